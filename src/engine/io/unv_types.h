// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "mesh/cell_type.h"

namespace femscalpel {

/// An element type in universal files: the descriptor it is written with, 0 where they have none, and its nodes as
/// positions in ours: node k of the file is our node order[k]. Middle nodes of edges stand between their ends.
struct UnvType {
    int descriptor;
    std::array<std::int8_t, 20> order;
};

/// The type in universal files for one of ours.
const UnvType& unv_type(CellType type);

/// Our type for a descriptor and a number of nodes; none for those we have not.
std::optional<CellType> cell_type_of_unv(std::int64_t descriptor, std::int64_t nodes);

/// Whether elements of that descriptor are rods, beams or pipes, which may have a line for their sections.
bool is_unv_beam(std::int64_t descriptor);

/// The name of a descriptor that we have not: "rigid element"; empty for unknown ones.
std::string unv_description(std::int64_t descriptor);

}  // namespace femscalpel
