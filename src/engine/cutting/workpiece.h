// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deformation/deformable.h"
#include "mesh/stopwatch.h"

namespace femscalpel {

/// How element faces are brought onto the tool (DESIGN 3, step 2).
enum class Method {
    snap,    ///< move near nodes onto the tool, split what still crosses; succeeds on any sound mesh
    deform,  ///< the paper's: choose element faces near the tool, then move their nodes; may end in QualityError
};

/// Method of that name ("snap" or "deform"); throws ToolError otherwise.
Method method_from_name(const std::string& name);
std::string_view to_string(Method method);

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
/// The largest there is: where the tool runs along a surface that holds the node, or elements would come out so poor
/// that they were an error.
inline constexpr double along_beside = 0.025;

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

    struct FoldedElement {
        Index id;      ///< number in the mesh
        double ratio;  ///< its curved_ratio() there
        bool mended;   ///< by moving mid-side nodes alone
    };
    /// Folded or strongly curved ones of the input, see folded_input.h; by whether it is a triangle, and slot.
    std::map<std::pair<bool, int>, FoldedElement> folded_input = {};
    bool patched = false;  ///< only the faces in BandMesh::cut_faces (cut_edges) are to be opened

    /// Signed distance of a node to a tool, 0 in contact. To the first tool it is that of before the band was relaxed:
    /// the side its elements are on.
    double value(int node, const Tool& t) const {
        if (d.contact[node].has(&t)) return 0;
        return &t == tool ? distance[node] : t.distance(d.band.nodes[node].at);
    }
};

/// Makes element faces (edges of shells) lie on a blade, where it is wanted: nodes near it are moved onto it along
/// their constraints, nearest first; edges that still cross are bisected on it, longest first. Elements are not
/// relaxed.
void cut_along(Workpiece& workpiece, const Blade& blade);

/// Puts a node in contact with a tool that it lies on but for the rounding of coordinates. Where something holds it (a
/// border, a corner, a card of the deck) it leaves that by as much as rounding allows.
void put_on_tool(Workpiece& workpiece, int node, const Tool& tool);

/// Whether a node is so near a tool, `distance` away, that no element should come to lie between them: then it is on
/// the tool, held beside it where it cannot be moved there (Deformable::hold_beside()). `reach`: how far the elements
/// around it reach to the tool's other side; up to the part `part` of that it is.
inline bool is_beside(double distance, double reach, double part) { return std::abs(distance) <= part * reach; }

/// Collects the node sets, then improves the shape of the band's elements: deform(), improve(), and new nodes brought
/// onto their curved surfaces.
void relax_band(Workpiece& workpiece);

/// Runs `cut`, which has to leave `workpiece` relaxed, and looks at what came out: where new nodes could not be brought
/// onto the skin or line they were born on and their tools, or second-order elements came out folded, it starts again
/// with other choices there: nodes not put on the tool, then elements refined before the cut; `attempts` times at most,
/// and within bounds on the band's growth, also against the mesh's `mesh_elements`, and on the work of all tries. Poor
/// elements are a reason, too: first to hold nodes beside the tool that it passes closely, then, but for a whole plane
/// through flat surfaces (`whole_tool`), to refine.
///
/// Throws QualityError naming the place when nothing helps.
void cut_soundly(Workpiece& workpiece, const std::function<void(Workpiece&)>& cut, Index mesh_elements,
                 int attempts = 12, bool whole_tool = false);

/// DESIGN's `snap`: nodes near the tool are moved onto it along their constraints, nearest first; edges
/// that still cross are bisected on it, longest first; then the band is relaxed.
void snap_to_tool(Workpiece& workpiece, const Blade& blade, Index mesh_elements);

/// Collects `nodes` (all with contact) and `transition` anew.
void find_node_sets(Workpiece& workpiece);

/// What relaxation may move: interface and transition nodes, and released ones; ascending.
std::vector<int> movable_nodes(const Workpiece& workpiece);

/// Relaxes anew around nodes that were born or moved since the last relaxation: those within a few edges, and others as
/// far as that moves them, unless `only_there`. Collects the node sets anew.
void relax_near(Workpiece& workpiece, const std::vector<int>& changed, bool only_there = false);

/// The paper's 3.1.1 and 3.1.2: finds a surface of element faces (edges, for shells) near the tool between a
/// set T1 and a set T2 of elements, then moves its nodes, the interface nodes (CI), onto the tool.
///
/// T1 and T2 are the half-spaces', except that nodes near the tool may join either side: of all surfaces
/// the one whose nodes have least to move is taken (a least vertex cut), which also does the paper's
/// handing over of elements with three interface faces. Nodes that would be in the way (two on one crease,
/// say) are made dearer and the cut is repeated.
///
/// The only nodes added are Figure 4's, on its condition in full: each edge that joins two interface nodes
/// but is in no interface face would come to lie in the tool and flatten what is between, so it is split in
/// the middle. The interface nodes are put on the tool, the bar network carries the transition nodes along,
/// and elements turned over by that are untangled before all are relaxed. When elements remain bad,
/// the nodes around them are made dearer and another surface is tried, a few times.
///
/// No element comes out inverted or nearly flat, and no node on the wrong side of the tool. Throws
/// QualityError naming the elements in the way when no surface tried can be moved there.
void deform_to_tool(Workpiece& workpiece, const Tool& tool, const Mesh& mesh);

/// Edges that are to be cut by the blade and whose mid-side node must not move (NodeConstraints::has_fixed_middle())
/// are split in that node, where it is; the blade then crosses one half. To be called first.
void split_at_fixed_middles(Workpiece& workpiece, const Blade& blade, const Mesh& mesh);

/// Throws QualityError that names the elements when the input itself has inverted ones in the band, or second-order
/// ones that are folded where solvers integrate; counts poor ones (mean ratio below 0.1) as a warning. Elements that
/// are folded at a corner only are mended, see folded_input.h.
void check_input_shape(Workpiece& workpiece, const Mesh& mesh);

/// With the shape of the skin given: throws ToolError when no face of the skin in the band lies on it, counts those
/// that do not as a warning.
void check_skin(Workpiece& workpiece);

/// Throws QualityError that names the elements when one of the band is flat or inverted.
void check_shape(const Workpiece& workpiece, const Mesh& mesh);

/// Throws QualityError when a node in contact with a tool is off it by more than 1e-9 of the mesh's size.
void check_contacts(const Workpiece& workpiece);

}  // namespace femscalpel
