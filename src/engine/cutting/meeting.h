// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include "cutting/meeting_lines.h"

namespace femscalpel {

/// What find_meeting() returns.
struct Meeting {
    std::vector<MeetingLine> lines;
    double tolerance = 0;  ///< the largest that there was
    bool facets = false;   ///< whether curved faces of solids lie on each other, as facets that need not be the same
};

/// Where the surfaces of two meshes meet: where they cross, and where the border of one is on the other. A border is so
/// where it is no farther off than `tolerance`, or, if not given, a tenth of the shorter mean edge length there, or as
/// far as a curved surface may be off its faces; its points are then on the other's surface, or border if that is as
/// near, the first mesh's nodes where they are.
Meeting find_meeting(const Mesh& a, const Mesh& b, std::optional<double> tolerance);

}  // namespace femscalpel
