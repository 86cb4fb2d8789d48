// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "cutting/workpiece.h"
#include "operators/feature_line.h"
#include "operators/fillet_path.h"

namespace femscalpel {

/// A corner of the outline of a plane mesh of triangles.
struct OutlineCorner {
    Index node;
    Vec3 normal;                 ///< of the mesh's plane
    std::array<Vec3, 2> along;   ///< unit vectors along the outline, with the material on the left, and against it
    std::array<double, 2> room;  ///< how far the outline goes on straight in them
    bool convex;
};

/// The corners, of more than `feature_angle` degrees, that `along` names: all of a group's or a list's nodes, those
/// nearest to points. Throws ToolError (parameter "along") when there is none, or the mesh is not plane.
std::vector<OutlineCorner> find_outline_corners(const Mesh& mesh, const Along& along, double feature_angle);

/// Replaces the triangles around a corner, between the walls through the points where a ball touches the outline, by
/// others that end at the ball's arc. As FilletCavity, in the plane; the edges on the arc become BandMesh::cut_edges.
class FilletCorner {
public:
    FilletCorner(Workpiece& workpiece, const Mesh& mesh, const FilletPath& path, double reach);

    /// Throws QualityError where it cannot.
    void replace(int tag);

private:
    const Vec3& at(int v) const { return f_.d.band.nodes[v].at; }
    /// What is nearer to the outline lies on it.
    double close() const { return 1e-6 * path_.radius() + 2 * path_.sag(); }
    void collect();
    void find_outline();
    void fill(int tag);
    int parent(const Vec3& x) const;

    Workpiece& f_;
    const Mesh& mesh_;
    const FilletPath& path_;
    double reach_;
    std::vector<int> removed_;
    std::vector<Vec3> centres_;
    std::vector<int> outline_;  ///< of what goes, from one end of the arc to the other, counter-clockwise
};

}  // namespace femscalpel
