// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/bar_network.h"

#include "cancel.h"

namespace femscalpel {

std::vector<Vec3> bar_network_displacements(const Deformable& d, const std::vector<int>& known,
                                            const std::vector<Vec3>& given, const std::vector<int>& unknown) {
    const BandMesh& band = d.band;
    using Field = std::vector<Vec3>;
    Field out(unknown.size(), Vec3::Zero());
    if (unknown.empty() || known.empty()) return out;
    // Nodes that cannot move stay at zero, and cost nothing.
    std::vector<int> place_of(static_cast<std::size_t>(band.size()), -1), moving;
    std::vector<Eigen::Matrix3d> basis_of;
    std::vector<int> freedom;
    for (std::size_t k = 0; k < unknown.size(); ++k) {
        Eigen::Matrix3d basis;
        const int count = d.constraints.tangents(unknown[k], d.contact[unknown[k]], band.nodes[unknown[k]].at, basis);
        if (count == 0) continue;
        place_of[unknown[k]] = static_cast<int>(moving.size());
        moving.push_back(static_cast<int>(k));
        basis_of.push_back(basis);
        freedom.push_back(count);
    }
    std::vector<int> given_of(static_cast<std::size_t>(band.size()), -1);
    for (std::size_t k = 0; k < known.size(); ++k) given_of[known[k]] = static_cast<int>(k);

    // One scalar stiffness matrix, in compressed rows, serves the three directions; constraints enter as projectors.
    std::vector<int> row{0}, column;
    std::vector<double> bars, diagonal(moving.size());
    Field residual(moving.size(), Vec3::Zero());
    std::vector<std::pair<std::size_t, Eigen::Matrix3d>> projectors;  // of the unknowns that are not free
    std::vector<int> neighbours;
    SparseCheck check(64);
    for (std::size_t k = 0; k < moving.size(); ++k, check()) {
        const int v = unknown[moving[k]];
        const auto tangent = basis_of[k].leftCols(freedom[k]);
        if (freedom[k] < 3) projectors.emplace_back(k, tangent * tangent.transpose());
        band.neighbours(v, neighbours);
        for (const int w : neighbours) {
            const double bar = 1 / (band.nodes[w].at - band.nodes[v].at).norm();
            diagonal[k] += bar;
            if (given_of[w] >= 0) {
                residual[k] += bar * given[given_of[w]];
            } else if (place_of[w] >= 0) {
                column.push_back(place_of[w]);
                bars.push_back(bar);
            }
        }
        row.push_back(static_cast<int>(column.size()));
    }

    const auto project = [&](Field& field) {
        for (const auto& [k, projector] : projectors) field[k] = projector * field[k];
    };
    const auto product = [](const Field& a, const Field& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
        return sum;
    };
    // Conjugate gradients, Jacobi preconditioner, within the subspace the constraints leave. A thousandth
    // is enough: this is the starting point of the quality stage.
    project(residual);
    Field scaled(residual.size());
    for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] = residual[k] / diagonal[k];
    Field direction = scaled, image(residual.size());
    double energy = product(residual, scaled);
    const double enough = 1e-6 * energy;
    for (int iteration = 0; iteration < 200 && energy > enough; ++iteration) {
        check_cancelled();
        for (std::size_t k = 0; k < image.size(); ++k) {
            Vec3 sum = diagonal[k] * direction[k];
            for (int e = row[k]; e < row[k + 1]; ++e) sum -= bars[e] * direction[column[e]];
            image[k] = sum;
        }
        project(image);
        const double step = energy / product(direction, image);
        for (std::size_t k = 0; k < image.size(); ++k) {
            out[moving[k]] += step * direction[k];
            residual[k] -= step * image[k];
            scaled[k] = residual[k] / diagonal[k];
        }
        const double next = product(residual, scaled);
        for (std::size_t k = 0; k < image.size(); ++k) direction[k] = scaled[k] + (next / energy) * direction[k];
        energy = next;
    }
    return out;
}

}  // namespace femscalpel
