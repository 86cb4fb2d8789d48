// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/simplify_at_meeting.h"

#include <utility>
#include <vector>

#include "cutting/locate.h"
#include "mesh/near_boxes.h"
#include "mesh/outer_faces.h"
#include "mesh/stopwatch.h"
#include "operators/simplify_first.h"

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;

/// What is nearer to a line than this, in its own size, may be given new nodes for it.
constexpr double near_line = 0.25;
/// What is nearer to a solid than this, in the diagonal of that's elements, may have to give way: as far as that of
/// cutting/refill.cpp at least.
constexpr double room = 0.5;
/// Rings around lines that may be relaxed, unless the option `transition` says it.
constexpr int usual_rings = 2;

Box box_of(const Mesh& mesh, const CellBlock& block, Index cell) {
    Box out;
    for (const Index n : block.nodes(cell)) out.extend(mesh.points[n]);
    return out;
}

BoxTree tree_of(std::span<const MeetingLine> lines) {
    std::vector<Box> boxes;
    for (const MeetingLine& line : lines) {
        const std::size_t n = line.points.size();
        for (std::size_t k = 0; k + (line.closed ? 0 : 1) < n; ++k) {
            Box& box = boxes.emplace_back(line.points[k].at);
            box.extend(line.points[(k + 1) % n].at);
        }
    }
    return BoxTree(std::move(boxes));
}

BoxTree tree_of_solids(const Mesh& mesh, const Box& there) {
    std::vector<Box> boxes;
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension != 3) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const Box own = box_of(mesh, b, c);
            if (Box wide = grown(own, room * own.diagonal().norm()); wide.intersects(there))
                boxes.push_back(std::move(wide));
        }
    }
    return BoxTree(std::move(boxes));
}

}  // namespace

std::optional<Refined> simplify_at_meeting(const Mesh& mesh, const Mesh& other, std::span<const MeetingLine> lines,
                                           bool gives_way, const OperatorOptions& options, const Prepared& known) {
    if (has_simplices_alone(mesh)) return {};
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    const auto mark = [&](const CellBlock& block, Index cell) {
        for (const Index n : block.nodes(cell)) level[n] = 0;
    };
    SparseCheck check(1 << 10);
    const BoxTree at_lines = tree_of(lines);
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension < 2) continue;
        for (Index c = 0; c < b.size(); ++c, check()) {
            const Box own = box_of(mesh, b, c);
            if (at_lines.meets(grown(own, near_line * own.diagonal().norm()))) mark(b, c);
        }
    }
    spread_levels(mesh, level, options.transition.value_or(usual_rings), known.adjacency);
    if (mesh.dimension() == 3 && other.dimension() == 3) {
        const Box there = box_around(mesh);
        const BoxTree near = tree_of_solids(other, there);
        const auto mark_near = [&](const CellBlock& b, Index c) {
            if (near.meets(box_of(mesh, b, c))) mark(b, c);
        };
        if (!gives_way) {
            for (const Facet& f : outer_faces(mesh, box_around(other)).owners) mark_near(mesh.block(f.type), f.cell);
        } else {
            for (const CellBlock& b : mesh.blocks())
                if (traits(b.type).dimension == 3)
                    for (Index c = 0; c < b.size(); ++c, check()) mark_near(b, c);
        }
    }
    return simplify_first(mesh, level, known);
}

}  // namespace femscalpel
