// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/refine.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "cancel.h"
#include "cutting/checks.h"
#include "cutting/folded_input.h"
#include "cutting/locate.h"
#include "cutting/mend_curved.h"
#include "cutting/opening.h"
#include "cutting/workpiece.h"
#include "deck/carry_over.h"
#include "deck/mark_deck.h"
#include "deformation/curved_shape.h"
#include "deformation/relaxation.h"
#include "groups/opened_areas.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"
#include "operators/changed_quality.h"
#include "operators/edit.h"
#include "operators/follow_fields.h"
#include "operators/raise_order.h"
#include "operators/seven_nodes.h"
#include "operators/simplify_first.h"
#include "operators/weld_first.h"
#include "words.h"

namespace femscalpel {
namespace {

void require(bool holds, const char* parameter, double value, const char* rule) {
    if (holds) return;
    std::ostringstream message;
    message << parameter << " is " << value << "; it must be " << rule;
    throw ToolError(message.str(), parameter);
}

void check(const RefineOptions& o) {
    require(std::isfinite(o.size) && o.size > 0, "size", o.size, "a positive length");
    require(std::isfinite(o.gradation) && o.gradation >= 0, "gradation", o.gradation,
            "0 (one size everywhere) or more");
    require(std::isfinite(o.reach) && o.reach >= 0, "reach", o.reach, "0 or a positive length");
    require(o.max_elements > 0, "max_elements", static_cast<double>(o.max_elements), "positive");
    require(o.feature_angle > 0 && o.feature_angle < 180, "feature_angle", o.feature_angle,
            "between 0 and 180 degrees");
}

/// Visits the elements of dimension 2 and more that have an edge to be bisected: block, index.
template <class Visit>
void for_each_long(const Mesh& mesh, const SizeField& field, const std::vector<double>& distance, Visit visit) {
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 2) continue;
        SparseCheck check(256);
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            check();
            const bool is_long = std::ranges::any_of(t.edges, [&](const auto& e) {
                return field.exceeded(mesh.points[n[e[0]]], mesh.points[n[e[1]]], distance[n[e[0]]], distance[n[e[1]]]);
            });
            if (is_long) visit(b, c);
        }
    }
}

void mark_corners(const CellBlock& block, Index cell, std::vector<std::int8_t>& level) {
    for (const Index n : block.nodes(cell).first(static_cast<std::size_t>(traits(block.type).corners))) level[n] = 0;
}

std::vector<double> distances_of(const Mesh& mesh, const SizeField& field) {
    std::vector<double> out(mesh.points.size());
    SparseCheck check(256);
    for (std::size_t n = 0; n < out.size(); ++n, check()) out[n] = field.distance(mesh.points[n]);
    return out;
}

/// Marks the corners of elements that have an edge to be bisected, level 0.
std::vector<std::int8_t> find_long_edges(const Mesh& mesh, const SizeField& field, const std::vector<double>& distance,
                                         const std::string& advice) {
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    std::array<std::vector<Index>, cell_type_count> unsupported;
    for_each_long(mesh, field, distance, [&](const CellBlock& block, Index cell) {
        if (!traits(block.type).simplex) unsupported[static_cast<int>(block.type)].push_back(block.ids[cell]);
        mark_corners(block, cell, level);
    });
    for (const CellTraits& t : all_cell_types()) {
        const std::vector<Index>& list = unsupported[static_cast<int>(t.type)];
        if (list.empty()) continue;
        std::string numbers;
        for (std::size_t k = 0; k < list.size() && k < 5; ++k) numbers += (k ? ", " : "") + std::to_string(list[k]);
        if (list.size() > 5) numbers += ", ...";
        throw UnsupportedElementError("the refinement reaches " + std::to_string(list.size()) + " " +
                                      std::string(t.name) + " elements (" + numbers +
                                      "); only triangles and tetrahedra can be bisected. " + advice +
                                      ", or split these elements into tetrahedra first");
    }
    return level;
}

/// A band around long edges, bisected.
class Bisected {
public:
    Bisected(const Edit& edit, const SizeField& field, const RefineOptions& options)
        : edit_(edit), field_(field), options_(options) {}

    /// `core` is level 0 at the corners of elements with long edges; `distances` those of nodes.
    void run(const std::vector<std::int8_t>& core, const std::vector<double>& distances) {
        // The propagation of longest edges leaves the elements to be refined by a few elements, seldom more.
        constexpr int first_band = 2, last_band = 64;
        const Mesh& mesh = edit_.mesh();
        ConstraintOptions constraints = edit_.constraints();
        constraints.feature_angle = options_.feature_angle;
        constraints.shape = options_.skin;
        for (int levels = first_band;; levels *= 4) {
            std::vector<std::int8_t> level = core;
            spread_levels(mesh, level, levels);
            bisector_.reset();
            workpiece_.reset();
            workpiece_.emplace(Workpiece{.d = Deformable(extract_band(mesh, level, nullptr, true), mesh, constraints),
                                         .tool = nullptr,
                                         .tolerance = 0,
                                         .bandwidth = 0});
            Workpiece& f = *workpiece_;
            check_input_shape(f, mesh);
            check_skin(f);
            std::vector<double> known(static_cast<std::size_t>(f.d.band.size()));
            for (int v = 0; v < f.d.band.size(); ++v) known[v] = distances[f.d.band.nodes[v].global];
            bisector_.emplace(f.d, mesh, field_, options_, std::move(known), levels < last_band);
            if (bisector_->run()) return;
        }
    }

    Workpiece& workpiece() { return *workpiece_; }
    const Workpiece& workpiece() const { return *workpiece_; }
    const Bisector& bisector() const { return *bisector_; }

private:
    const Edit& edit_;
    const SizeField& field_;
    const RefineOptions& options_;
    std::optional<Workpiece> workpiece_;
    std::optional<Bisector> bisector_;
};

/// Numbers of new nodes inside the material that are in node groups, ascending.
std::vector<Index> new_on_shortcuts(const Workpiece& f, const Rebuilt& rebuilt) {
    std::vector<Index> out;
    for (int v = f.d.band.original_nodes(); v < f.d.band.size(); ++v)
        if (const Index n = rebuilt.node[v]; n >= 0 && f.d.constraints[v].freedom == NodeFreedom::free &&
                                             !rebuilt.mesh.families.groups(rebuilt.mesh.node_families[n]).empty())
            out.push_back(rebuilt.mesh.node_ids[n]);
    return out;
}

std::vector<std::string> warnings_of(const Bisected& bisected, const Mesh& mesh) {
    const Workpiece& f = bisected.workpiece();
    std::vector<std::string> out = f.warnings;
    std::ranges::move(warnings_of_opened_areas(f.d.band, mesh), std::back_inserter(out));
    if (const int left = bisected.bisector().left(); left > 0)
        out.push_back(counted(left, "edge stays", "edges stay") +
                      " longer than wanted: the second-order elements around them are so curved that parts "
                      "of them would be flat or inverted by their corners");
    if (const int off = bisected.bisector().off_shape(); off > 0)
        out.push_back(counted(off, "new node of the skin stays", "new nodes of the skin stay") +
                      " on the skin's triangles: on the shape they would spoil elements");
    return out;
}

/// All but the seconds. Throws QualityError when elements were inverted. `mesh` is what was refined; `quality` is set.
Report report_of(const Bisected& bisected, const Mesh& mesh, const Edited& edited, ChangedQuality& quality) {
    const Rebuilt& rebuilt = edited.rebuilt;
    Report report;
    report.operation = "refine";
    report.method = "bisection";
    report.warnings = warnings_of(bisected, mesh);
    report.nodes_added = report.nodes_split = rebuilt.nodes_split;
    report.elements_added = rebuilt.elements_added;
    quality = changed_quality(mesh, bisected.workpiece(), rebuilt);
    report.quality_before = summarise(quality.before);
    report.quality_after = summarise(quality.after);
    if (report.quality_before.minimum > 0 && report.quality_after.minimum <= 0)
        throw QualityError("elements would be inverted by refinement; choose a larger size, or another place");
    report.groups = compare_groups(mesh, edited.before, rebuilt.mesh, edited.after);
    for (GroupRecord& r : report.groups)
        if (r.status == "kept" && r.count_before == r.count_after) r.status = "untouched";
    return report;
}

/// Tells the caller what the refinement comes to. Throws ToolError, at once, where that is more than is allowed.
void announce(const Mesh& mesh, const DistanceField& distance, const RefineOptions& options) {
    const auto counted = [&](double size, Index limit) {
        BisectionOptions o = options;
        o.size = size;
        return count_refined(mesh, SizeField(distance, o), limit);
    };
    const Index limit = options.before ? std::max(most_counted, options.max_elements) : options.max_elements;
    const Index least = counted(options.size, limit);
    RefinementEstimate estimate;
    estimate.size = options.size;
    estimate.elements_before = mesh.cell_count();
    estimate.elements_after = with_followers(mesh.cell_count(), least);
    estimate.is_more = least > limit;
    if (options.before) {
        estimate.count = std::make_shared<std::function<Index(double, Index)>>(counted);
        const std::shared_ptr<void> end(nullptr, [&](void*) { *estimate.count = nullptr; });
        options.before(estimate);
    }
    if (least > options.max_elements) throw too_many_elements(options);
}

bool has_segments_alone(const Mesh& mesh) {
    return std::ranges::all_of(mesh.blocks(),
                               [](const CellBlock& b) { return traits(b.type).dimension < 2 || b.size() == 0; });
}

}  // namespace

std::vector<std::int8_t> corners_of_long_edges(const Mesh& mesh, const DistanceField& distance,
                                               const BisectionOptions& options, bool no_simplices) {
    const SizeField field(distance, options);
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    for_each_long(mesh, field, distances_of(mesh, field), [&](const CellBlock& block, Index cell) {
        if (!no_simplices || !traits(block.type).simplex) mark_corners(block, cell, level);
    });
    return level;
}

namespace {

/// On a mesh whose double nodes, if any, are single. What changed is added to `stages`.
Result refine_on(const Mesh& input, const DistanceField& distance, const RefineOptions& options, const Prepared& known,
                 std::vector<Changes>& stages, Stopwatch::Time started) {
    Laps seconds;
    Stopwatch watch(seconds, started);
    Trace trace;
    watch.lap("locate");
    const std::optional<Refined> converted = simplify_first(input, distance, options, known);
    watch.lap(converted ? "convert" : "locate");
    if (auto result = refine_where_needed(converted ? converted->mesh : input, distance, options, trace)) {
        if (converted) stages.push_back(converted->trace.changes);
        stages.push_back(std::move(trace.changes));
        std::ranges::move(warnings_of(trace.deck, options.strict), std::back_inserter(result->report.warnings));
        if (converted) {
            Refined refined;
            refined.report = std::move(result->report);
            result->report = joined(*converted, std::move(refined), options.strict).report;
        }
        Laps all = seconds;
        for (const auto& [step, time] : result->report.seconds) all.add(step, time);
        result->report.seconds = all.list();
        return std::move(*result);
    }
    watch.lap("locate");
    Result untouched;
    const FamilyTotals totals = family_totals(input);
    untouched.report.operation = "refine";
    untouched.report.method = "bisection";
    untouched.report.groups = compare_groups(input, totals, input, totals);
    for (GroupRecord& r : untouched.report.groups) r.status = "untouched";
    untouched.report.warnings = {
        has_segments_alone(input)
            ? "nothing was refined: the mesh has points and segments (beams, springs) alone, which stay as they are"
            : "no edge is longer than wanted: nothing was refined"};
    untouched.mesh = input;
    watch.lap("report");
    untouched.report.seconds = seconds.list();
    return untouched;
}

}  // namespace

namespace {

/// On a mesh without triangles of seven nodes.
Result refine_pairs(const Mesh& input, const DistanceField& distance, const RefineOptions& options,
                    std::vector<Changes>& stages) {
    const Stopwatch::Time started = Stopwatch::now();
    Prepared known;
    known.stages = &stages;
    WeldFirst weld(input, known);
    if (!weld) return refine_on(input, distance, options, {}, stages, started);
    std::vector<Changes> of_welded;
    Result result = refine_on(weld.mesh(), distance, options, weld.known(), of_welded, Stopwatch::now());
    if (of_welded.empty()) {
        result.mesh = input;
        return result;
    }
    std::ranges::move(of_welded, std::back_inserter(weld.stages()));
    if (weld.finish(result, options.strict)) return result;
    return refine_on(input, distance, options, {}, stages, started);
}

}  // namespace

Result refine(const Mesh& input, const DistanceField& distance, const RefineOptions& options) {
    check(options);
    check_extent(input);
    std::vector<Changes> stages;
    SevenNodes seven(input);
    Result result =
        refine_pairs(seven ? seven.mesh() : input, distance, options, seven ? *seven.known().stages : stages);
    result.stages = std::move(stages);
    if (seven) seven.finish(result);
    follow_fields(input, false, result);
    tell_of_ties(input, options.strict, result);
    return result;
}

std::optional<Result> refine_where_needed(const Mesh& input, const DistanceField& distance,
                                          const RefineOptions& options, Trace& trace) {
    check(options);
    check_extent(input);
    Laps seconds;
    Stopwatch watch(seconds);
    const SizeField field(distance, options);
    const std::vector<double> distances = distances_of(input, field);
    const std::vector<std::int8_t> core = find_long_edges(input, field, distances, options.finer_advice);
    watch.lap("locate");
    if (std::ranges::find(core, 0) == core.end()) return {};
    announce(input, distance, options);
    watch.lap("locate");
    Edit edit(input, {});
    const Mesh& mesh = edit.mesh();
    if (input.companion) watch.lap("mark deck");
    edit.start_copy();
    Bisected bisected(edit, field, options);
    bisected.run(core, distances);
    Workpiece& f = bisected.workpiece();
    watch.lap("bisect");
    if (!f.folded_input.empty()) check_folded_input(f, newly_folded(f, folded_elements(f, 0)));
    f.mid_side = [&](int a, int b) { return bisected.bisector().mid_side(a, b); };
    Edited edited = edit.finish(f, no_opening(f.d.band), {}, watch);
    trace.on_shortcuts = new_on_shortcuts(f, edited.rebuilt);
    Result result{{}, report_of(bisected, mesh, edited, trace.quality)};
    result.mesh = std::move(edited.rebuilt.mesh);
    trace.changes = std::move(edited.rebuilt.changes);
    trace.deck = std::move(edited.deck);
    remove_marks(result.mesh);
    watch.lap("report");
    result.report.seconds = seconds.list();
    return result;
}

}  // namespace femscalpel
