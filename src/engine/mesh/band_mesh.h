// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/mesh.h"
#include "mesh/rows.h"

namespace femscalpel {

/// Simplices of one dimension over local nodes, with node adjacency kept up to date while edges are
/// split. `origin` is the slot of the ancestor a simplex was split from (its own slot if original).
template <std::size_t N>
class SimplexList {
public:
    using Nodes = std::array<int, N>;

    int size() const { return static_cast<int>(nodes_.size()); }
    const Nodes& operator[](int s) const { return nodes_[s]; }
    /// False for a simplex that merge() or remove() took out; its nodes must not be used any more.
    bool alive(int s) const { return origin_[s] >= 0; }
    int origin(int s) const { return origin_[s]; }
    int tag(int s) const { return tag_[s]; }
    void set_tag(int s, int tag) { tag_[s] = tag; }
    /// Whether merge() gave it another node: it is not the input's, though all its nodes may be.
    bool merged(int s) const { return s < static_cast<int>(merged_.size()) && merged_[s] != 0; }
    /// Slots of the simplices at a node. Not to be kept while simplices are added, split or merged.
    std::span<const int> around(int node) const { return around_[node]; }

    void resize_nodes(int count) { around_.resize(static_cast<std::size_t>(count)); }

    /// Takes all simplices of an empty list over `node_count` nodes at once, with tag 0: cheaper than one by one.
    void assign(std::vector<Nodes> nodes, int node_count) {
        nodes_ = std::move(nodes);
        origin_.resize(nodes_.size());
        std::iota(origin_.begin(), origin_.end(), 0);
        tag_.assign(nodes_.size(), 0);
        std::vector<int> counts(static_cast<std::size_t>(node_count), 0);
        for (const Nodes& simplex : nodes_)
            for (const int v : simplex) ++counts[v];
        around_.reserve(counts);
        for (int s = 0; s < size(); ++s)
            for (const int v : nodes_[s]) around_.add(v, s);
    }

    int add(const Nodes& nodes, int tag) {
        const int s = size();
        nodes_.push_back(nodes);
        origin_.push_back(s);
        tag_.push_back(tag);
        for (int v : nodes) around_.add(v, s);
        return s;
    }

    /// Adds a further part of the simplex in slot `of`, whose origin and tag it inherits.
    int add_part(const Nodes& nodes, int of) {
        const int s = add(nodes, tag_[of]);
        origin_[s] = origin_[of];
        merged_.resize(nodes_.size(), 0);
        merged_[s] = 1;
        return s;
    }

    /// Bisects every simplex that holds nodes a and b at node p. The part with a stays in its slot, the
    /// part with b gets a new one and inherits origin and tag. Orientation is kept.
    void split(int a, int b, int p) {
        // The slots around a stay the same; only those around b and the opposite nodes change.
        const auto count = around_[a].size();
        for (std::size_t k = 0; k < count; ++k) {
            const int s = around_[a][k];
            if (std::ranges::find(nodes_[s], b) == nodes_[s].end()) continue;
            Nodes child = nodes_[s];
            std::ranges::replace(child, a, p);
            std::ranges::replace(nodes_[s], b, p);
            const int c = size();
            nodes_.push_back(child);
            origin_.push_back(origin_[s]);
            tag_.push_back(tag_[s]);
            around_.replace(b, s, c);
            around_.add(p, s);
            for (int v : child)
                if (v != b) around_.add(v, c);
        }
    }

    /// Moves node p onto its neighbour t: simplices with both vanish, in the others t takes p's place.
    void merge(int p, int t) {
        const auto count = around_[p].size();
        for (std::size_t k = 0; k < count; ++k) {
            const int s = around_[p][k];
            if (std::ranges::find(nodes_[s], t) != nodes_[s].end()) {
                for (int v : nodes_[s])
                    if (v != p) around_.remove(v, s);
                origin_[s] = -1;
            } else {
                std::ranges::replace(nodes_[s], p, t);
                around_.add(t, s);
                merged_.resize(nodes_.size(), 0);
                merged_[s] = 1;
            }
        }
        around_.clear(p);
    }

    /// Takes a simplex out for good.
    void remove(int s) {
        for (const int v : nodes_[s]) around_.remove(v, s);
        origin_[s] = -1;
    }

    /// Slot of a simplex with exactly these nodes in any order, or -1.
    int find(const Nodes& wanted) const {
        for (const int s : around_[wanted[0]])
            if (std::ranges::all_of(wanted, [&](int v) { return std::ranges::find(nodes_[s], v) != nodes_[s].end(); }))
                return s;
        return -1;
    }

private:
    std::vector<Nodes> nodes_;
    std::vector<int> origin_;
    std::vector<int> tag_;
    std::vector<char> merged_;  // by slot, not of all
    Rows around_;
};

/// Faces of a tetrahedron by places of its corners, normals outwards.
inline constexpr int outward_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
/// The face opposite each corner, its normal towards the corner.
inline constexpr int opposite_face[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/// Undirected edge as a 64-bit key.
inline std::uint64_t edge_key(int a, int b) {
    if (a > b) std::swap(a, b);
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
}

/// A node of a BandMesh.
struct BandNode {
    Vec3 at;            ///< where it is now
    Vec3 start;         ///< where it was in the input, or where it was born
    Index global = -1;  ///< index in the input mesh; -1 for a node born here
    int level = 0;      ///< how many edges away from the tool's elements; -1 for the fixed outer ring
    bool gone = false;  ///< all its elements were removed
    bool movable() const { return level >= 0; }
};

/// The part of a mesh near a tool, by corner nodes, made to be changed: moved and split. It holds every
/// element with at least one node of the band, so all elements around a movable node are present.
///
/// `tetras`, `triangles`, `lines` are elements (tag: index into `cells` of the list); `skin` and `creases`
/// are faces and edges of the geometry to be kept (tag: surface or curve of NodeConstraints), split along.
class BandMesh {
public:
    std::vector<BandNode> nodes;
    SimplexList<4> tetras;
    SimplexList<3> triangles;
    SimplexList<2> lines;
    SimplexList<1> vertices;
    SimplexList<3> skin;
    SimplexList<2> creases;
    SimplexList<3> cut_faces;    ///< faces made to lie on a tool (tag: which surface of the operator)
    SimplexList<2> cut_edges;    ///< edges of shells likewise
    SimplexList<3> facet_faces;  ///< facets of tetrahedra, normal out of their element (tag: index in Mesh::facets)
    SimplexList<2> facet_edges;  ///< facets on edges of triangles, in their direction (tag likewise)
    std::vector<std::pair<int, int>> facet_sides;  ///< facets that are a whole side of a triangle: (slot, index)
    std::vector<CellRef> tetra_cells;              ///< by slot of the original element
    std::vector<CellRef> triangle_cells;
    std::vector<CellRef> line_cells;
    std::vector<CellRef> vertex_cells;

    /// Mid-side node of the input mesh on an edge between two nodes of the input mesh, if quadratic; and those whose
    /// edge was split and is gone (NodeMerger), each on another edge, one with a node born here.
    std::unordered_map<std::uint64_t, Index> mid_nodes;

    /// Whether the mid-side node of the edge a-b, if it has one, was that of another edge in the input.
    bool is_handed_over(int a, int b) const { return is_new(a) || is_new(b); }

    /// The ends of the edge a node was born on, by node minus original_nodes().
    struct Birth {
        int a;
        int b;
    };
    std::vector<Birth> births;

    int size() const { return static_cast<int>(nodes.size()); }

    /// False for a node born here that was merged away again, and for one without elements left.
    bool in_use(int node) const {
        if (nodes[node].gone) return false;
        return !is_new(node) || !tetras.around(node).empty() || !triangles.around(node).empty();
    }
    int original_nodes() const { return size() - static_cast<int>(births.size()); }
    bool is_new(int node) const { return node >= original_nodes(); }
    /// Whether an element of `tetras` or `triangles` has other corners than in the input, or they are elsewhere.
    bool is_changed(const auto& list, int slot) const {
        return list.merged(slot) ||
               std::ranges::any_of(list[slot], [&](int v) { return is_new(v) || nodes[v].at != nodes[v].start; });
    }

    /// Whether a-b is an edge of `cut_faces` or `cut_edges`.
    bool is_cut_edge(int a, int b) const;

    /// Whether, of the `cut_faces` of some tag, only one is at the edge a-b.
    bool is_cut_border(int a, int b) const;

    /// Adds a node that is on no edge and has no elements yet, and returns it; it counts as born between a and b.
    int add_node(const Vec3& at, int a, int b);

    /// Splits the edge a-b in every list at a new node and returns it.
    int split_edge(int a, int b, const Vec3& at);

    /// Removes node p by moving it onto its neighbour t, in every list.
    void merge_node(int p, int t);

    /// Nodes joined to `node` by an edge of an element (tetrahedron, triangle or segment), each once.
    void neighbours(int node, std::vector<int>& out) const;

    /// The nodes within so many edges of some, ascending.
    std::vector<int> nodes_near(std::vector<int> nodes, int rings) const;

    /// Mean length of the edges at a node.
    double mean_edge_length(int node) const;
};

/// Copies the elements of `mesh` that have a node with 0 <= level[node]; `level` is -1 elsewhere. One pass over the
/// elements, unless their `adjacency` is given.
/// Throws UnsupportedElementError naming the elements when one of them is not a simplex, or leaves them out if
/// `simplices_only`.
BandMesh extract_band(const Mesh& mesh, const std::vector<std::int8_t>& level, const Adjacency* adjacency = nullptr,
                      bool simplices_only = false);

}  // namespace femscalpel
