// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mesh/mesh.h"
#include "operators/report.h"

namespace femscalpel {

/// Warns of what sections a deck needs for the elements of the group `added`, unless all of them joined groups that the
/// mesh had.
void warn_of_sections(const Mesh& mesh, const Mesh& result, const std::string& added, Report& report);

}  // namespace femscalpel
