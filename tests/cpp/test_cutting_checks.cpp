// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <TopoDS_Shape.hxx>

#include <sstream>

#include "simple_meshes.h"
#include "tools/cad_shape.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Plane plane({1, 0, 0}, {1, 0, 0});

TEST(CheckShape, RefusesInvertedElements) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    EXPECT_NO_THROW(check_shape(f, mesh));
    f.d.band.nodes[node_at(f.d.band, {0, 0, 0})].at = {1.2, 1.1, 1.3};
    EXPECT_THAT([&] { check_shape(f, mesh); },
                testing::ThrowsMessage<QualityError>(AllOf(HasSubstr("6 elements would be flat or inverted"),
                                                           HasSubstr("elements 100, 101, 102, 103, 104, ..."))));
}

TEST(CheckShape, RefusesFoldedSecondOrderElements) {
    const Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
    Workpiece f = checks::whole_workpiece(mesh, plane);
    EXPECT_NO_THROW(check_shape(f, mesh));
    f.d.mids.set_bulge(node_at(f.d.band, {1, 1, 1}), node_at(f.d.band, {2, 1, 1}), Vec3(0.3, 0, 0));
    EXPECT_THAT([&] { check_shape(f, mesh); },
                testing::ThrowsMessage<QualityError>(HasSubstr("6 second-order elements would be folded")));
}

TEST(CheckContacts, RefusesNodesOffTheirTool) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    find_node_sets(f);
    EXPECT_NO_THROW(check_contacts(f));
    BandNode& middle = f.d.band.nodes[node_at(f.d.band, {1, 1, 1})];
    middle.at.x() = 1 + 5 * f.tolerance;
    EXPECT_NO_THROW(check_contacts(f)) << "within ten tolerances";
    middle.at.x() = 1.25;
    EXPECT_THAT(
        [&] { check_contacts(f); },
        testing::ThrowsMessage<QualityError>(HasSubstr("1 node cannot be brought onto the plane (off by up to 0.25)")));
}

TEST(CheckInputShape, RefusesInvertedElementsOfTheInput) {
    Mesh mesh = checks::grid(1, 1, 1);
    std::swap(mesh.block(CellType::tetra).connectivity[0], mesh.block(CellType::tetra).connectivity[1]);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    EXPECT_THAT([&] { check_input_shape(f, mesh); },
                testing::ThrowsMessage<QualityError>(
                    HasSubstr("the mesh already has 1 flat or inverted element near the tool (element 100)")));
}

TEST(CheckInputShape, WarnsOfPoorElementsOfTheInput) {
    Mesh mesh = checks::grid(1, 1, 1);
    Workpiece good = checks::whole_workpiece(mesh, plane);
    check_input_shape(good, mesh);
    EXPECT_THAT(good.warnings, IsEmpty());
    for (Vec3& x : mesh.points) x.z() *= 0.01;
    Workpiece flat = checks::whole_workpiece(mesh, plane);
    check_input_shape(flat, mesh);
    EXPECT_THAT(flat.warnings, ElementsAre(HasSubstr("6 elements with mean ratio below 0.1")));
}

/// The block's workpiece, with the shape that it is said to have been made from.
Workpiece shaped(const Mesh& mesh, const CadShape& shape) {
    ConstraintOptions options;
    options.shape = &shape;
    options.tolerance = 1e-9;
    return {.d = Deformable(extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0)), mesh, options),
            .tool = &plane,
            .tolerance = 1e-9};
}

CadShape box(const gp_Pnt& corner, double dx, double dy, double dz) {
    std::ostringstream text;
    BRepTools::Write(BRepPrimAPI_MakeBox(corner, dx, dy, dz).Shape(), text);
    return CadShape::from_brep(text.str());
}

TEST(CheckSkin, ComparesTheSkinWithTheGivenShape) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const CadShape same = box({0, 0, 0}, 2, 2, 2), higher = box({0, 0, 0}, 2, 2, 3), other = box({10, 0, 0}, 2, 2, 2);
    Workpiece f = shaped(mesh, same);
    check_skin(f);
    EXPECT_THAT(f.warnings, IsEmpty());
    Workpiece g = shaped(mesh, higher);
    check_skin(g);
    EXPECT_THAT(g.warnings, ElementsAre(HasSubstr("8 of 48 faces of the mesh's skin near the tool lie on no face")));
    Workpiece h = shaped(mesh, other);
    EXPECT_THAT([&] { check_skin(h); },
                testing::ThrowsMessage<ToolError>(HasSubstr("none of the 48 faces of the mesh's skin")));
}

TEST(CheckExtent, KnowsWhatDoublesCanTell) {
    const auto changed = [](double scale, double shift) {
        Mesh mesh = checks::grid(2, 2, 2);
        for (Vec3& x : mesh.points) x = scale * x + Vec3(shift, 0, 0);
        return mesh;
    };
    for (const auto& [scale, shift] : {std::pair(1.0, 0.0), {1.0, 1e7}, {1e-20, 0.0}, {1e20, 0.0}})
        EXPECT_NO_THROW(check_extent(changed(scale, shift))) << scale << " " << shift;
    const auto refused = [&](double scale, double shift, const char* why) {
        EXPECT_THAT([&] { check_extent(changed(scale, shift)); }, testing::ThrowsMessage<QualityError>(HasSubstr(why)));
    };
    for (const double scale : {1e-200, 1e-100, 1e-40, 1e40, 1e160}) refused(scale, 0, "Give it in another unit");
    for (const double shift : {1e8, -1e12}) refused(1, shift, "Move it to the origin first");
    EXPECT_NO_THROW(check_extent(Mesh()));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
