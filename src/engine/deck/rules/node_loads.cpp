// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/node_loads.h"

#include <algorithm>

#include "deck/card_numbers.h"
#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"
#include "words.h"

namespace femscalpel {
namespace {

void carry_set(std::size_t c, const CardReader& line, const std::string& set, const std::string& share,
               Carrying& carrying) {
    Remarks& remarks = carrying.remarks();
    if (const Index lost = carrying.closed_sets().lost_members(set); lost > 0)
        remarks.add(c, Weight::problem, line.where(), the_set(set),
                    "lost " + counted(lost, "node and with it its", "nodes and with them their") + " " + share);
    const std::string name = carrying.closed_sets().name_of_old_members(set);
    if (name == set) return;
    remarks.add_replaced(set, name);
    remarks.add(c, Weight::note, line.where(), the_set(set),
                "has new nodes; the card now names '" + name + "', the nodes it had, so that the total stays the same");
    carrying.edits(c).replace(line, name + "," + std::string(line.rest()));
}

/// Whether a node is a corner of an element: then only a wall that is moved (reshape) takes it along.
bool is_corner(const Mesh& mesh, Index number) {
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto corners = b.nodes(c).first(static_cast<std::size_t>(traits(b.type).corners));
            if (std::ranges::any_of(corners, [&](Index n) { return mesh.node_ids[n] == number; })) return true;
        }
    return false;
}

}  // namespace

bool NodeLoads::takes(const Card& card) const {
    return is_load(card) || card.keyword == "DISTRIBUTINGCOUPLING" || card.keyword == "RETAINEDNODALDOFS";
}

void NodeLoads::list_numbers(const Card& card, AbsentNumbers& numbers) const { numbers.name_nodes_first(card); }

void NodeLoads::mark(std::size_t /*c*/, const Card& card, Marking& marking) {
    CardReader line(card);
    while (const auto what = next_entry(line))
        if (what->is_number()) marking.pin(what->number);
}

void NodeLoads::carry(std::size_t c, const Card& card, Carrying& carrying) {
    const std::string share = is_load(card) ? "load" : "part";
    Remarks& remarks = carrying.remarks();
    CardReader line(card);
    while (const auto what = next_entry(line)) {
        if (!what->is_number()) {
            carry_set(c, line, what->set, share, carrying);
            continue;
        }
        const Index node = what->number;
        if (carrying.node_gone(node)) {
            remarks.add(c, Weight::problem, line.where(), the_node(node), "was removed, and with it the " + share);
            carrying.edits(c).drop(line);
        } else if (carrying.origins().is_doubled(node)) {
            remarks.add(c, is_load(card) ? Weight::note : Weight::problem, line.where(), the_node(node),
                        "the crack doubled; its " + share + " stays whole on the original, on the negative side");
        }
        if (!carrying.node_moved(node)) continue;
        const std::string moved = "moved by " + number_text(carrying.origins().moved(node));
        if (is_corner(carrying.before(), node))
            remarks.add(c, Weight::note, line.where(), the_node(node),
                        moved + " with the wall it is on; its " + share + " goes with it");
        else
            remarks.add(c, Weight::problem, line.where(), the_node(node),
                        "is a mid-side node that " + moved + " with its edge");
    }
}

}  // namespace femscalpel
