// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <string>

#include "cutting/workpiece.h"

namespace femscalpel {

/// Why a blade parts no nodes of an element, as a message: it lies inside elements, passes through their curved sides
/// only, between parts of the mesh, through segments only, or beside the whole mesh. `distance`: of each node from its
/// tool; `beyond`: it meets elements, but only where it is not wanted. One pass over the mesh, and some work for the
/// elements a curved tool is near.
std::string why_missed(const Mesh& mesh, const Blade& blade, std::span<const double> distance, double tolerance,
                       bool beyond);

/// Whether a curved blade passes through the inside of elements, beside all their nodes: it parts some of those that
/// refining makes of them.
bool lies_inside_elements(const Mesh& mesh, const Blade& blade);

/// Why nothing comes apart on a blade along which nodes lie, as a message: what lies on it is open already (a contact,
/// an earlier crack), is the outside of the mesh, or is shells on which nothing stands. `otherwise`, when no face nor
/// edge of a shell lies on it.
std::string why_nothing_parts(const Workpiece& workpiece, const Blade& blade, const std::string& otherwise);

/// Whether the elements around a node on the tool, or within it, are larger than the tool, by its radius.
bool is_smaller_than_elements(const Workpiece& workpiece, const Tool& tool);

/// What is said of such a tool that parts nothing.
std::string why_too_small(const Tool& tool);

}  // namespace femscalpel
