// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "cancel.h"
#include "deck/edge_ties.h"
#include "deck/rules/absent_numbers.h"
#include "deck/solver_element.h"
#include "deck/solver_input.h"
#include "deck/solver_sets.h"
#include "io/abaqus_cards.h"
#include "io/flatten_parts.h"
#include "io/inp.h"
#include "io/inp_cards.h"
#include "io/inp_file.h"
#include "io/inp_numbers.h"
#include "io/last_set.h"
#include "utf8.h"

namespace femscalpel {
namespace {

namespace fs = std::filesystem;

class DeckReader {
public:
    explicit DeckReader(const fs::path& path) : shown_(shown_path(path)), input_(std::make_shared<SolverInput>()) {
        input_->cards() = read_cards(path, mesh_.remarks);
        refuse_generated_mesh(input_->cards());
        flatten_parts(*input_);
        input_->set_has_last_set(remove_last_set(input_->cards()));
        input_->set_ties_orders(remove_edge_ties(input_->cards()));
        fs::path stem = path.filename();
        if (is_packed(stem)) stem = stem.stem();
        mesh_.name = shown_path(stem.stem());
    }

    Mesh read() {
        declare_groups();
        read_nodes();
        read_elements();
        list_nodes_of_element_sets(mesh_, *input_);
        read_sets();
        warn_of_idle_constraints(*input_);
        warn_of_newer_cards(*input_);
        warn_of_absent_numbers(mesh_, *input_);
        mesh_.companion = input_;
        return std::move(mesh_);
    }

private:
    /// Groups in the order of the deck: a hidden one per *NODE and *ELEMENT card, one per set.
    void declare_groups() {
        std::unordered_map<std::string, int> count;
        std::unordered_set<std::string> seen, nset_names;
        for (Card& card : input_->cards()) {
            if (card.keyword == "NODE" || card.keyword == "ELEMENT") {
                card.group = "*" + card.keyword + "#" + std::to_string(++count[card.keyword]);
                mesh_.groups.push_back(
                    {card.group, card.keyword == "NODE" ? GroupKind::node : GroupKind::element, true});
                card_groups_.push_back(static_cast<GroupIndex>(mesh_.groups.size()) - 1);
            } else {
                card_groups_.push_back(-1);
                refuse_missing_comma(card);
            }
            const auto set = set_of_card(card);
            if (!set ||
                !seen.insert(static_cast<char>('0' + static_cast<int>(set->first)) + deck_key(set->second)).second)
                continue;
            if (set->first == DeckSetType::nset) nset_names.insert(set->second);
            input_->sets().push_back({set->first, set->second, set->second, {}, 0});
            set_groups_.push_back(static_cast<GroupIndex>(mesh_.groups.size()));
            mesh_.groups.push_back({set->second, group_kind(set->first), false});
        }
        for (std::size_t s = 0; s < set_groups_.size(); ++s) {
            DeckSet& set = input_->sets()[s];
            if (set.type != DeckSetType::node_surface) continue;
            while (nset_names.contains(set.group)) set.group += "_SURFACE";
            nset_names.insert(set.group);
            mesh_.groups[static_cast<std::size_t>(set_groups_[s])].name = set.group;
        }
    }

    /// "*NODE NSET=A" reads as *NODE in CalculiX and loses the set; it is not what the user meant.
    void refuse_missing_comma(const Card& card) const {
        for (std::string_view keyword : {"NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"})
            if (card.keyword.starts_with(keyword) && card.keyword.find('=') != std::string::npos)
                throw ReadError(card.where() + ": a comma is missing after *" + std::string(keyword));
    }

    Index positive_number(CardReader& line, std::string_view what) {
        Index id = 0;
        if (!line.integer(id))
            throw ReadError(line.where() + "'" + line.field() + "' is not " + std::string(what) + " number");
        if (id <= 0 || id > largest_deck_number)
            throw ReadError(line.where() + std::string(what) + " number " + std::to_string(id) +
                            " is not between 1 and " + std::to_string(largest_deck_number));
        return id;
    }

    void read_nodes() {
        std::size_t bytes = 0;
        for (const Card& card : input_->cards())
            if (card.keyword == "NODE")
                for (const DeckText& t : card.text) bytes += t.text.size();
        mesh_.points.reserve(bytes / 48);
        mesh_.node_ids.reserve(bytes / 48);
        std::vector<std::size_t> card_of_first, first_node;  // the nodes of a card follow each other
        for (std::size_t c = 0; c < input_->cards().size(); ++c) {
            const Card& card = input_->cards()[c];
            if (card.keyword != "NODE") continue;
            warn_of_parameters(card, {"NSET"});
            card_of_first.push_back(c);
            first_node.push_back(mesh_.points.size());
            const FamilyIndex family = mesh_.families.with(0, card_groups_[c]);
            CardReader line(card);
            Index cut = 0;
            std::string first_cut;
            while (line.next_data_line()) {
                const Index id = positive_number(line, "a node");
                Vec3 x(0, 0, 0);
                bool fits = true;
                for (int k = 0; k < 3 && !line.at_end(); ++k) {
                    if (!line.number(x[k]))
                        throw ReadError(line.where() + "coordinate " + std::to_string(k + 1) + " of node " +
                                        std::to_string(id) + ", '" + line.field() + "', is not a finite number");
                    fits = fits && line.fits_calculix();
                }
                if (!fits && cut++ == 0) first_cut = line.where();
                mesh_.points.push_back(x);
                mesh_.node_ids.push_back(id);
                mesh_.node_families.push_back(family);
            }
            if (cut > 0)
                input_->warnings().push_back(first_cut + std::to_string(cut) +
                                             " nodes, this one first, have coordinates of more than 20 "
                                             "characters; CalculiX cuts them and gets other values");
        }
        if (mesh_.points.empty()) throw ReadError(shown_ + ": there are no nodes in this file");
        merge_repeated_nodes(card_of_first, first_node);
    }

    /// A node may be repeated with the same coordinates; it then belongs to both cards.
    void merge_repeated_nodes(const std::vector<std::size_t>& cards, const std::vector<std::size_t>& first_node) {
        {
            const NumberIndex numbers(mesh_);
            bool repeated = false;
            SparseCheck check(1 << 14);
            for (Index i = 0; i < mesh_.node_count() && !repeated; ++i, check())
                repeated = *numbers.node(mesh_.node_ids[i]) != i;
            if (!repeated) return;
        }
        std::unordered_map<Index, std::size_t> first;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
            const auto [it, is_new] = first.emplace(mesh_.node_ids[i], kept);
            const std::size_t k = it->second;
            if (is_new) {
                mesh_.points[k] = mesh_.points[i];
                mesh_.node_ids[k] = mesh_.node_ids[i];
                mesh_.node_families[k] = mesh_.node_families[i];
                ++kept;
                continue;
            }
            if (mesh_.points[k] != mesh_.points[i]) {
                const auto card = std::ranges::upper_bound(first_node, i) - first_node.begin() - 1;
                const auto in_card = i - first_node[static_cast<std::size_t>(card)];
                CardReader line(input_->cards()[cards[static_cast<std::size_t>(card)]]);
                for (std::size_t n = 0; n <= in_card; ++n) line.next_data_line();
                throw ReadError(line.where() + "node " + std::to_string(mesh_.node_ids[i]) +
                                " was defined before with other coordinates");
            }
            mesh_.node_families[k] = mesh_.families.unite(mesh_.node_families[k], mesh_.node_families[i]);
        }
        mesh_.points.resize(kept);
        mesh_.node_ids.resize(kept);
        mesh_.node_families.resize(kept);
    }

    void warn_of_parameters(const Card& card, std::initializer_list<std::string_view> known) {
        for (const CardParameter& p : card.parameters)
            if (std::ranges::find(known, std::string_view(p.name)) == known.end())
                input_->warnings().push_back(card.where() + ": *" + card.keyword + " has no parameter " + p.name +
                                             " in CalculiX; it is kept but means nothing here");
    }

    void read_elements() {
        const NumberIndex nodes(mesh_);
        for (std::size_t c = 0; c < input_->cards().size(); ++c) {
            const Card& card = input_->cards()[c];
            if (card.keyword != "ELEMENT") continue;
            warn_of_parameters(card, {"TYPE", "ELSET", "PARENT", "DLOAD"});
            const std::string* label = card.parameter("TYPE");
            if (!label || deck_key(*label).empty()) throw ReadError(card.where() + ": *ELEMENT needs TYPE=");
            if (const auto type = deck_element_type(*label))
                read_card(c, card, *type, nodes);
            else if (deck_key(*label).starts_with('U'))
                read_user_elements(c, card, nodes);
            else
                refuse_type(card, *label);
        }
        check_element_numbers();
    }

    [[noreturn]] static void refuse_type(const Card& card, const std::string& label) {
        const std::string key = deck_key(label);
        throw ReadError(card.where() + ": elements of type " + label + " are not known to CalculiX" +
                        (key.starts_with("COH") || key.starts_with("GK")
                             ? ", and nothing here knows which of their sides may open; leave them out, and join what "
                               "they join by *TIE or *CONTACT PAIR"
                             : "; take a type that CalculiX has, or leave them out"));
    }

    void read_card(std::size_t c, const Card& card, const DeckElementType& type, const NumberIndex& nodes) {
        const auto count = static_cast<std::size_t>(traits(type.cell).nodes);
        const bool network = deck_key(*card.parameter("TYPE")) == "D";
        const FamilyIndex family = mesh_.families.with(0, card_groups_[c]);
        CellBlock& block = mesh_.block(type.cell);
        std::size_t bytes = 0;
        for (const DeckText& t : card.text) bytes += t.text.size();
        block.connectivity.reserve(block.connectivity.size() + bytes / 8);
        std::vector<Index> record(count);
        Index odd = 0;
        CardReader line(card);
        while (line.next_data_line()) {
            const Index id = positive_number(line, "an element");
            bool loose_end = false;  // a line ended without comma before the element was complete
            for (std::size_t k = 0; k < count;) {
                if (line.at_end()) {
                    loose_end = loose_end || !line.ends_with_comma();
                    if (!line.next_data_line()) fail_truncated(card, id, k, count);
                    continue;
                }
                Index node = 0;
                if (!line.integer(node))
                    throw ReadError(line.where() + "'" + line.field() + "' in element " + std::to_string(id) +
                                    " is not a node number");
                if (node == 0 && network && k != 1) {
                    record[k++] = -1;
                    continue;
                }
                const auto index = nodes.node(node);
                if (!index)
                    throw ReadError(line.where() + "element " + std::to_string(id) + " names node " +
                                    std::to_string(node) + ", which the deck does not define");
                record[k++] = *index;
            }
            if (!line.at_end()) {
                if (loose_end) fail_truncated_at(line, id, count);
                ++odd;
            }
            if (network && std::ranges::find(record, -1) != record.end()) {
                OtherElement other{id, *card.parameter("TYPE"), {}, c};
                for (Index n : record) other.nodes.push_back(n < 0 ? 0 : mesh_.node_ids[n]);
                input_->other_elements().push_back(std::move(other));
                continue;
            }
            swap_node_order(type.cell, record);
            if (const auto pyramid = pyramid_from_deck(type.cell, record)) {
                mesh_.add_cell(pyramid->first, pyramid->second, id, family);
                continue;
            }
            block.connectivity.insert(block.connectivity.end(), record.begin(), record.end());
            block.ids.push_back(id);
            block.families.push_back(family);
        }
        if (odd > 0)
            input_->warnings().push_back(card.where() + ": " + std::to_string(odd) + " elements of type " +
                                         *card.parameter("TYPE") + " are followed by more than " +
                                         std::to_string(count) + " node numbers; CalculiX ignores the rest");
    }

    [[noreturn]] static void fail_truncated(const Card& card, Index id, std::size_t found, std::size_t count) {
        CardReader line(card), last(card);
        while (line.next_data_line()) last = line;
        throw ReadError(last.where() + "element " + std::to_string(id) + " ends after " + std::to_string(found) +
                        " of its " + std::to_string(count) + " nodes");
    }

    [[noreturn]] static void fail_truncated_at(const CardReader& line, Index id, std::size_t count) {
        throw ReadError(line.where() + "element " + std::to_string(id) +
                        ", which starts before this line, has not its " + std::to_string(count) + " nodes");
    }

    /// User elements have as many nodes as their *USER ELEMENT card says; without one, an element ends
    /// with the first line that does not end in a comma.
    void read_user_elements(std::size_t c, const Card& card, const NumberIndex& nodes) {
        const std::string label = deck_key(*card.parameter("TYPE"));
        Index count = 0;
        for (const Card& other : input_->cards()) {
            const std::string* type = other.parameter("TYPE");
            const std::string* number = other.parameter("NODES");
            if (other.keyword != "USERELEMENT" || !type || !number || deck_key(*type) != label) continue;
            count = std::strtol(number->c_str(), nullptr, 10);
        }
        CardReader line(card);
        while (line.next_data_line()) {
            OtherElement element{positive_number(line, "an element"), *card.parameter("TYPE"), {}, c};
            while (count > 0 ? static_cast<Index>(element.nodes.size()) < count : true) {
                if (line.at_end()) {
                    if (count <= 0 && !line.ends_with_comma()) break;
                    if (!line.next_data_line())
                        fail_truncated(card, element.number, element.nodes.size(),
                                       static_cast<std::size_t>(std::max<Index>(count, 0)));
                    continue;
                }
                Index node = 0;
                if (!line.integer(node) || (node != 0 && !nodes.node(node)))
                    throw ReadError(line.where() + "element " + std::to_string(element.number) + " names node " +
                                    (node ? std::to_string(node) : "'" + line.field() + "'") +
                                    ", which the deck does not define");
                element.nodes.push_back(node);
            }
            input_->other_elements().push_back(std::move(element));
        }
    }

    void check_element_numbers() const {
        const NumberIndex numbers(mesh_);
        std::optional<Index> twice;
        SparseCheck check(1 << 14);
        for (const CellBlock& b : mesh_.blocks())
            for (Index i = 0; i < b.size() && !twice; ++i, check())
                if (*numbers.cell(b.ids[i]) != CellRef{b.type, i}) twice = b.ids[i];
        std::unordered_set<Index> others;
        for (const OtherElement& e : input_->other_elements())
            if (numbers.cell(e.number) || !others.insert(e.number).second) twice = e.number;
        if (!twice) return;
        std::string first;
        for (const Card& card : input_->cards()) {
            if (card.keyword != "ELEMENT") continue;
            const auto type = deck_element_type(*card.parameter("TYPE"));
            CardReader line(card);
            while (line.next_data_line()) {
                Index id = 0;
                line.integer(id);
                if (id == *twice && !first.empty())
                    throw ReadError(line.where() + "element number " + std::to_string(id) + " is used before (" +
                                    first + "); give one of the two elements another number");
                if (id == *twice) first = line.where().substr(0, line.where().size() - 2);
                for (int k = 0; type && k < traits(type->cell).nodes;) {
                    Index unused = 0;
                    if (!line.at_end())
                        k += line.integer(unused);
                    else
                        line.next_data_line();
                }
            }
        }
        throw ReadError(shown_ + ": element number " + std::to_string(*twice) + " is used twice");
    }

    void read_sets() {
        for (const Card& card : input_->cards()) {
            if (card.keyword == "NSET") warn_of_parameters(card, {"NSET", "GENERATE"});
            if (card.keyword == "ELSET") warn_of_parameters(card, {"ELSET", "GENERATE"});
            if (card.keyword == "SURFACE") warn_of_parameters(card, {"NAME", "TYPE"});
        }
        const NumberIndex numbers(mesh_);
        const auto contributed = members_by_card(mesh_, *input_);
        std::vector<SetMembers> sets = evaluate_sets(mesh_, numbers, *input_, contributed, {}, &input_->warnings());
        std::vector<std::pair<std::array<Index, 3>, GroupIndex>> facets;  // type, cell, face
        SparseCheck check;
        for (std::size_t s = 0; s < sets.size(); ++s) {
            DeckSet& set = input_->sets()[s];
            set.unheld = std::move(sets[s].unheld);
            set.absent = sets[s].absent;
            const GroupIndex group = set_groups_[s];
            std::vector<FamilyIndex> with;  // by family, computed when first needed
            const auto join = [&](FamilyIndex& f) {
                if (static_cast<std::size_t>(f) >= with.size()) with.resize(static_cast<std::size_t>(f) + 1, -1);
                if (with[static_cast<std::size_t>(f)] < 0)
                    with[static_cast<std::size_t>(f)] = mesh_.families.with(f, group);
                f = with[static_cast<std::size_t>(f)];
            };
            for (Index member : sets[s].members) {
                check();
                if (group_kind(set.type) == GroupKind::node) {
                    join(mesh_.node_families[*numbers.node(member)]);
                } else if (group_kind(set.type) == GroupKind::element) {
                    const CellRef ref = *numbers.cell(member);
                    join(mesh_.block(ref.type).families[ref.cell]);
                } else {
                    const CellRef ref = *numbers.cell(member / 8);
                    facets.push_back({{static_cast<Index>(ref.type), ref.cell, member % 8}, group});
                }
            }
        }
        const std::vector<char> planes = plane_families(mesh_, *input_);
        std::ranges::sort(facets);
        std::vector<GroupIndex> groups;
        for (std::size_t i = 0; i < facets.size();) {
            const auto key = facets[i].first;
            groups.clear();
            for (; i < facets.size() && facets[i].first == key; ++i) groups.push_back(facets[i].second);
            const auto type = static_cast<CellType>(key[0]);
            const bool plane =
                planes[static_cast<std::size_t>(mesh_.block(type).families[static_cast<std::size_t>(key[1])])];
            mesh_.facets.push_back({type,
                                    static_cast<std::int8_t>(face_from_label(static_cast<int>(key[2]), type, plane)),
                                    mesh_.families.intern(groups), key[1]});
        }
        std::ranges::sort(mesh_.facets, {}, [](const Facet& f) {
            return std::array<Index, 3>{static_cast<Index>(f.type), f.cell, f.face};
        });
        compact_families(mesh_);
    }

    std::string shown_;
    std::shared_ptr<SolverInput> input_;
    Mesh mesh_;
    std::vector<GroupIndex> card_groups_;  // per card: hidden group or -1
    std::vector<GroupIndex> set_groups_;   // per set
};

}  // namespace

Mesh read_inp(const fs::path& path) { return DeckReader(path).read(); }

}  // namespace femscalpel
