// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "fracture/front.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// The fronts of a crack and what lies around them.
struct CrackLips {
    /// One front.
    struct Line {
        CrackFront front;
        std::vector<Index> nodes;  ///< in its order; the first not again at the end of a closed one
    };
    std::vector<Line> lines;
    std::vector<char> positive, negative;  ///< by node: whether it is on the lip
    double edge = 0;                       ///< mean length of the edges of elements at the front
};

/// NAME of NAME_FRONT; throws Error where the group is called otherwise.
std::string crack_name(const std::string& front);

/// Those of the crack whose front is the group `front`. Throws Error that names what is missing.
CrackLips crack_lips(const Mesh& mesh, const std::string& front);

}  // namespace femscalpel
