// SPDX-License-Identifier: LGPL-2.1-or-later
// Operators on a mesh whose shape is known: what they make of the skin lies on the shape, not on the mesh's triangles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <TopoDS_Shape.hxx>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "crack_checks.h"
#include "error.h"
#include "io/inp.h"
#include "mesh/quality.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/refine.h"
#include "tools/cad_shape.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

std::string brep(const TopoDS_Shape& shape) {
    std::ostringstream text;
    BRepTools::Write(shape, text);
    return text.str();
}

/// The shape of flanged_cylinder.geo.
const CadShape& flanged_cylinder() {
    static const CadShape shape = CadShape::from_brep(
        brep(BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 2), gp_Dir(0, 0, 1)), 4, 14).Shape(),
                              BRepPrimAPI_MakeCylinder(7, 2).Shape())
                 .Shape()));
    return shape;
}

/// How far a point is from its skin.
double off_skin(const Vec3& x) {
    const double r = std::hypot(x.x(), x.y()), z = x.z();
    const auto beyond = [](double v, double low, double high) { return std::max({low - v, v - high, 0.0}); };
    return std::min({std::hypot(r - 4, beyond(z, 2, 16)), std::hypot(r - 7, beyond(z, 0, 2)),
                     std::hypot(z, beyond(r, 0, 7)), std::hypot(z - 2, beyond(r, 4, 7)),
                     std::hypot(z - 16, beyond(r, 0, 4))});
}

struct Skin {
    std::size_t changed = 0;  ///< nodes of the skin that are new or have moved; of holes and lips only their rims
    double worst = 0;         ///< how far one of them is off the shape
};

/// Looks at all faces of one tetrahedron that are not on `tool`.
Skin skin_of(const Mesh& before, const Mesh& after, const Tool* tool) {
    constexpr int faces[4][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};
    std::map<std::array<Index, 3>, int> count;
    const CellBlock& b = after.block(CellType::tetra);
    for (Index c = 0; c < b.size(); ++c) {
        EXPECT_GT(cell_measure(after, CellType::tetra, c), 0);
        for (const auto& f : faces) {
            std::array<Index, 3> key{b.nodes(c)[f[0]], b.nodes(c)[f[1]], b.nodes(c)[f[2]]};
            std::ranges::sort(key);
            ++count[key];
        }
    }
    const NumberIndex numbers(before);
    std::set<Index> seen;
    Skin out;
    for (const auto& [key, owners] : count) {
        if (owners != 1 || (tool && std::ranges::all_of(key, [&](Index n) {
                                return std::abs(tool->distance(after.points[n])) < 1e-9;
                            })))
            continue;
        for (const Index n : key) {
            const auto was = numbers.node(after.node_ids[n]);
            if (!seen.insert(n).second || (was && before.points[*was] == after.points[n])) continue;
            ++out.changed;
            out.worst = std::max(out.worst, off_skin(after.points[n]));
        }
    }
    return out;
}

class SkinFromShape : public testing::TestWithParam<const char*> {
protected:
    const Mesh mesh_ = read_inp(std::string(FEMSCALPEL_TEST_MESHES "/") + GetParam() + ".inp");
    checks::Random random_{4};
    int done_ = 0, refused_ = 0;
    std::size_t changed_ = 0;
    double quality_ = 1;

    /// `operate` with and without the shape; what comes out with it lies on it.
    void both(const Tool* tool, const Mesh& mesh, auto operate) {
        std::optional<Result> on_shape, on_triangles;
        try {
            on_triangles = operate(nullptr);
        } catch (const Error&) {
            return;  // beside the part, or grazing it
        }
        try {
            on_shape = operate(&flanged_cylinder());
        } catch (const QualityError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("coarse"));
            ++refused_;
            return;
        }
        ++done_;
        on_shape->mesh.validate();
        const Skin exact = skin_of(mesh, on_shape->mesh, tool), faceted = skin_of(mesh, on_triangles->mesh, tool);
        EXPECT_LT(exact.worst, 1e-7) << testing::PrintToString(on_shape->report.warnings);
        changed_ += exact.changed;
        worst_faceted_ = std::max(worst_faceted_, faceted.worst);
        quality_ = std::min(quality_, on_shape->report.quality_after.minimum);
        EXPECT_GT(on_shape->report.quality_after.minimum, 0.02);
    }

    void summary(const char* what) {
        std::cout << "[  QUALITY ] " << GetParam() << " on its shape, " << what << ": " << done_ << " done, "
                  << refused_ << " refused as too coarse; " << changed_
                  << " nodes of the skin on the shape, else up to " << worst_faceted_ << " off it; minimum " << quality_
                  << "\n";
        EXPECT_GT(done_, 5 * refused_);
        EXPECT_GT(changed_, 100);
        EXPECT_GT(worst_faceted_, 1e-3) << "the triangles are no worse than the shape: the test says nothing";
    }
    double worst_faceted_ = 0;
};

TEST_P(SkinFromShape, Cracks) {
    for (int k = 0; k < 40; ++k) {
        const Plane plane(Vec3(random_.uniform(-2, 2), random_.uniform(-2, 2), random_.uniform(0.5, 15)),
                          random_.direction());
        SCOPED_TRACE(k);
        both(&plane, mesh_, [&](const CadShape* skin) {
            CrackOptions options;
            options.skin = skin;
            return crack(mesh_, plane, options);
        });
    }
    summary("cracks");
}

TEST_P(SkinFromShape, RefinedAndDrilled) {
    for (int k = 0; k < 12; ++k) {
        const double angle = random_.uniform(0, 2 * std::numbers::pi);
        const Cylinder hole(Vec3(0, random_.uniform(-1, 1), random_.uniform(6, 13)),
                            Vec3(std::cos(angle), std::sin(angle), random_.uniform(-0.2, 0.2)),
                            random_.uniform(0.8, 1.6));
        SCOPED_TRACE(k);
        both(&hole, mesh_, [&](const CadShape* skin) {
            RefineOptions refinement;
            refinement.size = 0.6;
            refinement.skin = skin;
            const Mesh fine = refine(mesh_, distance_to({&hole}), refinement).mesh;
            if (skin) {
                EXPECT_LT(skin_of(mesh_, fine, nullptr).worst, 1e-7);
            }
            DrillOptions options;
            options.name = "HOLE";
            options.skin = skin;
            const Tool* tools[] = {&hole};
            return drill(fine, tools, options);
        });
    }
    summary("refined and drilled");
}

TEST_P(SkinFromShape, Refined) {
    for (const double size : {0.4, 0.8}) {
        const Plane plane(Vec3(0, 0, 2), Vec3(0.2, 0.1, 1));
        both(nullptr, mesh_, [&](const CadShape* skin) {
            RefineOptions options;
            options.size = size;
            options.skin = skin;
            Result result = refine(mesh_, distance_to({&plane}), options);
            if (skin) {
                // Nearer to the true volume, by what the facets had cut off.
                double volume = 0;
                for (Index c = 0; c < result.mesh.block(CellType::tetra).size(); ++c)
                    volume += cell_measure(result.mesh, CellType::tetra, c);
                double before = 0;
                for (Index c = 0; c < mesh_.block(CellType::tetra).size(); ++c)
                    before += cell_measure(mesh_, CellType::tetra, c);
                EXPECT_GT(volume, before);
                EXPECT_LT(volume, std::numbers::pi * (16 * 14 + 49 * 2));
            }
            return result;
        });
    }
    summary("refined");
}

INSTANTIATE_TEST_SUITE_P(Meshes, SkinFromShape, testing::Values("flanged_cylinder", "flanged_cylinder_coarse"),
                         [](const auto& info) { return std::string(info.param); });

TEST(SkinFromShape, FeatureLinesAreTheShapesEdges) {
    // Nodes where the crack crosses the rims of the flange and of the stem are on the circles themselves.
    const Mesh mesh = read_inp(FEMSCALPEL_TEST_MESHES "/flanged_cylinder_coarse.inp");
    CrackOptions options;
    options.skin = &flanged_cylinder();
    const Result result = crack(mesh, Plane(Vec3(0.4, 0, 0), Vec3(1, 0.15, 0)), options);
    int on_rims = 0;
    for (const Vec3& x : result.mesh.points) {
        const double r = std::hypot(x.x(), x.y());
        for (const auto& [radius, z] :
             {std::pair(7.0, 0.0), std::pair(7.0, 2.0), std::pair(4.0, 2.0), std::pair(4.0, 16.0)})
            on_rims += std::abs(r - radius) < 1e-7 && std::abs(x.z() - z) < 1e-7 &&
                       std::abs(x.x() - 0.4 + 0.15 * x.y()) < 1e-7;
    }
    EXPECT_EQ(on_rims, 16) << "four circles, crossed twice, both lips";
}

TEST(SkinFromShape, WhereACoarseSkinCostsVolumeAWarningSaysSo) {
    const Mesh mesh = read_inp(FEMSCALPEL_TEST_MESHES "/flanged_cylinder_coarse.inp");
    CrackOptions options;
    const auto outcome = [&] {
        const Report report = crack(mesh, Plane(Vec3(0, 0, 9), Vec3(0.3, 0.2, 1)), options).report;
        const auto stem = std::ranges::find_if(
            report.groups, [](const GroupRecord& g) { return g.name == "STEM" && g.kind == GroupKind::element; });
        const bool warned = std::ranges::any_of(report.warnings, [](const std::string& w) {
            return w.find("changed the size of") != std::string::npos && w.find("'STEM' by -") != std::string::npos;
        });
        return std::pair(1 - stem->measure_after / stem->measure_before, warned);
    };
    options.feature_angle = 89;  // keeps no edge between facets
    const auto [lost, warned] = outcome();
    EXPECT_GT(lost, 0.005);
    EXPECT_TRUE(warned);
    options.feature_angle = 10;
    const auto [lost_then, warned_then] = outcome();
    EXPECT_LT(std::abs(lost_then), 1e-3);
    EXPECT_FALSE(warned_then);
}

TEST(SkinFromShape, AnotherShapeIsRefused) {
    const Mesh mesh = read_inp(FEMSCALPEL_TEST_MESHES "/flanged_cylinder.inp");
    const CadShape box = CadShape::from_brep(brep(BRepPrimAPI_MakeBox(30, 30, 30).Shape()));
    CrackOptions options;
    options.skin = &box;
    EXPECT_THAT(
        [&] { crack(mesh, Plane(Vec3(0, 0, 9), Vec3(0, 0, 1)), options); },
        testing::ThrowsMessage<ToolError>(testing::AllOf(testing::HasSubstr("skin"), testing::HasSubstr("unit"))));
    // Half of it: told, and the rest is done.
    const CadShape stem =
        CadShape::from_brep(brep(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, 2), gp_Dir(0, 0, 1)), 4, 14).Shape()));
    options.skin = &stem;
    const Result result = crack(mesh, Plane(Vec3(0, 0, 2.5), Vec3(1, 0, 0.2)), options);
    EXPECT_THAT(result.report.warnings, testing::Contains(testing::HasSubstr("lie on no face of the given shape")));
    EXPECT_THROW(CadShape::from_brep("nonsense"), ToolError);
    EXPECT_THROW(CadShape::read("no such file.brep"), ReadError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
