// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include <Eigen/Cholesky>

#include "cancel.h"
#include "cutting/folded_input.h"
#include "cutting/improve.h"
#include "cutting/mend_curved.h"
#include "cutting/workpiece.h"
#include "deformation/bar_network.h"
#include "deformation/curved_shape.h"
#include "deformation/deformation.h"
#include "deformation/relaxation.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

/// A result is taken at once when no element is worse than this, or than half the worst of the input.
constexpr double good_enough = 0.1;
/// Worse than this counts as flattened.
constexpr double acceptable = 0.02;
/// Interfaces tried before giving up.
constexpr int attempts = 6;
/// Cuts tried to find an interface without conflicts on creases.
constexpr int cuts = 40;
/// Most that a node's cost is multiplied with.
constexpr double largest_penalty = 1e4;
/// An interface node may move by so many mean edge lengths.
constexpr double reach = 2;
/// Having nothing else, this method may dent bent lines deeper than others, by this factor.
constexpr double dented = 3;

/// Least weight of nodes that separates two sides of a graph: a maximum flow through nodes split in an
/// entrance and an exit. Dinic, "Algorithm for solution of a problem of maximum flow in networks with
/// power estimation", Soviet Math. Dokl. 11 (1970).
class VertexCut {
public:
    using Weight = std::int64_t;
    static constexpr Weight endless = std::numeric_limits<Weight>::max() / 1000;

    explicit VertexCut(int nodes)
        : first_(2 * static_cast<std::size_t>(nodes) + 2, -1), source_(2 * nodes), sink_(2 * nodes + 1) {}

    void set_weight(int v, Weight weight) { add(2 * v, 2 * v + 1, weight); }
    void join(int v, int w) {
        add(2 * v + 1, 2 * w, endless);
        add(2 * w + 1, 2 * v, endless);
    }
    /// What it costs to leave v wholly on the negative (positive) side.
    void hold_positive(int v, Weight weight) { add(source_, 2 * v, weight); }
    void hold_negative(int v, Weight weight) { add(2 * v + 1, sink_, weight); }

    /// False when only an endless weight would separate the sides.
    bool solve() {
        Weight flow = 0;
        SparseCheck check(64);
        while (find_levels()) {
            check_cancelled();
            next_ = first_;
            while (const Weight pushed = push(endless)) {
                check();
                flow += pushed;
                if (flow >= endless) return false;
            }
        }
        return true;
    }

    /// +1, -1, or 0 for a node of the cut.
    int side(int v) const { return level_[2 * v] < 0 ? -1 : level_[2 * v + 1] < 0 ? 0 : 1; }

private:
    struct Arc {
        int to;
        int next;
        Weight left;
    };

    void add(int from, int to, Weight capacity) {
        arcs_.push_back({to, first_[from], capacity});
        first_[from] = static_cast<int>(arcs_.size()) - 1;
        arcs_.push_back({from, first_[to], 0});
        first_[to] = static_cast<int>(arcs_.size()) - 1;
    }

    bool find_levels() {
        level_.assign(first_.size(), -1);
        level_[source_] = 0;
        queue_.assign(1, source_);
        for (std::size_t k = 0; k < queue_.size(); ++k)
            for (int a = first_[queue_[k]]; a >= 0; a = arcs_[a].next)
                if (arcs_[a].left > 0 && level_[arcs_[a].to] < 0) {
                    level_[arcs_[a].to] = level_[queue_[k]] + 1;
                    queue_.push_back(arcs_[a].to);
                }
        return level_[sink_] >= 0;
    }

    /// Pushes along one path of rising level from the source; 0 when none is left.
    Weight push(Weight most) {
        path_.clear();
        int at = source_;
        while (at != sink_) {
            int& a = next_[at];
            while (a >= 0 && !(arcs_[a].left > 0 && level_[arcs_[a].to] == level_[at] + 1)) a = arcs_[a].next;
            if (a >= 0) {
                path_.push_back(a);
                at = arcs_[a].to;
            } else {
                if (path_.empty()) return 0;
                at = arcs_[path_.back() ^ 1].to;
                path_.pop_back();
                next_[at] = arcs_[next_[at]].next;
            }
        }
        for (const int a : path_) most = std::min(most, arcs_[a].left);
        for (const int a : path_) {
            arcs_[a].left -= most;
            arcs_[a ^ 1].left += most;
        }
        return most;
    }

    std::vector<Arc> arcs_;
    std::vector<int> first_, next_, level_, queue_, path_;
    int source_, sink_;
};

/// Pulls elements that moving nodes turned over back into shape: each node in turn minimises the sum of
/// the squared inverse mean ratios around it, with the volume V replaced by (V + sqrt(V^2 + 4 delta^2)) / 2,
/// which is positive for every V, and delta lowered step by step. Escobar et al., "Simultaneous
/// untangling and smoothing of tetrahedral meshes", Comput. Methods Appl. Mech. Engng. 192 (2003).
class Untangler {
public:
    explicit Untangler(Deformable& d) : d_(d), band_(d.band) {
        for (int t = 0; t < band_.tetras.size(); ++t) tetra_volume_.push_back(regular_measure(band_.tetras[t]));
        for (int t = 0; t < band_.triangles.size(); ++t) shell_area_.push_back(regular_measure(band_.triangles[t]));
    }

    /// The worst quality reached.
    double run(const std::vector<int>& movable, double goal) {
        std::vector<char> may_move(static_cast<std::size_t>(band_.size()), 0);
        for (const int v : movable) may_move[v] = 1;
        double worst = 0;
        for (double delta = 0.5; delta > 0.004; delta /= 2)
            for (int sweep = 0; sweep < 4; ++sweep) {
                std::vector<char> chosen(may_move.size(), 0);
                worst = choose(goal, chosen);
                if (worst >= goal) return worst;
                for (const int v : movable) {
                    check_cancelled();
                    if (chosen[v]) improve(v, delta);
                }
            }
        return worst;
    }

private:
    struct Term {
        Vec3 gradient;  // of the measure (volume or area) by the node's position
        double offset;
        Vec3 corner_sum;
        double constant;  // squared edges = edges |x|^2 - 2 x.corner_sum + constant
        double edges;
        double exponent;
        double delta;
        double scale;
    };

    template <std::size_t N>
    double regular_measure(const std::array<int, N>& v) const {
        double squares = 0;
        for (std::size_t i = 0; i < N; ++i)
            for (std::size_t j = 0; j < i; ++j)
                squares += (band_.nodes[v[i]].start - band_.nodes[v[j]].start).squaredNorm();
        const double square = squares / (N * (N - 1) / 2.0);
        return N == 4 ? square * std::sqrt(square) / (6 * std::sqrt(2.0)) : square * std::sqrt(3.0) / 4;
    }

    /// Marks the nodes of bad elements and their neighbours.
    double choose(double goal, std::vector<char>& chosen) const {
        double worst = 1;
        std::vector<int> seeds;
        check_cancelled();
        const auto look = [&](const auto& v, double quality) {
            worst = std::min(worst, quality);
            if (quality < goal) seeds.insert(seeds.end(), v.begin(), v.end());
        };
        for (int t = 0; t < band_.tetras.size(); ++t) look(band_.tetras[t], tetra_quality(d_, t));
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (d_.constraints.is_shell(band_.triangles.origin(t))) look(band_.triangles[t], shell_quality(d_, t));
        for (const int v : seeds) {
            for (const int s : band_.tetras.around(v))
                for (const int w : band_.tetras[s]) chosen[w] = 1;
            for (const int s : band_.triangles.around(v))
                for (const int w : band_.triangles[s]) chosen[w] = 1;
        }
        return worst;
    }

    void gather(int node, double delta) {
        terms_.clear();
        const Vec3 origin = band_.nodes[node].at;
        for (const int t : band_.tetras.around(node)) {
            const auto& v = band_.tetras[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band_.nodes[v[opposite_face[k][0]]].at - origin,
                       b = band_.nodes[v[opposite_face[k][1]]].at - origin,
                       c = band_.nodes[v[opposite_face[k][2]]].at - origin;
            const Vec3 gradient = (b - a).cross(c - a) / 6;
            terms_.push_back({gradient, -gradient.dot(a), a + b + c,
                              a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + (b - a).squaredNorm() +
                                  (c - a).squaredNorm() + (c - b).squaredNorm(),
                              3, 2.0 / 3, delta * tetra_volume_[t], 1 / (12 * std::cbrt(9.0))});
        }
        for (const int t : band_.triangles.around(node)) {
            if (!d_.constraints.is_shell(band_.triangles.origin(t))) continue;
            const auto& v = band_.triangles[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band_.nodes[v[(k + 1) % 3]].at - origin, b = band_.nodes[v[(k + 2) % 3]].at - origin;
            const Vec3 gradient = d_.shell_normals[band_.triangles.origin(t)].cross(b - a) / 2;
            terms_.push_back({gradient, -gradient.dot(a), a + b,
                              a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm(), 2, 1, delta * shell_area_[t],
                              1 / (4 * std::sqrt(3.0))});
        }
    }

    /// Objective at the node's position plus y, with derivatives if asked for.
    double value(const Vec3& y, Vec3* gradient, Eigen::Matrix3d* hessian) const {
        double sum = 0;
        if (gradient) {
            gradient->setZero();
            hessian->setZero();
        }
        for (const Term& t : terms_) {
            const double measure = t.gradient.dot(y) + t.offset;
            const double root = std::sqrt(measure * measure + 4 * t.delta * t.delta);
            // Of the two equal forms the one without cancellation.
            const double positive = measure > 0 ? (measure + root) / 2 : 2 * t.delta * t.delta / (root - measure);
            const double squares = t.edges * y.squaredNorm() - 2 * y.dot(t.corner_sum) + t.constant;
            const double u = t.scale * squares / std::pow(positive, t.exponent);
            const double power = u * u;
            sum += power;
            if (!gradient) continue;
            const Vec3 squares_part = 2 * (t.edges * y - t.corner_sum) / squares;
            const Vec3 measure_part = t.gradient / root;
            const Vec3 log_gradient = squares_part - t.exponent * measure_part;
            *gradient += 2 * power * log_gradient;
            *hessian += 2 * power *
                        (2 * log_gradient * log_gradient.transpose() - squares_part * squares_part.transpose() +
                         t.exponent * std::max(0.0, measure / root) * measure_part * measure_part.transpose());
            hessian->diagonal().array() += 2 * power * 2 * t.edges / squares;
        }
        return sum;
    }

    void improve(int v, double delta) {
        BandNode& node = band_.nodes[v];
        Eigen::Matrix3d basis;
        const int freedom = d_.constraints.tangents(v, d_.contact[v], node.at, basis);
        if (freedom == 0) return;
        gather(v, delta);
        const auto tangent = basis.leftCols(freedom);
        const Vec3 origin = node.at;
        const double limit = 0.5 * band_.mean_edge_length(v);
        Vec3 gradient;
        Eigen::Matrix3d hessian;
        for (int iteration = 0; iteration < 2; ++iteration) {
            const double now = value(node.at - origin, &gradient, &hessian);
            using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
            Small h = tangent.transpose() * hessian * tangent;
            Eigen::LDLT<Small> factors(h);
            if (factors.info() != Eigen::Success || !factors.isPositive()) {
                h.diagonal().array() += h.norm();
                factors.compute(h);
            }
            const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> g = tangent.transpose() * gradient;
            Vec3 step = -(tangent * factors.solve(g));
            if (!step.allFinite()) return;
            if (step.norm() > limit) step *= limit / step.norm();
            bool accepted = false;
            for (int halving = 0; halving < 6 && !accepted; ++halving, step /= 2) {
                Vec3 x = node.at + step;
                if (!d_.constraints.project(v, d_.contact[v], x) || d_.is_barred(v, x) ||
                    !(value(x - origin, nullptr, nullptr) < now))
                    continue;
                node.at = x;
                accepted = true;
            }
            if (!accepted) return;
        }
    }

    Deformable& d_;
    BandMesh& band_;
    std::vector<double> tetra_volume_, shell_area_;
    std::vector<Term> terms_;
};

/// What one attempt tells the next, by node of the input's band.
struct Lessons {
    std::vector<double> penalty;  ///< factor on the cost of having a node in the interface
    std::vector<char> held;       ///< nodes that have to stay on the side they are on
};

class Deformer {
public:
    Deformer(Workpiece& f, const Tool& tool, const Mesh& mesh, Lessons& lessons)
        : f_(f), d_(f.d), band_(f.d.band), tool_(tool), mesh_(mesh), lessons_(lessons) {}

    /// 3.1.1: the interface nodes, with Figure 4's splits. False when fixed nodes leave none.
    bool classify() {
        measure_nodes();
        for (int round = 0; round < cuts; ++round) {
            if (!cut()) return false;
            if (!penalise_impossible()) break;
        }
        split_astray();
        return true;
    }

    /// 3.1.2. Returns the worst quality.
    double move() {
        for (int v = 0; v < band_.size(); ++v) {
            f_.distance[v] = side_[v];
            d_.contact[v] = side_[v] == 0 ? Contact(&tool_) : Contact();
        }
        find_node_sets(f_);
        std::vector<Vec3> given;
        for (const int v : f_.nodes) given.push_back(target_[v] - band_.nodes[v].at);
        const std::vector<Vec3> spread = bar_network_displacements(d_, f_.nodes, given, f_.transition);
        for (std::size_t k = 0; k < f_.transition.size(); ++k) {
            const int v = f_.transition[k];
            Vec3 x = band_.nodes[v].at + spread[k];
            if (d_.constraints.project(v, nullptr, x) && !d_.is_barred(v, x)) band_.nodes[v].at = x;
        }
        for (const int v : f_.nodes) band_.nodes[v].at = target_[v];
        std::vector<int> movable = f_.nodes;
        movable.insert(movable.end(), f_.transition.begin(), f_.transition.end());
        worst_ = Untangler(d_).run(movable, 0.2);
        if (worst_ > 0) {
            relax(d_, movable);
            mend_curved(f_, false);
            folded_ = newly_folded(f_, folded_elements(f_, least_curved));
            worst_ = folded_.empty() ? worst_quality() : 0;
        }
        find_misplaced();
        return misplaced_.empty() ? worst_ : -1;
    }

    /// For the next attempt: interface nodes around the worst elements become dearer, nodes that ended on
    /// the wrong side of the tool are held on theirs.
    void learn() const {
        for (const int v : misplaced_)
            if (!band_.is_new(v)) lessons_.held[v] = 1;
        for_bad([&](const auto& v, const CellRef&) {
            for (const int n : v)
                if (side_[n] == 0 && !band_.is_new(n)) raise(n, 2);
        });
    }

    [[noreturn]] void fail() const {
        std::set<Index> elements;
        for_bad([&](const auto&, const CellRef& c) { elements.insert(mesh_.block(c.type).ids[c.cell]); });
        for (const int v : misplaced_) {
            for (const int t : band_.tetras.around(v)) {
                const CellRef& c = band_.tetra_cells[band_.tetras.origin(t)];
                elements.insert(mesh_.block(c.type).ids[c.cell]);
            }
            for (const int t : band_.triangles.around(v)) {
                const CellRef& c = band_.triangle_cells[band_.triangles.origin(t)];
                elements.insert(mesh_.block(c.type).ids[c.cell]);
            }
        }
        throw QualityError("method \"deform\" cannot bring the interface onto the " + std::string(tool_.kind()) +
                           " without flattening elements (" + list(elements) +
                           "). Moving nodes alone is not enough here; use method \"snap\"");
    }

    /// For classify() == false.
    [[noreturn]] void fail_fixed() const {
        std::set<Index> elements;
        const auto look = [&](const auto& list, const auto& cells) {
            for (int s = 0; s < list.size(); ++s) {
                if (!list.alive(s)) continue;
                bool positive = false, negative = false;
                for (const int v : list[s]) {
                    if (slide_[v] <= reach) continue;
                    positive = positive || f_.distance[v] > 0;
                    negative = negative || f_.distance[v] < 0;
                }
                const CellRef& c = cells[list.origin(s)];
                if (positive && negative) elements.insert(mesh_.block(c.type).ids[c.cell]);
            }
        };
        look(band_.tetras, band_.tetra_cells);
        look(band_.triangles, band_.triangle_cells);
        throw QualityError("method \"deform\" finds no row of nodes that could be moved onto the " +
                           std::string(tool_.kind()) + ": nodes on both sides of it cannot be moved there (elements " +
                           list(elements) + "); use method \"snap\"");
    }

private:
    bool is_shell(int t) const { return d_.constraints.is_shell(band_.triangles.origin(t)); }

    static std::string list(const std::set<Index>& elements) {
        std::string text;
        int shown = 0;
        for (const Index id : elements) {
            if (shown++ == 8) break;
            text += (text.empty() ? "" : ", ") + std::to_string(id);
        }
        return elements.size() > 8 ? text + ", ..." : text;
    }

    /// Nodes beyond the tool: there the interface does not separate what the tool does.
    void find_misplaced() {
        for (int v = 0; v < band_.size(); ++v)
            if (side_[v] * tool_.distance(band_.nodes[v].at) < -f_.tolerance &&
                !(band_.tetras.around(v).empty() && band_.triangles.around(v).empty()))
                misplaced_.push_back(v);
    }

    double worst_quality() const {
        check_cancelled();
        double worst = 1;
        for (int t = 0; t < band_.tetras.size(); ++t) worst = std::min(worst, tetra_quality(d_, t));
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (is_shell(t)) worst = std::min(worst, shell_quality(d_, t));
        return worst;
    }

    void for_bad(auto visit) const {
        check_cancelled();
        const double limit = misplaced_.empty() ? std::max(good_enough, worst_) : acceptable;
        const auto is_folded = [&](bool triangle, int slot) {
            return std::ranges::find(folded_, BandElement{triangle, slot}) != folded_.end();
        };
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (tetra_quality(d_, t) <= limit || is_folded(false, t))
                visit(band_.tetras[t], band_.tetra_cells[band_.tetras.origin(t)]);
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (is_shell(t) && (shell_quality(d_, t) <= limit || is_folded(true, t)))
                visit(band_.triangles[t], band_.triangle_cells[band_.triangles.origin(t)]);
    }

    /// Where each node would go, and how far that is.
    void measure_nodes() {
        const auto count = static_cast<std::size_t>(band_.size());
        target_.resize(count);
        slide_.assign(count, reach + 1);
        length_.assign(count, 0);
        SparseCheck check;
        for (int v = 0; v < band_.size(); ++v) {
            check();
            length_[v] = band_.mean_edge_length(v);
            target_[v] = band_.nodes[v].at;
            if (band_.tetras.around(v).empty() && band_.triangles.around(v).empty()) continue;
            if (!band_.nodes[v].movable() || std::abs(f_.distance[v]) > reach * length_[v]) continue;
            if (!d_.constraints.project(v, &tool_, target_[v])) continue;
            const double way = (target_[v] - band_.nodes[v].at).norm();
            if (way <= dented * d_.constraints.leash(v)) slide_[v] = way / length_[v];
        }
    }

    /// T1 and T2 by half-space; between them the interface nodes that have least to move.
    bool cut() {
        VertexCut cut(band_.size());
        const auto weight = [](double w) { return static_cast<VertexCut::Weight>(w * 1e6); };
        std::vector<int> neighbours;
        SparseCheck check;
        for (int v = 0; v < band_.size(); ++v) {
            check();
            const double r = slide_[v];
            cut.set_weight(
                v, r > reach ? VertexCut::endless : weight(lessons_.penalty[v] * (0.1 + r * r + 2 * r * r * r * r)));
            const double off = std::abs(f_.distance[v]) / length_[v];
            const bool held = band_.nodes[v].level != 0 || off > 1 || r > reach || lessons_.held[v] != 0;
            const auto wrong = held ? VertexCut::endless : weight(0.5 * off * off);
            if (f_.distance[v] > 0) cut.hold_positive(v, wrong);
            if (f_.distance[v] < 0) cut.hold_negative(v, wrong);
            neighbours.clear();
            const auto gather = [&](int w) {
                if (w > v) neighbours.push_back(w);
            };
            for (const int s : band_.tetras.around(v)) std::ranges::for_each(band_.tetras[s], gather);
            for (const int s : band_.triangles.around(v)) std::ranges::for_each(band_.triangles[s], gather);
            std::ranges::sort(neighbours);
            const auto rest = std::ranges::unique(neighbours);
            neighbours.erase(rest.begin(), rest.end());
            for (const int w : neighbours) cut.join(v, w);
        }
        if (!cut.solve()) return false;
        side_.resize(static_cast<std::size_t>(band_.size()));
        for (int v = 0; v < band_.size(); ++v) side_[v] = cut.side(v);
        // A node that ended in the cut although it has only one side around it belongs to that side.
        for (int v = 0; v < band_.size(); ++v) {
            if (side_[v] != 0) continue;
            bool positive = false, negative = false;
            look_around(v, [&](int w) { (side_[w] > 0 ? positive : negative) |= side_[w] != 0; });
            if (positive != negative) side_[v] = positive ? 1 : -1;
        }
        return true;
    }

    void look_around(int v, auto visit) const {
        for (const int s : band_.tetras.around(v)) std::ranges::for_each(band_.tetras[s], visit);
        for (const int s : band_.triangles.around(v)) std::ranges::for_each(band_.triangles[s], visit);
    }

    /// Where no split helps the farthest node becomes dearer: two interface nodes on one crease would go to
    /// the same point; three whose edges are all in the interface but whose triangle is not would enclose
    /// elements between it and the interface.
    bool penalise_impossible() {
        bool any = false;
        for (int s = 0; s < band_.creases.size(); ++s) {
            const auto& [a, b] = band_.creases[s];
            if (side_[a] != 0 || side_[b] != 0) continue;
            if ((target_[a] - target_[b]).norm() > 0.2 * (band_.nodes[a].at - band_.nodes[b].at).norm()) continue;
            penalise(band_.creases[s], 4);
            any = true;
        }
        std::set<std::array<int, 3>> seen;
        SparseCheck check;
        const auto look = [&](std::array<int, 3> face) {
            check();
            std::ranges::sort(face);
            if (!std::ranges::all_of(face, [&](int v) { return side_[v] == 0; }) || !seen.insert(face).second) return;
            const auto [a, b, c] = face;
            if (!in_interface(a, b) || !in_interface(b, c) || !in_interface(a, c)) return;
            bool positive = false, negative = false;
            look_edge(a, b, [&, c = c](const auto& element) {
                if (std::ranges::find(element, c) == element.end()) return;
                for (const int v : element) (side_[v] > 0 ? positive : negative) |= side_[v] != 0;
            });
            if (positive && negative) return;
            penalise(face, 2);
            any = true;
        };
        for (int t = 0; t < band_.tetras.size(); ++t) {
            const auto& v = band_.tetras[t];
            if (std::ranges::count_if(v, [&](int n) { return side_[n] == 0; }) < 3) continue;
            for (int k = 0; k < 4; ++k) look({v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]});
        }
        return any;
    }

    /// Whether elements of both sides share the edge a-b.
    bool in_interface(int a, int b) const {
        bool positive = false, negative = false;
        look_edge(a, b, [&](const auto& element) {
            for (const int v : element) (side_[v] > 0 ? positive : negative) |= side_[v] != 0;
        });
        return positive && negative;
    }

    /// Figure 4: an edge between two interface nodes that is in no interface face would come to lie in the
    /// interface all the same, and flatten what is between; it is split in the middle, so that the new node
    /// can move away.
    void split_astray() {
        for (const auto& [a, b] : astray()) {
            if (in_interface(a, b)) continue;  // since a split before it
            int side = 0;
            look_edge(a, b, [&](const auto& element) {
                for (const int v : element) side = side != 0 ? side : side_[v];
            });
            const Vec3 middle = (band_.nodes[a].at + band_.nodes[b].at) / 2;
            Vec3 at = middle;
            if (!d_.constraints.project(d_.constraints.on_edge(band_, a, b), nullptr, at) ||
                (at - middle).norm() > 0.1 * (band_.nodes[a].at - band_.nodes[b].at).norm())
                at = middle;
            const int node = f_.split_edge(a, b, at, nullptr);
            side_.push_back(side != 0 ? side : tool_.distance(at) < 0 ? -1 : 1);
            target_.push_back(at);
            f_.distance[node] = side_.back();  // it may lie in the tool, and is of one side
        }
    }

    /// Edges between interface nodes that are in no interface face, longest first.
    std::vector<std::pair<int, int>> astray() const {
        std::vector<std::pair<double, std::pair<int, int>>> found;
        std::vector<int> others;
        SparseCheck check;
        for (int v = 0; v < band_.size(); ++v) {
            check();
            if (side_[v] != 0) continue;
            others.clear();
            look_around(v, [&](int w) {
                if (w > v && side_[w] == 0) others.push_back(w);
            });
            std::ranges::sort(others);
            const auto rest = std::ranges::unique(others);
            others.erase(rest.begin(), rest.end());
            for (const int w : others)
                if (!in_interface(v, w)) found.push_back({-(band_.nodes[v].at - band_.nodes[w].at).norm(), {v, w}});
        }
        std::ranges::sort(found);
        std::vector<std::pair<int, int>> edges;
        for (const auto& [length, edge] : found) edges.push_back(edge);
        return edges;
    }

    /// Calls visit(nodes) for the elements around the edge a-b.
    void look_edge(int a, int b, auto visit) const {
        const auto look = [&](const auto& list) {
            for (const int s : list.around(a))
                if (std::ranges::find(list[s], b) != list[s].end()) visit(list[s]);
        };
        look(band_.tetras);
        look(band_.triangles);
    }

    /// Makes the node that would have to move farthest dearer.
    void penalise(const auto& nodes, double factor) {
        raise(*std::ranges::max_element(nodes, {}, [&](int v) { return std::pair(slide_[v], v); }), factor);
    }

    void raise(int v, double factor) const {
        lessons_.penalty[v] = std::min(lessons_.penalty[v] * factor, largest_penalty);
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    const Tool& tool_;
    const Mesh& mesh_;
    Lessons& lessons_;
    std::vector<int> side_;            ///< +1, -1, 0: in the interface
    std::vector<Vec3> target_;         ///< on the tool
    std::vector<double> slide_;        ///< distance to it in mean edge lengths
    std::vector<double> length_;       ///< mean edge lengths
    std::vector<BandElement> folded_;  ///< second-order elements
    std::vector<int> misplaced_;       ///< nodes that ended on the wrong side of the tool
    double worst_ = 1;
};

}  // namespace

void deform_to_tool(Workpiece& f, const Tool& tool, const Mesh& mesh) {
    Stopwatch watch(f.seconds);
    const auto count = static_cast<std::size_t>(f.d.band.size());
    Lessons lessons{std::vector<double>(count, 1), std::vector<char>(count, 0)};
    double worst = 1;
    for (int t = 0; t < f.d.band.tetras.size(); ++t) worst = std::min(worst, tetra_quality(f.d, t));
    for (int t = 0; t < f.d.band.triangles.size(); ++t)
        if (f.d.constraints.is_shell(f.d.band.triangles.origin(t))) worst = std::min(worst, shell_quality(f.d, t));
    const double enough = std::min(good_enough, worst / 2);
    std::optional<Workpiece> best;
    double best_quality = acceptable;
    for (int k = 0; k < attempts; ++k) {
        check_cancelled();
        Workpiece g = f;
        Deformer deformer(g, tool, mesh, lessons);
        if (!deformer.classify()) {
            if (best) break;
            deformer.fail_fixed();
        }
        const double quality = deformer.move();
        if (quality > best_quality) {
            best_quality = quality;
            best = std::move(g);
        }
        if (best_quality >= enough) break;
        if (k + 1 == attempts && !best) deformer.fail();
        deformer.learn();
    }
    f = std::move(*best);
    watch.lap("deform");
}

}  // namespace femscalpel
