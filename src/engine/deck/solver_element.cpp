// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/solver_element.h"

#include <algorithm>
#include <charconv>

#include "deck/solver_input.h"

namespace femscalpel {
namespace {

struct Family {
    std::string_view prefix;
    int dimension;
    bool plane;
};

constexpr Family families[] = {
    {"C3D", 3, false}, {"F3D", 3, false}, {"M3D", 2, false}, {"CPS", 2, true},
    {"CPE", 2, true},  {"CAX", 2, true},  {"S", 2, false},
};

std::optional<CellType> cell_of(int dimension, int nodes) {
    for (const CellTraits& t : all_cell_types())
        if (t.dimension == dimension && t.nodes == nodes && nodes != 7 && nodes != 9 && nodes != 18 && nodes != 27)
            return t.type;
    return {};
}

}  // namespace

std::optional<DeckElementType> deck_element_type(std::string_view written) {
    std::string label = deck_key(written);
    struct Named {
        std::string_view label;
        CellType cell;
    };
    static constexpr Named named[] = {
        {"B31", CellType::line},       {"B31R", CellType::line},      {"B32", CellType::line3},
        {"B32R", CellType::line3},     {"B21", CellType::line},       {"T2D2", CellType::line},
        {"T3D2", CellType::line},      {"T3D3", CellType::line3},     {"D", CellType::line3},
        {"GAPUNI", CellType::line},    {"SPRINGA", CellType::line},   {"SPRING2", CellType::line},
        {"DASHPOTA", CellType::line},  {"SPRING1", CellType::vertex}, {"MASS", CellType::vertex},
        {"DCOUP3D", CellType::vertex},
    };
    for (const Named& n : named)
        if (label == n.label) return DeckElementType{n.cell, false};
    if (label.starts_with("DC") || label.starts_with("DS")) label.erase(0, 1);  // heat transfer, as CalculiX does
    for (const Family& f : families) {
        if (!label.starts_with(f.prefix)) continue;
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
            return "C3D8";
        case CellType::hexahedron20:
            return "C3D20";
        default:
            return "";
    }
}

void swap_node_order(CellType type, std::span<Index> nodes) {
    if (type == CellType::line3) std::swap(nodes[1], nodes[2]);
}

int face_from_label(int label, bool plane) { return plane ? (label <= 4 ? label + 2 : label - 4) : label; }

int label_from_face(int face, bool plane) { return plane ? (face <= 2 ? face + 4 : face - 2) : face; }

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
