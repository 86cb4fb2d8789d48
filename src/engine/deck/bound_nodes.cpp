// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/bound_nodes.h"

#include "mesh/facet_element.h"

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
    const std::vector<Card>& cards = deck.cards();
    for (std::size_t c = 0; c < cards.size(); ++c) {
        const Card& card = cards[c];
        CardReader line(card);
        if (card.keyword == "BOUNDARY") {
            add_supported(deck, card, supported);
        } else if (card.keyword == "EQUATION") {
            add_equations(deck, card);
        } else if (card.keyword == "MPC") {
            Numbers nodes;
            while (line.next_data_line())
                while (!line.at_end())
                    if (Index number = 0; line.integer(number))
                        nodes.insert(number);
                    else
                        add_set(deck, line.field(), nodes);
            related_.insert(nodes.begin(), nodes.end());
            dependent_.insert(nodes.begin(), nodes.end());
        } else if (card.keyword == "TIE" && line.next_data_line()) {
            Numbers nodes;
            add_set(deck, line.field(), nodes);
            if (card.parameter("CYCLICSYMMETRY")) add_set(deck, line.field(), nodes);
            related_.insert(nodes.begin(), nodes.end());
            // CalculiX does not tie slaves that an equation makes dependent.
            if (card.parameter("CYCLICSYMMETRY")) dependent_.insert(nodes.begin(), nodes.end());
        } else if (card.keyword == "TRANSFORM" && card.parameter("NSET")) {
            add_set(deck, *card.parameter("NSET"), turned);
        }
        // The nodes of a distributing coupling stay independent: the reference node follows them.
        const bool is_coupling =
            card.keyword == "COUPLING" && !(c + 1 < cards.size() && cards[c + 1].keyword == "DISTRIBUTING");
        for (const char* name : {"SURFACE", "NSET", "ELSET"})
            if (const std::string* set = card.parameter(name); set && (is_coupling || card.keyword == "RIGIDBODY"))
                add_set(deck, *set, dependent_);
    }
    bound_ = dependent_;
    bound_.insert(related_.begin(), related_.end());
    for (const Index node : turned)
        if (supported.contains(node)) bound_.insert(node);
}

/// All terms are related; the first of an equation is dependent.
void BoundNodes::add_equations(const DeckView& deck, const Card& card) {
    CardReader line(card);
    while (line.next_data_line()) {
        Index terms = 0;
        if (card.parameter("REMOVE") || !line.integer(terms)) return;
        for (Index k = 0; k < terms; ++k) {
            if ((k == 0 || line.at_end()) && !line.next_data_line()) return;
            const auto what = read_number_or_set(line);
            Index freedom = 0;
            const bool is_term = line.integer(freedom);
            line.field();
            if (!what || !is_term) continue;
            Numbers nodes;
            if (what->is_number())
                nodes.insert(what->number);
            else
                add_set(deck, what->set, nodes);
            related_.insert(nodes.begin(), nodes.end());
            if (k == 0)
                for (const Index node : nodes) freedoms_.insert({node, static_cast<int>(freedom)});
        }
    }
}

void BoundNodes::add_supported(const DeckView& deck, const Card& card, Numbers& to) {
    CardReader line(card);
    while (const auto what = next_entry(line)) {
        const std::vector<Index> nodes = nodes_of(deck, *what);
        to.insert(nodes.begin(), nodes.end());
    }
}

/// All nodes of a set or surface, whatever its kind; of surfaces of elements those of the faces.
void BoundNodes::add_set(const DeckView& deck, const std::string& name, Numbers& to) {
    const Mesh& mesh = deck.mesh();
    const auto add_cell = [&](CellType type, Index cell) {
        for (const Index n : mesh.block(type).nodes(cell)) to.insert(mesh.node_ids[n]);
    };
    for (const DeckSetType type : {DeckSetType::nset, DeckSetType::node_surface})
        if (const auto group = deck.group(type, name))
            to.insert(deck.members(*group).begin(), deck.members(*group).end());
    if (const auto group = deck.group(DeckSetType::element_surface, name))
        for (const Facet& f : mesh.facets) {
            if (!mesh.families.contains(f.family, *group)) continue;
            const FacetElement face = facet_element(mesh, f);
            for (int k = 0; k < face.size; ++k) to.insert(mesh.node_ids[face.nodes[static_cast<std::size_t>(k)]]);
        }
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
