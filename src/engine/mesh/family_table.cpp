// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/family_table.h"

#include <algorithm>
#include <iterator>

namespace femscalpel {

std::uint64_t FamilyTable::hash(std::span<const GroupIndex> groups) {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (GroupIndex g : groups) {
        h ^= static_cast<std::uint64_t>(g) + 1;
        h *= 0xff51afd7ed558ccdu;
        h ^= h >> 32;
    }
    return h;
}

bool FamilyTable::contains(FamilyIndex family, GroupIndex group) const {
    const auto set = groups(family);
    return std::binary_search(set.begin(), set.end(), group);
}

FamilyIndex FamilyTable::intern(std::span<const GroupIndex> set) {
    const std::uint64_t key = hash(set);
    const auto [first, last] = by_hash_.equal_range(key);
    for (auto it = first; it != last; ++it)
        if (std::ranges::equal(groups(it->second), set)) return it->second;
    groups_.insert(groups_.end(), set.begin(), set.end());
    offsets_.push_back(static_cast<std::int64_t>(groups_.size()));
    const FamilyIndex made = size() - 1;
    by_hash_.emplace(key, made);
    return made;
}

FamilyIndex FamilyTable::with(FamilyIndex family, GroupIndex group) {
    if (contains(family, group)) return family;
    const auto old = groups(family);
    std::vector<GroupIndex> set(old.begin(), old.end());
    set.insert(std::lower_bound(set.begin(), set.end(), group), group);
    return intern(set);
}

FamilyIndex FamilyTable::without(FamilyIndex family, GroupIndex group) {
    const auto old = groups(family);
    std::vector<GroupIndex> set;
    std::ranges::copy_if(old, std::back_inserter(set), [group](GroupIndex g) { return g != group; });
    return intern(set);
}

FamilyIndex FamilyTable::unite(FamilyIndex a, FamilyIndex b) {
    if (a == b || b == 0) return a;
    if (a == 0) return b;
    std::vector<GroupIndex> set;
    std::ranges::set_union(groups(a), groups(b), std::back_inserter(set));
    return intern(set);
}

FamilyIndex FamilyTable::intersect(FamilyIndex a, FamilyIndex b) {
    if (a == b) return a;
    if (a == 0 || b == 0) return 0;
    std::vector<GroupIndex> set;
    std::ranges::set_intersection(groups(a), groups(b), std::back_inserter(set));
    return intern(set);
}

}  // namespace femscalpel
