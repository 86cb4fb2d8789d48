// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cutting/wall.h"
#include "deformation/fitted_tool.h"

namespace femscalpel {

/// Where a wall is to go.
struct WallMotion {
    const char* parameter = "";           ///< of the operator, for messages
    const Tool* onto = nullptr;           ///< there, or else:
    Similarity carried = {};              ///< every point so
    std::vector<const Tool*> tools = {};  ///< by patch: the surface that it will lie on; null if its own shape is
                                          ///< carried instead
    std::vector<char> follows = {};       ///< by patch: Wall::Patch::follows
    /// Takes from a motion what runs along the wall everywhere, which does not change it.
    Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
    std::vector<std::unique_ptr<Tool>> own = {};  ///< those of `tools` that were made for it
};

/// Finds the surfaces that the patches of a wall will lie on: `onto`, or, where a patch is a plane, a cylinder or a
/// sphere, that one carried. (Of a shell's border, straight lines and circles.)
void find_tools(const Workpiece& f, const Wall& wall, WallMotion& motion);

/// Where the nodes of a wall end: each on the surfaces of its patches (or carried, where they have none), and on what
/// else it keeps to. Where that leads a node elsewhere than the motion alone, others around it go along.
class WallGoals {
public:
    /// Throws ToolError naming the parameter and a node that cannot get there.
    WallGoals(const Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh);

    const Vec3& operator[](int node) const { return goal_[node]; }

    /// The surfaces of a node's patches.
    Contact tools(int node) const;

    /// To be called when nodes were born: those on edges of the wall get their goals.
    void add_nodes();

private:
    std::optional<Vec3> place(int node, const Vec3& guess) const;
    int freedom(int node) const;
    bool follows(int node) const;
    void place_following(const Wall& wall);
    void spread(const std::vector<int>& nodes, int known_freedom);
    [[noreturn]] void refuse(int node) const;

    const Workpiece& f_;
    const WallMotion& motion_;
    std::vector<Vec3> goal_;   // by band node; nothing for those that are not on the wall
    std::vector<Vec3> plain_;  // likewise: where the motion alone would lead
    const Mesh& mesh_;
};

}  // namespace femscalpel
