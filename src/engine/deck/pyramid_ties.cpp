// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/pyramid_ties.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "cancel.h"
#include "deck/bound_nodes.h"

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

bool is_made(const Card& card) {
    return card.keyword == "EQUATION" && card.text.front().text.substr(card.head).starts_with(mark);
}

}  // namespace

std::string pyramid_ties(const Mesh& mesh) {
    if (mesh.block(CellType::pyramid13).size() == 0) return "";
    const std::map<Index, Edge> edges = edges_to_tie(mesh);
    if (edges.empty()) return "";
    const BoundNodes bound(mesh);
    std::string out;
    for (const auto& [middle, edge] : edges)
        for (const int freedom : computed_freedoms(mesh)) {
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
