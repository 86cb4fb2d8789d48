// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>

#include "cutting/meeting_lines.h"
#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/refine_first.h"

namespace femscalpel {

/// Makes simplices (simplify()) of what else of a mesh is where another meets it: around the lines; of solids, too,
/// what has a face that the other may cover or, where the mesh `gives_way`, what is near it or in it. Nothing, when
/// there is nothing else. `known` is what is known of `mesh`. Throws as simplify_first() does.
std::optional<Refined> simplify_at_meeting(const Mesh& mesh, const Mesh& other, std::span<const MeetingLine> lines,
                                           bool gives_way, const OperatorOptions& options, const Prepared& known);

}  // namespace femscalpel
