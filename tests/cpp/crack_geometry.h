// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "crack_model.h"

namespace femscalpel::checks {

/// Planes that geometry alone stops from giving good elements, in the words of the requirement: they meet a flat skin
/// or group border at under 5 degrees, or run (as) parallel to it within 0.15 edge lengths.
struct Grazing {
    bool surface = false;  ///< a skin or border face; a shell
    bool line = false;     ///< a feature line or border line, within the faces it bounds
    /// No mesh whatever can have a better minimum: the plane cuts a corner this sharp off a plate (a needle off an
    /// edge).
    double bound = 1;
};
Grazing grazing(const Model& model, const CutPlane& plane);

/// Area (length, for shells) of the cut of the plane through the input mesh.
double section_measure(const Model& model, const CutPlane& plane);

}  // namespace femscalpel::checks
