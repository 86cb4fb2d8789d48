// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string_view>

#include "mesh/mesh.h"

namespace femscalpel {

/// Name of the hidden group of segments that are beams, though they lie on edges of other elements: without it, and
/// under no *ELEMENT card, a solver's input takes those for edges of these (write_inp()).
inline constexpr std::string_view edge_beams_group = "beams on edges";

/// Puts all segments of the element group `of` into that group.
void mark_edge_beams(Mesh& mesh, GroupIndex of);

/// Puts all segments of a mesh into that group: those of a format whose segments are beams and bars.
void mark_edge_beams(Mesh& mesh);

}  // namespace femscalpel
