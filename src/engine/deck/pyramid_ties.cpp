// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/pyramid_ties.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "cancel.h"
#include "deck/deck_view.h"

namespace femscalpel {
namespace {

constexpr std::string_view mark = "** straight edges where pyramids (C3D20 with one upper node) meet triangles";

using Triangle = std::array<Index, 3>;

Triangle triangle(Index a, Index b, Index c) {
    Triangle t{a, b, c};
    std::ranges::sort(t);
    return t;
}

/// An edge at the base of a pyramid: ends and mid-side node.
using Edge = std::array<Index, 3>;

/// Those of sides that a tetrahedron or prism of second order is across from, by mid-side node.
std::map<Index, Edge> edges_to_tie(const Mesh& mesh) {
    std::map<Triangle, Edge> sides;
    const CellBlock& pyramids = mesh.block(CellType::pyramid13);
    for (Index c = 0; c < pyramids.size(); ++c) {
        const auto n = pyramids.nodes(c);
        for (int k = 0; k < 4; ++k) {
            const Index a = n[k], b = n[(k + 1) % 4];
            sides.emplace(triangle(a, b, n[4]), Edge{a, b, n[5 + k]});
        }
    }
    std::map<Index, Edge> out;
    SparseCheck check(1 << 12);
    for (const CellType type : {CellType::tetra10, CellType::wedge15}) {
        const CellBlock& b = mesh.block(type);
        for (Index c = 0; c < b.size(); ++c, check()) {
            const auto n = b.nodes(c);
            for (const auto& f : traits(type).faces) {
                if (f[3] >= 0) continue;
                const auto side = sides.find(triangle(n[f[0]], n[f[1]], n[f[2]]));
                if (side != sides.end()) out.emplace(side->second[2], side->second);
            }
        }
    }
    return out;
}

/// What of nodes (by number) is set otherwise.
class Bound {
public:
    explicit Bound(const Mesh& mesh) {
        if (solver_input(mesh)) collect(DeckView(mesh));
    }

    bool contains(Index node, int freedom) const {
        return wholly_.contains(node) || freedoms_.contains({node, freedom});
    }

private:
    void collect(const DeckView& deck) {
        for (const Card& card : deck.cards()) {
            CardReader line(card);
            if (card.keyword == "BOUNDARY")
                while (const auto what = next_entry(line)) add_support(nodes_of(deck, *what), line);
            else if (card.keyword == "EQUATION" || card.keyword == "MPC")
                while (line.next_data_line())
                    while (!line.at_end())
                        if (Index number = 0; line.integer(number))
                            wholly_.insert(number);
                        else
                            add_set(deck, line.field());
            else if (card.keyword == "TIE" && line.next_data_line())
                add_set(deck, line.field());
            for (const char* name : {"SURFACE", "NSET", "ELSET"})
                if (const std::string* set = card.parameter(name);
                    set && (card.keyword == "COUPLING" || card.keyword == "RIGIDBODY"))
                    add_set(deck, *set);
        }
    }

    static std::vector<Index> nodes_of(const DeckView& deck, const NumberOrSet& what) {
        if (what.is_number()) return {what.number};
        const auto group = deck.group(DeckSetType::nset, what.set);
        return group ? deck.members(*group) : std::vector<Index>();
    }

    void add_support(const std::vector<Index>& nodes, CardReader& line) {
        Index first = 1, last = 11;
        if (line.integer(first) && !line.integer(last)) last = first;
        for (const Index node : nodes)
            for (Index freedom = first; freedom <= std::min<Index>(last, 11); ++freedom)
                freedoms_.insert({node, static_cast<int>(freedom)});
    }

    /// All nodes of a set or surface, whatever its kind; of surfaces those of the elements.
    void add_set(const DeckView& deck, const std::string& name) {
        const Mesh& mesh = deck.mesh();
        const auto add_cell = [&](CellType type, Index cell) {
            for (const Index n : mesh.block(type).nodes(cell)) wholly_.insert(mesh.node_ids[n]);
        };
        for (const DeckSetType type : {DeckSetType::nset, DeckSetType::node_surface})
            if (const auto group = deck.group(type, name))
                wholly_.insert(deck.members(*group).begin(), deck.members(*group).end());
        if (const auto group = deck.group(DeckSetType::element_surface, name))
            for (const Facet& f : mesh.facets)
                if (mesh.families.contains(f.family, *group)) add_cell(f.type, f.cell);
        if (const auto group = deck.group(DeckSetType::elset, name))
            for (const Index element : deck.members(*group))
                if (const auto cell = deck.numbers().cell(element)) add_cell(cell->type, cell->cell);
    }

    std::unordered_set<Index> wholly_;
    std::set<std::pair<Index, int>> freedoms_;
};

/// Degrees of freedom that a deck computes.
std::vector<int> freedoms_of(const Mesh& mesh) {
    bool heat = false, motion = false;
    if (const SolverInput* deck = solver_input(mesh))
        for (const Card& card : deck->cards()) {
            const bool both = card.keyword.find("TEMPERATURE-DISPLACEMENT") != std::string::npos;
            heat = heat || both || card.keyword == "HEATTRANSFER";
            motion = motion || both || card.keyword == "STATIC" || card.keyword == "DYNAMIC" ||
                     card.keyword == "FREQUENCY" || card.keyword == "BUCKLE" || card.keyword == "VISCO";
        }
    std::vector<int> out;
    if (motion || !heat) out = {1, 2, 3};
    if (heat) out.push_back(11);
    return out;
}

bool is_made(const Card& card) {
    return card.keyword == "EQUATION" && card.text.front().text.substr(card.head).starts_with(mark);
}

}  // namespace

std::string pyramid_ties(const Mesh& mesh) {
    if (mesh.block(CellType::pyramid13).size() == 0) return "";
    const std::map<Index, Edge> edges = edges_to_tie(mesh);
    if (edges.empty()) return "";
    const Bound bound(mesh);
    std::string out;
    for (const auto& [middle, edge] : edges)
        for (const int freedom : freedoms_of(mesh)) {
            if (bound.contains(mesh.node_ids[middle], freedom)) continue;
            const auto term = [&](Index node, const char* factor) {
                return std::to_string(mesh.node_ids[node]) + ", " + std::to_string(freedom) + ", " + factor;
            };
            out += "3\n" + term(middle, "1.") + ", " + term(edge[0], "-0.5") + ", " + term(edge[1], "-0.5") + "\n";
        }
    return out.empty() ? out : "*EQUATION\n" + std::string(mark) + "\n" + out;
}

void remove_pyramid_ties(std::vector<Card>& cards) {
    for (std::size_t c = 0; c < cards.size();) {
        if (c == 0 || !is_made(cards[c])) {
            ++c;
            continue;
        }
        CardReader line(cards[c]);
        line.next_line();
        while (line.next_line()) {
            if (line.is_data()) continue;
            const DeckText& piece = cards[c].text.front();
            const std::size_t from = static_cast<std::size_t>(line.raw().data() - piece.text.data());
            cards[c - 1].text.push_back({piece.file, piece.text.substr(from),
                                         piece.line + std::ranges::count(piece.text.substr(0, from), '\n')});
            break;
        }
        cards.erase(cards.begin() + static_cast<std::ptrdiff_t>(c));
    }
}

}  // namespace femscalpel
