// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <memory>
#include <unordered_set>

#include "cancel.h"
#include "deck/edge_ties.h"
#include "deck/solver_element.h"
#include "deck/solver_input.h"
#include "deck/solver_sets.h"
#include "io/inp.h"
#include "io/inp_file.h"
#include "io/inp_numbers.h"
#include "io/inp_places.h"
#include "io/inp_sets.h"
#include "io/last_set.h"
#include "utf8.h"

namespace femscalpel {
namespace {

namespace fs = std::filesystem;

/// The text of a deck, see write_inp().
class DeckWriter {
public:
    explicit DeckWriter(const Mesh& mesh)
        : mesh_(mesh), input_(deck_of(mesh)), numbers_(mesh), index_(input_->sets()) {}

    std::string write() {
        if (mesh_.node_count() == 0) throw WriteError("the mesh has no nodes");
        check_number(mesh_.largest_node_id(), "node");
        check_number(mesh_.largest_cell_id(), "element");
        const std::string& first = input_->cards().front().text.front().file->text;
        const std::size_t newline = first.find('\n');
        if (newline != first.npos && newline > 0 && first[newline - 1] == '\r') eol_ = "\r\n";
        find_last_cards();
        places_ = find_deck_places(mesh_, *input_);
        plan_ = plan_sets(mesh_, *input_, numbers_, index_, places_);
        is_written_.assign(plan_.roles.size(), 0);
        ties_ = edge_ties(mesh_);
        std::size_t bytes = 1 << 16;
        for (const Card& card : input_->cards())
            for (const DeckText& t : card.text) bytes += t.text.size();
        out_.reserve(bytes + bytes / 8 + static_cast<std::size_t>(mesh_.node_count()) * 60);
        for (std::size_t c = 0; c < input_->cards().size(); ++c) write_card(c);
        if ((empties_ || input_->has_last_set()) && sets_.needs_last_set()) {
            std::string node;
            append_node(node, 0);
            out_.insert(first_node_card_, last_set_card(node, eol_));
        }
        return std::move(out_);
    }

private:
    static void check_number(Index largest, const char* what) {
        if (largest > largest_deck_number)
            throw WriteError("cannot be written: " + std::string(what) + " number " + std::to_string(largest) +
                             " is larger than CalculiX can hold (" + std::to_string(largest_deck_number) + ")");
    }

    static std::shared_ptr<const SolverInput> deck_of(const Mesh& mesh) {
        if (auto deck = std::dynamic_pointer_cast<const SolverInput>(mesh.companion); deck && !deck->cards().empty())
            return deck;
        std::string heading;
        for (char c : mesh.name) heading += c == '\n' || c == '\r' ? ' ' : c;
        if (heading.starts_with('*')) heading.insert(0, 1, ' ');
        const auto input = std::make_shared<SolverInput>();
        input->cards().emplace_back();
        input->cards().back().set_text("*HEADING\n" + heading + "\n");
        return input;
    }

    /// New things come after the last card of their kind.
    void find_last_cards() {
        for (std::size_t c = 0; c < input_->cards().size(); ++c) {
            const Card& card = input_->cards()[c];
            if (card.keyword == "NODE") last_node_card_ = c;
            if (card.keyword == "ELEMENT") last_element_card_ = c;
            if (card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE") last_mesh_card_ = c;
        }
        last_element_card_ = std::max(last_element_card_, last_node_card_);
        last_mesh_card_ = std::max(last_mesh_card_, last_element_card_);
    }

    std::optional<std::size_t> set_index(const Card& card) const { return femscalpel::set_index(index_, card); }

    void start_line() {
        if (!out_.empty() && out_.back() != '\n') out_ += eol_;
    }
    void put(std::string_view raw) {
        start_line();
        out_ += raw;
    }
    void put_line(std::string_view text) {
        put(text);
        out_ += eol_;
    }

    void write_card(std::size_t c) {
        const Card& card = input_->cards()[c];
        tail_.clear();
        if (card.keyword == "NODE")
            write_node_card(c, card);
        else if (card.keyword == "ELEMENT")
            write_element_card(c, card);
        else if (card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE")
            write_set_card(card);
        else
            for (const auto support = ties_.supports.find(c);
                 const DeckText& t : (support == ties_.supports.end() ? card : support->second).text)
                put(t.text);
        if (card.keyword == "NODE" || card.keyword == "ELEMENT")
            if (const auto s = set_index(card);
                s && !plan_.has_own_card[*s] && plan_.roles[*s].state == SetRole::replaced && !is_written_[*s])
                write_replaced_set(*s);
        if (c == last_node_card_) write_nodes_without_card();
        if (c == last_element_card_) write_free_elements();
        if (c == last_mesh_card_) {
            for (const NewSet& set : plan_.new_sets) write_set(set.type, set.name, set.members, {}, set.remark);
            put_ties();
        }
        for (std::string_view line : tail_) put(line);
    }

    /// What keeps edges straight, the supports aside.
    void put_ties() {
        const std::string& ties = ties_.text;
        for (std::size_t at = 0, end = 0; at < ties.size(); at = end + 1) {
            end = ties.find('\n', at);
            put_line(std::string_view(ties).substr(at, end - at));
        }
    }

    void write_head(std::size_t c, const Card& card, std::string_view set_parameter) {
        if (!plan_.drops_parameter[c]) {
            put(card.text.front().text.substr(0, card.head));
            if (const auto s = set_index(card)) {
                const auto in_card = [c](const OtherElement& e) { return e.card == c; };
                const bool any =
                    !plan_.contributed[c].empty() || std::ranges::any_of(input_->other_elements(), in_card);
                define(*s, any, true);
                empties_ = empties_ || (!any && CardReader(card).next_data_line());
            }
            return;
        }
        std::string head = "*" + card.keyword;
        for (const CardParameter& p : card.parameters)
            if (p.name != set_parameter) head += ", " + p.name + (p.value.empty() ? "" : "=" + p.value);
        put_line(head);
    }

    /// Comments are held back until a data line follows: what comes after the last one is the tail.
    void release_tail() {
        for (std::string_view line : tail_) put(line);
        tail_.clear();
    }

    void write_node_card(std::size_t c, const Card& card) {
        note_first_node_card();
        write_head(c, card, "NSET");
        if (node_written_under_.empty())
            node_written_under_.assign(static_cast<std::size_t>(mesh_.node_count()), DeckPlaces::none);
        CardReader line(card);
        while (line.next_line()) {
            if (!line.is_data()) {
                tail_.push_back(line.raw());
                continue;
            }
            const auto [node, is_same] = node_of_line(line, mesh_, numbers_);
            if (!node || !places_.stands_under(mesh_, *node, c)) continue;
            release_tail();
            node_written_under_[static_cast<std::size_t>(*node)] = c;
            if (is_same)
                put(line.raw());
            else
                put_node(*node);
        }
        for (Index id : plan_.members_of_card[c]) {
            const Index node = *numbers_.node(id);
            if (node_written_under_[static_cast<std::size_t>(node)] != c) put_node(node);
        }
    }

    void put_node(Index node) {
        check_();
        start_line();
        append_node(out_, node);
        out_ += eol_;
    }

    void append_node(std::string& line, Index node) const {
        append_integer(line, mesh_.node_ids[node]);
        for (int k = 0; k < 3; ++k) {
            line += ", ";
            append_coordinate(line, mesh_.points[node][k]);
        }
    }

    void note_first_node_card() {
        if (has_node_card_) return;
        has_node_card_ = true;
        start_line();
        first_node_card_ = out_.size();
    }

    void define(std::size_t s, bool has_members, bool by_mesh) {
        sets_.add(input_->sets()[s].type, input_->sets()[s].name, has_members, by_mesh);
    }

    void write_nodes_without_card() {
        bool first = true;
        for (Index i = 0; i < mesh_.node_count(); ++i) {
            if (!places_.node_cards_of_family[mesh_.node_families[i]].empty()) continue;
            note_first_node_card();
            if (first) put_line("*NODE");
            first = false;
            put_node(i);
        }
    }

    /// Nothing is left of what stood under an *ELEMENT card, and no set that is empty now needs the card.
    bool is_left_empty(std::size_t c, const Card& card) const {
        if (!plan_.members_of_card[c].empty() || !deck_element_type(*card.parameter("TYPE"))) return false;
        const auto in_card = [c](const OtherElement& e) { return e.card == c; };
        if (std::ranges::any_of(input_->other_elements(), in_card) || !CardReader(card).next_data_line()) return false;
        const auto s = set_index(card);
        return !s || plan_.drops_parameter[c] || !plan_.members[*s].empty() || !input_->sets()[*s].unheld.empty();
    }

    void write_element_card(std::size_t c, const Card& card) {
        if (!is_left_empty(c, card)) write_head(c, card, "ELSET");
        const auto type = deck_element_type(*card.parameter("TYPE"));
        if (!type) return put_data_lines(card);  // user elements, all kept beside the mesh
        std::unordered_set<Index> others;
        for (const OtherElement& e : input_->other_elements())
            if (e.card == c) others.insert(e.number);
        std::vector<Index> wanted(static_cast<std::size_t>(traits(type->cell).nodes));
        std::vector<std::string_view> record;
        CardReader line(card);
        while (line.next_line()) {
            if (!line.is_data()) {
                tail_.push_back(line.raw());
                continue;
            }
            Index id = 0;
            if (!line.integer(id)) continue;
            const auto found = numbers_.cell(id);
            const bool here = found && places_.card_of_family[mesh_.block(found->type).families[found->cell]] == c;
            if (here) {
                check_type(*found, *type, card);
                std::ranges::transform(nodes_as_written(*found, type->cell), wanted.begin(),
                                       [this](Index n) { return mesh_.node_ids[n]; });
                written(*found) = 1;
            }
            const bool keep = here || others.contains(id);
            if (keep) release_tail();
            const bool same = read_element(line, wanted, keep, record) || !here;
            if (keep && same)
                for (std::string_view raw : record) put(raw);
            else if (keep)
                put_element(*found, type->cell);
        }
        for (Index id : plan_.members_of_card[c]) {
            const CellRef ref = *numbers_.cell(id);
            check_type(ref, *type, card);
            if (!written(ref)) put_element(ref, type->cell);
        }
    }

    char& written(const CellRef& ref) {
        std::vector<char>& of_type = element_written_[static_cast<int>(ref.type)];
        if (of_type.empty()) of_type.assign(static_cast<std::size_t>(mesh_.block(ref.type).size()), 0);
        return of_type[static_cast<std::size_t>(ref.cell)];
    }

    /// Reads on behind an element's number to its last node; whether its nodes are `wanted`. Its lines come to
    /// `record`, with the comments between them if it is kept; these come to the tail otherwise.
    bool read_element(CardReader& line, std::span<const Index> wanted, bool keep,
                      std::vector<std::string_view>& record) {
        bool same = true;
        record.assign(1, line.raw());
        for (std::size_t k = 0; k < wanted.size();) {
            if (line.at_end()) {
                if (!line.next_line()) break;
                (line.is_data() || keep ? record : tail_).push_back(line.raw());
                continue;
            }
            Index node = 0;
            if (!line.is_data() || !line.integer(node)) {
                line.field();
                continue;
            }
            if (wanted[k] != node) same = false;
            ++k;
        }
        return same;
    }

    /// The lines of a card behind its head as they are, but what follows the data may have to wait for new cards.
    void put_data_lines(const Card& card) {
        CardReader line(card);
        while (line.next_line()) {
            if (line.is_data()) {
                release_tail();
                put(line.raw());
            } else {
                tail_.push_back(line.raw());
            }
        }
    }

    void check_type(CellRef ref, const DeckElementType& type, const Card& card) const {
        if (holds(type, ref.type)) return;
        throw WriteError("element " + std::to_string(mesh_.block(ref.type).ids[ref.cell]) + ", a " +
                         std::string(traits(ref.type).name) + ", stands under " + card.where() +
                         ", whose elements are of type " + *card.parameter("TYPE"));
    }

    /// Under a card for elements of the type `as`.
    std::vector<Index> nodes_as_written(CellRef ref, CellType as) const {
        std::vector<Index> nodes = deck_nodes(ref.type, mesh_.block(ref.type).nodes(ref.cell), as);
        swap_node_order(as, nodes);
        return nodes;
    }

    void put_element(CellRef ref, CellType as) {
        check_();
        const std::vector<Index> order = nodes_as_written(ref, as);
        start_line();
        append_integer(out_, mesh_.block(ref.type).ids[ref.cell]);
        for (std::size_t k = 0; k < order.size(); ++k) {
            out_ += ',';
            if (k == 15) out_ += eol_;  // CalculiX reads 16 entries per line
            out_ += ' ';
            append_integer(out_, mesh_.node_ids[order[k]]);
        }
        out_ += eol_;
    }

    void write_free_elements() {
        for (const CellBlock& b : mesh_.blocks()) {
            const std::vector<Fate>& fates = places_.fates_of(b.type);
            bool first = true;
            for (Index i = 0; i < b.size(); ++i) {
                if (fates[static_cast<std::size_t>(i)] != Fate::free) continue;
                const std::string_view label = default_deck_label(b.type);
                if (first) put_line("*ELEMENT, TYPE=" + std::string(label));
                first = false;
                put_element({b.type, i}, deck_element_type(label)->cell);
            }
        }
    }

    void write_set_card(const Card& card) {
        const auto s = set_index(card);
        if (!s || plan_.roles[*s].state == SetRole::by_cards) {
            put(card.text.front().text.substr(0, card.head));
            if (const bool has_lines = CardReader(card).next_data_line(); s && (has_lines || card.keyword == "SURFACE"))
                define(*s, has_lines, false);
            return put_data_lines(card);
        }
        if (plan_.roles[*s].state == SetRole::replaced && !is_written_[*s]) write_replaced_set(*s);
        CardReader line(card);
        while (line.next_line())
            if (!line.is_data()) tail_.push_back(line.raw());
    }

    /// Lists a set anew, but for what the NSET= and ELSET= of other cards give it already: CalculiX keeps
    /// repeated members, and prints and loads them twice.
    void write_replaced_set(std::size_t s) {
        is_written_[s] = 1;
        const DeckSet& set = input_->sets()[s];
        std::vector<Index> given, rest;
        std::vector<std::array<Index, 2>> unheld = set.unheld;
        bool defined = false;
        for (std::size_t c = 0; c < input_->cards().size(); ++c) {
            const Card& card = input_->cards()[c];
            if ((card.keyword != "NODE" && card.keyword != "ELEMENT") || plan_.drops_parameter[c] ||
                set_index(card) != s)
                continue;
            defined = true;
            given.insert(given.end(), plan_.contributed[c].begin(), plan_.contributed[c].end());
            for (const OtherElement& e : input_->other_elements())
                if (e.card == c) std::erase(unheld, std::array<Index, 2>{e.number, 0});
        }
        const std::vector<std::string_view> lines =
            lines_still_true(*input_, index_, plan_, numbers_, s, given, unheld);
        std::ranges::sort(given);
        std::ranges::set_difference(plan_.members[s], given, std::back_inserter(rest));
        if (defined && rest.empty() && unheld.empty()) return;
        if (set.type == DeckSetType::nset) put_in_order(*input_, index_, plan_, s, rest);
        write_set(set.type, set.name, rest, unheld, "", lines);
    }

    void write_set(DeckSetType type, const std::string& name, std::span<const Index> members,
                   std::span<const std::array<Index, 2>> unheld, const std::string& remark,
                   std::span<const std::string_view> lines = {}) {
        if (!remark.empty()) put_line(remark);
        const bool empty = members.empty() && unheld.empty();
        empties_ = empties_ || (empty && lines.empty());
        sets_.add(type, name, !empty || !lines.empty(),
                  empty && (type == DeckSetType::nset || type == DeckSetType::elset));
        switch (type) {
            case DeckSetType::nset:
                // CalculiX forgets an empty *NSET, but not the empty set of an empty *NODE card.
                put_line((empty ? "*NODE, NSET=" : "*NSET, NSET=") + name);
                break;
            case DeckSetType::elset:
                put_line(empty ? "*ELEMENT, TYPE=" + any_label() + ", ELSET=" + name : "*ELSET, ELSET=" + name);
                break;
            case DeckSetType::node_surface:
                put_line("*SURFACE, NAME=" + name + ", TYPE=NODE");
                break;
            case DeckSetType::element_surface:
                put_line("*SURFACE, NAME=" + name + ", TYPE=ELEMENT");
                break;
        }
        for (const std::string_view line : lines) put(line);
        if (type == DeckSetType::element_surface) {
            start_line();
            for (Index key : members) {
                check_();
                const CellRef ref = *numbers_.cell(key / 8);
                append_integer(out_, key / 8);
                out_ += ", ";
                out_ += label_name(static_cast<int>(key % 8), ref.type,
                                   plan_.planes[mesh_.block(ref.type).families[ref.cell]]);
                out_ += eol_;
            }
            for (const auto& [number, label] : unheld) put_line(std::to_string(number) + ", S" + std::to_string(label));
            return;
        }
        const std::size_t per_line = type == DeckSetType::node_surface ? 1 : 10;
        std::size_t on_line = 0;
        const auto put_number = [&](Index number) {
            check_();
            if (on_line == per_line) out_ += eol_, on_line = 0;
            append_integer(out_, number);
            if (per_line > 1) out_ += ", ";
            ++on_line;
        };
        for (Index number : members) put_number(number);
        for (const auto& [number, label] : unheld)
            if (!numbers_.cell(number)) put_number(number);
        if (on_line > 0) out_ += eol_;
    }

    /// A type the deck uses already, so that naming it once more changes nothing.
    std::string any_label() const {
        for (const Card& card : input_->cards())
            if (card.keyword == "ELEMENT") return *card.parameter("TYPE");
        for (const CellBlock& b : mesh_.blocks())
            if (std::ranges::count(places_.fates_of(b.type), Fate::free) > 0)
                return std::string(default_deck_label(b.type));
        return "C3D4";
    }

    const Mesh& mesh_;
    std::shared_ptr<const SolverInput> input_;
    EdgeTies ties_;
    NumberIndex numbers_;
    DeckSetIndex index_;
    DeckPlaces places_;
    DeckSetPlan plan_;
    std::size_t last_node_card_ = 0, last_element_card_ = 0, last_mesh_card_ = 0;
    std::vector<char> is_written_;                  // per set
    DefinedSets sets_;                              // so far
    std::size_t first_node_card_ = 0;               // where it starts in out_
    bool has_node_card_ = false, empties_ = false;  // empties_: sets without members that had some, or are new
    std::vector<std::size_t> node_written_under_;   // the *NODE card that wrote a node last
    std::array<std::vector<char>, cell_type_count> element_written_;
    std::vector<std::string_view> tail_;
    std::string out_, eol_ = "\n";
    SparseCheck check_;
};

}  // namespace

void write_inp(const Mesh& mesh, const fs::path& path) {
    std::string text;
    try {
        text = DeckWriter(mesh).write();
    } catch (const WriteError& error) {
        throw WriteError(shown_path(path) + ": " + error.what());
    }
    save_text(path, text);
}

}  // namespace femscalpel
