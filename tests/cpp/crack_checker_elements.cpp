// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <unordered_map>

#include "crack_checker.h"

namespace femscalpel::checks {
namespace {

/// An element is degenerate below this mean ratio: a height of about a thousandth of its length.
constexpr double degenerate = 1e-4;

/// Where the element of each number is.
struct NumberIndexByHand {
    explicit NumberIndexByHand(const Mesh& mesh) {
        for (const CellBlock& b : mesh.blocks())
            for (Index c = 0; c < b.size(); ++c) cells.emplace(b.ids[c], CellRef{b.type, c});
    }
    std::unordered_map<Index, CellRef> cells;
};

}  // namespace

void CrackChecker::index() {
    for (std::size_t n = 0; n < out_.node_ids.size(); ++n) {
        index_.emplace(out_.node_ids[n], static_cast<Index>(n));
        distance_.push_back(plane_.distance(out_.points[n]));
    }
    for (const auto& [set, ids] : report_.node_sets)
        for (const Index i : ids) {
            if (!index_.contains(i)) bad_.add("node sets", set, " names node ", i, ", which the mesh does not have");
            if (!in_sets_.insert(i).second) bad_.add("node sets", "node ", i, " is named twice");
        }
    for (const char* set : {"ICN", "ECN"})
        if (report_.node_sets.contains(set))
            for (const Index i : report_.node_sets.at(set))
                if (const auto n = index_.find(i); n != index_.end()) interface_places_.insert(place(n->second));
}

bool CrackChecker::numbers_and_nodes() {
    if (index_.size() != out_.node_ids.size()) bad_.add("numbers", "node numbers are not unique");
    std::set<Index> cells;
    for (const CellBlock& b : out_.blocks())
        for (const Index i : b.ids)
            if (!cells.insert(i).second) bad_.add("numbers", "element number ", i, " is used twice");
    bool complete = true;
    for (const auto& [number, before] : model_.node_index) {
        const auto after = index_.find(number);
        if (after == index_.end()) {
            bad_.add("numbers", "node ", number, " is gone");
            complete = false;
        } else if (!in_sets_.contains(number) &&
                   std::memcmp(in_.points[before].data(), out_.points[after->second].data(), sizeof(Vec3)) != 0) {
            bad_.add("far node", "node ", number, " is in no node set but moved by ",
                     (in_.points[before] - out_.points[after->second]).norm());
        }
    }
    for (const Index n : model_.isolated_nodes)
        if (complete && !same_place(index_.at(in_.node_ids[n])))
            bad_.add("isolated node", "node ", in_.node_ids[n], " moved");
    std::vector<char> used(out_.points.size(), 0);
    for (const CellBlock& b : out_.blocks())
        for (const Index n : b.connectivity) used[n] = 1;
    std::vector<char> was_used(in_.points.size(), 0);
    for (const CellBlock& b : in_.blocks())
        for (const Index n : b.connectivity) was_used[n] = 1;
    for (std::size_t n = 0; n < used.size(); ++n) {
        if (used[n]) continue;
        const auto before = model_.node_index.find(out_.node_ids[n]);
        if (before == model_.node_index.end())
            bad_.add("orphan", "new node ", out_.node_ids[n], " belongs to no element");
        else if (was_used[before->second])
            bad_.add("orphan", "node ", out_.node_ids[n], " belongs to no element any more");
    }
    return complete;
}

void CrackChecker::far_elements() {
    const NumberIndexByHand after(out_);
    const std::vector<std::string> names_in = family_names(in_), names_out = family_names(out_, made_);
    for (const CellBlock& b : in_.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            const auto found = after.cells.find(b.ids[c]);
            const bool near = std::any_of(n.begin(), n.begin() + corners_of(b.type),
                                          [&](Index k) { return in_sets_.contains(in_.node_ids[k]); });
            if (found == after.cells.end()) {
                ++gone_;
                if (!near)
                    bad_.add("far element", "element ", b.ids[c],
                             " is gone, though none of its nodes is in a node set");
                continue;
            }
            const auto& [type, cell] = found->second;
            if (type != b.type) {
                bad_.add("far element", "element ", b.ids[c], " changed its type");
                continue;
            }
            if (names_in[b.families[c]] != names_out[out_.block(type).families[cell]])
                bad_.add("element groups", "element ", b.ids[c], " was in '", names_in[b.families[c]], "', is in '",
                         names_out[out_.block(type).families[cell]], "'");
            if (near) continue;
            const auto m = out_.block(type).nodes(cell);
            for (std::size_t k = 0; k < n.size(); ++k)
                if (in_.node_ids[n[k]] != id(m[k])) {
                    bad_.add("far element", "element ", b.ids[c], " has other nodes, though none is in a node set");
                    break;
                }
        }
}

bool CrackChecker::is_shell(std::span<const Index> n) const {
    if (!model_.mixed || n.size() == 4 || n.size() == 10) return false;
    const auto host = std::ranges::lower_bound(faces_, ascending(Key3{n[0], n[1], n[2]}), {},
                                               [](const TetraFace& f) { return f.key; });
    return host == faces_.end() || host->key != ascending(Key3{n[0], n[1], n[2]});
}

void CrackChecker::shapes() {
    std::map<Key2, Index> mids;
    const auto look = [&](CellType type, Index c, std::span<const Index> n) {
        const auto at = [&](int k) -> const Vec3& { return out_.points[n[k]]; };
        const Index number = out_.block(type).ids[c];
        const double q = is_tetra(type) ? tetra_shape(at(0), at(1), at(2), at(3)) : triangle_shape(at(0), at(1), at(2));
        const int corners = corners_of(type);
        if (is_tetra(type) == model_.solid || is_shell(n)) {
            if (!(q > 0))
                bad_.add("inverted", "element ", number, ", mean ratio ", q);
            else if (q < degenerate)
                bad_.add("degenerate", "element ", number, ", mean ratio ", q);
            if (std::any_of(n.begin(), n.begin() + corners, [&](Index k) {
                    return in_sets_.contains(id(k)) || interface_places_.contains(place(k));
                })) {
                ++band_count_;
                band_minimum_ = std::min(band_minimum_, q);
            }
        }
        if (!is_second_order(type)) return;
        for (int i = 0; i < corners; ++i)
            for (int j = 0; j < i; ++j) {
                const Index mid = n[mid_of(type, i, j)];
                const auto [known, fresh] = mids.emplace(ascending(Key2{n[i], n[j]}), mid);
                if (known->second != mid)
                    bad_.add("mid-side", "edge ", id(n[i]), "-", id(n[j]), " has two mid-side nodes");
                if (fresh && (out_.points[mid] - (at(i) + at(j)) / 2).norm() > 0.25 * (at(i) - at(j)).norm())
                    bad_.add("mid-side", "node ", id(mid), " is far from the middle of its edge");
            }
        if (!is_tetra(type)) return;
        std::array<Vec3, 10> p;
        for (int k = 0; k < 10; ++k) p[k] = at(k);
        const double a = (5 - std::sqrt(5.0)) / 20, b = (5 + 3 * std::sqrt(5.0)) / 20;
        for (const auto& [r, s, t] :
             {std::array{a, a, a}, std::array{b, a, a}, std::array{a, b, a}, std::array{a, a, b}})
            if (!(jacobian(p, r, s, t) > 0))
                bad_.add("jacobian", "element ", number, " has Jacobian ", jacobian(p, r, s, t),
                         " at an integration point");
    };
    for_each_cell(out_, is_tetra, look);
    for_each_cell(out_, is_triangle, look);
    std::set<Index> seen;
    for (const auto& [edge, mid] : mids)
        if (!seen.insert(mid).second) bad_.add("mid-side", "node ", id(mid), " is in the middle of two edges");
}

void CrackChecker::sides() {
    std::vector<char> side(out_.points.size(), 0);  // bit 1: of a positive element, bit 2: of a negative one
    std::vector<Index> part(out_.points.size());
    std::iota(part.begin(), part.end(), Index{0});
    const auto root = [&](Index n) {
        while (part[n] != n) n = part[n] = part[part[n]];
        return n;
    };
    for_each_cell(out_, model_.solid ? is_tetra : is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
        double low = 0, high = 0;
        for (int k = 0; k < corners_of(type); ++k) {
            low = std::min(low, distance_[n[k]]);
            high = std::max(high, distance_[n[k]]);
        }
        if (low < -tolerance() && high > tolerance())
            bad_.add("crossed", "element ", out_.block(type).ids[c], " reaches from ", low, " to ", high);
        if (high > tolerance() || low < -tolerance())
            for (const Index k : n) side[k] |= high > -low ? 1 : 2;
        for (const Index k : n) part[root(k)] = root(n[0]);
    });
    std::set<Index> front;
    if (const auto g = out_.find_group(name_ + "_FRONT", GroupKind::node)) {
        const auto members = group_members(out_, *g).ids;
        front.insert(members.begin(), members.end());
    }
    for (std::size_t n = 0; n < side.size(); ++n)
        if (side[n] == 3 && !front.contains(out_.node_ids[n]))
            bad_.add("still joined", "node ", out_.node_ids[n], " belongs to elements of both sides");
    if (!front.empty())
        bad_.add("front", "an infinite plane left ", front.size(), " front node(s), first ", *front.begin());
    std::map<Index, int> parts;
    for (std::size_t n = 0; n < side.size(); ++n)
        if (side[n]) parts[root(static_cast<Index>(n))] |= side[n];
    if (parts.size() < 2) bad_.add("parts", "the mesh did not come apart");
    for (const auto& [r, s] : parts)
        if (s == 3 && front.empty()) bad_.add("parts", "a part reaches to both sides");
}

}  // namespace femscalpel::checks
