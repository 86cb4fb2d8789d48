// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/inp_sets.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>

#include "cancel.h"
#include "deck/deck_view.h"
#include "deck/solver_element.h"
#include "error.h"
#include "io/inp.h"
#include "io/inp_places.h"
#include "words.h"

namespace femscalpel {
namespace {

/// See plan_sets().
class SetPlanner {
public:
    SetPlanner(const Mesh& mesh, const SolverInput& input, const NumberIndex& numbers, const DeckSetIndex& index,
               const DeckPlaces& places)
        : mesh_(mesh), input_(input), numbers_(numbers), index_(index), places_(places) {
        out_.members_of_card = members_by_card(mesh, input);
        out_.contributed.resize(input.cards().size());
    }

    DeckSetPlan run() {
        collect_groups();
        check_other_elements();
        choose_parameters();
        choose_roles();
        return std::move(out_);
    }

private:
    void collect_groups() {
        out_.planes = plane_families(mesh_, input_);
        std::vector<std::vector<Index>> members(mesh_.groups.size());
        std::vector<std::vector<std::size_t>> loose(mesh_.groups.size());
        for (Index i = 0; i < mesh_.node_count(); ++i, check_())
            for (GroupIndex g : mesh_.families.groups(mesh_.node_families[i]))
                if (!mesh_.groups[g].hidden) members[g].push_back(mesh_.node_ids[i]);
        for (const CellBlock& b : mesh_.blocks())
            for (Index i = 0; i < b.size(); ++i, check_()) {
                const Fate fate = places_.fate({b.type, i});
                if (fate != Fate::card && fate != Fate::free) continue;
                for (GroupIndex g : mesh_.families.groups(b.families[i]))
                    if (!mesh_.groups[g].hidden) members[g].push_back(b.ids[i]);
            }
        for (std::size_t i = 0; i < places_.loose.size(); ++i)
            if (places_.loose[i].fate != Fate::free)
                for (GroupIndex g :
                     mesh_.families.groups(mesh_.block(places_.loose[i].type).families[places_.loose[i].cell]))
                    if (!mesh_.groups[g].hidden) loose[g].push_back(i);
        for (const Facet& f : mesh_.facets) {
            const CellBlock& b = mesh_.block(f.type);
            const Fate fate = places_.fate({f.type, f.cell});
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

        group_of_set_.assign(input_.sets().size(), DeckPlaces::none);
        out_.members.resize(input_.sets().size());
        std::vector<char> in_deck(mesh_.groups.size());
        for (std::size_t s = 0; s < input_.sets().size(); ++s) {
            const DeckSet& set = input_.sets()[s];
            const auto g = mesh_.find_group(set.group, group_kind(set.type));
            if (!g) continue;
            group_of_set_[s] = static_cast<std::size_t>(*g);
            in_deck[static_cast<std::size_t>(*g)] = 1;
            out_.members[s] = members[static_cast<std::size_t>(*g)];
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
            out_.new_sets.push_back({type, group.name, std::move(members[g]), ""});
        }
        for (std::size_t g = 0; g < mesh_.groups.size(); ++g)
            if (!loose[g].empty()) add_loose_group(mesh_.groups[g].name, loose[g]);
        std::ranges::stable_sort(out_.new_sets, {}, &NewSet::type);
    }

    Index facet_key(CellRef element, int face) const {
        const CellBlock& b = mesh_.block(element.type);
        return 8 * b.ids[element.cell] + label_from_face(face, element.type, out_.planes[b.families[element.cell]]);
    }

    /// A group of faces and edges: a surface where CalculiX can name them, and a node set.
    void add_loose_group(const std::string& name, const std::vector<std::size_t>& members) {
        NewSet surface{DeckSetType::element_surface, name, {}, ""}, nodes{DeckSetType::nset, name, {}, ""};
        std::array<Index, 3> count{};
        for (std::size_t i : members) {
            const LooseElement& e = places_.loose[i];
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
            out_.new_sets.push_back(std::move(surface));
        }
        if (!names_.contains(name_key(DeckSetType::nset, name))) {
            claim(DeckSetType::nset, name, name);
            out_.new_sets.push_back(std::move(nodes));
        }
    }

    static std::string name_key(DeckSetType type, const std::string& name) {
        return static_cast<char>('0' + static_cast<int>(type)) + deck_key(name);
    }

    void claim(DeckSetType type, const std::string& name, const std::string& group) {
        const std::string key = deck_key(name);
        using namespace std::string_view_literals;
        constexpr std::string_view blanks = " \t";  // do not count, and get lost
        if (key.empty() || key.size() > 80 || name.find_first_of(",\n\r\0"sv) != name.npos || key.starts_with('*') ||
            blanks.find(name.front()) != blanks.npos || blanks.find(name.back()) != blanks.npos)
            throw WriteError("group '" + group +
                             "' cannot be a CalculiX set: names have 1 to 80 characters, no comma, no asterisk first "
                             "and no blank at either end; rename the group");
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
        for (const OtherElement& e : input_.other_elements()) {
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

    /// A *NODE or *ELEMENT card keeps its NSET= or ELSET= while everything under it is in that set.
    void choose_parameters() {
        out_.drops_parameter.assign(input_.cards().size(), 0);
        for (std::size_t c = 0; c < input_.cards().size(); ++c) {
            const Card& card = input_.cards()[c];
            if (card.keyword != "NODE" && card.keyword != "ELEMENT") continue;
            const auto s = set_index(index_, card);
            if (!s) continue;
            bool keep = group_of_set_[*s] != DeckPlaces::none;
            if (keep) {
                out_.contributed[c] = out_.members_of_card[c];
                if (!std::ranges::is_sorted(out_.contributed[c])) std::ranges::sort(out_.contributed[c]);
                keep = std::ranges::includes(out_.members[*s], out_.contributed[c]);
            }
            if (!keep) {
                out_.drops_parameter[c] = 1;
                out_.contributed[c].clear();
            }
        }
    }

    /// Leaves a set to its cards where these still give its members. Sets that name other sets depend on
    /// them, so this is repeated until nothing changes; surfaces come when the sets they name are settled.
    void choose_roles() {
        out_.roles.resize(input_.sets().size());
        for (std::size_t s = 0; s < out_.roles.size(); ++s)
            if (group_of_set_[s] == DeckPlaces::none) out_.roles[s].state = SetRole::dropped;
        for (bool changed = true; changed;) {
            changed = false;
            const auto now = evaluate_sets(mesh_, numbers_, input_, out_.contributed, out_.roles, nullptr);
            for (const bool surfaces : {false, true}) {
                if (changed) break;
                for (std::size_t s = 0; s < out_.roles.size(); ++s) {
                    const DeckSet& set = input_.sets()[s];
                    const bool is_surface =
                        set.type == DeckSetType::node_surface || set.type == DeckSetType::element_surface;
                    if (out_.roles[s].state != SetRole::by_cards || is_surface != surfaces) continue;
                    if (now[s].members == out_.members[s] && now[s].unheld == set.unheld && now[s].absent == set.absent)
                        continue;
                    out_.roles[s].state = SetRole::replaced;
                    out_.roles[s].members = out_.members[s];
                    changed = true;
                }
            }
        }
        out_.has_own_card.assign(out_.roles.size(), 0);
        for (const Card& card : input_.cards())
            if (card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE")
                if (const auto s = set_index(index_, card)) out_.has_own_card[*s] = 1;
    }

    const Mesh& mesh_;
    const SolverInput& input_;
    const NumberIndex& numbers_;
    const DeckSetIndex& index_;
    const DeckPlaces& places_;
    std::vector<std::size_t> group_of_set_;               // per set, or DeckPlaces::none
    std::unordered_map<std::string, std::string> names_;  // set key -> group
    DeckSetPlan out_;
    SparseCheck check_;
};

}  // namespace

DeckSetPlan plan_sets(const Mesh& mesh, const SolverInput& input, const NumberIndex& numbers, const DeckSetIndex& index,
                      const DeckPlaces& places) {
    return SetPlanner(mesh, input, numbers, index, places).run();
}

std::optional<std::size_t> set_index(const DeckSetIndex& index, const Card& card) {
    const auto set = set_of_card(card);
    return set ? index.find(set->first, set->second) : std::nullopt;
}

void put_in_order(const SolverInput& input, const DeckSetIndex& index, const DeckSetPlan& plan, std::size_t set,
                  std::vector<Index>& nodes) {
    std::unordered_map<Index, std::size_t> place;
    const auto add = [&](Index node) { place.try_emplace(node, place.size()); };
    const auto add_entry = [&](const NumberOrSet& what) {
        if (what.is_number()) return add(what.number);
        if (const auto named = index.find(DeckSetType::nset, what.set))
            for (const Index node : plan.members[*named]) add(node);
    };
    for (const Card& card : input.cards()) {
        if (card.keyword != "NSET" || set_index(index, card) != set) continue;
        CardReader line(card);
        while (const auto what = next_entry(line)) {
            if (Index last = 0, step = 1; card.parameter("GENERATE") && line.integer(last)) {
                if (!line.integer(step)) step = 1;
                for (Index node = what->number; step > 0 && node <= last; node += step) add(node);
                continue;
            }
            add_entry(*what);
            for (const NumberOrSet& more : read_entries(line)) add_entry(more);
        }
    }
    std::ranges::stable_sort(nodes, {}, [&](Index node) {
        const auto found = place.find(node);
        return found == place.end() ? place.size() : found->second;
    });
}

std::vector<std::string_view> lines_still_true(const SolverInput& input, const DeckSetIndex& index,
                                               const DeckSetPlan& plan, const NumberIndex& numbers, std::size_t s,
                                               std::vector<Index>& given, std::vector<std::array<Index, 2>>& unheld) {
    std::vector<std::string_view> out;
    if (input.sets()[s].type != DeckSetType::element_surface) return out;
    for (const Card& card : input.cards()) {
        if (card.keyword != "SURFACE" || set_index(index, card) != s) continue;
        CardReader line(card);
        while (line.next_data_line()) {
            Index number = 0;
            if (line.integer(number)) continue;
            const auto named = index.find(DeckSetType::elset, line.field());
            const int label = label_from_name(line.field());
            if (!named || label == 0 || plan.roles[*named].state == SetRole::dropped) continue;
            std::vector<Index> faces;
            std::vector<std::array<Index, 2>> loose;
            for (const Index id : plan.members[*named])
                if (traits(numbers.cell(id)->type).dimension < 2)
                    loose.push_back({id, label});
                else
                    faces.push_back(8 * id + label);
            for (const auto& [id, unused] : input.sets()[*named].unheld) loose.push_back({id, label});
            const auto is_unheld = [&](const auto& face) { return std::ranges::find(unheld, face) != unheld.end(); };
            if (!std::ranges::includes(plan.members[s], faces) || !std::ranges::all_of(loose, is_unheld)) continue;
            out.push_back(line.raw());
            given.insert(given.end(), faces.begin(), faces.end());
            std::erase_if(unheld, [&](const auto& face) { return std::ranges::find(loose, face) != loose.end(); });
        }
    }
    return out;
}

namespace {

/// Elements that are not written as such, a line for each type. Of a mesh with a deck only those in no group: the
/// others are what operators made, such as lips, and are there as surfaces and node sets.
void add_left_out(const Mesh& mesh, std::vector<std::string>& out) {
    const SolverInput* deck = solver_input(mesh);
    const DeckPlaces places = find_deck_places(mesh, deck ? *deck : SolverInput());
    std::array<Index, cell_type_count> count{}, in_no_group{};
    for (const LooseElement& e : places.loose) {
        if (e.fate == Fate::free) continue;
        const auto is_seen = [&](GroupIndex g) { return !mesh.groups[static_cast<std::size_t>(g)].hidden; };
        const FamilyIndex family = mesh.block(e.type).families[static_cast<std::size_t>(e.cell)];
        const bool is_in_group = std::ranges::any_of(mesh.families.groups(family), is_seen);
        count[static_cast<std::size_t>(e.type)] += !deck || !is_in_group;
        in_no_group[static_cast<std::size_t>(e.type)] += !is_in_group;
    }
    for (const CellTraits& t : all_cell_types()) {
        const Index n = count[static_cast<std::size_t>(t.type)], alone = in_no_group[static_cast<std::size_t>(t.type)];
        if (n == 0) continue;
        std::string text = counted(n, "element") + " of the type " + std::string(t.name) +
                           (t.dimension == 2   ? " on faces of solids, which would be shells"
                            : t.dimension == 1 ? " on edges of others, which would be beams"
                                               : "");
        if (alone == n)
            text += " (in no group)";
        else
            text += std::string(" (their groups are ") + (t.dimension == 2 ? "surfaces and node sets" : "node sets") +
                    (alone > 0 ? "; " + std::to_string(alone) + " of them in none)" : ")");
        out.push_back(std::move(text));
    }
}

}  // namespace

std::vector<std::string> inp_losses(const Mesh& mesh) {
    std::vector<std::string> out;
    add_left_out(mesh, out);
    if (!mesh.unit.empty()) out.push_back("the unit '" + mesh.unit + "'");
    if (const SolverInput* deck = solver_input(mesh))
        for (const DeckSet& set : deck->sets()) {
            const bool beside = set.type == DeckSetType::node_surface && set.group.starts_with(set.name + "_SURFACE");
            if (set.group != set.name && !beside && mesh.find_group(set.group, group_kind(set.type)))
                out.push_back("the name '" + set.group + "', as the deck's cards name that " +
                              std::string(to_string(set.type)) + " '" + set.name + "'");
        }
    return out;
}

}  // namespace femscalpel
