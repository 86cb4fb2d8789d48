// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/sections.h"

#include <algorithm>

#include "deck/solver_input.h"

namespace femscalpel {

void warn_of_sections(const Mesh& mesh, const Mesh& result, const std::string& added, Report& report) {
    if (!solver_input(mesh)) return;
    const GroupIndex group = *result.find_group(added, GroupKind::element);
    int dimension = 0;
    Index without = 0;
    for (const CellBlock& b : result.blocks())
        for (const FamilyIndex f : b.families) {
            const auto groups = result.families.groups(f);
            if (traits(b.type).dimension < 2 || std::ranges::find(groups, group) == groups.end()) continue;
            dimension = std::max(dimension, traits(b.type).dimension);
            without += std::ranges::none_of(groups, [&](GroupIndex g) {
                return static_cast<std::size_t>(g) < mesh.groups.size() && !result.groups[g].hidden;
            });
        }
    if (without == 0) return;
    report.warnings.push_back(
        "the deck has no section for the " + std::to_string(without) + " elements of '" + added + "': add the card" +
        (dimension == 3
             ? " *SOLID SECTION, ELSET=" + added + ", MATERIAL=(its material)"
             : " *SHELL SECTION, ELSET=" + added + ", MATERIAL=(its material), and a line with the thickness") +
        ", after the material's");
}

}  // namespace femscalpel
