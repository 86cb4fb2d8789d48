// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "cancel.h"
#include "cutting/covered_faces.h"
#include "cutting/meeting.h"
#include "cutting/refill.h"
#include "cutting/surface_line.h"
#include "deck/adopt_sections.h"
#include "deck/carry_over.h"
#include "deck/mark_deck.h"
#include "deck/solver_input.h"
#include "mesh/band_mesh.h"
#include "mesh/order.h"
#include "mesh/stopwatch.h"
#include "mesh/surface.h"
#include "mesh/surface_tree.h"
#include "operators/attach.h"
#include "operators/driver.h"
#include "operators/follow_fields.h"
#include "operators/joint.h"
#include "operators/merge_checks.h"
#include "operators/merge_refining.h"
#include "operators/merge_report.h"
#include "operators/poor.h"
#include "operators/sections.h"
#include "operators/simplify_at_meeting.h"
#include "operators/simplify_first.h"
#include "operators/tie.h"
#include "operators/trim.h"
#include "operators/unfold.h"
#include "operators/unite.h"
#include "words.h"

namespace femscalpel {
namespace {

/// A triangle as near to the other's surface, in its edges, and as parallel (cosine), lies on it.
constexpr double on_each_other = 1e-3;
constexpr double parallel = 0.99;
/// Elements filled in with a smaller mean ratio than this are worth another attempt, and a word.
constexpr double poor = 0.12;
/// Edges of the one at the line may be so many times longer than those of the other; and where that comes to nothing or
/// to poor elements. The last is for lines that lie on each other as polygons of one circle do: finer edges part them.
constexpr double coarser[] = {2.5, 1.1, 0.3};
/// A mesh may be refined to so many times as many elements as it had: for the first attempt, or as long as none came to
/// anything; and only to make elements better.
constexpr double growth_to_meet = 20, growth_for_shape = 3;
/// Elements no worse than this part of those that were there are as good as these let them be: none of a thin plate, as
/// long as they are wide and much longer than thick, is a good one.
constexpr double as_thin = 0.7;

/// What to do where facets are in the way.
constexpr const char* about_facets =
    "Curved surfaces of the two lie on each other there as facets that are not the same, so that the one is now above, "
    "now below the other. Mesh both with the same number of elements around, or a multiple of it, or with smaller ones";

[[noreturn]] void fail_apart(const Mesh& mesh, const Mesh& addition) {
    check_within(mesh, addition);
    throw ToolError(
        "the addition does not meet the mesh: nowhere do their surfaces cross, and no border of the one is on the "
        "other. " +
            extents_text(mesh, addition) + ". Move the addition, or give a larger tolerance",
        "other");
}

void check(const Mesh& mesh, const Mesh& addition, const MergeOptions& options) {
    if (mesh.cell_count() == 0) throw ToolError("the mesh is empty: there is nothing to add to", "mesh");
    if (addition.cell_count() == 0) throw ToolError("the addition has no elements", "other");
    check_tolerance(mesh, addition, options.tolerance);
    if (options.tie && options.keep_side)
        throw ToolError("keep_side is for shells that pass through; what is tied only touches", "keep_side");
    if (addition.dimension() == 1 && options.tie)
        throw ToolError("beams are joined to a mesh by common nodes: use method='conform'", "method");
    if (addition.dimension() == 1 && options.keep_side)
        throw ToolError("keep_side is for shells that pass through, not for beams", "keep_side");
    if (mesh.dimension() < 2 || addition.dimension() < 1 || (addition.dimension() > mesh.dimension() && !options.tie))
        throw ToolError("an addition of dimension " + std::to_string(addition.dimension()) +
                            " cannot be joined to a mesh of dimension " + std::to_string(mesh.dimension()) +
                            ": shells and the ends of beams are joined to shells and to solids, solids to solids",
                        "other");
    if (options.refine.when == RefineFirst::When::to_size) {
        if (!(std::isfinite(options.refine.size) && options.refine.size > 0))
            throw ToolError("refine must be a positive length", "refine");
        if (options.tie || addition.dimension() == 1)
            throw ToolError(options.tie ? "refine is not for method='tie', by which both stay as they are"
                                        : "refine is not for beams, which need no finer mesh",
                            "refine");
    }
    if (addition.dimension() == 3 && options.keep_side)
        throw ToolError("keep_side is for shells; of solids, keep says what is cut off", "keep_side");
}

/// Throws ToolError when shells lie on each other over an area: they would be joined along its outline alone.
void check_overlap(const Mesh& mesh, const Mesh& addition) {
    Eigen::AlignedBox3d box = box_around(addition);
    box = grown(box, 1e-3 * box.diagonal().norm());
    const std::vector<SurfaceFace> faces = surface_near(mesh, box), own = surface_near(addition, box);
    const SurfaceTree tree(mesh, faces), of_addition(addition, own);
    Index count = 0;
    Vec3 first = Vec3::Zero();
    SparseCheck check(64);
    for (std::size_t f = 0; f < own.size() && !faces.empty(); ++f, check()) {
        const auto& n = own[f].nodes;
        const Vec3 middle = (addition.points[n[0]] + addition.points[n[1]] + addition.points[n[2]]) / 3;
        const SurfaceTree::Foot foot = tree.closest(middle);
        const int face = static_cast<int>(f);
        if (foot.distance > on_each_other * of_addition.size(face) ||
            std::abs(tree.normal(foot.piece).dot(of_addition.normal(face))) < parallel)
            continue;
        if (count++ == 0) first = middle;
    }
    if (count > 0)
        throw ToolError(std::to_string(count) + " triangles of the addition lie on the mesh's surface, the first at " +
                            point_text(first) +
                            ": shells are joined along lines. Move the addition off, or leave that part of it out",
                        "other");
}

/// Throws ToolError when a group that the operator makes has a name already, or none that solvers accept.
void check_names(const Mesh& mesh, const Mesh& addition, const std::string& name, bool tie) {
    const std::vector<const char*> made =
        tie ? std::vector{"_TIE_MESH", "_TIE_ADDED", "_ADDED"} : std::vector{"_SEAM", "_ADDED"};
    for (const char* suffix : made) {
        Naming naming;
        naming.front = name + suffix;
        check_name(mesh, name, naming);
        if (addition.find_group(naming.front))
            throw ToolError(
                "name '" + name + "' is taken: the addition already has a group '" + naming.front + "'; choose another",
                "name");
    }
}

Index count_of(const Mesh& mesh, std::string_view type) {
    Index out = 0;
    for (const CellBlock& b : mesh.blocks())
        if (traits(b.type).name == type) out += b.size();
    return out;
}

/// The report on the mesh, with what the addition brings.
Report report_of(const Mesh& input, const Mesh& addition, Joint& joint, const Mesh& result, const std::string& added,
                 Index shared) {
    Report out = std::move(joint.report(0));
    const Report& other = joint.report(1);
    out.groups = merged_records(input, result, out.groups);
    describe_joined(input, addition, result, added, out);
    out.nodes_added += joint.mesh(1).node_count() - shared;
    out.elements_added += joint.mesh(1).cell_count();
    for (const auto& [type, count] : other.converted) out.converted[type] += count;
    // Pyramids may have been made by the first of several conversions.
    for (auto& [type, count] : out.converted) count = std::min(count, count_of(input, type) + count_of(addition, type));
    std::erase_if(out.converted, [](const auto& entry) { return entry.second == 0; });
    for (const std::string& w : other.warnings) out.warnings.push_back("the addition: " + w);
    out.straightened.count += other.straightened.count;
    out.straightened.largest = std::max(out.straightened.largest, other.straightened.largest);
    std::ranges::copy(other.poor, std::back_inserter(out.poor));
    join_warnings_about_stiffness(out.warnings);
    join_warnings_about_the_seam(out.warnings);
    return out;
}

/// The two as one mesh.
struct United {
    Mesh mesh;
    std::vector<std::string> warnings;
    double worst = 1;                              ///< smallest mean ratio of what was filled in
    std::vector<Index> seam;                       ///< nodes that both have
    std::vector<std::array<Index, 2>> seam_edges;  ///< of shells
};

/// Adds the group of the addition's elements.
std::string add_group_added(Mesh& mesh, const MergeOptions& options) {
    std::string name = options.name + "_ADDED";
    mesh.add_group(name, GroupKind::element);
    return name;
}

United unite_shells(Joint& joint, const MergeOptions& options) {
    United out;
    out.mesh = std::move(joint.mesh(0));
    std::vector<Index> shared(joint.mesh(1).points.size(), -1);
    for (const JointLine& line : joint.lines())
        for (std::size_t k = 0; k < line.stops.size(); ++k) {
            const auto& node = line.stops[k].node;
            shared[node[1]] = node[0];
            if (k + 1 < line.stops.size() || line.closed)
                out.seam_edges.push_back({node[0], line.stops[(k + 1) % line.stops.size()].node[0]});
        }
    if (options.keep_side) {
        Crop kept = trimmed(joint.mesh(1), joint.lines(), *options.keep_side);
        std::vector<Index> shared_kept;
        shared_kept.reserve(kept.nodes.size());
        for (const Index n : kept.nodes) shared_kept.push_back(shared[n]);
        kept.mesh.companion = joint.mesh(1).companion;
        joint.mesh(1) = std::move(kept.mesh);
        shared = std::move(shared_kept);
    }
    unite(out.mesh, joint.mesh(1), shared, add_group_added(out.mesh, options), names_of(options));
    return out;
}

/// Says which borders of groups are uneven now, as elements were filled in across them.
void warn_of_borders(const Mesh& fitted, const CrossedBorders& borders, const std::string& whose, United& out) {
    const auto names = [&](const std::set<GroupIndex>& groups) {
        std::string text;
        for (const GroupIndex g : groups) text += (text.empty() ? "'" : ", '") + fitted.groups[g].name + "'";
        return text;
    };
    if (!borders.groups.empty())
        out.warnings.push_back(whose + "the border of " + names(borders.groups) +
                               " runs through where elements were filled in, as near " + point_text(borders.at) +
                               ", and is uneven there: what fills is in the groups of what was nearest before");
    if (borders.lost > 0)
        out.warnings.push_back(whose + counted(borders.lost, "face") + " of " + names(borders.faces) +
                               (borders.lost == 1 ? " is" : " are") + " gone, as near " + point_text(borders.at) +
                               ": inside, between elements that gave way to what was filled in");
}

/// One of the two is fitted to the other's skin where they meet.
United unite_solids(Joint& joint, double tolerance, const MergeOptions& options) {
    const std::size_t base = options.keep_addition ? 1 : 0, fitted = 1 - base;
    std::array<std::vector<std::array<Index, 2>>, 2> outline;
    std::vector<Index> partner(joint.mesh(fitted).points.size(), -1);
    for (const JointLine& line : joint.lines())
        for (std::size_t k = 0; k < line.stops.size(); ++k) {
            const JointLine::Stop& stop = line.stops[k];
            partner[stop.node[fitted]] = stop.node[base];
            if (k + 1 == line.stops.size() && !line.closed) continue;
            const JointLine::Stop& next = line.stops[(k + 1) % line.stops.size()];
            for (const std::size_t m : {0U, 1U}) outline[m].push_back({stop.node[m], next.node[m]});
        }
    const double close = std::max(tolerance, 1e-9 * box_around(joint.mesh(base)).diagonal().norm());
    const auto covered = [&](std::size_t m) {
        return covered_faces(joint.mesh(m), joint.mesh(1 - m), outline[m], close, m == fitted);
    };
    const std::vector<SurfaceFace> cover = covered(base), gone = covered(fitted);
    if (gone.size() == surface_near(joint.mesh(fitted), box_around(joint.mesh(fitted))).size())
        throw ToolError(
            std::string(fitted == 1 ? "the addition lies inside the mesh" : "the mesh lies inside the addition") +
                ": nothing of it would be left. Move the addition so that it "
                "reaches through the skin",
            "other");
    United out;
    if (fitted == 1) {
        Refilled refilled = refill(joint.mesh(1), joint.mesh(0), partner, gone, cover);
        out.warnings = warnings_of(carry_deck(joint.mesh(1), refilled.mesh, refilled.changes), options.strict);
        for (const std::string& group : emptied_groups(joint.mesh(1), refilled.mesh))
            out.warnings.push_back("the addition: group '" + group +
                                   "' is empty now: all that it had is where the two meet");
        warn_of_borders(joint.mesh(1), refilled.borders, "the addition: ", out);
        out.mesh = std::move(joint.mesh(0));
        out.worst = refilled.worst;
        unite(out.mesh, refilled.mesh, refilled.partner, add_group_added(out.mesh, options), names_of(options));
        return out;
    }
    const DeckMarks marks = mark_deck(joint.mesh(0));
    const Mesh& input = marks.mesh ? *marks.mesh : joint.mesh(0);
    Refilled refilled = refill(input, joint.mesh(1), partner, gone, cover);
    if (!marks.surface_sets.empty())
        renew_surface_sets(refilled.mesh, marks.surface_sets, *solver_input(input), refilled.added);
    out.warnings = warnings_of(carry_deck(input, refilled.mesh, refilled.changes), options.strict);
    remove_marks(refilled.mesh);
    warn_of_borders(input, refilled.borders, "", out);
    out.worst = refilled.worst;
    std::vector<Index> shared(joint.mesh(1).points.size(), -1);
    for (Index n = 0; n < refilled.mesh.node_count(); ++n)
        if (refilled.partner[n] >= 0) shared[refilled.partner[n]] = n;
    out.mesh = std::move(refilled.mesh);
    unite(out.mesh, joint.mesh(1), shared, add_group_added(out.mesh, options), names_of(options));
    return out;
}

/// An attempt, and what it is made of.
struct Joined {
    std::unique_ptr<MergeRefining> refined;
    std::unique_ptr<Joint> joint;
    United united;

    /// The smallest mean ratio by the line that there was.
    double input() const {
        return std::min(joint->report(0).quality_before.minimum, joint->report(1).quality_before.minimum);
    }

    /// The smallest mean ratio of what was filled in or, by the line, made worse than it was.
    double worst() const {
        double out = united.worst;
        for (const std::size_t m : {0U, 1U}) {
            const Report& report = joint->report(m);
            if (report.quality_after.minimum < 0.999 * report.quality_before.minimum)
                out = std::min(out, report.quality_after.minimum);
        }
        return out;
    }
};

/// One attempt, with elements at the line no more than `longer` times as long as the other's, and no more than `growth`
/// times as many.
Joined join_once(const Mesh& mesh, const Mesh& addition, Meeting meeting, double longer, double growth,
                 const MergeOptions& options, const Knowledge& known) {
    Joined out;
    out.refined = std::make_unique<MergeRefining>(mesh, addition, options);
    MergeRefining& refined = *out.refined;
    refined.run(meeting.lines, longer, growth, known);
    // Smaller elements do not make what is off a curved surface nearer.
    if (refined.any())
        meeting = find_meeting(refined.mesh(0), refined.mesh(1),
                               meeting.tolerance > 0 ? meeting.tolerance : options.tolerance);
    std::vector<JointLine> lines;
    lines.reserve(meeting.lines.size());
    for (const MeetingLine& line : meeting.lines) lines.push_back(line_of(line, refined.mesh(0)));
    out.joint = std::make_unique<Joint>(refined.mesh(0), refined.mesh(1), std::move(lines), options);
    out.joint->run(&refined.mesh(0) == &mesh ? known[0] : Prepared{});
    check_cancelled();
    for (const std::size_t m : {0U, 1U}) refined.join(m, out.joint->report(m));
    const bool solids = mesh.dimension() == 3 && addition.dimension() == 3;
    out.united = solids ? unite_solids(*out.joint, meeting.tolerance, options) : unite_shells(*out.joint, options);
    unfold(out.united.mesh, {&mesh, &addition});
    out.united.seam = shared_nodes(out.united.mesh, options.name + "_ADDED");
    std::vector<PoorPlace> said = out.joint->report(0).poor;
    std::ranges::copy(out.joint->report(1).poor, std::back_inserter(said));
    check_poorest(poorest_at(out.united.mesh, out.united.seam), out.input(), said,
                  "The skins of the two meet at a sharp angle there, or their nodes lie close to each other. Move the "
                  "addition a little, or refine the coarser one there first",
                  "other");
    return out;
}

/// Where elements of different sizes meet badly, tries again with smaller ones.
Joined join(const Mesh& mesh, const Mesh& addition, const Meeting& meeting, const MergeOptions& options,
            const Knowledge& known) {
    std::optional<Joined> best;
    std::exception_ptr first;
    const bool automatic = options.refine.when == RefineFirst::When::automatic;
    for (const double longer : coarser) {
        try {
            Joined next =
                join_once(mesh, addition, meeting, longer, best ? growth_for_shape : growth_to_meet, options, known);
            if (!best || next.worst() > best->worst()) best = std::move(next);
        } catch (const QualityError&) {
            if (!first) first = std::current_exception();
        } catch (const ToolError& error) {
            // Too many elements are none to begin with, but no reason to give up what there is.
            if ((!best && !first) || std::string_view(error.parameter()) != "refine") throw;
            break;
        }
        if (!automatic || (best && best->worst() >= std::min(poor, as_thin * best->input()))) break;
    }
    if (best) return std::move(*best);
    try {
        std::rethrow_exception(first);
    } catch (const QualityError& error) {
        if (!meeting.facets) throw;
        throw QualityError(std::string(error.what()) + ". " + about_facets, error.parameter());
    }
}

/// The two with simplices alone where they meet.
struct Simplices {
    std::array<const Mesh*, 2> mesh;
    std::array<std::optional<Refined>, 2> converted;
    Knowledge known;
    Meeting meeting;

    Simplices(const Mesh& first, const Mesh& addition, Meeting met, const MergeOptions& options,
              const Prepared& known_of_first)
        : mesh{&first, &addition}, known{known_of_first, {}}, meeting(std::move(met)) {
        const std::size_t fitted = options.keep_addition ? 0 : 1;
        for (const std::size_t m : {0U, 1U})
            converted[m] =
                simplify_at_meeting(*mesh[m], m == 0 ? addition : first, meeting.lines, m == fitted, options, known[m]);
        for (const std::size_t m : {0U, 1U})
            if (converted[m]) {
                mesh[m] = &converted[m]->mesh;
                known[m] = {};
            }
        if (converted[0] || converted[1]) meeting = find_meeting(*mesh[0], *mesh[1], options.tolerance);
    }
};

/// Throws QualityError where more than two solids have a face at the seam, or half a quadrangle is another's face: a
/// mesh that only looks right.
void check_seam(const Mesh& mesh, const std::vector<Index>& seam) {
    const auto at_seam = [&](Index n) { return std::ranges::binary_search(seam, n); };
    const auto fail = [&](Index node) {
        throw QualityError("the two solids cannot be joined at " + point_text(mesh.points[node]) +
                               ": they would overlap there. Move the addition a little",
                           "other");
    };
    std::map<FaceKey, int> faces;
    std::vector<std::array<Index, 4>> quadrangles;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension != 3) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (std::none_of(n.begin(), n.begin() + t.corners, at_seam)) continue;
            for (const auto& f : t.faces) {
                if (f[3] >= 0) {
                    quadrangles.push_back({n[f[0]], n[f[1]], n[f[2]], n[f[3]]});
                    continue;
                }
                const FaceKey key = face_key({n[f[0]], n[f[1]], n[f[2]]});
                if (++faces[key] > 2) fail(key[0]);
            }
        }
    }
    for (const auto& q : quadrangles)
        for (std::size_t k = 0; k < 4; ++k)
            if (faces.contains(face_key({q[k], q[(k + 1) % 4], q[(k + 2) % 4]}))) fail(q[k]);
}

}  // namespace

UniteNames names_of(const MergeOptions& options) {
    return {options.prefix.empty() ? options.name + "_" : options.prefix, options.join_groups};
}

namespace {

Result merge_meshes(const Mesh& mesh, const Mesh& other, const MergeOptions& options, const Prepared& known) {
    Stopwatch::Time started = Stopwatch::now();
    check(mesh, other, options);
    check_names(mesh, other, options.name, options.tie);
    check_characters(options.prefix, "prefix");
    if (options.tie) return tie(mesh, other, options);
    Mesh addition = is_second_order(mesh) ? to_second_order(other) : to_first_order(other);
    const std::vector<std::string> left_out = reduce_to_sections(mesh, addition);
    if (addition.dimension() == 1) {
        Result out = attach_beams(mesh, addition, options, known);
        check_pieces(out.mesh, options.name);
        std::ranges::copy(left_out, std::back_inserter(out.report.warnings));
        return out;
    }
    check_itself(addition);
    Meeting meeting = find_meeting(mesh, addition, options.tolerance);
    if (meeting.lines.empty()) fail_apart(mesh, addition);
    if (addition.dimension() == 2) check_overlap(mesh, addition);
    const bool solids = mesh.dimension() == 3 && addition.dimension() == 3;
    const Simplices simple(mesh, addition, std::move(meeting), options, known);
    Joined joined = join(*simple.mesh[0], *simple.mesh[1], simple.meeting, options, simple.known);
    for (const std::size_t m : {0U, 1U})
        if (simple.converted[m]) add_conversion(*simple.converted[m], options.strict, joined.joint->report(m));
    United& united = joined.united;
    Result out;
    out.mesh = std::move(united.mesh);
    const std::vector<Index>& seam = united.seam;
    if (solids)
        check_seam(out.mesh, seam);
    else
        check_seam_edges(out.mesh, options.name + "_ADDED", united.seam_edges);
    add_seam(out.mesh, options.name, seam);
    check_pieces(out.mesh, options.name);
    out.report =
        report_of(mesh, addition, *joined.joint, out.mesh, options.name + "_ADDED", static_cast<Index>(seam.size()));
    std::ranges::move(united.warnings, std::back_inserter(out.report.warnings));
    std::ranges::copy(left_out, std::back_inserter(out.report.warnings));
    if (united.worst < poor) {
        std::ostringstream text;
        text << "an element that was filled in where the two meet has a mean ratio of " << united.worst
             << ": their skins meet at a sharp angle, or nodes lie close to each other there. Move the addition a "
                "little, or refine the coarser one there first";
        if (united.worst < poor_limit(out.report.quality_before.minimum)) throw QualityError(text.str(), "other");
        out.report.warnings.push_back(text.str());
    }
    if (options.join_groups) warn_of_joined_groups(mesh, addition, out.report);
    if (!solids && mesh.dimension() == 3) warn_of_hinge(out.report);
    warn_of_sections(mesh, out.mesh, options.name + "_ADDED", out.report);
    if (!solids && mesh.dimension() == 3) warn_of_inside(mesh, out.mesh, options.name + "_ADDED", out.report);
    if (solids) warn_of_buried(out.mesh, options.name + "_ADDED", out.report);
    out.report.seconds = {{"merge", Stopwatch::since(started)}};
    return out;
}

}  // namespace

Result merge(const Mesh& mesh, const Mesh& other, const MergeOptions& options, const Prepared& known) {
    Result out = merge_meshes(mesh, other, options, known);
    follow_fields(mesh, options.band_only, out, options.name + "_ADDED");
    if (other.fields)
        for (const Field& field : other.fields->fields)
            out.report.warnings.push_back("the addition's field '" + field.name + "' is left behind: what is added " +
                                          "has no values");
    return out;
}

}  // namespace femscalpel
