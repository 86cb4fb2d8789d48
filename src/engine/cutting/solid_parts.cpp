// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/solid_parts.h"

#include <algorithm>
#include <limits>

#include "deformation/mid_sides.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// Fewer parts are worth so much quality.
constexpr double worth_fewer = 0.7;
/// A node in the middle is moved where parts are poorer than this.
constexpr double good = 0.3;
/// Parts around a corner that are as good as this are good enough not to look for better.
constexpr double good_corner = 0.7;

/// The mean ratio of a pyramid by its corners: the smallest over those of its base, the regular one has 1.
double pyramid_quality(const std::array<Vec3, 5>& x) {
    constexpr double height = 0.70710678118654752;
    static const double regular = mean_ratio(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, height));
    double worst = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) worst = std::min(worst, mean_ratio(x[k], x[(k + 1) % 4], x[(k + 3) % 4], x[4]));
    return worst / regular;
}

class Cutter {
public:
    Cutter(const Mesh& mesh, const CellRef& cell, const Conversion& conversion, QuadCuts& cuts)
        : mesh_(mesh),
          type_(cell.type),
          nodes_(mesh.block(cell.type).nodes(cell.cell)),
          cuts_(cuts),
          rules_(conversion.rules),
          shape_(cell.type, nodes_),
          second_order_(traits(cell.type).quadratic) {
        const std::vector<ElementFace> faces = faces_of(mesh, cell);
        sides_.reserve(faces.size());
        for (const ElementFace& f : faces) {
            Side& side = sides_.emplace_back(f, f.count == 4 && conversion.bases.contains(quad_key(f.corners)));
            if (f.count == 3) side.cut[side.count++] = {f.corners[0], f.corners[1], f.corners[2]};
            if (f.count == 4 && !side.is_base)
                for (const auto& triangle : cuts.triangles(f.corners)) side.cut[side.count++] = triangle;
        }
    }

    SolidParts run() {
        SolidParts best;
        std::vector<Index> tried;
        for (int k = 0; k < traits(type_).corners; ++k) {
            if (std::ranges::find(tried, nodes_[k]) != tried.end()) continue;
            tried.push_back(nodes_[k]);
            if (!sees_all(nodes_[k]) || !may_be_tip(nodes_[k])) continue;
            SolidParts parts = from_corner(nodes_[k]);
            if (parts.quality > best.quality * (1 + 1e-9)) best = std::move(parts);
        }
        if (traits(type_).corners == 5 || best.quality >= good_corner) return best;
        SolidParts inside = from_middle();
        return inside.quality > 0 && best.quality < worth_fewer * inside.quality ? inside : best;
    }

private:
    struct Side {
        ElementFace face;
        bool is_base;
        std::array<std::array<Index, 3>, 2> cut{};
        std::size_t count = 0;

        Side(const ElementFace& f, bool base) : face(f), is_base(base) {}
        std::span<const std::array<Index, 3>> triangles() const { return std::span(cut).first(count); }
    };

    static bool has(const ElementFace& face, Index node) {
        const auto corners = std::span(face.corners).first(static_cast<std::size_t>(face.count));
        return std::ranges::find(corners, node) != corners.end();
    }

    /// Whether the faces at a corner are cut through it.
    bool sees_all(Index corner) const {
        return std::ranges::all_of(sides_, [&](const Side& s) {
            if (!has(s.face, corner) || s.face.count == 3) return true;
            return !s.is_base && std::ranges::all_of(s.triangles(), [&](const auto& triangle) {
                return std::ranges::find(triangle, corner) != triangle.end();
            });
        });
    }

    bool may_be_tip(Index corner) const {
        return rules_.empty() || rules_[corner] == PyramidRule::any ||
               std::ranges::none_of(sides_, [&](const Side& s) { return s.is_base && !has(s.face, corner); });
    }

    std::vector<SolidPart> parts_to(Index tip) const {
        std::vector<SolidPart> out;
        out.reserve(2 * sides_.size());
        for (const Side& s : sides_) {
            if (has(s.face, tip)) continue;
            for (const auto& [a, b, c] : s.triangles()) out.push_back({{a, b, c, tip}, 4});
            if (s.is_base) {
                const auto& q = s.face.corners;
                out.push_back({{q[0], q[1], q[2], q[3], tip}, 5});
            }
        }
        return out;
    }

    SolidParts from_corner(Index tip) const {
        SolidParts out;
        out.parts = parts_to(tip);
        return finished(std::move(out), reference(tip));
    }

    SolidParts from_middle() const {
        if (type_ == CellType::hexahedron27) {
            SolidParts out;
            out.parts = parts_to(-1);
            out.centre_node = nodes_[26];
            out.centre = {{nodes_[26], 1}};
            return finished(std::move(out), ShapeBlend::middle(type_));
        }
        Vec3 at = ShapeBlend::middle(type_);
        SolidParts best = from_inside(at);
        for (double step = 0.3; best.quality < good && step > 0.05;) {
            bool better = false;
            // The poorest part decides, of which there may be two at once: also ways between the axes.
            for (int k = 0; k < 27; ++k) {
                const int row = k / 3, layer = k / 9;
                const Vec3 way(k % 3 - 1, row % 3 - 1, layer - 1);
                const Vec3 there = at + step / std::max(1.0, way.norm()) * way;
                if (k == 13 || !ShapeBlend::inside(type_, there, 0.1)) continue;
                SolidParts other = from_inside(there);
                if (!(other.quality > best.quality)) continue;
                best = std::move(other);
                at = there;
                better = true;
            }
            if (!better) step /= 2;
        }
        return best;
    }

    SolidParts from_inside(const Vec3& at) const {
        SolidParts out;
        out.parts = parts_to(-1);
        out.centre = shape_.at(at);
        return finished(std::move(out), at);
    }

    /// Reference coordinates of a corner; of one that is there several times, their mean.
    Vec3 reference(Index corner) const {
        Vec3 sum = Vec3::Zero();
        int count = 0;
        for (int k = 0; k < traits(type_).corners; ++k)
            if (nodes_[k] == corner) {
                sum += ShapeBlend::corner(type_, k);
                ++count;
            }
        return sum / count;
    }

    /// With the mid-side nodes of edges to the tip, which has the reference coordinates `tip`, and the quality.
    SolidParts finished(SolidParts out, const Vec3& tip) const {
        if (second_order_) place_middles(out, tip);
        out.quality = out.parts.empty() ? -1 : std::numeric_limits<double>::infinity();
        for (const SolidPart& part : out.parts) out.quality = std::min(out.quality, quality(out, part));
        if (second_order_ && out.quality <= 0 && !out.middles.empty()) straighten(out);
        return out;
    }

    void place_middles(SolidParts& out, const Vec3& tip) const {
        const bool can_bend = traits(type_).corners != 5;
        for (const SolidPart& part : out.parts) {
            const Index to = part.corners[part.count - 1];
            for (int k = 0; k + 1 < part.count; ++k) {
                const Index from = part.corners[k];
                if (to >= 0 && cuts_.middle(from, to) >= 0) continue;
                const std::array<Index, 2> edge{from, to};
                if (std::ranges::any_of(out.middles, [&](const auto& m) { return m.first == edge; })) continue;
                Blend at = half_way(out, edge);
                if (can_bend) {
                    add(at, shape_.bulge((reference(from) + tip) / 2));
                    if (to < 0) add(at, shape_.bulge(tip), -0.5);
                }
                out.middles.emplace_back(edge, std::move(at));
            }
        }
    }

    static Blend half_way(const SolidParts& out, const std::array<Index, 2>& edge) {
        Blend at{{edge[0], 0.5}};
        add(at, edge[1] < 0 ? out.centre : Blend{{edge[1], 1}}, 0.5);
        return at;
    }

    /// Takes straight edges to the tip if these are better.
    void straighten(SolidParts& out) const {
        SolidParts straight = out;
        for (auto& [edge, at] : straight.middles) at = half_way(straight, edge);
        straight.quality = std::numeric_limits<double>::infinity();
        for (const SolidPart& part : straight.parts)
            straight.quality = std::min(straight.quality, quality(straight, part));
        if (straight.quality > out.quality) out = std::move(straight);
    }

    Vec3 place(const SolidParts& of, Index node) const {
        return node < 0 ? place_of(mesh_, of.centre) : mesh_.points[node];
    }

    Vec3 middle(const SolidParts& of, Index a, Index b) const {
        if (a >= 0 && b >= 0)
            if (const Index node = cuts_.middle(a, b); node >= 0) return mesh_.points[node];
        for (const auto& [edge, at] : of.middles)
            if ((edge[0] == a && edge[1] == b) || (edge[0] == b && edge[1] == a)) return place_of(mesh_, at);
        return (place(of, a) + place(of, b)) / 2;
    }

    double quality(const SolidParts& of, const SolidPart& part) const {
        std::array<Vec3, 5> x;
        for (int k = 0; k < part.count; ++k) x[k] = place(of, part.corners[k]);
        if (part.count == 5) return pyramid_quality(x);
        const double straight = mean_ratio(x[0], x[1], x[2], x[3]);
        if (!second_order_ || straight <= 0) return straight;
        const CellTraits& t = traits(CellType::tetra10);
        std::array<Vec3, 10> curved;
        for (int k = 0; k < 4; ++k) curved[k] = x[k];
        for (std::size_t e = 0; e < t.edges.size(); ++e)
            curved[4 + e] = middle(of, part.corners[t.edges[e][0]], part.corners[t.edges[e][1]]);
        const double ratio = integration_ratio(curved);
        return straight * std::min(1.0, ratio);
    }

    const Mesh& mesh_;
    CellType type_;
    std::span<const Index> nodes_;
    QuadCuts& cuts_;
    const std::vector<PyramidRule>& rules_;
    ShapeBlend shape_;
    bool second_order_;
    std::vector<Side> sides_;
};

}  // namespace

SolidParts cut_solid(const Mesh& mesh, const CellRef& cell, const Conversion& conversion, QuadCuts& cuts) {
    return Cutter(mesh, cell, conversion, cuts).run();
}

}  // namespace femscalpel
