// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <map>
#include <string>

#include "io/bdf_source.h"

namespace femscalpel {

/// The coordinate systems of a Nastran deck.
class BdfSystems {
public:
    /// `place` gives a node's place in the basic system, by number; it may ask this for others.
    BdfSystems(const BdfSource& source, std::function<Vec3(Index node, const BdfCard& asked_by)> place)
        : source_(source), place_(std::move(place)) {}

    /// Takes a CORD1R, CORD2R, CORD1C, CORD2C, CORD1S or CORD2S card; false for other cards.
    bool add(const BdfCard& card);

    /// A place in the basic system from coordinates in system `number` (0: the same). `at`: who asks.
    Vec3 basic(Index number, const Vec3& coordinates, const char* at);

private:
    struct System {
        BdfCard card;
        std::size_t first = 0;  // of its fields in the card
        bool resolved = false, open = false;
        char form = 'R';
        Vec3 origin = Vec3::Zero();
        Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    };
    void resolve(Index number, System& system);

    const BdfSource& source_;
    std::function<Vec3(Index, const BdfCard&)> place_;
    std::map<Index, System> systems_;
};

}  // namespace femscalpel
