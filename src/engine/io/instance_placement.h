// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

#include "deck/solver_input.h"

namespace femscalpel {

/// Where something that has coordinates of its own lies in the model: turned first, then shifted.
struct Placement {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Vec3 shift = Vec3::Zero();
    bool turns = false;  ///< `turn` is not the identity
    bool moves = false;  ///< it is another place at all

    Vec3 point(const Vec3& x) const { return turns ? Vec3(turn * x + shift) : Vec3(x + shift); }
    Vec3 direction(const Vec3& d) const { return turns ? Vec3(turn * d) : d; }
    /// This one, of what is already placed by `inner`.
    Placement after(const Placement& inner) const;
};

/// The placement on the data lines of an *INSTANCE card: a translation, then, on a second line, two points of an axis
/// and an angle in degrees about it (right-handed from the first to the second point), which is applied to what is
/// translated already. Multiples of 90 degrees are exact. Throws ReadError that names the line.
Placement placement_of_instance(const Card& card);

/// The placement of nodes behind a *SYSTEM card: its origin, a point on its first axis and one in its plane of the
/// first two. Without the last its third axis stays and the first is projected; without any line it is the global
/// system again. Throws ReadError that names the line.
Placement placement_of_system(const Card& card);

}  // namespace femscalpel
