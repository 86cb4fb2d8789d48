// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/changes.h"

namespace femscalpel {

/// Nodes of a result that are new or have moved, and where each came from. Nodes are given by number.
class NodeOrigins {
public:
    /// Linear in the meshes; `numbers` are those of `before` and `after`. `before` and its numbers must outlive this.
    NodeOrigins(const Mesh& before, const NumberIndex& before_numbers, const Mesh& after,
                const NumberIndex& after_numbers, const Changes& changes);

    /// A node of `before` and its share in the value at some node of `after`.
    struct Share {
        Index node;
        double weight;
    };

    /// A node that is new or has moved.
    struct Node {
        Index number;
        std::vector<Index> ancestors;  ///< nodes of `before` it stands for: itself, or the ends of its edge
        bool is_new;
        double moved = 0;    ///< how far, if not new
        Vec3 place;          ///< in `after`
        bool spans = false;  ///< Changes::Born::spans
    };
    const std::vector<Node>& nodes() const { return nodes_; }

    /// What gives a field's value at the place of nodes()[k]: the shape functions of the old element it is in. Empty
    /// if it is in none of those around its ancestors and around these. The first call takes a pass over `before`;
    /// results are kept.
    const std::vector<Share>& shares(std::size_t k) const;

    /// The copies of an original node, none for most.
    const std::vector<Index>& copies_of(Index node) const;
    bool is_doubled(Index node) const { return !copies_of(node).empty(); }
    /// How far an original node moved.
    double moved(Index node) const;

private:
    /// A point farther outside an element than this, in barycentric coordinates, is not said to be in it.
    static constexpr double outside = -0.25;
    /// Where a point is in an element.
    struct Place {
        std::optional<CellRef> cell;
        int dimension = 0;
        double inside = outside;  ///< the least of the coordinates
        std::vector<double> coordinates;
    };

    void find_elements() const;
    std::vector<CellRef> around(std::span<const Index> nodes) const;
    std::vector<Share> find_shares(const Node& node) const;
    Place best_place(std::span<const CellRef> cells, const Vec3& x, Place best) const;

    const Mesh& before_;
    const NumberIndex& before_numbers_;
    std::vector<Node> nodes_;
    mutable std::vector<std::optional<std::vector<Share>>> shares_;
    mutable std::unordered_map<Index, std::vector<CellRef>> elements_;  // around each ancestor, by index
    std::unordered_map<Index, std::vector<Index>> copies_;
    std::unordered_map<Index, double> moved_;
};

}  // namespace femscalpel
