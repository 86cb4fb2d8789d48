// SPDX-License-Identifier: LGPL-2.1-or-later
// Decks for tests of what their cards say after an operator.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "deck/deck_view.h"
#include "io/inp.h"
#include "operators/crack.h"
#include "tools/plane.h"

namespace femscalpel::deck_testing {

namespace fs = std::filesystem;

using Row = std::vector<std::string>;

/// Fields of all data lines of the cards `keyword`.
inline std::vector<Row> rows(const Mesh& mesh, const std::string& keyword) {
    std::vector<Row> out;
    for (const Card& card : solver_input(mesh)->cards()) {
        if (card.keyword != keyword) continue;
        CardReader line(card);
        while (line.next_data_line()) {
            Row row;
            while (!line.at_end()) row.push_back(line.field());
            out.push_back(row);
        }
    }
    return out;
}

inline bool is_number(const std::string& s) { return !s.empty() && std::ranges::all_of(s, ::isdigit); }

inline std::vector<Index> node_set(const Mesh& mesh, const std::string& name) {
    const auto g = mesh.find_group(name, GroupKind::node);
    return g ? group_members(mesh, *g).ids : std::vector<Index>{};
}

inline std::vector<Index> element_set(const Mesh& mesh, const std::string& name) {
    const auto g = mesh.find_group(name, GroupKind::element);
    return g ? group_members(mesh, *g).ids : std::vector<Index>{};
}

/// Nodes a first entry means.
inline std::vector<Index> nodes_of(const Mesh& mesh, const std::string& entry) {
    return is_number(entry) ? std::vector<Index>{std::stoll(entry)} : node_set(mesh, entry);
}

inline std::set<Index> nodes_where(const Mesh& mesh, const std::function<bool(const Vec3&)>& holds) {
    std::set<Index> out;
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (holds(mesh.points[n])) out.insert(mesh.node_ids[n]);
    return out;
}

inline Vec3 place(const Mesh& mesh, Index number) { return mesh.points[*NumberIndex(mesh).node(number)]; }

/// A block 4 x 2 x 2 of cubes, each six tetrahedra; node numbers 1 + i + 5 j + 15 k.
inline constexpr int nx = 4, ny = 2, nz = 2;

inline Index node_at(int i, int j, int k) { return 1 + i + (nx + 1) * (j + (ny + 1) * k); }

struct Block {
    std::string nodes, elements;
    std::vector<std::array<Index, 4>> tetras;  // number e + 1
};

inline Block block() {
    Block out;
    std::ostringstream nodes, elements;
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i) nodes << node_at(i, j, k) << ", " << i << ", " << j << ", " << k << "\n";
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}};
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                for (int o = 0; o < 6; ++o) {
                    std::array<Index, 4> t;
                    std::array<int, 3> at{i, j, k};
                    t[0] = node_at(at[0], at[1], at[2]);
                    for (int s = 0; s < 3; ++s) {
                        ++at[orders[o][s]];
                        t[s + 1] = node_at(at[0], at[1], at[2]);
                    }
                    if (o >= 3) std::swap(t[1], t[2]);
                    out.tetras.push_back(t);
                    elements << out.tetras.size();
                    for (const Index n : t) elements << ", " << n;
                    elements << "\n";
                }
    out.nodes = nodes.str();
    out.elements = elements.str();
    return out;
}

inline constexpr int solver_faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};  // CalculiX's S1 to S4

/// (element, face) of the block on the plane z = 2.
inline std::vector<std::pair<Index, int>> top_faces() {
    std::vector<std::pair<Index, int>> out;
    const Block b = block();
    for (std::size_t e = 0; e < b.tetras.size(); ++e)
        for (int f = 0; f < 4; ++f)
            if (std::ranges::all_of(solver_faces[f], [&](int v) { return b.tetras[e][v] >= node_at(0, 0, nz); }))
                out.push_back({static_cast<Index>(e) + 1, f + 1});
    return out;
}

/// A sheet 4 x 2 of shell triangles; node numbers 1 + i + 5 j, elements 1 to 16.
inline std::string sheet(const std::string& type) {
    std::ostringstream out;
    out << "*NODE, NSET=NALL\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) out << 1 + i + 5 * j << ", " << i << ", " << j << ", 1\n";
    out << "*ELEMENT, TYPE=" << type << ", ELSET=EALL\n";
    int e = 0;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const int a = 1 + i + 5 * j;
            out << e + 1 << ", " << a << ", " << a + 1 << ", " << a + 6 << "\n"
                << e + 2 << ", " << a << ", " << a + 6 << ", " << a + 5 << "\n";
            e += 2;
        }
    return out.str();
}

class DeckSemantics : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            fs::temp_directory_path() / ("femscalpel_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    Mesh read(const std::string& text) const {
        std::ofstream(folder_ / "deck.inp", std::ios::binary) << text;
        Mesh mesh = read_inp(folder_ / "deck.inp");
        mesh.validate();
        return mesh;
    }

    /// The block with further cards.
    Mesh block_with(const std::string& cards) const {
        const Block b = block();
        return read("*NODE, NSET=NALL\n" + b.nodes + "*ELEMENT, TYPE=C3D4, ELSET=EALL\n" + b.elements + cards);
    }

    /// Cracks; as written().
    Mesh crack_at(const Mesh& mesh, double x, const std::string& name = "CRACK", const Vec3& normal = Vec3(1, 0, 0),
                  bool strict = false) {
        CrackOptions options;
        options.name = name;
        options.strict = strict;
        return written(crack(mesh, Plane(Vec3(x, 1, 1), normal), options));
    }

    /// Checks what holds for every result, writes it and reads it back.
    Mesh written(const Result& result) {
        result.mesh.validate();
        warnings_ = result.report.warnings;
        for (const Group& g : result.mesh.groups) EXPECT_FALSE(g.name.starts_with("*MARK")) << g.name;
        for (const GroupRecord& r : result.report.groups) EXPECT_FALSE(r.name.starts_with("*"));
        write_inp(result.mesh, folder_ / "after.inp");
        Mesh back = read_inp(folder_ / "after.inp");
        EXPECT_THAT(solver_input(back)->warnings(), testing::IsEmpty());
        return back;
    }

    /// Line of deck.inp that holds `text`.
    int line_of(const std::string& text) const {
        std::ifstream in(folder_ / "deck.inp");
        std::string line;
        for (int number = 1; std::getline(in, line); ++number)
            if (line == text) return number;
        return -1;
    }
    std::string at_line(const std::string& text) const { return "deck.inp:" + std::to_string(line_of(text)) + ": "; }

    fs::path folder_;
    std::vector<std::string> warnings_;
};

/// Area of an element surface, all of it checked to lie where `holds` says; each face counts once.
inline double surface_area(const Mesh& mesh, const std::string& name, const std::function<bool(const Vec3&)>& holds) {
    const GroupIndex g = *mesh.find_group(name, GroupKind::facet);
    double area = 0;
    for (const Facet& f : mesh.facets) {
        if (!mesh.families.contains(f.family, g)) continue;
        const auto n = mesh.block(f.type).nodes(f.cell);
        std::array<Vec3, 3> p;
        for (int k = 0; k < 3; ++k) {
            p[k] = mesh.points[n[solver_faces[f.face - 1][k]]];
            EXPECT_TRUE(holds(p[k])) << name << " has a wrong face of element " << mesh.block(f.type).ids[f.cell];
        }
        area += (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
    }
    return area;
}

/// Text of all cards with a keyword.
inline std::string text_of(const Mesh& mesh, const std::string& keyword) {
    std::string out;
    for (const Card& card : solver_input(mesh)->cards())
        if (card.keyword == keyword)
            for (const DeckText& t : card.text) out += t.text;
    return out;
}

}  // namespace femscalpel::deck_testing
