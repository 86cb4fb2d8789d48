// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/deform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>
#include <set>

#include "error.h"
#include "mesh/quality.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

constexpr int cells = 10;

/// The same numbers with every standard library.
class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * (engine_() / 4294967296.0); }
    Vec3 direction() {
        for (;;) {
            const Vec3 v((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
            if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
        }
    }

private:
    std::mt19937 engine_;
};

enum class Split { six, five };

/// A cube of 10 x 10 x 10 cells of side 1, each split in tetrahedra, inner nodes displaced at random.
Mesh cube(Split split, double jitter) {
    Mesh mesh;
    Random random(7);
    Index id = 0;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j)
            for (int k = 0; k <= cells; ++k) {
                Vec3 x(i, j, k);
                for (int c = 0; c < 3; ++c)
                    if (x[c] > 0 && x[c] < cells) x[c] += random(-jitter, jitter);
                mesh.add_node(x, ++id);
            }
    const auto node = [](int i, int j, int k) { return static_cast<Index>((i * (cells + 1) + j) * (cells + 1) + k); };
    constexpr int six[6][4] = {{0, 4, 6, 7}, {0, 4, 5, 7}, {0, 2, 6, 7}, {0, 2, 3, 7}, {0, 1, 5, 7}, {0, 1, 3, 7}};
    constexpr int five[2][5][4] = {{{0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}, {1, 2, 4, 7}},
                                   {{1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}, {0, 3, 5, 6}}};
    id = 0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j)
            for (int k = 0; k < cells; ++k)
                for (int t = 0; t < (split == Split::six ? 6 : 5); ++t) {
                    const int* corners = split == Split::six ? six[t] : five[(i + j + k) % 2][t];
                    std::array<Index, 4> v;
                    for (int c = 0; c < 4; ++c)
                        v[c] = node(i + (corners[c] >> 2), j + (corners[c] >> 1 & 1), k + (corners[c] & 1));
                    const auto& p = mesh.points;
                    if ((p[v[1]] - p[v[0]]).cross(p[v[2]] - p[v[0]]).dot(p[v[3]] - p[v[0]]) < 0) std::swap(v[2], v[3]);
                    mesh.add_cell(CellType::tetra, v, ++id);
                }
    return mesh;
}

/// A square plate of 10 x 10 cells of side 1 in the plane z = 0.
Mesh plate(double jitter) {
    Mesh mesh;
    Random random(7);
    Index id = 0;
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j) {
            Vec3 x(i, j, 0);
            for (int c = 0; c < 2; ++c)
                if (x[c] > 0 && x[c] < cells) x[c] += random(-jitter, jitter);
            mesh.add_node(x, ++id);
        }
    const auto node = [](int i, int j) { return static_cast<Index>(i * (cells + 1) + j); };
    id = 0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            mesh.add_cell(CellType::triangle, std::array<Index, 3>{node(i, j), node(i + 1, j), node(i + 1, j + 1)},
                          ++id);
            mesh.add_cell(CellType::triangle, std::array<Index, 3>{node(i, j), node(i + 1, j + 1), node(i, j + 1)},
                          ++id);
        }
    return mesh;
}

double measure(const Mesh& mesh, CellType type) {
    double sum = 0;
    for (Index c = 0; c < mesh.block(type).size(); ++c) sum += cell_measure(mesh, type, c);
    return sum;
}

/// Area (length, for shells) of the part of a cube (plate) of side 10 in a plane, from the other method.
double section(const Mesh& mesh, const Plane& plane) {
    const Result r = crack(mesh, plane);
    return std::ranges::find(r.report.groups, "CRACK_P", &GroupRecord::name)->measure_after;
}

struct Tally {
    int tried = 0;
    int done = 0;
    Index added = 0;
    double worst = 1;
    double rate() const { return static_cast<double>(done) / tried; }
};

/// Cracks the mesh; whatever comes out has to be right.
void attempt(const Mesh& mesh, const Plane& plane, Tally& tally) {
    CrackOptions options;
    options.method = Method::deform;
    ++tally.tried;
    std::optional<Result> result;
    try {
        result = crack(mesh, plane, options);
    } catch (const QualityError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("snap"));
        return;
    }
    ++tally.done;
    tally.added += result->report.nodes_split;
    const Mesh& m = result->mesh;
    m.validate();
    const CellType type = mesh.block(CellType::tetra).size() > 0 ? CellType::tetra : CellType::triangle;
    double worst = 1;
    for (const double q : mean_ratios(m, type)) worst = std::min(worst, q);
    EXPECT_GT(worst, 0.01);
    tally.worst = std::min(tally.worst, worst);
    EXPECT_NEAR(measure(m, type), measure(mesh, type), 1e-9 * measure(mesh, type));
    // The whole section is opened, on both sides alike.
    const auto lip = [&](const char* name) {
        return *std::ranges::find(result->report.groups, name, &GroupRecord::name);
    };
    EXPECT_EQ(lip("CRACK_P").count_after, lip("CRACK_N").count_after);
    const double area = section(mesh, plane);
    EXPECT_NEAR(lip("CRACK_P").measure_after, area, 1e-9 * area);
    // No element is crossed.
    const CellBlock& block = m.block(type);
    for (Index c = 0; c < block.size(); ++c) {
        double low = 0, high = 0;
        for (const Index n : block.nodes(c)) {
            low = std::min(low, plane.distance(m.points[n]));
            high = std::max(high, plane.distance(m.points[n]));
        }
        EXPECT_FALSE(low < -1e-8 && high > 1e-8) << "element " << block.ids[c];
    }
}

void print(const char* what, const Tally& t) {
    std::cout << "[ SUCCESS ] deform, " << what << ": " << t.done << " of " << t.tried << ", worst mean ratio "
              << t.worst << ", " << (t.done > 0 ? static_cast<double>(t.added) / t.done : 0)
              << " nodes added on average\n";
}

class DeformCube : public testing::TestWithParam<std::pair<Split, double>> {};

TEST_P(DeformCube, AxisAlignedPlanes) {
    const Mesh mesh = cube(GetParam().first, GetParam().second);
    Random random(1);
    Tally tally;
    for (int i = 0; i < 15; ++i) attempt(mesh, Plane(Vec3::Constant(random(1.2, 8.8)), Vec3::Unit(i % 3)), tally);
    print("axis-aligned planes", tally);
    EXPECT_GE(tally.rate(), 0.9);
}

TEST_P(DeformCube, ObliquePlanes) {
    const Mesh mesh = cube(GetParam().first, GetParam().second);
    Random random(2);
    Tally tally;
    for (int i = 0; i < 15; ++i) {
        const Vec3 axis = Vec3::Unit(i % 3), side = axis.cross(random.direction()).normalized();
        const double angle = random(0, std::numbers::pi / 6);
        attempt(mesh,
                Plane(Vec3(random(4, 6), random(4, 6), random(4, 6)), std::cos(angle) * axis + std::sin(angle) * side),
                tally);
    }
    print("oblique planes", tally);
    EXPECT_GE(tally.rate(), 0.8);
}

TEST_P(DeformCube, RandomPlanes) {
    const Mesh mesh = cube(GetParam().first, GetParam().second);
    Random random(3);
    Tally tally;
    for (int i = 0; i < 15; ++i)
        attempt(mesh, Plane(Vec3(random(2, 8), random(2, 8), random(2, 8)), random.direction()), tally);
    print("random planes", tally);
    EXPECT_GE(tally.rate(), 0.6);
}

INSTANTIATE_TEST_SUITE_P(Cubes, DeformCube,
                         testing::Values(std::pair(Split::six, 0.0), std::pair(Split::six, 0.15),
                                         std::pair(Split::five, 0.15)));

/// A tip smaller than an element must not silently stay uncut.
TEST(Deform, CornerTip) {
    const Mesh mesh = cube(Split::five, 0.15);
    Tally tally;
    for (const double depth : {0.1, 0.3, 0.5, 0.8, 1.2, 1.7, 2.4})
        attempt(mesh, Plane(Vec3(depth, 0, 0), Vec3(1, 1, 1)), tally);
    print("corner tip", tally);
}

TEST(Deform, ThinSlice) {
    const Mesh mesh = cube(Split::six, 0.15);
    Tally tally;
    for (const double depth : {0.05, 0.2, 0.5, 0.8}) attempt(mesh, Plane(Vec3(depth, 0, 0), Vec3(1, 0, 0)), tally);
    print("thin slice", tally);
}

TEST(Deform, Plate) {
    const Mesh mesh = plate(0.2);
    Random random(4);
    Tally tally;
    for (int i = 0; i < 30; ++i) {
        const double angle = random(0, 2 * std::numbers::pi);
        attempt(mesh,
                Plane(Vec3(random(2, 8), random(2, 8), 0), Vec3(std::cos(angle), std::sin(angle), random(-0.5, 0.5))),
                tally);
    }
    print("planes through a plate", tally);
    EXPECT_GE(tally.rate(), 0.8);
}

/// Drills the mesh; whatever comes out has to be right. `length`: of the hole, if its ends are square to it.
void attempt_hole(const Mesh& mesh, const Cylinder& cylinder, double length, Tally& tally) {
    DrillOptions options;
    options.name = "HOLE";
    options.method = Method::deform;
    const Tool* tools[] = {&cylinder};
    ++tally.tried;
    std::optional<Result> result;
    try {
        result = drill(mesh, tools, options);
    } catch (const QualityError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("snap"));
        return;
    } catch (const ToolError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("too coarse"));
        return;
    }
    ++tally.done;
    tally.added += result->report.nodes_split;
    const Mesh& m = result->mesh;
    m.validate();
    const CellType type = mesh.block(CellType::tetra).size() > 0 ? CellType::tetra : CellType::triangle;
    double worst = 1;
    for (const double q : mean_ratios(m, type)) worst = std::min(worst, q);
    EXPECT_GT(worst, 0.01);
    tally.worst = std::min(tally.worst, worst);
    // The nodes of the wall are on the cylinder, and as many as the report says; no other is inside.
    std::size_t on = 0;
    for (const Vec3& x : m.points) {
        const double off = cylinder.distance(x);
        EXPECT_GT(off, -1e-8);
        on += std::abs(off) < 1e-9;
    }
    const auto& sets = result->report.node_sets;
    EXPECT_GE(on, sets.at("IHN").size() + sets.at("EHN").size());
    EXPECT_EQ(result->report.constraints.at("cylinder"), sets.at("IHN").size() + sets.at("EHN").size());
    const auto exterior = sets.at("EHN").size() + sets.at("ETN").size();
    EXPECT_EQ(result->report.constraints.at("tangent plane"),
              type == CellType::tetra ? exterior : exterior + sets.at("IHN").size() + sets.at("ITN").size());
    // A polygon with its corners on the circle is taken out.
    const double removed = measure(mesh, type) - measure(m, type),
                 exact = std::numbers::pi * cylinder.radius() * cylinder.radius() * length;
    if (length > 0) {
        EXPECT_LT(removed, exact * (1 + 1e-9));
        EXPECT_GT(removed, 0.7 * exact);
    }
    // Nodes off the band are where they were, with the same numbers.
    const NumberIndex numbers(m);
    std::set<Index> moving;
    for (const auto& [name, ids] : sets) moving.insert(ids.begin(), ids.end());
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (const auto now = numbers.node(mesh.node_ids[n]); now && !moving.contains(mesh.node_ids[n])) {
            EXPECT_EQ(m.points[*now], mesh.points[n]);
        }
}

TEST(DeformHole, AlongAnAxisOfTheCube) {
    for (const auto& [split, jitter] : {std::pair(Split::six, 0.15), std::pair(Split::five, 0.15)}) {
        const Mesh mesh = cube(split, jitter);
        Random random(5);
        Tally tally;
        for (int i = 0; i < 15; ++i)
            attempt_hole(mesh,
                         Cylinder(Vec3(random(4, 6), random(4, 6), random(4, 6)), Vec3::Unit(i % 3), random(1.5, 3)),
                         cells, tally);
        print("holes along an axis", tally);
        EXPECT_GE(tally.rate(), 0.9);
    }
}

TEST(DeformHole, Oblique) {
    const Mesh mesh = cube(Split::six, 0.15);
    Random random(6);
    Tally tally;
    for (int i = 0; i < 15; ++i) {
        const Vec3 axis = Vec3::Unit(i % 3) + 0.3 * random.direction();
        attempt_hole(mesh, Cylinder(Vec3(random(4, 6), random(4, 6), random(4, 6)), axis, random(1.5, 2.5)), 0, tally);
    }
    print("oblique holes", tally);
    EXPECT_GE(tally.rate(), 0.9);
}

TEST(DeformHole, InAPlate) {
    const Mesh mesh = plate(0.2);
    Random random(8);
    Tally tally;
    for (int i = 0; i < 30; ++i)
        attempt_hole(mesh, Cylinder(Vec3(random(3.5, 6.5), random(3.5, 6.5), 0), Vec3(0, 0, 1), random(1.2, 3)), 1,
                     tally);
    print("holes in a plate", tally);
    EXPECT_GE(tally.rate(), 0.8);
}

TEST(DeformHole, OneSurfaceAtATime) {
    const Mesh mesh = cube(Split::six, 0.15);
    const auto refused = [](const auto& call) {
        EXPECT_THAT(call, testing::ThrowsMessage<ToolError>(
                              testing::AllOf(testing::HasSubstr("single surface"), testing::HasSubstr("snap"))));
    };
    const Cylinder one(Vec3(3, 5, 5), Vec3(0, 0, 1), 1.5), two(Vec3(7, 5, 5), Vec3(0, 0, 1), 1.5);
    DrillOptions holes;
    holes.name = "HOLE";
    holes.method = Method::deform;
    const Tool* both[] = {&one, &two};
    refused([&] { drill(mesh, both, holes); });
    holes.depth = 3;
    refused([&] { drill(mesh, {both, 1}, holes); });
    CutOptions slot;
    slot.name = "CUT";
    slot.method = Method::deform;
    refused([&] { cut(mesh, Plane(Vec3(5, 5, 5), Vec3(1, 0, 0)), 1.5, slot); });
}

TEST(DeformToTool, TakesTheNodesThatHaveLeastToMove) {
    const Mesh mesh = checks::grid(4, 2, 2);
    const Plane near({1.8, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, near);
    deform_to_tool(f, near, mesh);
    EXPECT_EQ(f.d.band.size(), 45) << "none is born";
    for (int v = 0; v < f.d.band.size(); ++v) {
        const bool moved = f.d.band.nodes[v].start.x() == 2;
        EXPECT_EQ(f.d.contact[v].has(&near), moved);
        if (moved) {
            EXPECT_NEAR(f.d.band.nodes[v].at.x(), 1.8, 1e-12);
        }
    }
}

TEST(DeformToTool, RefusesNodesThatNothingCanMove) {
    // Corners of the skin, all of them.
    Mesh mesh;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
        mesh.add_node(at, mesh.node_count() + 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1);
    const Plane plane({0, 0, 0.3}, {0, 0, 1});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    EXPECT_THAT([&] { deform_to_tool(f, plane, mesh); },
                testing::ThrowsMessage<QualityError>(testing::HasSubstr("finds no row of nodes")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
