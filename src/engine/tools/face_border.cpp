// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/face_border.h"

#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "error.h"
#include "tools/occ_point.h"

namespace femscalpel {
namespace {

using Point = Eigen::Vector3d;

/// Faces that meet at more than this, in degrees, fold the surface.
constexpr double smooth_angle = 20;

/// Edges of the border that meet at more than this, in degrees, make a corner of it.
constexpr double corner_angle = 1;

/// The point of a curve closest to `x`, between two parameters and from one near it on, and the tangent there.
struct OnCurve {
    gp_Pnt at;
    gp_Vec tangent;
};
OnCurve closest_on(const BRepAdaptor_Curve& curve, double from, double to, double t, const Point& x, double close) {
    OnCurve out;
    gp_Vec dd;
    for (int iteration = 0; iteration < 12; ++iteration) {
        curve.D2(t, out.at, out.tangent, dd);
        const gp_Vec& d = out.tangent;
        const gp_Vec r(gp_Pnt(x[0], x[1], x[2]), out.at);
        double curvature = d * d + r * dd;
        if (!(curvature > 0)) curvature = d * d;
        if (!(curvature > 0)) break;
        const double next = std::clamp(t - (r * d) / curvature, from, to);
        if (std::abs(next - t) * d.Magnitude() < close) break;
        t = next;
    }
    curve.D1(t, out.at, out.tangent);
    return out;
}

/// Throws ToolError when two faces meet in an edge at an angle.
void check_smooth(const TopoDS_Edge& edge, const TopoDS_Face& face, const TopoDS_Face& other) {
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
            at = to_vector(p.XYZ());
            normal[k++] = to_vector(su.Crossed(sv).XYZ()).normalized() * (f.Orientation() == TopAbs_REVERSED ? -1 : 1);
        }
        const double angle = std::acos(std::clamp(normal[0].dot(normal[1]), -1.0, 1.0)) * 180 / std::numbers::pi;
        if (!(angle > smooth_angle)) continue;
        std::ostringstream message;
        message << "face: its faces meet at " << angle << " degrees near (" << at.transpose()
                << "); one surface cannot fold. Take the faces one after the other";
        throw ToolError(message.str(), "source");
    }
}

}  // namespace

ChainSet ChainSet::only(int chain) {
    ChainSet out;
    out.only_ = chain;
    return out;
}

ChainSet ChainSet::marked(std::vector<char> marks) {
    ChainSet out;
    out.marks_ = std::move(marks);
    return out;
}

FaceBorder::FaceBorder(const TopoDS_Shape& shape, double size) : size_(size) {
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
            if (other.IsNull())
                add_edge(edge);
            else
                check_smooth(edge, face, other);
        }
    }
    find_chains();
}

void FaceBorder::add_edge(const TopoDS_Edge& edge) {
    const int index = static_cast<int>(edges_.size());
    edges_.emplace_back(edge);
    reversed_.push_back(edge.Orientation() == TopAbs_REVERSED);
    const BRepAdaptor_Curve& curve = edges_.back();
    const bool straight = curve.GetType() == GeomAbs_Line;
    const int count = straight ? 1 : 48;
    for (int k = 0; k < count; ++k) {
        const double from = curve.FirstParameter() + k * (curve.LastParameter() - curve.FirstParameter()) / count;
        const double to = curve.FirstParameter() + (k + 1) * (curve.LastParameter() - curve.FirstParameter()) / count;
        pieces_.push_back({index, from, to, to_vector(curve.Value(from).XYZ()), to_vector(curve.Value(to).XYZ())});
    }
}

std::vector<FaceBorder::Ends> FaceBorder::ends() const {
    std::vector<Ends> out;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        Ends of;
        for (int k = 0; k < 2; ++k) {
            gp_Pnt p;
            gp_Vec d;
            edges_[e].D1(k == 0 ? edges_[e].FirstParameter() : edges_[e].LastParameter(), p, d);
            of[k] = {to_vector(p.XYZ()), to_vector(d.XYZ()).normalized() * (reversed_[e] ? -1 : 1)};
        }
        if (reversed_[e]) std::swap(of[0], of[1]);
        out.push_back(of);
    }
    return out;
}

/// Takes the border apart at its corners.
void FaceBorder::find_chains() {
    const int count = static_cast<int>(edges_.size());
    const double close = 1e-6 * size_;
    const std::vector<Ends> ends = this->ends();
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
    follow(next, previous, smooth);
    for (int e = 0; e < count; ++e) {
        Chain& chain = chains_[chain_of_[e]];
        if (previous[e] < 0 || !smooth[previous[e]])
            chain.ends.insert(chain.ends.begin(),
                              {ends[e][0].at, ends[e][0].tangent, previous[e] < 0 ? -1 : chain_of_[previous[e]]});
        if (smooth[e]) continue;
        chain.ends.push_back({ends[e][1].at, ends[e][1].tangent, next[e] < 0 ? -1 : chain_of_[next[e]]});
        if (next[e] >= 0) joints_.push_back({ends[e][1].at, chain_of_[e], chain_of_[next[e]]});
    }
    find_radii();
}

/// Gives every edge its chain: first those that begin somewhere, then closed ones.
void FaceBorder::follow(const std::vector<int>& next, const std::vector<int>& previous,
                        const std::vector<char>& smooth) {
    const int count = static_cast<int>(edges_.size());
    chain_of_.assign(edges_.size(), -1);
    const auto follow_from = [&](int from) {
        for (int e = from; e >= 0 && chain_of_[e] < 0; e = smooth[e] ? next[e] : -1)
            chain_of_[e] = static_cast<int>(chains_.size());
        chains_.emplace_back();
    };
    for (int e = 0; e < count; ++e)
        if (previous[e] < 0 || !smooth[previous[e]]) follow_from(e);
    for (int e = 0; e < count; ++e)
        if (chain_of_[e] < 0) follow_from(e);
}

void FaceBorder::find_radii() {
    for (const Piece& piece : pieces_) {
        gp_Pnt p;
        gp_Vec d, dd;
        edges_[piece.edge].D2((piece.from + piece.to) / 2, p, d, dd);
        const double bend = d.Crossed(dd).Magnitude(), speed = d.Magnitude();
        double& least = chains_[chain_of_[piece.edge]].least_radius;
        if (bend > 1e-9 * speed * speed * speed / size_) least = std::min(least, speed * speed * speed / bend);
    }
}

FaceBorder::Foot FaceBorder::foot(const FacePlace& place, const ChainSet& counted) const {
    Foot best;
    const bool all = counted.has_all();
    const double close = 1e-9 * size_;
    // In a corner of the border several pieces are as near; together their directions tell inside from outside.
    const auto consider = [&](const Point& at, const Point& tangent, int chain) {
        const double distance = (at - place.at).norm();
        if (distance > best.distance + close) return;
        if (distance < best.distance - close) best.left.setZero();
        best.left += place.normal.cross(tangent).normalized();
        if (distance >= best.distance) return;
        best.distance = distance;
        best.at = at;
        best.chain = chain;
    };
    for (const Piece& piece : pieces_) {
        if (!all && !counted.has(chain_of_[piece.edge])) continue;
        const Point along = piece.end - piece.start;
        const double length = along.squaredNorm(),
                     s = length > 0 ? std::clamp(along.dot(place.at - piece.start) / length, 0.0, 1.0) : 0;
        // The chord is off the curve by less than its own length.
        if ((piece.start + s * along - place.at).norm() > best.distance + std::sqrt(length)) continue;
        const OnCurve on = closest_on(edges_[piece.edge], piece.from, piece.to,
                                      piece.from + s * (piece.to - piece.from), place.at, 1e-14 * size_);
        consider(to_vector(on.at.XYZ()), to_vector(on.tangent.XYZ()) * (reversed_[piece.edge] ? -1 : 1),
                 chain_of_[piece.edge]);
    }
    for (std::size_t c = 0; c < chains_.size(); ++c) {
        if (!counted.has(static_cast<int>(c))) continue;
        for (std::size_t k = 0; k < chains_[c].ends.size(); ++k) {
            const Chain::End& end = chains_[c].ends[k];
            const double along = end.tangent.dot(place.at - end.at);
            if ((k == 0 ? along < 0 : along > 0) && (end.neighbour < 0 || !counted.has(end.neighbour)))
                consider(end.at + along * end.tangent, end.tangent, static_cast<int>(c));
        }
    }
    return best;
}

}  // namespace femscalpel
