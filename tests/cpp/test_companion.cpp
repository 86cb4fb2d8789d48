// SPDX-License-Identifier: LGPL-2.1-or-later
// What a mesh carries of its file, and the account of where new nodes come from.
#include "mesh/companion.h"

#include <gtest/gtest.h>

#include "cutting/rebuild.h"
#include "mesh/changes.h"
#include "mesh/order.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

struct Numbered : Companion {
    explicit Numbered(Index number) : largest(number) {}
    Index largest_other_element() const override { return largest; }
    Index largest_other_node() const override { return largest_node; }
    Index largest, largest_node = 0;
};

TEST(Companion, KeepsNumbersOfElementsThatTheMeshHasNot) {
    Mesh mesh = checks::grid(1, 1, 1);  // elements 100 to 105, nodes 10 to 17
    EXPECT_EQ(next_numbers(mesh).cell, 106);
    mesh.companion = std::make_shared<Numbered>(500);
    EXPECT_EQ(next_numbers(mesh).cell, 501);
    EXPECT_EQ(next_numbers(mesh).node, 18);
    mesh.companion = std::make_shared<Numbered>(0);
    EXPECT_EQ(next_numbers(mesh).cell, 106);
    const Mesh copy = mesh;
    EXPECT_EQ(copy.companion, mesh.companion) << "copies share it";
}

TEST(Companion, KeepsNumbersOfNodesThatTheFileNames) {
    Mesh mesh = checks::grid(1, 1, 1);
    const auto file = std::make_shared<Numbered>(0);
    file->largest_node = 70;
    mesh.companion = file;
    EXPECT_EQ(next_numbers(mesh).node, 71);
    EXPECT_EQ(next_numbers(mesh).cell, 106);
    const Mesh quadratic = to_second_order(mesh);
    EXPECT_EQ(quadratic.node_ids[8], 71) << "the first of those in the middle of edges";
}

TEST(Changes, AreEmptyWhenNothingIsNew) {
    EXPECT_TRUE(Changes().empty());
    Changes copied, born, parted;
    copied.copies.push_back({2, 1});
    born.born.push_back({3, {1, 2}});
    parted.parts.push_back({5, 4});
    EXPECT_FALSE(copied.empty());
    EXPECT_FALSE(born.empty());
    EXPECT_FALSE(parted.empty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
