// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Where two meshes touch: faces of solids, sides of shells, and edges of shells that stand on the other. Elements may
/// be of any type.
struct TouchingFaces {
    std::array<std::vector<Facet>, 2> facets;  ///< of each mesh, ascending; without families
    std::array<double, 2> size{};              ///< mean edge length of the faces they are on
    std::array<bool, 2> edges{};               ///< whether there are edges of shells among them
    double gap = 0;                            ///< the largest distance between the two there
    double tolerance = 0;                      ///< the largest that there was
};

/// Finds them: what is no farther from the other, along its normal, than `tolerance`, or, if not given, a tenth of the
/// shorter mean edge length there, or as far as curved surfaces may be off their faces. Where an edge of each stands on
/// the other, as in an L, it is the second mesh's. Empty where nothing touches.
///
/// Throws ToolError (parameter other) that names the place where the two overlap or cross by more than that.
TouchingFaces touching_faces(const Mesh& a, const Mesh& b, std::optional<double> tolerance);

}  // namespace femscalpel
