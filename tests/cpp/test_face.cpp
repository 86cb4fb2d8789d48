// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces of CAD models as tools, against analytic surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepTools.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Circ.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "crack_checks.h"
#include "error.h"
#include "io/inp.h"
#include "mesh/quality.h"
#include "operators/crack.h"
#include "tools/cylinder.h"
#include "tools/face.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

std::string brep(const TopoDS_Shape& shape) {
    std::ostringstream text;
    BRepTools::Write(shape, text);
    return text.str();
}

const gp_Ax3 frame(gp_Pnt(6, 5, 5), gp_Dir(0.3, 0.2, 1));

TopoDS_Face plane_face(double size) { return BRepBuilderAPI_MakeFace(gp_Pln(frame), -size, size, -size, size); }

TEST(Face, PlaneIsThePlane) {
    const Face face = Face::from_brep(brep(plane_face(4)));
    const Plane plane({6, 5, 5}, {0.3, 0.2, 1});
    checks::Random random(1);
    for (int k = 0; k < 500; ++k) {
        const Vec3 x = Vec3(6, 5, 5) + 5 * random.uniform() * random.direction();
        EXPECT_NEAR(face.distance(x), plane.distance(x), 1e-12);
        EXPECT_NEAR((face.normal(x) - plane.normal(x)).norm(), 0, 1e-12);
        EXPECT_NEAR((face.project(x) - plane.project(x)).norm(), 0, 1e-12);
        // The border is the square |u|, |v| = 4 in the plane.
        const gp_Dir u = frame.XDirection(), v = frame.YDirection();
        const Vec3 r = plane.project(x) - Vec3(6, 5, 5);
        const double a = std::abs(r.dot(Vec3(u.X(), u.Y(), u.Z()))) - 4,
                     b = std::abs(r.dot(Vec3(v.X(), v.Y(), v.Z()))) - 4;
        const double beyond = a > 0 && b > 0 ? std::hypot(a, b) : std::max(a, b);
        EXPECT_NEAR(face.beyond(x), beyond, 1e-9);
    }
    EXPECT_TRUE(std::isinf(face.feature_size()));
    EXPECT_TRUE(face.bounded());
    // Turned round, the positive side is the other one.
    EXPECT_NEAR(Face::from_brep(brep(plane_face(4).Reversed())).distance({6, 5, 7}), -plane.distance({6, 5, 7}), 1e-12);
}

TEST(Face, PartOfACylinder) {
    const Face face = Face::from_brep(brep(BRepBuilderAPI_MakeFace(gp_Cylinder(frame, 3), 0.2, 2.2, -4, 4)));
    const Cylinder cylinder({6, 5, 5}, {0.3, 0.2, 1}, 3);
    EXPECT_NEAR(face.feature_size(), 3, 1e-9);
    const auto on_axes = [&](double angle, double radius, double height) {
        const gp_Pnt p = gp_Pnt(frame.Location().XYZ() + frame.XDirection().XYZ() * radius * std::cos(angle) +
                                frame.YDirection().XYZ() * radius * std::sin(angle) + frame.Direction().XYZ() * height);
        return Vec3(p.X(), p.Y(), p.Z());
    };
    checks::Random random(2);
    for (int k = 0; k < 500; ++k) {
        const double angle = random.uniform(0, 2.4), height = random.uniform(-4.5, 4.5);
        const Vec3 x = on_axes(angle, random.uniform(1.5, 4.5), height);
        EXPECT_NEAR(face.distance(x), cylinder.distance(x), 1e-10);
        EXPECT_NEAR((face.normal(x) - cylinder.normal(x)).norm(), 0, 1e-9);
        EXPECT_NEAR(cylinder.distance(face.project(x)), 0, 1e-10);
        const bool inside = angle > 0.2 && angle < 2.2 && std::abs(height) < 4;
        EXPECT_EQ(face.beyond(x) < 0, inside) << angle << " " << height << " " << face.beyond(x);
        // Beside the end circles the border is straight above or below.
        if (angle > 0.6 && angle < 1.8 && std::abs(std::abs(height) - 4) < 0.5) {
            EXPECT_NEAR(face.beyond(x), std::abs(height) - 4, 1e-8);
        }
    }
}

TEST(Face, SplineIsConsistent) {
    TColgp_Array2OfPnt points(1, 9, 1, 9);
    for (int i = 1; i <= 9; ++i)
        for (int j = 1; j <= 9; ++j)
            points.SetValue(i, j, gp_Pnt(i - 5, j - 5, 0.5 * std::sin(0.7 * (i - 5)) * std::cos(0.5 * (j - 5))));
    const Handle(Geom_BSplineSurface) surface = GeomAPI_PointsToBSplineSurface(points).Surface();
    const Face face = Face::from_brep(brep(BRepBuilderAPI_MakeFace(surface, 1e-6)));
    EXPECT_GT(face.feature_size(), 2);
    EXPECT_LT(face.feature_size(), 6);
    checks::Random random(3);
    for (int k = 0; k < 500; ++k) {
        const Vec3 x(random.uniform(-3.5, 3.5), random.uniform(-3.5, 3.5), random.uniform(-1.5, 1.5));
        const double distance = face.distance(x);
        const Vec3 normal = face.normal(x), foot = face.project(x);
        EXPECT_NEAR(normal.norm(), 1, 1e-12);
        EXPECT_NEAR(face.distance(foot), 0, 1e-10) << x.transpose();
        EXPECT_NEAR((x - foot).norm(), std::abs(distance), 1e-10);
        const double step = 1e-6;
        if (std::abs(distance) < 1e-4) continue;
        for (int a = 0; a < 3; ++a)
            EXPECT_NEAR(
                (face.distance(x + step * Vec3::Unit(a)) - face.distance(x - step * Vec3::Unit(a))) / (2 * step),
                normal[a], 1e-5);
    }
}

TEST(Face, BadShapes) {
    const auto what = [](const char* part) { return testing::HasSubstr(part); };
    EXPECT_THAT([] { Face::from_brep("nonsense"); }, testing::ThrowsMessage<ToolError>(what("BREP")));
    EXPECT_THAT([] { Face::read("no such file.step"); }, testing::ThrowsMessage<ReadError>(what("no such file.step")));
    const auto folder = std::filesystem::temp_directory_path();
    std::ofstream(folder / "femscalpel_bad.step") << "not a STEP file";
    EXPECT_THAT([&] { Face::read(folder / "femscalpel_bad.step"); },
                testing::ThrowsMessage<ReadError>(what("femscalpel_bad.step")));
    std::ofstream(folder / "femscalpel_bad.stl") << "";
    EXPECT_THAT([&] { Face::read(folder / "femscalpel_bad.stl"); }, testing::ThrowsMessage<ReadError>(what(".brep")));
    // A wire has no face; two faces at a right angle fold.
    BRepBuilderAPI_MakePolygon wire(gp_Pnt(0, 0, 0), gp_Pnt(1, 0, 0), gp_Pnt(0, 1, 0), true);
    EXPECT_THAT([&] { Face::from_brep(brep(wire.Shape())); }, testing::ThrowsMessage<ToolError>(what("no face")));
    BRepBuilderAPI_Sewing sewing;
    sewing.Add(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 0, 1, 0, 1));
    sewing.Add(BRepBuilderAPI_MakeFace(gp_Pln(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0), gp_Dir(0, 1, 0))), 0, 1, 0, 1));
    sewing.Perform();
    EXPECT_THAT([&] { Face::from_brep(brep(sewing.SewedShape())); },
                testing::ThrowsMessage<ToolError>(what("cannot fold")));
}

TEST(Face, CracksAsThePlaneDoes) {
    const checks::Model model(read_inp(FEMSCALPEL_TEST_MESHES "/two_boxes.inp"), true);
    const checks::CutPlane plane{{6, 5, 5}, Vec3(1, 0.3, 0.2).normalized()};
    const gp_Pln pln(gp_Pnt(6, 5, 5), gp_Dir(1, 0.3, 0.2));
    const Face large = Face::from_brep(brep(BRepBuilderAPI_MakeFace(pln, -9, 9, -9, 9)));
    const Result result = crack(model.mesh, large);
    // Counted as "face", not as "plane".
    EXPECT_THAT(checks::check_crack(model, plane, result, "CRACK"),
                testing::Each(testing::HasSubstr("plane constraints are not as many")));
    EXPECT_GT(result.report.constraints.at("face"), 20);
    EXPECT_GE(result.report.quality_after.minimum, 0.3);
    CrackOptions deform;
    deform.method = Method::deform;
    EXPECT_THAT([&] { crack(model.mesh, large, deform); },
                testing::ThrowsMessage<ToolError>(testing::HasSubstr("snap")));
}

/// What a crack along a face that ends inside the material has to be.
struct FrontOfFace {
    double area;                        ///< of a lip
    std::vector<Vec3> nodes;            ///< of the front, in order
    std::size_t closed = 0, faces = 0;  ///< of the lip; closed: all its nodes are on both lips

    FrontOfFace(const Mesh& mesh, const Face& face, const Mesh& input) {
        mesh.validate();
        double volume = 0, before = 0;
        for (Index c = 0; c < mesh.block(CellType::tetra).size(); ++c) {
            const double v = cell_measure(mesh, CellType::tetra, c);
            EXPECT_GT(v, 0);
            volume += v;
        }
        for (Index c = 0; c < input.block(CellType::tetra).size(); ++c)
            before += cell_measure(input, CellType::tetra, c);
        EXPECT_NEAR(volume, before, 1e-9 * before);
        area = checks::group_sums(mesh)[*mesh.find_group("CRACK_P")].measure;
        EXPECT_NEAR(area, checks::group_sums(mesh)[*mesh.find_group("CRACK_N")].measure, 1e-9);
        const auto in_group = [&](CellType type, const char* name, auto visit) {
            const CellBlock& b = mesh.block(type);
            for (Index c = 0; c < b.size(); ++c)
                if (mesh.families.contains(b.families[c], *mesh.find_group(name))) visit(b.nodes(c));
        };
        std::set<std::set<Index>> positive;
        in_group(CellType::triangle, "CRACK_P", [&](const auto& n) {
            positive.insert({n.begin(), n.end()});
            for (const Index v : n) EXPECT_LT(std::abs(face.distance(mesh.points[v])), 1e-9);
        });
        faces = positive.size();
        in_group(CellType::triangle, "CRACK_N", [&](const auto& n) {
            closed += positive.contains({n.begin(), n.end()});
        });
        EXPECT_EQ(closed, 0) << "faces of the crack that cannot open";
        in_group(CellType::line, "CRACK_FRONT", [&](const auto& n) {
            if (nodes.empty()) nodes.push_back(mesh.points[n[0]]);
            EXPECT_EQ(nodes.back(), mesh.points[n[0]]) << "the front is not in order";
            nodes.push_back(mesh.points[n[1]]);
        });
    }
};

TEST(Face, ThatEndsInsideCracksUpToItsBorder) {
    const Mesh mesh = read_inp(FEMSCALPEL_TEST_MESHES "/two_boxes.inp");
    const gp_Pln pln(gp_Ax3(gp_Pnt(6, 5, 5), gp_Dir(1, 0.3, 0.2), gp_Dir(-0.3, 1, 0)));
    const Vec3 middle(6, 5, 5), normal = Vec3(1, 0.3, 0.2).normalized(), u = Vec3(-0.3, 1, 0).normalized(),
                                v = normal.cross(u);
    {
        SCOPED_TRACE("round");
        const Face face = Face::from_brep(brep(BRepBuilderAPI_MakeFace(
            pln, BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(pln.Position().Ax2(), 2.7))).Wire())));
        const Result result = crack(mesh, face);
        const FrontOfFace front(result.mesh, face, mesh);
        EXPECT_GT(front.nodes.size(), 12);
        EXPECT_EQ(front.nodes.front(), front.nodes.back()) << "the front is closed";
        for (const Vec3& x : front.nodes) EXPECT_NEAR((x - middle).norm(), 2.7, 1e-8);
        // The same as of the disk, the face's border being a disk's.
        CrackOptions options;
        const Disk disk(middle, 2.7);
        options.within = &disk;
        const Result same = crack(mesh, Plane(middle, normal), options);
        EXPECT_NEAR(front.area, checks::group_sums(same.mesh)[*same.mesh.find_group("CRACK_P")].measure, 1e-6);
        EXPECT_GE(result.report.quality_after.minimum, 0.1);
    }
    {
        SCOPED_TRACE("rectangle");
        const Face face = Face::from_brep(brep(BRepBuilderAPI_MakeFace(pln, -2.6, 2.6, -3.1, 3.1)));
        const Result result = crack(mesh, face);
        const FrontOfFace front(result.mesh, face, mesh);
        EXPECT_NEAR(front.area, 5.2 * 6.2, 1e-7);
        for (const int i : {-1, 1})
            for (const int j : {-1, 1}) {
                const Vec3 corner = middle + 2.6 * i * u + 3.1 * j * v;
                double nearest = 1;
                for (const Vec3& x : front.nodes) nearest = std::min(nearest, (x - corner).norm());
                EXPECT_LT(nearest, 1e-8) << "a corner of the face is a node of the front";
            }
        for (const Vec3& x : front.nodes) EXPECT_LT(std::abs(face.beyond(x)), 1e-8);
    }
    {
        // From outside to the middle: a straight front from skin to skin.
        SCOPED_TRACE("half in");
        const Face face = Face::from_brep(brep(BRepBuilderAPI_MakeFace(pln, -9, 0.4, -9, 9)));
        const Result result = crack(mesh, face);
        const FrontOfFace front(result.mesh, face, mesh);
        CrackOptions options;
        const HalfPlane half(middle + 0.4 * u, -u);
        options.within = &half;
        const Result same = crack(mesh, Plane(middle, normal), options);
        EXPECT_NEAR(front.area, checks::group_sums(same.mesh)[*same.mesh.find_group("CRACK_P")].measure, 1e-8);
        for (const Vec3& x : front.nodes) EXPECT_NEAR((x - middle).dot(u), 0.4, 1e-9);
    }
    {
        // Drawn in the CAD program to end in the skin, not beyond it.
        SCOPED_TRACE("flush with the skin");
        const gp_Pln level(gp_Ax3(gp_Pnt(0, 0, 4.4), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)));
        const Face face = Face::from_brep(brep(BRepBuilderAPI_MakeFace(level, 0, 7.3, 0, 10)));
        const Result result = crack(mesh, face);
        const FrontOfFace front(result.mesh, face, mesh);
        EXPECT_NEAR(front.area, 73, 1e-8);
        for (const Vec3& x : front.nodes) EXPECT_NEAR(x.x(), 7.3, 1e-9);
        EXPECT_NEAR(std::abs(front.nodes.front().y() - front.nodes.back().y()), 10, 1e-9);
    }
    {
        SCOPED_TRACE("part of a cylinder");
        const Face face = Face::from_brep(brep(BRepBuilderAPI_MakeFace(gp_Cylinder(frame, 3), 1.2, 3.2, -2.5, 2.5)));
        const Result result = crack(mesh, face);
        const FrontOfFace front(result.mesh, face, mesh);
        EXPECT_GT(front.area, 0.93 * 2 * 3 * 5);
        EXPECT_LT(front.area, 2 * 3 * 5);
        for (const Vec3& x : front.nodes) EXPECT_LT(std::abs(face.beyond(x)), 1e-8);
    }
}

TEST(Face, CracksAlongASpline) {
    const Mesh mesh = read_inp(FEMSCALPEL_TEST_MESHES "/two_boxes.inp");
    TColgp_Array2OfPnt points(1, 9, 1, 9);
    for (int i = 1; i <= 9; ++i)
        for (int j = 1; j <= 9; ++j) points.SetValue(i, j, gp_Pnt(6 + 0.6 * std::sin(0.5 * i), 2 * i - 5, 2 * j - 5));
    const Face face =
        Face::from_brep(brep(BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(points).Surface(), 1e-6)));
    const Result result = crack(mesh, face);
    EXPECT_GE(result.report.quality_after.minimum, 0.25);
    const auto sums = checks::group_sums(result.mesh);
    EXPECT_NEAR(sums[*result.mesh.find_group("CRACK_P")].measure, sums[*result.mesh.find_group("CRACK_N")].measure,
                1e-9);
    EXPECT_GT(sums[*result.mesh.find_group("CRACK_P")].measure, 100);
    EXPECT_LT(sums[*result.mesh.find_group("CRACK_P")].measure, 115);
    EXPECT_TRUE(std::ranges::none_of(result.mesh.groups, [](const Group& g) { return g.name == "CRACK_FRONT"; }))
        << "it is cut through";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
