// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/changed_quality.h"

#include <algorithm>
#include <set>
#include <utility>

#include "cancel.h"
#include "mesh/quality.h"

namespace femscalpel {

namespace {

/// The shapes of elements of two and three dimensions for which `counts` is true.
std::vector<ElementQuality> qualities_of(const Mesh& mesh, const std::vector<CellRef>& cells, auto counts) {
    std::vector<ElementQuality> out;
    SparseCheck check;
    for (const CellRef& c : cells) {
        check();
        if (traits(c.type).dimension > 1 && counts(c))
            out.push_back({mesh.block(c.type).ids[c.cell], mean_ratio(mesh, c.type, c.cell)});
    }
    return out;
}

}  // namespace

ChangedQuality changed_quality(const Mesh& mesh, const Workpiece& f, const Rebuilt& rebuilt) {
    std::set<Index> attached;  // triangles on tetrahedra
    for (std::size_t t = 0; t < f.d.band.triangle_cells.size(); ++t)
        if (const CellRef& c = f.d.band.triangle_cells[t]; !f.d.constraints.is_shell(static_cast<int>(t)))
            attached.insert(mesh.block(c.type).ids[c.cell]);
    for (const Changes::Part& part : rebuilt.changes.parts)
        if (attached.contains(part.parent)) attached.insert(part.element);
    const auto collect = [&](const Mesh& m, const std::vector<CellRef>& cells) {
        return qualities_of(m, cells,
                            [&](const CellRef& c) { return !attached.contains(m.block(c.type).ids[c.cell]); });
    };
    return {collect(mesh, rebuilt.before), collect(rebuilt.mesh, rebuilt.after)};
}

ChangedQuality changed_quality(const Mesh& mesh, const std::vector<CellRef>& before, const Mesh& result,
                               const std::vector<CellRef>& after) {
    const auto collect = [](const Mesh& m, const std::vector<CellRef>& cells) {
        std::vector<char> in_solid(m.points.size(), 0);
        for (const CellBlock& b : m.blocks())
            if (traits(b.type).dimension == 3)
                for (const Index n : b.connectivity) in_solid[n] = 1;
        return qualities_of(m, cells, [&](const CellRef& c) {
            const auto n = m.block(c.type).nodes(c.cell);
            return traits(c.type).dimension == 3 || std::ranges::any_of(n, [&](Index v) { return in_solid[v] == 0; });
        });
    };
    return {collect(mesh, before), collect(result, after)};
}

void describe_changed(const Mesh& mesh, const Workpiece& f, const Rebuilt& rebuilt, Report& report) {
    ChangedQuality quality = changed_quality(mesh, f, rebuilt);
    report.quality_before = summarise(std::move(quality.before));
    report.quality_after = summarise(std::move(quality.after));
}

}  // namespace femscalpel
