// SPDX-License-Identifier: LGPL-2.1-or-later
// Which surfaces, curves and corners are found in cubes of tetrahedra.
#include "deformation/kept_geometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "groups/band_boundaries.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::Each;
using testing::Eq;

/// Everything of a mesh, and what is kept of it.
struct Kept {
    explicit Kept(const Mesh& mesh, const ConstraintOptions& options = {})
        : band(extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0))),
          g(find_kept_geometry(band, mesh, BandBoundaries(band, mesh, options.drifting_groups), options)) {}

    NodeFreedom freedom(const Vec3& at) const { return g.place_of(node(at)).constraint.freedom; }
    int node(const Vec3& at) const {
        for (int v = 0; v < band.size(); ++v)
            if ((band.nodes[v].at - at).norm() < 1e-3) return v;
        throw Error("no node there");
    }
    std::map<NodeFreedom, int> count() const {
        std::map<NodeFreedom, int> out;
        for (int v = 0; v < band.size(); ++v) ++out[g.place_of(v).constraint.freedom];
        return out;
    }
    std::vector<bool> flat() const {
        std::vector<bool> out;
        for (const auto& s : g.surfaces) out.push_back(s.flat);
        return out;
    }

    BandMesh band;
    KeptGeometry g;
};

TEST(KeptGeometry, OfACubeIsItsFacesEdgesAndCorners) {
    const Kept kept(checks::grid(2, 2, 2));
    EXPECT_EQ(kept.g.surfaces.size(), 6u);
    EXPECT_THAT(kept.flat(), Each(Eq(true)));
    EXPECT_EQ(kept.g.curves.size(), 12u);
    for (const auto& c : kept.g.curves) EXPECT_TRUE(c.straight && !c.border);
    EXPECT_EQ(kept.g.facets.size(), 48u);
    EXPECT_EQ(kept.g.segments.size(), 24u);
    EXPECT_EQ(
        kept.count(),
        (std::map<NodeFreedom, int>{
            {NodeFreedom::free, 1}, {NodeFreedom::surface, 6}, {NodeFreedom::curve, 12}, {NodeFreedom::fixed, 8}}));
    EXPECT_EQ(kept.freedom({1, 1, 1}), NodeFreedom::free);
    EXPECT_EQ(kept.freedom({1, 1, 0}), NodeFreedom::surface);
    EXPECT_EQ(kept.freedom({1, 0, 0}), NodeFreedom::curve);
    EXPECT_EQ(kept.freedom({2, 0, 0}), NodeFreedom::fixed);
    const NodeConstraint c = kept.g.place_of(kept.node({1, 2, 1})).constraint;
    EXPECT_NEAR(std::abs(kept.g.surfaces[c.shape].normal[1]), 1, 1e-15);
    EXPECT_EQ(kept.g.facets[c.hint].shape, c.shape);
    EXPECT_FALSE(kept.g.any_curved());
}

TEST(KeptGeometry, BordersOfElementGroupsPartTheSkinAndAreSurfaces) {
    const Kept kept(checks::two_halves());
    EXPECT_EQ(kept.g.surfaces.size(), 11u) << "two ends, four sides in two parts, the border";
    EXPECT_EQ(std::ranges::count_if(kept.g.surfaces, &KeptGeometry::Surface::internal), 1);
    EXPECT_EQ(kept.g.curves.size(), 20u) << "12 edges, four of them in two parts, and four around the border";
    EXPECT_EQ(kept.freedom({1, 1, 1}), NodeFreedom::surface);
    EXPECT_EQ(kept.freedom({1, 1, 0}), NodeFreedom::curve);
    EXPECT_EQ(kept.freedom({1, 0, 0}), NodeFreedom::fixed);
    EXPECT_EQ(kept.freedom({0, 1, 1}), NodeFreedom::surface);
    EXPECT_EQ(kept.freedom({0, 1, 0}), NodeFreedom::curve);
    ConstraintOptions options;
    options.drifting_groups = {true, true};
    EXPECT_EQ(Kept(checks::two_halves(), options).count(), Kept(checks::grid(2, 2, 2)).count());
}

TEST(KeptGeometry, NothingPartsFacesBelowTheFeatureAngle) {
    ConstraintOptions options;
    options.feature_angle = 91;
    const Kept kept(checks::grid(2, 2, 2), options);
    EXPECT_EQ(kept.g.surfaces.size(), 1u);
    EXPECT_FALSE(kept.g.surfaces[0].flat);
    EXPECT_TRUE(kept.g.any_curved());
    EXPECT_TRUE(kept.g.curves.empty());
    EXPECT_EQ(kept.freedom({2, 2, 2}), NodeFreedom::surface);
    options.feature_angle = 89;
    EXPECT_EQ(Kept(checks::grid(2, 2, 2), options).g.surfaces.size(), 6u);
}

TEST(KeptGeometry, ASegmentInsideIsACurveOfItsOwn) {
    Mesh mesh = checks::grid(2, 2, 2);
    const auto near = [&](double x, double y, double z) { return checks::number_near(mesh, {x, y, z}); };
    mesh.add_cell(CellType::line, std::array{near(1, 1, 0), near(1, 1, 1)}, 5000);
    mesh.add_cell(CellType::line, std::array{near(1, 1, 1), near(1, 1, 2)}, 5001);
    const Kept kept(mesh);
    EXPECT_EQ(kept.g.curves.size(), 13u);
    EXPECT_EQ(kept.freedom({1, 1, 1}), NodeFreedom::curve);
    EXPECT_EQ(kept.freedom({1, 1, 0}), NodeFreedom::fixed) << "its end";
}

TEST(KeptGeometry, OfAPlateHasBorders) {
    Mesh mesh;
    checks::add_plate(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 2, 2);
    const Kept kept(mesh);
    ASSERT_EQ(kept.g.surfaces.size(), 1u);
    EXPECT_TRUE(kept.g.surfaces[0].shell && kept.g.surfaces[0].flat && !kept.g.surfaces[0].is_skin());
    EXPECT_EQ(kept.g.curves.size(), 4u);
    for (const auto& c : kept.g.curves) EXPECT_TRUE(c.border && c.straight);
}

TEST(KeptGeometry, RoundedCoordinatesAreFlat) {
    Mesh mesh = checks::grid(2, 2, 2);
    mesh.points[checks::number_near(mesh, {1, 1, 2})][2] += 1e-6;
    EXPECT_EQ(std::ranges::count(Kept(mesh).flat(), false), 1);
    ConstraintOptions options;
    options.rounding = 2e-6;
    EXPECT_THAT(Kept(mesh, options).flat(), Each(Eq(true)));
}

TEST(KeptGeometry, BentMiddlesMakeASurfaceCurved) {
    Mesh mesh = checks::second_order(checks::grid(1, 1, 1));
    EXPECT_FALSE(Kept(mesh).g.any_curved());
    // The middle of the top's diagonal, and that of an edge of the bottom.
    mesh.points[checks::number_near(mesh, {0.5, 0.5, 1})][2] += 0.05;
    mesh.points[checks::number_near(mesh, {0.5, 0, 0})][1] -= 0.05;
    const Kept kept(mesh);
    EXPECT_EQ(std::ranges::count(kept.flat(), false), 2) << "the top, and the side at y = 0";
    EXPECT_EQ(std::ranges::count(kept.g.curves, false, &KeptGeometry::Curve::straight), 1);
    EXPECT_EQ(std::ranges::count(kept.g.facets, true, &KeptGeometry::Facet::curved), 4)
        << "both of the top, and both at the edge";
    for (const auto& f : kept.g.facets)
        for (const Vec3& p : f.mid) EXPECT_LE((p - f.centre).norm(), f.radius);
}

TEST(KeptGeometry, IsMarkedInTheBand) {
    Kept kept(checks::two_halves());
    kept.g.mark(kept.band);
    ASSERT_EQ(kept.band.skin.size(), static_cast<int>(kept.g.facets.size()));
    ASSERT_EQ(kept.band.creases.size(), static_cast<int>(kept.g.segments.size()));
    for (int s = 0; s < kept.band.skin.size(); ++s) {
        EXPECT_EQ(kept.band.skin[s], kept.g.facets[s].node);
        EXPECT_EQ(kept.band.skin.tag(s), kept.g.facets[s].shape);
    }
    for (int s = 0; s < kept.band.creases.size(); ++s) EXPECT_EQ(kept.band.creases.tag(s), kept.g.segments[s].shape);
}

/// Two segments of one curve that bend by an angle in node 1.
KeptGeometry bent_line(double angle, bool fold) {
    KeptGeometry g;
    const std::array<Vec3, 3> p{Vec3(-1, 0, 0), Vec3::Zero(), 2 * Vec3(std::cos(angle), std::sin(angle), 0)};
    g.curves.push_back({.straight = false});
    g.facets_around.resize(3);
    g.segments_around = {{0}, {0, 1}, {1}};
    g.passes = {0, 1, 0};
    for (int k = 0; k < 2; ++k) {
        KeptGeometry::Segment s;
        s.node = {k, k + 1};
        s.end = {p[k], p[k + 1]};
        s.mid = (p[k] + p[k + 1]) / 2;
        s.fold = fold;
        s.shape = 0;
        g.segments.push_back(s);
    }
    return g;
}

TEST(KeptGeometry, ABentLineHoldsItsNodesOnALeash) {
    const KeptGeometry::Place place = bent_line(0.2, false).place_of(1);
    EXPECT_EQ(place.constraint.freedom, NodeFreedom::curve);
    EXPECT_NEAR(place.leash, 0.05 / std::sin(0.2), 1e-12) << "a twentieth of the shorter segment deep";
    EXPECT_TRUE(std::isinf(bent_line(0, false).place_of(1).leash));
    EXPECT_EQ(bent_line(0.2, false).place_of(0).constraint.freedom, NodeFreedom::fixed) << "its end";
}

TEST(KeptGeometry, ABentFrontOfACrackIsFixed) {
    EXPECT_EQ(bent_line(0.2, true).place_of(1).constraint.freedom, NodeFreedom::fixed);
    EXPECT_EQ(bent_line(1e-7, true).place_of(1).constraint.freedom, NodeFreedom::curve);
    KeptGeometry rounded = bent_line(1e-4, true);
    EXPECT_EQ(rounded.place_of(1).constraint.freedom, NodeFreedom::fixed);
    rounded.rounding = 2e-4;
    EXPECT_EQ(rounded.place_of(1).constraint.freedom, NodeFreedom::curve);
}

TEST(KeptGeometry, SheetsThatTouchInANodeAlonePinIt) {
    KeptGeometry g;
    g.surfaces.resize(1);
    g.segments_around.resize(7);
    g.passes.resize(7);
    // Around node 0 the fans 1-2-3 and 4-5-6.
    for (const std::array<int, 3>& node :
         {std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{0, 3, 1}, std::array{0, 4, 5}, std::array{0, 5, 6}}) {
        KeptGeometry::Facet f;
        f.corner.fill(Vec3::Zero());  // only who shares nodes with whom counts
        f.mid = f.corner;
        f.node = node;
        f.shape = 0;
        g.facets.push_back(f);
    }
    g.facets_around = {{0, 1, 2}, {}, {}, {}, {}, {}, {}};
    EXPECT_EQ(g.place_of(0).constraint.freedom, NodeFreedom::surface);
    g.facets_around[0] = {0, 1, 2, 3, 4};
    EXPECT_EQ(g.place_of(0).constraint.freedom, NodeFreedom::fixed);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
