// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/bisection.h"

#include <queue>
#include <sstream>

#include "cancel.h"
#include "deformation/relaxation.h"

namespace femscalpel {
namespace {

/// Edges of elements that cannot be bisected, between nodes of the band.
std::unordered_set<std::uint64_t> blocked_edges(const Mesh& mesh, const BandMesh& band) {
    std::unordered_set<std::uint64_t> blocked;
    std::vector<int> local(mesh.points.size(), -1);
    for (int v = 0; v < band.size(); ++v) local[band.nodes[v].global] = v;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.simplex) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (const auto& e : t.edges)
                if (local[n[e[0]]] >= 0 && local[n[e[1]]] >= 0)
                    blocked.insert(edge_key(local[n[e[0]]], local[n[e[1]]]));
        }
    }
    return blocked;
}

/// What squares of lengths in a band are multiplied by so that single precision holds them: a power of two, which
/// leaves their digits as they are.
double unit_of(const BandMesh& band) {
    double size = 0;
    for (const auto& node : band.nodes) size = std::max(size, (node.at - band.nodes[0].at).norm());
    return size > 0 ? std::ldexp(1.0, -2 * std::ilogb(size)) : 1;
}

/// Parts of elements with a mean ratio below this are not made.
constexpr double spoilt = 0.02;

}  // namespace

ToolError too_many_elements(const BisectionOptions& options) {
    std::ostringstream message;
    message << "size " << options.size << " would make more than " << options.max_elements << " elements. "
            << options.finer_advice << options.larger_advice;
    return ToolError(message.str(), "size");
}

Bisector::Bisector(Deformable& d, const Mesh& mesh, const SizeField& field, const BisectionOptions& options,
                   std::vector<double> distance, bool may_grow)
    : d_(d),
      band_(d.band),
      mesh_(mesh),
      field_(field),
      options_(options),
      distance_(std::move(distance)),
      may_grow_(may_grow),
      unit_(unit_of(d.band)),
      blocked_(blocked_edges(mesh, d.band)),
      geometry_(d.band, d.mids, mesh) {}

bool Bisector::run() {
    const int rounds = options_.relax ? 3 : 1;
    for (int round = 0; round < rounds; ++round) {
        const int before = band_.size();
        if (!split_long_edges()) return false;
        if (band_.size() == before || !options_.relax) break;
        improve();
        if (round == rounds - 1 && !split_long_edges()) return false;  // what relaxing has stretched
    }
    if (options_.skin) put_on_shape();
    return true;
}

Vec3 Bisector::middle(int a, int b) const {
    return strayed_[a] || strayed_[b] ? Vec3((band_.nodes[a].at + band_.nodes[b].at) / 2) : geometry_.middle(a, b);
}

Vec3 Bisector::mid_side(int a, int b) const {
    Vec3 x = middle(a, b);
    if (!options_.skin || (!band_.is_new(a) && !band_.is_new(b))) return x;
    const NodeConstraint on = d_.constraints.on_edge(band_, a, b);
    if (Vec3 put = x; d_.constraints.is_on_shape(on) && d_.constraints.project(on, {}, put) &&
                      (put - x).norm() < 0.2 * (band_.nodes[a].at - band_.nodes[b].at).norm())
        x = put;
    return x;
}

Bisector::Edge Bisector::edge(int a, int b) const {
    const double length = unit_ * (band_.nodes[a].at - band_.nodes[b].at).squaredNorm();
    return {static_cast<float>(length), std::min(a, b), std::max(a, b)};
}

bool Bisector::exceeded(int a, int b) const {
    return field_.exceeded(band_.nodes[a].at, band_.nodes[b].at, distance_[a], distance_[b]);
}

bool Bisector::exists(int a, int b) const {
    bool found = false;
    for_each_around(a, b, [&](const auto&) { found = true; });
    return found;
}

bool Bisector::split_long_edges() {
    std::priority_queue<Edge> queue;
    std::vector<int> neighbours;
    const auto gather = [&](int v, bool once) {
        band_.neighbours(v, neighbours);
        for (const int w : neighbours)
            if ((!once || v < w) && is_inside(v, w) && exceeded(v, w) && exists(v, w)) queue.push(edge(v, w));
    };
    SparseCheck check(64);
    for (int v = 0; v < band_.size(); ++v, check()) gather(v, true);
    while (!queue.empty()) {
        check();
        const Edge e = queue.top();
        if (!exists(e.a, e.b) || left_.contains(edge_key(e.a, e.b))) {
            queue.pop();
            continue;
        }
        const Edge longest = terminal(e);
        if (!is_inside(longest.a, longest.b)) return false;
        if (longest.a == e.a && longest.b == e.b) queue.pop();
        if (split(longest.a, longest.b)) gather(band_.size() - 1, false);
    }
    return true;
}

Bisector::Edge Bisector::terminal(Edge e) const {
    for (;;) {
        Edge longest = e;
        for_each_around(e.a, e.b, [&](const auto& nodes) {
            for (std::size_t i = 0; i < nodes.size(); ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    const Edge other = edge(nodes[i], nodes[j]);
                    const std::uint64_t key = edge_key(other.a, other.b);
                    if (!(longest < other) || blocked_.contains(key) || left_.contains(key)) continue;
                    if (may_grow_ || is_inside(other.a, other.b)) longest = other;
                }
        });
        if (longest.a == e.a && longest.b == e.b) return e;
        e = longest;
        if (!is_inside(e.a, e.b)) return e;
    }
}

bool Bisector::would_spoil(int a, int b, const Vec3& at) const {
    if (at == (band_.nodes[a].at + band_.nodes[b].at) / 2) return false;
    const double worst = d_.worst_part(a, b, at);
    return worst < spoilt && worst < d_.worst_part(a, b, (band_.nodes[a].at + band_.nodes[b].at) / 2) / 2;
}

bool Bisector::split(int a, int b) {
    Vec3 at = middle(a, b);
    if (would_spoil(a, b, at)) {
        left_.insert(edge_key(a, b));
        return false;
    }
    geometry_.add_node(a, b);
    // On the shape the mesh was made from, if that leaves sound elements.
    bool on_shape = false;
    if (options_.skin && d_.constraints.is_on_shape(d_.constraints.on_edge(band_, a, b)) &&
        !d_.constraints.has_fixed_middle(a, b)) {
        const Deformable::SplitPoint point = d_.fitted_split(a, b, at, {});
        on_shape = point.fits && point.worst > 0.1;
        if (on_shape) at = point.at;
    }
    d_.split_edge(a, b, at, {});
    strayed_.push_back(on_shape || strayed_[a] || strayed_[b]);
    distance_.push_back(field_.distance(at));
    if (mesh_.cell_count() + band_.tetras.size() + band_.triangles.size() <= options_.max_elements + count_at_start_)
        return true;
    throw too_many_elements(options_);
}

void Bisector::put_on_shape() {
    bool moved = true;
    for (int round = 0; round < 5 && moved; ++round) {
        moved = false;
        off_shape_ = 0;
        for (int v = band_.original_nodes(); v < band_.size(); ++v) {
            Vec3 x = band_.nodes[v].at;
            if (!d_.constraints.is_on_shape(d_.constraints[v]) ||
                d_.constraints.distance(d_.constraints[v], x) <= 1e-9 * band_.mean_edge_length(v))
                continue;
            if (!d_.constraints.project(v, {}, x) ||
                quality_around(d_, v, x) < std::min(0.1, quality_around(d_, v, band_.nodes[v].at))) {
                ++off_shape_;
                continue;
            }
            band_.nodes[v].at = x;
            distance_[v] = field_.distance(x);
            strayed_[v] = 1;
            moved = true;
        }
    }
}

void Bisector::improve() {
    std::vector<int> movable;
    SparseCheck check(64);
    for (int v = band_.original_nodes(); v < band_.size(); ++v, check()) {
        if (band_.nodes[v].global >= 0 || geometry_.is_curved_around(v)) continue;
        const NodeConstraint& c = d_.constraints[v];
        if (c.freedom == NodeFreedom::fixed ||
            (c.freedom == NodeFreedom::surface && !d_.constraints.is_flat(c.shape)) ||
            (c.freedom == NodeFreedom::curve && !d_.constraints.is_straight(c.shape)))
            continue;
        movable.push_back(v);
    }
    relax(d_, movable);
    for (const int v : movable) {
        distance_[v] = field_.distance(band_.nodes[v].at);
        strayed_[v] = strayed_[v] || band_.nodes[v].at != band_.nodes[v].start;
    }
}

}  // namespace femscalpel
