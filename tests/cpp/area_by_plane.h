// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "elements_by_hand.h"

namespace femscalpel::checks {

/// Area by plane, of faces that lie in a few planes.
class AreaByPlane {
public:
    void add(const std::array<Vec3, 3>& c, double size) {
        Vec3 normal = (c[1] - c[0]).cross(c[2] - c[0]);
        const double area = normal.norm() / 2;
        normal /= 2 * area;
        // Thin faces have inexact normals, so a plane is known by its distance to all three corners.
        Plane* found = nullptr;
        for (Plane& p : planes_) {
            const bool in = std::ranges::all_of(
                c, [&](const Vec3& x) { return std::abs(p.normal.dot(x) - p.offset) <= rounding * size; });
            if (in && normal.dot(p.normal) > 0.9) {
                found = &p;
                break;
            }
        }
        if (!found) {
            planes_.push_back({normal, normal.dot(c[0]), 0});
            found = &planes_.back();
        }
        found->area += area;
    }

    /// The same planes without their areas: faces of another mesh can be added.
    AreaByPlane emptied() const {
        AreaByPlane copy = *this;
        for (Plane& p : copy.planes_) p.area = 0;
        return copy;
    }

    /// What differs from `before`, whose planes come first, or nothing.
    std::string differs(const AreaByPlane& before, double size, double slack) const {
        std::ostringstream text;
        text.precision(12);
        for (std::size_t k = 0; k < planes_.size(); ++k) {
            const double old = k < before.planes_.size() ? before.planes_[k].area : 0;
            if (std::abs(planes_[k].area - old) <= rounding * std::max(old, 1e-3 * size * size) + slack) continue;
            text << "area " << old << " -> " << planes_[k].area << " in the plane of normal ("
                 << planes_[k].normal.transpose() << ") at " << planes_[k].offset << "; ";
        }
        return text.str();
    }

private:
    struct Plane {
        Vec3 normal;
        double offset;
        double area;
    };
    std::vector<Plane> planes_;
};

}  // namespace femscalpel::checks
