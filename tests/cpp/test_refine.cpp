// SPDX-License-Identifier: LGPL-2.1-or-later
// What must hold of every refinement, on random tools and sizes, and its special cases.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "crack_checks.h"
#include "deformation/mid_sides.h"
#include "groups/group_report.h"
#include "io/inp.h"
#include "mesh/quality.h"
#include "operators/crack.h"
#include "operators/refine.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace checks;

#if defined(__SANITIZE_ADDRESS__)
constexpr int runs_per_mesh = 6;
#else
constexpr int runs_per_mesh = 40;
#endif

using Ends = std::pair<Index, Index>;
Ends ends(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// Edges of all elements of dimension 2 and 3 (or all), with their mid-side nodes (-1: none). A second mid-side node is
/// a finding.
std::map<Ends, Index> edges_of(const Mesh& mesh, int from_dimension, std::vector<std::string>& bad) {
    std::map<Ends, Index> edges;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < from_dimension) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (std::size_t e = 0; e < t.edges.size(); ++e) {
                const Index mid = t.quadratic ? n[t.corners + static_cast<int>(e)] : -1;
                const auto [it, fresh] = edges.emplace(ends(n[t.edges[e][0]], n[t.edges[e][1]]), mid);
                if (!fresh && it->second != mid)
                    bad.push_back("conforming: element " + std::to_string(b.ids[c]) +
                                  " has another mid-side node than its neighbour");
            }
        }
    }
    return edges;
}

double skin_area(const Mesh& mesh) {
    Mesh skin;
    skin.points = mesh.points;
    double area = 0;
    const std::vector<TetraFace> faces = tetra_faces(mesh);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if ((i > 0 && faces[i - 1].key == faces[i].key) || (i + 1 < faces.size() && faces[i + 1].key == faces[i].key))
            continue;
        const auto &f = faces[i].outward, &m = faces[i].mid;
        if (m[0] < 0)
            area += cell_measure(skin, CellType::triangle, skin.add_cell(CellType::triangle, f, 1));
        else
            area += cell_measure(skin, CellType::triangle6,
                                 skin.add_cell(CellType::triangle6, std::array{f[0], f[1], f[2], m[0], m[1], m[2]}, 1));
    }
    return area;
}

/// The names of the groups of each family.
std::set<std::string> group_names(const Mesh& mesh, FamilyIndex family) {
    std::set<std::string> names;
    for (const GroupIndex g : mesh.families.groups(family))
        if (!mesh.groups[g].hidden)
            names.insert(std::string(to_string(mesh.groups[g].kind)) + " " + mesh.groups[g].name);
    return names;
}

/// Everything that does not hold; empty when all is well.
std::vector<std::string> check_refinement(const Mesh& in, const DistanceField& distance, const RefineOptions& options,
                                          const Result& result) {
    std::vector<std::string> bad;
    const Mesh& out = result.mesh;
    out.validate();
    const auto add = [&](const auto&... parts) {
        std::ostringstream text;
        text << std::setprecision(15);
        (text << ... << parts);
        if (bad.size() < 8) bad.push_back(text.str());
    };

    // Nothing of the input moves or changes its number; new numbers are above the largest.
    for (Index n = 0; n < in.node_count(); ++n) {
        if (out.node_ids[n] != in.node_ids[n] || out.points[n] != in.points[n]) add("untouched: node ", in.node_ids[n]);
        if (group_names(out, out.node_families[n]) != group_names(in, in.node_families[n]))
            add("groups: node ", in.node_ids[n]);
    }
    for (Index n = in.node_count(); n < out.node_count(); ++n)
        if (out.node_ids[n] <= in.largest_node_id()) add("numbers: node ", out.node_ids[n]);
    std::map<Index, std::vector<double>> parts;
    for (const CellBlock& b : out.blocks()) {
        const CellBlock& old = in.block(b.type);
        for (Index c = 0; c < old.size(); ++c) {
            if (b.ids[c] != old.ids[c]) add("untouched: element ", old.ids[c]);
            if (group_names(out, b.families[c]) != group_names(in, old.families[c]))
                add("groups: element ", old.ids[c]);
        }
        for (Index c = old.size(); c < b.size(); ++c)
            if (b.ids[c] <= in.largest_cell_id()) add("numbers: element ", b.ids[c]);
    }

    // Valid shapes.
    for (const CellType type : {CellType::tetra, CellType::tetra10}) {
        const CellBlock& b = out.block(type);
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (signed_volume(out.points[n[0]], out.points[n[1]], out.points[n[2]], out.points[n[3]]) <= 0)
                add("shape: element ", b.ids[c], " inverted");
            if (type == CellType::tetra) continue;
            std::array<Vec3, 10> x;
            for (int k = 0; k < 10; ++k) x[k] = out.points[n[k]];
            if (integration_ratio(x) <= 0) add("shape: element ", b.ids[c], " has a negative Jacobian");
        }
    }
    const QualitySummary &before = result.report.quality_before, &after = result.report.quality_after;
    if (after.minimum < before.minimum / 2) add("quality: ", before.minimum, " -> ", after.minimum);

    // Conforming: no face, edge or mid-side node stands alone that did not before.
    const std::map<Ends, Index> edges = edges_of(out, 1, bad), inner = edges_of(out, 2, bad);
    const std::vector<TetraFace> faces = tetra_faces(out);
    std::set<std::array<Index, 3>> keys;
    for (const TetraFace& f : faces) keys.insert(f.key);
    for (std::size_t i = 2; i < faces.size(); ++i)
        if (faces[i].key == faces[i - 2].key) add("conforming: three tetrahedra on one face");
    const double tolerance =
        in.block(CellType::tetra10).size() > 0 ? 1e-6 : 1e-9;  // of the area's quadrature on curved faces
    const double area = skin_area(in);
    if (std::abs(skin_area(out) - area) > tolerance * area) add("conforming: skin area ", area, " -> ", skin_area(out));
    std::vector<std::string> ignored;
    const std::map<Ends, Index> inner_before = edges_of(in, 2, ignored);
    const auto loose = [&](const Mesh& mesh, const std::map<Ends, Index>& of) {
        int count = 0;
        for (const CellType type : {CellType::line, CellType::line3})
            for (Index c = 0; c < mesh.block(type).size(); ++c)
                count += !of.contains(ends(mesh.block(type).nodes(c)[0], mesh.block(type).nodes(c)[1]));
        return count;
    };
    if (loose(out, inner) != loose(in, inner_before)) add("conforming: segments came off their elements");
    std::set<std::array<Index, 3>> keys_before;
    for (const TetraFace& f : tetra_faces(in)) keys_before.insert(f.key);
    const auto shells = [](const Mesh& mesh, const auto& of) {
        double sum = 0;
        for (const CellType type : {CellType::triangle, CellType::triangle6})
            for (Index c = 0; c < mesh.block(type).size(); ++c) {
                const auto n = mesh.block(type).nodes(c);
                std::array<Index, 3> key{n[0], n[1], n[2]};
                std::ranges::sort(key);
                if (!of.contains(key)) sum += cell_measure(mesh, type, c);
            }
        return sum;
    };
    if (const double a = shells(in, keys_before), b = shells(out, keys); std::abs(a - b) > 1e-9 * std::max(a, b))
        add("conforming: triangles came off their tetrahedra");
    if (const double a = area, b = shells(in, keys_before); a == 0) {  // a shell mesh: its border keeps its length
        static_cast<void>(b);
        const auto border = [](const Mesh& mesh) {
            std::map<Ends, int> count;
            double length = 0;
            for (Index c = 0; c < mesh.block(CellType::triangle).size(); ++c) {
                const auto n = mesh.block(CellType::triangle).nodes(c);
                for (int k = 0; k < 3; ++k) ++count[ends(n[k], n[(k + 1) % 3])];
            }
            for (const auto& [e, k] : count)
                length += k == 1 ? (mesh.points[e.first] - mesh.points[e.second]).norm() : 0;
            return length;
        };
        if (std::abs(border(in) - border(out)) > 1e-9 * border(in))
            add("conforming: border length ", border(in), " -> ", border(out));
    }

    // Groups: the same, each with the measure it had.
    const std::vector<GroupSum> sums = group_sums(in), sums_after = group_sums(out);
    if (in.groups.size() != out.groups.size()) add("groups: their number");
    for (std::size_t g = 0; g < std::min(in.groups.size(), out.groups.size()); ++g) {
        if (in.groups[g].name != out.groups[g].name || in.groups[g].kind != out.groups[g].kind)
            add("groups: name of ", in.groups[g].name);
        if (in.groups[g].kind == GroupKind::node) continue;
        if (std::abs(sums[g].measure - sums_after[g].measure) > tolerance * sums[g].measure)
            add("groups: measure of ", in.groups[g].name, ": ", sums[g].measure, " -> ", sums_after[g].measure);
        if ((sums[g].normal_area - sums_after[g].normal_area).norm() > 1e-9 * std::max(1.0, sums[g].measure))
            add("groups: area vector of ", in.groups[g].name);
    }
    // A node group that was all nodes of an element group, at least is so still.
    for (std::size_t g = 0; g < in.groups.size(); ++g) {
        if (in.groups[g].kind != GroupKind::node) continue;
        const auto twin = in.find_group(in.groups[g].name, GroupKind::element);
        if (!twin) continue;
        const auto missing = [&](const Mesh& mesh) {
            Index count = 0;
            for (const CellBlock& b : mesh.blocks())
                for (Index c = 0; c < b.size(); ++c)
                    if (mesh.families.contains(b.families[c], *twin))
                        for (const Index n : b.nodes(c))
                            count += !mesh.families.contains(mesh.node_families[n], static_cast<GroupIndex>(g));
            return count;
        };
        if (missing(in) == 0 && missing(out) > 0)
            add("groups: nodes of ", in.groups[g].name, " are not in its node group");
    }

    // The size that was asked for.
    for (const auto& [e, mid] : inner) {
        static_cast<void>(mid);
        const Vec3 &a = out.points[e.first], &b = out.points[e.second];
        const double da = distance(a), db = distance(b), dm = distance((a + b) / 2);
        // Signs differ on two sides of a surface, and where another of several surfaces is the nearest.
        const bool crosses = da * db < 0 && std::abs(da) + std::abs(db) <= (b - a).norm();
        const double d = crosses ? 0 : std::min({std::abs(da), std::abs(db), std::abs(dm)});
        const double wanted = options.size + options.gradation * std::max(0.0, d - options.reach);
        if ((b - a).norm() > wanted * (1 + 1e-12))
            add("size: an edge of ", (b - a).norm(), " instead of ", wanted, " at distance ", d);
    }
    return bad;
}

class Refinements : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Meshes, Refinements,
                         testing::Values("two_boxes", "flanged_cylinder", "l_shape", "quadratic_elbow",
                                         "caisson_shell"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(Refinements, AreConformingAndKeepEverything) {
    const Mesh mesh = read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/" + GetParam() + ".inp");
    const Mesh before = mesh;
    std::vector<std::string> ignored;
    double length = 0;
    Vec3 low = mesh.points[0], high = low;
    const auto edges = edges_of(mesh, 2, ignored);
    for (const auto& e : edges)
        length += (mesh.points[e.first.first] - mesh.points[e.first.second]).norm() / static_cast<double>(edges.size());
    for (const Vec3& x : mesh.points) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    Random random(31);
    int divided = 0, failed = 0;
    double worst = 1, worst_ratio = 1;
    for (int k = 0; k < runs_per_mesh; ++k) {
        Vec3 at;
        for (int a = 0; a < 3; ++a) at[a] = random.uniform(low[a], high[a]);
        if (k % 2 == 0)
            at = mesh.points[static_cast<std::size_t>(random.uniform(0, static_cast<double>(mesh.points.size())))];
        const Vec3 axis = random.direction();
        const Cylinder cylinder(at, axis, length * random.uniform(0.3, 3));
        const Plane plane(at, axis);
        const DistanceField distance = k % 3 == 0   ? distance_to(std::vector<const Tool*>{&cylinder})
                                       : k % 3 == 1 ? distance_to(std::vector<Vec3>{at, at + length * axis})
                                                    : distance_to(std::vector<const Tool*>{&plane, &cylinder});
        RefineOptions options;
        options.size = length * (k % 3 == 1 ? random.uniform(0.08, 0.9) : random.uniform(0.4, 1.2));
        options.gradation = random.uniform(0.2, 1.2);
        options.reach = k % 4 == 0 ? length * random.uniform() : 0;
        options.relax = k % 5 != 0;
        const Result result = refine(mesh, distance, options);
        const std::vector<std::string> findings = check_refinement(mesh, distance, options, result);
        divided += result.report.elements_added > 0;
        worst = std::min(worst, result.report.quality_after.minimum);
        worst_ratio = std::min(worst_ratio, result.report.quality_after.minimum / result.report.quality_before.minimum);
        if (findings.empty() || ++failed > 10) continue;
        ADD_FAILURE() << "run " << k << ", size " << options.size << ", gradation " << options.gradation << ", at ("
                      << at.transpose() << "): " << testing::PrintToString(findings);
    }
    EXPECT_EQ(failed, 0);
    EXPECT_GT(divided, runs_per_mesh * 2 / 3);
    EXPECT_TRUE(identical(mesh, before)) << "the input was changed";
    std::cout << std::setprecision(3) << "[  QUALITY ] " << GetParam() << ", refine: " << divided << " of "
              << runs_per_mesh << " divide elements; minimum mean ratio " << worst << ", at least " << worst_ratio
              << " of the input's\n";
}

/// Two tetrahedra on a face, a hexahedron beside them that shares an edge, a beam, a spring between far nodes.
struct Little {
    Mesh mesh;
    Little() {
        for (const Vec3& x :
             {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.3, 0.3, -1.5), Vec3(-1, 0, 0),
              Vec3(-1, 0, 1), Vec3(0, -1, 0), Vec3(-1, -1, 0), Vec3(0, -1, 1), Vec3(-1, -1, 1), Vec3(5, 5, 5)})
            mesh.add_node(x, 10 * (mesh.node_count() + 1));
    }
    FamilyIndex family(const char* name, GroupKind kind) { return mesh.families.with(0, mesh.add_group(name, kind)); }
};

const RefineOptions half = [] {
    RefineOptions o;
    o.size = 0.5;
    o.gradation = 0;
    return o;
}();

DistanceField everywhere() {
    return [](const Vec3&) { return 0.0; };
}

TEST(Refine, FacetsBeamsAndMassesFollow) {
    Little m;
    m.mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 100, m.family("UPPER", GroupKind::element));
    m.mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 2, 1, 4}, 101);
    m.mesh.add_cell(CellType::line, std::array<Index, 2>{0, 1}, 102,
                    m.family("EDGE", GroupKind::element));  // on the tetrahedra
    m.mesh.add_cell(CellType::line, std::array<Index, 2>{3, 11}, 103,
                    m.family("BEAM", GroupKind::element));  // on nothing
    m.mesh.add_cell(CellType::vertex, std::array<Index, 1>{1}, 104, m.family("MASS", GroupKind::element));
    m.mesh.facets.push_back({CellType::tetra, 2, m.family("LOAD", GroupKind::facet), 0});  // corners 0, 3, 1
    const FamilyIndex fixed = m.family("FIXED", GroupKind::node);
    for (const Index n : {0, 1, 3}) m.mesh.node_families[n] = fixed;
    const Mesh before = m.mesh;
    const Result result = refine(m.mesh, everywhere(), half);
    EXPECT_TRUE(identical(before, m.mesh));
    EXPECT_THAT(check_refinement(m.mesh, everywhere(), half, result), testing::IsEmpty());
    const auto sums = group_sums(result.mesh);
    const auto count = [&](const char* name) { return sums[*result.mesh.find_group(name)].count; };
    EXPECT_EQ(count("BEAM"), 1);
    EXPECT_EQ(count("MASS"), 1);
    EXPECT_GE(count("EDGE"), 2);
    EXPECT_DOUBLE_EQ(sums[*result.mesh.find_group("EDGE")].measure, 1);
    EXPECT_GE(count("LOAD"), 4);
    double area = 0;
    for (const Facet& f : result.mesh.facets) area += facet_measure(result.mesh, f);
    EXPECT_NEAR(area, 0.5, 1e-12);
    // All nodes of the face are in FIXED, and no others.
    for (Index n = 0; n < result.mesh.node_count(); ++n)
        EXPECT_EQ(result.mesh.points[n].y() == 0 && result.mesh.points[n].z() >= 0 && n != 5 && n != 6,
                  result.mesh.families.contains(result.mesh.node_families[n], *result.mesh.find_group("FIXED")))
            << result.mesh.points[n].transpose();
    for (const GroupRecord& r : result.report.groups)
        EXPECT_TRUE(r.status == "kept" || r.status == "untouched") << r.name << " " << r.status;
}

TEST(Refine, HexahedraStopIt) {
    Little m;
    m.mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 100);
    m.mesh.add_cell(CellType::hexahedron, std::array<Index, 8>{8, 7, 0, 5, 10, 9, 3, 6},
                    200);  // its edge 0-3 is the tetrahedron's
    const Plane far_end({1, 0, 0}, {1, 0, 0});
    // Away from the hexahedron the tetrahedron is divided, and conforming.
    RefineOptions options;
    options.size = 0.4;
    options.gradation = 0.9;
    const DistanceField near_end = distance_to(std::vector<const Tool*>{&far_end});
    const Result result = refine(m.mesh, near_end, options);
    EXPECT_GT(result.report.elements_added, 2);
    EXPECT_THAT(check_refinement(m.mesh, near_end, options, result), testing::IsEmpty());
    EXPECT_EQ(result.mesh.block(CellType::hexahedron).connectivity, m.mesh.block(CellType::hexahedron).connectivity);
}

TEST(Refine, HexahedraWithLongEdgesBecomeTetrahedra) {
    Mesh mesh = checks::bricks(6, 2, 2);
    const FamilyIndex all = family_of(mesh, "ALL", GroupKind::element);
    for (FamilyIndex& f : mesh.block(CellType::hexahedron).families) f = all;
    const Plane end({0, 0, 0}, {1, 0, 0});
    RefineOptions options;
    options.size = 0.6;
    options.gradation = 0.9;
    const Result result = refine(mesh, distance_to(std::vector<const Tool*>{&end}), options);
    result.mesh.validate();
    EXPECT_GT(result.report.converted.at("hexahedron"), 4);
    EXPECT_GT(result.mesh.block(CellType::hexahedron).size(), 0);
    EXPECT_EQ(result.report.groups.at(0).count_before, 24);
    EXPECT_NEAR(result.report.groups.at(0).measure_after, 24, 1e-12);
    EXPECT_EQ(mesh.cell_count() + result.report.elements_added, result.mesh.cell_count());
    EXPECT_EQ(mesh.node_count() + result.report.nodes_added, result.mesh.node_count());
}

TEST(Refine, CurvedElementsKeepTheirGeometry) {
    // One second-order tetrahedron with every edge bent: parts of it fill exactly the same space.
    Mesh mesh;
    const std::array<Vec3, 4> corner{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    for (const Vec3& x : corner) mesh.add_node(x, mesh.node_count() + 1);
    Random random(3);
    for (const auto& e : traits(CellType::tetra10).edges)
        mesh.add_node((corner[e[0]] + corner[e[1]]) / 2 + 0.08 * random.direction(), mesh.node_count() + 1);
    mesh.add_cell(CellType::tetra10, std::array<Index, 10>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 1);
    const double volume = cell_measure(mesh, CellType::tetra10, 0);
    ASSERT_GT(std::abs(volume - 1.0 / 6), 1e-3);
    for (const double size : {0.8, 0.3}) {
        RefineOptions options = half;
        options.size = size;
        const Result result = refine(mesh, everywhere(), options);
        const CellBlock& b = result.mesh.block(CellType::tetra10);
        double sum = 0;
        for (Index c = 0; c < b.size(); ++c) sum += cell_measure(result.mesh, CellType::tetra10, c);
        EXPECT_GT(b.size(), 4);
        EXPECT_NEAR(sum, volume, 1e-14);
        EXPECT_NEAR(skin_area(result.mesh), skin_area(mesh), 2e-4) << "quadrature";
    }
    // Bisected once, the longest edge's mid-side node is a corner now, and no node is lost.
    RefineOptions once = half;
    once.size = std::sqrt(2) - 1e-3;
    const Result result = refine(mesh, distance_to(std::vector<Vec3>{corner[1], corner[2]}), once);
    for (Index n = 0; n < 10; ++n) EXPECT_EQ(result.mesh.points[n], mesh.points[n]);
    std::set<Index> used(result.mesh.block(CellType::tetra10).connectivity.begin(),
                         result.mesh.block(CellType::tetra10).connectivity.end());
    EXPECT_EQ(static_cast<Index>(used.size()), result.mesh.node_count());
}

TEST(Refine, StraightSecondOrderElementsStayStraight) {
    // New nodes are relaxed between rounds of bisection; nodes born beside them later must not go back to where they
    // were.
    Mesh plate = grid(20, 10, 1);
    for (Vec3& x : plate.points) x = x.cwiseProduct(Vec3(2, 2, 0.3));
    const Mesh mesh = second_order(plate);
    const Cylinder cylinder({20, 10, 0}, {0, 0, 1}, 1);
    RefineOptions options;
    options.size = 0.15;
    options.gradation = 0.4;
    const DistanceField distance = distance_to(std::vector<const Tool*>{&cylinder});
    const Result result = refine(mesh, distance, options);
    EXPECT_THAT(check_refinement(mesh, distance, options, result), testing::IsEmpty());
    int bent = 0;
    std::vector<std::string> ignored;
    for (const auto& [e, mid] : edges_of(result.mesh, 3, ignored)) {
        const Vec3 &a = result.mesh.points[e.first], &b = result.mesh.points[e.second];
        bent += (result.mesh.points[mid] - (a + b) / 2).norm() > 1e-9 * (b - a).norm();
    }
    EXPECT_EQ(bent, 0) << "edges";
    EXPECT_GT(result.report.elements_added, 1000);
}

TEST(Refine, GroupsOfCornersAloneHaveTheNewCorners) {
    Mesh linear = checks::grid(4, 3, 3);
    const FamilyIndex corners = checks::family_of(linear, "CORNERS", GroupKind::node);
    for (std::size_t n = 0; n < linear.points.size(); ++n)
        if (linear.points[n].x() <= 2) linear.node_families[n] = corners;
    Mesh mesh = checks::second_order(linear);
    // The skin there with its mid-side nodes: edges through the material are no part of it.
    const GroupIndex skin = mesh.add_group("SKIN", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (const Vec3& x = mesh.points[n]; x.x() == 0 || x.z() == 0)
            mesh.node_families[n] = mesh.families.with(mesh.node_families[n], skin);
    const Plane plane({0, 0, 0}, {0.6, 0, 0.8});
    RefineOptions options;
    options.size = 0.5;
    const Mesh fine = refine(mesh, distance_to(std::vector<const Tool*>{&plane}), options).mesh;
    const GroupIndex of_corners = *fine.find_group("CORNERS", GroupKind::node),
                     of_skin = *fine.find_group("SKIN", GroupKind::node);
    const CellBlock& tetras = fine.block(CellType::tetra10);
    Index promoted = 0;
    for (Index c = 0; c < tetras.size(); ++c)
        for (int k = 0; k < 4; ++k) {
            const Index n = tetras.nodes(c)[k];
            const Vec3& x = fine.points[n];
            EXPECT_EQ(fine.families.contains(fine.node_families[n], of_corners), x.x() <= 2) << x.transpose();
            EXPECT_EQ(fine.families.contains(fine.node_families[n], of_skin), x.x() == 0 || x.z() == 0)
                << x.transpose();
            promoted += n >= linear.node_count() && n < mesh.node_count();
        }
    EXPECT_GT(promoted, 100) << "mid-side nodes that became corners";
}

TEST(Refine, NothingToDo) {
    const Mesh mesh = read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/l_shape.inp");
    RefineOptions options;
    options.size = 1e6;
    const Result result = refine(mesh, everywhere(), options);
    EXPECT_TRUE(identical(result.mesh, mesh));
    EXPECT_THAT(result.report.warnings, testing::ElementsAre(testing::HasSubstr("nothing was refined")));
}

TEST(Refine, NearestPointIsTheNearest) {
    Random random(8);
    std::vector<Vec3> points;
    for (int k = 0; k < 500; ++k) points.push_back(random.uniform() * random.direction());
    const DistanceField distance = distance_to(points);
    for (int k = 0; k < 500; ++k) {
        const Vec3 x = 2 * random.uniform() * random.direction();
        double nearest = 1e9;
        for (const Vec3& p : points) nearest = std::min(nearest, (x - p).norm());
        EXPECT_NEAR(distance(x), nearest, 1e-12);
    }
}

TEST(Refine, BadOptions) {
    const Mesh mesh = read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/l_shape.inp");
    const auto expect = [&](const char* word, auto change) {
        RefineOptions options = half;
        change(options);
        EXPECT_THAT([&] { refine(mesh, everywhere(), options); },
                    testing::ThrowsMessage<ToolError>(testing::HasSubstr(word)))
            << word;
    };
    expect("size is 0", [](RefineOptions& o) { o.size = 0; });
    expect("size is -1", [](RefineOptions& o) { o.size = -1; });
    expect("size is nan", [](RefineOptions& o) { o.size = std::nan(""); });
    expect("gradation is -1", [](RefineOptions& o) { o.gradation = -1; });
    expect("reach is inf", [](RefineOptions& o) { o.reach = INFINITY; });
    expect("feature_angle is 0", [](RefineOptions& o) { o.feature_angle = 0; });
    expect("more than 10000 elements", [](RefineOptions& o) {
        o.size = 0.02;
        o.max_elements = 10000;
    });
    EXPECT_THAT([] { distance_to(std::vector<const Tool*>{}); },
                testing::ThrowsMessage<ToolError>(testing::HasSubstr("near is empty")));
    EXPECT_THAT(
        [] {
            distance_to(std::vector<Vec3>{{0, 0, 0}, {0, std::nan(""), 0}});
        },
        testing::ThrowsMessage<ToolError>(testing::HasSubstr("point 1")));
}

TEST(Refine, IsTheSameInEveryUnit) {
    // Squares of lengths beyond single precision once had no order, and refining no end.
    const auto refined = [](double unit) {
        Mesh mesh = grid(3, 2, 2);
        for (Vec3& x : mesh.points) x *= unit;
        const Plane plane(Vec3(1.5, 0, 0) * unit, {1, 0.1, 0.2});
        RefineOptions options;
        options.size = 0.5 * unit;
        options.max_elements = 20000;
        return refine(mesh, distance_to(std::vector<const Tool*>{&plane}), options).mesh.cell_count();
    };
    const Index count = refined(1);
    EXPECT_GT(count, 72);
    for (const int exponent : {-90, -60, 60, 90}) EXPECT_EQ(refined(std::ldexp(1.0, exponent)), count) << exponent;
}

TEST(Refine, ThenCrackAlongAThinCylinder) {
    // In so thin a cylinder elements have all four corners on it; the crack must not have holes there.
    const Mesh mesh = read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/two_boxes.inp");
    const Cylinder thin({6, 5, 5}, {0, 0, 1}, 0.6);
    RefineOptions options;
    options.size = 0.3;
    const Result refined = refine(mesh, distance_to(std::vector<const Tool*>{&thin}), options);
    const Result result = crack(refined.mesh, thin);
    EXPECT_GE(result.report.quality_after.minimum, 0.3);
    const double whole = 2 * M_PI * 0.6 * 10;
    EXPECT_NEAR(group_sums(result.mesh)[*result.mesh.find_group("CRACK_P", GroupKind::element)].measure, whole,
                0.04 * whole);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
