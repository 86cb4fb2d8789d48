// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/relaxation.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "cancel.h"
#include "deformation/curved_shape.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The face opposite corner k, seen so that the volume is positive towards k.
constexpr int opposite_face[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/// One element as a function of the position x of one of its corners:
/// 1 / mean ratio = S(x) / (c M(x)^e), S the sum of squared edges, M volume or area, linear in x.
struct Term {
    Vec3 gradient;    // of M
    double offset;    // M = gradient.x + offset
    Vec3 corner_sum;  // of the other corners
    double constant;  // S = edges |x|^2 - 2 x.corner_sum + constant
    double edges;     // 3 or 2
    double exponent;  // 2/3 or 1
    double scale;     // 1 / c

    double inverse_quality(const Vec3& x) const {
        const double measure = gradient.dot(x) + offset;
        if (!(measure > 0)) return infinity;
        const double squares = edges * x.squaredNorm() - 2 * x.dot(corner_sum) + constant;
        if (exponent == 1) return scale * squares / measure;
        const double root = inverse_cube_root(measure);
        return scale * squares * root * root;
    }
};

/// The elements around one node, relative to the node's own position for accuracy.
class Star {
public:
    void gather(const Deformable& d, int node) {
        terms_.clear();
        const BandMesh& band = d.band;
        origin_ = band.nodes[node].at;
        static const double tetra_scale = 1 / (12 * std::cbrt(9.0));
        static const double shell_scale = 1 / (4 * std::sqrt(3.0));
        for (const int t : band.tetras.around(node)) {
            const auto& v = band.tetras[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band.nodes[v[opposite_face[k][0]]].at - origin_;
            const Vec3 b = band.nodes[v[opposite_face[k][1]]].at - origin_;
            const Vec3 c = band.nodes[v[opposite_face[k][2]]].at - origin_;
            Term term;
            term.gradient = (b - a).cross(c - a) / 6;
            term.offset = -term.gradient.dot(a);
            term.corner_sum = a + b + c;
            term.constant = a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + (b - a).squaredNorm() +
                            (c - a).squaredNorm() + (c - b).squaredNorm();
            term.edges = 3;
            term.exponent = 2.0 / 3;
            term.scale = tetra_scale;
            terms_.push_back(term);
        }
        for (const int t : band.triangles.around(node)) {
            const int origin = band.triangles.origin(t);
            if (!d.constraints.is_shell(origin)) continue;
            const auto& v = band.triangles[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band.nodes[v[(k + 1) % 3]].at - origin_;
            const Vec3 b = band.nodes[v[(k + 2) % 3]].at - origin_;
            Term term;
            term.gradient = d.shell_normals[origin].cross(b - a) / 2;
            term.offset = -term.gradient.dot(a);
            term.corner_sum = a + b;
            term.constant = a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm();
            term.edges = 2;
            term.exponent = 1;
            term.scale = shell_scale;
            terms_.push_back(term);
        }
    }

    bool empty() const { return terms_.empty(); }

    double worst(const Vec3& x) const {
        double largest = 0;
        const Vec3 y = x - origin_;
        for (const Term& t : terms_) largest = std::max(largest, t.inverse_quality(y));
        return 1 / largest;
    }

    double value(const Vec3& x, int doublings) const {
        double sum = 0;
        const Vec3 y = x - origin_;
        for (const Term& t : terms_) sum += power(t.inverse_quality(y), doublings);
        return sum;
    }

    double derivatives(const Vec3& x, int doublings, Vec3& gradient, Eigen::Matrix3d& hessian) const {
        gradient.setZero();
        hessian.setZero();
        const Vec3 y = x - origin_;
        const double p = 1 << doublings;
        double sum = 0;
        for (const Term& t : terms_) {
            const double measure = t.gradient.dot(y) + t.offset;
            if (!(measure > 0)) return infinity;
            const double squares = t.edges * y.squaredNorm() - 2 * y.dot(t.corner_sum) + t.constant;
            const Vec3 grad_squares = 2 * (t.edges * y - t.corner_sum);
            const double u = power(t.inverse_quality(y), doublings);
            const Vec3 squares_part = grad_squares / squares;
            const Vec3 measure_part = t.gradient / measure;
            const Vec3 log_gradient = squares_part - t.exponent * measure_part;
            sum += u;
            gradient += p * u * log_gradient;
            hessian += p * u *
                       (p * log_gradient * log_gradient.transpose() - squares_part * squares_part.transpose() +
                        t.exponent * measure_part * measure_part.transpose());
            hessian.diagonal().array() += p * u * 2 * t.edges / squares;
        }
        return sum;
    }

private:
    static double power(double u, int doublings) {
        for (int k = 0; k < doublings; ++k) u *= u;
        return u;
    }
    std::vector<Term> terms_;
    Vec3 origin_ = Vec3::Zero();
};

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

Deformable::Deformable(BandMesh b, const Mesh& mesh, const ConstraintOptions& options)
    : band(std::move(b)),
      constraints(band, mesh, options),
      mids(band, mesh, options.rounding),
      membership(band, mesh),
      contact(static_cast<std::size_t>(band.size())),
      side(static_cast<std::size_t>(band.size()), 0),
      off_tool(static_cast<std::size_t>(band.size()), 0),
      tolerance(options.tolerance),
      rounding(options.rounding),
      held_off(static_cast<std::size_t>(band.size()), 0) {
    check_cancelled();
    shell_normals.assign(static_cast<std::size_t>(band.triangles.size()), Vec3::Zero());
    for (int t = 0; t < band.triangles.size(); ++t) {
        const auto& v = band.triangles[t];
        const Vec3& a = band.nodes[v[0]].at;
        shell_normals[t] = (band.nodes[v[1]].at - a).cross(band.nodes[v[2]].at - a).normalized();
    }
}

int Deformable::split_edge(int a, int b, const Vec3& at, const Contact& tools) {
    check_cancelled();
    mids.split(band, a, b, band.size(), fraction(band.nodes[a].at, band.nodes[b].at, at));
    const bool fixed = constraints.has_fixed_middle(a, b);
    const int node = band.split_edge(a, b, at);
    contact.push_back(tools);
    const double distance = barrier && !tools.has(barrier) ? barrier->distance(at) : 0;
    side.push_back(static_cast<signed char>((distance > 0) - (distance < 0)));
    off_tool.push_back(0);
    held_off.push_back(tools ? held_between(a, b) : 0);
    constraints.add_node(band, node);
    if (fixed) constraints.fix_node(node);
    membership.add_node(band, node);
    return node;
}

void Deformable::hold_beside(int node, const Contact& tools) {
    contact[node] = tools;
    constraints.fix_node(node);
    held_off[node] = std::max(held_off[node], off_tools(tools, band.nodes[node].at, 0));
}

double Deformable::off_tools(const Contact& tools, const Vec3& x, double held_off) {
    double off = 0;
    for (const Tool* t : tools.tools()) off = std::max(off, std::abs(t->distance(x)) - held_off);
    return off;
}

Vec3 Deformable::along_edge(int a, int b, double t) const {
    const Vec3 &pa = band.nodes[a].at, &pb = band.nodes[b].at;
    Vec3 x = pa + t * (pb - pa);
    if (mids.any()) x += 4 * t * (1 - t) * (mid_side(*this, a, b).at - (pa + pb) / 2);
    const NodeConstraint constraint = constraints.on_edge(band, a, b);
    if (!constraints.is_straight(constraint)) constraints.project(constraint, {}, x);
    return x;
}

Deformable::SplitPoint Deformable::fitted_split(int a, int b, const Vec3& at, const Contact& tools) const {
    const auto worst_child = [&](const Vec3& p) {
        double worst = 1;
        const auto look = [&](const auto& list, auto quality) {
            for (const int s : list.around(a)) {
                if (std::ranges::find(list[s], b) == list[s].end()) continue;
                for (const int replaced : {a, b}) {
                    std::array<Vec3, 4> corner;
                    for (std::size_t k = 0; k < list[s].size(); ++k)
                        corner[k] = list[s][k] == replaced ? p : band.nodes[list[s][k]].at;
                    worst = std::min(worst, quality(corner, s));
                }
            }
        };
        look(band.tetras, [](const auto& c, int) { return mean_ratio(c[0], c[1], c[2], c[3]); });
        look(band.triangles, [&](const auto& c, int s) {
            const int origin = band.triangles.origin(s);
            if (!constraints.is_shell(origin)) return 1.0;
            return std::copysign(mean_ratio(c[0], c[1], c[2]),
                                 (c[1] - c[0]).cross(c[2] - c[0]).dot(shell_normals[origin]));
        });
        return worst;
    };
    const NodeConstraint constraint = constraints.on_edge(band, a, b);
    if (constraint.freedom == NodeFreedom::free && !tools) return {at, true, worst_child(at)};
    Vec3 fitted = at;
    const bool found = constraints.project(constraint, tools, fitted, held_between(a, b)) &&
                       (fitted - at).norm() < (band.nodes[a].at - band.nodes[b].at).norm();
    const double worst = worst_child(at);
    if (found) {
        const double worst_fitted = fitted == at ? worst : worst_child(fitted);
        if (worst_fitted > 0.2 * worst) return {fitted, true, worst_fitted};
    }
    const double close = std::max(1e-9 * (band.nodes[a].at - band.nodes[b].at).norm(), tolerance);
    return {at,
            off_tools(tools, at, held_between(a, b)) <= close &&
                constraints.distance(constraint, at) <= std::max(1e3 * close, rounding),
            worst};
}

Contact Deformable::edge_contact(int a, int b) const {
    const Contact both = contact[a].common(contact[b]);
    Contact out;
    for (const Tool* t : both.tools()) {
        const Vec3 middle = (band.nodes[a].at + band.nodes[b].at) / 2;
        const double length = (band.nodes[a].at - band.nodes[b].at).norm();
        if (std::abs(t->distance(middle)) <= std::max(1e-9 * length, tolerance) + held_between(a, b)) out = out.with(t);
    }
    if (out.count() == both.count() || !band.is_cut_edge(a, b)) return out;
    // A chord on a surface of cut faces: if it is the surface's border it lies on all tools of its ends, else on one.
    if (both.count() == 1 || band.is_cut_border(a, b)) return both;
    if (out) return out;
    const Vec3 middle = (band.nodes[a].at + band.nodes[b].at) / 2;
    return *std::ranges::min_element(both.tools(), {}, [&](const Tool* t) { return std::abs(t->distance(middle)); });
    return out;
}

double tetra_quality(const Deformable& d, int tetra) {
    const auto& v = d.band.tetras[tetra];
    const auto& n = d.band.nodes;
    return mean_ratio(n[v[0]].at, n[v[1]].at, n[v[2]].at, n[v[3]].at);
}

bool tetra_is_below(double limit, const Deformable& d, int tetra) {
    const auto& v = d.band.tetras[tetra];
    const auto& n = d.band.nodes;
    return mean_ratio_below(limit, n[v[0]].at, n[v[1]].at, n[v[2]].at, n[v[3]].at);
}

double shell_quality(const Deformable& d, int triangle) {
    const auto& v = d.band.triangles[triangle];
    const Vec3 &a = d.band.nodes[v[0]].at, &b = d.band.nodes[v[1]].at, &c = d.band.nodes[v[2]].at;
    const double turned = (b - a).cross(c - a).dot(d.shell_normals[d.band.triangles.origin(triangle)]);
    return std::copysign(mean_ratio(a, b, c), turned);
}

double quality_around(const Deformable& d, int node, const Vec3& x) {
    thread_local Star star;
    thread_local SparseCheck check(16);
    check();
    star.gather(d, node);
    return star.empty() ? 1 : star.worst(x);
}

bool quality_around_is_below(double limit, const Deformable& d, int node) {
    return std::ranges::any_of(d.band.tetras.around(node), [&](int t) { return tetra_is_below(limit, d, t); }) ||
           std::ranges::any_of(d.band.triangles.around(node), [&](int t) {
               return d.constraints.is_shell(d.band.triangles.origin(t)) && shell_quality(d, t) < limit;
           });
}

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
