// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace femscalpel {

/// Index into Mesh::groups.
using GroupIndex = std::int32_t;
/// Index of a set of groups in FamilyTable; 0 is the empty one.
using FamilyIndex = std::int32_t;

/// The distinct sets of groups that entities of a mesh belong to. An entity stores one family index;
/// entities with the same index form an elementary group (paper, 2.2; a family in MED). Family 0 is
/// the empty set. Sets are kept once each and never change, so indices stay valid while the table lives.
class FamilyTable {
public:
    FamilyTable() : offsets_{0, 0} { by_hash_.emplace(hash({}), 0); }

    /// Number of distinct sets, the empty one included.
    FamilyIndex size() const { return static_cast<FamilyIndex>(offsets_.size()) - 1; }

    /// The groups of a family, ascending.
    std::span<const GroupIndex> groups(FamilyIndex family) const {
        return {groups_.data() + offsets_[family], groups_.data() + offsets_[family + 1]};
    }

    bool contains(FamilyIndex family, GroupIndex group) const;

    /// The family of exactly these groups (ascending, without repeats); made if new.
    FamilyIndex intern(std::span<const GroupIndex> groups);

    FamilyIndex with(FamilyIndex family, GroupIndex group);     ///< family + group
    FamilyIndex without(FamilyIndex family, GroupIndex group);  ///< family - group
    FamilyIndex unite(FamilyIndex a, FamilyIndex b);
    FamilyIndex intersect(FamilyIndex a, FamilyIndex b);

private:
    static std::uint64_t hash(std::span<const GroupIndex> groups);

    std::vector<std::int64_t> offsets_;
    std::vector<GroupIndex> groups_;
    std::unordered_multimap<std::uint64_t, FamilyIndex> by_hash_;
};

}  // namespace femscalpel
