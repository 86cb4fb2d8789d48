// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/shape_blend.h"

#include <algorithm>
#include <cmath>

namespace femscalpel {
namespace {

bool is_prism(CellType type) { return traits(type).corners == 6; }

/// Barycentric coordinates in a prism's triangle.
double share(const Vec3& x, int corner) {
    const int k = corner % 3;
    return k == 0 ? 1 - x[0] - x[1] : x[k - 1];
}

/// That of the straight element for a corner.
double of_corner(CellType type, int k, const Vec3& x) {
    const Vec3 at = ShapeBlend::corner(type, k);
    if (is_prism(type)) return share(x, k) * (1 + x[2] * at[2]) / 2;
    double value = 1;
    for (int axis = 0; axis < traits(type).dimension; ++axis) value *= (1 + x[axis] * at[axis]) / 2;
    return value;
}

/// That of the mid-side node of the edge a-b.
double of_edge(CellType type, int a, int b, const Vec3& x) {
    const Vec3 at = (ShapeBlend::corner(type, a) + ShapeBlend::corner(type, b)) / 2;
    if (is_prism(type)) {
        if (at[2] == 0) return share(x, a) * (1 - x[2] * x[2]);
        return 2 * share(x, a) * share(x, b) * (1 + x[2] * at[2]);
    }
    double value = 1;
    for (int axis = 0; axis < traits(type).dimension; ++axis)
        value *= at[axis] == 0 ? 1 - x[axis] * x[axis] : (1 + x[axis] * at[axis]) / 2;
    return value;
}

void add_term(Blend& to, Index node, double weight) {
    const auto place = std::ranges::lower_bound(to, node, {}, &Blend::value_type::first);
    if (place != to.end() && place->first == node)
        place->second += weight;
    else
        to.insert(place, {node, weight});
}

}  // namespace

void add(Blend& to, const Blend& from, double factor) {
    for (const auto& [node, weight] : from) add_term(to, node, factor * weight);
}

Vec3 place_of(const Mesh& mesh, const Blend& blend) {
    Vec3 x = Vec3::Zero();
    for (const auto& [node, weight] : blend) x += weight * mesh.points[node];
    return x;
}

Vec3 ShapeBlend::corner(CellType type, int k) {
    static const Vec3 cube[8] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    static const Vec3 prism[6] = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    if (is_prism(type)) return prism[k];
    Vec3 at = cube[k];
    if (traits(type).dimension == 2) at[2] = 0;
    return at;
}

Vec3 ShapeBlend::middle(CellType type) { return is_prism(type) ? Vec3(1.0 / 3, 1.0 / 3, 0) : Vec3(0, 0, 0); }

bool ShapeBlend::inside(CellType type, const Vec3& x, double margin) {
    if (!is_prism(type)) return x.cwiseAbs().maxCoeff() <= 1 - margin;
    return std::abs(x[2]) <= 1 - margin && share(x, 0) >= margin && share(x, 1) >= margin && share(x, 2) >= margin;
}

Blend ShapeBlend::at(const Vec3& x) const {
    Blend out = bulge(x);
    for (int k = 0; k < traits(type_).corners; ++k) add_term(out, nodes_[k], of_corner(type_, k, x));
    return out;
}

Blend ShapeBlend::bulge(const Vec3& x) const {
    Blend out;
    const CellTraits& t = traits(type_);
    if (!t.quadratic) return out;
    for (std::size_t e = 0; e < t.edges.size(); ++e) {
        const std::int8_t a = t.edges[e][0], b = t.edges[e][1];
        const double weight = of_edge(type_, a, b, x);
        if (weight == 0) continue;
        add_term(out, nodes_[static_cast<std::size_t>(t.corners) + e], weight);
        add_term(out, nodes_[a], -weight / 2);
        add_term(out, nodes_[b], -weight / 2);
    }
    return out;
}

}  // namespace femscalpel
