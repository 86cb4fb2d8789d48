// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/msh.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

// What Gmsh makes of files is in tests/python/test_msh.py.
TEST(Msh, GroupsOfPointsNodesAndElements) {
    Mesh mesh;
    for (Index i = 0; i < 4; ++i) mesh.add_node({i == 1 ? 1. : 0., i == 2 ? 1. : 0., i == 3 ? .5 : 0.}, 10 * (i + 1));
    const std::array<Index, 4> nodes = {0, 1, 2, 3};
    mesh.add_cell(CellType::vertex, std::span(nodes).first(1), 9);
    mesh.add_cell(CellType::tetra, nodes, 5);
    mesh.add_group("A B", GroupKind::element);
    mesh.add_group("N", GroupKind::node);
    mesh.add_group("NONE", GroupKind::element);
    mesh.add_group("card", GroupKind::element, true);
    mesh.add_group("SIDE", GroupKind::facet);
    const std::vector<GroupMembers> members = {{GroupKind::element, {9, 5}, {}},
                                               {GroupKind::node, {20, 40}, {}},
                                               {GroupKind::element, {}, {}},
                                               {GroupKind::element, {5}, {}},
                                               {GroupKind::facet, {5}, {1}}};
    assign_groups(mesh, members);
    mesh.unit = "mm";
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("femscalpel_" + std::to_string(::getpid()) + ".msh");
    write_msh(mesh, path);
    std::ifstream in(path);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    std::filesystem::remove(path);
    EXPECT_EQ(text,
              "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
              "$PhysicalNames\n4\n0 1 \"A B\"\n3 1 \"A B\"\n0 2 \"N\"\n3 3 \"NONE\"\n$EndPhysicalNames\n"
              "$Comments\nFemScalpel: node groups are the physical points 2\n$EndComments\n"
              "$Entities\n2 0 0 1\n1 0 0 0 1 1 \n2 0 0 0 1 2 \n1 0 0 0 1 1 0.5 1 1 0\n$EndEntities\n"
              "$Nodes\n1 4 10 40\n3 1 0 4\n10\n20\n30\n40\n0 0 0\n1 0 0\n0 1 0\n0 0 0.5\n$EndNodes\n"
              "$Elements\n3 4 5 11\n0 1 15 1\n9 10\n3 1 4 1\n5 10 20 30 40\n0 2 15 2\n10 20\n11 40\n$EndElements\n");
    EXPECT_THAT(msh_losses(mesh), testing::ElementsAre("the facet group 'SIDE'", "the unit 'mm'"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
