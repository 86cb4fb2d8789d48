// SPDX-License-Identifier: LGPL-2.1-or-later
#include "random_groups.h"

#include <algorithm>
#include <array>

namespace femscalpel::checks {

void add_cells(Mesh& mesh, CellType type, const std::vector<std::vector<Index>>& cells) {
    for (const auto& c : cells) mesh.add_cell(type, c, mesh.largest_cell_id() + 1);
}

Mesh random_mesh(std::mt19937& rng, int dimension, int n, double attached) {
    const auto chance = [&](double p) { return std::bernoulli_distribution(p)(rng); };
    Mesh mesh;
    const Index m = n + 1;
    for (Index k = 0; k < (dimension == 3 ? m : 1); ++k)
        for (Index j = 0; j < m; ++j)
            for (Index i = 0; i < m; ++i) mesh.add_node({double(i), double(j), double(k)}, 1000 - mesh.node_count());
    // Sheared and stretched at random: no element is like another model's, and what is flat stays flat.
    Eigen::Matrix3d shape = Eigen::Matrix3d::Identity();
    for (int r = 0; r < dimension; ++r)
        for (int c = 0; c < dimension; ++c) shape(r, c) += std::uniform_real_distribution(-0.25, 0.25)(rng);
    for (Vec3& x : mesh.points) x = shape * x;
    std::vector<std::vector<Index>> cells;
    const Index step[3] = {1, m, m * m};
    for (Index k = 0; k < (dimension == 3 ? n : 1); ++k)
        for (Index j = 0; j < n; ++j)
            for (Index i = 0; i < n; ++i) {
                const Index low = i + m * j + m * m * k;
                std::array<int, 3> order{0, 1, 2};
                do {
                    if (dimension == 2 && order[2] != 2) continue;
                    std::vector<Index> nodes{low};
                    for (int d = 0; d < dimension; ++d) nodes.push_back(nodes.back() + step[order[d]]);
                    const bool odd = (order[0] > order[1]) ^ (order[0] > order[2]) ^ (order[1] > order[2]);
                    if (odd) std::swap(nodes[1], nodes[2]);
                    if (chance(0.9)) cells.push_back(nodes);
                } while (std::ranges::next_permutation(order).found);
            }
    add_cells(mesh, dimension == 3 ? CellType::tetra : CellType::triangle, cells);
    std::set<Nodes> faces, edges;
    for (const auto& c : cells)
        for (const Index a : c)
            for (const Index b : c) {
                if (a < b && chance(0.3 * attached)) edges.insert({a, b});
                for (const Index d : c)
                    if (dimension == 3 && a < b && b < d && chance(0.5 * attached)) faces.insert({a, b, d});
            }
    for (const Nodes& f : faces) add_cells(mesh, CellType::triangle, {{f.begin(), f.end()}});
    for (const Nodes& e : edges) add_cells(mesh, CellType::line, {{e.begin(), e.end()}});
    for (Index v = 0; v < mesh.node_count(); v += 7) add_cells(mesh, CellType::vertex, {{v}});
    return mesh;
}

void add_random_groups(std::mt19937& rng, Mesh& mesh, int count) {
    std::uniform_real_distribution<double> u(0, 1);
    for (int k = 0; k < count; ++k) {
        const auto kind = static_cast<GroupKind>(k % 3);
        const int dimension = std::uniform_int_distribution(0, 4)(rng);  // of elements; 4: all
        const double size = mesh.points.back().norm(), radius = size * (0.2 + 0.6 * u(rng)),
                     p = u(rng) < 0.5 ? 0.95 : 0.6;
        const Vec3 centre = mesh.points[std::uniform_int_distribution<Index>(0, mesh.node_count() - 1)(rng)];
        const auto take = [&](Index n) { return (mesh.points[n] - centre).norm() < radius && u(rng) < p; };
        GroupMembers members{kind, {}, {}};
        if (kind == GroupKind::node)
            for (Index n = 0; n < mesh.node_count(); ++n)
                if (take(n)) members.ids.push_back(mesh.node_ids[n]);
        for (const CellBlock& b : mesh.blocks())
            for (Index c = 0; c < b.size(); ++c) {
                const CellTraits& t = traits(b.type);
                if (kind == GroupKind::element && (dimension == 4 || t.dimension == dimension) && take(b.nodes(c)[0]))
                    members.ids.push_back(b.ids[c]);
                if (kind == GroupKind::facet && t.dimension >= 2)
                    for (Index f = 1; f <= (t.dimension == 3 ? 4 : 5); ++f)
                        if (take(b.nodes(c)[0])) {
                            members.ids.push_back(b.ids[c]);
                            members.faces.push_back(f);
                        }
            }
        set_group_members(mesh, mesh.add_group("G" + std::to_string(k), kind), members);
    }
}

std::set<Nodes> subsets(const Nodes& nodes, std::size_t size) {
    std::set<Nodes> out;
    const std::vector<Index> v(nodes.begin(), nodes.end());
    for (unsigned mask = 0; mask < (1u << v.size()); ++mask) {
        Nodes s;
        for (std::size_t k = 0; k < v.size(); ++k)
            if (mask >> k & 1) s.insert(v[k]);
        if (s.size() == size) out.insert(s);
    }
    return out;
}

bool contains(const Nodes& all, const Nodes& part) { return std::ranges::includes(all, part); }

Expected slow_boundary(const Mesh& mesh, GroupIndex group) {
    const auto d = static_cast<std::size_t>(mesh.dimension());
    std::set<Nodes> by_size[5], members;
    const GroupMembers m = group_members(mesh, group);
    const std::set<Index> ids(m.ids.begin(), m.ids.end());
    for (Index n = 0; n < mesh.node_count(); ++n) by_size[1].insert({n});  // also one without elements
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const Nodes cell(b.nodes(c).begin(), b.nodes(c).end());
            for (std::size_t s = 1; s <= cell.size(); ++s)
                for (const Nodes& sub : subsets(cell, s)) by_size[s].insert(sub);
            if (m.kind == GroupKind::element && ids.contains(b.ids[c])) members.insert(cell);
            for (std::size_t k = 0; k < m.ids.size(); ++k) {
                if (m.kind != GroupKind::facet || m.ids[k] != b.ids[c]) continue;
                const auto n = b.nodes(c);
                if (n.size() == 4) {
                    constexpr int table[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
                    const auto& f = table[m.faces[k] - 1];
                    members.insert({n[f[0]], n[f[1]], n[f[2]]});
                } else if (m.faces[k] <= 2) {
                    members.insert(cell);
                } else {
                    members.insert({n[m.faces[k] - 3], n[(m.faces[k] - 2) % 3]});
                }
            }
        }
    std::set<Nodes> belongs;
    for (std::size_t s = 1; s <= d + 1; ++s)
        for (const Nodes& e : by_size[s]) {
            const auto all = [&](std::size_t size) {
                return std::ranges::all_of(subsets(e, size), [&](const Nodes& sub) { return belongs.contains(sub); });
            };
            bool in = members.contains(e);
            if (m.kind == GroupKind::node)
                in = std::ranges::all_of(e, [&](Index n) { return ids.contains(mesh.node_ids[n]); });
            else if (s >= 3)
                in = in || all(s - 1);  // faces from edges, volumes from faces
            if (in) belongs.insert(e);
        }
    Expected out;
    for (const Nodes& e : belongs)
        if (e.size() == d + 1) out.area.insert(e);
    for (const Nodes& side : by_size[d])
        if (std::ranges::count_if(out.area, [&](const Nodes& a) { return contains(a, side); }) == 1)
            out.bounding.insert(side);
    const auto covered = [&](const std::set<Nodes>& by, const Nodes& e) {
        return std::ranges::any_of(by, [&](const Nodes& larger) { return contains(larger, e); });
    };
    for (std::size_t s = d; s >= 1; --s)
        for (const Nodes& e : belongs) {
            if (e.size() != s || covered(out.area, e)) continue;
            if (s == 3) out.linking_faces.insert(e);
            if (s == 2 && !covered(out.linking_faces, e)) out.linking_edges.insert(e);
            if (s == 1 && !covered(out.linking_faces, e) && !covered(out.linking_edges, e))
                out.isolated.insert(*e.begin());
        }
    return out;
}

}  // namespace femscalpel::checks
