// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/load_label.h"

#include <algorithm>

#include "deck/solver_element.h"
#include "deck/solver_input.h"

namespace femscalpel {

LoadLabel::LoadLabel(std::string_view label) {
    const auto digit = std::ranges::find_if(label, [](char c) { return c >= '1' && c <= '6'; });
    prefix = deck_key(label.substr(0, static_cast<std::size_t>(digit - label.begin())));
    if (digit == label.end()) return;
    number = *digit - '0';
    suffix = deck_key(label.substr(static_cast<std::size_t>(digit - label.begin()) + 1));
}

int LoadLabel::face(CellType type, bool plane) const {
    const CellTraits& t = traits(type);
    if (number == 0 || t.dimension < 2) return 0;
    const int face = is_edge_load() ? number + 2 : face_from_label(number, type, plane);
    const int faces = t.dimension == 3 ? static_cast<int>(t.faces.size()) : 2 + t.corners;
    return face >= 1 && face <= faces ? face : 0;
}

std::string LoadLabel::with_face(int face, CellType type, bool plane) const {
    return prefix + std::to_string(is_edge_load() ? face - 2 : label_from_face(face, type, plane)) + suffix;
}

}  // namespace femscalpel
