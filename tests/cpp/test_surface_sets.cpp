// SPDX-License-Identifier: LGPL-2.1-or-later
// Element sets that a deck has only to define a surface: their borders mean nothing, and they follow the surface.
#include "deck/surface_sets.h"

#include <map>

#include "deck_testing.h"
#include "operators/drill.h"
#include "operators/refine.h"
#include "tools/cylinder.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

std::string helper(int face) { return "_TOP_S" + std::to_string(face); }

/// The block with its elements' nodes turned, so that all face labels occur on its top.
Block turned_block() {
    constexpr int turns[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
    Block out = block();
    out.elements.clear();
    for (std::size_t e = 0; e < out.tetras.size(); ++e) {
        const auto was = out.tetras[e];
        out.elements += std::to_string(e + 1);
        for (int k = 0; k < 4; ++k)
            out.elements += ", " + std::to_string(out.tetras[e][k] = was[turns[(e * 7 / 5) % 4][k]]);
        out.elements += "\n";
    }
    return out;
}

/// (element, face) of the turned block on the plane z = 2.
std::vector<std::pair<Index, int>> faces_on_top() {
    std::vector<std::pair<Index, int>> out;
    const Block b = turned_block();
    for (std::size_t e = 0; e < b.tetras.size(); ++e)
        for (int f = 0; f < 4; ++f)
            if (std::ranges::all_of(solver_faces[f], [&](int v) { return b.tetras[e][v] >= node_at(0, 0, nz); }))
                out.push_back({static_cast<Index>(e) + 1, f + 1});
    return out;
}

/// Sets of the elements with each face on the block's top.
std::string helper_sets(const std::string& parameters = "") {
    std::map<int, std::string> sets;
    for (const auto& [e, f] : faces_on_top()) sets[f] += std::to_string(e) + ",\n";
    std::string out;
    for (const auto& [f, members] : sets) out += "*ELSET, ELSET=" + helper(f) + parameters + "\n" + members;
    return out;
}

/// The surface by the sets.
std::string by_sets() {
    std::set<int> faces;
    for (const auto& [e, f] : faces_on_top()) faces.insert(f);
    std::string out = "*SURFACE, NAME=TOP, TYPE=ELEMENT\n";
    for (const int f : faces) out += helper(f) + ", S" + std::to_string(f) + "\n";
    return out;
}

/// The surface by numbers.
std::string by_numbers() {
    std::string out = "*SURFACE, NAME=TOP, TYPE=ELEMENT\n";
    for (const auto& [e, f] : faces_on_top()) out += std::to_string(e) + ", S" + std::to_string(f) + "\n";
    return out;
}

const std::string load = "*STEP\n*STATIC\n*DSLOAD\nTOP, P, 1.\n*END STEP\n";

bool on_top(const Vec3& p) { return std::abs(p.z() - nz) < 1e-12; }

/// Names of the groups that surface_sets() finds.
std::set<std::string> found_in(const Mesh& mesh) {
    std::set<std::string> out;
    for (const SurfaceSet& s : surface_sets(mesh)) out.insert(mesh.groups[s.group].name);
    return out;
}

class SurfaceSets : public DeckSemantics {
protected:
    Mesh turned_with(const std::string& cards) const {
        const Block b = turned_block();
        return read("*NODE, NSET=NALL\n" + b.nodes + "*ELEMENT, TYPE=C3D4, ELSET=EALL\n" + b.elements + cards);
    }

    /// The surface is the top, and each set holds the elements that have its face on it, and no others.
    void expect_followed(const Mesh& after, double area) {
        EXPECT_NEAR(surface_area(after, "TOP", on_top), area, 1e-12);
        std::map<int, std::set<Index>> wanted;
        const GroupIndex top = *after.find_group("TOP", GroupKind::facet);
        for (const Facet& f : after.facets)
            if (after.families.contains(f.family, top)) wanted[f.face].insert(after.block(f.type).ids[f.cell]);
        for (int face = 1; face <= 4; ++face)
            if (after.find_group(helper(face), GroupKind::element)) {
                const auto members = element_set(after, helper(face));
                EXPECT_EQ(std::set<Index>(members.begin(), members.end()), wanted[face]) << helper(face);
            }
    }
};

TEST_F(SurfaceSets, AreThoseThatNothingElseUses) {
    std::set<std::string> all;
    for (const auto& [e, f] : faces_on_top()) all.insert(helper(f));
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(found_in(turned_with(helper_sets() + by_sets() + load)), all);
    EXPECT_EQ(found_in(turned_with(helper_sets(", INTERNAL") + by_sets() + load)), all);
    EXPECT_THAT(found_in(turned_with(helper_sets() + by_numbers() + load)), IsEmpty());
    const std::string one = *all.begin();
    auto others = all;
    others.erase(one);
    for (const std::string& use :
         {"*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n*SOLID SECTION, ELSET=" + one + ", MATERIAL=M\n",
          "*ELSET, ELSET=MORE\n 1, " + one + "\n", "*STEP\n*STATIC\n*DLOAD\n" + one + ", P1, 1.\n*END STEP\n",
          "*STEP\n*STATIC\n*EL PRINT, ELSET=" + one + "\nS\n*END STEP\n",
          "*ELEMENT, TYPE=C3D4, ELSET=" + one + "\n999, 1, 2, 6, 16\n",
          "*INITIAL CONDITIONS, TYPE=STRESS\n" + one + ", 1., 0.\n"}) {
        SCOPED_TRACE(use);
        EXPECT_EQ(found_in(turned_with(helper_sets() + by_sets() + use)), others);
    }
}

TEST_F(SurfaceSets, DoNotHoldTheMesh) {
    const Mesh plain = turned_with(by_numbers() + load), mesh = turned_with(helper_sets() + by_sets() + load);
    for (const auto& [x, normal] :
         {std::pair(1.5, Vec3(1, .3, .4)), std::pair(2.3, Vec3(1, .2, .1)), std::pair(1.7, Vec3(.1, .1, 1))}) {
        SCOPED_TRACE(x);
        CrackOptions options;
        options.name = "CRACK";
        const Plane plane(Vec3(x, 1, 1.2), normal);
        const Result without = crack(plain, plane, options), with = crack(mesh, plane, options);
        EXPECT_EQ(with.mesh.points, without.mesh.points);
        EXPECT_EQ(with.mesh.block(CellType::tetra).connectivity, without.mesh.block(CellType::tetra).connectivity);
        EXPECT_EQ(with.report.warnings, without.report.warnings);
        expect_followed(written(with), nx * ny);
        for (const GroupRecord& r : with.report.groups)
            EXPECT_TRUE(r.boundary_kept || r.name.starts_with("_TOP")) << r.name;
    }
}

TEST_F(SurfaceSets, LinesOfTheSurfaceStayTrue) {
    // An operator may leave a face under another label: with a set for each, the surface needs no new line.
    const Mesh after = crack_at(turned_with(helper_sets() + by_sets() + load), 1.5, "CRACK", Vec3(1, .3, .4));
    expect_followed(after, nx * ny);
    EXPECT_EQ(text_of(after, "SURFACE").substr(0, by_sets().size() + 2), by_sets() + "**");
    // Without a set for it, the element is named by number, behind the lines that are still true.
    std::string sets = helper_sets(), lines = by_sets(), numbers;
    const auto second = sets.find("*ELSET, ELSET=" + helper(2)), third = sets.find("*ELSET, ELSET=" + helper(3));
    sets.erase(second, third - second);
    lines.erase(lines.find(helper(2)), helper(2).size() + 5);
    for (const auto& [e, f] : faces_on_top())
        if (f == 2) numbers += std::to_string(e) + ", S2\n";
    const Mesh partial = crack_at(turned_with(sets + lines + numbers + load), 1.5, "CRACK", Vec3(1, .3, .4));
    expect_followed(partial, nx * ny);
    EXPECT_EQ(text_of(partial, "SURFACE").substr(0, lines.size()), lines);
}

TEST_F(SurfaceSets, ElementsThatTheSurfaceNamesByNumberStayOutOfThem) {
    // CalculiX would load a face twice that a set and a line of its own give.
    const auto [e, f] = faces_on_top().front();
    std::string sets = helper_sets();
    const std::string line = std::to_string(e) + ",\n";
    sets.replace(sets.find("\n" + line) + 1, line.size(), "");
    const Mesh after =
        crack_at(turned_with(sets + by_sets() + std::to_string(e) + ", S" + std::to_string(f) + "\n" + load), 3.4,
                 "CRACK", Vec3(1, .3, .4));
    EXPECT_NEAR(surface_area(after, "TOP", on_top), nx * ny, 1e-12);
    EXPECT_THAT(element_set(after, helper(f)), Not(Contains(e)));
}

TEST_F(SurfaceSets, FollowHolesAndRefinements) {
    const Mesh mesh = turned_with(helper_sets() + by_sets() + load);
    RefineOptions options;
    options.size = .6;
    const Plane plane(Vec3(2, 1, 1), Vec3(1, 0, 0));
    expect_followed(written(refine(mesh, distance_to({&plane}), options)), nx * ny);
    DrillOptions drilling;
    drilling.name = "HOLE";
    const Cylinder hole(Vec3(2, 1, 1), Vec3(0, 0, 1), .6);
    const Tool* const tools[] = {&hole};
    const Mesh after = written(drill(mesh, tools, drilling));
    expect_followed(after, surface_area(after, "TOP", on_top));
    EXPECT_LT(surface_area(after, "TOP", on_top), nx * ny - .9);
}

TEST_F(SurfaceSets, ShellsBySide) {
    std::string nodes, elements, all;
    for (int j = 0; j <= 4; ++j)
        for (int i = 0; i <= 4; ++i)
            nodes += std::to_string(1 + i + 5 * j) + ", " + std::to_string(i) + ", " + std::to_string(j) + ", 0.\n";
    int e = 0;
    std::string set;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            const int a = 1 + i + 5 * j, b = a + 1, c = b + 5, d = a + 5;
            for (const auto& t : {std::array{a, b, c}, std::array{a, c, d}}) {
                elements += std::to_string(++e) + ", " + std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " +
                            std::to_string(t[2]) + "\n";
                if (i == 1 || j == 2) set += std::to_string(e) + ",\n";  // an area with corners
            }
        }
    const std::string mesh_cards = "*NODE\n" + nodes + "*ELEMENT, TYPE=S3, ELSET=EALL\n" + elements;
    const Mesh mesh = read(mesh_cards + "*ELSET, ELSET=_P_SPOS\n" + set + "*SURFACE, NAME=P\n_P_SPOS, SPOS\n");
    EXPECT_THAT(found_in(mesh), UnorderedElementsAre("_P_SPOS"));
    const Mesh after = crack_at(mesh, 1.6, "CRACK", Vec3(1, .3, 0));
    const GroupIndex p = *after.find_group("P", GroupKind::facet);
    std::set<Index> wanted;
    for (const Facet& f : after.facets)
        if (after.families.contains(f.family, p)) wanted.insert(after.block(f.type).ids[f.cell]);
    const auto members = element_set(after, "_P_SPOS");
    EXPECT_EQ(std::set<Index>(members.begin(), members.end()), wanted);
    EXPECT_GT(wanted.size(), 14u);
    EXPECT_THAT(text_of(after, "SURFACE"), testing::StartsWith("*SURFACE, NAME=P\n_P_SPOS, SPOS\n** "));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
