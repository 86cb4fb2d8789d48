// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/touching_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <tuple>

#include "cancel.h"
#include "cutting/surface_line.h"
#include "error.h"
#include "mesh/near_boxes.h"
#include "mesh/outer_faces.h"
#include "mesh/surface_tree.h"
#include "mesh/triangle_crossing.h"

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;

/// What touches, in the shorter of the two mean edge lengths.
constexpr double touching = 0.1;
/// As far a faceted surface may be off the smooth one, in its sag.
constexpr double off_facets = 1.5;
/// Cosine of the angle up to which faces that are near each other lie on each other.
constexpr double parallel = 0.8;
/// A foot is on the border, not in the surface, if it is so much more beside than below, in the distance.
constexpr double beside = 0.5;
/// And in mean edge lengths, whatever the distance.
constexpr double exact = 1e-6;
/// Places at which a face is looked at, along each edge and for each edge length of the other.
constexpr int samples = 3, most_samples = 40;

/// Finds what touches.
class Toucher {
public:
    Toucher(const Mesh& a, const Mesh& b, std::optional<double> tolerance) : mesh_{&a, &b}, given_(tolerance) {
        const Box box_a = box_around(a), box_b = box_around(b);
        // How far apart what touches can be is known only when the faces there are.
        const double apart = tolerance.value_or(touching * std::min(box_a.diagonal().norm(), box_b.diagonal().norm()));
        const Box common = grown(box_a, apart).intersection(grown(box_b, apart));
        for (const std::size_t m : {0U, 1U}) {
            if (!common.isEmpty()) outer_[m] = outer_faces(*mesh_[m], common);
            trees_[m] = std::make_unique<SurfaceTree>(*mesh_[m], outer_[m].triangles);
            for (std::size_t t = 0; t < outer_[m].triangles.size(); ++t)
                if (!outer_[m].triangles[t].shell) skin_[m].push_back(outer_[m].triangles[t]);
            skins_[m] = std::make_unique<SurfaceTree>(*mesh_[m], skin_[m]);
        }
    }

    TouchingFaces run() {
        if (outer_[0].triangles.empty() || outer_[1].triangles.empty()) {
            for (const std::size_t m : {0U, 1U}) refuse_inside(m, first_place(m), 0);
            return {};
        }
        refuse_overlap();
        for (const std::size_t m : {0U, 1U}) find_faces(m);
        find_edges(1);
        if (found_[0].empty()) find_edges(0);
        TouchingFaces out;
        for (const std::size_t m : {0U, 1U}) put(m, out);
        out.gap = gap_;
        out.tolerance = reach_;
        return out;
    }

private:
    using Key = std::tuple<CellType, Index, std::int8_t>;

    /// What is under a place.
    struct Foot {
        SurfaceTree::Foot on;
        double reach;  ///< as far it may have been
    };

    Vec3 corner(std::size_t m, int triangle, int k) const {
        return mesh_[m]->points[outer_[m].triangles[triangle].nodes[k]];
    }
    Vec3 middle(std::size_t m, int triangle) const {
        return (corner(m, triangle, 0) + corner(m, triangle, 1) + corner(m, triangle, 2)) / 3;
    }

    double reach(double size, double sag, std::size_t other, int piece) const {
        return given_.value_or(std::max(touching * std::min(size, trees_[other]->size(piece)),
                                        off_facets * std::max(sag, trees_[other]->sag(piece))));
    }

    /// Where x, on mesh m, is on the other; nothing where it does not touch.
    std::optional<Foot> foot(std::size_t m, const Vec3& x, double size, double sag) const {
        const SurfaceTree& other = *trees_[1 - m];
        const SurfaceTree::Foot on = other.closest(x);
        const double most = reach(size, sag, 1 - m, on.piece);
        if (on.distance > most) return {};
        const Vec3 n = other.normal(on.piece), off = x - on.at;
        if ((off - off.dot(n) * n).norm() > std::max(beside * on.distance, exact * size)) return {};
        return Foot{on, most};
    }

    int divisions(double length, const Vec3& at, std::size_t other) const {
        const double fine = trees_[other]->size(trees_[other]->closest(at).piece);
        return std::clamp(static_cast<int>(std::ceil(samples * length / fine)), samples, most_samples);
    }

    void add(std::size_t m, const Facet& facet, int triangle) {
        found_[m].insert({facet.type, facet.cell, facet.face});
        sizes_[m].insert_or_assign(Key{facet.type, facet.cell, facet.face}, trees_[m]->size(triangle));
    }

    /// The facet of a triangle on the side of `towards`.
    Facet facet(std::size_t m, int triangle, const Vec3& towards) const {
        Facet out = outer_[m].owners[triangle];
        if (outer_[m].triangles[triangle].shell) out.face = trees_[m]->normal(triangle).dot(towards) < 0 ? 1 : 2;
        return out;
    }

    /// Where the other's material is as seen from x.
    Vec3 towards(std::size_t m, int triangle, const Vec3& x, const SurfaceTree::Foot& on) const {
        if (on.distance > exact * trees_[m]->size(triangle)) return on.at - x;
        if (!outer_[1 - m].triangles[on.piece].shell) return -trees_[1 - m]->normal(on.piece);
        // Shells in one surface: the first mesh's is below.
        return m == 0 ? trees_[0]->normal(triangle) : Vec3(-trees_[0]->normal(on.piece));
    }

    void find_faces(std::size_t m) {
        const SurfaceTree& own = *trees_[m];
        SparseCheck check(64);
        for (int t = 0; t < static_cast<int>(outer_[m].triangles.size()); ++t) {
            check();
            const Vec3 at = middle(m, t), a = corner(m, t, 0), b = corner(m, t, 1), c = corner(m, t, 2);
            const double radius = std::sqrt(
                             std::max({(a - at).squaredNorm(), (b - at).squaredNorm(), (c - at).squaredNorm()})),
                         size = own.size(t), sag = own.sag(t);
            const SurfaceTree::Foot near = trees_[1 - m]->closest(at);
            if (near.distance > radius + reach(size, sag, 1 - m, near.piece)) continue;
            const int n = divisions(size, at, 1 - m);
            for (int i = 0; i < n; ++i)
                for (int j = 0; i + j < n; ++j) {
                    const double u = (i + 1.0 / 3) / n, v = (j + 1.0 / 3) / n;
                    look_at(m, t, a + u * (b - a) + v * (c - a));
                }
        }
    }

    void look_at(std::size_t m, int t, const Vec3& x) {
        const auto on = foot(m, x, trees_[m]->size(t), trees_[m]->sag(t));
        if (!on || std::abs(trees_[1 - m]->normal(on->on.piece).dot(trees_[m]->normal(t))) < parallel) return;
        gap_ = std::max(gap_, on->on.distance);
        reach_ = std::max(reach_, on->reach);
        add(m, facet(m, t, towards(m, t, x, on->on)), t);
        // A small face of the other may lie between the places that are looked at there.
        add(1 - m, facet(1 - m, on->on.piece, towards_back(m, t, x, on->on)), on->on.piece);
    }

    Vec3 towards_back(std::size_t m, int triangle, const Vec3& x, const SurfaceTree::Foot& on) const {
        if (on.distance > exact * trees_[m]->size(triangle)) return x - on.at;
        if (!outer_[m].triangles[triangle].shell) return -trees_[m]->normal(triangle);
        return m == 1 ? trees_[0]->normal(on.piece) : Vec3(-trees_[0]->normal(triangle));
    }

    /// Edges of shells of mesh m that stand on the other.
    void find_edges(std::size_t m) {
        SparseCheck check(64);
        for (const OuterFaces::Edge& e : outer_[m].edges) {
            check();
            const Vec3 a = mesh_[m]->points[e.nodes[0]], b = mesh_[m]->points[e.nodes[1]];
            const double length = (b - a).norm(), size = std::min(length, trees_[m]->size(e.triangle));
            const int n = divisions(length, (a + b) / 2, 1 - m);
            for (int i = 0; i < n; ++i) {
                const auto on = foot(m, a + (i + 0.5) / n * (b - a), size, trees_[m]->sag(e.triangle));
                if (!on || std::abs(trees_[1 - m]->normal(on->on.piece).dot(trees_[m]->normal(e.triangle))) > parallel)
                    continue;
                gap_ = std::max(gap_, on->on.distance);
                reach_ = std::max(reach_, on->reach);
                add(m, e.facet, e.triangle);
                add_around(1 - m, on->on, on->reach * trees_[1 - m]->normal(on->on.piece).cross(b - a).normalized(),
                           middle(m, e.triangle));
                edges_[m] = true;
            }
        }
    }

    /// The facets of mesh m under an edge, and beside it, as far as `across`: shells have a thickness.
    void add_around(std::size_t m, const SurfaceTree::Foot& foot, const Vec3& across, const Vec3& towards) {
        for (const double side : {-1.0, 0.0, 1.0}) {
            const int piece = trees_[m]->closest(foot.at + side * across).piece;
            if (std::abs(trees_[m]->normal(piece).dot(trees_[m]->normal(foot.piece))) >= parallel)
                add(m, facet(m, piece, towards - foot.at), piece);
        }
    }

    void put(std::size_t m, TouchingFaces& out) const {
        double sum = 0;
        for (const Key& key : found_[m]) {
            const auto& [type, cell, face] = key;
            out.facets[m].push_back({type, face, 0, cell});
            sum += sizes_[m].at(key);
        }
        if (!found_[m].empty()) out.size[m] = sum / static_cast<double>(found_[m].size());
        out.edges[m] = edges_[m];
    }

    [[noreturn]] static void fail_overlap(const Vec3& at, double depth) {
        std::ostringstream text;
        text << "the addition and the mesh overlap at " << point_text(at) << " by " << depth
             << ": what is tied only touches. Move the addition off, or use method='conform'";
        throw ToolError(text.str(), "other");
    }

    /// A place of mesh m.
    Vec3 first_place(std::size_t m) const {
        for (const CellBlock& b : mesh_[m]->blocks())
            if (b.size() > 0 && traits(b.type).dimension >= 2) return mesh_[m]->points[b.nodes(0)[0]];
        return mesh_[m]->points[0];
    }

    /// Throws when x, a place of mesh m, is deeper in the other's solids than `most`; by all of their skin.
    void refuse_inside(std::size_t m, const Vec3& x, double most) const {
        const Mesh& other = *mesh_[1 - m];
        std::vector<SurfaceFace> skin = outer_faces(other, box_around(other)).triangles;
        std::erase_if(skin, [](const SurfaceFace& f) { return f.shell; });
        if (skin.empty()) return;
        const double depth = -SurfaceTree(other, skin).signed_distance(x);
        if (depth > most) fail_overlap(x, depth);
    }

    void refuse_overlap() const {
        SparseCheck check(64);
        for (const std::size_t m : {0U, 1U})
            for (int t = 0; t < static_cast<int>(outer_[m].triangles.size()); ++t) {
                check();
                for (const Vec3& x : {middle(m, t), corner(m, t, 0)}) {
                    if (skin_[1 - m].empty()) continue;
                    const SurfaceTree::Foot near = trees_[1 - m]->closest(x);
                    const double most = reach(trees_[m]->size(t), trees_[m]->sag(t), 1 - m, near.piece);
                    if (-skins_[1 - m]->signed_distance(x) > most) refuse_inside(m, x, most);
                }
            }
        for (const std::size_t m : {0U, 1U}) refuse_passing(m);
        for (const auto& [i, j] : near_boxes(boxes(0), boxes(1))) {
            check();
            refuse_crossing(i, j);
        }
    }

    /// Throws when an edge of mesh m lies on the other, and its faces are on both sides of that.
    void refuse_passing(std::size_t m) const {
        std::map<std::pair<Index, Index>, std::vector<std::pair<int, Index>>> edges;  // triangle, and its third corner
        for (int t = 0; t < static_cast<int>(outer_[m].triangles.size()); ++t) {
            const auto& n = outer_[m].triangles[t].nodes;
            for (std::size_t k = 0; k < 3; ++k) edges[std::minmax(n[k], n[(k + 1) % 3])].push_back({t, n[(k + 2) % 3]});
        }
        SparseCheck check(64);
        const auto& points = mesh_[m]->points;
        for (const auto& [edge, faces] : edges) {
            check();
            if (faces.size() < 2) continue;
            const int t = faces.front().first;
            const Vec3 x = (points[edge.first] + points[edge.second]) / 2;
            const auto on = foot(m, x, trees_[m]->size(t), trees_[m]->sag(t));
            // On the other's border it is the other that touches.
            const SurfaceTree& other = *trees_[1 - m];
            if (!on || (!other.border().empty() && other.closest_on_border(x).distance <= on->reach)) continue;
            double low = 0, high = 0;
            for (const auto& [face, third] : faces) {
                const double side = (points[third] - on->on.at).dot(trees_[1 - m]->normal(on->on.piece));
                low = std::min(low, side);
                high = std::max(high, side);
            }
            if (std::min(-low, high) > on->reach) fail_overlap(x, std::min(-low, high));
        }
    }

    std::vector<Box> boxes(std::size_t m) const {
        std::vector<Box> out(outer_[m].triangles.size());
        for (int t = 0; t < static_cast<int>(out.size()); ++t)
            for (int k = 0; k < 3; ++k) out[t].extend(corner(m, t, k));
        return out;
    }

    /// Throws when one triangle goes through another by more than the tolerance.
    void refuse_crossing(int i, int j) const {
        const TriangleCorners a{corner(0, i, 0), corner(0, i, 1), corner(0, i, 2)},
            b{corner(1, j, 0), corner(1, j, 1), corner(1, j, 2)};
        const double most = reach(trees_[0]->size(i), trees_[0]->sag(i), 1, j);
        const auto depth = [&](const TriangleCorners& of, const Vec3& at, const Vec3& normal) {
            double low = 0, high = 0;
            for (const Vec3& x : of) {
                low = std::min(low, (x - at).dot(normal));
                high = std::max(high, (x - at).dot(normal));
            }
            return std::min(-low, high);
        };
        const double through = std::min(depth(a, b[0], trees_[1]->normal(j)), depth(b, a[0], trees_[0]->normal(i)));
        if (through <= most) return;
        if (const auto span = cross_triangles(a, b, exact * most); span && ((*span)[1] - (*span)[0]).norm() > most)
            fail_overlap(((*span)[0] + (*span)[1]) / 2, through);
    }

    std::array<const Mesh*, 2> mesh_;
    std::optional<double> given_;
    std::array<OuterFaces, 2> outer_;
    std::array<std::vector<SurfaceFace>, 2> skin_;  // triangles of solids alone
    std::array<std::unique_ptr<SurfaceTree>, 2> trees_, skins_;
    std::array<std::set<Key>, 2> found_;
    std::array<std::map<Key, double>, 2> sizes_;
    std::array<bool, 2> edges_{};
    double gap_ = 0, reach_ = 0;
};

}  // namespace

TouchingFaces touching_faces(const Mesh& a, const Mesh& b, std::optional<double> tolerance) {
    return Toucher(a, b, tolerance).run();
}

}  // namespace femscalpel
