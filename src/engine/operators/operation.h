// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "cutting/locate.h"
#include "cutting/opening.h"
#include "cutting/rebuild.h"
#include "cutting/workpiece.h"
#include "deck/mark_deck.h"
#include "groups/group_report.h"
#include "groups/preserve.h"
#include "mesh/crop.h"
#include "mesh/stopwatch.h"
#include "operators/options.h"
#include "operators/report.h"

namespace femscalpel {

struct Refined;

/// What is known of a mesh: what a session keeps, all of which can be made anew at a cost linear in the mesh; and that
/// it was refined for the operation.
struct Prepared {
    const Adjacency* adjacency = nullptr;
    const FamilyTotals* totals = nullptr;  ///< of the marked mesh, if `marks` have one
    const DeckMarks* marks = nullptr;
    const Refined* refined = nullptr;  ///< then the report is of refinement and operation together
};

/// How an operator calls what it made.
struct Naming {
    std::vector<std::vector<std::string>>
        groups;         ///< of faces, by Opening::Face::group: each face is in all of its list
    std::string front;  ///< of the front: its segments if they form chains, else its nodes
    /// Node sets of the report: interface nodes inside and on the outside, transition nodes inside and on the outside.
    std::array<const char*, 4> sets{"ICN", "ECN", "ITN", "ETN"};
};

/// The steps that all operators share (DESIGN 3): locating, constraints, and, when the operator has done its own,
/// putting the band back, carrying the solver's input over, and the report.
class Operation {
public:
    /// Checks the options; `suffixes` are those of the groups the operator makes, `started` is when it was called.
    /// Throws ToolError.
    Operation(const char* kind, const Mesh& input, const OperatorOptions& options, const Prepared& prepared,
              const std::vector<std::string>& suffixes, Stopwatch::Time started);

    /// What is worked on: the input, with the solver's input marked; of it, if asked for and after begin(), the band
    /// alone.
    const Mesh& mesh() const { return part_ ? part_->mesh : whole(); }

    /// The same, but never the band alone.
    const Mesh& whole() const { return marks_->mesh ? *marks_->mesh : input_; }

    /// Picks elements with no node in the band (level < 0) that the operator removes.
    using PickRemoved = std::function<std::vector<CellRef>(const Mesh& mesh, const std::vector<std::int8_t>& level)>;

    /// Finds the band of `blades` and what its nodes have to keep to. Nodes on the first blade, where it is
    /// unbounded, are in contact with it. Throws as locate(), extract_band() and check_input_shape() do.
    Workpiece begin(std::span<const Blade> blades, const PickRemoved& pick_removed = {});

    /// Where the blades meet the mesh; known after begin().
    const Location& location() const { return location_; }

    /// The steps that an operator has timed itself since begin(); what they leave of the time is that of checks and
    /// further attempts.
    void take_laps(const Laps& laps) { watch_.lap("check", laps); }

    Result finish(Workpiece& f, const Opening& opening, const Naming& naming);

private:
    void join_refinement(const Rebuilt& rebuilt);
    void crop_to_band(std::vector<CellRef>& removed);
    std::vector<Index> in_part(const std::vector<Index>& nodes) const;

    const Mesh& input_;
    const OperatorOptions& options_;
    Prepared prepared_;
    Report report_;
    Laps seconds_;
    Stopwatch watch_;
    DeckMarks own_marks_;
    const DeckMarks* marks_;
    Numbering numbering_;
    std::optional<Crop> part_;
    std::vector<Blade> blades_;
    Location location_;
    std::vector<bool> meaningless_;        // groups of DeckMarks::surface_sets, by index; empty if none
    std::vector<bool> drifting_;           // groups, by index; empty if none
    std::optional<DriftGauge> gauge_;      // of them
    std::optional<DriftGauge> shortcuts_;  // of the others, if they have any
    std::future<std::pair<std::unique_ptr<Mesh>, FamilyTotals>> copy_;
};

}  // namespace femscalpel
