// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where a FilletRun finds its edge, what is across it, and its tangent lines.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "mesh/quality.h"
#include "operators/fillet_run.h"

namespace femscalpel {
namespace {

bool has_corner(const Triangle& t, int v) { return std::ranges::find(t, v) != t.end(); }

}  // namespace

bool FilletRun::Section::has(int side) const {
    return std::ranges::any_of(parts, [&](const Part& p) { return p.side < 0 || p.side == side; });
}

FilletRun::FilletRun(FilletMaterial& material, FilletPatches& patches, const FilletPath& path, std::size_t place)
    : m_(material), patches_(patches), path_(path), place_(place) {}

bool FilletRun::halved() const {
    return std::ranges::any_of(segments_, [](const auto& sides) { return sides[0] != sides[1]; });
}

void FilletRun::find_sections() {
    find_edge();
    if (!path_.closed()) sections_.push_back(end_section(0));
    find_borders();
    if (!path_.closed()) sections_.push_back(end_section(1));
    if (path_.convex() && halved()) find_borders_along();
    check_strips();
}

/// The nodes on the edge, and the domains beside it.
void FilletRun::find_edge() {
    std::array<std::map<std::array<int, 2>, int>, 2> domains;
    std::array<std::set<int>, 2> beside;
    for (const int side : {0, 1})
        for (const Face& face : m_.strip(place_, side))
            for (int k = 0; k < 3; ++k) {
                const int a = face.nodes[k], b = face.nodes[(k + 1) % 3];
                if (path_.distance(at(a), 0) > on_edge()) continue;
                beside[side].insert(a);
                domains[side][{std::min(a, b), std::max(a, b)}] = face.domain;
            }
    std::ranges::set_intersection(beside[0], beside[1], std::back_inserter(edge_));
    std::ranges::sort(edge_, {}, [&](int v) { return place(v).s; });
    const Vec3 somewhere = path_.at((path_.begin() + path_.end()) / 2, Vec2::Zero());
    if (edge_.size() < 2) m_.refuse("the skin beside it is not found", somewhere);
    for (std::size_t k = 0; k + (path_.closed() ? 0 : 1) < edge_.size(); ++k) {
        const int a = edge_[k], b = edge_[(k + 1) % edge_.size()];
        std::array<int, 2>& domain = segments_.emplace_back();
        for (const int side : {0, 1}) {
            const auto found = domains[side].find({std::min(a, b), std::max(a, b)});
            if (found == domains[side].end()) m_.refuse("the skin beside it is not found", at(a));
            domain[side] = found->second;
        }
    }
}

/// The plane across the edge at a section's node, turned in the edge's direction.
void FilletRun::set_normal(Section& section, const Vec3& normal) const {
    section.normal = normal;
    section.s = place(section.corner).s;
    section.offset = normal.dot(at(section.corner));
    const double step = path_.mean_edge() / 4;
    const Vec3 along =
        (path_.at(section.s + step, Vec2::Zero()) - path_.at(section.s - step, Vec2::Zero())).normalized();
    if (normal.dot(along) > 0) return;
    section.normal = -section.normal;
    section.offset = -section.offset;
}

/// The borders between domains across the edge, one after the other along it.
void FilletRun::find_borders() {
    const std::size_t before = path_.closed() ? segments_.size() - 1 : 0;
    for (std::size_t k = path_.closed() ? 0 : 1; k < segments_.size(); ++k)
        if (segments_[k] != segments_[k > 0 ? k - 1 : before]) sections_.push_back(border_at(k));
}

/// That at a node of the edge.
FilletRun::Section FilletRun::border_at(std::size_t node) {
    const std::size_t previous = node > 0 ? node - 1 : segments_.size() - 1;
    const std::array<int, 2> before = segments_[previous], after = segments_[node];
    Section section{edge_[node]};
    std::vector<int> sides;
    for (const int side : {0, 1}) {
        if (before[side] == after[side]) continue;
        sides.push_back(side);
        // The border's face at the line where it meets the skin beside the edge.
        std::map<int, std::set<int>> beside;
        for (const Face& face : m_.strip(place_, side))
            if (has_corner(face.nodes, section.corner))
                for (const int v : face.nodes) beside[v].insert(face.domain);
        const Border* border = nullptr;
        for (const Border& b : m_.borders)
            if (has_corner(b.nodes, section.corner) && std::ranges::any_of(b.nodes, [&](int v) {
                    return v != section.corner && beside[v].contains(before[side]) && beside[v].contains(after[side]);
                }))
                border = &b;
        if (!border) m_.refuse("several borders meet there", at(section.corner));
        if (section.normal.isZero()) {
            std::vector<Triangle> faces;
            faces.reserve(m_.borders.size());
            for (const Border& b : m_.borders) faces.push_back(b.nodes);
            set_normal(section, plane_of(faces, section.corner, m_.normal(border->nodes)));
        }
        if (!m_.is_parallel(border->nodes, section.normal, FilletMaterial::plane_angle))
            m_.refuse("a border of groups that crosses it is not plane", at(section.corner));
    }
    const double step = path_.mean_edge() / 4;
    if (section.normal.dot(path_.at(section.s + step, Vec2::Zero()) - path_.at(section.s, Vec2::Zero())) < 0.3 * step)
        m_.refuse("a border of groups crosses it at too small an angle", at(section.corner));
    if (sides.size() == 2 && !parted(previous) && !parted(node)) sides = {-1};
    for (const int side : sides) {
        const int k = std::max(side, 0);
        if (!border_part(section, side, {before[k], after[k]}))
            m_.refuse("several borders meet there", at(section.corner));
    }
    return section;
}

/// Takes the faces between two domains in a section's plane. False when there are none.
bool FilletRun::border_part(Section& section, int side, const std::array<int, 2>& domain) {
    const int patch = patches_.take_border(section.normal, section.offset, off_plane(), section.corner, domain);
    if (patch >= 0) section.parts.push_back({side, patch});
    return patch >= 0;
}

/// Domains must part the skin beside the edge along sections only.
void FilletRun::check_strips() const {
    for (const int side : {0, 1}) {
        std::map<DirectedEdge, int> domains;
        for (const Face& face : m_.strip(place_, side))
            for (int k = 0; k < 3; ++k) domains[{face.nodes[k], face.nodes[(k + 1) % 3]}] = face.domain;
        for (const auto& [e, domain] : domains) {
            const auto other = domains.find({e[1], e[0]});
            if (other == domains.end() || other->second == domain) continue;
            const double off = off_plane();
            const bool known = std::ranges::any_of(sections_, [&](const Section& s) {
                return s.has(side) &&
                       std::ranges::none_of(e, [&](int v) { return std::abs(s.normal.dot(at(v)) - s.offset) > off; });
            });
            if (!known)
                m_.refuse(
                    "a border of groups, or another surface that is kept, runs through the material there, and does "
                    "not cross the edge in one plane",
                    at(e[0]));
        }
    }
}

void FilletRun::find_rows() {
    for (const int side : {0, 1}) rows_[side] = find_row(side);
    for (Section& section : sections_) place_in_rows(section);
}

/// Where the outlines of what goes of a section leave the skin beside the edge.
void FilletRun::place_in_rows(Section& section) const {
    for (const int side : {0, 1}) {
        if (!section.has(side)) continue;
        if (section.end >= 0) {
            section.in_row[side] = section.end == 0 ? 0 : rows_[side].size() - 1;
            continue;
        }
        std::set<int> nodes;
        for (const Part& part : section.parts)
            if (part.side < 0 || part.side == side)
                for (const Triangle& t : patches_[part.patch].old) nodes.insert(t.begin(), t.end());
        const auto found = std::ranges::find_if(rows_[side], [&](int v) { return nodes.contains(v); });
        if (found == rows_[side].end())
            m_.refuse("a border or face across it does not reach the ball", at(section.corner));
        section.in_row[side] = static_cast<std::size_t>(found - rows_[side].begin());
    }
}

FilletRun::Row FilletRun::find_row(int side) const {
    std::set<DirectedEdge> ends;
    for (const Section& section : sections_)
        for (const Part& part : section.parts)
            if (part.patch >= 0 && std::ranges::min(patches_[part.patch].domain) < 0)
                for (const DirectedEdge& e : directed_edges(patches_[part.patch].old))
                    ends.insert({{e[0], e[1]}, {e[1], e[0]}});
    const auto at_open_end = [&](const DirectedEdge& e) {
        return std::ranges::any_of(sections_, [&](const Section& s) {
            return s.end >= 0 && path_.end_kind(s.end) == LineEnd::open && std::ranges::all_of(e, [&](int v) {
                       return std::abs(path_.end_plane(s.end).distance(at(v))) <= 10 * m_.workpiece().tolerance;
                   });
        });
    };
    // Beyond a corner the skin that goes is that of another edge, too.
    const auto is_others = [&](const DirectedEdge& e) {
        const auto on = [&](const Tool& wall) {
            return std::ranges::all_of(
                e, [&](int v) { return std::abs(wall.distance(at(v))) <= 10 * m_.workpiece().tolerance; });
        };
        return !on(path_.wall(side)) && std::ranges::any_of(m_.edge(place_).next, [&](const FilletPath* next) {
            return next && (on(next->wall(0)) || on(next->wall(1)));
        });
    };
    std::set<int> nodes;
    std::size_t edges = 0;
    for (const Face& face : m_.strip(place_, side))
        for (int k = 0; k < 3; ++k) {
            const DirectedEdge e{face.nodes[k], face.nodes[(k + 1) % 3]};
            if (m_.is_strip_edge(e[1], e[0]) || ends.contains({e[1], e[0]}) || at_open_end(e) || is_others(e)) continue;
            nodes.insert(e.begin(), e.end());
            ++edges;
            for (const int v : e)
                if (std::abs(path_.wall(side).distance(at(v))) > 10 * m_.workpiece().tolerance)
                    m_.refuse(
                        "the skin could not be parted along the line where the ball touches it; refine the mesh there",
                        at(v));
        }
    Row row(nodes.begin(), nodes.end());
    if (row.size() < 2 || row.size() != edges + (path_.closed() ? 0 : 1))
        m_.refuse("the faces beside it do not go on as far as the ball touches them, all along",
                  path_.at((path_.begin() + path_.end()) / 2, path_.tangent_point(side)));
    std::ranges::sort(row, {}, [&](int v) { return place(v).s; });
    return row;
}

/// Nodes of tangent lines on flat facets of a curved face go onto the face itself, if that spoils nothing.
void FilletRun::put_rows_on_ball() {
    Deformable& d = m_.workpiece().d;
    for (const int side : {0, 1})
        for (const int v : rows_[side]) {
            const Vec3 x = path_.at(place(v).s, path_.tangent_point(side));
            const Vec3 old = at(v);
            if ((x - old).norm() <= m_.workpiece().tolerance) continue;
            const double before = quality_around(d, v, old);
            if (quality_around(d, v, x) < std::min(0.2, 0.7 * before)) continue;
            d.band.nodes[v].at = x;
        }
}

FilletRun::Beside FilletRun::settle_rows() {
    Beside out;
    Deformable& d = m_.workpiece().d;
    const double tolerance = m_.workpiece().tolerance, facets = on_edge();
    for (const int side : {0, 1})
        for (const int v : rows_[side]) {
            if (std::abs(path_.ball().distance(at(v))) <= tolerance) continue;
            const Vec3 old = at(v), way = path_.at(place(v).s, path_.tangent_point(side)) - old;
            const double least = std::min(0.2, 0.7 * quality_around(d, v, old));
            for (const double part : {1.0, 0.75, 0.5, 0.25})
                if (quality_around(d, v, old + part * way) >= least) {
                    d.band.nodes[v].at += part * way;
                    break;
                }
            const double off = std::abs(path_.ball().distance(at(v)));
            if (off <= tolerance || off > facets) continue;
            d.hold_beside(v, d.contact[v]);
            ++out.count;
            out.farthest = std::max(out.farthest, off);
            out.at = at(v);
        }
    return out;
}

}  // namespace femscalpel
