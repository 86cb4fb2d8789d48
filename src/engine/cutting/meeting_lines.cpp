// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/meeting_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace femscalpel {
namespace {

/// A line that turns more than this (cosine), or whose surfaces do, has a corner there.
const double corner = std::cos(30 * M_PI / 180);
/// A line of this part of the edges' length is but a point.
constexpr double far_shorter = 0.1;
/// So many tolerances are near.
constexpr double nearby = 5;

/// Normals of surfaces may point either way.
void add_normal(Vec3& sum, const Vec3& n) { sum += sum.dot(n) < 0 ? Vec3(-n) : n; }

double length(const MeetingLine& line) {
    double sum = 0;
    for (std::size_t k = 1; k < line.points.size(); ++k) sum += (line.points[k].at - line.points[k - 1].at).norm();
    return sum;
}

/// Lines far shorter than the edges of the surfaces become one point.
void contract(std::vector<MeetingLine>& lines) {
    for (std::size_t k = 0; k < lines.size();) {
        const MeetingLine& line = lines[k];
        const MeetingLine::Point &p = line.points.front(), &q = line.points.back();
        const double size = std::min({p.size[0], p.size[1], q.size[0], q.size[1]});
        if (line.closed || length(line) > far_shorter * size) {
            ++k;
            continue;
        }
        // The first mesh stays as it is.
        const bool first = p.node[0] >= 0 || (q.node[0] < 0 && p.node[1] >= 0);
        const MeetingLine::Point kept = first ? p : q, gone = first ? q : p;
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(k));
        for (MeetingLine& other : lines)
            for (MeetingLine::Point* end : {&other.points.front(), &other.points.back()}) {
                if (end->at != gone.at && end->at != kept.at) continue;
                end->at = kept.at;
                for (const std::size_t m : {0U, 1U}) end->node[m] = std::max(kept.node[m], gone.node[m]);
            }
        std::erase_if(lines, [](const MeetingLine& l) { return !l.closed && length(l) == 0; });
        k = 0;
    }
}

void turn_alike(MeetingLine& line) {
    for (MeetingLine::Point& p : line.points)
        for (Vec3& n : p.normal) n.normalize();
    for (std::size_t k = 1; k < line.points.size(); ++k)
        for (const std::size_t m : {0U, 1U})
            if (line.points[k].normal[m].dot(line.points[k - 1].normal[m]) < 0) line.points[k].normal[m] *= -1;
}

}  // namespace

MeetingLines::Cell MeetingLines::cell_of(const Vec3& x) const {
    const double size = 2 * tolerance_;
    return {static_cast<std::int64_t>(std::floor(x[0] / size)), static_cast<std::int64_t>(std::floor(x[1] / size)),
            static_cast<std::int64_t>(std::floor(x[2] / size))};
}

/// The point nearest to a place, if near enough, or -1.
int MeetingLines::find(const Vec3& x) const {
    const Cell c = cell_of(x);
    int best = -1;
    double least = 2 * tolerance_;
    for (std::int64_t i = -1; i <= 1; ++i)
        for (std::int64_t j = -1; j <= 1; ++j)
            for (std::int64_t k = -1; k <= 1; ++k) {
                const auto found = cells_.find({c[0] + i, c[1] + j, c[2] + k});
                if (found == cells_.end()) continue;
                for (const int p : found->second)
                    if (const double d = (points_[p].at - x).norm(); d < least) {
                        least = d;
                        best = p;
                    }
            }
    return best;
}

int MeetingLines::point(const Vec3& x) {
    if (const int p = find(x); p >= 0) return p;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const int p = static_cast<int>(points_.size());
    points_.push_back({x, {Vec3::Zero(), Vec3::Zero()}, {-1, -1}, {infinite, infinite}});
    cells_[cell_of(x)].push_back(p);
    return p;
}

void MeetingLines::add_node(const Vec3& at, std::size_t mesh, Index node) {
    const int p = point(at);
    if (points_[p].node[mesh] < 0) points_[p].node[mesh] = node;
}

void MeetingLines::join(int p, int q) {
    next_[p].insert(q);
    next_[q].insert(p);
}

void MeetingLines::add(const Span& span, const Sides& sides, double reach) {
    int from = point(span[0]);
    const int to = point(span[1]);
    for (const int p : points_on(from, to, reach)) {
        add_piece(from, p, sides);
        from = p;
    }
    add_piece(from, to, sides);
}

void MeetingLines::add_piece(int p, int q, const Sides& sides) {
    for (const int v : {p, q})
        for (const std::size_t m : {0U, 1U}) points_[v].size[m] = std::min(points_[v].size[m], sides.size[m]);
    if (p == q) return;
    Normals& normals = normals_.try_emplace(std::minmax(p, q), Normals{Vec3::Zero(), Vec3::Zero()}).first->second;
    for (const std::size_t m : {0U, 1U}) add_normal(normals[m], sides.normal[m]);
    join(p, q);
}

/// The points between two that are no farther than `reach` from the segment between them, along it.
std::vector<int> MeetingLines::points_on(int p, int q, double reach) const {
    std::vector<std::pair<double, int>> found;
    const Vec3 &a = points_[p].at, way = points_[q].at - a;
    const double length2 = way.squaredNorm();
    for (int v = 0; v < static_cast<int>(points_.size()) && reach > 0 && length2 > 0; ++v) {
        const double t = (points_[v].at - a).dot(way) / length2;
        if (v != p && v != q && t > 0 && t < 1 && (points_[v].at - a - t * way).norm() <= reach)
            found.push_back({t, v});
    }
    std::ranges::sort(found);
    std::vector<int> out;
    out.reserve(found.size());
    for (const auto& [t, v] : found) out.push_back(v);
    return out;
}

/// Loose ends closer to each other than a few tolerances are joined.
void MeetingLines::bridge() {
    std::vector<int> loose;
    for (const auto& [p, others] : next_)
        if (others.size() == 1) loose.push_back(p);
    for (std::size_t i = 0; i < loose.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const int p = loose[i], q = loose[j];
            if (next_[p].size() != 1 || next_[q].size() != 1 || next_[p].contains(q)) continue;
            if ((points_[p].at - points_[q].at).norm() > 2 * nearby * tolerance_) continue;
            normals_.emplace(std::minmax(p, q), normals_.at(std::minmax(p, *next_[p].begin())));
            join(p, q);
        }
}

/// Takes out points that are but crossings of edges and very near to others: they say nothing of the line, and where it
/// seems to go from there is mostly tolerance.
void MeetingLines::thin() {
    for (const auto& [p, others] : next_) {
        if (others.size() != 2 || points_[p].node[0] >= 0 || points_[p].node[1] >= 0) continue;
        const int a = *others.begin(), b = *others.rbegin();
        const double to_a = (points_[p].at - points_[a].at).norm(), to_b = (points_[p].at - points_[b].at).norm();
        if (std::min(to_a, to_b) > nearby * tolerance_ || next_[a].contains(b)) continue;
        // What is left has the normals of the longer.
        const Normals normals = normals_.at(std::minmax(p, to_a > to_b ? a : b));
        normals_.insert_or_assign(std::minmax(a, b), normals);
        for (const int q : {a, b}) next_[q].erase(p);
        next_[p].clear();
        join(a, b);
    }
    std::erase_if(next_, [](const auto& entry) { return entry.second.empty(); });
}

/// Where the line goes from p through its neighbour q, far enough not to be mostly tolerance.
Vec3 MeetingLines::direction(int p, int q) const {
    int from = p, to = q;
    while ((points_[to].at - points_[p].at).norm() < 2 * nearby * tolerance_) {
        const std::set<int>& others = next_.at(to);
        if (others.size() != 2) break;
        const int next = *others.begin() == from ? *others.rbegin() : *others.begin();
        if (next == p) break;
        from = to;
        to = next;
    }
    return (points_[to].at - points_[p].at).normalized();
}

bool MeetingLines::is_end(int p) const {
    const std::set<int>& others = next_.at(p);
    if (others.size() != 2) return !others.empty();
    if (-direction(p, *others.begin()).dot(direction(p, *others.rbegin())) < corner) return true;
    const Normals &before = normals_.at(std::minmax(p, *others.begin())),
                  &after = normals_.at(std::minmax(p, *others.rbegin()));
    return std::abs(before[0].dot(after[0])) < corner || std::abs(before[1].dot(after[1])) < corner;
}

/// The line from a point on through its neighbour, to where it ends, taken out of what is left.
MeetingLine MeetingLines::walk(int from, int to) {
    MeetingLine line;
    line.points.push_back(points_[from]);
    const int start = from;
    for (;;) {
        next_[from].erase(to);
        next_[to].erase(from);
        line.closed = to == start;
        if (!line.closed) line.points.push_back(points_[to]);
        const Normals& normals = normals_.at(std::minmax(from, to));
        for (MeetingLine::Point* p : {&line.points[line.points.size() - (line.closed ? 1 : 2)],
                                      line.closed ? &line.points.front() : &line.points.back()})
            for (const std::size_t m : {0U, 1U}) add_normal(p->normal[m], normals[m]);
        if (line.closed || next_[to].size() != 1 || stops_.contains(to)) break;
        from = to;
        to = *next_[from].begin();
    }
    turn_alike(line);
    return line;
}

void MeetingLines::prune(double length) {
    std::vector<int> loose;
    for (const auto& [p, others] : next_)
        if (others.size() == 1) loose.push_back(p);
    for (const int start : loose) {
        std::vector<int> way{start};
        double sum = 0;
        while (sum <= length && next_[way.back()].size() == (way.size() == 1 ? 1U : 2U)) {
            const std::set<int>& others = next_[way.back()];
            const int next =
                way.size() > 1 && *others.begin() == way[way.size() - 2] ? *others.rbegin() : *others.begin();
            sum += (points_[next].at - points_[way.back()].at).norm();
            way.push_back(next);
        }
        if (sum > length || next_[way.back()].size() < 3) continue;
        for (std::size_t k = 1; k < way.size(); ++k) {
            next_[way[k - 1]].erase(way[k]);
            next_[way[k]].erase(way[k - 1]);
        }
    }
    std::erase_if(next_, [](const auto& entry) { return entry.second.empty(); });
}

std::vector<MeetingLine> MeetingLines::pieces() {
    bridge();
    thin();
    for (auto& [edge, normals] : normals_)
        for (Vec3& n : normals) n.normalize();
    for (const auto& [p, others] : next_)
        if (is_end(p)) stops_.insert(p);
    std::vector<MeetingLine> out;
    for (const int p : stops_)
        for (const int q : std::set<int>(next_[p]))
            if (next_[p].contains(q)) out.push_back(walk(p, q));
    for (const auto& [p, others] : next_)
        if (!others.empty()) out.push_back(walk(p, *others.begin()));
    std::erase_if(out, [&](const MeetingLine& line) { return length(line) < 4 * tolerance_; });
    contract(out);
    return out;
}

}  // namespace femscalpel
