// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads a mesh; the format follows the extension, case ignored, see formats.h. Of a file of several, `mesh` names the
/// one; the first if empty.
/// Throws ReadError that names the file and, for text, the line.
Mesh read(const std::filesystem::path& path, const std::string& mesh = {});

/// The names of a file's meshes; none in formats whose files hold one, without a name. Throws as read() does.
std::vector<std::string> meshes_in(const std::filesystem::path& path);

/// Writes a mesh; the format follows the extension, case ignored, see formats.h.
/// A temporary file beside `path` is renamed when complete, so `path` is whole or untouched.
/// Throws WriteError.
void write(const Mesh& mesh, const std::filesystem::path& path);

/// What of a mesh a file of that extension does not hold, a line each: "the facet group 'PRESSED'". Empty where nothing
/// is lost, for an unknown extension, and for formats that do not say.
std::vector<std::string> losses(const Mesh& mesh, const std::filesystem::path& path);

/// What a file of that extension names and does not have, so that a solver will stop: sets of a deck whose groups were
/// taken out of the mesh (named_gone_sets()). Empty for formats without cards.
std::vector<std::string> loose_ends(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace femscalpel
