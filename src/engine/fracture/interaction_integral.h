// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fracture/auxiliary_field.h"
#include "fracture/front.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// What the virtual growth of a crack front covers: all of it within `inner` of the front, nothing beyond `outer`,
/// smoothly less between; along the front it is largest at the place asked for, and nothing beyond `along` of it.
struct IntegralDomain {
    double inner, outer;
    double along;  ///< of a tip it does not matter
};

/// Stress intensity in modes 1, 2 and 3 at places of a front, given by arc lengths, by the interaction integral over
/// the elements around it. The domain is a function of place alone and so does not depend on how the elements lie
/// (free tetrahedra): near the front, where the elements are worst, its gradient is 0. Of curved fronts the terms by
/// which the auxiliary fields are neither compatible nor in equilibrium are in, in closed form.
///
/// The lips are plane and free of traction near the front, there are no forces in the volume and no thermal strain.
/// Yau, Wang and Corten, J. Appl. Mech. 47 (1980); Gosz and Moran, Eng. Fract. Mech. 69 (2002); Daimon and Okada, Eng.
/// Fract. Mech. 115 (2014).
/// `displacements` has one for each node of the mesh, `solids` the elements of the largest dimension that have a node
/// within domain.outer of the front.
std::vector<std::array<double, 3>> interaction_integrals(const Mesh& mesh, std::span<const Vec3> displacements,
                                                         const std::vector<CellRef>& solids, const CrackFront& front,
                                                         const std::vector<double>& places,
                                                         const IntegralDomain& domain, const Elasticity& elasticity);

}  // namespace femscalpel
