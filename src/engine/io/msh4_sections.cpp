// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cstdlib>

#include "io/msh_sections.h"
#include "io/msh_types.h"

namespace femscalpel {
namespace {

/// Fails for tags that no file can mean: Gmsh's are of 32 bits.
Index checked_msh_tag(const MshSource& source, Index tag) {
    if (std::abs(tag) > 2147483647) source.fail("the tag " + std::to_string(tag) + " is too large");
    return tag;
}

}  // namespace

bool Msh4Sections::read(std::string_view section) {
    if (section == "Entities" || section == "PartitionedEntities")
        read_entities(section != "Entities");
    else if (section == "Nodes")
        read_nodes();
    else if (section == "Elements")
        read_elements();
    else
        return false;
    return true;
}

void Msh4Sections::read_entities(bool partitioned) {
    if (partitioned) {
        partitions_ = source_.size();
        const Index ghosts = source_.size();
        source_.expect(ghosts, 2);
        for (Index k = 0; k < 2 * ghosts; ++k) source_.integer();
    }
    std::array<Index, 4> counts;
    for (Index& count : counts) source_.expect(count = source_.size(), 5);
    SparseCheck check(1 << 12);
    for (int d = 0; d <= 3; ++d)
        for (Index k = 0; k < counts[static_cast<std::size_t>(d)]; ++k, check()) read_entity(d, partitioned);
}

void Msh4Sections::read_entity(int dimension, bool partitioned) {
    const Index tag = source_.integer();
    Index parent_dimension = dimension;
    if (partitioned) {
        parent_dimension = source_.integer();
        source_.integer();  // the parent's tag
        const Index in = source_.size();
        source_.expect(in, 1);
        for (Index k = 0; k < in; ++k) source_.integer();
    }
    for (int k = 0; k < (dimension == 0 && minor_ > 0 ? 3 : 6); ++k) source_.skip_real();
    std::vector<Index> physical;
    const Index groups = source_.size();
    source_.expect(groups, 1);
    for (Index k = 0; k < groups; ++k) physical.push_back(checked_msh_tag(source_, source_.integer()));
    std::erase(physical, 0);
    if (dimension > 0) {
        const Index bounds = source_.size();
        source_.expect(bounds, 1);
        for (Index k = 0; k < bounds; ++k) source_.integer();
    }
    Entity entity;
    if (parent_dimension == dimension) {
        const auto negative = std::ranges::count_if(physical, [](Index t) { return t < 0; });
        entity.elements = builder_.groups().elements(dimension, physical);
        if (dimension == 0) entity.nodes = builder_.groups().nodes(physical);
        const bool has_sides = dimension == 1 || dimension == 2;
        entity.turned = has_sides && negative > 0 && negative == std::ssize(physical);
        entity.two_sided = has_sides && negative > 0 && !entity.turned;
    } else {
        ++interfaces_;  // it repeats the groups of its parent, which are of another dimension
    }
    ++entity_count_;
    if (!entities_[static_cast<std::size_t>(dimension)].emplace(tag, entity).second)
        source_.fail("the entity of dimension " + std::to_string(dimension) + " and tag " + std::to_string(tag) +
                     " is there twice");
}

Msh4Sections::Entity* Msh4Sections::find(Index dimension, Index tag) {
    auto& of_dimension = entities_[static_cast<std::size_t>(dimension)];
    const auto it = of_dimension.find(tag);
    return it == of_dimension.end() ? nullptr : &it->second;
}

int Msh4Sections::dimension() {
    const Index value = source_.integer();
    if (value < 0 || value > 3) source_.fail("there is no dimension " + std::to_string(value));
    return static_cast<int>(value);
}

Index Msh4Sections::block_size(Index left, const char* what) {
    const Index count = source_.size();
    if (count > left)
        source_.fail("a block of " + std::to_string(count) + " " + what + ", but " + std::to_string(left) +
                     " are left of those that the section says it has");
    return count;
}

void Msh4Sections::read_nodes() {
    const Index blocks = source_.size(), count = source_.size();
    if (minor_ > 0) {
        source_.size();  // smallest number
        source_.size();  // largest number
    }
    source_.expect(count, 4);
    builder_.start_nodes(count);
    std::vector<Index> numbers;
    Index done = 0;
    for (Index b = 0; b < blocks; ++b) {
        const auto [d, tag] = entity();
        const bool parametric = source_.integer() != 0;
        const Index here = block_size(count - done, "nodes");
        if (d == 0 && here > 0) point_nodes_.push_back({tag, done, done + here});
        parametric_ = parametric_ || (parametric && d > 0 && here > 0);
        numbers.resize(minor_ > 0 ? static_cast<std::size_t>(here) : 0);
        for (Index& number : numbers) number = source_.size();
        for (Index k = 0; k < here; ++k) {
            const Index number = minor_ > 0 ? numbers[static_cast<std::size_t>(k)] : source_.integer();
            Vec3 point;
            for (int a = 0; a < 3; ++a) point[a] = source_.real();
            for (Index a = 0; parametric && a < d; ++a) source_.skip_real();
            builder_.add_node(number, point);
        }
        done += here;
    }
    if (done != count)
        source_.fail("the blocks have " + std::to_string(done) + " nodes, but the section says " +
                     std::to_string(count));
    builder_.end_nodes();
}

/// Dimension and tag of the entity that a block is of; 4.0 has them the other way round.
std::pair<int, Index> Msh4Sections::entity() {
    if (minor_ > 0) {
        const int d = dimension();
        return {d, source_.integer()};
    }
    const Index tag = source_.integer();
    return {dimension(), tag};
}

void Msh4Sections::read_elements() {
    builder_.start_elements();
    const Index blocks = source_.size(), count = source_.size();
    if (minor_ > 0) {
        source_.size();  // smallest number
        source_.size();  // largest number
    }
    source_.expect(count, 2);
    Index done = 0;
    for (Index b = 0; b < blocks; ++b) {
        const auto [d, tag] = entity();
        const CellType type = builder_.type(source_.integer());
        if (traits(type).dimension != d)
            source_.fail("elements of type " + std::string(traits(type).name) + " in an entity of dimension " +
                         std::to_string(d));
        const Index here = block_size(count - done, "elements");
        Entity* entity = find(d, tag);
        if (entity && here > 0) entity->filled = true;
        read_block(entity ? *entity : Entity(), type, here);
        done += here;
    }
    if (done != count)
        source_.fail("the blocks have " + std::to_string(done) + " elements, but the section says " +
                     std::to_string(count));
}

void Msh4Sections::read_block(const Entity& entity, CellType type, Index count) {
    std::array<Index, 27> all;
    const std::span<Index> nodes = std::span(all).first(static_cast<std::size_t>(traits(type).nodes));
    source_.expect(count, std::ssize(nodes) + 1);
    const bool members = type == CellType::vertex && entity.nodes != 0;
    const bool elements = !members || entity.elements != 0;
    if (entity.two_sided) two_sided_ += count;
    if (elements) builder_.reserve(type, count);
    for (Index k = 0; k < count; ++k) {
        const Index number = source_.size();
        builder_.read_nodes(number, nodes);
        if (members) builder_.add_to_groups(nodes[0], entity.nodes);
        if (elements) builder_.add_element(type, number, nodes, entity.elements);
        if (entity.turned) builder_.turn_last(type);
    }
}

void Msh4Sections::finish() {
    for (const PointNodes& p : point_nodes_) {
        const Entity* entity = find(0, p.entity);
        if (!entity || entity->nodes == 0 || entity->filled) continue;
        for (Index n = p.first; n < p.end; ++n) builder_.add_to_groups(n, entity->nodes);
    }
    if (parametric_) builder_.remark(source_.shown() + ": the nodes' parametric coordinates are not read");
    if (partitions_ > 0)
        builder_.remark(source_.shown() + ": which of the " + std::to_string(partitions_) +
                        " partitions elements are in is not read");
    if (interfaces_ > 0)
        builder_.remark(source_.shown() + ": " + std::to_string(interfaces_) +
                        " entities are interfaces of partitions; their elements are in no group");
    if (!builder_.groups().any() && entity_count_ > 1)
        builder_.remark(source_.shown() + ": no element is in a physical group; the " + std::to_string(entity_count_) +
                        " geometrical entities that elements and nodes stand in did not become groups");
    tell_two_sided();
}

}  // namespace femscalpel
