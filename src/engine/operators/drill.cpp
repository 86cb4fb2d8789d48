// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/drill.h"

#include <cmath>
#include <sstream>

#include "operators/carve.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {

Result drill(const Mesh& mesh, std::span<const Tool* const> tools, const DrillOptions& options,
             const Prepared& prepared) {
    if (options.depth && !(std::isfinite(*options.depth) && *options.depth > 0)) {
        std::ostringstream message;
        message << "depth is " << *options.depth << "; it must be positive";
        throw ToolError(message.str(), "depth");
    }
    std::vector<Body> bodies;
    std::vector<std::unique_ptr<Plane>> bottoms;
    for (std::size_t k = 0; k < tools.size(); ++k) {
        Body body;
        body.walls.push_back({tools[k], {"_WALL"}});
        if (tools.size() > 1) body.walls.back().suffixes.push_back("_WALL" + std::to_string(k + 1));
        if (options.depth) {
            const auto* cylinder = dynamic_cast<const Cylinder*>(tools[k]);
            if (!cylinder)
                throw ToolError("depth is for cylinders; a " + tools[k]->kind() + " has no direction to measure it in",
                                "depth");
            bottoms.push_back(std::make_unique<Plane>(cylinder->origin() + *options.depth * cylinder->unit_axis(),
                                                      cylinder->unit_axis()));
            body.walls.push_back({bottoms.back().get(), {"_BOTTOM"}});
        }
        bodies.push_back(std::move(body));
    }
    return carve("drill", mesh, bodies, options, {"IHN", "EHN", "ITN", "ETN"}, prepared);
}

}  // namespace femscalpel
