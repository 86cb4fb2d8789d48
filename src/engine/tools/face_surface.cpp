// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/face_surface.h"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "error.h"
#include "tools/occ_point.h"

namespace femscalpel {
namespace {

using Point = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;
using Triangle = FaceSurface::Triangle;

/// The coarse picture of a face is off it by less than this, in sizes of the face.
constexpr double picture_sag = 1e-3;

/// Closest point of a triangle as weights of its corners.
Point weights_on(const Triangle& t, const Point& x) {
    const Point ab = t.corner[1] - t.corner[0], ac = t.corner[2] - t.corner[0], ax = x - t.corner[0];
    const double aa = ab.dot(ab), ad = ab.dot(ac), dd = ac.dot(ac), bx = ab.dot(ax), cx = ac.dot(ax),
                 det = aa * dd - ad * ad;
    if (det > 0) {
        const double v = (dd * bx - ad * cx) / det, w = (aa * cx - ad * bx) / det;
        if (v >= 0 && w >= 0 && v + w <= 1) return {1 - v - w, v, w};
    }
    Point best(1, 0, 0);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const Point &a = t.corner[k], &b = t.corner[(k + 1) % 3];
        const double length = (b - a).squaredNorm(),
                     s = length > 0 ? std::clamp((b - a).dot(x - a) / length, 0.0, 1.0) : 0;
        const double distance = (a + s * (b - a) - x).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        best.setZero();
        best[k] = 1 - s;
        best[(k + 1) % 3] = s;
    }
    return best;
}

Point at(const Triangle& t, const Point& weights) {
    return weights[0] * t.corner[0] + weights[1] * t.corner[1] + weights[2] * t.corner[2];
}

struct NearestTriangle {
    using Scalar = double;
    const std::vector<Triangle>& triangles;
    const Point& x;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();

    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVMinimize() calls them.
    double minimumOnVolume(const Box& box) const { return box.squaredExteriorDistance(x); }
    double minimumOnObject(int t) {
        const double d = (at(triangles[t], weights_on(triangles[t], x)) - x).squaredNorm();
        if (d < least) {
            least = d;
            best = t;
        }
        return d;
    }
    // NOLINTEND(readability-identifier-naming)
};

double size_of(const Poly_Triangulation& picture) {
    Box b;
    for (int k = 1; k <= picture.NbNodes(); ++k) b.extend(to_vector(picture.Node(k).XYZ()));
    return b.diagonal().norm();
}

/// One of Newton's steps in the parameters `uv` of a surface towards the point closest to `x`, and how far the surface
/// is followed by it.
struct Step {
    Eigen::Vector2d uv;
    double length;
};
Step newton_step(const Geom_Surface& surface, const double (&low)[2], const double (&high)[2],
                 const Eigen::Vector2d& before, const Point& x) {
    gp_Pnt p;
    gp_Vec su, sv, suu, svv, suv;
    surface.D2(before[0], before[1], p, su, sv, suu, svv, suv);
    const gp_Vec r(gp_Pnt(x[0], x[1], x[2]), p);
    Eigen::Vector2d slope(r * su, r * sv);
    Eigen::Matrix2d h;
    h << su * su + r * suu, su * sv + r * suv, su * sv + r * suv, sv * sv + r * svv;
    if (!(h(0, 0) > 0 && h.determinant() > 1e-12 * h(0, 0) * h(1, 1))) h << su * su, su * sv, su * sv, sv * sv;
    // Where the surface ends, it can only be followed along its end.
    for (int k = 0; k < 2; ++k)
        if ((before[k] <= low[k] && slope[k] > 0) || (before[k] >= high[k] && slope[k] < 0)) {
            h(0, 1) = h(1, 0) = 0;
            slope[k] = 0;
        }
    Eigen::Vector2d uv = before;
    uv -= h.inverse() * slope;
    for (int k = 0; k < 2; ++k) uv[k] = std::clamp(uv[k], low[k], high[k]);
    if (!uv.allFinite()) return {before, 0};
    const Eigen::Vector2d step = uv - before;
    return {uv, std::abs(step[0]) * su.Magnitude() + std::abs(step[1]) * sv.Magnitude()};
}

}  // namespace

FaceSurface::FaceSurface(const TopoDS_Shape& shape) {
    Bnd_Box bounds;
    BRepBndLib::Add(shape, bounds);
    TopExp_Explorer faces(shape, TopAbs_FACE);
    if (!faces.More() || bounds.IsVoid()) throw ToolError("face: the shape has no face", "source");
    const double size = std::sqrt(bounds.SquareExtent());
    BRepTools::Clean(shape);
    const BRepMesh_IncrementalMesh pictures(shape, picture_sag * size, false, 0.1);
    for (; faces.More(); faces.Next()) add_sheet(TopoDS::Face(faces.Current()));
    if (triangles_.empty())
        throw ToolError(
            "face: the shape's faces cannot be divided into triangles; check its geometry in the CAD program",
            "source");
    grow_tree();
}

void FaceSurface::grow_tree() {
    std::vector<int> order;
    std::vector<Box> boxes;
    for (const Triangle& t : triangles_) {
        order.push_back(static_cast<int>(order.size()));
        Box b;
        for (const Point& p : t.corner) b.extend(p);
        boxes.push_back(b);
        box_.extend(b);
    }
    size_ = box_.diagonal().norm();
    tree_.init(order.begin(), order.end(), boxes.begin(), boxes.end());
}

FacePlace FaceSurface::foot(const Point& x) const {
    NearestTriangle search{triangles_, x};
    Eigen::BVMinimize(tree_, search);
    const Triangle& t = triangles_[search.best];
    const Point w = weights_on(t, x);
    const Sheet& s = sheets_[t.sheet];
    Eigen::Vector2d uv = w[0] * t.uv[0] + w[1] * t.uv[1] + w[2] * t.uv[2];
    for (int iteration = 0; iteration < 30; ++iteration) {
        const Step step = newton_step(*s.surface, s.low, s.high, uv, x);
        uv = step.uv;
        if (step.length < 1e-14 * size_) break;
    }
    gp_Pnt p;
    gp_Vec su, sv;
    s.surface->D1(uv[0], uv[1], p, su, sv);
    Point normal = to_vector(su.Crossed(sv).XYZ());
    const double length = normal.norm();
    if (length > 1e-14 * su.Magnitude() * sv.Magnitude())
        normal *= (s.reversed ? -1 : 1) / length;
    else
        normal = (t.corner[1] - t.corner[0])
                     .cross(t.corner[2] - t.corner[0])
                     .normalized();  // a pole; the picture's normal will do
    return {to_vector(p.XYZ()), normal};
}

FacePlace FaceSurface::level_foot(const Point& x) const {
    FacePlace out = foot(x);
    out.at = x - out.normal.dot(x - out.at) * out.normal;
    return out;
}

bool FaceSurface::is_off_picture(const Point& x) const {
    NearestTriangle search{triangles_, x};
    Eigen::BVMinimize(tree_, search);
    return search.least > std::pow(5 * picture_sag * size_, 2);
}

void FaceSurface::add_sheet(const TopoDS_Face& face) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) picture = BRep_Tool::Triangulation(face, location);
    if (picture.IsNull() || !picture->HasUVNodes()) return;
    Sheet sheet{BRep_Tool::Surface(face), face.Orientation() == TopAbs_REVERSED, {}, {}};
    // Without the bounds that some files give their surfaces: beyond the border it goes on.
    if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(sheet.surface); !trimmed.IsNull())
        sheet.surface = trimmed->BasisSurface();
    double bounds[2][2];
    sheet.surface->Bounds(bounds[0][0], bounds[0][1], bounds[1][0], bounds[1][1]);
    const bool periodic[2] = {static_cast<bool>(sheet.surface->IsUPeriodic()),
                              static_cast<bool>(sheet.surface->IsVPeriodic())};
    for (int k = 0; k < 2; ++k) {
        const double infinity = std::numeric_limits<double>::infinity();
        const bool ends = !periodic[k];
        sheet.low[k] = ends && !Precision::IsInfinite(bounds[k][0]) ? bounds[k][0] : -infinity;
        sheet.high[k] = ends && !Precision::IsInfinite(bounds[k][1]) ? bounds[k][1] : infinity;
    }
    add_triangles(*picture, location.Transformation(), sheet.reversed);
    find_feature_size(*picture, sheet.surface);
    sheets_.push_back(std::move(sheet));
}

void FaceSurface::add_triangles(const Poly_Triangulation& picture, const gp_Trsf& transform, bool reversed) {
    for (int k = 1; k <= picture.NbTriangles(); ++k) {
        int n[3];
        picture.Triangle(k).Get(n[0], n[1], n[2]);
        if (reversed) std::swap(n[1], n[2]);
        Triangle t{static_cast<int>(sheets_.size()), {}, {}};
        for (int c = 0; c < 3; ++c) {
            t.corner[c] = to_vector(picture.Node(n[c]).Transformed(transform).XYZ());
            const gp_Pnt2d uv = picture.UVNode(n[c]);
            t.uv[c] = {uv.X(), uv.Y()};
        }
        const Point area = (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]);
        mean_normal_ += area;
        triangles_.push_back(t);
    }
}

void FaceSurface::find_feature_size(const Poly_Triangulation& picture, const Handle(Geom_Surface) & surface) {
    for (int k = 1; k <= picture.NbNodes(); ++k) {
        const gp_Pnt2d uv = picture.UVNode(k);
        GeomLProp_SLProps properties(surface, uv.X(), uv.Y(), 2, 1e-12);
        if (!properties.IsCurvatureDefined()) continue;
        const double curvature = std::max(std::abs(properties.MaxCurvature()), std::abs(properties.MinCurvature()));
        if (curvature > 0) feature_size_ = std::min(feature_size_, 1 / curvature);
    }
    if (feature_size_ > 1e9 * size_of(picture))
        feature_size_ = std::numeric_limits<double>::infinity();  // rounding of a plane
}

}  // namespace femscalpel
