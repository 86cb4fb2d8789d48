// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace femscalpel {

void write_vtu(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace femscalpel
