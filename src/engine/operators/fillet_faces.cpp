// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The new faces of a FilletCavity, and what fills it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cutting/inner_node.h"
#include "mesh/quality.h"
#include "operators/fillet_cavity.h"

namespace femscalpel {

/// So that the chords are off the arc by less than 3 % of what is rounded off a right angle, too.
void FilletCavity::divide_arc() {
    double length = 0;
    std::size_t edges = 0;
    for (const Row& row : rows_)
        for (std::size_t k = 1; k < row.size(); ++k, ++edges) length += (at(row[k]) - at(row[k - 1])).norm();
    const double by_length = path_.arc_length() * static_cast<double>(edges) / length,
                 by_angle = path_.arc_angle() / (std::numbers::pi / 16);
    divisions_ = std::max({4, static_cast<int>(std::lround(by_length)), static_cast<int>(std::ceil(by_angle - 1e-6))});
}

/// Where the line of the ball's surface through a section point meets the plane of a section.
double FilletCavity::on_plane(const Vec2& p, const Section& section) const {
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

void FilletCavity::make_arc(Section& section) {
    section.arc.push_back(rows_[0][section.in_row[0]]);
    for (int k = 1; k < divisions_; ++k) {
        const Vec2 p = path_.arc(path_.arc_angle() * k / divisions_);
        const Vec3 x = path_.at(on_plane(p, section), p);
        section.arc.push_back(add_inner_node(f_, x, &path_.ball(), true, face_near(section, x)));
    }
    section.arc.push_back(rows_[1][section.in_row[1]]);
}

/// The outline of the old faces of a section from one tangent line to the other, without what they share with the skin
/// that goes, counter-clockwise.
std::vector<int> FilletCavity::outline_of(const Section& section, const std::array<int, 2>& ends) const {
    std::map<int, int> next;
    std::set<DirectedEdge> strips;
    for (const auto& strip : strips_)
        for (const DirectedEdge& e : directed_edges(strip)) strips.insert({{e[0], e[1]}, {e[1], e[0]}});
    const std::set<DirectedEdge> own = directed_edges(section.old);
    for (const DirectedEdge& e : own)
        if (!own.contains({e[1], e[0]}) && !strips.contains(e))
            if (!next.emplace(e[0], e[1]).second) refuse("a face across it is only joined at a point", at(e[0]));
    for (const auto& [from, to] : {std::pair(ends[0], ends[1]), std::pair(ends[1], ends[0])}) {
        std::vector<int> outline{from};
        while (next.contains(outline.back()) && outline.size() <= next.size()) outline.push_back(next[outline.back()]);
        if (outline.back() == to && outline.size() == next.size() + 1) return outline;
    }
    refuse("a face across it is too small, or has a hole there", at(ends[0]));
}

void FilletCavity::mesh_section(Section& section) {
    std::vector<int> outline = outline_of(section, {section.arc.front(), section.arc.back()});
    if (outline.back() == section.arc.front())
        outline.insert(outline.end(), section.arc.begin() + 1, section.arc.end() - 1);
    else
        outline.insert(outline.end(), section.arc.rbegin() + 1, section.arc.rend() - 1);

    const Vec3 u = section.normal.unitOrthogonal(), w = section.normal.cross(u), origin = at(outline[0]);
    std::vector<Vec2> points;
    double length = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        points.emplace_back(u.dot(at(outline[k]) - origin), w.dot(at(outline[k]) - origin));
        length += (at(outline[k]) - at(outline[(k + 1) % outline.size()])).norm();
    }
    const std::vector<Vec2> inside = points_inside(points, length / static_cast<double>(outline.size()));
    const std::vector<Triangle> triangles = triangulate(points, inside);
    const std::size_t given = points.size();
    points.insert(points.end(), inside.begin(), inside.end());
    smooth(points, given, triangles, 5);
    for (std::size_t k = given; k < points.size(); ++k) {
        const Vec3 x = origin + points[k].x() * u + points[k].y() * w;
        outline.push_back(add_inner_node(f_, x, {}, true, face_near(section, x)));
    }
    for (const Triangle& t : triangles) section.fresh.push_back({outline[t[0]], outline[t[1]], outline[t[2]]});
}

void FilletCavity::mesh_arcs() {
    if (sections_.empty()) {
        mesh_whole_arc();
        return;
    }
    for (std::size_t k = 0; k + 1 < sections_.size(); ++k) mesh_arc(sections_[k], sections_[k + 1]);
    if (path_.closed()) mesh_arc(sections_.back(), sections_.front());
}

/// About that of the nodes on the tangent lines.
double FilletCavity::spacing_along() const {
    const double step = path_.arc_length() / divisions_,
                 mean = path_.length() / (0.5 * static_cast<double>(rows_[0].size() + rows_[1].size() - 2) + 1e-9);
    return std::clamp(mean, step, 2.5 * step);
}

/// Points inside an arc's unrolled face, in rows from one side to the other.
std::vector<Vec2> FilletCavity::inner_points(const std::function<double(int)>& from,
                                             const std::function<double(int)>& to) const {
    const double step = path_.arc_length() / divisions_, spacing = spacing_along();
    std::vector<Vec2> inner;
    for (int k = 1; k < divisions_; ++k) {
        const double length = to(k) - from(k);
        const int count = std::max(1, static_cast<int>(std::lround(length / spacing)));
        for (int j = 0; j <= count; ++j) {
            const double along = (j + (k % 2 ? 0.5 : 0)) * length / count;
            if (along > 0.4 * spacing && along < length - 0.4 * spacing) inner.emplace_back(from(k) + along, k * step);
        }
    }
    return inner;
}

/// The arc between two sections.
void FilletCavity::mesh_arc(const Section& from, const Section& to) {
    const int domain = from.domain[1];
    if (domain < 0 || domain != to.domain[0]) refuse("borders there do not follow each other", at(from.arc[0]));
    const double step = path_.arc_length() / divisions_, around = path_.length();
    // Of a closed edge, going on beyond where s begins anew.
    const auto s_of = [&](int v) {
        double s = place(v).s;
        if (path_.closed() && s < from.s - 0.25 * around) s += around;
        return s;
    };
    const bool wraps = path_.closed() && to.s <= from.s;
    const auto end_s = [&](int v) {
        return wraps && place(v).s < from.s + 0.5 * around ? place(v).s + around : s_of(v);
    };
    std::vector<int> node_of;
    std::vector<Vec2> outline;
    const auto add = [&](int v, double s, double q) {
        node_of.push_back(v);
        outline.emplace_back(s, q);
    };
    const auto row_between = [&](int side) {
        std::vector<int> nodes;
        const Row& row = rows_[side];
        for (std::size_t k = from.in_row[side];; k = (k + 1) % row.size()) {
            nodes.push_back(row[k]);
            if (k == to.in_row[side] && nodes.size() > 1) return nodes;
            if (nodes.size() > row.size() + 1) refuse("its tangent lines are torn", at(row[0]));
        }
    };
    const std::vector<int> first = row_between(0), second = row_between(1);
    const auto along = [&](const std::vector<int>& row, std::size_t k) {
        return k == 0                                       ? place(row[0]).s
               : k + 1 == row.size()                        ? end_s(row[k])
               : wraps && place(row[k]).s < place(row[0]).s ? place(row[k]).s + around
                                                            : place(row[k]).s;
    };
    for (std::size_t k = 0; k < first.size(); ++k) add(first[k], along(first, k), 0);
    for (int k = 1; k < divisions_; ++k) add(to.arc[k], end_s(to.arc[k]), k * step);
    for (std::size_t k = second.size(); k-- > 0;) add(second[k], along(second, k), path_.arc_length());
    for (int k = divisions_ - 1; k > 0; --k) add(from.arc[k], place(from.arc[k]).s, k * step);
    add_arc_triangles(
        node_of, outline,
        inner_points([&](int k) { return place(from.arc[k]).s; }, [&](int k) { return end_s(to.arc[k]); }), domain);
}

/// The arc of a closed edge, cut open from the first node of one tangent line to the nearest of the other.
void FilletCavity::mesh_whole_arc() {
    const double step = path_.arc_length() / divisions_, around = path_.length();
    const auto nearest = std::ranges::min_element(rows_[1], {}, [&](int v) {
        const double d = std::abs(place(v).s - place(rows_[0][0]).s);
        return std::min(d, around - d);
    });
    std::ranges::rotate(rows_[1], nearest);
    const double begin = place(rows_[0][0]).s;
    double end = place(rows_[1][0]).s;
    if (end > begin + around / 2) end -= around;
    const auto seam_s = [&](int k) { return begin + k * (end - begin) / divisions_; };
    Row seam;
    for (int k = 1; k < divisions_; ++k) {
        const Vec3 x = path_.at(seam_s(k), path_.arc(path_.arc_angle() * k / divisions_));
        seam.push_back(add_inner_node(f_, x, &path_.ball(), true, nodes_near(x)));
    }
    const auto unrolled = [&](int v, double from) {
        const double s = place(v).s;
        return s < from - 1e-9 * around ? s + around : s >= from + around * (1 - 1e-9) ? s - around : s;
    };
    std::vector<int> node_of;
    std::vector<Vec2> outline;
    const auto add = [&](int v, double s, double q) {
        node_of.push_back(v);
        outline.emplace_back(s, q);
    };
    for (const int v : rows_[0]) add(v, unrolled(v, begin), 0);
    add(rows_[0][0], begin + around, 0);
    for (int k = 1; k < divisions_; ++k) add(seam[k - 1], seam_s(k) + around, k * step);
    add(rows_[1][0], end + around, path_.arc_length());
    for (std::size_t k = rows_[1].size(); k-- > 0;) add(rows_[1][k], unrolled(rows_[1][k], end), path_.arc_length());
    for (int k = divisions_ - 1; k > 0; --k) add(seam[k - 1], seam_s(k), k * step);
    add_arc_triangles(node_of, outline, inner_points(seam_s, [&](int k) { return seam_s(k) + around; }), 0);
}

void FilletCavity::add_arc_triangles(const std::vector<int>& node_of, const std::vector<Vec2>& outline,
                                     const std::vector<Vec2>& inner, int domain) {
    std::vector<int> nodes = node_of;
    for (const Vec2& p : inner) {
        const Vec3 x = path_.at(p.x(), path_.arc(p.y() / path_.radius()));
        nodes.push_back(add_inner_node(f_, x, &path_.ball(), true, nodes_near(x)));
    }
    double outwards = 0;
    const std::size_t first = arc_.size();
    // As if nodes were as far apart along the edge as across: then no triangle reaches over several rows, whose chords
    // would be far off the arc.
    const double scale = path_.arc_length() / divisions_ / spacing_along();
    const auto squeezed = [&](std::vector<Vec2> all) {
        for (Vec2& p : all) p.x() *= scale;
        return all;
    };
    for (const Triangle& t : triangulate(squeezed(outline), squeezed(inner))) {
        const Triangle face{nodes[t[0]], nodes[t[1]], nodes[t[2]]};
        arc_.push_back({face, domain});
        const Vec3 normal = (at(face[1]) - at(face[0])).cross(at(face[2]) - at(face[0]));
        outwards += normal.dot(path_.ball().normal(at(face[0])));
    }
    if ((outwards > 0) != path_.convex())
        for (std::size_t k = first; k < arc_.size(); ++k) std::swap(arc_[k].nodes[1], arc_[k].nodes[2]);
}

/// Each domain by itself, so that new elements have the groups of their own.
void FilletCavity::fill() {
    std::vector<Vec3> points;
    points.reserve(f_.d.band.nodes.size());
    for (const BandNode& n : f_.d.band.nodes) points.push_back(n.at);
    BandMesh& band = f_.d.band;
    FillOptions options;
    options.enough = 0.3;
    for (int domain = 0; domain < domains_; ++domain) {
        std::vector<Triangle> surface;
        for (const auto* faces : {&kept_, &arc_})
            for (const Face& face : *faces)
                if (face.domain == domain) surface.push_back(face.nodes);
        for (const Section& section : sections_)
            for (const Triangle& t : section.fresh) {
                if (section.domain[0] == domain) surface.push_back(t);
                if (section.domain[1] == domain) surface.push_back({t[0], t[2], t[1]});
            }
        Filled filled = fill_cavity(points, surface, options);
        std::vector<int> fresh;
        fresh.reserve(filled.points.size());
        for (const Vec3& x : filled.points) fresh.push_back(add_inner_node(f_, x, {}, false, nodes_near(x)));
        for (Tetra t : filled.tetras) {
            for (int& v : t)
                if (v >= static_cast<int>(points.size())) v = fresh[v - static_cast<int>(points.size())];
            const int of = removed_[parent((at(t[0]) + at(t[1]) + at(t[2]) + at(t[3])) / 4, domain)];
            band.tetras.add_part(t, of);
            f_.taken.push_back(
                {band.tetra_cells[band.tetras.origin(of)], -signed_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3]))});
        }
    }
}

/// Mid-side nodes at the tangent lines of a circular edge. That these are on the ball cannot be left to a contact with
/// it, as it only touches the curved faces there.
void FilletCavity::bend_row_edges() {
    std::set<int> on_row;
    for (const Row& row : rows_) on_row.insert(row.begin(), row.end());
    for (const Face& face : arc_)
        for (int k = 0; k < 3; ++k) {
            const int a = face.nodes[k], b = face.nodes[(k + 1) % 3];
            if (!on_row.contains(a) && !on_row.contains(b)) continue;
            const Vec3 chord = (at(a) + at(b)) / 2;
            Vec3 middle = path_.ball().project(chord);
            for (const Row& row : rows_)
                if (std::ranges::find(row, a) != row.end() && std::ranges::find(row, b) != row.end())
                    middle = path_.at(path_.place(chord).s, path_.tangent_point(&row == &rows_[0] ? 0 : 1));
            middles_.insert_or_assign(edge_key(a, b), middle);
            if (f_.d.band.mid_nodes.contains(edge_key(a, b)))
                f_.d.mids.mend(a, b, middle - chord);
            else
                f_.d.mids.set_bulge(a, b, middle - chord);
        }
}

/// What lay on the old faces of a section lies on the new ones.
void FilletCavity::write_section(const Section& section) {
    BandMesh& band = f_.d.band;
    const auto on = [&](const auto& list, const Triangle& face) {
        std::vector<int> slots;
        for (const int s : list.around(face[0]))
            if (sorted(list[s]) == sorted(face)) slots.push_back(s);
        return slots;
    };
    for (const Triangle& t : section.fresh) {
        const Triangle& like = face_near(section, (at(t[0]) + at(t[1]) + at(t[2])) / 3);
        const auto turned_as = [&](const Triangle& other) {
            const bool same = other == like || other == Triangle{like[1], like[2], like[0]} ||
                              other == Triangle{like[2], like[0], like[1]};
            return same ? t : Triangle{t[0], t[2], t[1]};
        };
        for (const int s : on(band.skin, like)) band.skin.add_part(turned_as(band.skin[s]), s);
        for (const int s : on(band.facet_faces, like))
            band.facet_faces.add(turned_as(band.facet_faces[s]), band.facet_faces.tag(s));
        for (const int s : on(band.triangles, like)) {
            band.triangles.add_part(turned_as(band.triangles[s]), s);
            f_.taken.push_back({band.triangle_cells[band.triangles.origin(s)],
                                -(at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / 2});
        }
    }
}

/// The old face of a section whose middle is nearest.
const Triangle& FilletCavity::face_near(const Section& section, const Vec3& x) const {
    return *std::ranges::min_element(
        section.old, {}, [&](const Triangle& o) { return ((at(o[0]) + at(o[1]) + at(o[2])) / 3 - x).squaredNorm(); });
}

std::array<int, 4> FilletCavity::nodes_near(const Vec3& x) const { return f_.d.band.tetras[removed_[parent(x, -1)]]; }

/// Place in removed_ of the element that is nearest, of a domain if not -1; of one that is about so, far from all.
int FilletCavity::parent(const Vec3& x, int domain) const {
    const auto [i, j, k] = cube(x);
    int best = -1;
    const auto look = [&](int c) {
        if (domain >= 0 && domain_[c] != domain) return;
        if (best < 0 || (centres_[c] - x).squaredNorm() < (centres_[best] - x).squaredNorm()) best = c;
    };
    for (long reach = 1; best < 0 && reach < 4; ++reach)
        for (long a = i - reach; a <= i + reach; ++a)
            for (long b = j - reach; b <= j + reach; ++b)
                for (long c = k - reach; c <= k + reach; ++c)
                    if (const auto found = near_.find({a, b, c}); found != near_.end())
                        for (const int place : found->second) look(place);
    if (best < 0)
        for (int c = 0; c < static_cast<int>(centres_.size()); ++c) look(c);
    return best;
}

}  // namespace femscalpel
