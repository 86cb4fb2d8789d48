// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/kept_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <span>

#include "cancel.h"
#include "groups/band_boundaries.h"

namespace femscalpel {
namespace {

/// Faces at a smaller angle than this (cosine) are the two lips of a crack.
constexpr double closed_fold = 0.9999;

/// A mesh lies on the shape it was made from to this, in sizes of the shape.
constexpr double shape_tolerance = 1e-5;

/// A triangle or segment runs along a face or edge of the shape: cosine of the angle between them.
constexpr double along_shape = 0.5;

/// The face of the shape on which a triangle with these corners lies, or -1.
int shape_face(const CadShape& shape, const std::array<Vec3, 3>& corner) {
    const double tolerance = shape_tolerance * shape.size();
    std::vector<int> common = shape.faces_at(corner[0], tolerance);
    for (int k = 1; k < 3 && !common.empty(); ++k) {
        const std::vector<int> here = shape.faces_at(corner[k], tolerance);
        std::erase_if(common, [&](int f) { return std::ranges::find(here, f) == here.end(); });
    }
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3,
               normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int f : common) {
        const CadShape::Foot foot = shape.on_face(f, middle);
        const double distance = (foot.at - middle).norm();
        if (distance >= least || std::abs(foot.direction.dot(normal)) < along_shape) continue;
        least = distance;
        best = f;
    }
    return best;
}

/// The edge of the shape on which the segment from `a` to `b` lies, or -1.
int shape_edge(const CadShape& shape, const Vec3& a, const Vec3& b) {
    const double tolerance = shape_tolerance * shape.size();
    const std::vector<int> at_b = shape.edges_at(b, tolerance);
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const int e : shape.edges_at(a, tolerance)) {
        if (std::ranges::find(at_b, e) == at_b.end()) continue;
        const CadShape::Foot foot = shape.on_edge(e, (a + b) / 2);
        const double distance = (foot.at - (a + b) / 2).norm();
        if (distance >= least || std::abs(foot.direction.dot((b - a).normalized())) < along_shape) continue;
        least = distance;
        best = e;
    }
    return best;
}

/// A face and its edge with this key.
struct FaceEdge {
    std::uint64_t key;
    int face;
    auto operator<=>(const FaceEdge&) const = default;
};

std::array<int, 2> ends_of(std::uint64_t key) {
    return {static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)};
}

class PartFinder {
public:
    PartFinder(const BandMesh& band, const BandBoundaries& boundaries, const ConstraintOptions& options)
        : band_(band), boundaries_(boundaries), shape_(options.shape), smooth_(smooth_cosine(options)) {}

    KeptParts run() {
        find_faces();
        find_lines();
        look_at_edges();
        for (const auto& [key, line] : lines_) add_crease(key, {}, line);  // segments inside the material
        return std::move(out_);
    }

private:
    const Vec3& at(int node) const { return band_.nodes[node].at; }
    bool movable(const std::array<int, 2>& edge) const {
        return band_.nodes[edge[0]].movable() || band_.nodes[edge[1]].movable();
    }

    void find_faces() {
        for (const BandBoundaries::Face& f : boundaries_.faces()) {
            check_();
            // Faces that differ in this are never one surface.
            const int place = f.is_shell() ? 0 : f.is_skin() ? 1 : 2;
            int cad = -1;
            if (shape_ && !f.is_internal()) {
                cad = shape_face(*shape_, {at(f.nodes[0]), at(f.nodes[1]), at(f.nodes[2])});
                ++out_.match.faces;
                out_.match.off += cad < 0;
            }
            out_.faces.push_back(
                {f.nodes, (f.kind * 3 + place) * 2 + f.element, f.kind, f.is_internal(), f.is_shell(), cad});
        }
        out_.joined = UnionFind(out_.faces.size());
    }

    void find_lines() {
        for (const BandBoundaries::Line& l : boundaries_.lines())
            if (movable(l.nodes)) lines_.emplace(edge_key(l.nodes[0], l.nodes[1]), &l);
    }

    /// Smooth edges join faces to surfaces, the others are creases.
    void look_at_edges() {
        std::vector<FaceEdge> edges;
        edges.reserve(out_.faces.size() * 3);
        for (int f = 0; f < static_cast<int>(out_.faces.size()); ++f)
            for (int k = 0; k < 3; ++k) {
                const std::array<int, 2> e{out_.faces[f].nodes[k], out_.faces[f].nodes[(k + 1) % 3]};
                if (movable(e)) edges.push_back({edge_key(e[0], e[1]), f});
            }
        std::ranges::sort(edges);
        for (std::size_t i = 0; i < edges.size();) {
            check_();
            std::size_t end = i;
            while (end < edges.size() && edges[end].key == edges[i].key) ++end;
            look_at_edge(std::span(edges).subspan(i, end - i));
            i = end;
        }
    }

    void look_at_edge(std::span<const FaceEdge> around) {
        const std::uint64_t key = around[0].key;
        const auto line = lines_.find(key);
        const bool smooth = around.size() == 2 && is_smooth(key, around[0].face, around[1].face);
        // A segment on a smooth surface does not part it.
        if (smooth) out_.joined.unite(around[0].face, around[1].face);
        if (line != lines_.end()) {
            add_crease(key, around, line->second);
            lines_.erase(line);
        } else if (!smooth) {
            add_crease(key, around, nullptr);
        }
    }

    void add_crease(std::uint64_t key, std::span<const FaceEdge> around, const BandBoundaries::Line* line) {
        constexpr int none = -1;
        std::vector<int> kind{line ? line->kind * 2 + line->element : none};
        std::set<int> cads;
        for (const FaceEdge& e : around) {
            const KeptFace& face = out_.faces[e.face];
            kind.push_back(face.kind);
            if (!face.internal) cads.insert(face.cad);
        }
        std::sort(kind.begin() + 1, kind.end());
        const std::array<int, 2> ends = ends_of(key);
        // Faces of the shape meet here, or one ends.
        const bool parts_shape = cads.size() > 1 || around.size() == 1;
        out_.creases.push_back({ends, kinds_.emplace(std::move(kind), static_cast<int>(kinds_.size())).first->second,
                                line ? line->kind : 0, around.size() == 1 && out_.faces[around[0].face].shell,
                                folds_back(key, around),
                                shape_ && parts_shape ? shape_edge(*shape_, at(ends[0]), at(ends[1])) : -1,
                                cads.size() == 1 ? *cads.begin() : -1});
    }

    /// Cosine of the angle between two faces around an edge; 1 if they lie on each other.
    double opening(std::uint64_t key, int f, int g) const {
        const auto [a, b] = ends_of(key);
        const Vec3 along = (at(b) - at(a)).normalized();
        const auto across = [&](int face) {
            for (int v : out_.faces[face].nodes)
                if (v != a && v != b) {
                    const Vec3 w = at(v) - at(a);
                    return Vec3((w - along * along.dot(w)).normalized());
                }
            return Vec3(Vec3::Zero());
        };
        return across(f).dot(across(g));
    }

    bool is_smooth(std::uint64_t key, int f, int g) const {
        const KeptFace &one = out_.faces[f], &other = out_.faces[g];
        // Between coarse triangles of one face of the shape there is a kink, but no feature line.
        const double limit = one.cad >= 0 && one.cad == other.cad ? 0 : smooth_;
        return one.kind == other.kind && opening(key, f, g) < limit;
    }

    bool folds_back(std::uint64_t key, std::span<const FaceEdge> around) const {
        for (std::size_t k = 0; k < around.size(); ++k)
            for (std::size_t j = 0; j < k; ++j) {
                const int f = around[j].face, g = around[k].face;
                if (!out_.faces[f].internal && !out_.faces[g].internal && opening(key, f, g) > closed_fold) return true;
            }
        return false;
    }

    const BandMesh& band_;
    const BandBoundaries& boundaries_;
    const CadShape* shape_;
    double smooth_;
    SparseCheck check_{64};
    std::map<std::uint64_t, const BandBoundaries::Line*> lines_;  // by edge; those that are no creases yet
    std::map<std::vector<int>, int> kinds_;  // of creases: the line's, then those of the faces, ascending
    KeptParts out_;
};

}  // namespace

double smooth_cosine(const ConstraintOptions& options) {
    return -std::cos(options.feature_angle * std::numbers::pi / 180);
}

KeptParts find_kept_parts(const BandMesh& band, const BandBoundaries& boundaries, const ConstraintOptions& options) {
    return PartFinder(band, boundaries, options).run();
}

}  // namespace femscalpel
