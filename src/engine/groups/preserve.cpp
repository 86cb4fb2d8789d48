// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/preserve.h"

#include <algorithm>
#include <map>
#include <set>

#include "groups/band_boundaries.h"
#include "mesh/closest_point.h"

namespace femscalpel {

std::vector<bool> drifting_groups(const Mesh& mesh, const std::optional<std::vector<std::string>>& preserve) {
    if (!preserve) return {};
    for (const std::string& name : *preserve)
        if (!mesh.find_group(name))
            throw ToolError("preserve names '" + name + "', but the mesh has no group of that name");
    std::vector<bool> drifting;
    for (const Group& g : mesh.groups) drifting.push_back(!g.hidden && std::ranges::find(*preserve, g.name) == preserve->end());
    return drifting;
}

DriftGauge::DriftGauge(const BandMesh& band, const Mesh& mesh, std::vector<bool> drifting)
    : kept_(std::move(drifting)), around_(static_cast<std::size_t>(band.size())) {
    kept_.flip();
    for (const BandNode& n : band.nodes) old_at_.push_back(n.at);
    old_ = pieces(band, mesh, kinds_);
    for (std::size_t p = 0; p < old_.size(); ++p)
        for (const int v : old_[p].nodes)
            if (around_[v].empty() || around_[v].back() != static_cast<int>(p)) around_[v].push_back(static_cast<int>(p));
}

std::vector<DriftGauge::Piece> DriftGauge::pieces(const BandMesh& band, const Mesh& mesh, FamilyTable& kinds) const {
    const BandBoundaries boundaries(band, mesh, kept_);
    kinds = boundaries.kinds();
    std::vector<Piece> out;
    std::map<std::array<int, 2>, std::vector<int>> faces_at;  // kinds of the faces at each edge
    for (const auto& f : boundaries.faces()) {
        if (f.kind == 0) continue;
        if (!f.is_shell()) out.push_back({f.nodes, f.kind});
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(f.nodes[k], f.nodes[(k + 1) % 3]);
            faces_at[{a, b}].push_back(f.kind);
        }
    }
    for (const auto& [edge, meeting] : faces_at) {
        // A rim is where a group has just one face.
        std::map<GroupIndex, int> count;
        for (const int kind : meeting)
            for (const GroupIndex g : kinds.groups(kind)) ++count[g];
        std::vector<GroupIndex> once;
        for (const auto& [g, n] : count)
            if (n == 1) once.push_back(g);
        if (!once.empty()) out.push_back({{edge[0], edge[1], edge[1]}, kinds.intern(once)});
    }
    for (const auto& l : boundaries.lines())
        if (l.kind != 0) out.push_back({{l.nodes[0], l.nodes[1], l.nodes[1]}, l.kind});
    return out;
}

std::vector<double> DriftGauge::drift(const BandMesh& now, const Mesh& mesh) const {
    std::vector<double> out(mesh.groups.size(), 0);
    FamilyTable kinds;
    std::vector<std::array<std::set<GroupIndex>, 2>> groups_at(static_cast<std::size_t>(now.size()));  // on faces, edges
    for (const Piece& p : pieces(now, mesh, kinds))
        for (const int v : p.nodes)
            if (now.is_new(v) || now.nodes[v].at != now.nodes[v].start)
                groups_at[v][p.is_edge()].insert(kinds.groups(p.kind).begin(), kinds.groups(p.kind).end());
    std::vector<int> ancestors;
    const auto gather = [&](auto&& self, int v) -> void {
        if (!now.is_new(v)) return ancestors.push_back(v);
        self(self, now.births[v - now.original_nodes()].a);
        self(self, now.births[v - now.original_nodes()].b);
    };
    for (int v = 0; v < now.size(); ++v) {
        if (groups_at[v][0].empty() && groups_at[v][1].empty()) continue;
        ancestors.clear();
        gather(gather, v);
        // Pieces at the node it was, or at the ends of its edge, and one further.
        std::set<int> near;
        for (const int a : ancestors)
            for (const int p : around_[a])
                for (const int w : old_[p].nodes) near.insert(around_[w].begin(), around_[w].end());
        std::array<std::vector<std::pair<double, int>>, 2> by_distance;
        for (const int p : near) {
            const auto& [a, b, c] = old_[p].nodes;
            const Vec3& x = now.nodes[v].at;
            Vec3 shares;
            const Vec3 foot = old_[p].is_edge() ? closest_on_segment(old_at_[a], old_at_[b], x)
                                                : closest_on_triangle(old_at_[a], old_at_[b], old_at_[c], x, shares);
            by_distance[old_[p].is_edge()].push_back({(foot - x).norm(), p});
        }
        for (int edge = 0; edge < 2; ++edge) {
            std::ranges::sort(by_distance[edge]);
            for (const GroupIndex g : groups_at[v][edge]) {
                const auto first =
                    std::ranges::find_if(by_distance[edge], [&](const auto& d) { return kinds_.contains(old_[d.second].kind, g); });
                if (first != by_distance[edge].end()) out[g] = std::max(out[g], first->first);
            }
        }
    }
    return out;
}

}  // namespace femscalpel
