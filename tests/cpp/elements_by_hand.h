// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"

/// What checks know of elements: written out again, nothing here uses the engine but its data types.
namespace femscalpel::checks {

using Key2 = std::array<Index, 2>;
using Key3 = std::array<Index, 3>;

/// Faces of a tetrahedron, their normals outwards.
inline constexpr int outward_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
/// In the order of the mid-side nodes.
inline constexpr int edges_of_tetra[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/// Number of corner nodes of a point, segment, triangle or tetrahedron.
int corners_of(CellType type);

/// Position of the mid-side node of the edge between two local corners.
int mid_of(CellType type, int a, int b);

/// What is nearer than this to being the same, in sizes of the mesh or of what is compared, is.
inline constexpr double rounding = 1e-9;

inline bool is_tetra(CellType t) { return t == CellType::tetra || t == CellType::tetra10; }
inline bool is_triangle(CellType t) { return t == CellType::triangle || t == CellType::triangle6; }
inline bool is_line(CellType t) { return t == CellType::line || t == CellType::line3; }
inline bool is_second_order(CellType t) {
    return t == CellType::tetra10 || t == CellType::triangle6 || t == CellType::line3;
}

/// Calls visit(type, cell, nodes) for all elements of wanted types.
template <class Visit>
void for_each_cell(const Mesh& mesh, bool (*wanted)(CellType), Visit visit) {
    for (const CellBlock& b : mesh.blocks())
        if (wanted(b.type))
            for (Index c = 0; c < b.size(); ++c) visit(b.type, c, b.nodes(c));
}

/// Node indices in order.
template <std::size_t N>
std::array<Index, N> ascending(std::array<Index, N> nodes) {
    std::ranges::sort(nodes);
    return nodes;
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Jacobian determinant of a ten-node tetrahedron.
double jacobian(const std::array<Vec3, 10>& p, double r, double s, double t);

/// Point and derivatives of a six-node triangle.
struct OnFace {
    Vec3 at, du, dv;
};
OnFace on_face(const std::array<Vec3, 3>& c, const std::array<Vec3, 3>& m, double u, double v);

double flat_area(const std::array<Vec3, 3>& c);

/// Area vector and area of a triangle element, by Gauss points where it is curved.
std::pair<Vec3, double> face_area(const std::array<Vec3, 3>& c, const std::array<Vec3, 3>& m, bool curved);

double segment_length(const Vec3& a, const Vec3& b, const Vec3& mid, bool curved);

double tetra_volume(const Mesh& mesh, CellType type, std::span<const Index> n);

/// Mean ratio 12 (3V)^(2/3) / sum of squared edge lengths, with the sign of the volume.
double tetra_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Mean ratio 4 sqrt(3) A / sum of squared edge lengths.
double triangle_shape(const Vec3& a, const Vec3& b, const Vec3& c);

/// A face of one tetrahedron. Sorted by `key`, faces of neighbours stand side by side.
struct TetraFace {
    std::array<Index, 3> key;      ///< corner nodes, ascending
    std::array<Index, 3> outward;  ///< the same, turned so that the normal points out of the tetrahedron
    std::array<Index, 3> mid;      ///< mid-side nodes of outward's edges 01, 12, 20; -1 when linear
    CellRef cell;
};

/// All faces of all tetrahedra, sorted by key.
std::vector<TetraFace> tetra_faces(const Mesh& mesh);

/// The visible groups of each family as one text, without those in `without`.
std::vector<std::string> family_names(const Mesh& mesh, const std::set<std::string>& without = {});

/// An edge of one element.
struct Edge {
    Key2 key;  ///< its ends, ascending
    CellRef cell;
};

/// All edges of all elements of wanted types, sorted by key.
std::vector<Edge> edges_of(const Mesh& mesh, bool (*wanted)(CellType));

/// Calls visit(first, last) for every run of equal keys.
template <class List, class Visit>
void runs(const List& list, Visit visit) {
    for (auto first = list.begin(); first != list.end();) {
        auto last = first + 1;
        while (last != list.end() && last->key == first->key) ++last;
        visit(first, last);
        first = last;
    }
}

}  // namespace femscalpel::checks
