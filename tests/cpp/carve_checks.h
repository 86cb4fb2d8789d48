// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "crack_checks.h"

/// What must hold when material was taken away, looked at from the outside, as in crack_checks.h.
namespace femscalpel::checks {

/// Material that was to be removed.
struct Carved {
    std::function<double(const Vec3&)> depth;  ///< not positive inside; outside about the distance
    /// A group of wall faces, and the signed distance to the surface they must lie on.
    struct Wall {
        std::string group;
        std::function<double(const Vec3&)> distance;
    };
    std::vector<Wall> walls;
    double sag = 0;  ///< how far a chord of the surface may be off it, in squared edge lengths: 1 / (8 radius)
};

/// Everything that does not hold, one line each; empty when all is well.
std::vector<std::string> check_carved(const Model& model, const Carved& carved, const Result& result);

/// Area (length, for shells) of a group of faces.
double measure_of(const Mesh& mesh, const std::string& group);

}  // namespace femscalpel::checks
