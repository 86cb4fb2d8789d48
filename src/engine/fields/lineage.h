// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/changes.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Where the nodes and elements of a result come from, as fields have to know it: of every element the one of the input
/// that it is, or is a part of, and of every node that is new or moved the element of the input it lies in. That is
/// looked for among those whose parts have the node, so that where nodes are double - contact, an earlier crack - each
/// side keeps to its own.
class FieldLineage {
public:
    /// A node that is new or has moved, where a field of the input has its value.
    struct Made {
        Index node;                                           ///< in `after`
        std::vector<std::pair<Index, double>> shares;         ///< nodes of `before`, by index
        std::vector<std::pair<Index, double>> corner_shares;  ///< the same by the element's corners alone
        double outside =
            0;  ///< how far it is off the input's elements, where their value at the nearest point is taken
        bool doubled = false;
    };
    static constexpr Index unknown = -1;
    static constexpr Index made = -2;

    /// `stages`: what changed, step by step, as far as it is known; elements that nothing is known of are looked for
    /// where they lie. Those of the group `added`, if given, are not the input's. All must outlive this.
    FieldLineage(const Mesh& before, const Mesh& after, std::span<const Changes> stages,
                 std::optional<GroupIndex> added);

    const Mesh& before() const { return before_; }
    const Mesh& after() const { return after_; }

    /// Index in `before` of each node of `after` whose value it has as it is: itself, unmoved, or what it doubles;
    /// `made` or `unknown` for others.
    const std::vector<Index>& nodes() const { return nodes_; }
    /// Whether a node of `after` has a number of its own that `before` has not, but the value of one unmoved.
    bool is_copy(Index node) const;
    /// Those that are `made`, in the order of `after`.
    const std::vector<Made>& made_nodes() const { return made_; }

    /// Index, in the block of parent_type(), of the element of `before` that each is or is a part of; `unknown` if
    /// none.
    struct Parent {
        CellType type = CellType::vertex;
        Index cell = unknown;
        bool same = false;  ///< itself, with its nodes where they were
    };
    const std::vector<Parent>& parents(CellType type) const { return parents_[static_cast<std::size_t>(type)]; }

    /// The element of `before` that a point is in, looked for from `start` on; on a border the one on the side of
    /// `towards`. `start` itself if there is none.
    CellRef element_at(CellRef start, const Vec3& point, const Vec3& towards);

    /// Shares of an element's nodes in a value at a point, as they are of Made; `off` becomes the larger of itself and
    /// how far the point is beyond what the element tells of. Nothing for an element of no size.
    static std::optional<std::vector<double>> shares_in(const Mesh& mesh, CellRef cell, const Vec3& point, double& off);

    /// An element of `before` and where a point is in it.
    struct Found;

private:
    void find_kept_nodes();
    void find_parents(std::span<const Changes> stages, std::optional<GroupIndex> added);
    void look_for(const std::vector<CellRef>& lost);
    bool is_same(const CellBlock& block, Index cell, CellRef was) const;
    void make_nodes(std::span<const Changes> stages);
    std::unordered_map<Index, std::vector<CellRef>> parents_around_made() const;
    void look_around(Found& found, const Vec3& point, bool also_outside);
    std::optional<Made> make(Index node, const std::vector<CellRef>& around);
    std::optional<Made> copy_in_place(Index node, const std::vector<CellRef>& around) const;

    const Mesh &before_, &after_;
    NumberIndex numbers_;  // of before_
    std::vector<Index> nodes_;
    std::array<std::vector<Parent>, cell_type_count> parents_;
    std::vector<Made> made_;
    std::unique_ptr<Adjacency> adjacency_;  // of before_, when it is needed
};

}  // namespace femscalpel
