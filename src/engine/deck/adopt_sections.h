// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Leaves in the deck of an addition what can be taken over to that of `mesh`: the cards of the mesh itself, materials,
/// orientations, distributions, and sections. Without a deck of `mesh` the addition loses its own. Returns warnings of
/// what is left out; elements of user types are.
std::vector<std::string> reduce_to_sections(const Mesh& mesh, Mesh& addition);

/// Gives those groups of the addition that its sections and distributions name another name, with the prefix, where
/// `mesh` has an element group of that name as CalculiX compares names: one set cannot have two sections. Throws
/// ToolError (parameter prefix) when that is taken, too.
void rename_section_groups(const Mesh& mesh, Mesh& addition, const std::string& prefix);

/// Takes the cards over to the deck of `united`, which the addition's elements were added to, at the end of each block
/// and in the same order: element types, and materials, orientations, distributions and sections, behind those that are
/// there. `groups`: what group of `united` each of the addition's became, or -1. A material, orientation or
/// distribution whose name is taken gets the prefix, unless what is there says the same.
///
/// Throws ToolError (parameter prefix) when that name is taken, too. Nothing happens unless both have a deck.
void adopt_sections(Mesh& united, const Mesh& addition, const std::vector<GroupIndex>& groups,
                    const std::string& prefix);

}  // namespace femscalpel
