// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "cutting/input_geometry.h"
#include "deformation/deformable.h"
#include "error.h"
#include "tools/cad_shape.h"
#include "tools/distance_field.h"

namespace femscalpel {

/// How a band is bisected.
struct BisectionOptions {
    double size = 0;                 ///< longest edge wanted near the tool, in the mesh's unit
    double gradation = 0.5;          ///< how much longer edges may be per unit of distance from the tool
    double reach = 0;                ///< `size` holds up to this distance, and grows from there
    bool relax = true;               ///< move new nodes for better shape, where that changes no surface or border
    Index max_elements = 5'000'000;  ///< ToolError instead of a larger mesh
    const CadShape* skin = nullptr;  ///< the shape the mesh was made from: new nodes of the skin are put on it
    /// What messages advise against too fine a mesh, and, other than that, too large a one.
    std::string finer_advice = "Choose a larger size or gradation";
    std::string larger_advice = ", or a larger max_elements";
};

/// What is thrown where bisection would make more than BisectionOptions::max_elements.
ToolError too_many_elements(const BisectionOptions& options);

/// How long edges may be: size + gradation * max(0, d - reach), d the smallest distance of their ends and middle.
class SizeField {
public:
    SizeField(const DistanceField& distance, const BisectionOptions& options)
        : distance_(distance), options_(options) {}

    double distance(const Vec3& x) const { return distance_(x); }

    /// Whether an edge between `a` and `b`, at distances `da` and `db`, has to be bisected.
    bool exceeded(const Vec3& a, const Vec3& b, double da, double db) const {
        const double length = (b - a).norm();
        if (length <= options_.size) return false;
        // Distances change by no more than the way between two points, so most edges are settled by their ends.
        const double ends = std::min(std::abs(da), std::abs(db));
        const bool crosses = may_cross(length, da, db);
        if (!crosses && length <= longest(std::max(0.0, ends - length / 2))) return false;
        if (crosses || length > longest(ends)) return true;
        const double middle = distance_((a + b) / 2);
        return may_cross(length / 2, da, middle) || may_cross(length / 2, middle, db) ||
               length > longest(std::min(ends, std::abs(middle)));
    }

private:
    /// Whether the surface may be between two points so far from each other. The distance changes its sign far from
    /// it, too: behind a disk, at the border of the column beneath it; and where another of two surfaces is nearer.
    static bool may_cross(double apart, double da, double db) {
        return (da < 0) != (db < 0) && std::abs(da) + std::abs(db) <= apart * (1 + 1e-6);
    }

    double longest(double distance) const {
        return options_.size + options_.gradation * std::max(0.0, distance - options_.reach);
    }

    const DistanceField& distance_;
    const BisectionOptions& options_;
};

/// Bisects the edges of a band that are longer than a size field wants: longest edges first, and an edge only when it
/// is the longest of all elements around it; otherwise theirs go first (Rivara, "New longest-edge algorithms for the
/// refinement and/or improvement of unstructured triangulations", Int. J. Numer. Meth. Engng. 40 (1997)).
class Bisector {
public:
    /// `distance` is that of the band's nodes. All but it must outlive this. Where `may_grow`, run() may ask for a
    /// larger band; otherwise propagation ends at the band's rim.
    Bisector(Deformable& d, const Mesh& mesh, const SizeField& field, const BisectionOptions& options,
             std::vector<double> distance, bool may_grow);

    /// False when an edge had to be bisected some of whose elements are outside the band. Throws ToolError when there
    /// would be more than BisectionOptions::max_elements.
    bool run();

    /// New nodes of the skin that are off the shape the mesh was made from, because elements would have been spoilt.
    int off_shape() const { return off_shape_; }

    /// The middle of an edge: in the input's geometry, unless relaxing took an end of it from where it was there.
    Vec3 middle(int a, int b) const;

    /// Edges that were left as they are because their elements are so curved that parts of them would be flat.
    int left() const { return static_cast<int>(left_.size()); }

    /// Where a mid-side node between two nodes belongs.
    Vec3 mid_side(int a, int b) const;

private:
    /// Edges in the order they are bisected in. Lengths are rounded, so that rounding does not decide between equal
    /// ones.
    struct Edge {
        float length;
        int a, b;
        bool operator<(const Edge& other) const {
            return std::tie(length, a, b) < std::tie(other.length, other.a, other.b);
        }
    };

    Edge edge(int a, int b) const;
    bool exceeded(int a, int b) const;
    bool is_inside(int a, int b) const { return band_.nodes[a].movable() || band_.nodes[b].movable(); }

    template <class Visit>
    void for_each_around(int a, int b, Visit visit) const {
        const auto look = [&](const auto& list) {
            for (const int s : list.around(a))
                if (std::ranges::find(list[s], b) != list[s].end()) visit(list[s]);
        };
        look(band_.tetras);
        look(band_.triangles);
    }

    bool exists(int a, int b) const;

    bool split_long_edges();

    /// The end of the longest-edge propagation path from `e`: an edge that is the longest of all elements around it.
    Edge terminal(Edge e) const;

    /// Whether parts of the elements around an edge would be nearly flat or inverted, split in its bent middle: their
    /// curved shape may be sound all the same, but not what is made of their corners.
    bool would_spoil(int a, int b, const Vec3& at) const;

    bool split(int a, int b);

    /// Brings nodes onto the shape for which there was no room when they were born.
    void put_on_shape();

    /// Relaxes new nodes wherever that changes neither the geometry nor a border.
    void improve();

    Deformable& d_;
    BandMesh& band_;
    const Mesh& mesh_;
    const SizeField& field_;
    const BisectionOptions& options_;
    std::vector<double> distance_;  // by band node
    int off_shape_ = 0;
    const bool may_grow_;  // whether a larger band may be asked for; otherwise propagation ends at the rim
    const double unit_;    // of squares of lengths in Edge
    const Index count_at_start_ = band_.tetras.size() + band_.triangles.size();
    const std::unordered_set<std::uint64_t> blocked_;
    std::unordered_set<std::uint64_t> left_;  // see left()
    InputGeometry geometry_;
    /// By band node: it is not where its place in the input's elements says, as it or a node it was born between moved.
    std::vector<char> strayed_ = std::vector<char>(static_cast<std::size_t>(band_.size()), 0);
};

}  // namespace femscalpel
