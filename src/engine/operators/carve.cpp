// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/carve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "cancel.h"
#include "cutting/checks.h"
#include "cutting/deform.h"
#include "cutting/improve.h"
#include "cutting/no_cut.h"
#include "cutting/removal.h"
#include "cutting/retry.h"
#include "cutting/snap.h"
#include "deck/solver_sets.h"
#include "deformation/deformation.h"
#include "operators/driver.h"
#include "operators/follow_fields.h"
#include "operators/raise_order.h"
#include "tools/cylinder.h"
#include "words.h"

namespace femscalpel {
namespace {

/// Fewer than for planes: refining does not help a hole so much, as its own wall bends the elements.
constexpr int carve_attempts = 8;

/// Elements that stay may bulge so deep into a hole, in its radii.
constexpr double deepest_bulge = 0.25;

/// Part of a hole that its flat wall faces may leave standing without a warning.
constexpr double flat_walls = 0.05;

/// The surfaces of a body, each bounded by the others, in the order they are cut.
std::vector<Blade> blades_of(const Body& body, int first_tag) {
    std::vector<Blade> blades;
    for (std::size_t k = 0; k < body.walls.size(); ++k) {
        Blade blade{body.walls[k].tool, {}, {}, first_tag + static_cast<int>(k)};
        if (body.walls.size() > 1)
            blade.bound = [&body, k](const Vec3& x) {
                double depth = -std::numeric_limits<double>::infinity();
                for (std::size_t j = 0; j < body.walls.size(); ++j)
                    if (j != k) depth = std::max(depth, body.walls[j].tool->distance(x));
                return depth;
            };
        for (std::size_t j = 0; j < k; ++j) blade.inside.push_back(body.walls[j].tool);
        blades.push_back(std::move(blade));
    }
    return blades;
}

/// Around the walls, where they bound their body.
std::vector<RefineZone> zones_of(std::span<const Body> bodies, const RefineFirst& refine) {
    std::vector<RefineZone> zones;
    for (const Body& body : bodies)
        for (const Blade& blade : blades_of(body, 0))
            if (auto zone = zone_around(*blade.tool, blade.bound, refine)) zones.push_back(std::move(*zone));
    return zones;
}

/// Elements that stay must not reach deep into what was removed: then the mesh is too coarse to show the hole's shape.
void check_resolution(const Workpiece& f, std::span<const Body> bodies) {
    const BandMesh& band = f.d.band;
    for (const Body& body : bodies) {
        double radius = std::numeric_limits<double>::infinity();
        for (const Body::Wall& w : body.walls) radius = std::min(radius, w.tool->feature_size());
        if (!std::isfinite(radius)) continue;
        const auto look = [&](const auto& list) {
            SparseCheck check(64);
            for (int s = 0; s < list.size(); ++s) {
                check();
                if (!list.alive(s)) continue;
                Vec3 middle = Vec3::Zero();
                double longest = 0;
                for (const int v : list[s]) {
                    middle += band.nodes[v].at / static_cast<double>(list[s].size());
                    for (const int w : list[s])
                        longest = std::max(longest, (band.nodes[v].at - band.nodes[w].at).squaredNorm());
                }
                // No deeper than the chords of the wall are, either: what is deeper was to be removed.
                if (body.depth(middle) >= -std::min(deepest_bulge * radius, longest / (8 * radius))) continue;
                std::ostringstream message;
                const double edge = std::sqrt(longest);
                message << "the mesh is too coarse for the " << body.walls.front().tool->kind() << " of radius "
                        << radius << " near (" << middle.transpose() << "): an element with edges of " << edge
                        << " would reach deep into it. Refine the mesh there first, to edges of at most "
                        << std::min(radius, edge / 2);
                if (edge <= radius)
                    message << ", or move the tool: it may nearly touch a border or the skin there, and leave only a "
                               "thin layer of material";
                throw ToolError(message.str());
            }
        };
        look(band.tetras);
        look(band.triangles);
    }
}

/// Warns where the flat faces of a cylinder's wall, whose nodes lie on it, leave much of the hole standing.
void warn_of_flat_walls(Workpiece& f, const Opening& walls, std::span<const Tool* const> tool_of_tag) {
    for (std::size_t tag = 0; tag < tool_of_tag.size(); ++tag) {
        const Tool& tool = *tool_of_tag[tag];
        if (!dynamic_cast<const Cylinder*>(&tool)) continue;
        const double radius = tool.feature_size();
        double measure = 0,
               left = 0;  // of the wall; what is between it and the cylinder, where distances grow as squares
        const auto add = [&](double size, double mean_distance) {
            measure += size;
            left -= size * mean_distance;
        };
        const auto at = [&](int v) { return f.d.band.nodes[v].at; };
        const auto middle = [&](int v, int w) { return tool.distance((at(v) + at(w)) / 2); };
        for (const auto& [n, group, element, second_order] : walls.faces)
            if (group == static_cast<int>(tag) && !second_order)
                add((at(n[1]) - at(n[0])).cross(at(n[2]) - at(n[0])).norm() / 2,
                    (middle(n[0], n[1]) + middle(n[1], n[2]) + middle(n[2], n[0])) / 3);
        for (const auto& [n, group, element, second_order] : walls.edges)
            if (group == static_cast<int>(tag) && !second_order)
                add((at(n[1]) - at(n[0])).norm(), middle(n[0], n[1]) * 2 / 3);
        const double part = measure > 0 ? 2 * left / (radius * measure) : 0;
        if (part <= flat_walls) continue;
        std::ostringstream message;
        message << "the mesh is coarse for the " << tool.kind() << " of radius " << radius
                << ": the flat faces of the wall leave about " << std::lround(100 * part)
                << " % of the hole standing. Refine the mesh there first, to edges of at most " << radius / 2;
        f.warnings.push_back(message.str());
    }
}

Index solid_count(const Mesh& mesh) {
    Index count = 0;
    for (const CellBlock& b : mesh.blocks())
        if (traits(b.type).dimension == mesh.dimension()) count += b.size();
    return count;
}

/// The bodies without walls that the whole mesh lies behind, such as the bottom of a hole that is deeper than the part:
/// these bound nothing. Throws ToolError when a body has no other walls.
std::vector<Body> without_idle_walls(const Mesh& mesh, std::span<const Body> bodies,
                                     std::vector<std::string>& warnings) {
    std::vector<Body> out(bodies.begin(), bodies.end());
    for (Body& body : out) {
        const Body all = body;
        check_cancelled();
        std::erase_if(body.walls, [&](const Body::Wall& w) {
            return std::ranges::all_of(mesh.points, [&](const Vec3& x) { return w.tool->distance(x) <= 0; });
        });
        if (body.walls.empty())
            throw ToolError("the " + all.walls.front().tool->kind() +
                            " would remove the whole mesh: all of it lies inside. Make the tool smaller, or move it");
        for (const Body::Wall& w : all.walls)
            if (std::ranges::none_of(body.walls, [&](const Body::Wall& left) { return left.tool == w.tool; }))
                warnings.push_back("the wall " + w.suffixes.front().substr(1) + " (" + w.tool->kind() +
                                   ") lies beyond the part: what is removed reaches right through there");
    }
    return out;
}

/// Whether a body with several walls passes through the material, however thin it is: there are nodes behind each wall.
bool is_inside(const Workpiece& f, const Body& body) {
    return body.walls.size() > 1 && std::ranges::all_of(body.walls, [&](const Body::Wall& w) {
               return std::ranges::any_of(
                   f.d.band.nodes, [&](const auto& node) { return w.tool->distance(node.at) < -10 * f.tolerance; });
           });
}

/// Whether the band has elements left.
bool has_elements(const BandMesh& band) {
    const auto any = [](const auto& list) {
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s)) return true;
        return false;
    };
    return any(band.tetras) || any(band.triangles) || any(band.lines);
}

class Carve final : public Recipe {
public:
    Carve(const char* kind, std::span<const Body> bodies, const OperatorOptions& options,
          const std::array<const char*, 4>& sets)
        : kind_(kind), all_(bodies.begin(), bodies.end()), options_(options), sets_(sets) {}

    const char* kind() const override { return kind_; }

    void start(const Mesh& mesh) override {
        warnings_.clear();
        bodies_ = without_idle_walls(mesh, all_, warnings_);
        blades_.clear();
        for (const Body& body : bodies_)
            std::ranges::move(blades_of(body, static_cast<int>(blades_.size())), std::back_inserter(blades_));
        if (blades_.empty()) throw ToolError("there is no tool: give at least one", "tools");
        if (options_.method == Method::deform && blades_.size() > 1)
            throw ToolError(
                "method \"deform\" works with a single surface; use method \"snap\" for holes with a bottom, cuts and "
                "several holes",
                "method");
    }

    std::vector<RefineZone> zones() const override { return zones_of(all_, options_.refine); }
    std::span<const Blade> blades() const override { return blades_; }

    bool cuts_beams() const override { return true; }

    Naming naming() const override {
        Naming out;
        out.sets = sets_;
        for (const Body& body : bodies_)
            for (const Body::Wall& wall : body.walls) {
                out.groups.emplace_back();
                for (const std::string& suffix : wall.suffixes) out.groups.back().push_back(options_.name + suffix);
            }
        return out;
    }

    std::vector<CellRef> removed(const Mesh& whole, const std::vector<std::int8_t>& level) const override {
        std::vector<std::function<double(const Vec3&)>> depths;
        depths.reserve(bodies_.size());
        for (const Body& body : bodies_) depths.push_back([&body](const Vec3& x) { return body.depth(x); });
        return deep_inside(whole, level, depths);
    }

    bool cut(Workpiece& f, const Site& site) override {
        f.warnings.insert(f.warnings.end(), warnings_.begin(), warnings_.end());
        warn_of_springs(f, site.mesh);
        if (options_.method == Method::snap)
            cut_soundly(
                f, [&](Workpiece& g) { carve_once(g, site); }, site.whole.cell_count(), carve_attempts);
        else
            carve_once(f, site);
        return true;
    }

    Opening open(Workpiece& f, const Site& site) override {
        check_resolution(f, bodies_);
        check_shape(f, site.mesh);
        find_node_sets(f);
        check_contacts(f);
        Opening walls = open_walls(f);
        warn_of_flat_walls(f, walls, tools());
        warn_of_empty_walls(f, walls);
        note_slivers(f, tools(), -1);
        return walls;
    }

private:
    /// By tag.
    std::vector<const Tool*> tools() const {
        std::vector<const Tool*> out;
        out.reserve(blades_.size());
        for (const Blade& blade : blades_) out.push_back(blade.tool);
        return out;
    }

    /// Of those that go because one end does.
    static void warn_of_springs(Workpiece& f, const Mesh& mesh) {
        const std::vector<char> whole = families_of_whole_elements(mesh);
        const auto count = std::ranges::count_if(f.deep_inside, [&](const CellRef& c) {
            return traits(c.type).dimension == 1 && !whole.empty() && whole[mesh.block(c.type).families[c.cell]];
        });
        if (count > 0)
            f.warnings.push_back(counted(count, "spring, dashpot or gap ends", "springs, dashpots or gaps end") +
                                 " inside what is removed, and " + (count == 1 ? "is" : "are") + " removed with it");
    }

    void warn_of_empty_walls(Workpiece& f, const Opening& walls) const {
        std::vector<bool> used(blades_.size(), false);
        for (const auto& face : walls.faces) used[static_cast<std::size_t>(face.group)] = true;
        for (const auto& edge : walls.edges) used[static_cast<std::size_t>(edge.group)] = true;
        for (const auto& end : walls.ends) used[static_cast<std::size_t>(end.group)] = true;
        std::size_t tag = 0;
        for (const Body& body : bodies_)
            for (const Body::Wall& wall : body.walls)
                if (!used[tag++])
                    f.warnings.push_back("nothing is left of the wall " + options_.name + wall.suffixes.back() + " (" +
                                         wall.tool->kind() +
                                         "): where it would be, other tools take the material, or there is none; its "
                                         "group has no members from it");
    }

    void carve_once(Workpiece& f, const Site& site) const {
        Index removed = static_cast<Index>(f.deep_inside.size());
        auto blade = blades_.begin();
        for (const Body& body : bodies_) {
            std::vector<const Tool*> walls;
            const int first_tag = blade->tag;
            for (std::size_t w = 0; w < body.walls.size(); ++w, ++blade) {
                walls.push_back(blade->tool);
                if (options_.method == Method::deform)
                    deform_to_tool(f, *blade->tool, site.mesh);
                else
                    cut_along(f, *blade);
            }
            removed += remove_inside(f, walls, first_tag);
        }
        check_removed(f, removed, site);
        release_all_but_walls(f, tools());
        note_slivers(f, tools(), 1);
        if (options_.method == Method::snap) relax_band(f);
    }

    void check_removed(const Workpiece& f, Index removed, const Site& site) const {
        const std::string tool = "the " + blades_.front().tool->kind();
        if (removed == 0) fail_to_remove(f, site);
        if (!has_elements(f.d.band) && removed >= solid_count(site.whole))
            throw ToolError(tool +
                            " would remove the whole mesh: all of it lies inside. Make the tool smaller, or move it");
    }

    [[noreturn]] void fail_to_remove(const Workpiece& f, const Site& site) const {
        const Body& body = bodies_.front();
        const std::string tool = "the " + body.walls.front().tool->kind();
        const bool in_material = site.crossed > 0 || is_inside(f, body);
        if (body.width && in_material) {
            std::ostringstream message;
            message << "a slot of width " << *body.width
                    << " removes nothing: it is narrower than what the elements there can show. Make it wider, or "
                       "refine the mesh there first";
            throw ToolError(message.str(), "width");
        }
        const std::string move = "move " + tool + " into the material";
        if (in_material && !is_smaller_than_elements(f, *body.walls.front().tool))
            throw ToolError(tool +
                            " removes nothing: what it would take off is thinner than the elements there. Refine the "
                            "mesh there, or " +
                            move);
        if (is_smaller_than_elements(f, *body.walls.front().tool))
            throw ToolError(tool +
                            " removes nothing: it is smaller than the elements there, and none lies inside. Refine "
                            "the mesh there first, or " +
                            move);
        throw ToolError(tool + " removes nothing: it touches the mesh from outside, and no element lies inside. M" +
                        move.substr(1));
    }

    const char* kind_;
    std::vector<Body> all_, bodies_;  // as given; without walls that bound nothing
    const OperatorOptions& options_;
    std::array<const char*, 4> sets_;
    std::vector<Blade> blades_;  // of bodies_
    std::vector<std::string> warnings_;
};

}  // namespace

double Body::depth(const Vec3& x) const {
    double depth = -std::numeric_limits<double>::infinity();
    for (const Wall& w : walls) depth = std::max(depth, w.tool->distance(x));
    return depth;
}

Result carve(const char* kind, const Mesh& input, std::span<const Body> bodies, const OperatorOptions& options,
             const std::array<const char*, 4>& sets, const Prepared& prepared) {
    Carve recipe(kind, bodies, options, sets);
    Result result = with_order_raised(input, perform(recipe, input, options, prepared), options);
    follow_fields(input, options.band_only, result);
    return result;
}

}  // namespace femscalpel
