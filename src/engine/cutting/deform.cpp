// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <set>

#include "cancel.h"
#include "cutting/folded_input.h"
#include "cutting/improve.h"
#include "cutting/mend_curved.h"
#include "cutting/untangler.h"
#include "cutting/vertex_cut.h"
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
            if (!band_.tetras.around(v).empty() || !band_.triangles.around(v).empty()) f_.distance[v] = side_[v];
            d_.contact[v] = side_[v] == 0 ? Contact(&tool_) : Contact();
        }
        find_node_sets(f_);
        std::vector<Vec3> given;
        given.reserve(f_.nodes.size());
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
        worst_ = untangle(d_, movable, 0.2);
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
                               "). Moving nodes alone is not enough here; use method \"snap\"",
                           "method");
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
                               std::string(tool_.kind()) +
                               ": nodes on both sides of it cannot be moved there (elements " + list(elements) +
                               "); use method \"snap\"",
                           "method");
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
        edges.reserve(found.size());
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
