// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "deformation/deformable.h"

namespace femscalpel {

/// Second-order elements whose curved_ratio() is below this are not made, unless they were worse before.
inline constexpr double curved_limit = 0.15;

/// A tetrahedron or triangle of a band.
struct BandElement {
    bool triangle;
    int slot;

    bool operator==(const BandElement&) const = default;
    bool alive(const BandMesh& band) const { return triangle ? band.triangles.alive(slot) : band.tetras.alive(slot); }
    bool is_changed(const BandMesh& band) const {
        return triangle ? band.is_changed(band.triangles, slot) : band.is_changed(band.tetras, slot);
    }
    int origin(const BandMesh& band) const { return triangle ? band.triangles.origin(slot) : band.tetras.origin(slot); }
    const CellRef& cell(const BandMesh& band) const {
        return (triangle ? band.triangle_cells : band.tetra_cells)[origin(band)];
    }
    /// Its corners. Not to be kept while elements are added, split or merged.
    std::span<const int> nodes(const BandMesh& band) const {
        return triangle ? std::span<const int>(band.triangles[slot]) : std::span<const int>(band.tetras[slot]);
    }
};

/// Whether it is curved by its mid-side nodes, and by nothing else: a second-order tetrahedron or shell.
bool is_second_order(const Deformable& d, BandElement element);

/// Calls visit(element) for the second-order elements around a node.
void for_second_order_around(const Deformable& d, int node, auto visit) {
    for (const bool triangle : {false, true})
        for (const int s : triangle ? d.band.triangles.around(node) : d.band.tetras.around(node))
            if (const BandElement e{triangle, s}; is_second_order(d, e)) visit(e);
}

/// Calls visit(element) for those around the edge a-b.
void for_second_order_at_edge(const Deformable& d, int a, int b, auto visit) {
    for_second_order_around(d, a, [&](BandElement e) {
        const auto nodes = e.nodes(d.band);
        if (std::ranges::find(nodes, b) != nodes.end()) visit(e);
    });
}

/// Where the mid-side node of an edge belongs.
struct MidSide {
    Vec3 at;
    bool fits;  ///< false: there is no point near the chord on the surface, curve and tools the edge is on
};

/// The tools the edge a-b lies on. Where a curved skin touches a tool, an edge can have both ends on it without being
/// part of the interface; it stays with the skin.
Contact edge_tools(const Deformable& d, int a, int b);

/// Mid-side node of an edge of the band with its ends where they are: it keeps its place relative to the chord, and on
/// a curved surface or curve of the input, or on tools, it lies on them.
MidSide mid_side(const Deformable& d, int a, int b);

/// The second-order elements around a node of which several places are to be tried. The mid-side nodes of the edges
/// across from it are found once; so nothing else may change from then on.
class CurvedStar {
public:
    CurvedStar(Deformable& d, int node);

    /// Smallest curved_ratio() of the elements, were the node at `x`; 1 if they are straight, -1 if a mid-side node
    /// does not fit. Looks no further once it is below `enough`. Moves the node there and back.
    double worst(const Vec3& x, double enough = -std::numeric_limits<double>::infinity());

    /// Neighbours have moved: their mid-side nodes are to be found anew.
    void forget_places();

    /// Whether the elements stay sound when the node moves to `x` from where it is.
    bool stays_sound(const Vec3& x);

private:
    void gather();

    struct Element {
        std::size_t corners;
        std::array<int, 4> corner;
        std::array<int, 6> edge;  // places in edges_
        double bulges;            // sum of theirs
    };
    struct Edge {
        int a, b;
        bool at_node;  // its mid-side node moves with the node
        bool found;    // whether `mid` is that of the place tried
        double bulge;  // farthest_bulge()
        MidSide mid;
    };
    Deformable& d_;
    int node_;
    bool gathered_ = false;
    std::vector<Element> elements_;  // but those whose edges are all straight
    std::vector<Edge> edges_;        // around the node
    std::optional<Vec3> home_;       // for which at_home_ holds
    double at_home_ = 0;             // worst() where the node is
};

/// Where to look at an element's Jacobian: integration_ratio() or curved_ratio().
enum class ShapeAt { integration_points, corners_too };

/// That ratio of an element of the band as it is, 1 if it is not of second order.
double curved_shape(const Deformable& d, BandElement element, ShapeAt at = ShapeAt::corners_too);

/// Whether curved_shape() is at least curved_limit, at less cost; false for some elements for which it is.
bool is_surely_sound(const Deformable& d, BandElement element);

/// CurvedStar::stays_sound() for a single place.
bool keeps_curved_shape(Deformable& d, int node, const Vec3& x);

/// Smallest curved_ratio() of the elements around the edge a-b when it is split at `at`.
double curved_children(const Deformable& d, int a, int b, const Vec3& at, const Contact& tools);

/// Smallest curved_ratio() of the elements around node p when it is merged into its neighbour t.
double curved_merged(const Deformable& d, int p, int t);

}  // namespace femscalpel
