// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>

#include "crack_model.h"

namespace femscalpel::checks {

std::vector<GroupSum> group_sums(const Mesh& mesh) {
    std::vector<std::array<double, 4>> measures(mesh.groups.size(), std::array<double, 4>{});
    std::vector<std::array<Vec3, 4>> vectors(
        mesh.groups.size(), std::array<Vec3, 4>{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
    std::vector<GroupSum> sums(mesh.groups.size());
    for (const FamilyIndex f : mesh.node_families)
        for (const GroupIndex g : mesh.families.groups(f)) sums[g].count += mesh.groups[g].kind == GroupKind::node;
    const auto add = [&](GroupIndex g, int dimension, double measure, const Vec3& vector) {
        ++sums[g].count;
        sums[g].dimension = std::max(sums[g].dimension, dimension);
        measures[g][dimension] += measure;
        vectors[g][dimension] += vector;
    };
    const auto face = [&](std::array<Index, 3> c, std::array<Index, 3> m) {
        const Model::Face f = make_face(mesh, c, m);
        return face_area(f.corner, f.mid, f.curved);
    };
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto groups = mesh.families.groups(b.families[c]);
            if (groups.empty()) continue;
            const auto n = b.nodes(c);
            double measure = 0;
            Vec3 vector = Vec3::Zero();
            int dimension = 0;
            if (is_tetra(b.type)) {
                dimension = 3;
                measure = tetra_volume(mesh, b.type, n);
            } else if (is_triangle(b.type)) {
                dimension = 2;
                std::tie(vector, measure) =
                    face({n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1});
            } else if (is_line(b.type)) {
                dimension = 1;
                measure = segment_length(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n.back()],
                                         b.type == CellType::line3);
            } else if (b.type != CellType::vertex) {
                continue;
            }
            for (const GroupIndex g : groups)
                if (mesh.groups[g].kind == GroupKind::element) add(g, dimension, measure, vector);
        }
    for (const Facet& f : mesh.facets) {
        const auto n = mesh.block(f.type).nodes(f.cell);
        double measure;
        Vec3 vector = Vec3::Zero();
        if (is_tetra(f.type)) {
            static constexpr int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
            const auto& k = faces[f.face - 1];
            std::tie(vector, measure) = face({n[k[0]], n[k[1]], n[k[2]]}, {-1, -1, -1});
        } else if (f.face <= 2) {
            std::tie(vector, measure) = face({n[0], n[1], n[2]}, {-1, -1, -1});
        } else {
            measure = (mesh.points[n[f.face - 3]] - mesh.points[n[(f.face - 2) % 3]]).norm();
        }
        for (const GroupIndex g : mesh.families.groups(f.family)) add(g, 2, measure, vector);
    }
    for (std::size_t g = 0; g < sums.size(); ++g) {
        if (mesh.groups[g].kind == GroupKind::node) continue;
        sums[g].measure = measures[g][sums[g].dimension];
        sums[g].normal_area = vectors[g][sums[g].dimension];
    }
    return sums;
}

}  // namespace femscalpel::checks
