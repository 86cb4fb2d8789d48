// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>

#include "io/msh_sections.h"

namespace femscalpel {

void MshSections::tell_two_sided() const {
    if (two_sided_ > 0)
        builder_.remark(source_.shown() + ": " + std::to_string(two_sided_) +
                        " elements are in physical groups of both signs, seen from both sides; they keep the nodes' "
                        "order they have");
}

bool Msh2Sections::read(std::string_view section) {
    if (section == "Nodes" || section == "ParametricNodes")
        read_nodes(section != "Nodes");
    else if (section == "Elements")
        read_elements();
    else
        return false;
    return true;
}

void Msh2Sections::read_nodes(bool parametric) {
    const Index count = source_.text_integer();
    if (source_.is_binary()) source_.rest_of_line();
    source_.expect(count, 4);
    builder_.start_nodes(count);
    for (Index i = 0; i < count; ++i) {
        const Index number = source_.integer();
        Vec3 point;
        for (int a = 0; a < 3; ++a) point[a] = source_.real();
        builder_.add_node(number, point);
        if (!parametric) continue;
        const Index dimension = source_.integer();
        source_.integer();  // the entity
        if (dimension < 0 || dimension > 3) source_.fail("there is no dimension " + std::to_string(dimension));
        for (Index k = 0; k < dimension % 3; ++k) source_.real();  // none in volumes
    }
    builder_.end_nodes();
    if (parametric) builder_.remark(source_.where() + "the nodes' parametric coordinates are not read");
}

void Msh2Sections::read_elements() {
    builder_.start_elements();
    const Index count = source_.text_integer();
    if (source_.is_binary()) source_.rest_of_line();
    source_.expect(count, 3);
    for (Index done = 0; done < count;) {
        if (!source_.is_binary()) {
            const Index number = source_.integer();
            const CellType type = builder_.type(source_.integer());
            read_element(type, source_.integer(), number);
            ++done;
            continue;
        }
        const CellType type = builder_.type(source_.integer());
        const Index follow = source_.integer(), tag_count = source_.integer();
        if (follow <= 0 || follow > count - done)
            source_.fail(std::to_string(follow) + " elements follow, but " + std::to_string(count - done) +
                         " are left of the " + std::to_string(count) + " that the section has");
        for (Index k = 0; k < follow; ++k) read_element(type, tag_count, source_.integer());
        done += follow;
    }
}

bool Msh2Sections::repeats_last(CellType type, Index entity, Index physical, std::span<const Index> nodes) const {
    if (type != last_.type || entity != last_.entity || last_.physical.empty()) return false;
    if (std::ranges::count(last_.physical, physical) > 0) return false;
    return std::ranges::is_permutation(nodes, last_.nodes);  // negative groups have them the other way round
}

void Msh2Sections::read_element(CellType type, Index tag_count, Index number) {
    source_.expect(tag_count, 1);
    if (tag_count < 0) source_.fail("the number of tags is negative");
    tags_.clear();
    for (Index k = 0; k < tag_count; ++k) tags_.push_back(source_.integer());
    if (tag_count > 2) ++partitioned_;
    const int dimension = traits(type).dimension;
    const Index signed_physical = tags_.empty() ? 0 : tags_[0], entity = tags_.size() < 2 ? 0 : tags_[1];
    const Index physical = std::abs(signed_physical);
    const bool turned = signed_physical < 0 && (dimension == 1 || dimension == 2);
    std::array<Index, 27> all;
    const std::span<Index> nodes = std::span(all).first(static_cast<std::size_t>(traits(type).nodes));
    builder_.read_short_nodes(number, nodes);
    if (type == CellType::vertex)
        if (const FamilyIndex family = builder_.groups().nodes({&physical, 1})) {
            builder_.add_to_groups(nodes[0], family);
            return;
        }
    const FamilyIndex family = builder_.groups().elements(dimension, {&physical, 1});
    if (physical != 0 && repeats_last(type, entity, physical, nodes)) {
        FamilyIndex& of_first = builder_.mesh().block(type).families.back();
        of_first = builder_.mesh().families.unite(of_first, family);
        last_.physical.push_back(physical);
        ++repeated_;
        if (!std::ranges::equal(nodes, last_.nodes)) ++two_sided_;
        return;
    }
    builder_.add_element(type, number, nodes, family);
    if (turned) builder_.turn_last(type);
    last_.type = type;
    last_.entity = entity;
    last_.physical.assign(physical == 0 ? 0 : 1, physical);
    last_.nodes.assign(nodes.begin(), nodes.end());
}

void Msh2Sections::finish() {
    if (repeated_ > 0)
        builder_.remark(source_.shown() + ": " + std::to_string(repeated_) +
                        " elements repeat the one before them in another physical group, as files of version 2 do; "
                        "each is one element, with the number it has first");
    if (partitioned_ > 0)
        builder_.remark(source_.shown() + ": the partitions of " + std::to_string(partitioned_) +
                        " elements are not read");
    tell_two_sided();
}

}  // namespace femscalpel
