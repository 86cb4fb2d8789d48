// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads a mesh; the format follows the extension, case ignored, see formats.h.
/// Throws ReadError that names the file and, for text, the line.
Mesh read(const std::filesystem::path& path);

/// Writes a mesh; the format follows the extension, case ignored, see formats.h.
/// A temporary file beside `path` is renamed when complete, so `path` is whole or untouched.
/// Throws WriteError.
void write(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace femscalpel
