// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/carry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error.h"
#include "fields/element_values.h"
#include "fields/field.h"
#include "fields/lineage.h"
#include "operators/follow_fields.h"
#include "random_numbers.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;

std::shared_ptr<const std::vector<Index>> numbers(std::vector<Index> list) {
    return std::make_shared<const std::vector<Index>>(std::move(list));
}

/// Two triangles on each other's edge 2-3, and a field on nodes and elements.
Mesh two_triangles() {
    Mesh mesh;
    mesh.add_node({0, 0, 0}, 1);
    mesh.add_node({2, 0, 0}, 2);
    mesh.add_node({0, 2, 0}, 3);
    mesh.add_node({2, 2, 0}, 4);
    mesh.add_cell(CellType::triangle, std::vector<Index>{0, 1, 2}, 10);
    mesh.add_cell(CellType::triangle, std::vector<Index>{3, 2, 1}, 20);
    auto fields = std::make_shared<Fields>();
    FieldPart nodes;
    nodes.numbers = numbers({1, 2, 3, 4});
    nodes.reals = {0.1, 2.1, 20.1, 22.1};
    FieldPart elements;
    elements.support = FieldSupport::element;
    elements.type = CellType::triangle;
    elements.numbers = numbers({10, 20});
    elements.reals = {5, 7};
    fields->fields.push_back({"F", {"X"}, {""}, "", FieldValues::float64, {{-1, -1, 0, {nodes, elements}}}});
    mesh.fields = fields;
    return mesh;
}

/// The first is halved at a new node 5 in the middle of 1-2, and node 4 is moved.
Mesh halved(const Mesh& before) {
    Mesh out = before;
    const Index middle = out.add_node({1, 0, 0}, 5);
    out.points[3] = {2.5, 2, 0};
    CellBlock& block = out.block(CellType::triangle);
    block.connectivity[1] = middle;
    out.add_cell(CellType::triangle, std::vector<Index>{middle, 1, 2}, 21);
    return out;
}

TEST(CarryFields, InterpolatesNewNodesAndGivesPartsTheirParentsValue) {
    const Mesh before = two_triangles(), after = halved(before);
    Changes changes;
    changes.parts.push_back({21, 10});
    for (const bool told : {true, false}) {  // or found by the place
        std::vector<FieldRecord> records;
        const auto out =
            carry_fields({before, after, told ? std::span(&changes, 1) : std::span<Changes>(), {}}, records);
        const auto& parts = out->fields.at(0).steps.at(0).parts;
        ASSERT_EQ(parts.size(), 2u);
        EXPECT_THAT(*parts[0].numbers, ElementsAre(1, 2, 3, 4, 5));
        EXPECT_THAT(parts[0].reals,
                    ElementsAre(0.1, 2.1, 20.1, testing::DoubleNear(22.6, 1e-14), testing::DoubleNear(1.1, 1e-15)));
        EXPECT_THAT(*parts[1].numbers, ElementsAre(10, 20, 21));
        EXPECT_THAT(parts[1].reals, ElementsAre(5, 7, 5));
        ASSERT_EQ(records.size(), 2u);
        EXPECT_EQ(records[0].kept, 3);
        EXPECT_EQ(records[0].made, 2);
        EXPECT_EQ(records[0].outside, 0);
        EXPECT_EQ(records[1].kept, 0);
        EXPECT_EQ(records[1].parts, 3);
        EXPECT_NO_THROW(validate(*out, after));
    }
}

TEST(CarryFields, TakesTheNearestPointFarOutside) {
    const Mesh before = two_triangles();
    Mesh after = before;
    after.points[3] = {12, 2, 0};
    Result result{after, {}};
    follow_fields(before, false, result);
    const FieldPart& part = result.mesh.fields->fields[0].steps[0].parts[0];
    EXPECT_LT(part.reals[3], 22.2);
    ASSERT_EQ(result.report.fields[0].outside, 1);
    EXPECT_NEAR(result.report.fields[0].farthest, 10, 0.5);
    EXPECT_THAT(result.report.warnings, ElementsAre(HasSubstr("field 'F' (node): 1 values are those of the nearest "
                                                              "point of the mesh as it was, up to ")));
}

TEST(CarryFields, WhatIsAddedHasNoValues) {
    const Mesh before = two_triangles();
    Mesh after = before;
    const Index node = after.add_node({1, 1, 0}, 5);
    const GroupIndex added = after.add_group("ADDED", GroupKind::element);
    after.add_cell(CellType::triangle, std::vector<Index>{1, 3, node}, 30, after.families.with(0, added));
    Result result{after, {}};
    follow_fields(before, false, result, "ADDED");
    const auto& parts = result.mesh.fields->fields[0].steps[0].parts;
    EXPECT_THAT(*parts[0].numbers, ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(*parts[1].numbers, ElementsAre(10, 20));
    EXPECT_EQ(result.report.fields[0].absent, 1);
    EXPECT_EQ(result.report.fields[1].absent, 1);
    EXPECT_EQ(result.report.warnings.size(), 2u);
    follow_fields(before, true, result);
    EXPECT_FALSE(result.mesh.fields) << "previews have none";
}

TEST(CarryFields, ValuesOfWhatIsGoneAreCounted) {
    const Mesh before = two_triangles();
    Mesh after;
    for (Index n = 0; n < 3; ++n) after.add_node(before.points[n], before.node_ids[n]);
    after.add_cell(CellType::triangle, std::vector<Index>{0, 1, 2}, 10);
    std::vector<FieldRecord> records;
    const auto out = carry_fields({before, after, {}, {}}, records);
    EXPECT_THAT(out->fields[0].steps[0].parts[0].reals, ElementsAre(0.1, 2.1, 20.1));
    EXPECT_EQ(records[0].removed, 1);
    EXPECT_EQ(records[1].removed, 1);
    EXPECT_EQ(records[1].kept, 1);
}

TEST(FieldLineages, CopiesKeepToTheirOwnSide) {
    // Two triangles with double nodes along their common edge, which both get a node in the middle.
    Mesh before;
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)})
        before.add_node(p, before.node_count() + 1);
    before.add_cell(CellType::triangle, std::vector<Index>{0, 1, 2}, 1);
    before.add_cell(CellType::triangle, std::vector<Index>{5, 4, 3}, 2);
    Mesh after = before;
    const Index here = after.add_node({0.5, 0.5, 0}, 7), there = after.add_node({0.5, 0.5, 0}, 8);
    CellBlock& block = after.block(CellType::triangle);
    block.connectivity = {0, 1, here, 5, 4, there};
    after.add_cell(CellType::triangle, std::vector<Index>{0, here, 2}, 3);
    after.add_cell(CellType::triangle, std::vector<Index>{5, there, 3}, 4);
    Changes changes;
    changes.parts = {{3, 1}, {4, 2}};
    FieldLineage lineage(before, after, std::span(&changes, 1), {});
    ASSERT_EQ(lineage.made_nodes().size(), 2u);
    EXPECT_EQ(lineage.made_nodes()[0].node, here);
    for (const auto& [node, share] : lineage.made_nodes()[0].shares)
        EXPECT_TRUE(std::abs(share) < 1e-12 || node == 1 || node == 2) << node;
    for (const auto& [node, share] : lineage.made_nodes()[1].shares)
        EXPECT_TRUE(std::abs(share) < 1e-12 || node == 3 || node == 4) << node;
    EXPECT_FALSE(lineage.is_copy(here));
    EXPECT_EQ(lineage.element_at({CellType::triangle, 0}, {0.5, 0.5, 0}, {1, 1, 0}), (CellRef{CellType::triangle, 0}));
}

TEST(ElementValues, LinearSharesKeepLinearFields) {
    checks::Random random(3);
    for (const int count : {1, 2, 3, 4, 8, 27}) {
        Eigen::Matrix3Xd known(3, count), wanted(3, 5);
        for (double& x : known.reshaped()) x = random.uniform(-1, 1);
        for (double& x : wanted.reshaped()) x = random.uniform(-1, 1);
        const LinearFit fit(known);
        for (int p = 0; p < 5; ++p) {
            const std::vector<double> shares = fit.shares(wanted.col(p));
            const Eigen::Map<const Eigen::VectorXd> of_points(shares.data(), std::ssize(shares));
            EXPECT_NEAR(of_points.sum(), 1, 1e-12) << count;
            if (count < 4) continue;
            EXPECT_LT((known * of_points - wanted.col(p)).norm(), 1e-10) << count;
        }
    }
}

TEST(ElementValues, LocalizationsAreTakenToOurReferenceElement) {
    // A tetrahedron of Code_Aster's coordinates, its first corner on the second axis.
    const FieldLocalization file{"P", CellType::tetra, 3, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, {0, .5, .5}, {1}};
    const auto points = reference_points(file);
    ASSERT_TRUE(points);
    EXPECT_LT((*points - Eigen::Vector3d(.5, 0, 0)).norm(), 1e-14) << points->transpose();
    FieldLocalization bent = file;
    bent.element[0] = 0.3;
    EXPECT_TRUE(reference_points(bent)) << "every tetrahedron is an image of every other";
    FieldLocalization none = file;
    none.element.clear();
    EXPECT_FALSE(reference_points(none));
    for (const CellTraits& t : all_cell_types()) {
        if (t.dimension == 0) continue;
        const FieldLocalization middle = middle_point(t.type);
        const auto at = reference_points(middle);
        ASSERT_TRUE(at) << t.name;
        EXPECT_EQ(middle.weights.size(), 1u);
        FieldLocalization odd = middle;
        if (t.corners > t.dimension + 1) {
            odd.element[0] += 0.3;
            EXPECT_FALSE(reference_points(odd)) << t.name;
        }
    }
}

TEST(ValidateFields, NamesTheFieldAtFault) {
    const Mesh mesh = two_triangles();
    EXPECT_NO_THROW(validate(*mesh.fields, mesh));
    const auto expect_error = [&](auto change, const char* message) {
        Fields fields = *mesh.fields;
        change(fields);
        EXPECT_THAT([&] { validate(fields, mesh); }, testing::ThrowsMessage<Error>(HasSubstr(message)));
    };
    const auto part = [](Fields& f, std::size_t k) -> FieldPart& { return f.fields[0].steps[0].parts[k]; };
    expect_error([&](Fields& f) { f.fields.push_back(f.fields[0]); }, "field 'F': there are two of this name");
    expect_error([&](Fields& f) { f.fields[0].components.clear(); }, "field 'F': it has no components");
    expect_error([&](Fields& f) { part(f, 0).reals.pop_back(); }, "there are 3 values of its type, 4 are needed");
    expect_error([&](Fields& f) { part(f, 0).numbers = numbers({1, 2, 3, 9}); }, "the mesh has no node 9");
    expect_error([&](Fields& f) { part(f, 0).numbers = numbers({1, 2, 3, 3}); }, "node 3 has values twice");
    expect_error([&](Fields& f) { part(f, 1).type = CellType::quad; }, "element 10 is no quad");
    expect_error([&](Fields& f) { part(f, 1).support = FieldSupport::element_nodes; },
                 "1 values per element, where there are 3");
    expect_error(
        [&](Fields& f) {
            part(f, 1).support = FieldSupport::element_points;
            part(f, 1).localization = "NONE";
        },
        "its localization 'NONE' is not one of 1 points of triangle elements");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
