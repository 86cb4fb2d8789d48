// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "cancel.h"
#include "mesh/facet_element.h"
#include "mesh/rounding.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

/// A hash table of grid cells with open addressing: millions of nodes take a fraction of a second.
class Grid {
public:
    Grid(std::size_t count, double size) : size_(size) {
        std::size_t slots = 16;
        while (slots < 2 * count) slots *= 2;
        slots_.assign(slots, -1);
    }

    using Key = std::array<std::int64_t, 3>;
    Key key(const Vec3& x) const {
        return {static_cast<std::int64_t>(std::floor(x[0] / size_)),
                static_cast<std::int64_t>(std::floor(x[1] / size_)),
                static_cast<std::int64_t>(std::floor(x[2] / size_))};
    }

    /// The last node put into the cell, or -1.
    Index& at(const Key& key, const std::vector<Vec3>& points) {
        std::uint64_t h = 0;
        for (const std::int64_t k : key) {
            h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15u;
            h ^= h >> 29;
        }
        for (std::size_t s = h & (slots_.size() - 1);; s = (s + 1) & (slots_.size() - 1))
            if (slots_[s] < 0 || this->key(points[slots_[s]]) == key) return slots_[s];
    }

private:
    double size_;
    std::vector<Index> slots_;
};

/// Of each node the first one at its place; empty if no two are at one place.
std::vector<Index> first_at_place(const Mesh& mesh, double rounding) {
    if (mesh.points.empty()) return {};
    const double close = same_place(mesh.points, rounding), cell = 16 * close;
    Grid grid(mesh.points.size(), cell);
    std::vector<Index> next(mesh.points.size(), -1), first(mesh.points.size());
    bool any = false;
    SparseCheck check;
    for (Index n = 0; n < mesh.node_count(); ++n) {
        check();
        const Vec3& x = mesh.points[n];
        first[n] = n;
        // Nearly always one cell; those beside it where the node is at its border.
        Grid::Key low = grid.key(x - Vec3::Constant(close)), high = grid.key(x + Vec3::Constant(close));
        for (std::int64_t i = low[0]; i <= high[0]; ++i)
            for (std::int64_t j = low[1]; j <= high[1]; ++j)
                for (std::int64_t k = low[2]; k <= high[2]; ++k)
                    for (Index m = grid.at({i, j, k}, mesh.points); m >= 0; m = next[m])
                        if ((mesh.points[m] - x).norm() <= close) first[n] = std::min(first[n], first[m]);
        any = any || first[n] != n;
        Index& head = grid.at(grid.key(x), mesh.points);
        next[n] = head;
        head = n;
    }
    if (!any) first.clear();
    return first;
}

/// A face on the outside, a shell element, or a shell's border edge.
struct Side {
    std::vector<Index> nodes;    // corners and others, in no order
    std::vector<Index> corners;  // their places, ascending
    Facet facet;                 // of family 0; `face` 0 for a shell itself
    int owners = 1;              // elements that have it
};

class Welder {
public:
    Welder(const Mesh& mesh, std::vector<Index> first)
        : mesh_(mesh), first_(std::move(first)), sets_(static_cast<std::size_t>(mesh.node_count())) {
        double_.assign(first_.size(), 0);
        for (std::size_t n = 0; n < first_.size(); ++n)
            if (first_[n] != static_cast<Index>(n)) double_[n] = double_[first_[n]] = 1;
    }

    std::optional<Welded> run() {
        collect();
        std::vector<Facet> welded;
        find_misfits();
        for (const auto& [place, sides] : sides_) {
            if (!match(sides)) continue;
            for (const Side& s : sides)
                if (s.facet.face > 0) {
                    welded.push_back(s.facet);
                    break;
                }
        }
        std::map<Index, std::vector<Index>> sets;
        for (Index n = 0; n < mesh_.node_count(); ++n)
            if (double_[n]) sets[sets_.find(static_cast<int>(n))].push_back(n);
        std::erase_if(sets, [](const auto& s) { return s.second.size() < 2; });
        if (sets.empty()) return {};
        std::ranges::sort(facing_);
        facing_.erase(std::unique(facing_.begin(), facing_.end()), facing_.end());
        Welded out{.mesh = mesh_, .sets = {}, .aside = {}, .facing = std::move(facing_)};
        for (auto& [root, set] : sets) out.sets.push_back(std::move(set));
        join(out, welded);
        return out;
    }

private:
    void collect() {
        const int dimension = mesh_.dimension();
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (t.dimension < 2) continue;
            SparseCheck check;
            for (Index c = 0; c < b.size(); ++c) {
                check();
                const auto n = b.nodes(c);
                if (std::ranges::none_of(n, [&](Index v) { return double_[v] != 0; })) continue;
                if (t.dimension == 3) {
                    for (std::size_t f = 0; f < t.faces.size(); ++f) put(side_of(b, c, static_cast<int>(f) + 1));
                } else {
                    Side self{{n.begin(), n.end()}, {}, {b.type, 0, 0, c}};
                    for (const Index v : n.first(static_cast<std::size_t>(t.corners)))
                        self.corners.push_back(first_[v]);
                    put(std::move(self));
                    if (dimension == 2)
                        for (std::size_t e = 0; e < t.edges.size(); ++e) put(side_of(b, c, static_cast<int>(e) + 3));
                }
            }
        }
    }

    /// A face of a solid, by its number minus one, or an edge of a shell, by its number minus three.
    Side side_of(const CellBlock& b, Index c, int face) const {
        Side out{{}, {}, {b.type, static_cast<std::int8_t>(face), 0, c}};
        const FacetElement f = facet_element(mesh_, out.facet);
        out.nodes.assign(f.nodes.begin(), f.nodes.begin() + f.size);
        for (int k = 0; k < traits(f.type).corners; ++k) out.corners.push_back(f.nodes[static_cast<std::size_t>(k)]);
        for (std::vector<Index>* list : {&out.nodes, &out.corners}) {  // degenerate elements have nodes twice
            std::ranges::sort(*list);
            list->erase(std::unique(list->begin(), list->end()), list->end());
        }
        for (Index& n : out.corners) n = first_[n];
        return out;
    }

    void put(Side side) {
        if (std::ranges::none_of(side.nodes, [&](Index v) { return double_[v] != 0; })) return;
        std::ranges::sort(side.nodes);
        std::ranges::sort(side.corners);
        std::vector<Index> place;
        place.reserve(side.nodes.size());
        for (const Index n : side.nodes) place.push_back(first_[n]);
        std::ranges::sort(place);
        if (std::ranges::adjacent_find(place) != place.end()) return;  // an element between double nodes
        std::vector<Side>& there = sides_[std::move(place)];
        for (Side& s : there)
            if (s.nodes == side.nodes && (s.facet.face > 0) == (side.facet.face > 0)) {
                ++s.owners;
                return;
            }
        there.push_back(std::move(side));
    }

    /// Nodes of faces that have all corners in common, but neither division nor nodes: of a hexahedron on two
    /// tetrahedra, or of eight and nine nodes. They stay double, as conversion would not part such faces alike.
    void find_misfits() {
        std::map<std::vector<Index>, std::vector<const Side*>> alone;  // by corners
        for (const auto& [place, sides] : sides_)
            if (sides.size() == 1 && sides[0].owners == 1) alone[sides[0].corners].push_back(&sides[0]);
        const auto misfit = [&](const std::vector<const Side*>& sides) {
            for (const Side* s : sides) misfits_.insert(s->nodes.begin(), s->nodes.end());
        };
        for (const auto& [corners, sides] : alone) {
            if (sides.size() > 1) misfit(sides);
            if (corners.size() != 4) continue;
            for (std::size_t k = 0; k < 4; ++k) {
                std::vector<Index> three = corners;
                three.erase(three.begin() + static_cast<std::ptrdiff_t>(k));
                const auto found = alone.find(three);
                if (found == alone.end()) continue;
                misfit(sides);
                misfit(found->second);
            }
        }
    }

    /// Makes the nodes of sides at one place single; false if they are the same, or inside the material.
    bool match(const std::vector<Side>& sides) {
        bool any = false;
        for (std::size_t i = 1; i < sides.size(); ++i) {
            const Side &a = sides.front(), &b = sides[i];
            if (a.nodes == b.nodes || (a.owners > 1 && b.owners > 1)) continue;
            for (const Index n : a.nodes)
                for (const Index m : b.nodes)
                    if (n != m && first_[n] == first_[m] && !misfits_.contains(n) && !misfits_.contains(m)) {
                        sets_.unite(static_cast<int>(n), static_cast<int>(m));
                        facing_.push_back({std::min(n, m), std::max(n, m)});
                    }
            any = true;
        }
        return any;
    }

    /// Has all elements name the first node of each set.
    static void join(Welded& out, const std::vector<Facet>& welded) {
        Mesh& mesh = out.mesh;
        const std::vector<Index> now = out.single_nodes();
        for (const std::vector<Index>& set : out.sets)
            for (const Index n : set) {
                mesh.node_families[set.front()] =
                    mesh.families.unite(mesh.node_families[set.front()], mesh.node_families[n]);
            }
        for (CellBlock& b : mesh.blocks()) {
            const auto count = static_cast<std::size_t>(traits(b.type).nodes);
            const bool is_line = traits(b.type).dimension == 1;
            std::size_t kept = 0;
            for (std::size_t c = 0; c < b.ids.size(); ++c) {
                const auto n = std::span(b.connectivity).subspan(c * count, count);
                if (is_line && now[n[0]] == now[n[1]]) {
                    out.aside.push_back({b.type, static_cast<Index>(c)});
                    continue;
                }
                for (std::size_t k = 0; k < count; ++k) b.connectivity[kept * count + k] = now[n[k]];
                b.ids[kept] = b.ids[c];
                b.families[kept++] = b.families[c];
            }
            b.connectivity.resize(kept * count);
            b.ids.resize(kept);
            b.families.resize(kept);
        }
        out.faces = mesh.add_group(std::string(weld_group), GroupKind::facet, true);
        GroupMembers members{GroupKind::facet, {}, {}};
        for (const Facet& f : welded) {
            members.ids.push_back(mesh.block(f.type).ids[f.cell]);
            members.faces.push_back(f.face);
        }
        set_group_members(mesh, out.faces, members);
        std::vector<char> is_double(mesh.points.size(), 0);
        for (const std::vector<Index>& set : out.sets) is_double[set.front()] = 1;
        out.rim = mesh.add_group(std::string(weld_rim_group), GroupKind::node, true);
        for (const Facet& f : welded) {
            const auto n = mesh.block(f.type).nodes(f.cell);
            const CellTraits& t = traits(f.type);
            const auto add = [&](std::int8_t k) {
                if (k < 0 || is_double[n[k]]) return;
                mesh.node_families[n[k]] = mesh.families.with(mesh.node_families[n[k]], out.rim);
            };
            if (t.dimension == 3)
                std::ranges::for_each(t.faces[f.face - 1], add);
            else
                std::ranges::for_each(t.edges[f.face - 3], add);
        }
    }

    const Mesh& mesh_;
    std::vector<Index> first_;
    std::vector<char> double_;
    UnionFind sets_;
    std::vector<std::array<Index, 2>> facing_;
    std::set<Index> misfits_;
    std::map<std::vector<Index>, std::vector<Side>> sides_;  // by the places of their nodes
};

}  // namespace

std::vector<Index> Welded::single_nodes() const {
    std::vector<Index> out(mesh.points.size());
    for (std::size_t n = 0; n < out.size(); ++n) out[n] = static_cast<Index>(n);
    for (const std::vector<Index>& set : sets)
        for (const Index n : set) out[n] = set.front();
    return out;
}

Index Welded::pairs() const {
    Index count = 0;
    for (const std::vector<Index>& set : sets) count += static_cast<Index>(set.size()) - 1;
    return count;
}

std::optional<Welded> weld(const Mesh& mesh, double rounding) {
    std::vector<Index> first = first_at_place(mesh, rounding);
    if (first.empty()) return {};
    return Welder(mesh, std::move(first)).run();
}

}  // namespace femscalpel
