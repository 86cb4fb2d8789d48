// SPDX-License-Identifier: LGPL-2.1-or-later
#include "elements_by_hand.h"

#include <cmath>

namespace femscalpel::checks {

int corners_of(CellType type) {
    switch (type) {
        case CellType::vertex:
            return 1;
        case CellType::line:
        case CellType::line3:
            return 2;
        case CellType::triangle:
        case CellType::triangle6:
            return 3;
        default:
            return 4;
    }
}

int mid_of(CellType type, int a, int b) {
    if (type == CellType::line3) return 2;
    if (type == CellType::triangle6) return a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
    for (int k = 0; k < 6; ++k)
        if (std::minmax(edges_of_tetra[k][0], edges_of_tetra[k][1]) == std::minmax(a, b)) return 4 + k;
    return -1;
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6;
}

double jacobian(const std::array<Vec3, 10>& p, double r, double s, double t) {
    const double u = 1 - r - s - t;
    // Derivatives of u(2u-1), r(2r-1), s(2s-1), t(2t-1), 4ur, 4rs, 4su, 4ut, 4rt, 4st.
    const double dr[10] = {1 - 4 * u, 4 * r - 1, 0, 0, 4 * (u - r), 4 * s, -4 * s, -4 * t, 4 * t, 0};
    const double ds[10] = {1 - 4 * u, 0, 4 * s - 1, 0, -4 * r, 4 * r, 4 * (u - s), -4 * t, 0, 4 * t};
    const double dt[10] = {1 - 4 * u, 0, 0, 4 * t - 1, -4 * r, 0, -4 * s, 4 * (u - t), 4 * r, 4 * s};
    Vec3 x = Vec3::Zero(), y = Vec3::Zero(), z = Vec3::Zero();
    for (int k = 0; k < 10; ++k) {
        x += dr[k] * p[k];
        y += ds[k] * p[k];
        z += dt[k] * p[k];
    }
    return x.cross(y).dot(z);
}

OnFace on_face(const std::array<Vec3, 3>& c, const std::array<Vec3, 3>& m, double u, double v) {
    const double w = 1 - u - v;
    return {w * (2 * w - 1) * c[0] + u * (2 * u - 1) * c[1] + v * (2 * v - 1) * c[2] + 4 * u * w * m[0] +
                4 * u * v * m[1] + 4 * v * w * m[2],
            (1 - 4 * w) * c[0] + (4 * u - 1) * c[1] + 4 * (w - u) * m[0] + 4 * v * m[1] - 4 * v * m[2],
            (1 - 4 * w) * c[0] + (4 * v - 1) * c[2] - 4 * u * m[0] + 4 * u * m[1] + 4 * (w - v) * m[2]};
}

double flat_area(const std::array<Vec3, 3>& c) { return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2; }

std::pair<Vec3, double> face_area(const std::array<Vec3, 3>& c, const std::array<Vec3, 3>& m, bool curved) {
    if (!curved) {
        const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]) / 2;
        return {n, n.norm()};
    }
    // Dunavant's rule of degree 4.
    static const double a = 0.445948490915965, b = 0.091576213509771, wa = 0.223381589678011 / 2,
                        wb = 0.109951743655322 / 2;
    Vec3 vector = Vec3::Zero();
    double area = 0;
    for (const auto& [p, weight] : {std::pair{a, wa}, std::pair{b, wb}})
        for (const auto& [u, v] : {std::pair{p, p}, std::pair{1 - 2 * p, p}, std::pair{p, 1 - 2 * p}}) {
            const OnFace x = on_face(c, m, u, v);
            const Vec3 n = x.du.cross(x.dv);
            vector += weight * n;
            area += weight * n.norm();
        }
    return {vector, area};
}

double segment_length(const Vec3& a, const Vec3& b, const Vec3& mid, bool curved) {
    if (!curved) return (b - a).norm();
    double length = 0;
    for (const auto& [x, weight] :
         {std::pair{-std::sqrt(0.6), 5.0 / 9}, std::pair{0.0, 8.0 / 9}, std::pair{std::sqrt(0.6), 5.0 / 9}})
        length += weight * ((x - 0.5) * a + (x + 0.5) * b - 2 * x * mid).norm();
    return length;
}

double tetra_volume(const Mesh& mesh, CellType type, std::span<const Index> n) {
    std::array<Vec3, 10> p;
    for (std::size_t k = 0; k < n.size(); ++k) p[k] = mesh.points[n[k]];
    if (type == CellType::tetra) return volume(p[0], p[1], p[2], p[3]);
    // Five points, degree 3: exact for this Jacobian.
    double sum = -0.8 * jacobian(p, 0.25, 0.25, 0.25);
    const double a = 1.0 / 6, b = 0.5;
    for (const auto& [r, s, t] : {std::array{a, a, a}, std::array{b, a, a}, std::array{a, b, a}, std::array{a, a, b}})
        sum += 0.45 * jacobian(p, r, s, t);
    return sum / 6;
}

double tetra_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double v = volume(a, b, c, d);
    const double sum = (a - b).squaredNorm() + (a - c).squaredNorm() + (a - d).squaredNorm() + (b - c).squaredNorm() +
                       (b - d).squaredNorm() + (c - d).squaredNorm();
    return std::copysign(12 * std::pow(3 * std::abs(v), 2.0 / 3) / sum, v);
}

double triangle_shape(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = (b - a).cross(c - a).norm() / 2;
    return 4 * std::sqrt(3.0) * area / ((a - b).squaredNorm() + (b - c).squaredNorm() + (c - a).squaredNorm());
}

std::vector<TetraFace> tetra_faces(const Mesh& mesh) {
    std::vector<TetraFace> faces;
    for_each_cell(mesh, is_tetra, [&](CellType type, Index c, std::span<const Index> n) {
        for (const auto& f : outward_faces) {
            TetraFace face{{}, {n[f[0]], n[f[1]], n[f[2]]}, {-1, -1, -1}, {type, c}};
            face.key = ascending(face.outward);
            if (type == CellType::tetra10)
                for (int k = 0; k < 3; ++k) face.mid[k] = n[mid_of(type, f[k], f[(k + 1) % 3])];
            faces.push_back(face);
        }
    });
    std::ranges::sort(faces, {}, [](const TetraFace& f) { return std::pair(f.key, f.cell.cell); });
    return faces;
}

std::vector<std::string> family_names(const Mesh& mesh, const std::set<std::string>& without) {
    std::vector<std::string> names(static_cast<std::size_t>(mesh.families.size()));
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f) {
        std::vector<std::string> in;
        for (const GroupIndex g : mesh.families.groups(f))
            if (!mesh.groups[g].hidden && !without.contains(mesh.groups[g].name)) in.push_back(mesh.groups[g].name);
        std::ranges::sort(in);
        for (const std::string& n : in) names[f] += n + ';';
    }
    return names;
}

std::vector<Edge> edges_of(const Mesh& mesh, bool (*wanted)(CellType)) {
    std::vector<Edge> edges;
    for_each_cell(mesh, wanted, [&](CellType type, Index c, std::span<const Index> n) {
        const int corners = corners_of(type);
        for (int a = 0; a < corners; ++a)
            for (int b = 0; b < a; ++b) edges.push_back({ascending(Key2{n[a], n[b]}), {type, c}});
    });
    std::ranges::sort(edges, {}, [](const Edge& e) { return e.key; });
    return edges;
}

}  // namespace femscalpel::checks
