// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/opened_areas.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace femscalpel {
namespace {

/// Faces of a tetrahedron by its corners.
constexpr int tetra_faces[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};

class OpenedAreas {
public:
    OpenedAreas(const BandMesh& band, const Mesh& mesh) : band_(band), mesh_(mesh), families_(mesh.families) {
        find_members();
    }

    std::vector<std::string> run() {
        if (edges_.empty() && faces_.empty()) return {};
        look_at(band_.tetras, band_.tetra_cells);
        look_at(band_.triangles, band_.triangle_cells);
        std::vector<std::string> out;
        for (const auto& [g, cells] : opened_) {
            const Group& group = mesh_.groups[g];
            if (group.hidden) continue;
            std::string numbers;
            int named = 0;
            for (const Index id : cells)
                if (named++ < 5) numbers += (named > 1 ? ", " : "") + std::to_string(id);
            if (named > 5) numbers += ", ...";
            out.push_back("group '" + group.name + "' covers " + (cells.size() > 1 ? "elements " : "element ") +
                          numbers +
                          ", or faces of them, only by the edges or faces around: these were split, and no elements "
                          "are made inside, so the group covers less than "
                          "before. If it is meant to cover them, put the elements themselves into a group");
        }
        return out;
    }

private:
    using Edge = std::array<Index, 2>;
    using Face = std::array<Index, 3>;

    static auto sorted(auto nodes) {
        std::ranges::sort(nodes);
        return nodes;
    }

    void add(auto& at, const auto& key, FamilyIndex family) {
        if (family == 0) return;
        FamilyIndex& now = at[key];
        now = families_.unite(now, family);
    }

    /// The groups of segments, triangles and facets of the input, and the edges that were split.
    void find_members() {
        for (const CellRef& c : band_.line_cells) {
            const auto n = mesh_.block(c.type).nodes(c.cell);
            add(edges_, sorted(Edge{n[0], n[1]}), mesh_.block(c.type).families[c.cell]);
        }
        for (const CellRef& c : band_.triangle_cells) {
            const auto n = mesh_.block(c.type).nodes(c.cell);
            add(faces_, sorted(Face{n[0], n[1], n[2]}), mesh_.block(c.type).families[c.cell]);
        }
        const auto add_facet = [&](int tag) {
            const Facet& f = mesh_.facets[static_cast<std::size_t>(tag)];
            const CellTraits& t = traits(f.type);
            const auto n = mesh_.block(f.type).nodes(f.cell);
            if (t.dimension == 3) {
                const auto& k = t.faces[f.face - 1];
                add(faces_, sorted(Face{n[k[0]], n[k[1]], n[k[2]]}), f.family);
            } else {
                const auto& k = t.edges[f.face - 3];
                add(edges_, sorted(Edge{n[k[0]], n[k[1]]}), f.family);
            }
        };
        std::set<int> tags;
        for (int s = 0; s < band_.facet_faces.size(); ++s) tags.insert(band_.facet_faces.tag(s));
        for (int s = 0; s < band_.facet_edges.size(); ++s) tags.insert(band_.facet_edges.tag(s));
        for (const int tag : tags) add_facet(tag);
        for (int v = band_.original_nodes(); v < band_.size(); ++v) {
            const auto& [a, b] = band_.births[v - band_.original_nodes()];
            if (band_.in_use(v) && !band_.is_new(a) && !band_.is_new(b))
                split_.insert(sorted(Edge{band_.nodes[a].global, band_.nodes[b].global}));
        }
    }

    FamilyIndex of(const auto& at, const auto& key) const {
        const auto found = at.find(key);
        return found == at.end() ? 0 : found->second;
    }

    /// The groups that have all three edges of a face.
    FamilyIndex around_face(const Face& f) {
        FamilyIndex all = of(edges_, Edge{f[0], f[1]});
        if (all != 0) all = families_.intersect(all, of(edges_, Edge{f[0], f[2]}));
        return all == 0 ? 0 : families_.intersect(all, of(edges_, Edge{f[1], f[2]}));
    }

    void note(FamilyIndex groups, FamilyIndex members, Index element) {
        for (const GroupIndex g : families_.groups(groups))
            if (!families_.contains(members, g)) opened_[g].insert(element);
    }

    /// Elements of the input that were split, and faces of them.
    template <std::size_t N>
    void look_at(const SimplexList<N>& list, const std::vector<CellRef>& cells) {
        std::vector<int> parts(cells.size(), 0);
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s)) ++parts[list.origin(s)];
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (parts[k] < 2) continue;
            const CellRef& c = cells[k];
            const FamilyIndex own = mesh_.block(c.type).families[c.cell];
            const Index id = mesh_.block(c.type).ids[c.cell];
            const auto n = mesh_.block(c.type).nodes(c.cell);
            if constexpr (N == 3) {  // also one on a tetrahedron, which says the same of its face
                note(around_face(sorted(Face{n[0], n[1], n[2]})), own, id);
            } else {
                FamilyIndex volume = -1;
                for (const auto& corner : tetra_faces) {
                    const Face face = sorted(Face{n[corner[0]], n[corner[1]], n[corner[2]]});
                    const FamilyIndex member = of(faces_, face), around = around_face(face);
                    if (around != 0 && is_split(face)) note(around, member, id);
                    const FamilyIndex covers = families_.unite(member, around);
                    volume = volume < 0 ? covers : families_.intersect(volume, covers);
                }
                note(volume, own, id);
            }
        }
    }

    bool is_split(const Face& f) const {
        return split_.contains({f[0], f[1]}) || split_.contains({f[0], f[2]}) || split_.contains({f[1], f[2]});
    }

    const BandMesh& band_;
    const Mesh& mesh_;
    FamilyTable families_;
    std::map<Edge, FamilyIndex> edges_;
    std::map<Face, FamilyIndex> faces_;
    std::set<Edge> split_;
    std::map<GroupIndex, std::set<Index>> opened_;
};

}  // namespace

std::vector<std::string> warnings_of_opened_areas(const BandMesh& band, const Mesh& mesh) {
    return OpenedAreas(band, mesh).run();
}

}  // namespace femscalpel
