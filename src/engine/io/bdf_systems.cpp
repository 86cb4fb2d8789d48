// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/bdf_systems.h"

#include <cmath>
#include <numbers>

namespace femscalpel {
namespace {

/// Cartesian coordinates from those of a system's form: R, C or S; angles are in degrees.
Vec3 cartesian_of_bdf(char form, const Vec3& x) {
    constexpr double degree = std::numbers::pi / 180;
    if (form == 'C') return {x[0] * std::cos(x[1] * degree), x[0] * std::sin(x[1] * degree), x[2]};
    if (form == 'S') {
        const double across = x[0] * std::sin(x[1] * degree);
        return {across * std::cos(x[2] * degree), across * std::sin(x[2] * degree), x[0] * std::cos(x[1] * degree)};
    }
    return x;
}

}  // namespace

bool BdfSystems::add(const BdfCard& card) {
    const std::string& name = card.name;
    if (name.size() != 6 || !name.starts_with("CORD") || (name[4] != '1' && name[4] != '2') ||
        std::string_view("RCS").find(name[5]) == std::string_view::npos)
        return false;
    // A card by nodes may define two.
    for (std::size_t first = 0; first == 0 || (name[4] == '1' && !card.field(first).empty()); first += 4) {
        if (first > 4) break;
        const Index number = source_.integer(card, first, "the number of the system");
        if (number <= 0) source_.fail(card.at, name + " has the number " + std::to_string(number));
        System system;
        system.card = card;
        system.first = first;
        system.form = name[5];
        if (!systems_.emplace(number, std::move(system)).second)
            source_.fail(card.at, "coordinate system " + std::to_string(number) + " is defined twice");
    }
    return true;
}

void BdfSystems::resolve(Index number, System& s) {
    if (s.open)
        source_.fail(s.card.at,
                     "coordinate system " + std::to_string(number) + " is given in itself, by way of others");
    s.open = true;
    Vec3 points[3];
    if (s.card.name[4] == '1') {
        for (std::size_t k = 0; k < 3; ++k)
            points[k] = place_(source_.integer(s.card, s.first + 1 + k, "a node of the system"), s.card);
    } else {
        const Index in = source_.integer(s.card, 1, "the system it is given in", 0);
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 x;
            for (std::size_t a = 0; a < 3; ++a)
                x[static_cast<Eigen::Index>(a)] = source_.real(s.card, 2 + 3 * k + a, "a coordinate");
            points[k] = basic(in, x, s.card.at);
        }
    }
    const Vec3 up = points[1] - points[0], aside = points[2] - points[0], across = up.cross(aside);
    if (!(across.norm() > 1e-12 * up.norm() * aside.norm()) || up.norm() == 0)
        source_.fail(s.card.at, "the three points of coordinate system " + std::to_string(number) +
                                    " lie on a line; they have to span its plane");
    s.origin = points[0];
    s.axes.col(2) = up.normalized();
    s.axes.col(1) = across.normalized();
    s.axes.col(0) = s.axes.col(1).cross(s.axes.col(2));
    s.resolved = true;
    s.open = false;
}

Vec3 BdfSystems::basic(Index number, const Vec3& coordinates, const char* at) {
    if (number == 0) return coordinates;
    const auto found = systems_.find(number);
    if (found == systems_.end())
        source_.fail(at, "coordinate system " + std::to_string(number) + " is not defined in this file");
    System& system = found->second;
    if (!system.resolved) resolve(number, system);
    return system.origin + system.axes * cartesian_of_bdf(system.form, coordinates);
}

}  // namespace femscalpel
