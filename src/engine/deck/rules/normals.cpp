// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/normals.h"

#include <algorithm>

#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"

namespace femscalpel {

std::vector<Normals::Line> Normals::read(const Card& card) {
    std::vector<Line> out;
    CardReader line(card);
    Index element = 0, node = 0;
    while (line.next_data_line())
        if (line.integer(element) && line.integer(node)) out.push_back({line, element, node});
    return out;
}

void Normals::mark(std::size_t /*c*/, const Card& card, Marking& marking) {
    for (const Line& l : read(card)) marking.pin(l.node);
}

void Normals::carry(std::size_t c, const Card& card, Carrying& carrying) {
    for (const Line& l : read(card)) {
        if (!carrying.had_element(l.element)) continue;
        const std::vector<std::pair<Index, Index>> now = images(l, carrying);
        if (now == std::vector<std::pair<Index, Index>>{{l.element, l.node}}) continue;
        CardEdits& edits = carrying.edits(c);
        edits.drop(l.line);
        if (now.empty())
            carrying.remarks().add(c, Weight::problem, l.line.where(), the_element(l.element),
                                   "has no longer the node of its normal");
        for (const auto& [part, image] : now)
            edits.add_after(l.line,
                            std::to_string(part) + ", " + std::to_string(image) + "," + std::string(l.line.rest()));
    }
}

/// Parts of the element, and the node or copy of it that each has.
std::vector<std::pair<Index, Index>> Normals::images(const Line& line, const Carrying& carrying) {
    std::vector<Index> nodes{line.node};
    const auto& copies = carrying.origins().copies_of(line.node);
    nodes.insert(nodes.end(), copies.begin(), copies.end());
    const Mesh& after = carrying.after();
    std::vector<std::pair<Index, Index>> out;
    for (const Index part : carrying.parts_of(line.element)) {
        const CellRef cell = *carrying.new_numbers().cell(part);
        for (const Index n : after.block(cell.type).nodes(cell.cell))
            if (std::ranges::find(nodes, after.node_ids[n]) != nodes.end()) out.push_back({part, after.node_ids[n]});
    }
    return out;
}

}  // namespace femscalpel
