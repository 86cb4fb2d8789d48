// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Elements (face 0) or element faces, by number.
using Faces = std::vector<std::pair<Index, int>>;

/// What is in the hidden groups of elements and faces that were marked (marking.h).
class LoadedFaces {
public:
    /// Linear in `after` if there are such groups. Both meshes must outlive this.
    LoadedFaces(const Mesh& before, const Mesh& after);

    /// What a group has in the result, ascending.
    const Faces& now(const std::string& group) const;
    /// Whether a group lost area or volume. Elements that vanish in the work of an operator, their place taken by
    /// others of their groups, take no load with them. Linear in the meshes for each group that is asked for.
    bool shrank(const std::string& group);

private:
    const Mesh& before_;
    const Mesh& after_;
    std::map<std::string, Faces> now_;
    std::map<std::string, bool> shrank_;
};

}  // namespace femscalpel
