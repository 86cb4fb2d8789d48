// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Geom_Surface.hxx>
#include <Poly_Triangulation.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <unsupported/Eigen/BVH>
#include <vector>

namespace femscalpel {

/// A point of a surface and the surface's unit normal there.
struct FacePlace {
    Eigen::Vector3d at;
    Eigen::Vector3d normal;
};

/// The faces of a CAD shape without their border, by OpenCASCADE: they go on as the underlying geometry does.
class FaceSurface {
public:
    /// Throws ToolError when the shape has no face or none that can be divided into triangles, and OpenCASCADE's
    /// Standard_Failure. Leaves a triangulation with the shape.
    explicit FaceSurface(const TopoDS_Shape& shape);

    /// The box around the faces within their border.
    const Eigen::AlignedBox3d& box() const { return box_; }

    /// The diagonal of that.
    double size() const { return size_; }

    /// A point so far away that no element that meets the faces reaches it.
    bool is_far(const Eigen::Vector3d& x) const { return box_.exteriorDistance(x) > 2 * size_; }

    /// The place near `x` closest to it, on the surface as it goes on beyond the border.
    FacePlace foot(const Eigen::Vector3d& x) const;

    /// The same for points that may be beyond the end of the surface, which is then followed along its tangent.
    FacePlace level_foot(const Eigen::Vector3d& x) const;

    /// Whether a point on the surface is surely not on the faces within their border.
    bool is_off_picture(const Eigen::Vector3d& x) const;

    /// Sum of the normals, by area.
    const Eigen::Vector3d& mean_normal() const { return mean_normal_; }

    /// Smallest radius of curvature; infinite for planes.
    double feature_size() const { return feature_size_; }

    int face_count() const { return static_cast<int>(sheets_.size()); }

    /// A triangle of the coarse picture that finds the sheet and a place on it to start from.
    struct Triangle {
        int sheet;
        std::array<Eigen::Vector3d, 3> corner;
        std::array<Eigen::Vector2d, 3> uv;
    };

private:
    /// One surface of the shape, without its border.
    struct Sheet {
        Handle(Geom_Surface) surface;
        bool reversed;
        double low[2], high[2];  // parameters it is defined for; infinite where it goes on for ever
    };

    void add_sheet(const TopoDS_Face& face);
    void add_triangles(const Poly_Triangulation& picture, const gp_Trsf& transform, bool reversed);
    void find_feature_size(const Poly_Triangulation& picture, const Handle(Geom_Surface) & surface);
    void grow_tree();

    std::vector<Sheet> sheets_;
    std::vector<Triangle> triangles_;
    Eigen::KdBVH<double, 3, int> tree_;
    Eigen::AlignedBox3d box_;
    double size_ = 0;
    Eigen::Vector3d mean_normal_ = Eigen::Vector3d::Zero();
    double feature_size_ = std::numeric_limits<double>::infinity();
};

}  // namespace femscalpel
