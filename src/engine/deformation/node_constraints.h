// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_set>
#include <vector>

#include "mesh/band_mesh.h"
#include "mesh/family_table.h"
#include "tools/cad_shape.h"
#include "tools/contact.h"

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
    int hint = -1;   ///< facet of that shape it was last seen on
};

/// Which groups' boundaries are kept, and what counts as a feature line.
struct ConstraintOptions {
    double feature_angle = 30;          ///< degrees
    std::vector<bool> drifting_groups;  ///< by group index: boundary may drift; empty = all are kept
    std::vector<bool> meaningless;      ///< by group index: as if the group were not there; empty = none
    std::vector<bool> kept_hidden;      ///< by group index: hidden, but its boundary is kept; empty = none
    std::vector<Index> pinned;          ///< nodes (indices in the mesh, ascending) that must not move
    std::vector<Index> related;  ///< nodes (as pinned): one born on the skin between two of them must not move, so that
                                 ///< matching sides keep matching
    std::vector<Index>
        on_shortcuts;  ///< numbers of nodes, ascending, whose node groups have no boundary there: BandBoundaries
    const CadShape* shape =
        nullptr;           ///< what the mesh was made from: its skin is taken to be this, where it lies on it
    double tolerance = 0;  ///< what is nearer than this to something lies on it
    double rounding = 0;   ///< what is flat or straight but for so much is so: a few times coordinate_rounding(), or 0
};

/// The geometry that moving nodes of a band have to keep: the skin, feature lines, and the boundaries of
/// groups (resources/docs/architecture.md, "constrain"; paper, 3.1.2 and 4.1), and each node's place on it.
///
/// Surfaces are the input's own triangles, taken apart at feature lines and group borders; a surface
/// whose triangles are coplanar is treated as the exact plane. Second-order faces are followed as the
/// curved faces they are. Curves likewise. Where the shape the mesh was made from is known, faces and feature lines of
/// the skin that lie on it are followed as its faces and edges; edges between triangles of one of its faces are no
/// feature lines.
class NodeConstraints {
public:
    /// Analyses `band` and fills its `skin` and `creases` (tag: surface or curve index).
    NodeConstraints(BandMesh& band, const Mesh& mesh, const ConstraintOptions& options);

    const NodeConstraint& operator[](int node) const { return nodes_[node]; }

    /// Must be called after BandMesh::split_edge() made `node`: it keeps to what its edge was on.
    void add_node(const BandMesh& band, int node);

    /// Whether equations relate the node to others, or both ends of the edge it was born on; and whether an edge of the
    /// skin runs between such nodes. What is made or taken away there on one side of a pair would be missed on the
    /// other.
    bool is_related(int node) const { return !related_.empty() && related_[node]; }
    bool is_related_edge(const BandMesh& band, int a, int b) const {
        return is_related(a) && is_related(b) && is_skin_edge(band, a, b);
    }

    /// Whether the mid-side node of the edge a-b must not move: an isolated member of a group (IE), or pinned.
    bool has_fixed_middles() const { return !fixed_middles_.empty(); }
    bool has_fixed_middle(int a, int b) const { return fixed_middles_.contains(edge_key(a, b)); }

    /// To be called after add_node() for a node that was such a mid-side node, and for nodes that are held beside a
    /// tool.
    void fix_node(int node) { nodes_[node].freedom = NodeFreedom::fixed; }

    /// The constraint a node in the middle of the edge a-b has (of an existing edge of the band).
    NodeConstraint on_edge(const BandMesh& band, int a, int b) const;

    /// The constraint a node inside the face a-b-c has (an existing face of an element of the band).
    NodeConstraint on_face(const BandMesh& band, int a, int b, int c) const;

    /// Moves `x` to a near point that satisfies the node's constraints and lies on all of `tools`.
    /// False when there is none nearby (parallel surfaces, a fixed node off the tool); `x` is then undefined. A tool
    /// that runs along the node's surface or line, and on it but for the rounding of coordinates, adds nothing to it:
    /// there the tool is what counts. With `held` (Deformable::held_off) the tool may be so far off what it runs along,
    /// and then stays so.
    bool project(int node, const Contact& tools, Vec3& x) const { return project(nodes_[node], tools, x); }
    bool project(const NodeConstraint& constraint, const Contact& tools, Vec3& x, double held = 0) const;

    /// Orthonormal columns spanning the directions the node may move in at `x`; 0 to 3 columns.
    int tangents(int node, const Contact& tools, const Vec3& x, Eigen::Matrix3d& basis) const;

    /// How far a node may move from where it was: where a line of straight segments bends (the rim of a hole), moving
    /// its node cuts the corner, and the line and what it bounds would lose their shape. Infinite elsewhere.
    double leash(int node) const { return leash_[node]; }

    /// Distance of `x` to the node's surface or curve in the input; 0 for free nodes.
    double distance(const NodeConstraint& constraint, const Vec3& x) const;

    /// The normal of the surface a node lies on, at `x`, or nothing.
    std::optional<Vec3> surface_normal(const NodeConstraint& constraint, const Vec3& x) const;

    /// Whether any surface or curve is not flat or straight.
    bool any_curved() const {
        return !std::ranges::all_of(surfaces_, &Surface::flat) || !std::ranges::all_of(curves_, &Curve::straight);
    }

    /// Number of faces of the skin and of shells, and of those that lie on no face of ConstraintOptions::shape.
    struct ShapeMatch {
        Index faces = 0;
        Index off = 0;
    };
    const ShapeMatch& shape_match() const { return match_; }

    /// Whether the constraint's shape at `constraint.hint` is a curved face or edge of ConstraintOptions::shape.
    bool is_on_shape(const NodeConstraint& c) const {
        return (c.freedom == NodeFreedom::surface && facets_[c.hint].cad >= 0 && !surfaces_[c.shape].flat) ||
               (c.freedom == NodeFreedom::curve && (segments_[c.hint].cad >= 0 || segments_[c.hint].cad_face >= 0) &&
                !curves_[c.shape].straight);
    }

    bool is_flat(int surface) const { return surfaces_[surface].flat; }

    /// Whether the chord between two points on the constraint's shape is on it, too.
    bool is_straight(const NodeConstraint& c) const {
        return c.freedom == NodeFreedom::surface ? surfaces_[c.shape].flat
                                                 : c.freedom != NodeFreedom::curve || curves_[c.shape].straight;
    }
    bool is_straight(int curve) const { return curves_[curve].straight; }
    bool is_internal(int surface) const { return surfaces_[surface].internal; }

    /// Whether a node is on the outside in the paper's sense (3.1.2): on a face of only one tetrahedron,
    /// or, where there are only shells, on an edge of only one triangle.
    bool is_exterior(int node) const { return exterior_[node] != 0; }

    /// The same of an edge, of which a mid-side node would be.
    bool is_exterior_edge(const BandMesh& band, int a, int b) const;

    /// Whether the edge a-b lies on the skin of a solid or on a shell.
    bool is_skin_edge(const BandMesh& band, int a, int b) const;

    /// Whether a node lies on the skin of a solid or on a shell.
    bool is_on_skin(const BandMesh& band, int node) const;

    /// Whether an edge lies on a surface inside the material.
    bool is_internal_edge(const BandMesh& band, int a, int b) const;

    /// Whether a node lies on a surface inside the material: a border between groups.
    bool is_on_internal(const BandMesh& band, int node) const;

    /// Number of nodes by what a group's boundary leaves them, the other constraints of the node included.
    struct GroupCount {
        Index surface = 0;  ///< move on a surface, part of the boundary
        Index line = 0;     ///< move along a line
        Index fixed = 0;    ///< do not move
    };
    /// For each of `group_count` groups of the mesh, how many of `nodes` lie on its boundary (BE, LE and IE).
    std::vector<GroupCount> count_by_group(const BandMesh& band, std::span<const int> nodes,
                                           std::size_t group_count) const;

    /// The groups of the mesh that have their boundary (BE, LE, IE) at a node, ascending.
    std::vector<GroupIndex> groups_at(const BandMesh& band, int node) const;
    /// Whether a node group has shortcuts through the material (BandBoundaries), to whose shape nothing keeps.
    bool has_shortcuts() const { return has_shortcuts_; }

    /// Whether the triangle element in this slot is no face of a tetrahedron (a shell of its own).
    bool is_shell(int triangle_origin) const { return shell_[triangle_origin] != 0; }

    /// Whether the segment in this slot is no edge of a tetrahedron or triangle (a beam, a spring, ...).
    bool is_loose(int line_origin) const { return loose_[line_origin] != 0; }

private:
    struct Facet {  // a reference triangle, by input positions
        std::array<Vec3, 3> corner;
        std::array<Vec3, 3> mid;  // of edges 01, 12, 20
        Vec3 centre = Vec3::Zero();
        double radius = 0;  // of a ball around the centre that holds the facet
        double sag = 0;     // at most so far is it from its flat triangle
        double height = 0;  // smallest, of that triangle
        bool curved = false;
        std::array<int, 3> node;
        int surface = -1;
        int cad = -1;  // face of shape_
    };
    struct Surface {
        bool flat = true;
        bool internal = false;  // between two tetrahedra
        bool shell = false;
        int kind = 0;  // groups with their boundary here, in kinds_
        Vec3 normal = Vec3::Zero();
        Vec3 origin = Vec3::Zero();
    };
    struct Segment {
        std::array<Vec3, 2> end;
        Vec3 mid = Vec3::Zero();
        Vec3 centre = Vec3::Zero();
        double radius = 0;
        bool curved = false;
        std::array<int, 2> node;
        int curve = -1;
        int cad = -1;       // edge of shape_
        int cad_face = -1;  // or face of shape_ it lies on
    };
    struct Curve {
        bool straight = true;
        bool border = false;  // of a shell
        int kind = 0;         // groups with a linking edge here, in kinds_
        Vec3 origin = Vec3::Zero();
        Vec3 direction = Vec3::Zero();
    };
    struct Foot {
        Vec3 at = Vec3::Zero();
        Vec3 normal = Vec3::Zero();  // of a surface; tangent of a curve
        double distance2 = 0;
        double inside = 0;  // smallest barycentric coordinate on a facet
        int facet = -1;
    };

    /// `distance2` is infinite if that is surely not less than `limit2`.
    static Foot foot_on(const Facet& facet, const Vec3& x, double limit2 = std::numeric_limits<double>::infinity());
    static Foot foot_on(const Segment& segment, const Vec3& x);
    /// The face (edge) of the shape on which a triangle (segment) with these corners lies, or -1.
    int shape_face(const std::array<Vec3, 3>& corner) const;
    int shape_edge(const Vec3& a, const Vec3& b) const;
    void put_on_shape(Foot& foot, const CadShape::Foot& on, const Vec3& x) const;
    Foot surface_foot(const NodeConstraint& c, const Vec3& x) const;
    Foot curve_foot(const NodeConstraint& c, const Vec3& x) const;

    std::vector<int> kinds_at(const BandMesh& band, int node) const;

    std::vector<NodeConstraint> nodes_;
    std::vector<Facet> facets_;
    std::vector<Surface> surfaces_;
    std::vector<Segment> segments_;
    std::vector<Curve> curves_;
    std::vector<std::vector<int>> facets_around_;    // by input node
    std::vector<std::vector<int>> segments_around_;  // by input node
    std::vector<char> related_;  // nodes related by equations, and those born between them; empty if none
    std::vector<double> leash_;
    std::vector<char> exterior_;
    std::vector<char> shell_;
    std::vector<char> loose_;
    FamilyTable kinds_;
    std::vector<std::pair<int, int>> isolated_;  // input nodes in IE, ascending, and their kinds
    std::unordered_set<std::uint64_t> fixed_middles_;
    bool has_shortcuts_ = false;
    double size_ = 1;   // of the band, for tolerances
    double flat_ = 0;   // what is no farther off a plane or line is on it
    double close_ = 0;  // a tool that is no farther off what it runs along is on it
    const CadShape* shape_ = nullptr;
    ShapeMatch match_;
};

}  // namespace femscalpel
