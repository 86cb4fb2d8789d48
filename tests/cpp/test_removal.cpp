// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/removal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Plane in_x({1, 0, 0}, {1, 0, 0}), in_y({0, 1, 0}, {0, 1, 0});

int alive(const auto& list) {
    int count = 0;
    for (int s = 0; s < list.size(); ++s) count += list.alive(s);
    return count;
}

double measure_taken(const Workpiece& f) {
    return std::accumulate(f.taken.begin(), f.taken.end(), 0.0,
                           [](double sum, const auto& t) { return sum + t.second; });
}

/// Area vector of a face of the band.
Vec3 area(const BandMesh& band, const std::array<int, 3>& n) {
    return (band.nodes[n[1]].at - band.nodes[n[0]].at).cross(band.nodes[n[2]].at - band.nodes[n[0]].at) / 2;
}

TEST(Removal, TakesTheNegativeSideAndLeavesAWall) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, in_x);
    const Tool* tools[] = {&in_x};
    EXPECT_EQ(remove_inside(f, tools, 7), 24);
    const BandMesh& band = f.d.band;
    EXPECT_EQ(alive(band.tetras), 24);
    for (int t = 0; t < band.tetras.size(); ++t)
        if (band.tetras.alive(t)) {
            for (const int v : band.tetras[t]) EXPECT_GE(band.nodes[v].at.x(), 1);
        }
    EXPECT_EQ(f.taken.size(), 24u);
    EXPECT_NEAR(measure_taken(f), 4, 1e-14);
    EXPECT_EQ(alive(band.cut_faces), 8);
    for (int s = 0; s < band.cut_faces.size(); ++s) {
        EXPECT_EQ(band.cut_faces.tag(s), 7);
        EXPECT_LT(area(band, band.cut_faces[s]).x(), 0) << "out of what stays";
    }
    for (int v = 0; v < band.size(); ++v) EXPECT_EQ(band.nodes[v].gone, band.nodes[v].at.x() < 1);
    EXPECT_THAT(f.warnings, IsEmpty());
}

TEST(Removal, TakesWhatIsInsideAllTools) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, in_x);
    const Tool* tools[] = {&in_x, &in_y};
    EXPECT_EQ(remove_inside(f, tools, 3), 12);
    const BandMesh& band = f.d.band;
    std::map<int, Vec3> walls{{3, Vec3::Zero()}, {4, Vec3::Zero()}};
    for (int s = 0; s < band.cut_faces.size(); ++s) walls.at(band.cut_faces.tag(s)) += area(band, band.cut_faces[s]);
    EXPECT_LT((walls[3] - Vec3(-2, 0, 0)).norm(), 1e-14);
    EXPECT_LT((walls[4] - Vec3(0, -2, 0)).norm(), 1e-14);
    // The line where the walls meet stays, what is beyond them goes.
    EXPECT_FALSE(band.nodes[node_at(band, {1, 1, 1})].gone);
    EXPECT_TRUE(band.nodes[node_at(band, {0, 0, 1})].gone);
}

TEST(Removal, TakesWhatOnlyTheRemovedCarried) {
    Mesh mesh = checks::grid(2, 1, 1);
    const auto number = [&](double x, double y, double z) { return checks::number_near(mesh, {x, y, z}); };
    checks::add_plate(mesh, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1);  // faces in x = 0
    checks::add_plate(mesh, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1);  // and in x = 2
    mesh.add_cell(CellType::line, std::array{number(0, 0, 0), number(1, 0, 0)}, 3000);
    mesh.add_cell(CellType::line, std::array{number(1, 0, 0), number(2, 0, 0)}, 3001);
    // A beam, and masses.
    const Index beyond = mesh.add_node({-1, 0, 0}, 4000);
    mesh.add_cell(CellType::line, std::array{number(0, 0, 0), beyond}, 3002);
    mesh.add_cell(CellType::vertex, std::array{number(0, 1, 1)}, 3003);
    mesh.add_cell(CellType::vertex, std::array{number(2, 1, 1)}, 3004);
    Workpiece f = checks::whole_workpiece(mesh, in_x);
    const Tool* tools[] = {&in_x};
    EXPECT_EQ(remove_inside(f, tools, 0), 7);
    const BandMesh& band = f.d.band;
    EXPECT_EQ(alive(band.triangles), 2);
    for (int t = 0; t < band.triangles.size(); ++t)
        if (band.triangles.alive(t)) {
            EXPECT_EQ(band.nodes[band.triangles[t][0]].at.x(), 2);
        }
    ASSERT_EQ(alive(band.lines), 1);
    ASSERT_EQ(alive(band.vertices), 1);
    for (int l = 0; l < band.lines.size(); ++l)
        if (band.lines.alive(l)) {
            EXPECT_GE(band.nodes[band.lines[l][0]].at.x(), 1);
        }
    for (int p = 0; p < band.vertices.size(); ++p)
        if (band.vertices.alive(p)) {
            EXPECT_EQ(band.nodes[band.vertices[p][0]].at.x(), 2);
        }
    EXPECT_THAT(f.warnings, ElementsAre(HasSubstr("1 point element inside")));
}

TEST(Removal, CutsAPlateAtALine) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, in_x);
    const Tool* tools[] = {&in_x};
    EXPECT_EQ(remove_inside(f, tools, 5), 4);
    EXPECT_NEAR(measure_taken(f), 2, 1e-14);
    EXPECT_EQ(alive(f.d.band.cut_edges), 2);
    const Opening walls = open_walls(f);
    ASSERT_EQ(walls.edges.size(), 2u);
    for (const auto& e : walls.edges) {
        EXPECT_EQ(e.group, 5);
        EXPECT_EQ(e.element, Opening::fresh);
        for (const int v : e.nodes) EXPECT_EQ(f.d.band.nodes[v].at.x(), 1);
    }
}

TEST(Removal, RefusesWallsThatNoToolHasBesideThem) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane beside({1.1, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, beside);
    const Tool* tools[] = {&beside};
    EXPECT_THAT([&] { remove_inside(f, tools, 0); }, testing::ThrowsMessage<QualityError>(HasSubstr("too coarse")));
}

TEST(Removal, WallsAreFacesOfWhatStays) {
    Mesh mesh = checks::grid(2, 2, 2);
    Workpiece bare = checks::whole_workpiece(mesh, in_x);
    const Tool* tools[] = {&in_x};
    remove_inside(bare, tools, 0);
    // A triangle that lies on the wall to be.
    std::array<Index, 3> nodes;
    for (int k = 0; k < 3; ++k) nodes[k] = bare.d.band.nodes[bare.d.band.cut_faces[0][k]].global;
    mesh.add_cell(CellType::triangle, nodes, 1000);
    Workpiece f = checks::whole_workpiece(mesh, in_x);
    remove_inside(f, tools, 0);
    const Opening walls = open_walls(f);
    EXPECT_TRUE(walls.removes);
    EXPECT_THAT(walls.copy_of, IsEmpty());
    EXPECT_EQ(walls.interface_nodes.size(), 9u);
    ASSERT_EQ(walls.faces.size(), 8u);
    int joined = 0;
    for (const auto& face : walls.faces) {
        EXPECT_EQ(face.group, 0);
        EXPECT_LT(area(f.d.band, face.nodes).x(), 0);
        if (face.element == Opening::fresh) continue;
        ++joined;
        EXPECT_TRUE(std::ranges::is_permutation(f.d.band.triangles[face.element], face.nodes));
    }
    EXPECT_EQ(joined, 1);
}

TEST(Removal, ReleasesNodesThatAreOnNoWall) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, in_x);
    BandMesh& band = f.d.band;
    const int on_wall = node_at(band, {1, 0, 0}), off = node_at(band, {1, 2, 2});
    f.d.contact[on_wall] = f.d.contact[on_wall].with(&in_y);
    band.cut_faces.add({on_wall, node_at(band, {1, 1, 0}), node_at(band, {1, 1, 1})}, 0);
    const Tool* tool_of_tag[] = {&in_x};
    release_all_but_walls(f, tool_of_tag);
    EXPECT_TRUE(f.d.contact[on_wall].has(&in_x));
    EXPECT_FALSE(f.d.contact[on_wall].has(&in_y));
    EXPECT_FALSE(f.d.contact[off]);
}

TEST(Removal, NotesWhatLiesBetweenFlatWallsAndACurvedTool) {
    // The origin's corner of the cube, cut off by a face with its corners on a sphere about the origin.
    const Mesh mesh = checks::grid(1, 1, 1);
    const Sphere sphere({0, 0, 0}, 1);
    Workpiece f = checks::whole_workpiece(mesh, sphere);
    BandMesh& band = f.d.band;
    // Bring one face of a tetrahedron onto it.
    const std::array<int, 3> face{band.tetras[0][1], band.tetras[0][2], band.tetras[0][3]};
    const std::array<Vec3, 3> corners{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    for (int k = 0; k < 3; ++k) band.nodes[face[k]].at = corners[k];
    band.cut_faces.add(face, 0);
    const Tool* tool_of_tag[] = {&sphere};
    note_slivers(f, tool_of_tag, -1);
    ASSERT_EQ(f.taken.size(), 1u);
    // Middles of the edges are sqrt(1/2) from the centre, the face has sides of sqrt(2).
    const double depth = 1 - std::sqrt(0.5), size = std::sqrt(3.0) / 2;
    EXPECT_NEAR(f.taken[0].second, -size * depth, 1e-12);
    // Planes leave nothing.
    const Tool* flat[] = {&in_x};
    note_slivers(f, flat, 1);
    EXPECT_EQ(f.taken.size(), 1u);
}

TEST(Removal, FindsElementsDeepInside) {
    const Mesh mesh = checks::grid(4, 1, 1);
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    // Nodes at x = 2 are in the band.
    for (std::size_t n = 0; n < level.size(); ++n)
        if (mesh.points[n].x() == 2) level[n] = 0;
    const std::function<double(const Vec3&)> left = [](const Vec3&x) { return x.x() - 2.5; },
                                             right = [](const Vec3&x) { return 2.5 - x.x(); };
    const std::function<double(const Vec3&)> bodies[] = {left, right};
    const auto first = deep_inside(mesh, level, {bodies, 1});
    EXPECT_EQ(first.size(), 6u);
    for (const CellRef& c : first)
        for (const Index n : mesh.block(c.type).nodes(c.cell)) EXPECT_LE(mesh.points[n].x(), 1);
    EXPECT_EQ(deep_inside(mesh, level, bodies).size(), 12u);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
