// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Sets and surfaces of a mesh's deck whose group was taken out of the mesh, and which cards name: the deck is written
/// without them, and CalculiX stops at these cards. A line for each, "node set 'LOADED' is not in the mesh any more,
/// but deck.inp:12 (*CLOAD) ..."; none for a mesh without a deck. In lines, names that another set of the deck has,
/// too, are taken for that one's.
std::vector<std::string> named_gone_sets(const Mesh& mesh);

}  // namespace femscalpel
