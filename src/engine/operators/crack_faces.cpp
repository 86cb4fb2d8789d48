// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/crack_faces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "cancel.h"
#include "cutting/beams.h"
#include "cutting/locate.h"
#include "cutting/part_faces.h"
#include "deck/carry_over.h"
#include "deck/mark_deck.h"
#include "groups/group_report.h"
#include "groups/preserve.h"
#include "groups/unknown_group.h"
#include "mesh/crop.h"
#include "mesh/quality.h"
#include "mesh/rounding.h"
#include "mesh/stopwatch.h"
#include "operators/driver.h"
#include "operators/follow_fields.h"
#include "operators/weld_first.h"
#include "words.h"

namespace femscalpel {
namespace {

GroupIndex group_of_faces(const Mesh& mesh, const std::string& name) {
    for (const GroupKind kind : {GroupKind::element, GroupKind::facet, GroupKind::node})
        if (const auto group = mesh.find_group(name, kind)) return *group;
    throw ToolError(no_group_text(mesh, name), "tool");
}

/// Groups of which neither nodes nor elements changed.
void mark_untouched(const Mesh& before, const Parted& parted, Report& report) {
    std::set<GroupIndex> touched;
    const auto touch = [&](FamilyIndex family) {
        for (const GroupIndex g : before.families.groups(family)) touched.insert(g);
    };
    for (const Index n : parted.doubled) touch(before.node_families[n]);
    for (const CellRef& c : parted.changed) touch(before.block(c.type).families[c.cell]);
    for_each_record(before, report, [&](std::size_t g, GroupRecord& r) {
        if (r.count_before == r.count_after && !touched.contains(static_cast<GroupIndex>(g))) r.status = "untouched";
    });
}

std::vector<ElementQuality> qualities(const Mesh& mesh, const std::vector<CellRef>& cells) {
    std::vector<ElementQuality> out;
    for (const CellRef& c : cells)
        if (traits(c.type).dimension > 1)
            out.push_back({mesh.block(c.type).ids[c.cell], mean_ratio(mesh, c.type, c.cell)});
    return out;
}

Report report_of(const Mesh& before, const Parted& parted, const OperatorOptions& options, const FamilyTotals& totals) {
    FamilyTotals now = totals;
    for (const CellRef& c : parted.changed)  // an element on the crack joined a lip
        if (traits(c.type).dimension < before.dimension()) {
            count_cells(now, before, std::span(&c, 1), -1);
            count_cells(now, parted.mesh, std::span(&c, 1), +1);
        }
    count_cells(now, parted.mesh, parted.added, +1);
    recount_nodes_and_facets(now, parted.mesh);
    Report report;
    report.operation = "crack";
    report.name = options.name;
    report.method = "snap";
    report.groups = compare_groups(before, totals, parted.mesh, now);
    mark_untouched(before, parted, report);
    report.nodes_added = report.nodes_doubled = static_cast<Index>(parted.changes.copies.size());
    report.elements_added = static_cast<Index>(parted.added.size());
    report.quality_before = summarise(qualities(before, parted.changed));
    report.quality_after = summarise(qualities(parted.mesh, parted.changed));
    std::vector<Index>& nodes = report.node_sets["ICN"];
    for (const Index n : parted.doubled) nodes.push_back(before.node_ids[n]);
    std::ranges::sort(nodes);
    if (parted.closed > 0)
        report.warnings.push_back(std::to_string(parted.closed) +
                                  " of the faces have all nodes where the crack ends, and stay closed");
    if (parted.whole > 0)
        report.warnings.push_back(
            counted(parted.whole, "element that lies on the crack or ends on it stays",
                    "elements that lie on the crack or end on it stay") +
            " whole (beams, springs, points, shells across it), with the nodes of the negative side");
    return report;
}

bool passes_through(const Mesh& mesh, const std::vector<double>& distance, double rounding) {
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension < 2) continue;
        const auto corners = static_cast<std::size_t>(traits(b.type).corners);
        SparseCheck check;
        for (Index c = 0; c < b.size(); ++c) {
            check();
            bool before = false, behind = false;
            for (const Index n : b.nodes(c).first(corners)) {
                before = before || distance[n] > rounding;
                behind = behind || distance[n] < -rounding;
            }
            if (before && behind) return true;
        }
    }
    return false;
}

/// Whether shells of a mesh of solids end on the surface beside the solids: these have to be cut, too.
bool meets_shells(const Mesh& mesh, const std::vector<double>& distance, double rounding) {
    if (mesh.dimension() < 3) return false;
    std::vector<char> of_solids(mesh.points.size(), 0);
    for (const CellBlock& b : mesh.blocks())
        if (traits(b.type).dimension == 3)
            for (const Index n : b.connectivity) of_solids[n] = 1;
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension != 2) continue;
        const auto corners = static_cast<std::size_t>(traits(b.type).corners);
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c).first(corners);
            const bool lone = std::ranges::any_of(n, [&](Index v) { return !of_solids[v]; });
            if (lone && std::ranges::any_of(n, [&](Index v) { return std::abs(distance[v]) <= rounding; })) return true;
        }
    }
    return false;
}

/// What `part` makes of a mesh, as the result of an operator; nothing if that is nothing.
std::optional<Result> opened(
    const Mesh& mesh, const OperatorOptions& options, const Prepared& prepared,
    const std::function<std::optional<Parted>(const Mesh&, const PartedNames&, const Numbering&)>& part) {
    const Stopwatch::Time started = Stopwatch::now();
    Naming naming;
    naming.groups = {{options.name + "_N"}, {options.name + "_P"}};
    naming.front = options.name + "_FRONT";
    check_name(mesh, options.name, naming);
    DeckMarks own;
    if (!prepared.marks) own = mark_deck(mesh);
    const DeckMarks& marks = prepared.marks ? *prepared.marks : own;
    const Mesh& marked = marks.mesh ? *marks.mesh : mesh;
    std::optional<Parted> parted =
        part(marked, {naming.groups[0][0], naming.groups[1][0], naming.front}, next_numbers(mesh));
    if (!parted) return {};
    std::vector<CellRef> all = parted->changed;
    std::ranges::copy(parted->added, std::back_inserter(all));
    if (!marks.surface_sets.empty() && solver_input(mesh))
        renew_surface_sets(parted->mesh, marks.surface_sets, *solver_input(mesh), all);
    Remarks deck;
    if (!options.band_only) deck = carry_deck(marked, parted->mesh, parted->changes);
    Result result{{}, {}};
    result.report = report_of(marked, *parted, options, prepared.totals ? *prepared.totals : family_totals(marked));
    if (!options.band_only)
        std::ranges::move(warnings_of(deck, options.strict), std::back_inserter(result.report.warnings));
    result.mesh = options.band_only ? changed_part(marked, parted->mesh) : std::move(parted->mesh);
    remove_marks(result.mesh);
    result.stages.push_back(std::move(parted->changes));
    result.report.seconds = {{"part", Stopwatch::since(started)}};
    return result;
}

}  // namespace

Result crack_along_faces(const Mesh& mesh, const std::string& faces, const OperatorOptions& options,
                         const Prepared& prepared) {
    check_options(options);
    (void)drifting_groups(mesh, options.preserve);  // whose names may be unknown
    Result result =
        *opened(mesh, options, prepared, [&](const Mesh& marked, const PartedNames& names, const Numbering& numbering) {
            return part_along(marked, group_of_faces(marked, faces), names, numbering);
        });
    follow_fields(mesh, options.band_only, result);
    return result;
}

std::optional<Result> crack_between_elements(const Mesh& mesh, const Tool& tool, const OperatorOptions& options,
                                             const Prepared& prepared) {
    const auto is_other = [](const CellBlock& b) { return !traits(b.type).simplex && b.size() > 0; };
    if (tool.bounded() || options.refine.when == RefineFirst::When::to_size ||
        std::ranges::none_of(mesh.blocks(), is_other))
        return {};
    check_options(options);
    (void)drifting_groups(mesh, options.preserve);  // whose names may be unknown
    std::vector<double> distance(mesh.points.size());
    for (std::size_t n = 0; n < distance.size(); ++n) distance[n] = tool.distance(mesh.points[n]);
    const double rounding = reach_of_rounding(mesh).rounding;
    if (passes_through(mesh, distance, rounding) || meets_shells(mesh, distance, rounding)) return {};
    // Beams are cut, and double nodes, with springs and equations, followed the other way.
    const Blade blade{&tool, {}, {}, -1};
    if (!find_beam_cuts(mesh, std::span(&blade, 1)).empty()) return {};
    if (WeldFirst weld(mesh, prepared); weld && weld.is_near(std::span(&blade, 1))) return {};
    return opened(
        mesh, options, prepared,
        [&](const Mesh& marked, const PartedNames& names, const Numbering& numbering) -> std::optional<Parted> {
            std::optional<Parted> parted = part_along(marked, distance, rounding, names, numbering);
            if (parted && parted->bridges > 0) return {};
            return parted;
        });
}

}  // namespace femscalpel
