// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/cell_type.h"

#include <string>

#include "error.h"

namespace femscalpel {
namespace {

using Edge = std::array<std::int8_t, 2>;
using Face = std::array<std::int8_t, 4>;

constexpr Edge line_edges[] = {{0, 1}};
constexpr Edge triangle_edges[] = {{0, 1}, {1, 2}, {2, 0}};
constexpr Edge quad_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
constexpr Edge tetra_edges[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
constexpr Edge pyramid_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
constexpr Edge wedge_edges[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
constexpr Edge hexa_edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                               {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

constexpr Face tetra_faces[] = {{0, 1, 2, -1}, {0, 3, 1, -1}, {1, 3, 2, -1}, {2, 3, 0, -1}};
constexpr Face pyramid_faces[] = {{0, 1, 2, 3}, {0, 4, 1, -1}, {1, 4, 2, -1}, {2, 4, 3, -1}, {3, 4, 0, -1}};
constexpr Face wedge_faces[] = {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
constexpr Face hexa_faces[] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};

using T = CellType;
constexpr CellTraits table[cell_type_count] = {
    {T::vertex, "vertex", 0, 1, 1, T::vertex, {}, {}, true, false},
    {T::line, "line", 1, 2, 2, T::line, line_edges, {}, true, false},
    {T::line3, "line3", 1, 3, 2, T::line, line_edges, {}, true, true},
    {T::triangle, "triangle", 2, 3, 3, T::triangle, triangle_edges, {}, true, false},
    {T::triangle6, "triangle6", 2, 6, 3, T::triangle, triangle_edges, {}, true, true},
    {T::triangle7, "triangle7", 2, 7, 3, T::triangle, triangle_edges, {}, false, true},
    {T::quad, "quad", 2, 4, 4, T::quad, quad_edges, {}, false, false},
    {T::quad8, "quad8", 2, 8, 4, T::quad, quad_edges, {}, false, true},
    {T::quad9, "quad9", 2, 9, 4, T::quad, quad_edges, {}, false, true},
    {T::tetra, "tetra", 3, 4, 4, T::tetra, tetra_edges, tetra_faces, true, false},
    {T::tetra10, "tetra10", 3, 10, 4, T::tetra, tetra_edges, tetra_faces, true, true},
    {T::pyramid, "pyramid", 3, 5, 5, T::pyramid, pyramid_edges, pyramid_faces, false, false},
    {T::pyramid13, "pyramid13", 3, 13, 5, T::pyramid, pyramid_edges, pyramid_faces, false, true},
    {T::wedge, "wedge", 3, 6, 6, T::wedge, wedge_edges, wedge_faces, false, false},
    {T::wedge15, "wedge15", 3, 15, 6, T::wedge, wedge_edges, wedge_faces, false, true},
    {T::wedge18, "wedge18", 3, 18, 6, T::wedge, wedge_edges, wedge_faces, false, true},
    {T::hexahedron, "hexahedron", 3, 8, 8, T::hexahedron, hexa_edges, hexa_faces, false, false},
    {T::hexahedron20, "hexahedron20", 3, 20, 8, T::hexahedron, hexa_edges, hexa_faces, false, true},
    {T::hexahedron27, "hexahedron27", 3, 27, 8, T::hexahedron, hexa_edges, hexa_faces, false, true},
};

}  // namespace

const CellTraits& traits(CellType type) { return table[static_cast<int>(type)]; }

std::span<const CellTraits> all_cell_types() { return table; }

CellType cell_type_from_name(std::string_view name) {
    for (const CellTraits& t : table)
        if (t.name == name) return t.type;
    throw Error("unknown element type '" + std::string(name) + "'");
}

}  // namespace femscalpel
