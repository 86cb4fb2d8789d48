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
    check_materials();
    find_boundary();
    find_ends();
    find_rows();
    put_rows_on_ball();
    divide_arc();
    for (std::size_t k = 0; k < ends_.size(); ++k) make_end_arc(ends_[k], k == 0);
    for (End& end : ends_) mesh_end(end);
    mesh_arc();
    fill();
    for (const End& end : ends_) write_end(end);
    remove_elements(f_, removed_);
    for (const Triangle& t : arc_) f_.d.band.cut_faces.add(t, tag);
    for (const Row& row : rows_)
        for (const int v : row) f_.d.contact[v] = &path_.ball();
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
    sort_centres();
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

void FilletCavity::check_materials() const {
    const BandMesh& band = f_.d.band;
    const auto family = [&](int t) {
        const CellRef& c = band.tetra_cells[band.tetras.origin(t)];
        return mesh_.block(c.type).families[c.cell];
    };
    for (std::size_t k = 1; k < removed_.size(); ++k) {
        const FamilyIndex one = family(removed_[0]), other = family(removed_[k]);
        if (one == other) continue;
        std::string names;
        for (const FamilyIndex f : {one, other})
            for (const GroupIndex g : mesh_.families.groups(f))
                if (!mesh_.families.contains(one, g) || !mesh_.families.contains(other, g))
                    names += (names.empty() ? "" : ", ") + mesh_.groups[g].name;
        refuse("elements of different groups (" + names + ") meet there, whose border would be lost", centres_[k]);
    }
}

void FilletCavity::find_boundary() {
    const BandMesh& band = f_.d.band;
    std::map<Triangle, Triangle> open;
    for (const int t : removed_)
        for (const auto& f : outward_faces) {
            const auto& n = band.tetras[t];
            const Triangle face{n[f[0]], n[f[1]], n[f[2]]};
            const auto [it, fresh] = open.emplace(sorted(face), face);
            if (!fresh) {
                if (band.skin.find(face) >= 0)
                    refuse("a border of groups, or another surface that is kept, runs through the material there",
                           at(face[0]));
                open.erase(it);
            }
        }
    for (const auto& [key, face] : open) {
        const bool is_skin = std::ranges::none_of(band.tetras.around(face[0]), [&](int s) {
            return !std::ranges::binary_search(removed_, s) && std::ranges::all_of(face, [&](int v) {
                return std::ranges::find(band.tetras[s], v) != band.tetras[s].end();
            });
        });
        if (!is_skin)
            kept_.push_back(face);
        else if (is_strip(face, 0))
            strips_[0].push_back(face);
        else if (is_strip(face, 1))
            strips_[1].push_back(face);
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

void FilletCavity::find_ends() {
    if (!path_.closed()) {
        ends_.push_back(find_end(path_.begin()));
        ends_.push_back(find_end(path_.end()));
    }
    std::set<Triangle> gone;
    for (const End& end : ends_)
        for (const Triangle& t : end.old) gone.insert(sorted(t));
    for (const Triangle& t : skin_)
        if (!gone.contains(sorted(t))) kept_.push_back(t);
}

/// The plane faces at an end of the edge that are not beside it.
FilletCavity::End FilletCavity::find_end(double s) const {
    End end;
    const Vec3 tip = path_.at(s, Vec2::Zero());
    int corner = -1;
    const auto all = {&strips_[0], &strips_[1]};
    for (const auto* strip : all)
        for (const Triangle& t : *strip)
            for (const int v : t)
                if (corner < 0 || (at(v) - tip).squaredNorm() < (at(corner) - tip).squaredNorm()) corner = v;
    if (corner < 0) refuse("the skin beside it is not found", tip);
    for (const Triangle& t : skin_) {
        if (std::ranges::find(t, corner) == t.end()) continue;
        const Vec3 n = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized();
        if (end.normal.isZero()) {
            end.normal = n;
            end.offset = n.dot(at(corner));
        } else if ((n - end.normal).norm() > 1e-6)
            refuse("it ends at a corner of more than three faces, or at a face that is not plane", tip);
    }
    if (end.normal.isZero()) refuse("it does not end at a face of the part", tip);
    if (std::abs(end.normal.dot((path_.at(s, Vec2::Zero()) -
                                 path_.at(s + (s == path_.begin() ? 1 : -1) * path_.mean_edge() / 4, Vec2::Zero()))
                                    .normalized())) < 0.3)
        refuse("it runs into the face where it ends at too small an angle", tip);
    const double off = 1e-7 * (path_.radius() + path_.length());
    for (const Triangle& t : skin_) {
        const Vec3 n = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized();
        if ((n - end.normal).norm() <= 1e-4 &&
            std::ranges::all_of(t, [&](int v) { return std::abs(end.normal.dot(at(v)) - end.offset) <= off; }))
            end.old.push_back(t);
    }
    return end;
}

void FilletCavity::find_rows() {
    for (const int side : {0, 1}) rows_[side] = find_row(side);
}

FilletCavity::Row FilletCavity::find_row(int side) const {
    const std::set<Edge> strips = [&] {
        std::set<Edge> all = directed_edges(strips_[0]);
        all.merge(directed_edges(strips_[1]));
        return all;
    }();
    std::set<Edge> ends;
    for (const End& end : ends_) ends.merge(directed_edges(end.old));
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

/// Where the line of the ball's surface through a section point meets the plane of an end.
double FilletCavity::on_plane(const Vec2& p, const End& end, double s) const {
    const double step = 1e-4 * path_.radius();
    for (int k = 0; k < 50; ++k) {
        const double value = end.normal.dot(path_.at(s, p)) - end.offset,
                     slope = (end.normal.dot(path_.at(s + step, p)) - end.offset - value) / step;
        const double move = -value / slope;
        s += move;
        if (std::abs(move) < 1e-14 * (path_.radius() + path_.length())) break;
    }
    return s;
}

void FilletCavity::make_end_arc(End& end, bool at_begin) {
    const int first = at_begin ? rows_[0].front() : rows_[0].back(),
              last = at_begin ? rows_[1].front() : rows_[1].back();
    end.arc.push_back(first);
    for (int k = 1; k < divisions_; ++k) {
        const Vec2 p = path_.arc(path_.arc_angle() * k / divisions_);
        end.arc.push_back(new_node(path_.at(on_plane(p, end, place(first).s), p), &path_.ball(), true));
    }
    end.arc.push_back(last);
}

void FilletCavity::mesh_end(End& end) {
    // The outline of the old faces without the edges they share with what goes, as a path.
    std::map<int, int> next;
    std::set<Edge> strips = directed_edges(strips_[0]);
    strips.merge(directed_edges(strips_[1]));
    const std::set<Edge> own = directed_edges(end.old);
    for (const Edge& e : own)
        if (!own.contains({e[1], e[0]}) && !strips.contains({e[1], e[0]}))
            if (!next.emplace(e[0], e[1]).second) refuse("the face where it ends is only joined at a point", at(e[0]));
    std::vector<int> outline;
    for (const auto& [from, to] :
         std::array{std::pair(end.arc.front(), end.arc.back()), std::pair(end.arc.back(), end.arc.front())}) {
        outline = {from};
        while (next.contains(outline.back()) && outline.size() <= next.size()) outline.push_back(next[outline.back()]);
        if (outline.back() == to && outline.size() == next.size() + 1) break;
        outline.clear();
    }
    if (outline.empty()) refuse("the face where it ends is too small, or has a hole there", at(end.arc.front()));
    if (outline.back() == end.arc.front())
        outline.insert(outline.end(), end.arc.begin() + 1, end.arc.end() - 1);
    else
        outline.insert(outline.end(), end.arc.rbegin() + 1, end.arc.rend() - 1);

    const Vec3 u = end.normal.unitOrthogonal(), w = end.normal.cross(u), origin = at(outline[0]);
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
    for (std::size_t k = given; k < points.size(); ++k)
        outline.push_back(new_node(origin + points[k].x() * u + points[k].y() * w, {}, true));
    for (const Triangle& t : triangles) end.fresh.push_back({outline[t[0]], outline[t[1]], outline[t[2]]});
}

void FilletCavity::mesh_arc() {
    const double step = path_.arc_length() / divisions_;
    std::vector<int> node_of;
    std::vector<Vec2> outline, inner;
    const auto add = [&](int v, double s, double q) {
        node_of.push_back(v);
        outline.emplace_back(s, q);
    };
    const double top = path_.arc_length();
    Row seam;
    double seam_begin = 0, seam_end = 0;  // s on the first and the second line
    if (path_.closed()) {
        // Cut open from the first node of one line to the nearest of the other.
        const double around = path_.length();
        const auto nearest = std::ranges::min_element(rows_[1], {}, [&](int v) {
            const double d = std::abs(place(v).s - place(rows_[0][0]).s);
            return std::min(d, around - d);
        });
        std::ranges::rotate(rows_[1], nearest);
        seam_begin = place(rows_[0][0]).s;
        seam_end = place(rows_[1][0]).s;
        if (seam_end > seam_begin + around / 2) seam_end -= around;
        for (int k = 1; k < divisions_; ++k) {
            const double part = static_cast<double>(k) / divisions_;
            seam.push_back(
                new_node(path_.at(seam_begin + part * (seam_end - seam_begin), path_.arc(path_.arc_angle() * part)),
                         &path_.ball(), true));
        }
        const auto unrolled = [&](int v, double from) {
            const double s = place(v).s;
            return s < from - 1e-9 * around ? s + around : s >= from + around * (1 - 1e-9) ? s - around : s;
        };
        const double seam_at[2] = {seam_begin, seam_end};
        for (const int v : rows_[0]) add(v, unrolled(v, seam_at[0]), 0);
        add(rows_[0][0], seam_begin + around, 0);
        for (int k = 1; k < divisions_; ++k)
            add(seam[k - 1], seam_begin + around + k * (seam_end - seam_begin) / divisions_, k * step);
        add(rows_[1][0], seam_end + around, top);
        for (std::size_t k = rows_[1].size(); k-- > 0;) add(rows_[1][k], unrolled(rows_[1][k], seam_at[1]), top);
        for (int k = divisions_ - 1; k > 0; --k)
            add(seam[k - 1], seam_begin + k * (seam_end - seam_begin) / divisions_, k * step);
    } else {
        for (const int v : rows_[0]) add(v, place(v).s, 0);
        for (int k = 1; k < divisions_; ++k) add(ends_[1].arc[k], place(ends_[1].arc[k]).s, k * step);
        for (std::size_t k = rows_[1].size(); k-- > 0;) add(rows_[1][k], place(rows_[1][k]).s, top);
        for (int k = divisions_ - 1; k > 0; --k) add(ends_[0].arc[k], place(ends_[0].arc[k]).s, k * step);
    }
    const double mean = path_.length() / (0.5 * static_cast<double>(rows_[0].size() + rows_[1].size() - 2) + 1e-9),
                 spacing = std::clamp(mean, step, 2 * step);
    for (int k = 1; k < divisions_; ++k) {
        const double part = static_cast<double>(k) / divisions_;
        double from, to;
        if (path_.closed()) {
            from = seam_begin + part * (seam_end - seam_begin);
            to = from + path_.length();
        } else {
            from = place(ends_[0].arc[k]).s;
            to = place(ends_[1].arc[k]).s;
        }
        const int count = std::max(1, static_cast<int>(std::lround((to - from) / spacing)));
        const double shift = k % 2 ? 0.5 : 0;
        for (int j = 0; j <= count; ++j) {
            const double s = from + (j + shift) * (to - from) / count;
            if (s > from + 0.4 * spacing && s < to - 0.4 * spacing) inner.emplace_back(s, k * step);
        }
    }
    add_arc_triangles(node_of, outline, inner);
}

void FilletCavity::add_arc_triangles(const std::vector<int>& node_of, const std::vector<Vec2>& outline,
                                     const std::vector<Vec2>& inner) {
    std::vector<int> nodes = node_of;
    for (const Vec2& x : inner)
        nodes.push_back(new_node(path_.at(x.x(), path_.arc(x.y() / path_.radius())), &path_.ball(), true));
    double outwards = 0;
    for (const Triangle& t : triangulate(outline, inner)) {
        const Triangle& face = arc_.emplace_back(Triangle{nodes[t[0]], nodes[t[1]], nodes[t[2]]});
        const Vec3 normal = (at(face[1]) - at(face[0])).cross(at(face[2]) - at(face[0]));
        outwards += normal.dot(path_.ball().normal(at(face[0])));
    }
    if ((outwards > 0) != path_.convex())
        for (Triangle& t : arc_) std::swap(t[1], t[2]);
}

void FilletCavity::fill() {
    std::vector<Vec3> points;
    std::vector<Triangle> surface = kept_;
    for (const End& end : ends_) surface.insert(surface.end(), end.fresh.begin(), end.fresh.end());
    surface.insert(surface.end(), arc_.begin(), arc_.end());
    for (const BandNode& n : f_.d.band.nodes) points.push_back(n.at);
    FillOptions options;
    options.enough = 0.3;
    Filled filled = fill_cavity(points, surface, options);
    std::vector<int> fresh;
    for (const Vec3& x : filled.points) fresh.push_back(new_node(x, {}, false));
    BandMesh& band = f_.d.band;
    for (Tetra t : filled.tetras) {
        for (int& v : t)
            if (v >= static_cast<int>(points.size())) v = fresh[v - static_cast<int>(points.size())];
        const int of = parent((at(t[0]) + at(t[1]) + at(t[2]) + at(t[3])) / 4);
        band.tetras.add_part(t, removed_[of]);
        f_.taken.push_back({band.tetra_cells[band.tetras.origin(removed_[of])],
                            -signed_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3]))});
    }
}

/// What lay on the old faces of an end lies on the new ones.
void FilletCavity::write_end(const End& end) {
    BandMesh& band = f_.d.band;
    const auto on = [&](const auto& list, const Triangle& face) {
        std::vector<int> slots;
        for (const int s : list.around(face[0]))
            if (sorted(list[s]) == sorted(face)) slots.push_back(s);
        return slots;
    };
    for (const Triangle& t : end.fresh) {
        const Vec3 middle = (at(t[0]) + at(t[1]) + at(t[2])) / 3;
        const Triangle& like = *std::ranges::min_element(end.old, {}, [&](const Triangle& o) {
            return ((at(o[0]) + at(o[1]) + at(o[2])) / 3 - middle).squaredNorm();
        });
        for (const int s : on(band.skin, like)) band.skin.add_part(t, s);
        for (const int s : on(band.facet_faces, like)) band.facet_faces.add(t, band.facet_faces.tag(s));
        for (const int s : on(band.triangles, like)) {
            const bool turned = band.triangles[s] != like && band.triangles[s] != Triangle{like[1], like[2], like[0]} &&
                                band.triangles[s] != Triangle{like[2], like[0], like[1]};
            band.triangles.add_part(turned ? Triangle{t[0], t[2], t[1]} : t, s);
            f_.taken.push_back({band.triangle_cells[band.triangles.origin(s)],
                                -(at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / 2});
        }
    }
}

/// Place in removed_ of the element that is nearest; of one that is about so, far from all.
int FilletCavity::parent(const Vec3& x) const {
    const auto [i, j, k] = cube(x);
    int best = -1;
    const auto look = [&](int c) {
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

/// A node that is in the node groups which two nodes of the element there have in common, the two with fewest.
int FilletCavity::new_node(const Vec3& x, const Contact& tools, bool exterior) {
    const auto n = f_.d.band.tetras[removed_[parent(x)]];
    std::array<int, 2> between{n[0], n[1]};
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b) {
            const auto one = f_.d.membership.groups(n[a]), other = f_.d.membership.groups(n[b]);
            const auto common = static_cast<std::size_t>(
                std::ranges::count_if(one, [&](GroupIndex g) { return std::ranges::find(other, g) != other.end(); }));
            if (common >= fewest) continue;
            fewest = common;
            between = {n[a], n[b]};
        }
    const int node = f_.d.add_node(x, between[0], between[1], tools, exterior);
    f_.distance.push_back(1);
    return node;
}

}  // namespace femscalpel
