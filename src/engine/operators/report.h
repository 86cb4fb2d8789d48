// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fields/carry.h"
#include "groups/group_report.h"
#include "mesh/changes.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Number of bars in a quality histogram; bar k counts mean ratios in [k, k+1) / bars.
inline constexpr int quality_bars = 20;

/// An element and its mean ratio.
struct ElementQuality {
    Index id = 0;
    double mean_ratio = 0;
};

/// Shape quality of a set of elements (mean ratio, corner nodes; 1 is equilateral, 0 degenerate).
struct QualitySummary {
    Index count = 0;
    double minimum = 1;
    double mean = 1;
    std::array<Index, quality_bars> histogram{};
    std::vector<ElementQuality> worst;  ///< at most ten, worst first
};

/// Summary of the given elements.
QualitySummary summarise(std::vector<ElementQuality> qualities);

/// A refinement that came first, because a tool was finer than the mesh or a size was given (refine_first.h).
struct Refinement {
    double size = 0;            ///< longest edge wanted near the tool; of several sizes the smallest
    Index elements_before = 0;  ///< of the whole mesh, all kinds
    Index elements_after = 0;   ///< by refining alone
};

/// Nodes that something holds a little beside the tool: it goes through them where they are, or ends there.
struct HeldNodes {
    Index count = 0;
    double largest = 0;                 ///< how far they are off the tool, in the mesh's unit
    std::vector<std::string> groups;    ///< whose boundary holds them
    std::vector<std::string> features;  ///< what else does: "the skin", "a corner", ...
};

/// Mid-side nodes left in the middle of straight edges beside the surface, curve or curved tool they belong to, as no
/// sound curved element found room there.
struct StraightenedEdges {
    Index count = 0;     ///< of nodes
    double largest = 0;  ///< how far they are off it, in the mesh's unit
};

/// A place where elements came out poor (find_poor_places()), as what is kept there and the tool leave no room for
/// better ones.
struct PoorPlace {
    std::vector<Index> elements;        ///< numbers of the input's elements that they are parts of, worst first
    double mean_ratio = 0;              ///< of the worst
    Vec3 place = Vec3::Zero();          ///< its middle
    std::vector<std::string> groups;    ///< whose boundary is kept there
    std::vector<std::string> features;  ///< what else is: "the skin", "a feature line", ...
    double gap = 0;   ///< between the tool and what is kept, at the worst: the tool moved by so much goes through it
    double room = 0;  ///< how large that would have to be for good elements
};

/// What an operator did; the same for all operators.
struct Report {
    std::string operation;  ///< "crack", "drill", ...
    std::string name;       ///< prefix of the groups it made
    std::string method;     ///< "snap" or "deform"
    int transition = 0;     ///< i of the i-th neighbourhood that was allowed to move
    /// Node numbers by the paper's names: ICN, ECN (interface), ITN, ETN (transition). Of mid-side nodes those that
    /// moved, in the set of their edge: interface if it lies on the tool, else transition.
    std::map<std::string, std::vector<Index>> node_sets;
    /// Number of nodes by constraint, in the paper's terms: the tool's kind ("plane"), "tangent plane" (on
    /// the skin or a shell), of these "line" (on a feature line or border line: two surfaces) and "fixed";
    /// "group boundary" (on a border inside the material); "free" (none of these). A node can count twice.
    std::map<std::string, Index> constraints;
    /// Of the elements near the tool, and those divided or converted first, before; and of what became of them.
    QualitySummary quality_before, quality_after;
    std::vector<GroupRecord> groups;
    std::vector<FieldRecord> fields;  ///< of a mesh with fields, one for each support
    HeldNodes held;
    StraightenedEdges straightened;
    std::vector<PoorPlace> poor;           ///< empty when all is well
    std::optional<Refinement> refinement;  ///< part of what the counts below say
    Index welded_pairs = 0;                ///< of double nodes that stayed pairs: each side did as the other
    /// Elements that became triangles, tetrahedra and pyramids first, by the names of their types.
    std::map<std::string, Index> converted;
    Index beams_cut = 0;      ///< places where a tool passes through a beam: a segment that is no edge of others
    Index nodes_added = 0;    ///< by splitting and by doubling
    Index nodes_split = 0;    ///< of them, born on split edges
    Index nodes_doubled = 0;  ///< of them, copies of interface nodes
    Index nodes_moved = 0;
    Index nodes_removed = 0;
    Index elements_added = 0;
    Index elements_removed = 0;
    double max_displacement = 0;
    std::vector<std::pair<std::string, double>> seconds;  ///< by step, in order
    std::vector<std::string> warnings;
};

/// Calls visit(index, record) for each group of the input `before` that is not hidden: their records come first, in
/// order.
void for_each_record(const Mesh& before, Report& report, auto visit) {
    std::size_t record = 0;
    for (std::size_t g = 0; g < before.groups.size(); ++g)
        if (!before.groups[g].hidden) visit(g, report.groups[record++]);
}

/// A new mesh and what was done to get it.
struct Result {
    Mesh mesh;
    Report report;
    std::vector<Changes> stages = {};  ///< what became of nodes and elements, step by step, where that is known
};

}  // namespace femscalpel
