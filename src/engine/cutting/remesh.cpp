// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/remesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "cancel.h"
#include "cutting/wall.h"
#include "deck/mark_deck.h"
#include "deformation/curved_shape.h"
#include "deformation/relaxation.h"

namespace femscalpel {
namespace {

/// Edges longer than this are bisected, and nodes at shorter than that merged, in lengths of the input.
constexpr double too_long = 2.0, too_short = 0.4;
/// Elements worse than this get their longest edge bisected, in so many rounds at most.
constexpr double split_below = 0.25;
constexpr int split_rounds = 4;
/// An element that has at least this part of the mean ratio it had has not become poor.
constexpr double as_it_was = 0.85;
/// Relaxation leaves elements better than this alone, and those that have nearly the mean ratio they had.
constexpr double good = 0.55, unstrained = 0.97;

/// Whether a node group means each of its members: it is no such thing as all nodes of a part, which holds all
/// neighbours of the node, too.
bool means_it_alone(const Mesh& mesh, const BandMesh& band, int node, std::vector<int>& neighbours) {
    const auto groups = mesh.families.groups(mesh.node_families[band.nodes[node].global]);
    if (groups.empty()) return false;
    band.neighbours(node, neighbours);
    return std::ranges::any_of(groups, [&](GroupIndex g) {
        if (mesh.groups[g].hidden) return mesh.groups[g].name.starts_with(mark_prefix);
        return std::ranges::any_of(
            neighbours, [&](int w) { return !mesh.families.contains(mesh.node_families[band.nodes[w].global], g); });
    });
}

}  // namespace

Remesher::Remesher(Workpiece& f, const Mesh& mesh, std::function<bool(int)> slides)
    : f_(f), d_(f.d), band_(f.d.band), merger_(f), slides_(std::move(slides)) {
    for (int v = 0; v < band_.size(); ++v) {
        size_.push_back(band_.mean_edge_length(v));
        material_.push_back(band_.nodes[v].at);
    }
    for (int t = 0; t < band_.tetras.size(); ++t) tetra_was_.push_back(tetra_quality(d_, t));
    for (int t = 0; t < band_.triangles.size(); ++t)
        shell_was_.push_back(d_.constraints.is_shell(t) ? shell_quality(d_, t) : 1);
    find_removable(mesh);
}

void Remesher::find_removable(const Mesh& mesh) {
    std::vector<int> neighbours;
    SparseCheck check(64);
    for (int v = 0; v < band_.size(); ++v, check())
        removable_.push_back(band_.nodes[v].movable() && !d_.constraints.is_held(v) && !d_.constraints.is_related(v) &&
                             !means_it_alone(mesh, band_, v, neighbours));
}

std::vector<int> Remesher::movable() const {
    std::vector<int> out;
    for (int v = 0; v < band_.size(); ++v)
        if (band_.nodes[v].movable() && band_.in_use(v) && slides_(v)) out.push_back(v);
    return out;
}

Remesher::Worst Remesher::worst() const {
    Worst out{1, Vec3::Zero()};
    const auto look = [&](double quality, const auto& nodes) {
        if (!(quality < out.mean_ratio)) return;
        out = {quality, Vec3::Zero()};
        for (const int v : nodes) out.at += material_[v] / static_cast<double>(nodes.size());
    };
    for (int t = 0; t < band_.tetras.size(); ++t)
        if (band_.tetras.alive(t)) look(tetra_quality(d_, t), band_.tetras[t]);
    for (int t = 0; t < band_.triangles.size(); ++t)
        if (band_.triangles.alive(t) && d_.constraints.is_shell(band_.triangles.origin(t)))
            look(shell_quality(d_, t), band_.triangles[t]);
    return out;
}

/// The length of an edge in the input, or where it is a new one that of edges there: the shorter or the longer.
double Remesher::wanted(int a, int b, bool shortest) const {
    const double length = (material_[a] - material_[b]).norm();
    if (!band_.is_new(a) && !band_.is_new(b)) return length;
    const double mean = (size_[a] + size_[b]) / 2;
    return shortest ? std::min(mean, length) : std::max(mean, length);
}

double Remesher::was(BandElement e) const { return (e.triangle ? shell_was_ : tetra_was_)[e.origin(band_)]; }

bool Remesher::exists(int a, int b) const { return in_one(band_.tetras, a, b) || in_one(band_.triangles, a, b); }

/// The edges with a movable end that `counts(excess)`, each once.
std::vector<Remesher::Edge> Remesher::edges(bool shortest, auto counts) const {
    std::vector<Edge> out;
    std::vector<int> neighbours;
    SparseCheck check(64);
    for (int v = 0; v < band_.size(); ++v, check()) {
        if (!band_.in_use(v) || !band_.nodes[v].movable()) continue;
        band_.neighbours(v, neighbours);
        for (const int w : neighbours) {
            if (band_.nodes[w].movable() && w < v) continue;
            const double excess = (band_.nodes[v].at - band_.nodes[w].at).norm() / wanted(v, w, shortest);
            if (counts(excess) && exists(v, w)) out.push_back({excess, v, w});
        }
    }
    return out;
}

bool Remesher::split(int a, int b) {
    if (d_.constraints.has_fixed_middle(a, b) || d_.constraints.is_related_edge(band_, a, b)) return false;
    const Contact tools = d_.edge_contact(a, b);
    const auto [at, fits, worst] = d_.fitted_split(a, b, d_.along_edge(a, b, 0.5), tools);
    const bool bent = !d_.constraints.is_straight(d_.constraints.on_edge(band_, a, b));
    // Off its tool a node would be off it for good.
    if (((bent || tools) && !fits) || worst < 0.02 || curved_children(d_, a, b, at, tools) < curved_limit) return false;
    touched_.push_back(d_.split_edge(a, b, at, tools));
    size_.push_back((size_[a] + size_[b]) / 2);
    material_.push_back((material_[a] + material_[b]) / 2);
    f_.distance.push_back(0);
    return true;
}

bool Remesher::may_go(int v) const {
    if (!band_.in_use(v) || !band_.nodes[v].movable()) return false;
    if (wall_tags(band_, v).size() > 1) return false;
    if (band_.is_new(v)) return band_.nodes[v].global < 0;
    if (!removable_[v]) return false;
    const NodeConstraint& c = d_.constraints[v];
    if (c.freedom == NodeFreedom::fixed || !d_.constraints.is_straight(c)) return false;
    // A wall without a tool is what its nodes make it.
    return !is_on_wall(band_, v) || d_.contact[v];
}

int Remesher::merge(int v) {
    const int target = merger_.merge(v);
    if (target < 0) return target;
    touched_.push_back(target);
    if (band_.is_new(v)) return target;
    band_.nodes[v].gone = true;
    ++taken_out_;
    return target;
}

bool Remesher::split_long() {
    std::vector<Edge> found = edges(false, [](double excess) { return excess > too_long; });
    std::ranges::sort(found, [](const Edge& x, const Edge& y) {
        return std::tie(y.excess, x.a, x.b) < std::tie(x.excess, y.a, y.b);
    });
    bool any = false;
    for (const Edge& e : found) any = (exists(e.a, e.b) && split(e.a, e.b)) || any;
    return any;
}

bool Remesher::merge_short() {
    std::vector<Edge> found = edges(true, [](double excess) { return excess < too_short; });
    std::ranges::sort(found, [](const Edge& x, const Edge& y) {
        return std::tie(x.excess, x.a, x.b) < std::tie(y.excess, y.a, y.b);
    });
    bool any = false;
    for (const Edge& e : found)
        for (const int v : {e.a, e.b})
            if (may_go(e.a) + may_go(e.b) > 0 && may_go(v) && exists(e.a, e.b) && merge(v) >= 0) any = true;
    return any;
}

/// Those worse than `goal`, and than they were.
std::vector<Remesher::Poor> Remesher::poor_elements(double goal) const {
    check_cancelled();
    std::vector<Poor> out;
    for (int t = 0; t < band_.tetras.size(); ++t) {
        if (!band_.tetras.alive(t)) continue;
        const double limit = std::min(goal, as_it_was * was({false, t}));
        if (tetra_is_below(limit, d_, t)) out.push_back({tetra_quality(d_, t), band_.tetras[t]});
    }
    for (int t = 0; t < band_.triangles.size(); ++t)
        if (band_.triangles.alive(t) && d_.constraints.is_shell(band_.triangles.origin(t)))
            if (const double q = shell_quality(d_, t); q < std::min(goal, as_it_was * was({true, t}))) {
                const auto& v = band_.triangles[t];
                out.push_back({q, {v[0], v[1], v[2], -1}});
            }
    std::ranges::sort(out);
    return out;
}

bool Remesher::merge_poor(double goal) {
    bool any = false;
    std::vector<char> in_vain(static_cast<std::size_t>(band_.size()), 0);
    for (const Poor& e : poor_elements(goal))
        for (const int v : e.nodes) {
            if (v < 0 || in_vain[v] || !may_go(v)) continue;
            in_vain[v] = 1;
            const int target = merge(v);
            if (target < 0) continue;
            any = true;
            for (const int w : band_.nodes_near({target}, 2)) in_vain[w] = 0;
        }
    return any;
}

bool Remesher::split_poor(double limit) {
    bool any = false;
    for (const Poor& e : poor_elements(limit)) {
        int a = -1, b = -1;
        double longest = 0;
        for (const int v : e.nodes)
            for (const int w : e.nodes) {
                if (v < 0 || w < 0 || w >= v || (!band_.nodes[v].movable() && !band_.nodes[w].movable())) continue;
                const double length = (band_.nodes[v].at - band_.nodes[w].at).squaredNorm();
                if (length > longest) std::tie(longest, a, b) = std::tuple(length, v, w);
            }
        any = (a >= 0 && exists(a, b) && split(a, b)) || any;
    }
    return any;
}

double Remesher::shortfall(double limit) const {
    double sum = 0;
    for (const Poor& e : poor_elements(limit)) sum += (limit - e.quality) * (limit - e.quality);
    return sum;
}

std::vector<int> Remesher::strained() const {
    std::vector<char> in(static_cast<std::size_t>(band_.size()), 0);
    for (int t = 0; t < band_.tetras.size(); ++t)
        if (band_.tetras.alive(t) && tetra_is_below(std::min(good, unstrained * was({false, t})), d_, t))
            for (const int v : band_.tetras[t]) in[v] = 1;
    for (int t = 0; t < band_.triangles.size(); ++t)
        if (band_.triangles.alive(t) && d_.constraints.is_shell(band_.triangles.origin(t)) &&
            shell_quality(d_, t) < std::min(good, unstrained * was({true, t})))
            for (const int v : band_.triangles[t]) in[v] = 1;
    std::vector<int> out = movable();
    std::erase_if(out, [&](int v) { return in[v] == 0; });
    return out;
}

void Remesher::relax_touched() {
    const std::vector<int> all = movable(), near = band_.nodes_near(std::exchange(touched_, {}), 2);
    std::vector<int> there;
    std::ranges::set_intersection(all, near, std::back_inserter(there));
    relax_from(d_, there, there);
}

void Remesher::run(double goal) {
    for (int round = 0; round < 4 && split_long(); ++round) relax_touched();
    for (int round = 0; round < 4 && merge_short(); ++round) relax_touched();
    for (int round = 0; round < 4 && merge_poor(goal); ++round) relax_touched();
    double best = shortfall(split_below);
    for (int round = 0, idle = 0; round < split_rounds && idle < 2 && best > 0 && split_poor(split_below); ++round) {
        relax_touched();
        if (merge_poor(goal)) relax_touched();
        const double now = shortfall(split_below);
        idle = now < 0.95 * best ? 0 : idle + 1;
        best = std::min(best, now);
    }
}

}  // namespace femscalpel
