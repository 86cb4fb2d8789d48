// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/merging.h"

#include <cmath>
#include <iterator>

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
    if (target < 0) return -1;
    band_.merge_node(p, target);
    d_.contact[p] = {};
    return target;
}

}  // namespace femscalpel
