// SPDX-License-Identifier: LGPL-2.1-or-later
// Each warning once where it is due, and once where it is not.
#include "operators/warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Plane sloping(const Vec3& through, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {through, {std::sin(angle), 0, std::cos(angle)}};
}

/// A cube of eight whose top a plane meets in its middle node, at an angle. The middle of the cube comes as high as
/// `height`.
std::vector<std::string> grazing_the_top(double degrees, double height) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane plane = sloping({1, 1, 2}, degrees);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    for (Contact& c : f.d.contact) c = {};
    f.d.contact[node_at(f.d.band, {1, 1, 2})] = &plane;
    find_node_sets(f);
    f.d.band.nodes[node_at(f.d.band, {1, 1, 1})].at.z() = height;
    warn_of_grazing(f, plane, mesh);
    return f.warnings;
}

TEST(WarnOfGrazing, ASurfaceAtASmallAngle) {
    EXPECT_THAT(grazing_the_top(2, 1.7),
                Contains(HasSubstr("the plane meets a surface or group border at 2 degrees: elements in the wedge")));
    EXPECT_THAT(grazing_the_top(0.01, 1.7), Contains(HasSubstr("at less than 0.1 degrees")));
    EXPECT_THAT(grazing_the_top(8, 1.7), Not(Contains(HasSubstr("meets a surface"))));
    EXPECT_THAT(grazing_the_top(2, 1), IsEmpty()) << "no element became worse";
}

/// A plane along the edge y = 0, z = 2 of a bar, through the middle of that.
std::vector<std::string> along_the_edge(double degrees, bool worse) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane plane = sloping({1, 0, 2}, degrees);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    for (Contact& c : f.d.contact) c = {};
    f.d.contact[node_at(f.d.band, {1, 0, 2})] = &plane;
    f.bandwidth = 0;  // others lie on lines at other angles
    find_node_sets(f);
    if (worse) {
        const int below = node_at(f.d.band, {1, 0, 1});
        f.d.band.nodes[below].at.z() = 1.8;
    }
    warn_of_grazing(f, plane, mesh);
    return f.warnings;
}

TEST(WarnOfGrazing, ALineAtASmallAngle) {
    EXPECT_THAT(along_the_edge(3, true),
                Contains(HasSubstr("the plane runs along a feature line or border line at 3 degrees")));
    EXPECT_THAT(along_the_edge(8, true), Not(Contains(HasSubstr("runs along a feature line"))));
    EXPECT_THAT(along_the_edge(3, false), IsEmpty());
}

/// A plane `gap` below the top of a block, onto which one node was moved.
std::vector<std::string> below_the_top(double gap) {
    const Mesh mesh = checks::grid(4, 4, 2);
    const Plane plane({0, 0, 2 - gap}, {0, 0, 1});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    const int on = node_at(f.d.band, {2, 2, 1});
    f.d.band.nodes[on].at.z() = 2 - gap;
    f.d.contact[on] = &plane;
    find_node_sets(f);
    warn_of_grazing(f, plane, mesh);
    return f.warnings;
}

TEST(WarnOfGrazing, AThinLayer) {
    EXPECT_THAT(below_the_top(0.1), ElementsAre(HasSubstr("the plane runs within 0.15 edge lengths of a nearly "
                                                          "parallel surface or group border at 4 nodes: the layer")));
    EXPECT_THAT(below_the_top(0.3), IsEmpty());
}

TEST(WarnOfPartedLips, WhereTheyNoLongerMatch) {
    // Two cubes side by side, each with nodes of its own.
    Mesh mesh = checks::grid(1, 1, 1);
    const Mesh other = mesh;
    for (const Vec3& x : other.points) mesh.add_node(x + Vec3(1, 0, 0), mesh.largest_node_id() + 1);
    for (Index c = 0; c < 6; ++c) {
        std::array<Index, 4> nodes;
        std::ranges::transform(other.block(CellType::tetra).nodes(c), nodes.begin(), [](Index n) { return n + 8; });
        mesh.add_cell(CellType::tetra, nodes, 200 + c);
    }
    const Plane away({9, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, away);
    warn_of_parted_lips(f);
    EXPECT_THAT(f.warnings, IsEmpty());
    const int one = node_at(f.d.band, {1, 1, 1});
    f.d.band.nodes[one].at.y() = 0.9;
    warn_of_parted_lips(f);
    EXPECT_THAT(f.warnings, ElementsAre(HasSubstr("no longer match node for node (2 nodes)")));
    // Elsewhere nodes have no partner to lose.
    Workpiece g = checks::whole_workpiece(mesh, away);
    g.d.band.nodes[node_at(g.d.band, {0, 1, 1})].at.y() = 0.9;
    warn_of_parted_lips(g);
    EXPECT_THAT(g.warnings, IsEmpty());
}

struct ChangedSize : testing::Test {
    ChangedSize() {
        all = checks::family_of(mesh, "ALL", GroupKind::element);
        for (FamilyIndex& f : mesh.block(CellType::tetra).families) f = all;
        before = after = family_totals(mesh);
        f.emplace(checks::whole_workpiece(mesh, plane));
    }
    /// Warnings when the size of all is `part` of what it was.
    std::vector<std::string> warnings(double part, const std::vector<bool>& unjudged = {}) {
        after.by_family[all].measure[3] = 4 * part;
        Report report;
        report.groups.push_back({.name = "ALL",
                                 .kind = GroupKind::element,
                                 .dimension = 3,
                                 .measure_before = 4,
                                 .measure_after = 4 * part,
                                 .status = "changed"});
        warn_of_changed_size(mesh, mesh, before, after, *f, unjudged, report);
        return report.warnings;
    }
    Mesh mesh = checks::grid(4, 1, 1);
    FamilyIndex all = 0;
    FamilyTotals before, after;
    Plane plane{{9, 0, 0}, {1, 0, 0}};
    std::optional<Workpiece> f;
};

TEST_F(ChangedSize, IsToldWhereItIsMuch) {
    EXPECT_THAT(warnings(0.98), ElementsAre(HasSubstr("changed the size of the mesh by -2 %, 'ALL' by -2 %: give")));
    EXPECT_THAT(warnings(1.01), ElementsAre(HasSubstr("the mesh by 1 %")));
    EXPECT_THAT(warnings(0.996), IsEmpty());
    EXPECT_THAT(warnings(0.98, {true}), ElementsAre(AllOf(HasSubstr("the mesh by"), Not(HasSubstr("'ALL'")))));
}

TEST_F(ChangedSize, IsNotWhatToolsTake) {
    f->taken.push_back({{CellType::tetra, 0}, 0.08});
    EXPECT_THAT(warnings(0.98), IsEmpty());
    EXPECT_THAT(warnings(0.96), ElementsAre(AllOf(HasSubstr("by -2 %"), HasSubstr("beyond what was removed"))));
    f->taken.clear();
    f->deep_inside.push_back({CellType::tetra, 3});
    EXPECT_THAT(warnings(1 - 1.0 / 24), IsEmpty());
}

TEST(WarnOfEmptiedGroups, ButNotOfThoseThatMeanNothing) {
    Mesh mesh;
    mesh.add_group("*CARD", GroupKind::node, true);
    mesh.add_group("A", GroupKind::node);
    mesh.add_group("B", GroupKind::element);
    const auto warnings = [&](const std::vector<bool>& meaningless) {
        Report report;
        report.groups.push_back({.name = "A", .kind = GroupKind::node, .count_before = 3, .status = "became empty"});
        report.groups.push_back({.name = "B", .kind = GroupKind::element, .count_before = 3, .status = "reduced"});
        warn_of_emptied_groups(mesh, meaningless, report);
        return report.warnings;
    };
    EXPECT_THAT(warnings({}), ElementsAre("node group 'A' loses all its 3 members; it stays, empty"));
    EXPECT_THAT(warnings({false, true, false}), IsEmpty());
}

TEST(CheckGrowth, FromFourTimesOn) {
    const Plane plane({0, 0, 0}, {1, 0, 0});
    const auto warnings = [&](Index added, Index removed, Index cells = 100, const char* operation = "crack") {
        Report report;
        report.operation = operation;
        report.elements_added = added;
        report.elements_removed = removed;
        check_growth(cells, plane, report);
        return report.warnings;
    };
    EXPECT_THAT(warnings(301, 0), ElementsAre(HasSubstr("the mesh grows from 100 to 401 elements: the plane")));
    EXPECT_THAT(warnings(300, 0), IsEmpty());
    EXPECT_THAT(warnings(350, 50), IsEmpty());
    EXPECT_THAT(warnings(3000, 0, 1000), IsEmpty());
    EXPECT_THROW(warnings(3001, 0, 1000), ToolError);
    EXPECT_THAT(warnings(3001, 0, 1000, "fillet"), testing::SizeIs(1));
}

TEST(WarnOfHeldNodes, WhereTheyAreManyAndElementsPoor) {
    Mesh mesh = checks::grid(4, 4, 4);
    // Every node inside is in a group of its own.
    int count = 0;
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n].minCoeff() > 0 && mesh.points[n].maxCoeff() < 4)
            mesh.node_families[n] = checks::family_of(mesh, ("D" + std::to_string(count++)).c_str(), GroupKind::node);
    ASSERT_EQ(count, 27);
    const Plane plane({2, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    find_node_sets(f);
    const auto warnings = [&](const Workpiece& w, const Mesh& m, double was, double is) {
        Report report;
        report.quality_before.minimum = was;
        report.quality_after.minimum = is;
        warn_of_held_nodes(w, m, report);
        return report.warnings;
    };
    EXPECT_THAT(warnings(f, mesh, 0.75, 0.1),
                ElementsAre(AllOf(HasSubstr("hold 27 of 27 nodes near the tool"), HasSubstr("from 0.75 to 0.1"),
                                  HasSubstr("'D0' (1), 'D1' (1)"), HasSubstr("and of 22 more groups"))));
    EXPECT_THAT(warnings(f, mesh, 0.75, 0.3), IsEmpty());
    EXPECT_THAT(warnings(f, mesh, 0.15, 0.1), IsEmpty()) << "they were poor before";
    const Mesh bare = checks::grid(4, 4, 4);
    Workpiece g = checks::whole_workpiece(bare, plane);
    find_node_sets(g);
    EXPECT_THAT(warnings(g, bare, 0.75, 0.1), IsEmpty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
