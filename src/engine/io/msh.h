// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Writes a mesh as Gmsh's MSH 4.1, ASCII. Node and element numbers and coordinates are kept exactly.
///
/// Element groups are physical groups of their name, one per dimension of their members; the tag is the same in all. As
/// in Gmsh the elements of one entity have their physical groups in common, there is a discrete entity per dimension
/// and set of groups, with all its tags; groups may overlap freely. Elements keep their order.
///
/// Node groups are physical groups of dimension 0, as Gmsh has it: over point elements that are added for them, one per
/// node in a group, numbered above the largest element number. Of empty groups there is only the name; their dimension
/// is 0 for node groups, else the mesh's.
///
/// Hidden groups are left out; msh_losses() says what else is. Written by way of AtomicFile. The mesh must be valid
/// (Mesh::validate). Throws WriteError: elements that Gmsh has not (triangle7); a group's name that is empty, longer
/// than Gmsh's 127 bytes or contains a double quote or control character; path not writable; disk full.
void write_msh(const Mesh& mesh, const std::filesystem::path& path);

/// What of this mesh write_msh() leaves out, a line each: facet groups by name, a deck's cards, the unit.
std::vector<std::string> msh_losses(const Mesh& mesh);

}  // namespace femscalpel
