// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/kept_geometry.h"

#include <cmath>
#include <utility>

#include "cancel.h"

namespace femscalpel {
namespace {

/// Flatness and straightness tolerance relative to the size of the band: coordinates that passed
/// through a text file with nine digits still count as plane.
constexpr double flat_tolerance = 1e-9;

/// A node that moves along a bent line may dent it by this many edge lengths.
constexpr double deepest_dent = 0.05;

/// Sine of the angle up to which the segments of a crack front are in line.
constexpr double straight_front = 1e-6;

using Facet = KeptGeometry::Facet;
using Surface = KeptGeometry::Surface;
using Segment = KeptGeometry::Segment;
using Curve = KeptGeometry::Curve;

/// Rounding grows with the coordinates themselves, so a model far from the origin counts as larger.
double size_of(const BandMesh& band) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const BandNode& n : band.nodes) {
        low = low.cwiseMin(n.at);
        high = high.cwiseMax(n.at);
    }
    if (band.size() == 0) return 1;
    return std::max({(high - low).norm(), 0.1 * low.cwiseAbs().maxCoeff(), 0.1 * high.cwiseAbs().maxCoeff()});
}

/// Twice the area times the normal of the facet's flat triangle.
Vec3 area_of(const Facet& f) { return (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]); }

class Finder {
public:
    Finder(const BandMesh& band, const Mesh& mesh, KeptParts parts, const ConstraintOptions& options)
        : band_(band), mesh_(mesh), parts_(std::move(parts)), smooth_(smooth_cosine(options)) {
        out_.shape = options.shape;
        out_.rounding = options.rounding;
        out_.size = size_of(band);
        out_.match = parts_.match;
        flat_ = out_.flatness();
    }

    KeptGeometry run() {
        make_facets();
        fit_planes();
        find_flat();
        check_cancelled();
        make_segments();
        fit_lines();
        find_straight();
        return std::move(out_);
    }

private:
    const Vec3& at(int node) const { return band_.nodes[node].at; }

    /// The mid-side node of an edge, or else its middle.
    Vec3 middle_of(int a, int b) const {
        const auto it = band_.mid_nodes.find(edge_key(a, b));
        return it == band_.mid_nodes.end() ? Vec3((at(a) + at(b)) / 2) : mesh_.points[it->second];
    }

    /// Faces that are joined are one surface.
    void make_facets() {
        std::vector<int> surface_of(parts_.faces.size(), -1);
        out_.facets.resize(parts_.faces.size());
        out_.facets_around.resize(static_cast<std::size_t>(band_.size()));
        for (int f = 0; f < static_cast<int>(parts_.faces.size()); ++f, check_()) {
            const KeptFace& face = parts_.faces[f];
            int& surface = surface_of[parts_.joined.find(f)];
            if (surface < 0) {
                surface = static_cast<int>(out_.surfaces.size());
                out_.surfaces.push_back({});
                out_.surfaces.back().internal = face.internal;
                out_.surfaces.back().shell = face.shell;
                out_.surfaces.back().kind = face.groups;
            }
            Facet& facet = out_.facets[f];
            facet.node = face.nodes;
            facet.shape = surface;
            facet.cad = face.cad;
            measure(facet);
            for (const int v : face.nodes) out_.facets_around[v].push_back(f);
        }
    }

    /// Where a facet is and how far it reaches, from its nodes.
    void measure(Facet& facet) const {
        std::array<Vec3, 3> chord;  // their middles
        double bulge = 0, longest = 0;
        for (int k = 0; k < 3; ++k) facet.corner[k] = at(facet.node[k]);
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            chord[k] = (facet.corner[k] + facet.corner[next]) / 2;
            facet.mid[k] = middle_of(facet.node[k], facet.node[next]);
            bulge = std::max(bulge, (facet.mid[k] - chord[k]).norm());
            longest = std::max(longest, (facet.corner[k] - facet.corner[next]).norm());
        }
        facet.curved = bulge > flat_;
        facet.centre = (facet.corner[0] + facet.corner[1] + facet.corner[2]) / 3;
        facet.sag = bulge * 4 / 3;
        facet.height = area_of(facet).norm() / longest;
        // The hull of its Bezier points holds a second-order facet.
        for (int k = 0; k < 3; ++k) {
            const Vec3 control = 2 * facet.mid[k] - chord[k];
            facet.radius =
                std::max({facet.radius, (facet.corner[k] - facet.centre).norm(), (control - facet.centre).norm()});
        }
    }

    /// The plane of a surface: through its largest facet, the best defined normal.
    void fit_planes() {
        std::vector<double> largest(out_.surfaces.size(), -1);
        for (const Facet& f : out_.facets) {
            const Vec3 n = area_of(f);
            if (n.norm() > largest[f.shape]) {
                largest[f.shape] = n.norm();
                out_.surfaces[f.shape].normal = n.normalized();
                out_.surfaces[f.shape].origin = f.corner[0];
            }
        }
        if (out_.rounding > 0) average_planes();
    }

    /// Where coordinates are rounded, all facets together define it better.
    void average_planes() {
        std::vector<Surface>& surfaces = out_.surfaces;
        std::vector<Vec3> sum(surfaces.size(), Vec3::Zero()), middle(surfaces.size(), Vec3::Zero());
        std::vector<int> count(surfaces.size(), 0);
        for (const Facet& f : out_.facets) {
            const Vec3 n = area_of(f);
            sum[f.shape] += n.dot(surfaces[f.shape].normal) < 0 ? Vec3(-n) : n;
            middle[f.shape] += f.centre;
            ++count[f.shape];
        }
        for (std::size_t k = 0; k < surfaces.size(); ++k) {
            surfaces[k].normal = sum[k].normalized();
            surfaces[k].origin = middle[k] / count[k];
        }
    }

    void find_flat() {
        for (const Facet& f : out_.facets) {
            Surface& s = out_.surfaces[f.shape];
            if (f.cad >= 0 && !out_.shape->is_plane(f.cad)) s.flat = false;
            for (int k = 0; k < 3; ++k)
                for (const Vec3& p : {f.corner[k], f.mid[k]})
                    if (std::abs(s.normal.dot(p - s.origin)) > flat_) s.flat = false;
        }
    }

    /// Creases that are chained are one curve.
    void make_segments() {
        UnionFind chained = chain();
        std::vector<int> curve_of(parts_.creases.size(), -1);
        out_.segments.resize(parts_.creases.size());
        for (int c = 0; c < static_cast<int>(parts_.creases.size()); ++c, check_()) {
            const KeptCrease& crease = parts_.creases[c];
            Segment& segment = out_.segments[c];
            segment.node = crease.nodes;
            segment.fold = crease.fold;
            segment.cad = crease.cad;
            if (segment.cad < 0 && crease.cad_face >= 0 && !out_.shape->is_plane(crease.cad_face))
                segment.cad_face = crease.cad_face;
            for (int k = 0; k < 2; ++k) segment.end[k] = at(segment.node[k]);
            const Vec3 chord = (segment.end[0] + segment.end[1]) / 2;
            segment.mid = middle_of(segment.node[0], segment.node[1]);
            segment.curved = (segment.mid - chord).norm() > flat_;
            segment.centre = chord;
            segment.radius = std::max((segment.end[0] - chord).norm(), 2 * (segment.mid - chord).norm());
            int& curve = curve_of[chained.find(c)];
            if (curve < 0) {
                curve = static_cast<int>(out_.curves.size());
                out_.curves.push_back({true, crease.border, crease.groups, segment.end[0],
                                       (segment.end[1] - segment.end[0]).normalized()});
            }
            segment.shape = curve;
        }
    }

    /// Joins creases at nodes where exactly two of one kind meet without a kink.
    UnionFind chain() {
        const std::vector<KeptCrease>& creases = parts_.creases;
        out_.segments_around.resize(static_cast<std::size_t>(band_.size()));
        for (int c = 0; c < static_cast<int>(creases.size()); ++c)
            for (int v : creases[c].nodes) out_.segments_around[v].push_back(c);
        const auto direction_from = [&](int c, int from) {
            const auto& e = creases[c].nodes;
            return (at(e[0] == from ? e[1] : e[0]) - at(from)).normalized();
        };
        UnionFind chained(creases.size());
        out_.passes.assign(static_cast<std::size_t>(band_.size()), 0);
        for (int v = 0; v < band_.size(); ++v) {
            const auto& c = out_.segments_around[v];
            if (c.size() != 2 || creases[c[0]].kind != creases[c[1]].kind) continue;
            const double limit = creases[c[0]].cad >= 0 && creases[c[0]].cad == creases[c[1]].cad ? 0 : smooth_;
            if (direction_from(c[0], v).dot(direction_from(c[1], v)) >= limit) continue;
            out_.passes[v] = 1;
            chained.unite(c[0], c[1]);
        }
        return chained;
    }

    /// The direction of a curve: from its first segment to the end farthest away, the best defined one.
    void fit_lines() {
        std::vector<double> reach(out_.curves.size(), 0);
        for (const Segment& s : out_.segments)
            for (const Vec3& p : s.end) {
                Curve& c = out_.curves[s.shape];
                const double length = (p - c.origin).norm();
                if (length > reach[s.shape]) {
                    reach[s.shape] = length;
                    c.direction = (p - c.origin) / length;
                }
            }
    }

    void find_straight() {
        for (const Segment& s : out_.segments) {
            Curve& c = out_.curves[s.shape];
            if ((s.cad >= 0 && !out_.shape->is_line(s.cad)) || s.cad_face >= 0) c.straight = false;
            for (const Vec3& p : {s.end[0], s.end[1], s.mid})
                if (c.direction.cross(p - c.origin).norm() > flat_) c.straight = false;
        }
    }

    const BandMesh& band_;
    const Mesh& mesh_;
    KeptParts parts_;
    double smooth_;
    double flat_ = 0;
    SparseCheck check_{64};
    KeptGeometry out_;
};

/// Whether the facets around a node are one closed fan of one surface.
bool is_one_fan(const KeptGeometry& g, const std::vector<int>& around) {
    std::vector<int> fan{around[0]};
    for (std::size_t k = 0; k < fan.size(); ++k)
        for (int f : around)
            if (std::ranges::find(fan, f) == fan.end()) {
                int shared = 0;
                for (int w : g.facets[f].node)
                    shared += std::ranges::find(g.facets[fan[k]].node, w) != g.facets[fan[k]].node.end();
                if (shared >= 2) fan.push_back(f);
            }
    return fan.size() == around.size() &&
           std::ranges::all_of(around, [&](int f) { return g.facets[f].shape == g.facets[around[0]].shape; });
}

/// The place of a node that two segments of one curve pass through.
KeptGeometry::Place place_on_curve(const KeptGeometry& g, int node) {
    const Segment &first = g.segments[g.segments_around[node][0]], &second = g.segments[g.segments_around[node][1]];
    KeptGeometry::Place place{g.on_segment(g.segments_around[node][0])};
    // Moved by s, the node leaves a dent of about s sin(bend).
    double length = std::numeric_limits<double>::infinity();
    const auto away = [&](const Segment& s) {
        const int here = s.node[0] == node ? 0 : 1;
        length = std::min(length, (s.end[1] - s.end[0]).norm());
        return (4 * s.mid - 3 * s.end[here] - s.end[1 - here]).normalized();
    };
    const Vec3 one = away(first), other = away(second);
    const double bend = one.cross(other).norm();
    if (first.fold && second.fold && bend > std::max(straight_front, g.rounding / length))
        place.constraint.freedom = NodeFreedom::fixed;
    else if (bend > 0 && first.cad < 0)
        place.leash = deepest_dent / bend * length;
    return place;
}

}  // namespace

double KeptGeometry::flatness() const {
    // The plane and line go through nodes that are off by as much themselves.
    return std::max(flat_tolerance * size, rounding);
}

KeptGeometry::Place KeptGeometry::place_of(int node) const {
    if (!segments_around[node].empty())
        return passes[node] ? place_on_curve(*this, node) : Place{{.freedom = NodeFreedom::fixed}};
    const auto& around = facets_around[node];
    if (around.empty()) return {};
    Place place{on_facet(around[0])};
    // Two sheets that touch in this node alone pin it.
    if (!is_one_fan(*this, around)) place.constraint.freedom = NodeFreedom::fixed;
    return place;
}

void KeptGeometry::mark(BandMesh& band) const {
    for (const Facet& f : facets) band.skin.add(f.node, f.shape);
    for (const Segment& s : segments) band.creases.add(s.node, s.shape);
}

KeptGeometry find_kept_geometry(const BandMesh& band, const Mesh& mesh, const BandBoundaries& boundaries,
                                const ConstraintOptions& options) {
    return Finder(band, mesh, find_kept_parts(band, boundaries, options), options).run();
}

}  // namespace femscalpel
