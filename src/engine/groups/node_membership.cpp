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

bool holds(const auto& nodes, int v) { return std::ranges::find(nodes, v) != nodes.end(); }

}  // namespace

NodeMembership::NodeMembership(const BandMesh& band, const Mesh& mesh) : families_(mesh.families) {
    for (const BandNode& n : band.nodes) in_.push_back(mesh.node_families[n.global]);
    for (const auto& [edge, middle] : band.mid_nodes)
        if (mesh.node_families[middle] != 0) of_middle_.emplace(middle, mesh.node_families[middle]);
}

void NodeMembership::add_node(const BandMesh& band, int node) {
    const auto& [a, b] = band.births[node - band.original_nodes()];
    if (const Index middle = band.nodes[node].global; middle >= 0) {
        const auto own = of_middle_.find(middle);
        in_.push_back(own == of_middle_.end() ? 0 : own->second);
    } else {
        in_.push_back(families_.intersect(in_[a], in_[b]));
    }
}

bool NodeMembership::merge_links(const BandMesh& band, int p, int t) const {
    if (in_[t] == in_[p] || in_[t] == 0) return false;
    const auto joined = [&](std::initializer_list<int> nodes) {
        const auto in = [&](const auto& list) {
            return std::ranges::any_of(list.around(t), [&](int s) {
                return std::ranges::all_of(nodes, [&](int v) { return holds(list[s], v); });
            });
        };
        return in(band.tetras) || in(band.triangles);
    };
    // The groups of t alone among the two: what they link with other nodes of an element was not linked before.
    Groups fresh;
    std::ranges::set_difference(families_.groups(in_[t]), families_.groups(in_[p]), std::back_inserter(fresh));
    const auto links = [&](const auto& list) {
        for (const int s : list.around(p)) {
            if (holds(list[s], t)) continue;
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
