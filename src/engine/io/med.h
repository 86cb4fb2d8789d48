// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads the unstructured mesh of that name, or the first if `mesh` is empty, of a MED file (SALOME, Code_Aster, Gmsh,
/// FreeCAD), at its first computation step; where it has several, that is in Mesh::remarks. Files of MED 2.2 to 4.1.
///
/// Nodes: coordinates bit for bit, z (and y) = 0 where the file is 2-D (1-D). Cartesian axes only. The
/// unit of the first axis becomes Mesh::unit.
///
/// Elements: every type of CellType. MED orders the nodes of volume elements the other way round
/// (a tetrahedron's fourth node lies opposite to where the normal of the first three points); they are
/// turned into the order of CellType. Polygons, polyhedra, SEG4, OCTA12, structure elements and
/// descending connectivity throw UnsupportedElementError with type and count.
///
/// Numbers: the file's optional node numbers, otherwise 1, 2, 3... Element numbers are optional per type
/// and may repeat between types; they are kept if every element has one and all differ in the whole
/// mesh. Otherwise all elements are numbered from 1 in the order of CellType, points first.
///
/// Groups: a MED family is a set of groups. A name that node families and element families share gives
/// two groups, one of each kind. Groups of families no entity uses are kept, empty; their kind is the
/// family number's sign (positive: nodes). Trailing blanks of names are dropped.
///
/// Fields on nodes, elements, elements' nodes and integration points, with profiles, localizations and all time steps,
/// of real and whole numbers, become Mesh::fields. Those on edges and faces that are no elements, and damaged ones, are
/// left out, and named in Mesh::remarks.
///
/// Throws ReadError that names the file and what is wrong with it: missing, not a MED file, truncated,
/// damaged, contradictory. The mesh returned is valid (Mesh::validate).
/// MED-fichier and HDF5 are not thread-safe: calls of read_med and write_med wait for each other.
Mesh read_med(const std::filesystem::path& path, const std::string& mesh = {});

/// The names of the unstructured meshes of a MED file. Throws as read_med() does.
std::vector<std::string> med_meshes(const std::filesystem::path& path);

/// Writes a mesh as MED 4.1: three-dimensional Cartesian coordinates (axes X, Y, Z in Mesh::unit), node
/// and element numbers, groups as families. The order of the groups is not part of the format.
///
/// MED has no facets. Each facet is written as a new face element - an edge element for the edge of a
/// shell - numbered above the largest element number, in an element group of the facet group's name.
/// (If an element group has that name already, "_SURF" is appended.) Its normal points out of the volume
/// element, or, for the sides of a shell, away from the shell on that side. This is what Code_Aster
/// applies pressures to; on reading back, such a group is an element group.
///
/// Fields are written with profiles where not all nodes or elements of a type have values.
///
/// Hidden groups are not written. Mesh names are cut to MED's 64 bytes and lose characters HDF5 forbids.
/// Written by way of AtomicFile. The mesh must be valid (Mesh::validate).
/// Throws WriteError: path not writable; no nodes; a group name that is empty, ends in a blank or is
/// longer than MED's 80 bytes; a number too large for the MED library's integers; disk full.
void write_med(const Mesh& mesh, const std::filesystem::path& path);

/// What of this mesh write_med() changes, a line each: facet groups that cannot keep their name.
std::vector<std::string> med_losses(const Mesh& mesh);

}  // namespace femscalpel
