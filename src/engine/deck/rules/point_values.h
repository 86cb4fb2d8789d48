// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "deck/rules/card_rule.h"
#include "deck/rules/carrying.h"

namespace femscalpel {

/// Values at elements' integration points: *INITIAL CONDITIONS of stresses, plastic strains and state variables. Each
/// integration point of a part of an element, or of an element that is of another type now, gets the values of the
/// nearest one that the element had. Of elements whose integration points are not known (shells), parts of the same
/// type get what the element has, point for point, which is a problem; parts of other types get none, as CalculiX
/// would write values of points that an element has not over those of others.
class PointValues : public CardRule {
public:
    bool takes(const Card& card) const override;
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void begin_carrying(Carrying& carrying) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    /// The values of one integration point.
    struct Record {
        Index point = 0;
        std::string rest;               ///< of the record, behind the point's number
        std::vector<CardReader> lines;  ///< it stands on
    };
    struct Element {
        Index number = 0;
        std::string where;
        std::vector<Record> records;
    };
    /// Of one integration point of a new element: the one of the old element whose values it gets.
    using Sources = std::vector<const Record*>;

    std::vector<Element> read(const Card& card, const Carrying& carrying) const;
    bool is_concerned(Index element, const Carrying& carrying) const;
    void carry_element(std::size_t c, const Element& element, Carrying& carrying) const;
    Sources sources_of(const Element& element, Index part, const Carrying& carrying) const;
    std::vector<Vec3> points_of(const Mesh& mesh, CellRef cell, std::string_view label) const;

    std::vector<std::string> labels_;  // by family of the mesh as it was
};

}  // namespace femscalpel
