// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/cut.h"

#include "operators/carve.h"
#include "tools/checks.h"

namespace femscalpel {

namespace {

Result cut_out(const Mesh& mesh, const Tool& positive, const Tool& negative, std::optional<double> width,
               const CutOptions& options, const Prepared& prepared) {
    Body body;
    body.width = width;
    body.walls.push_back({&positive, {"_P"}});
    body.walls.push_back({&negative, {"_N"}});
    if (options.bottom) body.walls.push_back({options.bottom, {"_BOTTOM"}});
    return carve("cut", mesh, {&body, 1}, options, {"ICN", "ECN", "ITN", "ETN"}, prepared);
}

}  // namespace

Result cut(const Mesh& mesh, const Tool& positive, const Tool& negative, const CutOptions& options,
           const Prepared& prepared) {
    return cut_out(mesh, positive, negative, {}, options, prepared);
}

Result cut(const Mesh& mesh, const Plane& plane, double width, const CutOptions& options, const Prepared& prepared) {
    const Vec3 half = checked_length(width, {"", "width"}) / 2 * plane.unit_normal();
    return cut_out(mesh, Plane(plane.origin() + half, plane.unit_normal()),
                   Plane(plane.origin() - half, -plane.unit_normal()), width, options, prepared);
}

}  // namespace femscalpel
