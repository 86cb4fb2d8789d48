// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// What an element becomes in a deck: an element under its own card or under none yet, or, not written as an element,
/// the face or edge of another, or a point.
enum class Fate : std::uint8_t { card, free, face, edge, point };

/// An element that stands under no *ELEMENT card.
struct LooseElement {
    CellType type;
    Index cell;
    Fate fate = Fate::free;
    CellRef owner{};  ///< the element whose face or edge it is
    int face = 0;     ///< Facet::face there; 0: an edge of a solid, which is no face
};

/// Where the nodes and elements of a mesh stand in a deck.
struct DeckPlaces {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::vector<std::size_t> card_of_family;                     ///< *ELEMENT card of elements, or none
    std::vector<std::vector<std::size_t>> node_cards_of_family;  ///< *NODE cards of nodes
    std::vector<LooseElement> loose;                             ///< of dimension 0 to 2, by type and cell
    std::array<std::vector<Fate>, cell_type_count> fates;        ///< of all elements

    Fate fate(CellRef element) const {
        return fates[static_cast<std::size_t>(element.type)][static_cast<std::size_t>(element.cell)];
    }
    const std::vector<Fate>& fates_of(CellType type) const { return fates[static_cast<std::size_t>(type)]; }
    /// Whether a node, by index, is written under the *NODE card of that index.
    bool stands_under(const Mesh& mesh, Index node, std::size_t card) const;
};

/// Finds them: by the hidden groups of cards (Card::group), or, for what is in none, by what it is, see write_inp().
/// Throws WriteError for an element under two cards, and for elements under none of a type CalculiX has not.
DeckPlaces find_deck_places(const Mesh& mesh, const SolverInput& input);

/// What a data line of a *NODE card is about.
struct NodeOfLine {
    std::optional<Index> node;  ///< its index in the mesh; none if it is not there any more
    bool is_same = false;       ///< the coordinates are those of the mesh, so the line can stay as it is
};

/// That of the data line that `line` has come to; `numbers` are the mesh's.
NodeOfLine node_of_line(CardReader& line, const Mesh& mesh, const NumberIndex& numbers);

}  // namespace femscalpel
