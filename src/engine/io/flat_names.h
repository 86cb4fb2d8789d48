// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "io/part_deck.h"

namespace femscalpel {

/// What a number in a deck counts.
enum class Numbered : std::uint8_t { node, element, either };

/// First and last number; none where the first is 0.
struct NumberRange {
    Index first = 0, last = 0;

    void include(Index number) {
        first = first == 0 ? number : std::min(first, number);
        last = std::max(last, number);
    }
    bool contains(Index number) const { return first > 0 && number >= first && number <= last; }
    bool meets(const NumberRange& other) const {
        return first > 0 && other.first > 0 && first <= other.last && other.first <= last;
    }
    NumberRange shifted(Index offset) const { return first > 0 ? NumberRange{first + offset, last + offset} : *this; }
};

/// How numbers and names of an instance, or of the assembly itself, are called in the flat deck.
struct FlatScope {
    std::string label;                           ///< "instance 'A-1'", for messages
    Index offset = 0;                            ///< added to numbers
    NumberRange nodes, elements;                 ///< numbers it has, before that
    std::vector<Index> node_list, element_list;  ///< all of them, ascending; empty where the range has no gaps
    std::unordered_map<std::string, std::string>
        names;              ///< sets, surfaces, orientations...: by name_key(), the new name
    Placement placement;    ///< of its coordinates
    bool is_alone = false;  ///< no other scope has numbers

    bool has_node(Index number) const;
    bool has_element(Index number) const;
};

/// The name a card gives to something of its part, instance or assembly, if it does: a set, a surface, an orientation,
/// a distribution, a tie or a coupling. The parameter that holds it, and its value.
const CardParameter* defined_name(const Card& card);

/// Says what numbers and names of a deck of parts are in the flat one.
class FlatNames {
public:
    /// Works out the numbers and names. Throws ReadError where there are not numbers enough for all instances.
    explicit FlatNames(const PartDeck& deck);

    const FlatScope& instance(std::size_t i) const { return instances_[i]; }
    const FlatScope& assembly() const { return assembly_; }
    /// The scope of the instance of that name; null if there is none.
    const FlatScope* find_instance(std::string_view name) const;

    /// Numbers in the assembly's and the steps' cards are those of the flat deck already.
    bool keeps_plain_numbers() const { return all_keep_ && assembly_.offset == 0; }

    /// What stands for a field of a card of `scope` in the flat deck, or none if it stays. The field is a number or a
    /// name: in an instance its own; in the assembly INSTANCE.NUMBER, INSTANCE.NAME, or the assembly's own (or the name
    /// of one instance alone). Calls `fail` with what is wrong with it.
    using Fail = std::function<void(const std::string&)>;
    std::optional<std::string> number_or_name(const FlatScope& scope, std::string_view field, Numbered what,
                                              const Fail& fail) const;
    /// The same of INSTANCE.NUMBER and INSTANCE.NAME alone, where it is not known whether the field is a reference;
    /// nothing fails.
    std::optional<std::string> if_reference(std::string_view field) const;

    /// Checks that a number of `scope` is one it has, and gives that of the flat deck. `by_name`: as INSTANCE.NUMBER;
    /// else numbers that nobody has are left to the reader where the scope is alone.
    static Index number(const FlatScope& scope, Index number, Numbered what, bool by_name, const Fail& fail);

private:
    void find_numbers(const PartDeck& deck);
    void find_names(const PartDeck& deck);
    void number_scope(FlatScope& scope, std::vector<const FlatScope*>& done, const std::string& where) const;
    std::optional<std::pair<const FlatScope*, std::string>> split_reference(std::string_view field) const;
    std::optional<std::string> name_in_assembly(std::string_view field, const Fail& fail) const;

    std::vector<FlatScope> instances_;
    FlatScope assembly_;
    std::unordered_map<std::string, std::size_t> by_name_;
    std::unordered_map<std::string, std::vector<std::size_t>> with_name_;  // instances that have a set of that name
    std::string assembly_key_;
    bool all_keep_ = true;  // no instance has other numbers than its part
};

/// The numbers of the elements of an *ELEMENT card, in its order.
std::vector<Index> elements_of(const Card& card);

/// A field as a whole number; none if it is not one.
std::optional<Index> whole_number(std::string_view field);

/// Tells the numbers of elements from those of their nodes on the lines of an *ELEMENT card.
class ElementLines {
public:
    explicit ElementLines(const Card& card);
    /// A new data line starts. `last` is the one before: an element of a type of which the number of nodes is not known
    /// goes on behind a comma.
    void start_line();
    /// What the next number of the line is; none behind the last node of an element.
    std::optional<Numbered> next();
    void end_line(bool with_comma);

private:
    Index count_ = 0;  // nodes of an element; 0 if not known
    Index left_ = 0;
    bool continues_ = false, fresh_ = false;
};

}  // namespace femscalpel
