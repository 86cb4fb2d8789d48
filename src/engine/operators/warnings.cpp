// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "cancel.h"
#include "cutting/held_inside.h"
#include "mesh/quality.h"
#include "words.h"

namespace femscalpel {
namespace {

/// Part of the mesh or of a group that cutting the corners of a coarse skin may cost without a warning.
constexpr double size_noticed = 0.005;

/// A mesh that grows to more times its elements is an error.
constexpr Index most_growth = 4;
/// One of so few elements may.
constexpr Index small_mesh = 300;

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

/// What tools took of a mesh, by family and dimension: lengths, areas, volumes.
class Taken {
public:
    Taken(const Workpiece& f, const Mesh& before) : before_(before) {
        for (std::vector<double>& measures : taken_)
            measures.resize(static_cast<std::size_t>(before.families.size()), 0);
        for (const auto& [cell, measure] : f.taken) add(cell, measure);
        for (const CellRef& c : f.deep_inside) add(c, cell_measure(before, c.type, c.cell));
    }

    bool any() const { return any_; }

    double in_all(int dimension) const {
        double sum = 0;
        for (const double measure : taken_[dimension]) sum += measure;
        return sum;
    }

    double of_group(GroupIndex group, int dimension) const {
        double sum = 0;
        for (FamilyIndex k = 0; k < static_cast<FamilyIndex>(taken_[dimension].size()); ++k)
            if (taken_[dimension][k] != 0 && before_.families.contains(k, group)) sum += taken_[dimension][k];
        return sum;
    }

private:
    void add(const CellRef& c, double measure) {
        taken_[traits(c.type).dimension][before_.block(c.type).families[c.cell]] += measure;
        any_ = true;
    }

    const Mesh& before_;
    std::array<std::vector<double>, 4> taken_;
    bool any_ = false;
};

double size_of(const FamilyTotals& totals, int dimension) {
    double sum = 0;
    for (const FamilyTotals::Entry& e : totals.by_family) sum += e.measure[dimension];
    return sum;
}

}  // namespace

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
                             counted(near, "node") + ": the layer between them is that thin");
}
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

void warn_of_changed_size(const Mesh& whole, const Mesh& before, const FamilyTotals& totals, const FamilyTotals& after,
                          const Workpiece& f, const std::vector<bool>& unjudged, Report& report) {
    const int dimension = whole.dimension();
    const Taken taken(f, before);
    std::ostringstream message;
    message.precision(2);
    const auto look = [&](const std::string& name, double was, double change) {
        if (was > 0 && std::abs(change) > size_noticed * was)
            message << (message.tellp() > 0 ? ", " : "") << name << " by " << 100 * change / was << " %";
    };
    const double change = size_of(after, dimension) - size_of(totals, dimension) + taken.in_all(dimension);
    double was = size_of(totals, dimension);
    if (std::abs(change) > size_noticed * was)  // totals are without what is in no group
        for (const CellBlock& b : whole.blocks())
            for (Index c = 0; traits(b.type).dimension == dimension && c < b.size(); ++c)
                if (b.families[c] == 0) was += cell_measure(whole, b.type, c);
    look("the mesh", was, change);
    for_each_record(before, report, [&](std::size_t g, const GroupRecord& r) {
        if (r.kind != GroupKind::element || r.dimension == 0 || (!unjudged.empty() && unjudged[g])) return;
        const double by = r.measure_after - r.measure_before + taken.of_group(static_cast<GroupIndex>(g), r.dimension);
        // Faces and edges on a crack count twice: of them what shrinks.
        if (r.dimension == dimension || by < 0) look("'" + r.name + "'", r.measure_before, by);
    });
    if (message.tellp() > 0)
        report.warnings.push_back("a curved surface is coarse, and moving its nodes changed the size of " +
                                  message.str() + (taken.any() ? ", beyond what was removed" : "") +
                                  ": give its shape (skin), a smaller feature_angle, which keeps the edges between its "
                                  "facets, or refine the mesh there first");
}

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

std::string emptied_text(const GroupRecord& r) {
    return std::string(to_string(r.kind)) + " group '" + r.name +
           (r.count_before == 1 ? "' loses its only member; it stays, empty"
                                : "' loses all its " + std::to_string(r.count_before) + " members; it stays, empty");
}

void warn_of_emptied_groups(const Mesh& before, const std::vector<bool>& meaningless, Report& report) {
    for_each_record(before, report, [&](std::size_t g, const GroupRecord& r) {
        if (r.status == "became empty" && (meaningless.empty() || !meaningless[g]))
            report.warnings.push_back(emptied_text(r));
    });
}

void check_growth(Index cells, const Tool& tool, Report& report) {
    const Index grown = cells + report.elements_added - report.elements_removed;
    if (grown <= most_growth * cells) return;
    const std::string what = " from " + std::to_string(cells) + " to " + std::to_string(grown) + " elements: the " +
                             tool.kind() +
                             " crosses most of them, or passes close to surfaces or borders over much of it";
    const bool cuts = report.operation == "crack" || report.operation == "drill" || report.operation == "cut";
    if (cuts && cells > small_mesh)
        throw ToolError("the mesh would grow" + what + ". Turn the " + tool.kind() +
                        ", move it, or make smaller elements first, of which it crosses fewer (refine)");
    report.warnings.push_back("the mesh grows" + what);
}

}  // namespace femscalpel
