// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deformation/deformable.h"
#include "mesh/stopwatch.h"

namespace femscalpel {

/// A surface that element faces are to be made of.
struct Blade {
    const Tool* tool = nullptr;
    /// It is wanted where this is not positive (a length, about that to the border); everywhere if empty.
    std::function<double(const Vec3&)> bound;
    /// Of tools that were cut along before: it is wanted on their negative side only.
    std::vector<const Tool*> inside;
    /// Faces made to lie on it are collected in BandMesh::cut_faces (edges of shells in cut_edges) under this tag; not
    /// if negative.
    int tag = -1;
};

/// Elements farther than this from where a blade is wanted, in their longest edges, are not cut by it.
inline constexpr double blade_margin = 1.5;

/// The part for is_beside() up to which a node is held in any case, as elements between it and the tool could be no
/// better than flat.
inline constexpr double close_beside = 1e-5;
/// The same where the tool runs along a surface that holds the node, or elements would come out so poor that they were
/// an error.
inline constexpr double along_beside = 0.025;
/// The largest there is: where elements are poor whatever else was tried, in a wedge between the tool and a feature
/// line or surface.
inline constexpr double far_beside = 0.05;

/// A band in which element faces are being made to lie on tools.
struct Workpiece {
    Deformable d;
    const Tool* tool = nullptr;             ///< the first, to which `distance` belongs
    std::vector<double> distance = {};      ///< signed, by band node; exactly 0 for nodes on the tool
    double tolerance = 0;                   ///< what is nearer than this lies on the tool
    std::vector<int> nodes = {};            ///< nodes on the tool (ICN and ECN), ascending
    std::vector<int> transition = {};       ///< nodes within `bandwidth` edges of them (ITN and ETN), ascending
    int bandwidth = 2;                      ///< i of the paper's i-th neighbourhood
    std::vector<CellRef> deep_inside = {};  ///< elements to be removed that are not in the band
    /// What tools have taken, as parts of elements of the mesh: those removed with their measure where they were then,
    /// and what walls of flat faces have left standing (positive) at that moment, or leave in the end (negative).
    std::vector<std::pair<CellRef, double>> taken = {};
    /// Mid-side nodes that straighten_folded() left beside their surfaces, how far off the farthest is, and how far one
    /// is at most in edge lengths there.
    Index straightened = 0;
    double straightened_off = 0, straightened_part = 0;
    std::vector<std::string> warnings = {};
    Laps seconds = {};
    /// Where a new mid-side node between two band nodes belongs, for an operator that knows; else see rebuild().
    std::function<Vec3(int, int)> mid_side = {};
    long most_visits = std::numeric_limits<long>::max();  ///< Deformable::visits from which on nothing more is tried
                                                          ///< for better elements
    double most_elements =
        std::numeric_limits<double>::infinity();  ///< of the band, from which on none is divided for better ones
    std::vector<int> released =
        {};  ///< nodes moved onto the tool that are beyond a bounded crack, and could not be put back
    /// By node of the input, not for all: the part for is_beside() where elements came out poor as the node was not
    /// held beside the tool.
    std::vector<double> may_hold = {};
    std::map<int, double> passed = {};  ///< nodes that were not held, and with which `may_hold` they would be
    double part_to_hold(int node) const {
        return std::max(close_beside, node < static_cast<int>(may_hold.size()) ? may_hold[node] : 0.0);
    }

    /// An element of the input that is folded or strongly curved.
    struct FoldedElement {
        Index id;      ///< number in the mesh
        double ratio;  ///< its curved_ratio() there
        bool mended;   ///< by moving mid-side nodes alone
    };
    /// Folded or strongly curved ones of the input, see folded_input.h; by whether it is a triangle, and slot.
    std::map<std::pair<bool, int>, FoldedElement> folded_input = {};
    /// Of lines that were made edges (imprint.h): by line and stop the node there.
    std::vector<std::vector<int>> at_stop = {};
    /// By such a node: whether a border, feature line or group held it on its surface before it was held at its stop.
    std::map<int, bool> bound_at_stop = {};
    /// Edges between nodes (the smaller first) that are not to be divided for another try: they are where a line is to
    /// have edges.
    std::set<std::pair<int, int>> kept_edges = {};
    std::vector<int> beam_nodes = {};  ///< on the first tool, where it is wanted, that beams end in; ascending
    std::vector<std::pair<int, int>> beam_ends = {};  ///< where beams were cut off: node, and tag of the tool
    bool patched = false;  ///< only the faces in BandMesh::cut_faces (cut_edges) are to be opened

    /// Whether a border, feature line or group holds a node on its surface.
    bool is_bound(int node) const {
        const auto stop = bound_at_stop.find(node);
        return stop != bound_at_stop.end() ? stop->second : d.constraints[node].freedom > NodeFreedom::surface;
    }

    /// Splits the edge a-b at `at` and returns the new node, which lies on `tools`: everything known of nodes holds for
    /// it, too.
    int split_edge(int a, int b, const Vec3& at, const Contact& tools);

    /// Signed distance of a node to a tool, 0 in contact. To the first tool it is that of before the band was relaxed:
    /// the side its elements are on.
    double value(int node, const Tool& t) const {
        if (d.contact[node].has(&t)) return 0;
        return &t == tool ? distance[node] : t.distance(d.band.nodes[node].at);
    }
};

/// Collects `nodes` (all with contact) and `transition` anew.
void find_node_sets(Workpiece& workpiece);

/// What relaxation may move: interface and transition nodes, and released ones; ascending.
std::vector<int> movable_nodes(const Workpiece& workpiece);

/// Relaxes anew around nodes that were born or moved since the last relaxation: those within a few edges, and others as
/// far as that moves them, unless `only_there`. Collects the node sets anew.
void relax_near(Workpiece& workpiece, const std::vector<int>& changed, bool only_there = false);

/// Edges that are to be cut by the blade and whose mid-side node must not move (NodeConstraints::has_fixed_middle())
/// are split in that node, where it is; the blade then crosses one half. So are edges on the blade in whose mid-side
/// node a segment or point ends, which goes on with the new corner. To be called first.
void split_at_fixed_middles(Workpiece& workpiece, const Blade& blade, const Mesh& mesh);

}  // namespace femscalpel
