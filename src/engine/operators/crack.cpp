// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/crack.h"

namespace femscalpel {

Result crack(const Mesh& input, const Tool& tool, const CrackOptions& options, const Prepared& prepared) {
    Operation operation("crack", input, options, prepared, {"_P", "_N", "_FRONT"});
    const Blade blade{&tool, {}, {}, -1};
    Interface f = operation.begin({&blade, 1});
    if (operation.location().crossed > 0) {
        if (options.method == Method::snap) snap_to_tool(f, tool);
        else deform_to_tool(f, tool, operation.mesh());
        operation.take_laps(f.seconds);
        check_shape(f, operation.mesh());
    }
    const Lips lips = open_lips(f);
    if (lips.copy_of.empty())
        throw ToolError("the " + tool.kind() + " only grazes the mesh: what it would cut off is thinner than the elements there. Move the " + tool.kind() +
                        " into the material");
    return operation.finish(f, lips, {{{options.name + "_N"}, {options.name + "_P"}}, options.name + "_FRONT", {"ICN", "ECN", "ITN", "ETN"}});
}

}  // namespace femscalpel
