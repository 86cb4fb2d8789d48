// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/node_membership.h"

#include <algorithm>
#include <iterator>

namespace femscalpel {
namespace {

using Groups = std::vector<GroupIndex>;

Groups common(std::span<const GroupIndex> a, std::span<const GroupIndex> b) {
    Groups out;
    std::ranges::set_intersection(a, b, std::back_inserter(out));
    return out;
}

bool has_node(const auto& nodes, int v) { return std::ranges::find(nodes, v) != nodes.end(); }

}  // namespace

NodeMembership::NodeMembership(const BandMesh& band, const Mesh& mesh) : families_(mesh.families) {
    for (const Group& g : mesh.groups) hidden_.push_back(g.hidden);
    for (const BandNode& n : band.nodes) in_.push_back(mesh.node_families[n.global]);
    middles_.assign(in_.size(), 0);
    for (const auto& [edge, middle] : band.mid_nodes) {
        const FamilyIndex family = mesh.node_families[middle];
        if (family == 0) continue;
        of_middle_.emplace(middle, family);
        for (const auto end : {edge >> 32, edge & 0xffffffffu}) middles_[end] = families_.unite(middles_[end], family);
    }
}

void NodeMembership::add_node(const BandMesh& band, int node) {
    const auto& [a, b] = band.births[node - band.original_nodes()];
    const FamilyIndex common_to_ends = families_.intersect(in_[a], in_[b]),
                      of_middles = families_.unite(middles_[a], middles_[b]);
    middles_.push_back(of_middles);
    const Index middle = band.nodes[node].global;
    if (middle < 0 || band.is_handed_over(a, b)) {
        in_.push_back(common_to_ends);
        return;
    }
    const auto own = of_middle_.find(middle);
    FamilyIndex family = own == of_middle_.end() ? 0 : own->second;
    const std::span<const GroupIndex> candidates = families_.groups(common_to_ends);
    for (const GroupIndex g : Groups(candidates.begin(), candidates.end()))
        if (!hidden_[g] && !families_.contains(of_middles, g)) family = families_.with(family, g);
    in_.push_back(family);
}

bool NodeMembership::may_hand_over(Index middle, int a, int b) const {
    const auto own = of_middle_.find(middle);
    if (own == of_middle_.end()) return true;
    return std::ranges::all_of(families_.groups(own->second), [&](GroupIndex g) {
        return !hidden_[g] && families_.contains(in_[a], g) && families_.contains(in_[b], g);
    });
}

bool NodeMembership::merge_links(const BandMesh& band, int p, int t) const {
    if (in_[t] == in_[p] || in_[t] == 0) return false;
    const auto joined = [&](std::initializer_list<int> nodes) {
        const auto in = [&](const auto& list) {
            return std::ranges::any_of(list.around(t), [&](int s) {
                return std::ranges::all_of(nodes, [&](int v) { return has_node(list[s], v); });
            });
        };
        return in(band.tetras) || in(band.triangles);
    };
    // The groups of t alone among the two: what they link with other nodes of an element was not linked before.
    Groups fresh;
    std::ranges::set_difference(families_.groups(in_[t]), families_.groups(in_[p]), std::back_inserter(fresh));
    const auto links = [&](const auto& list) {
        for (const int s : list.around(p)) {
            if (has_node(list[s], t)) continue;
            for (const int x : list[s]) {
                if (x == p) continue;
                const Groups edge = common(fresh, families_.groups(in_[x]));
                if (edge.empty()) continue;
                if (!joined({x})) return true;
                for (const int y : list[s]) {
                    if (y == p || y <= x) continue;
                    const Groups face = common(edge, families_.groups(in_[y]));
                    if (face.empty()) continue;
                    if (!joined({x, y})) return true;
                    for (const int z : list[s])
                        if (z != p && z > y && !common(face, families_.groups(in_[z])).empty()) return true;
                }
            }
        }
        return false;
    };
    return links(band.tetras) || links(band.triangles);
}

}  // namespace femscalpel
