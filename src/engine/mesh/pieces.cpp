// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "cancel.h"
#include "mesh/quality.h"
#include "mesh/union_find.h"

namespace femscalpel {

namespace {

/// A set of numbers, quick to ask where they are dense.
class Numbers {
public:
    explicit Numbers(const std::vector<Index>& ids) {
        const Index largest = ids.empty() ? -1 : *std::max_element(ids.begin(), ids.end());
        if (largest < 64 * static_cast<Index>(ids.size()) + 4096) {
            flat_.resize(static_cast<std::size_t>(largest + 1));
            for (const Index id : ids)
                if (id >= 0) flat_[id] = true;
        } else {
            sparse_.insert(ids.begin(), ids.end());
        }
    }

    bool has(Index id) const {
        if (sparse_.empty()) return id >= 0 && id < static_cast<Index>(flat_.size()) && flat_[id];
        return sparse_.contains(id);
    }

private:
    std::vector<bool> flat_;
    std::unordered_set<Index> sparse_;
};

/// A mesh, some elements of which do not count, with its nodes in a numbering it may share with another.
struct Layer {
    const Mesh& mesh;
    std::vector<int> joint;                         ///< of each node; empty: its own index
    const Numbers* left_out = nullptr;              ///< of elements; null: none
    std::vector<bool> hidden;                       ///< nodes that another layer has, too; empty: none
    std::vector<std::optional<GroupIndex>> groups;  ///< of each group, what it counts as

    explicit Layer(const Mesh& m) : mesh(m) {}
    int node(Index n) const { return joint.empty() ? static_cast<int>(n) : joint[n]; }
    bool counts(Index cell_id) const { return !left_out || !left_out->has(cell_id); }
};

/// std::sort() of what is a few ascending runs, mostly.
void sort_runs(std::vector<Index>& ids) {
    auto sorted_to = std::is_sorted_until(ids.begin(), ids.end());
    for (int run = 0; sorted_to != ids.end(); ++run) {
        if (run == 8) return std::sort(ids.begin(), ids.end());
        const auto next = std::is_sorted_until(sorted_to, ids.end());
        std::inplace_merge(ids.begin(), sorted_to, next);
        sorted_to = next;
    }
}

/// Finds the pieces of layers that share a numbering of `count` nodes.
class Finder {
public:
    Finder(std::span<const Layer> layers, std::size_t count) : layers_(layers), of_node_(count, -1) {}

    std::vector<Piece> find() {
        join();
        measure();
        sort();
        list_members();
        find_groups();
        return std::move(pieces_);
    }

private:
    /// f(layer, block, element, its piece) for what counts.
    template <class Function>
    void for_each_element(Function f) {
        SparseCheck check;
        for (const Layer& layer : layers_)
            for (const CellBlock& b : layer.mesh.blocks())
                if (traits(b.type).dimension > 0)
                    for (Index c = 0; c < b.size(); ++c, check())
                        if (layer.counts(b.ids[c])) f(layer, b, c, of_node_[layer.node(b.nodes(c)[0])]);
    }

    void join() {
        UnionFind sets(of_node_.size());
        std::vector<bool> used(of_node_.size());
        for_each_element([&](const Layer& layer, const CellBlock& b, Index c, int) {
            const int first = layer.node(b.nodes(c)[0]);
            for (const Index n : b.nodes(c)) {
                used[layer.node(n)] = true;
                sets.unite(first, layer.node(n));
            }
        });
        int next = 0;
        for (int n = 0; n < static_cast<int>(of_node_.size()); ++n) {
            if (!used[n]) continue;
            const int root = sets.find(n);  // its smallest
            of_node_[n] = root == n ? next++ : of_node_[root];
        }
        pieces_.resize(next);
    }

    void measure() {
        std::vector<std::size_t> sizes(pieces_.size());
        for_each_element([&](const Layer&, const CellBlock& b, Index, int k) {
            pieces_[k].dimension = std::max(pieces_[k].dimension, traits(b.type).dimension);
            ++sizes[k];
        });
        for (std::size_t k = 0; k < sizes.size(); ++k) pieces_[k].elements.reserve(sizes[k]);
        std::vector<Vec3> middles(pieces_.size(), Vec3::Zero());  // for those whose elements have no size
        std::vector<Index> counts(pieces_.size(), 0);
        for_each_element([&](const Layer& layer, const CellBlock& b, Index c, int k) {
            Piece& piece = pieces_[k];
            if (traits(b.type).dimension < piece.dimension) return;
            const auto nodes = b.nodes(c).first(traits(b.type).corners);
            Vec3 centre = Vec3::Zero();
            for (const Index n : nodes) centre += layer.mesh.points[n];
            centre /= static_cast<double>(nodes.size());
            const double size = std::abs(cell_measure(layer.mesh, b.type, c));
            piece.measure += size;
            piece.place += size * centre;
            middles[k] += centre;
            ++counts[k];
        });
        for (std::size_t k = 0; k < counts.size(); ++k) {
            Piece& piece = pieces_[k];
            if (piece.measure > 0)
                piece.place /= piece.measure;
            else
                piece.place = middles[k] / static_cast<double>(counts[k]);
        }
    }

    void sort() {
        std::vector<int> order(pieces_.size()), place(pieces_.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
        std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
            const Piece &a = pieces_[i], &b = pieces_[j];
            return a.dimension != b.dimension ? a.dimension > b.dimension : a.measure > b.measure;
        });
        std::vector<Piece> sorted;
        sorted.reserve(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            place[order[k]] = static_cast<int>(k);
            sorted.push_back(std::move(pieces_[order[k]]));
        }
        pieces_ = std::move(sorted);
        for (int& k : of_node_)
            if (k >= 0) k = place[k];
    }

    void list_members() {
        for_each_element(
            [&](const Layer&, const CellBlock& b, Index c, int k) { pieces_[k].elements.push_back(b.ids[c]); });
        for (const Layer& layer : layers_)
            for (Index n = 0; n < layer.mesh.node_count(); ++n)
                if (layer.hidden.empty() || !layer.hidden[n])
                    if (const int k = of_node_[layer.node(n)]; k >= 0)
                        pieces_[k].nodes.push_back(layer.mesh.node_ids[n]);
        for (Piece& piece : pieces_)
            for (std::vector<Index>* ids : {&piece.elements, &piece.nodes}) sort_runs(*ids);
    }

    /// The groups of every family that is met in a piece.
    void find_groups() {
        for (const Layer& layer : layers_) {
            const Mesh& mesh = layer.mesh;
            std::vector<std::pair<int, FamilyIndex>> met;
            std::vector<int> last(mesh.families.size(), -1);  // neighbours are mostly alike
            const auto meet = [&](Index node, FamilyIndex family) {
                const int piece = of_node_[layer.node(node)];
                if (piece < 0 || family == 0 || last[family] == piece) return;
                last[family] = piece;
                met.emplace_back(piece, family);
            };
            for (Index n = 0; n < mesh.node_count(); ++n)
                if (layer.hidden.empty() || !layer.hidden[n]) meet(n, mesh.node_families[n]);
            for (const CellBlock& b : mesh.blocks())
                for (Index c = 0; c < b.size(); ++c)
                    if (layer.counts(b.ids[c])) meet(b.nodes(c)[0], b.families[c]);
            for (const Facet& f : mesh.facets)
                if (layer.counts(mesh.block(f.type).ids[f.cell])) meet(mesh.block(f.type).nodes(f.cell)[0], f.family);
            std::sort(met.begin(), met.end());
            met.erase(std::unique(met.begin(), met.end()), met.end());
            for (const auto& [piece, family] : met)
                for (const GroupIndex g : mesh.families.groups(family))
                    if (layer.groups[g]) pieces_[piece].groups.push_back(*layer.groups[g]);
        }
        for (Piece& piece : pieces_) {
            std::sort(piece.groups.begin(), piece.groups.end());
            piece.groups.erase(std::unique(piece.groups.begin(), piece.groups.end()), piece.groups.end());
        }
    }

    std::span<const Layer> layers_;
    std::vector<int> of_node_;  ///< piece of each node; -1 without an element
    std::vector<Piece> pieces_;
};

/// A layer whose groups count as those of `named` of the same name and kind.
Layer layer_of(const Mesh& mesh, const Mesh& named) {
    Layer out(mesh);
    for (const Group& g : mesh.groups) out.groups.push_back(g.hidden ? std::nullopt : named.find_group(g.name, g.kind));
    return out;
}

}  // namespace

std::vector<Piece> find_pieces(const Mesh& mesh) {
    const std::array<Layer, 1> layers{layer_of(mesh, mesh)};
    return Finder(layers, mesh.points.size()).find();
}

std::vector<Piece> find_pieces(const Mesh& mesh, const Mesh& changed, std::span<const Index> gone) {
    std::array<Layer, 2> layers{layer_of(mesh, mesh), layer_of(changed, mesh)};
    Layer &before = layers[0], &after = layers[1];
    std::vector<Index> cells(gone.begin(), gone.end());
    for (const CellBlock& b : changed.blocks()) cells.insert(cells.end(), b.ids.begin(), b.ids.end());
    const Numbers left_out(cells), nodes(changed.node_ids);
    before.left_out = &left_out;
    before.hidden.resize(mesh.points.size());
    std::unordered_map<Index, int> place;
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (nodes.has(mesh.node_ids[n])) {
            before.hidden[n] = true;
            place.emplace(mesh.node_ids[n], static_cast<int>(n));
        }
    auto count = static_cast<int>(mesh.points.size());
    for (const Index id : changed.node_ids) {
        const auto known = place.find(id);
        after.joint.push_back(known != place.end() ? known->second : count++);
    }
    return Finder(layers, static_cast<std::size_t>(count)).find();
}

}  // namespace femscalpel
