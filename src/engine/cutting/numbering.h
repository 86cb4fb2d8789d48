// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mesh/mesh.h"

namespace femscalpel {

/// The numbers that new nodes and elements get, in order from these on.
struct Numbering {
    Index node = 1;
    Index cell = 1;
};

/// Those above the largest in use, also by elements outside the mesh that the solver's input has. Throws ToolError when
/// that is too large.
Numbering next_numbers(const Mesh& mesh);

}  // namespace femscalpel
