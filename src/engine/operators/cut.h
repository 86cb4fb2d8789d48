// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"
#include "tools/plane.h"

namespace femscalpel {

/// What the user of cut() can choose.
struct CutOptions : OperatorOptions {
    CutOptions() { name = "CUT"; }  // new groups: NAME_P, NAME_N, NAME_BOTTOM

    /// Where the cut ends: it stays on the negative side of this tool, whose surface becomes its bottom (a plane, or
    /// the cylinder of a circular saw). The cut goes through the whole part when null.
    const Tool* bottom = nullptr;
};

/// Cuts a slot (the paper's incision, 3.3): takes out what lies on the negative side of both `positive` and `negative`,
/// so that their normals point into the material that stays, with everything only the removed elements carried.
/// Two planes that are not parallel make a notch. The input is not changed.
///
/// New groups: NAME_P and NAME_N, the walls on `positive` and `negative` (triangles of a volume mesh, normals out of
/// the material; segments of a shell mesh), NAME_BOTTOM. Throws as drill() does.
Result cut(const Mesh& mesh, const Tool& positive, const Tool& negative, const CutOptions& options = {},
           const Prepared& prepared = {});

/// A slot of `width` between two planes parallel to `plane`, which runs in the middle; NAME_P is on its positive side.
Result cut(const Mesh& mesh, const Plane& plane, double width, const CutOptions& options = {},
           const Prepared& prepared = {});

}  // namespace femscalpel
