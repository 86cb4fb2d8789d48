// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace femscalpel {

/// The shape a mesh was made from, by OpenCASCADE: its faces and edges, for nodes of the mesh's skin to stay on.
class CadShape {
public:
    /// From a .step, .stp, .brep or .brp file. Throws ReadError that names the file, ToolError when there is no face in
    /// it.
    static CadShape read(const std::filesystem::path& path);

    /// From the text of a .brep file, as FreeCAD's exportBrepToString() gives it. Throws ToolError.
    static CadShape from_brep(const std::string& text);

    int face_count() const;
    int edge_count() const;

    /// Diagonal of its box.
    double size() const;

    /// A point of a face or edge, and the face's normal or the edge's tangent there (unit vectors).
    struct Foot {
        Eigen::Vector3d at;
        Eigen::Vector3d direction;
    };

    /// The point closest to `x` of a face, which goes on beyond its border.
    Foot on_face(int face, const Eigen::Vector3d& x) const;
    /// The same of an edge.
    Foot on_edge(int edge, const Eigen::Vector3d& x) const;

    /// Faces less than `tolerance` away from `x`, their borders included.
    std::vector<int> faces_at(const Eigen::Vector3d& x, double tolerance) const;
    /// Edges less than `tolerance` away from `x`, their ends included.
    std::vector<int> edges_at(const Eigen::Vector3d& x, double tolerance) const;

    bool is_plane(int face) const;
    bool is_line(int edge) const;

private:
    struct Geometry;
    explicit CadShape(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
    std::shared_ptr<const Geometry> geometry_;
};

}  // namespace femscalpel
