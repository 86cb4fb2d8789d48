// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <span>

#include "mesh/mesh.h"
#include "tools/tool.h"

namespace femscalpel {

/// A motion that keeps shapes: x becomes factor * x + shift.
struct Similarity {
    double factor = 1;
    Vec3 shift = Vec3::Zero();

    Vec3 operator()(const Vec3& x) const { return factor * x + shift; }
};

/// The plane, cylinder or sphere on which all of these points lie to within `tolerance`, moved; none if there is none,
/// or too few points to tell. `normals` are those of the surface between them, about: they give the first guess, and
/// tell a plane.
///
/// Gauss and Newton's method on the distances (Forbes, "Least-squares best-fit geometric elements", NPL report DITC
/// 140/89, 1989).
std::unique_ptr<Tool> fitted_tool(std::span<const Vec3> points, std::span<const Vec3> normals, double tolerance,
                                  const Similarity& moved);

}  // namespace femscalpel
