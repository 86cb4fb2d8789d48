// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_material.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "mesh/quality.h"
#include "operators/fillet_inside.h"

namespace femscalpel {

void FilletMaterial::refuse(const std::string& text, const Vec3& near) {
    std::ostringstream message;
    message << "the edge cannot be rounded near (" << near.transpose() << "): " << text;
    throw QualityError(message.str());
}

FilletMaterial::FilletMaterial(Workpiece& workpiece, const Mesh& mesh, std::span<const FilletReach> edges)
    : f_(workpiece),
      mesh_(mesh),
      slack_(workpiece.d.rounding),
      edges_(edges.begin(), edges.end()),
      strips_(edges.size()) {
    collect(edges);
    find_domains();
    find_boundary(edges);
    leave_untouched(edges);
    sort_centres();
}

void FilletMaterial::collect(std::span<const FilletReach> edges) {
    for (const auto& [path, reach, next] : edges) {
        const std::vector<int> inside =
            elements_inside(f_, f_.d.band.tetras, *path, reach, 1e-6 * path->radius() + 2 * path->sag());
        if (inside.empty()) refuse("no element lies there", path->at((path->begin() + path->end()) / 2, Vec2::Zero()));
        removed_.insert(removed_.end(), inside.begin(), inside.end());
    }
    std::ranges::sort(removed_);
    removed_.erase(std::unique(removed_.begin(), removed_.end()), removed_.end());
    for (int round = 0; round < 10 && take_wedges(edges); ++round) {
    }
}

/// Elements that stay must not reach, like a wedge, with an edge or a node into the middle of plane faces that go: skin
/// or borders, which are made anew. They go, too. False when there are none.
bool FilletMaterial::take_wedges(std::span<const FilletReach> edges) {
    const auto& tetras = f_.d.band.tetras;
    std::map<DirectedEdge, std::vector<Triangle>> at_edge;
    for (const Triangle& face : outer_faces())
        for (int k = 0; k < 3; ++k) {
            const int a = face[k], b = face[(k + 1) % 3];
            at_edge[{std::min(a, b), std::max(a, b)}].push_back(face);
        }
    std::map<int, bool> inside;  // nodes, by whether all of their edges are within plane faces
    std::set<int> taken;
    const auto take_around = [&](int a, int b) {
        for (const int t : tetras.around(a)) {
            const auto& n = tetras[t];
            if (std::ranges::find(n, b) == n.end() || std::ranges::binary_search(removed_, t)) continue;
            const bool may_go = std::ranges::any_of(edges, [&](const FilletReach& e) {
                return std::ranges::all_of(n, [&](int v) {
                    return f_.value(v, e.path->wall(0)) <= 10 * f_.tolerance &&
                           f_.value(v, e.path->wall(1)) <= 10 * f_.tolerance;
                });
            });
            if (may_go) taken.insert(t);
        }
    };
    for (const auto& [e, faces] : at_edge) {
        const bool within =
            faces.size() == 2 && is_parallel(faces[0], normal(faces[1]), plane_angle + normal_slack(faces[1]));
        for (const int v : e) inside.emplace(v, true).first->second &= within;
        if (within) take_around(e[0], e[1]);
    }
    for (const auto& [v, within] : inside)
        if (within) take_around(v, v);
    removed_.insert(removed_.end(), taken.begin(), taken.end());
    std::ranges::sort(removed_);
    return !taken.empty();
}

/// The skin of the elements that go, and the borders between them.
std::vector<Triangle> FilletMaterial::outer_faces() const {
    const BandMesh& band = f_.d.band;
    const auto family = [&](int t) {
        const CellRef& c = band.tetra_cells[band.tetras.origin(t)];
        return mesh_.block(c.type).families[c.cell];
    };
    std::vector<Triangle> out;
    std::map<Triangle, std::pair<int, Triangle>> open;
    for (const int t : removed_)
        for (const auto& f : outward_faces) {
            const auto& n = band.tetras[t];
            const Triangle face{n[f[0]], n[f[1]], n[f[2]]};
            const auto [it, fresh] = open.emplace(sorted(face), std::pair(t, face));
            if (fresh) continue;
            if (family(t) != family(it->second.first) || band.skin.find(face) >= 0) out.push_back(face);
            open.erase(it);
        }
    for (const auto& [key, face] : open)
        if (is_skin(face.second)) out.push_back(face.second);
    return out;
}

/// Elements that are joined through faces on which nothing is kept.
void FilletMaterial::find_domains() {
    const BandMesh& band = f_.d.band;
    const auto family = [&](int k) {
        const CellRef& c = band.tetra_cells[band.tetras.origin(removed_[k])];
        return mesh_.block(c.type).families[c.cell];
    };
    std::map<Triangle, std::pair<int, Triangle>> open;  // by sorted nodes: place in removed_ and face
    std::vector<std::vector<int>> joined(removed_.size());
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
    join_domains(joined);
    for (Border& b : borders) b.domain = {domain_[b.domain[0]], domain_[b.domain[1]]};
}

void FilletMaterial::join_domains(const std::vector<std::vector<int>>& joined) {
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
}

void FilletMaterial::find_boundary(std::span<const FilletReach> edges) {
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
        if (!is_skin(face.nodes)) {
            kept.push_back(face);
            continue;
        }
        bool beside = false;
        for (std::size_t e = 0; e < edges.size(); ++e)
            for (const int side : {0, 1})
                if (is_strip(face.nodes, edges[e], side)) {
                    strips_[e][side].push_back(face);
                    beside = true;
                    break;
                }
        if (!beside) skin.push_back(face);
    }
    for (const auto& sides : strips_)
        for (const auto& strip : sides)
            for (const Face& face : strip)
                for (int k = 0; k < 3; ++k) strip_edges_.insert({face.nodes[k], face.nodes[(k + 1) % 3]});
}

/// Whether no element that stays has it.
bool FilletMaterial::is_skin(const Triangle& face) const {
    const auto& tetras = f_.d.band.tetras;
    return std::ranges::none_of(tetras.around(face[0]), [&](int s) {
        return !std::ranges::binary_search(removed_, s) &&
               std::ranges::all_of(face, [&](int v) { return std::ranges::find(tetras[s], v) != tetras[s].end(); });
    });
}

bool FilletMaterial::is_strip(const Triangle& face, const FilletReach& edge, int side) const {
    const FilletPath& path = *edge.path;
    const double length = std::sqrt((at(face[1]) - at(face[0])).squaredNorm());
    if (!is_within_ends(middle(face), edge, side)) return false;
    const auto [s, p] = path.place(middle(face));
    const Vec3 expected = (path.at(s, p + path.radius() * path.normal(side)) - path.at(s, p)).normalized();
    if (normal(face).dot(expected) < 0.9) return false;
    const double off = 2 * path.sag() + 1e-3 * length;
    return std::ranges::all_of(face, [&](int v) {
        const Vec2 q = path.place(at(v)).p;
        return f_.value(v, path.wall(side)) <= 10 * f_.tolerance && std::abs(q.dot(path.normal(side))) <= off &&
               q.dot(path.along_face(side)) >= -off;
    });
}

/// Whether a point is not beyond where the new face ends on a side of the edge.
bool FilletMaterial::is_within_ends(const Vec3& x, const FilletReach& edge, int side) const {
    const FilletPath& path = *edge.path;
    if (path.is_beyond_end(x)) return false;
    const auto [s, p] = path.place(x);
    for (const int which : {0, 1}) {
        if (path.end_kind(which) != LineEnd::joined) continue;
        if (which == 0 ? s >= path.begin() : s <= path.end()) continue;
        // Beyond a corner: as far as the other edge there has the face, too.
        const FilletPath* next = edge.next[which];
        if (!next) return false;
        const auto normal_of = [&](const FilletPath& of, int face) {
            const auto [t, q] = of.place(x);
            return Vec3(of.at(t, q + of.normal(face)) - of.at(t, q));
        };
        const auto shares = [&](int face) {
            return (normal_of(*next, face) - normal_of(path, side)).norm() <
                       1e-3 + path.face_slack() + next->face_slack() &&
                   next->wall(face).distance(x) < 0;
        };
        if (!shares(0) && !shares(1)) return false;
    }
    return true;
}

bool FilletMaterial::is_rounded_off(int v) const {
    return std::ranges::any_of(edges_, [&](const FilletReach& e) {
        return e.path->convex() && e.path->distance(at(v), 0) <= e.reach &&
               e.path->wall(0).distance(at(v)) < -close() && e.path->wall(1).distance(at(v)) < -close() &&
               e.path->ball().distance(at(v)) > close();
    });
}

/// Whether an element has a face that the new material's end, or that of what is rounded off, parts.
bool FilletMaterial::meets_end(int tetra, std::span<const FilletReach> edges) const {
    const auto parted = [&](const FilletPath& path, const Tool& end, const Triangle& face) {
        const double off = 10 * f_.tolerance + 4 * slack_.off();
        if (std::ranges::any_of(face, [&](int v) { return std::abs(end.distance(at(v))) > off; })) return false;
        const Vec2 p = path.place(middle(face)).p;
        const bool outside = p.dot(path.normal(0)) > 0 && p.dot(path.normal(1)) > 0;
        if (!path.convex()) return outside;
        return std::ranges::any_of(face, [&](int v) { return path.ball().distance(at(v)) > close(); });
    };
    for (const auto& [path, reach, next] : edges)
        for (const int which : {0, 1}) {
            if (path->closed() || path->end_kind(which) == LineEnd::plane) continue;
            const auto& n = f_.d.band.tetras[tetra];
            for (const auto& f : outward_faces)
                if (parted(*path, path->end_plane(which), {n[f[0]], n[f[1]], n[f[2]]})) return true;
        }
    return false;
}

/// Domains that have no skin beside the edges stay as they are.
void FilletMaterial::leave_untouched(std::span<const FilletReach> edges) {
    std::vector<char> goes(static_cast<std::size_t>(domains_), 0);
    for (const auto& sides : strips_)
        for (const auto& strip : sides)
            for (const Face& face : strip) goes[face.domain] = 1;
    for (std::size_t k = 0; k < removed_.size(); ++k)
        if (!goes[domain_[k]] &&
            (meets_end(removed_[k], edges) ||
             std::ranges::any_of(f_.d.band.tetras[removed_[k]], [&](int v) { return is_rounded_off(v); })))
            goes[domain_[k]] = 1;
    std::vector<int> removed, domain;
    for (std::size_t k = 0; k < removed_.size(); ++k) {
        if (!goes[domain_[k]]) continue;
        removed.push_back(removed_[k]);
        domain.push_back(domain_[k]);
    }
    if (removed.empty()) refuse("the skin beside it is not found", edges[0].path->at(0, Vec2::Zero()));
    if (removed.size() == removed_.size()) return;
    removed_ = std::move(removed);
    domain_ = std::move(domain);
    const auto stays = [&](const Face& face) { return !goes[face.domain]; };
    std::erase_if(kept, stays);
    std::erase_if(skin, stays);
    std::erase_if(borders, [&](const Border& b) {
        const auto& [one, other] = b.domain;
        if (goes[one] && goes[other]) return false;
        if (goes[one]) kept.push_back({b.nodes, one});
        if (goes[other]) kept.push_back({{b.nodes[0], b.nodes[2], b.nodes[1]}, other});
        return true;
    });
}

void FilletMaterial::sort_centres() {
    double volume = 0;
    for (const int t : removed_) {
        const auto& n = f_.d.band.tetras[t];
        volume += signed_volume(at(n[0]), at(n[1]), at(n[2]), at(n[3]));
        centres_.push_back(middle_of(f_.d.band, n));
        on_edges_.push_back(std::ranges::all_of(n, [&](int v) {
            return std::ranges::any_of(edges_, [&](const FilletReach& e) {
                return e.path->distance(at(v), 0) <= 2 * e.path->sag() + 1e-6 * e.path->radius();
            });
        }));
    }
    cell_ = 2 * std::cbrt(volume / static_cast<double>(removed_.size()));
    for (int k = 0; k < static_cast<int>(centres_.size()); ++k) near_[cube(centres_[k])].push_back(k);
}

std::array<long, 3> FilletMaterial::cube(const Vec3& x) const {
    return {std::lround(x.x() / cell_), std::lround(x.y() / cell_), std::lround(x.z() / cell_)};
}

int FilletMaterial::parent(const Vec3& x, int domain) const {
    return removed_[nearest(x, [&](int c) { return domain < 0 || domain_[c] == domain; })];
}

std::array<int, 4> FilletMaterial::nodes_near(const Vec3& x) const {
    return f_.d.band.tetras[removed_[nearest(x, [&](int c) { return !on_edges_[c]; })]];
}

/// Place of the element of some that is nearest.
int FilletMaterial::nearest(const Vec3& x, const std::function<bool(int)>& counts) const {
    const auto [i, j, k] = cube(x);
    int best = -1;
    const auto look = [&](int c) {
        if (!counts(c)) return;
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
    return std::max(best, 0);
}

}  // namespace femscalpel
