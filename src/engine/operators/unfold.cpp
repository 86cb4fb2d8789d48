// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/unfold.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cancel.h"
#include "cutting/surface_line.h"
#include "deformation/curved_shape.h"
#include "mesh/middles.h"

namespace femscalpel {
namespace {

/// A mid-side node this far off the middle of its edge, in that's length, is on a straight one.
constexpr double straight_edge = 1e-8;

bool is_simplex_of_second_order(CellType type) { return type == CellType::tetra10 || type == CellType::triangle6; }

bool is_straight(const Mesh& mesh, const CellBlock& block, Index cell) {
    const auto n = block.nodes(cell);
    const CellTraits& t = traits(block.type);
    for (std::size_t k = 0; k < t.edges.size(); ++k) {
        const Vec3 &a = mesh.points[n[t.edges[k][0]]], &b = mesh.points[n[t.edges[k][1]]];
        if ((mesh.points[n[t.corners + k]] - (a + b) / 2).squaredNorm() >
            straight_edge * straight_edge * (a - b).squaredNorm())
            return false;
    }
    return true;
}

std::vector<Vec3> points_of(const Mesh& mesh, const CellRef& c) {
    std::vector<Vec3> out;
    for (const Index n : mesh.block(c.type).nodes(c.cell)) out.push_back(mesh.points[n]);
    return out;
}

/// Elements worse than a limit, by `ratio` of their nodes' places.
std::vector<CellRef> worse_than(const Mesh& mesh, double limit, auto ratio) {
    std::vector<CellRef> out;
    SparseCheck check(1 << 8);
    for (const CellBlock& b : mesh.blocks()) {
        if (!is_simplex_of_second_order(b.type)) continue;
        for (Index c = 0; c < b.size(); ++c) {
            check();
            const CellRef cell{b.type, c};
            if (!is_straight(mesh, b, c) && ratio(points_of(mesh, cell)) < limit) out.push_back(cell);
        }
    }
    return out;
}

/// What identifies an element in another mesh: where its nodes are.
using ElementPlaces = std::vector<std::array<double, 3>>;

ElementPlaces places_of(const Mesh& mesh, const CellRef& c) {
    ElementPlaces out;
    for (const Vec3& x : points_of(mesh, c)) out.push_back({x[0], x[1], x[2]});
    std::ranges::sort(out);
    return out;
}

/// One call of unfold().
class Straightener {
public:
    Straightener(Mesh& mesh, const std::vector<CellRef>& bad) : mesh_(mesh) {
        for (const CellRef& c : bad)
            for (const std::uint64_t edge : edges_of(c)) edges_.try_emplace(edge);
        find_around();
    }

    void run(const std::vector<CellRef>& bad) {
        for (const CellRef& c : bad)
            for (const std::uint64_t key : edges_of(c)) straighten(edges_.at(key));
    }

private:
    struct Edge {
        std::vector<CellRef> around;
        Index a = -1, b = -1, middle = -1;
        bool kept = false;
        FamilyIndex family = -1;
        std::unordered_map<Index, int> faces;  // across it: by the third node, how many solids have that face
    };

    std::vector<std::uint64_t> edges_of(const CellRef& c) const {
        const auto n = mesh_.block(c.type).nodes(c.cell);
        std::vector<std::uint64_t> out;
        for (const auto& e : traits(c.type).edges) out.push_back(mesh_edge_key(n[e[0]], n[e[1]]));
        return out;
    }

    void find_around() {
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                for (std::size_t k = 0; k < t.edges.size(); ++k) {
                    const auto found = edges_.find(mesh_edge_key(n[t.edges[k][0]], n[t.edges[k][1]]));
                    if (found == edges_.end()) continue;
                    Edge& edge = found->second;
                    edge.around.push_back({b.type, c});
                    edge.kept =
                        edge.kept || b.type != CellType::tetra10 || (edge.family >= 0 && edge.family != b.families[c]);
                    edge.family = b.families[c];
                    if (b.type != CellType::tetra10) continue;
                    edge.a = n[t.edges[k][0]];
                    edge.b = n[t.edges[k][1]];
                    edge.middle = n[t.corners + k];
                    for (std::size_t i = 0; i < 4; ++i)
                        if (n[i] != edge.a && n[i] != edge.b) ++edge.faces[n[i]];
                }
            }
        }
        for (const Facet& f : mesh_.facets) {
            if (f.family == 0 || f.type != CellType::tetra10) continue;
            const auto n = mesh_.block(f.type).nodes(f.cell);
            const auto& face = traits(f.type).faces[f.face - 1];
            for (std::size_t k = 0; k < 3; ++k)
                if (const auto found = edges_.find(mesh_edge_key(n[face[k]], n[face[(k + 1) % 3]]));
                    found != edges_.end())
                    found->second.kept = true;
        }
        for (auto& [key, edge] : edges_)
            edge.kept = edge.kept || edge.middle < 0 || mesh_.node_families[edge.middle] != 0 ||
                        std::ranges::any_of(edge.faces, [](const auto& f) { return f.second != 2; });
    }

    double worst(const Edge& edge) const {
        double out = 1;
        for (const CellRef& c : edge.around) out = std::min(out, curved_ratio(points_of(mesh_, c)));
        return out;
    }

    void straighten(const Edge& edge) {
        if (edge.kept) return;
        const Vec3 before = mesh_.points[edge.middle];
        const double was = worst(edge);
        mesh_.points[edge.middle] = (mesh_.points[edge.a] + mesh_.points[edge.b]) / 2;
        if (!(worst(edge) > was)) mesh_.points[edge.middle] = before;
    }

    Mesh& mesh_;
    std::unordered_map<std::uint64_t, Edge> edges_;
};

}  // namespace

void unfold(Mesh& joined, const std::array<const Mesh*, 2>& inputs) {
    const auto at_corners = [](const std::vector<Vec3>& points) { return curved_ratio(points); };
    const auto inside = [](const std::vector<Vec3>& points) { return integration_ratio(points); };
    const std::vector<CellRef> bad = worse_than(joined, curved_limit, at_corners);
    if (bad.empty()) return;
    // Each edge may make room for others.
    Straightener straightener(joined, bad);
    for (int round = 0; round < 2; ++round) straightener.run(bad);
    const std::vector<CellRef> folded = worse_than(joined, 1e-6, inside);
    if (folded.empty()) return;
    std::set<ElementPlaces> known;
    for (const Mesh* mesh : inputs)
        for (const CellRef& c : worse_than(*mesh, 1e-6, inside)) known.insert(places_of(*mesh, c));
    for (const CellRef& c : folded) {
        if (known.contains(places_of(joined, c))) continue;
        Vec3 middle = Vec3::Zero();
        const auto n = joined.block(c.type).nodes(c.cell);
        const int corners = traits(c.type).corners;
        for (int k = 0; k < corners; ++k) middle += joined.points[n[static_cast<std::size_t>(k)]] / corners;
        throw QualityError("a second-order element near " + point_text(middle) +
                               " would be folded where the two meet: they are too coarse there for how they are "
                               "curved. Refine both there first, or move the addition a little",
                           "other");
    }
}

}  // namespace femscalpel
