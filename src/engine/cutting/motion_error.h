// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "error.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// A wall cannot be moved as far as it is to be; less of the motion may have room. The message says why, and has no
/// full stop: what works instead is added to it (reshape()).
class MotionError : public ToolError {
public:
    /// `at`: where in the mesh as it is; of use where the message does not name a place that is not in the mesh yet.
    MotionError(const std::string& message, const char* parameter, const Vec3& at)
        : ToolError(message, parameter), at_(at) {}

    const Vec3& at() const noexcept { return at_; }

private:
    Vec3 at_;
};

}  // namespace femscalpel
