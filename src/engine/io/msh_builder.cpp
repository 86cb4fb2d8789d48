// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/msh_builder.h"

#include <algorithm>

#include "error.h"
#include "io/msh_types.h"

namespace femscalpel {

std::array<std::array<std::int8_t, 27>, cell_type_count> MshBuilder::orders() {
    std::array<std::array<std::int8_t, 27>, cell_type_count> out;
    for (const CellTraits& t : all_cell_types()) out[static_cast<std::size_t>(t.type)] = msh_type(t.type).order;
    return out;
}

void MshBuilder::start_nodes(Index count) {
    if (numbers_ || has_elements_) source_.fail("there is a second section of nodes");
    const auto n = static_cast<std::size_t>(count);
    mesh_.points.reserve(n);
    mesh_.node_ids.reserve(n);
    mesh_.node_families.reserve(n);
}

void MshBuilder::end_nodes() {
    if (mesh_.points.empty()) source_.fail("there are no nodes in this file");
    numbers_.emplace(mesh_);
    SparseCheck check(1 << 14);
    for (Index i = 0; i < mesh_.node_count(); ++i, check()) {
        const Index number = mesh_.node_ids[static_cast<std::size_t>(i)];
        if (*numbers_->node(number) != i) throw RepeatedNumber{.node = number};
    }
}

void MshBuilder::start_elements() {
    if (!numbers_) source_.fail("the elements come before the nodes");
    if (has_elements_) source_.fail("there is a second section of elements");
    has_elements_ = true;
}

CellType MshBuilder::type(Index number) const {
    if (const auto found = cell_type_of_msh(number)) return *found;
    const std::string known = msh_type_description(number);
    throw UnsupportedElementError(source_.where() + "elements of Gmsh's type " + std::to_string(number) +
                                  (known.empty() ? "" : " (" + known + ")") +
                                  ", which FemScalpel cannot hold; save the mesh with elements of first or second "
                                  "order (Mesh.ElementOrder in Gmsh)");
}

void MshBuilder::reserve(CellType type, Index count) {
    CellBlock& block = mesh_.block(type);
    const auto wanted = block.ids.size() + static_cast<std::size_t>(count);
    if (wanted <= block.ids.capacity()) return;
    const std::size_t room = std::max(wanted, 2 * block.ids.capacity());
    block.ids.reserve(room);
    block.families.reserve(room);
    block.connectivity.reserve(room * static_cast<std::size_t>(traits(type).nodes));
}

void MshBuilder::missing_node(Index element, Index node) const {
    source_.fail("element " + std::to_string(element) + " names node " + std::to_string(node) +
                 ", which the file does not define");
}

void MshBuilder::meet(bool& met, const char* what, Index number) const {
    if (met) source_.fail(std::string(what) + " number " + std::to_string(number) + " is used twice");
    met = true;
}

void MshBuilder::turn_last(CellType type) {
    CellBlock& block = mesh_.block(type);
    const auto count = static_cast<std::size_t>(traits(type).nodes);
    Index* nodes = block.connectivity.data() + (block.connectivity.size() - count);
    const auto from = turned_round(type);
    std::array<Index, 27> before;
    std::copy_n(nodes, count, before.begin());
    for (std::size_t k = 0; k < count; ++k) nodes[k] = before[from[k]];
}

void MshBuilder::add_to_groups(Index node, FamilyIndex family) {
    FamilyIndex& now = mesh_.node_families[static_cast<std::size_t>(node)];
    if (now != family) now = now == 0 ? family : mesh_.families.unite(now, family);
}

Mesh MshBuilder::finish() {
    if (!numbers_) throw ReadError(source_.shown() + ": there are no nodes in this file");
    const NumberIndex numbers(mesh_);
    SparseCheck check(1 << 14);
    for (const CellBlock& block : mesh_.blocks())
        for (Index c = 0; c < block.size(); ++c, check()) {
            const Index number = block.ids[static_cast<std::size_t>(c)];
            if (*numbers.cell(number) != CellRef{block.type, c}) throw RepeatedNumber{.element = number};
        }
    compact_families(mesh_);
    return std::move(mesh_);
}

}  // namespace femscalpel
