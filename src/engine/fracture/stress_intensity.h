// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "fracture/auxiliary_field.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Stress intensity and energy release along the fronts of a crack, node by node.
struct StressIntensity {
    std::vector<Index> nodes;  ///< indices, in order along each front
    std::vector<int> front;    ///< which front each is of
    std::vector<double> s;     ///< arc length from the front's first node
    std::vector<Vec3> points;
    std::vector<std::array<double, 3>> k;         ///< K1, K2, K3 by the interaction integral
    std::vector<std::array<double, 3>> k_inside;  ///< the same in a domain of two thirds of the radius
    /// By the displacements of the lips, extrapolated to the front; NaN where too few pairs of nodes are behind it.
    std::vector<std::array<double, 3>> k_lips;
    std::vector<double> g;  ///< energy release rate, from k
    double radius = 0;      ///< of the domain
    double edge = 0;        ///< mean length of element edges at the front
    std::vector<std::string> warnings;
};

/// K and G from the displacements of a mesh that a crack was made in. K1 is positive where the crack opens, K2 where
/// the positive lip moves ahead, K3 where it moves along b x n.
///
/// In a mesh of solids `front` is the element group of segments along the front, in a mesh of shells (one plane) the
/// node group of its tips; the lips are the element groups of the same name with _P and _N in place of _FRONT. The
/// material is isotropic, the lips are plane near the front and free of traction.
///
/// `displacements` has one for each node of the mesh. `radius` is that of the domain; 0 for three element edges, or
/// less where the front bends or other surfaces are near. Throws Error naming what is missing or does not fit: groups,
/// numbers, a deck with temperatures or with pressure on the lips.
StressIntensity stress_intensity(const Mesh& mesh, std::span<const Vec3> displacements, const std::string& front,
                                 const Elasticity& elasticity, double radius = 0);

}  // namespace femscalpel
