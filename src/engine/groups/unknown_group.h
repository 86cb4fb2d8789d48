// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mesh/mesh.h"

namespace femscalpel {

/// Says that a mesh has no group of a name, and which it has that are like it, or which at all: "the mesh has no group
/// 'TPO'. Did you mean 'TOP'?"
std::string no_group_text(const Mesh& mesh, const std::string& name);

}  // namespace femscalpel
