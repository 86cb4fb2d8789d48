// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/cell_type.h"

namespace femscalpel {

/// What our files' $Comments say before the tags of those physical groups of points that are node groups; the others
/// are groups of point elements. It is there where groups hold point elements.
inline constexpr std::string_view msh_node_groups_comment = "FemScalpel: node groups are the physical points";

/// An element type in Gmsh: its number, 0 where Gmsh has none, and where its nodes stand in ours: Gmsh's node k is our
/// node order[k].
struct MshType {
    int number;
    std::array<std::int8_t, 27> order;
};

/// Gmsh's element type for one of ours.
const MshType& msh_type(CellType type);

/// Our element type for Gmsh's number; none for those we have not.
std::optional<CellType> cell_type_of_msh(std::int64_t number);

/// What Gmsh's documentation calls that type: "10-node third order triangle"; empty for numbers it does not explain.
std::string msh_type_description(std::int64_t number);

/// The nodes of an edge or face element seen from its other side: node k of the turned one is node result[k].
/// The type must be of dimension 1 or 2.
std::array<std::uint8_t, 27> turned_round(CellType type);

}  // namespace femscalpel
