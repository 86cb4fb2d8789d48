// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cutting/locate.h"
#include "cutting/opening.h"
#include "cutting/rebuild.h"
#include "cutting/workpiece.h"
#include "deck/mark_deck.h"
#include "deck/rules/remarks.h"
#include "deformation/node_constraints.h"
#include "groups/group_report.h"
#include "mesh/crop.h"
#include "mesh/stopwatch.h"
#include "operators/prepared.h"

namespace femscalpel {

/// How an operator calls what it made.
struct Naming {
    /// Groups of faces, by Opening::Face::group: each face is in all of its list.
    std::vector<std::vector<std::string>> groups;
    std::string front;  ///< of the front: its segments if they form chains, else its nodes; none if empty
    /// Node sets of the report: interface nodes inside and on the outside, transition nodes inside and on the outside.
    std::array<const char*, 4> sets{"ICN", "ECN", "ITN", "ETN"};
};

/// A mesh whose band was worked on.
struct Edited {
    Rebuilt rebuilt;             ///< its mesh still has the hidden groups of mark_deck()
    FamilyTotals before, after;  ///< of the whole mesh
    Remarks deck;                ///< on how the solver's input followed
};

/// What is done to a mesh around the work on its band, whatever that is: the solver's input marked, the output's copy
/// and the measures made meanwhile, the band put back, the solver's input carried over, the measures renewed.
class Edit {
public:
    /// Marks the solver's input of `input`, which must outlive this, as must what is `known` of it.
    Edit(const Mesh& input, const Prepared& known);

    /// What is worked on: the input, with the solver's input marked; after keep_band() the band alone.
    const Mesh& mesh() const { return part_ ? part_->mesh : whole(); }

    /// The same, but never the band alone.
    const Mesh& whole() const { return marks_->mesh ? *marks_->mesh : input_; }

    const Mesh& input() const { return input_; }
    const DeckMarks& marks() const { return *marks_; }

    /// Elements and nodes of mesh() around each node, if known.
    const Adjacency* adjacency() const { return part_ ? nullptr : known_.adjacency; }

    /// Groups that follow surfaces, by index, whose boundary means nothing; empty if none.
    const std::vector<bool>& meaningless() const { return meaningless_; }

    /// What new nodes and elements are numbered from.
    const Numbering& numbering() const { return numbering_; }

    /// Whether only the band is worked on, and the result is that alone.
    bool is_part() const { return part_.has_value(); }

    /// Has the second core make what does not depend on the band: the output's copy, if the result is to be the whole
    /// mesh, and measures that are not known.
    void start_copy(bool whole_result = true);

    /// Goes on with the elements of the band and those `removed` alone; these, and `location`, are given their places
    /// among them.
    void keep_band(Location& location, std::vector<CellRef>& removed);

    /// What the solver's input asks of nodes.
    ConstraintOptions constraints() const;

    /// Puts the band back, makes the groups of `naming`, and carries the solver's input over. Throws as carry_deck()
    /// does. To be called once, after start_copy().
    Edited finish(Workpiece& f, const Opening& opening, const Naming& naming, Stopwatch& watch);

private:
    std::vector<Index> in_part(const std::vector<Index>& nodes) const;

    const Mesh& input_;
    Prepared known_;
    DeckMarks own_marks_;
    const DeckMarks* marks_;
    Numbering numbering_;
    std::vector<bool> meaningless_;
    std::optional<Crop> part_;
    std::future<std::pair<std::unique_ptr<Mesh>, FamilyTotals>> copy_;
};

}  // namespace femscalpel
