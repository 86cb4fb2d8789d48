// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/rebuild.h"
#include "operators/report.h"

namespace femscalpel {

/// Puts the quality of the elements of a band that were changed, and of what they became, into the report; but for
/// triangles on tetrahedra, whose shape is that of these.
void describe_changed(const Mesh& mesh, const Workpiece& f, const Rebuilt& rebuilt, Report& report);

}  // namespace femscalpel
