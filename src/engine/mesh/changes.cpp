// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/changes.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace femscalpel {

Changes in_one(std::span<const Changes> stages) {
    Changes out;
    std::unordered_map<Index, Index> parents;
    std::unordered_map<Index, std::size_t> births;
    const auto resolve = [&](Changes::Born b) {
        std::vector<Index> ancestors;
        for (const Index a : b.ancestors) {
            const auto birth = births.find(a);
            if (birth == births.end()) {
                ancestors.push_back(a);
                continue;
            }
            const Changes::Born& first = out.born[birth->second];
            ancestors.insert(ancestors.end(), first.ancestors.begin(), first.ancestors.end());
            b.spans = b.spans || first.spans;
        }
        std::ranges::sort(ancestors);
        ancestors.erase(std::unique(ancestors.begin(), ancestors.end()), ancestors.end());
        b.ancestors = std::move(ancestors);
        std::map<Index, double> shares;
        bool told = true;
        for (const auto& [node, share] : b.shares) {
            const auto birth = births.find(node);
            if (birth == births.end()) {
                shares[node] += share;
                continue;
            }
            told = told && !out.born[birth->second].shares.empty();
            for (const auto& [first, part] : out.born[birth->second].shares) shares[first] += share * part;
        }
        b.shares.clear();
        if (told) b.shares.assign(shares.begin(), shares.end());
        return b;
    };
    for (const Changes& stage : stages) {
        for (const Changes::Born& b : stage.born) {
            births[b.node] = out.born.size();
            out.born.push_back(resolve(b));
        }
        for (const Changes::Part& p : stage.parts) {
            const auto parent = parents.find(p.parent);
            const Index root = parent == parents.end() ? p.parent : parent->second;
            parents[p.element] = root;
            out.parts.push_back({p.element, root});
        }
        out.copies.insert(out.copies.end(), stage.copies.begin(), stage.copies.end());
    }
    return out;
}

}  // namespace femscalpel
