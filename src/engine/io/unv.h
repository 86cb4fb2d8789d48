// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads a universal file (.unv) of I-DEAS, SALOME, FreeCAD, Gmsh.
///
/// Nodes: data sets 2411, 781 and 15. Coordinates are those of the file, in its unit: that of data set 164 is named in
/// Mesh::unit, nothing is scaled. Coordinate systems (2420) that nodes are given in must be the global one.
///
/// Elements: data sets 2412, 780 and 71, beams with or without the line for their sections. What they are is told by
/// their descriptor: rods, beams and pipes are line, line3; plane, axisymmetric, plate, membrane and shell elements
/// triangle, triangle6, triangle7, quad, quad8, quad9; solids tetra, tetra10, wedge, wedge15, hexahedron, hexahedron20;
/// lumped masses vertex. Others throw UnsupportedElementError, which names them; pyramids, too, since the files
/// have none, and SALOME gives those of 13 nodes in an order of its own.
///
/// Groups: data sets 2417, 2429, 2430, 2432, 2435, 2452, 2467, 2477. One that holds nodes and elements becomes a group
/// of each kind; groups of one name are one group; one without a name is called GROUP_7, by its number; one
/// without members is a group of elements.
///
/// Mesh::remarks tells what is not in the mesh: other data sets, numbers of properties and materials, members of other
/// kinds, members that the file does not define.
///
/// Throws ReadError with file and line: file missing, truncated, contradictory.
Mesh read_unv(const std::filesystem::path& path);

/// Writes a universal file as SALOME and FreeCAD do: data sets 2411, 2412, 2467. Numbers, coordinates and groups are
/// kept exactly; lines have the descriptors 11 and 22, triangles 41 and 42, quadrangles 44 and 45, points 161.
///
/// unv_losses() says what is left out. Written by way of AtomicFile. The mesh must be valid (Mesh::validate).
/// Throws WriteError: no nodes; pyramids, wedge18, hexahedron27, which the format has not; numbers over 2147483647; a
/// group's name that is empty, begins or ends in a blank, is "-1" or has control characters; path not writable; disk
/// full.
void write_unv(const Mesh& mesh, const std::filesystem::path& path);

/// What of this mesh write_unv() leaves out, a line each: facet groups by name, a deck's cards, the unit, that an
/// empty group is one of nodes; names of more than 40 bytes, which it writes, but not every program reads.
std::vector<std::string> unv_losses(const Mesh& mesh);

}  // namespace femscalpel
