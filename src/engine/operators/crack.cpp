// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/crack.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <numbers>
#include <sstream>

#include "groups/preserve.h"
#include "mesh/quality.h"
#include "operators/lips.h"
#include "operators/locate.h"
#include "operators/rebuild.h"
#include "operators/scalpel.h"
#include "operators/stopwatch.h"
#include "semantics/carry_over.h"

namespace femscalpel {
namespace {

/// Code_Aster's limit for group names.
constexpr std::size_t longest_name = 24;

void check_name(const Mesh& mesh, const std::string& name) {
    if (name.empty()) throw ToolError("name is empty; the new groups need one");
    if (name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.") != std::string::npos)
        throw ToolError("name '" + name + "' has a character other than letters, digits, '_', '-' and '.'; solvers would not accept its groups");
    for (const char* suffix : {"_P", "_N", "_FRONT"}) {
        const std::string group = name + suffix;
        if (group.size() > longest_name)
            throw ToolError("name '" + name + "' is too long: group '" + group + "' would have " + std::to_string(group.size()) +
                            " characters, at most " + std::to_string(longest_name) + " are allowed");
        if (mesh.find_group(group)) throw ToolError("name '" + name + "' is taken: the mesh already has a group '" + group + "'; choose another");
    }
}

/// The paper's bandwidth: largest distance between an interface node and the tool, in mean edge lengths; at least 2.
int bandwidth(const Location& location, const Mesh& mesh) {
    double largest = 0, length = 0;
    long edges = 0;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 2 || !t.simplex) continue;
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            bool touched = false;
            for (int k = 0; k < t.corners; ++k) touched = touched || location.level[n[k]] == 0;
            if (!touched) continue;
            for (const auto& e : t.edges) {
                const Index a = n[e[0]], d = n[e[1]];
                if (location.level[a] != 0 || location.level[d] != 0) continue;
                length += (mesh.points[a] - mesh.points[d]).norm();
                ++edges;
                largest = std::max(largest, std::min(std::abs(location.distance[a]), std::abs(location.distance[d])));
            }
        }
    }
    if (edges == 0) return 2;
    return std::max(2, static_cast<int>(std::lround(largest / (length / static_cast<double>(edges)))));
}

QualitySummary summarise(std::vector<ElementQuality> qualities) {
    QualitySummary s;
    s.count = static_cast<Index>(qualities.size());
    double sum = 0;
    for (const ElementQuality& q : qualities) {
        s.minimum = std::min(s.minimum, q.mean_ratio);
        sum += q.mean_ratio;
        const int bar = std::clamp(static_cast<int>(q.mean_ratio * quality_bars), 0, quality_bars - 1);
        ++s.histogram[bar];
    }
    if (s.count > 0) s.mean = sum / static_cast<double>(s.count);
    const auto worst = qualities.begin() + std::min<std::ptrdiff_t>(10, static_cast<std::ptrdiff_t>(qualities.size()));
    std::ranges::partial_sort(qualities, worst, {}, [](const ElementQuality& q) { return std::pair(q.mean_ratio, q.id); });
    s.worst.assign(qualities.begin(), worst);
    return s;
}

/// Elements of the band's moving part before and after; `inverted` collects those that were bad on arrival.
struct BandQuality {
    std::vector<ElementQuality> before, after;
    std::vector<Index> inverted;
};

BandQuality band_quality(const Interface& f, const Mesh& mesh) {
    const BandMesh& band = f.d.band;
    std::vector<char> in(static_cast<std::size_t>(band.size()), 0);
    for (const int v : f.nodes) in[v] = 1;
    for (const int v : f.transition) in[v] = 1;
    BandQuality out;
    const auto look = [&](const auto& list, const auto& cells, auto counts, auto quality_now) {
        std::vector<char> counted(cells.size(), 0);
        for (int s = 0; s < list.size(); ++s) {
            if (!list.alive(s) || !counts(list.origin(s)) || std::ranges::none_of(list[s], [&](int v) { return in[v] != 0; })) continue;
            const CellRef& cell = cells[list.origin(s)];
            const Index id = mesh.block(cell.type).ids[cell.cell];
            out.after.push_back({id, quality_now(s)});
            if (counted[list.origin(s)]) continue;
            counted[list.origin(s)] = 1;
            out.before.push_back({id, mean_ratio(mesh, cell.type, cell.cell)});
        }
    };
    look(band.tetras, band.tetra_cells, [](int) { return true; }, [&](int s) { return tetra_quality(f.d, s); });
    look(band.triangles, band.triangle_cells, [&](int s) { return f.d.constraints.is_shell(s); }, [&](int s) { return shell_quality(f.d, s); });
    return out;
}

/// Angles and gaps at which geometry alone, not the method, limits the quality near the tool.
void warn_of_grazing(Interface& f, const Tool& tool) {
    const BandMesh& band = f.d.band;
    double smallest = 90;
    for (const int v : f.nodes) {
        const auto normal = f.d.constraints.surface_normal(f.d.constraints[v], band.nodes[v].at);
        if (!normal) continue;
        const double sine = normal->cross(tool.normal(band.nodes[v].at)).norm();
        smallest = std::min(smallest, std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi);
    }
    if (smallest < 5) {
        std::ostringstream message;
        message.precision(2);
        message << "the " << tool.kind() << " meets a surface or group border at " << smallest
                << " degrees: elements in the wedge between them cannot be better than the wedge";
        f.warnings.push_back(message.str());
    }
    double flattest = 90;
    for (const auto* set : {&f.nodes, &f.transition})
        for (const int v : *set) {
            if (f.d.constraints[v].freedom != NodeFreedom::curve) continue;
            if (std::abs(tool.distance(band.nodes[v].at)) > 0.15 * band.mean_edge_length(v)) continue;
            Eigen::Matrix3d along;
            f.d.constraints.tangents(v, nullptr, band.nodes[v].at, along);
            const double sine = std::abs(along.col(0).dot(tool.normal(band.nodes[v].at)));
            flattest = std::min(flattest, std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi);
        }
    if (flattest < 5) {
        std::ostringstream message;
        message.precision(2);
        message << "the " << tool.kind() << " runs along a feature line or border line at " << flattest
                << " degrees: elements between them cannot be better than that wedge";
        f.warnings.push_back(message.str());
    }
    // Nodes that stay on a surface nearly parallel to the tool, closer than 0.15 edge lengths.
    int near = 0;
    for (const int v : f.transition) {
        const double gap = std::abs(tool.distance(band.nodes[v].at));
        if (gap > 0.15 * band.mean_edge_length(v)) continue;
        const auto normal = f.d.constraints.surface_normal(f.d.constraints[v], band.nodes[v].at);
        if (normal && normal->cross(tool.normal(band.nodes[v].at)).norm() < 0.15) ++near;
    }
    if (near > 0)
        f.warnings.push_back("the " + tool.kind() + " runs within 0.15 edge lengths of a nearly parallel surface or group border at " +
                             std::to_string(near) + " node(s): the layer between them is that thin");
}

void count_constraints(const Interface& f, const Tool& tool, Report& report) {
    const NodeConstraints& constraints = f.d.constraints;
    auto& counts = report.constraints;
    for (const char* kind : {"tangent plane", "line", "fixed", "group boundary", "free"}) counts[kind] = 0;
    counts[tool.kind()] = static_cast<Index>(f.nodes.size());
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

/// Calls visit(index, record) for each group of the input that is not hidden: their records come first, in order.
void for_each_record(const Mesh& before, Report& report, auto visit) {
    std::size_t record = 0;
    for (std::size_t g = 0; g < before.groups.size(); ++g)
        if (!before.groups[g].hidden) visit(g, report.groups[record++]);
}

void count_group_constraints(const Interface& f, const Mesh& before, Report& report) {
    std::vector<int> nodes = f.nodes;
    nodes.insert(nodes.end(), f.transition.begin(), f.transition.end());
    const auto counts = f.d.constraints.count_by_group(f.d.band, nodes, before.groups.size());
    for_each_record(before, report, [&](std::size_t g, GroupRecord& r) {
        r.nodes_on_surface = counts[g].surface;
        r.nodes_on_line = counts[g].line;
        r.nodes_fixed = counts[g].fixed;
    });
}

/// Of groups whose boundary was not kept: how far it went.
void describe_drift(const DriftGauge& gauge, const Interface& f, const Mesh& before, const std::vector<bool>& drifting, Report& report) {
    const std::vector<double> drift = gauge.drift(f.d.band, before);
    for_each_record(before, report, [&](std::size_t g, GroupRecord& r) {
        if (!drifting[g]) return;
        r.boundary_kept = false;
        r.boundary_drift = drift[g];
    });
}

/// Moved nodes and boundary drift of each group, by group index.
void describe_motion(const Interface& f, const Mesh& before, const Rebuilt& rebuilt, Report& report) {
    const BandMesh& band = f.d.band;
    struct Motion {
        Index moved = 0;
        double drift = 0;
        int last = -1;
    };
    std::vector<Motion> motion(before.groups.size());
    for (Index n = 0; n < before.node_count(); ++n) {
        if (rebuilt.mesh.points[n] == before.points[n]) continue;
        ++report.nodes_moved;
        report.max_displacement = std::max(report.max_displacement, (rebuilt.mesh.points[n] - before.points[n]).norm());
    }
    for (int v = 0; v < band.original_nodes(); ++v) {
        const BandNode& n = band.nodes[v];
        if (n.at == n.start) continue;
        const double drift = f.d.constraints.distance(f.d.constraints[v], n.at);
        const auto meet = [&](FamilyIndex family) {
            for (GroupIndex g : before.families.groups(family)) {
                motion[g].drift = std::max(motion[g].drift, drift);
                if (motion[g].last == v) continue;
                motion[g].last = v;
                ++motion[g].moved;
            }
        };
        meet(before.node_families[n.global]);
        const auto around = [&](const auto& list, const auto& cells) {
            for (const int s : list.around(v)) meet(before.block(cells[list.origin(s)].type).families[cells[list.origin(s)].cell]);
        };
        around(band.tetras, band.tetra_cells);
        around(band.triangles, band.triangle_cells);
        around(band.lines, band.line_cells);
        for (const int s : band.facet_faces.around(v)) meet(before.facets[band.facet_faces.tag(s)].family);
    }
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
    std::size_t record = 0;
    for (std::size_t g = 0; g < rebuilt.mesh.groups.size(); ++g) {
        if (rebuilt.mesh.groups[g].hidden) continue;
        GroupRecord& r = report.groups[record++];
        if (g >= before.groups.size()) continue;
        r.nodes_moved = motion[g].moved;
        r.boundary_drift = motion[g].drift;
        if (r.status == "kept" && motion[g].moved == 0 && !changed[g] && r.count_before == r.count_after) r.status = "untouched";
        if (r.status == "became empty") report.warnings.push_back("group '" + r.name + "' became empty");
    }
}

/// Merging nodes can leave one that moved earlier outside the neighbourhood of the final interface; it still
/// belongs to the transition.
void add_moved_nodes(Interface& f) {
    for (int v = 0; v < f.d.band.size(); ++v) {
        const BandNode& n = f.d.band.nodes[v];
        const bool counts = f.d.band.in_use(v) && (f.d.band.is_new(v) || n.at != n.start) && !f.d.contact[v];
        if (counts && !std::ranges::binary_search(f.transition, v)) f.transition.insert(std::ranges::upper_bound(f.transition, v), v);
    }
}

std::vector<Index> numbers(const std::vector<int>& nodes, const std::vector<Index>& index, const Mesh& mesh, auto keep) {
    std::vector<Index> out;
    for (const int v : nodes)
        if (keep(v) && index[v] >= 0) out.push_back(mesh.node_ids[index[v]]);
    return out;
}

void add_front(const Lips& lips, const std::string& name, Rebuilt& rebuilt) {
    if (lips.front_nodes.empty()) return;
    Mesh& mesh = rebuilt.mesh;
    const GroupIndex group = mesh.add_group(name + "_FRONT", GroupKind::node);
    for (const int v : lips.front_nodes) {
        FamilyIndex& family = mesh.node_families[rebuilt.node[v]];
        family = mesh.families.with(family, group);
    }
}

Result crack_with(const Mesh& input, const Tool& tool, const CrackOptions& options, const Adjacency* adjacency, const FamilyTotals* totals) {
    Result result;
    Report& report = result.report;
    report.operation = "crack";
    report.name = options.name;
    report.method = std::string(to_string(options.method));
    check_name(input, options.name);
    if (options.transition && (*options.transition < 1 || *options.transition > 20))
        throw ToolError("transition is " + std::to_string(*options.transition) + "; it must be between 1 and 20");
    if (!(options.feature_angle > 0 && options.feature_angle < 180))
        throw ToolError("feature_angle must lie between 0 and 180 degrees");

    Stopwatch watch(report.seconds);
    const DeckMarks marks = mark_deck(input);
    const Mesh& mesh = marks.mesh ? *marks.mesh : input;
    if (marks.mesh) totals = nullptr;  // other families
    if (input.solver_input) watch.lap("mark deck");
    // The output's copy and the group measures do not depend on the band: the second core makes them meanwhile.
    auto copy = std::async(std::launch::async, [&mesh, totals] {
        return std::pair(std::make_unique<Mesh>(mesh), totals ? FamilyTotals() : family_totals(mesh));
    });
    Location location = locate(mesh, tool, options.transition.value_or(2), adjacency);
    int width = options.transition.value_or(2);
    if (!options.transition && options.method == Method::deform) {
        width = bandwidth(location, mesh);
        if (width > 2) location = locate(mesh, tool, width, adjacency);
    }
    watch.lap("locate");
    ConstraintOptions constraint_options;
    constraint_options.feature_angle = options.feature_angle;
    constraint_options.drifting_groups = drifting_groups(mesh, options.preserve);
    constraint_options.kept_hidden = marks.kept;
    constraint_options.pinned = marks.pinned;
    Interface f{Deformable(extract_band(mesh, location.level), mesh, constraint_options), {}, location.tolerance, {}, {}, width, {}, {}};
    f.distance.resize(static_cast<std::size_t>(f.d.band.size()));
    for (int v = 0; v < f.d.band.size(); ++v) {
        f.distance[v] = location.distance[f.d.band.nodes[v].global];
        if (std::abs(f.distance[v]) > location.tolerance) continue;
        f.distance[v] = 0;
        f.d.contact[v] = &tool;
    }
    check_input_shape(f, mesh);
    std::optional<DriftGauge> gauge;
    if (options.preserve) gauge.emplace(f.d.band, mesh, constraint_options.drifting_groups);
    watch.lap("constraints");
    if (location.crossed > 0) {
        split_at_fixed_middles(f, tool, mesh);
        if (options.method == Method::snap) snap_to_tool(f, tool);
        else deform_to_tool(f, tool, mesh);
        report.seconds.insert(report.seconds.end(), f.seconds.begin(), f.seconds.end());
        check_shape(f, mesh);
    }
    watch.skip();

    const Lips lips = open_lips(f);
    if (lips.copy_of.empty()) {
        throw ToolError("the " + tool.kind() + " only grazes the mesh: what it would cut off is thinner than the elements there. Move the " + tool.kind() +
                        " into the material");
    }
    // Only nodes of opened faces count as interface; others merely happen to lie on the tool.
    for (int v = 0; v < f.d.band.size(); ++v)
        if (!std::ranges::binary_search(lips.interface_nodes, v)) f.d.contact[v] = {};
    find_node_sets(f);
    add_moved_nodes(f);
    warn_of_grazing(f, tool);
    watch.lap("open");
    auto [output, own_totals] = copy.get();
    if (!totals) totals = &own_totals;
    Rebuilt rebuilt = rebuild(mesh, std::move(*output), f, lips, options.name + "_P", options.name + "_N");
    add_front(lips, options.name, rebuilt);
    watch.lap("rebuild");
    std::vector<std::string> deck_warnings;
    if (input.solver_input) {
        carry_deck(mesh, rebuilt.mesh, rebuilt.changes, options.strict, deck_warnings);
        watch.lap("carry deck");
    }

    const auto exterior = [&](int v) { return f.d.constraints.is_exterior(v); };
    const auto interior = [&](int v) { return !f.d.constraints.is_exterior(v); };
    report.transition = f.bandwidth;
    report.node_sets["ICN"] = numbers(f.nodes, rebuilt.node, rebuilt.mesh, interior);
    report.node_sets["ECN"] = numbers(f.nodes, rebuilt.node, rebuilt.mesh, exterior);
    report.node_sets["ITN"] = numbers(f.transition, rebuilt.node, rebuilt.mesh, interior);
    report.node_sets["ETN"] = numbers(f.transition, rebuilt.node, rebuilt.mesh, exterior);
    count_constraints(f, tool, report);
    BandQuality quality = band_quality(f, mesh);
    report.quality_before = summarise(std::move(quality.before));
    report.quality_after = summarise(std::move(quality.after));
    report.nodes_split = rebuilt.nodes_split;
    report.nodes_doubled = rebuilt.nodes_doubled;
    report.nodes_added = rebuilt.nodes_split + rebuilt.nodes_doubled;
    report.elements_added = rebuilt.elements_added;
    report.elements_removed = rebuilt.elements_removed;
    FamilyTotals after = *totals;
    count_cells(after, mesh, rebuilt.before, -1);
    count_cells(after, rebuilt.mesh, rebuilt.after, +1);
    recount_nodes_and_facets(after, rebuilt.mesh);
    report.groups = compare_groups(mesh, *totals, rebuilt.mesh, after);
    report.warnings = f.warnings;
    report.warnings.insert(report.warnings.end(), lips.warnings.begin(), lips.warnings.end());
    report.warnings.insert(report.warnings.end(), rebuilt.warnings.begin(), rebuilt.warnings.end());
    report.warnings.insert(report.warnings.end(), deck_warnings.begin(), deck_warnings.end());
    describe_motion(f, mesh, rebuilt, report);
    count_group_constraints(f, mesh, report);
    if (gauge) describe_drift(*gauge, f, mesh, constraint_options.drifting_groups, report);
    watch.lap("report");
    remove_marks(rebuilt.mesh);
    result.mesh = std::move(rebuilt.mesh);
    return result;
}

}  // namespace

Result crack(const Mesh& mesh, const Tool& tool, const CrackOptions& options) {
    return crack_with(mesh, tool, options, nullptr, nullptr);
}

struct Scalpel::State {
    std::shared_ptr<const Mesh> mesh;
    Adjacency adjacency;
    FamilyTotals totals;
};

Scalpel::Scalpel(std::shared_ptr<const Mesh> mesh) {
    Adjacency adjacency(*mesh);
    FamilyTotals totals = family_totals(*mesh);
    state_ = std::make_unique<State>(State{std::move(mesh), std::move(adjacency), std::move(totals)});
}

Scalpel::~Scalpel() = default;
Scalpel::Scalpel(Scalpel&&) noexcept = default;

const Mesh& Scalpel::mesh() const { return *state_->mesh; }

Result Scalpel::crack(const Tool& tool, const CrackOptions& options) const {
    return crack_with(*state_->mesh, tool, options, &state_->adjacency, &state_->totals);
}

}  // namespace femscalpel
