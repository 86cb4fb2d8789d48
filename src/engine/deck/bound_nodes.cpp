// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/bound_nodes.h"

#include <algorithm>

namespace femscalpel {
namespace {

std::vector<Index> nodes_of(const DeckView& deck, const NumberOrSet& what) {
    if (what.is_number()) return {what.number};
    const auto group = deck.group(DeckSetType::nset, what.set);
    return group ? deck.members(*group) : std::vector<Index>();
}

}  // namespace

BoundNodes::BoundNodes(const Mesh& mesh) {
    if (solver_input(mesh)) collect(DeckView(mesh));
}

void BoundNodes::collect(const DeckView& deck) {
    Numbers turned, supported;
    for (const Card& card : deck.cards()) {
        CardReader line(card);
        if (card.keyword == "BOUNDARY") {
            while (const auto what = next_entry(line)) {
                const std::vector<Index> nodes = nodes_of(deck, *what);
                supported.insert(nodes.begin(), nodes.end());
                add_support(nodes, line);
            }
        } else if (card.keyword == "EQUATION" || card.keyword == "MPC") {
            while (line.next_data_line())
                while (!line.at_end())
                    if (Index number = 0; line.integer(number))
                        related_.insert(number);
                    else
                        add_set(deck, line.field(), related_);
        } else if (card.keyword == "TIE" && line.next_data_line()) {
            add_set(deck, line.field(), related_);
            if (card.parameter("CYCLICSYMMETRY")) add_set(deck, line.field(), related_);
        } else if (card.keyword == "TRANSFORM" && card.parameter("NSET")) {
            add_set(deck, *card.parameter("NSET"), turned);
        }
        for (const char* name : {"SURFACE", "NSET", "ELSET"})
            if (const std::string* set = card.parameter(name);
                set && (card.keyword == "COUPLING" || card.keyword == "RIGIDBODY"))
                add_set(deck, *set, wholly_);
    }
    wholly_.insert(related_.begin(), related_.end());
    for (const Index node : turned)
        if (supported.contains(node)) wholly_.insert(node);
}

void BoundNodes::add_support(const std::vector<Index>& nodes, CardReader& line) {
    Index first = 1, last = 11;
    if (line.integer(first) && !line.integer(last)) last = first;
    for (const Index node : nodes)
        for (Index freedom = first; freedom <= std::min<Index>(last, 11); ++freedom)
            freedoms_.insert({node, static_cast<int>(freedom)});
}

/// All nodes of a set or surface, whatever its kind; of surfaces those of the elements.
void BoundNodes::add_set(const DeckView& deck, const std::string& name, Numbers& to) {
    const Mesh& mesh = deck.mesh();
    const auto add_cell = [&](CellType type, Index cell) {
        for (const Index n : mesh.block(type).nodes(cell)) to.insert(mesh.node_ids[n]);
    };
    for (const DeckSetType type : {DeckSetType::nset, DeckSetType::node_surface})
        if (const auto group = deck.group(type, name))
            to.insert(deck.members(*group).begin(), deck.members(*group).end());
    if (const auto group = deck.group(DeckSetType::element_surface, name))
        for (const Facet& f : mesh.facets)
            if (mesh.families.contains(f.family, *group)) add_cell(f.type, f.cell);
    if (const auto group = deck.group(DeckSetType::elset, name))
        for (const Index element : deck.members(*group))
            if (const auto cell = deck.numbers().cell(element)) add_cell(cell->type, cell->cell);
}

std::vector<int> computed_freedoms(const Mesh& mesh) {
    bool heat = false, motion = false;
    if (const SolverInput* deck = solver_input(mesh))
        for (const Card& card : deck->cards()) {
            const bool both = card.keyword.find("TEMPERATURE-DISPLACEMENT") != std::string::npos;
            heat = heat || both || card.keyword == "HEATTRANSFER";
            motion = motion || both || card.keyword == "STATIC" || card.keyword == "DYNAMIC" ||
                     card.keyword == "FREQUENCY" || card.keyword == "BUCKLE" || card.keyword == "VISCO";
        }
    std::vector<int> out;
    if (motion || !heat) out = {1, 2, 3};
    if (heat) out.push_back(11);
    return out;
}

}  // namespace femscalpel
