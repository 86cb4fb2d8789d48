// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cutting/motion_error.h"
#include "operators/reshape.h"

namespace femscalpel {

/// A part of a motion.
struct PartOfMotion {
    ReshapeOptions options;
    std::unique_ptr<Tool> tool;  ///< that of `options`
    std::string text;            ///< as a user would give it, e.g. "by=(0.5, 0, 0)"
};

/// The motion as far as `share` of the way, 0 to 1, in numbers that can be written down. Onto a plane, cylinder or
/// sphere where the wall is one of the same kind, or all of it equally far from it; nothing onto other tools.
std::optional<PartOfMotion> part_of_motion(const Mesh& mesh, GroupIndex group, const ReshapeOptions& options,
                                           double share);

/// For the end of a message: the group nearest to where a motion failed, other than that of the wall.
std::string where_text(const Mesh& mesh, const std::string& wall, const MotionError& error);

/// Does as much of a motion as its options say, and throws where that cannot be.
using MotionAttempt = std::function<void(const ReshapeOptions&)>;

/// What to do about a motion that failed, for the end of a message: the largest share of it, in steps of a twentieth,
/// that works, by trying, first by `look`, which costs little, then by `work`. The search ends after `longest` seconds,
/// with what was found by then, and at once, with Cancelled, when the caller is to end.
std::string advice_on_motion(const Mesh& mesh, GroupIndex group, const ReshapeOptions& options,
                             const MotionAttempt& look, const MotionAttempt& work, double longest);

}  // namespace femscalpel
