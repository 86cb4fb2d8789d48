// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cutting/planar_mesh.h"
#include "operators/coordinate_slack.h"
#include "operators/feature_line.h"
#include "operators/skin_planes.h"
#include "tools/tool.h"

namespace femscalpel {

/// How an edge that is rounded ends at its beginning and end.
struct FilletEnds {
    std::array<LineEnd, 2> kind{LineEnd::plane, LineEnd::plane};
    /// Of the plane face at a wall, out of the edge.
    std::array<Vec3, 2> normal{Vec3::Zero(), Vec3::Zero()};
    /// Where it is joined to others: FilletVertex::to_centre.
    std::array<Vec3, 2> to_centre{Vec3::Zero(), Vec3::Zero()};
};

/// An edge of straight pieces and arcs of circles, smoothly joined in one plane, and its two faces, straight in
/// sections across it and the same in all: planes, and along arcs planes, cylinders and cones about the circle's axis.
/// A ball that rolls along touches them at the tangent lines.
///
/// A point is known by its place `s` along the edge and its section coordinates: the edge is at (0, 0), its plane's
/// normal is (0, 1).
class FilletPath {
public:
    /// A point by where it is along the edge, and its section coordinates there.
    struct Place {
        double s;
        Vec2 p;
    };

    /// At an open end the path stops where both tangent lines still lie on the faces. Throws ToolError (parameter
    /// "along" or "radius") when the line is of another kind, or the ball too large for its faces: `skin` is all of the
    /// mesh's, and `planes` where these are known better than from single triangles.
    FilletPath(const Mesh& mesh, const FeatureLine& line, double radius, const std::vector<std::array<Index, 3>>& skin,
               const FilletEnds& ends = {}, const SkinPlanes* planes = nullptr);

    /// A corner of a plane mesh, like an edge of no length across it: `faces` are unit vectors from it along the
    /// outline, with the material on the left of the first as seen from where `normal` points to.
    FilletPath(const Mesh& mesh, const Vec3& corner, const Vec3& normal, const std::array<Vec3, 2>& faces, bool convex,
               double radius);

    Place place(const Vec3& x) const;
    Vec3 at(double s, const Vec2& p) const;

    /// Distance to the edge, which counts as going on beyond its ends by `beyond`.
    double distance(const Vec3& x, double beyond) const;

    /// The point of the arc at an angle from 0 (on the first face) to arc_angle(), in section coordinates.
    Vec2 arc(double angle) const {
        return centre_ + radius_ * (std::cos(angle) * to_first_ + std::sin(angle) * across_);
    }
    double arc_angle() const { return arc_angle_; }
    double arc_length() const { return radius_ * arc_angle_; }
    double radius() const { return radius_; }

    /// Unit vector in the section from the edge along a face (0 or 1), and the tangent point.
    const Vec2& along_face(int face) const { return along_face_[face]; }
    Vec2 tangent_point(int face) const { return tangent_length_ * along_face_[face]; }
    /// The normal of a face, out of the material.
    const Vec2& normal(int face) const { return normal_[face]; }
    const Vec2& centre() const { return centre_; }
    double tangent_length() const { return tangent_length_; }
    /// The smallest radius of the tangent line on a face where it is a circle about an arc's axis; infinite along
    /// straight edges.
    double tangent_radius(int face) const;
    /// How far from the edge there is material that goes or comes.
    double rounded_reach() const { return tangent_length_; }

    bool convex() const { return convex_; }
    bool closed() const { return closed_; }
    bool is_straight() const { return pieces_.size() == 1 && pieces_[0].curvature == 0; }
    double begin() const { return begin_; }
    double end() const { return end_; }
    double length() const { return end_ - begin_; }
    double mean_edge() const { return mean_edge_; }
    /// How it ends at its beginning (0) and end (1).
    LineEnd end_kind(int which) const { return ends_[which]; }
    /// Where it is joined to others: how far before its end the tangent lines on a face do; negative: beyond it.
    double cut_back(int which) const { return cut_back_[which]; }
    /// The plane across an end, negative on the edge's side.
    const Tool& end_plane(int which) const { return *end_planes_[which]; }
    /// Whether a point is beyond an open end.
    bool is_beyond_end(const Vec3& x) const;
    /// How far the edge's segments and nodes may be off it.
    double sag() const { return sag_; }
    /// By how much the direction of a face may be off as coordinates were rounded, in radians.
    double face_slack() const { return face_slack_; }

    /// The surface through a tangent line that is perpendicular to its face; negative on the edge's side.
    const Tool& wall(int face) const { return *used_walls_[face]; }
    /// Another edge's that is the same, to be used from now on.
    void use_wall(int face, const Tool& wall) { used_walls_[face] = &wall; }
    /// The surface of the rolling ball.
    const Tool& ball() const { return *ball_; }

private:
    struct Piece {
        Vec3 start, tangent;  ///< where it begins, and its direction there
        double curvature;     ///< of an arc, positive if it turns left as seen from where the normal points to
        double begin, length;
    };

    void fit(std::vector<Vec3> points);
    std::vector<Vec3> corners_on_arc(const std::vector<Vec3>& points) const;
    void find_planes(const FeatureLine& line, const SkinPlanes& planes);
    void find_plane(const std::vector<Vec3>& points);
    void lay_between_planes(const Vec3& first, const Vec3& last);
    Piece arc_through(const Vec3& a, const Vec3& b, const Vec3& c) const;
    Piece fitted(const Piece& arc, std::span<const Vec3> points) const;
    bool lie_on_arc(std::span<const Vec3> points) const;
    std::size_t add_piece(const std::vector<Vec3>& points, std::size_t first);
    Vec3 right(const Piece& piece) const { return piece.tangent.cross(normal_3d_); }
    Place place_by(const Piece& piece, const Vec3& x) const;
    Vec3 at(const Piece& piece, double s, const Vec2& p) const;
    void set_faces(const Vec2& normal);
    void find_faces(const Mesh& mesh, const FeatureLine& line);
    Vec2 along_plane(int side, const Vec2& about) const;
    using SkinNear = std::vector<std::array<Vec3, 3>>;
    SkinNear skin_near(const Mesh& mesh, const std::vector<std::array<Index, 3>>& skin) const;
    double off_face(const SkinNear& near, int side, double s, double part) const;
    double room_margin(int side) const;
    [[noreturn]] static void refuse(const std::string& text, const Vec3& near, const char* parameter);
    [[noreturn]] void refuse_axis(int side, const Vec3& near) const;
    [[noreturn]] void refuse_room(const SkinNear& near, double begin, double end, int places) const;
    void stop_at_corner(int which, const SkinNear& near);
    void cut_back_at(int which, const Vec3& to_centre);
    void check_room(const SkinNear& near) const;

    bool closed_ = false, convex_ = true;
    std::vector<Piece> pieces_;
    Vec3 normal_3d_ = Vec3::Zero();
    double begin_ = 0, end_ = 0, mean_edge_ = 0, sag_ = 0, face_slack_ = 0;
    double chord_sag_ = 0;  // where nodes lie on an arc's chords: how far they may be off it
    CoordinateSlack slack_{0};
    std::array<std::optional<SkinPlanes::Plane>, 2> planes_;  // in which the faces lie, where they are known
    double radius_, tangent_length_ = 0, arc_angle_ = 0;
    std::array<Vec2, 2> along_face_, normal_;
    Vec2 centre_ = Vec2::Zero(), to_first_ = Vec2::Zero(), across_ = Vec2::Zero();
    std::array<std::unique_ptr<Tool>, 2> walls_;
    std::array<const Tool*, 2> used_walls_{};
    std::unique_ptr<Tool> ball_;
    std::array<LineEnd, 2> ends_{LineEnd::plane, LineEnd::plane};
    std::array<double, 2> cut_back_{0, 0};
    std::array<std::unique_ptr<Tool>, 2> end_planes_;
};

/// Throws ToolError when a radius is no length, or beyond all faces of the mesh.
void check_fillet_radius(double radius, const Mesh& mesh);

}  // namespace femscalpel
