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

}  // namespace

long relax(Deformable& d, const std::vector<int>& movable, const RelaxationOptions& options) {
    return relax_from(d, movable, movable, options);
}

long relax_from(Deformable& d, const std::vector<int>& near, const std::vector<int>& movable,
                const RelaxationOptions& options) {
    BandMesh& band = d.band;
    std::vector<char> may_move(static_cast<std::size_t>(band.size()), 0);
    for (const int v : near) may_move[v] = 1;
    // Elements worse than the target; only they give their nodes a reason to move.
    std::vector<char> poor_tetra(static_cast<std::size_t>(band.tetras.size())),
        poor_shell(static_cast<std::size_t>(band.triangles.size()));
    const auto look_at_shell = [&](int t) {
        poor_shell[t] = d.constraints.is_shell(band.triangles.origin(t)) && shell_quality(d, t) < options.target;
    };
    for (int t = 0; t < band.tetras.size(); ++t)
        if (band.tetras.alive(t)) poor_tetra[t] = tetra_is_below(options.target, d, t);
    for (int t = 0; t < band.triangles.size(); ++t)
        if (band.triangles.alive(t)) look_at_shell(t);
    const auto is_poor = [&](int v) {
        return std::ranges::any_of(band.tetras.around(v), [&](int t) { return poor_tetra[t] != 0; }) ||
               std::ranges::any_of(band.triangles.around(v), [&](int t) { return poor_shell[t] != 0; });
    };
    std::vector<char> dirty(static_cast<std::size_t>(band.size()), 0);
    std::vector<int> active, next;
    Star star;
    std::unordered_map<int, CurvedStar> curved_stars;
    SparseCheck check(16);
    long moves = 0;
    for (int sweep = 0; sweep < 2 * options.sweeps; ++sweep) {
        const bool last_stage = sweep >= options.sweeps;
        if (sweep % options.sweeps == 0) active = near;
        if (sweep == options.sweeps)
            for (const int v : movable) may_move[v] = 1;
        if (active.empty()) continue;
        const int doublings = last_stage ? 4 : 3;
        next.clear();
        for (const int v : active) dirty[v] = 0;
        for (const int v : active) {
            check();
            if (!is_poor(v)) continue;
            BandNode& node = band.nodes[v];
            Eigen::Matrix3d basis;
            const int freedom = d.constraints.tangents(v, d.contact[v], node.at, basis);
            if (freedom == 0) continue;
            ++d.visits;
            star.gather(d, v);
            const auto tangent = basis.leftCols(freedom);
            const Vec3 before = node.at;
            CurvedStar& curved = curved_stars.try_emplace(v, d, v).first->second;
            curved.forget_places();
            // Second-order elements are looked at where the node comes to, and on the way only if it must not come
            // there.
            minimise(d, star, v, tangent, doublings, [](const Vec3&) { return true; });
            if (node.at != before) {
                const Vec3 after = std::exchange(node.at, before);
                if (curved.stays_sound(after))
                    node.at = after;
                else
                    minimise(d, star, v, tangent, doublings, [&](const Vec3& x) { return curved.stays_sound(x); });
            }
            if (node.at == before) continue;
            ++moves;
            for (const int t : band.tetras.around(v)) poor_tetra[t] = tetra_is_below(options.target, d, t);
            for (const int t : band.triangles.around(v)) look_at_shell(t);
            const double reach = band.mean_edge_length(v);
            if ((node.at - before).norm() < 1e-3 * reach) continue;
            const auto wake = [&](const auto& list) {
                for (const int s : list.around(v))
                    for (const int w : list[s])
                        if (may_move[w] && !dirty[w]) {
                            dirty[w] = 1;
                            next.push_back(w);
                        }
            };
            wake(band.tetras);
            wake(band.triangles);
        }
        active.swap(next);
    }
    return moves;
}

}  // namespace femscalpel
