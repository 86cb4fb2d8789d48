// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/operation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <unordered_set>

#include "cancel.h"
#include "cutting/checks.h"
#include "cutting/folded_input.h"
#include "cutting/held_inside.h"
#include "cutting/snap.h"
#include "deck/carry_over.h"
#include "deck/solver_input.h"
#include "groups/opened_areas.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"
#include "operators/poor.h"
#include "operators/refine_first.h"

namespace femscalpel {
namespace {

/// Code_Aster's limit for group names.
constexpr std::size_t longest_name = 24;

/// Part of the mesh or of a group that cutting the corners of a coarse skin may cost without a warning.
constexpr double size_noticed = 0.005;

/// A mesh that grows to more times its elements is worth a word.
constexpr Index most_growth = 4;

void check_name(const Mesh& mesh, const std::string& name, const std::vector<std::string>& suffixes) {
    if (name.empty()) throw ToolError("name is empty; the new groups need one");
    if (name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.") !=
        std::string::npos)
        throw ToolError(
            "name '" + name +
            "' has a character other than letters, digits, '_', '-' and '.'; solvers would not accept its groups");
    for (const std::string& suffix : suffixes) {
        const std::string group = name + suffix;
        if (group.size() > longest_name)
            throw ToolError("name '" + name + "' is too long: group '" + group + "' would have " +
                            std::to_string(group.size()) + " characters, at most " + std::to_string(longest_name) +
                            " are allowed");
        if (mesh.find_group(group))
            throw ToolError("name '" + name + "' is taken: the mesh already has a group '" + group +
                            "'; choose another");
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

/// Elements of the band's moving part before and after.
struct BandQuality {
    std::vector<ElementQuality> before, after;
};

BandQuality band_quality(const Workpiece& f, const Mesh& mesh) {
    const BandMesh& band = f.d.band;
    std::vector<char> in(static_cast<std::size_t>(band.size()), 0);
    for (const int v : f.nodes) in[v] = 1;
    for (const int v : f.transition) in[v] = 1;
    BandQuality out;
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

/// An element whose mean ratio fell below this part of what it was has become clearly worse.
constexpr double clearly_worse = 0.75;

/// Whether an element at a node is clearly worse than in the input.
bool became_worse(const Workpiece& f, const Mesh& mesh, int v) {
    const BandMesh& band = f.d.band;
    const auto fell = [&](double now, const CellRef& cell) {
        return now < clearly_worse * mean_ratio(mesh, cell.type, cell.cell);
    };
    return std::ranges::any_of(
               band.tetras.around(v),
               [&](int t) { return fell(tetra_quality(f.d, t), band.tetra_cells[band.tetras.origin(t)]); }) ||
           std::ranges::any_of(band.triangles.around(v), [&](int t) {
               return f.d.constraints.is_shell(band.triangles.origin(t)) &&
                      fell(shell_quality(f.d, t), band.triangle_cells[band.triangles.origin(t)]);
           });
}

/// Whether all of the surface or curve that a node keeps to lies on the tool around it: then there is no wedge between
/// them.
bool lies_on(const Workpiece& f, const Tool& tool, int v) {
    const BandMesh& band = f.d.band;
    const NodeConstraint& c = f.d.constraints[v];
    const auto on_tool = [&](const auto& list) {
        return std::ranges::all_of(list.around(v), [&](int s) {
            return list.tag(s) != c.shape || std::ranges::all_of(list[s], [&](int w) {
                       return std::abs(tool.distance(band.nodes[w].at)) <= 10 * f.tolerance;
                   });
        });
    };
    return c.freedom == NodeFreedom::curve ? on_tool(band.creases)
                                           : c.freedom == NodeFreedom::surface && on_tool(band.skin);
}

std::string degrees(double angle) {
    if (angle < 0.1) return "less than 0.1 degrees";
    std::ostringstream text;
    text.precision(2);
    text << angle << " degrees";
    return text.str();
}

/// Angles and gaps at which geometry alone, not the method, limits the quality near the tool. Only where elements have
/// become worse.
void warn_of_grazing(Workpiece& f, const Tool& tool, const Mesh& mesh) {
    const BandMesh& band = f.d.band;
    const auto angle = [](double sine) { return std::asin(std::min(1.0, sine)) * 180 / std::numbers::pi; };
    const auto counts = [&](int v) { return !lies_on(f, tool, v) && became_worse(f, mesh, v); };
    constexpr double narrow = 5;
    double smallest = narrow;
    SparseCheck check(256);
    for (const int v : f.nodes) {
        check();
        if (!f.d.contact[v].has(&tool)) continue;
        const auto normal = f.d.constraints.surface_normal(f.d.constraints[v], band.nodes[v].at);
        if (!normal) continue;
        const double here = angle(normal->cross(tool.normal(band.nodes[v].at)).norm());
        if (here < smallest && counts(v)) smallest = here;
    }
    if (smallest < narrow)
        f.warnings.push_back("the " + tool.kind() + " meets a surface or group border at " + degrees(smallest) +
                             ": elements in the wedge between them cannot be better than the wedge");
    double flattest = narrow;
    for (const auto* set : {&f.nodes, &f.transition})
        for (const int v : *set) {
            if (f.d.constraints[v].freedom != NodeFreedom::curve) continue;
            if (std::abs(tool.distance(band.nodes[v].at)) > 0.15 * band.mean_edge_length(v)) continue;
            Eigen::Matrix3d along;
            f.d.constraints.tangents(v, nullptr, band.nodes[v].at, along);
            const double here = angle(std::abs(along.col(0).dot(tool.normal(band.nodes[v].at))));
            if (here < flattest && counts(v)) flattest = here;
        }
    if (flattest < narrow)
        f.warnings.push_back("the " + tool.kind() + " runs along a feature line or border line at " +
                             degrees(flattest) + ": elements between them cannot be better than that wedge");
    // Nodes that stay on a surface nearly parallel to the tool, closer than 0.15 edge lengths.
    int near = 0;
    for (const int v : f.transition) {
        const auto normal = f.d.constraints.surface_normal(f.d.constraints[v], band.nodes[v].at);
        if (!normal || normal->cross(tool.normal(band.nodes[v].at)).norm() >= 0.15) continue;
        if (std::abs(tool.distance(band.nodes[v].at)) <= 0.15 * band.mean_edge_length(v) && counts(v)) ++near;
    }
    if (near > 0)
        f.warnings.push_back("the " + tool.kind() +
                             " runs within 0.15 edge lengths of a nearly parallel surface or group border at " +
                             std::to_string(near) + " node(s): the layer between them is that thin");
}

/// Surfaces that lie on each other, such as the lips of a crack that the mesh had already, are worked on each for
/// itself: their nodes may part.
void warn_of_parted_lips(Workpiece& f) {
    const BandMesh& band = f.d.band;
    const auto key = [](const Vec3& x) { return std::array{x[0], x[1], x[2]}; };
    // Nodes of the skin that lay on each other, and new ones between them.
    std::map<std::array<double, 3>, std::vector<int>> places;
    for (int v = 0; v < band.original_nodes(); ++v)
        if (!band.skin.around(v).empty()) places[key(band.nodes[v].start)].push_back(v);
    std::vector<char> twin(static_cast<std::size_t>(band.size()), 0);
    bool any = false;
    for (const auto& [place, nodes] : places)
        for (const int v : nodes) any = (twin[v] = nodes.size() > 1) || any;
    if (!any) return;
    for (int v = band.original_nodes(); v < band.size(); ++v) {
        const BandMesh::Birth& birth = band.births[v - band.original_nodes()];
        twin[v] = twin[birth.a] && twin[birth.b] && band.in_use(v) && !band.skin.around(v).empty();
    }
    std::vector<Vec3> at;
    for (int v = 0; v < band.size(); ++v)
        if (twin[v] && band.in_use(v)) at.push_back(band.nodes[v].at);
    std::ranges::sort(at, {}, key);
    int alone = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
        const auto near = [&](std::size_t j) { return j < at.size() && (at[j] - at[k]).norm() <= 10 * f.tolerance; };
        alone += !near(k - 1) && !near(k + 1);
    }
    if (alone > 0)
        f.warnings.push_back(
            "near the tool, surfaces of the mesh that lie on each other (a contact, the lips of an earlier crack) keep "
            "their shape, but no longer match node for node (" +
            std::to_string(alone) + " nodes): what joins coincident nodes there has to be made anew");
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

void count_constraints(const Workpiece& f, const std::vector<Blade>& blades, Report& report) {
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

/// Calls visit(index, record) for each group of the input that is not hidden: their records come first, in order.
void for_each_record(const Mesh& before, Report& report, auto visit) {
    std::size_t record = 0;
    for (std::size_t g = 0; g < before.groups.size(); ++g)
        if (!before.groups[g].hidden) visit(g, report.groups[record++]);
}

/// Beyond what tools take, and drifting borders hand over, only the corners between the facets of a curved skin can get
/// lost, when their nodes move: warns where that is much of the mesh or of a group. (With the shape of the skin given,
/// what changes is the error of the facets: this is not for that.) `whole` is the mesh before, of which `totals` are;
/// `before` may be its band alone.
void warn_of_changed_size(const Mesh& whole, const Mesh& before, const FamilyTotals& totals, const FamilyTotals& after,
                          const Workpiece& f, const std::vector<bool>& unjudged, Report& report) {
    const int dimension = whole.dimension();
    const auto all = [&](const FamilyTotals& t) {
        double sum = 0;
        for (const FamilyTotals::Entry& e : t.by_family) sum += e.measure[dimension];
        return sum;
    };
    std::vector<double> taken(static_cast<std::size_t>(before.families.size()), 0);
    double taken_in_all = 0;
    const auto take = [&](const CellRef& c, double measure) {
        if (traits(c.type).dimension != dimension) return;
        taken[before.block(c.type).families[c.cell]] += measure;
        taken_in_all += measure;
    };
    for (const auto& [cell, measure] : f.taken) take(cell, measure);
    for (const CellRef& c : f.deep_inside) take(c, cell_measure(before, c.type, c.cell));
    std::ostringstream message;
    message.precision(2);
    const auto look = [&](const std::string& name, double was, double change) {
        if (was > 0 && std::abs(change) > size_noticed * was)
            message << (message.tellp() > 0 ? ", " : "") << name << " by " << 100 * change / was << " %";
    };
    const double change = all(after) - all(totals) + taken_in_all;
    double was = all(totals);
    if (std::abs(change) > size_noticed * was)  // totals are without what is in no group
        for (const CellBlock& b : whole.blocks())
            for (Index c = 0; traits(b.type).dimension == dimension && c < b.size(); ++c)
                if (b.families[c] == 0) was += cell_measure(whole, b.type, c);
    look("the mesh", was, change);
    for_each_record(before, report, [&](std::size_t g, const GroupRecord& r) {
        if (r.kind != GroupKind::element || (!unjudged.empty() && unjudged[g])) return;
        if (r.dimension != dimension) {
            // Faces and edges on a crack count twice, and what was removed of them is not known: what shrinks
            // otherwise.
            if (r.dimension > 0 && taken_in_all == 0 && r.measure_after < r.measure_before)
                look("'" + r.name + "'", r.measure_before, r.measure_after - r.measure_before);
            return;
        }
        double taken_of_group = 0;
        for (FamilyIndex k = 0; k < static_cast<FamilyIndex>(taken.size()); ++k)
            if (taken[k] != 0 && before.families.contains(k, static_cast<GroupIndex>(g))) taken_of_group += taken[k];
        look("'" + r.name + "'", r.measure_before, r.measure_after - r.measure_before + taken_of_group);
    });
    if (message.tellp() > 0)
        report.warnings.push_back("a curved surface is coarse, and moving its nodes changed the size of " +
                                  message.str() + (taken_in_all > 0 ? ", beyond what was removed" : "") +
                                  ": give its shape (skin), a smaller feature_angle, which keeps the edges between its "
                                  "facets, or refine the mesh there first");
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

/// Groups that are scattered through the material hold nodes everywhere: warns where these are many and the elements
/// came out poor.
void warn_of_held_nodes(const Workpiece& f, const Mesh& before, Report& report) {
    constexpr double poor = 0.2, fallen = 0.6;  // mean ratio; part of what it was before
    constexpr std::size_t named = 5;
    const double was = report.quality_before.minimum, is = report.quality_after.minimum;
    if (is >= poor || is >= fallen * was) return;
    const HeldInside held = held_inside(f);
    if (!held.many()) return;
    const auto counts = f.d.constraints.count_by_group(f.d.band, held.nodes, before.groups.size());
    std::vector<std::pair<Index, GroupIndex>> most;
    for (std::size_t g = 0; g < before.groups.size(); ++g)
        if (const Index n = counts[g].line + counts[g].fixed; n > 0 && !before.groups[g].hidden)
            most.push_back({-n, static_cast<GroupIndex>(g)});
    if (most.empty()) return;
    std::ranges::sort(most);
    std::ostringstream message;
    message.precision(2);
    message << "borders of groups inside the material hold " << held.nodes.size() << " of " << held.inside
            << " nodes near the tool, where the lowest mean ratio fell from " << was << " to " << is
            << ": most are on those of ";
    for (std::size_t k = 0; k < most.size() && k < named; ++k)
        message << (k > 0 ? ", " : "") << "'" << before.groups[most[k].second].name << "' (" << -most[k].first << ")";
    if (most.size() > named) message << " and of " << most.size() - named << " more groups";
    message << ". Give `preserve` without those whose borders need not keep their shape; they keep their elements all "
               "the same";
    report.warnings.push_back(message.str());
}

/// Of groups whose boundary was not kept: how far it went.
void describe_drift(const DriftGauge& gauge, const Workpiece& f, const Mesh& before, const std::vector<bool>& drifting,
                    Report& report) {
    const std::vector<double> drift = gauge.drift(f.d.band, before);
    for_each_record(before, report, [&](std::size_t g, GroupRecord& r) {
        if (!drifting[g]) return;
        r.boundary_kept = false;
        r.boundary_drift = drift[g];
    });
}

/// Of node groups whose boundary was kept, but for shortcuts: how far those went.
void describe_shortcuts(const DriftGauge& gauge, const Workpiece& f, const Mesh& before, Report& report) {
    const std::vector<double> drift = gauge.drift(f.d.band, before);
    for_each_record(before, report, [&](std::size_t g, GroupRecord& r) {
        if (r.kind == GroupKind::node) r.boundary_drift = std::max(r.boundary_drift, drift[g]);
    });
}

/// Moved nodes, boundary drift and losses of each group, by group index. Nodes from the number `first_new` on are not
/// the input's and do not count.
void describe_motion(const Workpiece& f, const Mesh& before, Index first_new, const Rebuilt& rebuilt, bool removes,
                     Report& report) {
    const BandMesh& band = f.d.band;
    struct Motion {
        Index moved = 0;
        Index nodes_gone = 0;
        double drift = 0;
        int last = -1;
    };
    std::vector<Motion> motion(before.groups.size());
    SparseCheck check;
    for (Index n = 0; n < before.node_count(); ++n, check()) {
        const Index now = rebuilt.kept_node(n);
        if (before.node_ids[n] >= first_new) continue;
        if (now < 0)
            for (const GroupIndex g : before.families.groups(before.node_families[n])) ++motion[g].nodes_gone;
        if (now < 0 || rebuilt.mesh.points[now] == before.points[n]) continue;
        ++report.nodes_moved;
        report.max_displacement =
            std::max(report.max_displacement, (rebuilt.mesh.points[now] - before.points[n]).norm());
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
        const bool smaller =
            r.measure_after < r.measure_before || (r.measure_before == 0 && r.count_after < r.count_before);
        if (removes && (motion[g].nodes_gone > 0 ||
                        (r.kind != GroupKind::node && smaller && (r.status == "changed" || r.measure_before == 0))))
            r.status = r.count_after == 0 ? "became empty" : "reduced";
        if (r.status == "kept" && motion[g].moved == 0 && !changed[g] && r.count_before == r.count_after)
            r.status = "untouched";
    }
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

void add_front(const Opening& opening, const std::string& name, Rebuilt& rebuilt) {
    if (opening.front_nodes.empty()) return;
    Mesh& mesh = rebuilt.mesh;
    const GroupIndex group = mesh.add_group(name, GroupKind::node);
    for (const int v : opening.front_nodes) {
        FamilyIndex& family = mesh.node_families[rebuilt.node[v]];
        family = mesh.families.with(family, group);
    }
}

}  // namespace

Operation::Operation(const char* kind, const Mesh& input, const OperatorOptions& options, const Prepared& prepared,
                     const std::vector<std::string>& suffixes, Stopwatch::Time started)
    : input_(input), options_(options), prepared_(prepared), watch_(seconds_, started) {
    report_.operation = kind;
    report_.name = options.name;
    report_.method = std::string(to_string(options.method));
    check_name(input, options.name, suffixes);
    if (options.transition && (*options.transition < 1 || *options.transition > 20))
        throw ToolError("transition is " + std::to_string(*options.transition) + "; it must be between 1 and 20");
    if (!(options.feature_angle > 0 && options.feature_angle < 180))
        throw ToolError("feature_angle must lie between 0 and 180 degrees");
    if (prepared.refined) seconds_.add("refine", prepared.refined->seconds);
    watch_.lap("locate");
    if (!prepared.marks) own_marks_ = mark_deck(input);
    marks_ = prepared.marks ? prepared.marks : &own_marks_;
    drifting_ = drifting_groups(mesh(), options.preserve);
    meaningless_ = groups_of(marks_->surface_sets, mesh());
    numbering_ = next_numbers(whole());
    if (prepared.refined) report_.warnings = prepared.refined->report.warnings;
    if (input.companion) watch_.lap("mark deck");
}

/// Makes the counts of the report those of refinement and operation together: what both made and removed does not
/// count.
void Operation::join_refinement(const Rebuilt& rebuilt) {
    const Refined& refined = *prepared_.refined;
    report_.refinement = refined.summary;
    Index nodes = 0, elements = 0;
    for (Index n = 0; n < mesh().node_count(); ++n)
        nodes += mesh().node_ids[n] >= refined.numbering.node && rebuilt.kept_node(n) < 0;
    std::set<Index> left;
    for (const CellRef& c : rebuilt.after) left.insert(rebuilt.mesh.block(c.type).ids[c.cell]);
    for (const CellRef& c : rebuilt.before)
        if (const Index id = mesh().block(c.type).ids[c.cell]; id >= refined.numbering.cell)
            elements += !left.contains(id);
    report_.nodes_split += refined.report.nodes_split - nodes;
    report_.nodes_added += refined.report.nodes_added - nodes;
    report_.nodes_removed -= nodes;
    report_.elements_added += refined.report.elements_added - elements;
    report_.elements_removed -= elements;
    for_each_record(mesh(), report_, [&, record = std::size_t{0}](std::size_t, GroupRecord& r) mutable {
        const GroupRecord& before = refined.report.groups[record++];
        r.count_before = before.count_before;
        r.measure_before = before.measure_before;
    });
}

/// Goes on with the elements of the band and those `removed` alone; these are given their places among them.
void Operation::crop_to_band(std::vector<CellRef>& removed) {
    CellLists cells = elements_near(whole(), location_.level, prepared_.adjacency);
    for (const CellRef& c : removed) cells[static_cast<int>(c.type)].push_back(c.cell);
    for (std::vector<Index>& list : cells) std::ranges::sort(list);
    for (CellRef& c : removed) {
        const std::vector<Index>& list = cells[static_cast<int>(c.type)];
        c.cell = std::ranges::lower_bound(list, c.cell) - list.begin();
    }
    part_ = crop(whole(), cells);
    prepared_.adjacency = nullptr;
    Location part{{}, {}, location_.tolerance, location_.rounding, location_.crossed};
    for (const Index n : part_->nodes) {
        part.distance.push_back(location_.distance[n]);
        part.level.push_back(location_.level[n]);
    }
    location_ = std::move(part);
}

/// Indices of nodes of the whole mesh (ascending) in mesh().
std::vector<Index> Operation::in_part(const std::vector<Index>& nodes) const {
    if (!part_) return nodes;
    std::vector<Index> out;
    for (std::size_t n = 0; n < part_->nodes.size(); ++n)
        if (std::ranges::binary_search(nodes, part_->nodes[n])) out.push_back(static_cast<Index>(n));
    return out;
}

Workpiece Operation::begin(std::span<const Blade> blades, const PickRemoved& pick_removed) {
    blades_.assign(blades.begin(), blades.end());
    // The output's copy and the group measures do not depend on the band: the second core makes them meanwhile.
    const bool copies = !options_.band_only, measures = prepared_.totals == nullptr;
    copy_ = async_obeying(copies || measures ? std::launch::async : std::launch::deferred, [this, copies, measures] {
        return std::pair(copies ? std::make_unique<Mesh>(whole()) : nullptr,
                         measures ? family_totals(whole()) : FamilyTotals());
    });
    int width = options_.transition.value_or(2);
    location_ = locate(mesh(), blades, width, prepared_.adjacency);
    if (!options_.transition && options_.method == Method::deform) {
        width = bandwidth(location_, mesh());
        if (width > 2) location_ = locate(mesh(), blades, width, prepared_.adjacency);
    }
    std::vector<CellRef> removed;
    if (pick_removed) removed = pick_removed(whole(), location_.level);
    if (options_.band_only) crop_to_band(removed);
    watch_.lap("locate");
    ConstraintOptions constraint_options;
    constraint_options.feature_angle = options_.feature_angle;
    constraint_options.drifting_groups = drifting_;
    constraint_options.meaningless = meaningless_;
    constraint_options.kept_hidden = marks_->kept;
    constraint_options.pinned = in_part(marks_->pinned);
    constraint_options.related = in_part(marks_->related);
    if (prepared_.refined) constraint_options.on_shortcuts = prepared_.refined->on_shortcuts;
    constraint_options.shape = options_.skin;
    constraint_options.tolerance = location_.tolerance;
    constraint_options.rounding = location_.rounding > location_.tolerance ? location_.rounding : 0;
    const Tool& first = *blades.front().tool;
    Workpiece f{.d = Deformable(extract_band(mesh(), location_.level, prepared_.adjacency), mesh(), constraint_options),
                .tool = &first,
                .tolerance = location_.tolerance,
                .bandwidth = width};
    f.deep_inside = std::move(removed);
    f.distance.resize(static_cast<std::size_t>(f.d.band.size()));
    check_cancelled();
    for (int v = 0; v < f.d.band.size(); ++v) {
        f.distance[v] = location_.distance[f.d.band.nodes[v].global];
        if (std::abs(f.distance[v]) > location_.rounding) continue;
        if (!blades.front().bound) put_on_tool(f, v, first);
        f.distance[v] = 0;
    }
    check_input_shape(f, mesh());
    check_skin(f);
    if (options_.preserve) gauge_.emplace(f.d.band, mesh(), drifting_);
    if (f.d.constraints.has_shortcuts())
        shortcuts_.emplace(DriftGauge::of_shortcuts(f.d.band, mesh(), drifting_, constraint_options.on_shortcuts));
    for (const Blade& b : blades) split_at_fixed_middles(f, b, mesh());
    watch_.lap("constraints");
    return f;
}

Result Operation::finish(Workpiece& f, const Opening& opening, const Naming& naming) {
    // Only nodes of opened faces count as interface; others merely happen to lie on the tool.
    std::vector<char> opened(static_cast<std::size_t>(f.d.band.size()), 0);
    for (const int v : opening.interface_nodes) opened[v] = 1;
    for (int v = 0; v < f.d.band.size(); ++v)
        if (!opened[v]) f.d.contact[v] = {};
    find_node_sets(f);
    add_moved_nodes(f);
    for (const Blade& b : blades_) warn_of_grazing(f, *b.tool, mesh());
    warn_of_parted_lips(f);
    report_.held = find_held_nodes(f, mesh());
    BandQuality quality = band_quality(f, mesh());
    report_.quality_before = summarise(std::move(quality.before));
    report_.quality_after = summarise(std::move(quality.after));
    report_.poor = find_poor_places(f, mesh(), report_.quality_before.minimum);
    for (std::string& warning : warnings_of_opened_areas(f.d.band, mesh())) f.warnings.push_back(std::move(warning));
    watch_.lap("open");
    put_back_middles(f, mesh());
    auto [output, own_totals] = await(copy_);
    if (part_) output = std::make_unique<Mesh>(mesh());
    const FamilyTotals& totals = prepared_.totals ? *prepared_.totals : own_totals;
    check_cancelled();
    Rebuilt rebuilt = rebuild(mesh(), std::move(*output), f, opening, naming.groups, numbering_, naming.front);
    if (opening.front_chains.empty()) add_front(opening, naming.front, rebuilt);
    if (!marks_->surface_sets.empty())
        renew_surface_sets(rebuilt.mesh, marks_->surface_sets, *solver_input(input_), rebuilt.after);
    watch_.lap("rebuild");
    std::vector<std::string> deck_warnings;
    if (input_.companion && !part_) {
        carry_deck(mesh(), rebuilt.mesh, rebuilt.changes, options_.strict, deck_warnings);
        watch_.lap("carry deck");
    }

    const auto exterior = [&](int v) { return f.d.constraints.is_exterior(v); };
    const auto interior = [&](int v) { return !f.d.constraints.is_exterior(v); };
    report_.transition = f.bandwidth;
    report_.node_sets[naming.sets[0]] = numbers(f.nodes, rebuilt.node, rebuilt.mesh, interior);
    report_.node_sets[naming.sets[1]] = numbers(f.nodes, rebuilt.node, rebuilt.mesh, exterior);
    report_.node_sets[naming.sets[2]] = numbers(f.transition, rebuilt.node, rebuilt.mesh, interior);
    report_.node_sets[naming.sets[3]] = numbers(f.transition, rebuilt.node, rebuilt.mesh, exterior);
    count_constraints(f, blades_, report_);
    add_middles(moved_middles(f.d.band, mesh(), rebuilt), f, mesh(), rebuilt, naming.sets, report_);
    report_.nodes_split = rebuilt.nodes_split;
    report_.nodes_doubled = rebuilt.nodes_doubled;
    report_.nodes_added = rebuilt.nodes_split + rebuilt.nodes_doubled;
    report_.nodes_removed = rebuilt.nodes_removed;
    report_.elements_added = rebuilt.elements_added;
    report_.elements_removed = rebuilt.elements_removed;
    FamilyTotals after = totals;
    count_cells(after, mesh(), rebuilt.before, -1);
    count_cells(after, rebuilt.mesh, rebuilt.after, +1);
    if (part_) {
        count_nodes_and_facets(after, mesh(), -1);
        count_nodes_and_facets(after, rebuilt.mesh, +1);
    } else {
        recount_nodes_and_facets(after, rebuilt.mesh);
    }
    report_.groups = compare_groups(mesh(), totals, rebuilt.mesh, after);
    // Sets that follow surfaces change with these; no size of theirs can get lost.
    std::vector<bool> unjudged = drifting_;
    if (unjudged.empty())
        unjudged = meaningless_;
    else
        for (std::size_t g = 0; g < meaningless_.size(); ++g) unjudged[g] = unjudged[g] || meaningless_[g];
    if (!options_.skin) warn_of_changed_size(whole(), mesh(), totals, after, f, unjudged, report_);
    const auto follows_surfaces = [&](const GroupRecord& g) {
        return std::ranges::any_of(marks_->surface_sets, [&](const SurfaceSet& s) {
            return mesh().groups[s.group].name == g.name && g.kind == GroupKind::element;
        });
    };
    for (const GroupRecord& g : report_.groups)
        if (g.status == "became empty" && !follows_surfaces(g))
            report_.warnings.push_back(std::string(to_string(g.kind)) + " group '" + g.name + "' loses all its " +
                                       std::to_string(g.count_before) + " member(s); it stays, empty");
    for (const std::vector<std::string>* warnings :
         std::initializer_list<const std::vector<std::string>*>{&f.warnings, &opening.warnings, &deck_warnings})
        for (const std::string& w : *warnings)
            if (std::ranges::find(report_.warnings, w) == report_.warnings.end()) report_.warnings.push_back(w);
    const bool refined = prepared_.refined && !prepared_.refined->tried_in_vain;
    const Index cells = whole().cell_count(), grown = cells + report_.elements_added - report_.elements_removed;
    if (!refined && grown > most_growth * cells)
        report_.warnings.push_back("the mesh grows from " + std::to_string(cells) + " to " + std::to_string(grown) +
                                   " elements: the " + blades_.front().tool->kind() +
                                   " crosses most of them, or passes close to surfaces or borders over much of it");
    if (refined) join_refinement(rebuilt);
    describe_motion(f, mesh(), refined ? prepared_.refined->numbering.node : numbering_.node, rebuilt, opening.removes,
                    report_);
    count_group_constraints(f, mesh(), report_);
    warn_of_held_nodes(f, mesh(), report_);
    if (gauge_) describe_drift(*gauge_, f, mesh(), drifting_, report_);
    if (!meaningless_.empty())
        for_each_record(mesh(), report_,
                        [&](std::size_t g, GroupRecord& r) { r.boundary_kept = r.boundary_kept && !meaningless_[g]; });
    if (shortcuts_) describe_shortcuts(*shortcuts_, f, mesh(), report_);
    remove_marks(rebuilt.mesh);
    watch_.lap("report");
    report_.seconds = seconds_.list();
    return {std::move(rebuilt.mesh), std::move(report_)};
}

}  // namespace femscalpel
