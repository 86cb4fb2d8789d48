// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads a VTK XML unstructured grid: text, binary, appended raw or in base64, of either byte order, plain or
/// compressed with zlib. What write_vtu() wrote comes back with numbers and groups, facet groups, too.
///
/// Files of others: the data arrays "NodeNumber" and "ElementNumber" are the numbers if they are whole, positive and
/// differ; otherwise nodes and elements count from 1 in the file's order. Cells of VTK that CellType has not - pixels,
/// voxels, polygons, polyhedra, strips, those of higher order - throw UnsupportedElementError. Data arrays, which are
/// results, are not read; Mesh::remarks names them.
///
/// Throws ReadError with file and line: file missing, truncated, contradictory; of several pieces, whose nodes would be
/// double where they meet; compressed in other ways.
Mesh read_vtu(const std::filesystem::path& path);

/// Writes a mesh as VTK XML unstructured grid, for ParaView: appended raw data, compressed with zlib.
///
/// Elements stand in the order of CellType. Point data: "NodeNumber", "Family" and per node group an
/// array of its name, 1 for members, else 0, with attributes that say so to read_vtu(). Cell data: "ElementNumber",
/// "Family" and per element group the same; per facet group a bit mask of local faces (face 1 is bit 0). An array whose
/// name is taken within its section gets "_" appended. Hidden groups are left out. Bytes of group names that are not
/// UTF-8 are taken as Latin-1.
///
/// The corners of a linear wedge are turned round, since VTK wants the normal of its base outside; this
/// is what meshio does, so that reading the file there gives this mesh.
///
/// Written by way of AtomicFile. The mesh must be valid (Mesh::validate). Throws WriteError that names the
/// path: not writable, disk full.
void write_vtu(const Mesh& mesh, const std::filesystem::path& path);

/// What of this mesh write_vtu() leaves out, a line each: control characters in groups' names, the unit.
std::vector<std::string> vtu_losses(const Mesh& mesh);

}  // namespace femscalpel
