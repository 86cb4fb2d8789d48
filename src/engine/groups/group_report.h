// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// What happened to one group. Measures are lengths, areas or volumes, summed over the members of the
/// group's highest dimension; 0 for node groups.
struct GroupRecord {
    std::string name;
    GroupKind kind = GroupKind::node;
    int dimension = 0;  ///< of the largest members; 0 for nodes
    Index count_before = 0;
    Index count_after = 0;
    double measure_before = 0;
    double measure_after = 0;
    Index nodes_moved = 0;      ///< nodes of the group (or of its elements) that changed place
    bool boundary_kept = true;  ///< false: the operator was told that the boundary may drift
    double boundary_drift =
        0;  ///< largest distance of its moved boundary nodes, and shortcuts (groups.md), from the boundary's old shape
    /// Nodes near the tool that lie on the group's boundary (BE, LE, IE), by what all their constraints together but
    /// the tool leave them: a surface, a line, nothing.
    Index nodes_on_surface = 0;
    Index nodes_on_line = 0;
    Index nodes_fixed = 0;
    std::string
        status;  ///< "untouched", "kept", "changed", "reduced" (lost members to a tool), "became empty" or "new"
};

/// Number and measure of the members of each elementary group (family), by dimension.
struct FamilyTotals {
    /// Of one family.
    struct Entry {
        Index nodes = 0;
        std::array<Index, 4> cells{};
        std::array<double, 4> measure{};
        Index facets = 0;
        double facet_area = 0;
    };
    std::vector<Entry> by_family;
};

/// Area of a volume element's face, length of a triangle's or quadrangle's edge, or the element's own area.
double facet_measure(const Mesh& mesh, const Facet& facet);

/// Totals of a whole mesh; one pass over it.
FamilyTotals family_totals(const Mesh& mesh);

/// Adds (sign +1) or takes away (sign -1) the given elements of `mesh`.
void count_cells(FamilyTotals& totals, const Mesh& mesh, std::span<const CellRef> cells, int sign);

/// Adds (sign +1) or takes away (sign -1) all nodes and facets of `mesh`.
void count_nodes_and_facets(FamilyTotals& totals, const Mesh& mesh, int sign);

/// Recounts nodes and facets, which cost little, from `mesh`.
void recount_nodes_and_facets(FamilyTotals& totals, const Mesh& mesh);

/// One record per visible group of `after`, counts and measures filled in and the status from them. Groups
/// of `before` must come first in `after`, in their order.
std::vector<GroupRecord> compare_groups(const Mesh& before, const FamilyTotals& totals_before, const Mesh& after,
                                        const FamilyTotals& totals_after);

}  // namespace femscalpel
