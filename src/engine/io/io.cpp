// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/io.h"

#include <algorithm>
#include <string>

#include "error.h"
#include "io/inp.h"
#include "io/med.h"
#include "io/vtu.h"

namespace femscalpel {
namespace {

/// The extension in lower case; ".inp.gz" counts as one.
std::string extension(const std::filesystem::path& path) {
    std::string out = path.extension().string();
    const auto lower = [](std::string& text) {
        std::ranges::transform(text, text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    };
    lower(out);
    if (out == ".gz") {
        std::string inner = path.stem().extension().string();
        lower(inner);
        out = inner + out;
    }
    return out;
}

std::string unknown(const std::filesystem::path& path, const char* known) {
    return path.string() + ": the format is told by the extension, one of " + known;
}

}  // namespace

Mesh read(const std::filesystem::path& path) {
    const std::string format = extension(path);
    if (format == ".med") return read_med(path);
    if (format == ".inp" || format == ".inp.gz") return read_inp(path);
    throw ReadError(unknown(path, ".med, .inp, .inp.gz"));
}

void write(const Mesh& mesh, const std::filesystem::path& path) {
    const std::string format = extension(path);
    if (format == ".med") return write_med(mesh, path);
    if (format == ".inp" || format == ".inp.gz") return write_inp(mesh, path);
    if (format == ".vtu") return write_vtu(mesh, path);
    throw WriteError(unknown(path, ".med, .inp, .inp.gz, .vtu"));
}

}  // namespace femscalpel
