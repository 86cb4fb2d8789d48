// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "io/msh_builder.h"

namespace femscalpel {

/// What differs between the versions of Gmsh's format: the sections of nodes, elements and entities.
class MshSections {
public:
    MshSections(MshSource& source, MshBuilder& builder) : source_(source), builder_(builder) {}
    virtual ~MshSections() = default;
    MshSections(const MshSections&) = delete;
    MshSections& operator=(const MshSections&) = delete;

    /// Reads the section the source is in; false if it is none of these, nothing read then.
    virtual bool read(std::string_view section) = 0;
    /// After the last section: groups that follow from all of them, and remarks.
    virtual void finish() = 0;

protected:
    MshSource& source_;
    MshBuilder& builder_;
    Index two_sided_ = 0;  // elements that are in groups of both signs

    /// A remark on two_sided_.
    void tell_two_sided() const;
};

/// Versions 2.1 and 2.2: every element has its physical group, and stands once in each of them.
class Msh2Sections : public MshSections {
public:
    using MshSections::MshSections;
    bool read(std::string_view section) override;
    void finish() override;

private:
    void read_nodes(bool parametric);
    void read_elements();
    void read_element(CellType type, Index tag_count, Index number);
    bool repeats_last(CellType type, Index entity, Index physical, std::span<const Index> nodes) const;

    /// What was read last, of which the next may be a repetition.
    struct Last {
        CellType type = CellType::vertex;
        Index entity = -1;
        std::vector<Index> physical;
        std::vector<Index> nodes;
    } last_;
    std::vector<Index> tags_;
    Index repeated_ = 0;     // elements that were repetitions
    Index partitioned_ = 0;  // elements with partitions
};

/// Versions 4.0 and 4.1: physical groups belong to the entities in which nodes and elements stand.
class Msh4Sections : public MshSections {
public:
    /// `minor`: 0 or 1.
    Msh4Sections(MshSource& source, MshBuilder& builder, int minor) : MshSections(source, builder), minor_(minor) {}
    bool read(std::string_view section) override;
    void finish() override;

private:
    /// What the file says of an entity.
    struct Entity {
        FamilyIndex elements = 0;  ///< of its elements
        FamilyIndex nodes = 0;     ///< of the nodes of its point elements
        bool turned = false;       ///< all its groups are negative
        bool two_sided = false;    ///< some are
        bool filled = false;       ///< has point elements
    };
    /// Nodes that stand in an entity of dimension 0.
    struct PointNodes {
        Index entity, first, end;
    };

    void read_entities(bool partitioned);
    void read_entity(int dimension, bool partitioned);
    void read_nodes();
    void read_elements();
    void read_block(const Entity& entity, CellType type, Index count);
    Entity* find(Index dimension, Index tag);
    int dimension();
    std::pair<int, Index> entity();
    Index block_size(Index left, const char* what);

    int minor_;
    std::array<std::map<Index, Entity>, 4> entities_;
    std::vector<PointNodes> point_nodes_;
    bool parametric_ = false;  // nodes have parametric coordinates
    Index partitions_ = 0;     // how many
    Index interfaces_ = 0;     // entities between partitions, whose groups are those of another dimension
    Index entity_count_ = 0;
};

}  // namespace femscalpel
