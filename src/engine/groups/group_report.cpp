// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/group_report.h"

#include <cmath>

#include "cancel.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

void fit(FamilyTotals& totals, const Mesh& mesh) {
    if (totals.by_family.size() < static_cast<std::size_t>(mesh.families.size()))
        totals.by_family.resize(static_cast<std::size_t>(mesh.families.size()));
}

struct GroupTotals {
    Index count = 0;
    std::array<Index, 4> cells{};
    std::array<double, 4> measure{};
    double facet_area = 0;
};

std::vector<GroupTotals> by_group(const Mesh& mesh, const FamilyTotals& totals) {
    std::vector<GroupTotals> out(mesh.groups.size());
    const auto families =
        std::min<std::size_t>(totals.by_family.size(), static_cast<std::size_t>(mesh.families.size()));
    for (std::size_t f = 0; f < families; ++f) {
        const FamilyTotals::Entry& e = totals.by_family[f];
        for (GroupIndex g : mesh.families.groups(static_cast<FamilyIndex>(f))) {
            GroupTotals& t = out[g];
            switch (mesh.groups[g].kind) {
                case GroupKind::node:
                    t.count += e.nodes;
                    break;
                case GroupKind::facet:
                    t.count += e.facets;
                    t.facet_area += e.facet_area;
                    break;
                case GroupKind::element:
                    for (int d = 0; d < 4; ++d) {
                        t.count += e.cells[d];
                        t.cells[d] += e.cells[d];
                        t.measure[d] += e.measure[d];
                    }
            }
        }
    }
    return out;
}

}  // namespace

double facet_measure(const Mesh& mesh, const Facet& f) {
    const CellTraits& t = traits(f.type);
    const auto n = mesh.block(f.type).nodes(f.cell);
    const auto at = [&](int k) -> const Vec3& { return mesh.points[n[k]]; };
    if (t.dimension == 3) {
        const auto& face = t.faces[f.face - 1];
        double area = (at(face[1]) - at(face[0])).cross(at(face[2]) - at(face[0])).norm() / 2;
        if (face[3] >= 0) area += (at(face[2]) - at(face[0])).cross(at(face[3]) - at(face[0])).norm() / 2;
        return area;
    }
    if (f.face <= 2) return cell_measure(mesh, f.type, f.cell);
    const auto& edge = t.edges[f.face - 3];
    return (at(edge[1]) - at(edge[0])).norm();
}

FamilyTotals family_totals(const Mesh& mesh) {
    FamilyTotals totals;
    fit(totals, mesh);
    for (const CellBlock& b : mesh.blocks()) {
        const int d = traits(b.type).dimension;
        SparseCheck check;
        for (Index c = 0; c < b.size(); ++c, check()) {
            FamilyTotals::Entry& e = totals.by_family[b.families[c]];
            ++e.cells[d];
            if (b.families[c] != 0) e.measure[d] += cell_measure(mesh, b.type, c);
        }
    }
    recount_nodes_and_facets(totals, mesh);
    return totals;
}

void count_cells(FamilyTotals& totals, const Mesh& mesh, std::span<const CellRef> cells, int sign) {
    fit(totals, mesh);
    SparseCheck check;
    for (const CellRef& c : cells) {
        check();
        FamilyTotals::Entry& e = totals.by_family[mesh.block(c.type).families[c.cell]];
        const int d = traits(c.type).dimension;
        e.cells[d] += sign;
        e.measure[d] += sign * cell_measure(mesh, c.type, c.cell);
    }
}

void count_nodes_and_facets(FamilyTotals& totals, const Mesh& mesh, int sign) {
    fit(totals, mesh);
    check_cancelled();
    for (FamilyIndex f : mesh.node_families) totals.by_family[f].nodes += sign;
    for (const Facet& f : mesh.facets) {
        totals.by_family[f.family].facets += sign;
        totals.by_family[f.family].facet_area += sign * facet_measure(mesh, f);
    }
}

void recount_nodes_and_facets(FamilyTotals& totals, const Mesh& mesh) {
    for (FamilyTotals::Entry& e : totals.by_family) {
        e.nodes = e.facets = 0;
        e.facet_area = 0;
    }
    count_nodes_and_facets(totals, mesh, +1);
}

std::vector<GroupRecord> compare_groups(const Mesh& before, const FamilyTotals& totals_before, const Mesh& after,
                                        const FamilyTotals& totals_after) {
    const std::vector<GroupTotals> old = by_group(before, totals_before);
    const std::vector<GroupTotals> now = by_group(after, totals_after);
    std::vector<GroupRecord> records;
    for (std::size_t g = 0; g < after.groups.size(); ++g) {
        const Group& group = after.groups[g];
        if (group.hidden) continue;
        GroupRecord r;
        r.name = group.name;
        r.kind = group.kind;
        const bool is_new = g >= before.groups.size();
        const GroupTotals was = is_new ? GroupTotals{} : old[g];
        r.count_before = was.count;
        r.count_after = now[g].count;
        for (int d = 0; d < 4; ++d)
            if (was.cells[d] > 0 || now[g].cells[d] > 0) r.dimension = d;
        if (group.kind == GroupKind::facet) {
            r.dimension = 2;
            r.measure_before = was.facet_area;
            r.measure_after = now[g].facet_area;
        } else if (group.kind == GroupKind::element) {
            r.measure_before = was.measure[r.dimension];
            r.measure_after =
                now[g].cells[r.dimension] > 0 ? now[g].measure[r.dimension] : 0;  // without what rounding leaves
        }
        const bool same_measure = std::abs(r.measure_after - r.measure_before) <= 1e-9 * std::abs(r.measure_before);
        if (is_new)
            r.status = "new";
        else if (r.count_before > 0 && r.count_after == 0)
            r.status = "became empty";
        else
            r.status = same_measure ? "kept" : "changed";
        records.push_back(std::move(r));
    }
    return records;
}

}  // namespace femscalpel
