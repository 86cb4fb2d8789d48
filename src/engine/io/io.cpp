// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/io.h"

#include <string>

#include "deck/rules/gone_sets.h"
#include "deck/solver_input.h"
#include "error.h"
#include "fields/field.h"
#include "io/formats.h"
#include "utf8.h"

namespace femscalpel {
namespace {

std::string unknown(const std::filesystem::path& path, const std::string& known) {
    return shown_path(path) + ": the format is told by the extension, one of " + known;
}

/// Throws ReadError when files of that kind cannot be read.
const Format& format_to_read(const std::filesystem::path& path) {
    const Format* format = format_of(path);
    if (format && !format->read)
        throw ReadError(shown_path(path) + ": files of this kind can only be written; those that can be read are " +
                        extensions_read());
    if (!format) throw ReadError(unknown(path, extensions_read()));
    return *format;
}

}  // namespace

Mesh read(const std::filesystem::path& path, const std::string& mesh) {
    const Format& format = format_to_read(path);
    if (!mesh.empty() && !format.meshes)
        throw ReadError(shown_path(path) + ": files of this kind hold one mesh, without a name; leave `mesh` out");
    Mesh out = format.read(path, mesh);
    try {
        out.check_numbers();
    } catch (const Error& error) {
        throw ReadError(shown_path(path) + ": " + error.what());
    }
    return out;
}

std::vector<std::string> meshes_in(const std::filesystem::path& path) {
    const Format& format = format_to_read(path);
    return format.meshes ? format.meshes(path) : std::vector<std::string>();
}

void write(const Mesh& mesh, const std::filesystem::path& path) {
    const Format* format = format_of(path);
    if (format && !format->write)
        throw WriteError(shown_path(path) + ": files of this kind can only be read; those that can be written are " +
                         extensions_written());
    if (!format) throw WriteError(unknown(path, extensions_written()));
    format->write(mesh, path);
}

std::vector<std::string> losses(const Mesh& mesh, const std::filesystem::path& path) {
    const Format* format = format_of(path);
    if (!format) return {};
    std::vector<std::string> out = format->losses ? format->losses(mesh) : std::vector<std::string>();
    if (solver_input(mesh) && !format->deck) out.emplace_back("the cards of the deck the mesh was read from");
    if (mesh.fields && !format->fields)
        for (const Field& field : mesh.fields->fields) out.push_back("the field '" + field.name + "'");
    return out;
}

std::vector<std::string> loose_ends(const Mesh& mesh, const std::filesystem::path& path) {
    const Format* format = format_of(path);
    return format && format->deck ? named_gone_sets(mesh) : std::vector<std::string>();
}

}  // namespace femscalpel
