// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"
#include "operators/report.h"

namespace femscalpel {

/// The mean ratio below which no element leaves an operator without a word: 0.02, or a tenth of the input's worst there
/// if that is less.
double poor_limit(double worst_before);

/// The poorest element with two dimensions or more (in a mesh of solids, three) that has one of some nodes.
struct PoorestElement {
    Index id = -1;  ///< its number; -1: there is none
    double mean_ratio = 1;
    Vec3 place = Vec3::Zero();  ///< its middle
};

/// The one that is, of a mesh; nodes by index.
PoorestElement poorest_at(const Mesh& mesh, const std::vector<Index>& nodes);

/// A last look at what an operator made, where nothing tells what holds its nodes: throws QualityError that names the
/// `poorest` element and its place if it is below poor_limit() and worse than what the report's `poor` places say.
/// `advice`: the end of the message, what to do.
void check_poorest(const PoorestElement& poorest, double worst_before, const std::vector<PoorPlace>& said,
                   const std::string& advice, const char* parameter);

/// Nodes that count as on the tool though something holds them a little beside it (Deformable::hold_beside()); with a
/// warning in the interface that names what does.
HeldNodes find_held_nodes(Workpiece& workpiece, const Mesh& mesh);

/// No poor result in silence: finds the elements that came out worse than a mean ratio of 0.02, and than a tenth of the
/// `worst_before` of the input's near the tool. Where kept surfaces, lines or nodes and the tool leave no room for
/// better ones they are returned, one entry for each combination of what holds them, worst first, with a warning in the
/// interface that says what would help.
///
/// Throws QualityError naming the place when nothing holds an element that is so poor.
std::vector<PoorPlace> find_poor_places(Workpiece& workpiece, const Mesh& mesh, double worst_before);

}  // namespace femscalpel
