// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/adopt_sections.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <unordered_map>
#include <utility>

#include "cancel.h"
#include "deck/model_end.h"
#include "deck/rules/mesh_cards.h"
#include "deck/solver_element.h"
#include "deck/solver_sets.h"

namespace femscalpel {
namespace {

bool is_one_of(const std::string& keyword, std::span<const std::string_view> all) {
    return std::ranges::find(all, keyword) != all.end();
}

bool is_section(const Card& card) {
    constexpr std::string_view all[] = {"SOLIDSECTION", "SHELLSECTION", "MEMBRANESECTION", "BEAMSECTION",
                                        "BEAMGENERALSECTION"};
    return is_one_of(card.keyword, all);
}

/// What stands behind a *MATERIAL.
bool is_property(const Card& card) {
    constexpr std::string_view all[] = {"CONDUCTIVITY",
                                        "CREEP",
                                        "CYCLICHARDENING",
                                        "DAMPING",
                                        "DEFORMATIONPLASTICITY",
                                        "DENSITY",
                                        "DEPVAR",
                                        "ELASTIC",
                                        "ELECTRICALCONDUCTIVITY",
                                        "EXPANSION",
                                        "FLUIDCONSTANTS",
                                        "HYPERELASTIC",
                                        "HYPERFOAM",
                                        "MAGNETICPERMEABILITY",
                                        "MOHRCOULOMB",
                                        "MOHRCOULOMBHARDENING",
                                        "PLASTIC",
                                        "SPECIFICGASCONSTANT",
                                        "SPECIFICHEAT",
                                        "USERMATERIAL"};
    return is_one_of(card.keyword, all);
}

/// Cards that are named, and named by others.
bool is_named(const Card& card) {
    constexpr std::string_view all[] = {"MATERIAL", "ORIENTATION", "DISTRIBUTION", "DISTRIBUTIONTABLE"};
    return is_one_of(card.keyword, all) && card.parameter("NAME");
}

/// Whether a card of an addition is taken over; all of a deck are asked for in order.
class Taken {
public:
    bool operator()(const Card& card) {
        if (card.keyword == "STEP") in_step_ = true;
        const bool property = is_property(card);
        in_material_ = card.keyword == "MATERIAL" || (in_material_ && property);
        return !in_step_ && (is_section(card) || is_named(card) || (property && in_material_));
    }

private:
    bool in_material_ = false, in_step_ = false;
};

bool is_of_mesh(const Card& card) {
    if (!is_mesh_card(card)) return false;
    const std::string* type = card.parameter("TYPE");
    return card.keyword != "ELEMENT" || (type && deck_element_type(*type));
}

bool is_word(const std::string& field) { return !field.empty() && std::isalpha(static_cast<unsigned char>(field[0])); }

/// The sets that sections and distributions name.
std::vector<std::string> named_sets(const SolverInput& deck) {
    std::vector<std::string> out;
    for (const Card& card : deck.cards()) {
        if (const std::string* elset = card.parameter("ELSET"); elset && is_section(card)) out.push_back(*elset);
        if (card.keyword != "DISTRIBUTION") continue;
        CardReader line(card);
        while (line.next_data_line())
            if (const std::string first = line.field(); is_word(first)) out.push_back(first);
    }
    return out;
}

/// What a card says, without its name, comments, blanks and case.
std::string bare_text(const Card& card) {
    std::string out = card.keyword;
    for (const CardParameter& p : card.parameters)
        if (p.name != "NAME") out += "," + p.name + "=" + deck_key(p.value);
    CardReader line(card);
    while (line.next_data_line()) {
        out += '\n';
        out += deck_key(line.line());
    }
    return out;
}

/// The named cards of a deck, of a material with its properties: keyword and key of the name, to what they say.
std::map<std::pair<std::string, std::string>, std::string> named_cards(const SolverInput& deck) {
    std::map<std::pair<std::string, std::string>, std::string> out;
    std::string* material = nullptr;
    for (const Card& card : deck.cards()) {
        if (material && is_property(card)) {
            *material += '\n';
            *material += bare_text(card);
            continue;
        }
        material = nullptr;
        if (!is_named(card)) continue;
        std::string& text = out[{card.keyword, deck_key(*card.parameter("NAME"))}];
        text = bare_text(card);
        if (card.keyword == "MATERIAL") material = &text;
    }
    return out;
}

/// Takes cards over, see adopt_sections().
class Adopter {
public:
    Adopter(Mesh& united, const Mesh& addition, const std::vector<GroupIndex>& groups, const std::string& prefix)
        : united_(united),
          addition_(addition),
          groups_(groups),
          prefix_(prefix),
          theirs_(*solver_input(addition)),
          their_sets_(theirs_.sets()),
          deck_(std::make_shared<SolverInput>(*solver_input(united))) {
        for (const CellBlock& b : addition.blocks())
            first_[static_cast<std::size_t>(b.type)] = united.block(b.type).size() - b.size();
    }

    void run() {
        choose_names();
        number_elements();
        std::vector<Card> types = element_cards();
        std::size_t place = 0;
        for (std::size_t c = 0; c < deck_->cards().size(); ++c) {
            const std::string& keyword = deck_->cards()[c].keyword;
            if (keyword == "NODE" || keyword == "ELEMENT") place = c + 1;
        }
        if (place > 0) insert_cards(*deck_, place, std::move(types));
        std::vector<Card> cards;
        bool left_out = false;
        Taken taken;
        for (const Card& card : theirs_.cards()) {
            if (!taken(card)) continue;
            if (is_named(card)) left_out = is_the_same(card);
            if (left_out && (is_named(card) || is_property(card))) continue;
            if (Card out = renamed(card); !out.text.empty()) cards.push_back(std::move(out));
        }
        std::ranges::move(cards, std::back_inserter(sets_));
        add_to_model(*deck_, std::move(sets_));
        deck_->set_ties_orders(deck_->ties_orders() || theirs_.ties_orders());
        united_.companion = std::move(deck_);
    }

private:
    using Name = std::pair<std::string, std::string>;  // keyword, key

    void choose_names() {
        const auto ours = named_cards(*deck_), theirs = named_cards(theirs_);
        for (const Card& card : theirs_.cards()) {
            if (!is_named(card)) continue;
            const std::string& name = *card.parameter("NAME");
            const Name key{card.keyword, deck_key(name)};
            const auto same = ours.find(key);
            if (same == ours.end()) continue;
            if (same->second == theirs.at(key)) {
                same_.insert(key);
                continue;
            }
            names_[key] = prefix_ + name;
            const Name wanted{card.keyword, deck_key(prefix_ + name)};
            if (ours.contains(wanted) || theirs.contains(wanted))
                throw ToolError(card.where() + ": the mesh's deck has a *" + card.keyword + " '" + name +
                                    "' that says something else, and '" + prefix_ + name +
                                    "' is taken, too: give another prefix",
                                "prefix");
        }
    }

    bool is_the_same(const Card& card) const {
        return same_.contains({card.keyword, deck_key(*card.parameter("NAME"))});
    }

    std::string name(const char* keyword, const std::string& old) const {
        const auto found = names_.find({keyword, deck_key(old)});
        return found == names_.end() ? old : found->second;
    }

    void number_elements() {
        for (const CellBlock& b : addition_.blocks())
            for (Index c = 0; c < b.size(); ++c)
                number_.emplace(b.ids[c], united_.block(b.type).ids[first_[static_cast<std::size_t>(b.type)] + c]);
    }

    /// The set's name in the united mesh, whose deck knows it then; empty if there is no such group.
    std::string set_name(const std::string& old) {
        const auto set = their_sets_.find(DeckSetType::elset, old);
        const auto group = set ? addition_.find_group(theirs_.sets()[*set].group, GroupKind::element) : std::nullopt;
        if (!group || groups_[*group] < 0) return "";
        const std::string& now = united_.groups[groups_[*group]].name;
        if (!DeckSetIndex(deck_->sets()).find(DeckSetType::elset, now)) {
            DeckSet fresh;
            fresh.type = DeckSetType::elset;
            fresh.name = fresh.group = now;
            deck_->sets().push_back(std::move(fresh));
            sets_.emplace_back().set_text("*ELSET, ELSET=" + now + "\n");
        }
        return now;
    }

    /// The card with the names that things have now; without text if what it is about is gone.
    Card renamed(const Card& card) {
        const std::string_view head = card.text.front().text;
        std::string text(head.substr(0, head.find_first_of(",\r\n")));
        for (const CardParameter& p : card.parameters) {
            std::string value = p.value;
            if (p.name == "NAME") value = name(card.keyword.c_str(), value);
            if (p.name == "MATERIAL") value = name("MATERIAL", value);
            if (p.name == "ORIENTATION") value = name("ORIENTATION", value);
            if (p.name == "TABLE" && card.keyword == "DISTRIBUTION") value = name("DISTRIBUTIONTABLE", value);
            if (p.name == "ELSET") {
                value = set_name(value);
                if (value.empty()) return {};
            }
            text += ", " + p.name + (value.empty() ? "" : "=" + value);
        }
        text += '\n';
        CardReader line(card);
        while (line.next_line()) text += line.is_data() ? renamed(card, line) : std::string(line.raw());
        Card out;
        out.set_text(std::move(text));
        return out;
    }

    /// A line of it.
    std::string renamed(const Card& card, CardReader& line) {
        const std::string raw(line.line());
        std::vector<std::string> fields;
        while (!line.at_end()) fields.push_back(line.field());
        if (fields.empty()) return raw + "\n";
        if (card.keyword == "SHELLSECTION" && card.parameter("COMPOSITE")) {
            if (fields.size() > 2) fields[2] = name("MATERIAL", fields[2]);
            if (fields.size() > 3) fields[3] = name("ORIENTATION", fields[3]);
        } else if (card.keyword == "ORIENTATION" && is_word(fields[0])) {
            fields[0] = name("DISTRIBUTION", fields[0]);
        } else if (card.keyword == "DISTRIBUTION" && !fields[0].empty()) {
            if (is_word(fields[0])) {
                fields[0] = set_name(fields[0]);
            } else {
                const auto now = number_.find(std::strtoll(fields[0].c_str(), nullptr, 10));
                fields[0] = now == number_.end() ? "" : std::to_string(now->second);
            }
            if (fields[0].empty()) return "";
        } else {
            return raw + "\n";
        }
        std::string out = fields[0];
        for (std::size_t k = 1; k < fields.size(); ++k) out += ", " + fields[k];
        return out + "\n";
    }

    /// *ELEMENT cards for types that no card would say; the elements come under them.
    std::vector<Card> element_cards() {
        std::map<GroupIndex, std::pair<GroupIndex, CellType>> groups;  // of the addition -> of the united, type
        std::vector<Card> out;
        for (const Card& card : theirs_.cards()) {
            if (card.keyword != "ELEMENT" || card.group.empty()) continue;
            const std::string& label = *card.parameter("TYPE");
            const auto type = deck_element_type(label);
            const auto group = addition_.find_group(card.group, GroupKind::element, true);
            if (!type || !group || deck_key(label) == default_deck_label(type->cell)) continue;
            std::string hidden;
            for (int k = 1; hidden.empty() || united_.find_group(hidden, GroupKind::element, true); ++k)
                hidden = "adopted card " + std::to_string(k);
            groups[*group] = {united_.add_group(hidden, GroupKind::element, true), type->cell};
            out.emplace_back().set_text("*ELEMENT, TYPE=" + label + "\n");
            out.back().group = hidden;
        }
        SparseCheck check;
        for (const CellBlock& b : addition_.blocks())
            for (Index c = 0; c < b.size(); ++c, check())
                for (const GroupIndex g : addition_.families.groups(b.families[c]))
                    if (const auto found = groups.find(g); found != groups.end() && found->second.second == b.type) {
                        FamilyIndex& family =
                            united_.block(b.type).families[first_[static_cast<std::size_t>(b.type)] + c];
                        family = united_.families.with(family, found->second.first);
                    }
        return out;
    }

    Mesh& united_;
    const Mesh& addition_;
    const std::vector<GroupIndex>& groups_;
    const std::string& prefix_;
    const SolverInput& theirs_;
    DeckSetIndex their_sets_;
    std::shared_ptr<SolverInput> deck_;
    std::array<Index, cell_type_count> first_{};  // of the addition's elements, in the united blocks
    std::map<Name, std::string> names_;           // new ones
    std::set<Name> same_;                         // which both have, and say the same
    std::unordered_map<Index, Index> number_;     // of the united mesh, by element number of the addition
    std::vector<Card> sets_;
};

}  // namespace

std::vector<std::string> reduce_to_sections(const Mesh& mesh, Mesh& addition) {
    const SolverInput* const deck = solver_input(addition);
    if (!deck) return {};
    const bool wanted = solver_input(mesh) != nullptr;
    auto reduced = std::make_shared<SolverInput>(*deck);
    std::vector<Card>& cards = reduced->cards();
    cards.clear();
    reduced->other_elements().clear();
    std::string left_out;
    std::set<std::string> told;
    Taken taken;
    for (const Card& card : deck->cards()) {
        const bool take = taken(card);
        if (is_of_mesh(card) || (take && wanted)) {
            cards.push_back(card);
            continue;
        }
        if (card.keyword.empty() || card.keyword == "HEADING" || card.keyword == "ENDSTEP") continue;
        if (told.insert(card.keyword).second)
            left_out += (left_out.empty() ? "*" : ", *") + card.keyword + " (" + card.where() + ")";
    }
    addition.companion = wanted ? reduced : nullptr;
    if (left_out.empty()) return {};
    if (!wanted) return {"the mesh has no deck, so that of the addition is left out: " + left_out};
    return {"of the addition's deck materials, orientations and sections are taken over; left out are " + left_out};
}

void rename_section_groups(const Mesh& mesh, Mesh& addition, const std::string& prefix) {
    const SolverInput* const deck = solver_input(addition);
    if (!deck || !solver_input(mesh)) return;
    std::set<std::string> taken;
    for (const Group& g : mesh.groups)
        if (g.kind == GroupKind::element && !g.hidden) taken.insert(deck_key(g.name));
    auto renamed = std::make_shared<SolverInput>(*deck);
    const DeckSetIndex sets(deck->sets());
    for (const std::string& name : named_sets(*deck)) {
        const auto set = sets.find(DeckSetType::elset, name);
        if (!set) continue;
        DeckSet& mine = renamed->sets()[*set];
        const auto group = addition.find_group(mine.group, GroupKind::element);
        if (!group || !taken.contains(deck_key(addition.groups[*group].name))) continue;
        const std::string now = prefix + addition.groups[*group].name;
        if (taken.contains(deck_key(now)) || addition.find_group(now, GroupKind::element))
            throw ToolError("the mesh has an element group '" + addition.groups[*group].name +
                                "', for which the addition's deck has a section of its own, and '" + now +
                                "' is taken, too: give another prefix",
                            "prefix");
        // The set keeps its name: the cards name it so.
        addition.groups[*group].name = mine.group = now;
    }
    addition.companion = std::move(renamed);
}

void adopt_sections(Mesh& united, const Mesh& addition, const std::vector<GroupIndex>& groups,
                    const std::string& prefix) {
    if (!solver_input(united) || !solver_input(addition)) return;
    Adopter(united, addition, groups, prefix).run();
}

}  // namespace femscalpel
