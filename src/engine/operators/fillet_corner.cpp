// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_corner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "cutting/inner_node.h"
#include "cutting/planar_mesh.h"
#include "cutting/removal.h"
#include "cutting/surface_line.h"
#include "operators/fillet_inside.h"

namespace femscalpel {
namespace {

using Edge = std::array<int, 2>;

[[noreturn]] void refuse(const std::string& text, const Vec3& near) {
    std::ostringstream message;
    message << "the corner cannot be rounded near (" << near.transpose() << "): " << text;
    throw QualityError(message.str());
}

[[noreturn]] void refuse_along(const std::string& text) { throw ToolError("along: " + text, "along"); }

/// The outline of the mesh's elements: the next node of each, with the material on the left.
class Outline {
public:
    explicit Outline(const Mesh& mesh) : mesh_(mesh), slack_(mesh) {
        std::set<std::array<Index, 2>> edges;
        double normal_off = 0;
        for (const CellBlock& b : mesh.blocks()) {
            if (traits(b.type).dimension != 2) continue;
            const int corners = traits(b.type).corners;
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                const Vec3 turned =
                    (mesh.points[n[1]] - mesh.points[n[0]]).cross(mesh.points[n[corners - 1]] - mesh.points[n[0]]);
                const double off = slack_.normal(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[corners - 1]]);
                if (normal.isZero() || off < normal_off) {
                    normal = turned.normalized();
                    normal_off = off;
                }
                if ((turned.normalized() - normal).norm() > 1.4e-3 + off + normal_off)
                    refuse_along(
                        "the mesh is not plane, or its elements are not turned all the same way; edges of "
                        "curved shells are not rounded");
                for (int k = 0; k < corners; ++k) edges.insert({n[k], n[(k + 1) % corners]});
            }
        }
        for (const auto& [a, b] : edges)
            if (!edges.contains({b, a})) {
                next_[a].push_back(b);
                before_[b].push_back(a);
            }
    }

    std::vector<Index> corners(double feature_angle) const {
        const double limit = std::cos(feature_angle * std::numbers::pi / 180);
        std::vector<Index> out;
        for (const auto& [node, following] : next_) {
            const auto previous = before_.find(node);
            if (following.size() != 1 || previous == before_.end() || previous->second.size() != 1) continue;
            if (direction(previous->second[0], node).dot(direction(node, following[0])) < limit) out.push_back(node);
        }
        return out;
    }

    OutlineCorner corner(Index node) const {
        const Index following = next_.at(node)[0], previous = before_.at(node)[0];
        OutlineCorner out{node, normal, {direction(node, following), direction(node, previous)}, {}, true};
        out.convex = out.along[0].cross(out.along[1]).dot(normal) > 0;
        out.room = {room(node, out.along[0], next_), room(node, out.along[1], before_)};
        return out;
    }

    /// Of the longer of the outline's edges at a corner.
    double edge_length(Index corner) const {
        const Vec3& x = mesh_.points[corner];
        return std::max((mesh_.points[next_.at(corner)[0]] - x).norm(),
                        (mesh_.points[before_.at(corner)[0]] - x).norm());
    }

    Vec3 normal = Vec3::Zero();

private:
    using Links = std::map<Index, std::vector<Index>>;

    Vec3 direction(Index a, Index b) const { return (mesh_.points[b] - mesh_.points[a]).normalized(); }

    double room(Index from, const Vec3& along, const Links& links) const {
        Index node = from;
        double length = 0;
        const double off = slack_.direction((mesh_.points[links.at(from)[0]] - mesh_.points[from]).norm());
        for (std::size_t k = 0; k <= links.size(); ++k) {
            const auto found = links.find(node);
            if (found == links.end() || found->second.size() != 1) break;
            const Vec3 step = mesh_.points[found->second[0]] - mesh_.points[node];
            if ((step.normalized() - along).norm() > 1.4e-4 + slack_.direction(step.norm()) + off) break;
            length += step.norm();
            node = found->second[0];
        }
        return length;
    }

    const Mesh& mesh_;
    CoordinateSlack slack_;
    Links next_, before_;
};

std::set<Index> named_nodes(const Mesh& mesh, const Along& along) {
    std::set<Index> nodes;
    if (!along.group.empty()) {
        const auto group = mesh.find_group(along.group, GroupKind::node);
        if (!group) refuse_along("the mesh has no node group '" + along.group + "'");
        for (Index n = 0; n < mesh.node_count(); ++n)
            if (mesh.families.contains(mesh.node_families[n], *group)) nodes.insert(n);
    }
    if (!along.nodes.empty()) {
        const NumberIndex numbers(mesh);
        for (const Index id : along.nodes) {
            const auto n = numbers.node(id);
            if (!n) refuse_along("the mesh has no node " + std::to_string(id));
            nodes.insert(*n);
        }
    }
    return nodes;
}

}  // namespace

std::vector<OutlineCorner> find_outline_corners(const Mesh& mesh, const Along& along, double feature_angle) {
    const Outline outline(mesh);
    const std::vector<Index> all = outline.corners(feature_angle);
    std::set<Index> wanted;
    if (along.points.empty()) {
        const std::set<Index> named = named_nodes(mesh, along);
        std::ranges::copy_if(all, std::inserter(wanted, wanted.end()), [&](Index n) { return named.contains(n); });
    } else if (!all.empty()) {
        for (const Vec3& x : along.points) {
            const Index nearest =
                *std::ranges::min_element(all, {}, [&](Index n) { return (mesh.points[n] - x).squaredNorm(); });
            if ((mesh.points[nearest] - x).norm() > outline.edge_length(nearest))
                refuse_along("no corner of the mesh's outline is within an edge length of the point " + point_text(x) +
                             ": the nearest is " + point_text(mesh.points[nearest]) + ". Name a point at the corner");
            wanted.insert(nearest);
        }
    }
    if (wanted.empty())
        refuse_along("no corner of the mesh's outline (of more than feature_angle) is named: nothing to be rounded");
    std::vector<OutlineCorner> out;
    out.reserve(wanted.size());
    for (const Index n : wanted) out.push_back(outline.corner(n));
    return out;
}

FilletCorner::FilletCorner(Workpiece& workpiece, const Mesh& mesh, const FilletPath& path, double reach)
    : f_(workpiece), mesh_(mesh), path_(path), reach_(reach) {}

void FilletCorner::replace(int tag) {
    collect();
    find_outline();
    fill(tag);
    remove_shells(f_, removed_);
}

void FilletCorner::collect() {
    const BandMesh& band = f_.d.band;
    removed_ = elements_inside(f_, band.triangles, path_, reach_, close());
    if (removed_.empty()) refuse("no element lies there", path_.at(0, Vec2::Zero()));
    const auto family = [&](int t) {
        const CellRef& c = band.triangle_cells[band.triangles.origin(t)];
        return mesh_.block(c.type).families[c.cell];
    };
    for (const int t : removed_) {
        centres_.push_back(middle_of(band, band.triangles[t]));
        if (family(t) != family(removed_[0]))
            refuse("elements of different groups meet there, whose border would be lost", centres_.back());
    }
}

void FilletCorner::find_outline() {
    const BandMesh& band = f_.d.band;
    std::set<Edge> edges;
    for (const int t : removed_)
        for (int k = 0; k < 3; ++k) edges.insert({band.triangles[t][k], band.triangles[t][(k + 1) % 3]});
    std::map<int, int> next;
    std::array<int, 2> ends{-1, -1};
    std::array<double, 2> nearest{close(), close()};
    for (const auto& [a, b] : edges) {
        for (const int side : {0, 1})
            for (const int v : {a, b}) {
                const double off = (path_.place(at(v)).p - path_.tangent_point(side)).norm();
                if (off >= nearest[side]) continue;
                nearest[side] = off;
                ends[side] = v;
            }
        if (edges.contains({b, a})) {
            if (band.creases.find({a, b}) >= 0)
                refuse("a border of groups, or another line that is kept, runs through the elements there", at(a));
            continue;
        }
        const bool on_outline = std::ranges::any_of(std::array{0, 1}, [&](int side) {
            return std::ranges::all_of(std::array{a, b}, [&](int v) {
                const Vec2 p = path_.place(at(v)).p;
                return std::abs(p.dot(path_.normal(side))) <= close() && p.dot(path_.along_face(side)) >= -close();
            });
        });
        if (on_outline) continue;
        if (!next.emplace(a, b).second) refuse("the elements there are only joined at a point", at(a));
    }
    if (ends[0] < 0 || ends[1] < 0)
        refuse("the outline could not be divided where the ball touches it", path_.at(0, path_.tangent_point(0)));
    for (const auto& [from, to] : {std::pair(ends[0], ends[1]), std::pair(ends[1], ends[0])}) {
        outline_ = {from};
        while (next.contains(outline_.back()) && outline_.size() <= next.size())
            outline_.push_back(next[outline_.back()]);
        if (outline_.back() == to && outline_.size() == next.size() + 1) return;
    }
    refuse("the part is too narrow there, or has a hole", path_.at(0, Vec2::Zero()));
}

void FilletCorner::fill(int tag) {
    BandMesh& band = f_.d.band;
    const Triangle& one = band.triangles[removed_[0]];
    const Vec3 normal = (at(one[1]) - at(one[0])).cross(at(one[2]) - at(one[0])).normalized();
    double length = 0;
    for (std::size_t k = 1; k < outline_.size(); ++k) length += (at(outline_[k]) - at(outline_[k - 1])).norm();
    const double spacing = length / static_cast<double>(outline_.size() - 1);
    const int divisions = std::max({4, static_cast<int>(std::lround(path_.arc_length() / spacing)),
                                    static_cast<int>(std::ceil(path_.arc_angle() / (std::numbers::pi / 16) - 1e-6))});
    const bool begins_at_first =
        (path_.place(at(outline_.front())).p - path_.tangent_point(0)).norm() < 1e-3 * path_.radius() + close();
    std::vector<int> arc{outline_.back()};
    for (int k = 1; k < divisions; ++k) {
        // The outline ends where the arc begins, which leads back to where the outline began.
        const double angle = path_.arc_angle() * (begins_at_first ? divisions - k : k) / divisions;
        const Vec3 x = path_.at(path_.place(at(outline_[0])).s, path_.arc(angle));
        arc.push_back(add_inner_node(f_, x, &path_.ball(), true, band.triangles[removed_[parent(x)]]));
    }
    std::vector<int> nodes = outline_;
    nodes.insert(nodes.end(), arc.begin() + 1, arc.end());
    arc.push_back(outline_.front());

    const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u), origin = at(nodes[0]);
    std::vector<Vec2> points;
    points.reserve(nodes.size());
    for (const int v : nodes) points.emplace_back(u.dot(at(v) - origin), w.dot(at(v) - origin));
    const std::vector<Vec2> inside = points_inside(points, 0.5 * (spacing + path_.arc_length() / divisions));
    const std::vector<Triangle> triangles = triangulate(points, inside);
    const std::size_t given = points.size();
    points.insert(points.end(), inside.begin(), inside.end());
    smooth(points, given, triangles, 10);
    for (std::size_t k = given; k < points.size(); ++k) {
        const Vec3 x = origin + points[k].x() * u + points[k].y() * w;
        nodes.push_back(add_inner_node(f_, x, {}, false, band.triangles[removed_[parent(x)]]));
    }
    std::map<Edge, int> at_edge;
    for (const int t : removed_)
        for (int k = 0; k < 3; ++k) at_edge[{band.triangles[t][k], band.triangles[t][(k + 1) % 3]}] = t;
    for (const Triangle& t : triangles) {
        const Triangle fresh{nodes[t[0]], nodes[t[1]], nodes[t[2]]};
        const Vec3 middle = (at(fresh[0]) + at(fresh[1]) + at(fresh[2])) / 3;
        int of = removed_[parent(middle)];
        // Facets on the outline stay with the element they are of.
        for (int k = 0; k < 3; ++k)
            if (const auto found = at_edge.find({fresh[k], fresh[(k + 1) % 3]}); found != at_edge.end())
                of = found->second;
        band.triangles.add_part(fresh, of);
        f_.taken.push_back({band.triangle_cells[band.triangles.origin(of)],
                            -(at(fresh[1]) - at(fresh[0])).cross(at(fresh[2]) - at(fresh[0])).norm() / 2});
    }
    for (std::size_t k = 1; k < arc.size(); ++k) band.cut_edges.add({arc[k - 1], arc[k]}, tag);
    for (const int v : {outline_.front(), outline_.back()}) f_.d.contact[v] = &path_.ball();
}

int FilletCorner::parent(const Vec3& x) const {
    const auto nearest = std::ranges::min_element(centres_, {}, [&](const Vec3& c) { return (c - x).squaredNorm(); });
    return static_cast<int>(nearest - centres_.begin());
}

}  // namespace femscalpel
