// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/rounding.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

namespace femscalpel {
namespace {

/// Coordinates that are looked at, at most.
constexpr std::size_t sample = 6000;

/// A coordinate with fewer digits below the size of the mesh is simple, however far from the origin: it says nothing
/// about how the others were rounded.
constexpr int fewest_digits = 5;
/// One with more was not rounded to decimals.
constexpr int most_digits = 11;
/// A number of single precision that has as few decimal digits may as well be just that.
constexpr int digits_of_single = 8;

/// Parts of the coordinates that are not simple: from so many on they were rounded so; a last digit that so many of
/// these have is the file's (one in ten ends in a zero).
constexpr double noticed = 0.05, typical = 0.15;

/// Numbers that tell of those with one first digit.
constexpr int few = 3;

/// The files meant have six digits or more; in sizes of the mesh.
constexpr double coarsest = 1e-5;

struct Decimal {
    int digits;  ///< significant
    int last;    ///< power of ten of the last
};

/// The shortest decimal number that is read as `x`, which is not 0.
Decimal shortest(double x) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.begin(), text.end(), std::abs(x), std::chars_format::scientific).ptr;
    const std::string_view all(text.data(), static_cast<std::size_t>(end - text.data()));
    const std::size_t e = all.find('e');
    std::string_view mantissa = all.substr(0, e);
    int exponent = 0;
    const char* from = all.data() + e + 1;
    std::from_chars(*from == '+' ? from + 1 : from, all.data() + all.size(), exponent);
    while (mantissa.back() == '0') mantissa.remove_suffix(1);
    const int digits = static_cast<int>(std::ranges::count_if(mantissa, [](char c) { return c != '.'; }));
    return {digits, exponent - digits + 1};
}

}  // namespace

double coordinate_rounding(std::span<const Vec3> points) {
    if (points.empty()) return 0;
    Vec3 low = points[0], high = low;
    for (const Vec3& x : points) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double largest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()),
                 size = (high - low).maxCoeff();
    if (!(size > 0)) return 0;
    const int first_digit = static_cast<int>(std::floor(std::log10(size)));
    const std::size_t stride = std::max<std::size_t>(1, points.size() * 3 / sample);
    int telling = 0, singles = 0, decimals = 0;
    std::map<int, int> last_digits;
    std::map<int, std::map<int, int>> by_first;  // the same of those with one first digit
    for (std::size_t k = 0; k < points.size(); k += stride)
        for (int a = 0; a < 3; ++a) {
            const double x = points[k][a];
            // Small ones have digits that the large ones lack.
            if (!(std::abs(x) >= 0.1 * largest) || x == 0) continue;
            const Decimal d = shortest(x);
            if (std::min(d.digits, first_digit - d.last + 1) < fewest_digits) continue;
            ++telling;
            if (d.digits >= digits_of_single && static_cast<double>(static_cast<float>(x)) == x) ++singles;
            if (d.digits > most_digits) continue;
            ++decimals;
            ++last_digits[d.last];
            ++by_first[d.last + d.digits][d.last];
        }
    double rounding = 0;
    if (singles > noticed * telling) rounding = std::ldexp(largest, -24);
    if (decimals > noticed * telling)
        for (const auto& [last, count] : last_digits)
            if (count > typical * decimals) rounding = std::max(rounding, 0.5 * std::pow(10.0, last));
    // Where a file has so many significant digits, the last of the largest numbers is another, few as they may be.
    if (decimals > noticed * telling)
        for (const auto& [first, digits] : by_first) {
            int all = 0;
            for (const auto& [last, count] : digits) all += count;
            for (const auto& [last, count] : digits)
                if (count >= few && 2 * count > all) rounding = std::max(rounding, 0.5 * std::pow(10.0, last));
        }
    return std::min(rounding, coarsest * size);
}

double same_place(std::span<const Vec3> points, double rounding) {
    if (points.empty()) return 0;
    Eigen::AlignedBox3d box;
    for (const Vec3& x : points) box.extend(x);
    const double size = std::max(box.diagonal().norm(), box.min().cwiseAbs().maxCoeff());
    return std::max(2 * rounding, 1e-13 * size);
}

}  // namespace femscalpel
