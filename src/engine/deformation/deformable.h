// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "deformation/mid_sides.h"
#include "deformation/node_constraints.h"
#include "groups/node_membership.h"
#include "mesh/band_mesh.h"
#include "tools/contact.h"

namespace femscalpel {

/// The state an operator deforms: a band, what its nodes have to stay on, and which tools each node lies on.
struct Deformable {
    BandMesh band;
    NodeConstraints constraints;
    MidSides mids;
    NodeMembership membership;        ///< node groups of each node
    std::vector<Contact> contact;     ///< by node: the tools it must stay on
    std::vector<Vec3> shell_normals;  ///< by triangle origin: the input's unit normal (shells only)
    const Tool* barrier = nullptr;    ///< a tool no node may pass through, if `side` of it is not 0
    std::vector<signed char> side;    ///< by node: sign of its distance to `barrier`
    std::vector<char> off_tool;       ///< by node: it may slide, but is not to be put on a tool
    double tolerance = 0;             ///< ConstraintOptions::tolerance
    double rounding = 0;              ///< ConstraintOptions::rounding
    long visits = 0;  ///< how often relaxation has tried to move a node: a measure of its work that does not depend on
                      ///< the machine
    std::vector<double>
        held_off;  ///< by node: how far off its tools it may be, as it is held beside them; see hold_beside()

    Deformable(BandMesh band, const Mesh& mesh, const ConstraintOptions& options);

    /// Splits the edge a-b at `at`, with everything that hangs on it, and returns the new node.
    int split_edge(int a, int b, const Vec3& at, const Contact& tools);

    /// Adds a node that is on no edge, as BandMesh::add_node() does; on the skin (`exterior`) it stays where it is.
    int add_node(const Vec3& at, int a, int b, const Contact& tools, bool exterior);

    /// Makes a node count as lying on `tools` where it is, though something else holds it a little beside them: it
    /// stays there.
    void hold_beside(int node, const Contact& tools);

    /// How far a node is off the tools it is in contact with, beyond what it is held off.
    double off_tools(int node) const { return off_tools(contact[node], band.nodes[node].at, held_off[node]); }
    static double off_tools(const Contact& tools, const Vec3& x, double held_off);

    /// The point at the fraction t of the edge a-b, which is bent if it is one of a second-order element or lies on
    /// a curved surface or curve.
    Vec3 along_edge(int a, int b, double t) const;

    /// A place to split the edge a-b, near `at`.
    struct SplitPoint {
        Vec3 at;
        bool fits;     ///< on the surface or curve the edge is on, and on the tools
        double worst;  ///< smallest mean ratio of the parts
    };

    /// Smallest mean ratio (negative when inverted) of the parts of the elements around the edge a-b, split at `at`.
    double worst_part(int a, int b, const Vec3& at) const;

    /// The point near `at` on the surface or curve the edge a-b is on (and on `tools`), if elements split
    /// there are nearly as good as those split at `at`; else `at` itself.
    SplitPoint fitted_split(int a, int b, const Vec3& at, const Contact& tools) const;

    /// The tools the edge a-b lies on: both its ends do, and it is not the chord of a curved tool, unless it is an edge
    /// of the faces that stand for that tool.
    Contact edge_contact(int a, int b) const;

    /// How far what lies between two nodes may be off the tools that both are on.
    double held_between(int a, int b) const { return std::max(held_off[a], held_off[b]); }

    /// Whether a node must not be at `x`: behind the barrier, or so far along a bent line that the line would lose its
    /// shape.
    bool is_barred(int node, const Vec3& x) const {
        return (barrier && side[node] != 0 && barrier->distance(x) * side[node] <= 0) ||
               (x - band.nodes[node].start).norm() > constraints.leash(node);
    }
};

/// Mean ratio of a tetrahedron of the band with its nodes where they are; negative when inverted.
double tetra_quality(const Deformable& d, int tetra);

/// The same of a shell; negative when turned over against the input's normal.
double shell_quality(const Deformable& d, int triangle);

/// tetra_quality(d, tetra) < limit, at less cost.
bool tetra_is_below(double limit, const Deformable& d, int tetra);

/// Smallest quality of the elements around a node, were it at `x`.
double quality_around(const Deformable& d, int node, const Vec3& x);

/// Whether it is below `limit` where the node is, at less cost.
bool quality_around_is_below(double limit, const Deformable& d, int node);

}  // namespace femscalpel
