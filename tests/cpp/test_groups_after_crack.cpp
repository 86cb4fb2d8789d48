// SPDX-License-Identifier: LGPL-2.1-or-later
// What becomes of groups: Figures 9 and 12 of the paper, boundaries that may drift, and, on random meshes with random
// groups, who is a member afterwards, told from the input and from where things are alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "crack_checks.h"
#include "groups/node_membership.h"
#include "groups/virtual_boundary.h"
#include "io/inp.h"
#include "operators/crack.h"
#include "operators/drill.h"
#include "random_groups.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace checks;
using testing::ElementsAre;
using testing::HasSubstr;

const GroupRecord& record(const Result& result, std::string_view name, GroupKind kind) {
    for (const GroupRecord& r : result.report.groups)
        if (r.name == name && r.kind == kind) return r;
    throw Error("no record of " + std::string(name));
}

/// Largest distance of a group's nodes, or of its elements' nodes, from a plane.
double farthest(const Mesh& mesh, const std::string& name, GroupKind kind, const CutPlane& plane) {
    const GroupIndex g = *mesh.find_group(name, kind);
    double out = 0;
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (kind == GroupKind::node && mesh.families.contains(mesh.node_families[n], g))
            out = std::max(out, std::abs(plane.distance(mesh.points[n])));
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c)
            if (kind == GroupKind::element && mesh.families.contains(b.families[c], g))
                for (const Index n : b.nodes(c)) out = std::max(out, std::abs(plane.distance(mesh.points[n])));
    return out;
}

// ---- Figure 12: a plane crack across the border of two groups of tetrahedra ----

class Figure12 : public testing::Test {
protected:
    Mesh mesh_ = read_inp(FEMSCALPEL_TEST_MESHES "/two_boxes.inp");
    const CutPlane cut_{{10.2, 5, 5}, Vec3(0.9, 0.4, 0.2).normalized()};
    const CutPlane border_{{10, 5, 5}, Vec3(1, 0, 0)};
    const double size_ = 24.5;  // of the boxes

    Result crack_preserving(std::optional<std::vector<std::string>> preserve) const {
        CrackOptions options;
        options.preserve = std::move(preserve);
        return crack(mesh_, Plane(cut_.origin, cut_.normal), options);
    }
};

TEST_F(Figure12, BorderStaysThePlane) {
    const Result result = crack_preserving({});
    for (const auto& [name, kind] : {std::pair("GLUE", GroupKind::element), std::pair("GLUE", GroupKind::node)}) {
        EXPECT_LE(farthest(result.mesh, name, kind, border_), 1e-12 * size_) << name;
        EXPECT_LE(record(result, name, kind).boundary_drift, 1e-12 * size_);
    }
    const auto sums = group_sums(result.mesh);
    for (const char* name : {"LEFT", "RIGHT"})
        EXPECT_NEAR(sums[*mesh_.find_group(name, GroupKind::element)].measure, 1000, 1e-6) << name;
    EXPECT_NEAR(sums[*mesh_.find_group("GLUE", GroupKind::element)].measure, 100, 1e-7);
    EXPECT_GT(record(result, "GLUE", GroupKind::element).nodes_moved, 10)
        << "nodes slid along the border: the case is not trivial";
    EXPECT_TRUE(record(result, "GLUE", GroupKind::element).boundary_kept);
    // The border between the elements of the two groups is the same plane too, not only what is called GLUE.
    std::map<std::array<Index, 3>, int> sides;
    const GroupIndex left = *mesh_.find_group("LEFT", GroupKind::element);
    for (const TetraFace& f : tetra_faces(result.mesh))
        sides[f.key] +=
            result.mesh.families.contains(result.mesh.block(f.cell.type).families[f.cell.cell], left) ? 1 : 100;
    int border = 0;
    for (const auto& [key, count] : sides)
        if (count == 101) {
            ++border;
            for (const Index n : key) EXPECT_LE(std::abs(border_.distance(result.mesh.points[n])), 1e-12 * size_);
        }
    EXPECT_GT(border, 100);
}

TEST_F(Figure12, BorderDriftsWhenItMay) {
    const Result result = crack_preserving(std::vector<std::string>{});
    EXPECT_GT(farthest(result.mesh, "GLUE", GroupKind::element, border_), 0.2)
        << "visible: the mesh's edges are 1.25 long";
    const auto sums = group_sums(result.mesh);
    const double left = sums[*mesh_.find_group("LEFT", GroupKind::element)].measure,
                 right = sums[*mesh_.find_group("RIGHT", GroupKind::element)].measure;
    EXPECT_GT(std::abs(left - 1000), 0.1);
    EXPECT_NEAR(left + right, 2000, 1e-6) << "the skin is kept all the same";
    for (const auto& [name, kind] : {std::pair("GLUE", GroupKind::element), std::pair("LEFT", GroupKind::element),
                                     std::pair("GLUE", GroupKind::node)}) {
        const GroupRecord& r = record(result, name, kind);
        EXPECT_FALSE(r.boundary_kept);
        EXPECT_NEAR(r.boundary_drift, farthest(result.mesh, "GLUE", GroupKind::element, border_), 1e-12)
            << name << ": the report says how far";
        EXPECT_EQ(r.nodes_on_surface + r.nodes_on_line + r.nodes_fixed, 0);
    }
    EXPECT_LE(record(result, "ALL", GroupKind::element).boundary_drift, 1e-9) << "its boundary is the skin";
    EXPECT_EQ(record(result, "LEFT", GroupKind::element).status, "changed");
    EXPECT_EQ(result.report.constraints.at("group boundary"), 0);
    result.mesh.validate();
}

TEST_F(Figure12, OneGroupNamedIsEnoughToKeepTheBorder) {
    for (const char* name : {"LEFT", "RIGHT", "GLUE"}) {
        const Result result = crack_preserving(std::vector<std::string>{name});
        EXPECT_LE(farthest(result.mesh, "GLUE", GroupKind::element, border_), 1e-12 * size_) << name;
        EXPECT_TRUE(record(result, name, GroupKind::element).boundary_kept);
        EXPECT_FALSE(record(result, "ALL", GroupKind::element).boundary_kept);
    }
    // All of them named is the default.
    std::vector<std::string> all;
    for (const Group& g : mesh_.groups)
        if (!g.hidden) all.push_back(g.name);
    EXPECT_TRUE(identical(crack_preserving(all).mesh, crack_preserving({}).mesh));
}

TEST_F(Figure12, UnknownNameIsAnError) {
    try {
        crack_preserving(std::vector<std::string>{"LEFT", "LEFFT"});
        FAIL();
    } catch (const ToolError& e) {
        EXPECT_THAT(e.what(), testing::AllOf(HasSubstr("preserve"), HasSubstr("'LEFFT'")));
    }
}

TEST_F(Figure12, ConstraintsAreCountedByGroup) {
    const Result result = crack_preserving({});
    // The border's nodes near the crack, by where they are: inside the square, on an edge of it, in a corner.
    std::set<Index> near;
    for (const auto& [set, ids] : result.report.node_sets) near.insert(ids.begin(), ids.end());
    Index inside = 0, edge = 0, corner = 0;
    for (Index n = 0; n < result.mesh.node_count(); ++n) {
        const Vec3& x = result.mesh.points[n];
        if (!near.contains(result.mesh.node_ids[n]) || std::abs(x.x() - 10) > 1e-9) continue;
        int walls = 0;
        for (const double c : {x.y(), x.z()}) walls += c < 1e-9 || c > 10 - 1e-9;
        ++(walls == 0 ? inside : walls == 1 ? edge : corner);
    }
    ASSERT_GT(inside, 20);
    for (const GroupKind kind : {GroupKind::element, GroupKind::node}) {
        const GroupRecord& r = record(result, "GLUE", kind);
        EXPECT_EQ(r.nodes_on_surface, inside);
        EXPECT_EQ(r.nodes_on_line, edge);
        EXPECT_EQ(r.nodes_fixed, corner);
    }
    const GroupRecord& far = record(result, "END_LEFT", GroupKind::element);
    EXPECT_EQ(far.nodes_on_surface + far.nodes_on_line + far.nodes_fixed, 0);
}

/// The paper's own case: a hole whose axis lies in the border.
TEST_F(Figure12, HoleAcrossTheBorder) {
    const double radius = 2.1;
    const Cylinder cylinder({10, 5, 5}, {0, 0, 1}, radius);
    const Tool* const tools[] = {&cylinder};
    DrillOptions options;
    const Result kept = drill(mesh_, tools, options);
    for (const auto& [name, kind] : {std::pair("GLUE", GroupKind::element), std::pair("GLUE", GroupKind::node)})
        EXPECT_LE(farthest(kept.mesh, name, kind, border_), 1e-12 * size_) << name;
    const auto sums = group_sums(kept.mesh);
    // Where the wall meets the border it lies on both, so that exactly a strip of the hole's width is gone from it.
    EXPECT_NEAR(sums[*mesh_.find_group("GLUE", GroupKind::element)].measure, 100 - 2 * radius * 10, 1e-7);
    const double left = sums[*mesh_.find_group("LEFT", GroupKind::element)].measure,
                 right = sums[*mesh_.find_group("RIGHT", GroupKind::element)].measure;
    const double half = std::numbers::pi * radius * radius * 10 / 2;
    for (const double volume : {left, right}) {
        EXPECT_GT(volume, 1000 - half - 1e-9) << "walls of flat faces take less than the round hole";
        EXPECT_LT(volume, 1000 - 0.85 * half);
    }
    // Each group lost what the faces of the wall in its own elements enclose, to rounding: the divergence theorem over
    // its wall, with the border as the plane it is.
    for (const auto& [name, sign, volume] : {std::tuple("LEFT", -1.0, left), std::tuple("RIGHT", 1.0, right)}) {
        const GroupIndex group = *mesh_.find_group(name, GroupKind::element),
                         wall = *kept.mesh.find_group("HOLE_WALL", GroupKind::element);
        std::set<std::array<Index, 3>> of_wall;
        const CellBlock& triangles = kept.mesh.block(CellType::triangle);
        for (Index c = 0; c < triangles.size(); ++c)
            if (kept.mesh.families.contains(triangles.families[c], wall)) {
                std::array<Index, 3> key{triangles.nodes(c)[0], triangles.nodes(c)[1], triangles.nodes(c)[2]};
                std::ranges::sort(key);
                of_wall.insert(key);
            }
        double removed = 0;
        for (const TetraFace& f : tetra_faces(kept.mesh)) {
            if (!of_wall.contains(f.key) ||
                !kept.mesh.families.contains(kept.mesh.block(f.cell.type).families[f.cell.cell], group))
                continue;
            const auto& p = kept.mesh.points;
            const Vec3 a = p[f.outward[0]], b = p[f.outward[1]], c = p[f.outward[2]];
            removed += (b - a).cross(c - a).x() / 2 *
                       -((a + b + c) / 3 - Vec3(10, 5, 5)).x();  // x = 0 on the border: no flux there
        }
        EXPECT_NEAR(volume, 1000 - removed, 1e-6) << name;
        EXPECT_GT(removed, 0.9 * half) << name << sign;
    }
    EXPECT_GT(record(kept, "GLUE", GroupKind::element).nodes_moved, 10);
    options.preserve.emplace();
    const Result free = drill(mesh_, tools, options);
    EXPECT_GT(farthest(free.mesh, "GLUE", GroupKind::element, border_), 0.1);
    EXPECT_GT(record(free, "LEFT", GroupKind::element).boundary_drift, 0.1);
}

// ---- Figure 9: nodes along the border of a shell ----

TEST(Figure9, NodeBornBetweenLinkedNodesJoinsAndIsolatedOnesStayAlone) {
    Mesh mesh;
    add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 0.8, 0}, 8, 4);
    const FamilyIndex border = family_of(mesh, "GN", GroupKind::node), lone = family_of(mesh, "LONE", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n].y() == 0) mesh.node_families[n] = border;
    // Two isolated members of another group, on either side of the crack, and one close to it.
    std::vector<Index> alone;
    for (const Vec3& at : {Vec3(3, 1.6, 0), Vec3(6, 1.6, 0), Vec3(4, 2.4, 0)}) {
        alone.push_back(number_near(mesh, at));
        mesh.node_families[alone.back()] = lone;
    }
    const CutPlane plane{{4.5, 0, 0}, Vec3(1, 0.12, 0).normalized()};  // between n1 = (4, 0) and n2 = (5, 0)
    const Result result = crack(mesh, Plane(plane.origin, plane.normal));
    EXPECT_THAT(check_crack(Model(mesh, true), plane, result, "CRACK"), testing::IsEmpty());
    const GroupIndex gn = *mesh.find_group("GN"), lonely = *mesh.find_group("LONE");
    std::set<double> places;
    for (Index n = 0; n < result.mesh.node_count(); ++n) {
        const Vec3& x = result.mesh.points[n];
        EXPECT_EQ(result.mesh.families.contains(result.mesh.node_families[n], gn), x.y() == 0)
            << "node " << result.mesh.node_ids[n];
        if (x.y() == 0) places.insert(x.x());
    }
    EXPECT_EQ(places.size(), 10u) << "nine nodes, and the one that was born between n1 and n2";
    EXPECT_THAT(
        members(result.mesh, "LONE", GroupKind::node),
        testing::UnorderedElementsAre(mesh.node_ids[alone[0]], mesh.node_ids[alone[1]], mesh.node_ids[alone[2]]));
    for (const Index n : alone) {
        EXPECT_EQ(result.mesh.points[n], mesh.points[n]) << "an isolated node stays where it is";
        EXPECT_THAT(result.mesh.families.groups(result.mesh.node_families[n]), ElementsAre(lonely))
            << "single-membered";
    }
    EXPECT_EQ(record(result, "LONE", GroupKind::node).nodes_fixed, 3);
    EXPECT_GT(record(result, "GN", GroupKind::node).nodes_on_line, 3);
}

TEST(NodeMembership, MergingMustNotLinkIsolatedMembers) {
    // A fan of four triangles around the new node p = 5, born on the edge 0-2, which two triangles shared.
    Mesh mesh;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, -1, 0), Vec3(2, 0, 0), Vec3(1, 1, 0), Vec3(-1, 0, 0)})
        mesh.add_node(x, mesh.node_count() + 1);
    add_cells(mesh, CellType::triangle, {{0, 1, 2}, {0, 2, 3}, {4, 1, 0}, {4, 0, 3}});
    const FamilyIndex lone = family_of(mesh, "LONE", GroupKind::node), row = family_of(mesh, "ROW", GroupKind::node);
    mesh.node_families[1] = mesh.node_families[3] = lone;  // no edge joins them
    mesh.node_families[0] = mesh.node_families[2] = row;   // one does
    BandMesh band = extract_band(mesh, std::vector<std::int8_t>(5, 0));
    NodeMembership membership(band, mesh);
    const int p = band.split_edge(0, 2, {1, 0, 0});
    membership.add_node(band, p);
    EXPECT_TRUE(membership.merge_links(band, p, 1)) << "1 and 3 would become neighbours";
    EXPECT_TRUE(membership.merge_links(band, p, 3));
    EXPECT_FALSE(membership.merge_links(band, p, 0)) << "back to where it was";
    EXPECT_FALSE(membership.merge_links(band, p, 2));
}

TEST(FixedMiddle, EdgeIsSplitThere) {
    // A second-order box; one mid-side node of an edge that the plane crosses is observed, another is not.
    Mesh linear = grid(4, 2, 2), mesh;
    for (std::size_t n = 0; n < linear.points.size(); ++n) mesh.add_node(linear.points[n], linear.node_ids[n]);
    std::map<std::set<Index>, Index> middles;
    const CellBlock& tetras = linear.block(CellType::tetra);
    constexpr int edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    for (Index c = 0; c < tetras.size(); ++c) {
        const auto n = tetras.nodes(c);
        std::vector<Index> nodes(n.begin(), n.end());
        for (const auto& e : edges) {
            const auto [at, fresh] = middles.try_emplace({n[e[0]], n[e[1]]}, 0);
            if (fresh)
                at->second =
                    mesh.add_node((mesh.points[n[e[0]]] + mesh.points[n[e[1]]]) / 2, mesh.largest_node_id() + 1);
            nodes.push_back(at->second);
        }
        mesh.add_cell(CellType::tetra10, nodes, tetras.ids[c]);
    }
    const FamilyIndex gauge = family_of(mesh, "GAUGE", GroupKind::node);
    const Index observed = number_near(mesh, {1.5, 1, 1}), free = number_near(mesh, {1.5, 0, 0});
    mesh.node_families[observed] = gauge;
    for (const double x : {1.3, 1.5, 1.62}) {
        const CutPlane plane{{x, 1, 1}, Vec3(1, 0.1, 0.05).normalized()};
        const Result result = crack(mesh, Plane(plane.origin, plane.normal));
        EXPECT_THAT(check_crack(Model(mesh, true), plane, result, "CRACK"), testing::IsEmpty());
        EXPECT_EQ(result.mesh.points[observed], mesh.points[observed]) << "x = " << x;
        std::set<Index> gauges;
        for (const Index id : members(result.mesh, "GAUGE", GroupKind::node)) gauges.insert(id);
        // In the plane it is doubled, and the copy is a member, too.
        EXPECT_EQ(gauges.size(), x == 1.5 ? 2u : 1u);
        EXPECT_TRUE(gauges.contains(mesh.node_ids[observed]));
        if (x != 1.5) {
            EXPECT_NE(result.mesh.points[free], mesh.points[free]) << "another one may move: the case is not trivial";
        }
    }
}

TEST(DiscreteElements, StayOnTheSideWithMoreElements) {
    // Two layers left of the crack's node, or right: the mass goes with the side that has more elements at its node.
    Mesh mesh = grid(4, 2, 2);
    const FamilyIndex mass = family_of(mesh, "MASS", GroupKind::element),
                      gap = family_of(mesh, "GAP", GroupKind::element);
    std::map<Index, int> balance;  // positive elements less negative ones, by node in the plane
    const CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c) {
        double x = 0;
        for (const Index n : tetras.nodes(c)) x += mesh.points[n].x() / 4;
        for (const Index n : tetras.nodes(c))
            if (mesh.points[n].x() == 2) balance[n] += x > 2 ? 1 : -1;
    }
    Index number = 5000;
    for (const auto& [n, b] : balance) mesh.add_cell(CellType::vertex, std::array{n}, ++number, mass);
    // A gap between two opposite corners of the plane: no edge of the solid, both ends doubled.
    const Index from = number_near(mesh, {2, 0, 0}), to = number_near(mesh, {2, 2, 2});
    mesh.add_cell(CellType::line, std::array{from, to}, 6000, gap);
    const Result result = crack(mesh, Plane({2, 0, 0}, {1, 0, 0}));
    const auto is_positive = [&](Index node) {
        const CellBlock& block = result.mesh.block(CellType::tetra);
        for (Index c = 0; c < block.size(); ++c)
            if (std::ranges::count(block.nodes(c), node))
                for (const Index n : block.nodes(c))
                    if (result.mesh.points[n].x() != 2) return result.mesh.points[n].x() > 2;
        throw Error("no element there");
    };
    const CellBlock& points = result.mesh.block(CellType::vertex);
    ASSERT_EQ(points.size(), static_cast<Index>(balance.size()));
    int positive = 0;
    for (Index c = 0; c < points.size(); ++c) {
        const Index before = mesh.block(CellType::vertex).nodes(c)[0], now = points.nodes(c)[0];
        EXPECT_EQ(result.mesh.points[now], mesh.points[before]);
        EXPECT_EQ(is_positive(now), balance.at(before) > 0) << "balance " << balance.at(before);
        positive += balance.at(before) > 0;
    }
    EXPECT_GT(positive, 0);
    EXPECT_LT(positive, static_cast<int>(balance.size()));
    EXPECT_EQ(members(result.mesh, "MASS", GroupKind::element).size(), balance.size());
    const auto ends = result.mesh.block(CellType::line).nodes(0);
    EXPECT_EQ(is_positive(ends[0]), balance.at(from) + balance.at(to) > 0);
    EXPECT_EQ(is_positive(ends[1]), is_positive(ends[0])) << "whole on one side";
    EXPECT_THAT(result.report.warnings,
                testing::Contains(testing::AllOf(HasSubstr(std::to_string(balance.size()) + " point element"),
                                                 HasSubstr(std::to_string(positive) + " on the positive"))));
    EXPECT_THAT(result.report.warnings, testing::Contains(HasSubstr("1 segment element ")));
}

// ---- Random meshes, groups and planes ----

constexpr double near = 1e-9;

/// Distance of a point from a simplex of the input.
double distance_to(const Mesh& mesh, const Nodes& simplex, const Vec3& x) {
    // The nearest point is inside, or on a facet: barycentric coordinates by least squares.
    const std::vector<Index> n(simplex.begin(), simplex.end());
    if (n.size() == 1) return (mesh.points[n[0]] - x).norm();
    Eigen::MatrixXd edges(3, static_cast<Eigen::Index>(n.size()) - 1);
    for (std::size_t k = 1; k < n.size(); ++k)
        edges.col(static_cast<Eigen::Index>(k) - 1) = mesh.points[n[k]] - mesh.points[n[0]];
    const Eigen::VectorXd l = (edges.transpose() * edges).inverse() * edges.transpose() * (x - mesh.points[n[0]]);
    if (l.minCoeff() >= 0 && l.sum() <= 1) return (edges * l - (x - mesh.points[n[0]])).norm();
    double best = std::numeric_limits<double>::infinity();
    for (const Nodes& facet : subsets(simplex, n.size() - 1)) best = std::min(best, distance_to(mesh, facet, x));
    return best;
}

bool lies_on(const Mesh& mesh, const Nodes& simplex, const Vec3& x) {
    Vec3 low = x, high = x;
    for (const Index n : simplex) {
        low = low.cwiseMin(mesh.points[n]);
        high = high.cwiseMax(mesh.points[n]);
    }
    for (int a = 0; a < 3; ++a)  // not in the simplex's box: x made it larger
        if (std::ranges::all_of(
                simplex, [&](Index n) { return mesh.points[n][a] > x[a] + near || mesh.points[n][a] < x[a] - near; }) &&
            (low[a] == x[a] || high[a] == x[a]))
            return false;
    return distance_to(mesh, simplex, x) < near;
}

bool lies_on(const Mesh& mesh, const std::set<Nodes>& simplices, const Vec3& x) {
    return std::ranges::any_of(simplices, [&](const Nodes& s) { return lies_on(mesh, s, x); });
}

/// The elements and facets of a group, by their nodes.
std::set<Nodes> member_places(const Mesh& mesh, GroupIndex group) {
    std::set<Nodes> out;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c)
            if (mesh.families.contains(b.families[c], group)) out.insert(Nodes(b.nodes(c).begin(), b.nodes(c).end()));
    for (const Facet& f : mesh.facets) {
        if (!mesh.families.contains(f.family, group)) continue;
        constexpr int table[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
        const auto n = mesh.block(f.type).nodes(f.cell);
        if (n.size() == 4)
            out.insert({n[table[f.face - 1][0]], n[table[f.face - 1][1]], n[table[f.face - 1][2]]});
        else if (f.face <= 2)
            out.insert(Nodes(n.begin(), n.end()));
        else
            out.insert({n[f.face - 3], n[(f.face - 2) % 3]});
    }
    return out;
}

/// Whether a group of elements or facets covers more than its members: what all their edges or faces enclose.
bool closes(const Mesh& mesh, GroupIndex group, const VirtualBoundary& boundary) {
    const std::set<Nodes> members = member_places(mesh, group);
    const auto is_member = [&](const auto& nodes) {
        Nodes place(nodes.begin(), nodes.end());
        place.erase(-1);
        return members.contains(place);
    };
    return !std::ranges::all_of(boundary.linking.faces, is_member) ||
           !std::ranges::all_of(boundary.enclosed,
                                [&](const CellRef& c) { return is_member(mesh.block(c.type).nodes(c.cell)); });
}

std::set<std::string> names(const Mesh& mesh, FamilyIndex family, std::size_t of_input) {
    std::set<std::string> out;
    for (const GroupIndex g : mesh.families.groups(family))
        if (static_cast<std::size_t>(g) < of_input) out.insert(mesh.groups[g].name);
    return out;
}

/// Where a node group has shortcuts through the material, from one kept face of the group to another, its nodes need
/// not keep to them (band_boundaries.h), so the place of a node tells nothing: the tetrahedra around such faces and
/// edges.
std::set<Nodes> shortcut_zone(const Mesh& mesh, GroupIndex group) {
    const auto in = [&](Index n) { return mesh.families.contains(mesh.node_families[n], group); };
    std::map<Nodes, std::set<FamilyIndex>> families;
    std::map<Nodes, int> count;
    std::set<Nodes> tetras, kept;
    const CellBlock& block = mesh.block(CellType::tetra);
    for (Index c = 0; c < block.size(); ++c) {
        const Nodes t(block.nodes(c).begin(), block.nodes(c).end());
        tetras.insert(t);
        for (const Nodes& f : subsets(t, 3)) {
            ++count[f];
            families[f].insert(block.families[c]);
        }
    }
    for (const auto& [f, n] : count)
        if (n == 1 || families[f].size() > 1) kept.insert(f);
    const CellBlock& triangles = mesh.block(CellType::triangle);
    for (Index c = 0; c < triangles.size(); ++c)
        kept.insert(Nodes(triangles.nodes(c).begin(), triangles.nodes(c).end()));
    for (const Facet& f : mesh.facets)
        if (f.type == CellType::tetra) {
            constexpr int table[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
            const auto n = block.nodes(f.cell);
            kept.insert({n[table[f.face - 1][0]], n[table[f.face - 1][1]], n[table[f.face - 1][2]]});
        }
    Nodes covered;  // nodes on a kept face of the group
    for (const Nodes& f : kept)
        if (std::ranges::all_of(f, in)) covered.insert(f.begin(), f.end());
    std::set<Nodes> zone;
    for (const Nodes& t : tetras)
        for (const std::size_t size : {2u, 3u})
            for (const Nodes& s : subsets(t, size)) {
                if (!contains(covered, s)) continue;
                if (std::ranges::any_of(kept, [&](const Nodes& f) { return contains(f, s); })) continue;
                for (const Nodes& around : tetras)
                    if (std::ranges::any_of(around, [&](Index n) { return s.contains(n); })) zone.insert(around);
            }
    return zone;
}

struct Measures {
    double enclosed = 0, bounding = 0, faces = 0, edges = 0;
    std::set<std::array<long, 3>> isolated;
};

/// Sizes of a virtual boundary, what is in one place counted once and border that lies in the plane not at all.
Measures measure(const Mesh& mesh, const VirtualBoundary& b, const CutPlane& plane) {
    Measures out;
    const auto key = [&](Index n) {
        const Vec3 x = mesh.points[n] * 1e7;
        return std::array{std::lround(x.x()), std::lround(x.y()), std::lround(x.z())};
    };
    std::set<std::set<std::array<long, 3>>> seen;
    const auto size = [&](const auto& nodes, bool in_plane_too) {
        std::vector<Index> n;
        for (const Index v : nodes)
            if (v >= 0) n.push_back(v);
        std::set<std::array<long, 3>> place;
        bool in_plane = true;
        for (const Index v : n) {
            place.insert(key(v));
            in_plane = in_plane && std::abs(plane.distance(mesh.points[v])) < near;
        }
        if ((in_plane && !in_plane_too) || !seen.insert(place).second) return 0.0;
        const Vec3& a = mesh.points[n[0]];
        if (n.size() == 2) return (mesh.points[n[1]] - a).norm();
        return (mesh.points[n[1]] - a).cross(mesh.points[n[2]] - a).norm() / 2;
    };
    for (const auto& e : b.bounding.edges) out.bounding += size(e, false);
    for (const auto& f : b.bounding.faces) out.bounding += size(f, false);
    seen.clear();
    for (const auto& f : b.linking.faces) out.faces += size(f, true);
    for (const auto& e : b.linking.edges) out.edges += size(e, true);
    for (const Index n : b.isolated.nodes) out.isolated.insert(key(n));
    for (const CellRef& c : b.enclosed) {
        const auto n = mesh.block(c.type).nodes(c.cell);
        const Vec3 x = mesh.points[n[1]] - mesh.points[n[0]], y = mesh.points[n[2]] - mesh.points[n[0]];
        out.enclosed +=
            n.size() == 4 ? x.cross(y).dot(mesh.points[n[3]] - mesh.points[n[0]]) / 6 : x.cross(y).norm() / 2;
    }
    return out;
}

class RandomGroupsCracked : public testing::TestWithParam<int> {};

/// Members afterwards are the image of the members before: every element is in the groups of the one of the input that
/// its centre lies in, every node of the input in its own groups, every new one in the node groups that cover its
/// place. (All boundaries are flat here and kept, so places tell.) The virtual boundary of the image is the image of
/// the virtual boundary: it covers the same places, measured. What the crack opened counts once. Not compared are
/// groups of edges (faces) that cover more than themselves, a triangle by all its edges: the crack makes no elements of
/// the edges it cuts such a triangle with, which would add beams nobody asked for, so that its parts are not covered.
TEST_P(RandomGroupsCracked, MembersAreTheImage) {
    std::mt19937 rng(static_cast<unsigned>(1000 + GetParam()));
    const int dimension = GetParam() % 2 ? 3 : 2;
    constexpr int group_count = 30;
    int cracked = 0, checked_nodes = 0, joined = 0, unclear = 0, compared = 0, born = 0;
    for (int attempt = 0; attempt < 4; ++attempt) {
        Mesh mesh = random_mesh(rng, dimension, dimension == 3 ? 3 : 5, 0.2);
        add_random_groups(rng, mesh, group_count);
        std::uniform_real_distribution<double> u(0, 1);
        const Vec3 middle = mesh.points.back() / 2;
        Vec3 normal(u(rng) - 0.5, u(rng) - 0.5, dimension == 3 ? u(rng) - 0.5 : 0.1 * u(rng));
        const CutPlane plane{middle + 0.3 * Vec3(u(rng), u(rng), dimension == 3 ? u(rng) : 0), normal.normalized()};
        Result result;
        try {
            result = crack(mesh, Plane(plane.origin, plane.normal));
        } catch (const QualityError&) {  // too little room between fixed nodes
            continue;
        }
        ++cracked;
        const Mesh& after = result.mesh;
        after.validate();

        // Elements.
        for (const CellBlock& b : after.blocks()) {
            const CellBlock& old = mesh.block(b.type);
            const std::map<Index, Index> old_cells = [&] {
                std::map<Index, Index> out;
                for (Index c = 0; c < old.size(); ++c) out.emplace(old.ids[c], c);
                return out;
            }();
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                Vec3 centre = Vec3::Zero();
                for (const Index v : n) centre += after.points[v] / static_cast<double>(n.size());
                const auto now = names(after, b.families[c], group_count);
                const bool lip = after.families.groups(b.families[c]).size() > now.size();
                std::optional<std::set<std::string>> expected;
                for (Index o = 0; o < old.size() && !expected; ++o)
                    if (lies_on(mesh, Nodes(old.nodes(o).begin(), old.nodes(o).end()), centre))
                        expected = names(mesh, old.families[o], group_count);
                if (!expected && lip) expected.emplace();  // made by the crack
                ASSERT_TRUE(expected) << "element " << b.ids[c] << " is where none was";
                EXPECT_EQ(now, *expected) << "element " << b.ids[c];
                if (const auto kept = old_cells.find(b.ids[c]); kept != old_cells.end()) {
                    EXPECT_EQ(now, names(mesh, old.families[kept->second], group_count));
                }
            }
        }

        // Nodes and boundaries.
        std::map<Index, Index> old_nodes;
        for (Index n = 0; n < mesh.node_count(); ++n) old_nodes.emplace(mesh.node_ids[n], n);
        const auto sums_before = group_sums(mesh), sums_after = group_sums(after);
        const VirtualBoundaryFinder before_finder(mesh), after_finder(after);
        for (GroupIndex g = 0; g < group_count; ++g) {
            SCOPED_TRACE(mesh.groups[g].name + " " + std::string(to_string(mesh.groups[g].kind)));
            const bool node_group = mesh.groups[g].kind == GroupKind::node;
            const std::set<Nodes> zone = node_group && dimension == 3 ? shortcut_zone(mesh, g) : std::set<Nodes>{};
            if (node_group) {
                const Expected e = slow_boundary(mesh, g);
                std::set<Nodes> cover = e.area;
                cover.insert(e.linking_faces.begin(), e.linking_faces.end());
                cover.insert(e.linking_edges.begin(), e.linking_edges.end());
                for (const Index n : e.isolated) cover.insert({n});
                for (Index n = 0; n < after.node_count(); ++n) {
                    const bool member = after.families.contains(after.node_families[n], g);
                    if (const auto old = old_nodes.find(after.node_ids[n]); old != old_nodes.end()) {
                        EXPECT_EQ(member, mesh.families.contains(mesh.node_families[old->second], g))
                            << "node " << after.node_ids[n];
                        if (e.isolated.contains(old->second)) {
                            EXPECT_EQ(after.points[n], mesh.points[old->second])
                                << "isolated node " << after.node_ids[n] << " moved";
                        }
                        continue;
                    }
                    ++born;
                    if (lies_on(mesh, zone, after.points[n])) {
                        ++unclear;
                        continue;
                    }
                    ++checked_nodes;
                    joined += member;
                    EXPECT_EQ(member, lies_on(mesh, cover, after.points[n]))
                        << "new node " << after.node_ids[n] << " at " << after.points[n].transpose();
                }
            }
            if (!node_group) {  // whose shortcuts through the material may drift
                EXPECT_LE(record(result, mesh.groups[g].name, mesh.groups[g].kind).boundary_drift, 1e-9);
                EXPECT_NEAR(sums_before[g].measure, sums_after[g].measure, 1e-9);
            }
            const VirtualBoundary boundary = before_finder.find(g);
            if (!zone.empty() || (!node_group && closes(mesh, g, boundary))) continue;
            if (result.report.held.largest > 1e-9) continue;  // what borders the crack is a little beside the plane
            ++compared;
            const Measures a = measure(mesh, boundary, plane), b = measure(after, after_finder.find(g), plane);
            EXPECT_NEAR(a.enclosed, b.enclosed, 1e-9);
            EXPECT_NEAR(a.bounding, b.bounding, 1e-9);
            EXPECT_NEAR(a.faces, b.faces, 1e-9);
            EXPECT_NEAR(a.edges, b.edges, 1e-9);
            EXPECT_EQ(a.isolated, b.isolated);
        }
    }
    EXPECT_GT(cracked, 1);
    EXPECT_GT(compared, 10);  // not where nodes are held beside the plane, of which there are many here
    std::cout << "[   GROUPS ] " << cracked << " of 4 meshes cracked, " << group_count
              << " groups each: " << checked_nodes << " of " << born
              << " (new node, node group) pairs checked by place, " << joined << " of them members, " << unclear
              << " near a shortcut; virtual boundary compared for " << compared << " groups\n";
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomGroupsCracked, testing::Range(0, 24));

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
