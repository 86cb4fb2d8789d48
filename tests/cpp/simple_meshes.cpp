// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simple_meshes.h"

#include <array>
#include <map>

namespace femscalpel::checks {

Mesh grid(int nx, int ny, int nz) {
    Mesh mesh;
    const auto node = [&](int i, int j, int k) { return static_cast<Index>((k * (ny + 1) + j) * (nx + 1) + i); };
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i) mesh.add_node(Vec3(i, j, k), 10 + mesh.node_count());
    constexpr int paths[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    Index number = 100;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                for (const auto& path : paths) {
                    std::array<int, 3> at{i, j, k};
                    std::array<Index, 4> n;
                    n[0] = node(i, j, k);
                    for (int step = 0; step < 3; ++step) {
                        ++at[path[step]];
                        n[step + 1] = node(at[0], at[1], at[2]);
                    }
                    const auto& p = mesh.points;
                    if ((p[n[1]] - p[n[0]]).cross(p[n[2]] - p[n[0]]).dot(p[n[3]] - p[n[0]]) < 0) std::swap(n[2], n[3]);
                    mesh.add_cell(CellType::tetra, n, number++);
                }
    return mesh;
}

void add_plate(Mesh& mesh, const Vec3& origin, const Vec3& x, const Vec3& y, int nx, int ny, FamilyIndex family) {
    const auto node = [&](int i, int j) {
        const Vec3 at = origin + i * x + j * y;
        for (std::size_t n = 0; n < mesh.points.size(); ++n)
            if ((mesh.points[n] - at).norm() < 1e-12) return static_cast<Index>(n);
        return mesh.add_node(at, mesh.largest_node_id() + 1);
    };
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const Index a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
            mesh.add_cell(CellType::triangle, std::array{a, b, c}, mesh.largest_cell_id() + 1, family);
            mesh.add_cell(CellType::triangle, std::array{a, c, d}, mesh.largest_cell_id() + 1, family);
        }
}

Mesh bricks(int nx, int ny, int nz) {
    Mesh mesh;
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i) mesh.add_node(Vec3(i, j, k), mesh.node_count() + 1);
    const auto at = [&](int i, int j, int k) -> Index { return i + (nx + 1) * (j + (ny + 1) * k); };
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                mesh.add_cell(CellType::hexahedron,
                              std::array<Index, 8>{at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
                                                   at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1),
                                                   at(i, j + 1, k + 1)},
                              mesh.cell_count() + 1);
    return mesh;
}

Mesh quadrangles(int nx, int ny) {
    Mesh mesh;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) mesh.add_node(Vec3(i, j, 0), mesh.node_count() + 1);
    for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) {
            const Index a = i + (nx + 1) * j, b = a + nx + 1;
            mesh.add_cell(CellType::quad, std::array<Index, 4>{a, a + 1, b + 1, b}, mesh.cell_count() + 1);
        }
    return mesh;
}

Mesh two_halves() {
    Mesh mesh = grid(2, 2, 2);
    const FamilyIndex left = family_of(mesh, "LEFT", GroupKind::element),
                      right = family_of(mesh, "RIGHT", GroupKind::element);
    CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c) {
        double x = 0;
        for (const Index n : tetras.nodes(c)) x += mesh.points[n][0] / 4;
        tetras.families[c] = x < 1 ? left : right;
    }
    return mesh;
}

Mesh second_order(const Mesh& mesh) {
    Mesh out = mesh;
    std::map<std::pair<Index, Index>, Index> mids;
    for (const auto& [linear, quadratic] :
         {std::pair(CellType::triangle, CellType::triangle6), std::pair(CellType::tetra, CellType::tetra10)}) {
        CellBlock& b = out.block(linear);
        for (Index c = 0; c < b.size(); ++c) {
            std::vector<Index> nodes(b.nodes(c).begin(), b.nodes(c).end());
            for (const auto& e : traits(quadratic).edges) {
                const std::pair<Index, Index> ends = std::minmax(nodes[e[0]], nodes[e[1]]);
                if (!mids.contains(ends))
                    mids[ends] =
                        out.add_node((out.points[ends.first] + out.points[ends.second]) / 2, out.largest_node_id() + 1);
                nodes.push_back(mids[ends]);
            }
            out.add_cell(quadratic, nodes, b.ids[c], b.families[c]);
        }
        b.connectivity.clear();
        b.ids.clear();
        b.families.clear();
    }
    return out;
}

FamilyIndex family_of(Mesh& mesh, const char* name, GroupKind kind) {
    return mesh.families.with(0, mesh.add_group(name, kind));
}

Index number_near(const Mesh& mesh, const Vec3& at) {
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if ((mesh.points[n] - at).norm() < 1e-9) return static_cast<Index>(n);
    throw Error("no node there");
}

std::vector<Index> members(const Mesh& mesh, const char* name, GroupKind kind) {
    return group_members(mesh, *mesh.find_group(name, kind)).ids;
}

Mesh touching_tetrahedra() {
    Mesh mesh;
    const Vec3 at[] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, -2}};
    const Index numbers[] = {1, 2, 3, 4, 11, 12, 13, 14};
    for (int n = 0; n < 8; ++n) mesh.add_node(at[n], numbers[n]);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{4, 6, 5, 7}, 2);
    return mesh;
}

}  // namespace femscalpel::checks
