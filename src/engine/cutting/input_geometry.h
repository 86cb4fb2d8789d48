// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "deformation/mid_sides.h"
#include "mesh/band_mesh.h"

namespace femscalpel {

/// A band's geometry before it is refined: where points of its elements are, second-order ones on their curves.
class InputGeometry {
public:
    InputGeometry(const BandMesh& band, const MidSides& mids, const Mesh& mesh);

    /// Records the node just born in the middle of the edge a-b.
    void add_node(int a, int b) { born_.push_back(between(a, b)); }

    /// The middle, in the element's own parameters, of an edge inside an element of the input.
    Vec3 middle(int a, int b) const;

    /// Whether an element around `node` is part of a curved one.
    bool is_curved_around(int node) const;

private:
    /// A point by barycentric coordinates: up to four nodes of the input, the corners of a simplex.
    struct Place {
        std::array<int, 4> node{-1, -1, -1, -1};
        std::array<double, 4> weight{};

        void add(int n, double w) {
            for (int k = 0; k < 4; ++k) {
                if (node[k] >= 0 && node[k] != n) continue;
                node[k] = n;
                weight[k] += w;
                return;
            }
        }
    };

    const Vec3& input(int node) const { return band_.nodes[node].start; }

    bool bends(int a, int b) const;

    Place between(int a, int b) const;

    Vec3 at(const Place& p) const;

    const BandMesh& band_;
    std::unordered_map<std::uint64_t, Vec3> mids_;
    std::vector<Place> born_;
    std::vector<char> curved_tetras_, curved_triangles_, curved_lines_;  // by slot of the original element
};

}  // namespace femscalpel
