// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/crack_faces.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "cutting/part_faces.h"
#include "deck/carry_over.h"
#include "deck/mark_deck.h"
#include "groups/group_report.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"
#include "operators/driver.h"

namespace femscalpel {
namespace {

GroupIndex group_of_faces(const Mesh& mesh, const std::string& name) {
    for (const GroupKind kind : {GroupKind::element, GroupKind::facet, GroupKind::node})
        if (const auto group = mesh.find_group(name, kind)) return *group;
    throw ToolError("the mesh has no group '" + name + "'", "tool");
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
        report.warnings.push_back(std::to_string(parted.whole) +
                                  " element(s) that lie on the crack or end on it (beams, springs, points, shells "
                                  "across it) stay whole, with the nodes of the negative side");
    return report;
}

}  // namespace

Result crack_along_faces(const Mesh& mesh, const std::string& faces, const OperatorOptions& options,
                         const Prepared& prepared) {
    const Stopwatch::Time started = Stopwatch::now();
    Naming naming;
    naming.groups = {{options.name + "_N"}, {options.name + "_P"}};
    naming.front = options.name + "_FRONT";
    check_name(mesh, options.name, naming);
    DeckMarks own;
    if (!prepared.marks) own = mark_deck(mesh);
    const DeckMarks& marks = prepared.marks ? *prepared.marks : own;
    const Mesh& marked = marks.mesh ? *marks.mesh : mesh;
    Parted parted = part_along(marked, group_of_faces(marked, faces),
                               {naming.groups[0][0], naming.groups[1][0], naming.front}, next_numbers(mesh));
    std::vector<CellRef> all = parted.changed;
    std::ranges::copy(parted.added, std::back_inserter(all));
    if (!marks.surface_sets.empty() && solver_input(mesh))
        renew_surface_sets(parted.mesh, marks.surface_sets, *solver_input(mesh), all);
    Result result{{}, {}};
    const Remarks deck = carry_deck(marked, parted.mesh, parted.changes);
    result.report = report_of(marked, parted, options, prepared.totals ? *prepared.totals : family_totals(marked));
    std::ranges::move(warnings_of(deck, options.strict), std::back_inserter(result.report.warnings));
    result.mesh = std::move(parted.mesh);
    remove_marks(result.mesh);
    result.report.seconds = {{"part", Stopwatch::since(started)}};
    return result;
}

}  // namespace femscalpel
