// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/instance_placement.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "error.h"

namespace femscalpel {
namespace {

/// The numbers of the next data line; none at the end of the card.
std::vector<double> numbers_of_next_line(CardReader& line, std::size_t most, const std::string& what) {
    std::vector<double> out;
    if (!line.next_data_line()) return out;
    while (!line.at_end()) {
        double x = 0;
        if (!line.number(x)) throw ReadError(line.where() + "'" + line.field() + "' is not a finite number; " + what);
        out.push_back(x);
    }
    if (out.size() > most) throw ReadError(line.where() + "more than " + std::to_string(most) + " numbers; " + what);
    return out;
}

Vec3 vector_at(std::vector<double> numbers, std::size_t first) {
    numbers.resize(first + 3, 0.0);
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// Sine and cosine of an angle in degrees, exact where they are 0, 1 or -1.
std::pair<double, double> sine_and_cosine(double degrees) {
    const double turns = std::remainder(degrees, 360.0);
    if (turns == 0) return {0, 1};
    if (turns == 90) return {1, 0};
    if (turns == -90) return {-1, 0};
    if (std::abs(turns) == 180) return {0, -1};
    const double angle = turns * std::numbers::pi / 180;
    return {std::sin(angle), std::cos(angle)};
}

}  // namespace

Placement Placement::after(const Placement& inner) const {
    Placement out;
    out.turn = turn * inner.turn;
    out.shift = point(inner.shift);
    out.turns = turns || inner.turns;
    out.moves = moves || inner.moves;
    return out;
}

Placement placement_of_instance(const Card& card) {
    const std::string shift_line = "the translation of an instance is x, y, z",
                      axis_line =
                          "the rotation of an instance is two points of its axis and an angle in degrees: "
                          "xa, ya, za, xb, yb, zb, angle";
    CardReader line(card);
    std::vector<double> first = numbers_of_next_line(line, 7, shift_line), second;
    if (first.size() > 3) {  // a line left blank in place of the translation
        second = first;
        first.clear();
    } else if (!first.empty()) {
        second = numbers_of_next_line(line, 7, axis_line);
    }
    Placement out;
    out.shift = vector_at(first, 0);
    out.moves = out.shift != Vec3::Zero();
    if (!second.empty()) {
        if (second.size() != 7) throw ReadError(line.where() + "not 7 numbers; " + axis_line);
        const Vec3 a = vector_at(second, 0), along = vector_at(second, 3) - a;
        if (!(along.norm() > 0)) throw ReadError(line.where() + "the two points of the axis are one; " + axis_line);
        const auto [s, c] = sine_and_cosine(second[6]);
        if (c != 1) {
            const Vec3 k = along / along.norm();
            Eigen::Matrix3d cross;
            cross << 0, -k[2], k[1], k[2], 0, -k[0], -k[1], k[0], 0;
            out.turn = c * Eigen::Matrix3d::Identity() + s * cross + (1 - c) * k * k.transpose();
            out.shift = out.turn * (out.shift - a) + a;
            out.turns = out.moves = true;
        }
    }
    if (line.next_data_line())
        throw ReadError(line.where() +
                        "an instance has a line with its translation and one with its rotation, no more");
    return out;
}

Placement placement_of_system(const Card& card) {
    const std::string lines =
        "*SYSTEM has a line with the origin and a point on the first axis, and one with a point "
        "in the plane of the first two";
    CardReader line(card);
    const std::vector<double> first = numbers_of_next_line(line, 6, lines);
    const std::vector<double> second = numbers_of_next_line(line, 3, lines);
    Placement out;
    const Vec3 a = vector_at(first, 0);
    out.shift = a;
    if (first.size() > 3) {
        Vec3 x = vector_at(first, 3) - a, z = Vec3::UnitZ();
        if (second.empty())
            x[2] = 0;
        else
            z = x.cross(vector_at(second, 0) - a);
        if (!(x.norm() > 0) || !(z.norm() > 0))
            throw ReadError(card.where() + ": the points of *SYSTEM span no coordinate system");
        x.normalize();
        z.normalize();
        out.turn.col(0) = x;
        out.turn.col(1) = z.cross(x);
        out.turn.col(2) = z;
        out.turns = out.turn != Eigen::Matrix3d::Identity();
    }
    out.moves = out.turns || a != Vec3::Zero();
    return out;
}

}  // namespace femscalpel
