// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/account.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <unordered_set>

#include "cancel.h"
#include "deck/carry_over.h"
#include "groups/opened_areas.h"
#include "mesh/quality.h"
#include "operators/poor.h"
#include "operators/warnings.h"

namespace femscalpel {
namespace {

/// Elements of the band's moving part before and after.
ChangedQuality band_quality(const Workpiece& f, const Mesh& mesh) {
    const BandMesh& band = f.d.band;
    std::vector<char> in(static_cast<std::size_t>(band.size()), 0);
    for (const int v : f.nodes) in[v] = 1;
    for (const int v : f.transition) in[v] = 1;
    ChangedQuality out;
    const auto look = [&](const auto& list, const auto& cells, auto counts, auto quality_now) {
        std::vector<char> counted(cells.size(), 0);
        check_cancelled();
        for (int s = 0; s < list.size(); ++s) {
            if (!list.alive(s) || !counts(list.origin(s)) ||
                std::ranges::none_of(list[s], [&](int v) { return in[v] != 0; }))
                continue;
            const CellRef& cell = cells[list.origin(s)];
            const Index id = mesh.block(cell.type).ids[cell.cell];
            out.after.push_back({id, quality_now(s)});
            if (counted[list.origin(s)]) continue;
            counted[list.origin(s)] = 1;
            out.before.push_back({id, mean_ratio(mesh, cell.type, cell.cell)});
        }
    };
    look(
        band.tetras, band.tetra_cells, [](int) { return true; }, [&](int s) { return tetra_quality(f.d, s); });
    look(
        band.triangles, band.triangle_cells, [&](int s) { return f.d.constraints.is_shell(s); },
        [&](int s) { return shell_quality(f.d, s); });
    return out;
}

/// A mid-side node of the input that moved with its edge a-b.
struct MovedMiddle {
    Index node;  // of the input
    int a, b;
};

/// In ascending order. Those that became corners are band nodes themselves.
std::vector<MovedMiddle> moved_middles(const BandMesh& band, const Mesh& before, const Rebuilt& rebuilt) {
    std::unordered_set<Index> corners;
    for (const BandNode& n : band.nodes)
        if (n.global >= 0) corners.insert(n.global);
    std::vector<MovedMiddle> out;
    for (const auto& [key, middle] : band.mid_nodes) {
        const Index now = rebuilt.kept_node(middle);
        if (now < 0 || rebuilt.mesh.points[now] == before.points[middle] || corners.contains(middle)) continue;
        out.push_back({middle, static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)});
    }
    std::ranges::sort(out, {}, &MovedMiddle::node);
    return out;
}

/// Adds them to the set of their edge: interface if it lies on a tool, else transition; and to the constraints.
void add_middles(const std::vector<MovedMiddle>& middles, const Workpiece& f, const Mesh& before,
                 const Rebuilt& rebuilt, const std::array<const char*, 4>& sets, Report& report) {
    const NodeConstraints& constraints = f.d.constraints;
    for (const MovedMiddle& m : middles) {
        Contact tools = f.d.edge_contact(m.a, m.b);
        // An edge of a curved skin may have but its ends on the tool.
        if (Deformable::off_tools(tools, rebuilt.mesh.points[rebuilt.kept_node(m.node)], f.d.held_between(m.a, m.b)) >
            10 * f.tolerance)
            tools = {};
        const NodeFreedom freedom = constraints.on_edge(f.d.band, m.a, m.b).freedom;
        report.node_sets[sets[(tools ? 0 : 2) + constraints.is_exterior_edge(f.d.band, m.a, m.b)]].push_back(
            before.node_ids[m.node]);
        std::set<std::string> kinds;
        for (const Tool* t : tools.tools()) kinds.insert(t->kind());
        for (const std::string& kind : kinds) ++report.constraints[kind];
        report.constraints["tangent plane"] += constraints.is_skin_edge(f.d.band, m.a, m.b);
        report.constraints["group boundary"] += constraints.is_internal_edge(f.d.band, m.a, m.b);
        report.constraints["line"] += freedom == NodeFreedom::curve;
        report.constraints["free"] += !tools && freedom == NodeFreedom::free;
    }
}

void count_constraints(const Workpiece& f, std::span<const Blade> blades, Report& report) {
    const NodeConstraints& constraints = f.d.constraints;
    auto& counts = report.constraints;
    for (const char* kind : {"tangent plane", "line", "fixed", "group boundary", "free"}) counts[kind] = 0;
    std::set<std::string> kinds;
    for (const Blade& b : blades) kinds.insert(b.tool->kind());
    for (const std::string& kind : kinds)
        counts[kind] = std::ranges::count_if(f.nodes, [&](int v) {
            return std::ranges::any_of(f.d.contact[v].tools(), [&](const Tool* t) { return t->kind() == kind; });
        });
    for (const auto* set : {&f.nodes, &f.transition})
        for (const int v : *set) {
            const bool skin = constraints.is_on_skin(f.d.band, v), internal = constraints.is_on_internal(f.d.band, v);
            counts["tangent plane"] += skin;
            counts["group boundary"] += internal;
            counts["line"] += constraints[v].freedom == NodeFreedom::curve;
            counts["fixed"] += constraints[v].freedom == NodeFreedom::fixed;
            counts["free"] += set == &f.transition && constraints[v].freedom == NodeFreedom::free;
        }
}

void count_group_constraints(const Workpiece& f, const Mesh& before, Report& report) {
    std::vector<int> nodes = f.nodes;
    nodes.insert(nodes.end(), f.transition.begin(), f.transition.end());
    const auto counts = f.d.constraints.count_by_group(f.d.band, nodes, before.groups.size());
    for_each_record(before, report, [&](std::size_t g, GroupRecord& r) {
        r.nodes_on_surface = counts[g].surface;
        r.nodes_on_line = counts[g].line;
        r.nodes_fixed = counts[g].fixed;
    });
}

/// What happened to the nodes of a group.
struct Motion {
    Index moved = 0;
    Index nodes_gone = 0;
    double drift = 0;
    int last = -1;  // node that counted
};

/// By group index. Nodes from the number `first_new` on are not the input's and do not count.
std::vector<Motion> motion_of_groups(const Workpiece& f, const Mesh& before, Index first_new, const Rebuilt& rebuilt) {
    const BandMesh& band = f.d.band;
    std::vector<Motion> motion(before.groups.size());
    SparseCheck check;
    for (Index n = 0; n < before.node_count(); ++n, check()) {
        if (before.node_ids[n] >= first_new || rebuilt.kept_node(n) >= 0) continue;
        for (const GroupIndex g : before.families.groups(before.node_families[n])) ++motion[g].nodes_gone;
    }
    for (int v = 0; v < band.original_nodes(); ++v) {
        const BandNode& n = band.nodes[v];
        check();
        if (n.at == n.start || !band.in_use(v)) continue;
        const double drift = f.d.constraints.distance(f.d.constraints[v], n.at);
        const auto meet = [&](FamilyIndex family) {
            for (GroupIndex g : before.families.groups(family)) {
                motion[g].drift = std::max(motion[g].drift, drift);
                if (motion[g].last == v || before.node_ids[n.global] >= first_new) continue;
                motion[g].last = v;
                ++motion[g].moved;
            }
        };
        meet(before.node_families[n.global]);
        const auto around = [&](const auto& list, const auto& cells) {
            for (const int s : list.around(v))
                meet(before.block(cells[list.origin(s)].type).families[cells[list.origin(s)].cell]);
        };
        around(band.tetras, band.tetra_cells);
        around(band.triangles, band.triangle_cells);
        around(band.lines, band.line_cells);
        for (const int s : band.facet_faces.around(v)) meet(before.facets[band.facet_faces.tag(s)].family);
    }
    return motion;
}

/// Moved nodes, and how far they went. Nodes from the number `first_new` on are not the input's and do not count.
void count_moved_nodes(const Mesh& before, Index first_new, const Rebuilt& rebuilt, Report& report) {
    SparseCheck check;
    for (Index n = 0; n < before.node_count(); ++n, check()) {
        const Index now = rebuilt.kept_node(n);
        if (before.node_ids[n] >= first_new || now < 0 || rebuilt.mesh.points[now] == before.points[n]) continue;
        ++report.nodes_moved;
        report.max_displacement =
            std::max(report.max_displacement, (rebuilt.mesh.points[now] - before.points[n]).norm());
    }
}

/// Groups, by index, that had or have one of the elements that were changed.
std::vector<char> changed_groups(const Mesh& before, const Rebuilt& rebuilt) {
    std::vector<char> changed(before.groups.size(), 0);
    const auto mark = [&](const Mesh& mesh, const std::vector<CellRef>& cells) {
        std::vector<char> seen(static_cast<std::size_t>(mesh.families.size()), 0);
        for (const CellRef& c : cells) {
            const FamilyIndex family = mesh.block(c.type).families[c.cell];
            if (seen[family]) continue;
            seen[family] = 1;
            for (GroupIndex g : mesh.families.groups(family))
                if (static_cast<std::size_t>(g) < changed.size()) changed[g] = 1;
        }
    };
    mark(before, rebuilt.before);
    mark(rebuilt.mesh, rebuilt.after);
    return changed;
}

/// Splitting and merging can leave a node that moved, or an end of a split edge, outside the neighbourhood of the final
/// interface; it still belongs to the transition.
void add_moved_nodes(Workpiece& f) {
    const BandMesh& band = f.d.band;
    std::vector<char> changed(static_cast<std::size_t>(band.size()), 0);
    for (int v = 0; v < band.size(); ++v) changed[v] = band.is_new(v) || band.nodes[v].at != band.nodes[v].start;
    for (const BandMesh::Birth& b : band.births) changed[b.a] = changed[b.b] = 1;
    for (const int v : f.transition) changed[v] = 1;
    f.transition.clear();
    for (int v = 0; v < band.size(); ++v)
        if (changed[v] && band.in_use(v) && band.nodes[v].movable() && !f.d.contact[v]) f.transition.push_back(v);
}

std::vector<Index> numbers(const std::vector<int>& nodes, const std::vector<Index>& index, const Mesh& mesh,
                           auto keep) {
    std::vector<Index> out;
    for (const int v : nodes)
        if (keep(v) && index[v] >= 0) out.push_back(mesh.node_ids[index[v]]);
    return out;
}

}  // namespace

void describe_motion(const Workpiece& f, const Mesh& before, Index first_new, const Rebuilt& rebuilt, bool removes,
                     Report& report) {
    count_moved_nodes(before, first_new, rebuilt, report);
    const std::vector<Motion> motion = motion_of_groups(f, before, first_new, rebuilt);
    const std::vector<char> changed = changed_groups(before, rebuilt);
    std::size_t record = 0;
    for (std::size_t g = 0; g < rebuilt.mesh.groups.size(); ++g) {
        if (rebuilt.mesh.groups[g].hidden) continue;
        GroupRecord& r = report.groups[record++];
        if (g >= before.groups.size()) continue;
        r.nodes_moved = motion[g].moved;
        r.boundary_drift = motion[g].drift;
        const bool smaller =
            r.measure_after < r.measure_before || (r.measure_before == 0 && r.count_after < r.count_before);
        if (removes && (motion[g].nodes_gone > 0 ||
                        (r.kind != GroupKind::node && smaller && (r.status == "changed" || r.measure_before == 0))))
            r.status = r.count_after == 0 ? "became empty" : "reduced";
        if (r.status == "kept" && motion[g].moved == 0 && !changed[g] && r.count_before == r.count_after)
            r.status = "untouched";
    }
}

Account::Account(const char* kind, const OperatorOptions& options, const Edit& edit, const Refined* refined,
                 const std::vector<bool>& drifting)
    : options_(options), edit_(edit), refined_(refined), drifting_(drifting) {
    report_.operation = kind;
    report_.name = options.name;
    report_.method = std::string(to_string(options.method));
    if (refined) report_.warnings = refined->report.warnings;
}

void Account::open(const Workpiece& f) {
    if (options_.preserve) gauge_.emplace(f.d.band, edit_.mesh(), drifting_);
    if (f.d.constraints.has_shortcuts())
        shortcuts_.emplace(DriftGauge::of_shortcuts(f.d.band, edit_.mesh(), drifting_,
                                                    refined_ ? refined_->trace.on_shortcuts : std::vector<Index>()));
}

void Account::judge(Workpiece& f, std::span<const Blade> blades, const Opening& opening) {
    // Only nodes of opened faces count as interface; others merely happen to lie on the tool.
    std::vector<char> opened(static_cast<std::size_t>(f.d.band.size()), 0);
    for (const int v : opening.interface_nodes) opened[v] = 1;
    for (int v = 0; v < f.d.band.size(); ++v)
        if (!opened[v]) f.d.contact[v] = {};
    find_node_sets(f);
    add_moved_nodes(f);
    const Mesh& mesh = edit_.mesh();
    for (const Blade& b : blades) warn_of_grazing(f, *b.tool, mesh);
    warn_of_parted_lips(f);
    report_.held = find_held_nodes(f, mesh);
    report_.straightened = {.count = f.straightened, .largest = f.straightened_off};
    quality_ = band_quality(f, mesh);
    report_.quality_before = summarise(quality_.before);
    report_.quality_after = summarise(quality_.after);
    report_.poor = find_poor_places(f, mesh, report_.quality_before.minimum);
    for (std::string& warning : warnings_of_opened_areas(f.d.band, mesh)) f.warnings.push_back(std::move(warning));
}

void Account::list_node_sets(const Workpiece& f, const Naming& naming, const Rebuilt& rebuilt) {
    const auto exterior = [&](int v) { return f.d.constraints.is_exterior(v); };
    const auto interior = [&](int v) { return !f.d.constraints.is_exterior(v); };
    report_.transition = f.bandwidth;
    report_.node_sets[naming.sets[0]] = numbers(f.nodes, rebuilt.node, rebuilt.mesh, interior);
    report_.node_sets[naming.sets[1]] = numbers(f.nodes, rebuilt.node, rebuilt.mesh, exterior);
    report_.node_sets[naming.sets[2]] = numbers(f.transition, rebuilt.node, rebuilt.mesh, interior);
    report_.node_sets[naming.sets[3]] = numbers(f.transition, rebuilt.node, rebuilt.mesh, exterior);
}

void Account::count(const Rebuilt& rebuilt) {
    report_.nodes_split = rebuilt.nodes_split;
    report_.nodes_doubled = rebuilt.nodes_doubled;
    report_.nodes_added = rebuilt.nodes_split + rebuilt.nodes_doubled;
    report_.nodes_removed = rebuilt.nodes_removed;
    report_.elements_added = rebuilt.elements_added;
    report_.elements_removed = rebuilt.elements_removed;
}

/// Throws Error when there are problems and the option strict is given. A preview does not carry the deck over.
std::vector<std::string> Account::deck_warnings(const Edited& edited) const {
    if (edit_.is_part()) return {};
    if (!was_refined() || !refined_->deck) return warnings_of(edited.deck, options_.strict);
    const JoinedRemarks both(refined_->trace.deck, refined_->trace.changes, edited.deck, edited.rebuilt.changes,
                             edited.rebuilt.mesh, *refined_->deck);
    return warnings_of(both, options_.strict);
}

void Account::find_warnings(const Workpiece& f, std::span<const Blade> blades, const Opening& opening,
                            const Edited& edited) {
    // Sets that follow surfaces change with these; no size of theirs can get lost.
    std::vector<bool> unjudged = drifting_;
    const std::vector<bool>& meaningless = edit_.meaningless();
    if (unjudged.empty())
        unjudged = meaningless;
    else
        for (std::size_t g = 0; g < meaningless.size(); ++g) unjudged[g] = unjudged[g] || meaningless[g];
    const Mesh& mesh = edit_.mesh();
    if (!options_.skin) warn_of_changed_size(edit_.whole(), mesh, edited.before, edited.after, f, unjudged, report_);
    warn_of_emptied_groups(mesh, meaningless, report_);
    const std::vector<std::string> of_deck = deck_warnings(edited);
    for (const std::vector<std::string>* warnings : {&f.warnings, &opening.warnings, &of_deck})
        for (const std::string& w : *warnings)
            if (std::ranges::find(report_.warnings, w) == report_.warnings.end()) report_.warnings.push_back(w);
    // What refining added is told elsewhere; what was converted counts as it became.
    if (!was_refined() || !refined_->summary) check_growth(edit_.whole().cell_count(), *blades.front().tool, report_);
}

/// Makes the counts of the report those of refinement and operation together: what both made and removed does not
/// count.
void Account::join_refinement(const Rebuilt& rebuilt) {
    const Mesh& before = edit_.mesh();
    const Refined& refined = *refined_;
    report_.refinement = refined.summary;
    report_.converted = refined.report.converted;
    report_.beams_cut = refined.report.beams_cut;
    Index nodes = 0, elements = 0;
    for (Index n = 0; n < before.node_count(); ++n)
        nodes += before.node_ids[n] >= refined.numbering.node && rebuilt.kept_node(n) < 0;
    std::unordered_set<Index> left;
    left.reserve(rebuilt.after.size());
    for (const CellRef& c : rebuilt.after) left.insert(rebuilt.mesh.block(c.type).ids[c.cell]);
    for (const CellRef& c : rebuilt.before)
        if (const Index id = before.block(c.type).ids[c.cell]; id >= refined.numbering.cell)
            elements += !left.contains(id);
    report_.nodes_split += refined.report.nodes_split - nodes;
    report_.nodes_added += refined.report.nodes_added - nodes;
    report_.nodes_removed += refined.report.nodes_removed - nodes;
    report_.elements_added += refined.report.elements_added - elements;
    report_.elements_removed -= elements;
    for_each_record(before, report_, [&, record = std::size_t{0}](std::size_t, GroupRecord& r) mutable {
        const GroupRecord& was = refined.report.groups[record++];
        r.count_before = was.count_before;
        r.measure_before = was.measure_before;
    });
}

/// Elements that were divided or converted first count as those they were made of, also beside the band.
void Account::join_quality(const Rebuilt& rebuilt) {
    const ChangedQuality& first = refined_->trace.quality;
    std::unordered_set<Index> made, done;
    for (const ElementQuality& q : first.after) made.insert(q.id);
    for (const ElementQuality& q : quality_.before) done.insert(q.id);
    for (const CellRef& c : rebuilt.before) done.insert(edit_.mesh().block(c.type).ids[c.cell]);
    std::erase_if(quality_.before, [&](const ElementQuality& q) { return made.contains(q.id); });
    std::ranges::copy(first.before, std::back_inserter(quality_.before));
    std::ranges::copy_if(first.after, std::back_inserter(quality_.after),
                         [&](const ElementQuality& q) { return !done.contains(q.id); });
    report_.quality_before = summarise(std::move(quality_.before));
    report_.quality_after = summarise(std::move(quality_.after));
}

void describe_drift(const DriftGauge& gauge, const std::vector<bool>& drifting, const BandMesh& now, const Mesh& before,
                    Report& report) {
    const std::vector<double> drift = gauge.drift(now, before);
    for_each_record(before, report, [&](std::size_t g, GroupRecord& r) {
        if (!drifting[g]) return;
        r.boundary_kept = false;
        r.boundary_drift = drift[g];
    });
}

/// Of groups whose boundary was not kept, how far it went; and of node groups, whose boundary was but for shortcuts,
/// how far those did.
void Account::describe_drift(const Workpiece& f) {
    const Mesh& before = edit_.mesh();
    if (gauge_) femscalpel::describe_drift(*gauge_, drifting_, f.d.band, before, report_);
    if (const std::vector<bool>& meaningless = edit_.meaningless(); !meaningless.empty())
        for_each_record(before, report_,
                        [&](std::size_t g, GroupRecord& r) { r.boundary_kept = r.boundary_kept && !meaningless[g]; });
    if (shortcuts_) {
        const std::vector<double> drift = shortcuts_->drift(f.d.band, before);
        for_each_record(before, report_, [&](std::size_t g, GroupRecord& r) {
            if (r.kind == GroupKind::node) r.boundary_drift = std::max(r.boundary_drift, drift[g]);
        });
    }
}

Report Account::close(const Workpiece& f, std::span<const Blade> blades, const Opening& opening, const Naming& naming,
                      const Edited& edited) {
    const Mesh& before = edit_.mesh();
    const Rebuilt& rebuilt = edited.rebuilt;
    list_node_sets(f, naming, rebuilt);
    count_constraints(f, blades, report_);
    add_middles(moved_middles(f.d.band, before, rebuilt), f, before, rebuilt, naming.sets, report_);
    count(rebuilt);
    report_.groups = compare_groups(before, edited.before, rebuilt.mesh, edited.after);
    find_warnings(f, blades, opening, edited);
    if (was_refined()) join_refinement(rebuilt);
    const Index first_new = was_refined() ? refined_->numbering.node : edit_.numbering().node;
    describe_motion(f, before, first_new, rebuilt, opening.removes, report_);
    count_group_constraints(f, before, report_);
    warn_of_held_nodes(f, before, report_);
    describe_drift(f);
    if (was_refined()) join_quality(rebuilt);
    return std::move(report_);
}

}  // namespace femscalpel
