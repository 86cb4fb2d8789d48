// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/node_parts.h"

#include <algorithm>
#include <numeric>

namespace femscalpel {

NodeParts::NodeParts(int elements)
    : elements_(static_cast<std::size_t>(elements)), part_(static_cast<std::size_t>(elements)) {
    std::iota(part_.begin(), part_.end(), 0);
}

int NodeParts::find(int element) {
    while (part_[element] != element) element = part_[element] = part_[part_[element]];
    return element;
}

void NodeParts::unite(int a, int b) {
    a = find(a);
    b = find(b);
    part_[std::max(a, b)] = std::min(a, b);
}

void NodeParts::sum_up() {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
        Part& p = parts_[find(static_cast<int>(i))];
        ++p.size;
        p.side += elements_[i].side;
        p.touches = p.touches || elements_[i].touches;
    }
}

int NodeParts::largest(std::optional<bool> positive) const {
    int best = -1, size = 0;
    for (const auto& [root, p] : parts_)
        if (p.touches && (!positive || (p.side > 0) == *positive) && p.size > size) {
            best = root;
            size = p.size;
        }
    return best;
}

int NodeParts::goes_with(int element) {
    const int root = find(element);
    const Part& p = parts_.at(root);
    if (p.touches) return root;
    const int with = largest(p.side > 0);
    return with >= 0 ? with : largest({});
}

int NodeParts::keeper() const {
    const int negative = largest(false);
    return negative >= 0 ? negative : largest({});
}

std::vector<std::pair<int, bool>> NodeParts::parted() const {
    std::vector<std::pair<int, bool>> out;
    const int keeps = keeper();
    for (const auto& [root, p] : parts_)
        if (p.touches && root != keeps) out.push_back({root, p.side > 0});
    return out;
}

}  // namespace femscalpel
