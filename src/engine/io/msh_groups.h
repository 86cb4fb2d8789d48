// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// The physical groups of a Gmsh file as groups of the mesh that is made of it, see read_msh(). Physical groups of one
/// name are one group; those without a name are called PhysicalPoint7, PhysicalLine7, PhysicalSurface7,
/// PhysicalVolume7, by their tag, as Gmsh itself calls them in other formats.
class MshGroups {
public:
    /// `mesh` must outlive this.
    explicit MshGroups(Mesh& mesh) : mesh_(mesh) {}

    /// The tags of those physical groups of points that are node groups; without this call all are.
    void set_node_groups(std::vector<Index> tags) { node_tags_ = std::move(tags); }

    /// Names a physical group; all names come before what follows. False if it has another name already.
    bool name(int dimension, Index tag, std::string_view name);
    /// Makes the groups that have names, in the order of these, which may stay empty.
    void make_named();

    /// The family of elements in these physical groups; signs do not matter, 0 is none. 0 for points in node groups.
    FamilyIndex elements(int dimension, std::span<const Index> tags);
    /// The family of the nodes in these physical groups of points.
    FamilyIndex nodes(std::span<const Index> tags);

    /// How many physical groups had members.
    bool any() const { return any_; }

private:
    bool is_node_group(int dimension, Index tag) const;
    GroupIndex group(int dimension, Index tag, GroupKind kind);
    FamilyIndex family(int dimension, std::span<const Index> tags, GroupKind kind);

    using Key = std::pair<int, Index>;  // dimension and tag
    Mesh& mesh_;
    std::optional<std::vector<Index>> node_tags_;
    std::map<Key, std::string> names_;
    std::vector<Key> order_;
    std::map<Key, GroupIndex> known_;
    std::unordered_map<std::string, GroupIndex> by_name_[2];  // by GroupKind
    bool any_ = false;
};

}  // namespace femscalpel
