// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/bar_network.h"

#include <Eigen/SparseCore>

namespace femscalpel {

std::vector<Vec3> bar_network_displacements(const Deformable& d, const std::vector<int>& known, const std::vector<Vec3>& given,
                                            const std::vector<int>& unknown) {
    const BandMesh& band = d.band;
    const auto size = static_cast<Eigen::Index>(unknown.size());
    std::vector<Vec3> out(unknown.size(), Vec3::Zero());
    if (unknown.empty() || known.empty()) return out;
    std::vector<int> place_of(static_cast<std::size_t>(band.size()), -1);
    for (std::size_t k = 0; k < unknown.size(); ++k) place_of[unknown[k]] = static_cast<int>(k);
    std::vector<int> given_of(static_cast<std::size_t>(band.size()), -1);
    for (std::size_t k = 0; k < known.size(); ++k) given_of[known[k]] = static_cast<int>(k);

    // One scalar stiffness matrix serves the three directions; constraints enter as projectors.
    using Field = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
    Eigen::SparseMatrix<double, Eigen::RowMajor> stiffness(size, size);
    stiffness.reserve(Eigen::VectorXi::Constant(size, 24));
    Eigen::VectorXd diagonal(size);
    Field residual = Field::Zero(size, 3);
    std::vector<Eigen::Matrix3d> projector(unknown.size());
    std::vector<int> neighbours;
    for (Eigen::Index k = 0; k < size; ++k) {
        const int v = unknown[k];
        Eigen::Matrix3d basis;
        const int count = d.constraints.tangents(v, d.contact[v], band.nodes[v].at, basis);
        projector[k] = basis.leftCols(count) * basis.leftCols(count).transpose();
        band.neighbours(v, neighbours);
        double sum = 0;
        for (const int w : neighbours) {
            const double bar = 1 / (band.nodes[w].at - band.nodes[v].at).norm();
            sum += bar;
            if (given_of[w] >= 0) residual.row(k) += bar * given[given_of[w]].transpose();
            else if (place_of[w] >= 0) stiffness.insert(k, place_of[w]) = -bar;
        }
        stiffness.insert(k, k) = sum;
        diagonal[k] = sum;
    }
    stiffness.makeCompressed();

    const auto project = [&](Field& field) {
        for (Eigen::Index k = 0; k < size; ++k) field.row(k) = field.row(k) * projector[k];
    };
    // Conjugate gradients, Jacobi preconditioner, within the subspace the constraints leave. A thousandth
    // is enough: this is the starting point of the quality stage.
    project(residual);
    Field solution = Field::Zero(size, 3);
    Field scaled = residual.array().colwise() / diagonal.array();
    Field direction = scaled;
    double energy = residual.cwiseProduct(scaled).sum();
    const double enough = 1e-6 * energy;
    for (int iteration = 0; iteration < 200 && energy > enough; ++iteration) {
        Field image = stiffness * direction;
        project(image);
        const double step = energy / direction.cwiseProduct(image).sum();
        solution += step * direction;
        residual -= step * image;
        scaled = residual.array().colwise() / diagonal.array();
        const double next = residual.cwiseProduct(scaled).sum();
        direction = scaled + (next / energy) * direction;
        energy = next;
    }
    for (Eigen::Index k = 0; k < size; ++k) out[k] = solution.row(k).transpose();
    return out;
}

}  // namespace femscalpel
