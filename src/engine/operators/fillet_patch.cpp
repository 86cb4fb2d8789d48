// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_patch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cutting/inner_node.h"
#include "cutting/planar_mesh.h"

namespace femscalpel {
namespace {

bool holds(const Triangle& t, int v) { return std::ranges::find(t, v) != t.end(); }

Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

bool lies_in(const FilletMaterial& m, const Triangle& t, const Vec3& normal, double offset, double off) {
    return m.is_parallel(t, normal, FilletMaterial::plane_angle) &&
           std::ranges::none_of(t, [&](int v) { return std::abs(normal.dot(m.at(v)) - offset) > off; });
}

/// Takes those that are marked out of a list.
template <typename T>
void erase_marked(std::vector<T>& list, const std::vector<char>& marked) {
    std::size_t left = 0;
    for (std::size_t k = 0; k < list.size(); ++k)
        if (!marked[k]) list[left++] = list[k];
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(left), list.end());
}

}  // namespace

/// Of faces that are marked, those that hang together with the ones at a node stay so.
void FilletPatches::keep_connected(std::vector<char>& taken, const std::vector<Triangle>& faces, int node) const {
    std::map<DirectedEdge, std::vector<std::size_t>> at_edge;
    for (std::size_t k = 0; k < faces.size(); ++k)
        for (int i = 0; i < 3 && taken[k]; ++i) {
            const int a = faces[k][i], b = faces[k][(i + 1) % 3];
            at_edge[{std::min(a, b), std::max(a, b)}].push_back(k);
        }
    std::vector<char> connected(faces.size(), 0);
    std::vector<std::size_t> queue;
    const auto visit = [&](std::size_t k) {
        if (connected[k]) return;
        connected[k] = 1;
        queue.push_back(k);
    };
    for (std::size_t k = 0; k < faces.size(); ++k)
        if (taken[k] && holds(faces[k], node)) visit(k);
    while (!queue.empty()) {
        const std::size_t k = queue.back();
        queue.pop_back();
        for (int i = 0; i < 3; ++i) {
            const int a = faces[k][i], b = faces[k][(i + 1) % 3];
            for (const std::size_t other : at_edge[{std::min(a, b), std::max(a, b)}]) visit(other);
        }
    }
    taken = std::move(connected);
}

/// A patch that another edge has taken already.
int FilletPatches::known(const Vec3& normal, double off, int node, std::array<int, 2> domain, bool any) const {
    for (std::size_t k = 0; k < patches_.size(); ++k) {
        const FilletPatch& p = patches_[k];
        const double sign = p.normal.dot(normal) > 0 ? 1 : -1;
        if (std::ranges::none_of(p.old, [&](const Triangle& t) { return holds(t, node); })) continue;
        if ((p.normal - sign * normal).norm() > FilletMaterial::plane_angle ||
            std::abs(p.normal.dot(m_.at(node)) - p.offset) > 10 * off)
            continue;
        const std::array<int, 2> own = sign > 0 ? p.domain : std::array{p.domain[1], p.domain[0]};
        const bool fits = any ? (own[0] < 0) != (own[1] < 0) : own == domain;
        if (fits) return static_cast<int>(k);
    }
    return -1;
}

int FilletPatches::take_skin(const Vec3& normal, double offset, double off, int node, int domain) {
    std::vector<Triangle> faces;
    std::vector<char> taken;
    for (const auto& face : m_.skin) {
        faces.push_back(face.nodes);
        taken.push_back((domain < 0 || face.domain == domain) && lies_in(m_, face.nodes, normal, offset, off));
    }
    keep_connected(taken, faces, node);
    FilletPatch patch{normal, offset, {-1, -1}};
    for (std::size_t k = 0; k < faces.size(); ++k) {
        if (!taken[k]) continue;
        const bool behind = m_.normal(faces[k]).dot(normal) > 0;
        int& side = patch.domain[behind ? 0 : 1];
        if (side >= 0 && side != m_.skin[k].domain) m_.refuse("groups meet on the face in which it ends", m_.at(node));
        side = m_.skin[k].domain;
        patch.old.push_back(behind ? faces[k] : turned(faces[k]));
    }
    if (patch.old.empty()) {
        const int behind = known(normal, off, node, {domain, -1}, domain < 0);
        return behind >= 0 ? behind : known(normal, off, node, {-1, domain}, domain < 0);
    }
    erase_marked(m_.skin, taken);
    patches_.push_back(std::move(patch));
    return static_cast<int>(patches_.size()) - 1;
}

int FilletPatches::take_border(const Vec3& normal, double offset, double off, int node,
                               const std::array<int, 2>& domain) {
    std::vector<Triangle> faces;
    std::vector<char> taken;
    for (const auto& b : m_.borders) {
        const bool forwards = m_.normal(b.nodes).dot(normal) > 0;
        faces.push_back(b.nodes);
        taken.push_back(b.domain == (forwards ? domain : std::array{domain[1], domain[0]}) &&
                        lies_in(m_, b.nodes, normal, offset, off));
    }
    keep_connected(taken, faces, node);
    FilletPatch patch{normal, offset, domain};
    for (std::size_t k = 0; k < faces.size(); ++k)
        if (taken[k]) patch.old.push_back(m_.normal(faces[k]).dot(normal) > 0 ? faces[k] : turned(faces[k]));
    if (patch.old.empty()) return known(normal, off, node, domain, false);
    erase_marked(m_.borders, taken);
    patches_.push_back(std::move(patch));
    return static_cast<int>(patches_.size()) - 1;
}

int FilletPatches::add_free(const Vec3& normal, double offset, const std::array<int, 2>& domain) {
    patches_.push_back({normal, offset, domain, true});
    return static_cast<int>(patches_.size()) - 1;
}

void FilletPatches::mesh() {
    for (FilletPatch& patch : patches_) mesh(patch);
}

/// The outline of what is to be meshed: that of the old faces, without what they share with the skin that goes, closed
/// by the links; counter-clockwise, where there are old faces.
std::vector<int> FilletPatches::outline_of(const FilletPatch& patch) const {
    std::map<int, int> next;
    const std::set<DirectedEdge> own = directed_edges(patch.old);
    for (const DirectedEdge& e : own)
        if (!own.contains({e[1], e[0]}) && !m_.is_strip_edge(e[0], e[1]) && !m_.is_strip_edge(e[1], e[0]) &&
            !hidden_.contains(e))
            if (!next.emplace(e[0], e[1]).second) m_.refuse("a face across it is only joined at a point", m_.at(e[0]));
    std::vector<std::vector<int>> links = patch.links;
    if (!next.empty() && !next.contains(links[0].back())) std::ranges::reverse(links[0]);
    const int start = links[0].back();
    std::vector<int> outline{start};
    std::size_t left = next.size() + links.size();
    while (left > 0) {
        const int at = outline.back();
        if (const auto on = next.find(at); on != next.end()) {
            outline.push_back(on->second);
            next.erase(on);
        } else {
            const auto link = std::ranges::find_if(
                links, [&](const auto& l) { return !l.empty() && (l.front() == at || l.back() == at); });
            if (link == links.end()) break;
            if (link->front() != at) std::ranges::reverse(*link);
            outline.insert(outline.end(), link->begin() + 1, link->end());
            link->clear();
        }
        --left;
        if (outline.back() == start) break;
    }
    if (left > 0 || outline.back() != start)
        m_.refuse("a face across it is too small, or has a hole there", m_.at(start));
    outline.pop_back();
    return outline;
}

void FilletPatches::mesh(FilletPatch& patch) {
    std::vector<int> outline = outline_of(patch);
    const Vec3 u = patch.normal.unitOrthogonal(), w = patch.normal.cross(u), origin = m_.at(outline[0]);
    std::vector<Vec2> points;
    double length = 0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        points.emplace_back(u.dot(m_.at(outline[k]) - origin), w.dot(m_.at(outline[k]) - origin));
        length += (m_.at(outline[k]) - m_.at(outline[(k + 1) % outline.size()])).norm();
    }
    if (patch.free && polygon_area(points) < 0) {
        std::ranges::reverse(points);
        std::ranges::reverse(outline);
    }
    const std::vector<Vec2> inside = points_inside(points, length / static_cast<double>(outline.size()));
    const std::vector<Triangle> triangles = triangulate(points, inside);
    const std::size_t given = points.size();
    points.insert(points.end(), inside.begin(), inside.end());
    smooth(points, given, triangles, 5);
    const std::array<int, 1> self{static_cast<int>(
        std::ranges::find_if(patches_, [&](const FilletPatch& p) { return &p == &patch; }) - patches_.begin())};
    for (std::size_t k = given; k < points.size(); ++k) {
        const Vec3 x = origin + points[k].x() * u + points[k].y() * w;
        outline.push_back(add_inner_node(m_.workpiece(), x, {}, true, nodes_near(self, x)));
    }
    for (const Triangle& t : triangles) patch.fresh.push_back({outline[t[0]], outline[t[1]], outline[t[2]]});
}

void FilletPatches::carry_over() {
    for (const FilletPatch& patch : patches_)
        if (!patch.free) carry_over(patch);
}

void FilletPatches::carry_over(const FilletPatch& patch) {
    BandMesh& band = m_.workpiece().d.band;
    const auto on = [&](const auto& list, const Triangle& face) {
        std::vector<int> slots;
        for (const int s : list.around(face[0]))
            if (sorted(list[s]) == sorted(face)) slots.push_back(s);
        return slots;
    };
    std::set<Triangle> old;
    for (const Triangle& t : patch.old) old.insert(sorted(t));
    for (const Triangle& t : patch.fresh) {
        // What lies on a face that was there before stays.
        if (old.contains(sorted(t))) continue;
        const Triangle& like = face_near(patch, m_.middle(t));
        const auto turned_as = [&](const Triangle& other) {
            const bool same = other == like || other == Triangle{like[1], like[2], like[0]} ||
                              other == Triangle{like[2], like[0], like[1]};
            return same ? t : turned(t);
        };
        for (const int s : on(band.skin, like)) band.skin.add_part(turned_as(band.skin[s]), s);
        for (const int s : on(band.facet_faces, like))
            band.facet_faces.add(turned_as(band.facet_faces[s]), band.facet_faces.tag(s));
        for (const int s : on(band.triangles, like)) {
            band.triangles.add_part(turned_as(band.triangles[s]), s);
            const double area = (m_.at(t[1]) - m_.at(t[0])).cross(m_.at(t[2]) - m_.at(t[0])).norm() / 2;
            m_.workpiece().taken.push_back({band.triangle_cells[band.triangles.origin(s)], -area});
        }
    }
}

/// The old face whose middle is nearest.
const Triangle& FilletPatches::face_near(const FilletPatch& patch, const Vec3& x) const {
    return *std::ranges::min_element(patch.old, {},
                                     [&](const Triangle& t) { return (m_.middle(t) - x).squaredNorm(); });
}

std::vector<int> FilletPatches::nodes_near(std::span<const int> patches, const Vec3& x) const {
    const Triangle* best = nullptr;
    for (const int k : patches) {
        if (k < 0 || patches_[k].old.empty()) continue;
        const Triangle& t = face_near(patches_[k], x);
        if (!best || (m_.middle(t) - x).squaredNorm() < (m_.middle(*best) - x).squaredNorm()) best = &t;
    }
    if (best) return {best->begin(), best->end()};
    const std::array<int, 4> nodes = m_.nodes_near(x);
    return {nodes.begin(), nodes.end()};
}

}  // namespace femscalpel
