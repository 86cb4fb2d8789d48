// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deformation/relaxation.h"
#include "operators/report.h"

namespace femscalpel {

/// How element faces are brought onto the tool (DESIGN 3, step 2).
enum class Method {
    snap,    ///< move near nodes onto the tool, split what still crosses; succeeds on any sound mesh
    deform,  ///< the paper's 3.1.1: classify, then only move nodes; may end in QualityError
};

/// Method of that name ("snap" or "deform"); throws ToolError otherwise.
Method method_from_name(const std::string& name);
std::string_view to_string(Method method);

/// A band in which element faces are being made to lie on a tool.
struct Interface {
    Deformable d;
    std::vector<double> distance;    ///< signed, by band node; exactly 0 for nodes on the tool
    double tolerance = 0;            ///< nodes nearer than this lie on the tool
    std::vector<int> nodes;          ///< nodes on the tool (ICN and ECN), ascending
    std::vector<int> transition;     ///< nodes within `bandwidth` edges of them (ITN and ETN), ascending
    int bandwidth = 2;               ///< i of the paper's i-th neighbourhood
    std::vector<std::string> warnings;
    std::vector<std::pair<std::string, double>> seconds;
};

/// DESIGN's `snap`: nodes near the tool are moved onto it along their constraints, nearest first; edges
/// that still cross are bisected on it, longest first; then the band is relaxed.
void snap_to_tool(Interface& interface, const Tool& tool);

/// Collects `nodes` (all with contact) and `transition` anew.
void find_node_sets(Interface& interface);

/// The paper's 3.1.1: classifies tetrahedra (triangles) by half-space, splits those with two interface
/// faces (Figure 4), hands over those with more, then moves the interface nodes onto the tool. Throws
/// QualityError naming the elements in the way when no node move can do it.
void deform_to_tool(Interface& interface, const Tool& tool, const Mesh& mesh);

/// Throws QualityError that names the elements when the input itself has inverted ones in the band; counts
/// poor ones (mean ratio below 0.1) as a warning.
void check_input_shape(Interface& interface, const Mesh& mesh);

/// Throws QualityError that names the elements when one of the band is flat or inverted.
void check_shape(const Interface& interface, const Mesh& mesh);

}  // namespace femscalpel
