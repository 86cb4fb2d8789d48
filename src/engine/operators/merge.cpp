// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "cancel.h"
#include "cutting/covered_faces.h"
#include "cutting/meeting.h"
#include "cutting/refill.h"
#include "mesh/band_mesh.h"
#include "mesh/order.h"
#include "mesh/surface.h"
#include "operators/refine_first.h"
#include "operators/seam.h"
#include "operators/unite.h"
#include "tools/ribbon.h"

namespace femscalpel {
namespace {

/// A node of the one nearer to a node of the other than this, in the shortest edge of the line there, is the same.
constexpr double same_node = 0.25;
/// Cosine of the angle by which a line bends where it is to have a node.
const double bend = std::cos(6 * M_PI / 180);
/// How often the two may be divided where the other was.
constexpr int most_rounds = 4;
/// Edges of the one at the line may be so many times longer than those of the other.
constexpr double coarser = 2.5;
/// And no longer than this part of a closed line.
constexpr double of_length = 0.12;

std::string point_text(const Vec3& x) {
    std::ostringstream out;
    out << "(" << x.transpose() << ")";
    return out.str();
}

/// A line in which the two meshes meet, and which nodes it has of each by now.
struct Line {
    std::array<std::unique_ptr<Ribbon>, 2> standing;  ///< through the meeting's points, on the surface of each
    bool closed = false;
    /// Places where both are to have a node, along the line, and the nodes there, or -1.
    struct Stop {
        Vec3 at;
        std::array<Index, 2> node;
    };
    std::vector<Stop> stops;
};

/// Whether a point is an end of a line, or where a closed one begins.
bool is_end(const MeetingLine& line, std::size_t point) {
    return point == 0 || (!line.closed && point + 1 == line.points.size());
}

/// Whether a line bends at a point.
bool is_bend(const MeetingLine& line, std::size_t point) {
    const std::size_t n = line.points.size();
    if (is_end(line, point)) return false;
    const Vec3 in = line.points[point].at - line.points[(point + n - 1) % n].at,
               out = line.points[(point + 1) % n].at - line.points[point].at;
    return in.normalized().dot(out.normalized()) < bend;
}

/// The places of a meeting where nodes are to be: its ends, where it bends, and where one of the meshes has one; of
/// places that are nearer to each other than edges there should be, one.
std::vector<Line::Stop> stops_of(const MeetingLine& line, const Mesh& mesh) {
    std::vector<std::size_t> points;
    for (std::size_t k = 0; k < line.points.size(); ++k)
        if (is_end(line, k) || is_bend(line, k) || line.points[k].node[0] >= 0 || line.points[k].node[1] >= 0)
            points.push_back(k);
    // How far it is to the next node of the same mesh.
    const auto room = [&](std::size_t i, std::size_t mesh) {
        double out = std::numeric_limits<double>::infinity();
        for (const std::size_t k : points)
            if (k != points[i] && line.points[k].node[mesh] >= 0)
                out = std::min(out, (line.points[k].at - line.points[points[i]].at).norm());
        return out;
    };
    std::vector<Line::Stop> stops;
    std::vector<double> rooms;
    std::vector<char> fixed;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const MeetingLine::Point& p = line.points[points[i]];
        double own = std::min(p.size[0], p.size[1]);
        for (const std::size_t m : {0U, 1U})
            if (p.node[m] >= 0) own = std::min(own, room(i, m));
        // The mesh stays as it is.
        const Line::Stop stop{p.node[0] >= 0 ? mesh.points[p.node[0]] : p.at, p.node};
        const bool end = is_end(line, points[i]);
        if (!stops.empty()) {
            Line::Stop& last = stops.back();
            const bool different = (last.node[0] < 0 || stop.node[0] < 0) && (last.node[1] < 0 || stop.node[1] < 0);
            if (different && !(fixed.back() && end) &&
                (last.at - stop.at).norm() < same_node * std::min(rooms.back(), own)) {
                // The end stays where it is, else the mesh's node, and the addition's goes there. What node of the mesh
                // goes to an end is seen later.
                const bool stay = fixed.back() || (!end && last.node[0] >= 0);
                if (!stay) last.at = stop.at;
                last.node = {fixed.back() ? last.node[0]
                             : end        ? stop.node[0]
                                          : std::max(last.node[0], stop.node[0]),
                             std::max(last.node[1], stop.node[1])};
                fixed.back() = fixed.back() || end;
                continue;
            }
        }
        stops.push_back(stop);
        rooms.push_back(own);
        fixed.push_back(end);
    }
    return stops;
}

/// The ribbon through a meeting's points, on the surface of mesh m.
std::unique_ptr<Ribbon> ribbon_of(const MeetingLine& meeting, std::size_t m) {
    std::vector<Vec3> points, normals;
    for (const MeetingLine::Point& p : meeting.points) {
        points.push_back(p.at);
        normals.push_back(p.normal[m]);
    }
    return std::make_unique<Ribbon>(std::move(points), std::move(normals), meeting.closed);
}

Line line_of(const MeetingLine& meeting, const Mesh& mesh) {
    Line out;
    out.closed = meeting.closed;
    for (const std::size_t m : {0U, 1U}) out.standing[m] = ribbon_of(meeting, m);
    out.stops = stops_of(meeting, mesh);
    return out;
}

/// The meshes, refined where the other is much finer.
class Refining {
public:
    Refining(const Mesh& mesh, const Mesh& addition, const OperatorOptions& options)
        : meshes_{&mesh, &addition}, options_(options) {
        // Elements are divided to fit each other.
        options_.skin = nullptr;
    }

    void run(const std::vector<MeetingLine>& meeting) {
        for (const std::size_t m : {0U, 1U}) {
            std::vector<std::unique_ptr<Ribbon>> ribbons;
            std::vector<RefineZone> zones;
            for (const MeetingLine& line : meeting) {
                double sum = 0;
                for (const MeetingLine::Point& p : line.points) sum += p.size[1 - m];
                ribbons.push_back(ribbon_of(line, m));
                const Ribbon& ribbon = *ribbons.back();
                zones.push_back({[&ribbon](const Vec3& x) {
                                     return std::hypot(ribbon.distance(x), std::max(0.0, ribbon.beyond(x)));
                                 },
                                 std::min(coarser * sum / static_cast<double>(line.points.size()),
                                          ribbon.closed() ? of_length * ribbon.length() : HUGE_VAL)});
            }
            refined_[m] = refine_first(*meshes_[m], zones, options_);
        }
    }

    bool any() const { return is_refined(0) || is_refined(1); }
    const Mesh& mesh(std::size_t m) const { return is_refined(m) ? refined_[m]->mesh : *meshes_[m]; }

    /// Adds what was done to mesh m to a report on what was done then.
    void join(std::size_t m, Report& report) const {
        if (!refined_[m]) return;
        const Report& first = refined_[m]->report;
        report.warnings.insert(report.warnings.begin(), first.warnings.begin(), first.warnings.end());
        if (!is_refined(m)) return;
        report.refinement = refined_[m]->summary;
        report.nodes_added += first.nodes_added;
        report.nodes_split += first.nodes_split;
        report.elements_added += first.elements_added;
    }

private:
    bool is_refined(std::size_t m) const { return refined_[m] && !refined_[m]->tried_in_vain; }

    std::array<const Mesh*, 2> meshes_;
    OperatorOptions options_;
    std::array<std::optional<Refined>, 2> refined_;
};

/// Mid-side nodes go half as far as each end of their edge did.
void drag_middles(const Mesh& before, Mesh& after) {
    std::vector<char> dragged(after.points.size(), 0);
    for (const CellBlock& b : after.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.quadratic) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (std::size_t k = 0; k < t.edges.size(); ++k) {
                const Index i = n[t.edges[k][0]], j = n[t.edges[k][1]], middle = n[t.corners + k];
                if (dragged[middle] || (after.points[i] == before.points[i] && after.points[j] == before.points[j]))
                    continue;
                dragged[middle] = 1;
                after.points[middle] += (after.points[i] - before.points[i] + after.points[j] - before.points[j]) / 2;
            }
        }
    }
}

/// Two meshes that are given the same edges along lines.
class Joint {
public:
    Joint(const Mesh& mesh, const Mesh& addition, std::vector<Line> lines, const OperatorOptions& options)
        : lines_(std::move(lines)), options_(options) {
        mesh_ = {&mesh, &addition};
    }

    void run(const Prepared& known) {
        imprint(0, known);
        for (int round = 0; round < most_rounds; ++round)
            if (!imprint((round + 1) % 2, {})) return put_together();
        throw QualityError(
            "the two meshes cannot be given the same nodes where they meet: their elements there differ too much in "
            "size. Refine the coarser one there first");
    }

    Mesh& mesh(std::size_t m) { return results_[m].mesh; }
    const std::vector<Line>& lines() const { return lines_; }
    Report& report(std::size_t m) { return results_[m].report; }

private:
    /// Makes the lines edges of mesh m, with nodes at all stops. Whether that needs nodes which the other has not.
    bool imprint(std::size_t m, const Prepared& known) {
        const bool first = ribbons_.empty();
        std::vector<ImprintLine> wanted;
        for (Line& line : lines_) {
            ImprintLine& out = wanted.emplace_back();
            out.ribbon = first ? line.standing[m].get() : ribbon_through_stops(line, m);
            for (const Line::Stop& stop : line.stops) {
                out.places.push_back(stop.at);
                out.known.push_back(stop.node[m]);
            }
            out.stops = lengths(*out.ribbon, line);
        }
        if (first) ribbons_.emplace_back();
        const Mesh input = with_nodes_in_place(done_[m] ? results_[m].mesh : *mesh_[m], m);
        // The mesh's nodes stay on its surface, the addition's come to the mesh's.
        Seamed seamed = imprint_seam(input, std::move(wanted), m == 1, options_, known);
        bool more = false;
        for (std::size_t k = 0; k < lines_.size(); ++k)
            more = take(lines_[k], m, seamed.lines[k], seamed.result.mesh) || more;
        if (done_[m]) seamed.result.report = joined(results_[m].report, std::move(seamed.result.report));
        results_[m] = std::move(seamed.result);
        done_[m] = true;
        return more || !done_[1 - m];
    }

    /// The addition's nodes go to where the mesh's are.
    void put_together() {
        const Mesh before = results_[1].mesh;
        for (const Line& line : lines_)
            for (const Line::Stop& stop : line.stops) mesh(1).points[stop.node[1]] = mesh(0).points[stop.node[0]];
        drag_middles(before, mesh(1));
    }

    /// The mesh with the nodes it has at stops there, and mid-side nodes half as far.
    Mesh with_nodes_in_place(const Mesh& mesh, std::size_t m) const {
        Mesh out = mesh;
        bool any = false;
        for (const Line& line : lines_)
            for (const Line::Stop& stop : line.stops)
                if (stop.node[m] >= 0 && out.points[stop.node[m]] != stop.at) {
                    out.points[stop.node[m]] = stop.at;
                    any = true;
                }
        if (any) drag_middles(mesh, out);
        return out;
    }

    const Ribbon* ribbon_through_stops(const Line& line, std::size_t m) {
        if (line.stops.size() < (line.closed ? 3U : 2U))
            throw QualityError(
                "the two meet at " + point_text(line.stops.front().at) +
                " in a loop that is smaller than the elements there. Move the addition so that it meets the mesh "
                "properly, or refine the mesh there first");
        std::vector<Vec3> points, standing;
        for (const Line::Stop& stop : line.stops) {
            points.push_back(stop.at);
            standing.push_back(line.standing[m]->foot(stop.at).standing);
        }
        ribbons_.push_back(std::make_unique<Ribbon>(std::move(points), std::move(standing), line.closed));
        return ribbons_.back().get();
    }

    static std::vector<double> lengths(const Ribbon& ribbon, const Line& line) {
        std::vector<double> out;
        for (const Line::Stop& stop : line.stops) out.push_back(ribbon.foot(stop.at).arc);
        out.front() = 0;
        if (!line.closed) out.back() = ribbon.length();
        return out;
    }

    /// The line's stops are the nodes that mesh m has there now.
    static bool take(Line& line, std::size_t m, const SeamLine& seam, const Mesh& mesh) {
        std::vector<Line::Stop> stops;
        for (const Index n : seam.nodes) {
            Line::Stop& stop = stops.emplace_back(Line::Stop{mesh.points[n], {-1, -1}});
            stop.node[m] = n;
        }
        for (std::size_t s = 0; s < seam.at_stop.size(); ++s) {
            Line::Stop& stop = stops[seam.at_stop[s]];
            stop.node[1 - m] = std::max(stop.node[1 - m], line.stops[s].node[1 - m]);
        }
        const bool more = std::ranges::any_of(stops, [&](const Line::Stop& s) { return s.node[1 - m] < 0; });
        line.stops = std::move(stops);
        return more;
    }

    static Report joined(const Report& before, Report after) {
        after.quality_before = before.quality_before;
        after.nodes_added += before.nodes_added;
        after.nodes_split += before.nodes_split;
        after.nodes_moved = std::max(after.nodes_moved, before.nodes_moved);
        after.elements_added += before.elements_added;
        after.warnings.insert(after.warnings.begin(), before.warnings.begin(), before.warnings.end());
        return after;
    }

    std::array<const Mesh*, 2> mesh_;
    std::vector<Line> lines_;
    OperatorOptions options_;
    std::array<Result, 2> results_;
    std::array<bool, 2> done_{};
    std::vector<std::unique_ptr<Ribbon>> ribbons_;
};

[[noreturn]] void fail_apart(const Mesh& mesh, const Mesh& addition) {
    const Eigen::AlignedBox3d a = box_around(mesh), b = box_around(addition);
    std::ostringstream out;
    out << "the addition does not meet the mesh: nowhere do their surfaces cross, and no border of the one is on the "
           "other. The mesh reaches from "
        << point_text(a.min()) << " to " << point_text(a.max()) << ", the addition from " << point_text(b.min())
        << " to " << point_text(b.max()) << ". Move the addition, or give a larger tolerance";
    throw ToolError(out.str(), "other");
}

void check(const Mesh& mesh, const Mesh& addition) {
    if (mesh.cell_count() == 0) throw ToolError("the mesh is empty: there is nothing to add to", "mesh");
    if (addition.cell_count() == 0) throw ToolError("the addition has no elements", "other");
    if (mesh.dimension() < 2 || addition.dimension() < 2 || addition.dimension() > mesh.dimension())
        throw ToolError("an addition of dimension " + std::to_string(addition.dimension()) +
                            " cannot be joined to a mesh of dimension " + std::to_string(mesh.dimension()) +
                            ": shells are joined to shells and to solids, solids to solids",
                        "other");
}

/// Throws ToolError when a group that the operator makes has a name already.
void check_names(const Mesh& mesh, const Mesh& addition, const std::string& name) {
    for (const char* suffix : {"_SEAM", "_ADDED"})
        for (const Mesh* m : {&mesh, &addition})
            if (m->find_group(name + suffix))
                throw ToolError("name '" + name + "' is taken: " + (m == &mesh ? "the mesh" : "the addition") +
                                    " already has a group '" + name + suffix + "'; choose another",
                                "name");
}

void add_quality(QualitySummary& sum, const QualitySummary& more) {
    const Index count = sum.count + more.count;
    if (count > 0)
        sum.mean = (sum.mean * static_cast<double>(sum.count) + more.mean * static_cast<double>(more.count)) /
                   static_cast<double>(count);
    sum.count = count;
    sum.minimum = std::min(sum.minimum, more.minimum);
    for (std::size_t k = 0; k < sum.histogram.size(); ++k) sum.histogram[k] += more.histogram[k];
}

/// The report on the mesh, with what the addition brings.
Report report_of(const Mesh& input, Joint& joint, const Mesh& result, Index shared) {
    Report out = std::move(joint.report(0));
    const Report& other = joint.report(1);
    std::vector<GroupRecord> records = compare_groups(input, family_totals(input), result, family_totals(result));
    for (GroupRecord& r : records)
        for (const GroupRecord& was : out.groups)
            if (was.name == r.name && was.kind == r.kind) {
                const GroupRecord now = r;
                r = was;
                r.count_after = now.count_after;
                r.measure_after = now.measure_after;
                if (was.status == "untouched" && now.count_after != now.count_before) r.status = now.status;
            }
    out.groups = std::move(records);
    add_quality(out.quality_before, other.quality_before);
    add_quality(out.quality_after, other.quality_after);
    out.nodes_added += joint.mesh(1).node_count() - shared;
    out.elements_added += joint.mesh(1).cell_count();
    for (const std::string& w : other.warnings) out.warnings.push_back("the addition: " + w);
    return out;
}

/// The two as one mesh, and the nodes of it that both had.
struct United {
    Mesh mesh;
    std::vector<Index> seam;
};

UniteNames names_of(const MergeOptions& options) {
    return {options.prefix.empty() ? options.name + "_" : options.prefix, options.join_groups};
}

/// Adds the group of the addition's elements.
std::string add_group_added(Mesh& mesh, const MergeOptions& options) {
    std::string name = options.name + "_ADDED";
    mesh.add_group(name, GroupKind::element);
    return name;
}

United unite_shells(Joint& joint, const MergeOptions& options) {
    United out{std::move(joint.mesh(0)), {}};
    std::vector<Index> shared(joint.mesh(1).points.size(), -1);
    for (const Line& line : joint.lines())
        for (const Line::Stop& stop : line.stops) {
            shared[stop.node[1]] = stop.node[0];
            out.seam.push_back(stop.node[0]);
        }
    unite(out.mesh, joint.mesh(1), shared, add_group_added(out.mesh, options), names_of(options));
    return out;
}

/// One of the two is fitted to the other's skin where they meet.
United unite_solids(Joint& joint, double tolerance, const MergeOptions& options) {
    const std::size_t base = options.keep_addition ? 1 : 0, fitted = 1 - base;
    std::array<std::vector<std::array<Index, 2>>, 2> outline;
    std::vector<Index> partner(joint.mesh(fitted).points.size(), -1);
    for (const Line& line : joint.lines())
        for (std::size_t k = 0; k < line.stops.size(); ++k) {
            const Line::Stop& stop = line.stops[k];
            partner[stop.node[fitted]] = stop.node[base];
            if (k + 1 == line.stops.size() && !line.closed) continue;
            const Line::Stop& next = line.stops[(k + 1) % line.stops.size()];
            for (const std::size_t m : {0U, 1U}) outline[m].push_back({stop.node[m], next.node[m]});
        }
    const double close = std::max(tolerance, 1e-9 * box_around(joint.mesh(base)).diagonal().norm());
    const auto covered = [&](std::size_t m) {
        return covered_faces(joint.mesh(m), joint.mesh(1 - m), outline[m], close);
    };
    const std::vector<SurfaceFace> cover = covered(base);
    Refilled refilled = refill(joint.mesh(fitted), joint.mesh(base), partner, covered(fitted), cover);
    United out;
    if (fitted == 1) {
        out.mesh = std::move(joint.mesh(0));
        unite(out.mesh, refilled.mesh, refilled.partner, add_group_added(out.mesh, options), names_of(options));
        for (const SurfaceFace& f : cover) out.seam.insert(out.seam.end(), f.nodes.begin(), f.nodes.end());
        return out;
    }
    std::vector<Index> shared(joint.mesh(1).points.size(), -1);
    for (Index n = 0; n < refilled.mesh.node_count(); ++n)
        if (refilled.partner[n] >= 0) shared[refilled.partner[n]] = n;
    out.mesh = std::move(refilled.mesh);
    unite(out.mesh, joint.mesh(1), shared, add_group_added(out.mesh, options), names_of(options));
    for (const SurfaceFace& f : cover)
        for (const Index n : f.nodes) out.seam.push_back(shared[n]);
    return out;
}

/// Throws QualityError where more than two tetrahedra have a face at the seam: a mesh that only looks right.
void check_seam(const Mesh& mesh, const std::vector<Index>& seam) {
    const auto at_seam = [&](Index n) { return std::ranges::binary_search(seam, n); };
    std::map<std::array<Index, 3>, int> faces;
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).linear != CellType::tetra) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (std::none_of(n.begin(), n.begin() + 4, at_seam)) continue;
            for (const auto& f : outward_faces) {
                std::array<Index, 3> key{n[f[0]], n[f[1]], n[f[2]]};
                std::ranges::sort(key);
                if (++faces[key] > 2)
                    throw QualityError("the two solids cannot be joined at " + point_text(mesh.points[key[0]]) +
                                       ": they would overlap there. Move the addition a little");
            }
        }
    }
}

void name_seam(Mesh& mesh, std::vector<Index>& seam, const std::string& name) {
    std::ranges::sort(seam);
    const auto [rest, end] = std::ranges::unique(seam);
    seam.erase(rest, end);
    const GroupIndex group = mesh.add_group(name, GroupKind::node);
    for (const Index n : seam) mesh.node_families[n] = mesh.families.with(mesh.node_families[n], group);
}

}  // namespace

Result merge(const Mesh& mesh, const Mesh& other, const MergeOptions& options, const Prepared& known) {
    Stopwatch::Time started = Stopwatch::now();
    check(mesh, other);
    check_names(mesh, other, options.name);
    const Mesh addition = is_second_order(mesh) ? to_second_order(other) : to_first_order(other);
    Meeting meeting = find_meeting(mesh, addition, options.tolerance);
    if (meeting.lines.empty()) fail_apart(mesh, addition);
    Refining refined(mesh, addition, options);
    refined.run(meeting.lines);
    // Smaller elements do not make what is off a curved surface nearer.
    if (refined.any())
        meeting = find_meeting(refined.mesh(0), refined.mesh(1), options.tolerance.value_or(meeting.tolerance));
    std::vector<Line> lines;
    for (const MeetingLine& line : meeting.lines) lines.push_back(line_of(line, refined.mesh(0)));
    Joint joint(refined.mesh(0), refined.mesh(1), std::move(lines), options);
    joint.run(&refined.mesh(0) == &mesh ? known : Prepared{});
    check_cancelled();
    for (const std::size_t m : {0U, 1U}) refined.join(m, joint.report(m));

    const bool solids = mesh.dimension() == 3 && addition.dimension() == 3;
    United united = solids ? unite_solids(joint, meeting.tolerance, options) : unite_shells(joint, options);
    Result out;
    out.mesh = std::move(united.mesh);
    name_seam(out.mesh, united.seam, options.name + "_SEAM");
    if (solids) check_seam(out.mesh, united.seam);
    out.report = report_of(mesh, joint, out.mesh, static_cast<Index>(united.seam.size()));
    out.report.seconds = {{"merge", Stopwatch::since(started)}};
    return out;
}

}  // namespace femscalpel
