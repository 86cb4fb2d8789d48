// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How soon a computation ends when it is cancelled: for each operation its time, the number of check points (cancel.h),
// the longest time without one, and how long it took to end when cancelled right at the start of that time. With
// VERBOSE=1 also where that is.
//
//     cancel_latency [PART OF THE MESH'S NAME [PART OF THE OPERATION'S NAME]]
#include <execinfo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>

#include "cancel.h"
#include "groups/virtual_boundary.h"
#include "io/io.h"
#include "mesh/quality.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/fillet.h"
#include "operators/refine.h"
#include "operators/reshape.h"
#include "operators/scalpel.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"
#include "tools/torus.h"

namespace femscalpel {
namespace {

/// Milliseconds; with CPU=1 in the environment those of this thread's processor time, for a machine that has other
/// work.
double now() {
    static const bool processor = std::getenv("CPU") != nullptr;
    timespec time;
    clock_gettime(processor ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void print_calls() {
    void* calls[14];
    const int count = backtrace(calls, 14);
    char** names = backtrace_symbols(calls, count);
    for (int k = 3; k < count; ++k) std::printf("        %s\n", names[k]);
    std::free(names);
}

std::string wanted;  // part of the names of what is measured

void measure(const char* name, const std::function<void()>& run) {
    if (std::string(name).find(wanted) == std::string::npos) return;
    const bool verbose = std::getenv("VERBOSE") != nullptr;
    long count = 0, longest_at = 0;
    double longest = 0, last = now();
    const auto look = [&] {
        if (const double gap = now() - last; gap > longest) {
            longest = gap;
            longest_at = count;
        }
        ++count;
        last = now();
    };
    const double start = now();
    {
        const CancelScope scope(CancelToken(), [&] {
            look();
            return false;
        });
        run();
        look();
    }
    const double total = now() - start;
    // Once more, up to there.
    long again = 0;
    double asked = 0;
    bool asked_yet = false;
    const CancelToken token;
    double latency = 0;
    try {
        const CancelScope scope(token, [&] {
            if (again + 1 >= longest_at && !asked_yet) {
                asked = now();
                asked_yet = true;
                if (verbose) print_calls();
                ++again;
                return false;
            }
            if (asked_yet && verbose) {
                std::printf("        to:\n");
                print_calls();
            }
            ++again;
            return asked_yet;
        });
        run();
    } catch (const Cancelled&) {
    }
    if (asked_yet) latency = now() - asked;
    std::printf("%-28s %8.0f ms %9ld check points, at most %6.1f ms apart, ends within %6.1f ms\n", name, total, count,
                longest, latency);
    std::fflush(stdout);
}

/// The same mesh in second order, without its groups of nodes, as curved as the smooth map of space that its nodes went
/// through.
Mesh curved(const Mesh& mesh) {
    Mesh out = checks::second_order(mesh);
    std::ranges::fill(out.node_families, 0);
    for (Vec3& x : out.points)
        x += 0.2 * Vec3(std::sin(x[1]) + std::sin(x[2]), std::sin(x[2]) + std::sin(x[0]), std::sin(x[0] + x[1]));
    return out;
}

void measure_curved(const Mesh& linear) {
    const Mesh mesh = curved(linear);
    const Plane plane({7.3, 5, 5}, {0.9, 0.3, 0.2});
    const Cylinder hole({6, 5, 5}, {0.1, 0.2, 1}, 2);
    const Tool* tools[] = {&hole};
    measure("crack, curved", [&] { crack(mesh, plane); });
    measure("drill, curved", [&] { drill(mesh, tools); });
    RefineOptions o;
    o.size = 0.2;

    measure("refine, curved", [&] { refine(mesh, distance_to(std::vector<const Tool*>{&hole}), o); });
}

void measure_all(const std::filesystem::path& path) {
    const Mesh mesh = read(path);
    std::printf("%s: %lld elements\n", path.filename().c_str(), static_cast<long long>(mesh.cell_count()));
    const std::filesystem::path out = std::filesystem::temp_directory_path() / "femscalpel_cancel";
    std::filesystem::create_directories(out);
    const Plane plane({7.3, 5, 5}, {0.9, 0.3, 0.2});
    const Cylinder hole({6, 5, 5}, {0.1, 0.2, 1}, 2), fine({6, 5, 5}, {0, 0, 1}, 0.4);
    const Torus torus({6, 5, 5}, {0, 0, 1}, 3, 0.7);
    const Tool* tools[] = {&hole};
    measure("read .inp", [&] { read(path); });
    for (const char* type : {".med", ".inp", ".inp.gz", ".vtu", ".msh", ".unv", ".bdf"}) {
        const std::filesystem::path file = out / (std::string("mesh") + type);
        measure((std::string("write ") + type).c_str(), [&] { write(mesh, file); });
        if (!std::filesystem::exists(file)) write(mesh, file);
        measure((std::string("read ") + type).c_str(), [&] { read(file); });
    }
    measure("session", [&] { Scalpel scalpel(std::make_shared<Mesh>(mesh)); });
    measure("crack", [&] { crack(mesh, plane); });
    CrackOptions deform;
    deform.method = Method::deform;
    measure("crack, deform", [&] { crack(mesh, plane, deform); });
    const Scalpel scalpel(std::make_shared<Mesh>(mesh));
    measure("crack in a session", [&] { crack(scalpel.mesh(), plane, {}, scalpel.prepared()); });
    CrackOptions preview;
    preview.band_only = true;
    measure("preview in a session", [&] { crack(scalpel.mesh(), plane, preview, scalpel.prepared()); });
    measure("drill", [&] { drill(mesh, tools); });
    measure("fillet", [&] { fillet(mesh, {{}, {}, {{5, 0, 0}}}, 1); });
    measure("crack along a torus", [&] { crack(mesh, torus); });
    measure("cut", [&] { cut(mesh, plane, 0.5); });
    RefineOptions o;
    o.size = 0.1;
    measure("refine", [&] { refine(mesh, distance_to(std::vector<const Tool*>{&fine}), o); });
    o.size = 1e-9;
    o.gradation = 100;
    measure("refine, nothing to do", [&] { refine(mesh, distance_to(std::vector<Vec3>{{1000, 0, 0}}), o); });
    if (mesh.cell_count() < 100'000) measure_curved(mesh);
    ReshapeOptions wall;
    wall.by = Vec3(1, 0, 0);
    measure("reshape", [&] { reshape(mesh, "END_RIGHT", wall); });
    measure("virtual boundaries", [&] {
        const VirtualBoundaryFinder finder(mesh);
        for (std::size_t g = 0; g < mesh.groups.size(); ++g) finder.find(static_cast<GroupIndex>(g));
    });
    measure("mean ratios", [&] { mean_ratios(mesh, CellType::tetra); });
    measure("validate", [&] { mesh.validate(); });
    std::filesystem::remove_all(out);
}

}  // namespace
}  // namespace femscalpel

int main(int argc, char** argv) {
    if (argc > 2) femscalpel::wanted = argv[2];
    for (const char* name : {"two_boxes_39k", "two_boxes_505k", "two_boxes_2500k"}) {
        const std::filesystem::path path = std::filesystem::path(FEMSCALPEL_TEST_MESHES) / (std::string(name) + ".inp");
        if (std::filesystem::exists(path) && (argc < 2 || std::string(name).find(argv[1]) != std::string::npos))
            femscalpel::measure_all(path);
    }
}
