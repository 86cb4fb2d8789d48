// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "mesh/cell_type.h"

namespace femscalpel {

/// VTK's cell type numbers in the order of CellType (vtkCellType.h). Nodes have the same order but in linear wedges,
/// whose base VTK sees from the other side: see turn_vtk_wedge().
inline constexpr std::array<std::uint8_t, cell_type_count> vtk_types = {1,  3,  21, 5,  22, 34, 9,  23, 28, 10,
                                                                        24, 14, 27, 13, 26, 32, 12, 25, 29};

/// The attribute of an array that is a group: what the group is of, "node", "element" or "facet".
inline constexpr const char* vtu_group_kind = "femscalpel_group";
/// The attribute with the group's name.
inline constexpr const char* vtu_group_name = "femscalpel_name";

/// The six nodes of a linear wedge in VTK's order, or from VTK's in ours.
template <class Iterator>
void turn_vtk_wedge(Iterator nodes) {
    std::swap(nodes[1], nodes[2]);
    std::swap(nodes[4], nodes[5]);
}

}  // namespace femscalpel
