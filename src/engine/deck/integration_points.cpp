// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/integration_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "deck/solver_input.h"

namespace femscalpel {
namespace {

/// The products of `at` in all three directions, the first running fastest.
std::vector<Vec3> products(std::span<const double> at) {
    std::vector<Vec3> out;
    for (const double t : at)
        for (const double s : at)
            for (const double r : at) out.emplace_back(r, s, t);
    return out;
}

/// In the natural coordinates of the type: of hexahedra, and along prisms, from -1 to 1.
std::vector<Vec3> natural_points(CellType type, bool reduced) {
    const double two = std::sqrt(1.0 / 3), three = std::sqrt(0.6);
    switch (type) {
        case CellType::tetra:
            return {Vec3::Constant(0.25)};
        case CellType::tetra10: {
            const double a = (5 - std::sqrt(5.0)) / 20, b = 1 - 3 * a;
            return {{a, a, a}, {b, a, a}, {a, b, a}, {a, a, b}};
        }
        case CellType::wedge:
            return {{1. / 3, 1. / 3, -two}, {1. / 3, 1. / 3, two}};
        case CellType::wedge15: {
            std::vector<Vec3> out;
            for (const double t : {-three, 0.0, three})
                for (const auto& [r, s] : {std::pair(1. / 6, 1. / 6), {2. / 3, 1. / 6}, {1. / 6, 2. / 3}})
                    out.emplace_back(r, s, t);
            return out;
        }
        case CellType::hexahedron:
        case CellType::pyramid:
            return reduced ? std::vector<Vec3>{Vec3::Zero()} : products(std::array{-two, two});
        case CellType::hexahedron20:
        case CellType::pyramid13:
            return reduced ? products(std::array{-two, two}) : products(std::array{-three, 0.0, three});
        default:
            return {};
    }
}

Vec3 place_in(CellType type, std::span<const Vec3> x, const Vec3& at) {
    const double r = at[0], s = at[1], t = at[2];
    const int corners = traits(type).corners;
    if (corners == 4) return (1 - r - s - t) * x[0] + r * x[1] + s * x[2] + t * x[3];
    if (corners == 6) {
        const Vec3 low = (1 - r - s) * x[0] + r * x[1] + s * x[2], high = (1 - r - s) * x[3] + r * x[4] + s * x[5];
        return ((1 - t) * low + (1 + t) * high) / 2;
    }
    const auto on_square = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        return Vec3(((1 - r) * (1 - s) * a + (1 + r) * (1 - s) * b + (1 + r) * (1 + s) * c + (1 - r) * (1 + s) * d) /
                    4);
    };
    const Vec3 high = corners == 5 ? x[4] : on_square(x[4], x[5], x[6], x[7]);
    return ((1 - t) * on_square(x[0], x[1], x[2], x[3]) + (1 + t) * high) / 2;
}

}  // namespace

std::vector<Vec3> integration_points(std::string_view label, CellType type, std::span<const Vec3> nodes) {
    const std::string key = deck_key(label);
    if (!key.starts_with("C3D") || traits(type).dimension != 3) return {};
    const std::size_t formulation = std::min(key.find_first_not_of("0123456789", 3), key.size());
    std::vector<Vec3> out = natural_points(type, key.substr(formulation).starts_with('R'));
    for (Vec3& x : out) x = place_in(type, nodes, x);
    return out;
}

}  // namespace femscalpel
