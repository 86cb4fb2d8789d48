// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/io.h"

#include <string>

#include "error.h"
#include "io/formats.h"

namespace femscalpel {
namespace {

std::string unknown(const std::filesystem::path& path, const std::string& known) {
    return path.string() + ": the format is told by the extension, one of " + known;
}

}  // namespace

Mesh read(const std::filesystem::path& path) {
    const Format* format = format_of(path);
    if (format && !format->read)
        throw ReadError(path.string() + ": files of this kind can only be written; those that can be read are " +
                        extensions_read());
    if (!format) throw ReadError(unknown(path, extensions_read()));
    return format->read(path);
}

void write(const Mesh& mesh, const std::filesystem::path& path) {
    const Format* format = format_of(path);
    if (format && !format->write)
        throw WriteError(path.string() + ": files of this kind can only be read; those that can be written are " +
                         extensions_written());
    if (!format) throw WriteError(unknown(path, extensions_written()));
    format->write(mesh, path);
}

}  // namespace femscalpel
