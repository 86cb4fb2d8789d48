// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace femscalpel {

/// Element types. The node order is meshio's and VTK's: corners first, then mid-side nodes in the
/// order of CellTraits::edges, then face and volume centres.
enum class CellType : std::uint8_t {
    vertex,
    line,
    line3,
    triangle,
    triangle6,
    triangle7,
    quad,
    quad8,
    quad9,
    tetra,
    tetra10,
    pyramid,
    pyramid13,
    wedge,
    wedge15,
    wedge18,
    hexahedron,
    hexahedron20,
    hexahedron27,
};

/// How many CellTypes there are.
inline constexpr int cell_type_count = 19;

/// What is fixed for an element type.
struct CellTraits {
    CellType type;
    std::string_view name;                              ///< meshio's name, e.g. "tetra10"
    int dimension;                                      ///< 0 to 3
    int nodes;                                          ///< nodes per element
    int corners;                                        ///< corner nodes per element
    CellType linear;                                    ///< the type with the same corners and no other nodes
    std::span<const std::array<std::int8_t, 2>> edges;  ///< corner pairs; the mid-side node of edge k
                                                        ///< of a quadratic element is node corners + k
    /// Local faces of a volume element as lists of corners (-1 ends a triangle), in CalculiX's
    /// order: face number minus one. Empty for elements of lower dimension.
    std::span<const std::array<std::int8_t, 4>> faces;
    bool simplex;    ///< vertex, line, triangle or tetrahedron: the operators can work on it
    bool quadratic;  ///< has mid-side nodes
};

/// Traits of an element type; constant time.
const CellTraits& traits(CellType type);

/// All element types in the order of the enumeration.
std::span<const CellTraits> all_cell_types();

/// The type with meshio's name `name`; throws Error naming the unknown name.
CellType cell_type_from_name(std::string_view name);

}  // namespace femscalpel
