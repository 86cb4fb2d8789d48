// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/stress_intensity.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "fracture/crack_lips.h"
#include "fracture/deck_limits.h"
#include "fracture/interaction_integral.h"
#include "fracture/lip_displacements.h"
#include "mesh/outer_faces.h"
#include "short_number.h"

namespace femscalpel {
namespace {

constexpr double edges_to_radius = 3;  // of elements at the front
constexpr double least_radius = 1.5;   // in such edges
constexpr double most_bent = 0.5;      // radius over the front's radius of curvature
constexpr double near_surfaces = 0.9;  // radius over the distance to other surfaces
constexpr double least_plane = 0.05;   // how far lips may leave their plane, over the distance from the front

/// Elements of the mesh's dimension with a node within `reach` of a front.
std::vector<CellRef> elements_around(const Mesh& mesh, const CrackFront& front, double reach) {
    std::vector<char> near(mesh.points.size(), 0);
    Eigen::AlignedBox3d box;
    for (const Vec3& point : front.points()) box.extend(point);
    box.min().array() -= reach;
    box.max().array() += reach;
    CrackFront::Place place;
    for (std::size_t v = 0; v < near.size(); ++v)
        near[v] = box.contains(mesh.points[v]) && front.find(mesh.points[v], reach, place) ? 1 : 0;
    std::vector<CellRef> out;
    for (const CellBlock& block : mesh.blocks()) {
        if (traits(block.type).dimension != mesh.dimension()) continue;
        for (Index cell = 0; cell < block.size(); ++cell)
            if (std::ranges::any_of(block.nodes(cell), [&](Index v) { return near[v] != 0; }))
                out.push_back({block.type, cell});
    }
    return out;
}

/// Nodes of the mesh's surface that are not on the crack's lips.
std::vector<Index> other_surface(const Mesh& mesh, const CrackLips& lips, const Eigen::AlignedBox3d& box) {
    std::vector<char> is(mesh.points.size(), 0);
    const OuterFaces outer = outer_faces(mesh, box);
    if (mesh.dimension() == 3) {
        for (const SurfaceFace& face : outer.triangles)
            for (const Index v : face.nodes) is[v] = 1;
    } else {
        for (const OuterFaces::Edge& edge : outer.edges)
            for (const Index v : edge.nodes) is[v] = 1;
    }
    std::vector<Index> out;
    for (Index v = 0; v < mesh.node_count(); ++v)
        if (is[v] && !lips.positive[v] && !lips.negative[v]) out.push_back(v);
    return out;
}

/// Whether a place is beside a front's middle part, and not where it ends.
bool beside(const CrackFront& front, const CrackFront::Place& place, double radius) {
    if (front.closed() || front.length() == 0) return true;
    const double end = std::min(radius / 2, front.length() / 4);
    return place.s > end && place.s < front.length() - end;
}

/// The radius that bends and other surfaces leave, and why it is smaller than asked for; "" where it is not.
double fitting_radius(const Mesh& mesh, const CrackLips& lips, double radius, std::string& why) {
    for (const CrackLips::Line& line : lips.lines) {
        Eigen::AlignedBox3d box;
        for (const Vec3& point : line.front.points()) box.extend(point);
        CrackFront::Place place;
        for (const Vec3& point : line.front.points()) {
            if (!line.front.find(point, radius, place) || place.curvature == 0) continue;
            const double limit = most_bent / std::abs(place.curvature);
            if (limit < radius) radius = limit, why = "the front bends";
        }
        for (const Index v : other_surface(mesh, lips, grown(box, radius))) {
            if (!line.front.find(mesh.points[v], radius, place) || !beside(line.front, place, radius)) continue;
            const double limit = near_surfaces * std::hypot(place.x1, place.x2);
            if (limit < radius)
                radius = limit, why = "another surface, at node " + std::to_string(mesh.node_ids[v]) + ", is near";
        }
    }
    return radius;
}

/// Throws where the lips leave their plane within `radius`.
void check_plane(const Mesh& mesh, const CrackLips& lips, const CrackFront& front, double radius) {
    CrackFront::Place place;
    for (Index v = 0; v < mesh.node_count(); ++v) {
        if (!(lips.positive[v] || lips.negative[v]) || !front.find(mesh.points[v], radius, place)) continue;
        const double r = std::hypot(place.x1, place.x2);
        if (std::abs(place.x2) > least_plane * std::max(r, 0.1 * radius))
            throw Error("the lips are not plane near the front: node " + std::to_string(mesh.node_ids[v]) + " is " +
                            short_number(std::abs(place.x2)) + " off the plane there; a smaller radius may do",
                        "radius");
    }
}

double energy_release(const std::array<double, 3>& k, const Elasticity& elasticity) {
    return (k[0] * k[0] + k[1] * k[1]) / elasticity.effective() + k[2] * k[2] / (2 * elasticity.shear());
}

void check_arguments(const Mesh& mesh, std::span<const Vec3> displacements, const Elasticity& elasticity,
                     double radius) {
    if (displacements.size() != mesh.points.size())
        throw Error("displacements of " + std::to_string(displacements.size()) +
                        " nodes do not fit the mesh, which has " + std::to_string(mesh.points.size()),
                    "displacements");
    for (std::size_t v = 0; v < displacements.size(); ++v)
        if (!displacements[v].allFinite())
            throw Error("the displacement of node " + std::to_string(mesh.node_ids[v]) + " is no number",
                        "displacements");
    if (!(elasticity.young > 0) || !std::isfinite(elasticity.young)) throw Error("young must be positive", "young");
    if (!(elasticity.poisson > -1 && elasticity.poisson < 0.5))
        throw Error("poisson must lie between -1 and 0.5", "poisson");
    if (!(radius >= 0) || !std::isfinite(radius)) throw Error("radius must be positive", "radius");
}

}  // namespace

StressIntensity stress_intensity(const Mesh& mesh, std::span<const Vec3> displacements, const std::string& front,
                                 const Elasticity& elasticity, double radius) {
    check_arguments(mesh, displacements, elasticity, radius);
    check_deck_for_fracture(mesh, crack_name(front));
    const CrackLips lips = crack_lips(mesh, front);
    StressIntensity out;
    out.edge = lips.edge;
    std::string why;
    out.radius = fitting_radius(mesh, lips, radius > 0 ? radius : edges_to_radius * lips.edge, why);
    if (radius > 0 && !why.empty())
        throw Error("radius " + short_number(radius) + " is too large: " + why + "; the largest that fits is " +
                        short_number(out.radius),
                    "radius");
    if (out.radius < least_radius * lips.edge)
        out.warnings.push_back("the domain around the front is only " + short_number(out.radius / lips.edge) +
                               " element edges wide, as " + (why.empty() ? "asked for" : why) +
                               ": K is rough; refine the mesh at the front");
    for (std::size_t f = 0; f < lips.lines.size(); ++f) {
        const auto& [line, nodes] = lips.lines[f];
        check_plane(mesh, lips, line, out.radius);
        const std::vector<CellRef> elements = elements_around(mesh, line, out.radius + lips.edge);
        std::vector<double> places(line.s().begin(), line.s().begin() + static_cast<std::ptrdiff_t>(nodes.size()));
        const double along = std::max(2 * lips.edge, line.length() / static_cast<double>(nodes.size()));
        const auto at = [&](double outer) {
            return interaction_integrals(mesh, displacements, elements, line, places, {outer / 3, outer, along},
                                         elasticity);
        };
        const auto k = at(out.radius), inside = at(out.radius * 2 / 3);
        const auto by_lips = lip_displacements(mesh, displacements, lips, line, places, out.radius, along, elasticity);
        for (std::size_t v = 0; v < nodes.size(); ++v) {
            out.nodes.push_back(nodes[v]);
            out.front.push_back(static_cast<int>(f));
            out.s.push_back(places[v]);
            out.points.push_back(mesh.points[nodes[v]]);
            out.k.push_back(k[v]);
            out.k_inside.push_back(inside[v]);
            out.k_lips.push_back(by_lips[v]);
            out.g.push_back(energy_release(k[v], elasticity));
        }
    }
    const auto closed = std::ranges::count_if(out.k, [](const auto& k) { return k[0] < 0; });
    if (closed > 0)
        out.warnings.push_back("the lips go into each other at " + std::to_string(closed) + " of " +
                               std::to_string(out.k.size()) + " nodes of the front (K1 is negative): they would touch");
    return out;
}

}  // namespace femscalpel
