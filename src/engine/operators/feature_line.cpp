// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/feature_line.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <unordered_map>

#include "cancel.h"
#include "cutting/conversion.h"
#include "cutting/surface_line.h"
#include "groups/unknown_group.h"
#include "mesh/band_mesh.h"
#include "operators/coordinate_slack.h"

namespace femscalpel {
namespace {

using SkinTriangle = std::array<Index, 3>;

/// Faces whose normals are so far along a line lie across it.
constexpr double across = 0.3;
/// Two edges of a line that turns by more are not one line: a circle of eight segments still is.
const double largest_turn = std::cos(50 * std::numbers::pi / 180);

Vec3 normal(const Mesh& mesh, const SkinTriangle& f) {
    return (mesh.points[f[1]] - mesh.points[f[0]]).cross(mesh.points[f[2]] - mesh.points[f[0]]).normalized();
}

/// The edges of the skin that are feature lines.
class FeatureEdges {
public:
    struct Edge {
        std::array<Index, 2> ends;
        std::array<SkinTriangle, 2> faces;  // the first runs from ends[0] to ends[1]
    };

    FeatureEdges(const Mesh& mesh, double feature_angle) : mesh_(mesh) {
        const std::vector<SkinTriangle> skin = skin_of(mesh);
        std::map<std::array<Index, 2>, SkinTriangle> side;
        for (const SkinTriangle& f : skin)
            for (int k = 0; k < 3; ++k) side[{f[k], f[(k + 1) % 3]}] = f;
        const double limit = std::cos(feature_angle * std::numbers::pi / 180);
        SparseCheck check;
        for (const auto& [ends, face] : side) {
            check();
            if (ends[0] > ends[1]) continue;
            const auto other = side.find({ends[1], ends[0]});
            if (other == side.end()) continue;
            if (normal(mesh, face).dot(normal(mesh, other->second)) >= limit) continue;
            for (const Index n : ends) at_[n].push_back(static_cast<int>(edges.size()));
            edges.push_back({ends, {face, other->second}});
        }
    }

    /// The one edge that goes on from an edge at its end `node`, if the line does.
    std::optional<int> next(int edge, Index node) const {
        const std::vector<int>& all = at_.at(node);
        if (all.size() != 2) return {};
        const int other = all[0] == edge ? all[1] : all[0];
        const Vec3 in = mesh_.points[node] - mesh_.points[far_end(edge, node)],
                   out = mesh_.points[far_end(other, node)] - mesh_.points[node];
        if (in.normalized().dot(out.normalized()) < largest_turn) return {};
        return other;
    }

    Index far_end(int edge, Index node) const {
        return edges[edge].ends[0] == node ? edges[edge].ends[1] : edges[edge].ends[0];
    }

    std::vector<Edge> edges;

private:
    const Mesh& mesh_;
    std::unordered_map<Index, std::vector<int>> at_;
};

double distance_to(const Vec3& x, const Vec3& a, const Vec3& b) {
    const double t = std::clamp((b - a).dot(x - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + t * (b - a) - x).norm();
}

/// Edges that `along` names, by index.
class Seeds {
public:
    Seeds(const Mesh& mesh, const Along& along, const FeatureEdges& all) : mesh_(mesh), all_(all) {
        if (!along.group.empty())
            of_group(along.group);
        else if (!along.nodes.empty())
            of_numbers(along.nodes);
        else
            of_points(along.points);
    }

    std::vector<int> edges;

private:
    [[noreturn]] static void refuse(const std::string& text) { throw ToolError("along: " + text, "along"); }

    void of_group(const std::string& name) {
        std::set<Index> nodes;
        bool known = false;
        for (const GroupKind kind : {GroupKind::element, GroupKind::node}) {
            const auto group = mesh_.find_group(name, kind);
            if (!group) continue;
            known = true;
            if (kind == GroupKind::node) {
                for (Index n = 0; n < mesh_.node_count(); ++n)
                    if (mesh_.families.contains(mesh_.node_families[n], *group)) nodes.insert(n);
                continue;
            }
            for (const CellBlock& b : mesh_.blocks())
                for (Index c = 0; c < b.size(); ++c) {
                    if (!mesh_.families.contains(b.families[c], *group)) continue;
                    if (traits(b.type).dimension != 1)
                        refuse("group '" + name +
                               "' has elements other than segments: it is no edge. Name a group of segments or nodes");
                    for (int k = 0; k < 2; ++k) nodes.insert(b.nodes(c)[k]);
                }
        }
        if (!known && mesh_.find_group(name))
            refuse("group '" + name + "' is one of facets: it is no edge. Name a group of segments or nodes");
        if (!known) refuse(no_group_text(mesh_, name));
        if (nodes.empty()) refuse("group '" + name + "' is empty");
        between(nodes, "group '" + name + "' is");
    }

    void of_numbers(const std::vector<Index>& ids) {
        const NumberIndex numbers(mesh_);
        std::set<Index> nodes;
        for (const Index id : ids) {
            const auto n = numbers.node(id);
            if (!n) refuse("the mesh has no node " + std::to_string(id));
            nodes.insert(*n);
        }
        between(nodes, "the nodes named are");
    }

    void between(const std::set<Index>& nodes, const std::string& what) {
        for (int e = 0; e < static_cast<int>(all_.edges.size()); ++e)
            if (nodes.contains(all_.edges[e].ends[0]) && nodes.contains(all_.edges[e].ends[1])) edges.push_back(e);
        if (edges.empty())
            refuse(what + " no edge: no feature line of the skin (sharper than feature_angle) runs along it");
    }

    void of_points(const std::vector<Vec3>& points) {
        if (points.empty()) refuse("nothing is named");
        if (all_.edges.empty()) refuse("the skin has no feature line (edges sharper than feature_angle)");
        for (const Vec3& x : points) {
            int best = 0;
            double nearest = std::numeric_limits<double>::infinity();
            for (int e = 0; e < static_cast<int>(all_.edges.size()); ++e) {
                const auto& [a, b] = all_.edges[e].ends;
                const double d = distance_to(x, mesh_.points[a], mesh_.points[b]);
                if (d >= nearest) continue;
                nearest = d;
                best = e;
            }
            const auto& [a, b] = all_.edges[best].ends;
            if (nearest > (mesh_.points[b] - mesh_.points[a]).norm())
                refuse("no feature line of the skin is within an edge length of the point " + point_text(x) +
                       ": the nearest is near " + point_text(mesh_.points[a]) + ". Name a point on the edge");
            edges.push_back(best);
        }
    }

    const Mesh& mesh_;
    const FeatureEdges& all_;
};

/// The whole line through an edge.
FeatureLine line_through(const FeatureEdges& all, int seed, std::set<int>& used) {
    FeatureLine line;
    std::vector<int> edges{seed};
    used.insert(seed);
    const auto go = [&](Index from) {
        std::vector<int> out;
        Index node = from;
        int edge = seed;
        for (;;) {
            const auto next = all.next(edge, node);
            if (!next || used.contains(*next)) {
                line.closed = next && *next == seed && !out.empty();
                return out;
            }
            edge = *next;
            used.insert(edge);
            out.push_back(edge);
            node = all.far_end(edge, node);
        }
    };
    Index start = all.edges[seed].ends[0];
    for (const int e : go(all.edges[seed].ends[1])) edges.push_back(e);
    if (!line.closed) {
        const std::vector<int> before = go(start);
        edges.insert(edges.begin(), before.rbegin(), before.rend());
        for (const int e : before) start = all.far_end(e, start);
    }
    Index node = start;
    for (const int e : edges) {
        line.nodes.push_back(node);
        const bool forwards = all.edges[e].ends[0] == node;
        const auto& [left, right] = all.edges[e].faces;
        line.faces.push_back(forwards ? std::array{left, right} : std::array{right, left});
        node = all.far_end(e, node);
    }
    if (!line.closed) line.nodes.push_back(node);
    return line;
}

}  // namespace

namespace {

/// A face of a solid, normal outwards; the fourth of a triangle is -1.
struct SolidFace {
    std::array<Index, 4> key, corners;

    explicit SolidFace(const std::array<Index, 4>& nodes) : key(nodes), corners(nodes) {
        std::sort(key.begin(), key.end() - (nodes[3] < 0 ? 1 : 0));
    }
};

void add_faces_of_tetrahedra(const CellBlock& b, std::vector<SolidFace>& out) {
    out.reserve(out.size() + static_cast<std::size_t>(4 * b.size()));
    SparseCheck check;
    for (Index c = 0; c < b.size(); ++c) {
        check();
        const auto n = b.nodes(c);
        for (const auto& f : outward_faces) out.emplace_back(std::array<Index, 4>{n[f[0]], n[f[1]], n[f[2]], -1});
    }
}

void add_faces_of_others(const Mesh& mesh, const CellBlock& b, std::vector<SolidFace>& out) {
    const auto& x = mesh.points;
    SparseCheck check;
    for (Index c = 0; c < b.size(); ++c) {
        check();
        const auto corners = b.nodes(c).first(static_cast<std::size_t>(traits(b.type).corners));
        Vec3 middle = Vec3::Zero();
        for (const Index n : corners) middle += x[n] / static_cast<double>(corners.size());
        for (const ElementFace& f : faces_of(mesh, {b.type, c})) {
            if (f.count < 3) continue;
            std::array<Index, 4> n = f.corners;
            if (f.count == 3) n[3] = -1;
            const Vec3 turned = f.count == 3 ? (x[n[1]] - x[n[0]]).cross(x[n[2]] - x[n[0]])
                                             : (x[n[2]] - x[n[0]]).cross(x[n[3]] - x[n[1]]);
            if (turned.dot(x[n[0]] - middle) < 0) std::swap(n[0], n[2]);
            out.emplace_back(n);
        }
    }
}

}  // namespace

std::vector<std::array<Index, 3>> skin_of(const Mesh& mesh) {
    std::vector<SolidFace> faces;
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension != 3) continue;
        if (traits(b.type).simplex)
            add_faces_of_tetrahedra(b, faces);
        else
            add_faces_of_others(mesh, b, faces);
    }
    check_cancelled();
    std::ranges::sort(faces, {}, &SolidFace::key);
    std::vector<SkinTriangle> skin;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        if ((k > 0 && faces[k].key == faces[k - 1].key) || (k + 1 < faces.size() && faces[k].key == faces[k + 1].key))
            continue;
        const auto& [a, b, c, d] = faces[k].corners;
        skin.push_back({a, b, c});
        if (d >= 0) skin.push_back({a, c, d});
    }
    return skin;
}

namespace {

/// The normal of skin at a point, and by how much it may be off.
struct Facing {
    Vec3 normal = Vec3::Zero();
    double off = 0;

    bool is_found() const { return !normal.isZero(); }
    bool is(const Facing& other) const { return (normal - other.normal).norm() <= 1e-6 + off + other.off; }
};

/// The end of a line at `node`, before which is `before`; `beside`: the faces at its last edge.
LineEnd line_end(const Mesh& mesh, const std::vector<SkinTriangle>& around, Index node, Index before,
                 const std::array<SkinTriangle, 2>& beside) {
    const CoordinateSlack slack(mesh);
    const Vec3& end = mesh.points[node];
    const Vec3 onwards = (end - mesh.points[before]).normalized();
    const auto facing = [&](const SkinTriangle& f) {
        return Facing{normal(mesh, f), slack.normal(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]])};
    };
    // What lies across the line, and looks out of its end or to it, by the face that shows it best.
    Facing plane, wall;
    for (const SkinTriangle& f : around) {
        const Facing here = facing(f);
        Facing& known = here.normal.dot(onwards) > 0 ? plane : wall;
        if (std::abs(here.normal.dot(onwards)) >= across && (!known.is_found() || here.off < known.off)) known = here;
    }
    bool runs_out = plane.is_found(), stands = wall.is_found();
    for (const SkinTriangle& f : around) {
        const Facing here = facing(f);
        runs_out = runs_out && (here.normal.dot(onwards) < across || here.is(plane));
        stands = stands && (here.is(wall) || std::ranges::any_of(beside, [&](const SkinTriangle& b) {
                                return (here.normal - normal(mesh, b)).norm() <= 0.1;
                            }));
        for (const Index n : f) {
            if (n == node) continue;
            const Vec3 to = mesh.points[n] - end;
            const double off = 1e-6 + slack.direction(to.norm());
            runs_out = runs_out && to.dot(plane.normal) <= (off + plane.off) * to.norm();
            stands = stands && to.dot(wall.normal) >= -(off + wall.off) * to.norm();
        }
    }
    if (runs_out) return LineEnd::plane;
    const Facing inwards = facing(beside[0]);
    const bool concave = std::ranges::any_of(beside[1], [&](Index n) {
        const Vec3 to = mesh.points[n] - end;
        return to.dot(inwards.normal) > (1e-6 + slack.direction(to.norm()) + inwards.off) * to.norm();
    });
    return stands && concave ? LineEnd::wall : LineEnd::open;
}

}  // namespace

std::array<LineEnd, 2> line_ends(const Mesh& mesh, const FeatureLine& line,
                                 const std::vector<std::array<Index, 3>>& skin) {
    std::array<LineEnd, 2> out{LineEnd::plane, LineEnd::plane};
    if (line.closed) return out;
    for (const int which : {0, 1}) {
        const std::size_t last = line.nodes.size() - 1;
        const Index node = line.nodes[which == 0 ? 0 : last], before = line.nodes[which == 0 ? 1 : last - 1];
        std::vector<SkinTriangle> around;
        std::ranges::copy_if(skin, std::back_inserter(around),
                             [&](const SkinTriangle& f) { return std::ranges::find(f, node) != f.end(); });
        out[which] = line_end(mesh, around, node, before, which == 0 ? line.faces.front() : line.faces.back());
    }
    return out;
}

std::optional<std::array<Index, 3>> wall_at_end(const Mesh& mesh, const FeatureLine& line, int which,
                                                const std::vector<std::array<Index, 3>>& skin) {
    const CoordinateSlack slack(mesh);
    const std::size_t last = line.nodes.size() - 1;
    const Index node = line.nodes[which == 0 ? 0 : last], before = line.nodes[which == 0 ? 1 : last - 1];
    const Vec3 onwards = (mesh.points[node] - mesh.points[before]).normalized();
    std::optional<SkinTriangle> best;
    double least = 0;
    for (const SkinTriangle& f : skin) {
        if (std::ranges::find(f, node) == f.end() || normal(mesh, f).dot(onwards) > -across) continue;
        const double off = slack.normal(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]);
        if (best && off >= least) continue;
        best = f;
        least = off;
    }
    return best;
}

std::vector<FeatureLine> find_feature_lines(const Mesh& mesh, const Along& along, double feature_angle) {
    const FeatureEdges all(mesh, feature_angle);
    const Seeds seeds(mesh, along, all);
    const std::set<int> named(seeds.edges.begin(), seeds.edges.end());
    std::set<int> used;
    std::vector<FeatureLine> lines;
    for (const int seed : seeds.edges) {
        if (used.contains(seed)) continue;
        const std::size_t before = used.size();
        lines.push_back(line_through(all, seed, used));
        std::size_t count = 0;
        for (const int e : named) count += used.contains(e);
        lines.back().extended = along.points.empty() && used.size() > count && used.size() > before + 1;
    }
    return lines;
}

}  // namespace femscalpel
