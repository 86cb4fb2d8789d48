// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/nearest_group.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "cancel.h"
#include "mesh/facet_element.h"

namespace femscalpel {
namespace {

/// Groups that are at most so many times as far away as the nearest are about as near.
constexpr double about_as_near = 1.5;

}  // namespace

NearestGroup nearest_group(const Mesh& mesh, const Vec3& place, const std::string& except) {
    struct Near {
        double distance = std::numeric_limits<double>::infinity();
        Index members = 0;
    };
    std::vector<Near> near(mesh.groups.size());
    const auto look = [&](FamilyIndex family, Index node) {
        for (const GroupIndex g : mesh.families.groups(family)) {
            near[g].distance = std::min(near[g].distance, (mesh.points[node] - place).norm());
            ++near[g].members;
        }
    };
    SparseCheck check(4096);
    for (Index n = 0; n < mesh.node_count(); ++n, check()) look(mesh.node_families[n], n);
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension >= mesh.dimension()) continue;
        for (Index c = 0; c < b.size(); ++c, check())
            for (const Index n : b.nodes(c)) look(b.families[c], n);
    }
    for (const Facet& f : mesh.facets) {
        const FacetElement e = facet_element(mesh, f);
        for (int k = 0; k < e.size; ++k) look(f.family, e.nodes[k]);
        check();
    }
    double nearest = std::numeric_limits<double>::infinity();
    const auto counts = [&](std::size_t g) { return !mesh.groups[g].hidden && mesh.groups[g].name != except; };
    for (std::size_t g = 0; g < near.size(); ++g)
        if (counts(g)) nearest = std::min(nearest, near[g].distance);
    NearestGroup out;
    Index fewest = std::numeric_limits<Index>::max();
    for (std::size_t g = 0; g < near.size(); ++g) {
        if (!counts(g) || near[g].members == 0 || near[g].members >= fewest ||
            near[g].distance > about_as_near * nearest)
            continue;
        fewest = near[g].members;
        out = {mesh.groups[g].name, near[g].distance};
    }
    return out;
}

}  // namespace femscalpel
