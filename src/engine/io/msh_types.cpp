// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/msh_types.h"

#include <algorithm>

namespace femscalpel {
namespace {

/// In the order of CellType.
constexpr MshType msh_types[cell_type_count] = {
    {15, {0}},
    {1, {0, 1}},
    {8, {0, 1, 2}},
    {2, {0, 1, 2}},
    {9, {0, 1, 2, 3, 4, 5}},
    {0, {}},
    {3, {0, 1, 2, 3}},
    {16, {0, 1, 2, 3, 4, 5, 6, 7}},
    {10, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
    {4, {0, 1, 2, 3}},
    {11, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {7, {0, 1, 2, 3, 4}},
    {19, {0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12}},
    {6, {0, 1, 2, 3, 4, 5}},
    {18, {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10}},
    {13, {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16}},
    {5, {0, 1, 2, 3, 4, 5, 6, 7}},
    {17, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14}},
    {12, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26}},
};

struct MshDescription {
    std::int64_t number;
    const char* text;
};

/// Those that FemScalpel has not.
constexpr MshDescription msh_descriptions[] = {
    {14, "14-node second order pyramid"},
    {20, "9-node third order incomplete triangle"},
    {21, "10-node third order triangle"},
    {22, "12-node fourth order incomplete triangle"},
    {23, "15-node fourth order triangle"},
    {24, "15-node fifth order incomplete triangle"},
    {25, "21-node fifth order complete triangle"},
    {26, "4-node third order edge"},
    {27, "5-node fourth order edge"},
    {28, "6-node fifth order edge"},
    {29, "20-node third order tetrahedron"},
    {30, "35-node fourth order tetrahedron"},
    {31, "56-node fifth order tetrahedron"},
    {34, "polygon"},
    {35, "polyhedron"},
    {36, "16-node third order quadrangle"},
    {92, "64-node third order hexahedron"},
    {93, "125-node fourth order hexahedron"},
};

}  // namespace

const MshType& msh_type(CellType type) { return msh_types[static_cast<std::size_t>(type)]; }

std::optional<CellType> cell_type_of_msh(std::int64_t number) {
    if (number <= 0) return {};
    const auto* const found = std::ranges::find(msh_types, number, &MshType::number);
    if (found == std::end(msh_types)) return {};
    return static_cast<CellType>(found - msh_types);
}

std::string msh_type_description(std::int64_t number) {
    const auto* const found = std::ranges::find(msh_descriptions, number, &MshDescription::number);
    return found == std::end(msh_descriptions) ? std::string() : found->text;
}

std::array<std::uint8_t, 27> turned_round(CellType type) {
    const CellTraits& t = traits(type);
    std::array<std::uint8_t, 27> out{};
    for (int k = 0; k < t.nodes; ++k) {
        int from = k;  // centres stay
        if (t.dimension == 1)
            from = k < 2 ? 1 - k : k;
        else if (k < t.corners)
            from = (t.corners - k) % t.corners;
        else if (k < 2 * t.corners)
            from = 3 * t.corners - 1 - k;
        out[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(from);
    }
    return out;
}

}  // namespace femscalpel
