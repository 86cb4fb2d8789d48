// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "crack_checks.h"

/// What must hold of cracks along curved tools and of cracks that end inside the material, looked at from the outside,
/// as in crack_checks.h for whole planes.
namespace femscalpel::checks {

/// Where a crack was to be.
struct CrackSurface {
    std::function<double(const Vec3&)> distance;  ///< signed, to the tool
    std::function<double(const Vec3&)>
        border;  ///< signed, to the border of the part that cracks, negative inside; none: the whole tool
};

/// Everything that does not hold, one line each; empty when all is well. The lips are the groups CRACK_P and CRACK_N.
std::vector<std::string> check_lips(const Model& model, const CrackSurface& surface, const Result& result);

/// Whether geometry alone stops a tool from giving good elements: somewhere it runs at under 5 degrees along a skin, a
/// border between groups or a feature line, within 0.15 edge lengths of it. `radius`: the tool's smallest, or infinity.
class Tangency {
public:
    explicit Tangency(const Model& model);
    bool of(const std::function<double(const Vec3&)>& distance, double radius) const;

    /// The same of a front, or of the line where two walls meet, by points of it: as close together as it bends.
    bool of_curve(const std::vector<Vec3>& points, double radius) const;

private:
    const Model& model_;
    std::vector<Model::Segment> creases_;
};

}  // namespace femscalpel::checks
