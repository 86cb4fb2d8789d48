// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_cavity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <sstream>

#include "cancel.h"
#include "cutting/inner_node.h"
#include "cutting/removal.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

using Edge = std::array<int, 2>;

[[noreturn]] void refuse(const std::string& text, const Vec3& near) {
    std::ostringstream message;
    message << "the edge cannot be rounded near (" << near.transpose() << "): " << text;
    throw QualityError(message.str());
}

Triangle sorted(Triangle t) {
    std::ranges::sort(t);
    return t;
}

template <class Faces>
std::set<Edge> directed_edges(const Faces& faces) {
    std::set<Edge> out;
    for (const Triangle& t : faces)
        for (int k = 0; k < 3; ++k) out.insert({t[k], t[(k + 1) % 3]});
    return out;
}

}  // namespace

FilletCavity::FilletCavity(Workpiece& workpiece, const Mesh& mesh, const FilletPath& path, double reach)
    : f_(workpiece), mesh_(mesh), path_(path), reach_(reach) {}

void FilletCavity::replace(int tag) {
    collect();
    find_domains();
    sort_centres();
    find_boundary();
    find_sections();
    find_rows();
    put_rows_on_ball();
    divide_arc();
    for (Section& section : sections_) make_arc(section);
    for (Section& section : sections_) mesh_section(section);
    mesh_arcs();
    fill();
    for (const Section& section : sections_) write_section(section);
    remove_elements(f_, removed_);
    for (const Face& face : arc_) f_.d.band.cut_faces.add(face.nodes, tag);
    if (f_.d.mids.any() && !path_.is_straight())
        bend_row_edges();
    else
        for (const Row& row : rows_)
            for (const int v : row) f_.d.contact[v] = &path_.ball();
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

/// Elements between the walls, joined to the edge through faces.
void FilletCavity::collect() {
    const BandMesh& band = f_.d.band;
    const auto is_inside = [&](int t) {
        const auto& n = band.tetras[t];
        const Vec3 middle = (at(n[0]) + at(n[1]) + at(n[2]) + at(n[3])) / 4;
        for (const int side : {0, 1}) {
            const Tool& wall = path_.wall(side);
            if (wall.distance(middle) >= 0) return false;
            for (const int v : n)
                if (f_.value(v, wall) > 10 * f_.tolerance) return false;
        }
        return std::ranges::all_of(n, [&](int v) { return path_.distance(at(v), reach_) <= reach_; });
    };
    std::vector<char> state(static_cast<std::size_t>(band.tetras.size()), 0);
    std::vector<int> queue;
    const auto visit = [&](int t) {
        if (state[t] != 0) return;
        state[t] = is_inside(t) ? 1 : 2;
        if (state[t] == 1) queue.push_back(t);
    };
    for (int v = 0; v < band.size(); ++v)
        if (path_.distance(at(v), 0) <= 1e-6 * path_.radius() + 2 * path_.sag() && band.in_use(v))
            for (const int t : band.tetras.around(v)) visit(t);
    while (!queue.empty()) {
        check_cancelled();
        const int t = queue.back();
        queue.pop_back();
        removed_.push_back(t);
        for (const int v : band.tetras[t])
            for (const int s : band.tetras.around(v)) {
                const auto shared = std::ranges::count_if(band.tetras[s], [&](int w) {
                    return std::ranges::find(band.tetras[t], w) != band.tetras[t].end();
                });
                if (shared == 3) visit(s);
            }
    }
    if (removed_.empty()) refuse("no element lies there", path_.at((path_.begin() + path_.end()) / 2, Vec2::Zero()));
    std::ranges::sort(removed_);
    for (const int t : removed_) {
        const auto& n = band.tetras[t];
        centres_.emplace_back((at(n[0]) + at(n[1]) + at(n[2]) + at(n[3])) / 4);
    }
}

void FilletCavity::sort_centres() {
    double volume = 0;
    for (const int t : removed_) {
        const auto& n = f_.d.band.tetras[t];
        volume += signed_volume(at(n[0]), at(n[1]), at(n[2]), at(n[3]));
    }
    cell_ = 2 * std::cbrt(volume / static_cast<double>(removed_.size()));
    for (int k = 0; k < static_cast<int>(centres_.size()); ++k) near_[cube(centres_[k])].push_back(k);
}

std::array<long, 3> FilletCavity::cube(const Vec3& x) const {
    return {std::lround(x.x() / cell_), std::lround(x.y() / cell_), std::lround(x.z() / cell_)};
}

/// Elements that are joined through faces on which nothing is kept.
void FilletCavity::find_domains() {
    const BandMesh& band = f_.d.band;
    const auto family = [&](int k) {
        const CellRef& c = band.tetra_cells[band.tetras.origin(removed_[k])];
        return mesh_.block(c.type).families[c.cell];
    };
    std::map<Triangle, std::pair<int, Triangle>> open;  // by sorted nodes: place in removed_ and face
    std::vector<std::vector<int>> joined(removed_.size());
    std::vector<std::pair<Triangle, std::array<int, 2>>> borders;
    for (int k = 0; k < static_cast<int>(removed_.size()); ++k)
        for (const auto& f : outward_faces) {
            const auto& n = band.tetras[removed_[k]];
            const Triangle face{n[f[0]], n[f[1]], n[f[2]]};
            const auto [it, fresh] = open.emplace(sorted(face), std::pair(k, face));
            if (fresh) continue;
            const int other = it->second.first;
            if (family(k) != family(other) || band.skin.find(face) >= 0) {
                borders.push_back({it->second.second, {other, k}});
            } else {
                joined[k].push_back(other);
                joined[other].push_back(k);
            }
            open.erase(it);
        }
    domain_.assign(removed_.size(), -1);
    for (int k = 0; k < static_cast<int>(removed_.size()); ++k) {
        if (domain_[k] >= 0) continue;
        std::vector<int> queue{k};
        domain_[k] = domains_;
        while (!queue.empty()) {
            const int at = queue.back();
            queue.pop_back();
            for (const int next : joined[at])
                if (domain_[next] < 0) {
                    domain_[next] = domains_;
                    queue.push_back(next);
                }
        }
        ++domains_;
    }
    for (const auto& [face, sides] : borders) {
        borders_.push_back({face, domain_[sides[0]]});
        borders_.push_back({{face[0], face[2], face[1]}, domain_[sides[1]]});
    }
}

void FilletCavity::find_boundary() {
    const BandMesh& band = f_.d.band;
    std::map<Triangle, Face> open;
    for (std::size_t k = 0; k < removed_.size(); ++k)
        for (const auto& f : outward_faces) {
            const auto& n = band.tetras[removed_[k]];
            const Triangle face{n[f[0]], n[f[1]], n[f[2]]};
            const auto [it, fresh] = open.emplace(sorted(face), Face{face, domain_[k]});
            if (!fresh) open.erase(it);
        }
    for (const auto& [key, face] : open) {
        const bool is_skin = std::ranges::none_of(band.tetras.around(key[0]), [&](int s) {
            return !std::ranges::binary_search(removed_, s) && std::ranges::all_of(face.nodes, [&](int v) {
                return std::ranges::find(band.tetras[s], v) != band.tetras[s].end();
            });
        });
        if (!is_skin)
            kept_.push_back(face);
        else if (is_strip(face.nodes, 0))
            strips_[0].push_back(face.nodes);
        else if (is_strip(face.nodes, 1))
            strips_[1].push_back(face.nodes);
        else
            skin_.push_back(face);
    }
}

bool FilletCavity::is_strip(const Triangle& face, int side) const {
    const Vec3 normal = (at(face[1]) - at(face[0])).cross(at(face[2]) - at(face[0])).normalized();
    const double length = std::sqrt((at(face[1]) - at(face[0])).squaredNorm());
    const Vec3 middle = (at(face[0]) + at(face[1]) + at(face[2])) / 3;
    const auto [s, p] = path_.place(middle);
    const Vec3 expected = (path_.at(s, p + path_.radius() * path_.normal(side)) - path_.at(s, p)).normalized();
    if (normal.dot(expected) < 0.9) return false;
    const double off = 2 * path_.sag() + 1e-3 * length;
    return std::ranges::all_of(face, [&](int v) { return std::abs(place(v).p.dot(path_.normal(side))) <= off; });
}

void FilletCavity::find_sections() {
    if (!path_.closed()) sections_.push_back(section_at(corner_at(path_.begin()), skin_, false));
    find_borders();
    if (!path_.closed()) sections_.push_back(section_at(corner_at(path_.end()), skin_, false));
    kept_.insert(kept_.end(), skin_.begin(), skin_.end());
}

/// The borders between domains, one after the other along the edge.
void FilletCavity::find_borders() {
    const std::size_t first = sections_.size();
    while (!borders_.empty()) {
        // One of its nodes on the edge.
        int corner = -1;
        for (const Face& face : borders_)
            for (const int v : face.nodes)
                if (corner < 0 && path_.distance(at(v), 0) <= 2 * path_.sag() + 1e-6 * path_.radius()) corner = v;
        if (corner < 0)
            refuse(
                "a border of groups, or another surface that is kept, runs through the material there, and does not "
                "cross the edge",
                at(borders_[0].nodes[0]));
        sections_.push_back(section_at(corner, borders_, true));
    }
    std::sort(sections_.begin() + static_cast<std::ptrdiff_t>(first), sections_.end(),
              [](const Section& a, const Section& b) { return a.s < b.s; });
}

/// The node of the skin at an end of the edge.
int FilletCavity::corner_at(double s) const {
    const Vec3 tip = path_.at(s, Vec2::Zero());
    int corner = -1;
    for (const auto& strip : strips_)
        for (const Triangle& t : strip)
            for (const int v : t)
                if (corner < 0 || (at(v) - tip).squaredNorm() < (at(corner) - tip).squaredNorm()) corner = v;
    if (corner < 0) refuse("the skin beside it is not found", tip);
    return corner;
}

/// The plane faces at a node of the edge, out of `faces`, which they are taken from.
FilletCavity::Section FilletCavity::section_at(int corner, std::vector<Face>& faces, bool border) const {
    Section section;
    section.s = place(corner).s;
    const Vec3 tip = at(corner);
    const auto normal = [&](const Triangle& t) {
        return Vec3((at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized());
    };
    for (const Face& face : faces) {
        if (std::ranges::find(face.nodes, corner) == face.nodes.end()) continue;
        const Vec3 n = normal(face.nodes);
        if (section.normal.isZero())
            section.normal = n;
        else if ((n - section.normal).norm() > 1e-6 && (!border || (n + section.normal).norm() > 1e-6))
            refuse(border ? "more than one border, or one that is not plane, crosses it"
                          : "it ends at a corner of more than three faces, at a wall that stands across it, or at a "
                            "face that is not plane; there is no end for such a rounding yet",
                   tip);
    }
    if (section.normal.isZero()) refuse("it does not end at a face of the part", tip);
    const double step = path_.mean_edge() / 4;
    const double along = section.normal.dot(
        (path_.at(section.s + step, Vec2::Zero()) - path_.at(section.s - step, Vec2::Zero())).normalized());
    if (std::abs(along) < 0.3) refuse("it meets a face or border at too small an angle", tip);
    if (along < 0) section.normal = -section.normal;
    section.offset = section.normal.dot(tip);
    const double off = 1e-7 * (path_.radius() + path_.length());
    std::erase_if(faces, [&](const Face& face) {
        const double facing = normal(face.nodes).dot(section.normal);
        if (std::abs(facing) < 1 - 1e-6 || std::ranges::any_of(face.nodes, [&](int v) {
                return std::abs(section.normal.dot(at(v)) - section.offset) > off;
            }))
            return false;
        // Out of the domain before it: seen from behind.
        int& domain = section.domain[facing > 0 ? 0 : 1];
        if (domain >= 0 && domain != face.domain) refuse("several borders meet there", at(face.nodes[0]));
        domain = face.domain;
        if (facing > 0)
            section.old.push_back(face.nodes);
        else if (!border)
            section.old.push_back({face.nodes[0], face.nodes[2], face.nodes[1]});
        return true;
    });
    return section;
}

void FilletCavity::find_rows() {
    for (const int side : {0, 1}) rows_[side] = find_row(side);
    for (Section& section : sections_) place_in_rows(section);
}

/// Where the outline of what goes of a section leaves the skin beside the edge.
void FilletCavity::place_in_rows(Section& section) const {
    std::set<int> nodes;
    for (const Triangle& t : section.old) nodes.insert(t.begin(), t.end());
    for (const int side : {0, 1}) {
        const auto found = std::ranges::find_if(rows_[side], [&](int v) { return nodes.contains(v); });
        if (found == rows_[side].end())
            refuse("a border or face across it does not reach the ball", at(section.old[0][0]));
        section.in_row[side] = static_cast<std::size_t>(found - rows_[side].begin());
    }
}

FilletCavity::Row FilletCavity::find_row(int side) const {
    const std::set<Edge> strips = [&] {
        std::set<Edge> all = directed_edges(strips_[0]);
        all.merge(directed_edges(strips_[1]));
        return all;
    }();
    std::set<Edge> ends;
    for (const Section& section : sections_)
        if (section.domain[0] < 0 || section.domain[1] < 0)
            for (const Edge& e : directed_edges(section.old)) ends.insert({{e[0], e[1]}, {e[1], e[0]}});
    std::set<int> nodes;
    std::size_t edges = 0;
    for (const Edge& e : directed_edges(strips_[side])) {
        if (strips.contains({e[1], e[0]}) || ends.contains({e[1], e[0]})) continue;
        nodes.insert(e.begin(), e.end());
        ++edges;
        for (const int v : e)
            if (std::abs(path_.wall(side).distance(at(v))) > 10 * f_.tolerance)
                refuse("the skin could not be parted along the line where the ball touches it; refine the mesh there",
                       at(v));
    }
    Row row(nodes.begin(), nodes.end());
    if (row.size() < 2 || row.size() != edges + (path_.closed() ? 0 : 1))
        refuse("the faces beside it do not go on as far as the ball touches them, all along",
               path_.at((path_.begin() + path_.end()) / 2, path_.tangent_point(side)));
    std::ranges::sort(row, {}, [&](int v) { return place(v).s; });
    return row;
}

/// Nodes of tangent lines on flat facets of a curved face go onto the face itself, if that spoils nothing.
void FilletCavity::put_rows_on_ball() {
    for (const int side : {0, 1})
        for (const int v : rows_[side]) {
            const Vec3 x = path_.at(place(v).s, path_.tangent_point(side));
            const Vec3 old = at(v);
            if ((x - old).norm() <= f_.tolerance) continue;
            const double before = quality_around(f_.d, v, old);
            if (quality_around(f_.d, v, x) < std::min(0.2, 0.7 * before)) continue;
            f_.d.band.nodes[v].at = x;
        }
}

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
    std::set<Edge> strips;
    for (const auto& strip : strips_)
        for (const Edge& e : directed_edges(strip)) strips.insert({{e[0], e[1]}, {e[1], e[0]}});
    const std::set<Edge> own = directed_edges(section.old);
    for (const Edge& e : own)
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

/// Points inside an arc's unrolled face, in rows from one side to the other.
std::vector<Vec2> FilletCavity::inner_points(const std::function<double(int)>& from,
                                             const std::function<double(int)>& to) const {
    const double step = path_.arc_length() / divisions_;
    const double mean = path_.length() / (0.5 * static_cast<double>(rows_[0].size() + rows_[1].size() - 2) + 1e-9),
                 spacing = std::clamp(mean, step, 2 * step);
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
    for (const Triangle& t : triangulate(outline, inner)) {
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
