// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/relaxation.h"

#include <Eigen/Cholesky>
#include <unordered_map>
#include <utility>

#include "cancel.h"
#include "deformation/curved_shape.h"
#include "deformation/star.h"

namespace femscalpel {
namespace {

/// Moves a node to lower the star's value, by Newton steps in its tangent space that end at places `allowed`.
void minimise(Deformable& d, const Star& star, int v, const auto& tangent, int doublings, auto allowed) {
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
    BandNode& node = d.band.nodes[v];
    const Contact& tools = d.contact[v];
    Vec3 gradient;
    Eigen::Matrix3d hessian;
    double value = star.derivatives(node.at, doublings, gradient, hessian);
    for (int iteration = 0; iteration < 3; ++iteration) {
        const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> g = tangent.transpose() * gradient;
        Small h = tangent.transpose() * hessian * tangent;
        Eigen::LDLT<Small> factors(h);
        if (factors.info() != Eigen::Success || !factors.isPositive()) {
            h.diagonal().array() += h.norm();
            factors.compute(h);
        }
        const Vec3 step = -(tangent * factors.solve(g));
        double length = 1;
        bool accepted = false;
        for (int halving = 0; halving < 7 && !accepted; ++halving, length *= 0.5) {
            Vec3 x = node.at + length * step;
            if (!d.constraints.project(v, tools, x) || d.is_barred(v, x)) continue;
            const double tried = star.value(x, doublings);
            if (!(tried < value) || !allowed(x)) continue;
            accepted = true;
            if (value - tried < 1e-3 * value) iteration = 99;
            node.at = x;
            value = tried;
        }
        if (!accepted) break;
        if (iteration < 2) value = star.derivatives(node.at, doublings, gradient, hessian);
    }
}

/// The sweeps of relax_from().
class Relaxation {
public:
    Relaxation(Deformable& d, const RelaxationOptions& options)
        : d_(d),
          band_(d.band),
          options_(options),
          poor_tetra_(static_cast<std::size_t>(band_.tetras.size())),
          poor_shell_(static_cast<std::size_t>(band_.triangles.size())),
          may_move_(static_cast<std::size_t>(band_.size()), 0),
          dirty_(static_cast<std::size_t>(band_.size()), 0) {
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (band_.tetras.alive(t)) look_at_tetra(t);
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (band_.triangles.alive(t)) look_at_shell(t);
    }

    /// Moves `near` first, then `movable`; returns how often a node was moved.
    long run(const std::vector<int>& near, const std::vector<int>& movable) {
        for (const int v : near) may_move_[v] = 1;
        std::vector<int> active;
        SparseCheck check(16);
        long moves = 0;
        for (int sweep = 0; sweep < 2 * options_.sweeps; ++sweep) {
            const bool last_stage = sweep >= options_.sweeps;
            if (sweep % options_.sweeps == 0) active = near;
            if (sweep == options_.sweeps)
                for (const int v : movable) may_move_[v] = 1;
            if (active.empty()) continue;
            next_.clear();
            for (const int v : active) dirty_[v] = 0;
            for (const int v : active) {
                check();
                if (!is_poor(v)) continue;
                const Vec3 before = band_.nodes[v].at;
                move(v, last_stage ? 4 : 3);
                if (band_.nodes[v].at == before) continue;
                ++moves;
                look_around(v, before);
            }
            active.swap(next_);
        }
        return moves;
    }

private:
    void look_at_tetra(int t) { poor_tetra_[t] = tetra_is_below(options_.target, d_, t); }
    void look_at_shell(int t) {
        poor_shell_[t] = d_.constraints.is_shell(band_.triangles.origin(t)) && shell_quality(d_, t) < options_.target;
    }

    bool is_poor(int v) const {
        return std::ranges::any_of(band_.tetras.around(v), [&](int t) { return poor_tetra_[t] != 0; }) ||
               std::ranges::any_of(band_.triangles.around(v), [&](int t) { return poor_shell_[t] != 0; });
    }

    void move(int v, int doublings) {
        BandNode& node = band_.nodes[v];
        Eigen::Matrix3d basis;
        const int freedom = d_.constraints.tangents(v, d_.contact[v], node.at, basis);
        if (freedom == 0) return;
        ++d_.visits;
        star_.gather(d_, v);
        const auto tangent = basis.leftCols(freedom);
        const Vec3 before = node.at;
        CurvedStar& curved = curved_stars_.try_emplace(v, d_, v).first->second;
        curved.forget_places();
        // Second-order elements are looked at where the node comes to, and on the way only if it must not come there.
        minimise(d_, star_, v, tangent, doublings, [](const Vec3&) { return true; });
        if (node.at == before) return;
        const Vec3 after = std::exchange(node.at, before);
        if (curved.stays_sound(after))
            node.at = after;
        else
            minimise(d_, star_, v, tangent, doublings, [&](const Vec3& x) { return curved.stays_sound(x); });
    }

    /// After a move: which elements are poor now, and which nodes have a reason to move again.
    void look_around(int v, const Vec3& before) {
        for (const int t : band_.tetras.around(v)) look_at_tetra(t);
        for (const int t : band_.triangles.around(v)) look_at_shell(t);
        const double reach = band_.mean_edge_length(v);
        if ((band_.nodes[v].at - before).norm() < 1e-3 * reach) return;
        const auto wake = [&](const auto& list) {
            for (const int s : list.around(v))
                for (const int w : list[s])
                    if (may_move_[w] && !dirty_[w]) {
                        dirty_[w] = 1;
                        next_.push_back(w);
                    }
        };
        wake(band_.tetras);
        wake(band_.triangles);
    }

    Deformable& d_;
    BandMesh& band_;
    const RelaxationOptions& options_;
    std::vector<char> poor_tetra_, poor_shell_;  ///< worse than the target: only they give nodes a reason to move
    std::vector<char> may_move_, dirty_;         ///< by node
    std::vector<int> next_;
    Star star_;
    std::unordered_map<int, CurvedStar> curved_stars_;
};

}  // namespace

long relax(Deformable& d, const std::vector<int>& movable, const RelaxationOptions& options) {
    return relax_from(d, movable, movable, options);
}

long relax_from(Deformable& d, const std::vector<int>& near, const std::vector<int>& movable,
                const RelaxationOptions& options) {
    return Relaxation(d, options).run(near, movable);
}

}  // namespace femscalpel
