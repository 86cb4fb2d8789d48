// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "operators/fillet_material.h"
#include "operators/fillet_patch.h"

namespace femscalpel {

/// The new faces along one edge that is rounded: on the ball, and on planes across the edge. Where groups meet along a
/// concave edge, also a wall between their shares of the new material, from the edge to the middle of the arc.
class FilletRun {
public:
    using Face = FilletMaterial::Face;
    using Border = FilletMaterial::Border;
    /// Nodes along the edge, in its direction.
    using Row = std::vector<int>;

    /// A patch of a section.
    struct Part {
        int side;   ///< from one tangent line to the middle of the arc; -1: to the other
        int patch;  ///< -1 where the new face ends on that of another edge
    };
    /// A plane across the edge: where it leaves the part, or a border inside that is kept, such as one of materials.
    struct Section {
        int corner;  ///< the node on the edge
        Vec3 normal = Vec3::Zero();
        double offset = 0;
        double s = 0;  ///< where the edge passes
        int end = -1;  ///< which end of the edge it is
        std::vector<Part> parts = {};
        std::vector<int> arc = {};    ///< nodes from the first tangent line to the second, both included; -1: none
        std::vector<int> ridge = {};  ///< nodes from the edge to the middle of the arc, where a wall ends
        std::array<std::size_t, 3> in_row{};  ///< places of its ends in the rows, and of the middle of its arc

        bool has(int side) const;
    };

    /// The edge in that place of those that the material was collected for.
    FilletRun(FilletMaterial& material, FilletPatches& patches, const FilletPath& path, std::size_t place);

    /// Where the edge is joined to others at an end: its new face ends in this plane. To be called first.
    void end_in_plane(int which, const Vec3& normal, const Vec3& point) {
        end_normals_[which] = normal, end_points_[which] = point;
    }

    /// Takes what is across the edge out of the material's skin and borders. Throws QualityError where it cannot.
    void find_sections();
    /// Finds the tangent lines on the skin.
    void find_rows();
    /// Moves them onto the ball where facets have them off it. To be called when all edges have found theirs.
    void put_rows_on_ball();
    /// Nodes of the rows, which touch the ball by now, that had to stay on the facets of a face that stands for a bent
    /// one.
    struct Beside {
        int count = 0;
        double farthest = 0;  ///< off the ball
        Vec3 at = Vec3::Zero();
    };
    /// Once there are new elements: brings nodes of the rows as near to the ball as these let them come, and holds them
    /// there.
    Beside settle_rows();
    /// Into how many parts the arc should be divided.
    int wanted_divisions() const;
    /// Whether the arc is divided in its middle.
    bool halved() const;
    /// The nodes of sections on the ball, but for those that are given for ends.
    void make_arcs(int divisions);
    void give_arc(int which, std::vector<int> nodes) { end_section_at(which).arc = std::move(nodes); }
    void give_ridge(int which, std::vector<int> nodes) { end_section_at(which).ridge = std::move(nodes); }
    /// Those of an end, from the edge to the arc; none where groups do not meet there.
    const std::vector<int>& ridge_at(int which) const;
    /// Those of an end, from the first tangent line to the second.
    const std::vector<int>& arc_at(int which) const;
    /// Whether the first tangent line ends at one node with that of another edge.
    bool begins_like(int which, const FilletRun& other, int others) const {
        const Row &own = rows_[0], &row = other.rows_[0];
        return (which == 0 ? own.front() : own.back()) == (others == 0 ? row.front() : row.back());
    }
    /// The domains beside the edge at an end.
    std::array<int, 2> domains_at_end(int which) const;
    /// Makes all faces. To be called last.
    void make_faces();
    /// Mid-side nodes at the tangent lines of a circular edge go onto it: of second-order meshes; by edge_key().
    void bend_row_edges(std::map<std::uint64_t, Vec3>& middles);
    const FilletPath& path() const { return path_; }
    const std::vector<Face>& arc() const { return arc_; }
    const std::vector<Border>& walls() const { return walls_; }
    const std::vector<Section>& sections() const { return sections_; }
    const Row& row(int side) const { return rows_[side]; }

private:
    /// A surface unrolled: coordinates along the edge, and levels across it.
    struct Sheet {
        std::function<Vec3(double, double)> at;  ///< by place along the edge and level
        const Tool* tool;
        int levels;
        double step;     ///< from one level to the next
        double spacing;  ///< of nodes along the edge
        double squeeze;  ///< scale along the edge for triangulate()
    };
    /// A part of it between two lines across, whose nodes are by level.
    struct Patch {
        Row lower, upper;
        std::vector<int> left, right;
    };

    const Vec3& at(int v) const { return m_.at(v); }
    FilletPath::Place place(int v) const { return path_.place(at(v)); }
    double on_edge() const { return 2 * path_.sag() + 1e-6 * path_.radius(); }
    bool parted(std::size_t segment) const { return segments_[segment][0] != segments_[segment][1]; }

    void find_edge();
    int corner_at(double s) const;
    Section end_section(int which);
    Section end_on_face(int which);
    Vec3 plane_at(int corner) const;
    Vec3 plane_of(const std::vector<Triangle>& faces, int node, const Vec3& about) const;
    double off_plane() const { return 1e-7 * (path_.radius() + path_.length()) + 4 * m_.slack().off(); }
    int skin_part(Section& section, int side, int domain);
    Section end_in_wall(int which);
    Section open_end(int which);
    void add_borders_at_end(Section& section, int beyond);
    Section joined_end(int which);
    Section& end_section_at(int which) { return which == 0 ? sections_.front() : sections_.back(); }
    int domain_beyond(const Section& section) const;
    Row rim(const Section& section, int side) const;
    void find_borders();
    Section border_at(std::size_t node);
    bool border_part(Section& section, int side, const std::array<int, 2>& domain);
    void set_normal(Section& section, const Vec3& normal) const;
    void check_strips() const;
    void find_borders_along();
    int middle_level() const;
    double angle_at(double level) const;
    void make_trace(Section& section);
    void link_borders_along();
    std::size_t place_on_edge(const Section& section) const;

    Row find_row(int side) const;
    void place_in_rows(Section& section) const;

    double on_plane(const Vec2& p, const Section& section) const;
    void make_arc(Section& section);
    void make_ridge(Section& section);
    void link_patches(const Section& section);
    std::vector<int> nodes_near(const Section& section, const Vec3& x) const;

    double spacing_along() const;
    void make_middle_row();
    Row between(const Row& row, std::size_t from, std::size_t to) const;
    std::vector<double> unrolled(const std::vector<int>& nodes, double near) const;
    Sheet arc_sheet() const;
    Sheet wall_sheet() const;
    void mesh_arcs();
    int domain_behind(const Section& section, int side) const;
    void mesh_walls();
    std::vector<Triangle> mesh_ring(const Sheet& sheet, Row lower, Row upper, int first, int last);
    void add_arc(std::vector<Triangle> triangles, int domain);
    void add_wall(std::vector<Triangle> triangles, const std::array<int, 2>& domain);
    std::vector<Triangle> mesh_patch(const Sheet& sheet, const Patch& patch, int first, int last);

    FilletMaterial& m_;
    FilletPatches& patches_;
    const FilletPath& path_;
    std::size_t place_;
    Row edge_;                                  // nodes on the edge
    std::vector<std::array<int, 2>> segments_;  // domains on both sides of each of its segments
    std::vector<Section> sections_;             // by s; of an open edge the first and last are its ends
    std::array<Vec3, 2> end_normals_{Vec3::Zero(), Vec3::Zero()}, end_points_ = end_normals_;
    std::array<Row, 3> rows_;           // on the tangent lines; on the middle of the arc, where it is halved
    int divisions_ = 4, middle_ = 2;    // parts of the arc; those before its halves meet
    double middle_angle_ = 0;           // of a convex edge: where its border meets the arc
    std::map<std::size_t, int> along_;  // patches of borders along it, by the first of their segments
    std::vector<Face> arc_;
    std::vector<Border> walls_;
};

}  // namespace femscalpel
