// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/vtu.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "error.h"

namespace fs = std::filesystem;

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;

/// A written file, taken apart by what VTK's format description says.
class VtuFile {
public:
    explicit VtuFile(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        text_.assign(std::istreambuf_iterator<char>(in), {});
        const std::string marker = "<AppendedData encoding=\"raw\">\n_";
        data_ = text_.find(marker);
        EXPECT_NE(data_, std::string::npos);
        xml = text_.substr(0, data_);
        data_ += marker.size();
    }

    /// The values of an array within the XML element `section`.
    template <class T>
    std::vector<T> array(const std::string& section, const std::string& name) const {
        const std::size_t from = xml.find("<" + section + ">"), to = xml.find("</" + section + ">");
        const std::size_t at = xml.find(" Name=\"" + name + "\"", from);
        EXPECT_LT(at, to) << name;
        if (at >= to) return {};
        const std::size_t offset = std::stoull(xml.substr(xml.find("offset=\"", at) + 8));
        const char* block = text_.data() + data_ + offset;
        std::uint64_t head[3];
        std::memcpy(head, block, sizeof head);
        const auto [count, full, last] = head;
        std::vector<std::uint64_t> sizes(count);
        std::memcpy(sizes.data(), block + sizeof head, count * sizeof(std::uint64_t));
        block += sizeof head + count * sizeof(std::uint64_t);
        std::string bytes;
        for (std::size_t b = 0; b < count; ++b) {
            uLongf size = b + 1 == count && last ? last : full;
            std::string part(size, '\0');
            EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(part.data()), &size, reinterpret_cast<const Bytef*>(block),
                                 sizes[b]),
                      Z_OK);
            EXPECT_EQ(size, part.size());
            bytes += part;
            block += sizes[b];
        }
        std::vector<T> values(bytes.size() / sizeof(T));
        std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }

    std::string xml;

private:
    std::string text_;
    std::size_t data_ = 0;
};

class VtuTest : public testing::Test {
protected:
    void SetUp() override {
        path_ = fs::path(testing::TempDir()) / (std::string("femscalpel_vtu_") +
                                                testing::UnitTest::GetInstance()->current_test_info()->name() + ".vtu");
    }
    void TearDown() override { fs::remove(path_); }
    fs::path path_;
};

TEST_F(VtuTest, EveryElementTypeNumbersAndGroups) {
    Mesh mesh;
    for (Index i = 0; i < 27; ++i) mesh.add_node({0.1 * static_cast<double>(i), 1, -2}, 100 - i);
    std::vector<Index> nodes(27);
    std::iota(nodes.begin(), nodes.end(), 0);
    for (const CellTraits& t : all_cell_types())
        mesh.add_cell(t.type, std::span(nodes).first(static_cast<std::size_t>(t.nodes)),
                      1000 - static_cast<Index>(t.type));
    mesh.add_group("NODES", GroupKind::node);
    mesh.add_group("Family", GroupKind::element);
    mesh.add_group("SIDES", GroupKind::facet);
    mesh.add_group("a<b> & \"c\"\x01 \xe9", GroupKind::element);
    mesh.add_group("card", GroupKind::element, true);
    const Index hexahedron = mesh.block(CellType::hexahedron).ids[0];
    const std::vector<GroupMembers> members = {{GroupKind::node, {100, 98}, {}},
                                               {GroupKind::element, {1000, hexahedron}, {}},
                                               {GroupKind::facet, {hexahedron, hexahedron, 997}, {1, 6, 2}},
                                               {GroupKind::element, {}, {}},
                                               {GroupKind::element, {999}, {}}};
    assign_groups(mesh, members);
    write_vtu(mesh, path_);
    const VtuFile file(path_);

    EXPECT_THAT(file.xml, HasSubstr("NumberOfPoints=\"27\" NumberOfCells=\"19\""));
    // Control character replaced, Latin-1 turned into UTF-8.
    EXPECT_THAT(file.xml, HasSubstr("Name=\"a&lt;b&gt; &amp; &quot;c&quot;_ \xc3\xa9\""));
    EXPECT_THAT(file.xml, testing::Not(HasSubstr("card")));
    EXPECT_THAT(file.array<std::uint8_t>("Cells", "types"),
                ElementsAre(1, 3, 21, 5, 22, 34, 9, 23, 28, 10, 24, 14, 27, 13, 26, 32, 12, 25, 29));
    const auto points = file.array<double>("Points", "Points");
    ASSERT_EQ(points.size(), 81u);
    EXPECT_EQ(points[3 * 7], mesh.points[7].x());
    EXPECT_EQ(points[80], -2);
    EXPECT_EQ(file.array<Index>("PointData", "NodeNumber"), mesh.node_ids);

    const auto connectivity = file.array<Index>("Cells", "connectivity"),
               offsets = file.array<Index>("Cells", "offsets");
    ASSERT_EQ(offsets.size(), 19u);
    ASSERT_EQ(offsets.back(), static_cast<Index>(connectivity.size()));
    for (const CellTraits& t : all_cell_types()) {
        const auto c = static_cast<std::size_t>(t.type);
        std::vector<Index> cell(connectivity.begin() + (c ? offsets[c - 1] : 0), connectivity.begin() + offsets[c]);
        std::vector<Index> expected(nodes.begin(), nodes.begin() + t.nodes);
        if (t.type == CellType::wedge) expected = {0, 2, 1, 3, 5, 4};
        EXPECT_EQ(cell, expected) << t.name;
    }
    const auto numbers = file.array<Index>("CellData", "ElementNumber");
    for (std::size_t c = 0; c < 19; ++c) EXPECT_EQ(numbers[c], 1000 - static_cast<Index>(c));

    const auto in_nodes = file.array<std::uint8_t>("PointData", "NODES");
    EXPECT_EQ(std::accumulate(in_nodes.begin(), in_nodes.end(), 0), 2);
    EXPECT_EQ(in_nodes[0] + in_nodes[2], 2);
    const auto family = file.array<std::uint8_t>("CellData", "Family_");
    EXPECT_EQ(std::accumulate(family.begin(), family.end(), 0), 2);
    EXPECT_EQ(family[0] + family[static_cast<std::size_t>(CellType::hexahedron)], 2);
    const auto sides = file.array<std::uint8_t>("CellData", "SIDES");
    EXPECT_EQ(sides[static_cast<std::size_t>(CellType::hexahedron)], 0b100001);
    EXPECT_EQ(sides[static_cast<std::size_t>(CellType::triangle)], 0b10);
}

TEST_F(VtuTest, LargerThanOneBlock) {
    Mesh mesh;
    for (Index i = 0; i < 100000; ++i) mesh.add_node({std::sqrt(static_cast<double>(i)), 0, 0}, i + 1);
    write_vtu(mesh, path_);
    const auto points = VtuFile(path_).array<double>("Points", "Points");
    ASSERT_EQ(points.size(), 300000u);
    for (std::size_t i = 0; i < 100000; ++i) ASSERT_EQ(points[3 * i], mesh.points[i].x());
}

TEST_F(VtuTest, UnwritablePathIsNamed) {
    const fs::path nowhere = path_ / "none" / "m.vtu";
    try {
        write_vtu(Mesh(), nowhere);
        FAIL();
    } catch (const WriteError& e) {
        EXPECT_THAT(e.what(), HasSubstr(nowhere.string()));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
