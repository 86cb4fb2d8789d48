// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cutting/rebuild.h"
#include "deck/solver_input.h"
#include "operators/options.h"
#include "operators/refine.h"
#include "tools/patch.h"

namespace femscalpel {

/// Where a mesh is to be refined before an operation, and the longest edge wanted there.
struct RefineZone {
    DistanceField distance;
    double size;
};

/// A mesh refined for an operation, or some of whose elements were converted, and what that changed.
struct Refined {
    Mesh mesh;
    Report report;                      ///< of refinement and conversion
    std::optional<Refinement> summary;  ///< if it was refined
    Numbering numbering;                ///< nodes and elements from these numbers on are not the input's
    const SolverInput* deck = nullptr;  ///< of the mesh as it was, if it has one
    Trace trace;
    double seconds = 0;          ///< of the call so far, but for converting
    double converting = 0;       ///< seconds
    bool tried_in_vain = false;  ///< `report` has but a warning that says why, and `mesh` is empty
};

/// The zone around a tool's surface where it cuts, that is where `beyond` (if any) is not positive: as the options say,
/// or by default half the tool's smallest radius of curvature. None around planes and other tools without a size,
/// unless one is given.
std::optional<RefineZone> zone_around(const Tool& tool, std::function<double(const Vec3&)> beyond,
                                      const RefineFirst& refine);

/// The zone for a crack within a part of a tool: by default the whole part, so that it is at least four edges across;
/// around the front when a size is given.
std::optional<RefineZone> zone_around(const Tool& tool, const Patch& patch, const RefineFirst& refine);

/// Level 0 at the corners of elements that refine_first() would bisect, -1 elsewhere.
std::vector<std::int8_t> levels_to_refine(const Mesh& mesh, std::span<const RefineZone> zones,
                                          const OperatorOptions& options);

/// Refines a mesh (refine()) where an operation's tools are finer than it (the paper's conclusion: "a mesh
/// pre-refinement step is necessary"). Nothing, when they are not. By default an operation goes on with the mesh as it
/// is where elements that cannot be bisected are in the way or the number of elements would pass all reason, with a
/// warning; with a size given these are errors.
std::optional<Refined> refine_first(const Mesh& mesh, std::span<const RefineZone> zones,
                                    const OperatorOptions& options);

}  // namespace femscalpel
