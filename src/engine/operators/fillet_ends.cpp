// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sections of a FilletRun at the ends of its edge.
#include <algorithm>
#include <cmath>

#include "operators/fillet_run.h"

namespace femscalpel {
FilletRun::Section FilletRun::end_section(int which) {
    Section section = [&] {
        switch (path_.end_kind(which)) {
            case LineEnd::plane:
                return end_on_face(which);
            case LineEnd::wall:
                return end_in_wall(which);
            case LineEnd::joined:
                return joined_end(which);
            default:
                return open_end(which);
        }
    }();
    section.end = which;
    return section;
}

/// Where the new face ends on that of another edge, or on a ball at the corner: with no face across the edge.
FilletRun::Section FilletRun::joined_end(int which) {
    Section section{which == 0 ? edge_.front() : edge_.back()};
    set_normal(section, end_normals_[which]);
    section.offset = section.normal.dot(end_points_[which]);
    const auto [one, other] = domains_at_end(which);
    if (one == other)
        section.parts = {{-1, -1}};
    else
        section.parts = {{0, -1}, {1, -1}};
    return section;
}

const std::vector<int>& FilletRun::ridge_at(int which) const {
    return (which == 0 ? sections_.front() : sections_.back()).ridge;
}

const std::vector<int>& FilletRun::arc_at(int which) const {
    return (which == 0 ? sections_.front() : sections_.back()).arc;
}

/// Where the edge leaves the part.
FilletRun::Section FilletRun::end_on_face(int which) {
    Section section{which == 0 ? edge_.front() : edge_.back()};
    set_normal(section, plane_at(section.corner));
    const double step = path_.mean_edge() / 4;
    if (section.normal.dot(path_.at(section.s + step, Vec2::Zero()) - path_.at(section.s, Vec2::Zero())) < 0.3 * step)
        m_.refuse("it runs into the face where it ends at too small an angle", at(section.corner));
    const auto [one, other] = domains_at_end(which);
    std::vector<int> sides{0, 1};
    if (one == other) sides = {-1};
    for (const int side : sides) skin_part(section, side, side == 1 ? other : one);
    return section;
}

/// Takes skin in a section's plane, of a domain; of the only one there is for -1. Returns the domain.
int FilletRun::skin_part(Section& section, int side, int domain) {
    const int patch = patches_.take_skin(section.normal, section.offset, off_plane(), section.corner, domain);
    if (patch < 0) m_.refuse("it does not end at a plane face of the part", at(section.corner));
    section.parts.push_back({side, patch});
    return std::ranges::max(patches_[patch].domain);
}

/// The normal of the plane faces across the edge at its end.
Vec3 FilletRun::plane_at(int corner) const {
    std::vector<Triangle> faces;
    faces.reserve(m_.skin.size());
    for (const Face& face : m_.skin) faces.push_back(face.nodes);
    // What another edge has taken.
    for (const FilletPatch& patch : patches_.all())
        if (std::ranges::min(patch.domain) < 0)
            for (const Triangle& t : patch.old) faces.push_back(patch.domain[0] >= 0 ? t : Triangle{t[0], t[2], t[1]});
    Vec3 plane = Vec3::Zero();
    double off = 0;
    const auto at_corner = [&](const Triangle& face) { return std::ranges::find(face, corner) != face.end(); };
    for (const Triangle& face : faces) {
        if (!at_corner(face) || (!plane.isZero() && m_.normal_slack(face) >= off)) continue;
        plane = m_.normal(face);
        off = m_.normal_slack(face);
    }
    if (plane.isZero()) m_.refuse("it does not end at a face of the part", at(corner));
    for (const Triangle& face : faces)
        if (at_corner(face) && (m_.normal(face) - plane).norm() > 1e-6 + off + m_.normal_slack(face))
            m_.refuse("it ends at a corner of more than three faces, or at a face that is not plane", at(corner));
    return plane_of(faces, corner, plane);
}

/// The normal of the plane in which faces are about a node, from that of one of them: where coordinates were rounded,
/// the more exact the farther the faces reach.
Vec3 FilletRun::plane_of(const std::vector<Triangle>& faces, int node, const Vec3& about) const {
    if (m_.slack().off() == 0) return about;
    double off = 0.5;
    for (const Triangle& t : faces)
        if (std::ranges::find(t, node) != t.end() && m_.normal(t).dot(about) > 0.9)
            off = std::min(off, m_.normal_slack(t));
    Vec3 plane = about;
    // A second time by the better plane, that of the first.
    for (const double tilt : {off, off / 4}) {
        Vec3 sum = Vec3::Zero();
        for (const Triangle& t : faces) {
            const bool fits =
                m_.is_parallel(t, plane, FilletMaterial::plane_angle + tilt) && std::ranges::all_of(t, [&](int v) {
                    const Vec3 to = at(v) - at(node);
                    return std::abs(to.dot(plane)) <= off_plane() + tilt * to.norm();
                });
            const Vec3 area = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
            if (fits) sum += area.dot(plane) < 0 ? Vec3(-area) : area;
        }
        if (!sum.isZero()) plane = sum.normalized();
    }
    return plane;
}

/// Where the edge ends in a plane face across it, which new material covers a part of.
FilletRun::Section FilletRun::end_in_wall(int which) {
    Section section{which == 0 ? edge_.front() : edge_.back()};
    section.end = which;
    set_normal(section, plane_at(section.corner));
    add_borders_at_end(section, skin_part(section, -1, -1));
    return section;
}

/// An open end: a new face between the skin that goes and the arc.
FilletRun::Section FilletRun::open_end(int which) {
    Section section{which == 0 ? edge_.front() : edge_.back()};
    section.end = which;
    set_normal(section, path_.end_plane(which).normal(at(section.corner)));
    const auto add = [&](int side, int domain) {
        const bool behind = (which == 1) == path_.convex();
        section.parts.push_back(
            {side, patches_.add_free(section.normal, section.offset, {behind ? -1 : domain, behind ? domain : -1})});
    };
    const auto [one, other] = domains_at_end(which);
    if (path_.convex()) {
        const int beyond = domain_beyond(section);
        add(-1, beyond);
        add_borders_at_end(section, beyond);
    } else if (one == other) {
        add(-1, one);
    } else {
        add(0, one);
        add(1, other);
    }
    return section;
}

/// Borders between the domains beside the edge and that beyond its end, which must be in the end's plane.
void FilletRun::add_borders_at_end(Section& section, int beyond) {
    const auto domains = domains_at_end(section.end);
    std::vector<int> sides{0, 1};
    if (domains[0] == domains[1]) sides = {-1};
    for (const int side : sides) {
        const int domain = domains[std::max(side, 0)];
        if (domain == beyond) continue;
        const bool behind = section.end == 1;
        if (!border_part(section, side, {behind ? domain : beyond, behind ? beyond : domain}))
            m_.refuse("groups meet at the edge's end in another way than in a plane across it", at(section.corner));
    }
}

std::array<int, 2> FilletRun::domains_at_end(int which) const {
    return which == 0 ? segments_.front() : segments_.back();
}

/// The domain of the skin that goes on beyond an open end.
int FilletRun::domain_beyond(const Section& section) const {
    std::set<DirectedEdge> ends;
    for (const int side : {0, 1}) {
        const Row nodes = rim(section, side);
        for (std::size_t k = 1; k < nodes.size(); ++k)
            ends.insert({{nodes[k - 1], nodes[k]}, {nodes[k], nodes[k - 1]}});
    }
    int domain = -1;
    for (const Face& face : m_.skin)
        for (int k = 0; k < 3; ++k) {
            if (!ends.contains({face.nodes[k], face.nodes[(k + 1) % 3]})) continue;
            if (domain >= 0 && domain != face.domain)
                m_.refuse("groups meet beyond the edge's end", at(section.corner));
            domain = face.domain;
        }
    if (domain < 0) m_.refuse("there is nothing beyond its end", at(section.corner));
    return domain;
}

/// The nodes where the skin that goes on one side ends at an open end: from the edge to the tangent line.
FilletRun::Row FilletRun::rim(const Section& section, int side) const {
    const auto on_end = [&](int v) {
        return std::abs(path_.end_plane(section.end).distance(at(v))) <= 10 * m_.workpiece().tolerance;
    };
    std::set<int> nodes;
    std::size_t edges = 0;
    for (const Face& face : m_.strip(place_, side))
        for (int k = 0; k < 3; ++k) {
            const int a = face.nodes[k], b = face.nodes[(k + 1) % 3];
            if (!on_end(a) || !on_end(b) || m_.is_strip_edge(b, a)) continue;
            nodes.insert({a, b});
            ++edges;
        }
    Row row(nodes.begin(), nodes.end());
    std::ranges::sort(row, {}, [&](int v) { return place(v).p.dot(path_.along_face(side)); });
    if (row.size() < 2 || row.size() != edges + 1 || row.front() != section.corner)
        m_.refuse("the skin could not be parted where the rounding has to end", at(section.corner));
    return row;
}

}  // namespace femscalpel
