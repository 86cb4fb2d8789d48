// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What room a FilletPath has on the faces beside its edge.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "cancel.h"
#include "mesh/closest_point.h"
#include "mesh/surface.h"
#include "operators/fillet_path.h"

namespace femscalpel {
namespace {

/// A tangent line's radius about an axis must be this part of its distance from the edge, so that elements go around.
constexpr double axis_margin = 0.05;

}  // namespace

/// The skin's triangles about the tangent lines.
FilletPath::SkinNear FilletPath::skin_near(const Mesh& mesh, const std::vector<std::array<Index, 3>>& skin) const {
    Eigen::AlignedBox3d box;
    const int places = std::clamp(static_cast<int>(length() / mean_edge_), 4, 64);
    for (int k = 0; k <= 2 * places; ++k)
        for (const int side : {0, 1})
            for (const double part : {0.0, 1.1})
                box.extend(at(begin_ + length() * k / (2.0 * places), part * tangent_point(side)));
    const double margin = std::max(room_margin(0), room_margin(1));
    box.min().array() -= 2 * margin;
    box.max().array() += 2 * margin;
    SkinNear near;
    for (const auto& f : skin) {
        Eigen::AlignedBox3d own;
        for (const Index n : f) own.extend(mesh.points[n]);
        if (box.intersects(own)) near.push_back({mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]});
    }
    return near;
}

/// How far a face beside the edge is from a point across it, at that part of the way to the tangent line.
double FilletPath::off_face(const SkinNear& near, int side, double s, double part) const {
    check_cancelled();
    const Vec3 x = at(s, part * tangent_point(side)),
               n = (at(s, tangent_point(side) + normal_[side]) - at(s, tangent_point(side))).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    Vec3 weights;
    for (const auto& t : near) {
        if ((t[1] - t[0]).cross(t[2] - t[0]).normalized().dot(n) < 0.8) continue;
        nearest = std::min(nearest, (closest_on_triangle(t[0], t[1], t[2], x, weights) - x).norm());
    }
    return nearest;
}

/// Moves an end to the last place where both tangent lines lie on the faces, with what is between them and the edge.
void FilletPath::stop_at_corner(int which, const SkinNear& near) {
    const auto fits = [&](double s) {
        return std::ranges::all_of(std::array{0, 1}, [&](int side) {
            return std::ranges::all_of(std::array{0.4, 0.7, 1.0, 1.1},
                                       [&](double part) { return off_face(near, side, s, part) <= room_margin(side); });
        });
    };
    const double end = which == 0 ? begin_ : end_, inwards = which == 0 ? 1 : -1, tiny = 0.02 * mean_edge_,
                 step = mean_edge_ / 4;
    if (fits(end + inwards * tiny)) return;
    double low = tiny, high = tiny;  // from the end: where it does not fit, and where it does
    do {
        low = high;
        high += step;
        if (high > length() - step) {
            std::ostringstream text;
            text << radius_ << " is too large for the faces beside the edge, which ends at a corner: nowhere along it "
                 << "do they reach as far as " << 1.1 * tangent_length_ << ", where they would be touched,";
            refuse(text.str(), at(end, Vec2::Zero()), "radius");
        }
    } while (!fits(end + inwards * high));
    for (int k = 0; k < 30; ++k) {
        const double middle = (low + high) / 2;
        (fits(end + inwards * middle) ? high : low) = middle;
    }
    (which == 0 ? begin_ : end_) = end + inwards * high;
}

void FilletPath::cut_back_at(int which, const Vec3& to_centre) {
    const Vec3 tip = at(which == 0 ? begin_ : end_, Vec2::Zero());
    if (!is_straight()) refuse("a curved edge that meets others at a corner is not rounded", tip, "along");
    const Vec3 inwards = (which == 0 ? 1 : -1) * pieces_[0].tangent;
    cut_back_[which] = (convex_ ? -radius_ : radius_) * to_centre.dot(inwards);
}

/// Each face must be found under the tangent point, at some places along the edge.
void FilletPath::check_room(const SkinNear& near) const {
    // A round face may be too narrow for a part of the edge only.
    const double fineness = is_straight() ? 1 : 3;
    const int places =
        std::clamp(static_cast<int>(fineness * length() / mean_edge_), 4, static_cast<int>(64 * fineness));
    const double begin = begin_ + std::max(0.0, cut_back_[0]), end = end_ - std::max(0.0, cut_back_[1]);
    if (end - begin < 0.02 * length())
        refuse("too large for an edge between corners, whose roundings would meet", at((begin + end) / 2, Vec2::Zero()),
               "radius");
    for (int k = 0; k < places; ++k)
        for (const int side : {0, 1}) {
            const double s = begin + (end - begin) * (k + 0.5) / places;
            if (tangent_radius(side) < axis_margin * tangent_length_) refuse_axis(side, at(s, Vec2::Zero()));
            // Seen a little beyond the tangent line: a face must not end at it.
            if (off_face(near, side, s, 1.02) > room_margin(side)) refuse_room(near, begin, end, places);
        }
}

double FilletPath::tangent_radius(int face) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Piece& q : pieces_)
        if (q.curvature != 0) {
            const double from_axis = 1 + q.curvature * tangent_point(face).x();
            least = std::min(least, std::max(0.0, from_axis) / std::abs(q.curvature));
        }
    return least;
}

/// How far a face may seem to be off where it is: a plane one across the axis of an arc has no facets beside it.
double FilletPath::room_margin(int side) const {
    const bool is_flat = std::abs(along_face_[side].y()) < 1e-6;
    return 2 * (is_flat ? 2 * slack_.off() : sag_) + 1e-3 * tangent_length_;
}

void FilletPath::refuse_axis(int side, const Vec3& near) const {
    // Where the tangent line's radius is as large as is wanted.
    double largest = radius_;
    for (const Piece& q : pieces_)
        if (const double inwards = -q.curvature * along_face_[side].x(); inwards > 0)
            largest = std::min(largest, radius_ / (tangent_length_ * (inwards + axis_margin * std::abs(q.curvature))));
    std::ostringstream text;
    text << radius_ << " is too large for a face beside the edge, which is round: the line where it would be touched "
         << "comes too near the axis. There is room for about " << std::setprecision(3) << largest << ",";
    refuse(text.str(), near, "radius");
}

/// Where there is least room.
void FilletPath::refuse_room(const SkinNear& near, double begin, double end, int places) const {
    double fits = 1;  // part of the way to the tangent line
    Vec3 where = at(begin, Vec2::Zero());
    for (int k = 0; k < places; ++k)
        for (const int side : {0, 1}) {
            const double s = begin + (end - begin) * (k + 0.5) / places;
            const auto is_off = [&](double part) {
                return off_face(near, side, s, 1.02 * part) > room_margin(side) - 1e-3 * (1 - part) * tangent_length_;
            };
            if (!is_off(fits)) continue;
            where = at(s, Vec2::Zero());
            double low = fits;
            do {
                fits = low;
                low /= 2;
            } while (low > 0 && is_off(low));
            for (int round = 0; round < 12; ++round) {
                const double part = (low + fits) / 2;
                (is_off(part) ? fits : low) = part;
            }
            fits = low;
        }
    std::ostringstream text;
    text << radius_ << " is too large for a face beside the edge, which ends, or is not what it is at the edge, before "
         << "the distance of " << tangent_length_ << " at which it would be touched. There is room for about "
         << std::setprecision(3) << fits * radius_ << ",";
    refuse(text.str(), where, "radius");
}

void check_fillet_radius(double radius, const Mesh& mesh) {
    const double size = box_around(mesh).diagonal().norm();
    if (radius > 0 && radius <= 1000 * size) return;
    std::ostringstream message;
    message << "radius is " << radius
            << (radius > 0 ? ", which no face has room for" : "; it must be a positive length");
    throw ToolError(message.str(), "radius");
}

}  // namespace femscalpel
