// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/trim.h"

#include <map>
#include <set>
#include <utility>

#include "mesh/union_find.h"

namespace femscalpel {
namespace {

using SeamEdge = std::pair<Index, Index>;

SeamEdge edge_of(Index a, Index b) { return std::minmax(a, b); }

/// The shell's triangles, and what they are joined by.
struct Pieces {
    std::vector<CellRef> cells;
    std::vector<std::array<Index, 3>> corners;
    std::map<SeamEdge, std::vector<int>> at_edge;
};

Pieces pieces_of(const Mesh& mesh) {
    Pieces out;
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).linear != CellType::triangle) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (std::size_t k = 0; k < 3; ++k)
                out.at_edge[edge_of(n[k], n[(k + 1) % 3])].push_back(static_cast<int>(out.cells.size()));
            out.cells.push_back({b.type, c});
            out.corners.push_back({n[0], n[1], n[2]});
        }
    }
    return out;
}

}  // namespace

Crop trimmed(const Mesh& addition, std::span<const JointLine> lines, const Vec3& point) {
    const Pieces all = pieces_of(addition);
    std::map<SeamEdge, const JointLine*> seam;
    for (const JointLine& line : lines)
        for (std::size_t k = 0; k + (line.closed ? 0 : 1) < line.stops.size(); ++k)
            seam[edge_of(line.stops[k].node[1], line.stops[(k + 1) % line.stops.size()].node[1])] = &line;
    UnionFind parts(all.cells.size());
    for (const auto& [edge, cells] : all.at_edge)
        if (!seam.contains(edge))
            for (const int c : cells) parts.unite(cells.front(), c);
    std::map<int, double> votes;  // of parts at a line: for the point's side less against
    for (const auto& [edge, line] : seam) {
        const auto found = all.at_edge.find(edge);
        if (found == all.at_edge.end()) continue;
        const Vec3 &a = addition.points[edge.first], &b = addition.points[edge.second];
        const Vec3 up = line->standing[0]->foot((a + b) / 2).standing;
        for (const int c : found->second) {
            Vec3 middle = Vec3::Zero();
            for (const Index n : all.corners[c]) middle += addition.points[n] / 3;
            const bool same = up.dot(middle - (a + b) / 2) * up.dot(point - (a + b) / 2) > 0;
            votes[parts.find(c)] += same ? (b - a).norm() : -(b - a).norm();
        }
    }
    CellLists kept;
    std::set<Index> nodes;
    for (std::size_t c = 0; c < all.cells.size(); ++c) {
        const auto vote = votes.find(parts.find(static_cast<int>(c)));
        if (vote != votes.end() && vote->second < 0) continue;
        kept[static_cast<int>(all.cells[c].type)].push_back(all.cells[c].cell);
        nodes.insert(all.corners[c].begin(), all.corners[c].end());
    }
    if (nodes.empty())
        throw ToolError("nothing of the addition is on that side of the mesh: give a point on the other", "keep_side");
    // What is no triangle goes with its corners.
    for (const CellBlock& b : addition.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.linear == CellType::triangle) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c).first(static_cast<std::size_t>(t.corners));
            if (std::ranges::all_of(n, [&](Index v) { return nodes.contains(v); }))
                kept[static_cast<int>(b.type)].push_back(c);
        }
    }
    return crop(addition, kept);
}

}  // namespace femscalpel
