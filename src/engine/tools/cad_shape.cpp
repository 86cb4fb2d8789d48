// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/cad_shape.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"
#include "tools/cad_file.h"
#include "tools/face.h"
#include "tools/occ_point.h"

namespace femscalpel {
namespace {

using Point = Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

Box box_of(const TopoDS_Shape& shape) {
    Bnd_Box bounds;
    BRepBndLib::Add(shape, bounds, false);
    if (bounds.IsVoid()) return {};
    double low[3], high[3];
    bounds.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
    return {Point(low[0], low[1], low[2]), Point(high[0], high[1], high[2])};
}

/// Pieces a curved edge is divided into to find where to start from.
constexpr int edge_pieces = 32;

struct CadEdge {
    BRepAdaptor_Curve curve;
    Box box;
    std::vector<Point> samples;  // at equal steps of the parameter, both ends included

    explicit CadEdge(const TopoDS_Edge& edge) : curve(edge), box(box_of(edge)) {
        const int count = curve.GetType() == GeomAbs_Line ? 1 : edge_pieces;
        for (int k = 0; k <= count; ++k) samples.push_back(to_vector(curve.Value(parameter(k, count)).XYZ()));
    }

    double parameter(double k, int count) const {
        return curve.FirstParameter() + k / count * (curve.LastParameter() - curve.FirstParameter());
    }

    CadShape::Foot foot(const Point& x) const {
        const int count = static_cast<int>(samples.size()) - 1;
        double least = std::numeric_limits<double>::infinity(), t = 0;
        for (int k = 0; k < count; ++k) {
            const Point along = samples[k + 1] - samples[k];
            const double length = along.squaredNorm(),
                         s = length > 0 ? std::clamp(along.dot(x - samples[k]) / length, 0.0, 1.0) : 0;
            const double distance = (samples[k] + s * along - x).squaredNorm();
            if (distance >= least) continue;
            least = distance;
            t = parameter(k + s, count);
        }
        gp_Pnt p;
        gp_Vec d, dd;
        for (int iteration = 0; iteration < 30; ++iteration) {
            curve.D2(t, p, d, dd);
            const gp_Vec r(gp_Pnt(x[0], x[1], x[2]), p);
            double curvature = d * d + r * dd;
            if (!(curvature > 0)) curvature = d * d;
            if (!(curvature > 0)) break;
            const double next = std::clamp(t - (r * d) / curvature, curve.FirstParameter(), curve.LastParameter());
            if (std::abs(next - t) * d.Magnitude() < 1e-15 * (1 + x.norm())) break;
            t = next;
        }
        curve.D1(t, p, d);
        return {to_vector(p.XYZ()), to_vector(d.XYZ()).normalized()};
    }
};

}  // namespace

struct CadShape::Geometry {
    struct CadFace {
        Face face;
        Box box;
    };
    std::vector<CadFace> faces;
    std::vector<CadEdge> edges;
    double size = 0;

    explicit Geometry(const TopoDS_Shape& shape) {
        try {
            TopTools_IndexedMapOfShape map;
            TopExp::MapShapes(shape, TopAbs_FACE, map);
            for (int k = 1; k <= map.Extent(); ++k) faces.push_back({Face::from_shape(map(k)), box_of(map(k))});
            if (faces.empty()) throw ToolError("shape: there is no face in it", "source");
            map.Clear();
            TopExp::MapShapes(shape, TopAbs_EDGE, map);
            for (int k = 1; k <= map.Extent(); ++k)
                if (!BRep_Tool::Degenerated(TopoDS::Edge(map(k)))) edges.emplace_back(TopoDS::Edge(map(k)));
        } catch (const Standard_Failure& e) {
            throw ToolError(std::string("shape: OpenCASCADE says: ") + e.GetMessageString(), "source");
        }
        size = box_of(shape).diagonal().norm();
    }
};

CadShape CadShape::read(const std::filesystem::path& path) {
    return CadShape(std::make_shared<const Geometry>(read_cad_file(path)));
}

CadShape CadShape::from_brep(const std::string& text) {
    return CadShape(std::make_shared<const Geometry>(shape_from_brep(text, "shape")));
}

int CadShape::face_count() const { return static_cast<int>(geometry_->faces.size()); }
int CadShape::edge_count() const { return static_cast<int>(geometry_->edges.size()); }
double CadShape::size() const { return geometry_->size; }

CadShape::Foot CadShape::on_face(int face, const Eigen::Vector3d& x) const {
    const Face& f = geometry_->faces[face].face;
    return {f.project(x), f.normal(x)};
}

CadShape::Foot CadShape::on_edge(int edge, const Eigen::Vector3d& x) const { return geometry_->edges[edge].foot(x); }

std::vector<int> CadShape::faces_at(const Eigen::Vector3d& x, double tolerance) const {
    std::vector<int> out;
    for (int k = 0; k < face_count(); ++k) {
        const Geometry::CadFace& f = geometry_->faces[k];
        if (f.box.exteriorDistance(x) <= tolerance && std::abs(f.face.distance(x)) <= tolerance &&
            f.face.beyond(x) <= tolerance)
            out.push_back(k);
    }
    return out;
}

std::vector<int> CadShape::edges_at(const Eigen::Vector3d& x, double tolerance) const {
    std::vector<int> out;
    for (int k = 0; k < edge_count(); ++k)
        if (geometry_->edges[k].box.exteriorDistance(x) <= tolerance && (on_edge(k, x).at - x).norm() <= tolerance)
            out.push_back(k);
    return out;
}

bool CadShape::is_plane(int face) const { return !std::isfinite(geometry_->faces[face].face.feature_size()); }
bool CadShape::is_line(int edge) const { return geometry_->edges[edge].curve.GetType() == GeomAbs_Line; }

}  // namespace femscalpel
