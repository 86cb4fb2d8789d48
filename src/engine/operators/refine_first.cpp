// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/refine_first.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace femscalpel {
namespace {

/// Longest edge near a tool, in its smallest radius of curvature: chords are off the tool by at most 3 % of the radius
/// then.
constexpr double edge_per_radius = 0.5;

/// How much longer edges may be per unit of distance from the tool. Bisection keeps shapes sound at any; beyond this,
/// little is saved.
constexpr double steepest_gradation = 1;

/// What refining on its own account may make of a mesh.
constexpr Index most_elements = 2'000'000;

/// A refinement of its own account that makes more elements than a mesh had, and so many more, is worth a word.
constexpr Index many_elements = 2000;

bool is_much(const Refinement& r) {
    return r.elements_after > 2 * r.elements_before && r.elements_after - r.elements_before > many_elements;
}

std::string describe(const Refinement& r) {
    std::ostringstream text;
    text << "the tool is finer than the mesh, which was refined first, to edges of " << r.size
         << " near the tool: from " << r.elements_before << " to " << r.elements_after
         << " elements. refine=" << 2 * r.size << " makes fewer, refine=False none, but then a coarser wall or front";
    return text.str();
}

double checked(double size) {
    if (std::isfinite(size) && size > 0) return size;
    std::ostringstream message;
    message << "refine is " << size << "; it must be a positive length";
    throw ToolError(message.str(), "refine");
}

/// What the operator calls the parameter of refine() that an error is about.
const char* parameter_of_operator(const Error& e) {
    return std::string_view(e.parameter()) == "skin" ? "skin" : "refine";
}

/// One field for all zones, with the smallest of their sizes: a zone of a larger size counts as that much farther away
/// as edges take to grow so long.
DistanceField joined(std::span<const RefineZone> zones, double size, double gradation) {
    return [zones = std::vector<RefineZone>(zones.begin(), zones.end()), size, gradation](const Vec3& x) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const RefineZone& zone : zones) {
            double d = zone.distance(x);
            if (zone.size > size) d = std::abs(d) + (zone.size - size) / gradation;
            if (std::abs(d) < std::abs(nearest)) nearest = d;
        }
        return nearest;
    };
}

bool is_asked_for(const OperatorOptions& options) { return options.refine.when == RefineFirst::When::to_size; }

/// Whether a mesh is to be looked at at all: the method "deform" is there not to add nodes.
bool may_refine(std::span<const RefineZone> zones, const OperatorOptions& options) {
    return !zones.empty() && (is_asked_for(options) || options.method != Method::deform);
}

RefineOptions options_for(std::span<const RefineZone> zones, const OperatorOptions& options) {
    RefineOptions o;
    o.size = std::ranges::min(zones, {}, &RefineZone::size).size;
    o.feature_angle = options.feature_angle;
    o.skin = options.skin;
    o.before = options.before_refining;
    o.finer_advice = "Give `refine` a larger length, or False";
    o.larger_advice.clear();
    if (!is_asked_for(options)) {
        o.max_elements = most_elements;
        o.gradation = steepest_gradation;
    }
    return o;
}

}  // namespace

std::vector<std::int8_t> levels_to_refine(const Mesh& mesh, std::span<const RefineZone> zones,
                                          const OperatorOptions& options) {
    if (!may_refine(zones, options)) return std::vector<std::int8_t>(mesh.points.size(), -1);
    const RefineOptions o = options_for(zones, options);
    return corners_of_long_edges(mesh, joined(zones, o.size, o.gradation), o);
}

std::optional<RefineZone> zone_around(const Tool& tool, std::function<double(const Vec3&)> beyond,
                                      const RefineFirst& refine) {
    if (refine.when == RefineFirst::When::never) return {};
    const double size =
        refine.when == RefineFirst::When::to_size ? checked(refine.size) : edge_per_radius * tool.feature_size();
    if (!std::isfinite(size)) return {};
    return RefineZone{[&tool, beyond = std::move(beyond)](const Vec3& x) {
                          const double off = tool.distance(x), past = beyond ? beyond(x) : 0;
                          return past > 0 ? std::hypot(off, past) : off;
                      },
                      size};
}

std::optional<RefineZone> zone_around(const Tool& tool, const Patch& patch, const RefineFirst& refine) {
    if (refine.when == RefineFirst::When::to_size)
        return RefineZone{
            [&tool, front = patch.distance](const Vec3& x) { return std::hypot(tool.distance(x), front(x)); },
            checked(refine.size)};
    const double size = edge_per_radius * std::min(patch.feature_size, tool.feature_size());
    if (refine.when == RefineFirst::When::never || !std::isfinite(size)) return {};
    return zone_around(tool, patch.distance, {RefineFirst::When::to_size, size});
}

std::optional<Refined> refine_first(const Mesh& mesh, std::span<const RefineZone> zones,
                                    const OperatorOptions& options) {
    if (!may_refine(zones, options)) return {};
    const bool asked = is_asked_for(options);
    const RefineOptions o = options_for(zones, options);
    Refined out;
    try {
        std::optional<Result> result = refine_where_needed(mesh, joined(zones, o.size, o.gradation), o, out.trace);
        if (!result) return {};
        out.mesh = std::move(result->mesh);
        out.report = std::move(result->report);
    } catch (const Error& e) {
        if (asked && dynamic_cast<const ToolError*>(&e))
            throw ToolError(std::string("refine: ") + e.what(), parameter_of_operator(e));
        if (asked || !(dynamic_cast<const ToolError*>(&e) || dynamic_cast<const UnsupportedElementError*>(&e))) throw;
        out.tried_in_vain = true;
        out.report.warnings.push_back(std::string("the mesh is coarser than the tool, but was not refined first: ") +
                                      e.what());
        return out;
    }
    out.summary = Refinement{o.size, mesh.cell_count(), out.mesh.cell_count()};
    out.numbering = next_numbers(mesh);
    out.deck = solver_input(mesh);
    if (!asked && is_much(*out.summary)) out.report.warnings.push_back(describe(*out.summary));
    return out;
}

}  // namespace femscalpel
