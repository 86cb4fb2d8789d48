// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/numbering.h"

#include <algorithm>
#include <string>

#include "mesh/companion.h"

namespace femscalpel {
namespace {

Index one_above(Index largest, const char* what) {
    // More than any mesh needs, and far more than files can hold.
    constexpr Index kept_free = Index{1} << 62;
    if (largest < kept_free) return largest + 1;
    throw ToolError(std::string(what) + " number " + std::to_string(largest) + " leaves no numbers for new " + what +
                    "s, which come above the largest in use: give the " + what + "s of the mesh smaller numbers first");
}

}  // namespace

Numbering next_numbers(const Mesh& mesh) {
    Numbering next{one_above(mesh.largest_node_id(), "node"), one_above(mesh.largest_cell_id(), "element")};
    if (mesh.companion) {
        next.node = std::max(next.node, mesh.companion->largest_other_node() + 1);
        next.cell = std::max(next.cell, mesh.companion->largest_other_element() + 1);
    }
    return next;
}

}  // namespace femscalpel
