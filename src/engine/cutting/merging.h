// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "cutting/workpiece.h"

namespace femscalpel {

/// Whether two nodes are in one simplex of a list.
template <std::size_t N>
bool in_one(const SimplexList<N>& list, int a, int b) {
    return std::ranges::any_of(list.around(a), [&](int s) { return std::ranges::find(list[s], b) != list[s].end(); });
}

/// Moves nodes of a workpiece onto neighbours, where that changes no surface, line, tool or group and makes the
/// elements around them better. No node of the input is lost: the mid-side node that a node became where it was born
/// goes to another edge there.
class NodeMerger {
public:
    explicit NodeMerger(Workpiece& f) : f_(f), d_(f.d), band_(f.d.band) {}

    /// Merges p into the neighbour that makes the elements around it best; that neighbour, or -1 if none makes them
    /// better.
    int merge(int p);

private:
    bool may_merge(int p, int t);
    bool closes(int p, int t) const;
    bool link_is_sound(int p, int t);
    double quality_merged(int p, int t) const;
    std::vector<Index> homeless_middles(int p) const;
    std::vector<std::array<int, 2>> free_edges(int p, int t) const;
    bool find_homes(int p, int t);
    void hand_over(int p);

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    std::vector<int> near_p_, near_t_, common_, candidates_;
    std::vector<std::pair<std::uint64_t, Index>> homes_;  // of mid-side nodes, by edge
};

}  // namespace femscalpel
