// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <map>
#include <set>

#include "deck/carry_over.h"
#include "deck/deck_view.h"

namespace femscalpel {
namespace {

class Marker {
public:
    explicit Marker(const Mesh& mesh) : deck_(mesh) {}

    DeckMarks run() {
        for (std::size_t c = 0; c < deck_.cards().size(); ++c) {
            const Card& card = deck_.cards()[c];
            for (const auto& [parameter, node] : reference_nodes(card)) pin(node);
            switch (card_content(card).value_or(CardContent::nothing)) {
                case CardContent::nodal_dofs:
                    read_supports(c, card);
                    break;
                case CardContent::node_loads:
                case CardContent::node_weights:
                    read_first_nodes(card);
                    break;
                case CardContent::element_loads:
                    read_loads(c, card);
                    break;
                case CardContent::element_list:
                    read_elements(c, card);
                    break;
                case CardContent::element_normals:
                    read_normals(card);
                    break;
                case CardContent::equation:
                    read_equations(card);
                    break;
                case CardContent::mpc:
                    read_mpcs(card);
                    break;
                default:
                    break;
            }
        }
        for (const OtherElement& e : deck_.input().other_elements())
            for (const Index node : e.nodes) pin(node);
        pin_ends_of_mid_nodes();
        DeckMarks out;
        out.surface_sets = surface_sets(deck_.mesh());
        out.pinned.assign(pinned_.begin(), pinned_.end());
        out.related.assign(related_.begin(), related_.end());
        if (!nodes_.empty() || !cells_.empty() || !faces_.empty()) out.mesh = marked(out.kept);
        return out;
    }

private:
    void pin(Index number) {
        if (const auto node = deck_.numbers().node(number)) pinned_.insert(*node);
    }

    void read_supports(std::size_t c, const Card& card) {
        CardReader line(card);
        while (line.next_data_line())
            if (Index number = 0; line.integer(number))
                if (const auto node = deck_.numbers().node(number))
                    nodes_[std::string(mark_prefix) + "NODES" + std::to_string(deck_.step(c)) + parameters_key(card) +
                           ":" + deck_key(line.rest())]
                        .push_back(*node);
    }

    void read_first_nodes(const Card& card) {
        CardReader line(card);
        while (line.next_data_line())
            if (Index number = 0; line.integer(number)) pin(number);
    }

    void read_loads(std::size_t c, const Card& card) {
        CardReader line(card);
        while (line.next_data_line()) {
            const auto what = read_number_or_set(line);
            if (!what) continue;
            const LoadLabel label(line.field());
            const std::string faces = face_mark(c, label, line.rest()), cells = element_mark(c, label, line.rest());
            const auto mark = [&](Index number) {
                const auto cell = deck_.numbers().cell(number);
                if (!cell) return;
                if (const int face = label.face(cell->type, deck_.is_plane(*cell)))
                    faces_[faces].push_back({*cell, face});
                else if (what->is_number())
                    cells_[cells].push_back(*cell);
            };
            if (what->is_number())
                mark(what->number);
            else if (label.number > 0)
                if (const auto group = deck_.group(DeckSetType::elset, what->set))
                    for (const Index number : deck_.members(*group)) mark(number);
        }
    }

    void read_elements(std::size_t c, const Card& card) {
        CardReader line(card);
        while (line.next_data_line())
            while (!line.at_end()) {
                const auto what = read_number_or_set(line);
                if (what && what->is_number())
                    if (const auto cell = deck_.numbers().cell(what->number))
                        cells_[std::string(mark_prefix) + "LIST" + std::to_string(c)].push_back(*cell);
            }
    }

    void read_normals(const Card& card) {
        CardReader line(card);
        Index element = 0, node = 0;
        while (line.next_data_line())
            if (line.integer(element) && line.integer(node)) pin(node);
    }

    void read_equations(const Card& card) {
        if (card.parameter("REMOVE")) return;
        CardReader line(card);
        Index terms = 0;
        while (line.next_data_line()) {
            if (!line.integer(terms)) return;
            for (Index k = 0; k < 3 * terms;) {
                if (line.at_end()) {
                    if (!line.next_data_line()) return;
                    continue;
                }
                const auto what = read_number_or_set(line);
                if (k++ % 3 != 0 || !what) continue;
                if (what->is_number()) {
                    pin(what->number);
                    if (const auto node = deck_.numbers().node(what->number)) related_.insert(*node);
                } else if (const auto group = deck_.group(DeckSetType::nset, what->set))
                    for (const Index node : deck_.members(*group)) pin(node);
            }
        }
    }

    void read_mpcs(const Card& card) {
        CardReader line(card);
        while (line.next_data_line())
            while (!line.at_end()) {
                const auto what = read_number_or_set(line);
                if (what && what->is_number()) pin(what->number);
            }
    }

    /// A mid-side node follows the ends of its edge.
    void pin_ends_of_mid_nodes() {
        if (pinned_.empty()) return;
        for (const CellBlock& block : deck_.mesh().blocks()) {
            const CellTraits& t = traits(block.type);
            if (!t.quadratic) continue;
            for (Index c = 0; c < block.size(); ++c) {
                const auto n = block.nodes(c);
                for (std::size_t e = 0; e < t.edges.size(); ++e)
                    if (pinned_.contains(n[static_cast<std::size_t>(t.corners) + e]))
                        pinned_.insert({n[t.edges[e][0]], n[t.edges[e][1]]});
            }
        }
    }

    Mesh marked(std::vector<bool>& kept) const {
        Mesh mesh = deck_.mesh();
        // Names are unique as they are; add_group() would compare each with all.
        const auto add = [&](const std::string& name, GroupKind kind) {
            mesh.groups.push_back({name, kind, true});
            return static_cast<GroupIndex>(mesh.groups.size()) - 1;
        };
        const std::size_t first = mesh.groups.size();
        for (const auto& [name, nodes] : nodes_) {
            const GroupIndex group = add(name, GroupKind::node);
            for (const Index n : nodes) mesh.node_families[n] = mesh.families.with(mesh.node_families[n], group);
        }
        for (const auto& [name, cells] : cells_) {
            const GroupIndex group = add(name, GroupKind::element);
            for (const CellRef& c : cells) {
                FamilyIndex& family = mesh.block(c.type).families[c.cell];
                family = mesh.families.with(family, group);
            }
        }
        const auto place = [](const Facet& f) { return std::tuple(f.type, f.cell, f.face); };
        std::map<std::tuple<CellType, Index, std::int8_t>, FamilyIndex> facets;
        for (const Facet& f : mesh.facets) facets.emplace(place(f), f.family);
        const auto join = [&](const std::pair<CellRef, int>& face, GroupIndex group) {
            FamilyIndex& family = facets[{face.first.type, face.first.cell, static_cast<std::int8_t>(face.second)}];
            family = mesh.families.with(family, group);
        };
        for (const auto& [name, faces] : faces_) {
            const GroupIndex group = add(name, GroupKind::facet);
            for (const auto& face : faces) join(face, group);
        }
        kept.assign(mesh.groups.size(), false);
        std::fill(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end(), true);
        mesh.facets.clear();
        for (const auto& [where, family] : facets) {
            const auto& [type, cell, face] = where;
            mesh.facets.push_back({type, face, family, cell});
        }
        return mesh;
    }

    DeckView deck_;
    std::set<Index> pinned_, related_;
    // By name of the group to be.
    std::map<std::string, std::vector<Index>> nodes_;
    std::map<std::string, std::vector<CellRef>> cells_;
    std::map<std::string, std::vector<std::pair<CellRef, int>>> faces_;
};

}  // namespace

DeckMarks mark_deck(const Mesh& mesh) {
    if (!solver_input(mesh)) return {};
    return Marker(mesh).run();
}

}  // namespace femscalpel
