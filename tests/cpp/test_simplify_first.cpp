// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/simplify_first.h"

#include "deck_testing.h"
#include "mesh/order.h"
#include "mesh/quality.h"
#include "operators/drill.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"

namespace femscalpel::deck_testing {
namespace {

using checks::bricks;
using checks::quadrangles;
using testing::ElementsAre;
using testing::Pair;
using testing::UnorderedElementsAre;

Result crack_at_x(const Mesh& mesh, double x, const Vec3& normal = Vec3(1, 0.1, 0), bool band_only = false) {
    CrackOptions options;
    options.band_only = band_only;
    return crack(mesh, Plane(Vec3(x, 1, 1), normal), options);
}

TEST(SimplifyFirst, NothingWhereThereIsNothingToDo) {
    const Plane tool(Vec3(1.4, 0, 0), Vec3(1, 0, 0));
    const Blade blade{&tool, {}, {}};
    EXPECT_FALSE(simplify_first(checks::grid(3, 1, 1), {&blade, 1}, {}, {}, {}));
    Mesh mesh = quadrangles(12, 2);
    const std::optional<Refined> there = simplify_first(mesh, {&blade, 1}, {}, {}, {});
    ASSERT_TRUE(there);
    EXPECT_THAT(there->report.converted, ElementsAre(Pair("quad", 10)));
    EXPECT_EQ(there->mesh.block(CellType::triangle).size(), 20);
    EXPECT_EQ(there->mesh.block(CellType::quad).size(), 14);
    EXPECT_EQ(there->numbering.cell, 25);
    EXPECT_FALSE(there->summary);
    // Triangles there alone: what is far stays out of it.
    EXPECT_FALSE(simplify_first(there->mesh, {&blade, 1}, {}, {}, {}));
}

TEST(SimplifyFirst, CountsAreThoseOfTheInput) {
    Mesh mesh = quadrangles(12, 2);
    const FamilyIndex all = checks::family_of(mesh, "ALL", GroupKind::element);
    for (FamilyIndex& f : mesh.block(CellType::quad).families) f = all;
    const Result result = crack_at_x(mesh, 5.3);
    result.mesh.validate();
    EXPECT_EQ(mesh.cell_count() + result.report.elements_added - result.report.elements_removed,
              result.mesh.cell_count());
    EXPECT_EQ(mesh.node_count() + result.report.nodes_added - result.report.nodes_removed, result.mesh.node_count());
    const GroupRecord& record = result.report.groups.at(0);
    EXPECT_EQ(record.count_before, 24);
    EXPECT_NEAR(record.measure_before, 24, 1e-12);
    EXPECT_NEAR(record.measure_after, 24, 1e-9);
    EXPECT_GT(result.mesh.block(CellType::quad).size(), 0);
    EXPECT_FALSE(result.report.converted.empty());
    // What is not near is as it was.
    const CellBlock& quads = result.mesh.block(CellType::quad);
    for (Index c = 0; c < quads.size(); ++c) {
        const Index was = quads.ids[c] - 1;
        EXPECT_TRUE(std::ranges::equal(quads.nodes(c), mesh.block(CellType::quad).nodes(was)));
    }
    EXPECT_FALSE(crack_at_x(mesh, 5.3, Vec3(1, 0.1, 0), true).report.converted.empty());
}

TEST(SimplifyFirst, SolidsAreCutThroughAndTheRestStays) {
    for (const bool second : {false, true}) {
        Mesh mesh = bricks(14, 3, 3);
        if (second) mesh = to_second_order(mesh);
        const Result result = crack_at_x(mesh, 6.6);
        result.mesh.validate();
        EXPECT_GT(result.mesh.block(second ? CellType::pyramid13 : CellType::pyramid).size(), 0);
        EXPECT_GT(result.mesh.block(second ? CellType::hexahedron20 : CellType::hexahedron).size(), 20);
        EXPECT_GT(result.report.quality_after.minimum, 0.4);
        EXPECT_EQ(result.report.warnings.empty(), second) << "first-order tetrahedra are stiff";
        double volume = 0;
        for (const CellBlock& b : result.mesh.blocks())
            for (Index c = 0; traits(b.type).dimension == 3 && c < b.size(); ++c)
                volume += cell_measure(result.mesh, b.type, c);
        EXPECT_NEAR(volume, 126, 1e-9);
    }
}

TEST(SimplifyFirst, BeforeRefinementToo) {
    DrillOptions options;
    options.refine = {RefineFirst::When::to_size, 0.3};
    const Mesh mesh = quadrangles(16, 12);
    const Cylinder hole(Vec3(8.2, 6.1, 0), Vec3(0, 0, 1), 1.2);
    const Tool* const tools[] = {&hole};
    const Result result = drill(mesh, tools, options);
    result.mesh.validate();
    ASSERT_TRUE(result.report.refinement);
    EXPECT_FALSE(result.report.converted.empty());
    EXPECT_EQ(mesh.cell_count() + result.report.elements_added - result.report.elements_removed,
              result.mesh.cell_count());
    double area = 0;
    for (const CellBlock& b : result.mesh.blocks())
        for (Index c = 0; traits(b.type).dimension == 2 && c < b.size(); ++c)
            area += cell_measure(result.mesh, b.type, c);
    EXPECT_NEAR(area, 192 - M_PI * 1.44, 0.02);
}

/// A plate of 6 x 2 shells of four nodes, or plane elements.
std::string plate(const std::string& type) {
    std::ostringstream out;
    out << "*NODE, NSET=NALL\n";
    for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 8; ++i) out << 1 + i + 9 * j << ", " << i << ", " << j << ", 0\n";
    out << "*ELEMENT, TYPE=" << type << ", ELSET=EALL\n";
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 8; ++i) {
            const int a = 1 + i + 9 * j;
            out << 1 + i + 8 * j << ", " << a << ", " << a + 1 << ", " << a + 10 << ", " << a + 9 << "\n";
        }
    return out.str();
}

class SimplifiedDeck : public DeckSemantics {};

TEST_F(SimplifiedDeck, ShellsAndTheirLoadsAndSupportsFollow) {
    const Mesh mesh =
        read(plate("S4R") +
             "*NSET, NSET=END\n1, 10, 19\n*ELSET, ELSET=MID\n4, 5, 12, 13\n*SURFACE, NAME=TOP\nEALL, SPOS\n"
             "*SURFACE, NAME=RIM, TYPE=ELEMENT\n1, S3\n2, S3\n3, S3\n4, S3\n"
             "*SHELL SECTION, ELSET=EALL, MATERIAL=M\n0.1\n*MATERIAL, NAME=M\n*ELASTIC\n1, 0.3\n*STEP\n"
             "*STATIC\n*BOUNDARY\nEND, 1, 6\n*DLOAD\n4, P, 2.\n12, P, 2.\nMID, GRAV, 9.81, 0, 0, -1\n"
             "5, EDNOR1, 3.\n*END STEP\n");
    const Mesh after = crack_at(mesh, 3.6);
    EXPECT_GT(after.block(CellType::triangle).size(), 10);
    EXPECT_GT(after.block(CellType::quad).size(), 0);
    const std::string text = text_of(after, "ELEMENT");
    EXPECT_THAT(text, testing::HasSubstr("*ELEMENT, TYPE=S3, ELSET=EALL"));
    const auto area_of = [&](const std::vector<Index>& elements) {
        const NumberIndex numbers(after);
        double sum = 0;
        for (const Index e : elements) sum += cell_measure(after, numbers.cell(e)->type, numbers.cell(e)->cell);
        return sum;
    };
    EXPECT_NEAR(area_of(element_set(after, "EALL")), 16, 1e-9);
    EXPECT_NEAR(area_of(element_set(after, "MID")), 4, 1e-9);
    std::vector<Index> pressed;
    double edge = 0;
    for (const Row& row : rows(after, "DLOAD")) {
        if (row[1] == "P") pressed.push_back(std::stoll(row[0]));
        if (row[1].starts_with("EDNOR")) {
            const CellRef c = *NumberIndex(after).cell(std::stoll(row[0]));
            const auto n = after.block(c.type).nodes(c.cell);
            const auto& e = traits(c.type).edges[row[1].back() - '1'];
            const Vec3 a = after.points[n[e[0]]], b = after.points[n[e[1]]];
            EXPECT_EQ(a.y() + b.y(), 0);
            edge += (b - a).norm();
        }
    }
    EXPECT_NEAR(area_of(pressed), 2, 1e-9) << "of the elements 4 and 12";
    EXPECT_NEAR(edge, 1, 1e-9);
    double rim = 0;
    const GroupIndex g = *after.find_group("RIM", GroupKind::facet);
    for (const Facet& f : after.facets)
        if (after.families.contains(f.family, g)) rim += facet_measure(after, f);
    EXPECT_NEAR(rim, 4, 1e-9);
    EXPECT_THAT(node_set(after, "END"), UnorderedElementsAre(1, 10, 19));
}

TEST_F(SimplifiedDeck, PlaneElementsCountTheirEdgesFromOne) {
    const Mesh mesh =
        read(plate("CPS4") +
             "*SURFACE, NAME=RIM, TYPE=ELEMENT\n1, S1\n2, S1\n3, S1\n4, S1\n5, S1\n*SOLID SECTION, "
             "ELSET=EALL, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n1, 0.3\n*STEP\n*STATIC\n*DLOAD\n4, P1, "
             "2.\n*END STEP\n");
    const Mesh after = crack_at(mesh, 3.6);
    EXPECT_THAT(text_of(after, "ELEMENT"), testing::HasSubstr("TYPE=CPS3"));
    double rim = 0;
    const GroupIndex g = *after.find_group("RIM", GroupKind::facet);
    for (const Facet& f : after.facets)
        if (after.families.contains(f.family, g)) rim += facet_measure(after, f);
    EXPECT_NEAR(rim, 5, 1e-9);
    double loaded = 0;
    for (const Row& row : rows(after, "DLOAD")) {
        const CellRef c = *NumberIndex(after).cell(std::stoll(row[0]));
        const auto n = after.block(c.type).nodes(c.cell);
        const auto& e = traits(c.type).edges[row[1].back() - '1'];
        EXPECT_EQ(after.points[n[e[0]]].y() + after.points[n[e[1]]].y(), 0);
        loaded += (after.points[n[e[0]]] - after.points[n[e[1]]]).norm();
    }
    EXPECT_NEAR(loaded, 1, 1e-9);
}

TEST_F(SimplifiedDeck, ValuesOfNodesAreInterpolatedInTheOldElement) {
    Mesh mesh = to_second_order(quadrangles(8, 2));
    write_inp(mesh, folder_ / "plate.inp");
    std::ifstream in(folder_ / "plate.inp");
    std::string text(std::istreambuf_iterator<char>(in), {});
    text += "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n";
    for (Index n = 0; n < mesh.node_count(); ++n)
        text += std::to_string(n + 1) + ", " + std::to_string(3 * mesh.points[n].x() + 2 * mesh.points[n].y()) + "\n";
    const Mesh after = crack_at(read(text), 3.6);
    std::map<Index, double> values;  // the last line of a node counts
    for (const Row& row : rows(after, "INITIALCONDITIONS")) values[std::stoll(row[0])] = std::stod(row[1]);
    EXPECT_EQ(values.size(), static_cast<std::size_t>(after.node_count()));
    for (const auto& [node, value] : values) {
        const Vec3 x = place(after, node);
        EXPECT_NEAR(value, 3 * x.x() + 2 * x.y(), 1e-5) << node;
    }
}

}  // namespace
}  // namespace femscalpel::deck_testing
