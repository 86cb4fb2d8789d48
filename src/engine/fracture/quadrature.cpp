// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/quadrature.h"

#include <array>
#include <cmath>
#include <functional>

#include "error.h"
#include "fields/reference_element.h"

namespace femscalpel {
namespace {

/// Gauss's four points in [-1, 1], with their weights.
std::array<std::array<double, 2>, 4> gauss_points() {
    const double root = 2.0 / 7 * std::sqrt(6.0 / 5), near = std::sqrt(3.0 / 7 - root), far = std::sqrt(3.0 / 7 + root);
    const double large = (18 + std::sqrt(30.0)) / 36, small = (18 - std::sqrt(30.0)) / 36;
    return {{{-far, small}, {-near, large}, {near, large}, {far, small}}};
}

using Visit = std::function<void(const Eigen::VectorXd& at, double weight)>;

/// In a product of `dimension` lines from -1 to 1.
void visit_product(int dimension, const Visit& visit) {
    const auto line = gauss_points();
    for (const auto& [x, wx] : line)
        for (const auto& [y, wy] : line) {
            if (dimension == 2) {
                visit(Eigen::Vector2d(x, y), wx * wy);
                continue;
            }
            for (const auto& [z, wz] : line) visit(Eigen::Vector3d(x, y, z), wx * wy * wz);
        }
}

std::vector<QuadraturePoint> made(CellType type) {
    const CellTraits& t = traits(type);
    const ReferenceElement& element = ReferenceElement::of(type);
    std::vector<QuadraturePoint> out;
    visit_product(t.dimension, [&](const Eigen::VectorXd& product, double weight) {
        Eigen::VectorXd at = product;
        const auto collapse = [&](int one, int other) {  // a square onto the triangle of corners at 0 and 1
            const double x = (1 + at[one]) / 2, y = (1 + at[other]) / 2;
            at[one] = x * (1 - y);
            at[other] = y;
            weight *= (1 - y) / 4;
        };
        switch (t.linear) {
            case CellType::triangle:
                collapse(0, 1);
                break;
            case CellType::tetra: {
                const double x = (1 + at[0]) / 2, y = (1 + at[1]) / 2, z = (1 + at[2]) / 2;
                at = Eigen::Vector3d(x * (1 - y) * (1 - z), y * (1 - z), z);
                weight *= (1 - y) * (1 - z) * (1 - z) / 8;
                break;
            }
            case CellType::wedge:
                collapse(0, 1);
                break;
            case CellType::pyramid: {
                const double z = (1 + at[2]) / 2;
                at = Eigen::Vector3d(at[0] * (1 - z), at[1] * (1 - z), z);
                weight *= (1 - z) * (1 - z) / 2;
                break;
            }
            default:
                break;
        }
        out.push_back({weight, element.values(at), element.derivatives(at)});
    });
    return out;
}

}  // namespace

const std::vector<QuadraturePoint>& quadrature(CellType type) {
    static const std::array<std::vector<QuadraturePoint>, cell_type_count> all = [] {
        std::array<std::vector<QuadraturePoint>, cell_type_count> out;
        for (const CellTraits& t : all_cell_types())
            if (t.dimension >= 2) out[static_cast<std::size_t>(t.type)] = made(t.type);
        return out;
    }();
    return all[static_cast<std::size_t>(type)];
}

}  // namespace femscalpel
