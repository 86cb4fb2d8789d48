// SPDX-License-Identifier: LGPL-2.1-or-later
// The driver with a recipe that does next to nothing: opens what lies on a plane.
#include "operators/driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/opening.h"
#include "cutting/snap.h"
#include "operators/options.h"
#include "operators/prepared.h"
#include "simple_meshes.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;

class Opener final : public Recipe {
public:
    Opener(const OperatorOptions& options, double x) : options_(options), plane_({x, 0, 0}, {1, 0, 0}) {
        blades_.push_back({.tool = &plane_, .bound = {}, .inside = {}});
    }
    const char* kind() const override { return "open"; }
    void start(const Mesh& mesh) override { started.push_back(mesh.cell_count()); }
    std::vector<RefineZone> zones() const override { return first; }
    std::span<const Blade> blades() const override { return blades_; }
    Naming naming() const override {
        Naming out;
        out.groups = {{options_.name + "_N"}, {options_.name + "_P"}};
        return out;
    }
    bool cut(Workpiece& f, const Site& site) override {
        crossed = site.crossed;
        whole_nodes = site.whole.node_count();
        band_nodes = site.mesh.node_count();
        if (!later.empty()) {
            refined.push_back(site.refine(later));
            if (refined.back()) return false;
        }
        cut_along(f, blades_[0]);
        return true;
    }
    Opening open(Workpiece& f, const Site&) override { return open_lips(f); }

    /// Near the plane.
    RefineZone zone(double size) const {
        return {[this](const Vec3& x) { return plane_.distance(x); }, size};
    }

    std::vector<RefineZone> first, later;  // around what, from the start; found when cutting
    std::vector<Index> started;            // elements of the meshes it was started on
    std::vector<bool> refined;             // what Site::refine said
    Index crossed = 0, whole_nodes = 0, band_nodes = 0;

private:
    const OperatorOptions& options_;
    Plane plane_;
    std::vector<Blade> blades_;
};

OperatorOptions named(const std::string& name) {
    OperatorOptions out;
    out.name = name;
    return out;
}

TEST(Perform, RunsARecipeOnce) {
    const Mesh mesh = checks::grid(4, 1, 1);
    const OperatorOptions options = named("X");
    Opener recipe(options, 1.9);
    const Result result = perform(recipe, mesh, options, {});
    result.mesh.validate();
    EXPECT_THAT(recipe.started, ElementsAre(24));
    EXPECT_EQ(recipe.crossed, 6);
    EXPECT_EQ(recipe.whole_nodes, 20);
    EXPECT_EQ(recipe.band_nodes, 20);
    EXPECT_EQ(result.report.operation, "open");
    EXPECT_EQ(result.report.name, "X");
    EXPECT_FALSE(result.report.refinement);
    EXPECT_EQ(result.report.nodes_doubled, 4);
    EXPECT_EQ(result.mesh.node_count(), 24);
    EXPECT_EQ(checks::members(result.mesh, "X_N", GroupKind::element).size(), 2u);
    EXPECT_EQ(checks::members(result.mesh, "X_P", GroupKind::element).size(), 2u);
    EXPECT_EQ(mesh.node_count(), 20) << "the input is as it was";
    std::vector<std::string> steps;
    for (const auto& [step, seconds] : result.report.seconds) steps.push_back(step);
    EXPECT_THAT(steps, testing::IsSupersetOf({"locate", "constraints", "snap", "split", "check", "rebuild", "report"}));
}

TEST(Perform, RefinesFirstWhereTheMeshIsCoarse) {
    const Mesh mesh = checks::grid(4, 1, 1);
    const OperatorOptions options = named("X");
    Opener recipe(options, 1.9);
    recipe.first.push_back(recipe.zone(0.5));
    const Result result = perform(recipe, mesh, options, {});
    result.mesh.validate();
    ASSERT_EQ(recipe.started.size(), 2u) << "anew on the refined mesh";
    EXPECT_EQ(recipe.started[0], 24);
    EXPECT_GT(recipe.started[1], 24);
    ASSERT_TRUE(result.report.refinement);
    EXPECT_EQ(result.report.refinement->size, 0.5);
    EXPECT_EQ(result.report.refinement->elements_before, 24);
    EXPECT_EQ(result.report.refinement->elements_after, recipe.started[1]);
    EXPECT_EQ(result.report.seconds.front().first, "refine");
    // Fine enough as it is: nothing is refined.
    Opener fine(options, 1.9);
    fine.first.push_back(fine.zone(2));
    EXPECT_FALSE(perform(fine, mesh, options, {}).report.refinement);
    EXPECT_THAT(fine.started, ElementsAre(24));
}

TEST(Perform, BeginsAnewWhereARecipeAsksForMore) {
    const Mesh mesh = checks::grid(4, 1, 1);
    const OperatorOptions options = named("X");
    Opener recipe(options, 1.9);
    recipe.later.push_back(recipe.zone(0.5));
    const Result result = perform(recipe, mesh, options, {});
    EXPECT_THAT(recipe.refined, ElementsAre(true, false)) << "once only";
    ASSERT_EQ(recipe.started.size(), 2u);
    EXPECT_GT(recipe.started[1], 24);
    EXPECT_TRUE(result.report.refinement);
    EXPECT_EQ(mesh.cell_count(), 24);
}

TEST(Perform, WorksOnTheBandAlone) {
    const Mesh mesh = checks::grid(12, 1, 1);
    OperatorOptions options = named("X");
    Opener recipe(options, 3.1);
    const Result whole = perform(recipe, mesh, options, {});
    options.band_only = true;
    const Result part = perform(recipe, mesh, options, {});
    part.mesh.validate();
    // Nodes at x = 3 and 4, those two edges farther, and the elements around: from x = 0 to 7.
    EXPECT_EQ(part.mesh.block(CellType::tetra).size(), 7 * 6);
    EXPECT_EQ(whole.mesh.block(CellType::tetra).size(), 12 * 6);
    EXPECT_EQ(recipe.whole_nodes, 52);
    EXPECT_EQ(recipe.band_nodes, 32);
    const NumberIndex numbers(whole.mesh);
    for (Index n = 0; n < part.mesh.node_count(); ++n)
        EXPECT_EQ(part.mesh.points[n], whole.mesh.points[*numbers.node(part.mesh.node_ids[n])]);
    for (const CellType type : {CellType::tetra, CellType::triangle}) {
        const CellBlock& block = part.mesh.block(type);
        for (Index c = 0; c < block.size(); ++c) {
            const auto there = numbers.cell(block.ids[c]);
            ASSERT_TRUE(there);
            std::vector<Index> here_nodes, there_nodes;
            for (const Index n : block.nodes(c)) here_nodes.push_back(part.mesh.node_ids[n]);
            for (const Index n : whole.mesh.block(type).nodes(there->cell))
                there_nodes.push_back(whole.mesh.node_ids[n]);
            EXPECT_EQ(here_nodes, there_nodes);
        }
    }
    EXPECT_EQ(part.report.nodes_doubled, whole.report.nodes_doubled);
    EXPECT_EQ(part.report.nodes_moved, whole.report.nodes_moved);
}

TEST(Perform, ChecksNames) {
    Mesh mesh = checks::grid(4, 1, 1);
    mesh.add_group("OLD_P", GroupKind::node);
    const auto refused = [&](const std::string& name, const char* why) {
        const OperatorOptions options = named(name);
        Opener recipe(options, 1.9);
        EXPECT_THAT([&] { perform(recipe, mesh, options, {}); }, testing::ThrowsMessage<ToolError>(HasSubstr(why)));
    };
    refused("", "name is empty");
    refused("A B", "name 'A B' has a character other than letters");
    refused("OLD", "name 'OLD' is taken: the mesh already has a group 'OLD_P'");
    refused(std::string(23, 'A'), "would have 25 characters, at most 24 are allowed");
    const OperatorOptions options = named(std::string(22, 'A'));
    Opener recipe(options, 1.9);
    EXPECT_NO_THROW(perform(recipe, mesh, options, {}));
}

TEST(Perform, ChecksOptions) {
    const Mesh mesh = checks::grid(4, 1, 1);
    const auto refused = [&](const OperatorOptions& options, const char* why) {
        Opener recipe(options, 1.9);
        EXPECT_THAT([&] { perform(recipe, mesh, options, {}); }, testing::ThrowsMessage<ToolError>(HasSubstr(why)));
    };
    OperatorOptions options = named("X");
    options.transition = 0;
    refused(options, "transition is 0; it must be between 1 and 20");
    options.transition = 21;
    refused(options, "transition is 21");
    options = named("X");
    options.feature_angle = 180;
    refused(options, "feature_angle must lie between 0 and 180 degrees");
    options = named("X");
    options.preserve = {"NOSUCH"};
    refused(options, "preserve names 'NOSUCH'");
}

TEST(Method, HasAName) {
    EXPECT_EQ(method_from_name("snap"), Method::snap);
    EXPECT_EQ(method_from_name("deform"), Method::deform);
    EXPECT_EQ(to_string(Method::snap), "snap");
    EXPECT_EQ(to_string(Method::deform), "deform");
    EXPECT_THAT([] { method_from_name("cut"); }, testing::ThrowsMessage<ToolError>(HasSubstr("cut")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
