// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <set>
#include <vector>

#include "cutting/fill.h"
#include "cutting/workpiece.h"
#include "operators/fillet_path.h"

namespace femscalpel {

/// Replaces the elements around an edge, between the walls through its tangent lines, by others that end at the
/// rolling ball's surface. The band must have been cut along both walls, at least within `reach` of the edge: elements
/// farther away stay.
class FilletCavity {
public:
    FilletCavity(Workpiece& workpiece, const Mesh& mesh, const FilletPath& path, double reach);

    /// Does it; the faces on the ball become BandMesh::cut_faces with this tag. Throws QualityError where it cannot.
    void replace(int tag);

private:
    /// Nodes of the skin along one tangent line, in the edge's direction.
    using Row = std::vector<int>;
    /// One end of the edge: where it leaves the part.
    struct End {
        std::vector<Triangle> old;  ///< the faces there that go, all in one plane
        std::vector<int> arc;       ///< nodes from the first tangent line to the second, both included
        std::vector<Triangle> fresh;
        Vec3 normal = Vec3::Zero();
        double offset = 0;
    };

    const Vec3& at(int v) const { return f_.d.band.nodes[v].at; }
    FilletPath::Place place(int v) const { return path_.place(at(v)); }

    void collect();
    void sort_centres();
    std::array<long, 3> cube(const Vec3& x) const;
    void check_materials() const;
    void find_boundary();
    bool is_strip(const Triangle& face, int side) const;
    void find_ends();
    End find_end(double s) const;
    void find_rows();
    Row find_row(int side) const;
    void put_rows_on_ball();
    void divide_arc();
    void make_end_arc(End& end, bool at_begin);
    double on_plane(const Vec2& p, const End& end, double s) const;
    void mesh_end(End& end);
    void mesh_arc();
    void add_arc_triangles(const std::vector<int>& node_of, const std::vector<Vec2>& points,
                           const std::vector<Vec2>& inner);
    void fill();
    void write_end(const End& end);
    int new_node(const Vec3& x, const Contact& tools, bool exterior);
    int parent(const Vec3& x) const;

    Workpiece& f_;
    const Mesh& mesh_;
    const FilletPath& path_;
    double reach_;
    std::vector<int> removed_;
    std::vector<Vec3> centres_;                             // of removed_
    double cell_ = 0;                                       // side of the cubes of near_
    std::map<std::array<long, 3>, std::vector<int>> near_;  // places in centres_, by cube
    std::vector<Triangle> kept_;                            // boundary that stays, out of the cavity
    std::vector<Triangle> strips_[2];                       // skin that goes, on each face
    std::vector<Triangle> skin_;                            // other skin, before find_ends(); stays after
    std::vector<End> ends_;                                 // none or two
    Row rows_[2];
    int divisions_ = 4;
    std::vector<Triangle> arc_;
};

}  // namespace femscalpel
