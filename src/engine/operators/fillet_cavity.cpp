// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_cavity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <sstream>

#include "cutting/removal.h"
#include "mesh/quality.h"
#include "operators/fillet_inside.h"

namespace femscalpel {
void FilletCavity::refuse(const std::string& text, const Vec3& near) {
    std::ostringstream message;
    message << "the edge cannot be rounded near (" << near.transpose() << "): " << text;
    throw QualityError(message.str());
}

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

/// Elements between the walls, joined to the edge through faces.
void FilletCavity::collect() {
    const BandMesh& band = f_.d.band;
    removed_ = elements_inside(f_, band.tetras, path_, reach_, 1e-6 * path_.radius() + 2 * path_.sag());
    if (removed_.empty()) refuse("no element lies there", path_.at((path_.begin() + path_.end()) / 2, Vec2::Zero()));
    for (const int t : removed_) centres_.push_back(middle_of(band, band.tetras[t]));
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
    if (std::abs(along) < 0.3)
        refuse(border
                   ? "a border of groups, or another surface that is kept, runs along it: to which side new material "
                     "belongs is open. Round the edge before the groups are made"
                   : "it runs into the face where it ends at too small an angle",
               tip);
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
    const std::set<DirectedEdge> strips = [&] {
        std::set<DirectedEdge> all = directed_edges(strips_[0]);
        all.merge(directed_edges(strips_[1]));
        return all;
    }();
    std::set<DirectedEdge> ends;
    for (const Section& section : sections_)
        if (section.domain[0] < 0 || section.domain[1] < 0)
            for (const DirectedEdge& e : directed_edges(section.old)) ends.insert({{e[0], e[1]}, {e[1], e[0]}});
    std::set<int> nodes;
    std::size_t edges = 0;
    for (const DirectedEdge& e : directed_edges(strips_[side])) {
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

}  // namespace femscalpel
