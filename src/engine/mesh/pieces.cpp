// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cancel.h"
#include "mesh/quality.h"
#include "mesh/union_find.h"

namespace femscalpel {

namespace {

std::vector<const CellBlock*> blocks_with_extent(const Mesh& mesh) {
    std::vector<const CellBlock*> out;
    for (const CellBlock& b : mesh.blocks())
        if (b.size() > 0 && traits(b.type).dimension > 0) out.push_back(&b);
    return out;
}

/// For each node the piece it is in, numbered by their first nodes; -1 for nodes without elements.
std::vector<int> joined_nodes(Index count, const std::vector<const CellBlock*>& blocks) {
    UnionFind sets(static_cast<std::size_t>(count));
    std::vector<bool> used(static_cast<std::size_t>(count));
    SparseCheck check;
    for (const CellBlock* b : blocks)
        for (Index c = 0; c < b->size(); ++c, check())
            for (const Index n : b->nodes(c)) {
                used[n] = true;
                sets.unite(static_cast<int>(b->nodes(c)[0]), static_cast<int>(n));
            }
    std::vector<int> out(static_cast<std::size_t>(count), -1);
    int next = 0;
    for (int n = 0; n < static_cast<int>(count); ++n) {
        if (!used[n]) continue;
        const int root = sets.find(n);  // its smallest
        out[n] = root == n ? next++ : out[root];
    }
    return out;
}

/// Counts, sizes and centres of the pieces.
void measure_pieces(const Mesh& mesh, const std::vector<const CellBlock*>& blocks, Pieces& pieces) {
    for (const CellBlock* b : blocks)
        for (Index c = 0; c < b->size(); ++c) {
            Piece& piece = pieces.list[pieces.of_node[b->nodes(c)[0]]];
            ++piece.elements;
            piece.dimension = std::max(piece.dimension, traits(b->type).dimension);
        }
    std::vector<Vec3> middles(pieces.list.size(), Vec3::Zero());  // where all elements have no size
    std::vector<Index> counts(pieces.list.size(), 0);
    SparseCheck check;
    for (const CellBlock* b : blocks)
        for (Index c = 0; c < b->size(); ++c, check()) {
            const auto nodes = b->nodes(c).first(traits(b->type).corners);
            const int k = pieces.of_node[nodes[0]];
            Piece& piece = pieces.list[k];
            if (traits(b->type).dimension < piece.dimension) continue;
            Vec3 centre = Vec3::Zero();
            for (const Index n : nodes) centre += mesh.points[n];
            centre /= static_cast<double>(nodes.size());
            const double size = std::abs(cell_measure(mesh, b->type, c));
            piece.measure += size;
            piece.place += size * centre;
            middles[k] += centre;
            ++counts[k];
        }
    for (std::size_t k = 0; k < counts.size(); ++k) {
        Piece& piece = pieces.list[k];
        piece.place =
            piece.measure > 0 ? Vec3(piece.place / piece.measure) : Vec3(middles[k] / static_cast<double>(counts[k]));
    }
}

void sort_pieces(Pieces& pieces) {
    std::vector<int> order(pieces.list.size()), place(pieces.list.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
        const Piece &a = pieces.list[i], &b = pieces.list[j];
        return a.dimension != b.dimension ? a.dimension > b.dimension : a.measure > b.measure;
    });
    std::vector<Piece> sorted;
    sorted.reserve(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        place[order[k]] = static_cast<int>(k);
        sorted.push_back(std::move(pieces.list[order[k]]));
    }
    pieces.list = std::move(sorted);
    for (int& k : pieces.of_node)
        if (k >= 0) k = place[k];
}

/// The groups of each piece: of each family that is met there once.
void find_groups(const Mesh& mesh, Pieces& pieces) {
    const auto family_count = static_cast<std::size_t>(mesh.families.size());
    std::vector<std::pair<int, FamilyIndex>> met;
    std::vector<int> last(family_count, -1);  // most neighbours are alike
    const auto meet = [&](int piece, FamilyIndex family) {
        if (piece < 0 || family == 0 || last[family] == piece) return;
        last[family] = piece;
        met.emplace_back(piece, family);
    };
    for (std::size_t n = 0; n < pieces.of_node.size(); ++n) meet(pieces.of_node[n], mesh.node_families[n]);
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) meet(pieces.of_node[b.nodes(c)[0]], b.families[c]);
    for (const Facet& f : mesh.facets) meet(pieces.of_node[mesh.block(f.type).nodes(f.cell)[0]], f.family);
    std::sort(met.begin(), met.end());
    met.erase(std::unique(met.begin(), met.end()), met.end());
    for (const auto& [piece, family] : met)
        for (const GroupIndex g : mesh.families.groups(family))
            if (!mesh.groups[g].hidden) pieces.list[piece].groups.push_back(g);
    for (Piece& piece : pieces.list) {
        std::sort(piece.groups.begin(), piece.groups.end());
        piece.groups.erase(std::unique(piece.groups.begin(), piece.groups.end()), piece.groups.end());
    }
}

}  // namespace

Pieces find_pieces(const Mesh& mesh) {
    const std::vector<const CellBlock*> blocks = blocks_with_extent(mesh);
    Pieces pieces;
    pieces.of_node = joined_nodes(mesh.node_count(), blocks);
    const auto last = std::max_element(pieces.of_node.begin(), pieces.of_node.end());
    pieces.list.resize(last == pieces.of_node.end() ? 0 : static_cast<std::size_t>(*last + 1));
    measure_pieces(mesh, blocks, pieces);
    sort_pieces(pieces);
    find_groups(mesh, pieces);
    return pieces;
}

}  // namespace femscalpel
