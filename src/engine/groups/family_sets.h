// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <vector>

#include "mesh/family_table.h"

namespace femscalpel {

/// Set operations on the families of a table, each pair worked out once.
class FamilySets {
public:
    explicit FamilySets(FamilyTable& table) : table_(table) {}

    int both(int a, int b) {
        if (a == b) return a;
        if (a == 0 || b == 0) return 0;
        return cached(both_, std::min(a, b), std::max(a, b), [&] { return table_.intersect(a, b); });
    }
    int either(int a, int b) {
        if (a == b || b == 0) return a;
        if (a == 0) return b;
        return cached(either_, std::min(a, b), std::max(a, b), [&] { return table_.unite(a, b); });
    }
    int minus(int a, int b) {
        if (a == b || a == 0) return 0;
        if (b == 0) return a;
        return cached(minus_, a, b, [&] {
            std::vector<GroupIndex> rest;
            std::ranges::set_difference(table_.groups(a), table_.groups(b), std::back_inserter(rest));
            return table_.intern(rest);
        });
    }
    int differ(int a, int b) { return either(minus(a, b), minus(b, a)); }

private:
    template <class Work>
    static int cached(std::unordered_map<std::uint64_t, int>& cache, int a, int b, Work work) {
        const std::uint64_t key = (static_cast<std::uint64_t>(a) << 32) | static_cast<std::uint64_t>(b);
        const auto it = cache.find(key);
        if (it != cache.end()) return it->second;
        const int made = work();
        cache.emplace(key, made);
        return made;
    }
    FamilyTable& table_;
    std::unordered_map<std::uint64_t, int> both_, either_, minus_;
};

}  // namespace femscalpel
