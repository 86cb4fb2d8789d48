// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "cancel.h"
#include "deck/edge_beams.h"
#include "error.h"
#include "io/bdf.h"
#include "io/bdf_sets.h"
#include "io/bdf_source.h"
#include "io/bdf_systems.h"
#include "io/bdf_types.h"
#include "utf8.h"

namespace femscalpel {
namespace {

class BdfReader {
public:
    explicit BdfReader(const std::filesystem::path& path)
        : source_(path), systems_(source_, [this](Index node, const BdfCard& card) { return place(node, card); }) {
        mesh_.name = shown_path(path.stem());
        mesh_.remarks = source_.remarks();
    }

    Mesh read() {
        BdfCard card;
        for (SparseCheck check(1 << 12); source_.next(card); check()) take(card);
        if (grids_.empty()) throw ReadError(source_.shown() + ": there are no nodes (GRID) in this file");
        make_nodes();
        join_elements();
        make_groups();
        mark_edge_beams(mesh_);  // CBAR and kin are never but the edges of others
        tell_rest();
        return std::move(mesh_);
    }

private:
    struct Grid {
        Index number;
        Index system;
        Vec3 x;
        const char* at;
        bool placed = false;
    };

    void take(const BdfCard& card) {
        if (card.name == "GRID") {
            read_grid(card);
        } else if (card.name == "GRDSET") {
            default_system_ = source_.integer(card, 1, "a coordinate system", 0);
            default_turned_ = source_.integer(card, 5, "a coordinate system", 0);
        } else if (const BdfElement* element = bdf_element(card.name)) {
            read_element(card, *element);
        } else if (card.name == "SPC1" || card.name == "SPC") {
            read_supports(card);
        } else if (is_foreign_bdf_element(card.name)) {
            throw UnsupportedElementError(source_.where(card.at) + "elements " + card.name +
                                          " are none that FemScalpel can hold; export the mesh without them");
        } else if (!systems_.add(card)) {
            auto& [at, count] = rest_[card.name];
            if (count++ == 0) at = card.at;
        }
    }

    Index positive(const BdfCard& card, const char* what) const {
        const Index number = source_.integer(card, 0, what);
        if (number <= 0) source_.fail(card.at, card.name + " has the number " + std::to_string(number));
        return number;
    }

    void read_grid(const BdfCard& card) {
        Grid grid{positive(card, "the number of the node"), 0, {}, card.at};
        grid.system = source_.integer(card, 1, "the coordinate system", -1);  // GRDSET may come later
        for (std::size_t a = 0; a < 3; ++a)
            grid.x[static_cast<Eigen::Index>(a)] = source_.real(card, 2 + a, "a coordinate");
        const Index turned = source_.integer(card, 5, "the displacement system", -1);
        if (turned > 0)
            ++turned_;
        else if (turned < 0)
            ++not_said_;
        if (!card.field(6).empty()) ++held_;
        grids_.push_back(grid);
    }

    void read_element(const BdfCard& card, const BdfElement& element) {
        const Index number = positive(card, "the number of the element");
        const std::size_t first = element.has_property ? 2 : 1;
        const auto most = static_cast<std::size_t>(traits(element.quadratic).nodes);
        const auto corners = static_cast<std::size_t>(traits(element.type).nodes);
        std::size_t there = 0;
        for (std::size_t k = corners; k < most; ++k)
            there += !card.field(first + k).empty() && card.field(first + k) != "0";
        if (there > 0 && there < most - corners)
            throw UnsupportedElementError(source_.where(card.at) + card.name + " " + std::to_string(number) + " has " +
                                          std::to_string(there) + " of its " + std::to_string(most - corners) +
                                          " mid-side nodes; FemScalpel holds elements with all or none of them");
        const CellType type = there > 0 ? element.quadratic : element.type;
        CellBlock& block = mesh_.block(type);
        const auto order = bdf_order(type);
        const auto count = static_cast<std::size_t>(traits(type).nodes);
        const std::size_t start = block.connectivity.size();
        block.connectivity.resize(start + count);
        for (std::size_t k = 0; k < count; ++k)
            block.connectivity[start + static_cast<std::size_t>(order[k])] =
                source_.integer(card, first + k, "the number of a node");
        block.ids.push_back(number);
        block.families.push_back(0);
        element_at_[static_cast<std::size_t>(type)].push_back(card.at);
        // Without a property's number it is the element's.
        const Index property = element.has_property ? source_.integer(card, 1, "the number of a property", number) : 0;
        properties_[property].push_back(number);
        if (card.fields.size() > first + (type == element.quadratic ? most : std::max(corners, most)))
            with_more_.insert(card.name);
    }

    void read_supports(const BdfCard& card) {
        const Index set = source_.integer(card, 0, "the number of the set");
        const std::string begin = "SPC_" + std::to_string(set) + "_";
        const auto at = [&](const std::string& name) -> Supports& {
            const auto [it, added] = support_of_.try_emplace(name, supports_.size());
            if (added) supports_.push_back({name, card.at, {}});
            return supports_[it->second];
        };
        if (card.name == "SPC") {
            for (std::size_t k = 1; k < card.fields.size(); k += 3)
                if (!card.field(k).empty())
                    at(begin + std::string(card.field(k + 1))).words.push_back(std::string(card.field(k)));
            return;
        }
        Supports& to = at(begin + std::string(card.field(1)));
        for (std::size_t k = 2; k < card.fields.size(); ++k) {
            std::string word(card.field(k));
            for (char& c : word)
                if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
            if (!word.empty()) to.words.push_back(std::move(word));
        }
    }

    Vec3 place(Index node, const BdfCard& asked_by) {
        const auto found = grid_of_.find(node);
        if (found == grid_of_.end())
            source_.fail(asked_by.at,
                         asked_by.name + " names node " + std::to_string(node) + ", which the file does not define");
        return place(grids_[found->second]);
    }

    Vec3 place(Grid& grid) {
        if (!grid.placed) {
            grid.x = systems_.basic(grid.system < 0 ? default_system_ : grid.system, grid.x, grid.at);
            grid.placed = true;
        }
        return grid.x;
    }

    void make_nodes() {
        grid_of_.reserve(grids_.size());
        for (std::size_t n = 0; n < grids_.size(); ++n)
            if (!grid_of_.emplace(grids_[n].number, n).second)
                source_.fail(grids_[n].at, "the number of this node is used twice");
        for (Grid& grid : grids_) {
            mesh_.points.push_back(place(grid));
            mesh_.node_ids.push_back(grid.number);
        }
        mesh_.node_families.assign(grids_.size(), 0);
    }

    void join_elements() {
        std::unordered_map<Index, const char*> seen;
        for (CellBlock& block : mesh_.blocks()) {
            const auto& at = element_at_[static_cast<std::size_t>(block.type)];
            const auto nodes = static_cast<std::size_t>(traits(block.type).nodes);
            SparseCheck check(1 << 12);
            for (std::size_t c = 0; c < block.ids.size(); ++c, check()) {
                const auto [it, added] = seen.emplace(block.ids[c], at[c]);
                if (!added) source_.fail(std::max(at[c], it->second), "the number of this element is used twice");
                for (std::size_t k = c * nodes; k < (c + 1) * nodes; ++k) {
                    const auto found = grid_of_.find(block.connectivity[k]);
                    if (found == grid_of_.end())
                        source_.fail(at[c], "element " + std::to_string(block.ids[c]) + " names node " +
                                                std::to_string(block.connectivity[k]) +
                                                ", which the file does not define");
                    block.connectivity[k] = static_cast<Index>(found->second);
                }
            }
        }
    }

    void add_group(const std::string& name, GroupKind kind, std::vector<Index> ids, const char* at) {
        std::string free = name;
        for (int k = 2; !taken_.insert({kind, free}).second; ++k) free = name + "_" + std::to_string(k);
        if (free != name) remark(at, "there are several groups '" + name + "'; this one is called '" + free + "'");
        mesh_.groups.push_back({free, kind, false});
        members_.push_back({kind, std::move(ids), {}});
    }

    void make_groups() {
        node_numbers_ = mesh_.node_ids;
        std::ranges::sort(node_numbers_);
        for (const CellBlock& b : mesh_.blocks())
            element_numbers_.insert(element_numbers_.end(), b.ids.begin(), b.ids.end());
        std::ranges::sort(element_numbers_);
        const BdfNames names = bdf_names(source_);
        make_sets(names);
        if (!names.stand_ins) make_properties(names);
        for (const Supports& s : supports_) {
            BdfNumbers numbers;
            if (!numbers.parse(s.words)) source_.fail(s.at, "the nodes of this support are not whole numbers");
            tell_absent(s.name, numbers.absent(node_numbers_), s.at);
            add_group(s.name, GroupKind::node, numbers.among(node_numbers_), s.at);
        }
        assign_groups(mesh_, members_);
    }

    void tell_absent(const std::string& name, Index absent, const char* at) {
        if (absent > 0)
            remark(at, "group '" + name + "' names " + std::to_string(absent) +
                           " nodes or elements that the file does not define");
    }

    /// Of nodes and of elements, in order.
    std::vector<Index> all_numbers() const {
        std::vector<Index> out;
        std::ranges::set_union(node_numbers_, element_numbers_, std::back_inserter(out));
        return out;
    }

    void make_sets(const BdfNames& names) {
        std::vector<BdfSet> sets = bdf_sets(source_, other_statements_);
        std::set<Index> named;
        for (const BdfNames::Set& n : names.sets) {
            const auto set = std::ranges::find(sets, n.number, &BdfSet::number);
            const std::string name = n.name.empty() ? "SET_" + std::to_string(n.number) : n.name;
            named.insert(n.number);
            const auto& numbers = n.kind == GroupKind::node ? node_numbers_ : element_numbers_;
            if (set != sets.end() && !set->numbers) {
                remark(set->at, "set " + std::to_string(n.number) + " is not read: it lists no numbers");
                continue;
            }
            const char* at = set == sets.end() ? nullptr : set->at;
            if (at) tell_absent(name, set->numbers->absent(numbers), at);
            add_group(name, n.kind, at ? set->numbers->among(numbers) : std::vector<Index>(), at);
        }
        for (const BdfSet& set : sets) {
            if (named.contains(set.number)) continue;
            const std::string name = "SET_" + std::to_string(set.number);
            if (!set.numbers) {
                remark(set.at, "set " + std::to_string(set.number) + " is not read: it lists no numbers");
                continue;
            }
            std::vector<Index> nodes = set.numbers->among(node_numbers_),
                               elements = set.numbers->among(element_numbers_);
            const bool said = set.of_nodes || set.of_elements;
            if (!said && !nodes.empty() && !elements.empty())
                remark(set.at, "nothing says whether set " + std::to_string(set.number) +
                                   " is of nodes or of elements; there is a group of each");
            const bool of_nodes = said ? set.of_nodes : !nodes.empty() || elements.empty();
            const bool of_elements = said ? set.of_elements : !elements.empty();
            // Of both kinds, what is a node need be no element.
            if (of_nodes && of_elements)
                tell_absent(name, set.numbers->absent(all_numbers()), set.at);
            else
                tell_absent(name, set.numbers->absent(of_nodes ? node_numbers_ : element_numbers_), set.at);
            if (of_nodes) add_group(name, GroupKind::node, std::move(nodes), set.at);
            if (of_elements) add_group(name, GroupKind::element, std::move(elements), set.at);
        }
    }

    void make_properties(const BdfNames& names) {
        for (auto& [property, ids] : properties_) {
            const auto name = names.properties.find(property);
            std::ranges::sort(ids);
            add_group(property == 0                                             ? "CONROD"
                      : name != names.properties.end() && !name->second.empty() ? name->second
                                                                                : "PID_" + std::to_string(property),
                      GroupKind::element, std::move(ids), nullptr);
        }
    }

    void remark(const char* at, const std::string& text) {
        mesh_.remarks.push_back((at ? source_.where(at) : source_.shown() + ": ") + text);
    }

    void tell_rest() {
        const Index turned = turned_ + (default_turned_ > 0 ? not_said_ : 0);
        if (turned > 0)
            remark(nullptr, "the displacement systems (CD) of " + std::to_string(turned) + " nodes are not read");
        if (held_ > 0)
            remark(nullptr, "the permanent supports (PS) of " + std::to_string(held_) + " nodes are not read");
        std::string more;
        for (const std::string& name : with_more_) more += (more.empty() ? "" : ", ") + name;
        if (!more.empty())
            remark(nullptr,
                   "what cards of elements have beside nodes and property (orientation, offsets, thickness) is "
                   "not read: " +
                       more);
        if (!supports_.empty())
            remark(supports_.front().at, "supports (SPC, SPC1) are read as groups of their nodes alone");
        if (other_statements_ > 0)
            remark(nullptr, "of executive and case control only sets are read; there are " +
                                std::to_string(other_statements_) + " other statements");
        for (const auto& [name, where] : rest_) {
            const std::string_view what = bdf_description(name);
            remark(where.first,
                   name + " is not read" + (what.empty() ? "" : ": " + std::string(what)) +
                       (where.second > 1 ? " (there are " + std::to_string(where.second) + " of them)" : ""));
        }
    }

    struct Supports {
        std::string name;
        const char* at;
        std::vector<std::string> words;
    };

    BdfSource source_;
    BdfSystems systems_;
    Mesh mesh_;
    std::vector<Grid> grids_;
    std::unordered_map<Index, std::size_t> grid_of_;  // by number
    Index default_system_ = 0, default_turned_ = 0;
    Index turned_ = 0, not_said_ = 0, held_ = 0, other_statements_ = 0;
    std::array<std::vector<const char*>, cell_type_count> element_at_;
    std::map<Index, std::vector<Index>> properties_;
    std::vector<Supports> supports_;
    std::map<std::string, std::size_t> support_of_;
    std::set<std::string> with_more_;
    std::map<std::string, std::pair<const char*, Index>> rest_;
    std::vector<Index> node_numbers_, element_numbers_;  // ascending
    std::set<std::pair<GroupKind, std::string>> taken_;
    std::vector<GroupMembers> members_;
};

}  // namespace

Mesh read_bdf(const std::filesystem::path& path) { return BdfReader(path).read(); }

}  // namespace femscalpel
