// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace femscalpel {

/// Least weight of nodes that separates two sides of a graph: a maximum flow through nodes split in an
/// entrance and an exit. Dinic, "Algorithm for solution of a problem of maximum flow in networks with
/// power estimation", Soviet Math. Dokl. 11 (1970).
class VertexCut {
public:
    using Weight = std::int64_t;
    /// Weight of what must not be cut. Other weights must add up to less.
    static constexpr Weight endless = std::numeric_limits<Weight>::max() / 1000;

    /// A graph of `nodes` nodes, 0, 1, 2, ..., without edges. Nodes without weight cost nothing to cut.
    explicit VertexCut(int nodes)
        : first_(2 * static_cast<std::size_t>(nodes) + 2, -1), source_(2 * nodes), sink_(2 * nodes + 1) {}

    /// What it costs to have v in the cut; once per node.
    void set_weight(int v, Weight weight) { add(2 * v, 2 * v + 1, weight); }
    /// Adds the edge v-w: its ends are not on different sides, unless one of them is in the cut.
    void join(int v, int w) {
        add(2 * v + 1, 2 * w, endless);
        add(2 * w + 1, 2 * v, endless);
    }
    /// What it costs to leave v wholly on the negative (positive) side.
    void hold_positive(int v, Weight weight) { add(source_, 2 * v, weight); }
    void hold_negative(int v, Weight weight) { add(2 * v + 1, sink_, weight); }

    /// Finds the cut. False when only an endless weight would separate the sides. Throws Cancelled.
    bool solve();

    /// After solve(): +1, -1, or 0 for a node of the cut. Of several cuts of the least weight it is the one nearest to
    /// the positive side.
    int side(int v) const {
        const std::size_t into = 2 * static_cast<std::size_t>(v);
        return level_[into] < 0 ? -1 : level_[into + 1] < 0 ? 0 : 1;
    }

private:
    struct Arc {
        int to;
        int next;
        Weight left;
    };

    void add(int from, int to, Weight capacity);
    bool find_levels();
    /// Pushes along one path of rising level from the source; 0 when none is left.
    Weight push(Weight most);

    std::vector<Arc> arcs_;
    std::vector<int> first_, next_, level_, queue_, path_;
    int source_, sink_;
};

}  // namespace femscalpel
