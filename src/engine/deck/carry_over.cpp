// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/carry_over.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <unordered_set>

#include "cancel.h"
#include "deck/card_edits.h"
#include "deck/deck_view.h"
#include "deck/node_origins.h"
#include "deck/related_nodes.h"
#include "groups/group_report.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// CalculiX reads 20 characters of a number.
std::string number_text(double value) {
    std::array<char, 40> text{};
    char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    if (end - text.data() > 20)
        end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 12).ptr;
    std::string out(text.data(), end);
    if (out.find_first_of(".en") == out.npos) out += '.';
    return out;
}

/// Displacements of nodes smaller than this part of the mesh's size do not count as moved loads.
constexpr double unmoved = 1e-9;

class CarryOver {
public:
    CarryOver(const Mesh& before, Mesh& after, const Changes& changes)
        : before_(before),
          after_(after),
          old_(before),
          new_numbers_(after),
          origins_(before, old_.numbers(), after, new_numbers_, changes),
          input_(*solver_input(before)),
          edits_(input_.cards().size()),
          changes_(changes) {
        Vec3 low = Vec3::Constant(INFINITY), high = -low;
        for (const Vec3& x : before.points) {
            low = low.cwiseMin(x);
            high = high.cwiseMax(x);
        }
        if (before.node_count() > 0) size_ = (high - low).norm();
        for (const Changes::Part& p : changes.parts) {
            parts_[p.parent].push_back(p.element);
            parents_.emplace(p.element, p.parent);
        }
        for (const Changes::Born& b : changes.born) new_nodes_.push_back(b.node);
        for (const Changes::Copy& c : changes.copies) new_nodes_.push_back(c.node);
        new_groups_ = DeckSetIndex(input_.sets());
        find_marked();
    }

    std::shared_ptr<const Companion> run() {
        strip_closed_sets();
        find_emptied();
        relate_nodes();
        for (std::size_t c = 0; c < input_.cards().size(); ++c) carry_card(c);
        for (const auto& [key, cards] : pools_) carry_pool(cards);
        check_other_elements();
        collect_messages();
        bool any = !closed_.empty();
        for (std::size_t c = 0; c < edits_.size(); ++c)
            if (!edits_[c].empty()) {
                edits_[c].apply(input_.cards()[c]);
                any = true;
            }
        if (!any) return before_.companion;
        write_closed_sets();
        return std::make_shared<const SolverInput>(std::move(input_));
    }

    const std::vector<std::string>& notes() const { return notes_; }
    const std::vector<std::string>& problems() const { return problems_; }

private:
    // --- messages ----------------------------------------------------------------------------------

    /// Says `what` about the node or element of line `where`; equal remarks on one card become one.
    void remark(std::size_t card, bool problem, const std::string& where, const std::string& entity,
                const std::string& what) {
        Remark& r = remarks_[{card, problem, what}];
        if (r.count++ == 0) {
            r.where = where;
            r.entity = entity;
        }
    }

    void collect_messages() {
        for (const auto& [key, r] : remarks_) {
            const auto& [card, problem, what] = key;
            std::string text = r.where + "*" + old_.input().cards()[card].keyword + " names " + r.entity;
            if (r.count > 1)
                text += " and " + std::to_string(r.count - 1) + " more, each of which " + what;
            else
                text += ", which " + what;
            (problem ? problems_ : notes_).push_back(std::move(text));
        }
    }

    static std::string node_text(Index number) { return "node " + std::to_string(number); }
    static std::string element_text(Index number) { return "element " + std::to_string(number); }

    // --- what became of things ---------------------------------------------------------------------

    bool node_gone(Index number) const { return old_.numbers().node(number) && !new_numbers_.node(number); }

    /// All elements that an element of the input became.
    std::vector<Index> parts_of(Index element) const {
        std::vector<Index> out;
        if (new_numbers_.cell(element)) out.push_back(element);
        if (const auto it = parts_.find(element); it != parts_.end())
            out.insert(out.end(), it->second.begin(), it->second.end());
        return out;
    }

    bool in_mesh(Index element) const { return old_.numbers().cell(element).has_value(); }

    /// Elements (face 0) or element faces.
    using Faces = std::vector<std::pair<Index, int>>;

    void find_marked() {
        std::vector<Faces*> of_group(after_.groups.size(), nullptr);
        bool any = false;
        for (std::size_t g = 0; g < of_group.size(); ++g)
            if (after_.groups[g].hidden && after_.groups[g].kind != GroupKind::node &&
                after_.groups[g].name.starts_with(mark_prefix)) {
                of_group[g] = &marked_[after_.groups[g].name];
                any = true;
            }
        if (!any) return;
        SparseCheck check;
        for (const CellBlock& b : after_.blocks())
            for (Index c = 0; c < b.size(); ++c, check())
                for (const GroupIndex g : after_.families.groups(b.families[c]))
                    if (of_group[g]) of_group[g]->push_back({b.ids[c], 0});
        for (const Facet& f : after_.facets)
            for (const GroupIndex g : after_.families.groups(f.family))
                if (of_group[g]) of_group[g]->push_back({after_.block(f.type).ids[f.cell], f.face});
        for (auto& [name, faces] : marked_) std::ranges::sort(faces);
    }

    /// Area or volume of a group of mark_deck().
    static double measure_of(const Mesh& mesh, const std::string& name) {
        double sum = 0;
        if (const auto g = mesh.find_group(name, GroupKind::facet, true)) {
            for (const Facet& f : mesh.facets)
                if (mesh.families.contains(f.family, *g)) sum += facet_measure(mesh, f);
        } else if (const auto e = mesh.find_group(name, GroupKind::element, true)) {
            SparseCheck check;
            for (const CellBlock& b : mesh.blocks())
                for (Index c = 0; c < b.size(); ++c, check())
                    if (mesh.families.contains(b.families[c], *e)) sum += cell_measure(mesh, b.type, c);
        }
        return sum;
    }

    // --- sets that must not grow -------------------------------------------------------------------

    std::optional<GroupIndex> node_group_now(std::string_view name) const {
        const auto s = new_groups_.find(DeckSetType::nset, name);
        return s ? after_.find_group(input_.sets()[*s].group, GroupKind::node) : std::nullopt;
    }

    void strip_closed_sets() {
        for (const DeckSet& set : input_.sets()) {
            if (!set.closed) continue;
            const auto group = after_.find_group(set.group, GroupKind::node);
            if (!group) continue;
            for (const Index number : new_nodes_)
                if (const auto node = new_numbers_.node(number)) {
                    FamilyIndex& family = after_.node_families[*node];
                    family = after_.families.without(family, *group);
                }
        }
    }

    bool has_new_members(GroupIndex group) const {
        return std::ranges::any_of(new_nodes_, [&](Index number) {
            const auto node = new_numbers_.node(number);
            return node && after_.families.contains(after_.node_families[*node], group);
        });
    }

    Index lost_members(std::string_view name) const {
        const auto group = old_.group(DeckSetType::nset, name);
        if (!group) return 0;
        const auto& members = old_.members(*group);
        return std::ranges::count_if(members, [&](Index number) { return !new_numbers_.node(number); });
    }

    /// The set of the old members of a set that has new ones; made when first asked for.
    std::string closed_set(const std::string& name, GroupIndex group) {
        if (const auto it = closed_.find(deck_key(name)); it != closed_.end()) return it->second;
        std::string made;
        for (int k = 1;; ++k) {
            made = name.substr(0, 17) + "_LOAD" + std::to_string(k);  // within Code_Aster's 24 characters
            if (!new_groups_.find(DeckSetType::nset, made) && !after_.find_group(made, GroupKind::node)) break;
        }
        const GroupIndex closed = after_.add_group(made, GroupKind::node);
        std::vector<Index> fresh = new_nodes_;
        std::ranges::sort(fresh);
        for (Index n = 0; n < after_.node_count(); ++n)
            if (after_.families.contains(after_.node_families[n], group) &&
                !std::ranges::binary_search(fresh, after_.node_ids[n]))
                after_.node_families[n] = after_.families.with(after_.node_families[n], closed);
        DeckSet set;
        set.name = set.group = made;
        set.closed = true;
        input_.sets().push_back(std::move(set));
        new_groups_ = DeckSetIndex(input_.sets());
        closed_.emplace(deck_key(name), made);
        return made;
    }

    void write_closed_sets() {
        if (closed_.empty()) return;
        std::vector<Card>& cards = input_.cards();
        std::size_t at = 0;
        for (std::size_t c = 0; c < cards.size(); ++c)
            if (card_content(cards[c]) == CardContent::mesh) at = c + 1;
        for (const auto& [key, name] : closed_) {
            Card card;
            card.set_text("*NSET, NSET=" + name + "\n");
            cards.insert(cards.begin() + static_cast<std::ptrdiff_t>(at++), std::move(card));
        }
    }

    /// The name that stands for a set's old members; the set's own if it has no new ones.
    std::string name_of_old_members(const std::string& name) {
        const auto group = node_group_now(name);
        return group && has_new_members(*group) ? closed_set(name, *group) : name;
    }

    /// Sets and surfaces that had members and have none any more.
    void find_emptied() {
        const auto present = [](const Mesh& mesh) {
            std::vector<char> out(mesh.groups.size(), 0);
            const auto meet = [&](FamilyIndex family, GroupKind kind) {
                for (const GroupIndex g : mesh.families.groups(family)) out[g] = out[g] || mesh.groups[g].kind == kind;
            };
            for (const FamilyIndex f : mesh.node_families) meet(f, GroupKind::node);
            for (const CellBlock& b : mesh.blocks())
                for (const FamilyIndex f : b.families) meet(f, GroupKind::element);
            for (const Facet& f : mesh.facets) meet(f.family, GroupKind::facet);
            return out;
        };
        const std::vector<char> had = present(before_), has = present(after_);
        for (const DeckSet& set : old_.input().sets()) {
            const auto was = before_.find_group(set.group, group_kind(set.type)),
                       is = after_.find_group(set.group, group_kind(set.type));
            if (set.unheld.empty() && was && had[*was] && (!is || !has[*is]))
                emptied_.emplace(deck_key(set.name), std::string(to_string(set.type)));
        }
    }

    /// Cards that name such a set say less than they did; those whose lines carry loads or equations are told of on
    /// their own.
    void check_emptied(std::size_t c, const Card& card, CardContent content) {
        if (emptied_.empty() || content == CardContent::node_loads || content == CardContent::node_weights ||
            content == CardContent::equation)
            return;
        const auto check = [&](const std::string& where, const std::string& name) {
            if (const auto set = emptied_.find(deck_key(name)); set != emptied_.end())
                remark(c, true, where, set->second + " '" + name + "'", "lost all its members");
        };
        for (const CardParameter& p : card.parameters)
            if (p.name == "NSET" || p.name == "ELSET" || p.name == "SURFACE") check(card.where() + ": ", p.value);
        const bool pair = card.keyword == "TIE" || card.keyword == "CONTACTPAIR";
        CardReader line(card);
        while (line.next_data_line())
            for (int k = 0; k < (pair ? 2 : 1) && !line.at_end(); ++k) check(line.where(), line.field());
    }

    // --- cards -------------------------------------------------------------------------------------

    void carry_card(std::size_t c) {
        check_cancelled();
        const Card& card = input_.cards()[c];
        check_references(c, card);
        const auto content = card_content(card);
        if (!content) {
            if (unknown_.insert(card.keyword).second)
                problems_.push_back(
                    card.where() + ": *" + card.keyword +
                    " is not a card of CalculiX 2.20: whether it names nodes or elements is not known, so it "
                    "is kept as it is; check it");
            return;
        }
        if (*content != CardContent::mesh) check_emptied(c, card, *content);
        switch (*content) {
            case CardContent::nodal_dofs:
            case CardContent::nodal_dof:
            case CardContent::nodal_values:
            case CardContent::nodal_list:
                pools_[std::to_string(old_.step(c)) + parameters_key(card)].push_back(c);
                break;
            case CardContent::node_loads:
                carry_node_loads(c, card, true);
                break;
            case CardContent::node_weights:
                carry_node_loads(c, card, false);
                break;
            case CardContent::element_loads:
                carry_element_loads(c, card);
                break;
            case CardContent::element_values:
                carry_element_values(c, card);
                break;
            case CardContent::element_list:
                carry_element_list(c, card);
                break;
            case CardContent::element_normals:
                carry_normals(c, card);
                break;
            case CardContent::equation:
                carry_equations(c, card);
                break;
            case CardContent::face_equation:
                check_face_equations(c, card);
                break;
            case CardContent::mpc:
                carry_mpcs(c, card);
                break;
            case CardContent::foreign_results:
                problems_.push_back(
                    card.where() + ": *" + card.keyword +
                    ", READ needs results of the mesh as it was; the changed mesh has other nodes and elements");
                break;
            case CardContent::nothing:
                if (card.keyword == "VIEWFACTOR") check_view_factors(card);
                break;
            case CardContent::mesh:
                break;
        }
    }

    void check_view_factors(const Card& card) {
        if (card.parameter("READ") && !view_factors_made_)
            problems_.push_back(card.where() +
                                ": *VIEWFACTOR, READ needs view factors of the mesh as it was; compute them anew");
        else
            view_factors_made_ = true;
    }

    void check_references(std::size_t c, const Card& card) {
        for (const auto& [parameter, node] : reference_nodes(card)) {
            if (node_gone(node))
                remark(c, true, card.where() + ": ", node_text(node), "was removed; give another " + parameter);
            else if (origins_.is_doubled(node))
                remark(c, true, card.where() + ": ", node_text(node),
                       "the crack doubled; " + parameter + " stays the original, on the negative side");
        }
    }

    void carry_node_loads(std::size_t c, const Card& card, bool loads) {
        CardReader line(card);
        while (line.next_data_line()) {
            const auto what = read_number_or_set(line);
            if (!what) continue;
            const std::string share = loads ? "load" : "part";
            if (!what->is_number()) {
                if (const Index lost = lost_members(what->set); lost > 0)
                    remark(c, true, line.where(), "set '" + what->set + "'",
                           "lost " + std::to_string(lost) + " node(s) and with them their " + share);
                const std::string name = name_of_old_members(what->set);
                if (name == what->set) continue;
                remark(c, false, line.where(), "set '" + what->set + "'",
                       "has new nodes; the card now names '" + name +
                           "', the nodes it had, so that the total stays the same");
                edits_[c].replace(line, name + "," + std::string(line.rest()));
                continue;
            }
            const Index node = what->number;
            if (node_gone(node)) {
                remark(c, true, line.where(), node_text(node), "was removed, and with it the " + share);
                edits_[c].drop(line);
            } else if (origins_.is_doubled(node)) {
                remark(c, !loads, line.where(), node_text(node),
                       "the crack doubled; its " + share + " stays whole on the original, on the negative side");
            }
            if (origins_.moved(node) > unmoved * size_)
                remark(c, true, line.where(), node_text(node),
                       "is a mid-side node that moved by " + number_text(origins_.moved(node)) + " with its edge");
        }
    }

    /// A line of a distributed load, and where its load is applied in the input.
    struct LoadLine {
        CardReader line;
        NumberOrSet what;
        std::string written;  ///< label
        LoadLabel label;
        std::string rest;
        std::string mark;  ///< the group that has its faces or elements; empty if the line stays as it is
        Faces faces;
        std::vector<Index> other_members;  ///< of a set: elements that have no such face

        std::string with(Index element, const std::string& new_label) const {
            return std::to_string(element) + ", " + new_label + (rest.empty() ? "" : "," + rest);
        }
    };

    void carry_element_loads(std::size_t c, const Card& card) {
        std::vector<LoadLine> lines = read_element_loads(c, card);
        // What each group still has to give to lines.
        std::map<std::string, std::set<std::pair<Index, int>>> left;
        for (const LoadLine& l : lines)
            if (!l.mark.empty())
                if (const auto [it, fresh] = left.try_emplace(l.mark); fresh)
                    it->second.insert(marked_[l.mark].begin(), marked_[l.mark].end());
        std::map<std::pair<std::string, Index>, const LoadLine*> line_of;  // by group and element of the input
        std::map<std::string, const LoadLine*> last_line;
        for (const LoadLine& l : lines) {
            if (l.mark.empty()) continue;
            last_line[l.mark] = &l;
            for (const auto& [element, face] : l.faces) line_of.emplace(std::pair(l.mark, element), &l);
            auto& there = left[l.mark];
            // A set stays if none of its elements has parts, which would be loaded too.
            const bool stays = std::ranges::all_of(l.faces, [&](const auto& f) {
                return there.contains(f) && (l.what.is_number() || !parts_.contains(f.first));
            });
            if (stays) {
                for (const auto& f : l.faces) there.erase(f);
                continue;
            }
            edits_[c].drop(l.line);
            for (const Index element : l.other_members)
                for (const Index part : parts_of(element)) edits_[c].add_after(l.line, l.with(part, l.written));
            for (const auto& [element, face] : l.faces)
                if (parts_of(element).empty() && shrank(l.mark))
                    remark(c, true, l.line.where(), element_text(element), "was removed, and with it its " + l.written);
        }
        for (const auto& [mark, faces] : left)
            for (const auto& [element, face] : faces) {
                const auto parent = parents_.find(element);
                const auto found = line_of.find({mark, parent == parents_.end() ? element : parent->second});
                const LoadLine& l = found == line_of.end() ? *last_line.at(mark) : *found->second;
                edits_[c].add_after(
                    l.line, l.with(element, face == 0 ? l.written : l.label.with_face(face, is_plane_now(element))));
            }
    }

    std::vector<LoadLine> read_element_loads(std::size_t c, const Card& card) {
        std::vector<LoadLine> out;
        CardReader line(card);
        while (line.next_data_line()) {
            const CardReader start = line;
            const auto what = read_number_or_set(line);
            if (!what) continue;
            const std::string written = line.field();
            LoadLine l{start, *what, written, LoadLabel(written), std::string(line.rest()), "", {}, {}};
            if (l.label.suffix == "FC")
                if (Index sink = 0; line.integer(sink) && origins_.is_doubled(sink))
                    remark(c, true, line.where(), node_text(sink),
                           "the crack doubled; the original, on the negative side, stays the sink");
            const auto look = [&](Index element) {
                const auto cell = old_.numbers().cell(element);
                if (!cell) return;
                const int face = l.label.face(cell->type, old_.is_plane(*cell));
                if (face > 0 || what->is_number())
                    l.faces.push_back({element, face});
                else
                    l.other_members.push_back(element);
            };
            if (what->is_number())
                look(what->number);
            else if (l.label.number > 0)
                if (const auto group = old_.group(DeckSetType::elset, what->set))
                    for (const Index element : old_.members(*group)) look(element);
            if (!l.faces.empty())
                l.mark = l.faces.front().second > 0 ? face_mark(c, l.label, l.rest) : element_mark(c, l.label, l.rest);
            out.push_back(std::move(l));
        }
        return out;
    }

    /// Whether a load lost area or volume. Elements that vanish in the work of an operator, their place taken by
    /// others of their groups, take no load with them.
    bool shrank(const std::string& mark) {
        const auto [it, fresh] = shrank_.try_emplace(mark);
        if (fresh) it->second = measure_of(after_, mark) < (1 - 1e-9) * measure_of(before_, mark);
        return it->second;
    }

    bool is_plane_now(Index element) const {
        // Parts stand under the card of their parent.
        const auto parent = parents_.find(element);
        return old_.is_plane(*old_.numbers().cell(parent == parents_.end() ? element : parent->second));
    }

    /// Largest number of state variables in the deck: records of initial solutions are as long.
    Index state_variables() const {
        Index most = 0;
        for (const Card& card : input_.cards()) {
            if (card.keyword != "DEPVAR") continue;
            CardReader line(card);
            if (Index count = 0; line.next_data_line() && line.integer(count)) most = std::max(most, count);
        }
        return most;
    }

    void carry_element_values(std::size_t c, const Card& card) {
        const std::string* type = card.parameter("TYPE");
        const bool points = card.keyword == "INITIALCONDITIONS";
        // Two entries and six values on the first line of a record, eight on the others.
        const Index lines =
            points && deck_key(*type) == "SOLUTION" ? 1 + std::max<Index>(0, state_variables() - 6 + 7) / 8 : 1;
        CardReader line(card);
        while (line.next_data_line()) {
            const auto what = read_number_or_set(line);
            std::string rest(line.rest());
            const bool known = what && what->is_number() && in_mesh(what->number);
            const std::vector<Index> parts = known ? parts_of(what->number) : std::vector<Index>{};
            const bool gone = known && !new_numbers_.cell(what->number);
            const std::string where = line.where();
            if (gone) edits_[c].drop(line);
            for (Index k = 1; k < lines && line.next_data_line(); ++k) {
                rest += "\n" + std::string(line.line());
                if (gone) edits_[c].drop(line);
            }
            if (!known) continue;
            if (parts.empty()) remark(c, true, where, element_text(what->number), "was removed");
            const CellType cell = old_.numbers().cell(what->number)->type;
            if (points && parts.size() > 1 && cell != CellType::tetra && cell != CellType::triangle)
                remark(c, true, where, element_text(what->number),
                       "was split; the values at its integration points are given to those of each part");
            for (const Index part : parts)
                if (part != what->number) edits_[c].add_after(line, std::to_string(part) + "," + rest);
        }
    }

    void carry_element_list(std::size_t c, const Card& card) {
        CardReader line(card);
        while (line.next_data_line()) {
            std::string now;
            bool same = true;
            std::vector<std::string> entries;
            while (!line.at_end()) {
                const auto what = read_number_or_set(line);
                if (!what) continue;
                if (!what->is_number() || !in_mesh(what->number)) {
                    entries.push_back(what->is_number() ? std::to_string(what->number) : what->set);
                    continue;
                }
                const std::vector<Index> parts = parts_of(what->number);
                same = same && parts == std::vector<Index>{what->number};
                if (parts.empty()) remark(c, true, line.where(), element_text(what->number), "was removed");
                for (const Index part : parts) entries.push_back(std::to_string(part));
            }
            if (same) continue;
            edits_[c].drop(line);
            for (const std::string& entry : entries) edits_[c].add_after(line, entry);
        }
    }

    void carry_normals(std::size_t c, const Card& card) {
        CardReader line(card);
        while (line.next_data_line()) {
            Index element = 0, node = 0;
            if (!line.integer(element) || !line.integer(node) || !in_mesh(element)) continue;
            std::vector<Index> images{node};
            const auto& copies = origins_.copies_of(node);
            images.insert(images.end(), copies.begin(), copies.end());
            std::vector<std::pair<Index, Index>> now;
            for (const Index part : parts_of(element)) {
                const CellRef cell = *new_numbers_.cell(part);
                for (const Index n : after_.block(cell.type).nodes(cell.cell))
                    if (std::ranges::find(images, after_.node_ids[n]) != images.end())
                        now.push_back({part, after_.node_ids[n]});
            }
            if (now == std::vector<std::pair<Index, Index>>{{element, node}}) continue;
            edits_[c].drop(line);
            if (now.empty())
                remark(c, true, line.where(), element_text(element), "has no longer the node of its normal");
            for (const auto& [part, image] : now)
                edits_[c].add_after(
                    line, std::to_string(part) + ", " + std::to_string(image) + "," + std::string(line.rest()));
        }
    }

    /// An equation of nodes given by number.
    struct Equation {
        std::size_t card;
        CardReader last;  // on its last line
    };

    /// All equations of numbered nodes, up to the first in a card that cannot be read. Sets are told of on their own.
    std::vector<NodeEquation> read_equations() {
        std::vector<NodeEquation> all;
        for (std::size_t c = 0; c < input_.cards().size(); ++c) {
            const Card& card = input_.cards()[c];
            if (card.keyword != "EQUATION" || card.parameter("REMOVE")) continue;
            CardReader line(card);
            Index terms = 0;
            while (line.next_data_line() && line.integer(terms) && terms > 0) {
                const char* start = nullptr;
                NodeEquation equation;
                bool numbered = true, complete = true;
                for (Index k = 0; k < terms && complete; ++k) {
                    while (line.at_end() && (complete = line.next_data_line()))
                        if (!start) start = line.raw().data();
                    const auto node = read_number_or_set(line);
                    const std::string dof = line.field(), factor = line.field();
                    NodeEquation::Term term{node ? node->number : 0, 0, 0, dof + ", " + factor};
                    numbered = numbered && node && node->is_number() && read_term(term);
                    equation.terms.push_back(term);
                }
                if (!complete) break;
                if (!numbered || !start) continue;
                equation_at_.emplace(start, all.size());
                equations_.push_back({c, line});
                all.push_back(std::move(equation));
            }
        }
        return all;
    }

    /// Finds the equations of new nodes.
    void relate_nodes() {
        const std::vector<NodeEquation> all = read_equations();
        related_ = relate_new_nodes(all, before_, old_.numbers(), origins_, changes_);
        for (const RelatedNodes::Made& made : related_.made) {
            if (!std::ranges::all_of(made.nodes, [&](Index n) { return new_numbers_.node(n).has_value(); })) continue;
            const NodeEquation& like = all[made.like];
            std::string text = std::to_string(made.nodes.size());
            for (std::size_t k = 0; k < made.nodes.size(); ++k)  // CalculiX reads four terms per line
                text += (k % 4 == 0 ? "\n" : ", ") + std::to_string(made.nodes[k]) + ", " + like.terms[k].written;
            edits_[equations_[made.like].card].add_after(equations_[made.like].last, text);
        }
        tell_unrelated(related_.missed,
                       "lie between nodes that this card relates, but have no counterpart between the partners of "
                       "these, or the equations of these are "
                       "of different form: they are not related. Give them equations, or move the tool so that both "
                       "sides are divided alike");
        tell_unrelated(related_.one_sided,
                       "on the crack lie between nodes that this card relates, and their partners are not doubled: "
                       "only those on the negative side are "
                       "related. Check the equations there");
    }

    static bool read_term(NodeEquation::Term& term) {
        Card card;
        card.set_text("*EQUATION\n" + term.written + "\n");
        CardReader line(card);
        return line.next_data_line() && line.integer(term.dof) && line.number(term.factor);
    }

    /// One message per card.
    void tell_unrelated(const std::vector<RelatedNodes::Missed>& missed, const std::string& what) {
        std::map<std::size_t, std::pair<CardReader, std::set<Index>>> by_card;
        for (const RelatedNodes::Missed& m : missed)
            by_card.try_emplace(equations_[m.like].card, equations_[m.like].last, std::set<Index>{})
                .first->second.second.insert(m.node);
        for (const auto& [c, found] : by_card)
            problems_.push_back(found.first.where() + "*" + input_.cards()[c].keyword + ": " +
                                std::to_string(found.second.size()) + " new node(s), the first is " +
                                std::to_string(*found.second.begin()) + ", " + what);
    }

    void carry_equations(std::size_t c, const Card& card) {
        CardReader line(card);
        if (card.parameter("REMOVE")) {
            while (line.next_data_line())
                if (const auto what = read_number_or_set(line)) check_term(c, line, *what);
            return;
        }
        Index terms = 0;
        while (line.next_data_line()) {
            std::vector<CardReader> lines{line};
            if (!line.integer(terms) || terms < 1 || line.next_data_line() == false) {
                problems_.push_back(line.where() + "*" + card.keyword +
                                    ": no equation can be read here; the rest of the card is kept as it is");
                return;
            }
            lines.push_back(line);
            const auto known = equation_at_.find(line.raw().data());
            const bool copies_follow = known != equation_at_.end() && related_.copies_follow[known->second];
            std::vector<std::pair<CardReader, std::string>> changed;
            bool gone = false;
            std::string now;
            bool same = true;
            for (Index k = 0; k < 3 * terms;) {
                if (line.at_end()) {
                    if (!same) changed.emplace_back(line, now);
                    now.clear();
                    same = true;
                    if (!line.next_data_line()) return;
                    lines.push_back(line);
                    continue;
                }
                std::string field;
                if (k % 3 == 0) {
                    const auto what = read_number_or_set(line);
                    if (what && what->is_number()) {
                        gone = gone || node_gone(what->number);
                        check_term(c, line, *what, copies_follow);
                        field = std::to_string(what->number);
                    } else if (what) {
                        field = name_of_old_members(what->set);
                        if (lost_members(what->set) > 0)
                            remark(c, true, line.where(), "set '" + what->set + "'",
                                   "lost nodes; its pairs no longer match");
                        if (field != what->set) {
                            same = false;
                            remark(c, true, line.where(), "set '" + what->set + "'",
                                   "has new nodes; the equations stay with the nodes it had ('" + field + "')");
                        }
                    }
                } else {
                    field = line.field();
                }
                now += (now.empty() ? "" : ", ") + field;
                ++k;
            }
            if (!same) changed.emplace_back(line, now);
            if (gone)
                for (const CardReader& l : lines) edits_[c].drop(l);
            else
                for (const auto& [l, text] : changed) edits_[c].replace(l, text);
        }
    }

    void check_term(std::size_t c, const CardReader& line, const NumberOrSet& what, bool copies_follow = false) {
        if (!what.is_number()) return;
        if (node_gone(what.number))
            remark(c, true, line.where(), node_text(what.number), "was removed; its equation is left out");
        else if (origins_.is_doubled(what.number) && !copies_follow)
            remark(c, true, line.where(), node_text(what.number),
                   "the crack doubled; the equation stays with the original, on the negative side");
    }

    void check_face_equations(std::size_t c, const Card& card) {
        CardReader line(card);
        while (line.next_data_line())
            for (int k = 0; !line.at_end(); ++k) {
                Index element = 0;
                if (k % 4 != 0 || !line.integer(element)) {
                    line.field();
                    continue;
                }
                if (in_mesh(element) && parts_of(element) != std::vector<Index>{element})
                    remark(c, true, line.where(), element_text(element),
                           "was split or removed; the equation is kept as it is");
            }
    }

    void carry_mpcs(std::size_t c, const Card& card) {
        CardReader line(card);
        bool more = line.next_data_line();
        while (more) {
            Index first = 0;
            const std::string type = line.integer(first) ? "" : deck_key(line.field());
            const bool lists_nodes = type == "PLANE" || type == "STRAIGHT";
            std::vector<Index> nodes;
            CardReader last = line;
            do {
                last = line;
                std::string left = nodes.empty() ? type : "";
                bool gone = false;
                while (!line.at_end()) {
                    const auto what = read_number_or_set(line);
                    if (!what) continue;
                    if (what->is_number() && what->number > 0) {
                        nodes.push_back(what->number);
                        if (node_gone(what->number)) {
                            remark(c, true, line.where(), node_text(what->number),
                                   lists_nodes ? "was removed, and leaves the list" : "was removed");
                            gone = true;
                            continue;
                        }
                        if (!lists_nodes && origins_.is_doubled(what->number))
                            remark(c, true, line.where(), node_text(what->number),
                                   "the crack doubled; the " + type +
                                       " MPC stays with the original, on the negative side");
                    }
                    left += (left.empty() ? "" : ", ") + (what->is_number() ? std::to_string(what->number) : what->set);
                }
                if (gone && lists_nodes) edits_[c].replace(last, left);
                more = line.next_data_line();
                CardReader probe = line;
                Index zero = -1;
                if (!more || !probe.integer(zero) || zero != 0) break;
                line = probe;
            } while (true);
            std::ranges::sort(nodes);
            if (!lists_nodes) {
                tell_not_joining(last, type, nodes);
                continue;
            }
            std::string added;
            int count = 0;
            for (const NodeOrigins::Node& n : origins_.nodes()) {
                if (!n.is_new ||
                    !std::ranges::all_of(n.ancestors, [&](Index a) { return std::ranges::binary_search(nodes, a); }))
                    continue;
                added += ", " + std::to_string(n.number);
                if (++count % 15 != 0) continue;
                edits_[c].add_after(last, "0" + added);
                added.clear();
            }
            if (!added.empty()) edits_[c].add_after(last, "0" + added);
        }
    }

    void tell_not_joining(const CardReader& line, const std::string& type, const std::vector<Index>& nodes) {
        std::set<Index> between;
        for (const NodeOrigins::Node& n : origins_.nodes())
            if (n.is_new && n.ancestors.size() > 1 &&
                std::ranges::all_of(n.ancestors, [&](Index a) { return std::ranges::binary_search(nodes, a); }))
                between.insert(n.number);
        if (!between.empty())
            problems_.push_back(line.where() + "*MPC: " + std::to_string(between.size()) +
                                " new node(s), the first is " + std::to_string(*between.begin()) +
                                ", lie between nodes of this " + type + " MPC and do not join it");
    }

    void check_other_elements() {
        for (const OtherElement& e : input_.other_elements())
            for (const Index node : e.nodes)
                if (node_gone(node))
                    throw Error(input_.cards()[e.card].where() + ": element " + std::to_string(e.number) + " of type " +
                                e.type + " needs " + node_text(node) +
                                ", which would be removed, and cannot be removed itself. Move the tool, or take the "
                                "element out of the deck");
                else if (origins_.is_doubled(node))
                    remark(e.card, true, input_.cards()[e.card].where() + ": ", node_text(node),
                           "the crack doubled; element " + std::to_string(e.number) + " of type " + e.type +
                               " stays with the original, on the negative side");
    }

    // --- values at nodes ---------------------------------------------------------------------------

    using Values = std::map<int, double>;  // by degree of freedom, or by column

    struct NodalLine {
        std::optional<GroupIndex> before, after;  // of a set
        Values values;
    };

    /// Lines of equal cards, as one: later lines count.
    struct Pool {
        std::vector<NodalLine> lines;
        std::unordered_map<Index, std::vector<std::size_t>> of_node;
        std::vector<std::size_t> of_sets;
    };

    Pool read_pool(const std::vector<std::size_t>& cards) {
        Pool pool;
        for (const std::size_t c : cards) {
            const Card& card = input_.cards()[c];
            const CardContent content = *card_content(card);
            CardReader line(card);
            while (line.next_data_line()) {
                const auto what = read_number_or_set(line);
                if (!what) continue;
                NodalLine out;
                double value = 0;
                Index first = 0, last = 0;
                switch (content) {
                    case CardContent::nodal_dofs:
                        if (!line.integer(first)) {
                            problems_.push_back(line.where() + "*" + card.keyword + ": '" + line.field() +
                                                "' is no degree of freedom; the line is kept as it is");
                            continue;
                        }
                        if (line.at_end() || !line.integer(last)) {
                            line.field();
                            last = first;
                        }
                        if (last == 0) last = first;
                        if (!line.at_end()) line.number(value);
                        for (Index dof = first; dof <= std::min<Index>(last, first + 100); ++dof)
                            out.values[static_cast<int>(dof)] = value;
                        break;
                    case CardContent::nodal_dof:
                        if (!line.integer(first)) continue;
                        if (!line.at_end()) line.number(value);
                        out.values[static_cast<int>(first)] = value;
                        break;
                    case CardContent::nodal_values:
                        for (int column = 0; !line.at_end() && line.number(value); ++column) out.values[column] = value;
                        break;
                    default:
                        out.values[0] = 0;
                }
                if (what->is_number()) {
                    if (node_gone(what->number)) {
                        remark(c, true, line.where(), node_text(what->number), "was removed");
                        edits_[c].drop(line);
                    }
                    pool.of_node[what->number].push_back(pool.lines.size());
                } else {
                    out.before = old_.group(DeckSetType::nset, what->set);
                    out.after = node_group_now(what->set);
                    pool.of_sets.push_back(pool.lines.size());
                }
                pool.lines.push_back(std::move(out));
            }
        }
        return pool;
    }

    Values values_of(const Pool& pool, const Mesh& mesh, const NumberIndex& numbers, Index number) const {
        std::vector<std::size_t> lines;
        if (const auto it = pool.of_node.find(number); it != pool.of_node.end()) lines = it->second;
        const auto node = numbers.node(number);
        for (const std::size_t l : pool.of_sets) {
            const auto group = &mesh == &before_ ? pool.lines[l].before : pool.lines[l].after;
            if (group && node && mesh.families.contains(mesh.node_families[*node], *group)) lines.push_back(l);
        }
        std::ranges::sort(lines);
        Values out;
        for (const std::size_t l : lines)
            for (const auto& [key, value] : pool.lines[l].values) out[key] = value;
        return out;
    }

    /// What a node of the result should have: all that its ancestors have in common, interpolated.
    Values wanted_values(const Pool& pool, std::size_t which) const {
        const NodeOrigins::Node& node = origins_.nodes()[which];
        const auto old_values = [&](Index number) { return values_of(pool, before_, old_.numbers(), number); };
        std::vector<Values> of_ancestors, of_shares;
        for (const Index a : node.ancestors) {
            of_ancestors.push_back(old_values(a));
            if (of_ancestors.back().empty()) return {};
        }
        const std::vector<NodeOrigins::Share>& shares = origins_.shares(which);
        for (const NodeOrigins::Share& s : shares) of_shares.push_back(old_values(s.node));
        Values out;
        for (const auto& [key, first] : of_ancestors.front()) {
            if (!std::ranges::all_of(of_ancestors, [&](const Values& v) { return v.contains(key); })) continue;
            const bool inside =
                !of_shares.empty() && std::ranges::all_of(of_shares, [&](const Values& v) { return v.contains(key); });
            const std::vector<Values>& sources = inside ? of_shares : of_ancestors;
            const double any = sources.front().at(key);
            double value = 0;
            for (std::size_t k = 0; k < sources.size(); ++k)
                value += sources[k].at(key) * (inside ? shares[k].weight : 1 / static_cast<double>(sources.size()));
            const bool equal = std::ranges::all_of(sources, [&](const Values& v) { return v.at(key) == any; });
            out[key] = equal ? any : value;
        }
        return out;
    }

    void carry_pool(const std::vector<std::size_t>& cards) {
        const Pool pool = read_pool(cards);
        if (pool.lines.empty()) return;
        const std::size_t c = cards.back();
        const Card& card = input_.cards()[c];
        const CardContent content = *card_content(card);
        for (std::size_t k = 0; k < origins_.nodes().size(); ++k) {
            check_cancelled();
            const NodeOrigins::Node& node = origins_.nodes()[k];
            const Values wanted = wanted_values(pool, k);
            if (wanted.empty()) continue;
            const Values given = values_of(pool, after_, new_numbers_, node.number);
            const auto is_given = [&](int key, double value) {
                const auto it = given.find(key);
                return it != given.end() && std::abs(it->second - value) <= 1e-12 * std::abs(value);
            };
            const std::string number = std::to_string(node.number);
            if (content == CardContent::nodal_values || content == CardContent::nodal_list) {
                if (std::ranges::all_of(wanted, [&](const auto& v) { return is_given(v.first, v.second); })) continue;
                std::string text = number + ",";
                if (content == CardContent::nodal_values)
                    for (int column = 0; column <= wanted.rbegin()->first; ++column)
                        text += (column > 0 ? "," : "") +
                                (wanted.contains(column) ? number_text(wanted.at(column)) : std::string());
                edits_[c].append(card, text);
                continue;
            }
            for (auto it = wanted.begin(); it != wanted.end();) {
                const auto [dof, value] = *it++;
                if (is_given(dof, value)) continue;
                int last = dof;
                if (content == CardContent::nodal_dofs) {
                    while (it != wanted.end() && it->first == last + 1 && it->second == value &&
                           !is_given(it->first, value)) {
                        ++last;
                        ++it;
                    }
                    edits_[c].append(card, number + "," + std::to_string(dof) + "," + std::to_string(last) +
                                               (value == 0 ? "" : "," + number_text(value)));
                } else {
                    edits_[c].append(card, number + "," + std::to_string(dof) + "," + number_text(value));
                }
            }
        }
    }

    const Mesh& before_;
    Mesh& after_;
    DeckView old_;
    NumberIndex new_numbers_;
    NodeOrigins origins_;
    SolverInput input_;
    std::vector<CardEdits> edits_;  // by card
    const Changes& changes_;
    std::vector<Equation> equations_;                           // of nodes by number
    std::unordered_map<const char*, std::size_t> equation_at_;  // the same by start of their first line of terms
    RelatedNodes related_;
    double size_ = 0;
    std::vector<Index> new_nodes_;
    std::unordered_map<Index, std::vector<Index>> parts_;  // parent -> further parts
    std::unordered_map<Index, Index> parents_;             // further part -> parent
    std::map<std::string, Faces> marked_;                  // group of mark_deck() -> what is in it now
    std::map<std::string, bool> shrank_;
    DeckSetIndex new_groups_{{}};
    std::map<std::string, std::string> closed_;              // set -> set of its old members
    std::map<std::string, std::vector<std::size_t>> pools_;  // equal cards with values at nodes
    std::map<std::string, std::string> emptied_;             // sets without members any more -> type
    std::set<std::string> unknown_;
    bool view_factors_made_ = false;
    struct Remark {
        std::string where, entity;
        Index count = 0;
    };
    std::map<std::tuple<std::size_t, bool, std::string>, Remark> remarks_;
    std::vector<std::string> notes_, problems_;
};

/// Whether a deck has nothing that would have to follow a change: a mesh with sets, and cards that name neither.
bool is_mesh_alone(const SolverInput& input) {
    return input.other_elements().empty() &&
           std::ranges::none_of(input.sets(), [](const DeckSet& s) { return s.closed; }) &&
           std::ranges::all_of(input.cards(), [](const Card& card) {
               const auto content = card_content(card);
               return content && (*content == CardContent::mesh || *content == CardContent::nothing) &&
                      card.keyword != "VIEWFACTOR" && reference_nodes(card).empty();
           });
}

}  // namespace

void carry_deck(const Mesh& before, Mesh& after, const Changes& changes, bool strict,
                std::vector<std::string>& warnings) {
    const SolverInput* const deck = solver_input(before);
    if (!deck || is_mesh_alone(*deck)) return;
    CarryOver carry(before, after, changes);
    after.companion = carry.run();
    if (strict && !carry.problems().empty()) {
        std::string text = "the solver's input cannot follow the change (strict=True):";
        for (const std::string& problem : carry.problems()) text += "\n  " + problem;
        throw Error(text);
    }
    warnings.insert(warnings.end(), carry.problems().begin(), carry.problems().end());
    warnings.insert(warnings.end(), carry.notes().begin(), carry.notes().end());
}

void remove_marks(Mesh& mesh) {
    std::vector<bool> marks(mesh.groups.size());
    for (std::size_t g = 0; g < marks.size(); ++g)
        marks[g] = mesh.groups[g].hidden && mesh.groups[g].name.starts_with(mark_prefix);
    if (std::ranges::find(marks, true) != marks.end()) remove_groups(mesh, marks);
}

}  // namespace femscalpel
