// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/surface_line.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>
#include <sstream>

#include "cutting/root.h"
#include "deformation/curved_shape.h"
#include "mesh/closest_point.h"

namespace femscalpel {
namespace {

/// A surface that stands this steep in a ribbon (sine of the angle between its normal and the direction in which the
/// ribbon stands) is not the one it stands on.
constexpr double lying = 0.4;

void check_joined(const Deformable& d, int a, int b) {
    const BandMesh& band = d.band;
    if (are_joined(d, a, b)) return;
    if (band.nodes[a].at == band.nodes[b].at)
        throw QualityError("the seam runs across double nodes, of a crack's lips or a contact, at " +
                           point_text(band.nodes[a].at) +
                           ": join the two before it is cracked, or move the addition off the double nodes");
    throw QualityError("the seam cannot be made edges between " + point_text(band.nodes[a].at) + " and " +
                       point_text(band.nodes[b].at) +
                       ": the mesh is too coarse there, or something there holds its nodes. Refine the mesh there "
                       "first, or move the addition a little");
}

}  // namespace

std::string point_text(const Vec3& x) {
    std::ostringstream out;
    out << "(" << x.transpose() << ")";
    return out.str();
}

bool is_surface_face(const Deformable& d, int skin) {
    return d.band.skin.alive(skin) && !d.constraints.geometry().surfaces[d.band.skin.tag(skin)].internal;
}

bool are_joined(const Deformable& d, int a, int b) {
    return std::ranges::any_of(d.band.skin.around(a), [&](int s) {
        return is_surface_face(d, s) && std::ranges::find(d.band.skin[s], b) != d.band.skin[s].end();
    });
}

std::vector<int> line_nodes(const Workpiece& f, const ImprintLine& line, const std::vector<int>& at_stop) {
    const Ribbon& ribbon = *line.ribbon;
    std::vector<std::pair<double, int>> order;
    std::set<int> listed;
    const double slack = 1e-6 * ribbon.length();
    const auto list = [&](int v, double arc) {
        if (listed.insert(v).second) order.push_back({arc, v});
    };
    for (std::size_t k = 0; k < at_stop.size(); ++k)
        if (at_stop[k] >= 0) list(at_stop[k], line.stops[k]);
    for (int v = 0; v < f.d.band.size(); ++v) {
        if (!f.d.contact[v].has(&ribbon) || !f.d.band.in_use(v)) continue;
        const double arc = ribbon.foot(f.d.band.nodes[v].at).arc;
        if (ribbon.closed() || (arc >= -slack && arc <= ribbon.length() + slack)) list(v, arc);
    }
    std::ranges::sort(order);
    std::vector<int> out;
    out.reserve(order.size());
    for (const auto& [arc, v] : order) out.push_back(v);
    for (std::size_t k = 0; k + (ribbon.closed() ? 0 : 1) < out.size(); ++k)
        check_joined(f.d, out[k], out[(k + 1) % out.size()]);
    return out;
}

bool SurfaceLine::is_surface(int skin) const { return is_surface_face(d_, skin); }

const Vec3& SurfaceLine::at(int v) const { return band_.nodes[v].at; }

double SurfaceLine::length(int a, int b) const { return (at(a) - at(b)).norm(); }

double SurfaceLine::surface_edge(int v) const {
    double sum = 0;
    int count = 0;
    for (const int s : band_.skin.around(v)) {
        if (!is_surface(s)) continue;
        for (const int w : band_.skin[s])
            if (w != v) {
                sum += length(v, w);
                ++count;
            }
    }
    return count ? sum / count : band_.mean_edge_length(v);
}

const Vec3& SurfaceLine::wanted(std::size_t stop) const { return line_.places[stop]; }

void SurfaceLine::hold(int v, std::size_t stop) {
    const Ribbon::Foot foot = ribbon_.foot(wanted(stop));
    planes_.push_back(std::make_unique<Plane>(at(v), foot.tangent));
    Contact tools = d_.contact[v];
    if (!tools.full()) tools = tools.with(&ribbon_);
    if (!tools.full()) tools = tools.with(planes_.back().get());
    f_.bound_at_stop.emplace(v, d_.constraints[v].freedom > NodeFreedom::surface);
    d_.hold_beside(v, tools);
    at_stop_[stop] = v;
    if (static_cast<std::size_t>(v) < value_.size()) value_[v] = 0;
}

bool SurfaceLine::is_held(int v) const { return d_.constraints[v].freedom == NodeFreedom::fixed; }

bool SurfaceLine::move(int v, Vec3 target, double enough, double close) {
    BandNode& node = band_.nodes[v];
    if (!node.movable()) return false;
    const Vec3 asked = target;
    if (!d_.constraints.project(v, {}, target) || (target - asked).norm() > close) return false;
    if (exact_) target = asked;
    if ((target - node.start).norm() > d_.constraints.leash(v)) return false;
    const double before = quality_around(d_, v, node.at), after = quality_around(d_, v, target);
    if (!(after >= std::min(enough, before / 4)) || !(after > 0) || !keeps_curved_shape(d_, v, target)) return false;
    node.at = target;
    return true;
}

std::pair<int, Vec3> SurfaceLine::face_at(const Vec3& x) const {
    int best = -1;
    Vec3 foot = x, bary;
    double least = std::numeric_limits<double>::infinity();
    for (int s = 0; s < band_.skin.size(); ++s) {
        if (!is_surface(s)) continue;
        const auto& n = band_.skin[s];
        const Vec3 q = closest_on_triangle(at(n[0]), at(n[1]), at(n[2]), x, bary);
        if ((q - x).norm() >= least) continue;
        least = (q - x).norm();
        best = s;
        foot = q;
    }
    return {best, foot};
}

void SurfaceLine::extend_values() {
    for (int v = static_cast<int>(value_.size()); v < band_.size() && measured_; ++v) value_.push_back(value_of(v));
}

double SurfaceLine::value_of(int v) const {
    if (d_.contact[v].has(&ribbon_)) return 0;
    return ribbon_.distance(at(v));
}

void SurfaceLine::measure() {
    measured_ = true;
    value_.clear();
    extend_values();
    for (const int v : at_stop_)
        if (v >= 0) value_[v] = 0;
    const double close = std::max(f_.tolerance, d_.rounding);
    for (const int s : region())
        for (const int v : band_.skin[s])
            if (!d_.contact[v].has(&ribbon_) && !d_.contact[v].full() && std::abs(value_[v]) <= close &&
                within_ends(at(v))) {
                d_.contact[v] = d_.contact[v].with(&ribbon_);
                value_[v] = 0;
            }
}

bool SurfaceLine::within_ends(const Vec3& x) const {
    if (ribbon_.closed()) return true;
    const double arc = ribbon_.foot(x).arc, slack = 1e-9 * ribbon_.length();
    return arc > -slack && arc < ribbon_.length() + slack;
}

bool SurfaceLine::carries_line(int s) const {
    const auto& n = band_.skin[s];
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int v : n) {
        low = std::min(low, value_[v]);
        high = std::max(high, value_[v]);
    }
    return low <= 0 && high >= 0 && lies_there(s);
}

bool SurfaceLine::lies_there(int s) const {
    const auto& n = band_.skin[s];
    const Vec3 middle = (at(n[0]) + at(n[1]) + at(n[2])) / 3, normal = (at(n[1]) - at(n[0])).cross(at(n[2]) - at(n[0]));
    const double size = std::sqrt(normal.norm());
    const Ribbon::Foot foot = ribbon_.foot(middle);
    if (std::abs(normal.dot(foot.standing)) < lying * normal.norm()) return false;
    if (std::abs(foot.standing.dot(middle - foot.at)) > off_line * size) return false;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const int v : n) {
        const double arc = ribbon_.closed() ? 0 : ribbon_.foot(at(v)).arc;
        least = std::min(least, arc);
        most = std::max(most, arc);
    }
    return ribbon_.closed() || (most > 0 && least < ribbon_.length());
}

std::vector<int> SurfaceLine::region() const {
    std::vector<int> out;
    std::deque<int> next;
    std::set<int> seen;
    const auto visit = [&](int s) {
        if (is_surface(s) && seen.insert(s).second && carries_line(s)) next.push_back(s);
    };
    for (const int v : at_stop_)
        if (v >= 0)
            for (const int s : band_.skin.around(v)) visit(s);
    // The line may but dip into a face, whose nodes are all on one side.
    for (int k = 0; k < 8 && ribbon_.closed(); ++k)
        if (const int near = face_at(ribbon_.at(k * ribbon_.length() / 8)).first; near >= 0)
            for (const int v : band_.skin[near])
                for (const int s : band_.skin.around(v)) visit(s);
    while (!next.empty()) {
        const int s = next.front();
        next.pop_front();
        out.push_back(s);
        for (const int v : band_.skin[s])
            for (const int t : band_.skin.around(v)) visit(t);
    }
    std::ranges::sort(out);
    return out;
}

std::vector<std::pair<int, int>> SurfaceLine::crossing_edges() const {
    std::set<std::pair<int, int>> found;
    for (const int s : region())
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(band_.skin[s][k], band_.skin[s][(k + 1) % 3]);
            if (value_[a] * value_[b] < 0 && within_ends(crossing(a, b))) found.insert({a, b});
        }
    std::vector<std::pair<int, int>> out(found.begin(), found.end());
    std::ranges::stable_sort(out, std::greater(), [&](const auto& e) { return length(e.first, e.second); });
    return out;
}

Vec3 SurfaceLine::crossing(int a, int b) const {
    const auto point = [&](double t) { return d_.along_edge(a, b, t); };
    return point(
        root_between(value_[a], value_[b], 1e-3 * f_.tolerance, [&](double t) { return ribbon_.distance(point(t)); }));
}

}  // namespace femscalpel
