// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <span>

#include "crack_model.h"

namespace femscalpel::checks {

namespace {

/// Length, area or volume of an element or facet; of faces the area vector, too.
struct Measure {
    int dimension = 0;
    double size = 0;
    Vec3 vector = Vec3::Zero();
};

Measure measure_of_face(const Mesh& mesh, const Key3& corners, const Key3& mids) {
    const Model::Face f = make_face(mesh, corners, mids);
    const auto [vector, area] = face_area(f.corner, f.mid, f.curved);
    return {2, area, vector};
}

Measure measure_of_cell(const Mesh& mesh, CellType type, std::span<const Index> n) {
    if (is_tetra(type)) return {3, tetra_volume(mesh, type, n)};
    if (is_triangle(type))
        return measure_of_face(mesh, {n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1});
    if (is_line(type))
        return {1,
                segment_length(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n.back()], type == CellType::line3)};
    return {};
}

Measure measure_of_facet(const Mesh& mesh, const Facet& f) {
    static constexpr int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    const auto n = mesh.block(f.type).nodes(f.cell);
    if (is_tetra(f.type)) {
        const auto& k = faces[f.face - 1];
        return measure_of_face(mesh, {n[k[0]], n[k[1]], n[k[2]]}, {-1, -1, -1});
    }
    if (f.face <= 2) return measure_of_face(mesh, {n[0], n[1], n[2]}, {-1, -1, -1});
    return {2, (mesh.points[n[f.face - 3]] - mesh.points[n[(f.face - 2) % 3]]).norm()};
}

}  // namespace

std::vector<GroupSum> group_sums(const Mesh& mesh) {
    std::vector<std::array<Measure, 4>> by_dimension(mesh.groups.size());
    std::vector<GroupSum> sums(mesh.groups.size());
    for (const FamilyIndex f : mesh.node_families)
        for (const GroupIndex g : mesh.families.groups(f)) sums[g].count += mesh.groups[g].kind == GroupKind::node;
    const auto add = [&](GroupIndex g, const Measure& m) {
        ++sums[g].count;
        sums[g].dimension = std::max(sums[g].dimension, m.dimension);
        by_dimension[g][m.dimension].size += m.size;
        by_dimension[g][m.dimension].vector += m.vector;
    };
    for (const CellBlock& b : mesh.blocks()) {
        if (!is_tetra(b.type) && !is_triangle(b.type) && !is_line(b.type) && b.type != CellType::vertex) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto groups = mesh.families.groups(b.families[c]);
            if (groups.empty()) continue;
            const Measure m = measure_of_cell(mesh, b.type, b.nodes(c));
            for (const GroupIndex g : groups)
                if (mesh.groups[g].kind == GroupKind::element) add(g, m);
        }
    }
    for (const Facet& f : mesh.facets) {
        const Measure m = measure_of_facet(mesh, f);
        for (const GroupIndex g : mesh.families.groups(f.family)) add(g, m);
    }
    for (std::size_t g = 0; g < sums.size(); ++g) {
        if (mesh.groups[g].kind == GroupKind::node) continue;
        const Measure& m = by_dimension[g][sums[g].dimension];
        sums[g].measure = m.size;
        sums[g].normal_area = m.vector;
    }
    return sums;
}

}  // namespace femscalpel::checks
