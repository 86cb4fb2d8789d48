// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "crack_geometry.h"
#include "crack_model.h"
#include "operators/report.h"
#include "random_numbers.h"

/// What must hold for every crack, looked at from the outside: the input mesh, the plane and what came back.
/// Nothing here uses the engine but its data types; every formula is written out again.
namespace femscalpel::checks {

/// Everything that does not hold, one line each, beginning with a keyword; empty when all is well.
std::vector<std::string> check_crack(const Model& model, const CutPlane& plane, const Result& result,
                                     const std::string& name);

/// Whether two meshes are the same to the last bit: numbers, coordinates, connectivity, groups, members, order.
bool identical(const Mesh& a, const Mesh& b);

}  // namespace femscalpel::checks
