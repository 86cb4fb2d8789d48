// SPDX-License-Identifier: LGPL-2.1-or-later
// The reference holes at 39 k tetrahedra; femscalpel_bench prints the same and the time, also at 505 k.
#include <gtest/gtest.h>

#include <iostream>

#include "io/inp.h"
#include "operators/drill.h"
#include "reference_holes.h"
#include "tools/cylinder.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace checks;

TEST(ReferenceHoles, AreRoundTrueToSizeAndWellShaped) {
    const Mesh mesh = read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/two_boxes_39k.inp");
    for (const ReferenceHole& hole : reference_holes) {
        SCOPED_TRACE(hole.name);
        const Cylinder cylinder(hole.origin, hole.axis, hole.radius);
        const Tool* tool = &cylinder;
        const Result result = drill(mesh, {&tool, 1});
        const HoleMeasures m = measure(hole, mesh, result.mesh);
        const double quality = result.report.quality_after.minimum;
        std::cout << "[  QUALITY ] " << hole.name << ": minimum mean ratio " << quality << ", removed volume "
                  << 100 * m.volume_error << " %, nodes off the wall " << m.off_wall
                  << ", off the border between the boxes " << m.off_border << "\n";
        EXPECT_GE(quality, hole.quality);
        EXPECT_LE(std::abs(m.volume_error), 0.015);
        EXPECT_GT(m.wall_faces, 100);
        EXPECT_LE(m.off_wall, 1e-9);
        EXPECT_LE(m.off_border, 1e-12);
    }
}

/// Without refinement the one that is finer than the mesh is refused, with the reason.
TEST(ReferenceHoles, AreNotDrilledIntoAMeshTooCoarse) {
    const Mesh mesh = read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/two_boxes_39k.inp");
    const ReferenceHole& hole = reference_holes[2];
    const Cylinder cylinder(hole.origin, hole.axis, 0.35);  // edges are 0.6 long; whatever mesh Gmsh makes of it
    const Tool* tool = &cylinder;
    DrillOptions options;
    options.refine.when = RefineFirst::When::never;
    try {
        drill(mesh, {&tool, 1}, options);
        FAIL() << "drilled";
    } catch (const ToolError& e) {
        EXPECT_NE(std::string(e.what()).find("too coarse"), std::string::npos) << e.what();
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
