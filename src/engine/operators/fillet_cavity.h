// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "operators/fillet_material.h"
#include "operators/fillet_run.h"
#include "operators/fillet_vertex.h"

namespace femscalpel {

/// Replaces the elements around edges, between the walls through their tangent lines, by others that end at the rolling
/// ball's surface. The band must have been cut along both walls of each, at least within its reach: elements farther
/// away stay.
class FilletCavity {
public:
    /// The vertices are those at which these edges meet.
    FilletCavity(Workpiece& workpiece, const Mesh& mesh, std::span<const FilletReach> edges,
                 std::vector<FilletVertex> vertices = {});

    /// Does it; the faces on the ball become BandMesh::cut_faces with this tag, new ones at open ends with the next.
    /// The arc is divided into so many parts more than seems best. Returns the smallest mean ratio of the new elements.
    /// Throws QualityError where it cannot.
    double replace(int tag, int more);

    /// Mid-side nodes that are to lie exactly where they belong, by edge_key(); of second-order meshes.
    const std::map<std::uint64_t, Vec3>& middles() const { return middles_; }

private:
    void make_arcs(int more);
    void mesh_sphere(const FilletVertex& vertex);
    void touch(int v, const Tool& ball);
    void touch_at_vertices();
    void check_domains(const FilletVertex& vertex) const;
    void add_new_faces(int tag);
    void keep_other_borders();
    bool drop_faces_of_nodes(const Triangle& face);
    std::vector<Triangle> surface_of(int domain) const;
    double fill();
    void put_on_ball();

    Workpiece& f_;
    FilletMaterial material_;
    std::vector<FilletVertex> vertices_;
    FilletPatches patches_;
    std::vector<FilletRun> runs_;
    std::vector<FilletMaterial::Face> spheres_;
    std::map<std::uint64_t, Vec3> middles_;
};

}  // namespace femscalpel
