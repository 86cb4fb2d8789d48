// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace femscalpel {

class Adjacency;
class Mesh;
struct Changes;
struct FamilyTotals;
struct DeckMarks;

/// What is known of a mesh: what a session keeps, all of which can be made anew at a cost linear in the mesh.
struct Prepared {
    const Adjacency* adjacency = nullptr;
    const FamilyTotals* totals = nullptr;  ///< of the marked mesh, if `marks` have one
    const DeckMarks* marks = nullptr;
    /// Numbers of nodes in which an operation's tools cut beams: where these were divided, and BeamCuts::stops.
    std::vector<std::int64_t> beam_stops = {};
    /// Where an operation adds what it changed, step by step, for a caller who carries the solver's input over himself
    /// and takes the hidden groups away.
    std::vector<Changes>* stages = nullptr;
    /// What is known of the mesh refined or converted, where that is not to be found from itself.
    std::function<Prepared(const Mesh&)> renewed = {};
};

}  // namespace femscalpel
