// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include "cutting/checks.h"
#include "cutting/improve.h"
#include "cutting/removal.h"
#include "cutting/retry.h"
#include "cutting/snap.h"
#include "deformation/curved_shape.h"
#include "mesh/crop.h"
#include "mesh/union_find.h"
#include "operators/driver.h"
#include "operators/face_nodes.h"
#include "operators/fillet_cavity.h"
#include "operators/fillet_corner.h"
#include "operators/fillet_path.h"
#include "operators/fillet_vertex.h"
#include "operators/follow_fields.h"
#include "operators/raise_order.h"
#include "operators/seven_nodes.h"
#include "operators/weld_first.h"

namespace femscalpel {
namespace {

/// Longest edges over the arc's length; most are shorter by a third after bisection: there are four and more.
constexpr double longest_over_arc = 1 / 3.2;
/// The same over the radius of a tangent line about an axis: some eight go around.
constexpr double longest_over_radius = 0.8;
/// Elements of a mesh refined for a fillet, about, over the edge's length in radii; from so many on it is not tried.
constexpr double elements_over_radius = 1000, most_elements = 5e6;
constexpr int fillet_attempts = 8;
/// Smallest mean ratio of what is filled from which on nothing else is tried.
constexpr double good_enough = 0.2;

/// Zero within some distance of an edge, so that everything there is in the band.
class Surroundings final : public Tool {
public:
    Surroundings(const FilletPath& path, double reach) : path_(path), reach_(reach) {}
    std::string kind() const override { return "edge"; }
    double distance(const Vec3& x) const override { return std::max(0.0, path_.distance(x, reach_) - reach_); }
    Vec3 normal(const Vec3& x) const override { return path_.ball().normal(x); }
    double feature_size() const override { return std::numeric_limits<double>::infinity(); }

private:
    const FilletPath& path_;
    double reach_;
};

/// An edge being rounded.
struct Rounding {
    std::unique_ptr<FilletPath> path;
    double reach;  // what is replaced lies within this distance of the edge
    std::unique_ptr<Surroundings> surroundings;
};

class Fillet final : public Recipe {
public:
    Fillet(const Mesh& mesh, const Along& along, double radius, const FilletOptions& options) : options_(options) {
        if (options.method == Method::deform)
            throw ToolError("method \"deform\" moves nodes only; edges are rounded by method \"snap\"", "method");
        plane_ = mesh.dimension() == 2;
        if (plane_)
            find_corners(mesh, along, radius);
        else
            find_edges(mesh, along, radius);
        for (Rounding& r : roundings_) {
            r.reach = r.path->convex() ? 1.02 * r.path->centre().norm() : r.path->tangent_length() + 1.2 * radius;
            r.surroundings = std::make_unique<Surroundings>(*r.path, r.reach);
        }
        check_apart(radius);
        makers_.clear();
        check_fineness();
        for (Rounding& r : roundings_)
            for (const int side : {0, 1}) add_wall(r, side);
        for (const Rounding& r : roundings_)
            for (const int which : {0, 1})
                if (!plane_ && r.path->end_kind(which) == LineEnd::open) add_end(*r.path, which);
        for (const Rounding& r : roundings_) surroundings_.push_back({r.surroundings.get(), {}, {}, -1});
    }

    const char* kind() const override { return "fillet"; }
    void start(const Mesh&) override {}

    std::vector<RefineZone> zones() const override {
        std::vector<RefineZone> zones;
        if (options_.refine.when == RefineFirst::When::never) return zones;
        for (const Rounding& r : roundings_) {
            const FilletPath& path = *r.path;
            const bool to_size = options_.refine.when == RefineFirst::When::to_size;
            const double size = to_size ? options_.refine.size : path.arc_length() * longest_over_arc;
            zones.push_back(
                {[&path](const Vec3& x) { return std::max(0.0, path.distance(x, 0) - 1.1 * path.tangent_length()); },
                 size});
            // A tangent line that is a small circle about the axis.
            for (const int side : {0, 1}) {
                const double round = plane_ ? size : longest_over_radius * path.tangent_radius(side);
                if (to_size || round >= size) continue;
                zones.push_back({[&path, side](const Vec3& x) {
                                     const double off = (path.place(x).p - path.tangent_point(side)).norm();
                                     return std::max(0.0, off - path.tangent_radius(side));
                                 },
                                 round});
            }
        }
        return zones;
    }

    std::span<const Blade> blades() const override { return blades_; }
    std::span<const Blade> surroundings() const override { return surroundings_; }

    Naming naming() const override {
        Naming out;
        out.groups.push_back({options_.name + "_FACE"});
        if (has_ends_) out.groups.push_back({options_.name + "_END"});
        return out;
    }

    bool cut(Workpiece& f, const Site& site) override {
        f.warnings.insert(f.warnings.end(), warnings_.begin(), warnings_.end());
        cut_soundly(
            f,
            [&](Workpiece& g) {
                for (std::size_t k = 0; k < blades_.size(); ++k) cut_along(g, blades_[k]);
                relax_band(g);
            },
            site.whole.cell_count(), fillet_attempts);
        return true;
    }

    Opening open(Workpiece& f, const Site& site) override {
        auto& faces = f.d.band.cut_faces;
        for (int s = 0; s < faces.size(); ++s)
            if (faces.alive(s)) faces.remove(s);
        auto& edges = f.d.band.cut_edges;
        for (int s = 0; s < edges.size(); ++s)
            if (edges.alive(s)) edges.remove(s);
        if (plane_)
            for (const Rounding& r : roundings_) FilletCorner(f, site.mesh, *r.path, r.reach).replace(0);
        else
            replace(f, site.mesh);
        finish_contacts(f);
        check_shape(f, site.mesh);
        find_node_sets(f);
        check_contacts(f);
        return open_walls(f);
    }

private:
    /// Edges that meet, or are near each other, at once.
    void replace(Workpiece& f, const Mesh& mesh) const {
        UnionFind meeting(roundings_.size());
        for (const FilletVertex& v : vertices_)
            for (const auto& m : v.members)
                meeting.unite(static_cast<int>(v.members[0].edge), static_cast<int>(m.edge));
        for (std::size_t k = 0; k < roundings_.size(); ++k)
            for (std::size_t j = 0; j < k; ++j)
                if (are_near(roundings_[k], roundings_[j])) meeting.unite(static_cast<int>(k), static_cast<int>(j));
        std::map<int, std::vector<std::size_t>> cavities;
        for (std::size_t k = 0; k < roundings_.size(); ++k) cavities[meeting.find(static_cast<int>(k))].push_back(k);
        std::map<std::uint64_t, Vec3> middles;
        for (const auto& [first, members] : cavities) {
            std::vector<FilletReach> edges;
            for (const std::size_t k : members) edges.push_back({roundings_[k].path.get(), roundings_[k].reach});
            std::vector<FilletVertex> vertices;
            for (const FilletVertex& v : vertices_) {
                if (meeting.find(static_cast<int>(v.members[0].edge)) != first) continue;
                vertices.push_back(v);
                for (auto& m : vertices.back().members)
                    m.edge = static_cast<std::size_t>(std::ranges::find(members, m.edge) - members.begin());
                if (v.is_mitre())
                    for (const int k : {0, 1}) {
                        const auto &one = vertices.back().members[k], &other = vertices.back().members[1 - k];
                        edges[one.edge].next[one.which] = edges[other.edge].path;
                    }
            }
            replace(f, mesh, edges, vertices, middles);
        }
        if (!middles.empty())
            f.mid_side = [&f, middles](int a, int b) {
                const auto known = middles.find(edge_key(a, b));
                return known == middles.end() ? mid_side(f.d, a, b).at : known->second;
            };
    }

    /// Where elements come out poor, or none can be made, the arc is divided in other ways.
    static void replace(Workpiece& f, const Mesh& mesh, std::span<const FilletReach> edges,
                        const std::vector<FilletVertex>& vertices, std::map<std::uint64_t, Vec3>& middles) {
        const Workpiece before = f;
        double best = -1;
        std::exception_ptr failure;
        std::map<std::uint64_t, Vec3> bent;
        for (const int more : {0, 2, -2, 4}) {
            Workpiece trial = before;
            try {
                FilletCavity cavity(trial, mesh, edges, vertices);
                const double worst = cavity.replace(0, more);
                if (worst <= best) continue;
                best = worst;
                bent = cavity.middles();
            } catch (const QualityError&) {
                if (!failure) failure = std::current_exception();
                continue;
            }
            f = std::move(trial);
            if (best >= good_enough) break;
        }
        if (best < 0) std::rethrow_exception(failure);
        middles.insert(bent.begin(), bent.end());
    }

    /// Nodes keep contact with the new faces only.
    void finish_contacts(Workpiece& f) const {
        std::set<const Tool*> balls;
        for (const Rounding& r : roundings_) balls.insert(&r.path->ball());
        for (const FilletVertex& v : vertices_) balls.insert(v.sphere.get());
        for (int v = 0; v < f.d.band.size(); ++v) {
            Contact on;
            for (const Tool* t : f.d.contact[v].tools())
                if (balls.contains(t)) on = on.with(t);
            f.d.contact[v] = on;
            if (!on) f.d.held_off[v] = 0;
        }
    }

    /// The normal of a face into the material, which is out of an edge that ends at it.
    static Vec3 out_of_edge(const Mesh& mesh, const std::array<Index, 3>& f) {
        return (mesh.points[f[2]] - mesh.points[f[0]]).cross(mesh.points[f[1]] - mesh.points[f[0]]).normalized();
    }

    void find_edges(const Mesh& mesh, const Along& along, double radius) {
        const auto shared = std::make_shared<const std::vector<std::array<Index, 3>>>(skin_of(mesh));
        const std::vector<std::array<Index, 3>>& skin = *shared;
        const std::vector<FeatureLine> lines = find_feature_lines(mesh, along, options_.feature_angle);
        const auto planes = std::make_shared<const SkinPlanes>(mesh, skin);
        vertices_ = find_vertices(mesh, lines, skin, planes.get());
        std::vector<const FilletPath*> paths;
        for (std::size_t k = 0; k < lines.size(); ++k) {
            FilletEnds ends{line_ends(mesh, lines[k], skin)};
            for (const int which : {0, 1}) {
                if (ends.kind[which] != LineEnd::wall) continue;
                const auto wall = wall_at_end(mesh, lines[k], which, skin);
                const auto plane = wall ? planes->of(*wall) : std::nullopt;
                if (wall) ends.normal[which] = plane ? Vec3(-plane->normal) : out_of_edge(mesh, *wall);
            }
            for (const FilletVertex& v : vertices_)
                for (const auto& m : v.members) {
                    if (m.edge != k) continue;
                    ends.kind[m.which] = LineEnd::joined;
                    ends.to_centre[m.which] = v.to_centre;
                }
            makers_.push_back([&mesh, shared, planes, line = lines[k], ends](double size) {
                return std::make_unique<FilletPath>(mesh, line, size, *shared, ends, planes.get());
            });
            roundings_.push_back({makers_.back()(radius), 0, nullptr});
            paths.push_back(roundings_.back().path.get());
            if (lines[k].extended)
                warnings_.emplace_back("the edge goes on beyond what was named, and is rounded as far as it goes");
        }
        for (FilletVertex& v : vertices_) v.join(paths);
    }

    /// Whether an edge meets others at a corner that is not right-angled.
    bool ends_at_slant(const FilletPath& path) const {
        return std::ranges::any_of(vertices_, [&](const FilletVertex& v) {
            return !v.right_angled && std::ranges::any_of(v.members, [&](const auto& m) {
                return roundings_[m.edge].path.get() == &path;
            });
        });
    }

    /// Whether a straight edge's wall is that of another edge.
    static bool is_wall(const FilletPath& path, int side, const FilletPath& other, const Tool& others) {
        if (&path == &other || !path.is_straight()) return false;
        const Vec2 &p = path.tangent_point(side), &q = path.normal(side);
        return std::ranges::all_of(
            std::array{path.at(path.begin(), p), path.at(path.end(), p), path.at(path.begin(), p + path.radius() * q)},
            [&](const Vec3& x) {
                // Rounded coordinates tell the less of where a wall is, the farther it is from its edge.
                const double off = 1e-9 * (path.length() + path.radius()) + 2 * path.sag() +
                                   path.face_slack() * path.place(x).p.norm() +
                                   other.face_slack() * other.place(x).p.norm();
                return std::abs(others.distance(x)) <= off && others.normal(x).dot(path.wall(side).normal(x)) > 0.999;
            });
    }

    /// A surface to be cut along. Those of edges that meet may be one: nodes lie on three at most.
    void add_wall(Rounding& r, int side) {
        const FilletPath& path = *r.path;
        const auto bound = [&path, reach = r.reach, side, shallow = ends_at_slant(path)](const Vec3& x) {
            const double across = std::max(path.wall(1 - side).distance(x), path.distance(x, reach) - reach);
            if (!shallow) return across;
            // Six walls would meet in the ball's centre: they part what is near the skin, and no more.
            return std::max(across, 5 * std::abs(path.place(x).p.dot(path.normal(side))));
        };
        const auto found = std::ranges::find_if(
            blades_, [&](const Blade& blade) { return is_wall(path, side, *owners_[blade.tag], *blade.tool); });
        if (found != blades_.end()) {
            r.path->use_wall(side, *found->tool);
            found->inside.clear();
            found->bound = [first = found->bound, bound](const Vec3& x) { return std::min(first(x), bound(x)); };
            return;
        }
        // With a tag: improving elements must keep these faces.
        Blade blade{&path.wall(side), bound, {}, static_cast<int>(blades_.size())};
        if (side == 1) blade.inside.push_back(&path.wall(0));
        blades_.push_back(std::move(blade));
        owners_.push_back(&path);
    }

    /// The skin beside the edge is parted where its rounding stops.
    void add_end(const FilletPath& path, int which) {
        has_ends_ = true;
        const Vec3 tip = path.at(which == 0 ? path.begin() : path.end(), Vec2::Zero());
        Blade blade{&path.end_plane(which), {}, {&path.wall(0), &path.wall(1)}, static_cast<int>(blades_.size())};
        blade.bound = [tip, reach = 1.05 * path.tangent_length()](const Vec3& x) { return (x - tip).norm() - reach; };
        blades_.push_back(std::move(blade));
        std::ostringstream message;
        message << "the edge ends at a corner where its rounding cannot run out: it stops at (" << tip.transpose()
                << ") in a face across it, in the group " << options_.name << "_END";
        warnings_.push_back(message.str());
    }

    /// Whether a point is, but for a margin, in what one edge's rounding takes off or adds.
    static bool is_rounded(const FilletPath& path, const Vec3& x) {
        const auto [s, p] = path.place(x);
        const double margin = 0.02 * path.radius(), sign = path.convex() ? -1 : 1;
        if (!path.closed() && (s < path.begin() - margin || s > path.end() + margin)) return false;
        for (const int side : {0, 1})
            if (path.wall(side).distance(x) > margin || sign * p.dot(path.normal(side)) < -margin) return false;
        return (p - path.centre()).norm() >= path.radius() - margin;
    }

    /// Throws where roundings touch, but for those of edges that meet.
    void check_apart(double radius) const {
        const auto meet = [&](std::size_t k, std::size_t j) {
            return std::ranges::any_of(vertices_, [&](const FilletVertex& v) {
                const auto has = [&](std::size_t e) {
                    return std::ranges::any_of(v.members, [&](const auto& m) { return m.edge == e; });
                };
                return has(j) && has(k);
            });
        };
        for (std::size_t k = 0; k < roundings_.size(); ++k)
            for (std::size_t j = 0; j < roundings_.size(); ++j)
                if (j != k && !meet(k, j))
                    if (const auto x = where_touching(*roundings_[k].path, *roundings_[j].path)) {
                        std::ostringstream message;
                        message << "along: edges are so near each other that their roundings would touch, or all but "
                                << "do so, as at (" << x->transpose()
                                << "): " << room_for(radius, makers_[k], makers_[j]);
                        throw ToolError(message.str(), "along");
                    }
    }

    /// The mesh is refined for what is rounded: the more, the smaller the radius.
    void check_fineness() const {
        if (plane_ || options_.refine.when != RefineFirst::When::automatic) return;
        for (const Rounding& r : roundings_) {
            const double elements = elements_over_radius * r.path->length() / r.path->radius();
            if (elements <= most_elements) continue;
            std::ostringstream message;
            message.precision(3);
            message << "radius: " << r.path->radius() << " is so small against the edge's length of "
                    << r.path->length() << " that the mesh along it would be refined to some " << elements / 1e6
                    << " million elements. Round by " << elements_over_radius * r.path->length() / most_elements
                    << " or more";
            throw ToolError(message.str(), "radius");
        }
    }

    using Maker = std::function<std::unique_ptr<FilletPath>(double)>;

    /// What to do where two edges' roundings of a radius touch.
    static std::string room_for(double radius, const Maker& one, const Maker& other) {
        double fits = 0, touches = 1;
        for (int round = 0; round < 12; ++round) {
            const double part = (fits + touches) / 2;
            const auto first = one(part * radius), second = other(part * radius);
            (where_touching(*first, *second) || where_touching(*second, *first) ? touches : fits) = part;
        }
        std::ostringstream text;
        text.precision(3);
        if (fits > 0)
            text << "there is room for a radius of about " << fits * radius;
        else
            text << "there is no room for both";
        return text.str();
    }

    /// A point of one edge's new face in or near what another's takes off or adds.
    static std::optional<Vec3> where_touching(const FilletPath& path, const FilletPath& other) {
        const int steps = static_cast<int>(std::ceil(path.length() / (0.25 * path.radius())));
        for (int i = 0; i <= steps; ++i)
            for (int part = 0; part <= 8; ++part) {
                const double s = path.begin() + path.length() * i / std::max(steps, 1);
                const Vec3 x = path.at(s, path.arc(path.arc_angle() * part / 8));
                if (is_rounded(other, x)) return x;
            }
        return {};
    }

    /// Whether what is replaced around two edges may touch.
    static bool are_near(const Rounding& one, const Rounding& other) {
        const FilletPath& path = *one.path;
        const int steps = static_cast<int>(std::ceil(path.length() / (0.5 * path.radius())));
        for (int i = 0; i <= steps; ++i) {
            const Vec3 x = path.at(path.begin() + path.length() * i / std::max(steps, 1), Vec2::Zero());
            if (other.path->distance(x, 0) <= 1.5 * (one.reach + other.reach)) return true;
        }
        return false;
    }

    void find_corners(const Mesh& mesh, const Along& along, double radius) {
        for (const OutlineCorner& c : find_outline_corners(mesh, along, options_.feature_angle)) {
            const Vec3& at = mesh.points[c.node];
            makers_.push_back([&mesh, c](double size) {
                return std::make_unique<FilletPath>(mesh, mesh.points[c.node], c.normal, c.along, c.convex, size);
            });
            Rounding r{makers_.back()(radius), 0, nullptr};
            if (r.path->tangent_length() > 0.999 * std::min(c.room[0], c.room[1])) {
                std::ostringstream message;
                message << "radius: " << radius << " is too large for the corner at (" << at.transpose()
                        << "): the outline is straight for " << std::min(c.room[0], c.room[1])
                        << " beside it, and would be touched at " << r.path->tangent_length();
                throw ToolError(message.str(), "radius");
            }
            roundings_.push_back(std::move(r));
        }
    }

    const FilletOptions& options_;
    bool plane_ = false;  // a mesh of triangles, with corners
    bool has_ends_ = false;
    std::vector<Rounding> roundings_;
    std::vector<Maker> makers_;  // of the paths of roundings_ by another radius; until all is known
    std::vector<FilletVertex> vertices_;
    std::vector<Blade> blades_, surroundings_;
    std::vector<const FilletPath*> owners_;  // of the walls among the blades
    std::vector<std::string> warnings_;
};

}  // namespace

Result fillet(const Mesh& mesh, const Along& along, double radius, const FilletOptions& options,
              const Prepared& prepared) {
    check_fillet_radius(radius, mesh);
    FilletOptions whole = options;
    whole.band_only = false;
    const auto as_asked = [&](Result result) {
        if (options.band_only) result.mesh = changed_part(mesh, result.mesh);
        follow_fields(mesh, options.band_only, result);
        return result;
    };
    if (SevenNodes seven(mesh); seven) {
        Result result = fillet(seven.mesh(), along, radius, whole, seven.known());
        seven.finish(result);
        return as_asked(std::move(result));
    }
    const auto run = [&](const Mesh& on, const FilletOptions& with, const Prepared& known) {
        Fillet recipe(on, along, radius, with);
        return perform(recipe, on, with, known);
    };
    const auto keep = [&](Result& result) {
        if (mesh.dimension() == 3) keep_face_nodes(mesh, skin_of(mesh), result);
    };
    // An edge goes on from one part to what it touches.
    if (WeldFirst weld(mesh, prepared); weld) {
        Result result = run(weld.mesh(), whole, weld.known());
        if (weld.finish(result, options.strict)) {
            keep(result);
            return as_asked(with_order_raised(mesh, std::move(result), whole));
        }
    }
    Result result = run(mesh, options, prepared);
    if (!options.band_only) keep(result);
    result = with_order_raised(mesh, std::move(result), options);
    follow_fields(mesh, options.band_only, result);
    return result;
}

}  // namespace femscalpel
