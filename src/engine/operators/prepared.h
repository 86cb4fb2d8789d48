// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace femscalpel {

class Adjacency;
struct FamilyTotals;
struct DeckMarks;

/// What is known of a mesh: what a session keeps, all of which can be made anew at a cost linear in the mesh.
struct Prepared {
    const Adjacency* adjacency = nullptr;
    const FamilyTotals* totals = nullptr;  ///< of the marked mesh, if `marks` have one
    const DeckMarks* marks = nullptr;
};

}  // namespace femscalpel
