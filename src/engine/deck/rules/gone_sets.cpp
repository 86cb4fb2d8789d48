// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/gone_sets.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "deck/rules/mesh_cards.h"
#include "deck/rules/rules.h"

namespace femscalpel {
namespace {

/// Who names a gone set.
struct Naming {
    std::string first;  ///< "deck.inp:12 (*CLOAD)"
    int more = 0;
};

class GoneSets {
public:
    explicit GoneSets(const Mesh& mesh, const SolverInput& deck) : deck_(deck), naming_(deck.sets().size()) {
        for (std::size_t s = 0; s < deck.sets().size(); ++s) {
            const DeckSet& set = deck.sets()[s];
            if (mesh.find_group(set.group, group_kind(set.type)))
                there_.insert(deck_key(set.name));
            else
                gone_[deck_key(set.name)].push_back(s);
        }
    }

    std::vector<std::string> named() {
        std::vector<std::string> out;
        if (gone_.empty()) return out;
        const CardRules rules;
        for (const Card& card : deck_.cards())
            if (const CardRule* rule = rules.find(card); rule && !is_mesh_card(card) && card.keyword != "HEADING")
                look(card, *rule);
        for (std::size_t s = 0; s < naming_.size(); ++s) {
            if (naming_[s].first.empty()) continue;
            const DeckSet& set = deck_.sets()[s];
            const int more = naming_[s].more;
            out.push_back(std::string(to_string(set.type)) + " '" + set.name + "' is not in the mesh any more, but " +
                          naming_[s].first +
                          (more > 0 ? " and " + std::to_string(more) + " more name it" : " names it") +
                          ": CalculiX will stop there. Take what names it out of the deck, or put the group back");
        }
        return out;
    }

private:
    void look(const Card& card, const CardRule& rule) {
        const auto look_up = [&](const std::string& where, const std::string& name, bool typed, auto may_be) {
            const std::string key = deck_key(name);
            const auto gone = gone_.find(key);
            if (gone == gone_.end() || (!typed && there_.contains(key))) return;
            for (const std::size_t s : gone->second)
                if (may_be(deck_.sets()[s].type)) add(s, where + " (*" + card.keyword + ")");
        };
        const auto is_surface = [](DeckSetType type) {
            return type == DeckSetType::node_surface || type == DeckSetType::element_surface;
        };
        for (const CardParameter& p : card.parameters) {
            if (p.name == "NSET")
                look_up(card.where(), p.value, true, [](DeckSetType type) { return type == DeckSetType::nset; });
            if (p.name == "ELSET")
                look_up(card.where(), p.value, true, [](DeckSetType type) { return type == DeckSetType::elset; });
            if (p.name == "SURFACE") look_up(card.where(), p.value, true, is_surface);
        }
        const bool anywhere = card.keyword == "EQUATION" || card.keyword == "NETWORKMPC";
        const int names = anywhere ? std::numeric_limits<int>::max() : std::max(1, rule.names_per_line());
        CardReader line(card);
        while (line.next_data_line())
            for (int k = 0; k < names && !line.at_end(); ++k) {
                const std::string name = line.field();
                if (!gone_.contains(deck_key(name))) continue;
                const std::string where = line.where();
                look_up(where.substr(0, where.size() - 2), name, false, [](DeckSetType) { return true; });
            }
    }

    void add(std::size_t set, const std::string& where) {
        if (naming_[set].first.empty())
            naming_[set].first = where;
        else
            ++naming_[set].more;
    }

    const SolverInput& deck_;
    std::map<std::string, std::vector<std::size_t>> gone_;  // by key of the name: sets of the deck
    std::set<std::string> there_;                           // keys of names
    std::vector<Naming> naming_;                            // by set
};

}  // namespace

std::vector<std::string> named_gone_sets(const Mesh& mesh) {
    const SolverInput* deck = solver_input(mesh);
    return deck ? GoneSets(mesh, *deck).named() : std::vector<std::string>();
}

}  // namespace femscalpel
