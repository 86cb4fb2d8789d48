// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "deformation/kept_parts.h"
#include "mesh/band_mesh.h"
#include "tools/cad_shape.h"
#include "tools/tool.h"

namespace femscalpel {

/// What a node has to stay on, the tool apart.
enum class NodeFreedom : std::uint8_t {
    free,     ///< inside the material: may go anywhere
    surface,  ///< on one smooth surface: skin, shell, or the border of a group
    curve,    ///< on a feature line or the border line of a group: two surfaces
    fixed,    ///< a corner, an end, an isolated group node, a point where something else is attached
};

/// What a moving node has to keep to.
struct NodeConstraint {
    NodeFreedom freedom = NodeFreedom::free;
    int shape = -1;  ///< surface or curve the node stays on
    int hint = -1;   ///< facet or segment of that shape it was last seen on
};

/// The geometry that moving nodes of a band have to keep: the skin, feature lines, and the boundaries of groups
/// (resources/docs/architecture.md, "constrain"; paper, 3.1.2 and 4.1). It stays what it was in the input, whatever
/// becomes of the band.
///
/// Surfaces are the input's own triangles, taken apart at feature lines and group borders; a surface whose triangles
/// are coplanar is treated as the exact plane. Second-order faces are followed as the curved faces they are. Curves
/// likewise. Where the shape the mesh was made from is known, faces and feature lines of the skin that lie on it are
/// followed as its faces and edges; edges between triangles of one of its faces are no feature lines.
struct KeptGeometry {
    /// A triangle of a surface.
    struct Facet {
        std::array<Vec3, 3> corner;
        std::array<Vec3, 3> mid;  ///< of edges 01, 12, 20
        Vec3 centre = Vec3::Zero();
        double radius = 0;  ///< of a ball around the centre that holds the facet
        double sag = 0;     ///< at most so far is it from its flat triangle
        double height = 0;  ///< smallest, of that triangle
        bool curved = false;
        std::array<int, 3> node;
        int shape = -1;  ///< its surface
        int cad = -1;    ///< face of the shape the mesh was made from
    };
    /// Facets that are one smooth surface.
    struct Surface {
        bool flat = true;
        bool internal = false;  ///< between two tetrahedra
        bool shell = false;
        int kind = 0;                ///< groups with their boundary here: a kind of BandBoundaries
        Vec3 normal = Vec3::Zero();  ///< of the plane, if flat
        Vec3 origin = Vec3::Zero();  ///< on the plane, if flat
        /// What it is exactly, if that is known: then it goes on without end, as planes do.
        std::shared_ptr<const Tool> exact = {};
        bool goes_on = false;  ///< beyond its border it goes on in its tangent planes there
        bool is_skin() const { return !internal && !shell; }
    };
    /// A piece of a curve: an edge.
    struct Segment {
        std::array<Vec3, 2> end;
        Vec3 mid = Vec3::Zero();
        Vec3 centre = Vec3::Zero();
        double radius = 0;  ///< of a ball around the centre that holds the segment
        bool curved = false;
        bool fold = false;  ///< the front of a crack: KeptCrease
        std::array<int, 2> node;
        int shape = -1;     ///< its curve
        int cad = -1;       ///< edge of the shape the mesh was made from
        int cad_face = -1;  ///< or face of that it lies on
    };
    /// Segments that are one smooth curve.
    struct Curve {
        bool straight = true;
        bool border = false;  ///< of a shell
        int kind = 0;         ///< groups with a linking edge here: a kind of BandBoundaries
        Vec3 origin = Vec3::Zero();
        Vec3 direction = Vec3::Zero();
        bool goes_on = false;  ///< beyond its ends it goes on along its tangents there
    };
    /// What a node keeps to because of where it is.
    struct Place {
        NodeConstraint constraint;
        /// How far it may move from where it was: where a line of straight segments bends (the rim of a hole), moving
        /// its node cuts the corner, and the line and what it bounds would lose their shape. Infinite elsewhere.
        double leash = std::numeric_limits<double>::infinity();
    };

    std::vector<Facet> facets;  ///< by slot of the original in BandMesh::skin
    std::vector<Surface> surfaces;
    std::vector<Segment> segments;  ///< by slot of the original in BandMesh::creases
    std::vector<Curve> curves;
    std::vector<std::vector<int>> facets_around;    ///< by input node
    std::vector<std::vector<int>> segments_around;  ///< by input node
    std::vector<char> passes;                       ///< by input node: one curve goes through it, without a kink
    double size = 1;                                ///< of the band, for tolerances
    double rounding = 0;                            ///< ConstraintOptions::rounding
    const CadShape* shape = nullptr;                ///< ConstraintOptions::shape
    ShapeMatch match;

    /// What is no farther than this off a plane or line is on it.
    double flatness() const;

    /// Whether the chord between two points on the constraint's shape is on it, too.
    bool is_straight(const NodeConstraint& c) const {
        return c.freedom == NodeFreedom::surface ? surfaces[c.shape].flat
                                                 : c.freedom != NodeFreedom::curve || curves[c.shape].straight;
    }
    /// Whether the constraint's shape at `c.hint` is a curved face or edge of the shape the mesh was made from.
    bool is_on_shape(const NodeConstraint& c) const {
        return !is_straight(c) &&
               (c.freedom == NodeFreedom::surface ? facets[c.hint].cad >= 0
                                                  : segments[c.hint].cad >= 0 || segments[c.hint].cad_face >= 0);
    }
    /// Whether any surface or curve is not flat or straight.
    bool any_curved() const {
        return !std::ranges::all_of(surfaces, &Surface::flat) || !std::ranges::all_of(curves, &Curve::straight);
    }
    NodeConstraint on_facet(int facet) const { return {NodeFreedom::surface, facets[facet].shape, facet}; }
    NodeConstraint on_segment(int segment) const { return {NodeFreedom::curve, segments[segment].shape, segment}; }

    /// What a node of the input keeps to: nothing, one surface, one curve, or (a corner, an end, a front of a crack
    /// that bends, a point where surfaces only touch) its place.
    Place place_of(int node) const;

    /// Takes a facet or segment out of what is around its nodes: it counts no more for their places.
    void forget_facet(int facet) {
        for (const int v : facets[facet].node) std::erase(facets_around[v], facet);
    }
    void forget_segment(int segment) {
        for (const int v : segments[segment].node) std::erase(segments_around[v], segment);
    }

    /// Whether two surfaces lie in one plane, or two curves on one line.
    bool are_one_plane(int surface, int other) const;
    bool are_one_line(int curve, int other) const;

    /// Puts the facets and segments into the band's `skin` and `creases` (tag: surface or curve), to be split along
    /// with the elements. Those must be empty.
    void mark(BandMesh& band) const;
};

/// Finds the geometry to be kept in a band where nothing has moved yet. `boundaries` must be the band's.
KeptGeometry find_kept_geometry(const BandMesh& band, const Mesh& mesh, const BandBoundaries& boundaries,
                                const ConstraintOptions& options);

}  // namespace femscalpel
