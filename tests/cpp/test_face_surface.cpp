// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/face_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>

#include <cmath>
#include <numbers>

#include "error.h"
#include "tools/occ_point.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using Eigen::Vector3d;

TEST(FaceSurface, OfARectangleGoesOnAsItsPlane) {
    const FaceSurface surface(BRepBuilderAPI_MakeFace(gp_Pln(), -1, 1, -2, 2).Face());
    EXPECT_EQ(surface.face_count(), 1);
    EXPECT_NEAR(surface.size(), std::sqrt(20.0), 1e-6);
    EXPECT_LT((surface.box().min() - Vector3d(-1, -2, 0)).norm(), 1e-6);
    EXPECT_LT((surface.mean_normal().normalized() - Vector3d(0, 0, 1)).norm(), 1e-12);
    EXPECT_TRUE(std::isinf(surface.feature_size()));
    const FacePlace foot = surface.foot({5, 0.5, 3});
    EXPECT_LT((foot.at - Vector3d(5, 0.5, 0)).norm(), 1e-12);
    EXPECT_LT((foot.normal - Vector3d(0, 0, 1)).norm(), 1e-12);
    EXPECT_FALSE(surface.is_far({5, 0, 3}));
    EXPECT_TRUE(surface.is_far({50, 0, 3}));
    EXPECT_TRUE(surface.is_off_picture({5, 0, 0}));
    EXPECT_FALSE(surface.is_off_picture({0.5, 1, 0}));
}

TEST(FaceSurface, OfACylinderIsCurved) {
    const gp_Cylinder cylinder(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 2);
    const FaceSurface surface(BRepBuilderAPI_MakeFace(cylinder, 0, std::numbers::pi / 2, 0, 3).Face());
    EXPECT_NEAR(surface.feature_size(), 2, 1e-9);
    const FacePlace foot = surface.foot({3, 4, 1});
    EXPECT_LT((foot.at - Vector3d(1.2, 1.6, 1)).norm(), 1e-9);
    EXPECT_LT((foot.normal - Vector3d(0.6, 0.8, 0)).norm(), 1e-9);
}

TEST(FaceSurface, NeedsAFace) {
    TopoDS_Compound nothing;
    BRep_Builder().MakeCompound(nothing);
    EXPECT_THAT([&] { FaceSurface{nothing}; }, testing::Throws<ToolError>());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
