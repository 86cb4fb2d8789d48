// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "mesh/mesh.h"

namespace femscalpel::checks {

/// Random numbers that are the same with every standard library (SplitMix64).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits();
    double uniform(double low = 0, double high = 1);  ///< in [low, high)
    Vec3 direction();                                 ///< unit vector, evenly spread over the sphere

private:
    std::uint64_t state_;
};

}  // namespace femscalpel::checks
