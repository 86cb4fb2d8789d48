// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/rebuild.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "crack_checks.h"
#include "cutting/removal.h"
#include "deck/solver_input.h"
#include "mesh/quality.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const Plane plane({1, 0, 0}, {1, 0, 0});
const std::vector<std::vector<std::string>> lips{{"LIP_N", "LIPS"}, {"LIP_P", "LIPS"}};

double volume(const Mesh& mesh) {
    double sum = 0;
    for (const CellType type : {CellType::tetra, CellType::tetra10})
        for (Index c = 0; c < mesh.block(type).size(); ++c) sum += cell_measure(mesh, type, c);
    return sum;
}

TEST(Rebuild, OfNothingIsTheSameMeshToTheLastBit) {
    Mesh mesh = checks::grid(2, 2, 2);
    mesh.node_families[3] = checks::family_of(mesh, "FIX", GroupKind::node);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, no_opening(f.d.band), {}, next_numbers(mesh));
    EXPECT_TRUE(checks::identical(rebuilt.mesh, mesh));
    EXPECT_THAT(rebuilt.before, IsEmpty());
    EXPECT_THAT(rebuilt.after, IsEmpty());
    EXPECT_TRUE(rebuilt.changes.empty());
    EXPECT_THAT(rebuilt.place, IsEmpty());
}

TEST(Rebuild, MovesNodesAndListsTheElementsAround) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    const int centre = node_at(f.d.band, {1, 1, 1});
    f.d.band.nodes[centre].at = {1.1, 1, 1};
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, no_opening(f.d.band), {}, next_numbers(mesh));
    Mesh expected = mesh;
    expected.points[checks::number_near(mesh, {1, 1, 1})] = {1.1, 1, 1};
    EXPECT_TRUE(checks::identical(rebuilt.mesh, expected));
    EXPECT_EQ(rebuilt.before.size(), f.d.band.tetras.around(centre).size());
    EXPECT_EQ(rebuilt.after, rebuilt.before);
}

TEST(Rebuild, WritesPartsOfSplitElementsWithWhatTheyInherit) {
    Mesh mesh = checks::grid(1, 1, 1);
    const Index low = checks::number_near(mesh, {0, 0, 0}), high = checks::number_near(mesh, {1, 1, 1});
    const GroupIndex both = mesh.add_group("BOTH", GroupKind::node), one = mesh.add_group("ONE", GroupKind::node),
                     part = mesh.add_group("PART", GroupKind::element);
    mesh.node_families[low] = mesh.families.with(mesh.families.with(0, both), one);
    mesh.node_families[high] = mesh.families.with(0, both);
    CellBlock& tetras = mesh.block(CellType::tetra);
    tetras.families[0] = mesh.families.with(0, part);
    const double of_first = cell_measure(mesh, CellType::tetra, 0);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    // The diagonal that all six tetrahedra have.
    f.split_edge(node_at(f.d.band, {0, 0, 0}), node_at(f.d.band, {1, 1, 1}), {0.5, 0.5, 0.5}, nullptr);
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, no_opening(f.d.band), {}, {70, 700});
    const Mesh& out = rebuilt.mesh;
    out.validate();
    EXPECT_EQ(out.node_count(), 9);
    EXPECT_EQ(out.node_ids.back(), 70);
    EXPECT_EQ(out.points.back(), Vec3(0.5, 0.5, 0.5));
    EXPECT_EQ(rebuilt.nodes_split, 1);
    EXPECT_EQ(rebuilt.nodes_doubled, 0);
    EXPECT_EQ(rebuilt.elements_added, 6);
    EXPECT_NEAR(volume(out), 1, 1e-14);
    EXPECT_THAT(checks::members(out, "BOTH", GroupKind::node),
                UnorderedElementsAre(mesh.node_ids[low], mesh.node_ids[high], 70));
    EXPECT_THAT(checks::members(out, "ONE", GroupKind::node), ElementsAre(mesh.node_ids[low]));
    const std::vector<Index> parts = checks::members(out, "PART", GroupKind::element);
    ASSERT_EQ(parts.size(), 2u);
    double of_parts = 0;
    for (const Index id : parts) of_parts += cell_measure(out, CellType::tetra, NumberIndex(out).cell(id)->cell);
    EXPECT_NEAR(of_parts, of_first, 1e-15);
    ASSERT_EQ(rebuilt.changes.born.size(), 1u);
    EXPECT_EQ(rebuilt.changes.born[0].node, 70);
    EXPECT_THAT(rebuilt.changes.born[0].ancestors, UnorderedElementsAre(mesh.node_ids[low], mesh.node_ids[high]));
    EXPECT_EQ(rebuilt.changes.parts.size(), 6u);
    const auto child = std::ranges::find(rebuilt.changes.parts, parts[1], &Changes::Part::element);
    ASSERT_NE(child, rebuilt.changes.parts.end());
    EXPECT_EQ(child->parent, parts[0]);
}

TEST(Rebuild, DoublesNodesAndWritesLips) {
    Mesh mesh = checks::grid(2, 2, 2);
    const Index middle = checks::number_near(mesh, {1, 1, 1});
    mesh.node_families[middle] = checks::family_of(mesh, "FIX", GroupKind::node);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, open_lips(f), lips, next_numbers(mesh));
    const Mesh& out = rebuilt.mesh;
    out.validate();
    EXPECT_EQ(rebuilt.nodes_doubled, 9);
    EXPECT_EQ(rebuilt.nodes_split, 0);
    EXPECT_EQ(rebuilt.elements_added, 16);
    EXPECT_EQ(rebuilt.elements_removed, 0);
    EXPECT_EQ(out.node_count(), mesh.node_count() + 9);
    EXPECT_NEAR(volume(out), 8, 1e-12);
    ASSERT_EQ(rebuilt.changes.copies.size(), 9u);
    for (const Changes::Copy& c : rebuilt.changes.copies) {
        const NumberIndex numbers(out);
        EXPECT_EQ(out.points[*numbers.node(c.node)], out.points[*numbers.node(c.source)]);
        EXPECT_GT(c.node, mesh.largest_node_id());
    }
    EXPECT_EQ(checks::members(out, "FIX", GroupKind::node).size(), 2u);
    // In the order of `groups`, a name that comes twice once.
    ASSERT_EQ(out.groups.size(), 4u);
    EXPECT_EQ(out.groups[1].name, "LIP_N");
    EXPECT_EQ(out.groups[2].name, "LIPS");
    EXPECT_EQ(out.groups[3].name, "LIP_P");
    EXPECT_EQ(checks::members(out, "LIP_N", GroupKind::element).size(), 8u);
    EXPECT_EQ(checks::members(out, "LIP_P", GroupKind::element).size(), 8u);
    EXPECT_EQ(checks::members(out, "LIPS", GroupKind::element).size(), 16u);
    // The two sides have no node in common.
    std::vector<int> side(out.points.size(), 0);
    for (Index c = 0; c < out.block(CellType::tetra).size(); ++c) {
        double x = 0;
        for (const Index n : out.block(CellType::tetra).nodes(c)) x += out.points[n].x() / 4;
        for (const Index n : out.block(CellType::tetra).nodes(c)) side[n] |= x > 1 ? 1 : 2;
    }
    EXPECT_EQ(std::ranges::count(side, 3), 0);
}

TEST(Rebuild, DoublesMidSideNodesOfTheLips) {
    const Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, open_lips(f), lips, next_numbers(mesh));
    rebuilt.mesh.validate();
    // 9 corners, 12 edges of the squares and 4 diagonals.
    EXPECT_EQ(rebuilt.mesh.node_count(), mesh.node_count() + 25);
    EXPECT_EQ(rebuilt.nodes_doubled, 25);
    EXPECT_EQ(rebuilt.mesh.block(CellType::triangle6).size(), 16);
    EXPECT_EQ(rebuilt.mesh.block(CellType::triangle).size(), 0);
    EXPECT_NEAR(volume(rebuilt.mesh), 8, 1e-12);
}

TEST(Rebuild, WritesTheFrontInOrder) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    Opening opening = no_opening(f.d.band);
    const auto at = [&](double z) { return node_at(f.d.band, {1, 1, z}); };
    opening.front_chains = {{at(0), at(1), at(2)}};
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, opening, {}, next_numbers(mesh), "FRONT");
    const CellBlock& segments = rebuilt.mesh.block(CellType::line);
    ASSERT_EQ(segments.size(), 2);
    EXPECT_THAT(checks::members(rebuilt.mesh, "FRONT", GroupKind::element),
                ElementsAre(mesh.largest_cell_id() + 1, mesh.largest_cell_id() + 2));
    EXPECT_EQ(segments.nodes(0)[1], segments.nodes(1)[0]);
    EXPECT_EQ(rebuilt.mesh.points[segments.nodes(0)[0]], Vec3(1, 1, 0));
    EXPECT_EQ(rebuilt.mesh.points[segments.nodes(1)[1]], Vec3(1, 1, 2));
}

TEST(Rebuild, DropsRemovedElementsAndTheirNodes) {
    Mesh mesh = checks::grid(2, 1, 1);
    const Index unused = mesh.add_node({9, 9, 9}, 900);
    const Index gone = checks::number_near(mesh, {0, 1, 1});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    const Tool* tools[] = {&plane};
    ASSERT_EQ(remove_inside(f, tools, 0), 6);
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, open_walls(f), {{"WALL"}}, next_numbers(mesh));
    const Mesh& out = rebuilt.mesh;
    out.validate();
    EXPECT_EQ(rebuilt.elements_removed, 6);
    EXPECT_EQ(rebuilt.nodes_removed, 4);
    EXPECT_EQ(rebuilt.elements_added, 2);
    EXPECT_EQ(out.block(CellType::tetra).size(), 6);
    EXPECT_NEAR(volume(out), 1, 1e-14);
    EXPECT_EQ(checks::members(out, "WALL", GroupKind::element).size(), 2u);
    EXPECT_EQ(rebuilt.kept_node(gone), -1);
    EXPECT_EQ(out.node_ids[rebuilt.kept_node(unused)], 900) << "belonged to no element before";
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (const Index now = rebuilt.kept_node(n); now >= 0) {
            EXPECT_EQ(out.node_ids[now], mesh.node_ids[n]);
            EXPECT_EQ(out.points[now], mesh.points[n]);
        }
}

TEST(Rebuild, GivesFacetsToThePartsOfTheirFaces) {
    Mesh mesh = checks::grid(1, 1, 1);
    const GroupIndex surface = mesh.add_group("SURFACE", GroupKind::facet);
    // The facet of a tetrahedron that lies in z = 0.
    const CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size() && mesh.facets.empty(); ++c)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& face = traits(CellType::tetra).faces[k];
            if (std::ranges::all_of(std::array{face[0], face[1], face[2]},
                                    [&](int i) { return mesh.points[tetras.nodes(c)[i]].z() == 0; }))
                mesh.facets.push_back(
                    {CellType::tetra, static_cast<std::int8_t>(k + 1), mesh.families.with(0, surface), c});
        }
    ASSERT_EQ(mesh.facets.size(), 1u);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    f.split_edge(node_at(f.d.band, {0, 0, 0}), node_at(f.d.band, {1, 1, 0}), {0.5, 0.5, 0}, nullptr);
    const Rebuilt rebuilt = rebuild(mesh, mesh, f, no_opening(f.d.band), {}, next_numbers(mesh));
    rebuilt.mesh.validate();
    ASSERT_EQ(rebuilt.mesh.facets.size(), 2u);
    for (const Facet& facet : rebuilt.mesh.facets) {
        EXPECT_TRUE(rebuilt.mesh.families.contains(facet.family, surface));
        const auto& face = traits(CellType::tetra).faces[static_cast<std::size_t>(facet.face) - 1];
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(rebuilt.mesh.points[rebuilt.mesh.block(facet.type).nodes(facet.cell)[face[k]]].z(), 0);
    }
}

TEST(Rebuild, NumbersFromAboveWhatTheDeckHas) {
    Mesh mesh = checks::grid(1, 1, 1);
    EXPECT_EQ(next_numbers(mesh).node, mesh.largest_node_id() + 1);
    EXPECT_EQ(next_numbers(mesh).cell, mesh.largest_cell_id() + 1);
    const auto input = std::make_shared<SolverInput>();
    input->other_elements().push_back({5000, "USER", {}, 0});
    mesh.companion = input;
    EXPECT_EQ(next_numbers(mesh).cell, 5001);
}

TEST(Rebuild, NumbersMustNotOverflow) {
    Mesh mesh = checks::grid(1, 1, 1);
    mesh.node_ids.back() = std::numeric_limits<Index>::max();
    EXPECT_THAT([&] { next_numbers(mesh); }, testing::ThrowsMessage<ToolError>(testing::HasSubstr(
                                                 "node number 9223372036854775807 leaves no numbers for new nodes")));
    mesh = checks::grid(1, 1, 1);
    mesh.block(CellType::tetra).ids.back() = std::numeric_limits<Index>::max();
    EXPECT_THAT([&] { next_numbers(mesh); }, testing::ThrowsMessage<ToolError>(testing::HasSubstr(
                                                 "element number 9223372036854775807 leaves no numbers for new ele")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
