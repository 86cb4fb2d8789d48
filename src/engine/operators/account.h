// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "groups/preserve.h"
#include "operators/changed_quality.h"
#include "operators/edit.h"
#include "operators/options.h"
#include "operators/refine_first.h"
#include "operators/report.h"

namespace femscalpel {

/// Moved nodes, boundary drift and losses of each group. Nodes from the number `first_new` on are not the input's and
/// do not count.
void describe_motion(const Workpiece& f, const Mesh& before, Index first_new, const Rebuilt& rebuilt, bool removes,
                     Report& report);

/// Fills the report of an operation that cut along blades, and finds what to warn of: call open(), judge() and close(),
/// in this order.
class Account {
public:
    /// `refined`, if the mesh was refined for the operation: then the report is of both together. `drifting` as
    /// drifting_groups() returns it. All must outlive this.
    Account(const char* kind, const OperatorOptions& options, const Edit& edit, const Refined* refined,
            const std::vector<bool>& drifting);

    /// With the band before anything is done to it.
    void open(const Workpiece& f);

    /// With the band as it was cut, before it is put back. Collects the node sets of `f` anew.
    void judge(Workpiece& f, std::span<const Blade> blades, const Opening& opening);

    /// With the mesh that it became. All but the seconds.
    Report close(const Workpiece& f, std::span<const Blade> blades, const Opening& opening, const Naming& naming,
                 const Edited& edited);

private:
    bool was_refined() const { return refined_ && !refined_->tried_in_vain; }
    void list_node_sets(const Workpiece& f, const Naming& naming, const Rebuilt& rebuilt);
    void count(const Rebuilt& rebuilt);
    std::vector<std::string> deck_warnings(const Edited& edited) const;
    void find_warnings(const Workpiece& f, std::span<const Blade> blades, const Opening& opening, const Edited& edited);
    void join_refinement(const Rebuilt& rebuilt);
    void join_quality(const Rebuilt& rebuilt);
    void describe_drift(const Workpiece& f);

    const OperatorOptions& options_;
    const Edit& edit_;
    const Refined* refined_;
    const std::vector<bool>& drifting_;
    std::optional<DriftGauge> gauge_;      // of drifting groups
    std::optional<DriftGauge> shortcuts_;  // of the others, if they have any
    ChangedQuality quality_;               // of the band
    Report report_;
};

/// Of groups that may drift (drifting_groups()), that their boundary was not kept, and how far it went: `gauge` is of
/// the band before.
void describe_drift(const DriftGauge& gauge, const std::vector<bool>& drifting, const BandMesh& now, const Mesh& before,
                    Report& report);

}  // namespace femscalpel
