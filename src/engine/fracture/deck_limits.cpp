// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/deck_limits.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

#include "deck/solver_input.h"

namespace femscalpel {
namespace {

std::string in_capitals(std::string_view text) {
    std::string out;
    for (const char c : text)
        if (!std::isspace(static_cast<unsigned char>(c)))
            out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return out;
}

/// First and second entry of each data line of a card, in capitals.
std::vector<std::array<std::string, 2>> entries(const Card& card) {
    std::vector<std::array<std::string, 2>> out;
    bool first_piece = true;
    for (const DeckText& piece : card.text) {
        std::istringstream lines(std::string(piece.text.substr(first_piece ? card.head : 0)));
        first_piece = false;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("**")) continue;
            std::istringstream fields(line);
            std::array<std::string, 2> entry;
            for (std::string& field : entry) {
                std::getline(fields, field, ',');
                field = in_capitals(field);
            }
            out.push_back(entry);
        }
    }
    return out;
}

}  // namespace

void check_deck_for_fracture(const Mesh& mesh, const std::string& name) {
    const auto* const deck = dynamic_cast<const SolverInput*>(mesh.companion.get());
    if (!deck) return;
    const auto refuse = [](const Card& card, const std::string& what) {
        throw Error(card.where() + ": *" + card.keyword + ": " + what, "mesh");
    };
    const std::string positive = in_capitals(name) + "_P", negative = in_capitals(name) + "_N";
    const bool expands = std::ranges::any_of(deck->cards(), [](const Card& c) { return c.keyword == "EXPANSION"; });
    for (const Card& card : deck->cards()) {
        if (expands && card.keyword == "TEMPERATURE")
            refuse(card, "stress intensity with thermal strain is not known; K would be wrong");
        if (card.keyword != "DLOAD" && card.keyword != "DSLOAD") continue;
        for (const auto& [where, label] : entries(card)) {
            if (label == "GRAV" || label == "CENTRIF" || label.starts_with("BX") || label.starts_with("BY") ||
                label.starts_with("BZ"))
                refuse(card,
                       "stress intensity with forces in the volume (" + label + ") is not known; K would be wrong");
            if (where == positive || where == negative)
                refuse(card, "stress intensity with a load on the lips is not known; K would be wrong");
        }
    }
}

}  // namespace femscalpel
