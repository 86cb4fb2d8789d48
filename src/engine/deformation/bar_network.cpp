// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/bar_network.h"

#include "cancel.h"

namespace femscalpel {

namespace {

using Field = std::vector<Vec3>;

double product(const Field& a, const Field& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
    return sum;
}

/// The unknown nodes that can move, in which directions.
struct Moving {
    std::vector<int> place_of;  ///< by node of the band, -1 for others
    std::vector<int> unknown;   ///< places in the list of unknown nodes
    std::vector<Eigen::Matrix3d> basis;
    std::vector<int> freedom;  ///< columns of the basis
};

Moving find_moving(const Deformable& d, const std::vector<int>& unknown) {
    Moving out;
    out.place_of.assign(static_cast<std::size_t>(d.band.size()), -1);
    for (std::size_t k = 0; k < unknown.size(); ++k) {
        Eigen::Matrix3d basis;
        const int v = unknown[k];
        const int count = d.constraints.tangents(v, d.contact[v], d.band.nodes[v].at, basis);
        if (count == 0) continue;
        out.place_of[v] = static_cast<int>(out.unknown.size());
        out.unknown.push_back(static_cast<int>(k));
        out.basis.push_back(basis);
        out.freedom.push_back(count);
    }
    return out;
}

/// The bars' equations. One scalar stiffness matrix, in compressed rows, serves the three directions; constraints enter
/// as projectors.
struct Equations {
    std::vector<int> row{0}, column;
    std::vector<double> bars, diagonal;
    Field load;
    std::vector<std::pair<std::size_t, Eigen::Matrix3d>> projectors;  ///< of the unknowns that are not free

    void project(Field& field) const {
        for (const auto& [k, projector] : projectors) field[k] = projector * field[k];
    }

    void multiply(const Field& direction, Field& image) const {
        for (std::size_t k = 0; k < image.size(); ++k) {
            Vec3 sum = diagonal[k] * direction[k];
            for (int e = row[k]; e < row[k + 1]; ++e) sum -= bars[e] * direction[column[e]];
            image[k] = sum;
        }
        project(image);
    }
};

Equations assemble(const BandMesh& band, const Moving& moving, const std::vector<int>& unknown,
                   const std::vector<int>& known, const std::vector<Vec3>& given) {
    std::vector<int> given_of(static_cast<std::size_t>(band.size()), -1);
    for (std::size_t k = 0; k < known.size(); ++k) given_of[known[k]] = static_cast<int>(k);
    Equations out;
    out.diagonal.resize(moving.unknown.size());
    out.load.assign(moving.unknown.size(), Vec3::Zero());
    std::vector<int> neighbours;
    SparseCheck check(64);
    for (std::size_t k = 0; k < moving.unknown.size(); ++k, check()) {
        const int v = unknown[moving.unknown[k]];
        const auto tangent = moving.basis[k].leftCols(moving.freedom[k]);
        if (moving.freedom[k] < 3) out.projectors.emplace_back(k, tangent * tangent.transpose());
        band.neighbours(v, neighbours);
        for (const int w : neighbours) {
            const double bar = 1 / (band.nodes[w].at - band.nodes[v].at).norm();
            out.diagonal[k] += bar;
            if (given_of[w] >= 0) {
                out.load[k] += bar * given[given_of[w]];
            } else if (moving.place_of[w] >= 0) {
                out.column.push_back(moving.place_of[w]);
                out.bars.push_back(bar);
            }
        }
        out.row.push_back(static_cast<int>(out.column.size()));
    }
    return out;
}

/// Conjugate gradients, Jacobi preconditioner, within the subspace the constraints leave. A thousandth is enough: this
/// is the starting point of the quality stage.
Field solve(const Equations& equations) {
    const std::vector<double>& diagonal = equations.diagonal;
    Field residual = equations.load;
    equations.project(residual);
    Field out(residual.size(), Vec3::Zero()), scaled(residual.size());
    for (std::size_t k = 0; k < scaled.size(); ++k) scaled[k] = residual[k] / diagonal[k];
    Field direction = scaled, image(residual.size());
    double energy = product(residual, scaled);
    const double enough = 1e-6 * energy;
    for (int iteration = 0; iteration < 200 && energy > enough; ++iteration) {
        check_cancelled();
        equations.multiply(direction, image);
        const double step = energy / product(direction, image);
        for (std::size_t k = 0; k < image.size(); ++k) {
            out[k] += step * direction[k];
            residual[k] -= step * image[k];
            scaled[k] = residual[k] / diagonal[k];
        }
        const double next = product(residual, scaled);
        for (std::size_t k = 0; k < image.size(); ++k) direction[k] = scaled[k] + (next / energy) * direction[k];
        energy = next;
    }
    return out;
}

}  // namespace

std::vector<Vec3> bar_network_displacements(const Deformable& d, const std::vector<int>& known,
                                            const std::vector<Vec3>& given, const std::vector<int>& unknown) {
    // Nodes that cannot move stay at zero, and cost nothing.
    Field out(unknown.size(), Vec3::Zero());
    if (unknown.empty() || known.empty()) return out;
    const Moving moving = find_moving(d, unknown);
    const Field moves = solve(assemble(d.band, moving, unknown, known, given));
    for (std::size_t k = 0; k < moves.size(); ++k) out[moving.unknown[k]] = moves[k];
    return out;
}

}  // namespace femscalpel
