// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "cancel.h"
#include "error.h"
#include "io/unv.h"
#include "io/unv_source.h"
#include "io/unv_types.h"
#include "utf8.h"

namespace femscalpel {
namespace {

/// What data sets hold that are not read.
constexpr std::pair<std::string_view, const char*> not_in_unv_mesh[] = {
    {"18", "coordinate systems"},
    {"55", "results in nodes"},
    {"56", "results in elements"},
    {"57", "results in elements' nodes"},
    {"58", "functions"},
    {"58b", "functions"},
    {"82", "lines"},
    {"2414", "results"},
    {"1710", "materials"},
};

class UnvReader {
public:
    explicit UnvReader(const std::filesystem::path& path) : source_(path) {
        mesh_.name = shown_path(path.stem());
        mesh_.remarks = source_.remarks();
    }

    Mesh read() {
        // Units and coordinate systems first, groups last, in whatever order the file has them.
        const auto all = [this](auto is_it, auto read) {
            for (const UnvDataset& dataset : source_.datasets())
                if (is_it(dataset.number)) {
                    source_.open(dataset);
                    read(dataset.number);
                    known_.insert(&dataset);
                }
        };
        using Number = std::string_view;
        all([](Number n) { return n == "151"; }, [](Number) {});  // who wrote the file, and when
        all([](Number n) { return n == "164"; }, [this](Number) { read_unit(); });
        all([](Number n) { return n == "2420"; }, [this](Number) { read_systems(); });
        all([](Number n) { return n == "2411" || n == "781" || n == "15"; },
            [this](Number n) { read_nodes(n == "15"); });
        if (mesh_.points.empty()) throw ReadError(source_.shown() + ": there are no nodes in this file");
        numbers_.emplace(mesh_);
        check_nodes();
        all([](Number n) { return n == "2412" || n == "780" || n == "71"; }, [this](Number n) { read_elements(n); });
        cells_.emplace(mesh_);
        check_elements();
        all([](Number n) { return n == "2435" || n == "2452" || n == "2467" || n == "2477"; },
            [this](Number) { read_groups(4); });
        all([](Number n) { return n == "2417" || n == "2429" || n == "2430" || n == "2432"; },
            [this](Number) { read_groups(2); });
        assign_groups(mesh_, members_);
        tell_rest();
        return std::move(mesh_);
    }

private:
    void read_unit() {
        constexpr std::array units = {"m", "ft", "m", "ft", "mm", "cm", "in", "mm", "", "mm"};
        const Index code = source_.integer("the code of the units");
        if (code >= 1 && code <= std::ssize(units)) mesh_.unit = units[static_cast<std::size_t>(code - 1)];
        if (mesh_.unit.empty()) remark("the unit of code " + std::to_string(code) + " has no name");
    }

    /// The coordinate systems, and whether they are the global one.
    void read_systems() {
        source_.rest_of_line();  // the part's number
        source_.rest_of_line();  // its name
        while (!source_.at_end()) {
            const Index label = source_.integer("the number of a coordinate system");
            const Index type = source_.integer("the type of a coordinate system");
            source_.rest_of_line();
            source_.rest_of_line();  // its name
            bool global = type == 0;
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 3; ++column) {
                    const double value = source_.real("an entry of a coordinate system's matrix");
                    global = global && value == (row == column ? 1. : 0.);
                }
            systems_[label] = global ? "" : type == 0 ? "turned or moved" : type == 1 ? "cylindrical" : "spherical";
        }
    }

    void check_system(Index node, Index system) {
        if (system == last_system_) return;
        const auto found = systems_.find(system);
        if (found == systems_.end() && system != 0 && system != 1)
            source_.fail("node " + std::to_string(node) + " is given in coordinate system " + std::to_string(system) +
                         ", which the file does not define");
        if (found != systems_.end() && !found->second.empty())
            source_.fail("node " + std::to_string(node) + " is given in coordinate system " + std::to_string(system) +
                         ", which is " + found->second +
                         "; only coordinates of the global system are read: export the file in these");
        last_system_ = system;
    }

    void read_nodes(bool short_form) {
        const auto room = mesh_.points.size() + static_cast<std::size_t>(source_.left() / 80);
        mesh_.points.reserve(room);
        mesh_.node_ids.reserve(room);
        node_at_.reserve(room);
        SparseCheck check(1 << 12);
        for (; !source_.at_end(); check()) {
            const char* at = source_.last();
            const Index number = positive("a node");
            check_system(number, source_.integer("the coordinate system of a node"));
            source_.integer("the displacement system of a node");
            source_.integer("the colour of a node");
            Vec3 point;
            for (int a = 0; a < 3; ++a) point[a] = source_.real("a coordinate");
            if (short_form) source_.rest_of_line();
            mesh_.points.push_back(point);
            mesh_.node_ids.push_back(number);
            node_at_.push_back(at);
        }
        mesh_.node_families.assign(mesh_.points.size(), 0);
    }

    Index positive(const char* what) {
        const std::string number_of = std::string("the number of ") + what;
        const Index number = source_.integer(number_of.c_str());
        if (number <= 0) source_.fail(std::string(what) + " has the number " + std::to_string(number));
        return number;
    }

    void check_nodes() const {
        SparseCheck check(1 << 14);
        const char* twice = nullptr;  // the first place where a number is used again
        for (std::size_t n = 0; n < mesh_.node_ids.size(); ++n, check()) {
            const auto other = static_cast<std::size_t>(*numbers_->node(mesh_.node_ids[n]));
            if (other != n) note_second(twice, node_at_[n], node_at_[other]);
        }
        if (twice) source_.fail("the number of this node is used twice", twice);
    }

    static void note_second(const char*& first, const char* a, const char* b) {
        const char* second = std::max(a, b);
        if (!first || second < first) first = second;
    }

    void check_elements() const {
        SparseCheck check(1 << 14);
        const char* twice = nullptr;
        for (const CellBlock& block : mesh_.blocks())
            for (Index c = 0; c < block.size(); ++c, check()) {
                const CellRef other = *cells_->cell(block.ids[static_cast<std::size_t>(c)]);
                if (other != CellRef{block.type, c}) note_second(twice, place({block.type, c}), place(other));
            }
        if (twice) source_.fail("the number of this element is used twice", twice);
    }

    const char* place(CellRef cell) const {
        return element_at_[static_cast<std::size_t>(cell.type)][static_cast<std::size_t>(cell.cell)];
    }

    void read_elements(std::string_view dataset) {
        SparseCheck check(1 << 12);
        for (; !source_.at_end(); check()) {
            const char* at = source_.last();
            const Index number = positive("an element");
            const Index descriptor = source_.integer("the descriptor of an element");
            std::array<Index, 5> rest{};  // tables of properties and materials, with their bins in 780
            const int properties = dataset == "2412" ? 2 : dataset == "780" ? 4 : 3;
            for (int k = 0; k < properties; ++k)
                rest[static_cast<std::size_t>(k)] = source_.integer("a property of an element");
            if (dataset == "71") rest[0] = 0;  // how it is drawn
            source_.integer("the colour of an element");
            const Index count = source_.integer("the number of nodes of an element");
            const auto type = cell_type_of_unv(descriptor, count);
            if (!type) refuse(number, descriptor, count, at);
            if (properties_.size() < 2) properties_.insert(rest);
            if (is_unv_beam(descriptor)) skip_sections(count);
            add_element(*type, number, at);
        }
    }

    [[noreturn]] void refuse(Index number, Index descriptor, Index count, const char* at) const {
        const std::string name = unv_description(descriptor);
        throw UnsupportedElementError(source_.where(at) + "element " + std::to_string(number) + " has the descriptor " +
                                      std::to_string(descriptor) + (name.empty() ? "" : " (" + name + ")") + " and " +
                                      std::to_string(count) +
                                      " nodes, which FemScalpel cannot hold; export the mesh without such elements");
    }

    /// Passes over the line with a beam's orientation and sections, if there is one: SALOME and I-DEAS write it, not
    /// all others do.
    void skip_sections(Index count) {
        source_.rest_of_line();
        const bool are_nodes = source_.words_left() == static_cast<int>(count);
        const bool nodes_follow = source_.words_ahead(1) == static_cast<int>(count);
        if (nodes_follow && (!are_nodes || count == 3)) source_.rest_of_line();
    }

    void add_element(CellType type, Index number, const char* at) {
        CellBlock& block = mesh_.block(type);
        const auto& order = unv_type(type).order;
        const auto count = static_cast<std::size_t>(traits(type).nodes);
        const std::size_t first = block.connectivity.size();
        block.connectivity.resize(first + count);
        for (std::size_t k = 0; k < count; ++k) {
            const Index node = source_.integer("a node of an element");
            const auto found = numbers_->node(node);
            if (!found)
                source_.fail("element " + std::to_string(number) + " names node " + std::to_string(node) +
                             ", which the file does not define");
            block.connectivity[first + static_cast<std::size_t>(order[k])] = *found;
        }
        block.ids.push_back(number);
        block.families.push_back(0);
        element_at_[static_cast<std::size_t>(type)].push_back(at);
    }

    /// `words`: how many an entity has.
    void read_groups(int words) {
        SparseCheck check(1 << 12);
        while (!source_.at_end()) {
            const Index number = source_.integer("the number of a group");
            Index count = 0;
            for (int left = source_.words_left(); left > 0; --left)
                count = source_.integer("a number of a group's head");
            if (count < 0 || count > source_.left() / 4 + 1)
                source_.fail("the number of members, " + std::to_string(count) +
                             ", is more than the rest of the data set can hold");
            source_.rest_of_line();
            std::string name(source_.rest_of_line());
            if (name.empty()) name = "GROUP_" + std::to_string(number);
            std::array<std::vector<Index>, 2> found;  // by GroupKind
            Index absent = 0, foreign = 0;
            for (Index k = 0; k < count; ++k, check()) {
                const Index kind = source_.integer("the kind of a group's member");
                const Index member = source_.integer("the number of a group's member");
                for (int w = 2; w < words; ++w) source_.integer("what follows a group's member");
                if (kind == 7)
                    numbers_->node(member) ? found[0].push_back(member) : void(++absent);
                else if (kind == 8)
                    cells_->cell(member) ? found[1].push_back(member) : void(++absent);
                else
                    ++foreign;
            }
            if (absent > 0)
                remark("group '" + name + "' names " + std::to_string(absent) +
                       " nodes or elements that the file does not define");
            if (foreign > 0)
                remark("group '" + name + "' has " + std::to_string(foreign) +
                       " members that are neither nodes nor elements, which are not read");
            if (!found[0].empty()) add_members(name, GroupKind::node, found[0]);
            if (!found[1].empty() || found[0].empty()) add_members(name, GroupKind::element, found[1]);
        }
    }

    void add_members(const std::string& name, GroupKind kind, const std::vector<Index>& ids) {
        const auto [it, added] = groups_.try_emplace({kind, name}, mesh_.groups.size());
        if (added) {
            mesh_.groups.push_back({name, kind, false});
            members_.push_back({kind, {}, {}});
        } else {
            remark("several groups are called '" + name + "'; they are one");
        }
        std::vector<Index>& all = members_[it->second].ids;
        all.insert(all.end(), ids.begin(), ids.end());
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
    }

    void remark(const std::string& text) { mesh_.remarks.push_back(source_.where() + text); }

    void tell_rest() {
        if (properties_.size() > 1)
            mesh_.remarks.push_back(source_.shown() +
                                    ": the elements' numbers of properties and materials are not read");
        std::map<std::string_view, std::pair<const char*, Index>> rest;  // first place and how many
        for (const UnvDataset& dataset : source_.datasets())
            if (!known_.contains(&dataset) && rest[dataset.number].second++ == 0)
                rest[dataset.number].first = dataset.number.data();
        for (const auto& [number, where] : rest) {
            const auto* const known = std::ranges::find(not_in_unv_mesh, number, [](auto& p) { return p.first; });
            mesh_.remarks.push_back(
                source_.where(where.first) + "data set " + std::string(number) + " is not read" +
                (known == std::end(not_in_unv_mesh) ? "" : std::string(": ") + known->second) +
                (where.second > 1 ? " (there are " + std::to_string(where.second) + " of them)" : ""));
        }
    }

    UnvSource source_;
    Mesh mesh_;
    std::set<const UnvDataset*> known_;
    std::map<Index, std::string> systems_;  // what is special about them; empty for the global one
    Index last_system_ = -1;
    std::vector<const char*> node_at_;
    std::array<std::vector<const char*>, cell_type_count> element_at_;
    std::optional<NumberIndex> numbers_, cells_;  // of nodes; of elements
    std::set<std::array<Index, 5>> properties_;   // the first two that differ
    std::map<std::pair<GroupKind, std::string>, std::size_t> groups_;
    std::vector<GroupMembers> members_;
};

}  // namespace

Mesh read_unv(const std::filesystem::path& path) { return UnvReader(path).read(); }

}  // namespace femscalpel
