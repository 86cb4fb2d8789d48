// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/formats.h"

#include <algorithm>

#include "io/bdf.h"
#include "io/inp.h"
#include "io/med.h"
#include "io/msh.h"
#include "io/unv.h"
#include "io/vtu.h"

namespace femscalpel {
namespace {

constexpr Format table[] = {
    {"MED: Code_Aster, SALOME", {".med", ".mmed", ".rmed"}, read_med, write_med, med_meshes, med_losses, true},
    {"CalculiX",
     {".inp", ".inp.gz"},
     [](const std::filesystem::path& path, const std::string&) { return read_inp(path); },
     write_inp,
     nullptr,
     inp_losses,
     false,
     true},
    {"ParaView",
     {".vtu"},
     [](const std::filesystem::path& path, const std::string&) { return read_vtu(path); },
     write_vtu,
     nullptr,
     vtu_losses},
    {"Gmsh",
     {".msh"},
     [](const std::filesystem::path& path, const std::string&) { return read_msh(path); },
     write_msh,
     nullptr,
     msh_losses},
    {"UNV: I-DEAS, SALOME",
     {".unv"},
     [](const std::filesystem::path& path, const std::string&) { return read_unv(path); },
     write_unv,
     nullptr,
     unv_losses},
    {"Nastran",
     {".bdf", ".nas", ".dat"},
     [](const std::filesystem::path& path, const std::string&) { return read_bdf(path); },
     write_bdf,
     nullptr,
     bdf_losses},
};

/// The extension in lower case; of a packed file with the one before: ".inp.gz".
std::string extension(const std::filesystem::path& path) {
    std::string out = path.extension().string();
    const auto lower = [](std::string& text) {  // ASCII only, whatever the locale
        for (char& c : text)
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    };
    lower(out);
    if (out == ".gz") {
        std::string inner = path.stem().extension().string();
        lower(inner);
        out = inner + out;
    }
    return out;
}

std::string list(auto wanted) {
    std::string out;
    for (const Format& format : table)
        if (wanted(format))
            for (const std::string_view e : format.extensions()) out += (out.empty() ? "" : ", ") + std::string(e);
    return out;
}

}  // namespace

std::span<const std::string_view> Format::extensions() const {
    return {listed.begin(), std::ranges::find(listed, std::string_view())};
}

std::span<const Format> formats() { return table; }

const Format* format_of(const std::filesystem::path& path) {
    const std::string wanted = extension(path);
    if (wanted.empty()) return nullptr;
    const Format* found =
        std::ranges::find_if(table, [&](const Format& f) { return std::ranges::count(f.extensions(), wanted) > 0; });
    return found == std::end(table) ? nullptr : found;
}

std::string extensions_read() {
    return list([](const Format& f) { return f.read != nullptr; });
}

std::string extensions_written() {
    return list([](const Format& f) { return f.write != nullptr; });
}

}  // namespace femscalpel
