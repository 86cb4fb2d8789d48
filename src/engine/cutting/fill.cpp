// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/fill.h"

#include <cmath>
#include <sstream>

#include "cutting/fill_process.h"
#include "cutting/mend_filling.h"

namespace femscalpel {
namespace {

/// A cavity as Netgen gets it: only points that triangles have, about the origin, with edges of about 1.
struct Scaled {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<int> origin;  // index of each point in the caller's
    Vec3 centre = Vec3::Zero();
    double size = 0;
};

Scaled scaled(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
    Scaled s;
    std::vector<int> index(points.size(), -1);
    for (const Triangle& t : triangles) {
        Triangle& mine = s.triangles.emplace_back();
        for (int k = 0; k < 3; ++k) {
            if (index[t[k]] < 0) {
                index[t[k]] = static_cast<int>(s.origin.size());
                s.origin.push_back(t[k]);
                s.centre += points[t[k]];
            }
            mine[k] = index[t[k]];
            s.size += (points[t[(k + 1) % 3]] - points[t[k]]).norm();
        }
    }
    s.size /= 3.0 * static_cast<double>(triangles.size());
    s.centre /= static_cast<double>(s.origin.size());
    for (const int v : s.origin) s.points.emplace_back((points[v] - s.centre) / s.size);
    return s;
}

[[noreturn]] void refuse(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, const Vec3& centre,
                         const std::string& reason) {
    const SharpestEdge edge = sharpest_edge(points, triangles);
    std::ostringstream message;
    message << "a cavity of " << triangles.size() << " triangles around (" << centre.transpose()
            << ") cannot be filled with tetrahedra (" << reason << "); it is sharpest near (" << edge.at.transpose()
            << "), with " << edge.degrees << " degrees";
    throw QualityError(message.str());
}

}  // namespace

Filled fill_cavity(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                   const FillOptions& options) {
    check_cavity(points, triangles);
    const Scaled cavity = scaled(points, triangles);
    const fill_protocol::Request request{
        static_cast<std::int32_t>(cavity.points.size()), static_cast<std::int32_t>(cavity.triangles.size()),
        options.max_edge > 0 ? options.max_edge / cavity.size : 1e6, options.grading, options.enough};
    FillAnswer answer = run_fill_program(options.program.empty() ? fill_program() : options.program, request,
                                         cavity.points, cavity.triangles, options.seconds);
    if (!answer.failure.empty()) refuse(points, triangles, cavity.centre, answer.failure);

    Filled filled;
    std::vector<Vec3> all = points;
    for (const Vec3& p : answer.points) filled.points.emplace_back(cavity.centre + cavity.size * p);
    all.insert(all.end(), filled.points.begin(), filled.points.end());
    const int given = static_cast<int>(cavity.origin.size()), known = given + static_cast<int>(filled.points.size());
    filled.tetras = std::move(answer.tetras);
    for (Tetra& t : filled.tetras)
        for (int& v : t) {
            if (v < 0 || v >= known) refuse(points, triangles, cavity.centre, "an unknown node");
            v = v < given ? cavity.origin[v] : v - given + static_cast<int>(points.size());
        }
    mend_filling(all, triangles, filled.tetras);
    filled.points.assign(all.begin() + static_cast<std::ptrdiff_t>(points.size()), all.end());
    filled.worst = check_filling(all, triangles, filled.tetras);
    return filled;
}

}  // namespace femscalpel
