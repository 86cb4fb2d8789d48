// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cutting/locate.h"
#include "cutting/opening.h"
#include "cutting/workpiece.h"
#include "operators/edit.h"
#include "operators/options.h"
#include "operators/refine_first.h"
#include "operators/report.h"

namespace femscalpel {

/// Where a recipe works.
struct Site {
    const Mesh& mesh;   ///< which the workpiece is the band of
    const Mesh& whole;  ///< the same, even where only the band is worked on
    Index crossed;      ///< elements that the blades cross
    /// Refines the mesh around zones that a recipe found only now; then the recipe has to begin anew. False if the mesh
    /// is fine enough there, or was refined before.
    std::function<bool(std::span<const RefineZone>)> refine;
};

/// What makes an operator: along which surfaces element faces are to be made, how, what is then opened or removed, and
/// how it is called. All else is the driver's, perform().
class Recipe {
public:
    virtual ~Recipe() = default;

    /// "crack", "drill", ...: the operation's name in the report.
    virtual const char* kind() const = 0;

    /// Begins (anew) on `mesh`. Throws ToolError when the tools and options do not go together, or with the mesh.
    virtual void start(const Mesh& mesh) = 0;

    /// Around what the mesh has to be fine; known after start().
    virtual std::vector<RefineZone> zones() const = 0;

    /// The surfaces; known after start(), and at least one.
    virtual std::span<const Blade> blades() const = 0;

    /// Further surfaces that are not cut along, but whose elements are to be in the band; known after start().
    virtual std::span<const Blade> surroundings() const { return {}; }

    /// Whether beams that a blade passes through are divided there first.
    virtual bool cuts_beams() const { return false; }

    /// How what is made is called; known after start().
    virtual Naming naming() const = 0;

    /// Elements of `whole` with no node in the band (level < 0) that are to be removed.
    virtual std::vector<CellRef> removed(const Mesh& whole, const std::vector<std::int8_t>& level) const {
        (void)whole, (void)level;
        return {};
    }

    /// Makes the faces. False when the site was refined: the driver then begins anew.
    virtual bool cut(Workpiece& f, const Site& site) = 0;

    /// Opens or removes what was cut. Throws QualityError or ToolError when that is not what was asked for.
    virtual Opening open(Workpiece& f, const Site& site) = 0;

    /// With the band put back: where its nodes are in the result.
    virtual void finished(const Rebuilt& rebuilt) { (void)rebuilt; }
};

/// Throws ToolError when `transition` or `feature_angle` is out of range.
void check_options(const OperatorOptions& options);

/// Throws ToolError when a part of groups' names, given as that parameter, has characters that solvers do not accept.
void check_characters(const std::string& name, const char* parameter);

/// Throws ToolError that names `name` when an operator could not call its groups so.
void check_name(const Mesh& mesh, const std::string& name, const Naming& naming);

/// Runs a recipe on a mesh (resources/docs/architecture.md): refines the mesh first where it is coarser than the tools,
/// finds the band and what its nodes have to keep to, has the recipe cut and open it, puts the band back, carries the
/// solver's input over, and reports. `known` is what is known of `input`. Throws what the steps throw.
Result perform(Recipe& recipe, const Mesh& input, const OperatorOptions& options, const Prepared& known);

}  // namespace femscalpel
