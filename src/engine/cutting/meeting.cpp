// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/meeting.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <unsupported/Eigen/BVH>

#include "cancel.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;
using Triangle = std::array<Vec3, 3>;

/// A line that turns more than this (cosine), or whose surfaces do, has a corner there.
const double corner = std::cos(30 * M_PI / 180);
/// Sine of the angle below which two faces do not cross but lie on each other.
constexpr double nearly_parallel = 0.03;

/// Part of a plane's line that a triangle has.
using Span = std::array<Vec3, 2>;

/// Where a triangle crosses a plane, of which its vertices are so far; nothing if in less than a segment, or all of it.
std::optional<Span> cross_plane(const Triangle& t, std::array<double, 3> off, double tolerance) {
    std::array<Vec3, 6> found;
    std::size_t count = 0;
    for (double& d : off)
        if (std::abs(d) <= tolerance) d = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (off[k] == 0) found[count++] = t[k];
    if (count == 3) return {};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        if (off[k] * off[l] < 0) found[count++] = t[k] + off[k] / (off[k] - off[l]) * (t[l] - t[k]);
    }
    if (count != 2) return {};
    return Span{found[0], found[1]};
}

/// The segment in which two triangles cross.
std::optional<Span> cross(const Triangle& a, const Triangle& b, double tolerance) {
    const Vec3 na = (a[1] - a[0]).cross(a[2] - a[0]).normalized(), nb = (b[1] - b[0]).cross(b[2] - b[0]).normalized();
    const Vec3 along = na.cross(nb);
    if (along.norm() < nearly_parallel) return {};
    std::array<double, 3> off_a{}, off_b{};
    for (std::size_t k = 0; k < 3; ++k) {
        off_a[k] = nb.dot(a[k] - b[0]);
        off_b[k] = na.dot(b[k] - a[0]);
    }
    const auto of_a = cross_plane(a, off_a, tolerance), of_b = cross_plane(b, off_b, tolerance);
    if (!of_a || !of_b) return {};
    const Vec3 direction = along.normalized();
    const auto ordered = [&](Span s) {
        if (direction.dot(s[1] - s[0]) < 0) std::swap(s[0], s[1]);
        return s;
    };
    const Span p = ordered(*of_a), q = ordered(*of_b);
    // A node of b has the say where one of a is not nearer to the end of what both have.
    const Vec3 low = direction.dot(p[0] - q[0]) > tolerance ? p[0] : q[0];
    const Vec3 high = direction.dot(p[1] - q[1]) < -tolerance ? p[1] : q[1];
    if (direction.dot(high - low) <= tolerance) return {};
    // Spans of planes that are but tolerance apart at the vertices may miss each other sideways.
    for (const Vec3& x : {low, high})
        for (const Span& s : {p, q}) {
            const Vec3 way = s[1] - s[0];
            const double t = std::clamp((x - s[0]).dot(way) / way.squaredNorm(), 0.0, 1.0);
            if ((s[0] + t * way - x).norm() > 4 * tolerance) return {};
        }
    return Span{low, high};
}

/// For Eigen's BVIntersect: all pairs of faces whose boxes meet.
struct Pairs {
    const std::vector<Box>& first;
    const std::vector<Box>& second;
    std::vector<std::pair<int, int>> found;

    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVIntersect() calls them.
    bool intersectVolumeVolume(const Box& a, const Box& b) { return a.intersects(b); }
    bool intersectVolumeObject(const Box& a, int b) { return a.intersects(second[b]); }
    bool intersectObjectVolume(int a, const Box& b) { return first[a].intersects(b); }
    bool intersectObjectObject(int a, int b) {
        if (first[a].intersects(second[b])) found.push_back({a, b});
        return false;
    }
    // NOLINTEND(readability-identifier-naming)
};

Triangle corners(const Mesh& mesh, const SurfaceFace& f) {
    return {mesh.points[f.nodes[0]], mesh.points[f.nodes[1]], mesh.points[f.nodes[2]]};
}

std::vector<std::pair<int, int>> near_pairs(const std::array<const Mesh*, 2>& mesh,
                                            const std::array<std::vector<SurfaceFace>, 2>& faces, double tolerance) {
    std::array<std::vector<Box>, 2> boxes;
    std::array<Eigen::KdBVH<double, 3, int>, 2> trees;
    for (std::size_t m = 0; m < 2; ++m) {
        std::vector<int> objects;
        for (const SurfaceFace& f : faces[m]) {
            Box box;
            for (const Vec3& x : corners(*mesh[m], f)) box.extend(x);
            box.min().array() -= tolerance;
            box.max().array() += tolerance;
            objects.push_back(static_cast<int>(boxes[m].size()));
            boxes[m].push_back(box);
        }
        trees[m].init(objects.begin(), objects.end(), boxes[m].begin(), boxes[m].end());
    }
    Pairs pairs{boxes[0], boxes[1], {}};
    Eigen::BVIntersect(trees[0], trees[1], pairs);
    std::ranges::sort(pairs.found);
    return pairs.found;
}

/// Segments as a graph, whose points are one where they are nearer than the tolerance.
class Lines {
public:
    explicit Lines(double tolerance) : tolerance_(tolerance) {}

    void add(const Span& span, const Vec3& normal_a, const Vec3& normal_b) {
        const int p = point(span[0]), q = point(span[1]);
        if (p == q) return;
        for (const int v : {p, q}) {
            add_normal(points_[v].normal[0], normal_a);
            add_normal(points_[v].normal[1], normal_b);
        }
        next_[p].insert(q);
        next_[q].insert(p);
    }

    /// Makes a point the node of a mesh that lies there.
    void name_node(const Vec3& x, std::size_t mesh, Index node) {
        const int p = find(x);
        if (p < 0 || points_[p].node[mesh] >= 0) return;
        points_[p].node[mesh] = node;
        // The first mesh stays as it is.
        if (mesh == 0 || points_[p].node[0] < 0) points_[p].at = x;
    }

    std::vector<MeetingLine> pieces() {
        bridge();
        for (MeetingLine::Point& p : points_)
            for (Vec3& n : p.normal) n.normalize();
        for (const auto& [p, others] : next_)
            if (is_end(p)) stops_.insert(p);
        std::vector<MeetingLine> out;
        for (const int p : stops_)
            for (const int q : std::set<int>(next_[p]))
                if (next_[p].contains(q)) out.push_back(walk(p, q));
        for (const auto& [p, others] : next_)
            if (!others.empty()) out.push_back(walk(p, *others.begin()));
        std::erase_if(out, [&](const MeetingLine& line) { return length(line) < 3 * tolerance_; });
        for (MeetingLine& line : out) turn_alike(line);
        return out;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    static void add_normal(Vec3& sum, const Vec3& n) { sum += sum.dot(n) < 0 ? Vec3(-n) : n; }

    Cell cell_of(const Vec3& x) const {
        const double size = 2 * tolerance_;
        return {static_cast<std::int64_t>(std::floor(x[0] / size)), static_cast<std::int64_t>(std::floor(x[1] / size)),
                static_cast<std::int64_t>(std::floor(x[2] / size))};
    }

    int find(const Vec3& x) const {
        const Cell c = cell_of(x);
        int best = -1;
        double least = 2 * tolerance_;
        for (std::int64_t i = -1; i <= 1; ++i)
            for (std::int64_t j = -1; j <= 1; ++j)
                for (std::int64_t k = -1; k <= 1; ++k) {
                    const auto found = cells_.find({c[0] + i, c[1] + j, c[2] + k});
                    if (found == cells_.end()) continue;
                    for (const int p : found->second)
                        if (const double d = (first_at_[p] - x).norm(); d < least) {
                            least = d;
                            best = p;
                        }
                }
        return best;
    }

    int point(const Vec3& x) {
        if (const int p = find(x); p >= 0) return p;
        const int p = static_cast<int>(points_.size());
        points_.push_back({x, {Vec3::Zero(), Vec3::Zero()}, {-1, -1}});
        first_at_.push_back(x);
        cells_[cell_of(x)].push_back(p);
        return p;
    }

    /// Points closer than a few tolerances to each other, both at loose ends, are one place.
    void bridge() {
        std::vector<int> loose;
        for (const auto& [p, others] : next_)
            if (others.size() == 1) loose.push_back(p);
        for (std::size_t i = 0; i < loose.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const int p = loose[i], q = loose[j];
                if (next_[p].size() != 1 || next_[q].size() != 1 || next_[p].contains(q)) continue;
                if ((points_[p].at - points_[q].at).norm() > 4 * tolerance_) continue;
                next_[p].insert(q);
                next_[q].insert(p);
            }
    }

    bool is_end(int p) const {
        const std::set<int>& others = next_.at(p);
        if (others.size() != 2) return !others.empty();
        const Vec3 in = (points_[p].at - points_[*others.begin()].at).normalized(),
                   out = (points_[*others.rbegin()].at - points_[p].at).normalized();
        if (in.dot(out) < corner) return true;
        return std::ranges::any_of(others, [&](int q) {
            for (std::size_t m = 0; m < 2; ++m)
                if (std::abs(points_[p].normal[m].dot(points_[q].normal[m])) < corner) return true;
            return false;
        });
    }

    MeetingLine walk(int from, int to) {
        MeetingLine line;
        line.points.push_back(points_[from]);
        const int start = from;
        for (;;) {
            next_[from].erase(to);
            next_[to].erase(from);
            if (to == start && !stops_.contains(to)) {
                line.closed = true;
                return line;
            }
            line.points.push_back(points_[to]);
            if (next_[to].size() != 1 || stops_.contains(to)) return line;
            from = to;
            to = *next_[from].begin();
        }
    }

    static double length(const MeetingLine& line) {
        double sum = 0;
        for (std::size_t k = 1; k < line.points.size(); ++k) sum += (line.points[k].at - line.points[k - 1].at).norm();
        return sum;
    }

    static void turn_alike(MeetingLine& line) {
        for (std::size_t k = 1; k < line.points.size(); ++k)
            for (std::size_t m = 0; m < 2; ++m)
                if (line.points[k].normal[m].dot(line.points[k - 1].normal[m]) < 0) line.points[k].normal[m] *= -1;
    }

    double tolerance_;
    std::vector<MeetingLine::Point> points_;
    std::vector<Vec3> first_at_;  // by point: where it was found
    std::map<Cell, std::vector<int>> cells_;
    std::map<int, std::set<int>> next_;
    std::set<int> stops_;  // where pieces end
};

}  // namespace

std::vector<MeetingLine> find_meeting(const Mesh& a, const Mesh& b, double tolerance) {
    const std::array<const Mesh*, 2> mesh{&a, &b};
    Box common = box_around(a).intersection([&] {
        Box box = box_around(b);
        box.min().array() -= tolerance;
        box.max().array() += tolerance;
        return box;
    }());
    if (common.isEmpty()) return {};
    common.min().array() -= tolerance;
    common.max().array() += tolerance;
    const std::array<std::vector<SurfaceFace>, 2> faces{surface_near(a, common), surface_near(b, common)};
    if (faces[0].empty() || faces[1].empty()) return {};
    Lines lines(tolerance);
    SparseCheck check(64);
    std::array<std::set<Index>, 2> nodes;
    for (const auto& [i, j] : near_pairs(mesh, faces, tolerance)) {
        check();
        const Triangle p = corners(a, faces[0][i]), q = corners(b, faces[1][j]);
        const auto span = cross(p, q, tolerance);
        if (!span) continue;
        lines.add(*span, (p[1] - p[0]).cross(p[2] - p[0]).normalized(), (q[1] - q[0]).cross(q[2] - q[0]).normalized());
        nodes[0].insert(faces[0][i].nodes.begin(), faces[0][i].nodes.end());
        nodes[1].insert(faces[1][j].nodes.begin(), faces[1][j].nodes.end());
    }
    for (const std::size_t m : {0U, 1U})
        for (const Index n : nodes[m]) lines.name_node(mesh[m]->points[n], m, n);
    return lines.pieces();
}

}  // namespace femscalpel
