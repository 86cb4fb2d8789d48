// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// What coordinates are in a file whose numbers are too short for some: `as_read` gives what is read of a coordinate
/// there.
struct LostDigits {
    std::vector<Index> nodes;  ///< indices of those with another coordinate in the file
    std::vector<double> off;   ///< of each the largest difference of a coordinate

    LostDigits(const Mesh& mesh, const std::function<double(double)>& as_read);

    /// "the last digits of the coordinates of 3 nodes (they are off by up to 1e-17)"; none without any.
    std::optional<std::string> told() const;
};

}  // namespace femscalpel
