// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/opening_groups.h"

#include <set>

namespace femscalpel {

std::vector<std::vector<GroupIndex>> add_opening_groups(Mesh& mesh, const Opening& opening,
                                                        const std::vector<std::vector<std::string>>& groups) {
    std::set<std::string> of_elements, of_ends;
    const auto note = [&](const auto& list, std::set<std::string>& names) {
        for (const auto& one : list) names.insert(groups[one.group].begin(), groups[one.group].end());
    };
    note(opening.faces, of_elements);
    note(opening.edges, of_elements);
    note(opening.ends, of_ends);
    const auto kind_of = [&](const std::string& name) {
        return of_ends.contains(name) && !of_elements.contains(name) ? GroupKind::node : GroupKind::element;
    };
    const auto first = static_cast<GroupIndex>(mesh.groups.size());
    const auto end = [&] { return static_cast<GroupIndex>(mesh.groups.size()); };
    std::vector<std::vector<GroupIndex>> out;
    for (const auto& names : groups) {
        out.emplace_back();
        for (const std::string& name : names) {
            GroupIndex g = first;
            while (g < end() && mesh.groups[g].name != name) ++g;
            out.back().push_back(g < end() ? g : mesh.add_group(name, kind_of(name)));
        }
    }
    return out;
}

}  // namespace femscalpel
