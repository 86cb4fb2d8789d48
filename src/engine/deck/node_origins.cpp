// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/node_origins.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "cancel.h"

namespace femscalpel {
namespace {

/// Smaller shares are rounding.
constexpr double smallest_share = 1e-13;

/// Barycentric coordinates of `x`, or of its foot on a triangle or segment.
std::vector<double> barycentric(const Mesh& mesh, std::span<const Index> nodes, int corners, const Vec3& x) {
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, corners - 1);
    for (int k = 1; k < corners; ++k) edges.col(k - 1) = mesh.points[nodes[k]] - mesh.points[nodes[0]];
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> along =
        edges.colPivHouseholderQr().solve(x - mesh.points[nodes[0]]);
    std::vector<double> out{1 - along.sum()};
    out.insert(out.end(), along.data(), along.data() + along.size());
    return out;
}

}  // namespace

NodeOrigins::NodeOrigins(const Mesh& before, const NumberIndex& before_numbers, const Mesh& after,
                         const NumberIndex& after_numbers, const Changes& changes)
    : before_(before), before_numbers_(before_numbers) {
    for (Index n = 0; n < before.node_count(); ++n) {
        const Index number = before.node_ids[n];
        // An operator keeps the order of the nodes that stay; then no look-up is needed.
        const bool in_place = n < after.node_count() && after.node_ids[n] == number;
        const auto now = in_place ? std::optional(n) : after_numbers.node(number);
        if (!now || after.points[*now] == before.points[n]) continue;
        const double moved = (after.points[*now] - before.points[n]).norm();
        moved_.emplace(number, moved);
        nodes_.push_back({number, {number}, false, moved, after.points[*now]});
    }
    std::unordered_map<Index, const Changes::Born*> born;
    std::vector<std::pair<std::size_t, std::vector<Share>>> known;
    for (const Changes::Born& b : changes.born) {
        born.emplace(b.node, &b);
        const auto now = after_numbers.node(b.node);
        if (!now) continue;
        if (!b.shares.empty()) {
            known.emplace_back(nodes_.size(), std::vector<Share>());
            for (const auto& [node, weight] : b.shares) known.back().second.push_back({node, weight});
        }
        nodes_.push_back({b.node, b.ancestors, true, 0, after.points[*now], b.spans});
    }
    for (const Changes::Copy& c : changes.copies) {
        copies_[c.source].push_back(c.node);
        const auto now = after_numbers.node(c.node);
        if (!now) continue;
        const auto source = born.find(c.source);
        if (source == born.end())
            nodes_.push_back({c.node, {c.source}, true, 0, after.points[*now]});
        else
            nodes_.push_back({c.node, source->second->ancestors, true, 0, after.points[*now], source->second->spans});
    }
    shares_.resize(nodes_.size());
    for (auto& [k, shares] : known) shares_[k] = std::move(shares);
}

const std::vector<NodeOrigins::Share>& NodeOrigins::shares(std::size_t k) const {
    if (!shares_[k]) {
        if (elements_.empty()) find_elements();
        shares_[k] = find_shares(nodes_[k]);
    }
    return *shares_[k];
}

void NodeOrigins::find_elements() const {
    const int dimension = before_.dimension();
    const auto for_all_around = [&](const std::vector<char>& wanted, auto found) {
        SparseCheck check(1 << 12);
        for (const CellBlock& b : before_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (!t.simplex || t.dimension == 0 || (t.dimension == 1 && dimension > 1)) continue;
            for (Index c = 0; c < b.size(); ++c, check())
                if (std::ranges::any_of(b.nodes(c), [&](Index n) { return wanted[n] != 0; })) found(CellRef{b.type, c});
        }
    };
    std::vector<char> near(static_cast<std::size_t>(before_.node_count()), 0);
    for (const Node& n : nodes_)
        for (const Index a : n.ancestors)
            if (const auto index = before_numbers_.node(a)) near[*index] = 1;
    std::vector<char> wanted = near;
    for_all_around(near, [&](CellRef c) {
        for (const Index n : before_.block(c.type).nodes(c.cell)) wanted[n] = 1;
    });
    for_all_around(wanted, [&](CellRef c) {
        for (const Index n : before_.block(c.type).nodes(c.cell))
            if (wanted[n]) elements_[n].push_back(c);
    });
}

std::vector<CellRef> NodeOrigins::around(std::span<const Index> nodes) const {
    std::vector<CellRef> out;
    for (const Index n : nodes)
        if (const auto it = elements_.find(n); it != elements_.end())
            out.insert(out.end(), it->second.begin(), it->second.end());
    const auto key = [](const CellRef& c) { return std::pair(c.type, c.cell); };
    std::ranges::sort(out, {}, key);
    out.erase(std::ranges::unique(out, {}, key).begin(), out.end());
    return out;
}

std::vector<NodeOrigins::Share> NodeOrigins::find_shares(const Node& node) const {
    std::vector<Index> from;
    for (const Index a : node.ancestors)
        if (const auto index = before_numbers_.node(a)) from.push_back(*index);
    const std::vector<CellRef> first = around(from);
    Place best = best_place(first, node.place, {});
    if (best.inside < 0 && !first.empty()) {  // nodes move through more than the elements around them
        for (const CellRef& c : first) {
            const auto n = before_.block(c.type).nodes(c.cell);
            from.insert(from.end(), n.begin(), n.end());
        }
        best = best_place(around(from), node.place, best);
    }
    if (!best.cell) return {};
    const CellTraits& t = traits(best.cell->type);
    const auto n = before_.block(best.cell->type).nodes(best.cell->cell);
    const std::vector<double>& l = best.coordinates;
    std::vector<Share> shares;
    const auto add = [&](Index n_share, double weight) {
        if (std::abs(weight) > smallest_share) shares.push_back({before_.node_ids[n_share], weight});
    };
    for (int i = 0; i < t.corners; ++i) add(n[i], t.quadratic ? l[i] * (2 * l[i] - 1) : l[i]);
    if (t.quadratic)
        for (std::size_t e = 0; e < t.edges.size(); ++e)
            add(n[static_cast<std::size_t>(t.corners) + e], 4 * l[t.edges[e][0]] * l[t.edges[e][1]]);
    return shares;
}

NodeOrigins::Place NodeOrigins::best_place(std::span<const CellRef> cells, const Vec3& x, Place best) const {
    for (const CellRef& cell : cells) {
        const CellTraits& t = traits(cell.type);
        if (t.dimension < best.dimension) continue;
        std::vector<double> l = barycentric(before_, before_.block(cell.type).nodes(cell.cell), t.corners, x);
        const double inside = *std::ranges::min_element(l);
        if (!(inside > best.inside) && !(inside > outside && t.dimension > best.dimension)) continue;
        best = {cell, t.dimension, inside, std::move(l)};
    }
    return best;
}

const std::vector<Index>& NodeOrigins::copies_of(Index node) const {
    static const std::vector<Index> none;
    const auto it = copies_.find(node);
    return it == copies_.end() ? none : it->second;
}

double NodeOrigins::moved(Index node) const {
    const auto it = moved_.find(node);
    return it == moved_.end() ? 0 : it->second;
}

}  // namespace femscalpel
