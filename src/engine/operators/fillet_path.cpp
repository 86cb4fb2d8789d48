// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_path.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "cancel.h"
#include "mesh/closest_point.h"

namespace femscalpel {
namespace {

[[noreturn]] void refuse(const std::string& text, const Vec3& near, const char* parameter) {
    std::ostringstream message;
    message << parameter << ": " << text << " near (" << near.transpose() << ")";
    throw ToolError(message.str(), parameter);
}

/// A surface that is a straight line in sections across the edge.
class Wall final : public Tool {
public:
    Wall(const FilletPath& path, int face) : path_(path), face_(face) {}
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

}  // namespace

FilletPath::FilletPath(const Mesh& mesh, const FeatureLine& line, double radius,
                       const std::vector<std::array<Index, 3>>& skin)
    : closed_(line.closed), radius_(radius) {
    fit(mesh, line);
    find_faces(mesh, line);
    check_room(mesh, skin);
}

FilletPath::FilletPath(const Vec3& corner, const Vec3& normal, const std::array<Vec3, 2>& faces, bool convex,
                       double radius)
    : convex_(convex), origin_(corner), direction_(normal), radius_(radius) {
    x_ = faces[0];
    y_ = direction_.cross(x_);
    along_face_ = {Vec2(1, 0), Vec2(faces[1].dot(x_), faces[1].dot(y_))};
    set_faces({0, -1});
}

void FilletPath::fit(const Mesh& mesh, const FeatureLine& line) {
    std::vector<Vec3> points;
    for (const Index n : line.nodes) points.push_back(mesh.points[n]);
    for (std::size_t k = 1; k < points.size(); ++k) mean_edge_ += (points[k] - points[k - 1]).norm();
    mean_edge_ /= static_cast<double>(points.size() - 1);
    const Vec3 chord = points.back() - points.front();
    double off = 0;
    for (const Vec3& p : points)
        off = std::max(off, (p - points.front()).cross(chord).norm() / std::max(chord.norm(), 1e-300));
    if (!closed_ && off <= 1e-6 * chord.norm()) {
        origin_ = points.front();
        direction_ = chord.normalized();
        x_ = direction_.unitOrthogonal();
        y_ = direction_.cross(x_);
        end_ = chord.norm();
        return;
    }
    fit_circle(points);
    for (const Vec3& p : points)
        if (place(p).p.norm() > 1e-4 * edge_radius_)
            refuse("the edge is neither straight nor an arc of one circle; only such edges are rounded so far", p,
                   "along");
    double longest = 0;
    for (std::size_t k = 1; k < points.size(); ++k) longest = std::max(longest, (points[k] - points[k - 1]).norm());
    sag_ = edge_radius_ - std::sqrt(std::max(0.0, edge_radius_ * edge_radius_ - longest * longest / 4));
    begin_ = 0;
    end_ = closed_ ? 2 * std::numbers::pi * edge_radius_ : place(points.back()).s;
}

void FilletPath::fit_circle(const std::vector<Vec3>& points) {
    const std::size_t n = points.size();
    const Vec3 &a = points[0], &b = points[n / 3], &c = points[closed_ ? 2 * n / 3 : n - 1];
    const Vec3 u = b - a, v = c - a, w = u.cross(v);
    if (w.norm() < 1e-9 * u.norm() * v.norm()) refuse("the edge bends in an unknown way", a, "along");
    origin_ = a + (v.squaredNorm() * w.cross(u) + u.squaredNorm() * v.cross(w)) / (2 * w.squaredNorm());
    direction_ = w.normalized();
    edge_radius_ = (a - origin_).norm();
    x_ = (a - origin_).normalized();
    y_ = direction_.cross(x_);
}

FilletPath::Place FilletPath::place(const Vec3& x) const {
    const Vec3 d = x - origin_;
    if (edge_radius_ == 0) return {d.dot(direction_), {d.dot(x_), d.dot(y_)}};
    const double u = d.dot(x_), v = d.dot(y_);
    double angle = std::atan2(v, u);
    // An open arc's parameter must not jump near its beginning or end.
    const double middle = closed_ ? std::numbers::pi : (begin_ + end_) / 2 / edge_radius_;
    while (angle < middle - std::numbers::pi) angle += 2 * std::numbers::pi;
    while (angle >= middle + std::numbers::pi) angle -= 2 * std::numbers::pi;
    if (!closed_ && end_ == 0 && angle < 0) angle += 2 * std::numbers::pi;  // while it is being fitted
    return {angle * edge_radius_, {std::hypot(u, v) - edge_radius_, d.dot(direction_)}};
}

Vec3 FilletPath::at(double s, const Vec2& p) const {
    if (edge_radius_ == 0) return origin_ + s * direction_ + p.x() * x_ + p.y() * y_;
    const double angle = s / edge_radius_;
    return origin_ + (edge_radius_ + p.x()) * (std::cos(angle) * x_ + std::sin(angle) * y_) + p.y() * direction_;
}

double FilletPath::distance(const Vec3& x, double beyond) const {
    const auto [s, p] = place(x);
    if (closed_) return p.norm();
    const double past = std::max({0.0, begin_ - beyond - s, s - end_ - beyond});
    return std::hypot(p.norm(), past);
}

void FilletPath::find_faces(const Mesh& mesh, const FeatureLine& line) {
    std::array<Vec2, 2> sum{Vec2::Zero(), Vec2::Zero()};
    std::vector<std::array<Vec2, 2>> all;
    for (std::size_t e = 0; e < line.faces.size(); ++e) {
        auto& here = all.emplace_back(std::array{Vec2(Vec2::Zero()), Vec2(Vec2::Zero())});
        for (const int side : {0, 1}) {
            for (const Index n : line.faces[e][side])
                if (std::ranges::find(line.nodes, n) == line.nodes.end())
                    here[side] = place(mesh.points[n]).p.normalized();
            sum[side] += here[side];
        }
    }
    for (const int side : {0, 1}) along_face_[side] = sum[side].normalized();
    for (std::size_t e = 0; e < all.size(); ++e)
        for (const int side : {0, 1})
            if (!all[e][side].isZero() && (all[e][side] - along_face_[side]).norm() > 2e-3)
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
    for (const int face : {0, 1}) walls_[face] = std::make_unique<Wall>(*this, face);
    ball_ = std::make_unique<Ball>(*this);
}

void FilletPath::check_room(const Mesh& mesh, const std::vector<std::array<Index, 3>>& skin) const {
    // The largest tangent length that finds each face under the tangent point, at some places along the edge.
    Eigen::AlignedBox3d box;
    const int places = std::clamp(static_cast<int>(length() / mean_edge_), 4, 64);
    const auto sample = [&](int k) { return begin_ + length() * (k + 0.5) / places; };
    for (int k = 0; k < places; ++k)
        for (const int side : {0, 1}) box.extend(at(sample(k), 1.02 * tangent_point(side)));
    const double margin = 2 * sag_ + 1e-3 * tangent_length_;
    box.min().array() -= 2 * margin;
    box.max().array() += 2 * margin;
    std::vector<std::array<Vec3, 3>> near;
    for (const auto& f : skin) {
        Eigen::AlignedBox3d own;
        for (const Index n : f) own.extend(mesh.points[n]);
        if (box.intersects(own)) near.push_back({mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]});
    }
    for (int k = 0; k < places; ++k)
        for (const int side : {0, 1}) {
            check_cancelled();
            const double s = sample(k);
            // Seen a little beyond the tangent line: a face must not end at it.
            const Vec3 x = at(s, 1.02 * tangent_point(side)),
                       n = (at(s, tangent_point(side) + normal_[side]) - at(s, tangent_point(side))).normalized();
            if (!is_straight() && edge_radius_ + 1.02 * tangent_point(side).x() <= 0)
                refuse("too large for a face beside the edge: the tangent line passes the axis", at(s, Vec2::Zero()),
                       "radius");
            double nearest = std::numeric_limits<double>::infinity();
            Vec3 weights;
            for (const auto& t : near) {
                if ((t[1] - t[0]).cross(t[2] - t[0]).normalized().dot(n) < 0.8) continue;
                nearest = std::min(nearest, (closest_on_triangle(t[0], t[1], t[2], x, weights) - x).norm());
            }
            if (nearest > margin) {
                std::ostringstream text;
                text << radius_ << " is too large for a face beside the edge, which ends, or is not what it is at the "
                     << "edge, before the distance of " << tangent_length_ << " at which it would be touched";
                refuse(text.str(), at(s, Vec2::Zero()), "radius");
            }
        }
}

}  // namespace femscalpel
