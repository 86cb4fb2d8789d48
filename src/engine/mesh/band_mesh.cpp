// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/band_mesh.h"

#include <map>
#include <string>

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

}  // namespace

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
    return cut_edges.find({a, b}) >= 0 ||
           std::ranges::any_of(cut_faces.around(a), [&](int s) { return std::ranges::find(cut_faces[s], b) != cut_faces[s].end(); });
}

void BandMesh::neighbours(int node, std::vector<int>& out) const {
    out.clear();
    const auto gather = [&](const auto& list) {
        for (const int s : list.around(node))
            for (const int v : list[s])
                if (v != node) out.push_back(v);
    };
    gather(tetras);
    gather(triangles);
    gather(lines);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
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

BandMesh extract_band(const Mesh& mesh, const std::vector<std::int8_t>& level) {
    BandMesh band;
    std::array<std::vector<Index>, cell_type_count> chosen;
    std::vector<int> local(mesh.points.size(), -1);
    for (const CellBlock& block : mesh.blocks()) {
        const CellTraits& t = traits(block.type);
        std::vector<Index>& cells = chosen[static_cast<int>(block.type)];
        const Index count = block.size();
        const Index* n = block.connectivity.data();
        for (Index c = 0; c < count; ++c, n += t.nodes) {
            bool near = false;
            for (int k = 0; k < t.corners; ++k) near = near || level[n[k]] >= 0;
            if (!near) continue;
            cells.push_back(c);
            for (int k = 0; k < t.corners; ++k) local[n[k]] = 0;
        }
        if (!t.simplex && !cells.empty()) {
            std::string numbers;
            for (std::size_t k = 0; k < cells.size() && k < 5; ++k) numbers += (k ? ", " : "") + std::to_string(block.ids[cells[k]]);
            if (cells.size() > 5) numbers += ", ...";
            throw UnsupportedElementError("the tool's band reaches " + std::to_string(cells.size()) + " " + std::string(t.name) +
                                          " elements (" + numbers +
                                          "); only triangles and tetrahedra can be cut. Choose a smaller transition, move the tool, "
                                          "or split these elements into tetrahedra first");
        }
    }
    for (std::size_t n = 0; n < local.size(); ++n)
        if (local[n] == 0) {
            local[n] = band.size();
            band.nodes.push_back({mesh.points[n], mesh.points[n], static_cast<Index>(n), level[n]});
        }
    for_each_list(band, [&](auto& list) { list.resize_nodes(band.size()); });

    const auto fill = [&]<std::size_t N>(SimplexList<N>& list, std::vector<CellRef>& refs, CellType type) {
        const CellBlock& block = mesh.block(type);
        const CellTraits& t = traits(type);
        for (Index c : chosen[static_cast<int>(type)]) {
            const auto n = block.nodes(c);
            std::array<int, N> v;
            for (std::size_t k = 0; k < N; ++k) v[k] = local[n[k]];
            list.add(v, 0);
            refs.push_back({type, c});
            if (t.quadratic)
                for (std::size_t e = 0; e < t.edges.size(); ++e)
                    band.mid_nodes.emplace(edge_key(v[t.edges[e][0]], v[t.edges[e][1]]), n[t.corners + static_cast<int>(e)]);
        }
    };
    fill(band.tetras, band.tetra_cells, CellType::tetra);
    fill(band.tetras, band.tetra_cells, CellType::tetra10);
    fill(band.triangles, band.triangle_cells, CellType::triangle);
    fill(band.triangles, band.triangle_cells, CellType::triangle6);
    fill(band.lines, band.line_cells, CellType::line);
    fill(band.lines, band.line_cells, CellType::line3);
    fill(band.vertices, band.vertex_cells, CellType::vertex);

    if (mesh.facets.empty()) return band;
    std::map<std::pair<CellType, Index>, int> slots;
    for (int s = 0; s < band.tetras.size(); ++s) slots.emplace(std::pair(band.tetra_cells[s].type, band.tetra_cells[s].cell), s);
    for (int s = 0; s < band.triangles.size(); ++s) slots.emplace(std::pair(band.triangle_cells[s].type, band.triangle_cells[s].cell), s);
    for (std::size_t k = 0; k < mesh.facets.size(); ++k) {
        const Facet& f = mesh.facets[k];
        const auto slot = slots.find({f.type, f.cell});
        if (slot == slots.end()) continue;
        const int tag = static_cast<int>(k);
        if (traits(f.type).dimension == 3) {
            // The table's faces of a tetrahedron have their normal inwards.
            const auto& face = traits(f.type).faces[f.face - 1];
            const auto& v = band.tetras[slot->second];
            band.facet_faces.add({v[face[0]], v[face[2]], v[face[1]]}, tag);
        } else if (f.face <= 2) {
            band.facet_sides.push_back({slot->second, tag});
        } else {
            const auto& v = band.triangles[slot->second];
            band.facet_edges.add({v[f.face - 3], v[(f.face - 2) % 3]}, tag);
        }
    }
    return band;
}

}  // namespace femscalpel
