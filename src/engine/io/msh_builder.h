// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cancel.h"
#include "io/msh_groups.h"
#include "io/msh_source.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// A number that a file uses twice.
struct RepeatedNumber {
    Index node = 0;     ///< of a node, or 0
    Index element = 0;  ///< of an element, or 0
};

/// Puts a mesh together from what a Gmsh file says, whatever its version. Errors name the place where the source is.
class MshBuilder {
public:
    /// `sought`: a number, known to be used twice, whose second use is to be an error, told with its place.
    MshBuilder(MshSource& source, RepeatedNumber sought) : source_(source), sought_(sought), groups_(mesh_) {}
    MshBuilder(const MshBuilder&) = delete;
    MshBuilder& operator=(const MshBuilder&) = delete;

    MshGroups& groups() { return groups_; }
    Mesh& mesh() { return mesh_; }

    /// A section of nodes begins, of which there is one before all elements.
    void start_nodes(Index count);
    void add_node(Index tag, const Vec3& point) {
        check_();
        if (tag <= 0) source_.fail("node number " + std::to_string(tag) + " is not positive");
        if (tag == sought_.node) meet(sought_node_met_, "node", tag);
        mesh_.points.push_back(point);
        mesh_.node_ids.push_back(tag);
        mesh_.node_families.push_back(0);
    }
    /// Throws RepeatedNumber.
    void end_nodes();

    /// A section of elements begins, of which there is one.
    void start_elements();
    /// The type of that number; fails for those FemScalpel does not have.
    CellType type(Index number) const;
    /// Makes room for that many elements more.
    void reserve(CellType type, Index count);
    /// Reads the nodes of an element, in Gmsh's order, as indices.
    void read_nodes(Index element, std::span<Index> nodes) {
        for (Index& node : nodes) {
            const Index tag = source_.size();
            const auto found = numbers_->node(tag);
            if (!found) missing_node(element, tag);
            node = *found;
        }
    }
    /// The same for numbers of four bytes in binary.
    void read_short_nodes(Index element, std::span<Index> nodes) {
        for (Index& node : nodes) {
            const Index tag = source_.integer();
            const auto found = numbers_->node(tag);
            if (!found) missing_node(element, tag);
            node = *found;
        }
    }
    /// Adds an element with nodes in Gmsh's order.
    void add_element(CellType type, Index tag, std::span<const Index> nodes, FamilyIndex family) {
        check_();
        check_number(tag);
        CellBlock& block = mesh_.block(type);
        const auto& order = msh_order_[static_cast<std::size_t>(type)];
        const std::size_t first = block.connectivity.size();
        block.connectivity.resize(first + nodes.size());
        Index* out = block.connectivity.data() + first;
        for (std::size_t k = 0; k < nodes.size(); ++k) out[order[k]] = nodes[k];
        block.ids.push_back(tag);
        block.families.push_back(family);
    }
    /// Turns the last element of that type, of dimension 1 or 2, round.
    void turn_last(CellType type);
    /// Puts a node into the groups of that family, besides those it is in.
    void add_to_groups(Index node, FamilyIndex family);

    /// Tells of something that is not in the mesh.
    void remark(std::string text) { mesh_.remarks.push_back(std::move(text)); }
    /// The mesh. Throws RepeatedNumber.
    Mesh finish();

private:
    void check_number(Index tag) {
        if (tag <= 0) source_.fail("element number " + std::to_string(tag) + " is not positive");
        if (tag == sought_.element) meet(sought_element_met_, "element", tag);
    }
    void meet(bool& met, const char* what, Index number) const;
    [[noreturn]] void missing_node(Index element, Index node) const;

    MshSource& source_;
    RepeatedNumber sought_;
    bool sought_node_met_ = false, sought_element_met_ = false;
    bool has_elements_ = false;
    Mesh mesh_;
    MshGroups groups_;
    std::optional<NumberIndex> numbers_;  // of the nodes
    std::array<std::array<std::int8_t, 27>, cell_type_count> msh_order_ = orders();
    SparseCheck check_{1 << 14};

    static std::array<std::array<std::int8_t, 27>, cell_type_count> orders();
};

}  // namespace femscalpel
