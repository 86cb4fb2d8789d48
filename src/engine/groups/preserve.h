// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// Which groups' boundaries an operator need not keep, by group index: the visible groups whose name is not in
/// `preserve`. Empty when `preserve` is absent: all are kept. A name stands for the groups of every kind that have it.
/// Throws ToolError that names the first name no group has.
std::vector<bool> drifting_groups(const Mesh& mesh, const std::optional<std::vector<std::string>>& preserve);

/// Where the boundaries of groups lie that may drift, to tell afterwards how far they went: their faces (BE and LE of
/// a 3-D mesh, but for shells, which stay what they are), the edges in LE or at the rim of such faces or of shells, and
/// the shortcuts of node groups through the material, faces and edges.
class DriftGauge {
public:
    /// `drifting` as drifting_groups() returns it; `band` before anything is done to it.
    DriftGauge(const BandMesh& band, const Mesh& mesh, std::vector<bool> drifting);

    /// Of the groups that do not drift only the shortcuts, which nothing keeps. `on_shortcuts` as for BandBoundaries.
    static DriftGauge of_shortcuts(const BandMesh& band, const Mesh& mesh, const std::vector<bool>& drifting,
                                   std::vector<Index> on_shortcuts);

    /// By group index: the largest distance of a node that moved or is new, and is on a face (an edge) of the group's
    /// boundary now, from the faces (edges) there were around it; of shortcuts that of nodes and middles from the
    /// nearest of both. 0 for groups that are not gauged.
    std::vector<double> drift(const BandMesh& now, const Mesh& mesh) const;

private:
    struct Piece {
        std::array<int, 3> nodes;  ///< of an edge, the last is there twice
        int kind;
        bool shortcut = false;
        bool through = false;  ///< the material: a shortcut, or what became of one
        bool is_edge() const { return nodes[1] == nodes[2]; }
    };
    DriftGauge(const BandMesh& band, const Mesh& mesh, std::vector<bool> ignored, std::vector<Index> on_shortcuts,
               bool only_shortcuts);

    /// Raises the drift of each of `groups` to the distance of `x`, which comes from nodes `ancestors`, from the old
    /// pieces there that `counts` picks.
    void measure(const Vec3& x, std::span<const int> ancestors, const std::set<GroupIndex>& groups,
                 bool (*counts)(const Piece&), std::vector<double>& drift) const;

    std::vector<Piece> pieces(const BandMesh& band, const Mesh& mesh, FamilyTable& kinds) const;

    std::vector<bool> ignored_;  // groups
    std::vector<Index> on_shortcuts_;
    bool only_shortcuts_ = false;
    FamilyTable kinds_;
    std::vector<Piece> old_;
    std::vector<Vec3> old_at_;
    std::vector<std::vector<int>> around_;  // old pieces at each node
};

}  // namespace femscalpel
