// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <unordered_map>

#include "cutting/conversion.h"
#include "mesh/shape_blend.h"

namespace femscalpel {

/// The mid-side nodes and middles of faces around what is converted, and the diagonals its quadrangles are cut along:
/// one for each, whichever element it is looked at from.
class QuadCuts {
public:
    /// Takes the edges of the elements `cells` of `mesh`, which must outlive this. `add_node` makes the mid-side node
    /// of a diagonal at a place of these blends, for the corners of a face; not called when all edges are straight.
    /// `given`: diagonals of some faces.
    QuadCuts(Mesh& mesh, const CellLists& cells,
             std::function<Index(const Blend&, const std::array<Index, 4>&)> add_node,
             QuadTable<QuadDiagonal> given = {});

    /// Mid-side node of an edge, or -1.
    Index middle(Index a, Index b) const;
    void set_middle(Index a, Index b, Index node);

    /// Ends of the diagonal of a quadrangle: the one given, else that of the better triangles; where both are as good,
    /// at its node of the lowest number. The mid-side node is made if the edges have theirs.
    std::array<Index, 2> diagonal(const std::array<Index, 4>& corners);

    /// The two triangles of a quadrangle, running as it does.
    std::array<std::array<Index, 3>, 2> triangles(const std::array<Index, 4>& corners);

private:
    struct Choice {
        std::array<Index, 2> ends;
        Blend middle;
        double quality;
    };
    Choice choice(const std::array<Index, 4>& corners, int first) const;
    double quality(const std::array<Index, 3>& triangle, Index a, Index c, const Vec3& on_diagonal) const;

    Mesh& mesh_;
    QuadTable<QuadDiagonal> given_;
    std::function<Index(const Blend&, const std::array<Index, 4>&)> add_node_;
    std::unordered_map<std::uint64_t, Index> middles_;
    QuadTable<Index> face_middles_;
    QuadTable<QuadDiagonal> diagonals_;
};

}  // namespace femscalpel
