// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cutting/unweld.h"
#include "cutting/weld.h"
#include "cutting/workpiece.h"
#include "deck/mark_deck.h"
#include "mesh/changes.h"
#include "operators/prepared.h"
#include "operators/report.h"

namespace femscalpel {

/// Double nodes made single for the time of an operation, so that both sides of a contact, an earlier crack or
/// coincident shells do the same (weld(), unweld()).
class WeldFirst {
public:
    /// Welds a copy of `input`, which must outlive this, as must what is `known` of it.
    WeldFirst(const Mesh& input, const Prepared& known);

    /// Whether there is anything to weld.
    explicit operator bool() const { return welded_.has_value(); }

    /// Whether any of it is so near these surfaces that an operation along them could reach it.
    bool is_near(std::span<const Blade> blades) const;

    const Mesh& mesh() const { return welded_->mesh; }

    /// The group of mesh() that holds the faces which were made single.
    GroupIndex faces() const { return welded_->faces; }

    /// What an operation on mesh() is to know; see Prepared.
    Prepared known();

    /// What an operation did to mesh(), step by step.
    std::vector<Changes>& stages() { return stages_; }

    /// Takes the nodes of what an operation made of mesh() apart again, carries the solver's input over, and brings the
    /// report up to date. `strict`: see warnings_of(). False, and the result is of no use, when a crack opened but what
    /// was open before, or what was open could not be again.
    bool finish(Result& result, bool strict);

private:
    const Mesh& marked() const { return marks_->mesh ? *marks_->mesh : input_; }
    void find_marks();
    std::vector<char> free_together() const;
    void pin_fronts();
    void carry(Mesh& mesh, const Changes& changes, bool strict, Report& report) const;
    void report_segments(const Mesh& mesh, const Unwelded& unwelded, Report& report) const;
    void report_pairs(const Mesh& mesh, const Unwelded& unwelded, Index doubled, Report& report) const;

    const Mesh& input_;
    DeckMarks own_marks_;
    const DeckMarks* marks_;
    std::vector<Changes>* outer_stages_;  // where what was done to the input goes
    std::optional<Welded> welded_;
    DeckMarks on_welded_;   // what the deck asks of the welded mesh
    DeckMarks on_changed_;  // of that refined or converted
    std::vector<Changes> stages_;
    double seconds_ = 0;  // that welding took
};

}  // namespace femscalpel
