// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/solver_sets.h"

#include <algorithm>
#include <unordered_set>

#include "cancel.h"
#include "deck/solver_element.h"

namespace femscalpel {
namespace {

std::string index_key(DeckSetType type, std::string_view name) {
    return static_cast<char>('0' + static_cast<int>(type)) + deck_key(name);
}

/// Members as cards add them. Repeats are dropped now and then, so that sets of sets of sets cannot
/// grow beyond the mesh.
class Collector {
public:
    void add(Index member) { out_.members.push_back(member); }
    void add(std::span<const Index> members) {
        out_.members.insert(out_.members.end(), members.begin(), members.end());
        if (out_.members.size() > 2 * clean_ + 4096) clean();
    }
    void add_unheld(Index number, Index label) { out_.unheld.push_back({number, label}); }
    void add_absent(Index count) { out_.absent += count; }
    void assign(std::span<const Index> members) { out_.members.assign(members.begin(), members.end()); }

    const SetMembers& clean() {
        sort_unique(out_.members);
        sort_unique(out_.unheld);
        clean_ = out_.members.size();
        return out_;
    }
    SetMembers take() {
        clean();
        return std::move(out_);
    }

private:
    template <class T>
    static void sort_unique(std::vector<T>& v) {
        if (!std::ranges::is_sorted(v)) std::ranges::sort(v);
        v.erase(std::unique(v.begin(), v.end()), v.end());
    }

    SetMembers out_;
    std::size_t clean_ = 0;
};

class Evaluation {
public:
    Evaluation(const Mesh& mesh, const NumberIndex& numbers, const SolverInput& input,
               std::span<const std::vector<Index>> contributed, std::span<const SetRole> roles,
               std::vector<std::string>* warnings)
        : mesh_(mesh),
          numbers_(numbers),
          input_(input),
          contributed_(contributed),
          roles_(roles),
          warnings_(warnings),
          index_(input.sets()),
          sets_(input.sets().size()),
          seen_(input.sets().size()),
          replaced_(input.sets().size()) {
        for (const OtherElement& e : input.other_elements()) others_.insert(e.number);
    }

    std::vector<SetMembers> run() {
        // A set that has no set card of its own can still be replaced: then after its first *NODE or
        // *ELEMENT card.
        std::vector<char> own_card(sets_.size());
        for (const Card& card : input_.cards())
            if (is_set_card(card))
                if (const auto s = set_index(card)) own_card[*s] = 1;
        for (std::string_view keyword : {"NODE", "ELEMENT"})
            for (std::size_t c = 0; c < input_.cards().size(); ++c) {
                const Card& card = input_.cards()[c];
                if (card.keyword != keyword) continue;
                const auto s = set_index(card);
                if (!s) continue;
                seen_[*s] = 1;
                if (c < contributed_.size()) sets_[*s].add(contributed_[c]);
                for (const OtherElement& e : input_.other_elements())
                    if (e.card == c) sets_[*s].add_unheld(e.number, 0);
                if (!own_card[*s]) replace_if_asked(*s);
            }
        for (std::string_view keyword : {"NSET", "ELSET", "SURFACE"})
            for (const Card& card : input_.cards())
                if (card.keyword == keyword)
                    if (const auto s = set_index(card)) {
                        if (!replaced_[*s] && !replace_if_asked(*s)) read(card, *s);
                        seen_[*s] = 1;
                    }
        std::vector<SetMembers> out;
        out.reserve(sets_.size());
        for (Collector& c : sets_) out.push_back(c.take());
        return out;
    }

private:
    static bool is_set_card(const Card& card) {
        return card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE";
    }

    std::optional<std::size_t> set_index(const Card& card) const {
        const auto named = set_of_card(card);
        if (!named) return {};
        return index_.find(named->first, named->second);
    }

    bool replace_if_asked(std::size_t s) {
        if (roles_.empty() || roles_[s].state == SetRole::by_cards) return false;
        if (!replaced_[s] && roles_[s].state == SetRole::replaced) sets_[s].assign(roles_[s].members);
        if (roles_[s].state == SetRole::dropped) sets_[s].assign({});
        replaced_[s] = 1;
        return true;
    }

    /// The set a data line names, if it is defined at this point.
    std::optional<std::size_t> named_set(DeckSetType type, const std::string& name) const {
        const auto s = index_.find(type, name);
        if (!s || !seen_[*s] || (!roles_.empty() && roles_[*s].state == SetRole::dropped)) return {};
        return s;
    }

    void fail(const CardReader& line, const std::string& what) const {
        if (warnings_) throw ReadError(line.where() + what);
    }

    bool exists(bool node, Index number) const {
        return node ? numbers_.node(number).has_value() : numbers_.cell(number).has_value();
    }

    void read(const Card& card, std::size_t s) {
        first_absent_ = 0;
        absent_count_ = 0;
        if (card.keyword == "SURFACE")
            read_surface(card, s);
        else if (card.parameter("GENERATE"))
            read_ranges(card, s);
        else
            read_list(card, s);
        sets_[s].clean();
        if (warnings_ && absent_count_ > 0) {
            const DeckSet& set = input_.sets()[s];
            warnings_->push_back(
                card.where() + ": " + std::string(to_string(set.type)) + " '" + set.name + "' names " +
                (set.type == DeckSetType::nset || set.type == DeckSetType::node_surface ? "node " : "element ") +
                std::to_string(first_absent_) +
                (absent_count_ > 1 ? " and " + std::to_string(absent_count_ - 1) + " more" : "") +
                " that the deck does not define; left out");
        }
    }

    void absent(std::size_t s, Index number) {
        if (absent_count_++ == 0) first_absent_ = number;
        sets_[s].add_absent(1);
    }

    void add_number(std::size_t s, bool node, Index number) {
        if (exists(node, number)) {
            sets_[s].add(number);
            return;
        }
        if (!node) sets_[s].add_unheld(number, 0);
        if (node || !others_.contains(number)) absent(s, number);
    }

    void read_list(const Card& card, std::size_t s) {
        const DeckSetType type = input_.sets()[s].type;
        CardReader line(card);
        while (line.next_data_line())
            while (!line.at_end()) {
                Index number = 0;
                if (line.integer(number)) {
                    add_number(s, type == DeckSetType::nset, number);
                    continue;
                }
                const std::string name = line.field();
                if (name.empty()) continue;
                add_set(line, s, type, name);
            }
    }

    void add_set(const CardReader& line, std::size_t s, DeckSetType type, const std::string& name) {
        const auto other = named_set(type, name);
        if (!other) {
            fail(line, "'" + name + "' is neither a number nor a " + std::string(to_string(type)) +
                           " defined before this line");
            sets_[s].add_absent(1);
            return;
        }
        if (*other == s) return;
        const SetMembers& from = sets_[*other].clean();
        sets_[s].add(from.members);
        for (const auto& [number, label] : from.unheld) sets_[s].add_unheld(number, label);
    }

    void read_ranges(const Card& card, std::size_t s) {
        const bool node = input_.sets()[s].type == DeckSetType::nset;
        CardReader line(card);
        while (line.next_data_line()) {
            Index first = 0, last = 0, step = 1;
            if (!line.integer(first) || line.at_end() || !line.integer(last) ||
                (!line.at_end() && !line.integer(step)) || first < 0 || last < first || step <= 0) {
                fail(line, "GENERATE needs: first number, last number, increment (a positive one)");
                sets_[s].add_absent(1);
                continue;
            }
            const Index wanted = (last - first) / step + 1;
            Index found = 0;
            if (wanted <= (node ? mesh_.node_count() : mesh_.cell_count())) {
                SparseCheck check(1 << 12);
                for (Index id = first; id <= last; id += step, check())
                    if (exists(node, id)) {
                        sets_[s].add(id);
                        ++found;
                    }
            } else {
                const auto take = [&](std::span<const Index> ids) {
                    for (Index id : ids)
                        if (id >= first && id <= last && (id - first) % step == 0) {
                            sets_[s].add(id);
                            ++found;
                        }
                };
                if (node)
                    take(mesh_.node_ids);
                else
                    for (const CellBlock& b : mesh_.blocks()) take(b.ids);
            }
            if (!node)
                for (Index id : others_)
                    if (id >= first && id <= last && (id - first) % step == 0) {
                        sets_[s].add_unheld(id, 0);
                        ++found;
                    }
            sets_[s].add_absent(wanted - found);
            if (found == 0 && absent_count_++ == 0) first_absent_ = first;
        }
    }

    void read_surface(const Card& card, std::size_t s) {
        const bool nodes = input_.sets()[s].type == DeckSetType::node_surface;
        CardReader line(card);
        while (line.next_data_line()) {
            Index number = 0;
            std::string name;
            const bool by_number = line.integer(number);
            if (!by_number) name = line.field();
            if (nodes) {
                if (by_number)
                    add_number(s, true, number);
                else if (!name.empty())
                    add_set(line, s, DeckSetType::nset, name);
                if (!line.at_end()) fail(line, "only one node or node set per line is allowed in a node surface");
                continue;
            }
            const std::string label_text = line.field();
            const int label = label_from_name(label_text);
            if (label == 0) {
                fail(line, label_text.empty()
                               ? "the face is missing behind '" + (by_number ? std::to_string(number) : name) +
                                     "': S1 to S6, SNEG, SPOS, SN or SP (Abaqus takes all free faces then; list them)"
                               : "'" + label_text + "' is not a face: S1 to S6, SNEG, SPOS, SN or SP" +
                                     (label_text.starts_with('E') ? "; edges E1 to E4 of a shell are S3 to S6" : ""));
                sets_[s].add_absent(1);
            } else if (by_number) {
                add_face(line, s, number, label);
            } else if (const auto other = named_set(DeckSetType::elset, name)) {
                const SetMembers& from = sets_[*other].clean();
                for (Index id : from.members) add_face(line, s, id, label);
                for (const auto& [id, unused] : from.unheld) sets_[s].add_unheld(id, label);
            } else {
                fail(line, "'" + name + "' is neither a number nor an element set");
                sets_[s].add_absent(1);
            }
        }
    }

    void add_face(const CardReader& line, std::size_t s, Index id, int label) {
        const auto cell = numbers_.cell(id);
        if (!cell) {
            sets_[s].add_unheld(id, label);
            if (!others_.contains(id)) absent(s, id);
            return;
        }
        const CellTraits& t = traits(cell->type);
        if (t.dimension < 2) {  // CalculiX gives beams faces when it expands them to solids
            sets_[s].add_unheld(id, label);
            return;
        }
        // Plane elements: SN and SP are labels 5 and 6 whatever the number of edges.
        if (planes_.empty()) planes_ = plane_families(mesh_, input_);
        const bool plane = planes_[mesh_.block(cell->type).families[cell->cell]];
        const int face = face_from_label(label, cell->type, plane);
        if (face == 0 && t.corners == 5) return absent(s, id);  // the tip, of a hexahedron's faces
        const int faces = t.dimension == 3 ? static_cast<int>(t.faces.size()) : 2 + t.corners;
        if (face < 1 || face > faces) {
            fail(line, "element " + std::to_string(id) + ", a " + std::string(t.name) + ", has no face S" +
                           std::to_string(label));
            sets_[s].add_absent(1);
            return;
        }
        sets_[s].add(8 * id + label);
    }

    const Mesh& mesh_;
    const NumberIndex& numbers_;
    const SolverInput& input_;
    std::span<const std::vector<Index>> contributed_;
    std::span<const SetRole> roles_;
    std::vector<std::string>* warnings_;
    DeckSetIndex index_;
    std::vector<Collector> sets_;
    std::vector<char> seen_;  // defined so far
    std::vector<char> replaced_;
    std::vector<char> planes_;
    std::unordered_set<Index> others_;
    Index first_absent_ = 0;
    Index absent_count_ = 0;
};

}  // namespace

std::optional<std::pair<DeckSetType, std::string>> set_of_card(const Card& card) {
    const auto named = [&card](std::string_view parameter,
                               DeckSetType type) -> std::optional<std::pair<DeckSetType, std::string>> {
        const std::string* name = card.parameter(parameter);
        if (!name) return {};
        if (deck_key(*name).empty()) throw ReadError(card.where() + ": " + std::string(parameter) + "= without a name");
        if (deck_key(*name).size() > 80)
            throw ReadError(card.where() + ": the name '" + *name +
                            "' is longer than the 80 characters CalculiX allows");
        return std::pair(type, *name);
    };
    const auto needed = [&](std::string_view parameter, DeckSetType type) {
        auto set = named(parameter, type);
        if (!set) throw ReadError(card.where() + ": *" + card.keyword + " needs " + std::string(parameter) + "=name");
        return set;
    };
    if (card.keyword == "NODE") return named("NSET", DeckSetType::nset);
    if (card.keyword == "ELEMENT") return named("ELSET", DeckSetType::elset);
    if (card.keyword == "NSET") return needed("NSET", DeckSetType::nset);
    if (card.keyword == "ELSET") return needed("ELSET", DeckSetType::elset);
    if (card.keyword == "SURFACE") {
        const std::string* type = card.parameter("TYPE");
        const std::string key = type ? deck_key(*type) : "ELEMENT";
        if (key.starts_with("ELEMENT")) return needed("NAME", DeckSetType::element_surface);
        if (key.starts_with("NODE")) return needed("NAME", DeckSetType::node_surface);
        throw ReadError(
            card.where() + ": *SURFACE of TYPE=" + *type +
            "; CalculiX knows NODE and ELEMENT. Give the surface elements, or leave out the card and what names the "
            "surface");
    }
    return {};
}

DeckSetIndex::DeckSetIndex(std::span<const DeckSet> sets) {
    for (std::size_t s = 0; s < sets.size(); ++s) by_key_.emplace(index_key(sets[s].type, sets[s].name), s);
}

std::optional<std::size_t> DeckSetIndex::find(DeckSetType type, std::string_view name) const {
    const auto it = by_key_.find(index_key(type, name));
    return it == by_key_.end() ? std::nullopt : std::optional(it->second);
}

std::vector<SetMembers> evaluate_sets(const Mesh& mesh, const NumberIndex& numbers, const SolverInput& input,
                                      std::span<const std::vector<Index>> contributed, std::span<const SetRole> roles,
                                      std::vector<std::string>* warnings) {
    return Evaluation(mesh, numbers, input, contributed, roles, warnings).run();
}

std::vector<std::vector<Index>> members_by_card(const Mesh& mesh, const SolverInput& input) {
    std::unordered_map<std::string_view, std::size_t> cards;
    for (std::size_t c = 0; c < input.cards().size(); ++c)
        if (!input.cards()[c].group.empty()) cards.emplace(input.cards()[c].group, c);
    std::vector<std::vector<std::size_t>> cards_of_family(static_cast<std::size_t>(mesh.families.size()));
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f)
        for (GroupIndex g : mesh.families.groups(f)) {
            const Group& group = mesh.groups[static_cast<std::size_t>(g)];
            if (const auto it = cards.find(group.name); group.hidden && it != cards.end())
                cards_of_family[static_cast<std::size_t>(f)].push_back(it->second);
        }
    std::vector<std::vector<Index>> out(input.cards().size());
    SparseCheck check(1 << 14);
    for (Index i = 0; i < mesh.node_count(); ++i, check())
        for (std::size_t c : cards_of_family[mesh.node_families[i]]) out[c].push_back(mesh.node_ids[i]);
    for (const CellBlock& b : mesh.blocks())
        for (Index i = 0; i < b.size(); ++i, check())
            for (std::size_t c : cards_of_family[b.families[i]]) out[c].push_back(b.ids[i]);
    return out;
}

namespace {

/// By family: its elements are under an *ELEMENT card of a type that `is` takes.
std::vector<char> families_under(const Mesh& mesh, const SolverInput& input, auto is) {
    std::unordered_set<std::string_view> groups;
    for (const Card& card : input.cards())
        if (card.keyword == "ELEMENT" && card.parameter("TYPE")) {
            const auto type = deck_element_type(*card.parameter("TYPE"));
            if (type && is(*type)) groups.insert(card.group);
        }
    std::vector<char> is_one(mesh.groups.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g)
        is_one[g] = mesh.groups[g].hidden && groups.contains(mesh.groups[g].name);
    std::vector<char> out(static_cast<std::size_t>(mesh.families.size()));
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f)
        for (GroupIndex g : mesh.families.groups(f)) out[f] |= is_one[g];
    return out;
}

}  // namespace

std::vector<char> plane_families(const Mesh& mesh, const SolverInput& input) {
    return families_under(mesh, input, [](const DeckElementType& type) { return type.plane; });
}

std::vector<std::string> labels_of_families(const Mesh& mesh, const SolverInput& input) {
    std::unordered_map<std::string_view, const std::string*> labels;
    for (const Card& card : input.cards())
        if (card.keyword == "ELEMENT" && card.parameter("TYPE")) labels.emplace(card.group, card.parameter("TYPE"));
    std::vector<std::string> out(static_cast<std::size_t>(mesh.families.size()));
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f)
        for (const GroupIndex g : mesh.families.groups(f)) {
            const Group& group = mesh.groups[static_cast<std::size_t>(g)];
            if (const auto it = labels.find(group.name); group.hidden && it != labels.end())
                out[static_cast<std::size_t>(f)] = *it->second;
        }
    return out;
}

std::vector<char> families_of_whole_elements(const Mesh& mesh) {
    const SolverInput* input = solver_input(mesh);
    if (!input) return {};
    return families_under(mesh, *input, [](const DeckElementType& type) { return type.whole; });
}

}  // namespace femscalpel
