// SPDX-License-Identifier: LGPL-2.1-or-later
// What must hold of a crack along a plane, whatever the plane: the same checks on hundreds of random ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "crack_checks.h"
#include "io/inp.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/scalpel.h"
#include "session.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace checks;

#if defined(__SANITIZE_ADDRESS__)
constexpr int snap_planes = 10, deform_planes = 4;
#else
constexpr int snap_planes = 500, deform_planes = 100;
#endif

/// Failures printed in full; the rest is counted.
constexpr int described = 10;

struct Subject {
    const char* name;
    bool flat;      ///< skin and borders are plane
    int share = 1;  ///< one in so many of the planes: curved second-order elements take a quarter of a second each,
                    ///< some many seconds
};

std::ostream& operator<<(std::ostream& out, const Subject& s) { return out << s.name; }

class PlaneProperties : public testing::TestWithParam<Subject> {
protected:
    PlaneProperties()
        : model_(read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/" + GetParam().name + ".inp"), GetParam().flat),
          session_(std::make_shared<const Mesh>(model_.mesh)) {}

    /// With FEMSCALPEL_ALL_PLANES in the environment no mesh gets fewer planes.
    static int share() { return std::getenv("FEMSCALPEL_ALL_PLANES") ? 1 : GetParam().share; }

    CutPlane random_plane(Random& random) const {
        CutPlane plane;
        const Vec3 margin = 0.05 * (model_.high - model_.low);
        for (int a = 0; a < 3; ++a)
            plane.origin[a] = random.uniform(model_.low[a] - margin[a], model_.high[a] + margin[a]);
        plane.normal = random.direction();
        return plane;
    }

    bool misses(const CutPlane& plane) const {
        bool above = false, below = false;
        for (const Vec3& x : model_.mesh.points) {
            above = above || plane.distance(x) > 1e-9 * model_.size;
            below = below || plane.distance(x) < -1e-9 * model_.size;
        }
        return !above || !below;
    }

    static std::string describe(int k, const CutPlane& plane) {
        std::ostringstream text;
        text << std::setprecision(17) << "plane " << k << ", origin (" << plane.origin.transpose() << "), normal ("
             << plane.normal.transpose() << ")";
        return text.str();
    }

    Model model_;
    checks::Session session_;
};

INSTANTIATE_TEST_SUITE_P(Meshes, PlaneProperties,
                         testing::Values(Subject{"two_boxes", true}, Subject{"flanged_cylinder", false},
                                         Subject{"l_shape", true}, Subject{"quadratic_elbow", false, 8},
                                         Subject{"caisson_shell", true}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(PlaneProperties, SnapIsValidAndGood) {
    const int planes = snap_planes / share();
    Random random(2024);
    int low = 0, valid = 0, failed = 0, missed = 0, surface = 0, line = 0, counted = 0, good = 0, good_anyhow = 0,
        reachable = 0;
    double worst = 1;
    const Mesh before = model_.mesh;
    for (int k = 0; k < planes; ++k) {
        const CutPlane plane = random_plane(random);
        Result result;
        try {
            result = session_.crack(Plane(plane.origin, plane.normal));
        } catch (const ToolError& e) {
            // The only excuse: there is nothing to cut, or just a bulge of a curved skin between two nodes.
            ++missed;
            if (!misses(plane) && (model_.flat || section_measure(model_, plane) > model_.section_slack(plane)))
                ADD_FAILURE() << describe(k, plane) << " cuts the mesh, but: " << e.what();
            continue;
        } catch (const std::exception& e) {
            if (++failed <= described) ADD_FAILURE() << describe(k, plane) << ": " << e.what();
            continue;
        }
        const std::vector<std::string> findings = check_crack(model_, plane, result, "CRACK");
        if (findings.empty())
            ++valid;
        else if (++failed <= described)
            std::cout << describe(k, plane) << ":\n  " << testing::PrintToString(findings) << "\n";
        const double quality = result.report.quality_after.minimum, input = result.report.quality_before.minimum;
        const Grazing limits = grazing(model_, plane);
        surface += limits.surface;
        line += limits.line && !limits.surface;
        if (limits.surface || limits.line) {
            if (quality < 0.1) {
                EXPECT_THAT(result.report.warnings, testing::Not(testing::IsEmpty()))
                    << describe(k, plane) << " grazes a border, quality " << quality;
            }
            continue;
        }
        ++counted;
        worst = std::min(worst, quality);
        if (quality < std::min(0.1, input) && ++low <= described)
            std::cout << describe(k, plane) << ": quality " << quality << "\n";
        if (input < 0.3) continue;
        good_anyhow += quality >= 0.3;
        if (limits.bound < 0.3) continue;
        ++reachable;
        good += quality >= 0.3;
    }
    EXPECT_EQ(failed, 0) << "see the output";
    EXPECT_EQ(low, 0) << "see the output";
    EXPECT_GT(valid, planes / 2);
    // In plates a crack that meets a border at 10 degrees already cuts off a triangle of 0.3: no mesh is better there.
    EXPECT_GE(good, 0.9 * reachable);
    if (model_.solid) {
        EXPECT_GE(good_anyhow, 0.9 * counted);
    }
    EXPECT_TRUE(identical(model_.mesh, before) && identical(session_.mesh(), before)) << "the input was changed";
    std::cout << std::setprecision(3) << "[  QUALITY ] " << GetParam().name << ", snap: " << valid << " of " << planes
              << " valid, " << missed << " miss the mesh, " << failed << " fail; grazing a surface " << surface
              << ", a line " << line << "; of the other " << counted << ": minimum " << worst
              << ", mean ratio >= 0.3 in " << good_anyhow << ", and in " << good << " of " << reachable
              << " where the angles allow it\n";
}

TEST_P(PlaneProperties, DeformIsValidOrSaysNo) {
    const int planes = std::max(1, deform_planes / share());
    Random random(7);
    int valid = 0, failed = 0, refused = 0, missed = 0;
    double worst = 1;
    CrackOptions options;
    options.method = Method::deform;
    const Mesh before = model_.mesh;
    for (int k = 0; k < planes; ++k) {
        const CutPlane plane = random_plane(random);
        try {
            const Result result = session_.crack(Plane(plane.origin, plane.normal), options);
            const std::vector<std::string> findings = check_crack(model_, plane, result, "CRACK");
            if (findings.empty())
                ++valid;
            else if (++failed <= described)
                std::cout << describe(k, plane) << ":\n  " << testing::PrintToString(findings) << "\n";
            worst = std::min(worst, result.report.quality_after.minimum);
        } catch (const QualityError& e) {
            ++refused;
            EXPECT_THAT(e.what(), testing::HasSubstr("snap")) << describe(k, plane);
        } catch (const ToolError&) {
            ++missed;
        } catch (const std::exception& e) {
            if (++failed <= described) ADD_FAILURE() << describe(k, plane) << ": " << e.what();
        }
    }
    EXPECT_EQ(failed, 0) << "see the output";
    EXPECT_TRUE(identical(model_.mesh, before)) << "the input was changed";
    std::cout << std::setprecision(3) << "[  QUALITY ] " << GetParam().name << ", deform: succeeds on " << valid
              << " of " << planes - missed << " planes that cut the mesh ("
              << 100.0 * valid / std::max(1, planes - missed) << " %), minimum mean ratio there " << worst
              << "; refuses " << refused << "\n";
}

/// Planes that are special to the mesh: along the axes, through nodes, through whole edges.
TEST_P(PlaneProperties, SnapOnSpecialPlanes) {
    const int planes = snap_planes / share();
    Random random(99);
    int valid = 0, failed = 0, missed = 0;
    const Mesh& mesh = model_.mesh;
    const auto node = [&] {
        return static_cast<std::size_t>(random.uniform(0, static_cast<double>(mesh.points.size())));
    };
    for (int k = 0; k < planes / 5; ++k) {
        CutPlane plane = random_plane(random);
        const int kind = k % 4;
        if (kind == 0) plane.normal = Vec3::Unit(static_cast<int>(random.uniform(0, 3)));
        if (kind >= 1) plane.origin = mesh.points[node()];
        if (kind == 2) plane.normal = plane.normal.cross(mesh.points[node()] - plane.origin).normalized();
        if (kind == 3)
            plane.normal = (mesh.points[node()] - plane.origin).cross(mesh.points[node()] - plane.origin).normalized();
        if (!plane.normal.allFinite() || plane.normal.norm() < 0.5) continue;
        try {
            const Result result = session_.crack(Plane(plane.origin, plane.normal));
            const std::vector<std::string> findings = check_crack(model_, plane, result, "CRACK");
            if (findings.empty())
                ++valid;
            else if (++failed <= described)
                std::cout << describe(k, plane) << ":\n  " << testing::PrintToString(findings) << "\n";
        } catch (const ToolError&) {
            ++missed;
        } catch (const QualityError& e) {
            // Exactly through a corner there may be no room for elements; the error has to say where.
            ++missed;
            EXPECT_THAT(e.what(), testing::HasSubstr("element")) << describe(k, plane);
        }
    }
    EXPECT_EQ(failed, 0) << "see the output";
    std::cout << "[  QUALITY ] " << GetParam().name << ", special planes: " << valid << " valid, " << missed
              << " refused, " << failed << " fail\n";
}

TEST_P(PlaneProperties, SessionAndSingleCallGiveTheSame) {
    Random random(5);
    int compared = 0;
    for (int k = 0; k < 6; ++k) {
        const CutPlane plane = random_plane(random);
        if (misses(plane)) continue;
        try {
            const Result once = crack(model_.mesh, Plane(plane.origin, plane.normal)),
                         again = session_.crack(Plane(plane.origin, plane.normal));
            EXPECT_TRUE(identical(once.mesh, again.mesh)) << describe(k, plane);
            ++compared;
        } catch (const Error&) {
        }
    }
    EXPECT_GT(compared, 2);
}

/// Everything about an element, by numbers and names, so that it can be compared between meshes.
std::map<Index, std::string> described_elements(const Mesh& mesh) {
    const auto groups = [&](FamilyIndex family) {
        std::string text;
        for (const GroupIndex g : mesh.families.groups(family)) text += " " + mesh.groups[g].name;
        return text;
    };
    std::map<Index, std::string> out;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            std::ostringstream text;
            text << std::hexfloat << static_cast<int>(b.type) << groups(b.families[c]);
            for (const Index n : b.nodes(c))
                text << " | " << mesh.node_ids[n] << " " << mesh.points[n].x() << " " << mesh.points[n].y() << " "
                     << mesh.points[n].z() << groups(mesh.node_families[n]);
            out.emplace(b.ids[c], text.str());
        }
    for (const Facet& f : mesh.facets)
        out[mesh.block(f.type).ids[f.cell]] += " face " + std::to_string(f.face) + groups(f.family);
    return out;
}

/// A band is exactly its part of the whole result, and all that changed is in it.
void check_band(const Result& whole, const Result& band, const std::map<Index, std::string>& input) {
    EXPECT_NO_THROW(band.mesh.validate());
    const auto wanted = described_elements(whole.mesh), got = described_elements(band.mesh);
    int differ = 0, missing = 0;
    for (const auto& [id, text] : got) differ += !wanted.contains(id) || wanted.at(id) != text;
    for (const auto& [id, text] : wanted) missing += !got.contains(id) && (!input.contains(id) || input.at(id) != text);
    EXPECT_EQ(differ, 0) << "elements of the band that are not the whole result's";
    EXPECT_EQ(missing, 0) << "changed elements that are not in the band";
    EXPECT_LT(got.size(), wanted.size());
    const Report &a = whole.report, &b = band.report;
    EXPECT_EQ(a.node_sets, b.node_sets);
    EXPECT_EQ(a.constraints, b.constraints);
    EXPECT_EQ(a.warnings, b.warnings);
    EXPECT_EQ(a.quality_after.histogram, b.quality_after.histogram);
    EXPECT_EQ(a.quality_after.minimum, b.quality_after.minimum);
    EXPECT_EQ(std::tuple(a.nodes_added, a.nodes_moved, a.elements_added, a.elements_removed, a.max_displacement),
              std::tuple(b.nodes_added, b.nodes_moved, b.elements_added, b.elements_removed, b.max_displacement));
    ASSERT_EQ(a.groups.size(), b.groups.size());
    for (std::size_t g = 0; g < a.groups.size(); ++g) {
        const GroupRecord &x = a.groups[g], &y = b.groups[g];
        EXPECT_EQ(std::tuple(x.name, x.status, x.count_before, x.count_after, x.nodes_moved, x.boundary_drift,
                             x.measure_before),
                  std::tuple(y.name, y.status, y.count_before, y.count_after, y.nodes_moved, y.boundary_drift,
                             y.measure_before))
            << x.name;
        EXPECT_NEAR(x.measure_after, y.measure_after, 1e-12 * std::abs(x.measure_after)) << x.name;
    }
}

TEST_P(PlaneProperties, BandAloneIsThatOfTheWholeResult) {
    Random random(6);
    CrackOptions band_only;
    band_only.band_only = true;
    const auto input = described_elements(model_.mesh);
    int compared = 0;
    for (int k = 0; k < (share() > 1 ? 4 : 6); ++k) {
        const CutPlane cut = random_plane(random);
        const Plane plane(cut.origin, cut.normal);
        std::optional<Result> whole;
        try {
            whole = session_.crack(plane);
        } catch (const Error& e) {
            EXPECT_THROW(session_.crack(plane, band_only), Error) << describe(k, cut) << ": " << e.what();
            continue;
        }
        ++compared;
        const Result band = session_.crack(plane, band_only);
        EXPECT_TRUE(identical(band.mesh, crack(model_.mesh, plane, band_only).mesh)) << describe(k, cut);
        const testing::ScopedTrace trace(__FILE__, __LINE__, describe(k, cut));
        check_band(*whole, band, input);
    }
    EXPECT_GT(compared, 2);
}

TEST(Drill, BandAloneIsThatOfTheWholeResult) {
    const Mesh mesh = read_inp(FEMSCALPEL_TEST_MESHES "/two_boxes_39k.inp");
    const Cylinder cylinder({10, 5, 5}, {0, 0.1, 1}, 2.5);  // so wide that elements away from its wall go too
    const Tool* tool = &cylinder;
    DrillOptions options;
    const Result whole = drill(mesh, {&tool, 1}, options);
    options.band_only = true;
    const Result band = drill(mesh, {&tool, 1}, options);
    EXPECT_LT(band.mesh.cell_count(), whole.mesh.cell_count() / 2);
    check_band(whole, band, described_elements(mesh));
}

TEST(Crack, AlongElementFacesOnlyDoubles) {
    const Model model(read_inp(FEMSCALPEL_TEST_MESHES "/two_boxes.inp"), true);
    const CutPlane glue{{10, 5, 5}, {1, 0, 0}};
    const Result result = crack(model.mesh, Plane(glue.origin, glue.normal));
    EXPECT_THAT(check_crack(model, glue, result, "CRACK"), testing::IsEmpty());
    EXPECT_EQ(result.report.nodes_split, 0);
    EXPECT_EQ(result.report.nodes_moved, 0);
    EXPECT_EQ(result.report.max_displacement, 0);
    EXPECT_EQ(result.report.elements_removed, 0);
    for (std::size_t n = 0; n < model.mesh.points.size(); ++n) ASSERT_EQ(result.mesh.points[n], model.mesh.points[n]);
    // Every node of the glue has one double, nothing else is new.
    const auto glued = group_members(model.mesh, *model.mesh.find_group("GLUE", GroupKind::node)).ids;
    EXPECT_EQ(result.report.nodes_doubled, static_cast<Index>(glued.size()));
    EXPECT_EQ(result.mesh.block(CellType::tetra).size(), model.mesh.block(CellType::tetra).size());
    // The glue's faces are there once per side, in GLUE and in a lip; no further lip faces were made.
    const auto faces = [](const Mesh& mesh, const char* name) {
        return group_members(mesh, *mesh.find_group(name, GroupKind::element)).ids.size();
    };
    EXPECT_EQ(faces(result.mesh, "GLUE"), 2 * faces(model.mesh, "GLUE"));
    EXPECT_EQ(faces(result.mesh, "CRACK_P"), faces(model.mesh, "GLUE"));
    EXPECT_EQ(faces(result.mesh, "CRACK_N"), faces(model.mesh, "GLUE"));
    EXPECT_EQ(result.mesh.block(CellType::triangle).size(),
              model.mesh.block(CellType::triangle).size() + static_cast<Index>(faces(model.mesh, "GLUE")));
    EXPECT_NEAR(group_sums(result.mesh)[*model.mesh.find_group("GLUE", GroupKind::element)].measure, 200, 1e-7);
}

/// Cuts edges near their middles: some nodes are moved onto it, some edges split.
const CutPlane slanting{{3.4, 1, 1}, Vec3(0.6, 0.7, 0.4).normalized()};

/// Cracks `mesh` and expects everything that holds for every crack.
Result crack_and_check(const Mesh& mesh, const CutPlane& plane, const CrackOptions& options = {}) {
    const Model model(mesh, true);
    Result result = crack(mesh, Plane(plane.origin, plane.normal), options);
    EXPECT_THAT(check_crack(model, plane, result, options.name), testing::IsEmpty());
    EXPECT_TRUE(identical(mesh, model.mesh)) << "the input was changed";
    return result;
}

TEST(Crack, TJunctionOfShells) {
    Mesh mesh;
    const FamilyIndex floor = family_of(mesh, "FLOOR", GroupKind::element),
                      web = family_of(mesh, "WEB", GroupKind::element);
    add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8, 4, floor);
    add_plate(mesh, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, 8, 2, web);
    // Across both plates, at right angles and slanting: three lines of lips meet in the junction.
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0.9, 0.3, 0.2)}) {
        const CutPlane plane{{3.6, 2, 0}, normal.normalized()};
        const Result result = crack_and_check(mesh, plane);
        // The node where the junction is cut was doubled once, not once per plate.
        int at_junction = 0;
        for (const Vec3& x : result.mesh.points)
            at_junction += std::abs(x.y() - 2) < 1e-9 && std::abs(x.z()) < 1e-9 && std::abs(plane.distance(x)) < 1e-8;
        EXPECT_EQ(at_junction, 2);
    }
    // Along the junction: floor from floor, the web stays with one side.
    const CutPlane along{{0, 2, 0}, {0, 1, 0}};
    const Result result = crack(mesh, Plane(along.origin, along.normal));
    EXPECT_EQ(result.report.nodes_doubled, 9);
    EXPECT_EQ(result.report.nodes_split + result.report.nodes_moved, 0);
    const auto ends = [&](double y) {
        std::set<Index> nodes;
        const CellBlock& b = result.mesh.block(CellType::triangle);
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            const Vec3 centre = (result.mesh.points[n[0]] + result.mesh.points[n[1]] + result.mesh.points[n[2]]) / 3;
            if ((centre.y() - 2) * y > 1e-9) nodes.insert(n.begin(), n.end());
        }
        return nodes;
    };
    for (const Index n : ends(1)) EXPECT_FALSE(ends(-1).contains(n)) << "node " << result.mesh.node_ids[n];
}

TEST(Crack, MassAndBeamOnADoubledNode) {
    Mesh mesh = grid(4, 2, 2);
    const Index on = number_near(mesh, {2, 1, 1}), far = mesh.add_node({4, 4, 4}, 900);
    const FamilyIndex mass = family_of(mesh, "MASS", GroupKind::element),
                      beam = family_of(mesh, "BEAM", GroupKind::element);
    mesh.add_cell(CellType::vertex, std::array{on}, 5001, mass);
    mesh.add_cell(CellType::line, std::array{on, far}, 5002, beam);
    const CutPlane plane{{2, 0, 0}, {1, 0, 0}};
    const Result result = crack_and_check(mesh, plane);
    // Still one of each, still in their groups, on the node or its double; the beam on the side its other end is on.
    EXPECT_THAT(members(result.mesh, "MASS", GroupKind::element), testing::ElementsAre(5001));
    EXPECT_THAT(members(result.mesh, "BEAM", GroupKind::element), testing::ElementsAre(5002));
    ASSERT_EQ(result.mesh.block(CellType::vertex).size(), 1);
    ASSERT_EQ(result.mesh.block(CellType::line).size(), 1);
    EXPECT_EQ(result.mesh.points[result.mesh.block(CellType::vertex).nodes(0)[0]], Vec3(2, 1, 1));
    const Index end = result.mesh.block(CellType::line).nodes(0)[0];
    EXPECT_EQ(result.mesh.points[end], Vec3(2, 1, 1));
    bool positive = false;
    const CellBlock& tetras = result.mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c)
        if (std::ranges::count(tetras.nodes(c), end))
            for (const Index n : tetras.nodes(c)) positive = positive || result.mesh.points[n].x() > 2.5;
    EXPECT_TRUE(positive) << "the beam's other end is on the positive side";
    EXPECT_THAT(result.report.warnings, testing::Contains(testing::HasSubstr("point")));
}

TEST(Crack, FreeSegmentAcrossThePlaneIsCut) {
    Mesh mesh = grid(6, 2, 2);
    const FamilyIndex beam = family_of(mesh, "BEAM", GroupKind::element);
    const std::array ends{number_near(mesh, {0, 0, 0}), number_near(mesh, {6, 2, 2})};
    mesh.add_cell(CellType::line, ends, 5001, beam);
    const Result result = crack(mesh, Plane(slanting.origin, slanting.normal));
    EXPECT_EQ(result.report.beams_cut, 1);
    const CellBlock& lines = result.mesh.block(CellType::line);
    ASSERT_EQ(lines.size(), 2);
    EXPECT_EQ(lines.ids[0], 5001);
    EXPECT_THAT(members(result.mesh, "BEAM", GroupKind::element), testing::UnorderedElementsAreArray(lines.ids));
    EXPECT_EQ(lines.nodes(0)[0], ends[0]);
    EXPECT_EQ(lines.nodes(1)[1], ends[1]);
    EXPECT_NE(lines.nodes(0)[1], lines.nodes(1)[0]);
    EXPECT_EQ(result.mesh.points[lines.nodes(0)[1]], result.mesh.points[lines.nodes(1)[0]]);
}

TEST(Crack, FaceGroupOnThePlaneGetsOneCopyPerSide) {
    Mesh mesh = grid(4, 2, 2);
    const FamilyIndex seam = family_of(mesh, "SEAM", GroupKind::element);
    const FamilyIndex both = mesh.families.with(seam, mesh.add_group("UPPER", GroupKind::element));
    Index number = 7000;
    for (const TetraFace& f : tetra_faces(mesh)) {
        double x = 0;
        for (const Index n : mesh.block(CellType::tetra).nodes(f.cell.cell)) x += mesh.points[n].x() / 4;
        if (x < 2 || !std::ranges::all_of(f.key, [&](Index n) { return mesh.points[n].x() == 2; })) continue;
        const bool upper = (mesh.points[f.key[0]] + mesh.points[f.key[1]] + mesh.points[f.key[2]]).z() > 3;
        mesh.add_cell(CellType::triangle, f.outward, number++, upper ? both : seam);
    }
    ASSERT_EQ(number, 7008);
    const CutPlane plane{{2, 0, 0}, {1, 0, 0}};
    const Result result = crack_and_check(mesh, plane);
    EXPECT_EQ(members(result.mesh, "SEAM", GroupKind::element).size(), 16);
    EXPECT_EQ(members(result.mesh, "UPPER", GroupKind::element).size(), 8);
    EXPECT_EQ(result.mesh.block(CellType::triangle).size(), 16);
    const auto sums = group_sums(result.mesh);
    EXPECT_NEAR(sums[*mesh.find_group("SEAM")].measure, 8, 1e-12);
    EXPECT_NEAR(sums[*result.mesh.find_group("CRACK_P")].measure, 4, 1e-12);
    EXPECT_NEAR(sums[*result.mesh.find_group("CRACK_N")].measure, 4, 1e-12);
}

TEST(Crack, FacetGroupIsSplitAndKept) {
    Mesh mesh = grid(6, 2, 2);
    const FamilyIndex top = family_of(mesh, "TOP", GroupKind::facet);
    for (const TetraFace& f : tetra_faces(mesh)) {
        if (!std::ranges::all_of(f.key, [&](Index n) { return mesh.points[n].z() == 2; })) continue;
        // CalculiX's numbers: faces 123, 142, 243, 341 of the element's corners.
        constexpr int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
        const auto n = mesh.block(CellType::tetra).nodes(f.cell.cell);
        for (int k = 0; k < 4; ++k) {
            std::array<Index, 3> key{n[faces[k][0]], n[faces[k][1]], n[faces[k][2]]};
            std::ranges::sort(key);
            if (key == f.key)
                mesh.facets.push_back({CellType::tetra, static_cast<std::int8_t>(k + 1), top, f.cell.cell});
        }
    }
    ASSERT_EQ(mesh.facets.size(), 24);
    const Result result = crack_and_check(mesh, slanting);
    EXPECT_GT(members(result.mesh, "TOP", GroupKind::facet).size(), 24);
    EXPECT_NEAR(group_sums(result.mesh)[*mesh.find_group("TOP")].measure, 12, 1e-9);
    for (const Facet& f : result.mesh.facets) {
        constexpr int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
        for (const int k : faces[f.face - 1])
            EXPECT_NEAR(result.mesh.points[result.mesh.block(f.type).nodes(f.cell)[k]].z(), 2, 1e-12);
    }
}

TEST(Crack, FacetsOfShellsAreSplitAndKept) {
    Mesh mesh;
    add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, 8, 4);
    const FamilyIndex pressed = family_of(mesh, "PRESSED", GroupKind::facet),
                      edge = family_of(mesh, "EDGE", GroupKind::facet);
    const CellBlock& b = mesh.block(CellType::triangle);
    for (Index c = 0; c < b.size(); ++c) {
        mesh.facets.push_back({CellType::triangle, 2, pressed, c});
        for (int k = 0; k < 3; ++k)
            if (mesh.points[b.nodes(c)[k]].y() == 0 && mesh.points[b.nodes(c)[(k + 1) % 3]].y() == 0)
                mesh.facets.push_back({CellType::triangle, static_cast<std::int8_t>(k + 3), edge, c});
    }
    const Result result = crack_and_check(mesh, {{3.5, 0, 0}, Vec3(1, 0.1, 0.1).normalized()});
    const auto sums = group_sums(result.mesh);
    EXPECT_NEAR(sums[*mesh.find_group("PRESSED")].measure, 16, 1e-9);
    EXPECT_NEAR(sums[*mesh.find_group("EDGE")].measure, 8, 1e-9);
    EXPECT_GT(sums[*mesh.find_group("EDGE")].count, 8);
}

TEST(Crack, ShellStandingOnASolid) {
    Mesh mesh = grid(6, 2, 2);
    const FamilyIndex fin = family_of(mesh, "FIN", GroupKind::element);
    // On the line y = 1 of the top; its lowest nodes are the solid's.
    add_plate(mesh, {0, 1, 2}, {1, 0, 0}, {0, 0, 1}, 6, 2, fin);
    const Result result = crack_and_check(mesh, slanting);
    EXPECT_NEAR(group_sums(result.mesh)[*mesh.find_group("FIN")].measure, 12, 1e-9);
    // The fin comes apart with the solid: no triangle crosses, no node is shared by its two sides.
    std::set<Index> sides[2];
    const CellBlock& b = result.mesh.block(CellType::triangle);
    for (Index c = 0; c < b.size(); ++c) {
        double low = 0, high = 0;
        for (const Index n : b.nodes(c)) {
            low = std::min(low, slanting.distance(result.mesh.points[n]));
            high = std::max(high, slanting.distance(result.mesh.points[n]));
        }
        EXPECT_FALSE(low < -1e-8 && high > 1e-8) << "element " << b.ids[c];
        if (high > 1e-8 || low < -1e-8) sides[high > -low].insert(b.nodes(c).begin(), b.nodes(c).end());
    }
    for (const Index n : sides[0]) EXPECT_FALSE(sides[1].contains(n)) << "node " << result.mesh.node_ids[n];
}

TEST(Crack, NodeGroupsFollowTheirBothEnds) {
    Mesh mesh = grid(6, 2, 2);
    const GroupIndex bottom = mesh.add_group("BOTTOM", GroupKind::node),
                     lonely = mesh.add_group("GAUGE", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n].z() == 0) mesh.node_families[n] = mesh.families.with(0, bottom);
    const Index gauge = number_near(mesh, {3, 1, 1});
    mesh.node_families[gauge] = mesh.families.with(0, lonely);
    const Result result = crack_and_check(mesh, slanting);
    // Exactly the nodes of the bottom, new ones and doubles included.
    for (std::size_t n = 0; n < result.mesh.points.size(); ++n)
        EXPECT_EQ(result.mesh.families.contains(result.mesh.node_families[n], bottom),
                  std::abs(result.mesh.points[n].z()) < 1e-9)
            << "node " << result.mesh.node_ids[n];
    EXPECT_THAT(members(result.mesh, "GAUGE", GroupKind::node), testing::ElementsAre(mesh.node_ids[gauge]));
    EXPECT_EQ(result.mesh.points[gauge], Vec3(3, 1, 1)) << "an isolated node of a group does not move";
}

/// Every error: of type E, says `text`, leaves the input as it was, by single call and by session.
template <class E>
void expect_error(const Mesh& mesh, const std::function<std::unique_ptr<Plane>()>& plane, const CrackOptions& options,
                  const std::string& text) {
    const Mesh before = mesh;
    const auto attempt = [&](auto call) {
        try {
            call(*plane());
            ADD_FAILURE() << "no error; expected one with '" << text << "'";
        } catch (const E& e) {
            EXPECT_THAT(e.what(), testing::HasSubstr(text));
        } catch (const std::exception& e) {
            ADD_FAILURE() << "error of another type: " << e.what();
        }
    };
    attempt([&](const Plane& p) { crack(mesh, p, options); });
    const Scalpel session(std::make_shared<const Mesh>(mesh));
    attempt([&](const Plane& p) { crack(session.mesh(), p, options, session.prepared()); });
    EXPECT_TRUE(identical(mesh, before)) << "the input was changed";
}

std::function<std::unique_ptr<Plane>()> through(const Vec3& origin, const Vec3& normal) {
    return [=] { return std::make_unique<Plane>(origin, normal); };
}

const auto sound_plane = through(slanting.origin, slanting.normal);

TEST(CrackErrors, UnusablePlane) {
    const Mesh mesh = grid(6, 2, 2);
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    expect_error<ToolError>(mesh, through({3, 1, 1}, {0, 0, 0}), {}, "normal");
    expect_error<ToolError>(mesh, through({nan, 1, 1}, {1, 0, 0}), {}, "origin");
    expect_error<ToolError>(mesh, through({infinity, 1, 1}, {1, 0, 0}), {}, "origin");
    expect_error<ToolError>(mesh, through({3, 1, 1}, {nan, 0, 1}), {}, "normal");
    expect_error<ToolError>(mesh, through({3, 1, 1}, {infinity, 0, 1}), {}, "normal");
}

TEST(CrackErrors, PlaneThatCutsNothing) {
    const Mesh mesh = grid(6, 2, 2);
    expect_error<ToolError>(mesh, through({8, 1, 1}, {1, 0, 0}), {}, "misses");
    expect_error<ToolError>(mesh, through({-1e-3, 1, 1}, {1, 0, 0}), {}, "misses");
    expect_error<ToolError>(mesh, through({6, 1, 1}, {1, 0, 0}), {}, "only");  // a whole face
    expect_error<ToolError>(mesh, through({6, 2, 1}, {1, 1, 0}), {}, "only");  // an edge
    expect_error<ToolError>(mesh, through({6, 2, 2}, {1, 1, 1}), {}, "only");  // a corner
}

TEST(CrackErrors, Names) {
    Mesh mesh = grid(6, 2, 2);
    mesh.add_group("TAKEN_P", GroupKind::node);
    mesh.add_group("GONE_FRONT", GroupKind::element);
    const auto named = [](std::string name) {
        CrackOptions options;
        options.name = std::move(name);
        return options;
    };
    expect_error<ToolError>(mesh, sound_plane, named("TAKEN"), "TAKEN_P");
    expect_error<ToolError>(mesh, sound_plane, named("GONE"), "GONE_FRONT");
    expect_error<ToolError>(mesh, sound_plane, named(""), "empty");
    expect_error<ToolError>(mesh, sound_plane, named("MY CRACK"), "MY CRACK");
    expect_error<ToolError>(mesh, sound_plane, named("A,B"), "A,B");
    expect_error<ToolError>(mesh, sound_plane, named(std::string(25, 'X')), "24");
    expect_error<ToolError>(mesh, sound_plane, named(std::string(19, 'X')), "24");  // with _FRONT, 25
    const Result longest = crack_and_check(mesh, slanting, named(std::string(18, 'X')));
    EXPECT_TRUE(longest.mesh.find_group(std::string(18, 'X') + "_P").has_value());
}

TEST(CrackErrors, TransitionOutOfRange) {
    const Mesh mesh = grid(6, 2, 2);
    for (const int transition : {-1, 0, 21, 1000000}) {
        CrackOptions options;
        options.transition = transition;
        expect_error<ToolError>(mesh, sound_plane, options, "transition");
    }
    for (const int transition : {1, 20}) {
        CrackOptions options;
        options.transition = transition;
        EXPECT_EQ(crack_and_check(mesh, slanting, options).report.transition, transition);
    }
}

TEST(CrackErrors, InvertedElementNearThePlane) {
    const Mesh sound = grid(12, 2, 2);
    for (const bool near : {true, false}) {
        Mesh mesh = sound;
        CellBlock& b = mesh.block(CellType::tetra);
        Index bad = -1;
        for (Index c = 0; c < b.size(); ++c) {
            double x = 0;
            for (const Index n : b.nodes(c)) x += mesh.points[n].x() / 4;
            if (near ? std::abs(x - 3.3) < 0.5 : x > 11) bad = c;
        }
        ASSERT_GE(bad, 0);
        std::swap(b.connectivity[4 * bad], b.connectivity[4 * bad + 1]);
        if (near) {
            expect_error<QualityError>(mesh, sound_plane, {}, std::to_string(b.ids[bad]));
        } else {
            // Far from the plane it is none of the crack's business, and stays as it is.
            const Result result = crack(mesh, *sound_plane());
            for (int k = 0; k < 4; ++k) EXPECT_EQ(result.mesh.block(CellType::tetra).nodes(bad)[k], b.nodes(bad)[k]);
        }
    }
}

TEST(CrackErrors, FoldedSecondOrderElementNearThePlane) {
    Mesh mesh = second_order(grid(3, 3, 3));
    const CellBlock& b = mesh.block(CellType::tetra10);
    // Its first mid-side node beyond the end of the edge.
    mesh.points[b.nodes(80)[4]] += 0.8 * (mesh.points[b.nodes(80)[1]] - mesh.points[b.nodes(80)[0]]);
    expect_error<QualityError>(mesh, through({1.5, 1.5, 1.5}, Vec3(0.1, 0.2, 1)), {}, "near the tool, folded (element");
}

TEST(CrackErrors, BandThatReachesAHexahedron) {
    Mesh mesh = grid(8, 1, 1);
    const auto add_hexahedron = [](Mesh& to, double x) {
        std::array<Index, 8> n;
        constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        for (int k = 0; k < 8; ++k) {
            const Vec3 at(x + corner[k][0], corner[k][1], corner[k][2]);
            n[k] = corner[k][0] == 0 ? number_near(to, at) : to.add_node(at, to.largest_node_id() + 1);
        }
        to.add_cell(CellType::hexahedron, n, to.largest_cell_id() + 1);
    };
    add_hexahedron(mesh, 8);
    const Index number = mesh.largest_cell_id();
    // Through the hexahedron itself, and close enough to move its nodes, it becomes tetrahedra.
    for (const double x : {8.5, 7.6}) {
        const Result result = crack(mesh, Plane({x, 0, 0}, {1, 0, 0}));
        EXPECT_EQ(result.report.converted, (std::map<std::string, Index>{{"hexahedron", 1}}));
        EXPECT_EQ(result.mesh.block(CellType::hexahedron).size(), 0);
        EXPECT_TRUE(NumberIndex(result.mesh).cell(number));
    }
    // Far away it is carried through.
    const Result result = crack(mesh, Plane({2.4, 0, 0}, {1, 0.1, 0}));
    EXPECT_EQ(result.mesh.block(CellType::hexahedron).ids, mesh.block(CellType::hexahedron).ids);
    EXPECT_EQ(result.mesh.block(CellType::hexahedron).connectivity, mesh.block(CellType::hexahedron).connectivity);
    for (const Index n : mesh.block(CellType::hexahedron).connectivity)
        EXPECT_EQ(result.mesh.points[n], mesh.points[n]);
}

TEST(CrackErrors, EmptyMesh) {
    expect_error<ToolError>(Mesh(), sound_plane, {}, "empty");
    Mesh nodes_only;
    nodes_only.add_node({0, 0, 0}, 1);
    nodes_only.add_node({6, 0, 0}, 2);
    expect_error<ToolError>(nodes_only, sound_plane, {}, "misses");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
