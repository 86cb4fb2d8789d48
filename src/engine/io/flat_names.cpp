// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/flat_names.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "cancel.h"
#include "deck/solver_element.h"
#include "error.h"
#include "io/inp_numbers.h"

namespace femscalpel {
namespace {

constexpr std::size_t longest_name = 80;  // of a set in CalculiX

/// Adds the numbers a card defines to the scope's lists.
void scan_numbers(const Card& card, FlatScope& scope) {
    if (card.keyword == "ELEMENT") {
        const std::vector<Index> ids = elements_of(card);
        scope.element_list.insert(scope.element_list.end(), ids.begin(), ids.end());
    }
    if (card.keyword != "NODE") return;
    CardReader line(card);
    Index id = 0;
    while (line.next_data_line())
        if (line.integer(id) && id > 0) scope.node_list.push_back(id);
}

/// The range of numbers; of the list, what has gaps stays.
NumberRange range_of(std::vector<Index>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
    if (list.empty()) return {};
    const NumberRange out{list.front(), list.back()};
    if (out.last - out.first + 1 == static_cast<Index>(list.size())) list = {};
    return out;
}

void settle_numbers(FlatScope& scope) {
    scope.nodes = range_of(scope.node_list);
    scope.elements = range_of(scope.element_list);
}

bool has(const NumberRange& range, const std::vector<Index>& list, Index number) {
    return range.contains(number) && (list.empty() || std::ranges::binary_search(list, number));
}

/// The least number of one digit and zeros, at least one, that is not less.
Index rounded_up(Index number) {
    Index unit = 10;
    while (number / unit >= 10) unit *= 10;
    return (number + unit - 1) / unit * unit;
}

/// INSTANCE_NAME, or where that is too long or taken, with a number behind it.
std::string prefixed(const std::string& instance, const std::string& name,
                     const std::unordered_set<std::string>& taken) {
    for (int n = 1;; ++n) {
        const std::string tail = n == 1 ? "" : "_" + std::to_string(n);
        std::string out = instance + "_" + name;
        if (name_key(out).size() + tail.size() > longest_name) {
            std::erase_if(out, [](char c) { return c == ' ' || c == '\t'; });
            out.resize(longest_name - tail.size());
        }
        out += tail;
        if (!taken.contains(name_key(out))) return out;
    }
}

}  // namespace

std::vector<Index> elements_of(const Card& card) {
    std::vector<Index> out;
    CardReader line(card);
    ElementLines element(card);
    Index id = 0;
    while (line.next_data_line()) {
        element.start_line();
        for (bool more = true; more && !line.at_end();) {
            const auto what = element.next();
            more = what.has_value();
            if (!line.integer(id))
                line.field();
            else if (what == Numbered::element && id > 0)
                out.push_back(id);
        }
        element.end_line(line.ends_with_comma());
    }
    return out;
}

std::optional<Index> whole_number(std::string_view field) {
    while (!field.empty() && (field.front() == ' ' || field.front() == '\t')) field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '\t' || field.back() == '\r'))
        field.remove_suffix(1);
    if (field.starts_with('+')) field.remove_prefix(1);
    Index value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) return {};
    return value;
}

ElementLines::ElementLines(const Card& card) {
    const std::string* label = card.parameter("TYPE");
    if (const auto type = label ? deck_element_type(*label) : std::nullopt) count_ = traits(type->cell).nodes;
}

void ElementLines::start_line() { fresh_ = count_ > 0 ? left_ == 0 : !continues_; }

std::optional<Numbered> ElementLines::next() {
    if (fresh_) {
        fresh_ = false;
        left_ = count_;
        return Numbered::element;
    }
    if (count_ == 0) return Numbered::node;
    if (left_ == 0) return {};
    --left_;
    return Numbered::node;
}

void ElementLines::end_line(bool with_comma) { continues_ = with_comma; }

const CardParameter* defined_name(const Card& card) {
    constexpr std::pair<std::string_view, std::string_view> defining[] = {
        {"NODE", "NSET"},        {"ELEMENT", "ELSET"},    {"NSET", "NSET"}, {"ELSET", "ELSET"},
        {"SURFACE", "NAME"},     {"ORIENTATION", "NAME"}, {"TIE", "NAME"},  {"COUPLING", "CONSTRAINTNAME"},
        {"DISTRIBUTION", "NAME"}};
    for (const auto& [keyword, parameter] : defining)
        if (card.keyword == keyword)
            for (const CardParameter& p : card.parameters)
                if (p.name == parameter && !name_key(p.value).empty()) return &p;
    return nullptr;
}

FlatNames::FlatNames(const PartDeck& deck) : instances_(deck.instances.size()), assembly_key_(name_key(deck.assembly)) {
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        instances_[i].label = "instance '" + deck.instances[i].name + "'";
        instances_[i].placement = deck.instances[i].placement;
        by_name_.emplace(name_key(deck.instances[i].name), i);
    }
    assembly_.label = "the assembly";
    find_numbers(deck);
    find_names(deck);
}

void FlatNames::find_numbers(const PartDeck& deck) {
    std::vector<const FlatScope*> done;
    std::unordered_map<const Card*, FlatScope> of_card;  // parts may have many instances
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        FlatScope& scope = instances_[i];
        for (const Card* card : deck.instances[i].cards) {
            const auto [it, is_new] = of_card.try_emplace(card);
            if (is_new) scan_numbers(*card, it->second);
            const FlatScope& from = it->second;
            scope.node_list.insert(scope.node_list.end(), from.node_list.begin(), from.node_list.end());
            scope.element_list.insert(scope.element_list.end(), from.element_list.begin(), from.element_list.end());
        }
        settle_numbers(scope);
        number_scope(scope, done, deck.instances[i].card->where());
        all_keep_ = all_keep_ && scope.offset == 0;
    }
    std::string where;
    for (const DeckItem& item : deck.items)
        if (item.card && !item.is_bracket) {
            scan_numbers(*item.card, assembly_);
            if (where.empty() && !assembly_.node_list.empty()) where = item.card->where();
        }
    settle_numbers(assembly_);
    number_scope(assembly_, done, where);
    if (done.size() == 1)
        for (FlatScope& scope : instances_) scope.is_alone = &scope == done.front();
}

void FlatNames::number_scope(FlatScope& scope, std::vector<const FlatScope*>& done, const std::string& where) const {
    bool clash = false;
    Index used = 0;
    for (const FlatScope* other : done) {
        const NumberRange nodes = other->nodes.shifted(other->offset),
                          elements = other->elements.shifted(other->offset);
        clash = clash || scope.nodes.meets(nodes) || scope.elements.meets(elements);
        used = std::max({used, nodes.last, elements.last});
    }
    const Index last = std::max(scope.nodes.last, scope.elements.last);
    // A number that no deck can hold is an error of the line it stands in.
    if (clash && std::max(used, last) <= largest_deck_number) {
        scope.offset = rounded_up(used);
        if (scope.offset + last > largest_deck_number) {
            Index first = last;
            for (const NumberRange& r : {scope.nodes, scope.elements})
                if (r.first > 0) first = std::min(first, r.first);
            scope.offset = used - first + 1;
        }
        if (scope.offset + last > largest_deck_number)
            throw ReadError(where + ": " + scope.label + " has numbers up to " + std::to_string(last) +
                            ", and numbers up to " + std::to_string(used) +
                            " are in use before it: together they are more than CalculiX can hold (" +
                            std::to_string(largest_deck_number) + "). Number the parts from 1");
    }
    if (last > 0) done.push_back(&scope);
}

void FlatNames::find_names(const PartDeck& deck) {
    std::unordered_map<std::string, int> count;
    std::set<std::pair<const FlatScope*, std::string>> quoted;
    const auto add = [&](FlatScope& scope, const Card& card, const CardParameter& p) {
        const auto [at, is_new] = scope.names.emplace(name_key(p.value), unquoted(p.value));
        // Quotes keep blanks, which CalculiX does not see.
        const auto blanks = [](const std::string& name) { return std::ranges::count(name, ' '); };
        if (p.value.find('"') != p.value.npos) quoted.emplace(&scope, at->first);
        if (!is_new && quoted.contains({&scope, at->first}) && blanks(at->second) != blanks(unquoted(p.value)))
            throw ReadError(card.where() + ": the names '" + unquoted(p.value) + "' and '" + at->second + "' of " +
                            scope.label + " differ in blanks alone, which CalculiX does not see; rename one");
        return is_new;
    };
    for (const DeckItem& item : deck.items)
        if (item.card && !item.is_bracket)
            if (const CardParameter* p = defined_name(*item.card))
                if (add(assembly_, *item.card, *p)) ++count[name_key(p->value)];
    for (std::size_t i = 0; i < instances_.size(); ++i)
        for (const Card* card : deck.instances[i].cards)
            if (const CardParameter* p = defined_name(*card)) {
                const std::string key = name_key(p->value);
                if (!add(instances_[i], *card, *p)) continue;
                ++count[key];
                with_name_[key].push_back(i);
            }
    std::unordered_set<std::string> taken;
    for (const auto& [key, n] : count) taken.insert(key);
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        std::vector<std::string> keys;  // in an order that does not depend on the table's
        for (const auto& [key, name] : instances_[i].names)
            if (count[key] > 1) keys.push_back(key);
        std::ranges::sort(keys);
        for (const std::string& key : keys) {
            std::string& name = instances_[i].names[key];
            name = prefixed(deck.instances[i].name, name, taken);
            taken.insert(name_key(name));
        }
    }
}

const FlatScope* FlatNames::find_instance(std::string_view name) const {
    const auto it = by_name_.find(name_key(name));
    return it == by_name_.end() ? nullptr : &instances_[it->second];
}

bool FlatScope::has_node(Index number) const { return has(nodes, node_list, number); }

bool FlatScope::has_element(Index number) const { return has(elements, element_list, number); }

Index FlatNames::number(const FlatScope& scope, Index number, Numbered what, bool by_name, const Fail& fail) {
    const bool is_there =
        (what != Numbered::element && scope.has_node(number)) || (what != Numbered::node && scope.has_element(number));
    if (!is_there && number != 0 && (by_name || !scope.is_alone)) {  // it could be a number of another
        const NumberRange& range = what == Numbered::element ? scope.elements : scope.nodes;
        const std::string kind = what == Numbered::element ? "element" : "node";
        fail(scope.label + " has no " + kind + (what == Numbered::either ? " and no element " : " ") +
             std::to_string(number) +
             (range.first > 0 ? ": its " + kind + "s are " + std::to_string(range.first) + " to " +
                                    std::to_string(range.last) + (range.contains(number) ? ", with gaps" : "")
                              : ": it has no " + kind + "s"));
    }
    return number == 0 ? 0 : number + scope.offset;
}

std::optional<std::pair<const FlatScope*, std::string>> FlatNames::split_reference(std::string_view field) const {
    std::string text = unquoted(field);
    if (text.find('.') == text.npos || deck_number(text)) return {};
    if (const std::size_t dot = text.find('.');
        !assembly_key_.empty() && name_key(text.substr(0, dot)) == assembly_key_ && !by_name_.contains(assembly_key_)) {
        text.erase(0, dot + 1);
        if (!text.empty() && text.find('.') == text.npos) return std::pair(&assembly_, text);
    }
    // The longest: names may have points, too.
    for (std::size_t dot = text.rfind('.'); dot != text.npos && dot > 0; dot = text.rfind('.', dot - 1))
        if (const FlatScope* scope = find_instance(text.substr(0, dot))) return std::pair(scope, text.substr(dot + 1));
    return {};
}

std::optional<std::string> FlatNames::if_reference(std::string_view field) const {
    std::optional<std::string> out;
    if (const auto reference = split_reference(field)) {
        const auto& [scope, rest] = *reference;
        if (const auto it = scope->names.find(name_key(rest)); it != scope->names.end()) return it->second;
        if (const auto id = whole_number(rest)) {
            bool good = true;
            const Index flat = number(*scope, *id, Numbered::either, true, [&](const std::string&) { good = false; });
            if (good) out = std::to_string(flat);
        }
    }
    return out;
}

std::optional<std::string> FlatNames::name_in_assembly(std::string_view field, const Fail& fail) const {
    const std::string text = unquoted(field), key = name_key(text);
    const auto own = assembly_.names.find(key);
    std::string flat = text;
    if (own != assembly_.names.end()) {
        flat = field.find('"') == field.npos ? text : own->second;
    } else if (const auto it = with_name_.find(key); it != with_name_.end()) {
        if (it->second.size() > 1)
            fail("'" + text + "' is a name in " + instances_[it->second[0]].label + " and in " +
                 instances_[it->second[1]].label + "; say which is meant, as INSTANCE." + text);
        flat = instances_[it->second[0]].names.at(key);
    } else if (const std::size_t dot = text.rfind('.'); dot != text.npos && !deck_number(text)) {
        fail("there is no instance '" + text.substr(0, dot) + "', and no set of the name '" + text + "'");
    }
    return name_key(flat) == key && field.find('"') == field.npos ? std::nullopt : std::optional(flat);
}

std::optional<std::string> FlatNames::number_or_name(const FlatScope& scope, std::string_view field, Numbered what,
                                                     const Fail& fail) const {
    const bool in_assembly = &scope == &assembly_;
    if (const auto id = whole_number(field)) {
        if (*id == 0) return {};
        Index flat = *id;
        if (!in_assembly) {
            flat = number(scope, *id, what, false, fail);
        } else if ((what != Numbered::element && assembly_.has_node(*id)) ||
                   (what != Numbered::node && assembly_.has_element(*id))) {
            flat += assembly_.offset;
        } else if (!all_keep_) {
            fail("number " + std::to_string(*id) +
                 " is not of the assembly itself; say which instance's is meant, as " + "INSTANCE." +
                 std::to_string(*id));
        }
        return flat == *id ? std::nullopt : std::optional(std::to_string(flat));
    }
    const std::string key = name_key(field);
    if (key.empty()) return {};
    if (!in_assembly)
        if (const auto it = scope.names.find(key); it != scope.names.end())
            return name_key(it->second) == key && field.find('"') == field.npos ? std::nullopt
                                                                                : std::optional(it->second);
    if (const auto reference = split_reference(field)) {
        const auto& [other, rest] = *reference;
        if (const auto id = whole_number(rest)) return std::to_string(number(*other, *id, what, true, fail));
        const auto it = other->names.find(name_key(rest));
        if (it != other->names.end()) return it->second;
        fail(other->label + " has no set, surface or orientation '" + rest + "'");
        return {};
    }
    return in_assembly ? name_in_assembly(field, fail) : std::nullopt;
}

}  // namespace femscalpel
