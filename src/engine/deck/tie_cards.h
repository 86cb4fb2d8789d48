// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.h"

namespace femscalpel {

/// A connection of two surfaces without common nodes.
struct Tie {
    std::string name;
    std::string slave, master;  ///< facet groups
    double tolerance = 0;       ///< how far nodes of the slave may be off the master
};

/// Half the largest thickness of the shells whose facets a group has, as the *SHELL SECTION cards of the mesh's deck
/// say; 0 of solids, nothing where a shell has no section.
std::optional<double> half_thickness(const Mesh& mesh, GroupIndex facets);

/// The *TIE card and its line.
std::string tie_card(const Tie& tie);

/// Adds both surfaces and the *TIE to the deck of a mesh, before its first step. Nothing happens without a deck.
void add_tie(Mesh& mesh, const Tie& tie);

}  // namespace femscalpel
