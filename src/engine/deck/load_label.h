// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>

#include "mesh/cell_type.h"

namespace femscalpel {

/// The second entry of a distributed load ("P3", "EDNOR2", "F1FC", "GRAV", "SPOS") taken apart.
struct LoadLabel {
    std::string prefix;
    int number = 0;  ///< of the face or edge, 0 for a load on the whole element or a whole side of a shell
    std::string suffix;

    explicit LoadLabel(std::string_view label);

    /// Facet::face the label means on an element of `type`; 0 if it names none that element has.
    int face(CellType type, bool plane) const;
    /// The label for another face (as face() counts) of an element of `type`.
    std::string with_face(int face, CellType type, bool plane) const;

private:
    bool is_edge_load() const { return prefix == "EDNOR"; }
};

}  // namespace femscalpel
