// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "crack_model.h"

namespace femscalpel::checks {

/// Smallest of distance / mean edge length over a set of faces, as far as it is below `limit`; otherwise `limit`.
double edges_away(const Vec3& p, const std::vector<Model::Face>& faces, double limit);

/// The same of segments, and their lengths.
double edges_away(const Vec3& p, const std::vector<Model::Segment>& segments, double limit);

/// Distance of `p` from the nearest of the faces, or segments, in the mesh's unit.
double distance_away(const Vec3& p, const std::vector<Model::Face>& faces);
double distance_away(const Vec3& p, const std::vector<Model::Segment>& segments);

}  // namespace femscalpel::checks
