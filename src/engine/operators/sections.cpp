// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/sections.h"

#include <algorithm>
#include <array>

#include "deck/solver_input.h"
#include "deck/solver_sets.h"

namespace femscalpel {

void warn_of_sections(const Mesh& mesh, const Mesh& result, const std::string& added, Report& report) {
    const SolverInput* const deck = solver_input(result);
    if (!solver_input(mesh) || !deck) return;
    std::vector<char> provided(result.groups.size(), 0);
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) provided[g] = !result.groups[g].hidden;
    const DeckSetIndex sets(deck->sets());
    for (const Card& card : deck->cards())
        if (const std::string* elset = card.parameter("ELSET"); elset && card.keyword.ends_with("SECTION"))
            if (const auto set = sets.find(DeckSetType::elset, *elset))
                if (const auto g = result.find_group(deck->sets()[*set].group, GroupKind::element)) provided[*g] = 1;
    const GroupIndex group = *result.find_group(added, GroupKind::element);
    std::array<Index, 4> without{};  // by dimension
    int dimension = 0;
    for (const CellBlock& b : result.blocks())
        for (const FamilyIndex f : b.families) {
            const auto groups = result.families.groups(f);
            if (std::ranges::find(groups, group) == groups.end()) continue;
            const int own = traits(b.type).dimension;
            dimension = std::max(dimension, own);
            without[own] += std::ranges::none_of(groups, [&](GroupIndex g) { return provided[g] != 0; });
        }
    // Segments of an addition of shells or solids are groups of edges.
    if (dimension > 1) without[0] = without[1] = 0;
    const Index count = without[1] + without[2] + without[3];
    if (count == 0) return;
    const std::string of = ", ELSET=" + added + ", MATERIAL=(its material)";
    report.warnings.push_back(
        "the deck has no section for the " + std::to_string(count) + " elements of '" + added + "': add the card" +
        (dimension == 3   ? " *SOLID SECTION" + of
         : dimension == 2 ? " *SHELL SECTION" + of + ", and a line with the thickness"
                          : " *BEAM SECTION" + of +
                                ", SECTION=RECT, and lines with the two thicknesses and the direction of the first") +
        ", after the material's");
}

}  // namespace femscalpel
