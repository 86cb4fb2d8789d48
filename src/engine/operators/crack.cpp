// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/crack.h"

#include "operators/border.h"

namespace femscalpel {
namespace {

/// Tag of the tool's faces in the band.
constexpr int whole_tool = 0;

void snap_to_patch(Interface& f, const Blade& blade, const Patch& patch) {
    const Tool& tool = *blade.tool;
    cut_along(f, blade);
    cut_border(f, patch);
    keep_patch(f, patch);
    f.patched = true;
    f.d.barrier = &tool;
    for (int v = 0; v < f.d.band.size(); ++v) f.d.side[v] = static_cast<signed char>((f.distance[v] > 0) - (f.distance[v] < 0));
    relax_band(f);
    // Nodes beyond the front are free to leave the tool.
    for (int v = 0; v < f.d.band.size(); ++v)
        if (!f.d.contact[v] && f.distance[v] == 0) f.distance[v] = tool.distance(f.d.band.nodes[v].at);
}

}  // namespace

Result crack(const Mesh& input, const Tool& tool, const CrackOptions& options, const Prepared& prepared) {
    Operation operation("crack", input, options, prepared, {"_P", "_N", "_FRONT"});
    std::optional<Patch> patch;
    Blade blade{&tool, {}, {}, std::isfinite(tool.feature_size()) && options.method == Method::snap ? whole_tool : -1};
    if (options.within) {
        if (options.method == Method::deform) throw ToolError("method \"deform\" is for cracks along a whole tool; use \"snap\" with within");
        patch = options.within->on(tool);
        blade.bound = patch->distance;
        blade.tag = whole_tool;
    }
    Interface f = operation.begin({&blade, 1});
    if (patch) {
        snap_to_patch(f, blade, *patch);
    } else if (operation.location().crossed > 0) {
        if (options.method == Method::snap) snap_to_tool(f, blade);
        else deform_to_tool(f, tool, operation.mesh());
    }
    operation.take_laps(f.seconds);
    if (patch || operation.location().crossed > 0) check_shape(f, operation.mesh());
    const Lips lips = open_lips(f);
    if (lips.copy_of.empty())
        throw ToolError("the " + tool.kind() + " only grazes the mesh: what it would cut off is thinner than the elements there. Move the " + tool.kind() +
                        " into the material");
    find_node_sets(f);
    check_contacts(f);
    return operation.finish(f, lips, {{{options.name + "_N"}, {options.name + "_P"}}, options.name + "_FRONT", {"ICN", "ECN", "ITN", "ETN"}});
}

}  // namespace femscalpel
