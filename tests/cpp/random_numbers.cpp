// SPDX-License-Identifier: LGPL-2.1-or-later
#include "random_numbers.h"

#include <cmath>
#include <numbers>

namespace femscalpel::checks {

std::uint64_t Random::bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double Random::uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
}

Vec3 Random::direction() {
    const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return Vec3(r * std::cos(angle), r * std::sin(angle), z).normalized();
}

}  // namespace femscalpel::checks
