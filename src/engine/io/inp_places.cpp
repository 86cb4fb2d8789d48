// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/inp_places.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "cancel.h"
#include "deck/edge_beams.h"
#include "deck/solver_element.h"
#include "error.h"

namespace femscalpel {
namespace {

/// See find_deck_places().
class PlaceFinder {
public:
    PlaceFinder(const Mesh& mesh, const SolverInput& input) : mesh_(mesh), input_(input) {}

    DeckPlaces run() {
        find_cards();
        classify_loose_elements();
        return std::move(out_);
    }

private:
    void find_cards() {
        check_cancelled();
        std::unordered_map<std::string_view, std::size_t> by_group;
        for (std::size_t c = 0; c < input_.cards().size(); ++c) {
            const Card& card = input_.cards()[c];
            if (!card.group.empty()) by_group.emplace(card.group, c);
        }
        out_.card_of_family.assign(static_cast<std::size_t>(mesh_.families.size()), DeckPlaces::none);
        out_.node_cards_of_family.resize(static_cast<std::size_t>(mesh_.families.size()));
        std::vector<char> two_cards(out_.card_of_family.size());
        for (FamilyIndex f = 0; f < mesh_.families.size(); ++f)
            for (GroupIndex g : mesh_.families.groups(f)) {
                const Group& group = mesh_.groups[static_cast<std::size_t>(g)];
                const auto it = by_group.find(group.name);
                if (!group.hidden || it == by_group.end()) continue;
                if (group.kind == GroupKind::node)
                    out_.node_cards_of_family[f].push_back(it->second);
                else if (out_.card_of_family[f] != DeckPlaces::none)
                    two_cards[f] = 1;
                else
                    out_.card_of_family[f] = it->second;
            }
        for (const CellBlock& b : mesh_.blocks())
            for (Index i = 0; i < b.size(); ++i)
                if (two_cards[b.families[i]])
                    throw WriteError("element " + std::to_string(b.ids[i]) + " stands under two *ELEMENT cards");
    }

    static bool is_free(const LooseElement& e) { return e.fate == Fate::free; }

    void classify_loose_elements() {
        for (const CellBlock& b : mesh_.blocks()) {
            out_.fates[static_cast<int>(b.type)].assign(static_cast<std::size_t>(b.size()), Fate::card);
            for (Index i = 0; i < b.size(); ++i)
                if (out_.card_of_family[b.families[i]] == DeckPlaces::none) {
                    out_.fates[static_cast<int>(b.type)][static_cast<std::size_t>(i)] = Fate::free;
                    if (traits(b.type).dimension == 3) continue;
                    LooseElement e{b.type, i};
                    if (traits(b.type).dimension == 0) e.fate = Fate::point;
                    out_.loose.push_back(e);
                }
        }
        find_owners(2);
        find_owners(1);
        for (const LooseElement& e : out_.loose)
            out_.fates[static_cast<int>(e.type)][static_cast<std::size_t>(e.cell)] = e.fate;
        for (const CellBlock& b : mesh_.blocks()) {
            const auto free = std::ranges::count(out_.fates[static_cast<int>(b.type)], Fate::free);
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
        const auto beams = mesh_.find_group(edge_beams_group, GroupKind::element, true);
        std::vector<char> touched(static_cast<std::size_t>(mesh_.node_count()));
        for (std::size_t i = 0; i < out_.loose.size(); ++i) {
            const CellTraits& t = traits(out_.loose[i].type);
            if (t.dimension != dimension) continue;
            const FamilyIndex family = mesh_.block(out_.loose[i].type).families[out_.loose[i].cell];
            if (beams && mesh_.families.contains(family, *beams)) continue;
            const auto nodes = mesh_.block(out_.loose[i].type).nodes(out_.loose[i].cell);
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
                LooseElement& e = out_.loose[it->second];
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

    /// Fate of an element of dimension 2 while out_.fates is still being worked out.
    Fate fate_so_far(const CellBlock& b, Index cell) const {
        if (out_.card_of_family[b.families[cell]] != DeckPlaces::none) return Fate::card;
        const auto it = std::ranges::lower_bound(out_.loose, std::pair(b.type, cell), {},
                                                 [](const LooseElement& e) { return std::pair(e.type, e.cell); });
        return it->fate;
    }

    const Mesh& mesh_;
    const SolverInput& input_;
    DeckPlaces out_;
    SparseCheck check_;
};

}  // namespace

DeckPlaces find_deck_places(const Mesh& mesh, const SolverInput& input) { return PlaceFinder(mesh, input).run(); }

bool DeckPlaces::stands_under(const Mesh& mesh, Index node, std::size_t card) const {
    const auto family = static_cast<std::size_t>(mesh.node_families[static_cast<std::size_t>(node)]);
    return std::ranges::count(node_cards_of_family[family], card) > 0;
}

NodeOfLine node_of_line(CardReader& line, const Mesh& mesh, const NumberIndex& numbers) {
    Index id = 0;
    if (!line.integer(id)) return {};
    NodeOfLine out{numbers.node(id)};
    if (!out.node) return out;
    Vec3 x(0, 0, 0);
    out.is_same = true;
    for (int k = 0; k < 3 && !line.at_end(); ++k) out.is_same = line.number(x[k]) && out.is_same;
    out.is_same = out.is_same && x == mesh.points[static_cast<std::size_t>(*out.node)];
    return out;
}

}  // namespace femscalpel
