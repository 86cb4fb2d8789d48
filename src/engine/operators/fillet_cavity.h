// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
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

    /// Mid-side nodes that are to lie exactly where they belong, by edge_key(); of second-order meshes.
    const std::map<std::uint64_t, Vec3>& middles() const { return middles_; }

private:
    /// Nodes of the skin along one tangent line, in the edge's direction.
    using Row = std::vector<int>;
    /// A plane across the edge: where it leaves the part, or a border inside that is kept, such as one of materials.
    struct Section {
        std::vector<Triangle> old;  ///< the faces there that go; normals in the edge's direction
        std::vector<int> arc;       ///< nodes from the first tangent line to the second, both included
        std::vector<Triangle> fresh;
        Vec3 normal = Vec3::Zero();
        double offset = 0;
        double s = 0;                         ///< where the edge passes
        std::array<int, 2> domain{-1, -1};    ///< before and behind, in the edge's direction; -1 outside
        std::array<std::size_t, 2> in_row{};  ///< places of its ends in the rows
    };
    /// A face, and the domain of the element that it is a face of.
    struct Face {
        Triangle nodes;
        int domain;
    };

    [[noreturn]] static void refuse(const std::string& text, const Vec3& near);
    const Vec3& at(int v) const { return f_.d.band.nodes[v].at; }
    FilletPath::Place place(int v) const { return path_.place(at(v)); }

    void collect();
    void find_domains();
    void sort_centres();
    std::array<long, 3> cube(const Vec3& x) const;
    void find_boundary();
    bool is_strip(const Triangle& face, int side) const;
    void find_sections();
    int corner_at(double s) const;
    Section section_at(int corner, std::vector<Face>& faces, bool border) const;
    void find_borders();
    void find_rows();
    Row find_row(int side) const;
    void place_in_rows(Section& section) const;
    void put_rows_on_ball();
    void divide_arc();
    std::vector<int> outline_of(const Section& section, const std::array<int, 2>& ends) const;
    void make_arc(Section& section);
    double on_plane(const Vec2& p, const Section& section) const;
    void mesh_section(Section& section);
    void mesh_arcs();
    void mesh_whole_arc();
    void mesh_arc(const Section& from, const Section& to);
    void add_arc_triangles(const std::vector<int>& node_of, const std::vector<Vec2>& outline,
                           const std::vector<Vec2>& inner, int domain);
    std::vector<Vec2> inner_points(const std::function<double(int)>& from, const std::function<double(int)>& to) const;
    double spacing_along() const;
    void fill();
    void bend_row_edges();
    void write_section(const Section& section);
    std::array<int, 4> nodes_near(const Vec3& x) const;
    const Triangle& face_near(const Section& section, const Vec3& x) const;
    int parent(const Vec3& x, int domain) const;

    Workpiece& f_;
    const Mesh& mesh_;
    const FilletPath& path_;
    double reach_;
    std::vector<int> removed_;
    std::vector<int> domain_;  // of removed_: parts between borders
    int domains_ = 0;
    std::vector<Vec3> centres_;                             // of removed_
    double cell_ = 0;                                       // side of the cubes of near_
    std::map<std::array<long, 3>, std::vector<int>> near_;  // places in centres_, by cube
    std::vector<Face> borders_;                             // between domains, out of the first's
    std::vector<Face> kept_;                                // boundary that stays, out of the cavity
    std::array<std::vector<Triangle>, 2> strips_;           // skin that goes, on each face
    std::vector<Face> skin_;                                // other skin, before find_sections()
    std::vector<Section> sections_;                         // by s; of an open edge the first and last are its ends
    std::array<Row, 2> rows_;
    int divisions_ = 4;
    std::vector<Face> arc_;
    std::map<std::uint64_t, Vec3> middles_;
};

}  // namespace femscalpel
