// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fields/field.h"

namespace femscalpel {

/// Integration points of a type in the coordinates of ReferenceElement: dimension x points. Nothing where the
/// localization's reference element is no image of it.
std::optional<Eigen::MatrixXd> reference_points(const FieldLocalization& localization);

/// The localization of one point in the middle of an element.
FieldLocalization middle_point(CellType type);

/// Shares of values at some points in what a field has at others. By the linear function that fits best in the sense of
/// least squares (the smallest of those that fit as well), so that constant and - where the points are enough - linear
/// fields are kept.
class LinearFit {
public:
    /// Points are columns, in space.
    explicit LinearFit(const Eigen::Matrix3Xd& known);

    /// One for each of the known points.
    std::vector<double> shares(const Vec3& wanted) const;

private:
    Vec3 middle_;
    Eigen::Matrix3Xd slopes_;
};

/// Places in space of points given in the coordinates of an element's ReferenceElement.
Eigen::Matrix3Xd places_of(const Mesh& mesh, CellRef cell, const Eigen::MatrixXd& points);

}  // namespace femscalpel
