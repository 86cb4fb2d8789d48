// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/curved_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/cell_type.h"

namespace femscalpel {
namespace {

/// What an edge is on, and how it bulges.
struct EdgeShape {
    NodeConstraint constraint;
    Contact tools;
    Vec3 bulge;
    double held;  ///< how far it may be off the tools, as its ends are: Deformable::held_off
};

bool is_curved(const Tool* t) { return std::isfinite(t->feature_size()); }

MidSide fit(const Deformable& d, const Vec3& a, const Vec3& b, const EdgeShape& shape) {
    const Vec3 chord = (a + b) / 2;
    MidSide mid{chord + shape.bulge, true};
    const bool curved_tool = std::ranges::any_of(shape.tools.tools(), is_curved);
    if (shape.bulge.isZero(0) && !curved_tool && d.constraints.is_straight(shape.constraint)) return mid;
    const double reach = 0.2 * (b - a).norm();
    Vec3 x = mid.at;
    if (d.constraints.project(shape.constraint, shape.tools, x, shape.held) && (x - chord).norm() < reach) {
        mid.at = x;
        return mid;
    }
    const double close = 1e-9 * (b - a).norm();
    if (shape.held > 0 && Deformable::off_tools(shape.tools, mid.at, shape.held) <= close &&
        d.constraints.distance(shape.constraint, mid.at) <= std::max(close, d.rounding))
        return mid;
    // On its tools at least, for the lips; whoever made the edge has to look for another.
    mid.fits = false;
    x = chord;
    if (shape.tools && d.constraints.project(NodeConstraint{}, shape.tools, x) && (x - chord).norm() < reach)
        mid.at = x;
    else
        mid.at = chord;
    return mid;
}

/// Whether elements of both sides of the barrier share the edge a-b.
bool is_between_sides(const Deformable& d, int a, int b) {
    bool positive = false, negative = false;
    const auto look = [&](const auto& list) {
        for (const int s : list.around(a))
            if (std::ranges::find(list[s], b) != list[s].end())
                for (const int v : list[s]) (d.side[v] > 0 ? positive : negative) |= d.side[v] != 0;
    };
    look(d.band.tetras);
    look(d.band.triangles);
    return positive && negative;
}

EdgeShape shape_of(const Deformable& d, int a, int b) {
    return {d.constraints.on_edge(d.band, a, b), edge_tools(d, a, b), d.mids.bulge(a, b), d.held_between(a, b)};
}

/// Of an edge that is straightened: but for its tools it lies on nothing. On a flat surface it stays, though, beside a
/// curved tool that meets the surface at both ends but not between them.
MidSide straight_middle(const Deformable& d, int a, int b) {
    const Vec3 chord = (d.band.nodes[a].at + d.band.nodes[b].at) / 2;
    if (d.mids.is_off_tools(a, b)) return {chord, true};
    const Contact tools = edge_tools(d, a, b);
    Vec3 x = chord;
    const NodeConstraint on = d.constraints.on_edge(d.band, a, b);
    if (on.freedom != NodeFreedom::free && d.constraints.is_straight(on)) {
        const bool on_both = d.constraints.project(on, tools, x, d.held_between(a, b)) &&
                             (x - chord).norm() < 0.2 * (d.band.nodes[b].at - d.band.nodes[a].at).norm();
        return {on_both ? x : chord, true};
    }
    const bool on_tools = std::ranges::none_of(tools.tools(), is_curved) ||
                          d.constraints.project(NodeConstraint{}, tools, x, d.held_between(a, b));
    return {on_tools ? x : chord, on_tools};
}

/// How far the mid-side node of an edge of the band is from the chord wherever the edge's ends are: 0 if the edge is
/// straight, infinity if that depends on a curved shape or a tool.
double farthest_bulge(const Deformable& d, int a, int b) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const double bulge = d.mids.may_bulge(a, b) ? d.mids.bulge(a, b).norm() : 0;
    const auto is_held = [&](int v) { return d.constraints[v].freedom != NodeFreedom::free; };
    if (is_held(a) && is_held(b)) {
        const NodeConstraint shape = d.constraints.on_edge(d.band, a, b);
        if (!d.constraints.is_straight(shape) || (bulge > 0 && shape.freedom != NodeFreedom::free)) return unknown;
    }
    if (d.contact[a]) {
        const Contact tools = d.contact[a].common(d.contact[b]);
        if ((tools && bulge > 0) || std::ranges::any_of(tools.tools(), is_curved)) return unknown;
    }
    return bulge;
}

/// Whether a tetrahedron with corners at(0) to at(3) has a curved_ratio() of at least curved_limit, whatever the
/// directions in which its edges bulge by `bulges` in sum. Not all that have are found.
bool is_surely_sound(double bulges, auto at) {
    const Vec3 a = at(1) - at(0), b = at(2) - at(0), c = at(3) - at(0);
    const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
    const double determinant = a.dot(bc);
    // Bulges times gradients of shape functions, 4 sqrt(3) at most, times the inverse of the straight element's
    // Jacobian.
    const double inverse = std::sqrt(bc.squaredNorm() + ca.squaredNorm() + ab.squaredNorm());
    static const double small = (1 - std::cbrt(curved_limit)) / (4 * std::sqrt(3.0));
    return determinant > 0 && bulges * inverse < small * determinant;
}

/// Edges of a tetrahedron by places of corners; those of a triangle are the first.
std::span<const std::array<std::int8_t, 2>> edges_of(std::size_t corners) {
    return traits(corners == 3 ? CellType::triangle6 : CellType::tetra10).edges;
}

/// curved_ratio() of the element with these corners, or 1 if it is straight, -1 if a mid-side node does not fit.
/// `mid(k)`: of edge k.
double ratio(std::span<const Vec3> corner, auto mid, ShapeAt at = ShapeAt::corners_too) {
    std::array<Vec3, 10> x;
    std::ranges::copy(corner, x.begin());
    bool straight = true;
    const auto edges = edges_of(corner.size());
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const auto [i, j] = edges[k];
        const MidSide m = mid(k);
        if (!m.fits) return -1;
        x[corner.size() + k] = m.at;
        straight = straight && m.at == (corner[i] + corner[j]) / 2;
    }
    if (straight) return 1;
    const auto nodes = std::span(x).first(corner.size() + edges.size());
    return at == ShapeAt::corners_too ? curved_ratio(nodes) : integration_ratio(nodes);
}

/// The same, its mid-side nodes by mid(i, j), a function of the places of an edge's ends among the corners.
double ratio_by_ends(std::span<const Vec3> corner, auto mid, ShapeAt at = ShapeAt::corners_too) {
    const auto edges = edges_of(corner.size());
    return ratio(
        corner, [&](std::size_t k) { return mid(edges[k][0], edges[k][1]); }, at);
}

/// The corners of an element, were its nodes at place_of(node).
struct Corners {
    Corners(std::span<const int> nodes, auto place_of) : count(nodes.size()) {
        std::ranges::transform(nodes, at.begin(), place_of);
    }

    operator std::span<const Vec3>() const { return std::span(at).first(count); }

    std::size_t count;
    std::array<Vec3, 4> at;
};

}  // namespace

Contact edge_tools(const Deformable& d, int a, int b) {
    if (d.mids.is_kept(a, b)) return {};
    const Contact tools = d.edge_contact(a, b);
    if (!tools.has(d.barrier) ||
        (!is_curved(d.barrier) && d.constraints.is_straight(d.constraints.on_edge(d.band, a, b))) ||
        is_between_sides(d, a, b))
        return tools;
    return tools.without(d.barrier);
}

MidSide mid_side(const Deformable& d, int a, int b) {
    const BandNode &na = d.band.nodes[a], &nb = d.band.nodes[b];
    // Beams have a shape of their own.
    if (!d.band.lines.around(a).empty())
        if (const int l = d.band.lines.find({a, b}); l >= 0 && d.constraints.is_beam(d.band.lines.origin(l)))
            return {(na.at + nb.at) / 2 + d.mids.bulge(a, b), true};
    const bool untouched = !d.band.is_new(a) && !d.band.is_new(b) && na.at == na.start && nb.at == nb.start;
    if (untouched && !d.contact[a].common(d.contact[b])) return {(na.at + nb.at) / 2 + d.mids.bulge(a, b), true};
    if (d.mids.is_straightened(a, b)) return straight_middle(d, a, b);
    return fit(d, na.at, nb.at, shape_of(d, a, b));
}

bool is_second_order(const Deformable& d, BandElement e) {
    const CellType type = e.cell(d.band).type;
    return e.triangle ? type == CellType::triangle6 && d.constraints.is_shell(e.origin(d.band))
                      : type == CellType::tetra10;
}

CurvedStar::CurvedStar(Deformable& d, int node) : d_(d), node_(node) {}

void CurvedStar::gather() {
    gathered_ = true;
    if (!d_.mids.any()) return;
    std::vector<std::uint64_t> keys;
    for_second_order_around(d_, node_, [&](BandElement element) {
        const auto nodes = element.nodes(d_.band);
        const auto ends = edges_of(nodes.size());
        Element e{nodes.size(), {}, {}, 0};
        std::ranges::copy(nodes, e.corner.begin());
        for (std::size_t k = 0; k < ends.size(); ++k) {
            const int a = e.corner[ends[k][0]], b = e.corner[ends[k][1]];
            const std::uint64_t key = edge_key(a, b);
            const auto known = std::ranges::find(keys, key);
            const auto place = static_cast<std::size_t>(known - keys.begin());
            if (known == keys.end()) {
                keys.push_back(key);
                const MidSide unknown{Vec3::Zero(), false};
                edges_.push_back({a, b, a == node_ || b == node_, false, farthest_bulge(d_, a, b), unknown});
            }
            e.edge[k] = static_cast<int>(place);
            e.bulges += edges_[place].bulge;
        }
        if (e.bulges > 0) elements_.push_back(e);
    });
}

double CurvedStar::worst(const Vec3& x, double enough) {
    if (!gathered_) gather();
    if (elements_.empty()) return 1;
    Vec3& at = d_.band.nodes[node_].at;
    const Vec3 home = at;
    at = x;
    for (Edge& edge : edges_) edge.found = edge.found && !edge.at_node;
    double worst = 1;
    const bool may_skip = std::isfinite(enough) && enough <= curved_limit;
    for (std::size_t i = 0; i < elements_.size() && worst >= enough; ++i) {
        const Element& e = elements_[i];
        if (may_skip && e.corners == 4 &&
            is_surely_sound(e.bulges, [&](int k) { return d_.band.nodes[e.corner[k]].at; }))
            continue;
        const Corners corner(std::span(e.corner).first(e.corners), [&](int v) { return d_.band.nodes[v].at; });
        worst = std::min(worst, ratio(corner, [&](std::size_t k) {
                             Edge& edge = edges_[e.edge[k]];
                             if (!std::exchange(edge.found, true))
                                 edge.mid =
                                     edge.bulge == 0
                                         ? MidSide{(d_.band.nodes[edge.a].at + d_.band.nodes[edge.b].at) / 2, true}
                                         : mid_side(d_, edge.a, edge.b);
                             return edge.mid;
                         }));
        // It is likely to be the one that fails at the next place, too.
        if (worst < enough) std::swap(elements_[0], elements_[i]);
    }
    at = home;
    return worst;
}

void CurvedStar::forget_places() {
    for (Edge& edge : edges_) edge.found = false;
    home_.reset();
}

bool CurvedStar::stays_sound(const Vec3& x) {
    if (worst(x, curved_limit) >= curved_limit) return true;
    const Vec3& home = d_.band.nodes[node_].at;
    if (!home_ || *home_ != home) {
        at_home_ = worst(home);
        home_ = home;
    }
    return at_home_ < curved_limit && worst(x, at_home_) >= at_home_;
}

double curved_shape(const Deformable& d, BandElement element, ShapeAt at) {
    if (!is_second_order(d, element)) return 1;
    const auto v = element.nodes(d.band);
    return ratio_by_ends(
        Corners(v, [&](int n) { return d.band.nodes[n].at; }), [&](int i, int j) { return mid_side(d, v[i], v[j]); },
        at);
}

bool is_surely_sound(const Deformable& d, BandElement element) {
    if (!is_second_order(d, element)) return true;
    if (element.triangle) return false;
    const auto v = element.nodes(d.band);
    double bulges = 0;
    for (const auto& edge : edges_of(4)) bulges += farthest_bulge(d, v[edge[0]], v[edge[1]]);
    return is_surely_sound(bulges, [&](int k) -> const Vec3& { return d.band.nodes[v[k]].at; });
}

bool keeps_curved_shape(Deformable& d, int node, const Vec3& x) { return CurvedStar(d, node).stays_sound(x); }

double curved_children(const Deformable& d, int a, int b, const Vec3& at, const Contact& tools) {
    if (!d.mids.any()) return 1;
    const BandMesh& band = d.band;
    const double t = fraction(band.nodes[a].at, band.nodes[b].at, at);
    const NodeConstraint along = d.constraints.on_edge(band, a, b);
    const double held = d.held_between(a, b);
    double worst = 1;
    for_second_order_at_edge(d, a, b, [&](BandElement element) {
        const auto v = element.nodes(band);
        for (const int replaced : {a, b}) {
            const Corners corner(v, [&](int n) { return n == replaced ? at : band.nodes[n].at; });
            worst = std::min(worst, ratio_by_ends(corner, [&](int i, int j) {
                                 if (v[i] != replaced && v[j] != replaced) return mid_side(d, v[i], v[j]);
                                 const int other = v[i] == replaced ? v[j] : v[i];
                                 const Contact both = tools.common(d.contact[other]);
                                 const Vec3 &x = corner.at[i], &y = corner.at[j];
                                 if (other == a) return fit(d, x, y, {along, both, t * t * d.mids.bulge(a, b), held});
                                 if (other == b)
                                     return fit(d, x, y, {along, both, (1 - t) * (1 - t) * d.mids.bulge(a, b), held});
                                 return fit(d, x, y,
                                            {d.constraints.on_face(band, a, b, other), both,
                                             d.mids.bulge_across(a, b, other, t), std::max(held, d.held_off[other])});
                             }));
        }
    });
    return worst;
}

double curved_merged(const Deformable& d, int p, int t) {
    if (!d.mids.any()) return 1;
    const BandMesh& band = d.band;
    double worst = 1;
    for_second_order_around(d, p, [&](BandElement element) {
        const auto v = element.nodes(band);
        if (std::ranges::find(v, t) != v.end()) return;
        const Corners corner(v, [&](int n) { return band.nodes[n == p ? t : n].at; });
        worst = std::min(worst, ratio_by_ends(corner, [&](int i, int j) {
                             if (v[i] != p && v[j] != p) return mid_side(d, v[i], v[j]);
                             const int other = v[i] == p ? v[j] : v[i];
                             return fit(d, corner.at[i], corner.at[j],
                                        {d.constraints.on_edge(band, p, other), d.contact[t].common(d.contact[other]),
                                         Vec3::Zero(), d.held_between(t, other)});
                         }));
    });
    return worst;
}

}  // namespace femscalpel
