// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/rebuild.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "cancel.h"
#include "cutting/opening_groups.h"
#include "deformation/curved_shape.h"
#include "mesh/companion.h"

namespace femscalpel {
namespace {

class Rebuilder {
public:
    Rebuilder(const Mesh& input, Mesh copy, const Workpiece& f, const Opening& opening, const Numbering& numbering)
        : input_(input),
          f_(f),
          band_(f.d.band),
          opening_(opening),
          next_node_(numbering.node),
          next_cell_(numbering.cell) {
        out_.mesh = std::move(copy);
    }

    Rebuilt run(const std::vector<std::vector<std::string>>& groups, const std::string& front) {
        Mesh& mesh = out_.mesh;
        write_nodes();
        find_mid_owners();
        write_cells(band_.tetras, opening_.tetras, band_.tetra_cells, tetra_cell_);
        write_cells(band_.triangles, opening_.triangles, band_.triangle_cells, triangle_cell_);
        write_cells(band_.lines, opening_.lines, band_.line_cells, line_cell_);
        if (!opening_.vertices.empty())
            write_cells(band_.vertices, opening_.vertices, band_.vertex_cells, vertex_cell_);
        write_twins(opening_.triangle_twins, band_.triangles, band_.triangle_cells, triangle_twin_);
        write_twins(opening_.line_twins, band_.lines, band_.line_cells, line_twin_);
        write_lips(groups);
        if (!opening_.front_chains.empty()) write_front(front);
        write_facets();
        for (const CellRef& c : f_.deep_inside) note_removed(c);
        remove_cells();
        out_.elements_removed = static_cast<Index>(removed_.size());
        remove_nodes();
        out_.elements_added = mesh.cell_count() - input_.cell_count() + out_.elements_removed;
        return std::move(out_);
    }

private:
    bool moved(int v) const {
        return band_.nodes[v].global >= 0 && band_.nodes[v].at != input_.points[band_.nodes[v].global];
    }

    /// Whether a mid-side node of the element was moved for its own sake.
    bool is_mended(const auto& corners) const {
        return !f_.d.mids.mended().empty() && std::ranges::any_of(corners, [&](int v) {
            return std::ranges::any_of(corners, [&](int w) { return f_.d.mids.is_mended(v, w); });
        });
    }

    void write_nodes() {
        Mesh& mesh = out_.mesh;
        out_.node.assign(static_cast<std::size_t>(band_.size()) + opening_.copy_of.size(), -1);
        for (int v = 0; v < band_.size(); ++v) {
            check_();
            const BandNode& n = band_.nodes[v];
            if (n.global < 0 && !band_.in_use(v)) continue;
            if (n.global >= 0) {
                out_.node[v] = n.global;
                mesh.points[n.global] = n.at;
                if (band_.is_new(v))  // that was a mid-side node
                    for (const GroupIndex g : f_.d.membership.groups(v))
                        mesh.node_families[n.global] = mesh.families.with(mesh.node_families[n.global], g);
                continue;
            }
            const auto& [a, b] = band_.births[v - band_.original_nodes()];
            if (note_born(a, b, !f_.d.constraints.is_on_skin(band_, v))) spanning_.insert(v);
            out_.node[v] = mesh.add_node(n.at, next_node_++, mesh.families.intersect(family(a), family(b)));
            ++out_.nodes_split;
        }
        for (std::size_t k = 0; k < opening_.copy_of.size(); ++k) {
            const Index source = out_.node[opening_.copy_of[k]];
            out_.changes.copies.push_back({next_node_, mesh.node_ids[source]});
            out_.node[band_.size() + static_cast<int>(k)] =
                mesh.add_node(mesh.points[source], next_node_++, mesh.node_families[source]);
            ++out_.nodes_doubled;
        }
    }

    /// The next node is born on the edge a-b, on the skin or `inside`; whether it is Changes::Born::spans.
    bool note_born(int a, int b, bool inside) {
        check_();
        Changes::Born born{next_node_, {}};
        // Ends that are between others on the skin are no further inside.
        const auto counts = [&](int v) {
            return spanning_.contains(v) || (band_.in_use(v) && f_.d.constraints.is_on_skin(band_, v));
        };
        const bool spans = inside && counts(a) && counts(b);
        born.spans = spans;
        gather_ancestors(a, born.ancestors);
        gather_ancestors(b, born.ancestors);
        std::ranges::sort(born.ancestors);
        born.ancestors.erase(std::unique(born.ancestors.begin(), born.ancestors.end()), born.ancestors.end());
        out_.changes.born.push_back(std::move(born));
        return spans;
    }

    void gather_ancestors(int v, std::vector<Index>& out) {
        if (band_.nodes[v].global >= 0) {
            out.push_back(input_.node_ids[band_.nodes[v].global]);
            return;
        }
        // Kept, because births of births of ... would be visited over and over.
        if (!ancestors_.contains(v)) {
            const auto& [a, b] = band_.births[v - band_.original_nodes()];
            std::vector<Index> all;
            gather_ancestors(a, all);
            gather_ancestors(b, all);
            std::ranges::sort(all);
            all.erase(std::unique(all.begin(), all.end()), all.end());
            ancestors_[v] = std::move(all);
        }
        const std::vector<Index>& all = ancestors_[v];
        out.insert(out.end(), all.begin(), all.end());
    }

    /// Node family of a band node, also of one that was merged away after others were born on its edges.
    FamilyIndex family(int v) {
        if (out_.node[v] >= 0) return out_.mesh.node_families[out_.node[v]];
        const auto& [a, b] = band_.births[v - band_.original_nodes()];
        return out_.mesh.families.intersect(family(a), family(b));
    }

    /// Which image of each second-order edge keeps the edge's own mid-side node: the uncopied one where an
    /// element still has it.
    void find_mid_owners() {
        // Growing step by step, a map of millions of edges would be rehashed for a good part of a second.
        if (!band_.mid_nodes.empty())
            mids_.reserve(static_cast<std::size_t>(1.3 * band_.tetras.size() + 1.6 * band_.triangles.size()));
        const auto look = [&](const auto& corners, const auto& images, CellType type) {
            check_();
            const CellTraits& t = traits(type);
            if (!t.quadratic) return;
            for (const auto& e : t.edges) {
                const std::uint64_t base = edge_key(corners[e[0]], corners[e[1]]),
                                    image = edge_key(images[e[0]], images[e[1]]);
                MidNodes& mids = mids_.try_emplace(base, image).first->second;
                if (image == base) mids.owner = base;
            }
        };
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (band_.tetras.alive(t))
                look(band_.tetras[t], opening_.tetras[t], band_.tetra_cells[band_.tetras.origin(t)].type);
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (band_.triangles.alive(t))
                look(band_.triangles[t], opening_.triangles[t], band_.triangle_cells[band_.triangles.origin(t)].type);
        for (int l = 0; l < band_.lines.size(); ++l)
            if (band_.lines.alive(l))
                look(band_.lines[l], opening_.lines[l], band_.line_cells[band_.lines.origin(l)].type);
    }

    Index make_mid_node(int a, int b) {
        Mesh& mesh = out_.mesh;
        const auto original = band_.mid_nodes.find(edge_key(a, b));
        if (original == band_.mid_nodes.end()) {
            ++out_.nodes_split;
            note_born(a, b, !f_.d.constraints.is_skin_edge(band_, a, b));
            return mesh.add_node(half_way(a, b), next_node_++, mesh.families.intersect(family(a), family(b)));
        }
        if (band_.is_handed_over(a, b)) {
            mesh.points[original->second] = half_way(a, b);
            mesh.node_families[original->second] = mesh.families.intersect(family(a), family(b));
        } else if (moved(a) || moved(b) || f_.d.edge_contact(a, b) || f_.d.mids.is_mended(a, b)) {
            const Vec3 at = half_way(a, b);
            // Straight to within the digits of a text file stays as it is.
            if (moved(a) || moved(b) ||
                (at - mesh.points[original->second]).norm() > 1e-8 * (band_.nodes[a].at - band_.nodes[b].at).norm())
                mesh.points[original->second] = at;
        }
        return original->second;
    }

    /// The mid-side node between the images of two band nodes.
    Index mid_node(int a, int b, int image_a, int image_b) {
        const std::uint64_t base = edge_key(a, b), image = edge_key(image_a, image_b);
        MidNodes& mids = mids_.at(base);
        if (mids.node < 0) mids.node = make_mid_node(a, b);
        if (image == mids.owner) return mids.node;
        for (const auto& [key, node] : mids.copies)
            if (key == image) return node;
        Mesh& mesh = out_.mesh;
        out_.changes.copies.push_back({next_node_, mesh.node_ids[mids.node]});
        const Index copy = mesh.add_node(mesh.points[mids.node], next_node_++, mesh.node_families[mids.node]);
        ++out_.nodes_doubled;
        mids.copies.push_back({image, copy});
        return copy;
    }

    Vec3 half_way(int a, int b) const { return f_.mid_side ? f_.mid_side(a, b) : mid_side(f_.d, a, b).at; }

    /// Full connectivity of an element from its corners.
    template <std::size_t N>
    std::vector<Index> connectivity(CellType type, const std::array<int, N>& corners,
                                    const std::array<int, N>& images) {
        const CellTraits& t = traits(type);
        std::vector<Index> nodes;
        nodes.reserve(static_cast<std::size_t>(t.nodes));
        for (int image : images) nodes.push_back(out_.node[image]);
        if (t.quadratic)
            for (const auto& e : t.edges)
                nodes.push_back(mid_node(corners[e[0]], corners[e[1]], images[e[0]], images[e[1]]));
        return nodes;
    }

    template <std::size_t N>
    void write_cells(const SimplexList<N>& list, const std::vector<std::array<int, N>>& images,
                     const std::vector<CellRef>& cells, std::vector<Index>& written) {
        Mesh& mesh = out_.mesh;
        written.assign(static_cast<std::size_t>(list.size()), -1);
        std::vector<char> seated(cells.size(), 0);
        SparseCheck check;
        for (int s = 0; s < list.size(); ++s) {
            check();
            if (!list.alive(s)) continue;
            const CellRef& cell = cells[list.origin(s)];
            CellBlock& block = mesh.block(cell.type);
            std::vector<Index> nodes;
            if (N == 2 && f_.d.constraints.is_loose(list.origin(s))) {
                // Its mid-side node is its own, and stays.
                nodes.assign(block.nodes(cell.cell).begin(), block.nodes(cell.cell).end());
                for (std::size_t k = 0; k < N; ++k) nodes[k] = out_.node[images[s][k]];
            } else {
                nodes = connectivity(cell.type, list[s], images[s]);
            }
            if (!seated[list.origin(s)]) {
                seated[list.origin(s)] = 1;
                written[s] = cell.cell;
                Index* at = block.connectivity.data() + cell.cell * traits(cell.type).nodes;
                const bool same = std::equal(nodes.begin(), nodes.end(), at);
                if (!same) std::ranges::copy(nodes, at);
                if (!same || std::ranges::any_of(list[s], [&](int v) { return moved(v); }) || is_mended(list[s])) {
                    out_.before.push_back(cell);
                    out_.after.push_back(cell);
                }
            } else {
                out_.changes.parts.push_back({next_cell_, block.ids[cell.cell]});
                written[s] = mesh.add_cell(cell.type, nodes, next_cell_++, block.families[cell.cell]);
                out_.after.push_back({cell.type, written[s]});
            }
        }
        for (std::size_t o = 0; o < cells.size(); ++o)
            if (!seated[o]) note_removed(cells[o]);
    }

    void note_removed(const CellRef& cell) {
        removed_.push_back(cell);
        out_.before.push_back(cell);
    }

    template <std::size_t N>
    void write_twins(const std::vector<Opening::Twin<N>>& twins, const SimplexList<N>& list,
                     const std::vector<CellRef>& cells, std::vector<CellRef>& written) {
        for (const auto& twin : twins) {
            const CellRef& cell = cells[list.origin(twin.slot)];
            const std::vector<Index> nodes = connectivity(cell.type, list[twin.slot], twin.nodes);
            out_.changes.parts.push_back({next_cell_, out_.mesh.block(cell.type).ids[cell.cell]});
            const Index made =
                out_.mesh.add_cell(cell.type, nodes, next_cell_++, out_.mesh.block(cell.type).families[cell.cell]);
            written.push_back({cell.type, made});
            out_.after.push_back(written.back());
        }
    }

    void write_lips(const std::vector<std::vector<std::string>>& groups) {
        Mesh& mesh = out_.mesh;
        const std::vector<std::vector<GroupIndex>> members = add_opening_groups(mesh, opening_, groups);
        const auto with_groups = [&](FamilyIndex family, int face_group) {
            for (const GroupIndex g : members[face_group]) family = mesh.families.with(family, g);
            return family;
        };
        // An element of the input that joins a lip is a changed element, though its nodes may be the same.
        const auto list_as_changed = [&](const CellRef& cell) {
            if (std::ranges::find(out_.before, cell) != out_.before.end()) return;
            if (cell.cell >= input_.block(cell.type).size()) return;
            out_.before.push_back(cell);
            out_.after.push_back(cell);
        };
        const auto join = [&](CellType type, Index cell, int face_group) {
            FamilyIndex& family = mesh.block(type).families[cell];
            family = with_groups(family, face_group);
        };
        const auto write = [&](const auto& faces, const auto& cells, const auto& written, const auto& twins,
                               CellType linear, CellType quadratic) {
            for (const auto& lip : faces) {
                if (lip.element == Opening::fresh) {
                    auto corners = lip.nodes;
                    for (int& v : corners)
                        if (v >= band_.size()) v = opening_.copy_of[v - band_.size()];
                    const CellType type = lip.second_order ? quadratic : linear;
                    const Index made = mesh.add_cell(type, connectivity(type, corners, lip.nodes), next_cell_++,
                                                     with_groups(0, lip.group));
                    out_.after.push_back({type, made});
                } else if (lip.element >= 0) {
                    list_as_changed({cells(lip.element).type, written[lip.element]});
                    join(cells(lip.element).type, written[lip.element], lip.group);
                } else {
                    const CellRef& twin = twins[-1 - lip.element];
                    join(twin.type, twin.cell, lip.group);
                }
            }
        };
        write(
            opening_.faces, [&](int s) { return band_.triangle_cells[band_.triangles.origin(s)]; }, triangle_cell_,
            triangle_twin_, CellType::triangle, CellType::triangle6);
        write(
            opening_.edges, [&](int s) { return band_.line_cells[band_.lines.origin(s)]; }, line_cell_, line_twin_,
            CellType::line, CellType::line3);
        for (const Opening::End& end : opening_.ends)
            for (const GroupIndex g : members[end.group])
                if (FamilyIndex& family = mesh.node_families[out_.node[end.node]];
                    mesh.groups[g].kind == GroupKind::node)
                    family = mesh.families.with(family, g);
    }

    /// Segments along the front. One that is already there is taken; order then follows the numbers.
    void write_front(const std::string& name) {
        Mesh& mesh = out_.mesh;
        const GroupIndex group = mesh.add_group(name, GroupKind::element);
        for (const std::vector<int>& chain : opening_.front_chains)
            for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
                const std::array<int, 2> ends{chain[k], chain[k + 1]};
                if (const int old = band_.lines.find(ends); old >= 0) {
                    const CellType type = band_.line_cells[band_.lines.origin(old)].type;
                    FamilyIndex& family = mesh.block(type).families[line_cell_[old]];
                    family = mesh.families.with(family, group);
                    continue;
                }
                const CellType type = mids_.contains(edge_key(ends[0], ends[1])) ? CellType::line3 : CellType::line;
                const Index made =
                    mesh.add_cell(type, connectivity(type, ends, ends), next_cell_++, mesh.families.with(0, group));
                out_.after.push_back({type, made});
            }
    }

    /// The facet on an edge of its own triangle or, where merging took that away, of another in the same groups.
    std::optional<Facet> facet_on(const std::array<int, 2>& edge, const Facet& parent) const {
        std::optional<Facet> other;
        for (const int t : band_.triangles.around(edge[0]))
            for (int k = 0; k < 3; ++k) {
                if (band_.triangles[t][k] != edge[0] || band_.triangles[t][(k + 1) % 3] != edge[1]) continue;
                const CellRef& cell = band_.triangle_cells[band_.triangles.origin(t)];
                const Facet found{cell.type, static_cast<std::int8_t>(k + 3), parent.family, triangle_cell_[t]};
                if (cell == CellRef{parent.type, parent.cell}) return found;
                if (input_.block(cell.type).families[cell.cell] == input_.block(parent.type).families[parent.cell])
                    other = found;
            }
        return other;
    }

    void write_facets() {
        if (band_.facet_faces.size() == 0 && band_.facet_edges.size() == 0 && band_.facet_sides.empty()) return;
        Mesh& mesh = out_.mesh;
        std::vector<char> replaced(mesh.facets.size(), 0);
        std::vector<Facet> fresh;
        constexpr int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};  // CalculiX's order, normals inwards
        for (int s = 0; s < band_.facet_faces.size(); ++s) {
            replaced[band_.facet_faces.tag(s)] = 1;
            if (!band_.facet_faces.alive(s)) continue;
            const auto& v = band_.facet_faces[s];
            for (const int t : band_.tetras.around(v[0]))
                for (int k = 0; k < 4; ++k) {
                    const auto& n = band_.tetras[t];
                    const std::array<int, 3> outwards{n[faces[k][0]], n[faces[k][2]], n[faces[k][1]]};
                    for (int turn = 0; turn < 3; ++turn)
                        if (v[0] == outwards[turn] && v[1] == outwards[(turn + 1) % 3] &&
                            v[2] == outwards[(turn + 2) % 3])
                            fresh.push_back({band_.tetra_cells[band_.tetras.origin(t)].type,
                                             static_cast<std::int8_t>(k + 1),
                                             mesh.facets[band_.facet_faces.tag(s)].family, tetra_cell_[t]});
                }
        }
        for (int s = 0; s < band_.facet_edges.size(); ++s) {
            const Facet& parent = mesh.facets[band_.facet_edges.tag(s)];
            replaced[band_.facet_edges.tag(s)] = 1;
            if (!band_.facet_edges.alive(s)) continue;
            if (const auto facet = facet_on(band_.facet_edges[s], parent)) fresh.push_back(*facet);
        }
        for (const auto& [slot, tag] : band_.facet_sides) {
            const Facet& parent = mesh.facets[tag];
            replaced[tag] = 1;
            for (int t = 0; t < band_.triangles.size(); ++t)
                if (band_.triangles.alive(t) && band_.triangles.origin(t) == slot)
                    fresh.push_back({parent.type, parent.face, parent.family, triangle_cell_[t]});
        }
        std::size_t k = 0;
        std::erase_if(mesh.facets, [&](const Facet&) { return replaced[k++] != 0; });
        mesh.facets.insert(mesh.facets.end(), fresh.begin(), fresh.end());
        std::ranges::stable_sort(mesh.facets, {}, [](const Facet& f) { return std::tuple(f.type, f.cell, f.face); });
    }

    /// Drops elements no part of which is left.
    void remove_cells() {
        if (removed_.empty()) return;
        for (CellBlock& block : out_.mesh.blocks()) {
            check_cancelled();
            std::vector<char> gone(static_cast<std::size_t>(block.size()), 0);
            bool any = false;
            for (const CellRef& c : removed_)
                if (c.type == block.type) {
                    gone[c.cell] = 1;
                    any = true;
                }
            if (!any) continue;
            std::vector<Index> shift(gone.size());
            Index kept = 0;
            const int n = traits(block.type).nodes;
            for (std::size_t c = 0; c < gone.size(); ++c) {
                shift[c] = kept;
                if (gone[c]) continue;
                std::copy_n(block.connectivity.begin() + static_cast<std::ptrdiff_t>(c) * n, n,
                            block.connectivity.begin() + kept * n);
                block.ids[kept] = block.ids[c];
                block.families[kept] = block.families[c];
                ++kept;
            }
            block.connectivity.resize(static_cast<std::size_t>(kept * n));
            block.ids.resize(static_cast<std::size_t>(kept));
            block.families.resize(static_cast<std::size_t>(kept));
            std::erase_if(out_.mesh.facets, [&](const Facet& f) { return f.type == block.type && gone[f.cell]; });
            for (Facet& f : out_.mesh.facets)
                if (f.type == block.type) f.cell = shift[f.cell];
            for (CellRef& c : out_.after)
                if (c.type == block.type) c.cell = shift[c.cell];
        }
    }

    /// Drops the nodes that only removed elements had.
    void remove_nodes() {
        if (!opening_.removes) return;
        check_cancelled();
        Mesh& mesh = out_.mesh;
        std::vector<char> orphan(mesh.points.size(), 0);
        bool any = false;
        for (const CellRef& c : out_.before)
            for (const Index n : input_.block(c.type).nodes(c.cell)) orphan[n] = 1;
        for (const CellBlock& b : mesh.blocks())
            for (const Index n : b.connectivity) orphan[n] = 0;
        for (const char o : orphan) any = any || o;
        if (!any) return;
        std::vector<Index> shift(orphan.size(), -1);
        Index kept = 0;
        for (std::size_t n = 0; n < orphan.size(); ++n) {
            if (orphan[n]) continue;
            mesh.points[kept] = mesh.points[n];
            mesh.node_ids[kept] = mesh.node_ids[n];
            mesh.node_families[kept] = mesh.node_families[n];
            shift[n] = kept++;
        }
        out_.nodes_removed = static_cast<Index>(orphan.size()) - kept;
        mesh.points.resize(static_cast<std::size_t>(kept));
        mesh.node_ids.resize(static_cast<std::size_t>(kept));
        mesh.node_families.resize(static_cast<std::size_t>(kept));
        for (CellBlock& b : mesh.blocks())
            for (Index& n : b.connectivity) n = shift[n];
        for (Index& n : out_.node)
            if (n >= 0) n = shift[n];
        shift.resize(static_cast<std::size_t>(input_.node_count()));
        out_.place = std::move(shift);
    }

    const Mesh& input_;
    const Workpiece& f_;
    const BandMesh& band_;
    const Opening& opening_;
    Rebuilt out_;
    Index next_node_, next_cell_;
    SparseCheck check_;
    std::vector<Index> tetra_cell_, triangle_cell_, line_cell_, vertex_cell_;  // by slot: index in the new mesh
    std::vector<CellRef> triangle_twin_, line_twin_;
    std::vector<CellRef> removed_;
    std::unordered_map<int, std::vector<Index>> ancestors_;  // by new band node
    std::unordered_set<int> spanning_;                       // new band nodes that are Changes::Born::spans
    struct MidNodes {
        explicit MidNodes(std::uint64_t image) : owner(image) {}

        std::uint64_t owner;                                  // the image of the edge that keeps its node
        Index node = -1;                                      // that one, once it is known
        std::vector<std::pair<std::uint64_t, Index>> copies;  // those of other images
    };
    std::unordered_map<std::uint64_t, MidNodes> mids_;  // of second-order edges, by uncopied edge
};

}  // namespace

Rebuilt rebuild(const Mesh& input, Mesh copy, const Workpiece& workpiece, const Opening& opening,
                const std::vector<std::vector<std::string>>& groups, const Numbering& numbering,
                const std::string& front) {
    return Rebuilder(input, std::move(copy), workpiece, opening, numbering).run(groups, front);
}

}  // namespace femscalpel
