// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/foot.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/closest_point.h"

namespace femscalpel {
namespace {

using Facet = KeptGeometry::Facet;
using Segment = KeptGeometry::Segment;

/// A second-order triangle as a polynomial in the barycentric coordinates u, v of its second and third corner.
struct SixNodeFace {
    explicit SixNodeFace(const Facet& f)
        : c(f.corner[0]),
          cu(4 * f.mid[0] - 3 * c - f.corner[1]),
          cv(4 * f.mid[2] - 3 * c - f.corner[2]),
          cuu(2 * (c + f.corner[1] - 2 * f.mid[0])),
          cvv(2 * (c + f.corner[2] - 2 * f.mid[2])),
          cuv(4 * (c - f.mid[0] + f.mid[1] - f.mid[2])) {}

    Vec3 at(double u, double v) const { return c + u * (cu + u * cuu + v * cuv) + v * (cv + v * cvv); }
    Vec3 along_u(double u, double v) const { return cu + 2 * u * cuu + v * cuv; }
    Vec3 along_v(double u, double v) const { return cv + 2 * v * cvv + u * cuv; }

    Vec3 c, cu, cv, cuu, cvv, cuv;
};

/// Newton's step in u, v towards the closest point, with the sides as bounds. `pu`, `pv` are the tangents there, `r`
/// leads from there to the point sought from.
std::pair<double, double> newton_step(const SixNodeFace& face, double u, double v, const Vec3& pu, const Vec3& pv,
                                      const Vec3& r) {
    const double gu = pu.dot(r), gv = pv.dot(r), quu = pu.squaredNorm(), quv = pu.dot(pv), qvv = pv.squaredNorm();
    double huu = quu - 2 * r.dot(face.cuu), huv = quv - r.dot(face.cuv), hvv = qvv - 2 * r.dot(face.cvv);
    double determinant = huu * hvv - huv * huv;
    if (!(huu > 0.1 * quu && hvv > 0.1 * qvv &&
          determinant > 0.1 * (quu * qvv - quv * quv))) {  // far away: Gauss-Newton
        huu = quu;
        huv = quv;
        hvv = qvv;
        determinant = huu * hvv - huv * huv;
    }
    const double w = 1 - u - v;
    double du = (hvv * gu - huv * gv) / determinant, dv = (huu * gv - huv * gu) / determinant;
    if (u + du < 0) {
        du = -u;
        dv = (gv - huv * du) / hvv;
    }
    if (v + dv < 0) {
        dv = -v;
        du = std::max(-u, (gu - huv * dv) / huu);
    }
    if (du + dv > w) {
        du = std::clamp((gu - gv + (hvv - huv) * w) / (huu - 2 * huv + hvv), -u, 1 - u);
        dv = w - du;
    }
    return {du, dv};
}

/// The closest point of a second-order facet, from the place (u, v) on.
Foot foot_on_curved(const Facet& f, const Vec3& x, double u, double v) {
    const SixNodeFace face(f);
    Foot foot;
    for (int iteration = 0;; ++iteration) {
        const Vec3 pu = face.along_u(u, v), pv = face.along_v(u, v);
        foot.at = face.at(u, v);
        const Vec3 r = x - foot.at;
        const auto [du, dv] = newton_step(face, u, v, pu, pv, r);
        if (iteration == 12 || std::abs(du) + std::abs(dv) < 1e-13) {
            foot.normal = pu.cross(pv).normalized();
            foot.inside = std::min({u, v, 1 - u - v});
            foot.distance2 = r.squaredNorm();
            return foot;
        }
        u += du;
        v += dv;
    }
}

/// Walks from piece to piece of one surface (curve), from `hint` on, to the neighbour that is nearest to `x`, at most
/// `steps` times. `foot(piece, limit2)` is the closest point of a piece; where `is_nearest(foot)` no neighbour is
/// nearer.
template <class Piece>
Foot walk(const std::vector<Piece>& pieces, const std::vector<std::vector<int>>& around, int hint, const Vec3& x,
          int steps, auto foot_of, auto is_nearest) {
    const int shape = pieces[hint].shape;
    Foot best = foot_of(pieces[hint], std::numeric_limits<double>::infinity());
    best.piece = hint;
    const auto too_far = [&](const Piece& p) {
        const double reach = p.radius + std::sqrt(best.distance2);
        return (x - p.centre).squaredNorm() > reach * reach;
    };
    for (int step = 0; step < steps; ++step) {
        const int from = best.piece;
        if (is_nearest(best)) break;
        for (const int v : pieces[from].node)
            for (const int k : around[v]) {
                if (k == from || pieces[k].shape != shape || too_far(pieces[k])) continue;
                Foot foot = foot_of(pieces[k], best.distance2);
                if (foot.distance2 < best.distance2) {
                    best = foot;
                    best.piece = k;
                }
            }
        if (best.piece == from) break;
    }
    return best;
}

/// Whether a surface has no other facet at the edge of nodes a and b of this one.
bool is_border(const KeptGeometry& g, int facet, int a, int b) {
    return std::ranges::none_of(g.facets_around[a], [&](int k) {
        return k != facet && g.facets[k].shape == g.facets[facet].shape &&
               std::ranges::find(g.facets[k].node, b) != g.facets[k].node.end();
    });
}

/// Whether a surface ends at a node.
bool ends_at(const KeptGeometry& g, int shape, int node) {
    return std::ranges::any_of(g.facets_around[node], [&](int k) {
        if (g.facets[k].shape != shape) return false;
        return std::ranges::any_of(g.facets[k].node, [&](int w) { return w != node && is_border(g, k, node, w); });
    });
}

/// Where the point nearest to `x` is on the border of its surface, goes on from there to the one in its tangent plane.
void go_on_from_border(Foot& foot, const KeptGeometry& g, const Vec3& x) {
    constexpr double on_side = 1e-9;
    const Facet& f = g.facets[foot.piece];
    if (foot.inside > on_side) return;
    Vec3 bary;
    closest_on_triangle(f.corner[0], f.corner[1], f.corner[2], foot.at, bary);
    const double slack = on_side + (f.curved ? f.sag / f.height : 0);
    const auto ends_here = [&](int k) {
        const int a = f.node[(k + 1) % 3], b = f.node[(k + 2) % 3];
        // In a corner the border may be that of another facet.
        if (bary[(k + 1) % 3] <= slack) return ends_at(g, f.shape, b);
        if (bary[(k + 2) % 3] <= slack) return ends_at(g, f.shape, a);
        return is_border(g, foot.piece, a, b);
    };
    for (int k = 0; k < 3; ++k) {
        if (bary[k] > slack || !ends_here(k)) continue;
        const double off = foot.normal.dot(x - foot.at);
        foot.at = x - off * foot.normal;
        foot.distance2 = off * off;
        return;
    }
}

/// The same of the end of a line, along its tangent.
void go_on_from_end(Foot& foot, const KeptGeometry& g, const Vec3& x) {
    const Segment& s = g.segments[foot.piece];
    for (int k = 0; k < 2; ++k) {
        if (foot.at != s.end[k]) continue;
        if (std::ranges::count_if(g.segments_around[s.node[k]], [&](int o) { return g.segments[o].shape == s.shape; }) >
            1)
            continue;
        foot.at += foot.normal.dot(x - foot.at) * foot.normal;
        foot.distance2 = (foot.at - x).squaredNorm();
        return;
    }
}

void put_on_shape(Foot& foot, const CadShape::Foot& on, const Vec3& x) {
    foot.at = on.at;
    foot.normal = on.direction;
    foot.distance2 = (on.at - x).squaredNorm();
}

/// For a line that only groups mark: the closest point of the segment put on its face of the shape, from the segment's
/// own on.
void put_on_face(Foot& foot, const CadShape& shape, const Segment& segment, const Vec3& x) {
    const Vec3 along = segment.end[1] - segment.end[0];
    double t = std::clamp(along.dot(foot.at - segment.end[0]) / along.squaredNorm(), 0.0, 1.0);
    for (int iteration = 0; iteration < 40; ++iteration) {
        const CadShape::Foot on = shape.on_face(segment.cad_face, segment.end[0] + t * along);
        const Vec3 tangent = along - along.dot(on.direction) * on.direction;
        put_on_shape(foot, {on.at, tangent.normalized()}, x);
        const double next = std::clamp(t + tangent.dot(x - on.at) / tangent.squaredNorm(), 0.0, 1.0);
        if (std::abs(next - t) < 1e-15) break;
        t = next;
    }
}

}  // namespace

Foot foot_on(const KeptGeometry::Facet& f, const Vec3& x, double limit2) {
    Vec3 bary;
    Foot foot;
    foot.at = closest_on_triangle(f.corner[0], f.corner[1], f.corner[2], x, bary);
    foot.distance2 = (foot.at - x).squaredNorm();
    const double limit = std::sqrt(limit2) + f.sag;
    if (foot.distance2 >= limit * limit) {
        foot.distance2 = std::numeric_limits<double>::infinity();
        return foot;
    }
    if (f.curved) return foot_on_curved(f, x, bary[1], bary[2]);
    foot.normal = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).normalized();
    foot.inside = bary.minCoeff();
    return foot;
}

Foot foot_on(const KeptGeometry::Segment& s, const Vec3& x) {
    const Vec3 along = s.end[1] - s.end[0];
    double t = std::clamp(along.dot(x - s.end[0]) / along.squaredNorm(), 0.0, 1.0);
    Foot foot;
    foot.at = s.end[0] + t * along;
    foot.normal = along.normalized();
    if (s.curved) {
        for (int iteration = 0; iteration < 12; ++iteration) {
            const Vec3 p = (1 - t) * (1 - 2 * t) * s.end[0] + t * (2 * t - 1) * s.end[1] + 4 * t * (1 - t) * s.mid;
            const Vec3 pt = (4 * t - 3) * s.end[0] + (4 * t - 1) * s.end[1] + 4 * (1 - 2 * t) * s.mid;
            foot.at = p;
            foot.normal = pt.normalized();
            const double next = std::clamp(t + pt.dot(x - p) / pt.squaredNorm(), 0.0, 1.0);
            if (std::abs(next - t) < 1e-14) break;
            t = next;
        }
    }
    foot.distance2 = (foot.at - x).squaredNorm();
    return foot;
}

Foot surface_foot(const KeptGeometry& g, const NodeConstraint& c, const Vec3& x) {
    const KeptGeometry::Surface& s = g.surfaces[c.shape];
    if (s.flat) {
        const double d = s.normal.dot(x - s.origin);
        return {.at = x - d * s.normal, .normal = s.normal, .distance2 = d * d, .piece = c.hint};
    }
    if (s.exact) {
        const Vec3 at = s.exact->project(x);
        return {.at = at, .normal = s.exact->normal(at), .distance2 = (at - x).squaredNorm(), .piece = c.hint};
    }
    const auto foot_of = [&](const KeptGeometry::Facet& f, double limit2) { return foot_on(f, x, limit2); };
    // On it, or nearer than any smooth neighbour can be.
    const auto is_nearest = [&](const Foot& foot) {
        const double off = std::sqrt(foot.distance2);
        return off <= 1e-14 * g.size || 2 * off < foot.inside * g.facets[foot.piece].height;
    };
    Foot best = walk(g.facets, g.facets_around, c.hint, x, 64, foot_of, is_nearest);
    if (s.goes_on) go_on_from_border(best, g, x);
    const int cad = g.facets[best.piece].cad;
    if (cad >= 0) put_on_shape(best, g.shape->on_face(cad, x), x);
    return best;
}

Foot curve_foot(const KeptGeometry& g, const NodeConstraint& c, const Vec3& x) {
    const KeptGeometry::Curve& curve = g.curves[c.shape];
    if (curve.straight) {
        const Vec3 at = curve.origin + curve.direction.dot(x - curve.origin) * curve.direction;
        return {.at = at, .normal = curve.direction, .distance2 = (at - x).squaredNorm(), .piece = c.hint};
    }
    const auto foot_of = [&](const KeptGeometry::Segment& s, double) { return foot_on(s, x); };
    const auto is_nearest = [](const Foot&) { return false; };
    Foot best = walk(g.segments, g.segments_around, c.hint, x, 256, foot_of, is_nearest);
    const KeptGeometry::Segment& segment = g.segments[best.piece];
    if (curve.goes_on) go_on_from_end(best, g, x);
    if (segment.cad >= 0)
        put_on_shape(best, g.shape->on_edge(segment.cad, x), x);
    else if (segment.cad_face >= 0)
        put_on_face(best, *g.shape, segment, x);
    return best;
}

}  // namespace femscalpel
