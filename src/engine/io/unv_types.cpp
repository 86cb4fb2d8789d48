// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/unv_types.h"

#include <algorithm>

namespace femscalpel {
namespace {

/// In the order of CellType.
constexpr UnvType unv_types[cell_type_count] = {
    {161, {0}},
    {11, {0, 1}},
    {22, {0, 2, 1}},
    {41, {0, 1, 2}},
    {42, {0, 3, 1, 4, 2, 5}},
    {42, {0, 3, 1, 4, 2, 5, 6}},
    {44, {0, 1, 2, 3}},
    {45, {0, 4, 1, 5, 2, 6, 3, 7}},
    {45, {0, 4, 1, 5, 2, 6, 3, 7, 8}},
    {111, {0, 1, 2, 3}},
    {118, {0, 4, 1, 5, 2, 6, 7, 8, 9, 3}},
    {0, {}},
    {0, {}},
    {112, {0, 1, 2, 3, 4, 5}},
    {113, {0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11}},
    {0, {}},
    {115, {0, 1, 2, 3, 4, 5, 6, 7}},
    {116, {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15}},
    {0, {}},
};

/// What a descriptor is, with the types by their number of nodes.
struct UnvDescriptor {
    std::int64_t number;
    CellType type;
    CellType with_centre;  ///< the type with one node more; `type` if there is none
};

using T = CellType;
constexpr UnvDescriptor unv_descriptors[] = {
    // Plane stress, plane strain, plates, membranes, axisymmetric solids, thin shells.
    {41, T::triangle, T::triangle},
    {51, T::triangle, T::triangle},
    {61, T::triangle, T::triangle},
    {74, T::triangle, T::triangle},
    {81, T::triangle, T::triangle},
    {91, T::triangle, T::triangle},
    {42, T::triangle6, T::triangle7},
    {52, T::triangle6, T::triangle7},
    {62, T::triangle6, T::triangle7},
    {72, T::triangle6, T::triangle7},
    {82, T::triangle6, T::triangle7},
    {92, T::triangle6, T::triangle7},
    {44, T::quad, T::quad},
    {54, T::quad, T::quad},
    {64, T::quad, T::quad},
    {71, T::quad, T::quad},
    {84, T::quad, T::quad},
    {94, T::quad, T::quad},
    {45, T::quad8, T::quad9},
    {55, T::quad8, T::quad9},
    {65, T::quad8, T::quad9},
    {75, T::quad8, T::quad9},
    {85, T::quad8, T::quad9},
    {95, T::quad8, T::quad9},
    {111, T::tetra, T::tetra},
    {118, T::tetra10, T::tetra10},
    {112, T::wedge, T::wedge},
    {113, T::wedge15, T::wedge15},
    {115, T::hexahedron, T::hexahedron},
    {116, T::hexahedron20, T::hexahedron20},
    {161, T::vertex, T::vertex},
};

struct UnvName {
    std::int64_t number;
    const char* name;
};

constexpr UnvName unv_names[] = {
    {43, "plane stress cubic triangle"},
    {46, "plane stress cubic quadrilateral"},
    {53, "plane strain cubic triangle"},
    {56, "plane strain cubic quadrilateral"},
    {63, "plate cubic triangle"},
    {66, "plate cubic quadrilateral"},
    {73, "membrane cubic triangle"},
    {76, "membrane cubic quadrilateral"},
    {93, "thin shell cubic triangle"},
    {96, "thin shell cubic quadrilateral"},
    {101, "thick shell linear wedge"},
    {102, "thick shell parabolic wedge"},
    {103, "thick shell cubic wedge"},
    {104, "thick shell linear brick"},
    {105, "thick shell parabolic brick"},
    {106, "thick shell cubic brick"},
    {114, "solid cubic wedge, or SALOME's pyramid of 13 nodes"},
    {117, "solid cubic brick"},
    {121, "rigid bar"},
    {122, "rigid element"},
    {136, "node to node translational spring"},
    {137, "node to node rotational spring"},
    {138, "node to ground translational spring"},
    {139, "node to ground rotational spring"},
    {141, "node to node damper"},
    {142, "node to ground damper"},
    {151, "node to node gap"},
    {152, "node to ground gap"},
};

}  // namespace

const UnvType& unv_type(CellType type) { return unv_types[static_cast<std::size_t>(type)]; }

bool is_unv_beam(std::int64_t descriptor) {
    return descriptor == 11 || (descriptor >= 21 && descriptor <= 25) || descriptor == 31 || descriptor == 32;
}

std::optional<CellType> cell_type_of_unv(std::int64_t descriptor, std::int64_t nodes) {
    if (is_unv_beam(descriptor)) {
        if (nodes == 2) return T::line;
        if (nodes == 3) return T::line3;
        return {};
    }
    const auto* const found = std::ranges::find(unv_descriptors, descriptor, &UnvDescriptor::number);
    if (found == std::end(unv_descriptors)) return {};
    if (traits(found->type).nodes == nodes) return found->type;
    if (traits(found->with_centre).nodes == nodes) return found->with_centre;
    return {};
}

std::string unv_description(std::int64_t descriptor) {
    const auto* const found = std::ranges::find(unv_names, descriptor, &UnvName::number);
    return found == std::end(unv_names) ? std::string() : found->name;
}

}  // namespace femscalpel
