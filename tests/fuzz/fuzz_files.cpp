// SPDX-License-Identifier: LGPL-2.1-or-later
//
// fuzz_files [--count N] [--first K] [--seed S] [--format .EXT] [--keep FOLDER] [FILE...]: reads N damaged files of
// each format (200 unless told), made of FILEs of that format and of what its own writer makes. A reader may refuse a
// file by Error, and by nothing else, within 20 seconds. What it takes has to be valid, and is written to every format
// and read again. Files that fail are kept, by default in the current folder; one that crashes is the last one there,
// and the number to begin with again is in its name. Built by the preset asan, under the sanitizers.
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "error.h"
#include "fields/field.h"
#include "format_testing.h"
#include "io/formats.h"
#include "io/io.h"
#include "mutate.h"
#include "simple_meshes.h"

namespace {

using namespace femscalpel;
namespace fs = std::filesystem;

constexpr unsigned patience = 20;  // seconds

struct Arguments {
    std::uint64_t seed = 1;
    int count = 200, first = 0;
    std::string format;
    fs::path keep = ".";
    std::vector<fs::path> files;
};

void give_up(int /*signal*/) {
    constexpr char text[] = "fuzz_files: a file takes too long; it is the last one kept\n";
    static_cast<void>(!::write(STDERR_FILENO, text, sizeof text - 1));
    std::abort();
}

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& text) {
    fs::remove(path);  // to write over a file waits for the disk
    std::ofstream(path, std::ios::binary) << text;
}

/// A field on nodes, and one on elements.
std::shared_ptr<const Fields> some_fields(const Mesh& mesh) {
    auto out = std::make_shared<Fields>();
    FieldPart nodes;
    nodes.numbers = std::make_shared<std::vector<Index>>(mesh.node_ids);
    nodes.reals.assign(mesh.node_ids.size(), 1.5);
    FieldPart cells;
    cells.support = FieldSupport::element;
    for (const CellBlock& block : mesh.blocks())
        if (!block.ids.empty()) {
            cells.type = block.type;
            cells.numbers = std::make_shared<std::vector<Index>>(block.ids);
            cells.reals.assign(block.ids.size(), 2.5);
        }
    out->fields.push_back({"U", {"X"}, {"mm"}, "s", FieldValues::float64, {{1, -1, 0.5, {nodes}}}});
    out->fields.push_back({"S", {"MISES"}, {"MPa"}, "s", FieldValues::float64, {{1, -1, 0.5, {cells}}}});
    return out;
}

std::vector<Mesh> meshes() {
    std::vector<Mesh> out{checks::one_of_each({}), checks::second_order(checks::two_halves()), checks::bricks(2, 1, 1),
                          checks::quadrangles(2, 2)};
    out[1].fields = some_fields(out[1]);
    return out;
}

/// Files of each format by its first extension: given ones, and what the writers make.
std::map<std::string, std::vector<std::string>> make_seeds(const Arguments& arguments, const fs::path& folder) {
    std::map<std::string, std::vector<std::string>> out;
    for (const fs::path& path : arguments.files)
        if (const Format* format = format_of(path)) out[std::string(format->listed[0])].push_back(content(path));
    for (const Format& format : formats())
        for (const Mesh& mesh : meshes()) {
            if (!format.write || !format.read) continue;
            const fs::path path = folder / ("seed" + std::string(format.listed[0]));
            try {
                write(mesh, path);
                out[std::string(format.listed[0])].push_back(content(path));
            } catch (const Error&) {  // elements that it has not
            }
        }
    return out;
}

/// What is wrong with a file's reader, "" if nothing is.
std::string fault_with(const fs::path& path, const fs::path& folder, bool& read_well) {
    try {
        const Mesh mesh = read(path);
        read_well = true;
        try {
            mesh.validate();
            if (mesh.fields) validate(*mesh.fields, mesh);
        } catch (const std::exception& error) {
            return std::string("was read, but is not valid: ") + error.what();
        }
        for (const Format& format : formats()) {
            if (!format.write) continue;
            const fs::path again = folder / ("again" + std::string(format.listed[0]));
            fs::remove(again);
            try {
                write(mesh, again);
            } catch (const Error&) {
                continue;
            }
            if (!format.read) continue;
            try {
                read(again);
            } catch (const Error& error) {
                return "what was written of it is not read: " + std::string(error.what());
            }
        }
    } catch (const Error& error) {
        read_well = false;
        // To be found, an error names the file.
        return std::strstr(error.what(), path.filename().c_str()) ? "" : std::string("no file named: ") + error.what();
    } catch (const std::exception& error) {
        return std::string("other than Error: ") + error.what();
    }
    return "";
}

/// Number of files that failed.
int try_format(const std::string& extension, const std::vector<std::string>& seeds, const Arguments& arguments,
               const fs::path& folder) {
    int failed = 0, well = 0;
    for (int k = arguments.first; k < arguments.first + arguments.count; ++k) {
        checks::Random random(arguments.seed * 1000003 + static_cast<std::uint64_t>(k));
        const std::string& seed = seeds[random.bits() % seeds.size()];
        const std::string& other = seeds[random.bits() % seeds.size()];
        const fs::path path = arguments.keep / ("fuzzed_" + std::to_string(k) + extension);
        put(path, checks::mutated(seed, other, random));
        bool read_well = false;
        ::alarm(patience);
        const std::string fault = fault_with(path, folder, read_well);
        ::alarm(0);
        well += read_well;
        if (fault.empty()) {
            fs::remove(path);
            continue;
        }
        ++failed;
        std::printf("%s: %s\n", path.c_str(), fault.c_str());
    }
    std::printf("%-6s %zu seeds, %d files, %d read, %d failed\n", extension.c_str(), seeds.size(), arguments.count,
                well, failed);
    std::fflush(stdout);
    return failed;
}

Arguments parse(int argc, char** argv) {
    Arguments out;
    for (int k = 1; k < argc; ++k) {
        const std::string name = argv[k];
        const auto value = [&]() -> std::string {
            if (k + 1 == argc) throw std::invalid_argument(name + " needs a value");
            return argv[++k];
        };
        if (name == "--count")
            out.count = std::stoi(value());
        else if (name == "--first")
            out.first = std::stoi(value());
        else if (name == "--seed")
            out.seed = std::stoull(value());
        else if (name == "--format")
            out.format = value();
        else if (name == "--keep")
            out.keep = value();
        else if (name.starts_with("--"))
            throw std::invalid_argument("unknown option " + name);
        else
            out.files.emplace_back(name);
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) try {
    const Arguments arguments = parse(argc, argv);
    ::signal(SIGALRM, give_up);
    const fs::path folder = fs::temp_directory_path() / ("femscalpel_fuzz_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    fs::create_directories(arguments.keep);
    int failed = 0;
    for (const auto& [extension, seeds] : make_seeds(arguments, folder))
        if (arguments.format.empty() || arguments.format == extension)
            failed += try_format(extension, seeds, arguments, folder);
    fs::remove_all(folder);
    return failed == 0 ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz_files: %s\n", error.what());
    return 2;
}
