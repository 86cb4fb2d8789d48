// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/union_find.h"

#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(UnionFind, StandsForASetByItsSmallest) {
    UnionFind sets(6);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(sets.find(i), i);
    sets.unite(5, 3);
    sets.unite(4, 2);
    sets.unite(3, 4);
    sets.unite(3, 5);  // they are in one set already
    for (const int i : {2, 3, 4, 5}) EXPECT_EQ(sets.find(i), 2);
    EXPECT_EQ(sets.find(0), 0);
    EXPECT_EQ(sets.find(1), 1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
