// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace femscalpel {

Mesh read_med(const std::filesystem::path& path);
void write_med(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace femscalpel
