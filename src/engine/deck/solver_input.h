// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cancel.h"
#include "mesh/companion.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// One file a deck was read from, unpacked.
struct DeckFile {
    std::string path;  ///< for messages; empty for text made by a program
    std::string text;
    bool carried = false;  ///< made from a line of another file: `path` is the place of that
};

/// Whole consecutive lines of one file.
struct DeckText {
    std::shared_ptr<const DeckFile> file;
    std::string_view text;  ///< inside file->text
    Index line = 1;         ///< number of the first line in the file

    /// "deck.inp:12", for messages about a line of the file.
    std::string where(Index its_line) const;
};

/// NAME=value on a keyword line. Names are upper case without blanks; values are as written, trimmed.
struct CardParameter {
    std::string name;
    std::string value;
};

/// A keyword card of a CalculiX / Abaqus deck: its keyword line, its data lines, and the comments
/// around them up to the next keyword.
struct Card {
    /// Upper case, without asterisk and blanks ("SOLIDSECTION"). Empty for text before the first card.
    std::string keyword;
    std::vector<CardParameter> parameters;
    /// The card as written, in pieces where *INCLUDE was resolved. The first `head` bytes of the first
    /// piece are the keyword line with its continuation lines.
    std::vector<DeckText> text;
    std::size_t head = 0;
    /// *NODE and *ELEMENT cards: the hidden mesh group that holds the card's nodes or elements. Who has
    /// it is written under this card. Empty for other cards.
    std::string group;

    /// Value of a parameter (name in upper case), or none; a parameter without '=' has an empty value.
    const std::string* parameter(std::string_view name) const;
    /// "deck.inp:12", for messages.
    std::string where() const;
    /// Replaces the whole card's text; `new_text` starts with the keyword line. Keyword and parameters
    /// follow it; `group` stays.
    void set_text(std::string new_text);
};

/// What kind of set a card defines. CalculiX keeps one list of names per type.
enum class DeckSetType : std::uint8_t { nset, elset, node_surface, element_surface };

/// A set or surface of the deck and the mesh group that now holds its members.
struct DeckSet {
    DeckSetType type = DeckSetType::nset;
    std::string name;   ///< as first written
    std::string group;  ///< a group of kind group_kind(type); differs from `name` only where both a
                        ///< node set and a node surface have that name
    /// Members no group can hold: elements outside the mesh (see OtherElement, submodels) as (number, 0),
    /// surface faces of beams and such as (number, face label 1 to 6).
    std::vector<std::array<Index, 2>> unheld;
    /// How many numbers and names its cards mentioned that the deck did not define.
    Index absent = 0;
    /// Made by an operator for loads that must not multiply (carry_over.h): new nodes do not join it.
    bool closed = false;
};

/// An element that has no place in the mesh: of a user type, or a network element without an end node.
/// It is written back as it was read. Its number must stay free and its nodes must stay.
struct OtherElement {
    Index number = 0;
    std::string type;          ///< label as in the deck
    std::vector<Index> nodes;  ///< node numbers, 0 where the deck says so
    std::size_t card = 0;      ///< index into SolverInput::cards()
};

/// How an instance of a part of the file that was read is numbered in the mesh (io/flatten_parts.h).
struct DeckInstance {
    std::string name;  ///< as in the file; empty: what stands in the assembly itself, as reference points do
    std::string part;  ///< the part's name; empty for the assembly
    Index offset = 0;  ///< number in the mesh less number in the part, of nodes and of elements
    std::array<Index, 2> nodes{};     ///< first and last number in the mesh as it was read; 0 without any
    std::array<Index, 2> elements{};  ///< the same of elements
};

/// The deck around a mesh, its companion: every card in order, verbatim, and which of them define what. A value type:
/// copies share the text of the files. It says what to write in which order; the mesh says what nodes,
/// elements and groups there are now (io/inp.h).
class SolverInput : public Companion {
public:
    const std::vector<Card>& cards() const { return cards_; }
    std::vector<Card>& cards() { return cards_; }

    const std::vector<DeckSet>& sets() const { return sets_; }
    std::vector<DeckSet>& sets() { return sets_; }

    const std::vector<OtherElement>& other_elements() const { return other_elements_; }
    std::vector<OtherElement>& other_elements() { return other_elements_; }

    /// What was odd in the deck but did not keep it from being read, as CalculiX warns and goes on.
    const std::vector<std::string>& warnings() const { return warnings_; }
    std::vector<std::string>& warnings() { return warnings_; }

    /// The instances of parts the deck was put together from, in their order; none of a deck without parts.
    const std::vector<DeckInstance>& instances() const { return instances_; }
    std::vector<DeckInstance>& instances() { return instances_; }

    /// Whether edges between elements of second and of first order are kept straight where the deck is written
    /// (edge_ties.h).
    bool ties_orders() const { return ties_orders_; }
    void set_ties_orders(bool ties) { ties_orders_ = ties; }

    /// Whether the deck was written with a set that keeps those without members (io/last_set.h).
    bool has_last_set() const { return has_last_set_; }
    void set_has_last_set(bool has) { has_last_set_ = has; }

    /// Of elements beside the mesh, and of numbers kept free.
    Index largest_other_element() const override;
    Index largest_other_node() const override { return kept_node_; }
    Index kept_element() const { return kept_element_; }
    /// Keeps new nodes and elements from numbers up to these (rules/absent_numbers.h).
    void keep_numbers(Index node, Index element) {
        kept_node_ = node;
        kept_element_ = element;
    }

    /// The set keeps its name, which the cards name it by, and holds the group.
    std::shared_ptr<const Companion> with_renamed_group(GroupKind kind, const std::string& old_name,
                                                        const std::string& new_name) const override;

private:
    std::vector<Card> cards_;
    std::vector<DeckSet> sets_;
    std::vector<OtherElement> other_elements_;
    std::vector<std::string> warnings_;
    std::vector<DeckInstance> instances_;
    bool ties_orders_ = false, has_last_set_ = false;
    Index kept_node_ = 0, kept_element_ = 0;
};

/// The deck of a mesh; null if it was not read from one. Lives as long as the mesh has it.
const SolverInput* solver_input(const Mesh& mesh);

/// Kind of the mesh group that holds sets of this type.
GroupKind group_kind(DeckSetType type);

/// "node set", "element set", "node surface" or "element surface".
std::string_view to_string(DeckSetType type);

/// How CalculiX compares names: upper case, without blanks.
std::string deck_key(std::string_view name);

/// A field as a finite number, read as CalculiX does: blanks mean nothing, Fortran exponents count, an empty field is
/// 0.
std::optional<double> deck_number(std::string_view field);

/// Splits a keyword line (with continuation lines joined) into keyword and parameters.
void parse_keyword(std::string_view line, std::string& keyword, std::vector<CardParameter>& parameters);

/// Walks over the lines of a card and the comma-separated fields of a line, as CalculiX reads them:
/// blanks mean nothing, blank lines and comments (**) are skipped, Fortran exponents (1.d0) are numbers.
class CardReader {
public:
    explicit CardReader(const Card& card) : card_(&card) {}

    /// Goes to the next line of any kind after the keyword; false at the end of the card.
    bool next_line();
    /// Goes to the next line with data.
    bool next_data_line();

    bool is_data() const { return is_data_; }
    /// The current line with its line end.
    std::string_view raw() const { return {line_, static_cast<std::size_t>(next_ - line_)}; }
    /// The current line without line end.
    std::string_view line() const { return {line_, static_cast<std::size_t>(end_ - line_)}; }

    /// No further field on this line. A comma at the end of a line opens no field.
    bool at_end();
    /// Reads the next field as a whole number; false without moving on if it is not one.
    bool integer(Index& value);
    /// Reads the next field as a finite number; an empty field is 0; false without moving on otherwise.
    bool number(double& value);
    /// The number just read fits CalculiX's 20 characters, or is hardly different when cut to them.
    bool fits_calculix() const { return fits_; }
    /// Reads the next field, without blanks.
    std::string field();
    /// What is left of the line, as written.
    std::string_view rest() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }
    /// The line has a comma as its last character.
    bool ends_with_comma() const;

    /// "deck.inp:12: ", the current line, for messages.
    std::string where() const;

private:
    std::string_view peek() const;
    void skip(std::string_view field);

    const Card* card_;
    std::size_t piece_ = 0;
    const char* line_ = nullptr;  // start of the current line
    const char* at_ = nullptr;    // where the next field starts
    const char* end_ = nullptr;   // end of the current line's content
    const char* next_ = nullptr;  // start of the next line
    bool is_data_ = false;
    bool fits_ = true;
    SparseCheck check_{256};
};

}  // namespace femscalpel
