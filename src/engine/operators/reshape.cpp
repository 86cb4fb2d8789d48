// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/reshape.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <unordered_map>

#include "cancel.h"
#include "cutting/checks.h"
#include "cutting/crossing.h"
#include "cutting/locate.h"
#include "cutting/motion_error.h"
#include "cutting/move_wall.h"
#include "cutting/opening.h"
#include "cutting/tangent.h"
#include "deck/carry_over.h"
#include "groups/group_nodes.h"
#include "groups/opened_areas.h"
#include "groups/preserve.h"
#include "groups/unknown_group.h"
#include "mesh/rounding.h"
#include "operators/account.h"
#include "operators/changed_quality.h"
#include "operators/driver.h"
#include "operators/edit.h"
#include "operators/follow_fields.h"
#include "operators/poor.h"
#include "operators/reshape_part.h"
#include "operators/seven_nodes.h"
#include "operators/simplify_first.h"
#include "operators/warnings.h"
#include "operators/weld_first.h"
#include "words.h"

namespace femscalpel {
namespace {

/// The band reaches as many rings of elements around the wall as it moves edges, times this, and some more.
constexpr double rings_per_edge = 1.5;
constexpr int least_rings = 4, most_rings = 60;
/// Where a motion failed, how much of it works is looked for so many times as long as that took, and within these
/// seconds.
constexpr double search_to_failure = 3, least_search = 4, most_search = 15;

void check(const ReshapeOptions& o) {
    const int given = (o.onto != nullptr) + o.by.has_value() + o.scale.has_value();
    if (given != 1) {
        const char* at_fault = given == 0 ? "onto" : o.scale ? "scale" : "by";
        throw ToolError(std::string(given == 0 ? "none" : "more than one") +
                            " of onto, by and scale is given; reshape takes exactly one of them",
                        at_fault);
    }
    if (o.by && !o.by->allFinite()) throw ToolError("by must be three finite lengths", "by");
    if (o.by && o.by->isZero(0)) throw ToolError("by is zero: nothing would move", "by");
    if (o.scale && !(std::isfinite(o.scale->factor) && o.scale->factor > 0 && o.scale->centre.allFinite())) {
        std::ostringstream message;
        message << "scale has the factor " << o.scale->factor << "; it must be positive, about a finite point";
        throw ToolError(message.str(), "scale");
    }
    if (!(o.feature_angle > 0 && o.feature_angle < 180))
        throw ToolError("feature_angle must lie between 0 and 180 degrees", "feature_angle");
}

GroupIndex find(const Mesh& mesh, const std::string& name) {
    for (const GroupKind kind : {GroupKind::element, GroupKind::facet, GroupKind::node})
        if (const auto group = mesh.find_group(name, kind)) return *group;
    throw ToolError(no_group_text(mesh, name), "group");
}

/// The motion the options ask for, without tools.
WallMotion motion_of(const ReshapeOptions& o) {
    WallMotion out;
    out.parameter = o.onto ? "onto" : o.by ? "by" : "scale";
    out.onto = o.onto;
    if (o.by) out.carried.shift = *o.by;
    if (o.scale) out.carried = {o.scale->factor, (1 - o.scale->factor) * o.scale->centre};
    return out;
}

/// How far the motion takes the wall, in its mean edge length.
double edges_moved(const Mesh& mesh, const Covered& covered, const WallMotion& motion) {
    double farthest = 0, length = 0;
    Index edges = 0;
    for (const auto& part : covered.parts) {
        const int corners = covered.faces ? 3 : 2;
        for (int k = 0; k < corners; ++k) {
            const Vec3& x = mesh.points[part[k]];
            farthest =
                std::max(farthest, motion.onto ? std::abs(motion.onto->distance(x)) : (motion.carried(x) - x).norm());
            length += (x - mesh.points[part[(k + 1) % corners]]).norm();
            ++edges;
        }
    }
    return farthest * static_cast<double>(edges) / length;
}

std::vector<std::int8_t> levels_around(const Mesh& mesh, const Covered& covered, double edges,
                                       const Adjacency* adjacency) {
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    for (const auto& part : covered.parts)
        for (const Index n : part)
            if (n >= 0) level[n] = 0;
    const double rings = least_rings + std::ceil(rings_per_edge * std::min(edges, 1e3));
    spread_levels(mesh, level, std::min(most_rings, static_cast<int>(rings)), adjacency);
    return level;
}

Workpiece workpiece(const Edit& edit, const ReshapeOptions& options, const std::vector<std::int8_t>& level) {
    const Mesh& mesh = edit.mesh();
    ConstraintOptions constraints = edit.constraints();
    constraints.feature_angle = options.feature_angle;
    constraints.drifting_groups = drifting_groups(mesh, options.preserve);
    constraints.rounding = 2 * coordinate_rounding(mesh.points);
    Workpiece f{.d = Deformable(extract_band(mesh, level, edit.adjacency()), mesh, constraints), .tool = options.onto};
    f.tolerance = 1e-10 * f.d.constraints.geometry().size;
    f.d.tolerance = f.tolerance;
    for (const std::int8_t l : level)
        f.bandwidth = std::max<int>(f.bandwidth, static_cast<unsigned char>(std::max<std::int8_t>(l, 0)));
    f.distance.assign(static_cast<std::size_t>(f.d.band.size()), 0);
    check_input_shape(f, mesh);
    return f;
}

/// The band around the wall. What goes with the wall is added to `covered` and `following`.
Workpiece band_of(const Edit& edit, const ReshapeOptions& options, Covered& covered,
                  std::vector<std::array<Index, 3>>& following, const WallMotion& motion) {
    const Mesh& mesh = edit.mesh();
    const double edges = edges_moved(mesh, covered, motion);
    const std::size_t asked_for = covered.parts.size();
    for (;;) {
        Covered all = covered;
        all.parts.insert(all.parts.end(), following.begin(), following.end());
        Workpiece f = workpiece(edit, options, levels_around(mesh, all, edges, edit.adjacency()));
        const Beside beside = parts_beside(f, covered, following, options.feature_angle);
        if (beside.same.empty() && beside.following.empty()) {
            const auto warn = [&](std::size_t count, const char* what) {
                if (count > 0)
                    f.warnings.push_back(counted(static_cast<std::int64_t>(count), covered.faces ? "face" : "edge") +
                                         " beside the group moved with it: " + what);
            };
            warn(covered.parts.size() - asked_for, "they lie on the same surface");
            warn(following.size(), "they are tangent to it");
            return f;
        }
        covered.parts.insert(covered.parts.end(), beside.same.begin(), beside.same.end());
        following.insert(following.end(), beside.following.begin(), beside.following.end());
    }
}

/// Whether a node is on the wall itself, not only on what follows it.
bool leads(const Workpiece& f, const Wall& wall, int node) {
    return std::ranges::any_of(wall_tags(f.d.band, node), [&](int tag) { return !wall.patches[tag].follows; });
}

/// Adds the mid-side nodes of the wall's edges to the group of its nodes.
void add_middles(const Workpiece& f, const Wall& wall, Rebuilt& rebuilt, GroupIndex group) {
    Mesh& mesh = rebuilt.mesh;
    std::unordered_map<Index, int> band_node;
    for (int v = 0; v < f.d.band.size(); ++v)
        if (rebuilt.node[v] >= 0 && leads(f, wall, v)) band_node.emplace(rebuilt.node[v], v);
    for (const CellRef& c : rebuilt.after) {
        const CellTraits& t = traits(c.type);
        if (!t.quadratic) continue;
        const auto n = mesh.block(c.type).nodes(c.cell);
        for (std::size_t e = 0; e < t.edges.size(); ++e) {
            const auto a = band_node.find(n[t.edges[e][0]]), b = band_node.find(n[t.edges[e][1]]);
            if (a == band_node.end() || b == band_node.end() || !f.d.band.is_cut_edge(a->second, b->second)) continue;
            FamilyIndex& family = mesh.node_families[n[t.corners + static_cast<int>(e)]];
            family = mesh.families.with(family, group);
        }
    }
}

/// Throws ToolError when what moved of the skin passes through elements elsewhere.
void check_crossing(const Workpiece& f, const Wall& wall, const Rebuilt& rebuilt, const char* parameter) {
    const BandMesh& band = f.d.band;
    std::vector<std::array<Index, 3>> parts;
    const auto add = [&](const auto& list, bool all) {
        for (int s = 0; s < list.size(); ++s) {
            if (!list.alive(s)) continue;
            std::array<Index, 3> part{-1, -1, -1};
            bool moved = all;
            for (std::size_t k = 0; k < list[s].size(); ++k) {
                const BandNode& n = band.nodes[list[s][k]];
                part[k] = rebuilt.node[list[s][k]];
                moved = moved || n.at != n.start;
            }
            if (moved) parts.push_back(part);
        }
    };
    add(band.cut_faces, true);
    add(band.cut_edges, true);
    if (wall.faces) add(band.skin, false);
    const std::optional<CellRef> crossed = crossed_element(rebuilt.mesh, parts);
    if (!crossed) return;
    throw MotionError("the wall would pass through another part of the mesh, element " +
                          std::to_string(rebuilt.mesh.block(crossed->type).ids[crossed->cell]),
                      parameter, rebuilt.mesh.points[rebuilt.mesh.block(crossed->type).nodes(crossed->cell)[0]]);
}

Report report_of(const Edit& edit, const ReshapeOptions& options, Workpiece& f, Edited& edited) {
    const Mesh& before = edit.mesh();
    const Rebuilt& rebuilt = edited.rebuilt;
    Report report;
    report.operation = "reshape";
    report.name = options.name;
    report.method = "deform";
    report.transition = f.bandwidth;
    report.nodes_added = report.nodes_split = rebuilt.nodes_split;
    report.nodes_removed = rebuilt.nodes_removed;
    report.elements_added = rebuilt.elements_added;
    report.elements_removed = rebuilt.elements_removed;
    for (int v = 0; v < f.d.band.size(); ++v)
        if (const Index n = rebuilt.node[v]; n >= 0 && f.d.band.in_use(v)) {
            const bool wall = is_on_wall(f.d.band, v);
            if (wall || f.d.band.nodes[v].at != f.d.band.nodes[v].start)
                report.node_sets[wall ? "WALL" : "BAND"].push_back(rebuilt.mesh.node_ids[n]);
        }
    describe_changed(before, f, rebuilt, report);
    report.groups = compare_groups(before, edited.before, rebuilt.mesh, edited.after);
    describe_motion(f, before, edit.numbering().node, rebuilt, false, report);
    warn_of_emptied_groups(before, edit.meaningless(), report);
    report.warnings.insert(report.warnings.end(), f.warnings.begin(), f.warnings.end());
    std::ranges::move(warnings_of(edited.deck, options.strict), std::back_inserter(report.warnings));
    return report;
}

/// Throws MotionError where an element came out too poor to be of use.
void check_quality(const Rebuilt& rebuilt, const Report& report, const char* parameter) {
    const QualitySummary& after = report.quality_after;
    if (after.worst.empty() || after.minimum >= poor_limit(report.quality_before.minimum)) return;
    const Index id = after.worst.front().id;
    for (const CellRef& c : rebuilt.after) {
        const CellBlock& block = rebuilt.mesh.block(c.type);
        if (block.ids[c.cell] != id) continue;
        std::ostringstream text;
        text << "the wall would leave so little room for an element that it had a mean ratio of " << after.minimum;
        throw MotionError(text.str(), parameter, rebuilt.mesh.points[block.nodes(c.cell)[0]]);
    }
}

/// How far an attempt goes.
enum class Attempt {
    whole,
    look,  ///< whether there is a way (check_way()); the result has no mesh
};

/// On a mesh whose double nodes, if any, are single, and which has simplices alone around the wall.
Result reshape_simplices(const Mesh& input, Covered covered, const ReshapeOptions& options, const Naming& naming,
                         const Prepared& known, Attempt attempt) {
    Laps seconds;
    Stopwatch watch(seconds);
    WallMotion motion = motion_of(options);
    watch.lap("locate");
    Edit edit(input, known);
    if (input.companion) watch.lap("mark deck");
    const Mesh& mesh = edit.mesh();
    edit.start_copy();
    std::vector<std::array<Index, 3>> following;
    Workpiece f = band_of(edit, options, covered, following, motion);
    const std::vector<bool> drifting = drifting_groups(mesh, options.preserve);
    std::optional<DriftGauge> gauge;
    if (options.preserve) gauge.emplace(f.d.band, mesh, drifting);
    const Wall wall = release_wall(f, covered, following);
    go_on_beside(f, wall);
    find_tools(f, wall, motion);
    watch.lap("constraints");
    if (attempt == Attempt::look) {
        check_way(f, wall, motion, mesh);
        return {};
    }
    move_wall(f, wall, motion, mesh);
    check_shape(f, mesh);
    check_contacts(f);
    watch.lap("move");
    for (std::string& warning : warnings_of_opened_areas(f.d.band, mesh)) f.warnings.push_back(std::move(warning));
    Opening opening = no_opening(f.d.band);
    opening.removes = true;
    for (int v = 0; v < f.d.band.size(); ++v)
        if (f.d.band.in_use(v) && leads(f, wall, v)) opening.front_nodes.push_back(v);
    Edited edited = edit.finish(f, opening, naming, watch);
    check_crossing(f, wall, edited.rebuilt, motion.parameter);
    add_middles(f, wall, edited.rebuilt, *edited.rebuilt.mesh.find_group(naming.front, GroupKind::node));
    recount_nodes_and_facets(edited.after, edited.rebuilt.mesh);
    Result result{{}, report_of(edit, options, f, edited)};
    check_quality(edited.rebuilt, result.report, motion.parameter);
    if (gauge) describe_drift(*gauge, drifting, f.d.band, mesh, result.report);
    result.mesh = std::move(edited.rebuilt.mesh);
    if (known.stages)
        known.stages->push_back(std::move(edited.rebuilt.changes));
    else
        result.stages.push_back(std::move(edited.rebuilt.changes));
    if (!known.stages) remove_marks(result.mesh);
    watch.lap("report");
    result.report.seconds = seconds.list();
    return result;
}

/// How far the motion takes a group's nodes, in the mean length of the edges at them.
double edges_moved(const Mesh& mesh, const std::vector<char>& wall, const WallMotion& motion) {
    double farthest = 0, length = 0;
    Index edges = 0;
    for (std::size_t n = 0; n < wall.size(); ++n)
        if (wall[n]) {
            const Vec3& x = mesh.points[n];
            farthest =
                std::max(farthest, motion.onto ? std::abs(motion.onto->distance(x)) : (motion.carried(x) - x).norm());
        }
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (const auto& e : traits(b.type).edges) {
                if (!wall[n[e[0]]] || !wall[n[e[1]]]) continue;
                length += (mesh.points[n[e[0]]] - mesh.points[n[e[1]]]).norm();
                ++edges;
            }
        }
    return edges == 0 ? 0 : farthest * static_cast<double>(edges) / length;
}

/// Makes simplices of what else is around the wall first, as far as the band reaches.
Result reshape_on(const Mesh& input, const std::string& group, const ReshapeOptions& options, const Naming& naming,
                  const Prepared& known, Attempt attempt, std::optional<GroupIndex> weld = {}) {
    const auto on = [&](const Mesh& mesh, const Prepared& prepared) {
        return reshape_simplices(mesh, covered_by(mesh, find(mesh, group), weld), options, naming, prepared, attempt);
    };
    const bool simple =
        std::ranges::all_of(input.blocks(), [](const CellBlock& b) { return traits(b.type).simplex || b.size() == 0; });
    if (simple) return on(input, known);
    const std::vector<char> wall = nodes_of_group(input, find(input, group));
    const double edges = edges_moved(input, wall, motion_of(options));
    const double wanted = least_rings + std::ceil(rings_per_edge * std::min(edges, 1e3));
    for (int rings = std::min(most_rings, static_cast<int>(wanted));; rings *= 2) {
        const Stopwatch::Time started = Stopwatch::now();
        std::vector<std::int8_t> level(input.points.size(), -1);
        for (std::size_t n = 0; n < wall.size(); ++n) level[n] = wall[n] ? 0 : -1;
        spread_levels(input, level, std::min(rings, 2 * most_rings), known.adjacency);
        const std::optional<Refined> converted = simplify_first(input, level, known);
        if (!converted) return on(input, known);
        const double seconds = Stopwatch::since(started);
        const std::size_t stages = known.stages ? known.stages->size() : 0;
        if (known.stages) known.stages->push_back(converted->trace.changes);
        try {
            Result result = on(converted->mesh, known.renewed ? known.renewed(converted->mesh) : Prepared{});
            if (attempt == Attempt::whole) {
                add_conversion(*converted, options.strict, result.report);
                if (!known.stages) result.stages.insert(result.stages.begin(), converted->trace.changes);
            }
            result.report.seconds.insert(result.report.seconds.begin(), {"convert", seconds});
            return result;
        } catch (const UnsupportedElementError&) {
            // What moves with the wall reaches farther.
            if (rings > 2 * most_rings) throw;
            if (known.stages) known.stages->resize(stages);
        }
    }
}

/// On any mesh.
Result reshape_whole(const Mesh& input, const std::string& group, const ReshapeOptions& options, const Naming& naming,
                     const Prepared& known, Attempt attempt) {
    const bool looks = attempt == Attempt::look;
    if (SevenNodes seven(input); seven) {
        Result result = reshape_whole(seven.mesh(), group, options, naming, seven.known(), attempt);
        if (!looks) seven.finish(result);
        return result;
    }
    WeldFirst weld(input, known);
    if (weld) {
        Result result = reshape_on(weld.mesh(), group, options, naming, weld.known(), attempt, weld.faces());
        if (looks || weld.finish(result, options.strict)) return result;
    }
    return reshape_on(input, group, options, naming, known, attempt);
}

}  // namespace

Result reshape(const Mesh& input, const std::string& group, const ReshapeOptions& options, const Prepared& known) {
    const auto with_fields = [&](Result result) {
        follow_fields(input, false, result);
        return result;
    };
    check(options);
    Naming naming;
    naming.front = options.name + "_WALL";
    check_name(input, options.name, naming);
    (void)drifting_groups(input, options.preserve);  // whose names may be unknown
    const std::size_t stages = known.stages ? known.stages->size() : 0;
    const Stopwatch::Time started = Stopwatch::now();
    try {
        return with_fields(reshape_whole(input, group, options, naming, known, Attempt::whole));
    } catch (const MotionError& error) {
        if (known.stages) known.stages->resize(stages);
        const auto attempt = [&](Attempt attempt) {
            return [&, attempt](const ReshapeOptions& part) {
                (void)reshape_whole(input, group, part, naming, {}, attempt);
            };
        };
        const GroupIndex wall = find(input, group);
        const double search_time = std::clamp(search_to_failure * Stopwatch::since(started), least_search, most_search);
        const std::string advice =
            where_text(input, group, error) +
            advice_on_motion(input, wall, options, attempt(Attempt::look), attempt(Attempt::whole), search_time);
        throw ToolError(error.what() + advice, error.parameter());
    }
}

}  // namespace femscalpel
