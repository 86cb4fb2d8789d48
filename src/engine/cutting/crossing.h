// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <span>

#include "mesh/mesh.h"

namespace femscalpel {

/// A tetrahedron (or a triangle that is not in one plane with the part, or overlaps with it there) that one of these
/// faces, or edges (third node -1), passes through with which it has no node in common; the first in the mesh's order.
/// What merely touches, such as the other side of a contact, does not count. Second-order elements count as straight.
std::optional<CellRef> crossed_element(const Mesh& mesh, std::span<const std::array<Index, 3>> parts);

}  // namespace femscalpel
