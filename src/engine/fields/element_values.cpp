// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/element_values.h"

#include <Eigen/Dense>

#include "fields/reference_element.h"

namespace femscalpel {

std::optional<Eigen::MatrixXd> reference_points(const FieldLocalization& localization) {
    const CellTraits& t = traits(localization.type);
    const Eigen::Index d = localization.dimension, n = t.nodes;
    const auto points = static_cast<Eigen::Index>(localization.weights.size());
    if (d < t.dimension || t.dimension == 0 || std::ssize(localization.element) != n * d ||
        std::ssize(localization.points) != points * d)
        return {};
    // The affine map from the file's reference element to ours, by their corners.
    const Eigen::Map<const Eigen::MatrixXd> nodes(localization.element.data(), d, n);
    Eigen::MatrixXd from(d + 1, t.corners);
    from << nodes.leftCols(t.corners), Eigen::RowVectorXd::Ones(t.corners);
    const Eigen::MatrixXd to = ReferenceElement::of(localization.type).nodes().leftCols(t.corners);
    const Eigen::MatrixXd map = from.transpose().completeOrthogonalDecomposition().solve(to.transpose()).transpose();
    if ((map * from - to).cwiseAbs().maxCoeff() > 1e-6) return {};
    Eigen::MatrixXd at(d + 1, points);
    at << Eigen::Map<const Eigen::MatrixXd>(localization.points.data(), d, points), Eigen::RowVectorXd::Ones(points);
    return map * at;
}

FieldLocalization middle_point(CellType type) {
    const CellTraits& t = traits(type);
    const Eigen::MatrixXd& nodes = ReferenceElement::of(type).nodes();
    FieldLocalization out{"MIDDLE_" + std::string(t.name), type, t.dimension, {}, {}, {}};
    out.element.assign(nodes.data(), nodes.data() + nodes.size());
    const Eigen::VectorXd middle = nodes.leftCols(t.corners).rowwise().mean();
    out.points.assign(middle.data(), middle.data() + middle.size());
    constexpr double triangle = 0.5, tetra = 1. / 6, pyramid = 4. / 3;
    double size = t.dimension == 1 ? 2 : t.dimension == 2 ? 4 : 8;
    if (t.linear == CellType::triangle) size = triangle;
    if (t.linear == CellType::tetra) size = tetra;
    if (t.linear == CellType::pyramid) size = pyramid;
    if (t.linear == CellType::wedge) size = 1;
    out.weights = {size};
    return out;
}

LinearFit::LinearFit(const Eigen::Matrix3Xd& known)
    : middle_(known.rowwise().mean()), slopes_(Eigen::Matrix3Xd::Zero(3, known.cols())) {
    const Eigen::Index n = known.cols();
    if (n == 1) return;
    // Around the middle the mean is the constant part; slopes are zero across what the points span.
    const Eigen::Matrix3Xd around = known.colwise() - middle_;
    Eigen::JacobiSVD<Eigen::MatrixXd> solver(around.transpose(), Eigen::ComputeThinU | Eigen::ComputeThinV);
    solver.setThreshold(1e-9);
    Eigen::MatrixXd centred = Eigen::MatrixXd::Identity(n, n);
    centred.array() -= 1. / static_cast<double>(n);
    slopes_ = solver.solve(centred);
}

std::vector<double> LinearFit::shares(const Vec3& wanted) const {
    const Eigen::RowVectorXd out =
        (wanted - middle_).transpose() * slopes_ +
        Eigen::RowVectorXd::Constant(slopes_.cols(), 1. / static_cast<double>(slopes_.cols()));
    return {out.begin(), out.end()};
}

Eigen::Matrix3Xd places_of(const Mesh& mesh, CellRef cell, const Eigen::MatrixXd& points) {
    const ReferenceElement& element = ReferenceElement::of(cell.type);
    const auto nodes = mesh.block(cell.type).nodes(cell.cell);
    Eigen::Matrix3Xd at(3, std::ssize(nodes)), out(3, points.cols());
    for (std::size_t k = 0; k < nodes.size(); ++k) at.col(static_cast<Eigen::Index>(k)) = mesh.points[nodes[k]];
    for (Eigen::Index p = 0; p < points.cols(); ++p) out.col(p) = at * element.values(points.col(p));
    return out;
}

}  // namespace femscalpel
