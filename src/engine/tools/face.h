// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/patch.h"

class TopoDS_Shape;

namespace femscalpel {

/// A face or a shell of a CAD model as an open surface, by OpenCASCADE. The positive side is the one its oriented
/// normals point to (of a solid's faces: outside).
///
/// Beyond its border the surface goes on as the underlying geometry does (plane, cylinder, ...; a spline in its tangent
/// plane), and beyond() tells how far. Up to twice its own size away distances are exact; farther they are a lower
/// bound with a sign, which is all that locating needs.
class Face final : public Tool {
public:
    /// From a .step, .stp, .brep or .brp file; all faces in it. Throws ReadError that names the file when it cannot be
    /// read, ToolError when it holds no face, or faces that meet at an angle: the surface would fold there.
    static Face read(const std::filesystem::path& path);

    /// From the text of a .brep file, as FreeCAD's exportBrepToString() gives it.
    static Face from_brep(const std::string& text);

    /// All faces of a shape. Throws ToolError and OpenCASCADE's Standard_Failure.
    static Face from_shape(const TopoDS_Shape& shape);

    ~Face() override;

    std::string kind() const override { return "face"; }
    double distance(const Eigen::Vector3d& x) const override;
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override;
    Eigen::Vector3d project(const Eigen::Vector3d& x) const override;
    double feature_size() const override;
    bool bounded() const override;
    double beyond(const Eigen::Vector3d& x) const override;

    int face_count() const;

    /// The border is made of chains of edges, which meet in its corners. Those that a point of the surface, beyond the
    /// border by more than `clearance`, is beyond; of two that meet in the corner nearest to it, perhaps both.
    std::vector<int> chains_before(const Eigen::Vector3d& x, double clearance) const;

    /// The part of the surface within these chains of the border; where one of them meets another, it goes on straight.
    /// Throws ToolError when one has a corner of its own.
    Patch within(const std::vector<int>& chains) const;

private:
    struct Geometry;
    class Side;
    explicit Face(std::shared_ptr<const Geometry> geometry);
    std::shared_ptr<const Geometry> geometry_;
};

}  // namespace femscalpel
