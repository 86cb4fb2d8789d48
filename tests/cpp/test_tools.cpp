// SPDX-License-Identifier: LGPL-2.1-or-later
// Tools against what defines them: the normal is the gradient of the distance, the projection lies on the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "crack_checks.h"
#include "error.h"
#include "tools/cone.h"
#include "tools/cylinder.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "tools/torus.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// Compares normal() with differences of distance(), and looks at project(), at random points around the origin.
void expect_consistent(const Tool& tool, double reach) {
    checks::Random random(11);
    for (int k = 0; k < 1000; ++k) {
        const Vec3 x = reach * random.uniform() * random.direction();
        const double distance = tool.distance(x);
        const Vec3 normal = tool.normal(x);
        EXPECT_NEAR(normal.norm(), 1, 1e-12);
        const Vec3 foot = tool.project(x);
        EXPECT_NEAR(tool.distance(foot), 0, 1e-12 * reach) << x.transpose();
        EXPECT_NEAR((x - foot).norm(), std::abs(distance), 1e-9 * reach) << x.transpose();
        const double step = 1e-6 * reach;
        if (std::abs(distance) < 10 * step) continue;
        for (int a = 0; a < 3; ++a) {
            const double slope =
                (tool.distance(x + step * Vec3::Unit(a)) - tool.distance(x - step * Vec3::Unit(a))) / (2 * step);
            EXPECT_NEAR(slope, normal[a], 1e-4) << x.transpose();
        }
    }
}

TEST(Tools, Plane) {
    expect_consistent(Plane({0.1, 0.2, 0.3}, {1, -2, 0.5}), 2);
    EXPECT_DOUBLE_EQ(Plane({0, 0, 1}, {0, 0, 9}).distance({5, 5, 3}), 2);
}

TEST(Tools, Cylinder) {
    const Cylinder cylinder({0.1, 0.2, 0.3}, {1, -2, 0.5}, 0.7);
    expect_consistent(cylinder, 2);
    EXPECT_DOUBLE_EQ(cylinder.feature_size(), 0.7);
    const Cylinder upright({1, 1, 0}, {0, 0, 2}, 2);
    EXPECT_DOUBLE_EQ(upright.distance({1, 1, 7}), -2);
    EXPECT_DOUBLE_EQ(upright.distance({1, 4, -7}), 1);
    EXPECT_NEAR(upright.normal({1, 1, 7}).dot(Vec3::UnitZ()), 0, 1e-15) << "on the axis";
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 0}, 1), ToolError);
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 1}, 0), ToolError);
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 1}, -1), ToolError);
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 1}, std::nan("")), ToolError);
    EXPECT_THROW(Cylinder({0, 0, INFINITY}, {0, 0, 1}, 1), ToolError);
}

TEST(Tools, Sphere) {
    const Sphere sphere({0.1, 0.2, 0.3}, 0.7);
    expect_consistent(sphere, 2);
    EXPECT_DOUBLE_EQ(sphere.feature_size(), 0.7);
    EXPECT_DOUBLE_EQ(Sphere({1, 1, 1}, 2).distance({1, 1, 1}), -2);
    EXPECT_DOUBLE_EQ(Sphere({1, 1, 1}, 2).distance({1, 6, 1}), 3);
    EXPECT_DOUBLE_EQ(sphere.normal(sphere.center()).norm(), 1);
    EXPECT_THROW(Sphere({0, 0, 0}, 0), ToolError);
    EXPECT_THROW(Sphere({0, 0, 0}, std::nan("")), ToolError);
    EXPECT_THROW(Sphere({std::nan(""), 0, 0}, 1), ToolError);
}

TEST(Tools, Torus) {
    expect_consistent(Torus({0.1, 0.2, 0.3}, {1, -2, 0.5}, 1, 0.3), 2);
    const Torus flat({1, 0, 0}, {0, 0, 3}, 5, 2);
    EXPECT_DOUBLE_EQ(flat.distance({6, 0, 0}), -2);
    EXPECT_DOUBLE_EQ(flat.distance({1, 5, 6}), 4);
    EXPECT_DOUBLE_EQ(flat.distance({1, 0, 0}), 3);
    EXPECT_DOUBLE_EQ(flat.feature_size(), 2);
    EXPECT_DOUBLE_EQ(Torus({0, 0, 0}, {0, 0, 1}, 5, 4).feature_size(), 1);
    EXPECT_NEAR(flat.normal({6, 0, 0}).norm(), 1, 1e-15);
    EXPECT_THROW(Torus({0, 0, 0}, {0, 0, 1}, 2, 2), ToolError);
    EXPECT_THROW(Torus({0, 0, 0}, {0, 0, 1}, 0, 2), ToolError);
    EXPECT_THROW(Torus({0, 0, 0}, {0, 0, 1}, 2, -1), ToolError);
    EXPECT_THROW(Torus({0, 0, 0}, {0, 0, 0}, 2, 1), ToolError);
}

TEST(Tools, Cone) {
    expect_consistent(Cone({0.1, 0.2, 0.3}, {1, -2, 0.5}, 0.7, 30), 2);
    const Cone upright({0, 0, 0}, {0, 0, 2}, 2, 45);
    EXPECT_NEAR((upright.apex() - Vec3(0, 0, -2)).norm(), 0, 1e-12);
    EXPECT_NEAR(upright.distance({0, 0, 0}), -std::sqrt(2), 1e-12);
    EXPECT_NEAR(upright.distance({3, 0, 1}), 0, 1e-12);
    EXPECT_NEAR(upright.distance({0, 0, -5}), 3, 1e-12);
    EXPECT_NEAR((upright.normal({0, 0, -5}) - Vec3(0, 0, -1)).norm(), 0, 1e-12);
    EXPECT_NEAR(upright.feature_size(), 2 * std::sqrt(2), 1e-12);
    for (const double angle : {0.0, 90.0, -10.0, std::nan("")})
        EXPECT_THROW(Cone({0, 0, 0}, {0, 0, 1}, 1, angle), ToolError);
    EXPECT_THROW(Cone({0, 0, 0}, {0, 0, 1}, 0, 30), ToolError);
    EXPECT_THROW(Cone({0, 0, 0}, {0, 0, 0}, 1, 30), ToolError);
}

/// What the error of `make` is about, as base class.
template <class Make>
std::string parameter_at_fault(Make make) {
    try {
        make();
    } catch (const Error& e) {
        return e.parameter();
    }
    return "no error";
}

TEST(Tools, ErrorsCarryTheirParameter) {
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(parameter_at_fault([&] { Plane({infinite, 0, 0}, {0, 0, 1}); }), "origin");
    EXPECT_EQ(parameter_at_fault([&] { Plane({0, 0, 0}, {0, 0, 0}); }), "normal");
    EXPECT_EQ(parameter_at_fault([&] { Cylinder({0, 0, 0}, {0, 0, 1}, infinite); }), "radius");
    EXPECT_EQ(parameter_at_fault([&] { Sphere({0, infinite, 0}, 1); }), "center");
    EXPECT_EQ(parameter_at_fault([&] { Torus({0, 0, 0}, {0, 0, 1}, 2, 3); }), "minor_radius");
    EXPECT_EQ(parameter_at_fault([&] { Cone({0, 0, 0}, {0, 0, 1}, 1, 90); }), "half_angle");
    EXPECT_EQ(parameter_at_fault([] { throw QualityError("of no parameter"); }), "");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
