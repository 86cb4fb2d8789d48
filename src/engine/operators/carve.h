// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"
#include "tools/tool.h"

namespace femscalpel {

/// Material to be taken away: what lies on the negative side of all its tools.
struct Body {
    /// A tool and the suffixes of the groups that its wall faces go to.
    struct Wall {
        const Tool* tool;
        std::vector<std::string> suffixes;
    };
    std::vector<Wall> walls;
    std::optional<double> width = {};  ///< of a slot, if its user gave one

    /// Not positive inside; outside about the distance.
    double depth(const Vec3& x) const;
};

/// What drill() and cut() have in common (paper, 3.2 and 3.3): makes element faces lie on the bodies' surfaces, takes
/// out the elements inside, with everything only they carried, and brings what is left into shape. Faces that become
/// surface go to groups. `sets`: as in Naming.
///
/// Throws ToolError when nothing or everything would be removed, and what crack() throws.
Result carve(const char* kind, const Mesh& mesh, std::span<const Body> bodies, const OperatorOptions& options,
             const std::array<const char*, 4>& sets, const Prepared& prepared);

}  // namespace femscalpel
