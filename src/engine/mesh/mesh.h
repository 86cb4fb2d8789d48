// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"
#include "mesh/cell_type.h"
#include "mesh/family_table.h"

namespace femscalpel {

class Companion;
struct Fields;

/// Numbers, counts and indices of nodes and elements.
using Index = std::int64_t;
/// The largest number of a node or element: operators count on from the largest in use.
inline constexpr Index largest_number = Index{1} << 62;
/// A point or vector, in the mesh's unit.
using Vec3 = Eigen::Vector3d;

/// What a group's members are.
enum class GroupKind : std::uint8_t { node, element, facet };

/// "node", "element" or "facet".
std::string_view to_string(GroupKind kind);

/// A named set of entities. Its members are stored with the entities, as families.
struct Group {
    std::string name;
    GroupKind kind = GroupKind::node;
    /// Not the user's: bookkeeping of a file format (which card an element stands under). Inherited
    /// like any group, but constrains nothing, is not reported and only its own format writes it.
    bool hidden = false;
};

/// All elements of one type.
struct CellBlock {
    CellType type = CellType::vertex;
    std::vector<Index> connectivity;    ///< size() x nodes per element, indices into Mesh::points
    std::vector<Index> ids;             ///< element numbers, unique in the mesh
    std::vector<FamilyIndex> families;  ///< one per element

    Index size() const { return static_cast<Index>(ids.size()); }
    std::span<const Index> nodes(Index cell) const {
        const auto n = static_cast<std::size_t>(traits(type).nodes);
        return {connectivity.data() + static_cast<std::size_t>(cell) * n, n};
    }
};

/// A face of an element, as in a CalculiX *SURFACE, TYPE=ELEMENT.
/// `face` is the solver's local number from 1. For volume elements it is CalculiX's face number. For
/// triangles and quadrangles it is that of a shell: 1 = negative side, 2 = positive side, 3.. = the edges.
struct Facet {
    CellType type = CellType::tetra;
    std::int8_t face = 1;
    FamilyIndex family = 0;
    Index cell = 0;  ///< index into the block of `type`
};

/// A finite-element mesh with numbers and groups.
///
/// Plain data: the algorithms are free functions. Invariants, checked by validate(): node and element
/// numbers are unique and positive, connectivity and families are in range, coordinates are finite.
class Mesh {
public:
    std::vector<Vec3> points;                ///< node coordinates, in the mesh's own unit
    std::vector<Index> node_ids;             ///< node numbers
    std::vector<FamilyIndex> node_families;  ///< one per node
    std::vector<Facet> facets;               ///< those that belong to facet groups
    std::vector<Group> groups;
    FamilyTable families;
    std::string name = "mesh";
    std::string unit;  ///< unit of the coordinates as a file states it, may be empty
    /// What the file this mesh was read from holds and the mesh does not, a line each, with the file's name.
    std::vector<std::string> remarks;
    /// What the file this mesh was read from says besides, if there is any (mesh/companion.h).
    std::shared_ptr<const Companion> companion;
    /// Values on nodes and elements (fields/field.h); null where there are none. They go with numbers, so that copies
    /// can share them while they are changed.
    std::shared_ptr<const Fields> fields;

    CellBlock& block(CellType type) { return blocks_[static_cast<int>(type)]; }
    const CellBlock& block(CellType type) const { return blocks_[static_cast<int>(type)]; }
    std::span<CellBlock> blocks() { return blocks_; }
    std::span<const CellBlock> blocks() const { return blocks_; }

    Mesh();

    Index node_count() const { return static_cast<Index>(points.size()); }
    Index cell_count() const;
    /// Largest dimension of any element; -1 without elements.
    int dimension() const;

    /// Appends a node and returns its index.
    Index add_node(const Vec3& point, Index id, FamilyIndex family = 0);
    /// Appends an element and returns its index in the block of `type`.
    Index add_cell(CellType type, std::span<const Index> nodes, Index id, FamilyIndex family = 0);

    Index largest_node_id() const;
    Index largest_cell_id() const;

    /// Index of the group called `name` (hidden ones only if `hidden`), or none. Names are unique
    /// within a kind, not across kinds: MED and CalculiX both allow a node set and an element set of
    /// one name. Without `kind` the first match is returned.
    std::optional<GroupIndex> find_group(std::string_view name, std::optional<GroupKind> kind = {},
                                         bool hidden = false) const;

    /// Appends an empty group; throws Error when a group of that name and kind exists.
    GroupIndex add_group(std::string name, GroupKind kind, bool hidden = false);

    /// Throws Error where a number of a node or element is larger than largest_number.
    void check_numbers() const;

    /// Throws Error that names the first offending node, element or group.
    void validate() const;

private:
    std::array<CellBlock, cell_type_count> blocks_;
};

/// Where an element number is found.
struct CellRef {
    CellType type;
    Index cell;
    friend bool operator==(const CellRef&, const CellRef&) = default;
};

/// Numbers to indices for all nodes and elements of a mesh. Linear time; a flat table where numbers
/// are dense, a hash map otherwise.
class NumberIndex {
public:
    explicit NumberIndex(const Mesh& mesh);
    ~NumberIndex();
    NumberIndex(NumberIndex&&) noexcept;

    std::optional<Index> node(Index id) const;
    std::optional<CellRef> cell(Index id) const;

private:
    struct Tables;
    std::unique_ptr<Tables> tables_;
};

/// Members of one group: node or element numbers, or (element number, face) pairs for a facet group.
struct GroupMembers {
    GroupKind kind = GroupKind::node;
    std::vector<Index> ids;    ///< numbers, in mesh order
    std::vector<Index> faces;  ///< facet groups only: local face per entry of ids
};

/// Members of group `group`; linear in the mesh.
GroupMembers group_members(const Mesh& mesh, GroupIndex group);

/// Replaces the members of group `group`. Throws Error that names the group and the first number the
/// mesh does not have.
void set_group_members(Mesh& mesh, GroupIndex group, const GroupMembers& members);

/// Assigns the members of many groups at once, replacing all memberships of the mesh: linear in the
/// mesh plus the total number of members. `members[g]` goes with `mesh.groups[g]`.
void assign_groups(Mesh& mesh, std::span<const GroupMembers> members);

/// Gives a group another name, also in what the mesh's companion says of it. Throws Error when another group of its
/// kind has that name.
void rename_group(Mesh& mesh, GroupIndex group, const std::string& name);

/// Removes a group and its memberships; indices of later groups drop by one.
void remove_group(Mesh& mesh, GroupIndex group);

/// Removes all groups with gone[group] and their memberships, in one pass over the mesh.
void remove_groups(Mesh& mesh, const std::vector<bool>& gone);

/// Drops families no entity uses any more.
void compact_families(Mesh& mesh);

}  // namespace femscalpel
