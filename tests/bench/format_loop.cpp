// SPDX-License-Identifier: LGPL-2.1-or-later
//
// format_loop MESH [TIMES]: writes a mesh to every format there is and reads it again where that can be done; prints
// for each the size of the file and the shortest of so many times (5 unless told), and whether what was read is equal.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "io/formats.h"
#include "io/io.h"

namespace {

using namespace femscalpel;

double shortest(int times, const std::function<void()>& run) {
    double out = 0;
    for (int k = 0; k < times; ++k) {
        const auto start = std::chrono::steady_clock::now();
        run();
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        out = k == 0 ? seconds : std::min(out, seconds);
    }
    return out;
}

/// Whether numbers, coordinates and elements are equal; groups are left to the tests.
bool equal(const Mesh& a, const Mesh& b) {
    return a.points == b.points && a.node_ids == b.node_ids &&
           std::ranges::equal(a.blocks(), b.blocks(), [](const CellBlock& x, const CellBlock& y) {
               return x.connectivity == y.connectivity && x.ids == y.ids;
           });
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        std::fprintf(stderr, "usage: format_loop MESH [TIMES]\n");
        return 2;
    }
    const int times = argc == 3 ? std::max(1, std::atoi(argv[2])) : 5;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("femscalpel_format_loop_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    int status = 0;
    try {
        const Mesh mesh = read(argv[1]);
        std::printf("%lld nodes, %lld elements\n%-8s %9s %9s %9s\n", static_cast<long long>(mesh.node_count()),
                    static_cast<long long>(mesh.cell_count()), "format", "MB", "write s", "read s");
        for (const Format& format : formats()) {
            const std::string extension(format.extensions()[0]);
            const std::filesystem::path path = folder / ("mesh" + extension);
            if (!format.write) continue;
            const double writing = shortest(times, [&] { write(mesh, path); });
            std::printf("%-8s %9.1f %9.3f ", extension.c_str(),
                        1e-6 * static_cast<double>(std::filesystem::file_size(path)), writing);
            if (!format.read) {
                std::printf("%9s\n", "-");
                continue;
            }
            Mesh back;
            const double reading = shortest(times, [&] { back = read(path); });
            std::printf("%9.3f %s\n", reading, equal(mesh, back) ? "equal" : "different");
        }
    } catch (const Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        status = 1;
    }
    std::filesystem::remove_all(folder);
    return status;
}
