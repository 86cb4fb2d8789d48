// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/preserve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(DriftingGroups, AreThoseNotNamed) {
    Mesh mesh = checks::grid(1, 1, 1);
    mesh.add_group("A", GroupKind::node);
    mesh.add_group("B", GroupKind::element);
    mesh.add_group("A", GroupKind::element);
    mesh.add_group("*CARD", GroupKind::node, true);
    EXPECT_THAT(drifting_groups(mesh, {}), IsEmpty());
    EXPECT_THAT(drifting_groups(mesh, std::vector<std::string>{}), ElementsAre(true, true, true, false));
    EXPECT_THAT(drifting_groups(mesh, std::vector<std::string>{"A"}), ElementsAre(false, true, false, false));
    EXPECT_THAT(
        [&] {
            drifting_groups(mesh, std::vector<std::string>{"A", "C", "D"});
        },
        testing::ThrowsMessage<ToolError>(HasSubstr("preserve names 'C'")));
}

/// A cube of eight; TOP is its upper half, whose border is z = 1.
struct DriftGaugeTest : testing::Test {
    DriftGaugeTest() {
        const FamilyIndex top = checks::family_of(mesh, "TOP", GroupKind::element);
        CellBlock& tetras = mesh.block(CellType::tetra);
        for (Index c = 0; c < tetras.size(); ++c) {
            double z = 0;
            for (const Index n : tetras.nodes(c)) z += mesh.points[n].z() / 4;
            if (z > 1) tetras.families[c] = top;
        }
        band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
    }
    Mesh mesh = checks::grid(2, 2, 2);
    BandMesh band;
};

TEST_F(DriftGaugeTest, MeasuresHowFarABorderWent) {
    const DriftGauge gauge(band, mesh, {true});
    EXPECT_THAT(gauge.drift(band, mesh), ElementsAre(0));
    BandNode& middle = band.nodes[node_at(band, {1, 1, 1})];
    middle.at = {1.2, 0.9, 1};
    EXPECT_THAT(gauge.drift(band, mesh), ElementsAre(testing::DoubleNear(0, 1e-15))) << "within the border";
    middle.at.z() = 1.25;
    EXPECT_THAT(gauge.drift(band, mesh), ElementsAre(testing::DoubleNear(0.25, 1e-15)));
    // A node born on the border, too.
    middle.at = middle.start;
    band.split_edge(node_at(band, {1, 1, 1}), node_at(band, {0, 1, 1}), {0.5, 1, 0.875});
    EXPECT_THAT(gauge.drift(band, mesh), ElementsAre(testing::DoubleNear(0.125, 1e-15)));
}

TEST_F(DriftGaugeTest, LooksOnlyAtGroupsThatDrift) {
    const DriftGauge gauge(band, mesh, {false});
    band.nodes[node_at(band, {1, 1, 1})].at.z() = 1.25;
    EXPECT_THAT(gauge.drift(band, mesh), ElementsAre(0));
}

TEST(DriftGaugeOfShortcuts, MeasuresEdgesThroughTheMaterial) {
    // All nodes on two sides that meet: edges and faces near the corner between them run through the material.
    Mesh mesh = checks::grid(2, 2, 2);
    const FamilyIndex support = checks::family_of(mesh, "SUPPORT", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n].x() == 0 || mesh.points[n].y() == 2) mesh.node_families[n] = support;
    BandMesh band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
    const DriftGauge gauge = DriftGauge::of_shortcuts(band, mesh, {}, {});
    EXPECT_THAT(gauge.drift(band, mesh), ElementsAre(0));
    // Within its side x = 0, towards the corner: the shortcut from there to (1, 2, 1) goes along.
    band.nodes[node_at(band, {0, 1, 1})].at.y() = 1.2;
    const std::vector<double> drift = gauge.drift(band, mesh);
    ASSERT_EQ(drift.size(), 1u);
    EXPECT_GT(drift[0], 0.02);
    EXPECT_LT(drift[0], 0.2);
    const DriftGauge drifting = DriftGauge::of_shortcuts(band, mesh, {true}, {});
    EXPECT_THAT(drifting.drift(band, mesh), ElementsAre(0)) << "groups that drift are for the other gauge";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
