// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace femscalpel {

/// Edges, each named once by its ends, as chains of nodes that each go on as far as they can: open ones from their ends
/// first, then closed ones, which end where they begin. In the order of the nodes.
template <class Node>
std::vector<std::vector<Node>> chains_of(const std::vector<std::array<Node, 2>>& edges) {
    std::map<Node, std::vector<Node>> next;
    for (const auto& [a, b] : edges) {
        next[a].push_back(b);
        next[b].push_back(a);
    }
    std::vector<std::vector<Node>> out;
    const auto walk = [&](Node from) {
        std::vector<Node> chain{from};
        while (!next[chain.back()].empty()) {
            const Node v = chain.back(), w = next[v].front();
            next[v].erase(next[v].begin());
            std::erase(next[w], v);
            chain.push_back(w);
        }
        out.push_back(std::move(chain));
    };
    std::vector<Node> nodes;
    nodes.reserve(next.size());
    for (const auto& [v, neighbours] : next) nodes.push_back(v);
    for (const Node v : nodes)
        if (next[v].size() % 2 == 1) walk(v);
    for (const Node v : nodes)
        if (!next[v].empty()) walk(v);
    return out;
}

}  // namespace femscalpel
