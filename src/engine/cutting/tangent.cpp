// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/tangent.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "cancel.h"
#include "cutting/wall.h"
#include "deformation/fitted_tool.h"

namespace femscalpel {
namespace {

/// Cosine of the angle to the wall's normal from which on a surface runs along its motion.
constexpr double along_motion = 0.02;
/// A strip beside a wall is narrower than this part of the wall.
constexpr double narrow = 0.5;

class TangentFinder {
public:
    TangentFinder(const Workpiece& f, const Covered& covered, double feature_angle)
        : f_(f),
          band_(f.d.band),
          g_(f.d.constraints.geometry()),
          faces_(covered.faces),
          smooth_(std::cos(feature_angle * std::numbers::pi / 180)),
          tolerance_(std::max(1e-8 * g_.size, g_.rounding)) {
        for (int v = 0; v < band_.size(); ++v) local_.emplace(band_.nodes[v].global, v);
        for (const auto& part : covered.parts)
            if (const int slot = slot_of(part); slot >= 0) wall_.insert(slot);
    }

    Beside run(const std::vector<std::array<Index, 3>>& following) {
        Beside out;
        if (wall_.empty() || !std::ranges::all_of(wall_, [&](int k) { return is_outside(k); })) return out;
        find_same(out);
        for (const auto& part : following)
            if (const int slot = slot_of(part); slot >= 0) following_.insert(slot);
        find_following(out);
        return out;
    }

private:
    int slot_of(const std::array<Index, 3>& part) const {
        std::array<int, 3> v{};
        for (int k = 0; k < (faces_ ? 3 : 2); ++k) {
            const auto it = local_.find(part[k]);
            if (it == local_.end()) return -1;
            v[k] = it->second;
        }
        return faces_ ? band_.skin.find(v) : band_.creases.find({v[0], v[1]});
    }

    bool is_outside(int k) const {
        return faces_ ? g_.surfaces[g_.facets[k].shape].is_skin() : g_.curves[g_.segments[k].shape].border;
    }

    std::span<const int> nodes(int k) const {
        return faces_ ? std::span<const int>(g_.facets[k].node) : std::span<const int>(g_.segments[k].node);
    }

    std::array<Index, 3> part(int k) const {
        std::array<Index, 3> out{-1, -1, -1};
        const auto v = nodes(k);
        for (std::size_t i = 0; i < v.size(); ++i) out[i] = band_.nodes[v[i]].global;
        return ascending(out);
    }

    /// Unit normal out of the material.
    Vec3 normal(int k) const {
        if (faces_) {
            const auto& c = g_.facets[k].corner;
            return (c[1] - c[0]).cross(c[2] - c[0]).normalized();
        }
        const KeptGeometry::Segment& s = g_.segments[k];
        Vec3 out = Vec3::Zero();
        for (const int t : band_.triangles.around(s.node[0])) {
            const auto& v = band_.triangles[t];
            if (std::ranges::find(v, s.node[1]) == v.end()) continue;
            out = (s.end[1] - s.end[0]).cross(f_.d.shell_normals[t]).normalized();
            for (const int w : v)
                if (w != s.node[0] && w != s.node[1] && out.dot(band_.nodes[w].at - s.end[0]) > 0) out = -out;
        }
        return out;
    }

    /// Calls visit(part) for those at a common edge (of edges: node).
    void for_each_beside(int k, auto visit) const {
        const auto v = nodes(k);
        if (!faces_) {
            for (const int n : v)
                for (const int o : g_.segments_around[n])
                    if (o != k) visit(o);
            return;
        }
        for (int i = 0; i < 3; ++i) {
            const int a = v[i], b = v[(i + 1) % 3];
            for (const int o : g_.facets_around[a])
                if (o != k && std::ranges::find(g_.facets[o].node, b) != g_.facets[o].node.end()) visit(o);
        }
    }

    bool goes_on(int from, int k) const {
        return !wall_.contains(k) && is_outside(k) && normal(from).dot(normal(k)) > smooth_;
    }
    bool is_candidate(int from, int k) const { return !following_.contains(k) && goes_on(from, k); }

    SurfaceSample sample(const std::vector<int>& parts) const {
        if (faces_) return sample_of(g_, parts);
        SurfaceSample out;
        for (const int k : parts) {
            const KeptGeometry::Segment& s = g_.segments[k];
            out.points.insert(out.points.end(), s.end.begin(), s.end.end());
            if (s.curved) out.points.push_back(s.mid);
            out.normals.push_back(normal(k));
        }
        return out;
    }

    int shape(int k) const { return faces_ ? g_.facets[k].shape : g_.segments[k].shape; }

    /// The surface that a part of the wall lies on, if it is a known one.
    const Tool* tool_of(int wall_shape) {
        const auto [it, fresh] = tools_.try_emplace(wall_shape);
        if (!fresh) return it->second.get();
        std::vector<int> parts;
        for (const int k : wall_)
            if (shape(k) == wall_shape) parts.push_back(k);
        SurfaceSample s = sample(parts);
        if (!faces_) double_across(s, f_.d.shell_normals[band_.triangles.around(nodes(parts[0])[0])[0]], g_.size);
        it->second = fitted_tool(s.points, s.normals, tolerance_, {});
        return it->second.get();
    }

    bool lies_on(const Tool& tool, int k) const {
        const SurfaceSample s = sample({k});
        return std::ranges::all_of(s.points,
                                   [&](const Vec3& x) { return std::abs(tool.distance(x)) <= 2 * tolerance_; });
    }

    void find_same(Beside& out) {
        std::vector<std::pair<int, const Tool*>> front;
        front.reserve(wall_.size());
        for (const int k : wall_) front.emplace_back(k, tool_of(shape(k)));
        for (std::size_t i = 0; i < front.size(); ++i) {
            check_cancelled();
            const auto [from, tool] = front[i];
            if (!tool) continue;
            for_each_beside(from, [&](int k) {
                if (!is_candidate(from, k) || !lies_on(*tool, k)) return;
                wall_.insert(k);
                out.same.push_back(part(k));
                front.emplace_back(k, tool);
            });
        }
    }

    Vec3 middle(int k) const {
        Vec3 sum = Vec3::Zero();
        for (const int v : nodes(k)) sum += band_.nodes[v].at;
        return sum / static_cast<double>(nodes(k).size());
    }

    /// Parts of the wall beside which it goes on.
    std::vector<int> find_seam() const {
        std::vector<int> out;
        for (const int k : wall_) {
            bool ends = false;
            for_each_beside(k, [&](int o) { ends = ends || goes_on(k, o); });
            if (ends) out.push_back(k);
        }
        return out;
    }

    double extent() const {
        Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (const int k : wall_)
            for (const int v : nodes(k)) {
                low = low.cwiseMin(band_.nodes[v].at);
                high = high.cwiseMax(band_.nodes[v].at);
            }
        return (high - low).norm();
    }

    void find_following(Beside& out) {
        std::vector<int> front = find_seam();
        if (front.empty()) return;
        const std::vector<int> seam = front;
        front.insert(front.end(), following_.begin(), following_.end());
        const double reach = narrow * extent();
        for (std::size_t i = 0; i < front.size(); ++i) {
            check_cancelled();
            const int from = front[i];
            for_each_beside(from, [&](int k) {
                if (!is_candidate(from, k)) return;
                const Vec3 at = middle(k);
                const int nearest =
                    *std::ranges::min_element(seam, {}, [&](int w) { return (middle(w) - at).squaredNorm(); });
                // It moves along the normal of the wall's surface, which facets only come near.
                const Tool* tool = tool_of(shape(nearest));
                const Vec3 push = tool ? tool->normal(at) : normal(nearest);
                if (std::abs(normal(k).dot(push)) < along_motion) return;
                if ((at - middle(nearest)).norm() > reach)
                    throw ToolError("the wall goes on smoothly beside the group, far from it (near " + describe(at) +
                                        "); put that into the group, or move less of it",
                                    "group");
                following_.insert(k);
                out.following.push_back(part(k));
                front.push_back(k);
            });
        }
    }

    static std::string describe(const Vec3& x) {
        const auto text = [](double v) {
            std::string s = std::to_string(v);
            return s.substr(0, s.find('.') + 3);
        };
        return "(" + text(x[0]) + ", " + text(x[1]) + ", " + text(x[2]) + ")";
    }

    const Workpiece& f_;
    const BandMesh& band_;
    const KeptGeometry& g_;
    const bool faces_;
    const double smooth_, tolerance_;
    std::map<Index, int> local_;
    std::set<int> wall_, following_;  // slots
    std::map<int, std::unique_ptr<Tool>> tools_;
};

}  // namespace

Beside parts_beside(const Workpiece& f, const Covered& covered, const std::vector<std::array<Index, 3>>& following,
                    double feature_angle) {
    return TangentFinder(f, covered, feature_angle).run(following);
}

}  // namespace femscalpel
