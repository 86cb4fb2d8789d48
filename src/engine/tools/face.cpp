// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/face.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_Surface.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <sstream>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "error.h"

namespace femscalpel {
namespace {

using Point = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

Point point(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

/// Faces that meet at more than this, in degrees, fold the surface.
constexpr double smooth_angle = 20;

/// One surface of the shape, without its border.
struct Sheet {
    Handle(Geom_Surface) surface;
    bool reversed;
    double low[2], high[2];  // parameters it is defined for; infinite where it goes on for ever
};

/// A triangle of the coarse picture that finds the sheet and a place on it to start from.
struct Triangle {
    int sheet;
    std::array<Point, 3> corner;
    std::array<Eigen::Vector2d, 3> uv;
};

/// A piece of the border, from parameter `from` to `to` of an edge.
struct BorderPiece {
    int edge;
    double from, to;
    Point start, end;
};

struct Place {
    Point at;
    Point normal;
};

/// Closest point of a triangle as weights of its corners.
Point weights_on(const Triangle& t, const Point& x) {
    const Point ab = t.corner[1] - t.corner[0], ac = t.corner[2] - t.corner[0], ax = x - t.corner[0];
    const double aa = ab.dot(ab), ad = ab.dot(ac), dd = ac.dot(ac), bx = ab.dot(ax), cx = ac.dot(ax), det = aa * dd - ad * ad;
    if (det > 0) {
        const double v = (dd * bx - ad * cx) / det, w = (aa * cx - ad * bx) / det;
        if (v >= 0 && w >= 0 && v + w <= 1) return {1 - v - w, v, w};
    }
    Point best(1, 0, 0);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const Point &a = t.corner[k], &b = t.corner[(k + 1) % 3];
        const double length = (b - a).squaredNorm(), s = length > 0 ? std::clamp((b - a).dot(x - a) / length, 0.0, 1.0) : 0;
        const double distance = (a + s * (b - a) - x).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        best.setZero();
        best[k] = 1 - s;
        best[(k + 1) % 3] = s;
    }
    return best;
}

Point at(const Triangle& t, const Point& weights) { return weights[0] * t.corner[0] + weights[1] * t.corner[1] + weights[2] * t.corner[2]; }

struct NearestTriangle {
    using Scalar = double;
    const std::vector<Triangle>& triangles;
    const Point& x;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();

    double minimumOnVolume(const Box& box) const { return box.squaredExteriorDistance(x); }
    double minimumOnObject(int t) {
        const double d = (at(triangles[t], weights_on(triangles[t], x)) - x).squaredNorm();
        if (d < least) {
            least = d;
            best = t;
        }
        return d;
    }
};

}  // namespace

struct Face::Geometry {
    std::vector<Sheet> sheets;
    std::vector<Triangle> triangles;
    Eigen::KdBVH<double, 3, int> tree;
    std::vector<BRepAdaptor_Curve> border;
    std::vector<char> border_reversed;
    std::vector<BorderPiece> pieces;
    Box box;
    Point mean_normal = Point::Zero();
    double feature_size = std::numeric_limits<double>::infinity();

    explicit Geometry(const TopoDS_Shape& shape) {
        Bnd_Box bounds;
        BRepBndLib::Add(shape, bounds);
        TopExp_Explorer faces(shape, TopAbs_FACE);
        if (!faces.More() || bounds.IsVoid()) throw ToolError("face: the shape has no face");
        const double size = std::sqrt(bounds.SquareExtent());
        BRepTools::Clean(shape);
        BRepMesh_IncrementalMesh(shape, 1e-3 * size, false, 0.1);
        for (; faces.More(); faces.Next()) add_sheet(TopoDS::Face(faces.Current()));
        if (triangles.empty()) throw ToolError("face: the shape's faces cannot be divided into triangles; check its geometry in the CAD program");
        std::vector<int> order;
        std::vector<Box> boxes;
        for (const Triangle& t : triangles) {
            order.push_back(static_cast<int>(order.size()));
            Box b;
            for (const Point& p : t.corner) b.extend(p);
            boxes.push_back(b);
            box.extend(b);
        }
        tree.init(order.begin(), order.end(), boxes.begin(), boxes.end());
        find_border(shape);
    }

    /// A point farther away than the face is large.
    bool is_far(const Point& x) const { return box.exteriorDistance(x) > 0.5 * box.diagonal().norm(); }

    /// The point of the sheet near `x` closest to it, on the surface as it goes on beyond the border.
    Place foot(const Point& x) const {
        NearestTriangle search{triangles, x};
        Eigen::BVMinimize(tree, search);
        const Triangle& t = triangles[search.best];
        const Point w = weights_on(t, x);
        const Sheet& s = sheets[t.sheet];
        Eigen::Vector2d uv = w[0] * t.uv[0] + w[1] * t.uv[1] + w[2] * t.uv[2];
        gp_Pnt p;
        gp_Vec su, sv, suu, svv, suv;
        for (int iteration = 0; iteration < 30; ++iteration) {
            s.surface->D2(uv[0], uv[1], p, su, sv, suu, svv, suv);
            const gp_Vec r(gp_Pnt(x[0], x[1], x[2]), p);
            Eigen::Vector2d slope(r * su, r * sv);
            Eigen::Matrix2d h;
            h << su * su + r * suu, su * sv + r * suv, su * sv + r * suv, sv * sv + r * svv;
            if (!(h(0, 0) > 0 && h.determinant() > 1e-12 * h(0, 0) * h(1, 1))) h << su * su, su * sv, su * sv, sv * sv;
            // Where the surface ends, it can only be followed along its end.
            for (int k = 0; k < 2; ++k)
                if ((uv[k] <= s.low[k] && slope[k] > 0) || (uv[k] >= s.high[k] && slope[k] < 0)) {
                    h(0, 1) = h(1, 0) = 0;
                    slope[k] = 0;
                }
            const Eigen::Vector2d before = uv;
            uv -= h.inverse() * slope;
            for (int k = 0; k < 2; ++k) uv[k] = std::clamp(uv[k], s.low[k], s.high[k]);
            if (!uv.allFinite()) {
                uv = before;
                break;
            }
            const Eigen::Vector2d step = uv - before;
            if (std::abs(step[0]) * su.Magnitude() + std::abs(step[1]) * sv.Magnitude() < 1e-14 * box.diagonal().norm()) break;
        }
        s.surface->D1(uv[0], uv[1], p, su, sv);
        Point normal = point(su.Crossed(sv).XYZ());
        const double length = normal.norm();
        if (length > 1e-14 * su.Magnitude() * sv.Magnitude()) normal *= (s.reversed ? -1 : 1) / length;
        else normal = (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]).normalized();  // a pole; the picture's normal will do
        return {point(p.XYZ()), normal};
    }

    /// Signed distance from a point on the surface to the border; positive beyond it.
    double beyond(const Place& foot) const {
        double least = std::numeric_limits<double>::infinity();
        Point left = Point::Zero(), closest = Point::Zero();
        const double close = 1e-9 * box.diagonal().norm();
        for (const BorderPiece& piece : pieces) {
            const Point along = piece.end - piece.start;
            const double length = along.squaredNorm(), s = length > 0 ? std::clamp(along.dot(foot.at - piece.start) / length, 0.0, 1.0) : 0;
            // The chord is off the curve by less than its own length.
            if ((piece.start + s * along - foot.at).norm() > least + std::sqrt(length)) continue;
            const BRepAdaptor_Curve& curve = border[piece.edge];
            double t = piece.from + s * (piece.to - piece.from);
            gp_Pnt p;
            gp_Vec d, dd;
            for (int iteration = 0; iteration < 12; ++iteration) {
                curve.D2(t, p, d, dd);
                const gp_Vec r(gp_Pnt(foot.at[0], foot.at[1], foot.at[2]), p);
                double curvature = d * d + r * dd;
                if (!(curvature > 0)) curvature = d * d;
                if (!(curvature > 0)) break;
                const double next = std::clamp(t - (r * d) / curvature, piece.from, piece.to);
                if (std::abs(next - t) * d.Magnitude() < 1e-14 * box.diagonal().norm()) break;
                t = next;
            }
            curve.D1(t, p, d);
            const Point at = point(p.XYZ());
            const double distance = (at - foot.at).norm();
            if (distance > least + close) continue;
            const Point tangent = point(d.XYZ()) * (border_reversed[piece.edge] ? -1 : 1);
            const Point inside = foot.normal.cross(tangent).normalized();
            // In a corner of the border several pieces are as near; together their directions tell inside from outside.
            if (distance < least - close) left.setZero();
            left += inside;
            if (distance < least) {
                least = distance;
                closest = at;
            }
        }
        return (foot.at - closest).dot(left) >= 0 ? -least : least;
    }

private:
    void add_sheet(const TopoDS_Face& face) {
        TopLoc_Location location;
        const Handle(Poly_Triangulation) picture = BRep_Tool::Triangulation(face, location);
        if (picture.IsNull() || !picture->HasUVNodes()) return;
        Sheet sheet{BRep_Tool::Surface(face), face.Orientation() == TopAbs_REVERSED, {}, {}};
        // Without the bounds that some files give their surfaces: beyond the border it goes on.
        if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(sheet.surface); !trimmed.IsNull()) sheet.surface = trimmed->BasisSurface();
        double bounds[4];
        sheet.surface->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
        const bool periodic[2] = {static_cast<bool>(sheet.surface->IsUPeriodic()), static_cast<bool>(sheet.surface->IsVPeriodic())};
        for (int k = 0; k < 2; ++k) {
            const double infinity = std::numeric_limits<double>::infinity();
            const bool ends = !periodic[k];
            sheet.low[k] = ends && !Precision::IsInfinite(bounds[2 * k]) ? bounds[2 * k] : -infinity;
            sheet.high[k] = ends && !Precision::IsInfinite(bounds[2 * k + 1]) ? bounds[2 * k + 1] : infinity;
        }
        const int index = static_cast<int>(sheets.size());
        const gp_Trsf transform = location.Transformation();
        for (int k = 1; k <= picture->NbTriangles(); ++k) {
            int n[3];
            picture->Triangle(k).Get(n[0], n[1], n[2]);
            if (sheet.reversed) std::swap(n[1], n[2]);
            Triangle t{index, {}, {}};
            for (int c = 0; c < 3; ++c) {
                t.corner[c] = point(picture->Node(n[c]).Transformed(transform).XYZ());
                const gp_Pnt2d uv = picture->UVNode(n[c]);
                t.uv[c] = {uv.X(), uv.Y()};
            }
            const Point area = (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]);
            mean_normal += area;
            triangles.push_back(t);
        }
        for (int k = 1; k <= picture->NbNodes(); ++k) {
            const gp_Pnt2d uv = picture->UVNode(k);
            GeomLProp_SLProps properties(sheet.surface, uv.X(), uv.Y(), 2, 1e-12);
            if (!properties.IsCurvatureDefined()) continue;
            const double curvature = std::max(std::abs(properties.MaxCurvature()), std::abs(properties.MinCurvature()));
            if (curvature > 0) feature_size = std::min(feature_size, 1 / curvature);
        }
        if (feature_size > 1e9 * box_size(picture)) feature_size = std::numeric_limits<double>::infinity();  // rounding of a plane
        sheets.push_back(std::move(sheet));
    }

    static double box_size(const Handle(Poly_Triangulation)& picture) {
        Box b;
        for (int k = 1; k <= picture->NbNodes(); ++k) b.extend(point(picture->Node(k).XYZ()));
        return b.diagonal().norm();
    }

    void find_border(const TopoDS_Shape& shape) {
        TopTools_IndexedDataMapOfShapeListOfShape faces_of;
        TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of);
        for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) {
            const TopoDS_Face face = TopoDS::Face(f.Current());
            for (TopExp_Explorer e(face, TopAbs_EDGE); e.More(); e.Next()) {
                const TopoDS_Edge edge = TopoDS::Edge(e.Current());
                if (BRep_Tool::Degenerated(edge) || BRep_Tool::IsClosed(edge, face)) continue;
                TopoDS_Face other;
                for (const TopoDS_Shape& s : faces_of.FindFromKey(edge))
                    if (!s.IsSame(face)) other = TopoDS::Face(s);
                if (!other.IsNull()) {
                    check_smooth(edge, face, other);
                    continue;
                }
                const int index = static_cast<int>(border.size());
                border.emplace_back(edge);
                border_reversed.push_back(edge.Orientation() == TopAbs_REVERSED);
                const BRepAdaptor_Curve& curve = border.back();
                const bool straight = curve.GetType() == GeomAbs_Line;
                const int count = straight ? 1 : 48;
                for (int k = 0; k < count; ++k) {
                    const double from = curve.FirstParameter() + k * (curve.LastParameter() - curve.FirstParameter()) / count;
                    const double to = curve.FirstParameter() + (k + 1) * (curve.LastParameter() - curve.FirstParameter()) / count;
                    pieces.push_back({index, from, to, point(curve.Value(from).XYZ()), point(curve.Value(to).XYZ())});
                }
            }
        }
    }

    /// Throws ToolError when two faces meet in an edge at an angle.
    static void check_smooth(const TopoDS_Edge& edge, const TopoDS_Face& face, const TopoDS_Face& other) {
        double first = 0, last = 0;
        BRep_Tool::Range(edge, first, last);
        for (const double share : {0.1, 0.5, 0.9}) {
            const double t = first + share * (last - first);
            Point at, normal[2];
            int k = 0;
            for (const TopoDS_Face& f : {face, other}) {
                double from = 0, to = 0;
                const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, f, from, to);
                if (curve.IsNull()) return;
                const gp_Pnt2d uv = curve->Value(t);
                gp_Pnt p;
                gp_Vec su, sv;
                BRep_Tool::Surface(f)->D1(uv.X(), uv.Y(), p, su, sv);
                at = point(p.XYZ());
                normal[k++] = point(su.Crossed(sv).XYZ()).normalized() * (f.Orientation() == TopAbs_REVERSED ? -1 : 1);
            }
            const double angle = std::acos(std::clamp(normal[0].dot(normal[1]), -1.0, 1.0)) * 180 / std::numbers::pi;
            if (!(angle > smooth_angle)) continue;
            std::ostringstream message;
            message << "face: its faces meet at " << angle << " degrees near (" << at.transpose()
                    << "); one surface cannot fold. Take the faces one after the other";
            throw ToolError(message.str());
        }
    }
};

Face::Face(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
Face::~Face() = default;

Face Face::read(const std::filesystem::path& path) {
    std::string suffix = path.extension().string();
    for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const std::string name = path.string();
    if (!std::filesystem::is_regular_file(path)) throw ReadError("'" + name + "' is not a file");
    TopoDS_Shape shape;
    try {
        if (suffix == ".step" || suffix == ".stp") {
            STEPControl_Reader reader;
            if (reader.ReadFile(name.c_str()) != IFSelect_RetDone) throw ReadError("'" + name + "' is not a STEP file that OpenCASCADE can read");
            reader.TransferRoots();
            shape = reader.OneShape();
        } else if (suffix == ".brep" || suffix == ".brp") {
            BRep_Builder builder;
            if (!BRepTools::Read(shape, name.c_str(), builder)) throw ReadError("'" + name + "' is not a BREP file that OpenCASCADE can read");
        } else {
            throw ReadError("'" + name + "': the suffix is '" + suffix + "'; faces are read from .step, .stp, .brep and .brp files");
        }
        if (shape.IsNull()) throw ReadError("'" + name + "' holds no shape");
        return Face(std::make_shared<const Geometry>(shape));
    } catch (const Standard_Failure& e) {
        throw ReadError("'" + name + "': OpenCASCADE says: " + e.GetMessageString());
    }
}

Face Face::from_brep(const std::string& text) {
    TopoDS_Shape shape;
    try {
        std::istringstream stream(text);
        BRep_Builder builder;
        BRepTools::Read(shape, stream, builder);
        if (shape.IsNull()) throw ToolError("face: the text is not a BREP shape");
        return Face(std::make_shared<const Geometry>(shape));
    } catch (const Standard_Failure& e) {
        throw ToolError(std::string("face: OpenCASCADE says: ") + e.GetMessageString());
    }
}

double Face::distance(const Eigen::Vector3d& x) const {
    const Geometry& g = *geometry_;
    if (g.is_far(x)) return std::copysign(g.box.exteriorDistance(x), g.mean_normal.dot(x - g.box.center()));
    const Place foot = g.foot(x);
    return foot.normal.dot(x - foot.at);
}

Eigen::Vector3d Face::normal(const Eigen::Vector3d& x) const { return geometry_->foot(x).normal; }

Eigen::Vector3d Face::project(const Eigen::Vector3d& x) const {
    const Place foot = geometry_->foot(x);
    return x - foot.normal.dot(x - foot.at) * foot.normal;
}

double Face::feature_size() const { return geometry_->feature_size; }

bool Face::bounded() const { return !geometry_->pieces.empty(); }

double Face::beyond(const Eigen::Vector3d& x) const {
    if (!bounded()) return -std::numeric_limits<double>::infinity();
    if (geometry_->is_far(x)) return geometry_->box.exteriorDistance(x);
    Place foot = geometry_->foot(x);
    foot.at = x - foot.normal.dot(x - foot.at) * foot.normal;
    return geometry_->beyond(foot);
}

int Face::face_count() const { return static_cast<int>(geometry_->sheets.size()); }

}  // namespace femscalpel
