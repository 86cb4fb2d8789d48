// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>

#include "deck/rules/remarks.h"

namespace femscalpel {

/// Sets and surfaces that had members and have none any more: cards that name them say less than they did.
class EmptiedSets {
public:
    /// Linear in the meshes and the deck; `deck` is that of `before`.
    EmptiedSets(const SolverInput& deck, const Mesh& before, const Mesh& after);

    bool none() const { return emptied_.empty(); }
    /// Tells of such sets that card `c` names in its parameters, or in the first `names_per_line` entries of a line.
    void tell(std::size_t c, const Card& card, int names_per_line, Remarks& remarks) const;

private:
    std::map<std::string, std::string> emptied_;  // key of the name -> type
};

}  // namespace femscalpel
