// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/bdf_types.h"

#include <algorithm>
#include <utility>

namespace femscalpel {
namespace {

using T = CellType;

/// Of cards of one type the first is written.
constexpr BdfElement bdf_elements[] = {
    {"CBAR", T::line, T::line, true},           {"CBEAM", T::line, T::line, true},
    {"CROD", T::line, T::line, true},           {"CTUBE", T::line, T::line, true},
    {"CBEND", T::line, T::line, true},          {"CONROD", T::line, T::line, false},
    {"CBEAM3", T::line3, T::line3, true},       {"CTRIA3", T::triangle, T::triangle, true},
    {"CTRIAR", T::triangle, T::triangle, true}, {"CTRIA6", T::triangle, T::triangle6, true},
    {"CQUAD4", T::quad, T::quad, true},         {"CQUADR", T::quad, T::quad, true},
    {"CSHEAR", T::quad, T::quad, true},         {"CQUAD8", T::quad, T::quad8, true},
    {"CQUAD", T::quad, T::quad9, true},         {"CTETRA", T::tetra, T::tetra10, true},
    {"CPYRAM", T::pyramid, T::pyramid13, true}, {"CPYRA", T::pyramid, T::pyramid13, true},
    {"CPENTA", T::wedge, T::wedge15, true},     {"CHEXA", T::hexahedron, T::hexahedron20, true},
};

constexpr std::string_view foreign_bdf[] = {
    "CTRIAX",  "CTRIAX6", "CTRAX3",  "CTRAX6",  "CQUADX",  "CQUADX4", "CQUADX8", "CPLSTN3", "CPLSTN4", "CPLSTN6",
    "CPLSTN8", "CPLSTS3", "CPLSTS4", "CPLSTS6", "CPLSTS8", "CHEXCZ",  "CPENTCZ", "CIFHEX",  "CIFPENT", "CIFQUAD",
    "CIFQDX",  "CAXIFi",  "CCONEAX", "CTRIM6",  "CHEXA1",  "CHEXA2",  "CIHEX1",  "CIHEX2",  "CQUADTS", "CTRIATS"};

constexpr std::pair<std::string_view, std::string_view> bdf_descriptions[] = {
    {"CELAS1", "springs"},
    {"CELAS2", "springs"},
    {"CELAS3", "springs"},
    {"CELAS4", "springs"},
    {"CBUSH", "springs and dampers"},
    {"CDAMP1", "dampers"},
    {"CDAMP2", "dampers"},
    {"CVISC", "dampers"},
    {"CGAP", "gaps"},
    {"CMASS1", "masses"},
    {"CMASS2", "masses"},
    {"CONM1", "masses"},
    {"CONM2", "masses"},
    {"CFAST", "fasteners"},
    {"CWELD", "welds"},
    {"PLOTEL", "lines to be shown"},
    {"RBAR", "rigid elements"},
    {"RBE1", "rigid elements"},
    {"RBE2", "rigid elements"},
    {"RBE3", "rigid elements"},
    {"RROD", "rigid elements"},
    {"MPC", "equations"},
    {"SPOINT", "scalar points"},
    {"FORCE", "loads"},
    {"MOMENT", "loads"},
    {"PLOAD", "loads"},
    {"PLOAD2", "loads"},
    {"PLOAD4", "loads"},
    {"GRAV", "loads"},
    {"TEMP", "temperatures"},
    {"TEMPD", "temperatures"},
    {"SPCD", "displacements"},
};

}  // namespace

const BdfElement* bdf_element(std::string_view name) {
    const auto* const found = std::ranges::find(bdf_elements, name, &BdfElement::name);
    return found == std::end(bdf_elements) ? nullptr : found;
}

std::string_view bdf_card(CellType type) {
    const auto* const found =
        std::ranges::find_if(bdf_elements, [&](const BdfElement& e) { return e.type == type || e.quadratic == type; });
    return found == std::end(bdf_elements) ? std::string_view() : found->name;
}

std::array<std::int8_t, 27> bdf_order(CellType type) {
    std::array<std::int8_t, 27> out{};
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<std::int8_t>(k);
    // Nastran has the mid-side nodes of upright edges before those of the top's.
    const auto upright_first = [&](std::size_t corners, std::size_t around) {
        for (std::size_t k = 0; k < around; ++k) {
            out[corners + around + k] = static_cast<std::int8_t>(corners + 2 * around + k);
            out[corners + 2 * around + k] = static_cast<std::int8_t>(corners + around + k);
        }
    };
    if (type == T::hexahedron20) upright_first(8, 4);
    if (type == T::wedge15) upright_first(6, 3);
    return out;
}

bool is_foreign_bdf_element(std::string_view name) {
    return std::ranges::find(foreign_bdf, name) != std::end(foreign_bdf);
}

std::string_view bdf_description(std::string_view name) {
    const auto* const found = std::ranges::find(bdf_descriptions, name, [](const auto& d) { return d.first; });
    return found == std::end(bdf_descriptions) ? std::string_view() : found->second;
}

}  // namespace femscalpel
