// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/lineage.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "cancel.h"
#include "fields/reference_element.h"
#include "mesh/near_boxes.h"

namespace femscalpel {
namespace {

/// What is farther outside, in the element's dimensions, is on its border by rounding.
constexpr double rounding = -1e-9;
/// A node that is no farther outside belongs to its own elements: a crack's lips lie on each other.
constexpr double beside = -0.02;
/// A value is followed so far beyond an element, as its nodes have it; farther off it is that of the nearest point.
constexpr double farthest_outside = -0.25;
/// Rings of elements around its own that a node is looked for in.
constexpr int most_rings = 4;

/// What a place in an element means for a field's value.
struct Value {
    InElement::PerNode shares, cornered;  ///< of nodes, and of corners alone
    double outside = 0;
};

Value value_at(const Mesh& mesh, CellRef cell, const Vec3& at, const InElement& found) {
    const auto nodes = mesh.block(cell.type).nodes(cell.cell);
    const bool beyond = found.inside < farthest_outside;
    const InElement in = beyond ? held_inside(found, cell.type) : found;
    Value out{in.shares, in.cornered, 0};
    if (!beyond && in.inside < beside) {
        // Curved elements' functions go astray outside; a linear field is what their corners have, there, too.
        out.shares.setZero();
        out.shares.head(in.cornered.size()) = in.cornered;
    }
    if (beyond) {
        Vec3 nearest = Vec3::Zero();
        for (Eigen::Index k = 0; k < out.shares.size(); ++k)
            nearest += out.shares[k] * mesh.points[nodes[static_cast<std::size_t>(k)]];
        out.outside = (at - nearest).norm();
    }
    return out;
}

std::vector<std::pair<Index, double>> with_nodes(std::span<const Index> nodes, const InElement::PerNode& shares) {
    std::vector<std::pair<Index, double>> out;
    for (Eigen::Index k = 0; k < shares.size(); ++k)
        if (shares[k] != 0) out.emplace_back(nodes[static_cast<std::size_t>(k)], shares[k]);
    return out;
}

Vec3 middle(const Mesh& mesh, CellRef cell) {
    const auto nodes =
        mesh.block(cell.type).nodes(cell.cell).first(static_cast<std::size_t>(traits(cell.type).corners));
    Vec3 sum = Vec3::Zero();
    for (const Index n : nodes) sum += mesh.points[n];
    return sum / static_cast<double>(nodes.size());
}

Eigen::AlignedBox3d box(const Mesh& mesh, CellRef cell) {
    Eigen::AlignedBox3d out;
    for (const Index n : mesh.block(cell.type).nodes(cell.cell)) out.extend(mesh.points[n]);
    const Vec3 more = Vec3::Constant(1e-6 * out.diagonal().norm());
    return {out.min() - more, out.max() + more};
}

/// Whether all groups of an element of the input are also those of its part.
bool has_groups_of(const Mesh& before, CellRef was, const Mesh& after, CellRef now) {
    std::set<std::string> names;
    for (const GroupIndex g : after.families.groups(after.block(now.type).families[now.cell]))
        names.insert(after.groups[g].name);
    return std::ranges::all_of(before.families.groups(before.block(was.type).families[was.cell]),
                               [&](GroupIndex g) { return names.contains(before.groups[g].name); });
}

}  // namespace

struct FieldLineage::Found {
    CellRef cell{};
    std::optional<InElement> in;
    int dimension = 0;

    /// Whether another is better: of higher dimension, then deeper inside.
    void look(const Mesh& mesh, CellRef other, const Vec3& point) {
        const int d = traits(other.type).dimension;
        if (in && (d < dimension || (d == dimension && is_inside()))) return;
        const std::optional<InElement> there = find_in_element(mesh, other, point);
        if (!there || (in && d == dimension && there->inside <= in->inside)) return;
        cell = other;
        in = there;
        dimension = d;
    }
    bool is_inside() const { return in && in->inside >= rounding; }
};

FieldLineage::FieldLineage(const Mesh& before, const Mesh& after, std::span<const Changes> stages,
                           std::optional<GroupIndex> added)
    : before_(before), after_(after), numbers_(before) {
    find_kept_nodes();
    find_parents(stages, added);
    make_nodes(stages);
}

bool FieldLineage::is_copy(Index node) const {
    return nodes_[node] >= 0 && before_.node_ids[nodes_[node]] != after_.node_ids[node];
}

void FieldLineage::find_kept_nodes() {
    nodes_.assign(after_.points.size(), unknown);
    SparseCheck check(1 << 14);
    for (Index n = 0; n < after_.node_count(); ++n, check()) {
        // An operator keeps the order of the nodes that stay; then no look-up is needed.
        const bool in_place = n < before_.node_count() && before_.node_ids[n] == after_.node_ids[n];
        const std::optional<Index> was = in_place ? std::optional(n) : numbers_.node(after_.node_ids[n]);
        nodes_[n] = was && before_.points[*was] == after_.points[n] ? *was : made;
    }
}

bool FieldLineage::is_same(const CellBlock& block, Index cell, CellRef was) const {
    if (was.type != block.type || before_.block(was.type).ids[was.cell] != block.ids[cell]) return false;
    const auto now = block.nodes(cell), then = before_.block(was.type).nodes(was.cell);
    return std::ranges::equal(now, then, [&](Index a, Index b) { return after_.points[a] == before_.points[b]; });
}

void FieldLineage::find_parents(std::span<const Changes> stages, std::optional<GroupIndex> added) {
    std::unordered_map<Index, Index> parts;
    for (const Changes& stage : stages)
        for (const Changes::Part& p : stage.parts) parts.emplace(p.element, p.parent);
    std::vector<CellRef> lost;
    SparseCheck check(1 << 14);
    for (const CellBlock& b : after_.blocks()) {
        auto& list = parents_[static_cast<std::size_t>(b.type)];
        list.assign(static_cast<std::size_t>(b.size()), {});
        const CellBlock& same_type = before_.block(b.type);
        for (Index c = 0; c < b.size(); ++c, check()) {
            if (added && after_.families.contains(b.families[c], *added)) continue;
            const bool in_place = c < same_type.size() && same_type.ids[c] == b.ids[c];
            std::optional<CellRef> was = in_place ? CellRef{b.type, c} : numbers_.cell(b.ids[c]);
            Index number = b.ids[c];
            for (std::size_t k = 0; !was && k <= stages.size(); ++k) {
                const auto part = parts.find(number);
                if (part == parts.end()) break;
                number = part->second;
                was = numbers_.cell(number);
            }
            if (!was || traits(was->type).dimension != traits(b.type).dimension) {
                lost.push_back({b.type, c});
                continue;
            }
            list[static_cast<std::size_t>(c)] = {was->type, was->cell, is_same(b, c, *was)};
        }
    }
    if (!lost.empty()) look_for(lost);
}

void FieldLineage::look_for(const std::vector<CellRef>& lost) {
    std::vector<CellRef> cells;
    std::vector<Eigen::AlignedBox3d> boxes, points;
    for (const CellBlock& b : before_.blocks())
        for (Index c = 0; c < b.size() && traits(b.type).dimension > 0; ++c) {
            cells.push_back({b.type, c});
            boxes.push_back(box(before_, cells.back()));
        }
    for (const CellRef& c : lost) {
        const Vec3 at = middle(after_, c);
        points.emplace_back(at, at);
    }
    std::vector<Found> best(lost.size());
    std::vector<char> of_groups(lost.size(), 0);
    for (const auto& [k, c] : near_boxes(points, boxes)) {
        check_cancelled();
        const CellRef &now = lost[static_cast<std::size_t>(k)], &was = cells[static_cast<std::size_t>(c)];
        if (traits(now.type).dimension != traits(was.type).dimension) continue;
        Found there;
        there.look(before_, was, points[static_cast<std::size_t>(k)].min());
        if (!there.in || there.in->inside < -1e-6) continue;
        // Of faces that lie on each other, those that are in the same groups.
        const char fits = has_groups_of(before_, was, after_, now);
        Found& found = best[static_cast<std::size_t>(k)];
        char& fitted = of_groups[static_cast<std::size_t>(k)];
        if (found.in && (fits < fitted || (fits == fitted && there.in->inside <= found.in->inside))) continue;
        found = there;
        fitted = fits;
    }
    for (std::size_t k = 0; k < lost.size(); ++k)
        if (best[k].in)
            parents_[static_cast<std::size_t>(lost[k].type)][static_cast<std::size_t>(lost[k].cell)] = {
                best[k].cell.type, best[k].cell.cell, false};
}

std::unordered_map<Index, std::vector<CellRef>> FieldLineage::parents_around_made() const {
    std::unordered_map<Index, std::vector<CellRef>> out;
    SparseCheck check(1 << 14);
    for (const CellBlock& b : after_.blocks()) {
        const auto& list = parents_[static_cast<std::size_t>(b.type)];
        for (Index c = 0; c < b.size(); ++c, check()) {
            const Parent& parent = list[static_cast<std::size_t>(c)];
            if (parent.cell == unknown) continue;
            for (const Index n : b.nodes(c))
                if (nodes_[n] == made) out[n].push_back({parent.type, parent.cell});
        }
    }
    return out;
}

std::optional<FieldLineage::Made> FieldLineage::copy_in_place(Index node, const std::vector<CellRef>& around) const {
    if (numbers_.node(after_.node_ids[node])) return {};
    for (const CellRef& c : around)
        for (const Index n : before_.block(c.type).nodes(c.cell))
            if (before_.points[n] == after_.points[node]) return Made{node, {{n, 1.}}, {{n, 1.}}, 0, true};
    return {};
}

/// Among elements of one dimension, ring by ring until the point is inside one; `also_outside`: those beside it as
/// well.
void FieldLineage::look_around(Found& found, const Vec3& point, bool also_outside) {
    std::vector<CellRef> ring{found.cell};
    std::set<std::pair<int, Index>> seen{{static_cast<int>(found.cell.type), found.cell.cell}};
    const double enough = also_outside ? beside : rounding;
    for (int k = 0; k < most_rings && found.in->inside < enough; ++k) {
        if (!adjacency_) adjacency_ = std::make_unique<Adjacency>(before_);
        std::vector<CellRef> next;
        for (const CellRef& c : ring)
            for (const Index n :
                 before_.block(c.type).nodes(c.cell).first(static_cast<std::size_t>(traits(c.type).corners)))
                adjacency_->around(n, [&](CellType type, Index cell) {
                    if (traits(type).dimension == found.dimension && seen.emplace(static_cast<int>(type), cell).second)
                        next.push_back({type, cell});
                });
        for (const CellRef& c : next)
            if ((k == 0 && also_outside) || box(before_, c).contains(point)) found.look(before_, c, point);
        ring = std::move(next);
    }
}

CellRef FieldLineage::element_at(CellRef start, const Vec3& point, const Vec3& towards) {
    constexpr double aside = 1e-6;
    Found found;
    found.look(before_, start, point);
    if (!found.in || found.is_inside()) return start;
    found = {};
    const Vec3 at = point + aside * (towards - point);
    found.look(before_, start, at);
    if (found.in) look_around(found, at, false);
    return found.is_inside() ? found.cell : start;
}

std::optional<FieldLineage::Made> FieldLineage::make(Index node, const std::vector<CellRef>& around) {
    const Vec3& at = after_.points[node];
    Found found;
    for (const CellRef& c : around) found.look(before_, c, at);
    if (!found.in) return {};
    // Nodes that moved can be beyond the elements that their own are parts of.
    look_around(found, at, true);
    const auto nodes = before_.block(found.cell.type).nodes(found.cell.cell);
    const Value value = value_at(before_, found.cell, at, *found.in);
    return Made{node, with_nodes(nodes, value.shares), with_nodes(nodes, value.cornered), value.outside};
}

std::optional<std::vector<double>> FieldLineage::shares_in(const Mesh& mesh, CellRef cell, const Vec3& point,
                                                           double& off) {
    const std::optional<InElement> in = find_in_element(mesh, cell, point);
    if (!in) return {};
    const Value value = value_at(mesh, cell, point, *in);
    off = std::max(off, value.outside);
    return std::vector<double>(value.shares.begin(), value.shares.end());
}

void FieldLineage::make_nodes(std::span<const Changes> stages) {
    const auto around = parents_around_made();
    std::unordered_map<Index, Index> sources;  // of doubled nodes, by number
    for (const Changes& stage : stages)
        for (const Changes::Copy& c : stage.copies) sources.emplace(c.node, c.source);
    std::unordered_map<Index, std::size_t> at;  // of made ones, by number
    std::vector<Index> copies;
    SparseCheck check(256);
    for (Index n = 0; n < after_.node_count(); ++n) {
        if (nodes_[n] != made) continue;
        check();
        if (sources.contains(after_.node_ids[n])) {
            copies.push_back(n);
            continue;
        }
        const auto parents = around.find(n);
        std::optional<Made> out;
        if (parents != around.end()) {
            out = copy_in_place(n, parents->second);
            if (!out) out = make(n, parents->second);
        }
        if (!out) {
            nodes_[n] = unknown;
            continue;
        }
        if (out->doubled) {
            nodes_[n] = out->shares.front().first;
            continue;
        }
        at.emplace(after_.node_ids[n], made_.size());
        made_.push_back(std::move(*out));
    }
    for (const Index n : copies) {
        Index source = after_.node_ids[n];
        for (std::size_t k = 0; k <= stages.size() && sources.contains(source); ++k) source = sources.at(source);
        const auto parents = around.find(n);
        const auto was = numbers_.node(source);
        if (was && before_.points[*was] == after_.points[n]) {
            nodes_[n] = *was;
        } else if (const auto one = at.find(source); one != at.end()) {
            Made out = made_[one->second];
            out.node = n;
            out.doubled = true;
            made_.push_back(std::move(out));
        } else if (std::optional<Made> out = parents == around.end() ? std::nullopt : make(n, parents->second)) {
            out->doubled = true;
            made_.push_back(std::move(*out));
        } else {
            nodes_[n] = unknown;
        }
    }
    std::ranges::sort(made_, {}, &Made::node);
}

}  // namespace femscalpel
