// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "groups/band_boundaries.h"
#include "groups/elementary_groups.h"
#include "groups/virtual_boundary.h"
#include "random_groups.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace checks;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// Node sets of a part, whatever their order.
std::multiset<Nodes> edges_of(const BoundaryPart& p) {
    std::multiset<Nodes> out;
    for (const auto& e : p.edges) out.insert(Nodes(e.begin(), e.end()));
    return out;
}
std::multiset<Nodes> faces_of(const BoundaryPart& p) {
    std::multiset<Nodes> out;
    for (const auto& f : p.faces) {
        Nodes nodes(f.begin(), f.end());
        nodes.erase(-1);
        out.insert(nodes);
    }
    return out;
}

GroupIndex add_group(Mesh& mesh, const std::string& name, GroupKind kind, std::vector<Index> ids,
                     std::vector<Index> faces = {}) {
    const GroupIndex g = mesh.add_group(name, kind);
    set_group_members(mesh, g, {kind, std::move(ids), std::move(faces)});
    return g;
}

/// Nodes 0..8 (numbers 1..9) on a 3 x 3 grid, row by row; each square cut from lower left to upper right:
///
///     6 - 7 - 8     elements 1 to 8: lower then upper triangle of the
///     | / | / |     squares at 0, 1, 3, 4
///     3 - 4 - 5
///     | / | / |
///     0 - 1 - 2
Mesh plate() {
    Mesh mesh;
    for (Index n = 0; n < 9; ++n) mesh.add_node({double(n % 3), double(n / 3), 0}, n + 1);
    for (const Index n : {0, 1, 3, 4}) add_cells(mesh, CellType::triangle, {{n, n + 1, n + 4}, {n, n + 4, n + 3}});
    return mesh;
}

/// Two tetrahedra, elements 1 and 2, on the common face 1 2 3, with apexes 0 and 4.
Mesh two_tetrahedra() {
    Mesh mesh;
    const Vec3 points[] = {{0, 0, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const Vec3& p : points) mesh.add_node(p, mesh.node_count() + 1);
    add_cells(mesh, CellType::tetra, {{1, 3, 2, 0}, {1, 2, 3, 4}});
    return mesh;
}

TEST(VirtualBoundary, FacesIn2D) {
    Mesh mesh = plate();
    const auto b = virtual_boundary(mesh, add_group(mesh, "G", GroupKind::element, {1, 2}));  // the lower left square
    // In the direction of the elements, the diagonal inside.
    EXPECT_THAT(b.bounding.edges, UnorderedElementsAre(std::array<Index, 2>{0, 1}, std::array<Index, 2>{1, 4},
                                                       std::array<Index, 2>{4, 3}, std::array<Index, 2>{3, 0}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::triangle, 0}, CellRef{CellType::triangle, 1}));
    EXPECT_THAT(b.linking.edges, IsEmpty());
    EXPECT_THAT(b.bounding.faces, IsEmpty());
    EXPECT_THAT(b.isolated.nodes, IsEmpty());
}

TEST(VirtualBoundary, EdgesIn2D) {
    Mesh mesh = plate();
    // Around triangle 1, and two more on the right border; 9 to 13 are the segments' numbers.
    add_cells(mesh, CellType::line, {{0, 1}, {1, 4}, {4, 0}, {2, 5}, {5, 8}});
    const auto b = virtual_boundary(mesh, add_group(mesh, "G", GroupKind::element, {9, 10, 11, 12, 13}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::triangle, 0}));
    EXPECT_EQ(edges_of(b.bounding), (std::multiset<Nodes>{{0, 1}, {1, 4}, {0, 4}}));
    EXPECT_EQ(edges_of(b.linking), (std::multiset<Nodes>{{2, 5}, {5, 8}}));
    EXPECT_THAT(b.linking.edge_elements, ElementsAre(CellRef{CellType::line, 3}, CellRef{CellType::line, 4}));
    EXPECT_THAT(b.isolated.nodes, IsEmpty());
}

TEST(VirtualBoundary, NodesIn2D) {
    Mesh mesh = plate();
    // 0 1 4 enclose triangle 1; 8 is linked to 4, over the diagonal; 6 has no neighbour in the group.
    const auto b = virtual_boundary(mesh, add_group(mesh, "G", GroupKind::node, {1, 2, 5, 9, 7}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::triangle, 0}));
    EXPECT_EQ(edges_of(b.bounding), (std::multiset<Nodes>{{0, 1}, {1, 4}, {0, 4}}));
    EXPECT_EQ(edges_of(b.linking), (std::multiset<Nodes>{{4, 8}}));
    EXPECT_THAT(b.isolated.nodes, ElementsAre(6));
}

TEST(VirtualBoundary, Figure9) {
    Mesh mesh = plate();
    // The nodes along the left border: each edge between neighbours is LE, so that what is born there joins.
    const auto b = virtual_boundary(mesh, add_group(mesh, "GN", GroupKind::node, {1, 4, 7}));
    EXPECT_EQ(edges_of(b.linking), (std::multiset<Nodes>{{0, 3}, {3, 6}}));
    EXPECT_THAT(b.linking.edge_elements, ElementsAre(CellRef{CellType::vertex, -1}, CellRef{CellType::vertex, -1}));
    EXPECT_THAT(b.bounding.edges, IsEmpty());
    EXPECT_THAT(b.isolated.nodes, IsEmpty());
}

TEST(VirtualBoundary, TetrahedraIn3D) {
    Mesh mesh = two_tetrahedra();
    add_cells(mesh, CellType::triangle, {{2, 3, 4}});  // element 3, not of the group
    const GroupIndex one = add_group(mesh, "ONE", GroupKind::element, {2});
    const GroupIndex both = add_group(mesh, "BOTH", GroupKind::element, {1, 2});
    const auto b = virtual_boundary(mesh, one);
    EXPECT_EQ(faces_of(b.bounding), (std::multiset<Nodes>{{1, 2, 3}, {1, 2, 4}, {1, 3, 4}, {2, 3, 4}}));
    for (std::size_t f = 0; f < 4; ++f) {
        const auto& v = b.bounding.faces[f];
        const Vec3 a = mesh.points[v[0]], normal = (mesh.points[v[1]] - a).cross(mesh.points[v[2]] - a);
        EXPECT_GT(normal.dot(a - Vec3(0.2, 0.2, 0.2)), 0) << "normals point out of the area";
        const bool has_element = !Nodes(v.begin(), v.end()).contains(1);
        EXPECT_EQ(b.bounding.face_elements[f].cell, has_element ? 0 : -1);
    }
    EXPECT_EQ(faces_of(virtual_boundary(mesh, both).bounding),
              (std::multiset<Nodes>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 4}, {1, 3, 4}, {2, 3, 4}}));
}

TEST(VirtualBoundary, FacesIn3D) {
    Mesh mesh = two_tetrahedra();
    add_cells(mesh, CellType::triangle, {{1, 2, 3}, {1, 2, 4}, {1, 3, 4}, {2, 3, 4}, {0, 1, 2}});
    // Four of them enclose tetrahedron 2, the fifth links.
    const auto b = virtual_boundary(mesh, add_group(mesh, "G", GroupKind::element, {3, 4, 5, 6, 7}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::tetra, 1}));
    EXPECT_EQ(faces_of(b.bounding), (std::multiset<Nodes>{{1, 2, 3}, {1, 2, 4}, {1, 3, 4}, {2, 3, 4}}));
    EXPECT_EQ(faces_of(b.linking), (std::multiset<Nodes>{{0, 1, 2}}));
    EXPECT_THAT(b.linking.face_elements, ElementsAre(CellRef{CellType::triangle, 4}));
    EXPECT_THAT(b.linking.edges, IsEmpty());
}

TEST(VirtualBoundary, EdgesIn3D) {
    Mesh mesh = two_tetrahedra();
    add_cells(mesh, CellType::line, {{1, 2}, {2, 3}, {3, 1}, {0, 1}, {4, 1}});
    const GroupIndex ring = add_group(mesh, "RING", GroupKind::element, {3, 4, 5, 6});
    auto b = virtual_boundary(mesh, ring);  // three edges of the common face, and one more
    EXPECT_THAT(b.enclosed, IsEmpty());
    EXPECT_EQ(faces_of(b.linking), (std::multiset<Nodes>{{1, 2, 3}}));
    EXPECT_EQ(edges_of(b.linking), (std::multiset<Nodes>{{0, 1}}));
    EXPECT_THAT(b.isolated.nodes, IsEmpty());
    add_cells(mesh, CellType::line, {{4, 2}, {4, 3}});
    b = virtual_boundary(mesh, add_group(mesh, "SIX", GroupKind::element, {3, 4, 5, 6, 7, 8, 9}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::tetra, 1}));
    EXPECT_EQ(faces_of(b.bounding), (std::multiset<Nodes>{{1, 2, 3}, {1, 2, 4}, {1, 3, 4}, {2, 3, 4}}));
    EXPECT_THAT(b.linking.faces, IsEmpty());
    EXPECT_EQ(edges_of(b.linking), (std::multiset<Nodes>{{0, 1}}));
}

TEST(VirtualBoundary, NodesIn3D) {
    Mesh mesh = two_tetrahedra();
    for (const Vec3& p : {Vec3(0, 0, 2), Vec3(1, 0, 2), Vec3(0, 1, 2)}) mesh.add_node(p, mesh.node_count() + 1);
    add_cells(mesh, CellType::tetra, {{4, 5, 6, 7}});
    const GroupIndex face = add_group(mesh, "FACE", GroupKind::node, {2, 3, 4, 7});
    auto b = virtual_boundary(mesh, face);
    EXPECT_EQ(faces_of(b.linking), (std::multiset<Nodes>{{1, 2, 3}}));
    EXPECT_THAT(b.linking.edges, IsEmpty()) << "they are covered by the face";
    EXPECT_THAT(b.bounding.faces, IsEmpty());
    EXPECT_THAT(b.isolated.nodes, ElementsAre(6));
    b = virtual_boundary(mesh, add_group(mesh, "SOLID", GroupKind::node, {2, 3, 4, 5, 6}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::tetra, 1}));
    EXPECT_EQ(b.bounding.faces.size(), 4u);
    EXPECT_EQ(edges_of(b.linking), (std::multiset<Nodes>{{4, 5}}));
    EXPECT_THAT(b.linking.faces, IsEmpty());
    EXPECT_THAT(b.isolated.nodes, IsEmpty());
}

TEST(VirtualBoundary, FacetsPointsAndMiddleNodes) {
    Mesh mesh = two_tetrahedra();
    add_cells(mesh, CellType::vertex, {{0}, {4}});
    // All faces of tetrahedron 2 as facets; CalculiX's face 1 of tetrahedron 1 is nodes 1 3 2.
    auto b = virtual_boundary(mesh, add_group(mesh, "S", GroupKind::facet, {2, 2, 2, 1}, {2, 3, 4, 1}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::tetra, 1}));
    EXPECT_THAT(b.linking.faces, IsEmpty());
    // A point element is isolated unless the group's tetrahedron covers it.
    b = virtual_boundary(mesh, add_group(mesh, "M", GroupKind::element, {2, 3, 4}));
    EXPECT_THAT(b.isolated.nodes, ElementsAre(0));

    Mesh bar;
    for (Index n = 0; n < 5; ++n) bar.add_node({double(n), 0, 0}, n + 1);
    add_cells(bar, CellType::line3, {{0, 2, 1}, {2, 4, 3}});
    b = virtual_boundary(bar, add_group(bar, "N", GroupKind::node, {1, 2, 3, 4}));
    EXPECT_EQ(edges_of(b.linking), (std::multiset<Nodes>{{0, 2}}));
    EXPECT_THAT(b.isolated.nodes, ElementsAre(3)) << "the middle of an edge that does not belong";
    EXPECT_THROW(virtual_boundary(bar, 1), Error);
}

TEST(VirtualBoundary, OtherElementsAndCoincidentOnes) {
    Mesh mesh;
    for (Index n = 0; n < 12; ++n) mesh.add_node({double(n % 2), double(n / 2 % 2), double(n / 4)}, n + 1);
    add_cells(mesh, CellType::hexahedron, {{0, 1, 3, 2, 4, 5, 7, 6}, {4, 5, 7, 6, 8, 9, 11, 10}});
    auto b = virtual_boundary(mesh, add_group(mesh, "N", GroupKind::node, {1, 2, 3, 4, 5, 6, 7, 8, 10, 12}));
    EXPECT_THAT(b.enclosed, ElementsAre(CellRef{CellType::hexahedron, 0}));
    EXPECT_EQ(b.bounding.faces.size(), 6u);
    EXPECT_EQ(faces_of(b.linking), (std::multiset<Nodes>{{5, 7, 9, 11}}));

    Mesh layers = plate();
    add_cells(layers, CellType::triangle, {{0, 1, 4}});  // a second layer on triangle 1
    b = virtual_boundary(layers, add_group(layers, "L", GroupKind::element, {1, 9}));
    EXPECT_EQ(edges_of(b.bounding), (std::multiset<Nodes>{{0, 1}, {1, 4}, {0, 4}}));
}

TEST(ElementaryGroups, DisjointClasses) {
    Mesh mesh = plate();
    add_cells(mesh, CellType::line, {{0, 1}});  // element 9
    const GroupIndex a = add_group(mesh, "A", GroupKind::element, {1, 2, 3, 9});
    const GroupIndex b = add_group(mesh, "B", GroupKind::element, {3, 4});
    const GroupIndex n = add_group(mesh, "N", GroupKind::node, {5});
    const GroupIndex f = add_group(mesh, "F", GroupKind::facet, {8, 7}, {1, 3});
    const GroupIndex hidden = mesh.add_group("CARD", GroupKind::element, true);
    set_group_members(mesh, hidden, {GroupKind::element, {2, 8}, {}});
    const auto classes = elementary_groups(mesh);
    ASSERT_EQ(classes.size(), 7u);
    const auto expect = [&](std::size_t k, GroupKind kind, int dimension, std::vector<GroupIndex> groups,
                            std::vector<Index> ids) {
        EXPECT_EQ(classes[k].kind, kind) << k;
        EXPECT_EQ(classes[k].dimension, dimension) << k;
        EXPECT_EQ(classes[k].groups, groups) << k;
        EXPECT_EQ(classes[k].members.ids, ids) << k;
    };
    expect(0, GroupKind::node, 0, {n}, {5});
    expect(1, GroupKind::element, 1, {a}, {9});
    expect(2, GroupKind::element, 2, {a}, {1, 2});  // the hidden group does not part them
    expect(3, GroupKind::element, 2, {a, b}, {3});
    expect(4, GroupKind::element, 2, {b}, {4});
    expect(5, GroupKind::facet, 1, {f}, {7});
    expect(6, GroupKind::facet, 2, {f}, {8});
    EXPECT_THAT(classes[6].members.faces, ElementsAre(1));
}

// ---- Random meshes and groups against the definition, worked out the slow way ----

template <class T>
std::multiset<T> multi(const std::set<T>& set) {
    return {set.begin(), set.end()};
}

class RandomGroups : public testing::TestWithParam<int> {};

TEST_P(RandomGroups, BoundaryIsTheDefinition) {
    std::mt19937 rng(static_cast<unsigned>(GetParam()));
    const int dimension = GetParam() % 2 ? 3 : 2;
    Mesh mesh = random_mesh(rng, dimension, dimension == 3 ? 2 : 4);
    add_random_groups(rng, mesh, 30);
    const VirtualBoundaryFinder finder(mesh);
    for (GroupIndex g = 0; g < 30; ++g) {
        SCOPED_TRACE(mesh.groups[g].name + " " + std::string(to_string(mesh.groups[g].kind)));
        const VirtualBoundary b = finder.find(g);
        const Expected e = slow_boundary(mesh, g);
        std::multiset<Nodes> area;
        for (const CellRef& c : b.enclosed)
            area.insert(Nodes(mesh.block(c.type).nodes(c.cell).begin(), mesh.block(c.type).nodes(c.cell).end()));
        EXPECT_EQ(area, multi(e.area));
        EXPECT_EQ(dimension == 3 ? faces_of(b.bounding) : edges_of(b.bounding), multi(e.bounding));
        EXPECT_EQ(faces_of(b.linking), multi(e.linking_faces));
        EXPECT_EQ(edges_of(b.linking), multi(e.linking_edges));
        EXPECT_EQ(b.isolated.nodes, std::vector<Index>(e.isolated.begin(), e.isolated.end()));
        // An element is named exactly where one lies.
        for (std::size_t k = 0; k < b.linking.edges.size(); ++k) {
            const CellRef& c = b.linking.edge_elements[k];
            const Nodes edge(b.linking.edges[k].begin(), b.linking.edges[k].end());
            bool exists = false;
            const CellBlock& lines = mesh.block(CellType::line);
            for (Index l = 0; l < lines.size(); ++l)
                exists = exists || Nodes(lines.nodes(l).begin(), lines.nodes(l).end()) == edge;
            EXPECT_EQ(c.cell >= 0, exists);
            if (c.cell >= 0) {
                EXPECT_EQ(Nodes(lines.nodes(c.cell).begin(), lines.nodes(c.cell).end()), edge);
            }
        }
    }
}

TEST_P(RandomGroups, ElementaryGroupsPartTheMesh) {
    std::mt19937 rng(static_cast<unsigned>(GetParam()));
    Mesh mesh = random_mesh(rng, GetParam() % 2 ? 3 : 2, 2);
    add_random_groups(rng, mesh, 30);
    const auto classes = elementary_groups(mesh);
    std::map<GroupIndex, std::set<std::pair<Index, Index>>> found, expected;
    std::set<std::tuple<GroupKind, int, std::vector<GroupIndex>>> seen;
    std::set<std::tuple<GroupKind, Index, Index>> members;
    for (const ElementaryGroup& c : classes) {
        EXPECT_TRUE(seen.emplace(c.kind, c.dimension, c.groups).second) << "two classes of the same groups";
        EXPECT_FALSE(c.groups.empty() || c.members.ids.empty());
        for (std::size_t k = 0; k < c.members.ids.size(); ++k) {
            const Index face = c.kind == GroupKind::facet ? c.members.faces[k] : 0;
            EXPECT_TRUE(members.emplace(c.kind, c.members.ids[k], face).second) << "in two classes";
            for (const GroupIndex g : c.groups) found[g].emplace(c.members.ids[k], face);
        }
    }
    for (GroupIndex g = 0; g < 30; ++g) {
        const GroupMembers m = group_members(mesh, g);
        for (std::size_t k = 0; k < m.ids.size(); ++k)
            expected[g].emplace(m.ids[k], m.kind == GroupKind::facet ? m.faces[k] : 0);
    }
    EXPECT_EQ(found, expected);
}

/// A band of the whole mesh has the boundary of every group, but for the shortcuts of node groups.
TEST_P(RandomGroups, BandHasTheBoundaries) {
    std::mt19937 rng(static_cast<unsigned>(GetParam()));
    const int dimension = GetParam() % 2 ? 3 : 2;
    Mesh mesh = random_mesh(rng, dimension, dimension == 3 ? 2 : 4);
    add_random_groups(rng, mesh, 30);
    const BandMesh band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
    std::vector<bool> drifting(30, false);
    drifting[3] = drifting[4] = true;
    const BandBoundaries boundaries(band, mesh, drifting);

    const auto global = [&](const auto& local) {
        Nodes out;
        for (const int v : local) out.insert(band.nodes[v].global);
        return out;
    };
    struct Found {
        std::set<Nodes> faces, lines;
        Nodes isolated;
    };
    std::map<GroupIndex, Found> found;
    Nodes in_band;
    for (const auto& n : band.nodes) in_band.insert(n.global);
    std::set<Nodes> kept_anyway;  // skin, shells, members, and borders of element groups
    std::size_t distinct = 0;
    std::set<Nodes> all;
    for (const auto& f : boundaries.faces()) {
        for (const GroupIndex g : boundaries.groups(f.kind)) found[g].faces.insert(global(f.nodes));
        if (!f.is_internal() || f.element) kept_anyway.insert(global(f.nodes));
        all.insert(global(f.nodes));
        ++distinct;
    }
    EXPECT_EQ(all.size(), distinct) << "each face once";
    for (const auto& l : boundaries.lines())
        for (const GroupIndex g : boundaries.groups(l.kind)) found[g].lines.insert(global(l.nodes));
    for (const auto& n : boundaries.isolated())
        for (const GroupIndex g : boundaries.groups(n.kind)) found[g].isolated.insert(band.nodes[n.node].global);

    for (GroupIndex g = 0; g < 30; ++g)
        if (dimension == 3 && !drifting[g] && mesh.groups[g].kind == GroupKind::element) {
            const Expected e = slow_boundary(mesh, g);
            kept_anyway.insert(e.bounding.begin(), e.bounding.end());
        }
    for (GroupIndex g = 0; g < 30; ++g) {
        SCOPED_TRACE(mesh.groups[g].name + " " + std::string(to_string(mesh.groups[g].kind)));
        if (drifting[g]) {
            EXPECT_FALSE(found.contains(g));
            continue;
        }
        const Expected e = slow_boundary(mesh, g);
        std::set<Nodes> wanted = e.linking_faces;
        if (dimension == 3) wanted.insert(e.bounding.begin(), e.bounding.end());
        if (mesh.groups[g].kind != GroupKind::node) {
            // Members are kept wherever they are; what they enclose or span has them as its border.
            for (const Nodes& f : wanted)
                if (!found[g].faces.contains(f)) {
                    for (const Nodes& edge : subsets(f, 2)) EXPECT_TRUE(found[g].lines.contains(edge));
                }
            for (const Nodes& l : e.linking_edges) EXPECT_TRUE(found[g].lines.contains(l));
            for (const Index n : e.isolated) EXPECT_TRUE(found[g].isolated.contains(n));
            continue;
        }
        if (dimension == 2) wanted = e.area;  // shells are listed with what they are part of
        const auto on_kept_face_of_group = [&](Index n) {
            return std::ranges::any_of(kept_anyway, [&](const Nodes& s) {
                return s.contains(n) && std::ranges::all_of(s, [&](Index v) {
                           return mesh.families.contains(mesh.node_families[v], g);
                       });
            });
        };
        const auto is_shortcut = [&](const Nodes& entity) {
            if (std::ranges::any_of(kept_anyway, [&](const Nodes& s) { return contains(s, entity); })) return false;
            return std::ranges::all_of(entity, on_kept_face_of_group);
        };
        std::set<Nodes> faces, lines;
        for (const Nodes& f : wanted)
            if (!is_shortcut(f)) faces.insert(f);
        for (const Nodes& l : e.linking_edges)
            if (dimension == 2 || !is_shortcut(l)) lines.insert(l);
        // A triangle element inside the material makes its edges real, too.
        for (const Nodes& l : e.linking_edges) {
            const CellBlock& triangles = mesh.block(CellType::triangle);
            for (Index t = 0; t < triangles.size(); ++t)
                if (contains(Nodes(triangles.nodes(t).begin(), triangles.nodes(t).end()), l)) lines.insert(l);
        }
        EXPECT_EQ(found[g].faces, faces);
        EXPECT_EQ(found[g].lines, lines);
        Nodes isolated;
        for (const Index n : e.isolated)
            if (in_band.contains(n)) isolated.insert(n);  // a node without elements does not move anyway
        EXPECT_EQ(found[g].isolated, isolated);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGroups, testing::Range(0, 24));

TEST(BandBoundaries, ShortcutsThroughTheMaterialAreNotKept) {
    // Four tetrahedra around the edge 0-1; on one of the ring's nodes hang two more, with a skin face at each end.
    Mesh mesh;
    for (const Vec3& p : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0),
                          Vec3(1, -1, 2), Vec3(1, 1, 2), Vec3(1, -1, -2), Vec3(1, 1, -2)})
        mesh.add_node(p, mesh.node_count() + 1);
    add_cells(mesh, CellType::tetra,
              {{1, 2, 3, 0}, {1, 3, 4, 0}, {1, 4, 5, 0}, {1, 5, 2, 0}, {0, 2, 6, 7}, {1, 2, 9, 8}});
    const GroupIndex ends = add_group(mesh, "ENDS", GroupKind::node, {1, 2});
    const GroupIndex sides = add_group(mesh, "SIDES", GroupKind::node, {1, 2, 7, 8, 9, 10});
    for (const GroupIndex g : {ends, sides})
        EXPECT_EQ(edges_of(virtual_boundary(mesh, g).linking), (std::multiset<Nodes>{{0, 1}}));

    const BandMesh band = extract_band(mesh, std::vector<std::int8_t>(10, 0));
    const BandBoundaries boundaries(band, mesh);
    ASSERT_EQ(boundaries.lines().size(), 1u);
    EXPECT_THAT(boundaries.lines()[0].nodes, UnorderedElementsAre(0, 1));
    EXPECT_THAT(boundaries.groups(boundaries.lines()[0].kind), ElementsAre(ends))
        << "the only link of its nodes is kept";
    int faces_of_sides = 0;
    for (const auto& f : boundaries.faces())
        if (f.kind != 0) {
            EXPECT_THAT(boundaries.groups(f.kind), ElementsAre(sides));
            ++faces_of_sides;
        }
    EXPECT_EQ(faces_of_sides, 2);
}

TEST(BandBoundaries, NodeBornOnALinkingEdgeIsLinked) {
    Mesh mesh = plate();
    const GroupIndex g = add_group(mesh, "GN", GroupKind::node, {1, 4, 7});
    BandMesh band = extract_band(mesh, std::vector<std::int8_t>(9, 0));
    band.split_edge(0, 3, {0, 0.5, 0});
    BandBoundaries boundaries(band, mesh);
    std::set<std::set<int>> lines;
    for (const auto& l : boundaries.lines()) {
        EXPECT_THAT(boundaries.groups(l.kind), ElementsAre(g));
        lines.insert({l.nodes[0], l.nodes[1]});
    }
    EXPECT_EQ(lines, (std::set<std::set<int>>{{0, 9}, {3, 9}, {3, 6}}));
    EXPECT_THAT(boundaries.isolated(), IsEmpty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
