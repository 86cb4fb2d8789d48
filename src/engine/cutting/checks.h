// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "cutting/workpiece.h"

namespace femscalpel {

/// Throws QualityError when the mesh is so small, so large or so far from the origin for its size that numbers in
/// double precision cannot tell its elements from flat ones.
void check_extent(const Mesh& mesh);

/// Throws QualityError that names the elements when the input itself has inverted ones in the band, or second-order
/// ones that are folded where solvers integrate; counts poor ones (mean ratio below 0.1) as a warning. Elements that
/// are folded at a corner only are mended, see folded_input.h.
void check_input_shape(Workpiece& workpiece, const Mesh& mesh);

/// A place in the box where a mesh has two nodes, as crack lips and contacts do: the nearest to `near`.
std::optional<Vec3> double_nodes(const Mesh& mesh, const Eigen::AlignedBox3d& box, const Vec3& near);

/// With the shape of the skin given: throws ToolError when no face of the skin in the band lies on it, counts those
/// that do not as a warning.
void check_skin(Workpiece& workpiece);

/// Throws QualityError that names the elements when one of the band is flat or inverted.
void check_shape(const Workpiece& workpiece, const Mesh& mesh);

/// Throws QualityError when a node in contact with a tool is off it by more than 1e-9 of the mesh's size.
void check_contacts(const Workpiece& workpiece);

}  // namespace femscalpel
