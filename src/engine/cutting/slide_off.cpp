// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/slide_off.h"

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "cancel.h"
#include "cutting/merging.h"
#include "mesh/closest_point.h"
#include "mesh/near_boxes.h"

namespace femscalpel {
namespace {

/// A part of the rim that goes into what is kept beside it.
struct Slide {
    Vec3 to;
    int tag;  // of the surface or line
    double off;
};

Eigen::AlignedBox3d box_of(const BandMesh& band, const auto& nodes) {
    Eigen::AlignedBox3d out;
    for (const int v : nodes) out.extend(band.nodes[v].at);
    return out;
}

/// `distance`: of a point from a part of `kept`.
std::optional<Vec3> first_off(const BandMesh& band, const auto& kept, const std::vector<Slide>& slides, auto distance) {
    std::vector<Eigen::AlignedBox3d> ends, parts;
    for (const Slide& s : slides) ends.emplace_back(s.to - Vec3::Constant(s.off), s.to + Vec3::Constant(s.off));
    std::vector<int> slots;
    for (int s = 0; s < kept.size(); ++s)
        if (kept.alive(s)) {
            slots.push_back(s);
            parts.push_back(box_of(band, kept[s]));
        }
    std::vector<char> on(slides.size(), 0);
    SparseCheck check(256);
    for (const auto& [k, p] : near_boxes(ends, parts)) {
        check();
        if (kept.tag(slots[p]) == slides[k].tag && distance(kept[slots[p]], slides[k].to) <= slides[k].off) on[k] = 1;
    }
    for (std::size_t k = 0; k < slides.size(); ++k)
        if (!on[k]) return slides[k].to;
    return {};
}

}  // namespace

std::optional<Vec3> slides_off(const BandMesh& band, const std::function<Vec3(int)>& goal, double off) {
    const auto at = [&](int v) -> const Vec3& { return band.nodes[v].at; };
    std::vector<Slide> on_surfaces, on_lines;
    const auto add = [&](std::vector<Slide>& to, const Vec3& from, const Vec3& goal_there, const Vec3& into, int tag,
                         double o) {
        const double length = into.norm();
        if (length > 0 && (goal_there - from).dot(into) > o * length) to.push_back({goal_there, tag, o});
    };
    for (int s = 0; s < band.skin.size(); ++s) {
        if (!band.skin.alive(s)) continue;
        const auto& n = band.skin[s];
        for (int k = 0; k < 3; ++k) {
            const int a = n[k], b = n[(k + 1) % 3], c = n[(k + 2) % 3];
            if (!in_one(band.cut_faces, a, b) || band.cut_faces.find({a, b, c}) >= 0) continue;
            const Vec3 middle = (at(a) + at(b)) / 2, along = (at(b) - at(a)).normalized(), up = at(c) - middle;
            add(on_surfaces, middle, (goal(a) + goal(b)) / 2, up - up.dot(along) * along, band.skin.tag(s),
                off * band.mean_edge_length(a));
        }
    }
    for (int s = 0; s < band.creases.size(); ++s) {
        if (!band.creases.alive(s) || band.cut_edges.size() == 0) continue;
        const auto& n = band.creases[s];
        for (const int k : {0, 1}) {
            const int v = n[k], w = n[1 - k];
            if (band.cut_edges.around(v).empty() || band.cut_edges.find({v, w}) >= 0) continue;
            add(on_lines, at(v), goal(v), at(w) - at(v), band.creases.tag(s), off * band.mean_edge_length(v));
        }
    }
    if (auto found = first_off(band, band.skin, on_surfaces, [&](const auto& n, const Vec3& x) {
            Vec3 weights;
            return (closest_on_triangle(at(n[0]), at(n[1]), at(n[2]), x, weights) - x).norm();
        }))
        return found;
    return first_off(band, band.creases, on_lines, [&](const auto& n, const Vec3& x) {
        return (closest_on_segment(at(n[0]), at(n[1]), x) - x).norm();
    });
}

}  // namespace femscalpel
