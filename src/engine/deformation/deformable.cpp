// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/deformable.h"

#include <algorithm>
#include <cmath>

#include "cancel.h"
#include "deformation/curved_shape.h"
#include "deformation/star.h"
#include "mesh/quality.h"

namespace femscalpel {

Deformable::Deformable(BandMesh b, const Mesh& mesh, const ConstraintOptions& options)
    : band(std::move(b)),
      constraints(band, mesh, options),
      mids(band, mesh, options.rounding),
      membership(band, mesh),
      contact(static_cast<std::size_t>(band.size())),
      side(static_cast<std::size_t>(band.size()), 0),
      off_tool(static_cast<std::size_t>(band.size()), 0),
      tolerance(options.tolerance),
      rounding(options.rounding),
      held_off(static_cast<std::size_t>(band.size()), 0) {
    check_cancelled();
    constraints.geometry().mark(band);
    shell_normals.assign(static_cast<std::size_t>(band.triangles.size()), Vec3::Zero());
    for (int t = 0; t < band.triangles.size(); ++t) {
        const auto& v = band.triangles[t];
        const Vec3& a = band.nodes[v[0]].at;
        shell_normals[t] = (band.nodes[v[1]].at - a).cross(band.nodes[v[2]].at - a).normalized();
    }
}

int Deformable::split_edge(int a, int b, const Vec3& at, const Contact& tools) {
    check_cancelled();
    mids.split(band, a, b, band.size(), fraction(band.nodes[a].at, band.nodes[b].at, at));
    const bool fixed = constraints.has_fixed_middle(a, b);
    const int node = band.split_edge(a, b, at);
    contact.push_back(tools);
    const double distance = barrier && !tools.has(barrier) ? barrier->distance(at) : 0;
    side.push_back(static_cast<signed char>((distance > 0) - (distance < 0)));
    off_tool.push_back(0);
    held_off.push_back(tools ? held_between(a, b) : 0);
    constraints.add_node(band, node);
    if (fixed) constraints.fix_node(node);
    membership.add_node(band, node);
    return node;
}

int Deformable::add_node(const Vec3& at, int a, int b, const Contact& tools, bool exterior) {
    const int node = band.add_node(at, a, b);
    contact.push_back(tools);
    side.push_back(0);
    off_tool.push_back(0);
    held_off.push_back(0);
    constraints.add_lone_node(band, node, exterior);
    membership.add_node(band, node);
    return node;
}

void Deformable::hold_beside(int node, const Contact& tools) {
    contact[node] = tools;
    constraints.fix_node(node);
    held_off[node] = std::max(held_off[node], off_tools(tools, band.nodes[node].at, 0));
}

double Deformable::off_tools(const Contact& tools, const Vec3& x, double held_off) {
    double off = 0;
    for (const Tool* t : tools.tools()) off = std::max(off, std::abs(t->distance(x)) - held_off);
    return off;
}

Vec3 Deformable::along_edge(int a, int b, double t) const {
    const Vec3 &pa = band.nodes[a].at, &pb = band.nodes[b].at;
    Vec3 x = pa + t * (pb - pa);
    if (mids.any()) x += 4 * t * (1 - t) * (mid_side(*this, a, b).at - (pa + pb) / 2);
    const NodeConstraint constraint = constraints.on_edge(band, a, b);
    if (!constraints.is_straight(constraint)) constraints.project(constraint, {}, x);
    return x;
}

double Deformable::worst_part(int a, int b, const Vec3& at) const {
    double worst = 1;
    const auto look = [&](const auto& list, auto quality) {
        for (const int s : list.around(a)) {
            if (std::ranges::find(list[s], b) == list[s].end()) continue;
            for (const int replaced : {a, b}) {
                std::array<Vec3, 4> corner;
                for (std::size_t k = 0; k < list[s].size(); ++k)
                    corner[k] = list[s][k] == replaced ? at : band.nodes[list[s][k]].at;
                worst = std::min(worst, quality(corner, s));
            }
        }
    };
    look(band.tetras, [](const auto& c, int) { return mean_ratio(c[0], c[1], c[2], c[3]); });
    look(band.triangles, [&](const auto& c, int s) {
        const int origin = band.triangles.origin(s);
        if (!constraints.is_shell(origin)) return 1.0;
        return std::copysign(mean_ratio(c[0], c[1], c[2]), (c[1] - c[0]).cross(c[2] - c[0]).dot(shell_normals[origin]));
    });
    return worst;
}

Deformable::SplitPoint Deformable::fitted_split(int a, int b, const Vec3& at, const Contact& tools) const {
    const NodeConstraint constraint = constraints.on_edge(band, a, b);
    if (constraint.freedom == NodeFreedom::free && !tools) return {at, true, worst_part(a, b, at)};
    Vec3 fitted = at;
    const bool found = constraints.project(constraint, tools, fitted, held_between(a, b)) &&
                       (fitted - at).norm() < (band.nodes[a].at - band.nodes[b].at).norm();
    const double worst = worst_part(a, b, at);
    if (found) {
        const double worst_fitted = fitted == at ? worst : worst_part(a, b, fitted);
        if (worst_fitted > 0.2 * worst) return {fitted, true, worst_fitted};
    }
    const double close = std::max(1e-9 * (band.nodes[a].at - band.nodes[b].at).norm(), tolerance);
    return {at,
            off_tools(tools, at, held_between(a, b)) <= close &&
                constraints.distance(constraint, at) <= std::max(1e3 * close, rounding),
            worst};
}

Contact Deformable::edge_contact(int a, int b) const {
    const Contact both = contact[a].common(contact[b]);
    Contact out;
    for (const Tool* t : both.tools()) {
        const Vec3 middle = (band.nodes[a].at + band.nodes[b].at) / 2;
        const double length = (band.nodes[a].at - band.nodes[b].at).norm();
        if (std::abs(t->distance(middle)) <= std::max(1e-9 * length, tolerance) + held_between(a, b)) out = out.with(t);
    }
    if (out.count() == both.count() || !band.is_cut_edge(a, b)) return out;
    // A chord on a surface of cut faces: if it is the surface's border it lies on all tools of its ends, else on one.
    if (both.count() == 1 || band.is_cut_border(a, b)) return both;
    if (out) return out;
    const Vec3 middle = (band.nodes[a].at + band.nodes[b].at) / 2;
    return *std::ranges::min_element(both.tools(), {}, [&](const Tool* t) { return std::abs(t->distance(middle)); });
    return out;
}

double tetra_quality(const Deformable& d, int tetra) {
    const auto& v = d.band.tetras[tetra];
    const auto& n = d.band.nodes;
    return mean_ratio(n[v[0]].at, n[v[1]].at, n[v[2]].at, n[v[3]].at);
}

bool tetra_is_below(double limit, const Deformable& d, int tetra) {
    const auto& v = d.band.tetras[tetra];
    const auto& n = d.band.nodes;
    return mean_ratio_below(limit, n[v[0]].at, n[v[1]].at, n[v[2]].at, n[v[3]].at);
}

double shell_quality(const Deformable& d, int triangle) {
    const auto& v = d.band.triangles[triangle];
    const Vec3 &a = d.band.nodes[v[0]].at, &b = d.band.nodes[v[1]].at, &c = d.band.nodes[v[2]].at;
    const double turned = (b - a).cross(c - a).dot(d.shell_normals[d.band.triangles.origin(triangle)]);
    return std::copysign(mean_ratio(a, b, c), turned);
}

double quality_around(const Deformable& d, int node, const Vec3& x) {
    thread_local Star star;
    thread_local SparseCheck check(16);
    check();
    star.gather(d, node);
    return star.empty() ? 1 : star.worst(x);
}

bool quality_around_is_below(double limit, const Deformable& d, int node) {
    return std::ranges::any_of(d.band.tetras.around(node), [&](int t) { return tetra_is_below(limit, d, t); }) ||
           std::ranges::any_of(d.band.triangles.around(node), [&](int t) {
               return d.constraints.is_shell(d.band.triangles.origin(t)) && shell_quality(d, t) < limit;
           });
}

}  // namespace femscalpel
