// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// Areas that a group covers with the edges or faces around them alone (paper, 4.2: inside BE, or LE that are faces
/// with three edges in the group), and no longer covers, because they were split and no elements of the group were made
/// between the parts: those would be beams and shells that nobody asked for. One message per visible group of elements
/// or facets, with the group, how much, and where: the numbers of the elements of `mesh` that were split.
std::vector<std::string> warnings_of_opened_areas(const BandMesh& band, const Mesh& mesh);

}  // namespace femscalpel
