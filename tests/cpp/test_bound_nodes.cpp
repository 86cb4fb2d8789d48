// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/bound_nodes.h"

#include "deck_testing.h"
#include "simple_meshes.h"

namespace femscalpel::deck_testing {
namespace {

using BoundNodesOf = DeckSemantics;

constexpr auto model =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 3, 0, 0\n6, 4, 0, 0\n7, 3, 1, 0\n8, 3, 0, 1\n"
    "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 5, 6, 7, 8\n*NSET, NSET=A\n1, 2\n*NSET, NSET=B\n2, 3\n";

TEST_F(BoundNodesOf, EquationsAndMpcsAreRelated) {
    const BoundNodes bound(
        read(std::string(model) + "*EQUATION\n2\n1, 1, 1., 5, 1, -1.\n*MPC\nPLANE, 6, 7, 8\n*MPC\nSTRAIGHT, B\n"));
    for (const Index n : {1, 5, 6, 7, 8, 2, 3}) EXPECT_TRUE(bound.is_related(n) && bound.is_bound(n)) << n;
    EXPECT_FALSE(bound.is_bound(4));
}

TEST_F(BoundNodesOf, RigidBodiesAreBoundButMoveWithTheirNeighbours) {
    const BoundNodes bound(read(std::string(model) + "*RIGID BODY, NSET=A, REF NODE=8\n"));
    EXPECT_TRUE(bound.is_bound(1) && bound.is_bound(2));
    EXPECT_FALSE(bound.is_related(1) || bound.is_bound(8));
}

TEST_F(BoundNodesOf, OfATieTheSlavesAndUnderCyclicSymmetryBothSides) {
    const std::string surfaces = "*SURFACE, NAME=S, TYPE=NODE\nA\n*SURFACE, NAME=M, TYPE=NODE\n5\n6\n";
    const BoundNodes tied(read(model + surfaces + "*TIE, NAME=T\nS, M\n"));
    EXPECT_TRUE(tied.is_related(1) && tied.is_related(2));
    EXPECT_FALSE(tied.is_bound(5));
    const BoundNodes cyclic(read(model + surfaces + "*TIE, CYCLIC SYMMETRY, NAME=T\nS, M\n"));
    EXPECT_TRUE(cyclic.is_related(5) && cyclic.is_related(6));
}

TEST_F(BoundNodesOf, OfAnEquationTheFirstTermIsDependent) {
    const BoundNodes bound(
        read(std::string(model) + "*EQUATION\n2\n7, 3, 1., 8, 3, -1.\n3\nA, 1, 1., 5, 1, -1.\n" + "6, 1, -1.\n"));
    EXPECT_TRUE(bound.is_dependent(7, 3) && bound.is_dependent(1, 1) && bound.is_dependent(2, 1));
    EXPECT_FALSE(bound.is_dependent(7, 1) || bound.is_dependent(8, 3) || bound.is_dependent(6, 1));
    for (const Index n : {1, 2, 5, 6, 7, 8}) EXPECT_TRUE(bound.is_related(n)) << n;
    EXPECT_FALSE(bound.is_related(3)) << "the number of terms is none of a node";
}

TEST_F(BoundNodesOf, OfASurfaceTheNodesOfItsFaces) {
    const std::string surfaces = "*SURFACE, NAME=S\n1, S1\n*SURFACE, NAME=M\n2, S1\n";
    const BoundNodes tied(read(model + surfaces + "*TIE, NAME=T\nS, M\n"));
    EXPECT_TRUE(tied.is_related(1) && tied.is_related(2) && tied.is_related(3));
    EXPECT_FALSE(tied.is_bound(4) || tied.is_dependent(1, 1));
    EXPECT_TRUE(BoundNodes(read(model + surfaces + "*TIE, NAME=T, CYCLIC SYMMETRY\nS, M\n")).is_dependent(1, 1));
    const std::string coupling = surfaces + "*NODE\n9, 9, 9, 9\n*COUPLING, REF NODE=9, SURFACE=S, CONSTRAINT NAME=C\n";
    EXPECT_TRUE(BoundNodes(read(model + coupling + "*KINEMATIC\n1, 3\n")).is_dependent(1, 1));
    EXPECT_FALSE(BoundNodes(read(model + coupling + "*DISTRIBUTING\n1, 3\n")).is_dependent(1, 1));
}

TEST_F(BoundNodesOf, SupportsUnderTransform) {
    const std::string support = "*BOUNDARY\nA, 2, 3\n";
    EXPECT_FALSE(BoundNodes(read(model + support)).is_bound(1));
    const BoundNodes turned(read(model + ("*TRANSFORM, NSET=B\n1, 1, 0, 0, 0, 1\n" + support)));
    EXPECT_TRUE(turned.is_bound(2)) << "supported, in other directions";
    EXPECT_FALSE(turned.is_bound(3)) << "turned, but free";
    EXPECT_TRUE(BoundNodes(checks::grid(1, 1, 1)).empty());
}

}  // namespace
}  // namespace femscalpel::deck_testing
