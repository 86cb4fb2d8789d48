// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/changed_quality.h"

#include <set>
#include <vector>

#include "cancel.h"
#include "mesh/quality.h"

namespace femscalpel {

void describe_changed(const Mesh& mesh, const Workpiece& f, const Rebuilt& rebuilt, Report& report) {
    std::set<Index> attached;  // triangles on tetrahedra: their shape is that of the tetrahedra
    for (std::size_t t = 0; t < f.d.band.triangle_cells.size(); ++t)
        if (const CellRef& c = f.d.band.triangle_cells[t]; !f.d.constraints.is_shell(static_cast<int>(t)))
            attached.insert(mesh.block(c.type).ids[c.cell]);
    for (const Changes::Part& part : rebuilt.changes.parts)
        if (attached.contains(part.parent)) attached.insert(part.element);
    const auto collect = [&](const Mesh& m, const std::vector<CellRef>& cells) {
        std::vector<ElementQuality> out;
        SparseCheck check;
        for (const CellRef& c : cells) {
            check();
            if (const Index id = m.block(c.type).ids[c.cell]; traits(c.type).dimension > 1 && !attached.contains(id))
                out.push_back({id, mean_ratio(m, c.type, c.cell)});
        }
        return out;
    };
    report.quality_before = summarise(collect(mesh, rebuilt.before));
    report.quality_after = summarise(collect(rebuilt.mesh, rebuilt.after));
}

}  // namespace femscalpel
