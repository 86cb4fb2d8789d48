// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/msh_groups.h"

#include <algorithm>
#include <cstdlib>

namespace femscalpel {

bool MshGroups::name(int dimension, Index tag, std::string_view name) {
    const auto [it, added] = names_.try_emplace({dimension, tag}, name);
    if (added) order_.emplace_back(dimension, tag);
    return added || it->second == name;
}

void MshGroups::make_named() {
    for (const auto& [dimension, tag] : order_)
        group(dimension, tag, is_node_group(dimension, tag) ? GroupKind::node : GroupKind::element);
}

bool MshGroups::is_node_group(int dimension, Index tag) const {
    return dimension == 0 && (!node_tags_ || std::ranges::find(*node_tags_, tag) != node_tags_->end());
}

GroupIndex MshGroups::group(int dimension, Index tag, GroupKind kind) {
    const auto known = known_.find({dimension, tag});
    if (known != known_.end()) return known->second;
    constexpr const char* unnamed[] = {"PhysicalPoint", "PhysicalLine", "PhysicalSurface", "PhysicalVolume"};
    const auto named = names_.find({dimension, tag});
    auto& by_name = by_name_[static_cast<std::size_t>(kind)];
    std::string name;
    if (named != names_.end() && !named->second.empty()) {
        name = named->second;
    } else {
        name = unnamed[dimension] + std::to_string(tag);
        while (by_name.contains(name)) name += '_';  // somebody else's name
    }
    const auto [it, added] = by_name.try_emplace(name, static_cast<GroupIndex>(mesh_.groups.size()));
    if (added) mesh_.groups.push_back({name, kind, false});
    known_.emplace(Key(dimension, tag), it->second);
    return it->second;
}

FamilyIndex MshGroups::family(int dimension, std::span<const Index> tags, GroupKind kind) {
    std::vector<GroupIndex> set;
    for (const Index signed_tag : tags) {
        const Index tag = std::abs(signed_tag);
        if (tag != 0 && is_node_group(dimension, tag) == (kind == GroupKind::node))
            set.push_back(group(dimension, tag, kind));
    }
    if (set.empty()) return 0;
    any_ = true;
    std::ranges::sort(set);
    set.erase(std::unique(set.begin(), set.end()), set.end());
    return mesh_.families.intern(set);
}

FamilyIndex MshGroups::elements(int dimension, std::span<const Index> tags) {
    return family(dimension, tags, GroupKind::element);
}

FamilyIndex MshGroups::nodes(std::span<const Index> tags) { return family(0, tags, GroupKind::node); }

}  // namespace femscalpel
