// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/inp.h"
#include "mesh/order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "deck/solver_element.h"
#include "deck/solver_input.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path calculix_decks = "/usr/share/doc/calculix-ccx-test/examples/test";

/// A directory of its own per test, removed afterwards.
class Inp : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            fs::temp_directory_path() / ("femscalpel_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path file(const std::string& name, const std::string& text) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    Mesh read(const std::string& text) const {
        Mesh mesh = read_inp(file("deck.inp", text));
        mesh.validate();
        return mesh;
    }
    std::string write(const Mesh& mesh, const std::string& name = "out.inp") const {
        write_inp(mesh, folder_ / name);
        return text_of(folder_ / name);
    }
    static std::string text_of(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        std::stringstream text;
        text << in.rdbuf();
        return text.str();
    }
    std::string read_error(const std::string& text) const {
        try {
            read_inp(file("bad.inp", text));
        } catch (const ReadError& error) {
            return error.what();
        }
        return "no error";
    }
    std::string write_error(const Mesh& mesh) const {
        try {
            write_inp(mesh, folder_ / "out.inp");
        } catch (const WriteError& error) {
            return error.what();
        }
        return "no error";
    }

    fs::path folder_;
};

std::vector<Index> ids(const Mesh& mesh, std::string_view name, GroupKind kind) {
    const auto g = mesh.find_group(name, kind);
    if (!g) return {-1};
    auto out = group_members(mesh, *g).ids;
    std::ranges::sort(out);
    return out;
}

std::vector<std::pair<Index, Index>> faces(const Mesh& mesh, std::string_view name) {
    const auto g = mesh.find_group(name, GroupKind::facet);
    if (!g) return {{-1, -1}};
    const auto members = group_members(mesh, *g);
    std::vector<std::pair<Index, Index>> out;
    for (std::size_t i = 0; i < members.ids.size(); ++i) out.emplace_back(members.ids[i], members.faces[i]);
    std::ranges::sort(out);
    return out;
}

std::vector<std::string> visible_groups(const Mesh& mesh) {
    std::vector<std::string> out;
    for (const Group& g : mesh.groups)
        if (!g.hidden) out.push_back(std::string(to_string(g.kind)) + " " + g.name);
    return out;
}

/// All a mesh says, by numbers, so that order does not count.
std::string describe(const Mesh& mesh) {
    std::ostringstream out;
    out.precision(17);
    std::vector<std::size_t> order(mesh.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return mesh.node_ids[i]; });
    for (std::size_t i : order) out << "node " << mesh.node_ids[i] << ' ' << mesh.points[i].transpose() << '\n';
    for (const CellBlock& b : mesh.blocks()) {
        std::map<Index, Index> by_id;
        for (Index i = 0; i < b.size(); ++i) by_id[b.ids[i]] = i;
        for (const auto& [id, i] : by_id) {
            out << traits(b.type).name << ' ' << id;
            for (Index n : b.nodes(i)) out << ' ' << mesh.node_ids[n];
            out << '\n';
        }
    }
    // Members of all groups at once; asking group by group would take long on decks with many cards.
    std::map<std::string, std::set<std::pair<Index, int>>> members;
    const auto join = [&](FamilyIndex family, Index id, int face) {
        for (GroupIndex g : mesh.families.groups(family))
            if (!mesh.groups[g].hidden)
                members[std::string(to_string(mesh.groups[g].kind)) + " " + mesh.groups[g].name].insert({id, face});
    };
    for (const std::string& name : visible_groups(mesh)) members[name];
    for (Index i = 0; i < mesh.node_count(); ++i) join(mesh.node_families[i], mesh.node_ids[i], 0);
    for (const CellBlock& b : mesh.blocks())
        for (Index i = 0; i < b.size(); ++i) join(b.families[i], b.ids[i], 0);
    for (const Facet& f : mesh.facets) join(f.family, mesh.block(f.type).ids[f.cell], f.face);
    for (const auto& [name, entries] : members) {
        out << name << ':';
        for (const auto& [id, face] : entries) out << ' ' << id << '/' << face;
        out << '\n';
    }
    return out.str();
}

std::string cards_text(const Mesh& mesh) {
    std::string out;
    for (const Card& card : solver_input(mesh)->cards())
        for (const DeckText& t : card.text) out += t.text;
    return out;
}

const std::string two_tets = R"(** a small deck
*HEADING
Two tetrahedra
*NODE, NSET=NALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 0., 1., 0.
4, 0., 0., 1.
** the tip
5, 1., 1., 1.
*ELEMENT, TYPE=C3D4, ELSET=EALL
1, 1, 2, 3, 4
2, 2, 3, 4, 5
*NSET, NSET=FIX
1, 2, 3
*SURFACE, NAME=BOTTOM
1, S1
** material
*MATERIAL, NAME=STEEL
*ELASTIC
210000., .3
*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL
*BOUNDARY
FIX, 1, 3
*STEP
*STATIC
*CLOAD
5, 3, 1.
*NODE PRINT, NSET=NALL
U
*END STEP
)";

TEST_F(Inp, ReadsNodesElementsGroups) {
    const Mesh mesh = read(two_tets);
    EXPECT_EQ(mesh.name, "deck");
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_EQ(mesh.points[4], Vec3(1, 1, 1));
    EXPECT_THAT(mesh.block(CellType::tetra).ids, ElementsAre(1, 2));
    EXPECT_THAT(mesh.block(CellType::tetra).nodes(1), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(visible_groups(mesh), ElementsAre("node NALL", "element EALL", "node FIX", "facet BOTTOM"));
    EXPECT_THAT(ids(mesh, "NALL", GroupKind::node), ElementsAre(1, 2, 3, 4, 5));
    EXPECT_THAT(ids(mesh, "EALL", GroupKind::element), ElementsAre(1, 2));
    EXPECT_THAT(faces(mesh, "BOTTOM"), ElementsAre(std::pair(1, 1)));
    const auto card = mesh.find_group("*ELEMENT#1", GroupKind::element, true);
    ASSERT_TRUE(card);
    EXPECT_THAT(group_members(mesh, *card).ids, ElementsAre(1, 2));
    EXPECT_TRUE(mesh.find_group("*NODE#1", GroupKind::node, true));
    EXPECT_THAT(solver_input(mesh)->warnings(), IsEmpty());
}

TEST_F(Inp, KeepsCardsInOrderWithTheirParameters) {
    const Mesh mesh = read(two_tets);
    std::vector<std::string> keywords;
    for (const Card& c : solver_input(mesh)->cards()) keywords.push_back(c.keyword);
    EXPECT_THAT(keywords, ElementsAre("", "HEADING", "NODE", "ELEMENT", "NSET", "SURFACE", "MATERIAL", "ELASTIC",
                                      "SOLIDSECTION", "BOUNDARY", "STEP", "STATIC", "CLOAD", "NODEPRINT", "ENDSTEP"));
    const Card& section = solver_input(mesh)->cards()[8];
    ASSERT_TRUE(section.parameter("MATERIAL"));
    EXPECT_EQ(*section.parameter("MATERIAL"), "STEEL");
    EXPECT_FALSE(section.parameter("ORIENTATION"));
    EXPECT_THAT(section.where(), HasSubstr("deck.inp:22"));
    const Card& boundary = solver_input(mesh)->cards()[9];
    CardReader line(boundary);
    ASSERT_TRUE(line.next_data_line());
    EXPECT_EQ(line.field(), "FIX");
    Index dof = 0;
    EXPECT_TRUE(line.integer(dof));
    EXPECT_EQ(dof, 1);
    EXPECT_THAT(line.where(), HasSubstr("deck.inp:24: "));

    SolverInput copy = *solver_input(mesh);
    copy.cards()[9].set_text("*Boundary, op = NEW\nFIX, 1, 2\n");
    EXPECT_EQ(copy.cards()[9].keyword, "BOUNDARY");
    EXPECT_EQ(*copy.cards()[9].parameter("OP"), "NEW");
    EXPECT_EQ(solver_input(mesh)->cards()[9].parameter("OP"), nullptr);
    Mesh changed = mesh;
    changed.companion = std::make_shared<SolverInput>(copy);
    EXPECT_THAT(write(changed), HasSubstr("MATERIAL=STEEL\n*Boundary, op = NEW\nFIX, 1, 2\n*STEP\n"));
}

TEST_F(Inp, OddSpellingIsReadAsCalculixReadsIt) {
    const Mesh mesh = read(
        "* Node ,\r\n 1 ,1.d0, 2.D-1 , +3.\r\n\r\n\t2,\t1.5+1\r\n3\r\n4,1,\r\n10, 1 0, 1e-400, 1.E1,\r\n"
        "*  eLeMent, elset = My Set, Type = c3d4 \r\n** in between\r\n 7, 1,\r\n2, 3,\r\n** once more\r\n\r\n 10,\r\n"
        "*n set, NSET=n 1,\r\n1,, 3,\r\n*NSET, nset=N1, generate,\r\n2,4,\r\n");
    EXPECT_EQ(mesh.points[0], Vec3(1, .2, 3));
    EXPECT_EQ(mesh.points[1], Vec3(15, 0, 0));
    EXPECT_EQ(mesh.points[2], Vec3(0, 0, 0));
    EXPECT_EQ(mesh.points[3], Vec3(1, 0, 0));
    EXPECT_EQ(mesh.points[4], Vec3(10, 0, 10));
    EXPECT_THAT(mesh.block(CellType::tetra).connectivity, ElementsAre(0, 1, 2, 4));
    EXPECT_THAT(ids(mesh, "My Set", GroupKind::element), ElementsAre(7));
    EXPECT_THAT(ids(mesh, "n 1", GroupKind::node), ElementsAre(1, 2, 3, 4));
    EXPECT_EQ(write(mesh), cards_text(mesh));
}

TEST_F(Inp, KeywordLinesMayContinue) {
    const Mesh mesh = read(
        "*NODE,\nNSET=A\n1\n2\n*NSET, NSET=B,\n** comment is "
        "data's\n1\n*NSET,NSET=C,\nGENERATE\n1,2\n*NSET,NSET=D,\nB\n");
    EXPECT_THAT(ids(mesh, "A", GroupKind::node), ElementsAre(1, 2));
    EXPECT_THAT(ids(mesh, "B", GroupKind::node), ElementsAre(1));
    EXPECT_THAT(ids(mesh, "C", GroupKind::node), ElementsAre(1, 2));
    EXPECT_THAT(ids(mesh, "D", GroupKind::node), ElementsAre(1));
}

TEST_F(Inp, SetsFollowCalculixOrderNotTheDecks) {
    // CalculiX reads all *NODE, then *ELEMENT, *NSET, *ELSET, *SURFACE cards.
    const Mesh mesh = read(R"(*SURFACE, NAME=S
both, S2
*ELSET, ELSET=Both
first, SECOND
*ELSET, ELSET=BOTH, GENERATE
7, 9, 2
*NSET, NSET=A
1
*NSET, NSET=B
A, 2
*NSET, NSET=a
3, A
*ELEMENT, TYPE=C3D4, ELSET=First
1, 1, 2, 3, 4
*ELEMENT, TYPE=C3D4, ELSET=Second
2, 1, 2, 3, 4
*ELEMENT, TYPE=C3D4
7, 1, 2, 3, 4
9, 1, 2, 3, 4
*NODE
1
2,1
3,0,1
4,0,0,1
)");
    EXPECT_THAT(visible_groups(mesh),
                ElementsAre("facet S", "element Both", "node A", "node B", "element First", "element Second"));
    EXPECT_THAT(ids(mesh, "Both", GroupKind::element), ElementsAre(1, 2, 7, 9));
    EXPECT_THAT(ids(mesh, "A", GroupKind::node), ElementsAre(1, 3));
    EXPECT_THAT(ids(mesh, "B", GroupKind::node), ElementsAre(1, 2));
    EXPECT_THAT(faces(mesh, "S"), ElementsAre(std::pair(1, 2), std::pair(2, 2), std::pair(7, 2), std::pair(9, 2)));
    EXPECT_EQ(write(mesh), cards_text(mesh));
}

TEST_F(Inp, SurfacesOfAllKinds) {
    const Mesh mesh = read(R"(*NODE
1,0,0
2,1,0
3,1,1
4,0,1
*ELEMENT, TYPE=CPS4
1, 1,2,3,4
*ELEMENT, TYPE=S4R
2, 1,2,3,4
*ELEMENT, TYPE=CAX3
3, 1,2,3
*ELEMENT, TYPE=B31
4, 1,2
*ELSET, ELSET=E
1,2,3
*NSET, NSET=EDGE
1,2
*SURFACE, NAME=EDGE, TYPE=NODE
EDGE
3
*SURFACE, NAME=EDGE
E, S3
1, SN
2, SNEG
3, sp
4, S2
)");
    // Edges of plane elements are faces 3.. of a Facet, as a shell's.
    EXPECT_THAT(faces(mesh, "EDGE"), ElementsAre(std::pair(1, 1), std::pair(1, 5), std::pair(2, 1), std::pair(2, 3),
                                                 std::pair(3, 2), std::pair(3, 5)));
    EXPECT_THAT(ids(mesh, "EDGE", GroupKind::node), ElementsAre(1, 2));
    EXPECT_THAT(ids(mesh, "EDGE_SURFACE", GroupKind::node), ElementsAre(1, 2, 3));
    EXPECT_EQ(write(mesh), cards_text(mesh));

    Mesh changed = mesh;
    auto members = group_members(mesh, *mesh.find_group("EDGE", GroupKind::facet));
    members.ids.erase(members.ids.begin());
    members.faces.erase(members.faces.begin());
    set_group_members(changed, *mesh.find_group("EDGE", GroupKind::facet), members);
    set_group_members(changed, *mesh.find_group("EDGE_SURFACE", GroupKind::node), {GroupKind::node, {2, 4}, {}});
    const std::string text = write(changed);
    EXPECT_THAT(text, HasSubstr("*NSET, NSET=EDGE\n1,2\n"));
    EXPECT_THAT(text, HasSubstr("*SURFACE, NAME=EDGE, TYPE=NODE\n2\n4\n"));
    EXPECT_THAT(text, HasSubstr("4, S2\n"));
    EXPECT_EQ(describe(read(text)), describe(changed));
    for (const auto& [plane, label, face] :
         {std::tuple(true, 1, 3), {true, 4, 6}, {true, 5, 1}, {true, 6, 2}, {false, 1, 1}, {false, 5, 5}}) {
        EXPECT_EQ(face_from_label(label, CellType::quad, plane), face);
        EXPECT_EQ(label_from_face(face, CellType::quad, plane), label);
    }
}

TEST_F(Inp, ThreeNodeLinesHaveTheirMiddleNodeSecond) {
    const Mesh mesh = read("*NODE\n1,0\n2,1\n3,2\n*ELEMENT,TYPE=B32\n1,1,2,3\n*ELEMENT,TYPE=D\n2,1,2,3\n");
    EXPECT_THAT(mesh.block(CellType::line3).connectivity, ElementsAre(0, 2, 1, 0, 2, 1));
    Mesh changed = mesh;
    changed.block(CellType::line3).ids = {11, 12};
    EXPECT_THAT(write(changed), HasSubstr("*ELEMENT,TYPE=B32\n11, 1, 2, 3\n*ELEMENT,TYPE=D\n12, 1, 2, 3\n"));
}

TEST_F(Inp, MidSideNodesOfRealDecksAreBetweenTheirCorners) {
    if (!fs::exists(calculix_decks)) GTEST_SKIP() << "Debian package calculix-ccx-test is not installed";
    std::set<CellType> seen;
    for (const char* name :
         {"beamp.inp.gz", "c3d15.inp.gz", "beam10p.inp.gz", "shell1.inp.gz", "ax6.inp.gz", "simplebeam.inp.gz"}) {
        fs::path path = calculix_decks / name;
        if (!fs::exists(path)) path.replace_extension("");
        const Mesh mesh = read_inp(path);
        for (const CellBlock& b : mesh.blocks()) {
            const CellTraits& t = traits(b.type);
            if (!t.quadratic) continue;
            for (Index i = 0; i < b.size(); ++i)
                for (std::size_t k = 0; k < t.edges.size(); ++k) {
                    const auto n = b.nodes(i);
                    const Vec3 a = mesh.points[n[t.edges[k][0]]], c = mesh.points[n[t.edges[k][1]]];
                    const Vec3 middle = mesh.points[n[static_cast<std::size_t>(t.corners) + k]];
                    EXPECT_LT((middle - (a + c) / 2).norm(), 0.3 * (a - c).norm()) << name << " element " << b.ids[i];
                    seen.insert(b.type);
                }
        }
    }
    EXPECT_THAT(seen, testing::IsSupersetOf({CellType::hexahedron20, CellType::wedge15, CellType::tetra10,
                                             CellType::quad8, CellType::triangle6, CellType::line3}));
}

TEST_F(Inp, IncludesAreResolvedRelativeToTheirFile) {
    file("parts/nodes.txt", "1,0,0,0\n2,1,0,0\n*INCLUDE, INPUT=\"more.txt\"\n4,0,0,1");
    file("parts/more.txt", "3,0,1,0");
    file("el.inp", "*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n");
    const std::string text =
        "*NODE, NSET=N\n*include, input = parts/nodes.txt\n5,1,1,1\n*INCLUDE,INPUT=el.inp\n2,2,3,4,5\n*STEP\n";
    const Mesh mesh = read(text);
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_THAT(ids(mesh, "E", GroupKind::element), ElementsAre(1, 2));
    EXPECT_EQ(write(mesh),
              "*NODE, "
              "NSET=N\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n2,2,3,4,5\n*"
              "STEP\n");
    file("parts/more.txt", "3,0,1,zero\n");
    EXPECT_THAT(read_error(text), HasSubstr("more.txt:1: coordinate 3 of node 3, 'zero'"));
    file("parts/more.txt", "*INCLUDE, INPUT=nodes.txt\n");
    EXPECT_THAT(read_error(text), HasSubstr("more.txt:1: 'nodes.txt' includes itself"));
    EXPECT_THAT(read_error("*NODE\n1\n\n*INCLUDE,INPUT=nowhere.inp\n"),
                HasSubstr("bad.inp:4: the included file 'nowhere.inp' does not exist"));
    EXPECT_THAT(read_error("*NODE\n1\n*INCLUDE\n"), HasSubstr("bad.inp:3: *INCLUDE needs INPUT=file"));
}

TEST_F(Inp, ReadsAndWritesGzip) {
    const Mesh mesh = read(two_tets);
    write_inp(mesh, folder_ / "deck.inp.gz");
    const std::string packed = text_of(folder_ / "deck.inp.gz");
    EXPECT_TRUE(packed.starts_with("\x1f\x8b"));
    const Mesh again = read_inp(folder_ / "deck.inp.gz");
    EXPECT_EQ(again.name, "deck");
    EXPECT_EQ(describe(again), describe(mesh));
    EXPECT_EQ(cards_text(again), two_tets);
    for (std::size_t size : {std::size_t{3}, packed.size() / 2, packed.size() - 1})
        EXPECT_THAT(read_error(packed.substr(0, size)), HasSubstr("bad.inp: the gzip'd file is truncated or damaged"));
}

TEST_F(Inp, ExtensionsOfPackedFilesHaveNoCase) {
    const Mesh mesh = read(two_tets);
    for (const char* name : {"deck.inp.GZ", "deck.inp.Gz", "deck.INP.gZ"}) {
        write_inp(mesh, folder_ / name);
        EXPECT_TRUE(text_of(folder_ / name).starts_with("\x1f\x8b")) << name;
        EXPECT_EQ(read_inp(folder_ / name).name, "deck") << name;
    }
}

TEST_F(Inp, RefusesNumbersThatCalculixCannotHold) {
    Mesh mesh = read(two_tets);
    mesh.node_ids.back() = 2147483647;
    write_inp(mesh, folder_ / "large.inp");
    EXPECT_EQ(read_inp(folder_ / "large.inp").node_ids, mesh.node_ids);
    mesh.node_ids.back() = 2147483648;
    EXPECT_THAT([&] { write_inp(mesh, folder_ / "larger.inp"); },
                testing::ThrowsMessage<WriteError>(testing::EndsWith(
                    "larger.inp: cannot be written: node number 2147483648 is larger than CalculiX can hold "
                    "(2147483647)")));
    mesh.node_ids.back() = 2147483647;
    mesh.block(CellType::tetra).ids.back() = 3000000000;
    EXPECT_THAT([&] { write_inp(mesh, folder_ / "larger.inp"); },
                testing::ThrowsMessage<WriteError>(HasSubstr("element number 3000000000 is larger")));
    EXPECT_FALSE(fs::exists(folder_ / "larger.inp"));
}

TEST_F(Inp, EveryErrorNamesFileAndLine) {
    const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";  // lines 1 to 5
    const std::string tet = nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";        // lines 6 and 7
    const std::pair<std::string, std::string> cases[] = {
        {"", "bad.inp: there are no nodes in this file"},
        {std::string("\0\0\x01garbage", 10), "bad.inp: there are no nodes in this file"},
        {"*NODE\n1,0,0,0\n1,0,0,1e-30\n", "bad.inp:3: node 1 was defined before with other coordinates"},
        {"*NODE\n1,0,0,nan\n", "bad.inp:2: coordinate 3 of node 1, 'nan', is not a finite number"},
        {"*NODE\n1,0,inf\n", "bad.inp:2: coordinate 2 of node 1, 'inf'"},
        {"*NODE\n1,1e999\n", "bad.inp:2: coordinate 1 of node 1, '1e999'"},
        {"*NODE\n1,1.2.3\n", "bad.inp:2: coordinate 1 of node 1, '1.2.3'"},
        {"*NODE\n0,1\n", "bad.inp:2: a node number 0 is not between 1 and 2147483647"},
        {"*NODE\n99999999999,1\n", "bad.inp:2: a node number 99999999999"},
        {"*NODE\nA,1\n", "bad.inp:2: 'A' is not a node number"},
        {"*NODE NSET=A\n1\n", "bad.inp:1: a comma is missing after *NODE"},
        {nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3\n", "bad.inp:7: element 1 ends after 3 of its 4 nodes"},
        {nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3\n2,1,2,3,4\n",
         "bad.inp:8: element 1, which starts before this line, has not its 4 nodes"},
        {nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3,5\n",
         "bad.inp:7: element 1 names node 5, which the deck does not define"},
        {nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3,x\n", "bad.inp:7: 'x' in element 1 is not a node number"},
        {nodes + "*ELEMENT,TYPE=C3D4\n1,1,,3,4\n", "bad.inp:7: '' in element 1 is not a node number"},
        {nodes + "*ELEMENT,TYPE=C3D4\n-1,1,2,3,4\n", "bad.inp:7: an element number -1"},
        {tet + "*ELEMENT,TYPE=S3\n\n1,1,2,3\n", "bad.inp:10: element number 1 is used before"},
        {nodes + "*ELEMENT,TYPE=C3D99\n1,1,2,3,4\n", "bad.inp:6: elements of type C3D99 are not known to CalculiX"},
        {nodes + "*ELEMENT,ELSET=A\n1,1,2,3,4\n", "bad.inp:6: *ELEMENT needs TYPE="},
        {nodes + "*NSET\n1\n", "bad.inp:6: *NSET needs NSET=name"},
        {nodes + "*NSET,NSET=\n1\n", "bad.inp:6: NSET= without a name"},
        {nodes + "*NSET,NSET=" + std::string(81, 'A') + "\n1\n", "longer than the 80 characters"},
        {nodes + "*NSET,NSET=A\n1\nB\n", "bad.inp:8: 'B' is neither a number nor a node set defined before this line"},
        {nodes + "*NSET,NSET=A\nB\n*NSET,NSET=B\n1\n", "bad.inp:7: 'B' is neither"},
        {nodes + "*NSET,NSET=A,GENERATE\n4,1\n", "bad.inp:7: GENERATE needs"},
        {nodes + "*NSET,NSET=A,GENERATE\n1,4,0\n", "bad.inp:7: GENERATE needs"},
        {tet + "*SURFACE,NAME=A\n1,S5\n", "bad.inp:9: element 1, a tetra, has no face S5"},
        {tet + "*SURFACE,NAME=A\n1,K1\n", "bad.inp:9: 'K1' is not a face"},
        {tet + "*SURFACE,NAME=A\nE,S1\n", "bad.inp:9: 'E' is neither a number nor an element set"},
        {tet + "*SURFACE,NAME=A,TYPE=CUTTING\n1,S1\n", "bad.inp:8: *SURFACE of TYPE=CUTTING"},
        {tet + "*SURFACE\n1,S1\n", "bad.inp:8: *SURFACE needs NAME=name"},
        {nodes + "*SURFACE,NAME=A,TYPE=NODE\n1,2\n", "bad.inp:7: only one node or node set per line"},
    };
    for (const auto& [text, message] : cases) EXPECT_THAT(read_error(text), HasSubstr(message)) << text;
    EXPECT_THROW(read_inp(folder_ / "missing.inp"), ReadError);
    EXPECT_THROW(read_inp(folder_), ReadError);
}

TEST_F(Inp, WarnsWhereCalculixWarns) {
    const Mesh mesh = read(
        "*NODE, FOO=1\n1\n2,1\n3,0,1\n1,0,0,0\n*ELEMENT,TYPE=S3,ELSET=E\n1,1,2,3,99\n"
        "*NSET,NSET=A\n1,8,9\n*ELSET,ELSET=B\n1,7\n*NSET,NSET=C,GENERATE\n2,1000000000\n");
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3));  // node 1 was repeated with the same coordinates
    EXPECT_THAT(ids(mesh, "A", GroupKind::node), ElementsAre(1));
    EXPECT_THAT(ids(mesh, "B", GroupKind::element), ElementsAre(1));
    EXPECT_THAT(ids(mesh, "C", GroupKind::node), ElementsAre(2, 3));
    EXPECT_THAT(solver_input(mesh)->warnings(),
                ElementsAre(HasSubstr("deck.inp:1: *NODE has no parameter FOO"),
                            HasSubstr("deck.inp:6: 1 elements of type S3 are followed by more"),
                            HasSubstr("deck.inp:8: node set 'A' names node 8 and 1 more that the deck does not define"),
                            HasSubstr("deck.inp:10: element set 'B' names element 7 that")));
    EXPECT_EQ(write(mesh), cards_text(mesh));
}

TEST_F(Inp, WarnsOfCoordinatesThatCalculixCuts) {
    const Mesh mesh =
        read("*NODE\n1, 0.1234567890123456789012\n2, 0.1234567890123456789e-12\n3, 0., 1.00000000000000000000d1\n");
    EXPECT_EQ(mesh.points[1].x(), 0.1234567890123456789e-12);
    EXPECT_THAT(solver_input(mesh)->warnings(),
                ElementsAre(HasSubstr("deck.inp:3: 2 nodes, this one first, have coordinates of more than 20")));
}

TEST_F(Inp, ElementsWithoutPlaceInTheMeshAreKept) {
    const Mesh mesh = read(R"(*NODE
1,0
2,1
3,2
4,3
*USER ELEMENT, TYPE=U1, NODES=2, INTEGRATION POINTS=2, MAXDOF=6
*ELEMENT, TYPE=U1, ELSET=U
10, 1,
2
11, 2, 3
*ELEMENT, TYPE=D, ELSET=NET
1, 0, 1, 2
2, 2, 3, 4
*ELSET, ELSET=ALL
10, 1
NET
)");
    EXPECT_THAT(mesh.block(CellType::line3).ids, ElementsAre(2));
    ASSERT_EQ(solver_input(mesh)->other_elements().size(), 3u);
    EXPECT_THAT(solver_input(mesh)->other_elements()[2].nodes, ElementsAre(0, 1, 2));
    EXPECT_EQ(solver_input(mesh)->largest_other_element(), 11);
    EXPECT_THAT(ids(mesh, "ALL", GroupKind::element), ElementsAre(2));
    EXPECT_EQ(write(mesh), cards_text(mesh));

    Mesh changed = mesh;
    set_group_members(changed, *changed.find_group("ALL"), {GroupKind::element, {}, {}});
    const std::string text = write(changed);
    EXPECT_THAT(text, HasSubstr("*ELSET, ELSET=ALL\n1, 10, \n"));
    EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=D, ELSET=NET\n1, 0, 1, 2\n2, 2, 3, 4\n"));
    Mesh clash = mesh;
    clash.block(CellType::line3).ids[0] = 11;
    EXPECT_THAT(write_error(clash), HasSubstr("element number 11 is used in the mesh and by an element of type U1"));
}

TEST_F(Inp, UntouchedDeckIsWrittenByteForByte) {
    EXPECT_EQ(write(read(two_tets)), two_tets);
    std::string crlf;
    for (char c : two_tets) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(write(read(crlf)), crlf);
    const std::string no_newline = two_tets.substr(0, two_tets.size() - 1);
    EXPECT_EQ(write(read(no_newline)), no_newline);
}

TEST_F(Inp, OnlyChangedLinesChange) {
    Mesh mesh = read(two_tets);
    mesh.points[3].z() = 1.25;
    mesh.add_node({1, 1, 0}, 6, mesh.node_families[4]);
    mesh.block(CellType::tetra).connectivity[7] = 5;
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{1, 2, 4, 5}, 3, mesh.block(CellType::tetra).families[0]);
    std::string expected = two_tets;
    const auto replace = [&](const std::string& from, const std::string& to) {
        expected.replace(expected.find(from), from.size(), to);
    };
    replace("4, 0., 0., 1.\n", "4, 0, 0, 1.25\n");
    replace("5, 1., 1., 1.\n", "5, 1., 1., 1.\n6, 1, 1, 0\n");
    replace("2, 2, 3, 4, 5\n", "2, 2, 3, 4, 6\n3, 2, 3, 5, 6\n");
    EXPECT_EQ(write(mesh), expected);
    EXPECT_EQ(describe(read(write(mesh))), describe(mesh));
}

TEST_F(Inp, NodesWithoutCardGoAfterTheLastNodeCard) {
    Mesh mesh = read(two_tets);
    mesh.add_node({.1, .2, .3}, 6);
    const std::string text = write(mesh);
    EXPECT_THAT(text, HasSubstr("5, 1., 1., 1.\n*NODE\n6, 0.1, 0.2, 0.3\n*ELEMENT"));
    EXPECT_THAT(ids(read(text), "NALL", GroupKind::node), ElementsAre(1, 2, 3, 4, 5));
}

TEST_F(Inp, ChangedSetsAreListedOnceAndParametersDropIfWrong) {
    Mesh mesh = read(R"(*NODE, NSET=NALL, FOO=1
1
2,1
3,0,1
4,0,0,1
*ELEMENT, TYPE=C3D4, ELSET=E
1, 1,2,3,4
2, 1,2,3,4
*NSET, NSET=A
1
*NSET, NSET=B
A, 2
** before A again
*NSET, NSET=A
3
** after A
*NSET, NSET=RANGE, GENERATE
1, 100
*STEP
)");
    const auto set = [&](std::string_view name, GroupKind kind, std::vector<Index> members) {
        set_group_members(mesh, *mesh.find_group(name, kind), {kind, std::move(members), {}});
    };
    set("A", GroupKind::node, {1, 3, 4});  // B names A and must not grow with it
    set("NALL", GroupKind::node, {1, 2, 3});
    set("E", GroupKind::element, {2});
    mesh.add_node({5, 5, 5}, 5);  // within 1..100, but not in RANGE
    const std::string text = write(mesh);
    EXPECT_EQ(text, R"(*NODE, FOO=1
1
2,1
3,0,1
4,0,0,1
*NSET, NSET=NALL
1, 2, 3, 
*NODE
5, 5, 5, 5
*ELEMENT, TYPE=C3D4
1, 1,2,3,4
2, 1,2,3,4
*ELSET, ELSET=E
2, 
*NSET, NSET=A
1, 3, 4, 
*NSET, NSET=B
1, 2, 
** before A again
** after A
*NSET, NSET=RANGE
1, 2, 3, 4, 
*STEP
)");
    EXPECT_EQ(describe(read(text)), describe(mesh));
}

TEST_F(Inp, SetsAreCompletedWithoutRepeatingMembers) {
    // CalculiX keeps repeated members of a set and would load and print them twice.
    Mesh mesh = read(two_tets);
    mesh.add_node({2, 2, 2}, 6);
    set_group_members(mesh, *mesh.find_group("NALL"), {GroupKind::node, {1, 2, 3, 4, 5, 6}, {}});
    const std::string text = write(mesh);
    EXPECT_THAT(text, HasSubstr("*NODE, NSET=NALL\n1,"));
    EXPECT_THAT(text, HasSubstr("\n*NSET, NSET=NALL\n6, \n"));
    EXPECT_EQ(describe(read(text)), describe(mesh));
}

TEST_F(Inp, RemovedEntitiesAndGroupsLeaveTheDeck) {
    Mesh mesh = read(two_tets + "*NSET, NSET=AFTER\nFIX, 5\n");
    // Element 2 and node 5 go, FIX becomes empty, BOTTOM is dropped altogether.
    Mesh out;
    for (const Group& g : mesh.groups) out.groups.push_back(g);
    out.families = mesh.families;
    out.companion = mesh.companion;
    for (Index i = 0; i < 4; ++i) out.add_node(mesh.points[i], mesh.node_ids[i], mesh.node_families[i]);
    out.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1, mesh.block(CellType::tetra).families[0]);
    set_group_members(out, *out.find_group("FIX"), {GroupKind::node, {}, {}});
    remove_group(out, *out.find_group("BOTTOM"));
    const std::string text = write(out);
    EXPECT_THAT(text, HasSubstr("4, 0., 0., 1.\n** the tip\n*ELEMENT, TYPE=C3D4, ELSET=EALL\n1, 1, 2, 3, 4\n*NODE, "
                                "NSET=FIX\n** material\n"));
    EXPECT_THAT(text, Not(HasSubstr("BOTTOM")));
    const Mesh again = read(text);
    EXPECT_THAT(ids(again, "FIX", GroupKind::node), IsEmpty());
    EXPECT_THAT(ids(again, "AFTER", GroupKind::node), ElementsAre(1, 2, 3));  // its own members did not change
    EXPECT_EQ(describe(again), describe(out));
}

TEST_F(Inp, FacesAndEdgesMadeByAnOperatorBecomeSurfacesAndNodeSets) {
    Mesh mesh = read(two_tets);
    const GroupIndex lip = mesh.add_group("CRACK_P", GroupKind::element);
    const GroupIndex front = mesh.add_group("CRACK_FRONT", GroupKind::element);
    const GroupIndex tip = mesh.add_group("TIP", GroupKind::node);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{4, 2, 1}, 10);  // face of element 2: nodes 2, 3, 5
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{3, 2, 1}, 11);  // between both: 2, 3, 4
    mesh.add_cell(CellType::line, std::array<Index, 2>{2, 1}, 12);
    set_group_members(mesh, lip, {GroupKind::element, {10, 11}, {}});
    set_group_members(mesh, front, {GroupKind::element, {12}, {}});
    set_group_members(mesh, tip, {GroupKind::node, {5}, {}});
    const std::string text = write(mesh);
    EXPECT_THAT(text, HasSubstr("1, S1\n*NSET, NSET=TIP\n5, \n** 2 faces of element group 'CRACK_P' on other elements\n"
                                "*NSET, NSET=CRACK_P\n2, 3, 4, 5, \n"));
    EXPECT_THAT(text, HasSubstr("*NSET, NSET=CRACK_FRONT\n2, 3, \n"));
    EXPECT_THAT(text, HasSubstr("*SURFACE, NAME=CRACK_P, TYPE=ELEMENT\n1, S3\n2, S2\n** material\n"));
    const Mesh again = read(text);
    EXPECT_EQ(again.cell_count(), 2);
    EXPECT_THAT(faces(again, "CRACK_P"), ElementsAre(std::pair(1, 3), std::pair(2, 2)));
    // The faces are those of the triangles.
    EXPECT_THAT(ids(again, "CRACK_P", GroupKind::node), ElementsAre(2, 3, 4, 5));
}

TEST_F(Inp, EdgesOnShellsBecomeEdgeSurfaces) {
    Mesh mesh = read(
        "*NODE\n1\n2,1\n3,1,1\n4,0,1\n*ELEMENT,TYPE=S3,ELSET=E\n1,1,2,3\n2,1,3,4\n*ELEMENT,TYPE=CPS3\n3,2,3,4\n*"
        "STEP\n");
    const GroupIndex g = mesh.add_group("LIP", GroupKind::element);
    mesh.add_cell(CellType::line, std::array<Index, 2>{0, 1}, 10);
    mesh.add_cell(CellType::line, std::array<Index, 2>{3, 1}, 11);
    set_group_members(mesh, g, {GroupKind::element, {10, 11}, {}});
    const std::string text = write(mesh);
    EXPECT_THAT(text, HasSubstr("*SURFACE, NAME=LIP, TYPE=ELEMENT\n1, S3\n3, S3\n*STEP\n"));
    EXPECT_THAT(faces(read(text), "LIP"), ElementsAre(std::pair(1, 3), std::pair(3, 5)));
}

Mesh box_from_med() {
    // As from MED: a hexahedron, its skin and one edge as elements, a free shell, a free beam, a point.
    Mesh mesh;
    mesh.name = "box";
    for (int i = 0; i < 8; ++i)
        mesh.add_node({double((i & 1) ^ ((i >> 1) & 1)), double((i >> 1) & 1), double(i >> 2)}, i + 1);
    mesh.add_node({2, 0, 0}, 9);
    mesh.add_node({3, 1, 0}, 10);
    mesh.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}, 1);
    mesh.add_cell(CellType::quad, std::array<Index, 4>{7, 6, 5, 4}, 2);
    mesh.add_cell(CellType::line, std::array<Index, 2>{0, 4}, 3);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{1, 8, 9}, 4);
    mesh.add_cell(CellType::line, std::array<Index, 2>{8, 7}, 5);
    mesh.add_cell(CellType::vertex, std::array<Index, 1>{9}, 6);
    const std::pair<const char*, std::vector<Index>> groups[] = {{"SOLID", {1}},    {"TOP", {2}}, {"EDGE", {3}},
                                                                 {"PLATE", {4}},    {"ROD", {5}}, {"POINT", {6}},
                                                                 {"MIXED", {1, 2}}, {"NONE", {}}};
    for (const auto& [name, members] : groups)
        set_group_members(mesh, mesh.add_group(name, GroupKind::element), {GroupKind::element, members, {}});
    set_group_members(mesh, mesh.add_group("TOP", GroupKind::node), {GroupKind::node, {5}, {}});
    return mesh;
}

TEST_F(Inp, MeshFromAnotherFormatIsWrittenByWhatItsElementsAre) {
    const std::string text = write(box_from_med());
    EXPECT_TRUE(text.starts_with("*HEADING\nbox\n*NODE\n1, 0, 0, 0\n")) << text;
    const Mesh mesh = read(text);
    EXPECT_EQ(mesh.points[6], box_from_med().points[6]);
    EXPECT_THAT(mesh.block(CellType::quad).ids, IsEmpty());
    EXPECT_THAT(mesh.block(CellType::triangle).ids, ElementsAre(4));
    EXPECT_THAT(mesh.block(CellType::line).ids, ElementsAre(5));
    EXPECT_THAT(ids(mesh, "SOLID", GroupKind::element), ElementsAre(1));
    EXPECT_THAT(faces(mesh, "TOP"), ElementsAre(std::pair(1, 2)));
    EXPECT_THAT(ids(mesh, "TOP", GroupKind::node), ElementsAre(5));  // the node group, not the face's nodes
    EXPECT_THAT(ids(mesh, "EDGE", GroupKind::node), ElementsAre(1, 5));
    EXPECT_THAT(ids(mesh, "POINT", GroupKind::node), ElementsAre(10));
    EXPECT_THAT(ids(mesh, "PLATE", GroupKind::element), ElementsAre(4));
    EXPECT_THAT(ids(mesh, "ROD", GroupKind::element), ElementsAre(5));
    EXPECT_THAT(ids(mesh, "MIXED", GroupKind::element), ElementsAre(1));
    EXPECT_THAT(faces(mesh, "MIXED"), ElementsAre(std::pair(1, 2)));
    EXPECT_THAT(ids(mesh, "NONE", GroupKind::element), IsEmpty());
    EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"));
    EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=S3\n4, 2, 9, 10\n"));
    EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=B31\n5, 9, 8\n"));
    EXPECT_EQ(write(mesh), text);
}

TEST_F(Inp, PyramidsAreHexahedraWithOneUpperNode) {
    Mesh mesh = box_from_med();
    mesh.add_node({0.5, 0.5, 2}, 11);
    mesh.add_cell(CellType::pyramid, std::array<Index, 5>{4, 5, 6, 7, 10}, 20);
    set_group_members(mesh, mesh.add_group("SIDE", GroupKind::facet), {GroupKind::facet, {20, 20}, {1, 2}});
    const std::string text = write(mesh);
    EXPECT_THAT(text, HasSubstr("20, 5, 6, 7, 8, 11, 11, 11, 11\n"));
    EXPECT_THAT(text, HasSubstr("20, S1\n20, S3\n"));
    const Mesh back = read(text);
    ASSERT_EQ(back.block(CellType::pyramid).size(), 1);
    EXPECT_THAT(back.block(CellType::pyramid).nodes(0), ElementsAre(4, 5, 6, 7, 10));
    EXPECT_THAT(faces(back, "SIDE"), ElementsAre(std::pair(20, 1), std::pair(20, 2)));
    EXPECT_EQ(write(back), text);

    Mesh second = to_second_order(mesh);
    const Mesh again = read(write(second));
    ASSERT_EQ(again.block(CellType::pyramid13).size(), 1);
    EXPECT_TRUE(
        std::ranges::equal(again.block(CellType::pyramid13).nodes(0), second.block(CellType::pyramid13).nodes(0)));
    EXPECT_EQ(write(again), write(second));
    // The card of the old Abaqus type has five nodes, and keeps them.
    const Mesh five = read("*NODE\n1,0\n2,1\n3,1,1\n4,0,1\n5,0,0,1\n*ELEMENT,TYPE=C3D5\n1,1,2,3,4,5\n");
    EXPECT_THAT(write(five), HasSubstr("1,1,2,3,4,5\n"));
}

TEST_F(Inp, WhatCalculixCannotHoldIsRefused) {
    Mesh mesh = box_from_med();
    mesh.add_cell(CellType::quad9, std::array<Index, 9>{0, 1, 9, 8, 2, 3, 4, 5, 6}, 20);
    EXPECT_THAT(write_error(mesh), HasSubstr("out.inp: 1 elements of type quad9: CalculiX has no such element"));
    mesh = box_from_med();
    mesh.add_group("top", GroupKind::node);
    EXPECT_THAT(write_error(mesh), HasSubstr("groups 'TOP' and 'top' would be one node set in CalculiX"));
    mesh = box_from_med();
    mesh.add_group("A,B", GroupKind::node);
    EXPECT_THAT(write_error(mesh), HasSubstr("group 'A,B' cannot be a CalculiX set"));
    mesh = box_from_med();
    mesh.add_group(std::string(81, 'X'), GroupKind::element);
    EXPECT_THAT(write_error(mesh), HasSubstr("cannot be a CalculiX set"));
    mesh = box_from_med();
    set_group_members(mesh, mesh.add_group("Top", GroupKind::facet), {GroupKind::facet, {1}, {2}});
    EXPECT_THAT(write_error(mesh), HasSubstr("groups 'Top' and 'TOP' would be one element surface"));
    EXPECT_THAT(write_error(Mesh()), HasSubstr("the mesh has no nodes"));
    EXPECT_FALSE(fs::exists(folder_ / "out.inp"));
    EXPECT_THROW(write_inp(box_from_med(), folder_ / "no" / "such" / "folder.inp"), WriteError);

    Mesh deck = read(two_tets);
    deck.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 3, 0, 1, 2, 3}, 9,
                  deck.block(CellType::tetra).families[0]);
    EXPECT_THAT(write_error(deck), HasSubstr("element 9, a hexahedron, stands under"));
    deck = read(two_tets);
    deck.add_group("fix", GroupKind::node);
    EXPECT_THAT(write_error(deck), HasSubstr("groups 'FIX' and 'fix' would be one node set"));
}

TEST_F(Inp, CoordinatesFitCalculixFieldsAndReadBack) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> mantissa(-10, 10);
    std::uniform_int_distribution<int> exponent(-30, 30);
    Mesh mesh;
    for (Index i = 0; i < 20000; ++i) {
        Vec3 x;
        for (int k = 0; k < 3; ++k) x[k] = mantissa(random) * (i % 2 ? 1.0 : std::pow(10., exponent(random)));
        mesh.add_node(x, i + 1);
    }
    mesh.add_node({1.2345678901234567e308, 5e-324, -2.2250738585072014e-308}, 30001);
    mesh.add_node({-0., 1. / 3, 123456789012345678.}, 30002);
    const Mesh again = read(write(mesh));
    ASSERT_EQ(again.node_ids, mesh.node_ids);
    Index exact = 0, common = 0;
    for (Index i = 0; i < mesh.node_count(); ++i)
        for (int k = 0; k < 3; ++k) {
            const double x = mesh.points[i][k], y = again.points[i][k];
            EXPECT_LE(std::abs(x - y),
                      (std::abs(x) > 1e-90 && std::abs(x) < 1e90 ? 5e-15 : 5e-14) * std::abs(x) + 5e-324)
                << x;
            if (std::abs(x) >= 0.1 && std::abs(x) < 1e6) ++common, exact += x == y;
        }
    EXPECT_EQ(exact, common);  // coordinates of ordinary size lose nothing
    std::istringstream lines(text_of(folder_ / "out.inp"));
    std::string line;
    while (std::getline(lines, line)) {
        std::istringstream fields(line);
        std::string field;
        while (std::getline(fields, field, ',')) {
            std::erase(field, ' ');
            EXPECT_LE(field.size(), 20u) << line;
        }
    }
}

std::vector<fs::path> real_decks() {
    std::vector<fs::path> out;
    if (fs::exists(calculix_decks))
        for (const auto& entry : fs::directory_iterator(calculix_decks)) {
            const std::string name = entry.path().filename().string();
            if (name.ends_with(".inp") || name.ends_with(".inp.gz")) out.push_back(entry.path());
        }
    std::ranges::sort(out);
    return out;
}

/// Decks that cannot be read, and why.
const std::map<std::string, std::string> unreadable = {
    // They take their mesh from a restart file; all but the first come with CalculiX 2.22.
    {"beamread.inp", "there are no nodes in this file"},  {"beamread2.inp", "there are no nodes in this file"},
    {"beamread3.inp", "there are no nodes in this file"}, {"beamread4.inp", "there are no nodes in this file"},
    {"beamhtfc2.inp", "there are no nodes in this file"},
};

/// Makes every set be listed anew: pretends that its cards named one more number when they were read.
Mesh with_sets_listed_anew(const Mesh& mesh) {
    auto input = std::make_shared<SolverInput>(*solver_input(mesh));
    for (DeckSet& set : input->sets()) ++set.absent;
    Mesh out = mesh;
    out.companion = input;
    return out;
}

TEST_F(Inp, CalculixDecksRoundTrip) {
    const auto decks = real_decks();
    if (decks.empty()) GTEST_SKIP() << "Debian package calculix-ccx-test is not installed";
    Index read_decks = 0, refused = 0;
    for (const fs::path& path : decks) {
        SCOPED_TRACE(path.string());
        if (const auto reason = unreadable.find(path.filename().string()); reason != unreadable.end()) {
            ++refused;
            try {
                read_inp(path);
                ADD_FAILURE() << "could be read";
            } catch (const ReadError& error) {
                EXPECT_THAT(error.what(), HasSubstr(reason->second));
            }
            continue;
        }
        Mesh mesh;
        ASSERT_NO_THROW(mesh = read_inp(path));
        mesh.validate();
        ++read_decks;
        ASSERT_EQ(write(mesh), cards_text(mesh));

        // The same with nothing written verbatim: other numbers, other coordinates, sets listed anew.
        Mesh other = with_sets_listed_anew(mesh);
        for (CellBlock& b : other.blocks())
            for (Index& id : b.ids) id += 200000;
        for (Vec3& x : other.points)
            for (double& c : x) c = std::round(c * 1e6 + 500) / 1e6;
        if (solver_input(mesh)->other_elements().empty())
            for (Index& id : other.node_ids) id += 100000;
        ASSERT_NO_THROW(write(other));
        Mesh again;
        ASSERT_NO_THROW(again = read_inp(folder_ / "out.inp"));
        again.validate();
        if (describe(again) != describe(other)) ADD_FAILURE() << "the deck changed";
    }
    EXPECT_EQ(read_decks + refused, static_cast<Index>(decks.size()));
}

TEST_F(Inp, DamagedDecksGiveAMeshOrAReadError) {
    std::vector<std::pair<std::string, std::string>> sources = {{"two_tets", two_tets}};
    for (const char* name :
         {"contact1", "branch1", "bolt", "edgeload", "planestress3", "distcoup", "simplebeam", "dashpot1"}) {
        fs::path path = calculix_decks / (std::string(name) + ".inp");
        if (!fs::exists(path)) path += ".gz";
        if (!fs::exists(path)) continue;
        const Mesh mesh = read_inp(path);
        sources.emplace_back(name, cards_text(mesh));
    }
    std::mt19937 random(20240);
    const auto pick = [&random](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    Index meshes = 0, errors = 0;
    for (int round = 0; round < 500; ++round) {
        const auto& [name, text] = sources[static_cast<std::size_t>(round) % sources.size()];
        std::string damaged = text;
        if (round % 3 == 0) damaged.resize(pick(damaged.size()));
        const std::size_t flips = round % 3 == 0 ? pick(3) : 1 + pick(8);
        for (std::size_t k = 0; k < flips && !damaged.empty(); ++k) {
            char& c = damaged[pick(damaged.size())];
            c = round % 2 ? static_cast<char>(pick(256)) : "0123456789,*\n-=.eDAS"[pick(20)];
        }
        const fs::path path = file("damaged.inp", damaged);
        try {
            const Mesh mesh = read_inp(path);
            mesh.validate();
            ++meshes;
            EXPECT_EQ(write(mesh), cards_text(mesh)) << name << " round " << round;
        } catch (const ReadError& error) {
            ++errors;
            EXPECT_THAT(error.what(), HasSubstr("damaged.inp")) << name << " round " << round;
        } catch (const WriteError&) {
            // a damaged name can be one that CalculiX does not take
        } catch (const std::exception& error) {
            ADD_FAILURE() << name << " round " << round << ": " << error.what();
        }
    }
    EXPECT_GT(meshes, 50);
    EXPECT_GT(errors, 50);
}

/// Rows of numbers in a CalculiX .dat file, ascending: the order of a set's members does not count. Rows
/// of zeros are left out: CalculiX prints such for numbers in a GENERATE range that no node has.
std::vector<std::vector<double>> result_rows(const fs::path& path) {
    std::vector<std::vector<double>> rows;
    std::ifstream in(path);
    std::string line;
    while (std::getline(in, line)) {
        std::istringstream fields(line);
        std::vector<double> row;
        double value = 0;
        while (fields >> value) row.push_back(value);
        const bool zeros = std::all_of(row.begin() + (row.empty() ? 0 : 1), row.end(), [](double v) { return v == 0; });
        if (row.size() > 1 && fields.eof() && !zeros) rows.push_back(row);
    }
    std::ranges::sort(rows);
    return rows;
}

TEST_F(Inp, CalculixGivesTheSameResultsForWrittenDecks) {
    if (std::system("command -v ccx >/dev/null 2>&1") != 0) GTEST_SKIP() << "ccx is not installed";
    if (!fs::exists(calculix_decks)) GTEST_SKIP() << "Debian package calculix-ccx-test is not installed";
    const char* const names[] = {"achtel2", "achtelc",  "beam8p",      "beamt",      "beam10p",      "simplebeam",
                                 "truss",   "spring1",  "spring3",     "dashpot1",   "planestress3", "axial",
                                 "ax6",     "c3d15",    "c3d6",        "contact1",   "contact3",     "pipe",
                                 "pret1",   "distcoup", "solidshell1", "beamptied1", "beamptied2",   "shell2",
                                 "shell1",  "rot1",     "dloadlinI",   "cubespring", "pipempc1"};
    for (const std::string name : names) {
        SCOPED_TRACE(name);
        fs::path path = calculix_decks / (name + ".inp");
        if (!fs::exists(path)) path += ".gz";
        ASSERT_TRUE(fs::exists(path));
        // Sets listed anew, and no node under a card: all *NODE, NSET= are replaced too.
        Mesh mesh = with_sets_listed_anew(read_inp(path));
        for (GroupIndex g = static_cast<GroupIndex>(mesh.groups.size()) - 1; g >= 0; --g)
            if (mesh.groups[g].hidden && mesh.groups[g].kind == GroupKind::node) remove_group(mesh, g);
        write(read_inp(path), "before.inp");
        write(mesh, "after.inp");
        for (const std::string job : {"before", "after"}) {
            const std::string command =
                "cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 timeout 60 ccx " + job + " > " + job + ".log 2>&1";
            ASSERT_EQ(std::system(command.c_str()), 0) << text_of(folder_ / (job + ".log"));
        }
        const auto before = result_rows(folder_ / "before.dat"), after = result_rows(folder_ / "after.dat");
        ASSERT_GT(before.size(), 0u);
        ASSERT_EQ(before.size(), after.size());
        double largest = 0;
        for (const auto& row : before)
            for (std::size_t k = 1; k < row.size(); ++k) largest = std::max(largest, std::abs(row[k]));
        for (std::size_t r = 0; r < before.size(); ++r) {
            ASSERT_EQ(before[r].size(), after[r].size());
            for (std::size_t k = 0; k < before[r].size(); ++k)
                ASSERT_NEAR(before[r][k], after[r][k], 1e-5 * std::abs(before[r][k]) + 1e-9 * largest);
        }
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
