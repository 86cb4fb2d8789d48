// SPDX-License-Identifier: LGPL-2.1-or-later
#include "crack_checks.h"

#include <algorithm>
#include <cstring>

#include "crack_checker.h"

namespace femscalpel::checks {

std::vector<std::string> CrackChecker::run() {
    try {
        out_.validate();
    } catch (const Error& e) {
        bad_.add("invalid", e.what());
        return bad_.lines();
    }
    index();
    faces_ = tetra_faces(out_);
    if (!numbers_and_nodes()) return bad_.lines();
    far_elements();
    shapes();
    sides();
    if (model_.solid)
        solid_conformity();
    else
        shell_conformity();
    attached();
    lips();
    section();
    groups();
    straightened();
    node_groups();
    report();
    return bad_.lines();
}

std::vector<std::string> check_crack(const Model& model, const CutPlane& plane, const Result& result,
                                     const std::string& name) {
    return CrackChecker(model, plane, result, name).run();
}

bool identical(const Mesh& a, const Mesh& b) {
    const auto same_points = [](const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
        return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(Vec3)) == 0);
    };
    if (!same_points(a.points, b.points) || a.node_ids != b.node_ids || a.name != b.name || a.unit != b.unit ||
        a.companion != b.companion)
        return false;
    for (std::size_t k = 0; k < a.blocks().size(); ++k)
        if (a.blocks()[k].connectivity != b.blocks()[k].connectivity || a.blocks()[k].ids != b.blocks()[k].ids)
            return false;
    if (a.groups.size() != b.groups.size() || a.facets.size() != b.facets.size()) return false;
    for (std::size_t g = 0; g < a.groups.size(); ++g)
        if (a.groups[g].name != b.groups[g].name || a.groups[g].kind != b.groups[g].kind ||
            a.groups[g].hidden != b.groups[g].hidden)
            return false;
    const auto same_family = [&](FamilyIndex x, FamilyIndex y) {
        return std::ranges::equal(a.families.groups(x), b.families.groups(y));
    };
    for (std::size_t n = 0; n < a.node_families.size(); ++n)
        if (!same_family(a.node_families[n], b.node_families[n])) return false;
    for (std::size_t k = 0; k < a.blocks().size(); ++k)
        for (std::size_t c = 0; c < a.blocks()[k].families.size(); ++c)
            if (!same_family(a.blocks()[k].families[c], b.blocks()[k].families[c])) return false;
    for (std::size_t k = 0; k < a.facets.size(); ++k)
        if (a.facets[k].type != b.facets[k].type || a.facets[k].face != b.facets[k].face ||
            a.facets[k].cell != b.facets[k].cell || !same_family(a.facets[k].family, b.facets[k].family))
            return false;
    return true;
}

}  // namespace femscalpel::checks
