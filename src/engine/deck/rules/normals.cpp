// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/normals.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "deck/rules/absent_numbers.h"
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

void Normals::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    for (const Line& l : read(card)) {
        numbers.name_element(l.line, l.element);
        numbers.name_node(l.line, l.node);
    }
}

void Normals::mark(std::size_t /*c*/, const Card& card, Marking& marking) {
    for (const Line& l : read(card)) marking.pin(l.node);
}

void Normals::carry(std::size_t c, const Card& card, Carrying& carrying) {
    const std::vector<Line> lines = read(card);
    add_between(c, lines, carrying);
    for (const Line& l : lines) {
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

/// Lines for the nodes of a divided beam that none of its lines names.
void Normals::add_between(std::size_t c, const std::vector<Line>& lines, Carrying& carrying) {
    struct End {
        Vec3 at, normal;
    };
    std::map<Index, std::vector<End>> ends;  // by element
    std::map<Index, const Line*> last;
    std::set<std::pair<Index, Index>> named;
    const Mesh& before = carrying.before();
    for (const Line& l : lines) {
        const auto cell = carrying.old().numbers().cell(l.element);
        const auto node = carrying.old().numbers().node(l.node);
        if (!cell || !node || traits(cell->type).dimension != 1 || !carrying.has_further_parts(l.element)) continue;
        CardReader rest = l.line;
        Vec3 normal;
        if (!rest.number(normal[0]) || !rest.number(normal[1]) || !rest.number(normal[2])) continue;
        ends[l.element].push_back({before.points[*node], normal.normalized()});
        last[l.element] = &l;
        for (const auto& image : images(l, carrying)) named.insert(image);
    }
    const Mesh& after = carrying.after();
    for (const auto& [element, given] : ends)
        for (const Index part : carrying.parts_of(element)) {
            const CellRef cell = *carrying.new_numbers().cell(part);
            for (const Index n : after.block(cell.type).nodes(cell.cell)) {
                if (named.contains({part, after.node_ids[n]})) continue;
                Vec3 sum = Vec3::Zero();
                for (const End& end : given) sum += end.normal / std::max((after.points[n] - end.at).norm(), 1e-300);
                if (sum.isZero(0)) continue;
                sum.normalize();
                char text[96];
                std::snprintf(text, sizeof text, ",%.12g,%.12g,%.12g", sum[0], sum[1], sum[2]);
                carrying.edits(c).add_after(last.at(element)->line,
                                            std::to_string(part) + ", " + std::to_string(after.node_ids[n]) + text);
            }
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
