// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/driver.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "cancel.h"
#include "cutting/checks.h"
#include "cutting/folded_input.h"
#include "cutting/snap.h"
#include "groups/preserve.h"
#include "mesh/crop.h"
#include "mesh/stopwatch.h"
#include "operators/account.h"
#include "operators/cut_beams_first.h"
#include "operators/seven_nodes.h"
#include "operators/simplify_first.h"
#include "operators/weld_first.h"

namespace femscalpel {
namespace {

/// Code_Aster's limit for group names.
constexpr std::size_t longest_name = 24;

/// The surfaces around which the band is.
std::vector<Blade> around(const Recipe& recipe) {
    std::vector<Blade> blades(recipe.blades().begin(), recipe.blades().end());
    blades.insert(blades.end(), recipe.surroundings().begin(), recipe.surroundings().end());
    return blades;
}

/// Band, node constraints and contacts around the blades of a recipe.
class Ground {
public:
    Ground(const OperatorOptions& options, Edit& edit, const Prepared& known, const Refined* refined,
           const std::vector<bool>& drifting)
        : options_(options), edit_(edit), known_(known), refined_(refined), drifting_(drifting) {}

    /// Finds the band of the recipe's blades. With the option band_only, `edit` goes on with that alone.
    void find_band(const Recipe& recipe) {
        const std::vector<Blade> blades = around(recipe);
        location_ = locate(edit_.mesh(), blades, width_, edit_.adjacency(), known_.beam_stops);
        if (!options_.transition && options_.method == Method::deform) {
            width_ = bandwidth(location_, edit_.mesh());
            if (width_ > 2) location_ = locate(edit_.mesh(), blades, width_, edit_.adjacency(), known_.beam_stops);
        }
        removed_ = recipe.removed(edit_.whole(), location_.level);
        if (options_.band_only) edit_.keep_band(location_, removed_);
    }

    Index crossed() const { return location_.crossed; }

    /// The band, and what its nodes have to keep to. Nodes on the first blade, where it is unbounded, are in contact
    /// with it. Throws as extract_band() and check_input_shape() do.
    Workpiece workpiece(std::span<const Blade> blades) {
        const Mesh& mesh = edit_.mesh();
        const Tool& first = *blades.front().tool;
        Workpiece f{.d = Deformable(extract_band(mesh, location_.level, edit_.adjacency()), mesh, constraints()),
                    .tool = &first,
                    .tolerance = location_.tolerance,
                    .bandwidth = width_};
        f.deep_inside = std::move(removed_);
        f.distance.resize(static_cast<std::size_t>(f.d.band.size()));
        check_cancelled();
        for (int v = 0; v < f.d.band.size(); ++v) {
            f.distance[v] = location_.distance[f.d.band.nodes[v].global];
            if (std::abs(f.distance[v]) > location_.rounding) continue;
            if (!blades.front().bound) put_on_tool(f, v, first);
            f.distance[v] = 0;
        }
        find_beam_nodes(f, blades.front());
        check_input_shape(f, mesh);
        check_skin(f);
        return f;
    }

private:
    void find_beam_nodes(Workpiece& f, const Blade& blade) const {
        const BandMesh& band = f.d.band;
        for (int v = 0; v < band.size(); ++v)
            if ((std::ranges::binary_search(location_.stops, band.nodes[v].global) ||
                 (f.distance[v] == 0 && (!blade.bound || blade.bound(band.nodes[v].at) <= location_.rounding))) &&
                std::ranges::any_of(band.lines.around(v), [&](int l) { return f.d.constraints.is_beam(l); }))
                f.beam_nodes.push_back(v);
    }

    ConstraintOptions constraints() const {
        ConstraintOptions out = edit_.constraints();
        out.feature_angle = options_.feature_angle;
        out.drifting_groups = drifting_;
        if (refined_) out.on_shortcuts = refined_->trace.on_shortcuts;
        out.shape = options_.skin;
        out.tolerance = location_.tolerance;
        out.rounding = location_.rounding > location_.tolerance ? location_.rounding : 0;
        return out;
    }

    const OperatorOptions& options_;
    Edit& edit_;
    const Prepared& known_;
    const Refined* refined_;
    const std::vector<bool>& drifting_;
    int width_ = options_.transition.value_or(2);
    Location location_;
    std::vector<CellRef> removed_;
};

/// Runs a recipe on the mesh as it is. Nothing when the recipe had it refined meanwhile.
std::optional<Result> attempt(Recipe& recipe, const Mesh& mesh, const OperatorOptions& options, const Prepared& known,
                              const Refined* refined, Stopwatch::Time started,
                              const std::function<bool(std::span<const RefineZone>)>& refine) {
    Laps seconds;
    if (refined && refined->converting > 0) seconds.add("convert", refined->converting);
    if (refined && refined->seconds > 0) seconds.add("refine", refined->seconds);
    Stopwatch watch(seconds, started);
    watch.lap("locate");
    Edit edit(mesh, known);
    if (mesh.companion) watch.lap("mark deck");
    const std::vector<bool> drifting = drifting_groups(edit.mesh(), options.preserve);
    edit.start_copy(!options.band_only);
    Ground ground(options, edit, known, refined, drifting);
    ground.find_band(recipe);
    watch.lap("locate");
    const std::span<const Blade> blades = recipe.blades();
    Workpiece f = ground.workpiece(blades);
    Account account(recipe.kind(), options, edit, refined, drifting);
    account.open(f);
    for (const Blade& b : blades) split_at_fixed_middles(f, b, edit.mesh());
    watch.lap("constraints");
    const Site site{edit.mesh(), edit.whole(), ground.crossed(), refine};
    if (!recipe.cut(f, site)) return {};
    watch.lap("check", f.seconds);
    const Opening opening = recipe.open(f, site);
    account.judge(f, blades, opening);
    watch.lap("open");
    const Naming naming = recipe.naming();
    Edited edited = edit.finish(f, opening, naming, watch);
    Result result{{}, account.close(f, blades, opening, naming, edited)};
    recipe.finished(edited.rebuilt);
    result.mesh = std::move(edited.rebuilt.mesh);
    if (known.stages) {
        if (refined) known.stages->push_back(refined->trace.changes);
        known.stages->push_back(std::move(edited.rebuilt.changes));
    } else {
        result.stages.push_back(std::move(edited.rebuilt.changes));
        remove_marks(result.mesh);
    }
    watch.lap("report");
    result.report.seconds = seconds.list();
    return result;
}

}  // namespace

void check_options(const OperatorOptions& options) {
    if (options.transition && (*options.transition < 1 || *options.transition > 20))
        throw ToolError("transition is " + std::to_string(*options.transition) + "; it must be between 1 and 20",
                        "transition");
    if (!(options.feature_angle > 0 && options.feature_angle < 180))
        throw ToolError("feature_angle must lie between 0 and 180 degrees", "feature_angle");
}

void check_characters(const std::string& name, const char* parameter) {
    if (name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.") !=
        std::string::npos)
        throw ToolError(
            std::string(parameter) + " '" + name +
                "' has a character other than letters, digits, '_', '-' and '.'; solvers would not accept its groups",
            parameter);
}

void check_name(const Mesh& mesh, const std::string& name, const Naming& naming) {
    if (name.empty()) throw ToolError("name is empty; the new groups need one", "name");
    check_characters(name, "name");
    std::set<std::string> groups;
    for (const auto& list : naming.groups) groups.insert(list.begin(), list.end());
    if (!naming.front.empty()) groups.insert(naming.front);
    for (const std::string& group : groups) {
        if (group.size() > longest_name)
            throw ToolError("name '" + name + "' is too long: group '" + group + "' would have " +
                                std::to_string(group.size()) + " characters, at most " + std::to_string(longest_name) +
                                " are allowed",
                            "name");
        if (mesh.find_group(group))
            throw ToolError(
                "name '" + name + "' is taken: the mesh already has a group '" + group + "'; choose another", "name");
    }
}

namespace {

/// On a mesh whose double nodes near the tool, if any, are single.
Result perform_on(Recipe& recipe, const Mesh& input, const OperatorOptions& options, const Prepared& known,
                  Stopwatch::Time started) {
    const auto renewed = [&](const Mesh& mesh) { return known.renewed ? known.renewed(mesh) : Prepared{}; };
    std::optional<Refined> converted, refined;
    std::vector<Index> stops;
    if (recipe.cuts_beams())
        if (auto beams = cut_beams_first(input, recipe.blades(), known)) {
            converted = std::move(beams->divided);
            stops = std::move(beams->stops);
        }
    if (converted) recipe.start(converted->mesh);
    const auto known_of = [&](const Refined* first) {
        Prepared out = first ? renewed(first->mesh) : known;
        out.beam_stops = stops;
        return out;
    };
    if (auto simplices = simplify_first(converted ? converted->mesh : input, around(recipe), recipe.zones(), options,
                                        known_of(converted ? &*converted : nullptr)))
        converted = converted ? joined(*converted, std::move(*simplices), options.strict) : std::move(*simplices);
    if (converted) {
        converted->converting = Stopwatch::since(started);
        started = Stopwatch::now();
        recipe.start(converted->mesh);
    }
    bool tried = false;
    const auto refine = [&](std::span<const RefineZone> zones) {
        if (tried) return false;
        refined = refine_first(converted ? converted->mesh : input, zones, options);
        if (!refined) return false;
        tried = true;
        refined->seconds = Stopwatch::since(started);
        if (!converted) return true;
        if (refined->tried_in_vain) {
            std::ranges::move(refined->report.warnings, std::back_inserter(converted->report.warnings));
            refined.reset();
        } else {
            refined = joined(*converted, std::move(*refined), options.strict);
        }
        return true;
    };
    refine(recipe.zones());
    for (;;) {
        const Refined* first = refined ? &*refined : converted ? &*converted : nullptr;
        const bool changed = first && !first->tried_in_vain;
        if (tried) started = Stopwatch::now();
        if (tried && changed) recipe.start(first->mesh);
        if (auto result = attempt(recipe, changed ? first->mesh : input, options, known_of(changed ? first : nullptr),
                                  first, started, refine)) {
            if (changed && !known.stages) {
                Changes& before = (refined ? refined : converted)->trace.changes;
                result->stages.insert(result->stages.begin(), std::move(before));
            }
            return std::move(*result);
        }
    }
}

}  // namespace

Result perform(Recipe& recipe, const Mesh& input, const OperatorOptions& options, const Prepared& known) {
    check_extent(input);
    recipe.start(input);
    check_name(input, options.name, recipe.naming());
    check_options(options);
    (void)drifting_groups(input, options.preserve);  // whose names may be unknown
    // What is taken out or made one before counts in the report, which the band alone would not tell.
    OperatorOptions whole = options;
    whole.band_only = false;
    const auto as_asked = [&](Result result) {
        if (options.band_only) result.mesh = changed_part(input, result.mesh);
        return result;
    };
    if (SevenNodes seven(input); seven) {
        recipe.start(seven.mesh());
        Result result = perform(recipe, seven.mesh(), whole, seven.known());
        seven.finish(result);
        return as_asked(std::move(result));
    }
    const Stopwatch::Time started = Stopwatch::now();
    WeldFirst weld(input, known);
    if (!weld || !(weld.is_near(around(recipe)) || !recipe.zones().empty()))
        return perform_on(recipe, input, options, known, started);
    try {
        recipe.start(weld.mesh());
        Result result = perform_on(recipe, weld.mesh(), whole, weld.known(), Stopwatch::now());
        if (weld.finish(result, options.strict)) return as_asked(std::move(result));
    } catch (const ToolError&) {
        // Sides that need not agree may find room; where they part, a warning says so.
    } catch (const QualityError&) {
    }
    recipe.start(input);
    return perform_on(recipe, input, options, known, started);
}

}  // namespace femscalpel
