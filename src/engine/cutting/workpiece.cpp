// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/workpiece.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "deformation/deformation.h"
#include "deformation/relaxation.h"

namespace femscalpel {

void find_node_sets(Workpiece& f) {
    const BandMesh& band = f.d.band;
    std::vector<int> depth(static_cast<std::size_t>(band.size()), -1);
    f.nodes.clear();
    f.transition.clear();
    for (int v = 0; v < band.size(); ++v)
        if (f.d.contact[v]) {
            depth[v] = 0;
            f.nodes.push_back(v);
        }
    std::vector<int> front = f.nodes, next, neighbours;
    for (int level = 1; level <= f.bandwidth; ++level) {
        next.clear();
        for (const int v : front) {
            const auto visit = [&](const auto& list) {
                for (const int s : list.around(v))
                    for (const int w : list[s])
                        if (depth[w] < 0 && band.nodes[w].movable()) {
                            depth[w] = level;
                            next.push_back(w);
                        }
            };
            visit(band.tetras);
            visit(band.triangles);
        }
        f.transition.insert(f.transition.end(), next.begin(), next.end());
        front.swap(next);
    }
    std::ranges::sort(f.transition);
}

std::vector<int> movable_nodes(const Workpiece& f) {
    std::vector<int> out = f.nodes;
    out.insert(out.end(), f.transition.begin(), f.transition.end());
    for (const int v : f.released)
        if (f.d.band.in_use(v) && !f.d.contact[v]) out.push_back(v);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

void relax_near(Workpiece& f, const std::vector<int>& changed, bool only_there) {
    find_node_sets(f);
    const std::vector<int> movable = movable_nodes(f), all_near = f.d.band.nodes_near(changed, 2);
    std::vector<int> near;
    std::ranges::set_intersection(movable, all_near, std::back_inserter(near));
    relax_from(f.d, near, only_there ? near : movable);
}

int Workpiece::split_edge(int a, int b, const Vec3& at, const Contact& tools) {
    const int node = d.split_edge(a, b, at, tools);
    const double off = tools.has(tool) ? 0 : tool->distance(at);
    distance.push_back(std::abs(off) <= tolerance ? 0 : off);
    return node;
}

void split_at_fixed_middles(Workpiece& f, const Blade& blade, const Mesh& mesh) {
    BandMesh& band = f.d.band;
    if (!f.d.constraints.has_fixed_middles()) return;
    std::map<Index, int> hung_on;  // nodes that segments and points end in, by node of the mesh
    for (int v = 0; v < band.original_nodes(); ++v)
        if (!band.lines.around(v).empty() || !band.vertices.around(v).empty()) hung_on[band.nodes[v].global] = v;
    std::vector<std::pair<std::array<int, 2>, Index>> crossed;
    for (const auto& [key, middle] : band.mid_nodes) {
        const std::array<int, 2> e{static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)};
        if (!f.d.constraints.has_fixed_middle(e[0], e[1])) continue;
        const int beam = band.lines.find(e);
        if (beam >= 0 && f.d.constraints.is_beam(band.lines.origin(beam))) continue;  // which was divided before
        const Vec3 &a = band.nodes[e[0]].at, &b = band.nodes[e[1]].at;
        const double at_a = blade.tool->distance(a), at_b = blade.tool->distance(b);
        const bool along = std::max(std::abs(at_a), std::abs(at_b)) <= f.tolerance;
        if (along ? !hung_on.contains(middle)
                  : std::min(at_a, at_b) >= -f.tolerance || std::max(at_a, at_b) <= f.tolerance)
            continue;
        if (!blade.bound || blade.bound(mesh.points[middle]) <= blade_margin * (a - b).norm())
            crossed.push_back({e, middle});
    }
    std::ranges::sort(crossed);
    for (const auto& [e, middle] : crossed) {
        const bool on_tool = std::abs(f.tool->distance(mesh.points[middle])) <= f.tolerance;
        const int node = f.split_edge(e[0], e[1], mesh.points[middle],
                                      on_tool && !blade.bound && blade.tool == f.tool ? f.tool : nullptr);
        const auto hung = hung_on.find(middle);
        if (hung == hung_on.end()) continue;
        band.lines.merge(hung->second, node);
        band.vertices.merge(hung->second, node);
        std::ranges::replace(f.beam_nodes, hung->second, node);
        std::ranges::sort(f.beam_nodes);
    }
}

}  // namespace femscalpel
