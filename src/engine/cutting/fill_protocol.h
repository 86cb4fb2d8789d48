// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

/// What the engine and the program that fills cavities say to each other, through one socket (helper_process.h). Both
/// run on one machine.
namespace femscalpel::fill_protocol {

/// What the engine sends first; then `points` times three coordinates (double) and `triangles` times three indices of
/// them (int32), the normals pointing out of the cavity.
struct Request {
    std::int32_t points, triangles;
    double max_edge;  ///< length of edges inside, at most about
    double grading;   ///< how fast elements may grow away from the triangles: 0 (not) to 1
    double enough;    ///< smallest mean ratio that is not worth another attempt
};

/// What the program sends back first. Of a success follow the new points (double) and four indices (int32) for each
/// tetrahedron, new points counted after those of the request; of a failure `text` characters that say why.
struct Answer {
    std::int32_t text, points, tetras;
};

}  // namespace femscalpel::fill_protocol
