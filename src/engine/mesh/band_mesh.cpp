// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/band_mesh.h"

#include <map>

#include <optional>
#include <string>

#include "cancel.h"

namespace femscalpel {
namespace {

template <class Visit>
void for_each_list(BandMesh& band, Visit visit) {
    visit(band.tetras);
    visit(band.triangles);
    visit(band.lines);
    visit(band.vertices);
    visit(band.skin);
    visit(band.creases);
    visit(band.cut_faces);
    visit(band.cut_edges);
    visit(band.facet_faces);
    visit(band.facet_edges);
}

/// Throws UnsupportedElementError if there are others than simplices among the chosen elements.
void refuse_other_elements(const Mesh& mesh, const CellLists& chosen) {
    for (const CellBlock& block : mesh.blocks()) {
        const CellTraits& t = traits(block.type);
        const std::vector<Index>& cells = chosen[static_cast<int>(block.type)];
        if (t.simplex || cells.empty()) continue;
        std::string numbers;
        for (std::size_t k = 0; k < cells.size() && k < 5; ++k)
            numbers += (k ? ", " : "") + std::to_string(block.ids[cells[k]]);
        if (cells.size() > 5) numbers += ", ...";
        throw UnsupportedElementError("the tool's band reaches " + std::to_string(cells.size()) + " " +
                                      std::string(t.name) + " elements (" + numbers +
                                      "); only triangles and tetrahedra can be cut. Choose a smaller transition, move "
                                      "the tool, or split these elements into tetrahedra first");
    }
}

/// Adds the corners of the chosen simplices to the band; returns the band's node by the mesh's, or -1.
std::vector<int> add_nodes(const Mesh& mesh, const std::vector<std::int8_t>& level, const CellLists& chosen,
                           BandMesh& band) {
    std::vector<int> local(mesh.points.size(), -1);
    for (const CellBlock& block : mesh.blocks()) {
        const CellTraits& t = traits(block.type);
        if (!t.simplex) continue;
        for (const Index c : chosen[static_cast<int>(block.type)])
            for (int k = 0; k < t.corners; ++k) local[block.connectivity[c * t.nodes + k]] = 0;
    }
    for (std::size_t n = 0; n < local.size(); ++n)
        if (local[n] == 0) {
            local[n] = band.size();
            band.nodes.push_back({mesh.points[n], mesh.points[n], static_cast<Index>(n), level[n]});
        }
    for_each_list(band, [&](auto& list) { list.resize_nodes(band.size()); });
    return local;
}

/// The chosen elements and their facets, on their way into a band that has the nodes.
struct Extraction {
    const Mesh& mesh;
    const CellLists& chosen;
    const std::vector<int>& local;  ///< the band's node by the mesh's

    /// First the linear elements, then the quadratic ones.
    template <std::size_t N>
    void fill(CellType linear, std::optional<CellType> quadratic, SimplexList<N>& list, std::vector<CellRef>& refs,
              BandMesh& band) const {
        std::vector<std::array<int, N>> simplices;
        for (const std::optional<CellType> type : {std::optional(linear), quadratic}) {
            if (!type) continue;
            const CellBlock& block = mesh.block(*type);
            const CellTraits& t = traits(*type);
            SparseCheck check;
            for (const Index c : chosen[static_cast<int>(*type)]) {
                check();
                const auto n = block.nodes(c);
                std::array<int, N> v;
                for (std::size_t k = 0; k < N; ++k) v[k] = local[n[k]];
                simplices.push_back(v);
                refs.push_back({*type, c});
                if (t.quadratic)
                    for (std::size_t e = 0; e < t.edges.size(); ++e)
                        band.mid_nodes.emplace(edge_key(v[t.edges[e][0]], v[t.edges[e][1]]),
                                               n[t.corners + static_cast<int>(e)]);
            }
        }
        check_cancelled();
        list.assign(std::move(simplices), band.size());
    }

    /// Where fill() put an element; -1 for one that is not near, or no simplex.
    int slot_of(CellType type, Index cell) const {
        if (!traits(type).simplex) return -1;
        const std::vector<Index>& cells = chosen[static_cast<int>(type)];
        const auto at = std::ranges::lower_bound(cells, cell);
        if (at == cells.end() || *at != cell) return -1;
        const CellType first = traits(type).dimension == 3 ? CellType::tetra : CellType::triangle;
        return static_cast<int>(at - cells.begin()) +
               (type == first ? 0 : static_cast<int>(chosen[static_cast<int>(first)].size()));
    }

    void add_facets(BandMesh& band) const {
        for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
            const Facet& f = mesh.facets[k];
            const int slot = slot_of(f.type, f.cell);
            if (slot < 0) continue;
            const int tag = static_cast<int>(k);
            if (traits(f.type).dimension == 3) {
                // The table's faces of a tetrahedron have their normal inwards.
                const auto& face = traits(f.type).faces[f.face - 1];
                const auto& v = band.tetras[slot];
                band.facet_faces.add({v[face[0]], v[face[2]], v[face[1]]}, tag);
            } else if (f.face <= 2) {
                band.facet_sides.push_back({slot, tag});
            } else {
                const auto& v = band.triangles[slot];
                band.facet_edges.add({v[f.face - 3], v[(f.face - 2) % 3]}, tag);
            }
        }
    }
};

}  // namespace

int BandMesh::add_node(const Vec3& at, int a, int b) {
    nodes.push_back({at, at, -1, 0});
    births.push_back({a, b});
    for_each_list(*this, [&](auto& list) { list.resize_nodes(size()); });
    return size() - 1;
}

int BandMesh::split_edge(int a, int b, const Vec3& at) {
    const int p = size();
    nodes.push_back({at, at, -1, 0});
    births.push_back({a, b});
    for_each_list(*this, [&](auto& list) {
        list.resize_nodes(size());
        list.split(a, b, p);
    });
    // The mid-side node of a second-order edge becomes the corner: no node of the input is lost.
    if (const auto mid = mid_nodes.find(edge_key(a, b)); mid != mid_nodes.end()) {
        nodes[p].global = mid->second;
        mid_nodes.erase(mid);
    }
    return p;
}

void BandMesh::merge_node(int p, int t) {
    for_each_list(*this, [&](auto& list) { list.merge(p, t); });
}

bool BandMesh::is_cut_edge(int a, int b) const {
    return cut_edges.find({a, b}) >= 0 || std::ranges::any_of(cut_faces.around(a), [&](int s) {
               return std::ranges::find(cut_faces[s], b) != cut_faces[s].end();
           });
}

bool BandMesh::is_cut_border(int a, int b) const {
    std::map<int, int> count;
    for (const int s : cut_faces.around(a))
        if (std::ranges::find(cut_faces[s], b) != cut_faces[s].end()) ++count[cut_faces.tag(s)];
    return std::ranges::any_of(count, [](const auto& c) { return c.second == 1; });
}

void BandMesh::neighbours(int node, std::vector<int>& out) const {
    out.clear();
    // Most nodes are met several times: a small hash table on the stack finds them; the sort takes what it missed.
    std::array<int, 256> met;
    met.fill(-1);
    const auto gather = [&](const auto& list) {
        for (const int s : list.around(node))
            for (const int v : list[s]) {
                int& place = met[static_cast<unsigned>(v) * 2654435769u >> 24];
                if (v == node || v == place) continue;
                place = v;
                out.push_back(v);
            }
    };
    gather(tetras);
    gather(triangles);
    gather(lines);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
}

std::vector<int> BandMesh::nodes_near(std::vector<int> nodes, int rings) const {
    const auto tidy = [](std::vector<int>& list) {
        std::ranges::sort(list);
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    std::vector<int> around, all;
    for (tidy(nodes); rings > 0; --rings) {
        all = nodes;
        for (const int v : nodes) {
            neighbours(v, around);
            all.insert(all.end(), around.begin(), around.end());
        }
        tidy(all);
        nodes.swap(all);
    }
    return nodes;
}

double BandMesh::mean_edge_length(int node) const {
    // Every edge counts as often as elements hold it: cheaper than finding each once, and as good a scale.
    double sum = 0;
    int count = 0;
    const auto gather = [&](const auto& list) {
        for (const int s : list.around(node))
            for (const int v : list[s])
                if (v != node) {
                    sum += (nodes[v].at - nodes[node].at).norm();
                    ++count;
                }
    };
    gather(tetras);
    gather(triangles);
    if (count == 0) gather(lines);
    return count > 0 ? sum / count : 0;
}

BandMesh extract_band(const Mesh& mesh, const std::vector<std::int8_t>& level, const Adjacency* adjacency,
                      bool simplices_only) {
    BandMesh band;
    const CellLists chosen = elements_near(mesh, level, adjacency);
    check_cancelled();
    if (!simplices_only) refuse_other_elements(mesh, chosen);
    const std::vector<int> local = add_nodes(mesh, level, chosen, band);
    const Extraction of{mesh, chosen, local};
    of.fill(CellType::tetra, CellType::tetra10, band.tetras, band.tetra_cells, band);
    of.fill(CellType::triangle, CellType::triangle6, band.triangles, band.triangle_cells, band);
    of.fill(CellType::line, CellType::line3, band.lines, band.line_cells, band);
    of.fill(CellType::vertex, std::nullopt, band.vertices, band.vertex_cells, band);
    of.add_facets(band);
    return band;
}

}  // namespace femscalpel
