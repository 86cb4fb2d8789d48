// SPDX-License-Identifier: LGPL-2.1-or-later
// What must hold of holes and cuts, whatever the tool: the same checks on hundreds of random ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>

#include "carve_checks.h"
#include "io/inp.h"
#include "operators/scalpel.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {
namespace {

using namespace checks;

#if defined(__SANITIZE_ADDRESS__)
constexpr int random_tools = 15;
#else
constexpr int random_tools = 300;
#endif
constexpr int described = 6;

struct Subject {
    const char* name;
    bool flat;
    int share = 1;  ///< one in so many of the tools: curved second-order elements take seconds each, or minutes
};

std::ostream& operator<<(std::ostream& out, const Subject& s) { return out << s.name; }

class CarveProperties : public testing::TestWithParam<Subject> {
protected:
    CarveProperties()
        : model_(read_inp(std::string(FEMSCALPEL_TEST_MESHES) + "/" + GetParam().name + ".inp"), GetParam().flat),
          session_(std::make_shared<const Mesh>(model_.mesh)) {
        for (const Model::Face& face : model_.skin) edge_ += face.edge / static_cast<double>(model_.skin.size());
    }

    Vec3 random_point(Random& random) const {
        Vec3 out;
        for (int a = 0; a < 3; ++a) out[a] = random.uniform(model_.low[a], model_.high[a]);
        return out;
    }

    /// Runs `attempt` (returns a result and what was to be carved) on random tools; counts and prints.
    void try_many(const char* what, std::uint64_t seed, auto attempt) {
        const int tools = std::max(1, random_tools / GetParam().share);
        Random random(seed);
        int valid = 0, refused = 0, failed = 0, good = 0;
        double worst = 1;
        std::map<std::string, int> reasons;
        const Mesh before = model_.mesh;
        for (int k = 0; k < tools; ++k) {
            try {
                const auto [result, carved, text] = attempt(random);
                const std::vector<std::string> findings = check_carved(model_, carved, result);
                if (!findings.empty() && ++failed <= described) ADD_FAILURE() << what << " " << k << ", " << text << ": " << testing::PrintToString(findings);
                const double quality = result.report.quality_after.minimum;
                valid += findings.empty();
                good += quality >= std::min(0.25, result.report.quality_before.minimum);
                worst = std::min(worst, quality);
                if (quality < 0.1) std::cout << "  " << what << " " << k << ", " << text << ": quality " << quality << "\n";
            } catch (const ToolError& e) {
                ++refused;
                ++reasons[std::string(e.what()).substr(0, 45)];
            } catch (const QualityError& e) {
                ++refused;
                ++reasons[std::string(e.what()).substr(0, 45)];
            }
        }
        EXPECT_TRUE(identical(model_.mesh, before) && identical(session_.mesh(), before)) << "the input was changed";
        EXPECT_GT(valid, tools / 3);
        std::cout << std::setprecision(3) << "[  QUALITY ] " << GetParam().name << ", " << what << ": " << valid << " of " << tools << " valid, " << refused
                  << " refused, " << failed << " fail; minimum " << worst << ", mean ratio >= 0.25 (or the input's) in " << good << "\n";
        for (const auto& [reason, count] : reasons) std::cout << "             " << count << " x " << reason << "...\n";
    }

    Model model_;
    Scalpel session_;
    double edge_ = 0;  ///< mean edge length of the skin
};

INSTANTIATE_TEST_SUITE_P(Meshes, CarveProperties,
                         testing::Values(Subject{"two_boxes", true}, Subject{"flanged_cylinder", false}, Subject{"l_shape", true},
                                         Subject{"quadratic_elbow", false, 10}, Subject{"caisson_shell", true}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(CarveProperties, ThroughHoles) {
    try_many("through hole", 5, [&](Random& random) {
        const Vec3 origin = random_point(random), axis = random.direction();
        const Cylinder cylinder(origin, axis, random.uniform(0.5, 4) * edge_);
        const Tool* tool = &cylinder;
        Result result = session_.drill({&tool, 1});
        std::ostringstream text;
        text << std::setprecision(17) << "origin (" << origin.transpose() << ") axis (" << axis.transpose() << ") radius " << cylinder.radius();
        const auto distance = [=](const Vec3& x) {
            const Vec3 r = x - origin;
            return (r - axis.dot(r) * axis).norm() - cylinder.radius();
        };
        return std::tuple(std::move(result), Carved{distance, {{"HOLE_WALL", distance}}, 1 / (8 * cylinder.radius())}, text.str());
    });
}

}  // namespace
}  // namespace femscalpel
