// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace femscalpel {

/// Disjoint sets of the numbers 0 to count - 1, each its own at first.
class UnionFind {
public:
    explicit UnionFind(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    /// The number that stands for the set of `i`: its smallest.
    int find(int i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// Makes one set of those of `i` and `j`.
    void unite(int i, int j) {
        i = find(i);
        j = find(j);
        if (i != j) parent_[std::max(i, j)] = std::min(i, j);
    }

private:
    std::vector<int> parent_;
};

}  // namespace femscalpel
