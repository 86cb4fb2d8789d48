// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "deck/rules/remarks.h"
#include "mesh/changes.h"

namespace femscalpel {

/// Remarks on two changes of a mesh, of which nobody sees the one between: in numbers that the input or the result has,
/// and only of what is still so in the result.
///
/// Of the first change, new nodes that the second took away again are not told of. Of the second, neither are nodes
/// that came and went; elements become those of the input that they are parts of, and count as removed when nothing is
/// left of these. Sets are called as the input's deck calls them.
class JoinedRemarks {
public:
    /// `first` and `second` are what was told of the changes, `after` the result, `input` the deck before both.
    JoinedRemarks(Remarks first, const Changes& first_changes, Remarks second, const Changes& second_changes,
                  const Mesh& after, const SolverInput& input);

    const Remarks& first() const { return first_; }
    const Remarks& second() const { return second_; }

private:
    bool keep(Remarks::Place& place);
    void translate_second(bool strip_places);

    Remarks first_, second_;
    std::unordered_set<Index> nodes_, born_;    // of the result; made by the first change
    std::unordered_map<Index, Index> parents_;  // of elements that the first change made
    std::unordered_set<Index> left_;            // elements of the input that have parts in the result
    std::unordered_set<Index> present_;         // elements of the mesh between that have parts in the result
};

}  // namespace femscalpel
