// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/band_boundaries.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "cancel.h"

namespace femscalpel {
namespace {

/// Set operations on families, each pair worked out once.
class Sets {
public:
    explicit Sets(FamilyTable& table) : table_(table) {}
    int both(int a, int b) {
        if (a == b) return a;
        if (a == 0 || b == 0) return 0;
        return cached(both_, std::min(a, b), std::max(a, b), [&] { return table_.intersect(a, b); });
    }
    int either(int a, int b) {
        if (a == b || b == 0) return a;
        if (a == 0) return b;
        return cached(either_, std::min(a, b), std::max(a, b), [&] { return table_.unite(a, b); });
    }
    int minus(int a, int b) {
        if (a == b || a == 0) return 0;
        if (b == 0) return a;
        return cached(minus_, a, b, [&] {
            std::vector<GroupIndex> rest;
            std::ranges::set_difference(table_.groups(a), table_.groups(b), std::back_inserter(rest));
            return table_.intern(rest);
        });
    }
    int differ(int a, int b) { return either(minus(a, b), minus(b, a)); }

private:
    template <class Work>
    static int cached(std::unordered_map<std::uint64_t, int>& cache, int a, int b, Work work) {
        const std::uint64_t key = (static_cast<std::uint64_t>(a) << 32) | static_cast<std::uint64_t>(b);
        const auto it = cache.find(key);
        if (it != cache.end()) return it->second;
        const int made = work();
        cache.emplace(key, made);
        return made;
    }
    FamilyTable& table_;
    std::unordered_map<std::uint64_t, int> both_, either_, minus_;
};

bool holds(const auto& nodes, int node) { return std::ranges::find(nodes, node) != nodes.end(); }

/// Marks the nodes on faces of only one tetrahedron of the band (its rim included), without matching faces. Every
/// face has a random number, and a node the exclusive or of those of its faces, counted once per tetrahedron: those of
/// faces between two tetrahedra cancel. (That others do by accident has a chance of 2^-64.)
void mark_outer_nodes(const BandMesh& band, std::vector<char>& marked) {
    const auto scramble = [](std::uint64_t x) {
        x = (x ^ (x >> 31)) * 0x7fb5d329728ea185u;
        x = (x ^ (x >> 27)) * 0x81dadef4bc2dd44du;
        return x ^ (x >> 33);
    };
    std::vector<std::uint64_t> random(static_cast<std::size_t>(band.size())), rest(random.size(), 0);
    for (std::size_t v = 0; v < random.size(); ++v) random[v] = scramble(v + 0x9e3779b97f4a7c15u);
    SparseCheck check(1 << 12);
    for (int t = 0; t < band.tetras.size(); ++t) {
        check();
        if (!band.tetras.alive(t)) continue;
        const auto& v = band.tetras[t];
        const std::uint64_t sum = random[v[0]] + random[v[1]] + random[v[2]] + random[v[3]];
        std::array<std::uint64_t, 4> face;  // opposite each corner
        for (int k = 0; k < 4; ++k) face[k] = scramble(sum - random[v[k]]);
        const std::uint64_t all = face[0] ^ face[1] ^ face[2] ^ face[3];
        for (int k = 0; k < 4; ++k) rest[v[k]] ^= all ^ face[k];
    }
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (rest[v] != 0) marked[v] = 1;
}

/// The faces of the band's tetrahedra that have a movable node and only nodes that count, in rows by their smallest
/// node: a row is short and in one place, which beats a hash table.
class TetraFaces {
public:
    TetraFaces(const BandMesh& band, const std::vector<char>& counts)
        : start_(static_cast<std::size_t>(band.size()) + 1, 0) {
        std::vector<char> movable(static_cast<std::size_t>(band.size()));
        for (int v = 0; v < band.size(); ++v) movable[v] = band.nodes[v].movable();
        SparseCheck check;
        const auto for_each = [&](auto visit) {
            for (int t = 0; t < band.tetras.size(); ++t) {
                check();
                if (!band.tetras.alive(t)) continue;
                const auto& v = band.tetras[t];
                if (counts[v[0]] + counts[v[1]] + counts[v[2]] + counts[v[3]] < 3) continue;
                for (const auto& f : outward_faces) {
                    const std::array<int, 3> nodes{v[f[0]], v[f[1]], v[f[2]]};
                    if (!(counts[nodes[0]] && counts[nodes[1]] && counts[nodes[2]])) continue;
                    if (movable[nodes[0]] || movable[nodes[1]] || movable[nodes[2]]) visit(t, nodes);
                }
            }
        };
        for_each([&](int, const std::array<int, 3>& nodes) { ++start_[std::ranges::min(nodes) + 1]; });
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        std::vector<BandBoundaries::Face> rows(static_cast<std::size_t>(start_.back()));
        std::vector<int> end(start_.begin(), start_.end() - 1);
        for_each([&](int t, const std::array<int, 3>& nodes) {
            const int row = std::ranges::min(nodes);
            for (int at = start_[row]; at < end[row]; ++at)
                if (same(rows[at].nodes, nodes)) {
                    rows[at].tetra[1] = t;
                    return;
                }
            rows[end[row]++] = {nodes, 0, {t, -1}, false};
        });
        // Close the gaps that faces seen twice left.
        faces.reserve(rows.size());
        for (int v = 0; v < band.size(); ++v) {
            const int first = start_[v];
            start_[v] = static_cast<int>(faces.size());
            faces.insert(faces.end(), rows.begin() + first, rows.begin() + end[v]);
        }
        start_.back() = static_cast<int>(faces.size());
    }

    /// Index in `faces`, or -1.
    int find(const std::array<int, 3>& nodes) const {
        const int row = std::ranges::min(nodes);
        for (int at = start_[row]; at < start_[row + 1]; ++at)
            if (same(faces[at].nodes, nodes)) return at;
        return -1;
    }

    std::vector<BandBoundaries::Face> faces;

private:
    static bool same(const std::array<int, 3>& a, const std::array<int, 3>& b) {
        return holds(a, b[0]) && holds(a, b[1]) && holds(a, b[2]);
    }
    std::vector<int> start_;
};

}  // namespace

BandBoundaries::BandBoundaries(const BandMesh& band, const Mesh& mesh, const std::vector<bool>& drifting,
                               std::span<const Index> on_shortcuts, const std::vector<bool>& meaningless) {
    Sets sets(sets_);
    std::vector<int> kept(static_cast<std::size_t>(mesh.families.size()), -1);
    const auto kept_groups = [&](FamilyIndex f) {
        if (kept[f] < 0) {
            std::vector<GroupIndex> set;
            for (const GroupIndex g : mesh.families.groups(f))
                if (drifting.empty() ? !mesh.groups[g].hidden : !drifting[g]) set.push_back(g);
            kept[f] = sets_.intern(set);
        }
        return kept[f];
    };
    const auto family_of = [&](const CellRef& c) { return mesh.block(c.type).families[c.cell]; };
    const auto of_cell = [&](const CellRef& c) { return kept_groups(family_of(c)); };
    // Whether an element or facet inside the material or on the skin is kept where it is: it is in no group, or in
    // one that is kept.
    const auto counts_for_nothing = [&](GroupIndex g) {
        return mesh.groups[g].hidden || (!meaningless.empty() && meaningless[g]);
    };
    const auto is_kept = [&](FamilyIndex f) {
        return kept_groups(f) != 0 || std::ranges::all_of(mesh.families.groups(f), counts_for_nothing);
    };

    // Node groups of each node; one born here is in those of both ends.
    std::vector<int> in(static_cast<std::size_t>(band.size()));
    for (int v = 0; v < band.size(); ++v) {
        if (!band.is_new(v)) {
            in[v] = kept_groups(mesh.node_families[band.nodes[v].global]);
        } else {
            const auto& [a, b] = band.births[v - band.original_nodes()];
            in[v] = sets.both(in[a], in[b]);
        }
    }
    const auto movable = [&](const auto& nodes) {
        return std::ranges::any_of(nodes, [&](int v) { return band.nodes[v].movable(); });
    };
    const auto in_all = [&](const std::array<int, 3>& f) { return sets.both(sets.both(in[f[0]], in[f[1]]), in[f[2]]); };

    // 1. The faces of tetrahedra that can matter, and what lies on them: those of nodes on the outside, of nodes of
    // face elements, and of nodes whose tetrahedra differ in their groups or in those of their nodes.
    std::vector<int> volume_kind(static_cast<std::size_t>(band.tetras.size()), 0);
    std::vector<char> counts(in.size(), 0);
    std::vector<int> first_kind(in.size(), -1);
    for (int t = 0; t < band.tetras.size(); ++t) {
        if (!band.tetras.alive(t)) continue;
        const auto& v = band.tetras[t];
        volume_kind[t] = of_cell(band.tetra_cells[band.tetras.origin(t)]);
        const bool mixed = in[v[0]] != in[v[1]] || in[v[0]] != in[v[2]] || in[v[0]] != in[v[3]];
        for (const int w : v) {
            if (first_kind[w] < 0) first_kind[w] = volume_kind[t];
            if (mixed || first_kind[w] != volume_kind[t]) counts[w] = 1;
        }
    }
    const auto count_nodes = [&](const auto& list) {
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s))
                for (const int v : list[s]) counts[v] = 1;
    };
    count_nodes(band.triangles);
    count_nodes(band.facet_faces);
    mark_outer_nodes(band, counts);
    TetraFaces index(band, counts);
    std::vector<Face>& faces = index.faces;
    for (int f = 0; f < band.facet_faces.size(); ++f) {
        if (!band.facet_faces.alive(f) || !movable(band.facet_faces[f])) continue;
        const int at = index.find(band.facet_faces[f]);
        if (at < 0 || !is_kept(mesh.facets[band.facet_faces.tag(f)].family)) continue;
        faces[at].element = true;
        faces[at].kind = sets.either(faces[at].kind, kept_groups(mesh.facets[band.facet_faces.tag(f)].family));
    }
    std::unordered_map<int, int> side_groups;  // of shells, by slot of the original
    for (const auto& [slot, facet] : band.facet_sides) {
        int& kind = side_groups[slot];
        kind = sets.either(kind, kept_groups(mesh.facets[facet].family));
    }
    // Shells on the same nodes (layers, a skin for a load) are one face: two would part the sheet along every edge.
    std::vector<int> face_of_shell(static_cast<std::size_t>(band.triangles.size()), -1);
    const auto face_on = [&](const std::array<int, 3>& v) {
        for (const int other : band.triangles.around(v[0]))
            if (face_of_shell[other] >= 0 && holds(band.triangles[other], v[1]) && holds(band.triangles[other], v[2]))
                return face_of_shell[other];
        return -1;
    };
    for (int t = 0; t < band.triangles.size(); ++t) {
        if (!band.triangles.alive(t) || !movable(band.triangles[t])) continue;
        const auto& v = band.triangles[t];
        const CellRef& cell = band.triangle_cells[band.triangles.origin(t)];
        int kind = of_cell(cell);
        const auto side = side_groups.find(band.triangles.origin(t));
        if (side != side_groups.end()) kind = sets.either(kind, side->second);
        if (const int at = index.find(v); at >= 0) {
            faces[at].element = faces[at].element || kind != 0 || is_kept(family_of(cell));
            faces[at].kind = sets.either(faces[at].kind, kind);
        } else if (const int same = face_on(v); same >= 0) {
            faces_[same].kind = sets.either(faces_[same].kind, kind);
        } else {
            face_of_shell[t] = static_cast<int>(faces_.size());
            faces_.push_back({v, sets.either(kind, in_all(v)), {-1, -1}, true});
        }
    }

    // 2. Groups of volume elements have their boundary where they differ; node groups where a face belongs and
    // is not between two elements of the area. The node groups of a node's faces that are kept anyway tell shortcuts.
    std::vector<char> kept_anyway(faces.size());
    std::vector<int> on_kept(in.size(), 0);
    const auto note_kept = [&](const Face& f) {
        if (const int set = in_all(f.nodes))
            for (const int v : f.nodes) on_kept[v] = sets.either(on_kept[v], set);
    };
    SparseCheck check;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        check();
        Face& f = faces[k];
        const auto volume = [&](int t) { return t < 0 ? 0 : volume_kind[t]; };
        f.kind = sets.either(f.kind, sets.differ(volume(f.tetra[0]), volume(f.tetra[1])));
        kept_anyway[k] = f.is_skin() || f.element || f.kind != 0;
        if (kept_anyway[k]) note_kept(f);
    }
    for (const Face& shell : faces_) note_kept(shell);
    if (!on_shortcuts.empty())
        for (int v = 0; v < band.size(); ++v)
            if (!band.is_new(v) && std::ranges::binary_search(on_shortcuts, mesh.node_ids[band.nodes[v].global]))
                on_kept[v] = in[v];
    const auto opposite = [&](int tetra, const std::array<int, 3>& face) {
        for (const int v : band.tetras[tetra])
            if (!holds(face, v)) return in[v];
        return 0;
    };
    for (std::size_t k = 0; k < faces.size(); ++k) {
        check();
        Face& f = faces[k];
        if (int belongs = in_all(f.nodes)) {
            if (f.is_internal()) {
                const auto& [a, b, c] = f.nodes;
                belongs = sets.minus(belongs, sets.both(opposite(f.tetra[0], f.nodes), opposite(f.tetra[1], f.nodes)));
                if (belongs && !kept_anyway[k]) {
                    const int shortcut = sets.both(belongs, sets.both(sets.both(on_kept[a], on_kept[b]), on_kept[c]));
                    if (shortcut != 0) shortcuts_.push_back({f.nodes, shortcut});
                    belongs = sets.minus(belongs, shortcut);
                }
            }
            f.kind = sets.either(f.kind, belongs);
        }
        if (f.kind != 0 || f.is_skin() || f.element) faces_.push_back(f);
    }

    // 3. Edges: members, and those of node groups that no face of the group holds.
    std::unordered_map<std::uint64_t, int> line_at;
    const auto put_line = [&](const std::array<int, 2>& nodes, int kind, bool element) {
        const auto [it, fresh] = line_at.emplace(edge_key(nodes[0], nodes[1]), static_cast<int>(lines_.size()));
        if (fresh) lines_.push_back({nodes, 0, false});
        Line& line = lines_[it->second];
        line.kind = sets.either(line.kind, kind);
        line.element = line.element || element;
    };
    for (int l = 0; l < band.lines.size(); ++l)
        if (band.lines.alive(l) && movable(band.lines[l]))
            if (const CellRef& cell = band.line_cells[band.lines.origin(l)]; is_kept(family_of(cell)))
                put_line(band.lines[l], of_cell(cell), true);
    for (int f = 0; f < band.facet_edges.size(); ++f)
        if (band.facet_edges.alive(f) && movable(band.facet_edges[f]) &&
            is_kept(mesh.facets[band.facet_edges.tag(f)].family))
            put_line(band.facet_edges[f], kept_groups(mesh.facets[band.facet_edges.tag(f)].family), true);
    std::unordered_map<std::uint64_t, int> seen;
    const auto link = [&](int a, int b) {
        const std::array<int, 2> edge{a, b};
        int groups = sets.both(in[a], in[b]);
        if (groups == 0 || !movable(edge) || !seen.emplace(edge_key(a, b), 0).second) return;
        bool through = true;  // the material
        for (const int t : band.tetras.around(a)) {
            if (groups == 0) return;
            const auto& v = band.tetras[t];
            if (!holds(v, b)) continue;
            for (int k = 0; k < 4; ++k) {
                if (v[k] == a || v[k] == b) continue;
                groups = sets.minus(groups, in[v[k]]);
                // The face with the fourth node left out holds the edge.
                for (const auto& f : outward_faces) {
                    const std::array<int, 3> nodes{v[f[0]], v[f[1]], v[f[2]]};
                    if (holds(nodes, v[k])) continue;
                    if (const int at = index.find(nodes); at >= 0 && kept_anyway[at]) through = false;
                }
            }
        }
        for (const int t : band.triangles.around(a)) {
            if (!holds(band.triangles[t], b)) continue;
            through = false;
            for (const int v : band.triangles[t])
                if (v != a && v != b) groups = sets.minus(groups, in[v]);
        }
        if (through) {
            const int shortcut = sets.both(groups, sets.both(on_kept[a], on_kept[b]));
            if (shortcut != 0) shortcuts_.push_back({{a, b, b}, shortcut});
            groups = sets.minus(groups, shortcut);
        }
        if (groups != 0) put_line(edge, groups, false);
    };
    const auto link_edges = [&](const auto& list) {
        for (int s = 0; s < list.size(); ++s) {
            check();
            if (!list.alive(s)) continue;
            const auto& v = list[s];
            // Inside an area nothing is left of any edge.
            if (v.size() > 2 && std::ranges::all_of(v, [&](int w) { return in[w] == in[v[0]]; })) continue;
            for (std::size_t i = 0; i < v.size(); ++i)
                for (std::size_t j = i + 1; j < v.size(); ++j) {
                    int rest = sets.both(in[v[i]], in[v[j]]);
                    for (std::size_t k = 0; k < v.size() && rest != 0; ++k)
                        if (k != i && k != j) rest = sets.minus(rest, in[v[k]]);
                    if (rest != 0) link(v[i], v[j]);
                }
        }
    };
    link_edges(band.tetras);
    link_edges(band.triangles);
    link_edges(band.lines);

    // 4. Nodes: those without a neighbour in the group, and point elements.
    std::vector<int> pinned(in.size(), 0);
    for (int v = 0; v < band.size(); ++v) {
        check();
        if (!band.in_use(v) || !band.nodes[v].movable()) continue;
        for (const int s : band.vertices.around(v))
            pinned[v] = sets.either(pinned[v], of_cell(band.vertex_cells[band.vertices.origin(s)]));
        int rest = in[v];
        const auto link_to = [&](const auto& list) {
            for (const int s : list.around(v)) {
                for (const int w : list[s])
                    if (w != v) rest = sets.minus(rest, in[w]);
                if (rest == 0) return;
            }
        };
        link_to(band.tetras);
        link_to(band.triangles);
        link_to(band.lines);
        pinned[v] = sets.either(pinned[v], rest);
    }
    for (const auto& [key, mid] : band.mid_nodes) {
        const int groups = kept_groups(mesh.node_families[mid]);
        if (groups == 0) continue;
        const int a = static_cast<int>(key >> 32), b = static_cast<int>(key & 0xffffffffu);
        const int rest = sets.minus(groups, sets.both(in[a], in[b]));
        if (rest != 0) isolated_middles_.push_back({a, b});
        for (const int v : {a, b})
            if (band.nodes[v].movable()) pinned[v] = sets.either(pinned[v], rest);
    }
    for (int v = 0; v < band.size(); ++v)
        if (pinned[v] != 0) isolated_.push_back({v, pinned[v]});
}

}  // namespace femscalpel
