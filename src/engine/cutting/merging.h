// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "cutting/workpiece.h"

namespace femscalpel {

/// Whether two nodes are in one simplex of a list.
template <std::size_t N>
bool in_one(const SimplexList<N>& list, int a, int b) {
    return std::ranges::any_of(list.around(a), [&](int s) { return std::ranges::find(list[s], b) != list[s].end(); });
}

/// Moves nodes of a workpiece onto neighbours, where that changes no surface, line, tool or group and makes the
/// elements around them better.
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

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    std::vector<int> near_p_, near_t_, common_, candidates_;
};

}  // namespace femscalpel
