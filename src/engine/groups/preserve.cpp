// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/preserve.h"

#include <algorithm>
#include <map>
#include <set>

#include "groups/band_boundaries.h"
#include "groups/unknown_group.h"
#include "mesh/closest_point.h"

namespace femscalpel {

std::vector<bool> drifting_groups(const Mesh& mesh, const std::optional<std::vector<std::string>>& preserve) {
    if (!preserve) return {};
    for (const std::string& name : *preserve)
        if (!mesh.find_group(name))
            throw ToolError("preserve names '" + name + "', but " + no_group_text(mesh, name), "preserve");
    std::vector<bool> drifting;
    drifting.reserve(mesh.groups.size());
    for (const Group& g : mesh.groups)
        drifting.push_back(!g.hidden && std::ranges::find(*preserve, g.name) == preserve->end());
    return drifting;
}

namespace {

std::vector<bool> opposite(std::vector<bool> flags) {
    flags.flip();
    return flags;
}

}  // namespace

DriftGauge::DriftGauge(const BandMesh& band, const Mesh& mesh, std::vector<bool> drifting)
    : DriftGauge(band, mesh, opposite(std::move(drifting)), {}, false) {}

DriftGauge DriftGauge::of_shortcuts(const BandMesh& band, const Mesh& mesh, const std::vector<bool>& drifting,
                                    std::vector<Index> on_shortcuts) {
    std::vector<bool> ignored;
    for (std::size_t g = 0; g < mesh.groups.size(); ++g)
        ignored.push_back(mesh.groups[g].hidden || (!drifting.empty() && drifting[g]));
    return {band, mesh, std::move(ignored), std::move(on_shortcuts), true};
}

DriftGauge::DriftGauge(const BandMesh& band, const Mesh& mesh, std::vector<bool> ignored,
                       std::vector<Index> on_shortcuts, bool only_shortcuts)
    : ignored_(std::move(ignored)),
      on_shortcuts_(std::move(on_shortcuts)),
      only_shortcuts_(only_shortcuts),
      around_(static_cast<std::size_t>(band.size())) {
    for (const BandNode& n : band.nodes) old_at_.push_back(n.at);
    old_ = pieces(band, mesh, kinds_);
    for (std::size_t p = 0; p < old_.size(); ++p)
        for (const int v : old_[p].nodes)
            if (around_[v].empty() || around_[v].back() != static_cast<int>(p))
                around_[v].push_back(static_cast<int>(p));
}

std::vector<DriftGauge::Piece> DriftGauge::pieces(const BandMesh& band, const Mesh& mesh, FamilyTable& kinds) const {
    const BandBoundaries boundaries(band, mesh, ignored_, on_shortcuts_);
    kinds = boundaries.kinds();
    std::vector<Piece> out;
    std::map<std::array<int, 2>, std::vector<int>> faces_at;  // kinds of the faces at each edge
    for (const auto& f : boundaries.faces()) {
        if (f.kind == 0) continue;
        if (!f.is_shell()) out.push_back({f.nodes, f.kind, false, f.is_internal() && !f.element});
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
        if (l.kind != 0) out.push_back({{l.nodes[0], l.nodes[1], l.nodes[1]}, l.kind, false, !l.element});
    for (const auto& s : boundaries.shortcuts()) out.push_back({s.nodes, s.kind, true, true});
    return out;
}

void DriftGauge::measure(const Vec3& x, std::span<const int> ancestors, const std::set<GroupIndex>& groups,
                         bool (*counts)(const Piece&), std::vector<double>& drift) const {
    // Pieces at the nodes it comes from, and one further.
    std::set<int> near;
    for (const int a : ancestors)
        for (const int p : around_[a])
            for (const int w : old_[p].nodes) near.insert(around_[w].begin(), around_[w].end());
    std::vector<std::pair<double, int>> by_distance;
    for (const int p : near) {
        if (!counts(old_[p])) continue;
        const auto& [a, b, c] = old_[p].nodes;
        Vec3 shares;
        const Vec3 foot = old_[p].is_edge() ? closest_on_segment(old_at_[a], old_at_[b], x)
                                            : closest_on_triangle(old_at_[a], old_at_[b], old_at_[c], x, shares);
        by_distance.push_back({(foot - x).norm(), p});
    }
    std::ranges::sort(by_distance);
    for (const GroupIndex g : groups) {
        const auto first =
            std::ranges::find_if(by_distance, [&](const auto& d) { return kinds_.contains(old_[d.second].kind, g); });
        if (first != by_distance.end()) drift[g] = std::max(drift[g], first->first);
    }
}

std::vector<double> DriftGauge::drift(const BandMesh& now, const Mesh& mesh) const {
    std::vector<double> out(mesh.groups.size(), 0);
    FamilyTable kinds;
    std::vector<std::array<std::set<GroupIndex>, 2>> groups_at(
        static_cast<std::size_t>(now.size()));  // on faces, edges
    const auto changed = [&](int v) { return now.is_new(v) || now.nodes[v].at != now.nodes[v].start; };
    std::vector<int> ancestors;
    const auto gather = [&](auto&& self, int v) -> void {
        if (!now.is_new(v)) return ancestors.push_back(v);
        self(self, now.births[v - now.original_nodes()].a);
        self(self, now.births[v - now.original_nodes()].b);
    };
    for (const Piece& p : pieces(now, mesh, kinds)) {
        const auto kind = kinds.groups(p.kind);
        const std::set<GroupIndex> groups(kind.begin(), kind.end());
        if (only_shortcuts_ ? !p.through : !p.shortcut) {
            for (const int v : p.nodes)
                if (!only_shortcuts_ && changed(v)) groups_at[v][p.is_edge()].insert(groups.begin(), groups.end());
            continue;
        }
        if (std::ranges::none_of(p.nodes, changed)) continue;
        ancestors.clear();
        for (const int v : p.nodes) gather(gather, v);
        const auto at = [&](int k) -> const Vec3& { return now.nodes[p.nodes[k]].at; };
        for (const Vec3& x :
             {at(0), at(1), at(2), p.is_edge() ? Vec3((at(0) + at(1)) / 2) : Vec3((at(0) + at(1) + at(2)) / 3)})
            measure(
                x, ancestors, groups, [](const Piece&) { return true; }, out);
    }
    for (int v = 0; v < now.size(); ++v)
        for (int edge = 0; edge < 2; ++edge) {
            if (groups_at[v][edge].empty()) continue;
            ancestors.clear();
            gather(gather, v);
            measure(
                now.nodes[v].at, ancestors, groups_at[v][edge],
                edge ? [](const Piece& p) { return p.is_edge(); } : [](const Piece& p) { return !p.is_edge(); }, out);
        }
    return out;
}

}  // namespace femscalpel
