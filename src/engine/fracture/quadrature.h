// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/cell_type.h"

namespace femscalpel {

/// A point of numerical integration in an element's reference element.
struct QuadraturePoint {
    double weight;
    Eigen::VectorXd values;       ///< of the shape functions
    Eigen::MatrixXd derivatives;  ///< nodes x dimension
};

/// Products of Gauss's four points, collapsed for simplices and pyramids: polynomials of degree 5 and more exactly.
/// Of elements of dimension 2 and 3.
const std::vector<QuadraturePoint>& quadrature(CellType type);

}  // namespace femscalpel
