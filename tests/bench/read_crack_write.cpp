// SPDX-License-Identifier: LGPL-2.1-or-later
//
// read_crack_write IN OUT: reads a mesh, makes the reference crack, writes the result; prints the seconds of
// each part. `time` it for the whole process.
#include <chrono>
#include <cstdio>

#include "io/io.h"
#include "operators/crack.h"
#include "tools/plane.h"

int main(int argc, char** argv) {
    using namespace femscalpel;
    if (argc != 3) {
        std::fprintf(stderr, "usage: read_crack_write IN OUT\n");
        return 2;
    }
    try {
        auto seconds = [last = std::chrono::steady_clock::now()]() mutable {
            const auto now = std::chrono::steady_clock::now();
            const double s = std::chrono::duration<double>(now - last).count();
            last = now;
            return s;
        };
        const Mesh mesh = read(argv[1]);
        const double reading = seconds();
        const Result result = crack(mesh, Plane({7.3, 5, 5}, {0.9, 0.3, 0.2}));
        const double cracking = seconds();
        write(result.mesh, argv[2]);
        std::printf("read %.3f s, crack %.3f s, write %.3f s; minimum quality %.3f, %lld new nodes\n", reading,
                    cracking, seconds(), result.report.quality_after.minimum,
                    static_cast<long long>(result.report.nodes_split));
    } catch (const Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
