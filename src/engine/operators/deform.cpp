// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <set>

#include "deformation/bar_network.h"
#include "operators/interface.h"
#include "operators/stopwatch.h"

namespace femscalpel {
namespace {

/// Tags of tetrahedra and shells during classification (the paper's T1 and T2).
constexpr int in_t1 = 1;
constexpr int in_t2 = 2;

constexpr int faces_of_tetra[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};  // opposite corner k

class Deformer {
public:
    Deformer(Interface& f, const Tool& tool, const Mesh& mesh, bool positive)
        : f_(f), d_(f.d), band_(f.d.band), tool_(tool), mesh_(mesh), t1_side_(positive ? 1 : -1) {}

    void classify() {
        const auto label = [&](auto& list) {
            for (int s = 0; s < list.size(); ++s)
                list.set_tag(s, std::ranges::all_of(list[s], [&](int v) { return t1_side_ * f_.distance[v] >= 0; }) ? in_t1 : in_t2);
        };
        label(band_.tetras);
        label(band_.triangles);
        while (hand_over_tetras() || split_figure_4() || hand_over_shells()) {}
    }

    /// The crack interface CI: nodes of faces (edges) between T1 and T2.
    void find_interface() {
        interface_.clear();
        for (int t = 0; t < band_.tetras.size(); ++t) {
            if (band_.tetras.tag(t) != in_t1) continue;
            for (int k = 0; k < 4; ++k)
                if (across(t, k) >= 0 && band_.tetras.tag(across(t, k)) == in_t2)
                    for (int c : faces_of_tetra[k]) interface_.insert(band_.tetras[t][c]);
        }
        for (int t = 0; t < band_.triangles.size(); ++t) {
            if (!is_shell(t) || band_.triangles.tag(t) != in_t1) continue;
            for (int k = 0; k < 3; ++k)
                if (meets_t2(t, k)) {
                    interface_.insert(band_.triangles[t][(k + 1) % 3]);
                    interface_.insert(band_.triangles[t][(k + 2) % 3]);
                }
        }
        for (const int v : interface_)
            if (!band_.nodes[v].movable())
                throw QualityError("the interface reaches node " + number(v) + " outside the transition band; choose a larger transition");
        // From here on a node's side is that of its elements.
        for (int v = 0; v < band_.size(); ++v) {
            if (interface_.contains(v)) {
                f_.distance[v] = 0;
                continue;
            }
            d_.contact[v] = nullptr;
            const auto side = [&](const auto& list) {
                if (!list.around(v).empty()) f_.distance[v] = list.tag(list.around(v)[0]) == in_t1 ? t1_side_ : -t1_side_;
            };
            if (!band_.triangles.around(v).empty() && is_shell(band_.triangles.around(v)[0])) side(band_.triangles);
            side(band_.tetras);
        }
    }

    void move() {
        for (const int v : interface_) d_.contact[v] = nullptr;
        std::vector<int> waiting(interface_.begin(), interface_.end());
        find_movable();
        spread(waiting);
        for (int round = 0; round < 40 && !waiting.empty(); ++round) {
            bool progress = false;
            std::vector<int> left;
            for (const int v : waiting) {
                if (approach(v, progress)) d_.contact[v] = &tool_;
                else left.push_back(v);
            }
            waiting.swap(left);
            const bool stuck = !progress;
            std::vector<int> relaxed;
            for (const int v : movable_)
                if (!interface_.contains(v) || d_.contact[v]) relaxed.push_back(v);
            RelaxationOptions options;
            options.sweeps = 3;
            const long moves = relax(d_, relaxed, options);
            if (stuck && moves == 0) break;
        }
        if (!waiting.empty()) fail(waiting);
        find_node_sets(f_);
        std::vector<int> all = f_.nodes;
        all.insert(all.end(), f_.transition.begin(), f_.transition.end());
        relax(d_, all);
    }

private:
    bool is_shell(int t) const { return d_.constraints.is_shell(band_.triangles.origin(t)); }

    std::string number(int v) const {
        return band_.nodes[v].global >= 0 ? std::to_string(mesh_.node_ids[band_.nodes[v].global]) : "(new)";
    }

    /// The tetrahedron on the other side of the face opposite corner k, or -1.
    int across(int t, int k) const {
        const auto& n = band_.tetras[t];
        const int a = n[faces_of_tetra[k][0]], b = n[faces_of_tetra[k][1]], c = n[faces_of_tetra[k][2]];
        for (const int s : band_.tetras.around(a))
            if (s != t && std::ranges::find(band_.tetras[s], b) != band_.tetras[s].end() &&
                std::ranges::find(band_.tetras[s], c) != band_.tetras[s].end())
                return s;
        return -1;
    }

    /// Whether the shell's edge opposite corner k is shared with a T2 shell.
    bool meets_t2(int t, int k) const {
        const int a = band_.triangles[t][(k + 1) % 3], b = band_.triangles[t][(k + 2) % 3];
        return std::ranges::any_of(band_.triangles.around(a), [&](int s) {
            return s != t && is_shell(s) && band_.triangles.tag(s) == in_t2 &&
                   std::ranges::find(band_.triangles[s], b) != band_.triangles[s].end();
        });
    }

    std::vector<int> interface_corners(int t) const {
        std::vector<int> corners;
        for (int k = 0; k < 4; ++k)
            if (const int s = across(t, k); s >= 0 && band_.tetras.tag(s) == in_t2) corners.push_back(k);
        return corners;
    }

    bool hand_over_tetras() {
        bool any = false;
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (band_.tetras.tag(t) == in_t1 && interface_corners(t).size() >= 3) {
                band_.tetras.set_tag(t, in_t2);
                any = true;
            }
        return any;
    }

    /// Nodes of faces between T1 and T2.
    std::vector<char> interface_flags() const {
        std::vector<char> on(static_cast<std::size_t>(band_.size()), 0);
        for (int t = 0; t < band_.tetras.size(); ++t) {
            if (band_.tetras.tag(t) != in_t1) continue;
            for (const int k : interface_corners(t))
                for (const int c : faces_of_tetra[k]) on[band_.tetras[t][c]] = 1;
        }
        return on;
    }

    /// Figure 4: in a tetrahedron with two interface faces, the edge that joins the two corners opposite
    /// them is split in the middle. Every other tetrahedron whose four corners are all on the interface
    /// would be flattened just the same, so it is split too, at an edge that is in no interface face.
    bool split_figure_4() {
        bool any = false;
        const std::vector<char> on = interface_flags();
        const int count = band_.tetras.size();
        for (int t = 0; t < count; ++t) {
            const auto v = band_.tetras[t];
            if (!std::ranges::all_of(v, [&](int n) { return n < static_cast<int>(on.size()) && on[n] != 0; })) continue;
            int a = -1, b = -1;
            const std::vector<int> corners = band_.tetras.tag(t) == in_t1 ? interface_corners(t) : std::vector<int>{};
            if (corners.size() == 2) {
                a = v[corners[0]];
                b = v[corners[1]];
            } else {
                double longest = 0;
                for (int i = 0; i < 4; ++i)
                    for (int j = 0; j < i; ++j) {
                        const double length = (band_.nodes[v[i]].at - band_.nodes[v[j]].at).norm();
                        if (length > longest && !in_interface(v[i], v[j])) {
                            longest = length;
                            a = v[i];
                            b = v[j];
                        }
                    }
            }
            if (a < 0 || (!band_.nodes[a].movable() && !band_.nodes[b].movable())) continue;
            Vec3 at = (band_.nodes[a].at + band_.nodes[b].at) / 2;
            const Vec3 middle = at;
            const double length = (band_.nodes[a].at - band_.nodes[b].at).norm();
            if (!d_.constraints.project(d_.constraints.on_edge(band_, a, b), nullptr, at) || (at - middle).norm() > 0.1 * length) at = middle;
            d_.split_edge(a, b, at, nullptr);
            f_.distance.push_back(tool_.distance(at));
            any = true;
        }
        return any;
    }

    /// Whether tetrahedra of both sets share the edge a-b.
    bool in_interface(int a, int b) const {
        bool one = false, two = false;
        for (const int s : band_.tetras.around(a))
            if (std::ranges::find(band_.tetras[s], b) != band_.tetras[s].end()) (band_.tetras.tag(s) == in_t1 ? one : two) = true;
        return one && two;
    }

    bool hand_over_shells() {
        bool any = false;
        for (int t = 0; t < band_.triangles.size(); ++t) {
            if (!is_shell(t) || band_.triangles.tag(t) != in_t1) continue;
            int shared = 0;
            for (int k = 0; k < 3; ++k) shared += meets_t2(t, k);
            if (shared < 2) continue;
            band_.triangles.set_tag(t, in_t2);
            any = true;
        }
        return any;
    }

    void find_movable() {
        movable_.clear();
        for (int v = 0; v < band_.size(); ++v)
            if (band_.nodes[v].movable()) movable_.push_back(v);
    }

    /// The bar network carries the whole band along as far as elements stay sound.
    void spread(const std::vector<int>& interface) {
        std::vector<Vec3> given;
        for (const int v : interface) {
            Vec3 target = band_.nodes[v].at;
            if (!d_.constraints.project(v, &tool_, target)) target = band_.nodes[v].at;
            given.push_back(target - band_.nodes[v].at);
        }
        std::vector<int> others;
        for (const int v : movable_)
            if (!interface_.contains(v)) others.push_back(v);
        const std::vector<Vec3> displacement = bar_network_displacements(d_, interface, given, others);
        const auto step = [&](const std::vector<int>& nodes, const std::vector<Vec3>& by, double factor) {
            for (std::size_t k = 0; k < nodes.size(); ++k) {
                Vec3 x = band_.nodes[nodes[k]].at + factor * by[k];
                if (d_.constraints.project(nodes[k], nullptr, x)) band_.nodes[nodes[k]].at = x;
            }
        };
        std::vector<Vec3> kept;
        for (const BandNode& n : band_.nodes) kept.push_back(n.at);
        for (double factor = 1; factor > 0.1; factor /= 2) {
            step(interface, given, factor);
            step(others, displacement, factor);
            double worst = 1;
            for (int t = 0; t < band_.tetras.size(); ++t) worst = std::min(worst, tetra_quality(d_, t));
            for (int t = 0; t < band_.triangles.size(); ++t)
                if (is_shell(t)) worst = std::min(worst, shell_quality(d_, t));
            if (worst > 0.02) return;
            for (int v = 0; v < band_.size(); ++v) band_.nodes[v].at = kept[v];
        }
    }

    /// Moves an interface node towards the tool as far as its elements allow; true when it has arrived.
    bool approach(int v, bool& progress) {
        Vec3 target = band_.nodes[v].at;
        if (!d_.constraints.project(v, &tool_, target)) return false;
        const Vec3 from = band_.nodes[v].at;
        const double now = quality_around(d_, v, from);
        for (double factor = 1; factor > 0.05; factor /= 2) {
            Vec3 x = factor == 1 ? target : Vec3(from + factor * (target - from));
            if (factor < 1 && !d_.constraints.project(v, nullptr, x)) continue;
            if (quality_around(d_, v, x) < std::min(0.02, now / 2)) continue;
            band_.nodes[v].at = x;
            if ((x - from).norm() > 1e-3 * band_.mean_edge_length(v) || factor == 1) progress = true;
            return factor == 1;
        }
        return false;
    }

    [[noreturn]] void fail(const std::vector<int>& waiting) const {
        std::set<Index> elements;
        for (const int v : waiting) {
            for (const int t : band_.tetras.around(v)) {
                const CellRef& c = band_.tetra_cells[band_.tetras.origin(t)];
                elements.insert(mesh_.block(c.type).ids[c.cell]);
            }
            for (const int t : band_.triangles.around(v)) {
                const CellRef& c = band_.triangle_cells[band_.triangles.origin(t)];
                if (is_shell(t)) elements.insert(mesh_.block(c.type).ids[c.cell]);
            }
        }
        std::string list;
        int shown = 0;
        for (const Index id : elements) {
            if (shown++ == 8) break;
            list += (list.empty() ? "" : ", ") + std::to_string(id);
        }
        if (elements.size() > 8) list += ", ...";
        throw QualityError("method \"deform\" cannot bring " + std::to_string(waiting.size()) +
                           " interface node(s) onto the tool without flattening elements around them (elements " + list +
                           "). Moving nodes alone is not enough here; use method \"snap\"");
    }

    Interface& f_;
    Deformable& d_;
    BandMesh& band_;
    const Tool& tool_;
    const Mesh& mesh_;
    int t1_side_;
    std::set<int> interface_;
    std::vector<int> movable_;
};

}  // namespace

void deform_to_tool(Interface& f, const Tool& tool, const Mesh& mesh) {
    Stopwatch watch(f.seconds);
    const auto attempt = [&](Interface& g, bool positive) {
        Deformer deformer(g, tool, mesh, positive);
        deformer.classify();
        deformer.find_interface();
        deformer.move();
    };
    // The paper leaves open which half-space is T1: the other one is tried when the first cannot be done.
    Interface first = f;
    try {
        attempt(first, true);
        f = std::move(first);
    } catch (const QualityError&) {
        attempt(f, false);
    }
    watch.lap("deform");
}

}  // namespace femscalpel
