// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a FilletCavity makes where edges meet.
#include <algorithm>
#include <array>
#include <cmath>

#include "cutting/inner_node.h"
#include "operators/fillet_cavity.h"

namespace femscalpel {
namespace {

/// A part of a sphere as seen from the point opposite its middle: the stereographic projection, which keeps angles.
class Projection {
public:
    Projection(const Vec3& centre, double radius, const Vec3& middle)
        : centre_(centre), radius_(radius), middle_(middle), u_(middle.unitOrthogonal()), w_(middle.cross(u_)) {}

    Vec2 onto_plane(const Vec3& x) const {
        const Vec3 d = (x - centre_).normalized();
        return Vec2(d.dot(u_), d.dot(w_)) / (1 + d.dot(middle_));
    }
    Vec3 onto_sphere(const Vec2& p) const {
        const double q = p.squaredNorm();
        return centre_ + radius_ / (1 + q) * ((1 - q) * middle_ + 2 * (p.x() * u_ + p.y() * w_));
    }

private:
    Vec3 centre_;
    double radius_;
    Vec3 middle_, u_, w_;
};

/// Three chains of nodes, each in either direction, as one closed outline.
std::vector<int> joined(std::vector<std::vector<int>> chains) {
    std::vector<int> outline = std::move(chains[0]);
    for (int k = 0; k < 2; ++k)
        for (auto& chain : chains) {
            if (chain.empty()) continue;
            if (chain.back() == outline.back()) std::ranges::reverse(chain);
            if (chain.front() != outline.back()) continue;
            outline.insert(outline.end(), chain.begin() + 1, chain.end());
            chain.clear();
        }
    if (outline.front() != outline.back()) return {};
    outline.pop_back();
    return outline;
}

}  // namespace

/// The triangle of the ball at a corner where three edges meet.
void FilletCavity::mesh_sphere(const FilletVertex& vertex) {
    std::vector<std::vector<int>> arcs;
    arcs.reserve(vertex.members.size());
    for (const auto& [edge, which] : vertex.members) arcs.push_back(runs_[edge].arc_at(which));
    const int domain = runs_[vertex.members[0].edge].domains_at_end(vertex.members[0].which)[0];
    const std::vector<int> outline = joined(arcs);
    if (outline.empty()) material_.refuse("the tangent lines do not meet at the corner", vertex.at);

    Vec3 middle = Vec3::Zero();
    double length = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) middle += (material_.at(outline[k]) - vertex.centre).normalized();
    const Projection projection(vertex.centre, vertex.sphere->radius(), middle.normalized());
    std::vector<int> nodes = outline;
    std::vector<Vec2> points;
    points.reserve(nodes.size());
    for (const int v : nodes) points.push_back(projection.onto_plane(material_.at(v)));
    if (polygon_area(points) < 0) {
        std::ranges::reverse(points);
        std::ranges::reverse(nodes);
    }
    for (std::size_t k = 0; k < points.size(); ++k) length += (points[(k + 1) % points.size()] - points[k]).norm();
    const std::vector<Vec2> inside = points_inside(points, length / static_cast<double>(points.size()));
    const std::vector<Triangle> triangles = triangulate(points, inside);
    const std::size_t given = points.size();
    points.insert(points.end(), inside.begin(), inside.end());
    smooth(points, given, triangles, 10);
    for (std::size_t k = given; k < points.size(); ++k) {
        const Vec3 x = projection.onto_sphere(points[k]);
        nodes.push_back(add_inner_node(f_, x, vertex.sphere.get(), true, material_.nodes_near(x)));
    }
    const bool convex = runs_[vertex.members[0].edge].path().convex();
    for (const Triangle& t : triangles) {
        Triangle face{nodes[t[0]], nodes[t[1]], nodes[t[2]]};
        const bool outwards = material_.normal(face).dot(material_.at(face[0]) - vertex.centre) > 0;
        if (outwards != convex) std::swap(face[1], face[2]);
        spheres_.push_back({face, domain});
    }
}

/// Nodes where new faces meet are on both. A contact with a cylinder and a ball, which only touch, says nothing of the
/// middle of an edge between two such nodes: this is given.
void FilletCavity::touch_at_vertices() {
    for (const FilletVertex& vertex : vertices_)
        for (const auto& [edge, which] : vertex.members) {
            const FilletRun& run = runs_[edge];
            const std::vector<int>& arc = run.arc_at(which);
            for (const int v : arc) touch(v, run.path().ball());
            if (!vertex.sphere) continue;
            for (std::size_t k = 0; k < arc.size(); ++k) {
                f_.d.contact[arc[k]] = f_.d.contact[arc[k]].with(vertex.sphere.get());
                if (k == 0 || !f_.d.mids.any()) continue;
                const Vec3 chord = (material_.at(arc[k - 1]) + material_.at(arc[k])) / 2,
                           middle = vertex.sphere->project(chord);
                middles_.insert_or_assign(edge_key(arc[k - 1], arc[k]), middle);
                f_.d.mids.set_bulge(arc[k - 1], arc[k], middle - chord);
            }
        }
}

}  // namespace femscalpel
