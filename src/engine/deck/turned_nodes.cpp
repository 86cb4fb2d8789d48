// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/turned_nodes.h"

#include <Eigen/Geometry>
#include <cmath>

namespace femscalpel {
namespace {

/// The part of v across the unit vector e.
Vec3 across(const Vec3& v, const Vec3& e) { return v - v.dot(e) * e; }

/// CalculiX's choice on the axis.
Vec3 any_across(const Vec3& axis) {
    constexpr double nothing = 1e-10;
    if (std::abs(axis.x()) > nothing) return {-axis.y() / axis.x(), 1, 0};
    if (std::abs(axis.y()) > nothing) return {0, -axis.z() / axis.y(), 1};
    return {1, 0, -axis.x() / axis.z()};
}

}  // namespace

TurnedNodes::TurnedNodes(const Mesh& mesh) : mesh_(mesh) {
    const SolverInput* const input = solver_input(mesh);
    if (!input) return;
    std::optional<DeckView> deck;
    for (const Card& card : input->cards()) {
        const std::string* const set = card.keyword == "TRANSFORM" ? card.parameter("NSET") : nullptr;
        if (!set) continue;
        if (!deck) deck.emplace(mesh);
        const auto group = deck->group(DeckSetType::nset, *set);
        if (!group) continue;
        for (const Index number : deck->members(*group)) system_of_[number] = systems_.size();
        systems_.push_back(read(card));
    }
    if (!system_of_.empty()) numbers_.emplace(mesh);
}

TurnedNodes::System TurnedNodes::read(const Card& card) {
    System out;
    out.is_cylinder = type_of(card).starts_with('C');
    CardReader line(card);
    out.is_readable = line.next_data_line();
    out.where = out.is_readable ? line.where() : card.where() + ": ";
    for (Vec3& x : out.points)
        for (int k = 0; k < 3 && out.is_readable; ++k) {
            x[k] = 0;
            if (!line.at_end()) out.is_readable = line.number(x[k]);
        }
    return out;
}

std::optional<Eigen::Matrix3d> TurnedNodes::axes(Index number) const {
    const auto found = system_of_.find(number);
    if (found == system_of_.end()) return Eigen::Matrix3d::Identity();
    const System& s = systems_[found->second];
    const auto node = numbers_->node(number);
    if (!s.is_readable || !node) return {};
    Vec3 e1, e2, e3;
    if (s.is_cylinder) {
        e3 = s.points[1] - s.points[0];
        if (!(e3.norm() > 0)) return {};
        e3.normalize();
        e1 = across(mesh_.points[static_cast<std::size_t>(*node)] - s.points[0], e3);
        if (e1.norm() < 1e-10) e1 = any_across(e3);
        e1.normalize();
        e2 = e3.cross(e1);
    } else {
        e1 = s.points[0];
        if (!(e1.norm() > 0)) return {};
        e1.normalize();
        e2 = across(s.points[1], e1);
        if (!(e2.norm() > 1e-12 * s.points[1].norm())) return {};
        e2.normalize();
        e3 = e1.cross(e2);
    }
    Eigen::Matrix3d out;
    out << e1, e2, e3;
    return out;
}

}  // namespace femscalpel
