// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/merging.h"

#include <cmath>
#include <iterator>
#include <tuple>

#include "cancel.h"
#include "deformation/curved_shape.h"
#include "mesh/quality.h"

namespace femscalpel {

/// Whether moving p onto t keeps everything p stands for.
bool NodeMerger::may_merge(int p, int t) {
    // Where tools cross, nodes stay; on one tool the edge p-t must run in it.
    if (d_.contact[p].count() > 1 || !d_.contact[t].includes(d_.contact[p])) return false;
    if (!band_.cut_faces.around(p).empty() && !in_one(band_.cut_faces, p, t)) return false;
    if (!band_.cut_edges.around(p).empty() && !in_one(band_.cut_edges, p, t)) return false;
    const NodeConstraint& c = d_.constraints[p];
    if (d_.constraints.is_related(p) && !band_.skin.around(p).empty()) return false;
    // On a surface or crease the edge p-t itself must run in it.
    if (!band_.creases.around(p).empty()) {
        if (c.freedom != NodeFreedom::curve || !in_one(band_.creases, p, t)) return false;
    } else if (!band_.skin.around(p).empty() && !in_one(band_.skin, p, t)) {
        return false;
    }
    if (!band_.lines.around(p).empty() && !in_one(band_.lines, p, t)) return false;
    if (f_.patched && closes(p, t)) return false;
    return !d_.membership.merge_links(band_, p, t);
}

/// Whether, with p moved onto t, all nodes of a face or edge of a bounded crack would be on its front: it could not
/// open.
bool NodeMerger::closes(int p, int t) const {
    const auto on_front = [&](int v) { return d_.contact[v].count() > 1; };
    if (!on_front(t)) return false;
    const auto any_closed = [&](const auto& list) {
        return std::ranges::any_of(list.around(p), [&](int s) {
            const auto& nodes = list[s];
            return std::ranges::find(nodes, t) == nodes.end() &&
                   std::ranges::all_of(nodes, [&](int v) { return v == p || on_front(v); });
        });
    };
    // So would the crack's mouth, were its only node between two of the front to go.
    for (const int s : band_.cut_faces.around(p))
        for (const int w : band_.cut_faces[s])
            if (w != p && w != t && on_front(w) && band_.is_cut_border(p, w) &&
                d_.constraints.is_skin_edge(band_, p, w))
                return true;
    return any_closed(band_.cut_faces) || any_closed(band_.cut_edges);
}

/// Link condition: every node next to both p and t forms a triangle (tetrahedron face) with them.
bool NodeMerger::link_is_sound(int p, int t) {
    band_.neighbours(p, near_p_);
    band_.neighbours(t, near_t_);
    common_.clear();
    std::ranges::set_intersection(near_p_, near_t_, std::back_inserter(common_));
    for (const int w : common_) {
        const auto holds = [&](const auto& list) {
            return std::ranges::any_of(list.around(p), [&](int s) {
                return std::ranges::find(list[s], t) != list[s].end() && std::ranges::find(list[s], w) != list[s].end();
            });
        };
        if (!holds(band_.tetras) && !holds(band_.triangles)) return false;
    }
    // The same on surfaces and creases, whose own links are smaller.
    for (const int w : common_) {
        const auto on_surface = [&](int a, int b) { return in_one(band_.skin, a, b) || in_one(band_.cut_faces, a, b); };
        if (on_surface(p, w) && on_surface(t, w) && on_surface(p, t) && band_.skin.find({p, t, w}) < 0 &&
            band_.cut_faces.find({p, t, w}) < 0)
            return false;
        if (in_one(band_.creases, p, w) && in_one(band_.creases, t, w)) return false;
        if (in_one(band_.cut_edges, p, w) && in_one(band_.cut_edges, t, w)) return false;
    }
    return true;
}

double NodeMerger::quality_merged(int p, int t) const {
    const Vec3& at = band_.nodes[t].at;
    double worst = 1;
    const auto point = [&](int v) -> const Vec3& { return v == p ? at : band_.nodes[v].at; };
    for (const int s : band_.tetras.around(p)) {
        const auto& v = band_.tetras[s];
        if (std::ranges::find(v, t) == v.end())
            worst = std::min(worst, mean_ratio(point(v[0]), point(v[1]), point(v[2]), point(v[3])));
    }
    for (const int s : band_.triangles.around(p)) {
        const auto& v = band_.triangles[s];
        if (std::ranges::find(v, t) != v.end() || !d_.constraints.is_shell(band_.triangles.origin(s))) continue;
        const double turned = (point(v[1]) - point(v[0]))
                                  .cross(point(v[2]) - point(v[0]))
                                  .dot(d_.shell_normals[band_.triangles.origin(s)]);
        worst = std::min(worst, std::copysign(mean_ratio(point(v[0]), point(v[1]), point(v[2])), turned));
    }
    return worst;
}

/// Mid-side nodes of the input that have no edge once p is gone: the one it was, and those that edges of it were given.
std::vector<Index> NodeMerger::homeless_middles(int p) const {
    std::vector<Index> out;
    if (band_.mid_nodes.empty()) return out;
    if (band_.is_new(p) && band_.nodes[p].global >= 0) out.push_back(band_.nodes[p].global);
    for (const int x : candidates_)
        if (const auto mid = band_.mid_nodes.find(edge_key(p, x));
            mid != band_.mid_nodes.end() && band_.is_handed_over(p, x))
            out.push_back(mid->second);
    return out;
}

/// Edges of second-order elements around t that have a node born here and no mid-side node of the input, once p is
/// there; those at t first.
std::vector<std::array<int, 2>> NodeMerger::free_edges(int p, int t) const {
    std::vector<std::array<int, 2>> out;
    const auto look = [&](BandElement element) {
        const auto nodes = element.nodes(band_);
        const auto has = [&](int v) { return std::ranges::find(nodes, v) != nodes.end(); };
        if (has(p) && has(t)) return;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const auto [a, b] = std::minmax(nodes[i] == p ? t : nodes[i], nodes[j] == p ? t : nodes[j]);
                if (!band_.is_handed_over(a, b)) continue;
                const auto mid = band_.mid_nodes.find(edge_key(a, b));
                if (mid == band_.mid_nodes.end()) out.push_back({a, b});
            }
    };
    for_second_order_around(d_, p, look);
    for_second_order_around(d_, t, look);
    std::ranges::sort(out, {},
                      [t](const std::array<int, 2>& e) { return std::tuple(e[0] != t && e[1] != t, e[0], e[1]); });
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// Whether there is an edge for each mid-side node that would have none were p moved onto t.
bool NodeMerger::find_homes(int p, int t) {
    homes_.clear();
    const std::vector<Index> homeless = homeless_middles(p);
    if (homeless.empty()) return true;
    if (band_.is_new(p) && band_.nodes[p].global >= 0) {
        const auto& [a, b] = band_.births[p - band_.original_nodes()];
        if (d_.constraints.has_fixed_middle(a, b)) return false;
    }
    std::vector<std::array<int, 2>> edges = free_edges(p, t);
    for (const Index middle : homeless) {
        const auto home =
            std::ranges::find_if(edges, [&](const auto& e) { return d_.membership.may_hand_over(middle, e[0], e[1]); });
        if (home == edges.end()) return false;
        homes_.push_back({edge_key((*home)[0], (*home)[1]), middle});
        edges.erase(home);
    }
    return true;
}

void NodeMerger::hand_over(int p) {
    if (homes_.empty()) return;
    for (const int x : candidates_)
        if (band_.is_handed_over(p, x)) band_.mid_nodes.erase(edge_key(p, x));
    if (band_.is_new(p)) band_.nodes[p].global = -1;
    for (const auto& [edge, middle] : homes_) band_.mid_nodes.emplace(edge, middle);
}

int NodeMerger::merge(int p) {
    check_cancelled();
    if (band_.tetras.around(p).empty() && band_.triangles.around(p).empty()) return -1;
    band_.neighbours(p, candidates_);
    double best = quality_around(d_, p, band_.nodes[p].at) + 1e-3;
    int target = -1;
    for (const int t : candidates_) {
        if (!may_merge(p, t)) continue;
        const double q = quality_merged(p, t);
        if (q > best && link_is_sound(p, t) && curved_merged(d_, p, t) >= curved_limit) {
            best = q;
            target = t;
        }
    }
    if (target < 0 || !find_homes(p, target)) return -1;
    hand_over(p);
    band_.merge_node(p, target);
    d_.contact[p] = {};
    return target;
}

}  // namespace femscalpel
