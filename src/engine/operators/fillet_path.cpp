// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_path.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <utility>

namespace femscalpel {
namespace {

/// So many corners, which turn by no more than this (sine), an arc of chords has at least: others are edges of prisms.
constexpr std::size_t fewest_corners = 5;
constexpr double sharpest_turn = 0.7;

/// A surface that is a straight line in sections across the edge.
class RollingWall final : public Tool {
public:
    RollingWall(const FilletPath& path, int face) : path_(path), face_(face) {}
    std::string kind() const override { return "wall"; }
    double distance(const Vec3& x) const override {
        return path_.place(x).p.dot(path_.along_face(face_)) - path_.tangent_length();
    }
    Vec3 normal(const Vec3& x) const override {
        const auto [s, p] = path_.place(x);
        return (path_.at(s, p + path_.along_face(face_)) - path_.at(s, p)).normalized();
    }
    double feature_size() const override { return std::numeric_limits<double>::infinity(); }

private:
    const FilletPath& path_;
    int face_;
};

/// The cylinder or torus that a ball touches as it rolls along the edge.
class Ball final : public Tool {
public:
    explicit Ball(const FilletPath& path) : path_(path) {}
    std::string kind() const override { return path_.is_straight() ? "cylinder" : "torus"; }
    double distance(const Vec3& x) const override {
        return (path_.place(x).p - path_.centre()).norm() - path_.radius();
    }
    Vec3 normal(const Vec3& x) const override {
        const auto [s, p] = path_.place(x);
        const Vec2 out = (p - path_.centre()).normalized();
        return (path_.at(s, p + path_.radius() * out) - path_.at(s, p)).normalized();
    }
    double feature_size() const override { return path_.radius(); }

private:
    const FilletPath& path_;
};

/// Across the edge at an end, in a plane whose normal is given if that is not at a right angle.
class EndPlane final : public Tool {
public:
    EndPlane(const FilletPath& path, int which, const Vec3& normal) {
        const double s = which == 0 ? path.begin() : path.end(), step = (which == 0 ? -1 : 1) * path.mean_edge() / 4;
        origin_ = path.at(s, Vec2::Zero());
        normal_ =
            normal.isZero() ? (path.at(s + step, Vec2::Zero()) - path.at(s - step, Vec2::Zero())).normalized() : normal;
    }
    std::string kind() const override { return "plane"; }
    double distance(const Vec3& x) const override { return normal_.dot(x - origin_); }
    Vec3 normal(const Vec3&) const override { return normal_; }
    double feature_size() const override { return std::numeric_limits<double>::infinity(); }

private:
    Vec3 origin_, normal_;
};

}  // namespace

void FilletPath::refuse(const std::string& text, const Vec3& near, const char* parameter) {
    std::ostringstream message;
    message << parameter << ": " << text << " near (" << near.transpose() << ")";
    throw ToolError(message.str(), parameter);
}

FilletPath::FilletPath(const Mesh& mesh, const FeatureLine& line, double radius,
                       const std::vector<std::array<Index, 3>>& skin, const FilletEnds& ends, const SkinPlanes* planes)
    : closed_(line.closed), slack_(mesh), radius_(radius), ends_(ends.kind) {
    std::vector<Vec3> points;
    points.reserve(line.nodes.size() + 1);
    for (const Index n : line.nodes) points.push_back(mesh.points[n]);
    if (closed_) points.push_back(points.front());
    if (planes) find_planes(line, *planes);
    fit(points);
    find_faces(mesh, line);
    const SkinNear near = skin_near(mesh, skin);
    for (const int which : {0, 1}) {
        if (closed_) break;
        if (ends_[which] == LineEnd::open) stop_at_corner(which, near);
        if (ends_[which] == LineEnd::joined) cut_back_at(which, ends.to_centre[which]);
        end_planes_[which] = std::make_unique<EndPlane>(*this, which, ends.normal[which]);
    }
    check_room(near);
}

FilletPath::FilletPath(const Mesh& mesh, const Vec3& corner, const Vec3& normal, const std::array<Vec3, 2>& faces,
                       bool convex, double radius)
    : convex_(convex), normal_3d_(normal), slack_(mesh), radius_(radius) {
    sag_ = 2 * slack_.off();
    pieces_.push_back({corner, normal, 0, 0, 0});
    normal_3d_ = faces[0];
    const Vec3 x = right(pieces_[0]);
    along_face_ = {Vec2(faces[0].dot(x), 1), Vec2(faces[1].dot(x), faces[1].dot(faces[0]))};
    // The material is on the left of the first face.
    set_faces({faces[0].cross(normal).dot(x), 0});
}

void FilletPath::fit(std::vector<Vec3> points) {
    for (std::size_t k = 1; k < points.size(); ++k) mean_edge_ += (points[k] - points[k - 1]).norm();
    mean_edge_ /= static_cast<double>(points.size() - 1);
    find_plane(points);
    std::vector<Vec3> corners = corners_on_arc(points);
    const bool on_chords = !corners.empty();
    if (on_chords) points = std::move(corners);
    for (std::size_t k = 0; k + 1 < points.size();) k = add_piece(points, k);
    if (is_straight() && planes_[0] && planes_[1]) lay_between_planes(points.front(), points.back());
    end_ = pieces_.back().begin + pieces_.back().length;
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Piece& piece = *std::ranges::find_if(pieces_, [&](const Piece& q) {
            return place((points[k] + points[k - 1]) / 2).s <= q.begin + q.length + 1e-9 * end_;
        });
        sag_ = std::max(sag_, (points[k] - points[k - 1]).squaredNorm() * std::abs(piece.curvature) / 7);
    }
    if (on_chords) chord_sag_ = sag_;
    // Both the nodes, and the ones by which the edge was found, may be off.
    sag_ += 2 * slack_.off();
}

/// Where an arc is of chords with nodes on them, as where solids of different divisions were joined: the corners. Else
/// none.
std::vector<Vec3> FilletPath::corners_on_arc(const std::vector<Vec3>& points) const {
    std::vector<Vec3> corners;
    const std::size_t count = points.size() - 1;
    for (std::size_t k = 0; k <= count; ++k) {
        if (!closed_ && (k == 0 || k == count)) {
            corners.push_back(points[k]);
            continue;
        }
        if (k == count) break;
        const Vec3 before = points[k] - points[k == 0 ? count - 1 : k - 1], after = points[k + 1] - points[k];
        const double one = before.norm(), other = after.norm(), turn = before.cross(after).norm() / (one * other);
        if (before.dot(after) <= 0 || turn > sharpest_turn) return {};
        if (turn > 1e-6 + slack_.direction(one) + slack_.direction(other)) corners.push_back(points[k]);
    }
    if (corners.size() < fewest_corners || corners.size() == count + (closed_ ? 0 : 1)) return {};
    if (!lie_on_arc(corners)) return {};
    if (closed_) corners.push_back(corners.front());
    return corners;
}

/// The planes that the faces beside all of the edge lie in.
void FilletPath::find_planes(const FeatureLine& line, const SkinPlanes& planes) {
    for (const int side : {0, 1}) {
        planes_[side] = planes.of(line.faces[0][side]);
        for (const auto& faces : line.faces) {
            const auto other = planes.of(faces[side]);
            if (planes_[side] && (!other || other->normal != planes_[side]->normal)) planes_[side] = std::nullopt;
        }
    }
}

/// A straight edge is where its faces meet.
void FilletPath::lay_between_planes(const Vec3& first, const Vec3& last) {
    Piece& piece = pieces_[0];
    const auto& [n, d] = *planes_[0];
    const auto& [m, e] = *planes_[1];
    const double c = n.dot(m), a = d - n.dot(first), b = e - m.dot(first);
    piece.start = first + ((a - c * b) * n + (b - c * a) * m) / (1 - c * c);
    const Vec3 along = n.cross(m).normalized();
    piece.tangent = along.dot(piece.tangent) < 0 ? Vec3(-along) : along;
    piece.length = (last - piece.start).dot(piece.tangent);
    normal_3d_ = (normal_3d_ - normal_3d_.dot(piece.tangent) * piece.tangent).normalized();
}

/// Throws if the edge is not plane.
void FilletPath::find_plane(const std::vector<Vec3>& points) {
    const Vec3& a = points.front();
    const Vec3& b = *std::ranges::max_element(points, {}, [&](const Vec3& p) { return (p - a).squaredNorm(); });
    const Vec3 along = (b - a).normalized();
    const auto off = [&](const Vec3& p) { return (p - a).cross(along).norm(); };
    const Vec3& c = *std::ranges::max_element(points, {}, off);
    const double close = 1e-6 * (b - a).norm() + 4 * slack_.off();
    normal_3d_ = off(c) <= close ? along.unitOrthogonal() : along.cross(c - a).normalized();
    for (const Vec3& p : points)
        if (std::abs(normal_3d_.dot(p - a)) > close)
            refuse(
                "the edge does not lie in a plane; only straight edges, arcs of circles and smooth sequences of these "
                "in one plane are rounded so far",
                p, "along");
    if (off(c) <= close) return;
    for (const auto& face : planes_)
        if (face && std::abs(face->normal.dot(normal_3d_)) > 0.999)
            normal_3d_ = face->normal.dot(normal_3d_) > 0 ? face->normal : Vec3(-face->normal);
}

/// The arc from a over b to c, up to its length.
FilletPath::Piece FilletPath::arc_through(const Vec3& a, const Vec3& b, const Vec3& c) const {
    Vec3 u = b - a, v = c - a;
    if (slack_.off() > 0)
        for (Vec3* x : {&u, &v}) *x -= x->dot(normal_3d_) * normal_3d_;
    const Vec3 w = u.cross(v);
    const Vec3 centre = a + (v.squaredNorm() * w.cross(u) + u.squaredNorm() * v.cross(w)) / (2 * w.squaredNorm());
    const double sign = w.dot(normal_3d_) > 0 ? 1 : -1, radius = (a - centre).norm();
    const Vec3 to_right = sign * (a - centre) / radius;
    return {a, normal_3d_.cross(to_right), sign / radius, 0, 0};
}

/// The arc that is nearest to points by least squares, of about the same.
FilletPath::Piece FilletPath::fitted(const Piece& arc, std::span<const Vec3> points) const {
    const Vec3 to_right = right(arc);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Vec3 by = Vec3::Zero();
    double level = 0;
    for (const Vec3& x : points) {
        const Vec3 d = x - arc.start;
        const Vec3 row(d.dot(to_right), d.dot(arc.tangent), 1);
        sum += row * row.transpose();
        by += row * (row.head<2>().squaredNorm());
        level += d.dot(normal_3d_) / static_cast<double>(points.size());
    }
    const Vec3 found = sum.ldlt().solve(by);
    const Vec2 centre = found.head<2>() / 2;
    const double radius = std::sqrt(found.z() + centre.squaredNorm());
    const Vec3 centre_3d = arc.start + centre.x() * to_right + centre.y() * arc.tangent + level * normal_3d_;
    const Vec3 out = (arc.start + level * normal_3d_ - centre_3d).normalized(),
               outwards = arc.curvature > 0 ? out : Vec3(-out);
    return {centre_3d + radius * out, normal_3d_.cross(outwards), arc.curvature > 0 ? 1 / radius : -1 / radius, 0, 0};
}

/// Whether points lie on an arc.
bool FilletPath::lie_on_arc(std::span<const Vec3> points) const {
    const Piece arc = fitted(arc_through(points[0], points[1], points[2]), points);
    const double radius = 1 / std::abs(arc.curvature);
    const Vec3 centre = arc.start - right(arc) / arc.curvature;
    return std::ranges::all_of(points, [&](const Vec3& x) {
        return std::abs((x - centre).norm() - radius) <= 1e-4 * radius + 4 * slack_.off();
    });
}

/// Adds the longest straight piece or arc from a point on; returns the place of its last point.
std::size_t FilletPath::add_piece(const std::vector<Vec3>& points, std::size_t first) {
    const Vec3& a = points[first];
    std::size_t straight = first + 1, arc = first;
    const auto goes_on = [&](const Vec3& x, const Vec3& next) {
        const double one = (x - a).norm(), other = (next - a).norm();
        return (next - a).dot(x - a) > 0 &&
               (x - a).cross(next - a).norm() <= (1e-6 + slack_.direction(one) + slack_.direction(other)) * one * other;
    };
    while (straight + 1 < points.size() && goes_on(points[straight], points[straight + 1])) ++straight;
    Piece piece{a, (points[straight] - a).normalized(), 0, end_, (points[straight] - a).norm()};
    if (straight == first + 1 && first + 2 < points.size()) {
        arc = first + 2;
        while (arc + 1 < points.size() && lie_on_arc(std::span(points).subspan(first, arc + 2 - first))) ++arc;
        // More exactly from points far apart.
        const bool whole = closed_ && first == 0 && arc + 1 == points.size();
        const std::size_t count = arc - first;
        piece = whole ? arc_through(a, points[count / 3], points[2 * count / 3])
                      : arc_through(a, points[first + count / 2], points[arc]);
        if (slack_.off() > 0) piece = fitted(piece, std::span(points).subspan(first, count + 1));
        piece.begin = end_;
        for (std::size_t k = first; k < arc; ++k) {
            const double half = (points[k + 1] - points[k]).norm() * std::abs(piece.curvature) / 2;
            piece.length += 2 * std::asin(std::min(1.0, half)) / std::abs(piece.curvature);
        }
        if (whole) piece.length = 2 * std::numbers::pi / std::abs(piece.curvature);
    }
    if (!pieces_.empty()) {
        const Piece& last = pieces_.back();
        const double turned = last.curvature * last.length;
        const Vec3 tangent = std::cos(turned) * last.tangent - std::sin(turned) * right(last);
        if ((tangent - piece.tangent).norm() > 0.02 + slack_.direction(last.length) + slack_.direction(piece.length))
            refuse("the edge bends in another way than arcs of circles and straight pieces that join smoothly do", a,
                   "along");
    }
    pieces_.push_back(piece);
    end_ = piece.begin + piece.length;
    return std::max(straight, arc);
}

FilletPath::Place FilletPath::place_by(const Piece& piece, const Vec3& x) const {
    const Vec3 to_right = right(piece);
    const double k = piece.curvature;
    if (k == 0) {
        const Vec3 d = x - piece.start;
        return {piece.begin + d.dot(piece.tangent), {d.dot(to_right), d.dot(normal_3d_)}};
    }
    const Vec3 d = x - piece.start + to_right / k;
    const double sign = k > 0 ? 1 : -1, u = sign * d.dot(to_right), v = sign * d.dot(piece.tangent);
    double angle = std::atan2(v, u);
    const double middle = k * piece.length / 2;
    while (angle < middle - std::numbers::pi) angle += 2 * std::numbers::pi;
    while (angle >= middle + std::numbers::pi) angle -= 2 * std::numbers::pi;
    return {piece.begin + angle / k, {sign * std::hypot(u, v) - 1 / k, d.dot(normal_3d_)}};
}

Vec3 FilletPath::at(const Piece& piece, double s, const Vec2& p) const {
    const Vec3 to_right = right(piece);
    const double k = piece.curvature, u = s - piece.begin;
    if (k == 0) return piece.start + u * piece.tangent + p.x() * to_right + p.y() * normal_3d_;
    const Vec3 out = std::cos(k * u) * to_right + std::sin(k * u) * piece.tangent;
    return piece.start - to_right / k + (1 / k + p.x()) * out + p.y() * normal_3d_;
}

FilletPath::Place FilletPath::place(const Vec3& x) const {
    if (pieces_.size() == 1) return place_by(pieces_[0], x);
    Place best{0, Vec2::Zero()};
    double nearest = std::numeric_limits<double>::infinity();
    for (const Piece& piece : pieces_) {
        const Place here = place_by(piece, x);
        const double low = &piece == &pieces_.front() && !closed_ ? -std::numeric_limits<double>::max() : piece.begin,
                     high = &piece == &pieces_.back() && !closed_ ? std::numeric_limits<double>::max()
                                                                  : piece.begin + piece.length;
        const double off = (x - at(piece, std::clamp(here.s, low, high), Vec2::Zero())).squaredNorm();
        if (off >= nearest) continue;
        nearest = off;
        best = here;
    }
    return best;
}

Vec3 FilletPath::at(double s, const Vec2& p) const {
    const auto after = std::ranges::find_if(pieces_, [&](const Piece& piece) { return piece.begin > s; });
    if (!closed_ || s < end_) return at(after == pieces_.begin() ? *after : *(after - 1), s, p);
    return at(s - end_, p);
}

double FilletPath::distance(const Vec3& x, double beyond) const {
    const auto [s, p] = place(x);
    if (closed_) return p.norm();
    const double past = std::max({0.0, begin_ - beyond - s, s - end_ - beyond});
    return std::hypot(p.norm(), past);
}

bool FilletPath::is_beyond_end(const Vec3& x) const {
    return std::ranges::any_of(std::array{0, 1}, [&](int which) {
        return !closed_ && ends_[which] == LineEnd::open && end_planes_[which]->distance(x) > 0 &&
               (which == 0 ? place(x).s <= begin_ + radius_ : place(x).s >= end_ - radius_);
    });
}

void FilletPath::find_faces(const Mesh& mesh, const FeatureLine& line) {
    std::array<Vec2, 2> sum{Vec2::Zero(), Vec2::Zero()};
    std::vector<std::array<Vec2, 2>> all;
    std::vector<std::array<double, 2>> off(line.faces.size());
    const double outside = pieces_[0].curvature > 0 ? -1 : 1;
    std::array<Vec2, 2> farthest{Vec2(2 * outside, 0), Vec2(2 * outside, 0)};
    for (std::size_t e = 0; e < line.faces.size(); ++e) {
        auto& here = all.emplace_back(std::array{Vec2(Vec2::Zero()), Vec2(Vec2::Zero())});
        for (const int side : {0, 1}) {
            for (const Index n : line.faces[e][side])
                if (std::ranges::find(line.nodes, n) == line.nodes.end()) {
                    const Vec2 p = place(mesh.points[n]).p;
                    here[side] = p.normalized();
                    off[e][side] = slack_.direction(p.norm()) + chord_sag_ / p.norm();
                }
            sum[side] += here[side];
            // What lies on chords is nearer to the axis than the surface.
            if (!here[side].isZero() && outside * here[side].x() < outside * farthest[side].x())
                farthest[side] = here[side];
            face_slack_ = std::max(face_slack_, off[e][side]);
        }
    }
    for (const int side : {0, 1})
        along_face_[side] = along_plane(side, chord_sag_ > 0 ? farthest[side] : Vec2(sum[side].normalized()));
    if (is_straight() && planes_[0] && planes_[1]) face_slack_ = slack_.direction(length());
    for (std::size_t e = 0; e < all.size(); ++e)
        for (const int side : {0, 1})
            if (!all[e][side].isZero() && (all[e][side] - along_face_[side]).norm() > 2e-3 + 2 * off[e][side])
                refuse(is_straight()
                           ? "a face beside the edge is not plane"
                           : "a face beside the edge is neither a plane nor a cylinder or cone about its axis",
                       mesh.points[line.nodes[e]], "along");
    const Vec2 &d = along_face_[0], &e = along_face_[1];
    // The first face's normal, from its triangle beside the first edge.
    const auto& f = line.faces[0][0];
    const Vec3 n = (mesh.points[f[1]] - mesh.points[f[0]]).cross(mesh.points[f[2]] - mesh.points[f[0]]).normalized();
    const Vec3 middle = (mesh.points[f[0]] + mesh.points[f[1]] + mesh.points[f[2]]) / 3;
    const auto [s, p] = place(middle);
    const Vec2 turned(-d.y(), d.x());
    const Vec3 turned_3d = at(s, p + turned) - at(s, p);
    const Vec2 outwards = turned_3d.dot(n) > 0 ? turned : Vec2(-turned);
    convex_ = outwards.dot(e) < 0;
    set_faces(outwards);
}

/// The direction of a face, by the plane in which it lies if that is known.
Vec2 FilletPath::along_plane(int side, const Vec2& about) const {
    if (!planes_[side]) return about;
    const Vec2 n(planes_[side]->normal.dot(right(pieces_[0])), planes_[side]->normal.dot(normal_3d_));
    // Beside an arc a plane that is not across its axis is not the same in all sections.
    if (n.norm() < 1 - 1e-9 || (!is_straight() && std::abs(n.x()) > 1e-9)) return about;
    const Vec2 along = Vec2(-n.y(), n.x()).normalized();
    return along.dot(about) < 0 ? Vec2(-along) : along;
}

/// What follows from where the faces are, and the first one's normal out of the material.
void FilletPath::set_faces(const Vec2& normal) {
    const Vec2 &d = along_face_[0], &e = along_face_[1];
    normal_[0] = normal;
    normal_[1] = Vec2(-e.y(), e.x());
    if ((normal_[1].dot(d) < 0) != convex_) normal_[1] = -normal_[1];

    const double angle = std::acos(std::clamp(d.dot(e), -1.0, 1.0));
    tangent_length_ = radius_ / std::tan(angle / 2);
    centre_ = (d + e).normalized() * radius_ / std::sin(angle / 2);
    to_first_ = (tangent_point(0) - centre_) / radius_;
    across_ = Vec2(-to_first_.y(), to_first_.x());
    if (across_.dot(tangent_point(1) - centre_) < 0) across_ = -across_;
    arc_angle_ = std::numbers::pi - angle;
    for (const int face : {0, 1}) {
        walls_[face] = std::make_unique<RollingWall>(*this, face);
        used_walls_[face] = walls_[face].get();
    }
    ball_ = std::make_unique<Ball>(*this);
}

}  // namespace femscalpel
