// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cutting/simplify.h"
#include "cutting/workpiece.h"
#include "deck/mark_deck.h"
#include "operators/prepared.h"
#include "operators/refine_first.h"

namespace femscalpel {

/// Rings around elements to be bisected that bisecting may reach.
inline constexpr int rings_to_refine = 2;

/// Whether a mesh has no elements but points, segments, triangles and tetrahedra.
bool has_simplices_alone(const Mesh& mesh);

/// Makes simplices (simplify()) of what else is where an operation will work: in the band around `blades`, and where
/// the mesh would be refined first for `zones`. Nothing, when there is nothing else. `known` is what is known of
/// `mesh`. Throws what locate(), simplify() and carry_deck() do.
std::optional<Refined> simplify_first(const Mesh& mesh, std::span<const Blade> blades,
                                      std::span<const RefineZone> zones, const OperatorOptions& options,
                                      const Prepared& known);

/// The same for what is around nodes with level >= 0.
std::optional<Refined> simplify_first(const Mesh& mesh, const std::vector<std::int8_t>& level, const Prepared& known);

/// The same for what a refinement would have to bisect. Nothing where that is simplices alone.
std::optional<Refined> simplify_first(const Mesh& mesh, const DistanceField& distance, const BisectionOptions& options,
                                      const Prepared& known);

/// What became of some elements of `mesh`, or of its copy with marks, with the solver's input carried over.
Refined with_parts(const Mesh& mesh, Simplified parts, const DeckMarks& marks, const Prepared& known);

/// Whether a warning of a conversion says that first-order tetrahedra are stiff.
bool is_about_stiffness(const std::string& warning);

/// Makes one of such warnings, which several conversions gave.
void join_warnings_about_stiffness(std::vector<std::string>& warnings);

/// Makes the report of what was done to what a conversion made one of both.
void add_conversion(const Refined& converted, bool strict, Report& report);

/// A conversion and then a refinement of what it made, as one change.
Refined joined(const Refined& converted, Refined refined, bool strict);

}  // namespace femscalpel
