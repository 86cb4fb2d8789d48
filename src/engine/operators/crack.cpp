// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/crack.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "cancel.h"
#include "cutting/border.h"
#include "cutting/checks.h"
#include "cutting/deform.h"
#include "cutting/improve.h"
#include "cutting/no_cut.h"
#include "cutting/retry.h"
#include "cutting/snap.h"
#include "deformation/deformation.h"
#include "deformation/relaxation.h"
#include "operators/crack_faces.h"
#include "operators/driver.h"
#include "operators/follow_fields.h"
#include "operators/raise_order.h"
#include "tools/face.h"

namespace femscalpel {
namespace {

/// A face whose border lies this far inside the skin, in edge lengths, still counts as reaching it: the skin is
/// faceted.
constexpr double outside = 0.05;

/// Mean edge length at a node of the crack, in radii of curvature of the tool, from which the mesh counts as coarse.
constexpr double coarse = 0.75;

/// Tag of the tool's faces in the band.
constexpr int whole_tool = 0;

void snap_to_patch(Workpiece& f, const Blade& blade, const Patch& patch) {
    const Tool& tool = *blade.tool;
    cut_along(f, blade);
    cut_border(f, patch);
    keep_patch(f, patch);
    f.patched = true;
    f.d.barrier = &tool;
    for (int v = 0; v < f.d.band.size(); ++v)
        f.d.side[v] = static_cast<signed char>((f.distance[v] > 0) - (f.distance[v] < 0));
    relax_band(f);
    if (part_closed_faces(f, patch)) {  // which improving elements may close again
        find_node_sets(f);
        relax(f.d, movable_nodes(f));
    }
    // Nodes beyond the front are free to leave the tool.
    for (int v = 0; v < f.d.band.size(); ++v)
        if (!f.d.contact[v] && f.distance[v] == 0) f.distance[v] = tool.distance(f.d.band.nodes[v].at);
}

/// The chains of a face's border that lie inside the material: nodes of the opened surface are beyond them.
std::vector<int> inner_border(const Workpiece& f, const Opening& opening) {
    const auto* face = dynamic_cast<const Face*>(f.tool);
    std::vector<int> out;
    if (!face) return out;
    for (const int v : opening.interface_nodes) {
        const Vec3& x = f.d.band.nodes[v].at;
        const double clearance = outside * f.d.band.mean_edge_length(v);
        if (face->beyond(x) <= clearance) continue;
        const std::vector<int> chains = face->chains_before(x, clearance);
        out.insert(out.end(), chains.begin(), chains.end());
    }
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// All nodes of the lips must have been brought onto the tool, and into the patch if there is one.
void check_lips(const Workpiece& f, const Opening& opening, const Patch* patch) {
    for (const int v : opening.interface_nodes) {
        const Vec3& x = f.d.band.nodes[v].at;
        const double held = f.d.held_off[v], off = std::abs(f.tool->distance(x)) - held,
                     beyond = patch ? patch->distance(x) - held : 0;
        if (off <= 10 * f.tolerance && beyond <= 100 * f.tolerance) continue;
        std::ostringstream message;
        message << "a node of the crack near (" << x.transpose() << ") cannot be brought ";
        if (off > 10 * f.tolerance)
            message << "onto the " << f.tool->kind() << ": it stays off by " << off;
        else
            message << "to the front: it stays " << beyond << " beyond it";
        message << ". The mesh is too coarse there: refine it near the crack first";
        throw QualityError(message.str());
    }
}

/// Exactly the faces of a bounded crack must have come apart, each lip must have them all, and the front must be their
/// whole border inside the material and lie on the patch's.
void check_opening(const Workpiece& f, const Opening& opening, const Patch& patch) {
    const BandMesh& band = f.d.band;
    const auto fail = [&](int v) {
        std::ostringstream message;
        message << "the crack cannot be opened cleanly near (" << band.nodes[v].at.transpose()
                << "): the mesh is too coarse for its front there. Refine it near the front, "
                << "or move the crack a little";
        throw QualityError(message.str());
    };
    using Key = std::array<int, 3>;
    const auto sorted = [](Key k) {
        std::ranges::sort(k);
        return k;
    };
    constexpr int corners[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    std::set<int> near;
    for (const int v : opening.interface_nodes) near.insert(band.tetras.around(v).begin(), band.tetras.around(v).end());
    std::map<Key, std::vector<Key>> faces;  // as they are now, by what they were
    for (const int t : near)
        for (const auto& c : corners) {
            const auto &was = band.tetras[t],
                       &is = static_cast<std::size_t>(t) < opening.tetras.size() ? opening.tetras[t] : was;
            faces[sorted({was[c[0]], was[c[1]], was[c[2]]})].push_back(sorted({is[c[0]], is[c[1]], is[c[2]]}));
        }
    std::multiset<Key> opened, listed;
    for (const auto& [key, sides] : faces) {
        if (sides.size() != 2) continue;
        const bool open = sides[0] != sides[1];
        if (open != (band.cut_faces.find(key) >= 0)) fail(key[0]);
        if (open) opened.insert(sides.begin(), sides.end());
    }
    for (const auto& face : opening.faces) listed.insert(sorted(face.nodes));
    if (opened != listed) fail(opening.interface_nodes.front());
    // The edges that only one face of a lip has, and both lips: neither of their ends is doubled.
    const std::set<int> doubled(opening.copy_of.begin(), opening.copy_of.end());
    std::map<std::array<int, 2>, int> edges;
    for (const auto& face : opening.faces)
        for (int k = 0; face.group == 1 && k < 3; ++k) {
            const auto [low, high] = std::minmax(face.nodes[k], face.nodes[(k + 1) % 3]);
            if (high < band.size() && !doubled.contains(low) && !doubled.contains(high)) ++edges[{low, high}];
        }
    std::set<std::array<int, 2>> border, front;
    for (const auto& [edge, count] : edges)
        if (count == 1) border.insert(edge);
    for (const auto& chain : opening.front_chains)
        for (std::size_t k = 1; k < chain.size(); ++k) {
            front.insert({std::min(chain[k - 1], chain[k]), std::max(chain[k - 1], chain[k])});
            for (const int v : {chain[k - 1], chain[k]})
                if (std::abs(patch.distance(band.nodes[v].at)) > 100 * f.tolerance + f.d.held_off[v]) fail(v);
        }
    if (border != front)
        fail(opening.front_nodes.empty() ? opening.interface_nodes.front() : opening.front_nodes.front());
}

/// Faces of elements that are long against a tool's curvature cut its corners off, or miss parts of it.
void warn_of_coarse_mesh(Workpiece& f, const Opening& opening) {
    const double radius = f.tool->feature_size();
    if (!std::isfinite(radius)) return;
    double longest = 0;
    for (const int v : opening.interface_nodes) longest = std::max(longest, f.d.band.mean_edge_length(v));
    if (longest <= coarse * radius) return;
    std::ostringstream message;
    message << "the mesh is coarse for the " << f.tool->kind() << ": edges of " << longest
            << " against a radius of curvature of " << radius
            << "; the crack is flatter and smaller than the tool. Refine the mesh there first, to edges of at most "
            << radius / 2;
    f.warnings.push_back(message.str());
}

/// Why a crack doubles no node, as a message.
std::string why_no_lips(const Workpiece& f, const Opening& opening, const Blade& blade, bool crossed) {
    const std::string tool = "the " + f.tool->kind();
    if (!opening.faces.empty() || !opening.edges.empty())
        return "the crack along " + tool + " cannot open: all its nodes are on its front. Refine the mesh there first";
    if (!crossed)
        return why_nothing_parts(f, blade,
                                 tool +
                                     " only touches the mesh, along edges or in single nodes: it passes through no "
                                     "element and along no face. Move " +
                                     tool + " into the material");
    if (is_smaller_than_elements(f, *blade.tool)) return why_too_small(*blade.tool);
    return tool + " only grazes the mesh: what it would cut off is thinner than the elements there. Move " + tool +
           " into the material";
}

class Crack final : public Recipe {
public:
    Crack(const Tool& tool, const CrackOptions& options) : tool_(tool), options_(options) {
        const bool deform = options.method == Method::deform;
        if (tool.bounded() && deform)
            throw ToolError(
                "method \"deform\" works with surfaces without a border; use method \"snap\" for a " + tool.kind(),
                "method");
        if (options.within && deform)
            throw ToolError("method \"deform\" is for cracks along a whole tool; use \"snap\" with within", "method");
    }

    const char* kind() const override { return "crack"; }

    void start(const Mesh&) override {
        patch_.reset();
        opening_.reset();
        blade_ = {};
        blade_.tool = &tool_;
        if (options_.method == Method::snap && std::isfinite(tool_.feature_size())) blade_.tag = whole_tool;
        if (tool_.bounded()) blade_.bound = [&tool = tool_](const Vec3& x) { return tool.beyond(x); };
        if (options_.within) keep_within(options_.within->on(tool_));
    }

    std::vector<RefineZone> zones() const override {
        auto zone =
            patch_ ? zone_around(tool_, *patch_, options_.refine) : zone_around(tool_, blade_.bound, options_.refine);
        if (!zone) return {};
        return {std::move(*zone)};
    }

    std::span<const Blade> blades() const override { return {&blade_, 1}; }

    bool cuts_beams() const override { return true; }

    Naming naming() const override {
        return {.groups = {{options_.name + "_N"}, {options_.name + "_P"}}, .front = options_.name + "_FRONT"};
    }

    bool cut(Workpiece& f, const Site& site) override {
        if (patch_)
            cut_within_patch(f, site);
        else if (tool_.bounded())
            return cut_as_far_as_it_goes(f, site);
        else if (site.crossed == 0)
            return true;
        else if (options_.method == Method::snap)
            snap_to_tool(f, blade_, site.whole.cell_count());
        else
            deform_to_tool(f, tool_, site.mesh);
        check_cancelled();
        return true;
    }

    Opening open(Workpiece& f, const Site& site) override {
        if (patch_ || site.crossed > 0) check_shape(f, site.mesh);
        Opening opening = opening_ ? std::move(*opening_) : open_lips(f);
        if (opening.copy_of.empty()) throw ToolError(why_no_lips(f, opening, blade_, site.crossed > 0));
        find_node_sets(f);
        check_contacts(f);
        check_lips(f, opening, patch_ ? &*patch_ : nullptr);
        if (patch_ && !opening.faces.empty()) check_opening(f, opening, *patch_);
        warn_of_coarse_mesh(f, opening);
        return opening;
    }

private:
    void keep_within(Patch patch) {
        patch_ = std::move(patch);
        blade_.bound = patch_->distance;
        blade_.tag = whole_tool;
    }

    void cut_within_patch(Workpiece& f, const Site& site) {
        cut_soundly(
            f, [&](Workpiece& g) { snap_to_patch(g, blade_, *patch_); }, site.whole.cell_count());
    }

    /// A tool that ends inside the material cracks it as far as it goes; whether it does shows when it has been cut
    /// along.
    bool cut_as_far_as_it_goes(Workpiece& f, const Site& site) {
        if (site.crossed == 0) return true;
        Workpiece start = f;
        cut_along(f, blade_);
        relax_band(f);
        check_cancelled();
        opening_ = open_lips(f);
        const std::vector<int> inner = inner_border(f, *opening_);
        if (inner.empty()) return true;
        opening_.reset();
        keep_within(dynamic_cast<const Face&>(tool_).within(inner));
        if (site.refine(zones())) return false;
        f = std::move(start);
        cut_within_patch(f, site);
        return true;
    }

    const Tool& tool_;
    const CrackOptions& options_;
    Blade blade_;
    std::optional<Patch> patch_;
    std::optional<Opening> opening_;  // where it had to be known before open()
};

}  // namespace

Result crack(const Mesh& input, const Tool& tool, const CrackOptions& options, const Prepared& prepared) {
    if (!options.within)
        if (auto between = crack_between_elements(input, tool, options, prepared)) {
            follow_fields(input, options.band_only, *between);
            return std::move(*between);
        }
    Crack recipe(tool, options);
    Result result = with_order_raised(input, perform(recipe, input, options, prepared), options);
    follow_fields(input, options.band_only, result);
    return result;
}

}  // namespace femscalpel
