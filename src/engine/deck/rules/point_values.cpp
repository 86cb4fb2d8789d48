// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/point_values.h"

#include <algorithm>

#include "deck/integration_points.h"
#include "deck/rules/absent_numbers.h"
#include "deck/solver_element.h"

namespace femscalpel {
namespace {

/// Largest number of state variables in the deck: records of initial solutions are as long.
Index state_variables(const std::vector<Card>& cards) {
    Index most = 0;
    for (const Card& card : cards) {
        if (card.keyword != "DEPVAR") continue;
        CardReader line(card);
        if (Index count = 0; line.next_data_line() && line.integer(count)) most = std::max(most, count);
    }
    return most;
}

/// Two entries and six values on the first line of a record, eight on the others.
Index lines_per_record(const Card& card, const std::vector<Card>& cards) {
    if (type_of(card) != "SOLUTION") return 1;
    return 1 + std::max<Index>(0, state_variables(cards) - 6 + 7) / 8;
}

/// A card's number of integration point and what is behind it.
std::string record_text(Index element, Index point, const std::string& rest) {
    return std::to_string(element) + ", " + std::to_string(point) + "," + rest;
}

}  // namespace

bool PointValues::takes(const Card& card) const {
    if (card.keyword != "INITIALCONDITIONS") return false;
    const std::string type = type_of(card);
    return type == "STRESS" || type == "PLASTICSTRAIN" || type == "SOLUTION";
}

void PointValues::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    const Index lines = lines_per_record(card, numbers.cards());
    CardReader line(card);
    Index element = 0;
    while (line.next_data_line()) {
        if (line.integer(element)) numbers.name_element(line, element);
        for (Index k = 1; k < lines && line.next_data_line();) ++k;
    }
}

void PointValues::begin_carrying(Carrying& carrying) {
    if (std::ranges::any_of(carrying.old().cards(), [&](const Card& card) { return takes(card); }))
        labels_ = labels_of_families(carrying.before(), carrying.old().input());
}

bool PointValues::is_concerned(Index element, const Carrying& carrying) const {
    return carrying.had_element(element) &&
           (carrying.has_further_parts(element) || !carrying.new_numbers().cell(element) ||
            carrying.type_now(element) != carrying.old().numbers().cell(element)->type);
}

std::vector<PointValues::Element> PointValues::read(const Card& card, const Carrying& carrying) const {
    const Index lines = lines_per_record(card, carrying.old().cards());
    std::vector<Element> out;
    std::unordered_map<Index, std::size_t> places;
    CardReader line(card);
    while (line.next_data_line()) {
        const auto what = read_number_or_set(line);
        const bool concerns = what && what->is_number() && is_concerned(what->number, carrying);
        Record record;
        const std::string where = concerns ? line.where() : "";
        if (concerns) {
            line.integer(record.point);
            record.rest = line.rest();
            record.lines.push_back(line);
        }
        for (Index k = 1; k < lines && line.next_data_line(); ++k)
            if (concerns) {
                record.rest += "\n" + std::string(line.line());
                record.lines.push_back(line);
            }
        if (!concerns) continue;
        const auto [place, is_new] = places.emplace(what->number, out.size());
        if (is_new) out.push_back({what->number, where, {}});
        out[place->second].records.push_back(std::move(record));
    }
    return out;
}

void PointValues::carry(std::size_t c, const Card& card, Carrying& carrying) {
    for (const Element& element : read(card, carrying)) {
        check_cancelled();
        carry_element(c, element, carrying);
    }
}

void PointValues::carry_element(std::size_t c, const Element& element, Carrying& carrying) const {
    CardEdits& edits = carrying.edits(c);
    const auto tell = [&](Weight weight, const std::string& what) {
        carrying.remarks().add(c, weight, element.where, the_element(element.number), what);
    };
    std::vector<Index> parts = carrying.parts_of(element.number);
    std::erase_if(parts, [&](Index part) { return !carrying.new_numbers().cell(part); });
    const CellType type = carrying.old().numbers().cell(element.number)->type;
    const CardReader& last = element.records.back().lines.back();
    const bool one_point = element.records.size() == 1;
    bool keeps = false;
    if (parts.empty()) tell(Weight::problem, "was removed");
    std::string added;
    for (const Index part : parts) {
        const bool same = carrying.type_now(part) == type;
        const Sources sources = sources_of(element, part, carrying);
        if (sources.empty() && !same) {
            tell(Weight::problem,
                 "has parts of a type whose integration points are not known; these have no values, give them some");
        } else if (sources.empty() || (same && one_point)) {
            if (!one_point)
                tell(Weight::problem,
                     "was split; the values at its integration points are given to those of each part");
            keeps = keeps || part == element.number;
            if (part != element.number)
                for (const Record& r : element.records) edits.add_after(last, record_text(part, r.point, r.rest));
        } else {
            tell(Weight::note,
                 "was divided; the integration points of its parts have the values of the nearest one it had");
            for (std::size_t p = 0; p < sources.size(); ++p)
                edits.add_after(last, record_text(part, static_cast<Index>(p) + 1, sources[p]->rest));
        }
    }
    if (keeps) return;
    for (const Record& r : element.records)
        for (const CardReader& line : r.lines) edits.drop(line);
}

PointValues::Sources PointValues::sources_of(const Element& element, Index part, const Carrying& carrying) const {
    const CellRef old = *carrying.old().numbers().cell(element.number), now = *carrying.new_numbers().cell(part);
    const std::string& label = labels_[static_cast<std::size_t>(carrying.before().block(old.type).families[old.cell])];
    const std::vector<Vec3> had = points_of(carrying.before(), old, label);
    if (had.size() != element.records.size()) return {};
    for (const Record& r : element.records)
        if (r.point < 1 || r.point > static_cast<Index>(had.size())) return {};
    Sources out;
    for (const Vec3& x : points_of(carrying.after(), now, deck_label_for(label, now.type)))
        out.push_back(&*std::ranges::min_element(element.records, {}, [&](const Record& r) {
            return (had[static_cast<std::size_t>(r.point) - 1] - x).squaredNorm();
        }));
    return out;
}

std::vector<Vec3> PointValues::points_of(const Mesh& mesh, CellRef cell, std::string_view label) const {
    std::vector<Vec3> nodes;
    for (const Index n : mesh.block(cell.type).nodes(cell.cell)) nodes.push_back(mesh.points[n]);
    return integration_points(label, cell.type, nodes);
}

}  // namespace femscalpel
