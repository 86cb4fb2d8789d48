// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/edit.h"

#include <algorithm>

#include "cancel.h"
#include "cutting/folded_input.h"
#include "deck/carry_over.h"
#include "deck/solver_input.h"
#include "deck/solver_sets.h"

namespace femscalpel {
namespace {

void add_front(const Opening& opening, const std::string& name, Rebuilt& rebuilt) {
    if (opening.front_nodes.empty() || name.empty()) return;
    Mesh& mesh = rebuilt.mesh;
    const GroupIndex group = mesh.add_group(name, GroupKind::node);
    for (const int v : opening.front_nodes) {
        FamilyIndex& family = mesh.node_families[rebuilt.node[v]];
        family = mesh.families.with(family, group);
    }
}

/// Adds mid-side nodes that segments or points end in, with the ends of their edges, which they follow: what hangs on
/// them has to stay with the material.
void add_attached_middles(const Mesh& mesh, std::vector<Index>& pinned) {
    std::vector<char> ends(mesh.points.size(), 0);
    bool any = false;
    for (const CellType type : {CellType::vertex, CellType::line, CellType::line3})
        for (Index c = 0; c < mesh.block(type).size(); ++c)
            for (const Index n : mesh.block(type).nodes(c).first(static_cast<std::size_t>(traits(type).corners)))
                ends[n] = 1, any = true;
    if (!any) return;
    const std::size_t before = pinned.size();
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.quadratic || t.dimension < 2) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (std::size_t e = 0; e < t.edges.size(); ++e)
                if (const Index middle = n[static_cast<std::size_t>(t.corners) + e]; ends[middle])
                    pinned.insert(pinned.end(), {middle, n[t.edges[e][0]], n[t.edges[e][1]]});
        }
    }
    if (pinned.size() == before) return;
    std::ranges::sort(pinned);
    pinned.erase(std::unique(pinned.begin(), pinned.end()), pinned.end());
}

}  // namespace

Edit::Edit(const Mesh& input, const Prepared& known) : input_(input), known_(known) {
    if (!known.marks) own_marks_ = mark_deck(input);
    marks_ = known.marks ? known.marks : &own_marks_;
    meaningless_ = groups_of(marks_->surface_sets, whole());
    numbering_ = next_numbers(whole());
}

void Edit::start_copy(bool whole_result) {
    const bool measures = known_.totals == nullptr;
    const auto policy = whole_result || measures ? std::launch::async : std::launch::deferred;
    copy_ = async_obeying(policy, [&mesh = whole(), whole_result, measures] {
        return std::pair(whole_result ? std::make_unique<Mesh>(mesh) : nullptr,
                         measures ? family_totals(mesh) : FamilyTotals());
    });
}

void Edit::keep_band(Location& location, std::vector<CellRef>& removed) {
    CellLists cells = elements_near(whole(), location.level, known_.adjacency);
    for (const CellRef& c : removed) cells[static_cast<int>(c.type)].push_back(c.cell);
    for (std::vector<Index>& list : cells) std::ranges::sort(list);
    for (CellRef& c : removed) {
        const std::vector<Index>& list = cells[static_cast<int>(c.type)];
        c.cell = std::ranges::lower_bound(list, c.cell) - list.begin();
    }
    part_ = crop(whole(), cells);
    Location part{.tolerance = location.tolerance, .rounding = location.rounding, .crossed = location.crossed};
    for (const Index n : part_->nodes) {
        if (std::ranges::binary_search(location.stops, n)) part.stops.push_back(std::ssize(part.level));
        part.distance.push_back(location.distance[n]);
        part.level.push_back(location.level[n]);
    }
    location = std::move(part);
}

/// Indices of nodes of the whole mesh (ascending) in mesh().
std::vector<Index> Edit::in_part(const std::vector<Index>& nodes) const {
    if (!part_) return nodes;
    std::vector<Index> out;
    for (std::size_t n = 0; n < part_->nodes.size(); ++n)
        if (std::ranges::binary_search(nodes, part_->nodes[n])) out.push_back(static_cast<Index>(n));
    return out;
}

ConstraintOptions Edit::constraints() const {
    ConstraintOptions out;
    out.meaningless = meaningless_;
    out.kept_hidden = marks_->kept;
    out.whole = families_of_whole_elements(mesh());
    out.pinned = in_part(marks_->pinned);
    add_attached_middles(mesh(), out.pinned);
    out.related = in_part(marks_->related);
    return out;
}

Edited Edit::finish(Workpiece& f, const Opening& opening, const Naming& naming, Stopwatch& watch) {
    put_back_middles(f, mesh());
    auto [output, totals] = await(copy_);
    if (part_) output = std::make_unique<Mesh>(mesh());
    check_cancelled();
    Edited out{rebuild(mesh(), std::move(*output), f, opening, naming.groups, numbering_, naming.front), {}, {}, {}};
    Rebuilt& rebuilt = out.rebuilt;
    if (opening.front_chains.empty()) add_front(opening, naming.front, rebuilt);
    if (!marks_->surface_sets.empty() && solver_input(input_))
        renew_surface_sets(rebuilt.mesh, marks_->surface_sets, *solver_input(input_), rebuilt.after);
    watch.lap("rebuild");
    if (input_.companion && !part_) {
        out.deck = carry_deck(mesh(), rebuilt.mesh, rebuilt.changes);
        watch.lap("carry deck");
    }
    out.before = known_.totals ? *known_.totals : totals;
    out.after = out.before;
    count_cells(out.after, mesh(), rebuilt.before, -1);
    count_cells(out.after, rebuilt.mesh, rebuilt.after, +1);
    if (part_) {
        count_nodes_and_facets(out.after, mesh(), -1);
        count_nodes_and_facets(out.after, rebuilt.mesh, +1);
    } else {
        recount_nodes_and_facets(out.after, rebuilt.mesh);
    }
    return out;
}

}  // namespace femscalpel
