// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/curved_rim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "cancel.h"
#include "deformation/curved_shape.h"
#include "deformation/foot.h"
#include "mesh/middles.h"
#include "mesh/surface.h"

namespace femscalpel {
namespace {

/// An edge runs along a curved face if its ends and its middle are no farther off it than this, in its length.
constexpr double along_face = 0.3;
/// Nearer than this, in an edge's length, is on it.
constexpr double on_face = 1e-7;
/// Steps to where a face meets a plane, at most.
constexpr int most_steps = 60;

using CurvedFacet = KeptGeometry::Facet;

/// The curved faces of a mesh's skin in a box.
std::vector<CurvedFacet> curved_faces(const Mesh& mesh, const Eigen::AlignedBox3d& box) {
    const std::vector<SurfaceFace> faces = surface_near(mesh, box);
    std::unordered_map<std::uint64_t, Index> sides;
    for (const SurfaceFace& f : faces)
        for (std::size_t k = 0; k < 3; ++k) sides.emplace(mesh_edge_key(f.nodes[k], f.nodes[(k + 1) % 3]), -1);
    for (const auto& [key, middle] :
         middles_of(mesh, [&](Index a, Index b) { return sides.contains(mesh_edge_key(a, b)); }))
        sides[key] = middle;
    std::vector<CurvedFacet> out;
    for (const SurfaceFace& f : faces) {
        CurvedFacet facet;
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = f.nodes[k], b = f.nodes[(k + 1) % 3], m = sides.at(mesh_edge_key(a, b));
            const Vec3 chord = (mesh.points[a] + mesh.points[b]) / 2;
            facet.corner[k] = mesh.points[a];
            facet.mid[k] = m < 0 ? chord : mesh.points[m];
            facet.sag += (facet.mid[k] - chord).norm();
            longest = std::max(longest, (mesh.points[a] - mesh.points[b]).norm());
        }
        const Vec3 normal = (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]).normalized();
        double out_of_plane = 0;
        for (const Vec3& m : facet.mid)
            out_of_plane = std::max(out_of_plane, std::abs(normal.dot(m - facet.corner[0])));
        facet.centre = (facet.corner[0] + facet.corner[1] + facet.corner[2]) / 3;
        facet.radius = longest + facet.sag;
        facet.curved = true;
        if (out_of_plane > on_face * longest) out.push_back(facet);
    }
    return out;
}

/// One call of bend_rim().
class Bender {
public:
    Bender(const Mesh& own, Mesh& first, Mesh& second, std::span<const CommonEdge> edges)
        : meshes_{&first, &second}, edges_(edges) {
        Eigen::AlignedBox3d box;
        for (const CommonEdge& e : edges)
            for (const Index n : e.ends[0]) box.extend(first.points[n]);
        const Eigen::AlignedBox3d there = grown(box, 1e-3 * box.diagonal().norm());
        faces_ = curved_faces(own, there);
        if (faces_.empty()) return;
        for (const std::size_t m : {0U, 1U}) find_elements(m);
        for (const SurfaceFace& f : surface_near(first, there)) find_normals(f);
    }

    BentRim run() {
        BentRim out;
        SparseCheck check(16);
        for (const CommonEdge& e : edges_) {
            check();
            const auto ours = middle(0, e), theirs = middle(1, e);
            if (faces_.empty() || !ours || !theirs) continue;
            const Vec3 &a = meshes_[0]->points[e.ends[0][0]], &b = meshes_[0]->points[e.ends[0][1]];
            const double length = (a - b).norm(), off = distance(meshes_[0]->points[*ours]);
            if (off <= on_face * length || std::max({off, distance(a), distance(b)}) > along_face * length) continue;
            const auto x = place(e, *ours, length);
            if (x && bend({*ours, *theirs}, *x)) {
                ++out.bent;
                continue;
            }
            ++out.straight;
            out.largest = std::max(out.largest, off);
        }
        return out;
    }

private:
    static std::uint64_t key(const std::array<Index, 2>& ends) { return mesh_edge_key(ends[0], ends[1]); }

    /// The mid-side nodes of the edges in mesh m, and the elements that have them.
    void find_elements(std::size_t m) {
        for (const CommonEdge& e : edges_) middles_[m].emplace(key(e.ends[m]), -1);
        const Mesh& mesh = *meshes_[m];
        for (const CellBlock& b : mesh.blocks()) {
            const CellTraits& t = traits(b.type);
            if (!t.quadratic || t.dimension < 2) continue;
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                for (std::size_t k = 0; k < t.edges.size(); ++k) {
                    const auto edge = middles_[m].find(mesh_edge_key(n[t.edges[k][0]], n[t.edges[k][1]]));
                    if (edge == middles_[m].end()) continue;
                    edge->second = n[t.corners + k];
                    around_[m][edge->second].push_back({b.type, c});
                }
            }
        }
    }

    /// Of faces of the first mesh that have such an edge.
    void find_normals(const SurfaceFace& f) {
        const auto& x = meshes_[0]->points;
        const Vec3 normal = (x[f.nodes[1]] - x[f.nodes[0]]).cross(x[f.nodes[2]] - x[f.nodes[0]]).normalized();
        for (std::size_t k = 0; k < 3; ++k)
            if (const std::uint64_t edge = mesh_edge_key(f.nodes[k], f.nodes[(k + 1) % 3]); middles_[0].contains(edge))
                normals_[edge].push_back(normal);
    }

    std::optional<Index> middle(std::size_t m, const CommonEdge& e) const {
        const auto found = middles_[m].find(key(e.ends[m]));
        if (found == middles_[m].end() || found->second < 0) return {};
        return found->second;
    }

    Foot closest(const Vec3& x) const {
        Foot out;
        out.distance2 = std::numeric_limits<double>::infinity();
        for (const CurvedFacet& f : faces_) {
            if ((x - f.centre).norm() - f.radius > std::sqrt(out.distance2)) continue;
            if (const Foot foot = foot_on(f, x, out.distance2); foot.distance2 < out.distance2) out = foot;
        }
        return out;
    }
    double distance(const Vec3& x) const { return std::sqrt(closest(x).distance2); }

    /// Where the curved faces meet the plane of the first mesh's surface beside an edge; nothing if that is no plane,
    /// or its edge is not straight.
    std::optional<Vec3> place(const CommonEdge& e, Index ours, double length) const {
        const auto normals = normals_.find(key(e.ends[0]));
        if (e.bound || normals == normals_.end()) return {};
        const Vec3& normal = normals->second.front();
        for (const Vec3& n : normals->second)
            if (n.cross(normal).norm() > on_face) return {};
        const Vec3 &a = meshes_[0]->points[e.ends[0][0]], &b = meshes_[0]->points[e.ends[0][1]], chord = (a + b) / 2;
        if ((meshes_[0]->points[ours] - chord).norm() > on_face * length) return {};
        Vec3 x = chord;
        for (int step = 0; step < most_steps; ++step) {
            const Foot foot = closest(x);
            if (foot.distance2 <= std::pow(1e-3 * on_face * length, 2)) break;
            x = foot.at - normal.dot(foot.at - chord) * normal;
        }
        if (distance(x) > on_face * length || (x - chord).norm() > along_face * length) return {};
        return x;
    }

    /// Moves the mid-side nodes of both meshes; not if elements would be spoiled.
    bool bend(const std::array<Index, 2>& middles, const Vec3& x) {
        const std::array<Vec3, 2> before{meshes_[0]->points[middles[0]], meshes_[1]->points[middles[1]]};
        for (const std::size_t m : {0U, 1U}) meshes_[m]->points[middles[m]] = x;
        if (is_sound(0, middles[0]) && is_sound(1, middles[1])) return true;
        for (const std::size_t m : {0U, 1U}) meshes_[m]->points[middles[m]] = before[m];
        return false;
    }

    bool is_sound(std::size_t m, Index middle) const {
        const Mesh& mesh = *meshes_[m];
        return std::ranges::all_of(around_[m].at(middle), [&](const CellRef& c) {
            if (c.type != CellType::tetra10 && c.type != CellType::triangle6) return false;
            std::vector<Vec3> points;
            for (const Index n : mesh.block(c.type).nodes(c.cell)) points.push_back(mesh.points[n]);
            return curved_ratio(points) >= curved_limit;
        });
    }

    std::array<Mesh*, 2> meshes_;
    std::span<const CommonEdge> edges_;
    std::vector<CurvedFacet> faces_;
    std::array<std::unordered_map<std::uint64_t, Index>, 2> middles_;  // by edge
    std::array<std::unordered_map<Index, std::vector<CellRef>>, 2> around_;
    std::unordered_map<std::uint64_t, std::vector<Vec3>> normals_;  // by edge of the first mesh
};

}  // namespace

BentRim bend_rim(const Mesh& own, Mesh& first, Mesh& second, std::span<const CommonEdge> edges) {
    if (edges.empty()) return {};
    return Bender(own, first, second, edges).run();
}

}  // namespace femscalpel
