// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/solver_element.h"

#include <algorithm>
#include <charconv>

#include "deck/solver_input.h"
#include "error.h"

namespace femscalpel {
namespace {

struct Family {
    std::string_view prefix;
    int dimension;
    bool plane;
    bool heat_alone = false;  ///< of heat transfer only
};

/// What begins as another does comes before it.
constexpr Family families[] = {
    {"C3D", 3, false}, {"C2D", 2, true, true}, {"C1D", 1, false, true}, {"F3D", 3, false}, {"M3D", 2, false},
    {"CPS", 2, true},  {"CPEG", 2, true},      {"CPE", 2, true},        {"CAX", 2, true},  {"AC3D", 3, false},
    {"AC2D", 2, true}, {"R3D", 2, false},      {"SFM3D", 2, false},     {"SC", 3, false},  {"S", 2, false},
};

std::optional<CellType> cell_of(int dimension, int nodes) {
    for (const CellTraits& t : all_cell_types())
        if (t.dimension == dimension && t.nodes == nodes && nodes != 7 && nodes != 9 && nodes != 18 && nodes != 27)
            return t.type;
    return {};
}

bool is_pyramid(CellType type) { return traits(type).corners == 5; }

}  // namespace

bool holds(const DeckElementType& said, CellType type) {
    return said.cell == type || (type == CellType::pyramid && said.cell == CellType::hexahedron) ||
           (type == CellType::pyramid13 && said.cell == CellType::hexahedron20);
}

std::string deck_label_for(std::string_view written, CellType type) {
    std::string label = deck_key(written);
    if (const auto said = deck_element_type(written); said && said->cell == type) return label;
    if (label.starts_with("SC"))
        throw UnsupportedElementError("elements of type " + label +
                                      " have no parts of their kind: the tool must stay away from them");
    const bool heat = label.starts_with("DC") || label.starts_with("DS");
    std::size_t digits = 0;
    for (const Family& f : families)
        if (digits == 0 && std::string_view(label).substr(heat).starts_with(f.prefix)) digits = heat + f.prefix.size();
    const std::size_t formulation = std::min(label.find_first_not_of("0123456789", digits), label.size());
    const std::string count = std::to_string(type == CellType::pyramid     ? 8
                                             : type == CellType::pyramid13 ? 20
                                                                           : traits(type).nodes);
    std::string out(label, 0, digits);
    out += count;
    // CalculiX's incompatible and reduced first-order elements are not exact as pyramids.
    if (label.compare(digits, formulation - digits, count) == 0 && type != CellType::pyramid)
        return out.append(label, formulation);
    // Abaqus' hybrid elements, and those with temperatures, pore pressures or potentials, have their kind in every
    // shape.
    for (const char c : label.substr(formulation))
        if (std::string_view("HTPE").find(c) != std::string_view::npos) out += c;
    return out;
}

std::optional<DeckElementType> deck_element_type(std::string_view written) {
    std::string label = deck_key(written);
    struct Named {
        std::string_view label;
        CellType cell;
        bool whole = false;
    };
    static constexpr Named named[] = {
        {"B31", CellType::line},
        {"B31R", CellType::line},
        {"B32", CellType::line3},
        {"B32R", CellType::line3},
        {"B21", CellType::line},
        {"T2D2", CellType::line},
        {"T3D2", CellType::line},
        {"T3D3", CellType::line3},
        {"T2D3", CellType::line3},
        {"B22", CellType::line3},
        {"B23", CellType::line},
        {"B33", CellType::line},
        {"PIPE21", CellType::line},
        {"PIPE31", CellType::line},
        {"PIPE22", CellType::line3},
        {"PIPE32", CellType::line3},
        {"SAX1", CellType::line},
        {"SAX2", CellType::line3},
        {"R2D2", CellType::line},
        {"RAX2", CellType::line},
        {"STRI3", CellType::triangle},
        {"STRI65", CellType::triangle6},
        {"S4R5", CellType::quad},
        {"S8R5", CellType::quad8},
        {"D", CellType::line3, true},
        {"GAPUNI", CellType::line, true},
        {"SPRINGA", CellType::line, true},
        {"SPRING2", CellType::line, true},
        {"DASHPOTA", CellType::line, true},
        {"DASHPOT2", CellType::line, true},
        {"JOINTC", CellType::line, true},
        {"FRAME2D", CellType::line, true},
        {"FRAME3D", CellType::line, true},
        {"CONN2D2", CellType::line, true},
        {"CONN3D2", CellType::line, true},
        {"SPRING1", CellType::vertex},
        {"DASHPOT1", CellType::vertex},
        {"MASS", CellType::vertex},
        {"ROTARYI", CellType::vertex},
        {"DCOUP3D", CellType::vertex},
    };
    for (const Named& n : named)
        if (label == n.label) return DeckElementType{n.cell, false, n.whole};
    const bool heat = label.starts_with("DC") || label.starts_with("DS");
    if (heat) label.erase(0, 1);  // as CalculiX does
    for (const Family& f : families) {
        if (!label.starts_with(f.prefix) || (f.heat_alone && !heat)) continue;
        const char* first = label.data() + f.prefix.size();
        const char* last = label.data() + label.size();
        int nodes = 0;
        const auto [end, error] = std::from_chars(first, last, nodes);
        if (error != std::errc{} || !std::all_of(end, last, [](char c) { return c >= 'A' && c <= 'Z'; })) return {};
        const auto cell = cell_of(f.dimension, nodes);
        if (!cell) return {};
        return DeckElementType{*cell, f.plane};
    }
    return {};
}

std::string_view default_deck_label(CellType type) {
    switch (type) {
        case CellType::line:
            return "B31";
        case CellType::line3:
            return "B32";
        case CellType::triangle:
            return "S3";
        case CellType::triangle6:
            return "S6";
        case CellType::quad:
            return "S4";
        case CellType::quad8:
            return "S8";
        case CellType::tetra:
            return "C3D4";
        case CellType::tetra10:
            return "C3D10";
        case CellType::wedge:
            return "C3D6";
        case CellType::wedge15:
            return "C3D15";
        case CellType::hexahedron:
        case CellType::pyramid:
            return "C3D8";
        case CellType::hexahedron20:
        case CellType::pyramid13:
            return "C3D20";
        default:
            return "";
    }
}

void swap_node_order(CellType type, std::span<Index> nodes) {
    if (type == CellType::line3) std::swap(nodes[1], nodes[2]);
}

std::vector<Index> deck_nodes(CellType type, std::span<const Index> n, CellType as) {
    if (!is_pyramid(type) || as == type) return {n.begin(), n.end()};
    std::vector<Index> out(n.begin(), n.begin() + 4);
    out.insert(out.end(), 4, n[4]);
    if (type == CellType::pyramid) return out;
    out.insert(out.end(), n.begin() + 5, n.begin() + 9);  // on the base
    out.insert(out.end(), 4, n[4]);
    out.insert(out.end(), n.begin() + 9, n.end());
    return out;
}

std::optional<std::pair<CellType, std::vector<Index>>> pyramid_from_deck(CellType type, std::span<const Index> n) {
    if (type != CellType::hexahedron && type != CellType::hexahedron20) return {};
    const auto at_tip = [&](std::size_t first) {
        return std::ranges::all_of(n.subspan(first, 4), [&](Index v) { return v == n[4]; });
    };
    if (!at_tip(4) || (type == CellType::hexahedron20 && !at_tip(12))) return {};
    for (std::size_t k = 0; k < 4; ++k)
        if (n[k] == n[(k + 1) % 4] || n[k] == n[4]) return {};
    std::vector<Index> out(n.begin(), n.begin() + 5);
    if (type == CellType::hexahedron) return std::pair(CellType::pyramid, std::move(out));
    out.insert(out.end(), n.begin() + 8, n.begin() + 12);
    out.insert(out.end(), n.begin() + 16, n.end());
    return std::pair(CellType::pyramid13, std::move(out));
}

int face_from_label(int label, CellType type, bool plane) {
    if (is_pyramid(type)) return label == 2 ? 0 : std::max(1, label - 1);  // without the one in its tip
    return plane ? (label <= 4 ? label + 2 : label - 4) : label;
}

int label_from_face(int face, CellType type, bool plane) {
    if (is_pyramid(type)) return face == 1 ? 1 : face + 1;
    return plane ? (face <= 2 ? face + 4 : face - 2) : face;
}

std::string_view label_name(int label, CellType type, bool plane) {
    static constexpr std::string_view names[] = {"", "S1", "S2", "S3", "S4", "S5", "S6"};
    if (traits(type).dimension == 2 && plane && label >= 5) return label == 5 ? "SN" : "SP";
    if (traits(type).dimension == 2 && !plane && label <= 2) return label == 1 ? "SNEG" : "SPOS";
    return names[label];
}

int label_from_name(std::string_view written) {
    const std::string name = deck_key(written);
    if (name == "SNEG") return 1;
    if (name == "SPOS") return 2;
    if (name == "SN") return 5;
    if (name == "SP") return 6;
    if (name.size() == 2 && name[0] == 'S' && name[1] >= '1' && name[1] <= '6') return name[1] - '0';
    return 0;
}

}  // namespace femscalpel
