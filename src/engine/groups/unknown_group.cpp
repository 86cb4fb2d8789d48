// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/unknown_group.h"

#include <algorithm>
#include <vector>

#include "words.h"

namespace femscalpel {

std::string no_group_text(const Mesh& mesh, const std::string& name) {
    constexpr std::size_t most_listed = 8;
    std::vector<std::string> names;
    for (const Group& g : mesh.groups)
        if (!g.hidden && std::ranges::find(names, g.name) == names.end()) names.push_back(g.name);
    const std::string text = "the mesh has no group '" + name + "'";
    if (names.empty()) return text + ", nor any other";
    if (const std::string meant = did_you_mean(name, names); !meant.empty()) return text + "." + meant;
    std::string listed;
    for (std::size_t k = 0; k < std::min(most_listed, names.size()); ++k)
        listed += (k == 0 ? "'" : ", '") + names[k] + "'";
    if (names.size() > most_listed) return text + ". Among its " + std::to_string(names.size()) + " are " + listed;
    return text + "; it has " + listed;
}

}  // namespace femscalpel
