// SPDX-License-Identifier: LGPL-2.1-or-later
// Which node groups new nodes are in, as far as merging shows it.
#include "groups/node_membership.h"

#include <gtest/gtest.h>

#include <optional>

#include "simple_meshes.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;

/// A bar of cubes; the node group G is some of its nodes.
struct NodeMembershipTest : testing::Test {
    void use(Mesh m, const std::vector<Vec3>& members) {
        mesh = std::move(m);
        const FamilyIndex group = checks::family_of(mesh, "G", GroupKind::node);
        for (const Vec3& at : members) mesh.node_families[checks::number_near(mesh, at)] = group;
        band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
        membership.emplace(band, mesh);
    }
    int split(const Vec3& a, const Vec3& b) {
        const int born = band.split_edge(node_at(band, a), node_at(band, b), (a + b) / 2);
        membership->add_node(band, born);
        return born;
    }
    bool links(const Vec3& p, const Vec3& t) const {
        return membership->merge_links(band, node_at(band, p), node_at(band, t));
    }

    Mesh mesh;
    BandMesh band;
    std::optional<NodeMembership> membership;
};

TEST_F(NodeMembershipTest, MergingLinksMembersThatWereApart) {
    use(checks::grid(2, 1, 1), {{0, 0, 0}, {2, 0, 0}});
    EXPECT_TRUE(links({1, 0, 0}, {0, 0, 0})) << "the ends of the bar would share an edge";
    EXPECT_FALSE(links({1, 0, 0}, {1, 1, 1})) << "that is no member";
    EXPECT_FALSE(links({0, 1, 0}, {0, 0, 0})) << "no element there has the other end";
}

TEST_F(NodeMembershipTest, MergingDoesNotLinkWhatIsLinked) {
    use(checks::grid(1, 1, 1), {{0, 0, 0}, {1, 1, 1}});
    EXPECT_FALSE(links({1, 0, 0}, {0, 0, 0}));
}

TEST_F(NodeMembershipTest, MergingLinksThreeToAFace) {
    // (0, 0, 0) is linked with each of the others, but there is no face of the three.
    use(checks::grid(1, 1, 1), {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}});
    EXPECT_FALSE(links({1, 0, 0}, {0, 0, 0}));
    use(checks::grid(1, 1, 1), {{0, 0, 0}, {1, 1, 0}, {1, 1, 1}});
    EXPECT_FALSE(links({1, 0, 0}, {0, 0, 0})) << "a face that is there";
}

TEST_F(NodeMembershipTest, ANodeBornBetweenMembersIsOne) {
    use(checks::grid(2, 1, 1), {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    split({1, 0, 0}, {2, 0, 0});
    EXPECT_FALSE(links({1.5, 0, 0}, {1, 0, 0}));
}

TEST_F(NodeMembershipTest, ANodeBornBetweenAMemberAndAnotherIsNone) {
    use(checks::grid(2, 1, 1), {{1, 0, 0}, {2, 1, 1}});
    split({1, 0, 0}, {2, 0, 0});
    EXPECT_FALSE(links({1.5, 0, 0}, {1, 0, 0})) << "(2, 1, 1) is joined to (1, 0, 0)";
    use(checks::grid(2, 1, 1), {{1, 0, 0}, {2, 0, 1}, {2, 1, 0}});
    split({1, 0, 0}, {2, 0, 0});
    EXPECT_FALSE(links({1.5, 0, 0}, {1, 0, 0}));
}

TEST_F(NodeMembershipTest, AMidSideNodeStaysWhatItIs) {
    // The ends are members, as is a mid-side node at one of them, but the one between them is not: the edge is none of
    // the group's. The node there joins neither, and merging it would link them.
    const Mesh second = checks::second_order(checks::grid(2, 1, 1));
    use(second, {{1, 0, 0}, {2, 0, 0}, {0.5, 0, 0}});
    EXPECT_TRUE(membership->groups(split({1, 0, 0}, {2, 0, 0})).empty());
    EXPECT_TRUE(links({1.5, 0, 0}, {1, 0, 0}));
    use(second, {{1, 0, 0}, {1.5, 0, 0}, {2, 0, 0}});
    EXPECT_EQ(membership->groups(split({1, 0, 0}, {2, 0, 0})).size(), 1u);
    EXPECT_FALSE(links({1.5, 0, 0}, {1, 0, 0}));
}

TEST_F(NodeMembershipTest, AGroupOfCornersAloneHasTheNewCorner) {
    const Mesh second = checks::second_order(checks::grid(2, 1, 1));
    use(second, {{1, 0, 0}, {2, 0, 0}});
    EXPECT_EQ(membership->groups(split({1, 0, 0}, {2, 0, 0})).size(), 1u);
    EXPECT_FALSE(links({1.5, 0, 0}, {1, 0, 0}));
    // What a card names by number stays that.
    Mesh marked = second;
    const FamilyIndex family = checks::family_of(marked, "MARK", GroupKind::node);
    marked.groups.back().hidden = true;
    for (const double x : {1.0, 2.0}) marked.node_families[checks::number_near(marked, {x, 0, 0})] = family;
    band = extract_band(marked, std::vector<std::int8_t>(marked.points.size(), 0));
    membership.emplace(band, marked);
    EXPECT_TRUE(membership->groups(split({1, 0, 0}, {2, 0, 0})).empty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
