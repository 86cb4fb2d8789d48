// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Borders of groups that run along the convex edge of a FilletRun, in a plane: they end at the ball.
#include <algorithm>
#include <cmath>

#include "cutting/inner_node.h"
#include "operators/fillet_run.h"

namespace femscalpel {

/// Takes the borders between the domains on both sides, which must be in one plane.
void FilletRun::find_borders_along() {
    const Vec3 somewhere = path_.at((path_.begin() + path_.end()) / 2, Vec2::Zero());
    if (!path_.is_straight() || path_.end_kind(0) != LineEnd::plane || path_.end_kind(1) != LineEnd::plane)
        m_.refuse(
            "groups meet along the edge, which is possible for straight convex ones that run out through plane faces "
            "only. Round the edge before the groups are made",
            somewhere);
    Vec3 plane = Vec3::Zero();
    Vec2 inwards = Vec2::Zero();
    for (std::size_t k = 0; k < segments_.size(); ++k) {
        if (!parted(k)) continue;
        const auto has = [](const Triangle& t, int v) { return std::ranges::find(t, v) != t.end(); };
        const auto border = std::ranges::find_if(
            m_.borders, [&](const Border& b) { return has(b.nodes, edge_[k]) && has(b.nodes, edge_[k + 1]); });
        // Else the border goes on one that was taken with a segment before.
        if (border == m_.borders.end()) continue;
        const bool forwards = border->domain == segments_[k];
        const Vec3 normal = (forwards ? 1 : -1) * m_.normal(border->nodes);
        if (plane.isZero()) {
            std::vector<Triangle> faces;
            faces.reserve(m_.borders.size());
            for (const Border& b : m_.borders) faces.push_back(b.nodes);
            plane = plane_of(faces, edge_[k], normal);
        }
        for (const int v : border->nodes)
            if (v != edge_[k] && v != edge_[k + 1]) inwards = place(v).p.normalized();
        const int patch = patches_.take_border(plane, plane.dot(at(edge_[k])), off_plane(), edge_[k], segments_[k]);
        if (patch < 0 || (normal - plane).norm() > 1e-6 + m_.normal_slack(border->nodes))
            m_.refuse("the border of groups along it is not plane, or more than one runs there", at(edge_[k]));
        along_[k] = patch;
    }
    if (along_.empty()) m_.refuse("no border between the groups on both sides of it is found", somewhere);
    // Where the border meets the ball.
    const double c = inwards.dot(path_.centre()),
                 t = c -
                     std::sqrt(std::max(0.0, c * c - path_.centre().squaredNorm() + path_.radius() * path_.radius()));
    const Vec2 to = t * inwards - path_.centre(), first = path_.arc(0) - path_.centre();
    middle_angle_ = std::acos(std::clamp(to.dot(first) / (to.norm() * first.norm()), -1.0, 1.0));
    if (middle_angle_ < 0.12 * path_.arc_angle() || middle_angle_ > 0.88 * path_.arc_angle())
        m_.refuse("the border of groups along it is too near one of the faces", somewhere);
}

/// The level of the arc at which the border along the edge meets it.
int FilletRun::middle_level() const {
    const double share = middle_angle_ / path_.arc_angle();
    return std::clamp(static_cast<int>(std::lround(share * divisions_)), 1, divisions_ - 1);
}

double FilletRun::angle_at(double level) const {
    if (middle_angle_ == 0) return path_.arc_angle() * level / divisions_;
    if (level <= middle_) return middle_angle_ * level / middle_;
    return middle_angle_ + (path_.arc_angle() - middle_angle_) * (level - middle_) / (divisions_ - middle_);
}

/// The line of a section on the border along the edge: from where it leaves what is replaced to the arc.
void FilletRun::make_trace(Section& section) {
    std::array<std::set<DirectedEdge>, 2> own;
    for (const auto& [side, patch] : section.parts)
        if (side >= 0 && patch >= 0) own[side] = directed_edges(patches_[patch].old);
    std::map<int, int> next;
    for (const DirectedEdge& e : own[0]) {
        if (!own[1].contains({e[1], e[0]})) continue;
        // In which of the directions it leads away from the edge.
        const bool away = place(e[0]).p.norm() < place(e[1]).p.norm();
        next[e[away ? 0 : 1]] = e[away ? 1 : 0];
    }
    int last = section.corner;
    while (next.contains(last)) {
        patches_.hide(last, next[last]);
        last = next[last];
    }
    const int middle = section.arc[middle_];
    const Vec3 from = at(last), way = at(middle) - from;
    if (last == section.corner || way.dot(at(section.corner) - from) <= 0)
        m_.refuse("the border along it is not found where it ends, or crosses another there", at(section.corner));
    const int count = std::max(1, static_cast<int>(std::lround(way.norm() / spacing_along())));
    section.ridge.push_back(last);
    for (int k = 1; k < count; ++k) {
        const Vec3 x = from + way * k / count;
        section.ridge.push_back(add_inner_node(m_.workpiece(), x, {}, true, nodes_near(section, x)));
    }
    section.ridge.push_back(middle);
}

/// What is left of the borders along the edge ends at the arc.
void FilletRun::link_borders_along() {
    for (std::size_t k = 0; k + 1 < sections_.size(); ++k) {
        const Section &from = sections_[k], &to = sections_[k + 1];
        const std::size_t begin = place_on_edge(from), end = place_on_edge(to);
        if (!parted(begin)) continue;
        const auto patch =
            std::ranges::find_if(along_, [&](const auto& entry) { return entry.first >= begin && entry.first < end; });
        if (patch == along_.end())
            m_.refuse("no border between the groups on both sides of it is found", at(edge_[begin]));
        std::vector<int> link = from.ridge;
        const Row row = between(rows_[2], from.in_row[2], to.in_row[2]);
        link.insert(link.end(), row.begin() + 1, row.end());
        link.insert(link.end(), to.ridge.rbegin() + 1, to.ridge.rend());
        patches_[patch->second].links.push_back(std::move(link));
    }
}

}  // namespace femscalpel
