// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "deformation/kept_geometry.h"
#include "mesh/band_mesh.h"
#include "mesh/family_table.h"
#include "tools/contact.h"

namespace femscalpel {

class BandBoundaries;

/// The geometry that moving nodes of a band have to keep (KeptGeometry), each node's place on it, and what else holds
/// nodes: isolated members of groups, equations, what is attached to them.
class NodeConstraints {
public:
    /// Analyses `band`, where nothing has moved yet. The functions that take the band need it to be marked by
    /// geometry().mark().
    NodeConstraints(const BandMesh& band, const Mesh& mesh, const ConstraintOptions& options);

    const KeptGeometry& geometry() const { return geometry_; }

    const NodeConstraint& operator[](int node) const { return nodes_[node]; }

    /// Must be called after BandMesh::split_edge() made `node`: it keeps to what its edge was on.
    void add_node(const BandMesh& band, int node);

    /// Must be called after BandMesh::add_node() made `node`: it is free inside the material, fixed on the skin.
    void add_lone_node(const BandMesh& band, int node, bool exterior);

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

    /// Takes faces and edges (slots of BandMesh::skin and BandMesh::creases, where nothing has moved or been split yet)
    /// out of what is kept: they are to be moved. Their nodes keep to what else there is.
    void release(BandMesh& band, std::span<const int> facets, std::span<const int> segments);

    /// Makes a curved surface of the kept geometry what it is exactly.
    void set_exact(int surface, std::shared_ptr<const Tool> exact) {
        geometry_.surfaces[surface].exact = std::move(exact);
    }

    /// Makes a curved surface, a bent line go on beyond its border, its ends.
    void let_surface_go_on(int surface) { geometry_.surfaces[surface].goes_on = true; }
    void let_curve_go_on(int curve) { geometry_.curves[curve].goes_on = true; }

    /// Whether something other than the geometry held a node of the input: a group it is isolated in, the solver's
    /// input, an element that ends there.
    bool is_held(int node) const { return node < static_cast<int>(held_.size()) && held_[node] != 0; }

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

    /// How far a node may move from where it was: KeptGeometry::Place::leash.
    double leash(int node) const { return leash_[node]; }

    /// Distance of `x` to the node's surface or curve in the input; 0 for free nodes.
    double distance(const NodeConstraint& constraint, const Vec3& x) const;

    /// The normal of the surface a node lies on, at `x`, or nothing.
    std::optional<Vec3> surface_normal(const NodeConstraint& constraint, const Vec3& x) const;

    /// Of the geometry: see there.
    bool any_curved() const { return geometry_.any_curved(); }
    using ShapeMatch = femscalpel::ShapeMatch;
    const ShapeMatch& shape_match() const { return geometry_.match; }
    bool is_on_shape(const NodeConstraint& c) const { return geometry_.is_on_shape(c); }
    bool is_flat(int surface) const { return geometry_.surfaces[surface].flat; }
    bool is_straight(const NodeConstraint& c) const { return geometry_.is_straight(c); }
    bool is_straight(int curve) const { return geometry_.curves[curve].straight; }

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

    /// Whether such a segment is a beam, truss, rod or cable: it has a length, and may be divided.
    bool is_beam(int line_origin) const { return loose_[line_origin] == beam; }

private:
    void find_shells(const BandMesh& band);
    void find_loose(const BandMesh& band, const Mesh& mesh, const ConstraintOptions& options);
    void find_isolated(const BandMesh& band, const BandBoundaries& boundaries, const ConstraintOptions& options);
    void find_freedom(const BandMesh& band, const ConstraintOptions& options);
    void find_exterior();
    NodeConstraint place_beside(int node) const;
    bool is_border(const BandMesh& band, int crease) const { return geometry_.curves[band.creases.tag(crease)].border; }
    const KeptGeometry::Surface& surface(const BandMesh& band, int skin) const {
        return geometry_.surfaces[band.skin.tag(skin)];
    }

    /// Kinds of the surfaces and curves at a node, and of its own, ascending.
    std::vector<int> kinds_at(const BandMesh& band, int node) const;

    KeptGeometry geometry_;
    std::vector<NodeConstraint> nodes_;
    std::vector<double> leash_;
    std::vector<char> held_;     // by input node: is_held()
    std::vector<char> related_;  // nodes related by equations, and those born between them; empty if none
    std::vector<char> exterior_;
    std::vector<char> shell_;
    enum : char { attached, other, beam };
    std::vector<char> loose_;
    FamilyTable kinds_;
    std::vector<std::pair<int, int>> isolated_;  // input nodes in IE, ascending, and their kinds
    std::unordered_set<std::uint64_t> fixed_middles_;
    bool has_shortcuts_ = false;
    double close_ = 0;  // a tool that is no farther off what it runs along is on it
};

}  // namespace femscalpel
