// SPDX-License-Identifier: LGPL-2.1-or-later
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "cancel.h"
#include "deck/solver_element.h"
#include "deck/solver_input.h"
#include "deck/solver_sets.h"
#include "io/atomic_file.h"
#include "io/inp.h"

namespace femscalpel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t coordinate_width = 20;  // CalculiX reads (f20.0)
constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Appends `value` in at most 20 characters, exactly if that is possible.
void append_coordinate(std::string& out, double value) {
    char text[32];
    const char* end = std::to_chars(text, text + sizeof text, value).ptr;
    if (end - text <= static_cast<std::ptrdiff_t>(coordinate_width)) {
        out.append(text, static_cast<std::size_t>(end - text));
        return;
    }
    for (int digits_wanted = 17;; --digits_wanted) {
        end =
            digits_wanted == 17
                ? std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr
                : std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits_wanted - 1).ptr;
        const char* mantissa_end = std::find(text, const_cast<char*>(end), 'e');
        std::string digits, sign;
        for (const char* p = text; p < mantissa_end; ++p) {
            if (*p == '-')
                sign = "-";
            else if (*p != '.')
                digits += *p;
        }
        while (digits.size() > 1 && digits.back() == '0') digits.pop_back();
        const int exponent = std::atoi(std::string(mantissa_end + 1, end).c_str());
        // 12345e-9 and .0012345 are shorter than 1.2345e-05.
        const std::string forms[] = {
            sign + digits.substr(0, 1) + "." + digits.substr(1) + "e" + std::to_string(exponent),
            exponent < 0 ? sign + "." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits
                         : std::string(),
            sign + digits + "e" + std::to_string(exponent - static_cast<int>(digits.size()) + 1),
        };
        for (const std::string& form : forms)
            if (!form.empty() && form.size() <= coordinate_width) {
                out += form;
                return;
            }
    }
}

void append_integer(std::string& out, Index value) {
    char text[24];
    out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// What an element becomes in the deck.
enum class Fate : std::uint8_t { card, free, face, edge, point };

struct LooseElement {
    CellType type;
    Index cell;
    Fate fate = Fate::free;
    CellRef owner{};  // the element whose face or edge it is
    int face = 0;     // Facet::face there; 0: an edge of a solid, which is no face
};

class DeckWriter {
public:
    explicit DeckWriter(const Mesh& mesh)
        : mesh_(mesh),
          input_(deck_of(mesh)),
          numbers_(mesh),
          index_(input_->sets()),
          members_of_card_(members_by_card(mesh, *input_)),
          contributed_(input_->cards().size()) {}

    std::string write() {
        if (mesh_.node_count() == 0) throw WriteError("the mesh has no nodes");
        const std::string& first = input_->cards().front().text.front().file->text;
        const std::size_t newline = first.find('\n');
        if (newline != first.npos && newline > 0 && first[newline - 1] == '\r') eol_ = "\r\n";
        find_cards();
        classify_loose_elements();
        collect_groups();
        check_other_elements();
        choose_parameters();
        choose_roles();
        std::size_t bytes = 1 << 16;
        for (const Card& card : input_->cards())
            for (const DeckText& t : card.text) bytes += t.text.size();
        out_.reserve(bytes + bytes / 8 + static_cast<std::size_t>(mesh_.node_count()) * 60);
        for (std::size_t c = 0; c < input_->cards().size(); ++c) write_card(c);
        return std::move(out_);
    }

private:
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

    // --- what is where -----------------------------------------------------------------------------

    void find_cards() {
        check_cancelled();
        std::unordered_map<std::string_view, std::size_t> by_group;
        for (std::size_t c = 0; c < input_->cards().size(); ++c) {
            const Card& card = input_->cards()[c];
            if (!card.group.empty()) by_group.emplace(card.group, c);
            if (card.keyword == "NODE") last_node_card_ = c;
            if (card.keyword == "ELEMENT") last_element_card_ = c;
            if (card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE") last_mesh_card_ = c;
        }
        last_element_card_ = std::max(last_element_card_, last_node_card_);
        last_mesh_card_ = std::max(last_mesh_card_, last_element_card_);

        card_of_family_.assign(static_cast<std::size_t>(mesh_.families.size()), none);
        node_cards_of_family_.resize(static_cast<std::size_t>(mesh_.families.size()));
        std::vector<char> two_cards(card_of_family_.size());
        for (FamilyIndex f = 0; f < mesh_.families.size(); ++f)
            for (GroupIndex g : mesh_.families.groups(f)) {
                const Group& group = mesh_.groups[static_cast<std::size_t>(g)];
                const auto it = by_group.find(group.name);
                if (!group.hidden || it == by_group.end()) continue;
                if (group.kind == GroupKind::node)
                    node_cards_of_family_[f].push_back(it->second);
                else if (card_of_family_[f] != none)
                    two_cards[f] = 1;
                else
                    card_of_family_[f] = it->second;
            }
        for (const CellBlock& b : mesh_.blocks())
            for (Index i = 0; i < b.size(); ++i)
                if (two_cards[b.families[i]])
                    throw WriteError("element " + std::to_string(b.ids[i]) + " stands under two *ELEMENT cards");
    }

    static bool is_free(const LooseElement& e) { return e.fate == Fate::free; }

    void classify_loose_elements() {
        for (const CellBlock& b : mesh_.blocks()) {
            fates_[static_cast<int>(b.type)].assign(static_cast<std::size_t>(b.size()), Fate::card);
            for (Index i = 0; i < b.size(); ++i)
                if (card_of_family_[b.families[i]] == none) {
                    fates_[static_cast<int>(b.type)][static_cast<std::size_t>(i)] = Fate::free;
                    if (traits(b.type).dimension == 3) continue;
                    LooseElement e{b.type, i};
                    if (traits(b.type).dimension == 0) e.fate = Fate::point;
                    loose_.push_back(e);
                }
        }
        find_owners(2);
        find_owners(1);
        for (const LooseElement& e : loose_)
            fates_[static_cast<int>(e.type)][static_cast<std::size_t>(e.cell)] = e.fate;
        for (const CellBlock& b : mesh_.blocks()) {
            const auto free = std::ranges::count(fates_[static_cast<int>(b.type)], Fate::free);
            if (free > 0 && default_deck_label(b.type).empty())
                throw WriteError(
                    std::to_string(free) + " elements of type " + std::string(traits(b.type).name) +
                    ": CalculiX has no such element; mesh these parts with elements it has (solids of 4, 10, 6, 15, "
                    "8 or 20 nodes, shells of 3, 6, 4 or 8), or write MED or VTU");
        }
    }

    using Corners = std::array<Index, 4>;

    static Corners key_of(std::span<const Index> nodes, const std::int8_t* local, int count) {
        Corners key{-1, -1, -1, -1};
        for (int k = 0; k < count; ++k) key[k] = nodes[static_cast<std::size_t>(local[k])];
        std::sort(key.begin(), key.end());
        return key;
    }

    /// For loose triangles and quadrangles (dimension 2): the solid whose face they are. For loose
    /// segments (dimension 1): the shell, or else the solid, whose edge they are. Corners decide.
    void find_owners(int dimension) {
        static constexpr std::int8_t straight[4] = {0, 1, 2, 3};
        std::vector<std::pair<Corners, std::size_t>> wanted;
        std::vector<char> touched(static_cast<std::size_t>(mesh_.node_count()));
        for (std::size_t i = 0; i < loose_.size(); ++i) {
            const CellTraits& t = traits(loose_[i].type);
            if (t.dimension != dimension) continue;
            const auto nodes = mesh_.block(loose_[i].type).nodes(loose_[i].cell);
            wanted.emplace_back(key_of(nodes, straight, t.corners), i);
            for (int k = 0; k < t.corners; ++k)
                touched[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])] = 1;
        }
        if (wanted.empty()) return;
        std::ranges::sort(wanted);
        const auto offer = [&](const Corners& key, CellRef owner, int face) {
            const Index id = mesh_.block(owner.type).ids[owner.cell];
            for (auto it = std::ranges::lower_bound(wanted, key, {}, &std::pair<Corners, std::size_t>::first);
                 it != wanted.end() && it->first == key; ++it) {
                LooseElement& e = loose_[it->second];
                if (!is_free(e)) {
                    // A shell's edge is a face CalculiX can name, a solid's is not; then the lowest number.
                    if ((face == 0) != (e.face == 0) ? face == 0 : mesh_.block(e.owner.type).ids[e.owner.cell] < id)
                        continue;
                }
                e.fate = dimension == 2 ? Fate::face : Fate::edge;
                e.owner = owner;
                e.face = face;
            }
        };
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (t.dimension <= dimension || t.dimension < 2) continue;
            for (Index i = 0; i < b.size(); ++i, check_()) {
                const auto nodes = b.nodes(i);
                int near = 0;
                for (int k = 0; k < t.corners; ++k)
                    near += touched[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
                if (near <= dimension) continue;
                if (dimension == 2) {
                    for (std::size_t f = 0; f < t.faces.size(); ++f)
                        offer(key_of(nodes, t.faces[f].data(), t.faces[f][3] < 0 ? 3 : 4), {b.type, i},
                              static_cast<int>(f) + 1);
                } else {
                    // A triangle that is itself only a face of a solid is not in the deck.
                    const bool shell = t.dimension == 2;
                    if (shell && fate_so_far(b, i) == Fate::face) continue;
                    for (std::size_t k = 0; k < t.edges.size(); ++k)
                        offer(key_of(nodes, t.edges[k].data(), 2), {b.type, i}, shell ? static_cast<int>(k) + 3 : 0);
                }
            }
        }
    }

    /// Fate of an element of dimension 2 while fates_ is still being worked out.
    Fate fate_so_far(const CellBlock& b, Index cell) const {
        if (card_of_family_[b.families[cell]] != none) return Fate::card;
        const auto it = std::ranges::lower_bound(loose_, std::pair(b.type, cell), {},
                                                 [](const LooseElement& e) { return std::pair(e.type, e.cell); });
        return it->fate;
    }

    // --- sets --------------------------------------------------------------------------------------

    struct NewSet {
        DeckSetType type;
        std::string name;
        std::vector<Index> members;
        std::string remark;
    };

    void collect_groups() {
        planes_ = plane_families(mesh_, *input_);
        std::vector<std::vector<Index>> members(mesh_.groups.size());
        std::vector<std::vector<std::size_t>> loose(mesh_.groups.size());
        for (Index i = 0; i < mesh_.node_count(); ++i, check_())
            for (GroupIndex g : mesh_.families.groups(mesh_.node_families[i]))
                if (!mesh_.groups[g].hidden) members[g].push_back(mesh_.node_ids[i]);
        for (const CellBlock& b : mesh_.blocks())
            for (Index i = 0; i < b.size(); ++i, check_()) {
                const Fate fate = fates_[static_cast<int>(b.type)][i];
                if (fate != Fate::card && fate != Fate::free) continue;
                for (GroupIndex g : mesh_.families.groups(b.families[i]))
                    if (!mesh_.groups[g].hidden) members[g].push_back(b.ids[i]);
            }
        for (std::size_t i = 0; i < loose_.size(); ++i)
            if (!is_free(loose_[i]))
                for (GroupIndex g : mesh_.families.groups(mesh_.block(loose_[i].type).families[loose_[i].cell]))
                    if (!mesh_.groups[g].hidden) loose[g].push_back(i);
        for (const Facet& f : mesh_.facets) {
            const CellBlock& b = mesh_.block(f.type);
            const Fate fate = fates_[static_cast<int>(f.type)][f.cell];
            for (GroupIndex g : mesh_.families.groups(f.family)) {
                if (mesh_.groups[g].hidden) continue;
                if (fate != Fate::card && fate != Fate::free)
                    throw WriteError("facet group '" + mesh_.groups[g].name + "' has a face of element " +
                                     std::to_string(b.ids[f.cell]) +
                                     ", which is itself a face of a solid and not written as element");
                members[g].push_back(facet_key({f.type, f.cell}, f.face));
            }
        }
        for (auto& m : members)
            if (!std::ranges::is_sorted(m)) std::ranges::sort(m);

        group_of_set_.assign(input_->sets().size(), none);
        members_.resize(input_->sets().size());
        std::vector<char> in_deck(mesh_.groups.size());
        for (std::size_t s = 0; s < input_->sets().size(); ++s) {
            const DeckSet& set = input_->sets()[s];
            const auto g = mesh_.find_group(set.group, group_kind(set.type));
            if (!g) continue;
            group_of_set_[s] = static_cast<std::size_t>(*g);
            in_deck[static_cast<std::size_t>(*g)] = 1;
            members_[s] = members[static_cast<std::size_t>(*g)];
            claim(set.type, set.name, set.group);
        }
        for (std::size_t g = 0; g < mesh_.groups.size(); ++g) {
            const Group& group = mesh_.groups[g];
            if (in_deck[g] || group.hidden) continue;
            if (group.kind == GroupKind::element && members[g].empty() && !loose[g].empty()) continue;
            const DeckSetType type = group.kind == GroupKind::node      ? DeckSetType::nset
                                     : group.kind == GroupKind::element ? DeckSetType::elset
                                                                        : DeckSetType::element_surface;
            claim(type, group.name, group.name);
            new_sets_.push_back({type, group.name, std::move(members[g]), ""});
        }
        for (std::size_t g = 0; g < mesh_.groups.size(); ++g)
            if (!loose[g].empty()) add_loose_group(mesh_.groups[g].name, loose[g]);
        std::ranges::stable_sort(new_sets_, {}, &NewSet::type);
    }

    Index facet_key(CellRef element, int face) const {
        const CellBlock& b = mesh_.block(element.type);
        return 8 * b.ids[element.cell] + label_from_face(face, planes_[b.families[element.cell]]);
    }

    /// A group of faces and edges: a surface where CalculiX can name them, and a node set.
    void add_loose_group(const std::string& name, const std::vector<std::size_t>& members) {
        NewSet surface{DeckSetType::element_surface, name, {}, ""}, nodes{DeckSetType::nset, name, {}, ""};
        std::array<Index, 3> count{};
        for (std::size_t i : members) {
            const LooseElement& e = loose_[i];
            ++count[static_cast<std::size_t>(traits(e.type).dimension)];
            if (e.face > 0) surface.members.push_back(facet_key(e.owner, e.face));
            for (Index n : mesh_.block(e.type).nodes(e.cell)) nodes.members.push_back(mesh_.node_ids[n]);
        }
        std::string what;
        static constexpr std::string_view names[] = {" point", " segment", " face"};
        for (std::size_t d = 0; d < count.size(); ++d)
            if (count[d] > 0)
                what += (what.empty() ? "" : " and ") + std::to_string(count[d]) + std::string(names[d]) +
                        (count[d] > 1 ? "s" : "");
        for (NewSet* set : {&surface, &nodes}) {
            std::ranges::sort(set->members);
            set->members.erase(std::unique(set->members.begin(), set->members.end()), set->members.end());
            set->remark = "** " + what + " of element group '" + name + "' on other elements";
        }
        if (!surface.members.empty()) {
            claim(DeckSetType::element_surface, name, name);
            new_sets_.push_back(std::move(surface));
        }
        if (!names_.contains(name_key(DeckSetType::nset, name))) {
            claim(DeckSetType::nset, name, name);
            new_sets_.push_back(std::move(nodes));
        }
    }

    static std::string name_key(DeckSetType type, const std::string& name) {
        return static_cast<char>('0' + static_cast<int>(type)) + deck_key(name);
    }

    void claim(DeckSetType type, const std::string& name, const std::string& group) {
        const std::string key = deck_key(name);
        if (key.empty() || key.size() > 80 || name.find_first_of(",\n\r") != name.npos || key.starts_with('*'))
            throw WriteError("group '" + group +
                             "' cannot be a CalculiX set: names have 1 to 80 characters, no comma and no "
                             "asterisk first; rename the group");
        const auto [it, is_new] = names_.emplace(name_key(type, name), group);
        if (is_new) return;
        if (it->second == group)
            throw WriteError("group '" + group + "' would give two " + std::string(to_string(type)) +
                             "s of that name; rename one of the groups");
        throw WriteError("groups '" + it->second + "' and '" + group + "' would be one " +
                         std::string(to_string(type)) +
                         " in CalculiX, where case and blanks do not count; rename one of them");
    }

    void check_other_elements() const {
        for (const OtherElement& e : input_->other_elements()) {
            if (numbers_.cell(e.number))
                throw WriteError("element number " + std::to_string(e.number) +
                                 " is used in the mesh and by an element of type " + e.type +
                                 " of the deck; renumber the elements of the mesh");
            for (Index n : e.nodes)
                if (n != 0 && !numbers_.node(n))
                    throw WriteError("element " + std::to_string(e.number) + " of type " + e.type +
                                     " in the deck needs node " + std::to_string(n) + ", which the mesh has no longer");
        }
    }

    std::optional<std::size_t> set_index(const Card& card) const {
        const auto set = set_of_card(card);
        return set ? index_.find(set->first, set->second) : std::nullopt;
    }

    /// A *NODE or *ELEMENT card keeps its NSET= or ELSET= while everything under it is in that set.
    void choose_parameters() {
        drops_parameter_.assign(input_->cards().size(), 0);
        for (std::size_t c = 0; c < input_->cards().size(); ++c) {
            const Card& card = input_->cards()[c];
            if (card.keyword != "NODE" && card.keyword != "ELEMENT") continue;
            const auto s = set_index(card);
            if (!s) continue;
            bool keep = group_of_set_[*s] != none;
            if (keep) {
                contributed_[c] = members_of_card_[c];
                if (!std::ranges::is_sorted(contributed_[c])) std::ranges::sort(contributed_[c]);
                keep = std::ranges::includes(members_[*s], contributed_[c]);
            }
            if (!keep) {
                drops_parameter_[c] = 1;
                contributed_[c].clear();
            }
        }
    }

    /// Leaves a set to its cards where these still give its members. Sets that name other sets depend on
    /// them, so this is repeated until nothing changes; surfaces come when the sets they name are settled.
    void choose_roles() {
        roles_.resize(input_->sets().size());
        for (std::size_t s = 0; s < roles_.size(); ++s)
            if (group_of_set_[s] == none) roles_[s].state = SetRole::dropped;
        for (bool changed = true; changed;) {
            changed = false;
            const auto now = evaluate_sets(mesh_, numbers_, *input_, contributed_, roles_, nullptr);
            for (const bool surfaces : {false, true}) {
                if (changed) break;
                for (std::size_t s = 0; s < roles_.size(); ++s) {
                    const DeckSet& set = input_->sets()[s];
                    const bool is_surface =
                        set.type == DeckSetType::node_surface || set.type == DeckSetType::element_surface;
                    if (roles_[s].state != SetRole::by_cards || is_surface != surfaces) continue;
                    if (now[s].members == members_[s] && now[s].unheld == set.unheld && now[s].absent == set.absent)
                        continue;
                    roles_[s].state = SetRole::replaced;
                    roles_[s].members = members_[s];
                    changed = true;
                }
            }
        }
        has_own_card_.assign(roles_.size(), 0);
        for (const Card& card : input_->cards())
            if (card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE")
                if (const auto s = set_index(card)) has_own_card_[*s] = 1;
        is_written_.assign(roles_.size(), 0);
    }

    // --- output ------------------------------------------------------------------------------------

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
            for (const DeckText& t : card.text) put(t.text);
        if (card.keyword == "NODE" || card.keyword == "ELEMENT")
            if (const auto s = set_index(card);
                s && !has_own_card_[*s] && roles_[*s].state == SetRole::replaced && !is_written_[*s])
                write_replaced_set(*s);
        if (c == last_node_card_) write_nodes_without_card();
        if (c == last_element_card_) write_free_elements();
        if (c == last_mesh_card_)
            for (const NewSet& set : new_sets_) write_set(set.type, set.name, set.members, {}, set.remark);
        for (std::string_view line : tail_) put(line);
    }

    void write_head(std::size_t c, const Card& card, std::string_view set_parameter) {
        if (!drops_parameter_[c]) {
            put(card.text.front().text.substr(0, card.head));
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
        write_head(c, card, "NSET");
        if (node_written_under_.empty()) node_written_under_.assign(static_cast<std::size_t>(mesh_.node_count()), none);
        CardReader line(card);
        while (line.next_line()) {
            if (!line.is_data()) {
                tail_.push_back(line.raw());
                continue;
            }
            Index id = 0;
            if (!line.integer(id)) continue;
            const auto node = numbers_.node(id);
            if (!node || !stands_under(*node, c)) continue;
            release_tail();
            node_written_under_[static_cast<std::size_t>(*node)] = c;
            Vec3 x(0, 0, 0);
            bool same = true;
            for (int k = 0; k < 3 && !line.at_end(); ++k) same = line.number(x[k]) && same;
            if (same && x == mesh_.points[static_cast<std::size_t>(*node)])
                put(line.raw());
            else
                put_node(*node);
        }
        for (Index id : members_of_card_[c]) {
            const Index node = *numbers_.node(id);
            if (node_written_under_[static_cast<std::size_t>(node)] != c) put_node(node);
        }
    }

    bool stands_under(Index node, std::size_t c) const {
        const auto& cards = node_cards_of_family_[mesh_.node_families[node]];
        return std::ranges::find(cards, c) != cards.end();
    }

    void put_node(Index node) {
        check_();
        start_line();
        append_integer(out_, mesh_.node_ids[node]);
        for (int k = 0; k < 3; ++k) {
            out_ += ", ";
            append_coordinate(out_, mesh_.points[node][k]);
        }
        out_ += eol_;
    }

    void write_nodes_without_card() {
        bool first = true;
        for (Index i = 0; i < mesh_.node_count(); ++i) {
            if (!node_cards_of_family_[mesh_.node_families[i]].empty()) continue;
            if (first) put_line("*NODE");
            first = false;
            put_node(i);
        }
    }

    void write_element_card(std::size_t c, const Card& card) {
        write_head(c, card, "ELSET");
        const auto type = deck_element_type(*card.parameter("TYPE"));
        if (!type) {  // user elements, all kept beside the mesh
            CardReader line(card);
            while (line.next_line()) {
                if (line.is_data()) release_tail();
                if (line.is_data())
                    put(line.raw());
                else
                    tail_.push_back(line.raw());
            }
            return;
        }
        const CellBlock& block = mesh_.block(type->cell);
        const auto count = static_cast<std::size_t>(traits(type->cell).nodes);
        std::unordered_set<Index> others;
        for (const OtherElement& e : input_->other_elements())
            if (e.card == c) others.insert(e.number);
        std::vector<char>& written = element_written_[static_cast<int>(type->cell)];
        if (written.empty()) written.assign(static_cast<std::size_t>(block.size()), 0);
        std::vector<Index> wanted(count);
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
            const bool here = found && card_of_family_[mesh_.block(found->type).families[found->cell]] == c;
            if (here) check_type(*found, *type, card);
            const bool keep = here || others.contains(id);
            bool same = true;
            if (here) {
                const auto nodes = block.nodes(found->cell);
                std::ranges::transform(nodes, wanted.begin(), [this](Index n) { return mesh_.node_ids[n]; });
                swap_node_order(type->cell, wanted);
                written[static_cast<std::size_t>(found->cell)] = 1;
            }
            if (keep) release_tail();
            record.assign(1, line.raw());
            for (std::size_t k = 0; k < count;) {
                if (line.at_end()) {
                    if (!line.next_line()) break;
                    if (line.is_data())
                        record.push_back(line.raw());
                    else if (keep)
                        record.push_back(line.raw());
                    else
                        tail_.push_back(line.raw());
                    continue;
                }
                Index node = 0;
                if (!line.is_data() || !line.integer(node)) {
                    line.field();
                    continue;
                }
                if (here && wanted[k] != node) same = false;
                ++k;
            }
            if (keep && same)
                for (std::string_view raw : record) put(raw);
            else if (keep)
                put_element({type->cell, found->cell});
        }
        for (Index id : members_of_card_[c]) {
            const CellRef ref = *numbers_.cell(id);
            check_type(ref, *type, card);
            if (!written[static_cast<std::size_t>(ref.cell)]) put_element(ref);
        }
    }

    void check_type(CellRef ref, const DeckElementType& type, const Card& card) const {
        if (ref.type == type.cell) return;
        throw WriteError("element " + std::to_string(mesh_.block(ref.type).ids[ref.cell]) + ", a " +
                         std::string(traits(ref.type).name) + ", stands under " + card.where() +
                         ", whose elements are of type " + *card.parameter("TYPE"));
    }

    void put_element(CellRef ref) {
        check_();
        const auto nodes = mesh_.block(ref.type).nodes(ref.cell);
        std::array<Index, 27> order;
        std::ranges::copy(nodes, order.begin());
        swap_node_order(ref.type, {order.data(), nodes.size()});
        start_line();
        append_integer(out_, mesh_.block(ref.type).ids[ref.cell]);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            out_ += ',';
            if (k == 15) out_ += eol_;  // CalculiX reads 16 entries per line
            out_ += ' ';
            append_integer(out_, mesh_.node_ids[order[k]]);
        }
        out_ += eol_;
    }

    void write_free_elements() {
        for (const CellBlock& b : mesh_.blocks()) {
            const std::vector<Fate>& fates = fates_[static_cast<int>(b.type)];
            bool first = true;
            for (Index i = 0; i < b.size(); ++i) {
                if (fates[static_cast<std::size_t>(i)] != Fate::free) continue;
                if (first) put_line("*ELEMENT, TYPE=" + std::string(default_deck_label(b.type)));
                first = false;
                put_element({b.type, i});
            }
        }
    }

    void write_set_card(const Card& card) {
        const auto s = set_index(card);
        if (!s || roles_[*s].state == SetRole::by_cards) {
            // The whole card as it is, but what follows its data may have to wait for new cards.
            put(card.text.front().text.substr(0, card.head));
            CardReader line(card);
            while (line.next_line()) {
                if (line.is_data()) {
                    release_tail();
                    put(line.raw());
                } else {
                    tail_.push_back(line.raw());
                }
            }
            return;
        }
        if (roles_[*s].state == SetRole::replaced && !is_written_[*s]) write_replaced_set(*s);
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
            if ((card.keyword != "NODE" && card.keyword != "ELEMENT") || drops_parameter_[c] || set_index(card) != s)
                continue;
            defined = true;
            given.insert(given.end(), contributed_[c].begin(), contributed_[c].end());
            for (const OtherElement& e : input_->other_elements())
                if (e.card == c) std::erase(unheld, std::array<Index, 2>{e.number, 0});
        }
        const std::vector<std::string_view> lines = lines_still_true(s, given, unheld);
        std::ranges::sort(given);
        std::ranges::set_difference(members_[s], given, std::back_inserter(rest));
        if (defined && rest.empty() && unheld.empty()) return;
        write_set(set.type, set.name, rest, unheld, "", lines);
    }

    /// Lines "set, label" of an element surface all of whose faces are still on it, and, added, what they give.
    std::vector<std::string_view> lines_still_true(std::size_t s, std::vector<Index>& given,
                                                   std::vector<std::array<Index, 2>>& unheld) const {
        std::vector<std::string_view> out;
        if (input_->sets()[s].type != DeckSetType::element_surface) return out;
        for (const Card& card : input_->cards()) {
            if (card.keyword != "SURFACE" || set_index(card) != s) continue;
            CardReader line(card);
            while (line.next_data_line()) {
                Index number = 0;
                if (line.integer(number)) continue;
                const auto named = index_.find(DeckSetType::elset, line.field());
                const int label = label_from_name(line.field());
                if (!named || label == 0 || roles_[*named].state == SetRole::dropped) continue;
                std::vector<Index> faces;
                std::vector<std::array<Index, 2>> loose;
                for (const Index id : members_[*named])
                    if (traits(numbers_.cell(id)->type).dimension < 2)
                        loose.push_back({id, label});
                    else
                        faces.push_back(8 * id + label);
                for (const auto& [id, unused] : input_->sets()[*named].unheld) loose.push_back({id, label});
                const auto is_unheld = [&](const auto& face) {
                    return std::ranges::find(unheld, face) != unheld.end();
                };
                if (!std::ranges::includes(members_[s], faces) || !std::ranges::all_of(loose, is_unheld)) continue;
                out.push_back(line.raw());
                given.insert(given.end(), faces.begin(), faces.end());
                std::erase_if(unheld, [&](const auto& face) { return std::ranges::find(loose, face) != loose.end(); });
            }
        }
        return out;
    }

    void write_set(DeckSetType type, const std::string& name, std::span<const Index> members,
                   std::span<const std::array<Index, 2>> unheld, const std::string& remark,
                   std::span<const std::string_view> lines = {}) {
        if (!remark.empty()) put_line(remark);
        const bool empty = members.empty() && unheld.empty();
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
                out_ +=
                    label_name(static_cast<int>(key % 8), ref.type, planes_[mesh_.block(ref.type).families[ref.cell]]);
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
            if (std::ranges::count(fates_[static_cast<int>(b.type)], Fate::free) > 0)
                return std::string(default_deck_label(b.type));
        return "C3D4";
    }

    const Mesh& mesh_;
    std::shared_ptr<const SolverInput> input_;
    NumberIndex numbers_;
    DeckSetIndex index_;
    std::vector<std::vector<Index>> members_of_card_;  // per card: numbers of what stands under it
    std::vector<std::vector<Index>> contributed_;      // per card: what its NSET= or ELSET= adds
    std::vector<char> drops_parameter_;                // per card
    std::size_t last_node_card_ = 0, last_element_card_ = 0, last_mesh_card_ = 0;
    std::vector<std::size_t> card_of_family_;                     // *ELEMENT card of elements, or none
    std::vector<std::vector<std::size_t>> node_cards_of_family_;  // *NODE cards of nodes
    std::vector<LooseElement> loose_;                             // of dimension 0 to 2, by type and cell
    std::array<std::vector<Fate>, cell_type_count> fates_;        // of all elements
    std::vector<char> planes_;                                    // by family
    std::vector<std::size_t> group_of_set_;
    std::vector<std::vector<Index>> members_;  // per set: what it must have, as in SetMembers
    std::vector<SetRole> roles_;
    std::vector<char> has_own_card_, is_written_;  // per set
    std::vector<NewSet> new_sets_;
    std::unordered_map<std::string, std::string> names_;  // set key -> group
    std::vector<std::size_t> node_written_under_;         // the *NODE card that wrote a node last
    std::array<std::vector<char>, cell_type_count> element_written_;
    std::vector<std::string_view> tail_;
    std::string out_, eol_ = "\n";
    SparseCheck check_;
};

void save(const fs::path& path, const std::string& text) {
    AtomicFile file(path);
    std::string extension = path.extension().string();
    if (extension == ".gz" || extension == ".GZ") {
        std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(file.temporary().c_str(), "wb6"), gzclose);
        bool good = out != nullptr;
        for (std::size_t at = 0; good && at < text.size();) {
            check_cancelled();
            const auto part = static_cast<unsigned>(std::min<std::size_t>(text.size() - at, 1u << 18));
            good = gzwrite(out.get(), text.data() + at, part) == static_cast<int>(part);
            at += part;
        }
        if (out) good = gzclose(out.release()) == Z_OK && good;
        if (!good) throw WriteError(path.string() + ": writing failed (disk full?)");
    } else {
        std::ofstream out(file.temporary(), std::ios::binary);
        write_obeying(out, text);
        out.close();
        if (!out) throw WriteError(path.string() + ": writing failed (disk full?)");
    }
    file.commit();
}

}  // namespace

void write_inp(const Mesh& mesh, const fs::path& path) {
    std::string text;
    try {
        text = DeckWriter(mesh).write();
    } catch (const WriteError& error) {
        throw WriteError(path.string() + ": " + error.what());
    }
    save(path, text);
}

}  // namespace femscalpel
