// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/weld_first.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>

#include "deck/carry_over.h"
#include "deck/fit_cards.h"
#include "mesh/companion.h"
#include "mesh/quality.h"
#include "mesh/rounding.h"
#include "mesh/stopwatch.h"
#include "operators/warnings.h"
#include "words.h"

namespace femscalpel {
namespace {

/// Welded nodes farther from all tools than so many lengths of their edges are out of reach.
constexpr double reach = 12;
/// A front bends where its segments are farther apart than this, in radians.
constexpr double straight = 1e-6;
/// The hidden groups of the deck are called so meanwhile: steps on the way remove those that mark_deck() made.
constexpr std::string_view other_prefix = "*KEPT#";

/// Keeps new nodes and elements from numbers that only the deck has.
class OtherNumbers : public Companion {
public:
    OtherNumbers(Index node, Index element) : node_(node), element_(element) {}
    Index largest_other_element() const override { return element_; }
    Index largest_other_node() const override { return node_; }

private:
    Index node_, element_;
};

void rename_marks(Mesh& mesh, std::string_view from, std::string_view to) {
    for (Group& g : mesh.groups)
        if (g.hidden && g.name.starts_with(from)) g.name.replace(0, from.size(), to);
}

std::vector<Index> numbers_of(const Mesh& mesh, const std::vector<Index>& nodes) {
    std::vector<Index> out;
    out.reserve(nodes.size());
    for (const Index n : nodes) out.push_back(mesh.node_ids[n]);
    return out;
}

std::vector<Index> nodes_of(const NumberIndex& numbers, const std::vector<Index>& ids) {
    std::vector<Index> out;
    for (const Index id : ids)
        if (const auto n = numbers.node(id)) out.push_back(*n);
    std::ranges::sort(out);
    return out;
}

}  // namespace

WeldFirst::WeldFirst(const Mesh& input, const Prepared& known)
    : input_(input), marks_(known.marks), outer_stages_(known.stages) {
    const Stopwatch::Time started = Stopwatch::now();
    std::optional<Welded> welded = weld(input, coordinate_rounding(input.points));
    if (!welded) return;
    if (!marks_) {
        own_marks_ = mark_deck(input);
        marks_ = &own_marks_;
    }
    welded_ = marks_->mesh ? weld(*marks_->mesh, coordinate_rounding(input.points)) : std::move(welded);
    find_marks();
    seconds_ = Stopwatch::since(started);
}

void WeldFirst::find_marks() {
    Mesh& mesh = welded_->mesh;
    Index largest = mesh.companion ? mesh.companion->largest_other_element() : 0;
    for (const CellRef& c : welded_->aside) largest = std::max(largest, input_.block(c.type).ids[c.cell]);
    const Index node = mesh.companion ? mesh.companion->largest_other_node() : 0;
    if (mesh.companion || !welded_->aside.empty()) mesh.companion = std::make_shared<OtherNumbers>(node, largest);
    rename_marks(mesh, mark_prefix, other_prefix);
    const std::vector<Index> now = welded_->single_nodes();
    const auto single = [&](const std::vector<Index>& nodes) {
        std::vector<Index> out;
        out.reserve(nodes.size());
        for (const Index n : nodes) out.push_back(now[n]);
        std::ranges::sort(out);
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    };
    on_welded_.kept = marks_->kept;
    on_welded_.kept.resize(mesh.groups.size(), false);
    on_welded_.kept[welded_->faces] = true;
    on_welded_.surface_sets = marks_->surface_sets;
    const std::vector<char> free = free_together();
    const auto held = [&](std::vector<Index> nodes) {
        std::erase_if(nodes, [&](Index n) { return free[n] != 0; });
        return single(nodes);
    };
    on_welded_.related = held(marks_->related);
    on_welded_.pinned = held(marks_->pinned);
    on_welded_.no_tips = single(marks_->no_tips);
    on_welded_.no_bases = single(marks_->no_bases);
    pin_fronts();
}

/// Which nodes of the input are held only so that they stay with others that are one with them now.
std::vector<char> WeldFirst::free_together() const {
    std::vector<char> out(input_.points.size(), 0);
    const std::vector<Index> now = welded_->single_nodes();
    bool all = true;
    for (const auto& [node, partners] : marks_->together) {
        const bool one = std::ranges::all_of(partners, [&](Index n) { return now[n] == now[node]; });
        out[node] = one && !partners.empty();
        all = all && one;
    }
    if (all)  // ends of edges whose mid-side nodes are
        for (const auto& [node, partners] : marks_->together) out[node] = 1;
    return out;
}

/// Where a weld ends inside the material - the front of an earlier crack, the rim of what is glued in part - its nodes
/// stay where it bends, as those of open lips do; elsewhere they may move along it.
void WeldFirst::pin_fronts() {
    const Mesh& mesh = welded_->mesh;
    std::map<std::array<Index, 2>, std::pair<int, Index>> edges;  // how many welded faces are there, mid-side node
    std::map<Index, int> ends;                                    // the same for nodes of welded edges of plates
    for (const Facet& f : mesh.facets) {
        if (!mesh.families.contains(f.family, welded_->faces)) continue;
        const CellTraits& t = traits(f.type);
        const auto n = mesh.block(f.type).nodes(f.cell);
        if (t.dimension != 3) {
            for (const std::int8_t k : t.edges[f.face - 3]) ++ends[n[k]];
            continue;
        }
        const auto& face = t.faces[f.face - 1];
        const auto has = [&](int k) { return std::ranges::find(face, k) != face.end(); };
        for (std::size_t e = 0; e < t.edges.size(); ++e)
            if (has(t.edges[e][0]) && has(t.edges[e][1])) {
                const Index a = n[t.edges[e][0]], b = n[t.edges[e][1]];
                auto& [count, middle] = edges[{std::min(a, b), std::max(a, b)}];
                ++count;
                middle = t.quadratic ? n[t.corners + static_cast<int>(e)] : -1;
            }
    }
    std::vector<char> is_double(mesh.points.size(), 0);
    for (const std::vector<Index>& set : welded_->sets) is_double[set.front()] = 1;
    std::map<Index, std::vector<Vec3>> ways;  // along the front, by node
    std::vector<Index>& pinned = on_welded_.pinned;
    for (const auto& [edge, there] : edges) {
        const auto& [a, b] = edge;
        if (there.first != 1 || is_double[a] || is_double[b]) continue;
        const Vec3 way = mesh.points[b] - mesh.points[a];
        ways[a].push_back(way.normalized());
        ways[b].push_back(-way.normalized());
        if (there.second < 0) continue;
        const Vec3 off = mesh.points[there.second] - (mesh.points[a] + mesh.points[b]) / 2;
        if (off.norm() > straight * way.norm()) pinned.insert(pinned.end(), {a, b, there.second});
    }
    for (const auto& [node, along] : ways)
        if (along.size() != 2 || (along[0] + along[1]).norm() > straight) pinned.push_back(node);
    for (const auto& [node, count] : ends)
        if (count == 1 && !is_double[node]) pinned.push_back(node);
    std::ranges::sort(pinned);
    pinned.erase(std::unique(pinned.begin(), pinned.end()), pinned.end());
}

bool WeldFirst::is_near(std::span<const Blade> blades) const {
    const Mesh& mesh = welded_->mesh;
    std::vector<double> length(mesh.points.size(), -1);
    for (const std::vector<Index>& set : welded_->sets) length[set.front()] = 0;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (const auto& e : traits(b.type).edges) {
                const Index p = n[e[0]], q = n[e[1]];
                if (length[p] < 0 && length[q] < 0) continue;
                const double size = (mesh.points[p] - mesh.points[q]).norm();
                for (const Index v : {p, q})
                    if (length[v] >= 0) length[v] = std::max(length[v], size);
            }
        }
    for (std::size_t n = 0; n < length.size(); ++n) {
        if (length[n] < 0) continue;
        for (const Blade& b : blades)
            if (std::abs(b.tool->distance(mesh.points[n])) <= reach * length[n]) return true;
    }
    return false;
}

Prepared WeldFirst::known() {
    Prepared out;
    out.marks = &on_welded_;
    out.stages = &stages_;
    out.renewed = [this](const Mesh& changed) {
        const NumberIndex numbers(changed);
        on_changed_ = {};
        on_changed_.kept = on_welded_.kept;
        on_changed_.surface_sets = on_welded_.surface_sets;
        on_changed_.related = nodes_of(numbers, numbers_of(mesh(), on_welded_.related));
        on_changed_.pinned = nodes_of(numbers, numbers_of(mesh(), on_welded_.pinned));
        on_changed_.no_tips = nodes_of(numbers, numbers_of(mesh(), on_welded_.no_tips));
        on_changed_.no_bases = nodes_of(numbers, numbers_of(mesh(), on_welded_.no_bases));
        Prepared renewed;
        renewed.marks = &on_changed_;
        renewed.stages = &stages_;
        return renewed;
    };
    return out;
}

void WeldFirst::carry(Mesh& mesh, const Changes& changes, bool strict, Report& report) const {
    const NumberIndex numbers(marked());
    std::unordered_map<Index, Index> parents;
    for (const Changes::Part& p : changes.parts) parents.emplace(p.element, p.parent);
    std::vector<CellRef> all, converted;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            all.push_back({b.type, c});
            const auto parent = parents.find(b.ids[c]);
            const auto root = numbers.cell(parent == parents.end() ? b.ids[c] : parent->second);
            if (root && root->type != b.type) converted.push_back({b.type, c});
        }
    if (!marks_->surface_sets.empty()) renew_surface_sets(mesh, marks_->surface_sets, *solver_input(input_), all);
    std::ranges::move(warnings_of(carry_deck(marked(), mesh, changes), strict), std::back_inserter(report.warnings));
    if (!converted.empty()) fit_cards(mesh, converted);
}

void WeldFirst::report_pairs(const Mesh& mesh, const Unwelded& unwelded, Index doubled, Report& report) const {
    report.welded_pairs = welded_->pairs();
    report.nodes_added += unwelded.born + doubled - report.nodes_doubled;
    report.nodes_split += unwelded.born;
    report.nodes_doubled = doubled;
    report.nodes_moved += unwelded.moved;
    report.nodes_removed += unwelded.removed;
    for (auto& [name, numbers] : report.node_sets) {
        const std::vector<Index> single = numbers;
        for (const Index n : single)
            if (const auto partners = unwelded.partners.find(n); partners != unwelded.partners.end())
                numbers.insert(numbers.end(), partners->second.begin(), partners->second.end());
        std::ranges::sort(numbers);
    }
    report_segments(mesh, unwelded, report);
    // Node groups were those of all that was single.
    std::vector<Index> before(mesh.groups.size(), 0), after(mesh.groups.size(), 0);
    const auto count = [](const Mesh& of, std::vector<Index>& counts) {
        for (const FamilyIndex f : of.node_families)
            for (const GroupIndex g : of.families.groups(f)) ++counts[g];
    };
    count(input_, before);
    count(mesh, after);
    for (GroupRecord& r : report.groups) {
        if (r.kind != GroupKind::node) continue;
        const auto g = mesh.find_group(r.name, GroupKind::node);
        if (!g) continue;
        r.count_before = before[*g];
        r.count_after = after[*g];
        if (r.count_after == 0 && r.count_before > 0 && r.status != "became empty") {
            r.status = "became empty";
            report.warnings.push_back(emptied_text(r));
        }
        if (r.status == "untouched" && r.count_after != r.count_before) r.status = "kept";
    }
}

/// Segments that were put aside, and those that came with taking nodes apart.
void WeldFirst::report_segments(const Mesh& mesh, const Unwelded& unwelded, Report& report) const {
    const auto count = [&](const Mesh& of, const CellRef& c, Index before, Index after) {
        const double length = cell_measure(of, c.type, c.cell);
        for (const GroupIndex g : of.families.groups(of.block(c.type).families[c.cell]))
            for (GroupRecord& r : report.groups)
                if (r.kind == GroupKind::element && r.name == of.groups[g].name) {
                    r.count_before += before;
                    r.count_after += after;
                    r.measure_after += static_cast<double>(after) * length;
                    r.dimension = std::max(r.dimension, 1);
                }
    };
    const auto& [made, removed] = unwelded.springs;
    for (const CellRef& c : welded_->aside) count(input_, c, 1, 1);
    for (const CellRef& c : removed) count(input_, c, 0, -1);
    for (const CellRef& c : made) count(mesh, c, 0, 1);
    if (!unwelded.segments.empty()) {
        const NumberIndex numbers(mesh);
        for (const Index id : unwelded.segments) count(mesh, *numbers.cell(id), 0, 1);
    }
    report.elements_added += static_cast<Index>(unwelded.segments.size() + made.size());
    report.elements_removed += static_cast<Index>(removed.size());
    if (!removed.empty())
        report.warnings.push_back(counted(static_cast<Index>(removed.size()), "segment element") +
                                  " (spring, gap) lost: between double nodes of which one is gone");
    if (!made.empty())
        report.warnings.push_back(counted(static_cast<Index>(made.size()), "new segment element") +
                                  " (spring, gap) between new double nodes of pairs that have such: each is like "
                                  "theirs. Where their stiffness stands for that of an area, give all a smaller one");
}

bool WeldFirst::finish(Result& result, bool strict) {
    const Stopwatch::Time started = Stopwatch::now();
    Mesh& mesh = result.mesh;
    Changes changes = in_one(stages_);
    const bool opened = !changes.copies.empty();
    Numbering next = next_numbers(marked());
    next.node = std::max(next.node, mesh.largest_node_id() + 1);
    next.cell = std::max(next.cell, mesh.largest_cell_id() + 1);
    const Unwelded unwelded = unweld(marked(), *welded_, mesh, changes, next);
    if (unwelded.joined > 0 || (opened && changes.copies.empty())) return false;
    std::vector<bool> gone(mesh.groups.size(), false);
    gone[welded_->faces] = gone[welded_->rim] = true;
    remove_groups(mesh, gone);
    rename_marks(mesh, other_prefix, mark_prefix);
    mesh.companion = input_.companion;
    if (mesh.companion) carry(mesh, changes, strict, result.report);
    remove_marks(mesh);
    if (outer_stages_) outer_stages_->push_back(changes);
    report_pairs(mesh, unwelded, static_cast<Index>(changes.copies.size()), result.report);
    result.stages = {std::move(changes)};
    auto& seconds = result.report.seconds;
    seconds.insert(seconds.begin(), {"weld", seconds_ + Stopwatch::since(started)});
    return true;
}

}  // namespace femscalpel
