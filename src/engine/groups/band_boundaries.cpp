// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/band_boundaries.h"

#include <algorithm>
#include <unordered_map>

#include "cancel.h"
#include "groups/family_sets.h"
#include "groups/tetra_faces.h"

namespace femscalpel {
namespace {

bool holds(const auto& nodes, int node) { return std::ranges::find(nodes, node) != nodes.end(); }

}  // namespace

/// Fills a BandBoundaries. Kinds of groups are families of its table.
class BandBoundaries::Finder {
public:
    Finder(BandBoundaries& out, const BandMesh& band, const Mesh& mesh, const std::vector<bool>& drifting,
           const std::vector<bool>& meaningless)
        : out_(out),
          band_(band),
          mesh_(mesh),
          drifting_(drifting),
          meaningless_(meaningless),
          sets_(out.sets_),
          kept_(static_cast<std::size_t>(mesh.families.size()), -1) {}

    void run(std::span<const Index> on_shortcuts) {
        find_node_groups();
        find_volume_kinds();
        index_ = TetraFaces(band_, relevant_nodes());
        put_facets();
        put_triangles();
        put_volume_borders();
        find_nodes_on_kept(on_shortcuts);
        for (std::size_t k = 0; k < index_.faces.size(); ++k) {
            check_();
            put_node_group_face(index_.faces[k], kept_anyway_[k] != 0);
        }
        put_member_lines();
        link_edges(band_.tetras);
        link_edges(band_.triangles);
        link_edges(band_.lines);
        put_isolated();
    }

private:
    /// The kept groups of a family.
    int kept_groups(FamilyIndex f) {
        if (kept_[f] < 0) {
            std::vector<GroupIndex> set;
            for (const GroupIndex g : mesh_.families.groups(f))
                if (drifting_.empty() ? !mesh_.groups[g].hidden : !drifting_[g]) set.push_back(g);
            kept_[f] = out_.sets_.intern(set);
        }
        return kept_[f];
    }
    FamilyIndex family_of(const CellRef& c) const { return mesh_.block(c.type).families[c.cell]; }
    FamilyIndex family_of(int facet) const { return mesh_.facets[facet].family; }
    int of_cell(const CellRef& c) { return kept_groups(family_of(c)); }

    /// Whether an element or facet inside the material or on the skin is kept where it is: it is in no group, or in
    /// one that is kept.
    bool is_kept(FamilyIndex f) {
        return kept_groups(f) != 0 || std::ranges::all_of(mesh_.families.groups(f), [&](GroupIndex g) {
                   return mesh_.groups[g].hidden || (!meaningless_.empty() && meaningless_[g]);
               });
    }
    bool movable(const auto& nodes) const {
        return std::ranges::any_of(nodes, [&](int v) { return band_.nodes[v].movable(); });
    }
    /// The node groups that all nodes of a face are in.
    int in_all(const std::array<int, 3>& f) { return sets_.both(sets_.both(in_[f[0]], in_[f[1]]), in_[f[2]]); }

    /// Node groups of each node; one born here is in those of both ends.
    void find_node_groups() {
        in_.resize(static_cast<std::size_t>(band_.size()));
        for (int v = 0; v < band_.size(); ++v) {
            if (!band_.is_new(v)) {
                in_[v] = kept_groups(mesh_.node_families[band_.nodes[v].global]);
            } else {
                const auto& [a, b] = band_.births[v - band_.original_nodes()];
                in_[v] = sets_.both(in_[a], in_[b]);
            }
        }
    }

    void find_volume_kinds() {
        volume_kind_.assign(static_cast<std::size_t>(band_.tetras.size()), 0);
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (band_.tetras.alive(t)) volume_kind_[t] = of_cell(band_.tetra_cells[band_.tetras.origin(t)]);
    }

    /// The nodes of faces of tetrahedra that can matter: those on the outside, those of face elements, and those whose
    /// tetrahedra differ in their groups or in those of their nodes.
    std::vector<char> relevant_nodes() const {
        std::vector<char> counts(in_.size(), 0);
        std::vector<int> first_kind(in_.size(), -1);
        for (int t = 0; t < band_.tetras.size(); ++t) {
            if (!band_.tetras.alive(t)) continue;
            const auto& v = band_.tetras[t];
            const bool mixed = in_[v[0]] != in_[v[1]] || in_[v[0]] != in_[v[2]] || in_[v[0]] != in_[v[3]];
            for (const int w : v) {
                if (first_kind[w] < 0) first_kind[w] = volume_kind_[t];
                if (mixed || first_kind[w] != volume_kind_[t]) counts[w] = 1;
            }
        }
        const auto count_nodes = [&](const auto& list) {
            for (int s = 0; s < list.size(); ++s)
                if (list.alive(s))
                    for (const int v : list[s]) counts[v] = 1;
        };
        count_nodes(band_.triangles);
        count_nodes(band_.facet_faces);
        mark_outer_nodes(band_, counts);
        return counts;
    }

    void put_facets() {
        for (int f = 0; f < band_.facet_faces.size(); ++f) {
            if (!band_.facet_faces.alive(f) || !movable(band_.facet_faces[f])) continue;
            const int at = index_.find(band_.facet_faces[f]);
            const FamilyIndex family = family_of(band_.facet_faces.tag(f));
            if (at < 0 || !is_kept(family)) continue;
            Face& face = index_.faces[at];
            face.element = true;
            face.kind = sets_.either(face.kind, kept_groups(family));
        }
    }

    /// Triangles lie on faces of tetrahedra, or are shells.
    void put_triangles() {
        std::unordered_map<int, int> side_groups;  // of shells, by slot of the original
        for (const auto& [slot, facet] : band_.facet_sides) {
            int& kind = side_groups[slot];
            kind = sets_.either(kind, kept_groups(family_of(facet)));
        }
        // Shells on the same nodes (layers, a skin for a load) are one face: two would part the sheet along every edge.
        std::vector<int> face_of_shell(static_cast<std::size_t>(band_.triangles.size()), -1);
        const auto face_on = [&](const std::array<int, 3>& v) {
            for (const int other : band_.triangles.around(v[0]))
                if (face_of_shell[other] >= 0 && holds(band_.triangles[other], v[1]) &&
                    holds(band_.triangles[other], v[2]))
                    return face_of_shell[other];
            return -1;
        };
        for (int t = 0; t < band_.triangles.size(); ++t) {
            if (!band_.triangles.alive(t) || !movable(band_.triangles[t])) continue;
            const auto& v = band_.triangles[t];
            const CellRef& cell = band_.triangle_cells[band_.triangles.origin(t)];
            int kind = of_cell(cell);
            const auto side = side_groups.find(band_.triangles.origin(t));
            if (side != side_groups.end()) kind = sets_.either(kind, side->second);
            if (const int at = index_.find(v); at >= 0) {
                Face& face = index_.faces[at];
                face.element = face.element || kind != 0 || is_kept(family_of(cell));
                face.kind = sets_.either(face.kind, kind);
            } else if (const int same = face_on(v); same >= 0) {
                out_.faces_[same].kind = sets_.either(out_.faces_[same].kind, kind);
            } else {
                face_of_shell[t] = static_cast<int>(out_.faces_.size());
                out_.faces_.push_back({v, sets_.either(kind, in_all(v)), {-1, -1}, true});
            }
        }
    }

    /// Groups of volume elements have their boundary where they differ. Then it is known which faces are kept
    /// whatever node groups there are.
    void put_volume_borders() {
        const auto volume = [&](int t) { return t < 0 ? 0 : volume_kind_[t]; };
        kept_anyway_.resize(index_.faces.size());
        for (std::size_t k = 0; k < index_.faces.size(); ++k) {
            check_();
            Face& f = index_.faces[k];
            f.kind = sets_.either(f.kind, sets_.differ(volume(f.tetra[0]), volume(f.tetra[1])));
            kept_anyway_[k] = f.is_skin() || f.element || f.kind != 0;
        }
    }

    /// The node groups of a node's faces that are kept anyway: they tell shortcuts.
    void find_nodes_on_kept(std::span<const Index> on_shortcuts) {
        on_kept_.assign(in_.size(), 0);
        const auto note_kept = [&](const Face& f) {
            if (const int set = in_all(f.nodes))
                for (const int v : f.nodes) on_kept_[v] = sets_.either(on_kept_[v], set);
        };
        for (std::size_t k = 0; k < index_.faces.size(); ++k)
            if (kept_anyway_[k]) note_kept(index_.faces[k]);
        for (const Face& shell : out_.faces_) note_kept(shell);
        if (!on_shortcuts.empty())
            for (int v = 0; v < band_.size(); ++v)
                if (!band_.is_new(v) && std::ranges::binary_search(on_shortcuts, mesh_.node_ids[band_.nodes[v].global]))
                    on_kept_[v] = in_[v];
    }

    /// Node groups have their boundary where a face belongs and is not between two elements of the area.
    void put_node_group_face(Face& f, bool kept_anyway) {
        if (int belongs = in_all(f.nodes)) {
            if (f.is_internal()) {
                const auto& [a, b, c] = f.nodes;
                belongs =
                    sets_.minus(belongs, sets_.both(opposite(f.tetra[0], f.nodes), opposite(f.tetra[1], f.nodes)));
                if (belongs && !kept_anyway) {
                    const int shortcut =
                        sets_.both(belongs, sets_.both(sets_.both(on_kept_[a], on_kept_[b]), on_kept_[c]));
                    if (shortcut != 0) out_.shortcuts_.push_back({f.nodes, shortcut});
                    belongs = sets_.minus(belongs, shortcut);
                }
            }
            f.kind = sets_.either(f.kind, belongs);
        }
        if (f.kind != 0 || f.is_skin() || f.element) out_.faces_.push_back(f);
    }

    /// The node groups of the fourth node of a tetrahedron.
    int opposite(int tetra, const std::array<int, 3>& face) const {
        for (const int v : band_.tetras[tetra])
            if (!holds(face, v)) return in_[v];
        return 0;
    }

    void put_line(const std::array<int, 2>& nodes, int kind, bool element) {
        const auto [it, fresh] = line_at_.emplace(edge_key(nodes[0], nodes[1]), static_cast<int>(out_.lines_.size()));
        if (fresh) out_.lines_.push_back({nodes, 0, false});
        Line& line = out_.lines_[it->second];
        line.kind = sets_.either(line.kind, kind);
        line.element = line.element || element;
    }

    void put_member_lines() {
        for (int l = 0; l < band_.lines.size(); ++l)
            if (band_.lines.alive(l) && movable(band_.lines[l]))
                if (const CellRef& cell = band_.line_cells[band_.lines.origin(l)]; is_kept(family_of(cell)))
                    put_line(band_.lines[l], of_cell(cell), true);
        for (int f = 0; f < band_.facet_edges.size(); ++f)
            if (band_.facet_edges.alive(f) && movable(band_.facet_edges[f]))
                if (const FamilyIndex family = family_of(band_.facet_edges.tag(f)); is_kept(family))
                    put_line(band_.facet_edges[f], kept_groups(family), true);
    }

    /// The edges of elements that are in node groups of which no face holds them.
    void link_edges(const auto& list) {
        for (int s = 0; s < list.size(); ++s) {
            check_();
            if (!list.alive(s)) continue;
            const auto& v = list[s];
            // Inside an area nothing is left of any edge.
            if (v.size() > 2 && std::ranges::all_of(v, [&](int w) { return in_[w] == in_[v[0]]; })) continue;
            for (std::size_t i = 0; i < v.size(); ++i)
                for (std::size_t j = i + 1; j < v.size(); ++j) {
                    int rest = sets_.both(in_[v[i]], in_[v[j]]);
                    for (std::size_t k = 0; k < v.size() && rest != 0; ++k)
                        if (k != i && k != j) rest = sets_.minus(rest, in_[v[k]]);
                    if (rest != 0) link(v[i], v[j]);
                }
        }
    }

    /// Puts the edge a-b, in node groups that no face around it is in.
    void link(int a, int b) {
        const std::array<int, 2> edge{a, b};
        int groups = sets_.both(in_[a], in_[b]);
        if (groups == 0 || !movable(edge) || !seen_.emplace(edge_key(a, b), 0).second) return;
        bool through = true;  // the material
        for (const int t : band_.tetras.around(a)) {
            if (groups == 0) return;
            const auto& v = band_.tetras[t];
            if (!holds(v, b)) continue;
            for (int k = 0; k < 4; ++k) {
                if (v[k] == a || v[k] == b) continue;
                groups = sets_.minus(groups, in_[v[k]]);
                // The face with the fourth node left out holds the edge.
                if (is_kept_face(v, v[k])) through = false;
            }
        }
        for (const int t : band_.triangles.around(a)) {
            if (!holds(band_.triangles[t], b)) continue;
            through = false;
            for (const int v : band_.triangles[t])
                if (v != a && v != b) groups = sets_.minus(groups, in_[v]);
        }
        if (through) {
            const int shortcut = sets_.both(groups, sets_.both(on_kept_[a], on_kept_[b]));
            if (shortcut != 0) out_.shortcuts_.push_back({{a, b, b}, shortcut});
            groups = sets_.minus(groups, shortcut);
        }
        if (groups != 0) put_line(edge, groups, false);
    }

    /// Whether the face of a tetrahedron without one of its nodes is kept, whatever node groups there are.
    bool is_kept_face(const std::array<int, 4>& tetra, int without) const {
        for (const auto& f : outward_faces) {
            const std::array<int, 3> nodes{tetra[f[0]], tetra[f[1]], tetra[f[2]]};
            if (holds(nodes, without)) continue;
            const int at = index_.find(nodes);
            return at >= 0 && kept_anyway_[at];
        }
        return false;
    }

    /// Nodes: those without a neighbour in the group, and point elements.
    void put_isolated() {
        std::vector<int> pinned(in_.size(), 0);
        for (int v = 0; v < band_.size(); ++v) {
            check_();
            if (!band_.in_use(v) || !band_.nodes[v].movable()) continue;
            for (const int s : band_.vertices.around(v))
                pinned[v] = sets_.either(pinned[v], of_cell(band_.vertex_cells[band_.vertices.origin(s)]));
            pinned[v] = sets_.either(pinned[v], alone_in(v));
        }
        for (const auto& [key, mid] : band_.mid_nodes) {
            const int groups = kept_groups(mesh_.node_families[mid]);
            if (groups == 0) continue;
            const int a = static_cast<int>(key >> 32), b = static_cast<int>(key & 0xffffffffu);
            const int rest = sets_.minus(groups, sets_.both(in_[a], in_[b]));
            if (rest != 0) out_.isolated_middles_.push_back({a, b});
            for (const int v : {a, b})
                if (band_.nodes[v].movable()) pinned[v] = sets_.either(pinned[v], rest);
        }
        for (int v = 0; v < band_.size(); ++v)
            if (pinned[v] != 0) out_.isolated_.push_back({v, pinned[v]});
    }

    /// The node groups of a node that none of its neighbours is in.
    int alone_in(int node) {
        int rest = in_[node];
        const auto link_to = [&](const auto& list) {
            for (const int s : list.around(node)) {
                for (const int w : list[s])
                    if (w != node) rest = sets_.minus(rest, in_[w]);
                if (rest == 0) return;
            }
        };
        link_to(band_.tetras);
        link_to(band_.triangles);
        link_to(band_.lines);
        return rest;
    }

    BandBoundaries& out_;
    const BandMesh& band_;
    const Mesh& mesh_;
    const std::vector<bool>& drifting_;
    const std::vector<bool>& meaningless_;
    FamilySets sets_;
    std::vector<int> kept_;         // by family of the mesh: kept_groups(), -1 if not asked for
    std::vector<int> in_;           // by node: its node groups
    std::vector<int> volume_kind_;  // by tetrahedron
    TetraFaces index_;
    std::vector<char> kept_anyway_;  // by index in index_.faces
    std::vector<int> on_kept_;       // by node: node groups of its faces that are kept anyway
    std::unordered_map<std::uint64_t, int> line_at_;
    std::unordered_map<std::uint64_t, int> seen_;  // edges that link() has looked at
    SparseCheck check_;
};

BandBoundaries::BandBoundaries(const BandMesh& band, const Mesh& mesh, const std::vector<bool>& drifting,
                               std::span<const Index> on_shortcuts, const std::vector<bool>& meaningless) {
    Finder(*this, band, mesh, drifting, meaningless).run(on_shortcuts);
}

}  // namespace femscalpel
