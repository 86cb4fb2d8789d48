// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deck/deck_view.h"
#include "deck/load_label.h"
#include "deck/rules/card_rule.h"
#include "deck/rules/loaded_faces.h"

namespace femscalpel {

/// Distributed loads, element, label of a face or of a load on all of it, values: *DLOAD, *DFLUX, *FILM, *RADIATE,
/// *MASS FLOW, *BOUNDARYF. Faces, by element number or set, and elements by number that lines of one card load alike
/// are a group whose shape is kept; the load goes to all that is in the group afterwards.
class ElementLoads : public CardRule {
public:
    bool takes(const Card& card) const override;
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void mark(std::size_t c, const Card& card, Marking& marking) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    /// A line, and where its load is applied.
    struct LoadLine {
        CardReader line;
        NumberOrSet what;
        std::string written;  ///< label
        LoadLabel label;
        std::string rest;
        std::string group;  ///< that has its faces or elements; empty if the line stays as it is
        Faces faces;
        std::vector<Index> other_members;  ///< of a set: elements that have no such face

        std::string with(Index element, const std::string& new_label) const;
    };
    /// What each group has now and no line names yet.
    using Left = std::map<std::string, std::set<std::pair<Index, int>>>;

    static std::vector<LoadLine> read(const DeckView& deck, std::size_t c, const Card& card);
    static void find_faces(const DeckView& deck, LoadLine& line);
    static bool stays(const LoadLine& line, Left& left, const Carrying& carrying);
    void replace(std::size_t c, const LoadLine& line, Carrying& carrying);
    static void add_left(std::size_t c, const std::vector<LoadLine>& lines, const Left& left, Carrying& carrying);

    std::optional<LoadedFaces> loaded_;
};

}  // namespace femscalpel
