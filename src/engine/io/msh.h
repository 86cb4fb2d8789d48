// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads a mesh of Gmsh: .msh of the versions 2.0 to 2.2, 4.0 (text) and 4.1, text or binary of either byte order.
///
/// Numbers, coordinates and element types are the file's; elements of third and higher order, the pyramid of 14 nodes,
/// polygons and polyhedra throw UnsupportedElementError. All nodes are kept, those without elements, too.
///
/// Groups: physical groups of curves, surfaces and volumes are element groups; those of one name, also of several
/// dimensions, are one group. Physical groups of points are node groups, and their point elements are no elements of
/// the mesh; in files of write_msh(), which say so, groups of point elements come back as these. Names without members
/// are empty groups. Without a name a group is called as Gmsh itself calls it elsewhere: PhysicalPoint7, PhysicalLine7,
/// PhysicalSurface7, PhysicalVolume7 for the tag 7 (followed by "_" where that is another group's name).
///
/// A negative tag means the other side: an edge or face element all of whose groups are negative is turned round;
/// one in groups of both signs stays as it is (Mesh::remarks).
///
/// Files of version 2 have an element once per physical group, with another number each time, one behind the other;
/// that is one element here, of the first of these numbers, in all these groups. What is told from elements that do
/// lie on each other is: consecutive, of one type and geometrical entity, the same nodes, another physical group.
///
/// What else the file holds is told in Mesh::remarks: partitions, parametric coordinates, results, comments, sections
/// that are unknown; geometrical entities where nothing is in a physical group.
///
/// Throws ReadError: file missing, truncated, contradictory; with file and line, or section and byte in binary.
Mesh read_msh(const std::filesystem::path& path);

/// Writes a mesh as Gmsh's MSH 4.1, ASCII. Node and element numbers and coordinates are kept exactly.
///
/// Element groups are physical groups of their name, one per dimension of their members; the tag is the same in all. As
/// in Gmsh the elements of one entity have their physical groups in common, there is a discrete entity per dimension
/// and set of groups, with all its tags; groups may overlap freely. Elements keep their order.
///
/// Node groups are physical groups of dimension 0, as Gmsh has it: over point elements that are added for them, one per
/// node in a group, numbered above the largest element number. Of empty groups there is only the name; their dimension
/// is 0 for node groups, else the mesh's, at least 1. Where element groups hold point elements, a section of comments
/// says which groups are which, for read_msh().
///
/// Hidden groups are left out; msh_losses() says what else is. Written by way of AtomicFile. The mesh must be valid
/// (Mesh::validate). Throws WriteError: elements that Gmsh has not (triangle7); a group's name that is empty, longer
/// than Gmsh's 127 bytes or contains a double quote or control character; path not writable; disk full.
void write_msh(const Mesh& mesh, const std::filesystem::path& path);

/// What of this mesh write_msh() leaves out, a line each: facet groups by name, a deck's cards, the unit.
std::vector<std::string> msh_losses(const Mesh& mesh);

}  // namespace femscalpel
