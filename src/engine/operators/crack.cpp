// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/crack.h"

#include <sstream>

namespace femscalpel {

/// A face whose border lies this far inside the skin, in edge lengths, still counts as cutting through: the skin is faceted.
constexpr double outside = 0.05;

Result crack(const Mesh& input, const Tool& tool, const CrackOptions& options, const Prepared& prepared) {
    Operation operation("crack", input, options, prepared, {"_P", "_N", "_FRONT"});
    Blade blade;
    blade.tool = &tool;
    if (tool.bounded()) blade.bound = [&tool](const Vec3& x) { return tool.beyond(x); };
    if (tool.bounded() && options.method == Method::deform)
        throw ToolError("method \"deform\" works with surfaces without a border; use method \"snap\" for a " + tool.kind());
    Interface f = operation.begin({&blade, 1});
    if (operation.location().crossed > 0) {
        if (tool.bounded()) {
            cut_along(f, blade);
            relax_band(f);
        } else if (options.method == Method::snap) snap_to_tool(f, tool);
        else deform_to_tool(f, tool, operation.mesh());
        operation.take_laps(f.seconds);
        check_shape(f, operation.mesh());
    }
    const Lips lips = open_lips(f);
    if (lips.copy_of.empty())
        throw ToolError("the " + tool.kind() + " only grazes the mesh: what it would cut off is thinner than the elements there. Move the " + tool.kind() +
                        " into the material");
    if (tool.bounded())
        for (const int v : lips.interface_nodes)
            if (const Vec3& x = f.d.band.nodes[v].at; tool.beyond(x) > outside * f.d.band.mean_edge_length(v)) {
                std::ostringstream message;
                message << "the " << tool.kind() << " ends inside the material, near (" << x.transpose() << "); it must cut right through. Make it larger";
                throw ToolError(message.str());
            }
    return operation.finish(f, lips, {{{options.name + "_N"}, {options.name + "_P"}}, options.name + "_FRONT", {"ICN", "ECN", "ITN", "ETN"}});
}

}  // namespace femscalpel
