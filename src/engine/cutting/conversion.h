// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cutting/quad_table.h"
#include "mesh/adjacency.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// A face of an element by its corners, in the order of CellTraits::faces, without repeated ones: three or four.
struct ElementFace {
    std::array<Index, 4> corners{};
    int count = 0;
    int number = 0;  ///< Facet::face
};

/// The faces of a solid. Degenerate elements, which have nodes twice, have triangles in place of quadrangles, or fewer
/// faces.
std::vector<ElementFace> faces_of(const Mesh& mesh, const CellRef& cell);

/// What a node allows pyramids. CalculiX, which has none, takes their tip for four nodes, which must be free; and the
/// edges at their base have to stay straight (deck/edge_ties.h).
enum class PyramidRule : char { any, no_tip, no_tip_nor_base };

/// What is to become simplices.
struct Conversion {
    CellLists cells;
    /// Quadrangular faces between these and solids that stay: pyramids stand on them.
    QuadTable<char> bases;
    /// Diagonals of faces that are not to be those that are better for the face alone.
    QuadTable<QuadDiagonal> diagonals = {};

    std::vector<PyramidRule> rules = {};  ///< by node, or empty

    bool empty() const;
};

/// What has to become simplices so that all elements with a corner where level >= 0 are: these elements themselves;
/// solids across their quadrangular faces, whose pyramids are then out of reach; shells on faces of all these. Where
/// such a face has a node in its middle, no pyramid can stand on it: then what is across follows, as far as such faces
/// go; where pyramids in an element would be poor, as `unfit` says; and where `rules` (by node, or empty) forbid a
/// mid-side node to be at the base of one. One pass over the elements for each step, unless their `adjacency` is given,
/// which saves the first.
Conversion plan_conversion(const Mesh& mesh, const std::vector<std::int8_t>& level, const Adjacency* adjacency,
                           std::span<const CellRef> unfit = {}, std::vector<PyramidRule> rules = {});

}  // namespace femscalpel
