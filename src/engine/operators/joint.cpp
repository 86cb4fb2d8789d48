// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/joint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include "cutting/surface_line.h"
#include "mesh/order.h"
#include "mesh/surface.h"
#include "mesh/surface_tree.h"
#include "operators/curved_rim.h"
#include "operators/merge_report.h"
#include "operators/poor.h"
#include "words.h"

namespace femscalpel {
namespace {

/// A node of the one nearer to a node of the other than this, in the shortest edge of the line there, is the same.
constexpr double same_node = 0.25;
/// Nearer to a surface than this, in the size of the lines, is on it.
constexpr double rounding = 1e-12;
/// Cosine of the angle by which a line bends where it is to have a node.
const double bend = std::cos(6 * M_PI / 180);
/// How often the two may be divided where the other was.
constexpr int most_rounds = 4;

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
std::vector<JointLine::Stop> stops_of(const MeetingLine& line, const Mesh& mesh) {
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
    std::vector<JointLine::Stop> stops;
    std::vector<double> rooms;
    std::vector<char> fixed;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const MeetingLine::Point& p = line.points[points[i]];
        double own = std::min(p.size[0], p.size[1]);
        for (const std::size_t m : {0U, 1U})
            if (p.node[m] >= 0) own = std::min(own, room(i, m));
        // The mesh stays as it is.
        const JointLine::Stop stop{p.node[0] >= 0 ? mesh.points[p.node[0]] : p.at, p.node};
        const bool end = is_end(line, points[i]);
        if (!stops.empty()) {
            JointLine::Stop& last = stops.back();
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

std::vector<double> lengths(const Ribbon& ribbon, const JointLine& line) {
    std::vector<double> out;
    out.reserve(line.stops.size());
    for (const JointLine::Stop& stop : line.stops) out.push_back(ribbon.foot(stop.at).arc);
    out.front() = 0;
    if (!line.closed) out.back() = ribbon.length();
    return out;
}

/// The line's stops are the nodes that mesh m has there now.
bool take(JointLine& line, std::size_t m, const SeamLine& seam, const Mesh& mesh) {
    std::vector<JointLine::Stop> stops;
    for (std::size_t k = 0; k < seam.nodes.size(); ++k) {
        JointLine::Stop& stop = stops.emplace_back(JointLine::Stop{mesh.points[seam.nodes[k]], {-1, -1}});
        stop.node[m] = seam.nodes[k];
        stop.bound = m == 0 && seam.bound[k] != 0;
    }
    for (std::size_t s = 0; s < seam.at_stop.size(); ++s) {
        JointLine::Stop& stop = stops[seam.at_stop[s]];
        stop.node[1 - m] = std::max(stop.node[1 - m], line.stops[s].node[1 - m]);
        stop.bound = stop.bound || (m == 1 && line.stops[s].bound);
    }
    const bool more = std::ranges::any_of(stops, [&](const JointLine::Stop& s) { return s.node[1 - m] < 0; });
    line.stops = std::move(stops);
    return more;
}

/// Stops go to the first mesh's nodes where these are bound, else to its surface where they are off it.
void bring_onto(const Mesh& mesh, std::vector<JointLine>& lines) {
    Eigen::AlignedBox3d box;
    for (const JointLine& line : lines)
        for (const JointLine::Stop& stop : line.stops) box.extend(stop.at);
    const double size = box.diagonal().norm();
    const std::vector<SurfaceFace> faces = surface_near(mesh, grown(box, size));
    const SurfaceTree tree(mesh, faces);
    for (JointLine& line : lines)
        for (JointLine::Stop& stop : line.stops)
            if (stop.bound)
                stop.at = mesh.points[stop.node[0]];
            else if (const SurfaceTree::Foot foot = tree.closest(stop.at);
                     foot.piece >= 0 && foot.distance > rounding * size)
                stop.at = foot.at;
}

/// The element with the least mean ratio.
PoorestElement poorest(const Mesh& mesh) {
    std::vector<Index> all(mesh.points.size());
    std::iota(all.begin(), all.end(), 0);
    return poorest_at(mesh, all);
}

/// imprint_seam(), with an error that says what there is to be done where meshes are merged. `own`: mesh m as it was,
/// before nodes of it were moved to where the other has them.
Seamed imprinted(const Mesh& mesh, const Mesh& own, std::vector<ImprintLine> lines, std::size_t m,
                 const OperatorOptions& options, const Prepared& known) {
    try {
        return imprint_seam(mesh, std::move(lines), m == 1, options, known);
    } catch (const QualityError& error) {
        const std::string text = error.what(), mesh_is = "the mesh already has";
        if (text.starts_with(mesh_is) && text.find("flat or inverted") != std::string::npos)
            if (const PoorestElement now = poorest(mesh); now.mean_ratio < poorest(own).mean_ratio)
                throw QualityError("nodes of the two near " + point_text(now.place) +
                                       " cannot be made one: an element there would be flat. Refine both there first, "
                                       "or move the addition a little",
                                   "other");
        if (m == 0 || !text.starts_with(mesh_is)) throw;
        throw QualityError("the addition already has" + text.substr(mesh_is.size()), "other");
    } catch (const UnsupportedElementError& error) {
        const std::string text = error.what();
        const std::size_t verb = text.find(" reaches "), end = text.find(';');
        if (verb == std::string::npos || end == std::string::npos) throw;
        throw UnsupportedElementError("what is changed where the two meet" + text.substr(verb, end - verb) +
                                          "; only triangles and tetrahedra can be given new nodes. Move the addition "
                                          "away from these elements, split them into tetrahedra or triangles first, "
                                          "or join the two with method='tie'",
                                      m == 0 ? "mesh" : "other");
    }
}

}  // namespace

std::unique_ptr<Ribbon> ribbon_of(const MeetingLine& meeting, std::size_t m) {
    std::vector<Vec3> points, normals;
    for (const MeetingLine::Point& p : meeting.points) {
        points.push_back(p.at);
        normals.push_back(p.normal[m]);
    }
    return std::make_unique<Ribbon>(std::move(points), std::move(normals), meeting.closed);
}

JointLine line_of(const MeetingLine& meeting, const Mesh& mesh) {
    JointLine out;
    out.closed = meeting.closed;
    for (const std::size_t m : {0U, 1U}) out.standing[m] = ribbon_of(meeting, m);
    out.stops = stops_of(meeting, mesh);
    return out;
}

Joint::Joint(const Mesh& mesh, const Mesh& addition, std::vector<JointLine> lines, const OperatorOptions& options)
    : mesh_{&mesh, &addition}, lines_(std::move(lines)), options_(options) {}

void Joint::run(const Prepared& known) {
    imprint(0, known);
    for (int round = 0; round < most_rounds; ++round)
        if (!imprint((round + 1) % 2, {})) {
            put_together();
            return bend();
        }
    throw QualityError(
        "the two meshes cannot be given the same nodes where they meet: their elements there differ too much in "
        "size. Refine the coarser one there first");
}

/// Makes the lines edges of mesh m, with nodes at all stops. Whether that needs nodes which the other has not.
bool Joint::imprint(std::size_t m, const Prepared& known) {
    const bool first = !done_[0];
    std::vector<ImprintLine> wanted;
    for (JointLine& line : lines_) {
        ImprintLine& out = wanted.emplace_back();
        out.ribbon = first ? line.standing[m].get() : ribbon_through_stops(line, m);
        for (const JointLine::Stop& stop : line.stops) {
            out.places.push_back(stop.at);
            out.known.push_back(stop.node[m]);
        }
        out.stops = lengths(*out.ribbon, line);
    }
    const Mesh input = with_nodes_in_place(done_[m] ? results_[m].mesh : *mesh_[m], m);
    // The mesh's nodes stay on its surface, the addition's come to the mesh's.
    Seamed seamed = imprinted(input, *mesh_[m], std::move(wanted), m, options_, known);
    bool more = false;
    for (std::size_t k = 0; k < lines_.size(); ++k)
        more = take(lines_[k], m, seamed.lines[k], seamed.result.mesh) || more;
    // Nodes of the addition that are held may be off the mesh, whose surface stays.
    if (m == 1) bring_onto(results_[0].mesh, lines_);
    if (done_[m]) seamed.result.report = joined(results_[m].report, std::move(seamed.result.report));
    results_[m] = std::move(seamed.result);
    done_[m] = true;
    return more || !done_[1 - m];
}

/// The addition's nodes go to where the mesh's are.
void Joint::put_together() {
    const Mesh before = results_[1].mesh;
    for (const JointLine& line : lines_)
        for (const JointLine::Stop& stop : line.stops) mesh(1).points[stop.node[1]] = mesh(0).points[stop.node[0]];
    drag_middles(before, mesh(1));
}

/// Along the seam the addition keeps its own curves where the mesh is flat.
void Joint::bend() {
    if (!is_second_order(*mesh_[0]) || !is_second_order(*mesh_[1])) return;
    std::vector<CommonEdge> edges;
    for (const JointLine& line : lines_)
        for (std::size_t k = 0; k + (line.closed ? 0 : 1) < line.stops.size(); ++k) {
            const JointLine::Stop &from = line.stops[k], &to = line.stops[(k + 1) % line.stops.size()];
            edges.push_back({{{{from.node[0], to.node[0]}, {from.node[1], to.node[1]}}}, from.bound && to.bound});
        }
    const BentRim rim = bend_rim(*mesh_[1], mesh(0), mesh(1), edges);
    if (rim.straight == 0) return;
    report(1).straightened.count += rim.straight;
    report(1).straightened.largest = std::max(report(1).straightened.largest, rim.largest);
    std::ostringstream text;
    text << "along the seam its own curved skin is left by up to " << rim.largest << " ("
         << counted(rim.straight, "edge")
         << "): the mesh is not flat there, or its elements have no room for curves. Refine both there first";
    report(1).warnings.push_back(text.str());
}

/// The mesh with the nodes it has at stops there, and mid-side nodes half as far.
Mesh Joint::with_nodes_in_place(const Mesh& mesh, std::size_t m) const {
    Mesh out = mesh;
    bool any = false;
    for (const JointLine& line : lines_)
        for (const JointLine::Stop& stop : line.stops)
            if (stop.node[m] >= 0 && out.points[stop.node[m]] != stop.at) {
                out.points[stop.node[m]] = stop.at;
                any = true;
            }
    if (any) drag_middles(mesh, out);
    return out;
}

const Ribbon* Joint::ribbon_through_stops(const JointLine& line, std::size_t m) {
    if (line.stops.size() < (line.closed ? 3U : 2U))
        throw QualityError(
            "the two meet at " + point_text(line.stops.front().at) +
            " in a loop that is smaller than the elements there. Move the addition so that it meets the mesh "
            "properly, or refine the mesh there first");
    std::vector<Vec3> points, standing;
    for (const JointLine::Stop& stop : line.stops) {
        points.push_back(stop.at);
        standing.push_back(line.standing[m]->foot(stop.at).standing);
    }
    ribbons_.push_back(std::make_unique<Ribbon>(std::move(points), std::move(standing), line.closed));
    return ribbons_.back().get();
}

}  // namespace femscalpel
