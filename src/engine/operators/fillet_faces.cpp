// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The new faces of a FilletRun.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cutting/inner_node.h"
#include "operators/fillet_run.h"

namespace femscalpel {

/// So that the chords are off the arc by less than 3 % of what is rounded off a right angle, too.
int FilletRun::wanted_divisions() const {
    double length = 0;
    std::size_t edges = 0;
    for (const int side : {0, 1})
        for (std::size_t k = 1; k < rows_[side].size(); ++k, ++edges)
            length += (at(rows_[side][k]) - at(rows_[side][k - 1])).norm();
    const double by_length = path_.arc_length() * static_cast<double>(edges) / length,
                 by_angle = path_.arc_angle() / (std::numbers::pi / 16);
    return std::max({4, static_cast<int>(std::lround(by_length)), static_cast<int>(std::ceil(by_angle - 1e-6))});
}

void FilletRun::make_arcs(int divisions) {
    divisions_ = divisions;
    middle_ = path_.convex() && halved() ? middle_level() : divisions_ / 2;
    for (Section& section : sections_) {
        if (section.arc.empty()) make_arc(section);
        if (section.ridge.empty() && halved()) make_ridge(section);
    }
}

void FilletRun::make_faces() {
    if (halved()) make_middle_row();
    for (const Section& section : sections_) link_patches(section);
    if (halved() && path_.convex()) link_borders_along();
    mesh_arcs();
    if (halved() && !path_.convex()) mesh_walls();
}

/// Where the line of the ball's surface through a section point meets the plane of a section.
double FilletRun::on_plane(const Vec2& p, const Section& section) const {
    const double step = 1e-4 * path_.radius();
    double s = section.s;
    for (int k = 0; k < 50; ++k) {
        const double value = section.normal.dot(path_.at(s, p)) - section.offset,
                     slope = (section.normal.dot(path_.at(s + step, p)) - section.offset - value) / step;
        const double move = -value / slope;
        s += move;
        if (std::abs(move) < 1e-14 * (path_.radius() + path_.length())) break;
    }
    return s;
}

void FilletRun::make_arc(Section& section) {
    section.arc.assign(static_cast<std::size_t>(divisions_) + 1, -1);
    for (int k = 0; k <= divisions_; ++k) {
        const int side = k <= middle_ ? 0 : 1;
        if (!section.has(side) && !(k == middle_ && section.has(1))) continue;
        if (k == 0 || k == divisions_) {
            section.arc[k] = rows_[side][section.in_row[side]];
            continue;
        }
        const Vec2 p = path_.arc(angle_at(k));
        const Vec3 x = path_.at(on_plane(p, section), p);
        section.arc[k] = add_inner_node(m_.workpiece(), x, &path_.ball(), true, nodes_near(section, x));
    }
}

/// The nodes of a section on the wall between two shares of new material.
void FilletRun::make_ridge(Section& section) {
    if (std::ranges::none_of(section.parts, [](const Part& p) { return p.side >= 0; })) return;
    if (path_.convex()) {
        make_trace(section);
        return;
    }
    const Sheet sheet = wall_sheet();
    section.ridge.push_back(section.corner);
    for (int k = 1; k < sheet.levels; ++k) {
        const Vec2 p = k * sheet.step * path_.centre().normalized();
        const Vec3 x = path_.at(on_plane(p, section), p);
        section.ridge.push_back(add_inner_node(m_.workpiece(), x, {}, true, nodes_near(section, x)));
    }
    section.ridge.push_back(section.arc[middle_]);
}

/// Closes the outlines of a section's patches.
void FilletRun::link_patches(const Section& section) {
    for (const auto& [side, patch] : section.parts) {
        if (patch < 0) continue;
        std::vector<int> link = section.arc;
        if (side == 0) {
            link.resize(static_cast<std::size_t>(middle_) + 1);
            link.insert(link.end(), section.ridge.rbegin() + 1, section.ridge.rend());
        } else if (side == 1) {
            link.assign(section.ridge.begin(), section.ridge.end() - 1);
            link.insert(link.end(), section.arc.begin() + middle_, section.arc.end());
        }
        patches_[patch].links.push_back(std::move(link));
        if (!patches_[patch].free) continue;
        std::vector<int> skin;
        if (side != 1) skin = rim(section, 0);
        std::ranges::reverse(skin);
        if (side != 0) {
            const Row second = rim(section, 1);
            skin.insert(skin.end(), second.begin() + (side < 0 ? 1 : 0), second.end());
        }
        patches_[patch].links.push_back(std::move(skin));
    }
}

std::vector<int> FilletRun::nodes_near(const Section& section, const Vec3& x) const {
    std::vector<int> patches;
    patches.reserve(section.parts.size());
    for (const Part& part : section.parts) patches.push_back(part.patch);
    return patches_.nodes_near(patches, x);
}

/// Between two places of a row, both included; on beyond the row's end for a closed edge.
FilletRun::Row FilletRun::between(const Row& row, std::size_t from, std::size_t to) const {
    Row nodes;
    for (std::size_t k = from;; k = (k + 1) % row.size()) {
        nodes.push_back(row[k]);
        if (k == to && nodes.size() > 1) return nodes;
        if (nodes.size() > row.size() + 1) m_.refuse("its tangent lines are torn", at(row[0]));
    }
}

/// Where nodes are along the edge, each near the one before, the first near a place; so a closed edge goes on.
std::vector<double> FilletRun::unrolled(const std::vector<int>& nodes, double near) const {
    std::vector<double> out;
    for (const int v : nodes) {
        double s = place(v).s;
        if (path_.closed()) s += path_.length() * std::round((near - s) / path_.length());
        out.push_back(s);
        near = s;
    }
    return out;
}

/// About that of the nodes on the tangent lines.
double FilletRun::spacing_along() const {
    const double step = path_.arc_length() / divisions_,
                 length = path_.length() - path_.cut_back(0) - path_.cut_back(1),
                 mean = length / (0.5 * static_cast<double>(rows_[0].size() + rows_[1].size() - 2) + 1e-9);
    return std::clamp(mean, step, 2.5 * step);
}

/// As if nodes were as far apart along the edge as across: then no triangle reaches over several rows, whose chords
/// would be far off the arc.
FilletRun::Sheet FilletRun::arc_sheet() const {
    const double step = path_.arc_length() / divisions_, spacing = spacing_along();
    return {[this](double s, double level) { return path_.at(s, path_.arc(angle_at(level))); },
            &path_.ball(),
            divisions_,
            step,
            spacing,
            step / spacing};
}

/// That between shares of new material.
FilletRun::Sheet FilletRun::wall_sheet() const {
    const double width = path_.centre().norm() - path_.radius(), spacing = spacing_along();
    const int levels = std::max(1, static_cast<int>(std::lround(width / spacing)));
    const double step = width / levels;
    return {[this, step](double s, double level) { return path_.at(s, level * step * path_.centre().normalized()); },
            nullptr,
            levels,
            step,
            spacing,
            1};
}

/// Nodes on the middle of the arc, where its halves meet.
void FilletRun::make_middle_row() {
    const Vec2 p = path_.arc(angle_at(middle_));
    const auto add = [&](double begin, double length, int from, int count) {
        for (int k = from; k < count; ++k) {
            const Vec3 x = path_.at(begin + length * k / count, p);
            rows_[2].push_back(add_inner_node(m_.workpiece(), x, &path_.ball(), true, m_.nodes_near(x)));
        }
    };
    const auto count = [&](double length) { return static_cast<int>(std::lround(length / spacing_along())); };
    if (sections_.empty()) add(0, path_.length(), 0, std::max(4, count(path_.length())));
    for (std::size_t k = 0; k < sections_.size(); ++k) {
        sections_[k].in_row[2] = rows_[2].size();
        const int middle = sections_[k].arc[middle_];
        rows_[2].push_back(middle);
        if (k + 1 == sections_.size() && !path_.closed()) break;
        const Section& next = sections_[(k + 1) % sections_.size()];
        const double begin = place(middle).s;
        double length = place(next.arc[middle_]).s - begin;
        if (length <= 0) length += path_.length();
        add(begin, length, 1, std::max(1, count(length)));
    }
}

void FilletRun::mesh_arcs() {
    const auto mesh_between = [&](int side, int lower, int upper, int first, int last) {
        std::vector<const Section*> across;
        for (const Section& s : sections_)
            if (s.has(side)) across.push_back(&s);
        if (across.empty()) {
            add_arc(mesh_ring(arc_sheet(), rows_[lower], rows_[upper], first, last), segments_[0][side]);
            return;
        }
        for (std::size_t k = 0; k < across.size(); ++k) {
            if (k + 1 == across.size() && !path_.closed()) break;
            const Section &from = *across[k], &to = *across[(k + 1) % across.size()];
            const auto part_of = [&](const Section& s) {
                return std::vector<int>(s.arc.begin() + first, s.arc.begin() + last + 1);
            };
            const Patch patch{between(rows_[lower], from.in_row[lower], to.in_row[lower]),
                              between(rows_[upper], from.in_row[upper], to.in_row[upper]), part_of(from), part_of(to)};
            add_arc(mesh_patch(arc_sheet(), patch, first, last), domain_behind(from, side));
        }
    };
    if (!halved()) {
        mesh_between(0, 0, 1, 0, divisions_);
        return;
    }
    mesh_between(0, 0, 2, 0, middle_);
    mesh_between(1, 2, 1, middle_, divisions_);
}

/// The domain of the skin on one side just behind a section, in the edge's direction.
int FilletRun::domain_behind(const Section& section, int side) const { return segments_[place_on_edge(section)][side]; }

std::size_t FilletRun::place_on_edge(const Section& section) const {
    return static_cast<std::size_t>(std::ranges::find(edge_, section.corner) - edge_.begin());
}

/// The walls between shares of new material.
void FilletRun::mesh_walls() {
    const Sheet sheet = wall_sheet();
    if (sections_.empty()) {
        add_wall(mesh_ring(sheet, edge_, rows_[2], 0, sheet.levels), segments_[0]);
        return;
    }
    for (std::size_t k = 0; k < sections_.size(); ++k) {
        if (k + 1 == sections_.size() && !path_.closed()) break;
        const Section &from = sections_[k], &to = sections_[(k + 1) % sections_.size()];
        const std::array<int, 2>& domain = segments_[place_on_edge(from)];
        if (domain[0] == domain[1]) continue;
        const Patch patch{between(edge_, place_on_edge(from), place_on_edge(to)),
                          between(rows_[2], from.in_row[2], to.in_row[2]), from.ridge, to.ridge};
        add_wall(mesh_patch(sheet, patch, 0, sheet.levels), domain);
    }
}

/// A sheet around a closed edge, cut open from the first node of one row to the nearest of the other.
std::vector<Triangle> FilletRun::mesh_ring(const Sheet& sheet, Row lower, Row upper, int first, int last) {
    const double around = path_.length(), begin = place(lower[0]).s;
    const auto nearest = std::ranges::min_element(upper, {}, [&](int v) {
        const double d = std::abs(place(v).s - begin);
        return std::min(d, around - d);
    });
    std::ranges::rotate(upper, nearest);
    const double end = unrolled({upper[0]}, begin)[0];
    Patch patch{std::move(lower), std::move(upper), {}, {}};
    patch.left.push_back(patch.lower[0]);
    for (int k = first + 1; k < last; ++k) {
        const Vec3 x = sheet.at(begin + (k - first) * (end - begin) / (last - first), k);
        patch.left.push_back(add_inner_node(m_.workpiece(), x, sheet.tool, true, m_.nodes_near(x)));
    }
    patch.left.push_back(patch.upper[0]);
    patch.right = patch.left;
    patch.lower.push_back(patch.lower[0]);
    patch.upper.push_back(patch.upper[0]);
    return mesh_patch(sheet, patch, first, last);
}

std::vector<Triangle> FilletRun::mesh_patch(const Sheet& sheet, const Patch& patch, int first, int last) {
    std::vector<int> nodes;
    std::vector<Vec2> outline, inner;
    const auto add = [&](int v, double s, double level) {
        nodes.push_back(v);
        outline.emplace_back(s * sheet.squeeze, level * sheet.step);
    };
    const std::vector<double> lower = unrolled(patch.lower, place(patch.lower[0]).s),
                              upper = unrolled(patch.upper, lower[0]), left = unrolled(patch.left, lower[0]),
                              right = unrolled(patch.right, lower.back());
    const auto levels = static_cast<std::size_t>(last - first);
    for (std::size_t k = 0; k < lower.size(); ++k) add(patch.lower[k], lower[k], first);
    for (std::size_t k = 1; k < levels; ++k) add(patch.right[k], right[k], first + static_cast<double>(k));
    for (std::size_t k = upper.size(); k-- > 0;) add(patch.upper[k], upper[k], last);
    for (std::size_t k = levels - 1; k > 0; --k) add(patch.left[k], left[k], first + static_cast<double>(k));
    for (std::size_t k = 1; k < levels; ++k) {
        const double length = right[k] - left[k], level = first + static_cast<double>(k);
        const int count = std::max(1, static_cast<int>(std::lround(length / sheet.spacing)));
        for (int j = 0; j <= count; ++j) {
            const double along = (j + (static_cast<int>(level) % 2 ? 0.5 : 0)) * length / count;
            if (along <= 0.4 * sheet.spacing || along >= length - 0.4 * sheet.spacing) continue;
            inner.emplace_back((left[k] + along) * sheet.squeeze, level * sheet.step);
            const Vec3 x = sheet.at(left[k] + along, level);
            nodes.push_back(add_inner_node(m_.workpiece(), x, sheet.tool, true, m_.nodes_near(x)));
        }
    }
    std::vector<Triangle> out;
    for (const Triangle& t : triangulate(outline, inner)) out.push_back({nodes[t[0]], nodes[t[1]], nodes[t[2]]});
    return out;
}

/// Faces of the ball, to be turned out of the material.
void FilletRun::add_arc(std::vector<Triangle> triangles, int domain) {
    double outwards = 0;
    for (const Triangle& t : triangles)
        outwards += (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).dot(path_.ball().normal(at(t[0])));
    for (Triangle& t : triangles) {
        if ((outwards > 0) != path_.convex()) std::swap(t[1], t[2]);
        arc_.push_back({t, domain});
    }
}

/// Faces between two shares, to be turned out of the first's.
void FilletRun::add_wall(std::vector<Triangle> triangles, const std::array<int, 2>& domain) {
    const Vec2 across = path_.along_face(1) - path_.along_face(0);
    double outwards = 0;
    for (const Triangle& t : triangles) {
        const auto [s, p] = place(t[0]);
        outwards += (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).dot(path_.at(s, p + across) - path_.at(s, p));
    }
    for (Triangle& t : triangles) {
        if (outwards < 0) std::swap(t[1], t[2]);
        walls_.push_back({t, domain});
    }
}

/// That these are on the ball cannot be left to a contact with it, as it only touches the curved faces there.
void FilletRun::bend_row_edges(std::map<std::uint64_t, Vec3>& middles) {
    Deformable& d = m_.workpiece().d;
    const std::array<std::set<int>, 2> on_row{std::set<int>(rows_[0].begin(), rows_[0].end()),
                                              std::set<int>(rows_[1].begin(), rows_[1].end())};
    for (const Face& face : arc_)
        for (int k = 0; k < 3; ++k) {
            const int a = face.nodes[k], b = face.nodes[(k + 1) % 3];
            if (std::ranges::none_of(on_row, [&](const auto& row) { return row.contains(a) || row.contains(b); }))
                continue;
            const Vec3 chord = (at(a) + at(b)) / 2;
            Vec3 middle = path_.ball().project(chord);
            for (const int side : {0, 1})
                if (on_row[side].contains(a) && on_row[side].contains(b))
                    middle = path_.at(path_.place(chord).s, path_.tangent_point(side));
            middles.insert_or_assign(edge_key(a, b), middle);
            if (d.band.mid_nodes.contains(edge_key(a, b)))
                d.mids.mend(a, b, middle - chord);
            else
                d.mids.set_bulge(a, b, middle - chord);
        }
}

}  // namespace femscalpel
