// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <gp_XYZ.hxx>

namespace femscalpel {

/// The coordinates of an OpenCASCADE point.
inline Eigen::Vector3d to_vector(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

}  // namespace femscalpel
