// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// A file format: a row of the table in formats.cpp, which is all that the engine, the Python package and the workbench
/// know of formats. A new one needs a pair of files with its functions, its row there and in README's list.
struct Format {
    std::string_view title;  ///< for file dialogs, in every language: "MED: Code_Aster, SALOME"
    /// In lower case, with the dot, the usual one first: ".inp", ".inp.gz". Empty ones end the list.
    std::array<std::string_view, 4> listed;
    /// Null for a format that is written only. The name is that of one of the file's meshes; empty: the first.
    Mesh (*read)(const std::filesystem::path&, const std::string& mesh);
    void (*write)(const Mesh&, const std::filesystem::path&);  ///< null for a format that is read only
    /// The names of a file's meshes; null for a format whose files hold one, without a name.
    std::vector<std::string> (*meshes)(const std::filesystem::path&) = nullptr;
    /// What of a mesh its files do not hold, a line each, to be told to who writes one; null where nothing is said.
    std::vector<std::string> (*losses)(const Mesh&) = nullptr;

    bool fields = false;  ///< its files hold fields
    bool deck = false;    ///< its files hold the deck the mesh was read from

    /// The extensions without the empty ones.
    std::span<const std::string_view> extensions() const;
};

/// All formats.
std::span<const Format> formats();

/// The format that a file's extension tells, case ignored; null if none has it.
const Format* format_of(const std::filesystem::path& path);

/// Extensions of the formats that are read, as a list for messages: ".med, .inp, .inp.gz".
std::string extensions_read();
/// The same of those that are written.
std::string extensions_written();

}  // namespace femscalpel
