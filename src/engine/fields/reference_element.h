// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// An element's own shape functions, in the coordinates of its reference element: corners at 0 and 1 for simplices,
/// -1 and 1 for what is a product of lines; prisms have a triangle by a line, pyramids a base at 0 and their tip at 1.
class ReferenceElement {
public:
    /// That of a type; made once.
    static const ReferenceElement& of(CellType type);

    /// Coordinates of its nodes: dimension x nodes.
    const Eigen::MatrixXd& nodes() const { return nodes_; }

    /// Values of the shape functions, one per node; their sum is 1.
    Eigen::VectorXd values(const Eigen::VectorXd& at) const;

    /// Their derivatives: nodes x dimension.
    Eigen::MatrixXd derivatives(const Eigen::VectorXd& at) const;

    /// How deep a point is inside, 0 on the border, negative outside; 1 are an element's dimensions.
    double inside(const Eigen::VectorXd& at) const;

    /// The point inside that is nearest to one outside, coordinate by coordinate.
    Eigen::VectorXd clamped(Eigen::VectorXd at) const;

private:
    explicit ReferenceElement(CellType type);

    /// x^a y^b z^c / (1 - z)^d
    struct Term {
        int a = 0, b = 0, c = 0, d = 0;
    };
    Eigen::VectorXd terms(const Eigen::VectorXd& at) const;
    Eigen::MatrixXd term_derivatives(const Eigen::VectorXd& at) const;

    enum class Form { simplex, product, prism, pyramid };
    Form form_ = Form::simplex;
    std::vector<Term> terms_;
    Eigen::MatrixXd nodes_;
    Eigen::MatrixXd coefficients_;  // terms x nodes
};

/// Where a point is in an element, by Newton's method on its shape functions.
struct InElement {
    /// One for each node or corner; on the stack, as there are millions of them.
    using PerNode = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 27, 1>;

    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> at;  ///< in coordinates of the reference element
    double inside = 0;                                     ///< ReferenceElement::inside()
    PerNode shares;                                        ///< of the element's nodes in a field's value there
    PerNode cornered;                                      ///< of its corners alone, as if it were straight
};

/// Of a point off a shell or beam that of its foot. Nothing for points, and for elements of no size.
std::optional<InElement> find_in_element(const Mesh& mesh, CellRef cell, const Vec3& point);

/// The same where the point is taken to the nearest inside.
InElement held_inside(const InElement& found, CellType type);

}  // namespace femscalpel
