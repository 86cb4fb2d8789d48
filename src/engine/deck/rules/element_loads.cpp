// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/element_loads.h"

#include <algorithm>
#include <map>
#include <set>

#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"

namespace femscalpel {
namespace {

/// Name of the group for the faces, or for the elements named by number, that lines of card `c` load alike: same label
/// but for the face, same entries after it.
std::string group_name(std::string_view kind, std::size_t c, const LoadLabel& label, std::string_view rest) {
    return std::string(kind) + std::to_string(c) + ":" + label.prefix + "#" + label.suffix + "," + deck_key(rest);
}

}  // namespace

std::string ElementLoads::LoadLine::with(Index element, const std::string& new_label) const {
    return std::to_string(element) + ", " + new_label + (rest.empty() ? "" : "," + rest);
}

bool ElementLoads::takes(const Card& card) const {
    constexpr std::string_view keywords[] = {"DLOAD", "DFLUX", "FILM", "RADIATE", "BOUNDARYF", "MASSFLOW"};
    return std::ranges::find(keywords, card.keyword) != std::end(keywords);
}

void ElementLoads::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    CardReader line(card);
    Index number = 0;
    while (line.next_data_line()) {
        if (line.integer(number))
            numbers.name_element(line, number);
        else
            line.field();
        const LoadLabel label(line.field());
        const bool has_node =
            label.suffix == "FC" || label.suffix == "NP";  // of the fluid, whose temperature or pressure
        if (has_node && line.integer(number)) numbers.name_node(line, number);
    }
}

void ElementLoads::mark(std::size_t c, const Card& card, Marking& marking) {
    for (const LoadLine& line : read(marking.deck(), c, card))
        for (const auto& [element, face] : line.faces)
            if (face > 0)
                marking.mark_face(line.group, element, face);
            else
                marking.mark_element(line.group, element);
}

void ElementLoads::carry(std::size_t c, const Card& card, Carrying& carrying) {
    if (!loaded_) loaded_.emplace(carrying.before(), carrying.after());
    const std::vector<LoadLine> lines = read(carrying.old(), c, card);
    Left left;
    for (const LoadLine& l : lines) {
        CardReader sink = l.line;
        sink.field();
        sink.field();
        if (Index node = 0; l.label.suffix == "FC" && sink.integer(node) && carrying.origins().is_doubled(node))
            carrying.remarks().add(c, Weight::problem, sink.where(), the_node(node),
                                   "the crack doubled; the original, on the negative side, stays the sink");
        if (l.group.empty()) continue;
        if (const auto [it, fresh] = left.try_emplace(l.group); fresh)
            it->second.insert(loaded_->now(l.group).begin(), loaded_->now(l.group).end());
    }
    for (const LoadLine& l : lines)
        if (!l.group.empty() && !stays(l, left, carrying)) replace(c, l, carrying);
    add_left(c, lines, left, carrying);
}

std::vector<ElementLoads::LoadLine> ElementLoads::read(const DeckView& deck, std::size_t c, const Card& card) {
    std::vector<LoadLine> out;
    std::map<std::string, std::set<std::pair<Index, int>>> loaded;  // by group
    CardReader line(card);
    while (line.next_data_line()) {
        const CardReader start = line;
        const auto what = read_number_or_set(line);
        if (!what) continue;
        const std::string written = line.field();
        LoadLine l{start, *what, written, LoadLabel(written), std::string(line.rest()), "", {}, {}};
        find_faces(deck, l);
        if (!l.faces.empty())
            l.group = group_name(l.faces.front().second > 0 ? "FACES" : "ELEMENTS", c, l.label, l.rest);
        // What is loaded again is so much more loaded.
        const auto again = [&] {
            const auto& before = loaded[l.group];
            return std::ranges::any_of(l.faces, [&](const auto& f) { return before.contains(f); });
        };
        while (again()) l.group += "#AGAIN";
        if (!l.faces.empty()) loaded[l.group].insert(l.faces.begin(), l.faces.end());
        out.push_back(std::move(l));
    }
    return out;
}

void ElementLoads::find_faces(const DeckView& deck, LoadLine& line) {
    const auto look = [&](Index element) {
        const auto cell = deck.numbers().cell(element);
        if (!cell) return;
        const int face = line.label.face(cell->type, deck.is_plane(*cell));
        if (face > 0 || line.what.is_number())
            line.faces.push_back({element, face});
        else
            line.other_members.push_back(element);
    };
    if (line.what.is_number())
        look(line.what.number);
    else if (line.label.number > 0)
        if (const auto group = deck.group(DeckSetType::elset, line.what.set))
            for (const Index element : deck.members(*group)) look(element);
}

/// Takes what the line names out of `left` if it can stay as it is. A set stays if none of its elements has parts,
/// which would be loaded too.
bool ElementLoads::stays(const LoadLine& line, Left& left, const Carrying& carrying) {
    auto& there = left.at(line.group);
    const bool stays = std::ranges::all_of(line.faces, [&](const auto& f) {
        return there.contains(f) && (line.what.is_number() || !carrying.has_further_parts(f.first));
    });
    if (stays)
        for (const auto& f : line.faces) there.erase(f);
    return stays;
}

void ElementLoads::replace(std::size_t c, const LoadLine& line, Carrying& carrying) {
    CardEdits& edits = carrying.edits(c);
    edits.drop(line.line);
    for (const Index element : line.other_members)
        for (const Index part : carrying.parts_of(element)) edits.add_after(line.line, line.with(part, line.written));
    for (const auto& [element, face] : line.faces)
        if (carrying.parts_of(element).empty() && loaded_->shrank(line.group))
            carrying.remarks().add(c, Weight::problem, line.line.where(), the_element(element),
                                   "was removed, and with it its " + line.written);
}

/// Adds lines for what is left of each group: after the line that loaded the element it comes from, or the group's
/// last.
void ElementLoads::add_left(std::size_t c, const std::vector<LoadLine>& lines, const Left& left, Carrying& carrying) {
    std::map<std::pair<std::string, Index>, const LoadLine*> line_of;  // by group and element of the input
    std::map<std::string, const LoadLine*> last_line;
    for (const LoadLine& l : lines) {
        if (l.group.empty()) continue;
        last_line[l.group] = &l;
        for (const auto& [element, face] : l.faces) line_of.emplace(std::pair(l.group, element), &l);
    }
    for (const auto& [group, faces] : left)
        for (const auto& [element, face] : faces) {
            const auto found = line_of.find({group, carrying.origin_of(element)});
            const LoadLine& l = found == line_of.end() ? *last_line.at(group) : *found->second;
            const std::string label =
                face == 0 ? l.written
                          : l.label.with_face(face, carrying.type_now(element), carrying.is_plane_now(element));
            carrying.edits(c).add_after(l.line, l.with(element, label));
        }
}

}  // namespace femscalpel
