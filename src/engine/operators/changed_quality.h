// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/rebuild.h"
#include "operators/report.h"

namespace femscalpel {

/// Shapes of elements that were changed, and of what they became.
struct ChangedQuality {
    std::vector<ElementQuality> before, after;
};

/// Those of a band; but for triangles on tetrahedra, whose shape is that of these.
ChangedQuality changed_quality(const Mesh& mesh, const Workpiece& f, const Rebuilt& rebuilt);

/// Those of the elements `before` of a mesh, which became `after` of another; but for triangles and quadrangles whose
/// corners solids have, and with which they go.
ChangedQuality changed_quality(const Mesh& mesh, const std::vector<CellRef>& before, const Mesh& result,
                               const std::vector<CellRef>& after);

/// Puts the quality of the elements of a band that were changed, and of what they became, into the report; but for
/// triangles on tetrahedra, whose shape is that of these.
void describe_changed(const Mesh& mesh, const Workpiece& f, const Rebuilt& rebuilt, Report& report);

}  // namespace femscalpel
