// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/bar_network.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace femscalpel {

std::vector<Vec3> bar_network_displacements(const Deformable& d, const std::vector<int>& known, const std::vector<Vec3>& given,
                                            const std::vector<int>& unknown) {
    const BandMesh& band = d.band;
    struct Place {
        int first = -1;  // of its unknowns, -1: none
        int count = 0;
        Eigen::Matrix3d basis;
    };
    std::vector<int> place_of(static_cast<std::size_t>(band.size()), -1);
    std::vector<Place> places(unknown.size());
    int size = 0;
    for (std::size_t k = 0; k < unknown.size(); ++k) {
        const int v = unknown[k];
        place_of[v] = static_cast<int>(k);
        places[k].count = d.constraints.tangents(v, d.contact[v], band.nodes[v].at, places[k].basis);
        places[k].first = size;
        size += places[k].count;
    }
    std::vector<Vec3> out(unknown.size(), Vec3::Zero());
    if (size == 0) return out;
    std::vector<int> given_of(static_cast<std::size_t>(band.size()), -1);
    for (std::size_t k = 0; k < known.size(); ++k) given_of[known[k]] = static_cast<int>(k);

    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(size);
    std::vector<int> neighbours;
    for (std::size_t k = 0; k < unknown.size(); ++k) {
        const Place& here = places[k];
        const auto own = here.basis.leftCols(here.count);
        band.neighbours(unknown[k], neighbours);
        double diagonal = 0;
        for (const int w : neighbours) {
            const double stiffness = 1 / (band.nodes[w].at - band.nodes[unknown[k]].at).norm();
            diagonal += stiffness;
            if (given_of[w] >= 0) {
                load.segment(here.first, here.count) += stiffness * (own.transpose() * given[given_of[w]]);
            } else if (place_of[w] >= 0) {
                const Place& there = places[place_of[w]];
                const Eigen::MatrixXd block = -stiffness * own.transpose() * there.basis.leftCols(there.count);
                for (int i = 0; i < here.count; ++i)
                    for (int j = 0; j < there.count; ++j) entries.emplace_back(here.first + i, there.first + j, block(i, j));
            }
        }
        for (int i = 0; i < here.count; ++i) entries.emplace_back(here.first + i, here.first + i, diagonal);
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(1e-3);  // a starting point for the quality stage, not a result
    const Eigen::VectorXd solution = solver.compute(matrix).solve(load);
    for (std::size_t k = 0; k < unknown.size(); ++k)
        out[k] = places[k].basis.leftCols(places[k].count) * solution.segment(places[k].first, places[k].count);
    return out;
}

}  // namespace femscalpel
