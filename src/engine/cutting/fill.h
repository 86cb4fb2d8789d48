// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "cutting/cavity.h"

namespace femscalpel {

/// How a cavity is to be filled.
struct FillOptions {
    double max_edge = 0;   ///< length of edges inside, at most about; 0: as the triangles and `grading` have it
    double grading = 0.3;  ///< how fast elements may grow away from the triangles: 0 (not) to 1
    double enough = 0.35;  ///< smallest mean ratio with which no other way of filling is tried
    double seconds = 120;  ///< it is given up after that time
    std::string program;   ///< that does it; empty: the one that belongs to the engine
};

/// Tetrahedra in a cavity.
struct Filled {
    std::vector<Vec3> points;   ///< the new ones; they are counted after those given
    std::vector<Tetra> tetras;  ///< volumes are positive (signed_volume())
    double worst = 1;           ///< smallest mean ratio
};

/// Fills what closed triangulated surfaces enclose with tetrahedra that have exactly these triangles as outer faces.
/// `triangles` are indices of `points`, their normals point out of the cavity. Points that no triangle has are left
/// alone. Several cavities, and voids in them, can be filled at once. Any number of threads can do so at once; ends
/// early when cancelled.
///
/// Netgen's library does it, in a process of its own (see fill_process.h); what it leaves nearly flat is mended
/// (mend_filling.h). Throws QualityError that names the place when the surface is open or crosses itself, and when
/// Netgen gives up or what it makes does not fit.
Filled fill_cavity(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                   const FillOptions& options = {});

}  // namespace femscalpel
