// SPDX-License-Identifier: LGPL-2.1-or-later
// What nodes keep to once a part of the skin is free to move.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "deformation/node_constraints.h"

namespace femscalpel {

bool KeptGeometry::are_one_plane(int surface, int other) const {
    const Surface &s = surfaces[surface], &o = surfaces[other];
    return surface == other || (s.flat && o.flat && s.normal.cross(o.normal).norm() < 1e-9 &&
                                std::abs(s.normal.dot(o.origin - s.origin)) <= flatness());
}

bool KeptGeometry::are_one_line(int curve, int other) const {
    const Curve &c = curves[curve], &o = curves[other];
    return curve == other || (c.straight && o.straight && c.direction.cross(o.direction).norm() < 1e-9 &&
                              c.direction.cross(o.origin - c.origin).norm() <= flatness());
}

/// What a node of the input keeps to where some of what was around it is forgotten.
NodeConstraint NodeConstraints::place_beside(int node) const {
    const KeptGeometry& g = geometry_;
    const std::vector<int>&segments = g.segments_around[node], &facets = g.facets_around[node];
    const NodeConstraint nowhere{.freedom = NodeFreedom::fixed};
    if (!segments.empty()) {
        const int first = g.segments[segments[0]].shape;
        const bool one = std::ranges::all_of(
            segments, [&](int s) { return g.are_one_line(first, g.segments[s].shape) && !g.segments[s].fold; });
        return one ? g.on_segment(segments[0]) : nowhere;
    }
    if (facets.empty()) return {};
    const int first = g.facets[facets[0]].shape;
    const bool one = std::ranges::all_of(facets, [&](int f) { return g.are_one_plane(first, g.facets[f].shape); });
    return one ? g.on_facet(facets[0]) : nowhere;
}

void NodeConstraints::release(BandMesh& band, std::span<const int> facets, std::span<const int> segments) {
    std::set<int> nodes;
    for (const int f : facets) {
        nodes.insert(geometry_.facets[f].node.begin(), geometry_.facets[f].node.end());
        geometry_.forget_facet(f);
        band.skin.remove(f);
    }
    for (const int s : segments) {
        nodes.insert(geometry_.segments[s].node.begin(), geometry_.segments[s].node.end());
        geometry_.forget_segment(s);
        band.creases.remove(s);
    }
    for (const int v : nodes) {
        if (!band.nodes[v].movable()) continue;
        nodes_[v] = place_beside(v);
        leash_[v] = std::numeric_limits<double>::infinity();
    }
}

}  // namespace femscalpel
