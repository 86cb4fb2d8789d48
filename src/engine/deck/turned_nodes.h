// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "deck/deck_view.h"

namespace femscalpel {

/// Nodes whose degrees of freedom are in the local directions of a *TRANSFORM card, of several the last.
class TurnedNodes {
public:
    /// None without a deck. Of a set that the deck does not have, nothing is turned.
    explicit TurnedNodes(const Mesh& mesh);

    bool contains(Index number) const { return system_of_.contains(number); }

    /// The local directions 1 to 3 of a node as columns; the global ones of a node that is not turned. As in CalculiX
    /// an arbitrary radial direction on the axis of a cylindrical system. None where the card does not make sense, or
    /// the mesh has no such node.
    std::optional<Eigen::Matrix3d> axes(Index number) const;

    /// "deck.inp:12: ", the card of a node that is turned.
    const std::string& where(Index number) const { return systems_[system_of_.at(number)].where; }

private:
    struct System {
        bool is_cylinder = false;
        bool is_readable = true;
        std::array<Vec3, 2> points;
        std::string where;
    };
    static System read(const Card& card);

    const Mesh& mesh_;
    std::optional<NumberIndex> numbers_;
    std::vector<System> systems_;
    std::unordered_map<Index, std::size_t> system_of_;
};

}  // namespace femscalpel
