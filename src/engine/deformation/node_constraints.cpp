// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/node_constraints.h"

#include "cancel.h"
#include "groups/band_boundaries.h"
#include "mesh/closest_point.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <span>

namespace femscalpel {
namespace {

/// Flatness and straightness tolerance relative to the size of the band: coordinates that passed
/// through a text file with nine digits still count as plane.
constexpr double flat_tolerance = 1e-9;

/// A node that moves along a bent line may dent it by this many edge lengths.
constexpr double deepest_dent = 0.05;

/// Faces at a smaller angle than this (cosine) are the two lips of a crack.
constexpr double closed_fold = 0.9999;

/// Sine of the angle up to which the segments of a crack front are in line.
constexpr double straight_front = 1e-6;

/// Square of the sine of the angle up to which a tool runs along a surface (line): 0.06 degrees.
constexpr double parallel = 1e-6;

/// A mesh lies on the shape it was made from to this, in sizes of the shape.
constexpr double shape_tolerance = 1e-5;

/// A triangle or segment runs along a face or edge of the shape: cosine of the angle between them.
constexpr double along_shape = 0.5;

class UnionFind {
public:
    explicit UnionFind(int count) : parent_(static_cast<std::size_t>(count)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int find(int i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(int i, int j) {
        i = find(i);
        j = find(j);
        if (i != j) parent_[std::max(i, j)] = std::min(i, j);
    }

private:
    std::vector<int> parent_;
};

}  // namespace

NodeConstraints::NodeConstraints(BandMesh& band, const Mesh& mesh, const ConstraintOptions& options) {
    const int node_count = band.size();
    shape_ = options.shape;
    nodes_.resize(static_cast<std::size_t>(node_count));
    exterior_.assign(static_cast<std::size_t>(node_count), 0);
    leash_.assign(static_cast<std::size_t>(node_count), std::numeric_limits<double>::infinity());
    facets_around_.resize(static_cast<std::size_t>(node_count));
    segments_around_.resize(static_cast<std::size_t>(node_count));
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const BandNode& n : band.nodes) {
        low = low.cwiseMin(n.at);
        high = high.cwiseMax(n.at);
    }
    // Rounding grows with the coordinates themselves, so a model far from the origin counts as larger.
    if (node_count > 0)
        size_ = std::max({(high - low).norm(), 0.1 * low.cwiseAbs().maxCoeff(), 0.1 * high.cwiseAbs().maxCoeff()});
    // The plane and line go through nodes that are off by as much themselves.
    flat_ = std::max(flat_tolerance * size_, options.rounding);
    close_ = std::max({1e-10 * size_, options.tolerance, options.rounding});

    const auto movable = [&](auto& nodes) {
        return std::ranges::any_of(nodes, [&](int v) { return band.nodes[v].movable(); });
    };
    const auto shared = [](const auto& list, int a, int b) {
        return std::ranges::any_of(list.around(a),
                                   [&](int s) { return std::ranges::find(list[s], b) != list[s].end(); });
    };

    // 1. Faces to be kept; which triangles are shells of their own, which segments hang loose.
    std::vector<bool> drifting(mesh.groups.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g)
        drifting[g] = (!options.meaningless.empty() && options.meaningless[g]) ||
                      (mesh.groups[g].hidden ? options.kept_hidden.empty() || !options.kept_hidden[g]
                                             : !options.drifting_groups.empty() && options.drifting_groups[g]);
    const BandBoundaries boundaries(band, mesh, drifting, options.on_shortcuts, options.meaningless);
    struct Face {
        std::array<int, 3> nodes;
        int kind;
        bool internal;
        bool shell;
        int groups;
        int cad;  // face of the shape it lies on
    };
    std::vector<Face> faces;
    SparseCheck check(64);
    for (const BandBoundaries::Face& f : boundaries.faces()) {
        check();
        // Faces that differ in this are never one surface.
        const int place = f.is_shell() ? 0 : f.is_skin() ? 1 : 2;
        int cad = -1;
        if (shape_ && !f.is_internal()) {
            cad = shape_face({band.nodes[f.nodes[0]].at, band.nodes[f.nodes[1]].at, band.nodes[f.nodes[2]].at});
            ++match_.faces;
            match_.off += cad < 0;
        }
        faces.push_back({f.nodes, (f.kind * 3 + place) * 2 + f.element, f.is_internal(), f.is_shell(), f.kind, cad});
    }
    shell_.assign(static_cast<std::size_t>(band.triangles.size()), 0);
    for (int t = 0; t < band.triangles.size(); ++t, check()) {
        const auto& v = band.triangles[t];
        shell_[t] = std::ranges::none_of(band.tetras.around(v[0]), [&](int s) {
            const auto& n = band.tetras[s];
            return std::ranges::find(n, v[1]) != n.end() && std::ranges::find(n, v[2]) != n.end();
        });
    }
    loose_.assign(static_cast<std::size_t>(band.lines.size()), 0);
    for (int l = 0; l < band.lines.size(); ++l) {
        const auto& v = band.lines[l];
        if (shared(band.tetras, v[0], v[1]) || shared(band.triangles, v[0], v[1])) continue;
        loose_[l] = 1;
        for (int n : v) nodes_[n].freedom = NodeFreedom::fixed;
    }

    // 2. Edges of those faces: smooth ones join faces to surfaces, the others are creases.
    std::vector<std::pair<std::uint64_t, int>> edges;
    edges.reserve(faces.size() * 3);
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
        for (int k = 0; k < 3; ++k) {
            const std::array<int, 2> e{faces[f].nodes[k], faces[f].nodes[(k + 1) % 3]};
            if (movable(e)) edges.push_back({edge_key(e[0], e[1]), f});
        }
    std::ranges::sort(edges);
    constexpr int none = -1;
    std::map<std::uint64_t, int> line_family;
    for (const BandBoundaries::Line& l : boundaries.lines())
        if (movable(l.nodes)) line_family.emplace(edge_key(l.nodes[0], l.nodes[1]), l.kind * 2 + l.element);
    const double smooth = -std::cos(options.feature_angle * std::numbers::pi / 180);
    // Cosine of the angle between two faces around an edge; 1 if they lie on each other.
    const auto opening = [&](std::uint64_t key, int f, int g) {
        const int a = static_cast<int>(key >> 32), b = static_cast<int>(key & 0xffffffffu);
        const Vec3 along = (band.nodes[b].at - band.nodes[a].at).normalized();
        const auto across = [&](int face) {
            for (int v : faces[face].nodes)
                if (v != a && v != b) {
                    const Vec3 w = band.nodes[v].at - band.nodes[a].at;
                    return Vec3((w - along * along.dot(w)).normalized());
                }
            return Vec3(Vec3::Zero());
        };
        return across(f).dot(across(g));
    };
    const auto is_smooth = [&](std::uint64_t key, int f, int g) {
        // Between coarse triangles of one face of the shape there is a kink, but no feature line.
        const double limit = faces[f].cad >= 0 && faces[f].cad == faces[g].cad ? 0 : smooth;
        return faces[f].kind == faces[g].kind && opening(key, f, g) < limit;
    };
    const auto folds_back = [&](std::uint64_t key, const auto& at_edge) {
        for (std::size_t k = 0; k < at_edge.size(); ++k)
            for (std::size_t j = 0; j < k; ++j) {
                const int f = at_edge[j].second, g = at_edge[k].second;
                if (!faces[f].internal && !faces[g].internal && opening(key, f, g) > closed_fold) return true;
            }
        return false;
    };
    UnionFind joined(static_cast<int>(faces.size()));
    std::map<std::vector<int>, int> crease_kinds;
    struct Crease {
        std::array<int, 2> nodes;
        int kind;
        bool border;
        int groups;
        bool fold;         // the skin comes back along itself: the front of a crack
        bool parts_shape;  // faces of the shape meet here, or one ends
        int shape_face;    // or all faces of the skin here lie on this one
    };
    std::vector<Crease> creases;
    const auto groups_of_line = [](int line_family) { return line_family / 2; };
    for (std::size_t i = 0; i < edges.size();) {
        check();
        std::size_t end = i;
        while (end < edges.size() && edges[end].first == edges[i].first) ++end;
        const std::uint64_t key = edges[i].first;
        const auto line = line_family.find(key);
        if (end - i == 2 && line == line_family.end() && is_smooth(key, edges[i].second, edges[i + 1].second)) {
            joined.unite(edges[i].second, edges[i + 1].second);
        } else {
            std::vector<int> kind{line == line_family.end() ? none : line->second};
            for (std::size_t k = i; k < end; ++k) kind.push_back(faces[edges[k].second].kind);
            std::sort(kind.begin() + 1, kind.end());
            // A segment on a smooth surface does not part it.
            if (end - i == 2 && is_smooth(key, edges[i].second, edges[i + 1].second))
                joined.unite(edges[i].second, edges[i + 1].second);
            const int k = crease_kinds.emplace(std::move(kind), static_cast<int>(crease_kinds.size())).first->second;
            std::set<int> cads;
            for (std::size_t e = i; e < end; ++e)
                if (!faces[edges[e].second].internal) cads.insert(faces[edges[e].second].cad);
            creases.push_back({{static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)},
                               k,
                               end - i == 1 && faces[edges[i].second].shell,
                               line == line_family.end() ? 0 : groups_of_line(line->second),
                               folds_back(key, std::span(edges).subspan(i, end - i)),
                               cads.size() > 1 || end - i == 1,
                               cads.size() == 1 ? *cads.begin() : -1});
        }
        if (line != line_family.end()) line_family.erase(line);
        i = end;
    }
    for (const auto& [key, family] : line_family) {  // segments inside the material
        const int k =
            crease_kinds.emplace(std::vector<int>{family}, static_cast<int>(crease_kinds.size())).first->second;
        creases.push_back({{static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)},
                           k,
                           false,
                           groups_of_line(family),
                           false,
                           false,
                           -1});
    }

    // 3. Surfaces.
    const auto mid_of = [&](int a, int b) -> std::optional<Vec3> {
        const auto it = band.mid_nodes.find(edge_key(a, b));
        return it == band.mid_nodes.end() ? std::nullopt : std::optional<Vec3>(mesh.points[it->second]);
    };
    std::vector<int> surface_of(faces.size(), -1);
    facets_.resize(faces.size());
    for (int f = 0; f < static_cast<int>(faces.size()); ++f, check()) {
        const int root = joined.find(f);
        if (surface_of[root] < 0) {
            surface_of[root] = static_cast<int>(surfaces_.size());
            surfaces_.push_back({});
            surfaces_.back().internal = faces[f].internal;
            surfaces_.back().shell = faces[f].shell;
            surfaces_.back().kind = faces[f].groups;
        }
        Facet& facet = facets_[f];
        facet.node = faces[f].nodes;
        facet.surface = surface_of[root];
        facet.cad = faces[f].cad;
        for (int k = 0; k < 3; ++k) {
            facet.corner[k] = band.nodes[facet.node[k]].at;
            facets_around_[facet.node[k]].push_back(f);
        }
        for (int k = 0; k < 3; ++k) {
            const auto mid = mid_of(facet.node[k], facet.node[(k + 1) % 3]);
            const Vec3 chord = (facet.corner[k] + facet.corner[(k + 1) % 3]) / 2;
            facet.mid[k] = mid.value_or(chord);
            facet.curved = facet.curved || (facet.mid[k] - chord).norm() > flat_;
        }
        // The hull of its Bezier points holds a second-order facet.
        facet.centre = (facet.corner[0] + facet.corner[1] + facet.corner[2]) / 3;
        double bulge = 0, longest = 0;
        for (int k = 0; k < 3; ++k) {
            bulge = std::max(bulge, (facet.mid[k] - (facet.corner[k] + facet.corner[(k + 1) % 3]) / 2).norm());
            longest = std::max(longest, (facet.corner[k] - facet.corner[(k + 1) % 3]).norm());
        }
        facet.sag = bulge * 4 / 3;
        facet.height = (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]).norm() / longest;
        for (int k = 0; k < 3; ++k) {
            const Vec3 control = 2 * facet.mid[k] - (facet.corner[k] + facet.corner[(k + 1) % 3]) / 2;
            facet.radius =
                std::max({facet.radius, (facet.corner[k] - facet.centre).norm(), (control - facet.centre).norm()});
        }
        band.skin.add(facet.node, facet.surface);
        if (!faces[f].internal && !faces[f].shell)
            for (int v : facet.node) exterior_[v] = 1;
    }
    // The plane of a surface: through its largest facet, the best defined normal.
    std::vector<double> largest(surfaces_.size(), -1);
    for (const Facet& f : facets_) {
        const Vec3 n = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]);
        if (n.norm() > largest[f.surface]) {
            largest[f.surface] = n.norm();
            surfaces_[f.surface].normal = n.normalized();
            surfaces_[f.surface].origin = f.corner[0];
        }
    }
    // Where coordinates are rounded, all facets together define it better.
    if (options.rounding > 0) {
        std::vector<Vec3> sum(surfaces_.size(), Vec3::Zero()), middle(surfaces_.size(), Vec3::Zero());
        std::vector<int> count(surfaces_.size(), 0);
        for (const Facet& f : facets_) {
            const Vec3 n = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]);
            sum[f.surface] += n.dot(surfaces_[f.surface].normal) < 0 ? Vec3(-n) : n;
            middle[f.surface] += f.centre;
            ++count[f.surface];
        }
        for (std::size_t k = 0; k < surfaces_.size(); ++k) {
            surfaces_[k].normal = sum[k].normalized();
            surfaces_[k].origin = middle[k] / count[k];
        }
    }
    for (const Facet& f : facets_) {
        Surface& s = surfaces_[f.surface];
        if (f.cad >= 0 && !shape_->is_plane(f.cad)) s.flat = false;
        for (int k = 0; k < 3; ++k)
            for (const Vec3& p : {f.corner[k], f.mid[k]})
                if (std::abs(s.normal.dot(p - s.origin)) > flat_) s.flat = false;
    }

    // 4. Curves: creases joined at nodes where exactly two of one kind meet without a kink.
    check_cancelled();
    std::vector<std::vector<int>> creases_at(static_cast<std::size_t>(node_count));
    for (int c = 0; c < static_cast<int>(creases.size()); ++c)
        for (int v : creases[c].nodes) creases_at[v].push_back(c);
    const auto direction_from = [&](int c, int from) {
        const auto& e = creases[c].nodes;
        return (band.nodes[e[0] == from ? e[1] : e[0]].at - band.nodes[from].at).normalized();
    };
    UnionFind chained(static_cast<int>(creases.size()));
    std::vector<int> crease_cad(creases.size(), -1);
    for (std::size_t c = 0; c < creases.size() && shape_; ++c)
        if (creases[c].parts_shape)
            crease_cad[c] = shape_edge(band.nodes[creases[c].nodes[0]].at, band.nodes[creases[c].nodes[1]].at);
    std::vector<char> passes(static_cast<std::size_t>(node_count), 0);
    for (int v = 0; v < node_count; ++v) {
        const auto& c = creases_at[v];
        if (c.size() != 2 || creases[c[0]].kind != creases[c[1]].kind) continue;
        const double limit = crease_cad[c[0]] >= 0 && crease_cad[c[0]] == crease_cad[c[1]] ? 0 : smooth;
        if (direction_from(c[0], v).dot(direction_from(c[1], v)) >= limit) continue;
        passes[v] = 1;
        chained.unite(c[0], c[1]);
    }
    std::vector<int> curve_of(creases.size(), -1);
    segments_.resize(creases.size());
    for (int c = 0; c < static_cast<int>(creases.size()); ++c) {
        check();
        const int root = chained.find(c);
        Segment& segment = segments_[c];
        segment.node = creases[c].nodes;
        segment.cad = crease_cad[c];
        if (segment.cad < 0 && creases[c].shape_face >= 0 && !shape_->is_plane(creases[c].shape_face))
            segment.cad_face = creases[c].shape_face;
        for (int k = 0; k < 2; ++k) {
            segment.end[k] = band.nodes[segment.node[k]].at;
            segments_around_[segment.node[k]].push_back(c);
        }
        const Vec3 chord = (segment.end[0] + segment.end[1]) / 2;
        segment.mid = mid_of(segment.node[0], segment.node[1]).value_or(chord);
        segment.curved = (segment.mid - chord).norm() > flat_;
        segment.centre = chord;
        segment.radius = std::max((segment.end[0] - chord).norm(), 2 * (segment.mid - chord).norm());
        if (curve_of[root] < 0) {
            curve_of[root] = static_cast<int>(curves_.size());
            curves_.push_back({true, creases[c].border, creases[c].groups, segment.end[0],
                               (segment.end[1] - segment.end[0]).normalized()});
        }
        segment.curve = curve_of[root];
        band.creases.add(segment.node, segment.curve);
        if (creases[c].border)
            for (int v : segment.node) exterior_[v] = 1;
    }
    // The direction of a curve: from its first segment to the end farthest away, the best defined one.
    std::vector<double> reach(curves_.size(), 0);
    for (const Segment& s : segments_)
        for (const Vec3& p : s.end) {
            Curve& c = curves_[s.curve];
            const double length = (p - c.origin).norm();
            if (length > reach[s.curve]) {
                reach[s.curve] = length;
                c.direction = (p - c.origin) / length;
            }
        }
    for (const Segment& s : segments_) {
        Curve& c = curves_[s.curve];
        if ((s.cad >= 0 && !shape_->is_line(s.cad)) || s.cad_face >= 0) c.straight = false;
        for (const Vec3& p : {s.end[0], s.end[1], s.mid})
            if (c.direction.cross(p - c.origin).norm() > flat_) c.straight = false;
    }

    // 5. Freedom of each node. Isolated members of groups (IE) do not move.
    kinds_ = boundaries.kinds();
    if (!options.related.empty())
        for (int v = 0; v < node_count; ++v)
            related_.push_back(std::ranges::binary_search(options.related, band.nodes[v].global));
    has_shortcuts_ = !boundaries.shortcuts().empty();
    for (const BandBoundaries::Node& n : boundaries.isolated()) {
        nodes_[n.node].freedom = NodeFreedom::fixed;
        isolated_.push_back({n.node, n.kind});
    }
    for (const auto& [a, b] : boundaries.isolated_middles()) fixed_middles_.insert(edge_key(a, b));
    if (!options.pinned.empty())
        for (const auto& [key, mid] : band.mid_nodes)
            if (std::ranges::binary_search(options.pinned, mid)) fixed_middles_.insert(key);
    for (int v = 0; v < node_count; ++v) {
        check();
        NodeConstraint& c = nodes_[v];
        if (c.freedom == NodeFreedom::fixed) continue;
        if (!band.nodes[v].movable() || !band.vertices.around(v).empty() ||
            std::ranges::binary_search(options.pinned, band.nodes[v].global)) {
            c.freedom = NodeFreedom::fixed;
            continue;
        }
        const auto& around = facets_around_[v];
        if (!creases_at[v].empty()) {
            c.freedom = passes[v] ? NodeFreedom::curve : NodeFreedom::fixed;
            if (passes[v]) {
                c.hint = creases_at[v][0];
                c.shape = segments_[c.hint].curve;
                // Moved by s, the node leaves a dent of about s sin(bend).
                std::array<Vec3, 2> away;
                double length = std::numeric_limits<double>::infinity();
                for (int k = 0; k < 2; ++k) {
                    const Segment& s = segments_[creases_at[v][k]];
                    away[k] = (4 * s.mid - 3 * band.nodes[v].at - s.end[s.node[0] == v ? 1 : 0]).normalized();
                    length = std::min(length, (s.end[1] - s.end[0]).norm());
                }
                const double bend = away[0].cross(away[1]).norm();
                const bool front = creases[creases_at[v][0]].fold && creases[creases_at[v][1]].fold;
                if (front && bend > std::max(straight_front, options.rounding / length))
                    c.freedom = NodeFreedom::fixed;
                else if (bend > 0 && segments_[creases_at[v][0]].cad < 0)
                    leash_[v] = deepest_dent / bend * length;
            }
        } else if (!around.empty()) {
            // One closed fan of one surface; two sheets that touch in this node alone pin it.
            std::vector<int> fan{around[0]};
            for (std::size_t k = 0; k < fan.size(); ++k)
                for (int f : around)
                    if (std::ranges::find(fan, f) == fan.end()) {
                        int shared = 0;
                        for (int w : facets_[f].node)
                            shared += std::ranges::find(facets_[fan[k]].node, w) != facets_[fan[k]].node.end();
                        if (shared >= 2) fan.push_back(f);
                    }
            const bool one = fan.size() == around.size() && std::ranges::all_of(around, [&](int f) {
                                 return facets_[f].surface == facets_[around[0]].surface;
                             });
            c.freedom = one ? NodeFreedom::surface : NodeFreedom::fixed;
            c.hint = around[0];
            c.shape = facets_[around[0]].surface;
        }
    }
}

NodeConstraint NodeConstraints::on_edge(const BandMesh& band, int a, int b) const {
    const int crease = band.creases.find({a, b});
    if (crease >= 0) {
        const int origin = band.creases.origin(crease);
        return {NodeFreedom::curve, segments_[origin].curve, origin};
    }
    for (const int s : band.skin.around(a)) {
        const auto& v = band.skin[s];
        if (std::ranges::find(v, b) == v.end()) continue;
        const int origin = band.skin.origin(s);
        return {NodeFreedom::surface, facets_[origin].surface, origin};
    }
    return {};
}

NodeConstraint NodeConstraints::on_face(const BandMesh& band, int a, int b, int c) const {
    const int face = band.skin.find({a, b, c});
    if (face < 0) return {};
    const int origin = band.skin.origin(face);
    return {NodeFreedom::surface, facets_[origin].surface, origin};
}

void NodeConstraints::add_node(const BandMesh& band, int node) {
    nodes_.resize(static_cast<std::size_t>(band.size()));
    exterior_.resize(static_cast<std::size_t>(band.size()), 0);
    leash_.resize(static_cast<std::size_t>(band.size()), std::numeric_limits<double>::infinity());
    const auto& [a, b] = band.births[node - band.original_nodes()];
    nodes_[node] = on_edge(band, a, node);
    if (!related_.empty()) {
        related_.resize(static_cast<std::size_t>(band.size()));
        related_[node] = related_[a] && related_[b];
        if (related_[node] && nodes_[node].freedom != NodeFreedom::free) nodes_[node].freedom = NodeFreedom::fixed;
    }
    for (const int s : band.skin.around(node)) {
        const Surface& surface = surfaces_[band.skin.tag(s)];
        if (!surface.internal && !surface.shell) exterior_[node] = 1;
    }
    for (const int s : band.creases.around(node))
        if (curves_[band.creases.tag(s)].border) exterior_[node] = 1;
}

bool NodeConstraints::is_skin_edge(const BandMesh& band, int a, int b) const {
    return std::ranges::any_of(band.skin.around(a), [&](int s) {
        return !surfaces_[band.skin.tag(s)].internal && std::ranges::find(band.skin[s], b) != band.skin[s].end();
    });
}

bool NodeConstraints::is_exterior_edge(const BandMesh& band, int a, int b) const {
    if (const int crease = band.creases.find({a, b}); crease >= 0 && curves_[band.creases.tag(crease)].border)
        return true;
    return std::ranges::any_of(band.skin.around(a), [&](int s) {
        const Surface& surface = surfaces_[band.skin.tag(s)];
        return !surface.internal && !surface.shell && std::ranges::find(band.skin[s], b) != band.skin[s].end();
    });
}

bool NodeConstraints::is_internal_edge(const BandMesh& band, int a, int b) const {
    return std::ranges::any_of(band.skin.around(a), [&](int s) {
        return surfaces_[band.skin.tag(s)].internal && std::ranges::find(band.skin[s], b) != band.skin[s].end();
    });
}

bool NodeConstraints::is_on_skin(const BandMesh& band, int node) const {
    return std::ranges::any_of(band.skin.around(node), [&](int s) { return !surfaces_[band.skin.tag(s)].internal; });
}

bool NodeConstraints::is_on_internal(const BandMesh& band, int node) const {
    return std::ranges::any_of(band.skin.around(node), [&](int s) { return surfaces_[band.skin.tag(s)].internal; });
}

NodeConstraints::Foot NodeConstraints::foot_on(const Facet& f, const Vec3& x, double limit2) {
    Vec3 bary;
    Foot foot;
    foot.at = closest_on_triangle(f.corner[0], f.corner[1], f.corner[2], x, bary);
    foot.distance2 = (foot.at - x).squaredNorm();
    const double limit = std::sqrt(limit2) + f.sag;
    if (foot.distance2 >= limit * limit) {
        foot.distance2 = std::numeric_limits<double>::infinity();
        return foot;
    }
    if (!f.curved) {
        foot.normal = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).normalized();
        foot.inside = bary.minCoeff();
        return foot;
    }
    // Closest point of the six-node face: Newton in its parameters from the flat foot, with the sides as bounds.
    const Vec3 &c = f.corner[0], cu = 4 * f.mid[0] - 3 * c - f.corner[1], cv = 4 * f.mid[2] - 3 * c - f.corner[2];
    const Vec3 cuu = 2 * (c + f.corner[1] - 2 * f.mid[0]), cvv = 2 * (c + f.corner[2] - 2 * f.mid[2]),
               cuv = 4 * (c - f.mid[0] + f.mid[1] - f.mid[2]);
    double u = bary[1], v = bary[2];
    for (int iteration = 0;; ++iteration) {
        const Vec3 pu = cu + 2 * u * cuu + v * cuv, pv = cv + 2 * v * cvv + u * cuv;
        foot.at = c + u * (cu + u * cuu + v * cuv) + v * (cv + v * cvv);
        const Vec3 r = x - foot.at;
        const double gu = pu.dot(r), gv = pv.dot(r), quu = pu.squaredNorm(), quv = pu.dot(pv), qvv = pv.squaredNorm();
        double huu = quu - 2 * r.dot(cuu), huv = quv - r.dot(cuv), hvv = qvv - 2 * r.dot(cvv);
        double determinant = huu * hvv - huv * huv;
        if (!(huu > 0.1 * quu && hvv > 0.1 * qvv &&
              determinant > 0.1 * (quu * qvv - quv * quv))) {  // far away: Gauss-Newton
            huu = quu;
            huv = quv;
            hvv = qvv;
            determinant = huu * hvv - huv * huv;
        }
        const double w = 1 - u - v;
        double du = (hvv * gu - huv * gv) / determinant, dv = (huu * gv - huv * gu) / determinant;
        if (u + du < 0) {
            du = -u;
            dv = (gv - huv * du) / hvv;
        }
        if (v + dv < 0) {
            dv = -v;
            du = std::max(-u, (gu - huv * dv) / huu);
        }
        if (du + dv > w) {
            du = std::clamp((gu - gv + (hvv - huv) * w) / (huu - 2 * huv + hvv), -u, 1 - u);
            dv = w - du;
        }
        if (iteration == 12 || std::abs(du) + std::abs(dv) < 1e-13) {
            foot.normal = pu.cross(pv).normalized();
            foot.inside = std::min({u, v, w});
            foot.distance2 = r.squaredNorm();
            return foot;
        }
        u += du;
        v += dv;
    }
}

NodeConstraints::Foot NodeConstraints::foot_on(const Segment& s, const Vec3& x) {
    const Vec3 along = s.end[1] - s.end[0];
    double t = std::clamp(along.dot(x - s.end[0]) / along.squaredNorm(), 0.0, 1.0);
    Foot foot;
    foot.at = s.end[0] + t * along;
    foot.normal = along.normalized();
    if (s.curved) {
        for (int iteration = 0; iteration < 12; ++iteration) {
            const Vec3 p = (1 - t) * (1 - 2 * t) * s.end[0] + t * (2 * t - 1) * s.end[1] + 4 * t * (1 - t) * s.mid;
            const Vec3 pt = (4 * t - 3) * s.end[0] + (4 * t - 1) * s.end[1] + 4 * (1 - 2 * t) * s.mid;
            foot.at = p;
            foot.normal = pt.normalized();
            const double next = std::clamp(t + pt.dot(x - p) / pt.squaredNorm(), 0.0, 1.0);
            if (std::abs(next - t) < 1e-14) break;
            t = next;
        }
    }
    foot.distance2 = (foot.at - x).squaredNorm();
    return foot;
}

NodeConstraints::Foot NodeConstraints::surface_foot(const NodeConstraint& c, const Vec3& x) const {
    const Surface& s = surfaces_[c.shape];
    if (s.flat) {
        Foot foot;
        const double d = s.normal.dot(x - s.origin);
        foot.at = x - d * s.normal;
        foot.normal = s.normal;
        foot.distance2 = d * d;
        foot.facet = c.hint;
        return foot;
    }
    // Walk over the surface from the hint: look at the facets around the best one's corners.
    Foot best = foot_on(facets_[c.hint], x);
    best.facet = c.hint;
    const auto too_far = [&](const Facet& f) {
        const double reach = f.radius + std::sqrt(best.distance2);
        return (x - f.centre).squaredNorm() > reach * reach;
    };
    for (int step = 0; step < 64; ++step) {
        const int from = best.facet;
        // On it, or nearer than any smooth neighbour can be.
        const double off = std::sqrt(best.distance2);
        if (off <= 1e-14 * size_ || 2 * off < best.inside * facets_[from].height) break;
        for (int v : facets_[from].node)
            for (int f : facets_around_[v]) {
                if (f == from || facets_[f].surface != c.shape || too_far(facets_[f])) continue;
                Foot foot = foot_on(facets_[f], x, best.distance2);
                if (foot.distance2 < best.distance2) {
                    best = foot;
                    best.facet = f;
                }
            }
        if (best.facet == from) break;
    }
    if (facets_[best.facet].cad >= 0) put_on_shape(best, shape_->on_face(facets_[best.facet].cad, x), x);
    return best;
}

void NodeConstraints::put_on_shape(Foot& foot, const CadShape::Foot& on, const Vec3& x) const {
    foot.at = on.at;
    foot.normal = on.direction;
    foot.distance2 = (on.at - x).squaredNorm();
}

int NodeConstraints::shape_face(const std::array<Vec3, 3>& corner) const {
    const double tolerance = shape_tolerance * shape_->size();
    std::vector<int> common = shape_->faces_at(corner[0], tolerance);
    for (int k = 1; k < 3 && !common.empty(); ++k) {
        const std::vector<int> here = shape_->faces_at(corner[k], tolerance);
        std::erase_if(common, [&](int f) { return std::ranges::find(here, f) == here.end(); });
    }
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3,
               normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int f : common) {
        const CadShape::Foot foot = shape_->on_face(f, middle);
        const double distance = (foot.at - middle).norm();
        if (distance >= least || std::abs(foot.direction.dot(normal)) < along_shape) continue;
        least = distance;
        best = f;
    }
    return best;
}

int NodeConstraints::shape_edge(const Vec3& a, const Vec3& b) const {
    const double tolerance = shape_tolerance * shape_->size();
    const std::vector<int> at_b = shape_->edges_at(b, tolerance);
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int e : shape_->edges_at(a, tolerance)) {
        if (std::ranges::find(at_b, e) == at_b.end()) continue;
        const CadShape::Foot foot = shape_->on_edge(e, (a + b) / 2);
        const double distance = (foot.at - (a + b) / 2).norm();
        if (distance >= least || std::abs(foot.direction.dot((b - a).normalized())) < along_shape) continue;
        least = distance;
        best = e;
    }
    return best;
}

NodeConstraints::Foot NodeConstraints::curve_foot(const NodeConstraint& c, const Vec3& x) const {
    const Curve& curve = curves_[c.shape];
    if (curve.straight) {
        Foot foot;
        foot.at = curve.origin + curve.direction.dot(x - curve.origin) * curve.direction;
        foot.normal = curve.direction;
        foot.distance2 = (foot.at - x).squaredNorm();
        foot.facet = c.hint;
        return foot;
    }
    Foot best = foot_on(segments_[c.hint], x);
    best.facet = c.hint;
    const auto too_far = [&](const Segment& s) {
        const double reach = s.radius + std::sqrt(best.distance2);
        return (x - s.centre).squaredNorm() > reach * reach;
    };
    for (int step = 0; step < 256; ++step) {
        const int from = best.facet;
        for (int v : segments_[from].node)
            for (int s : segments_around_[v]) {
                if (s == from || segments_[s].curve != c.shape || too_far(segments_[s])) continue;
                Foot foot = foot_on(segments_[s], x);
                if (foot.distance2 < best.distance2) {
                    best = foot;
                    best.facet = s;
                }
            }
        if (best.facet == from) break;
    }
    const Segment& segment = segments_[best.facet];
    if (segment.cad >= 0) {
        put_on_shape(best, shape_->on_edge(segment.cad, x), x);
    } else if (segment.cad_face >= 0) {
        // A line that only groups mark: the segment put on the face. The closest point of that, from the segment's.
        const Vec3 along = segment.end[1] - segment.end[0];
        double t = std::clamp(along.dot(best.at - segment.end[0]) / along.squaredNorm(), 0.0, 1.0);
        for (int iteration = 0; iteration < 40; ++iteration) {
            const CadShape::Foot on = shape_->on_face(segment.cad_face, segment.end[0] + t * along);
            const Vec3 tangent = along - along.dot(on.direction) * on.direction;
            put_on_shape(best, {on.at, tangent.normalized()}, x);
            const double next = std::clamp(t + tangent.dot(x - on.at) / tangent.squaredNorm(), 0.0, 1.0);
            if (std::abs(next - t) < 1e-15) break;
            t = next;
        }
    }
    return best;
}

bool NodeConstraints::project(const NodeConstraint& c, const Contact& tools, Vec3& x, double held) const {
    const double tight = 1e-14 * size_;
    const auto off_tools = [&](const Vec3& at, const Contact& some) {
        double off = 0;
        for (const Tool* t : some.tools()) off = std::max(off, std::abs(t->distance(at)));
        return off;
    };
    if (c.freedom == NodeFreedom::fixed) return off_tools(x, tools) <= close_;
    const bool free = c.freedom == NodeFreedom::free, surface = c.freedom == NodeFreedom::surface;
    if (free && !tools) return true;
    NodeConstraint at = c;
    const auto foot_of = [&](const Vec3& p) {
        if (!free) return surface ? surface_foot(at, p) : curve_foot(at, p);
        Foot foot;
        foot.at = p;
        return foot;
    };
    const bool exact = free || (surface ? surfaces_[c.shape].flat : curves_[c.shape].straight);
    const double accept = exact ? 1e-12 * size_ : is_on_shape(c) ? 1e-11 * size_ : 1e-9 * size_;
    if (!tools) {
        x = foot_of(x).at;
        return true;
    }
    // The tools that do not merely run along the shape where the node is.
    Contact across = tools;
    const double near = std::max(close_, 1.001 * held);
    const auto done = [&] {
        if (across.count() == tools.count() || off_tools(x, tools) <= 1.001 * held) return true;
        return project(NodeConstraint{}, tools, x) && distance(at, x) <= 2 * close_;
    };
    for (int i = 0; i < 60; ++i) {
        const Foot foot = foot_of(x);
        at.hint = foot.facet;
        // From the foot, along the shape, onto the tangent planes of the tools.
        const auto along_shape = [&](const Vec3& n) {
            if (free) return n;
            const Vec3 off_shape = n.dot(foot.normal) * foot.normal;
            return surface ? Vec3(n - off_shape) : off_shape;
        };
        if (i == 0)
            for (const Tool* t : tools.tools())
                if (along_shape(t->normal(foot.at)).squaredNorm() < parallel && std::abs(t->distance(foot.at)) <= near)
                    across = across.without(t);
        if (std::sqrt(foot.distance2) <= (exact ? tight : accept) && off_tools(x, across) <= tight) return done();
        if (!across) {
            x = foot.at;
        } else if (across.count() == 1) {
            const Vec3 along = along_shape(across.tools()[0]->normal(foot.at));
            const double slope = along.squaredNorm();
            if (slope < parallel) return false;
            x = foot.at - (across.tools()[0]->distance(foot.at) / slope) * along;
        } else {
            // The shortest such step: along = A^T m with A A^T m = -distances.
            const int count = across.count();
            Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> a(count, 3);
            Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> d(count);
            for (int k = 0; k < count; ++k) {
                a.row(k) = along_shape(across.tools()[k]->normal(foot.at)).transpose();
                d[k] = across.tools()[k]->distance(foot.at);
            }
            const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
            if (svd.singularValues()[count - 1] < 1e-3) {
                // More tools than directions: only right where they happen to meet.
                if (off_tools(foot.at, across) > 1e-12 * size_) return false;
                x = foot.at;
                return done();
            }
            x = foot.at - Vec3(svd.solve(d));
        }
    }
    // At a kink of a faceted surface the steps may alternate between two facets: close enough counts.
    const Foot foot = foot_of(x);
    if (std::sqrt(foot.distance2) > (exact ? accept : 1e-6 * size_)) return false;
    return off_tools(x, across) <= 1e-12 * size_ && done();
}

int NodeConstraints::tangents(int node, const Contact& tools, const Vec3& x, Eigen::Matrix3d& basis) const {
    const NodeConstraint& c = nodes_[node];
    // Orthonormal directions the node may not move in.
    Eigen::Matrix3d held;
    int count = 0;
    switch (c.freedom) {
        case NodeFreedom::fixed:
            return 0;
        case NodeFreedom::curve:
            if (tools) return 0;
            basis.col(0) = curve_foot(c, x).normal;
            return 1;
        case NodeFreedom::surface:
            held.col(count++) = surface_foot(c, x).normal;
            break;
        case NodeFreedom::free:
            break;
    }
    for (const Tool* t : tools.tools()) {
        if (count == 3) return 0;
        Vec3 n = t->normal(x);
        for (int k = 0; k < count; ++k) n -= held.col(k).dot(n) * held.col(k);
        const double length = n.norm();
        if (length < 1e-3) {
            if (c.freedom == NodeFreedom::surface && count == 1 && surfaces_[c.shape].flat &&
                std::isinf(t->feature_size()))
                continue;  // a plane on a plane
            return 0;
        }
        held.col(count++) = n / length;
    }
    switch (count) {
        case 0:
            basis.setIdentity();
            return 3;
        case 1:
            basis.col(0) = held.col(0).unitOrthogonal();
            basis.col(1) = held.col(0).cross(basis.col(0));
            return 2;
        case 2:
            basis.col(0) = held.col(0).cross(held.col(1)).normalized();
            return 1;
        default:
            return 0;
    }
}

double NodeConstraints::distance(const NodeConstraint& c, const Vec3& x) const {
    if (c.freedom == NodeFreedom::surface) return std::sqrt(surface_foot(c, x).distance2);
    if (c.freedom == NodeFreedom::curve) return std::sqrt(curve_foot(c, x).distance2);
    return 0;
}

std::vector<int> NodeConstraints::kinds_at(const BandMesh& band, int node) const {
    std::vector<int> kinds;
    for (const int s : band.skin.around(node)) kinds.push_back(surfaces_[band.skin.tag(s)].kind);
    for (const int s : band.creases.around(node)) kinds.push_back(curves_[band.creases.tag(s)].kind);
    const auto alone = std::ranges::lower_bound(isolated_, node, {}, [](const auto& n) { return n.first; });
    if (alone != isolated_.end() && alone->first == node) kinds.push_back(alone->second);
    std::ranges::sort(kinds);
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    return kinds;
}

std::vector<GroupIndex> NodeConstraints::groups_at(const BandMesh& band, int node) const {
    std::set<GroupIndex> groups;
    for (const int kind : kinds_at(band, node)) groups.insert(kinds_.groups(kind).begin(), kinds_.groups(kind).end());
    return {groups.begin(), groups.end()};
}

std::vector<NodeConstraints::GroupCount> NodeConstraints::count_by_group(const BandMesh& band,
                                                                         std::span<const int> nodes,
                                                                         std::size_t group_count) const {
    // Many nodes lie on few combinations of kinds: these are counted, and spread over their groups at the end.
    std::map<std::vector<int>, GroupCount> by_kinds;
    for (const int v : nodes) {
        GroupCount& count = by_kinds[kinds_at(band, v)];
        switch (nodes_[v].freedom) {
            case NodeFreedom::free:
                break;
            case NodeFreedom::surface:
                ++count.surface;
                break;
            case NodeFreedom::curve:
                ++count.line;
                break;
            case NodeFreedom::fixed:
                ++count.fixed;
                break;
        }
    }
    std::vector<GroupCount> out(group_count);
    std::vector<GroupIndex> groups;
    for (const auto& [combination, count] : by_kinds) {
        groups.clear();
        for (const int kind : combination)
            groups.insert(groups.end(), kinds_.groups(kind).begin(), kinds_.groups(kind).end());
        std::ranges::sort(groups);
        groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
        for (const GroupIndex g : groups) {
            out[g].surface += count.surface;
            out[g].line += count.line;
            out[g].fixed += count.fixed;
        }
    }
    return out;
}

std::optional<Vec3> NodeConstraints::surface_normal(const NodeConstraint& c, const Vec3& x) const {
    if (c.freedom != NodeFreedom::surface) return {};
    return surface_foot(c, x).normal;
}

}  // namespace femscalpel
