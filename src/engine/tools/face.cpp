// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/face.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_Surface.hxx>
#include <Poly_Triangulation.hxx>
#include <Precision.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "error.h"
#include "tools/cad_file.h"

namespace femscalpel {
namespace {

using Point = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

Point point(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

/// Faces that meet at more than this, in degrees, fold the surface.
constexpr double smooth_angle = 20;

/// The coarse picture of a face is off it by less than this, in sizes of the face.
constexpr double picture_sag = 1e-3;

/// Edges of the border that meet at more than this, in degrees, make a corner of it.
constexpr double corner_angle = 1;

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

/// Edges of the border that follow each other without a corner.
struct Chain {
    /// Its ends, with the direction of the border there; none if it is closed.
    struct End {
        Point at, tangent;
        int neighbour;  // the chain that goes on there, or -1
    };
    std::vector<End> ends;  // where it begins, where it ends
    double least_radius = std::numeric_limits<double>::infinity();
};

/// A corner of the border.
struct Joint {
    Point at;
    int before, after;  // chains
};

/// The point of a border closest to some point of the surface.
struct BorderFoot {
    Point at = Point::Zero();
    Point left = Point::Zero();  // to the side the surface is on
    double distance = std::numeric_limits<double>::infinity();
    int chain = -1;

    double beyond(const Point& x) const { return (x - at).dot(left) >= 0 ? -distance : distance; }
};

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
    std::vector<int> chain_of;  // by edge of the border
    std::vector<Chain> chains;
    std::vector<Joint> joints;
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
        BRepMesh_IncrementalMesh(shape, picture_sag * size, false, 0.1);
        for (; faces.More(); faces.Next()) add_sheet(TopoDS::Face(faces.Current()));
        if (triangles.empty())
            throw ToolError(
                "face: the shape's faces cannot be divided into triangles; check its geometry in the CAD program");
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
        find_chains();
    }

    /// A point so far away that no element that meets the face reaches it.
    bool is_far(const Point& x) const { return box.exteriorDistance(x) > 2 * box.diagonal().norm(); }

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
            if (std::abs(step[0]) * su.Magnitude() + std::abs(step[1]) * sv.Magnitude() < 1e-14 * box.diagonal().norm())
                break;
        }
        s.surface->D1(uv[0], uv[1], p, su, sv);
        Point normal = point(su.Crossed(sv).XYZ());
        const double length = normal.norm();
        if (length > 1e-14 * su.Magnitude() * sv.Magnitude())
            normal *= (s.reversed ? -1 : 1) / length;
        else
            normal = (t.corner[1] - t.corner[0])
                         .cross(t.corner[2] - t.corner[0])
                         .normalized();  // a pole; the picture's normal will do
        return {point(p.XYZ()), normal};
    }

    /// The same for points that may be beyond the end of the surface, which is then followed along its tangent.
    Place level_foot(const Point& x) const {
        Place out = foot(x);
        out.at = x - out.normal.dot(x - out.at) * out.normal;
        return out;
    }

    /// The point of the border closest to a point on the surface. Of the chains for which `counts` holds; where one of
    /// them meets one that does not count, it goes on straight.
    BorderFoot border_foot(const Place& foot, auto counts) const {
        BorderFoot best;
        const double close = 1e-9 * box.diagonal().norm();
        // In a corner of the border several pieces are as near; together their directions tell inside from outside.
        const auto consider = [&](const Point& at, const Point& tangent, int chain) {
            const double distance = (at - foot.at).norm();
            if (distance > best.distance + close) return;
            if (distance < best.distance - close) best.left.setZero();
            best.left += foot.normal.cross(tangent).normalized();
            if (distance >= best.distance) return;
            best.distance = distance;
            best.at = at;
            best.chain = chain;
        };
        for (const BorderPiece& piece : pieces) {
            if (!counts(chain_of[piece.edge])) continue;
            const Point along = piece.end - piece.start;
            const double length = along.squaredNorm(),
                         s = length > 0 ? std::clamp(along.dot(foot.at - piece.start) / length, 0.0, 1.0) : 0;
            // The chord is off the curve by less than its own length.
            if ((piece.start + s * along - foot.at).norm() > best.distance + std::sqrt(length)) continue;
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
            consider(point(p.XYZ()), point(d.XYZ()) * (border_reversed[piece.edge] ? -1 : 1), chain_of[piece.edge]);
        }
        for (std::size_t c = 0; c < chains.size(); ++c) {
            if (!counts(static_cast<int>(c))) continue;
            for (std::size_t k = 0; k < chains[c].ends.size(); ++k) {
                const Chain::End& end = chains[c].ends[k];
                const double along = end.tangent.dot(foot.at - end.at);
                if ((k == 0 ? along < 0 : along > 0) && (end.neighbour < 0 || !counts(end.neighbour)))
                    consider(end.at + along * end.tangent, end.tangent, static_cast<int>(c));
            }
        }
        return best;
    }

    /// Signed distance from a point on the surface to the chains that count; positive beyond them.
    double beyond(const Place& foot, auto counts) const {
        const BorderFoot closest = border_foot(foot, counts);
        const double out = closest.beyond(foot.at);
        if (out >= 0 || counts(border_foot(foot, [](int) { return true; }).chain) == 0) return out;
        // Far round a curved surface directions do not tell. What is inside is on the picture, too.
        NearestTriangle search{triangles, foot.at};
        Eigen::BVMinimize(tree, search);
        return search.least > std::pow(5 * picture_sag * box.diagonal().norm(), 2) ? -out : out;
    }

private:
    void add_sheet(const TopoDS_Face& face) {
        TopLoc_Location location;
        const Handle(Poly_Triangulation) picture = BRep_Tool::Triangulation(face, location);
        if (picture.IsNull() || !picture->HasUVNodes()) return;
        Sheet sheet{BRep_Tool::Surface(face), face.Orientation() == TopAbs_REVERSED, {}, {}};
        // Without the bounds that some files give their surfaces: beyond the border it goes on.
        if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(sheet.surface); !trimmed.IsNull())
            sheet.surface = trimmed->BasisSurface();
        double bounds[4];
        sheet.surface->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
        const bool periodic[2] = {static_cast<bool>(sheet.surface->IsUPeriodic()),
                                  static_cast<bool>(sheet.surface->IsVPeriodic())};
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
        if (feature_size > 1e9 * box_size(picture))
            feature_size = std::numeric_limits<double>::infinity();  // rounding of a plane
        sheets.push_back(std::move(sheet));
    }

    static double box_size(const Handle(Poly_Triangulation) & picture) {
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
                    const double from =
                        curve.FirstParameter() + k * (curve.LastParameter() - curve.FirstParameter()) / count;
                    const double to =
                        curve.FirstParameter() + (k + 1) * (curve.LastParameter() - curve.FirstParameter()) / count;
                    pieces.push_back({index, from, to, point(curve.Value(from).XYZ()), point(curve.Value(to).XYZ())});
                }
            }
        }
    }

    /// Takes the border apart at its corners.
    void find_chains() {
        struct End {
            Point at, tangent;
        };
        const int count = static_cast<int>(border.size());
        const double close = 1e-6 * box.diagonal().norm();
        std::vector<std::array<End, 2>> ends;  // first and last, in the border's direction
        for (int e = 0; e < count; ++e) {
            std::array<End, 2> of;
            for (int k = 0; k < 2; ++k) {
                gp_Pnt p;
                gp_Vec d;
                border[e].D1(k == 0 ? border[e].FirstParameter() : border[e].LastParameter(), p, d);
                of[k] = {point(p.XYZ()), point(d.XYZ()).normalized() * (border_reversed[e] ? -1 : 1)};
            }
            if (border_reversed[e]) std::swap(of[0], of[1]);
            ends.push_back(of);
        }
        std::vector<int> next(count, -1), previous(count, -1);
        std::vector<char> smooth(count, 0);  // to the next
        for (int e = 0; e < count; ++e)
            for (int f = 0; f < count; ++f)
                if (previous[f] < 0 && next[e] < 0 && (ends[f][0].at - ends[e][1].at).norm() <= close) {
                    next[e] = f;
                    previous[f] = e;
                    smooth[e] =
                        ends[e][1].tangent.dot(ends[f][0].tangent) > std::cos(corner_angle * std::numbers::pi / 180);
                }
        chain_of.assign(count, -1);
        const auto follow = [&](int from) {
            for (int e = from; e >= 0 && chain_of[e] < 0; e = smooth[e] ? next[e] : -1)
                chain_of[e] = static_cast<int>(chains.size());
            chains.emplace_back();
        };
        for (int e = 0; e < count; ++e)
            if (previous[e] < 0 || !smooth[previous[e]]) follow(e);
        for (int e = 0; e < count; ++e)
            if (chain_of[e] < 0) follow(e);
        for (int e = 0; e < count; ++e) {
            Chain& chain = chains[chain_of[e]];
            if (previous[e] < 0 || !smooth[previous[e]])
                chain.ends.insert(chain.ends.begin(),
                                  {ends[e][0].at, ends[e][0].tangent, previous[e] < 0 ? -1 : chain_of[previous[e]]});
            if (smooth[e]) continue;
            chain.ends.push_back({ends[e][1].at, ends[e][1].tangent, next[e] < 0 ? -1 : chain_of[next[e]]});
            if (next[e] >= 0) joints.push_back({ends[e][1].at, chain_of[e], chain_of[next[e]]});
        }
        for (const BorderPiece& piece : pieces) {
            gp_Pnt p;
            gp_Vec d, dd;
            border[piece.edge].D2((piece.from + piece.to) / 2, p, d, dd);
            const double bend = d.Crossed(dd).Magnitude(), speed = d.Magnitude();
            double& least = chains[chain_of[piece.edge]].least_radius;
            if (bend > 1e-9 * speed * speed * speed / box.diagonal().norm())
                least = std::min(least, speed * speed * speed / bend);
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

/// The surface that stands on a face along a chain of its border.
class Face::Side final : public Tool {
public:
    Side(std::shared_ptr<const Geometry> geometry, int chain) : geometry_(std::move(geometry)), chain_(chain) {}

    std::string kind() const override { return "face border"; }
    double distance(const Eigen::Vector3d& x) const override {
        if (geometry_->is_far(x)) return geometry_->box.exteriorDistance(x);
        const Place foot = geometry_->level_foot(x);
        const BorderFoot to = closest(foot);
        return (to.at - foot.at).dot(to.left.normalized());
    }
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override {
        return -closest(geometry_->level_foot(x)).left.normalized();
    }
    double feature_size() const override { return geometry_->chains[chain_].least_radius; }

private:
    BorderFoot closest(const Place& foot) const {
        return geometry_->border_foot(foot, [this](int c) { return c == chain_; });
    }
    std::shared_ptr<const Geometry> geometry_;
    int chain_;
};

Face::Face(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
Face::~Face() = default;

Face Face::read(const std::filesystem::path& path) {
    try {
        return from_shape(read_cad_file(path));
    } catch (const Standard_Failure& e) {
        throw ReadError("'" + path.string() + "': OpenCASCADE says: " + e.GetMessageString());
    }
}

Face Face::from_brep(const std::string& text) {
    try {
        return from_shape(shape_from_brep(text, "face"));
    } catch (const Standard_Failure& e) {
        throw ToolError(std::string("face: OpenCASCADE says: ") + e.GetMessageString());
    }
}

Face Face::from_shape(const TopoDS_Shape& shape) { return Face(std::make_shared<const Geometry>(shape)); }

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
    return geometry_->beyond(geometry_->level_foot(x), [](int) { return true; });
}

std::vector<int> Face::chains_before(const Eigen::Vector3d& x, double clearance) const {
    const Geometry& g = *geometry_;
    const Place foot = g.level_foot(x);
    const BorderFoot nearest = g.border_foot(foot, [](int) { return true; });
    std::vector<int> there{nearest.chain}, out;
    for (const Joint& j : g.joints)
        if ((j.at - nearest.at).norm() <= 1e-6 * g.box.diagonal().norm())
            there.insert(there.end(), {j.before, j.after});
    std::ranges::sort(there);
    there.erase(std::unique(there.begin(), there.end()), there.end());
    for (const int c : there)
        if (g.border_foot(foot, [c](int other) { return other == c; }).beyond(foot.at) > clearance) out.push_back(c);
    return out;
}

Patch Face::within(const std::vector<int>& chains) const {
    Patch patch;
    std::vector<char> counts(geometry_->chains.size(), 0);
    for (const int c : chains) counts[c] = 1;
    std::vector<int> side_of(counts.size(), -1);
    for (const int c : chains) {
        side_of[c] = static_cast<int>(patch.sides.size());
        patch.sides.push_back(std::make_unique<Side>(geometry_, c));
        patch.feature_size = std::min(patch.feature_size, patch.sides.back()->feature_size());
    }
    for (const Joint& j : geometry_->joints) {
        if (!counts[j.before] || !counts[j.after]) continue;
        if (j.before == j.after) {
            std::ostringstream message;
            message << "face: its border has a single corner, at (" << j.at.transpose()
                    << "). Divide the edge there into two, so that the corner is between two edges";
            throw ToolError(message.str());
        }
        patch.corners.push_back({j.at, {side_of[j.before], side_of[j.after]}});
    }
    const auto closest = [g = geometry_, counts](const Place& foot) {
        return g->border_foot(foot, [&](int c) { return counts[c] != 0; });
    };
    patch.distance = [g = geometry_, counts](const Eigen::Vector3d& x) {
        if (g->is_far(x)) return g->box.exteriorDistance(x);
        return g->beyond(g->level_foot(x), [&](int c) { return counts[c] != 0; });
    };
    patch.side = [g = geometry_, closest, side_of](const Eigen::Vector3d& x) {
        return side_of[closest(g->level_foot(x)).chain];
    };
    return patch;
}

int Face::face_count() const { return static_cast<int>(geometry_->sheets.size()); }

}  // namespace femscalpel
