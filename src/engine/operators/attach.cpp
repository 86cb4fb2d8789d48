// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/attach.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "cutting/surface_line.h"
#include "deck/edge_beams.h"
#include "mesh/outer_faces.h"
#include "mesh/stopwatch.h"
#include "mesh/surface_tree.h"
#include "operators/attach_along.h"
#include "operators/merge_report.h"
#include "operators/seam.h"
#include "operators/sections.h"
#include "operators/unite.h"
#include "words.h"

namespace femscalpel {
namespace {

/// What touches, in the shorter of beam and mean edge.
constexpr double touching = 0.1;
/// As far a faceted surface may be off the smooth one, in its sag.
constexpr double off_facets = 1.5;
/// What is nearer than this, in mean edges, is at the same place.
constexpr double same_place = 1e-9;
/// Half the length of the line that stands for a place, in mean edges.
constexpr double around_place = 0.25;
/// The angle of that line to a border.
constexpr double oblique = 40 * M_PI / 180;

/// A place of the mesh's surface where beams end.
struct Seat {
    Vec3 at, normal;
    Vec3 across;  ///< unit vector in the surface that runs along no border near it
    double size;  ///< mean edge of the face there
    bool on_solid;
    Index node = -1;          ///< of the mesh, if there is one
    std::vector<Index> ends;  ///< nodes of the addition
};

/// Finds where beams end on a mesh.
class Seats {
public:
    /// `shared`: by node of the addition, the node of the mesh that it is already, or -1; empty when none is.
    Seats(const Mesh& mesh, const Mesh& addition, std::optional<double> tolerance, const std::vector<Index>& shared)
        : mesh_(mesh), addition_(addition), given_(tolerance), shared_(shared) {
        for (const CellBlock& b : addition.blocks()) {
            if (traits(b.type).dimension != 1) continue;
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                const double length = (addition.points[n[0]] - addition.points[n[1]]).norm();
                for (const Index v : {n[0], n[1]}) {
                    ++uses_[v];
                    beam_[v] = length;
                }
            }
        }
        const Eigen::AlignedBox3d box = box_around(addition);
        outer_ = outer_faces(mesh, grown(box, std::max(box.diagonal().norm(), given_.value_or(0))));
    }

    std::vector<Seat> run() {
        const SurfaceTree tree(mesh_, outer_.triangles);
        for (const auto& [v, uses] : uses_)
            if (uses == 1 && (shared_.empty() || shared_[v] < 0)) look_at(v, tree);
        if (seats_.empty() && shared_.empty()) fail_apart();
        return std::move(seats_);
    }

private:
    void look_at(Index v, const SurfaceTree& tree) {
        const Vec3& x = addition_.points[v];
        const SurfaceTree::Foot foot = tree.closest(x);
        if (foot.piece < 0) return;
        const SurfaceFace& face = outer_.triangles[foot.piece];
        const double size = tree.size(foot.piece), most = given_.value_or(std::max(touching * std::min(beam_[v], size),
                                                                                   off_facets * tree.sag(foot.piece)));
        if (foot.distance < nearest_) nearest_ = foot.distance, nearest_end_ = x;
        if (foot.distance > most) {
            if (!face.shell && tree.signed_distance(x) < 0)
                throw ToolError("a beam ends inside the solid, at " + point_text(x) +
                                    ": its end has to be on the skin. Move the addition, or give a larger tolerance",
                                "other");
            return;
        }
        Seat seat{foot.at, tree.normal(foot.piece), across(tree, foot), size, !face.shell, -1, {v}};
        for (const Index n : face.nodes)
            if ((mesh_.points[n] - foot.at).norm() <= same_place * size) {
                seat.node = n;
                seat.at = mesh_.points[n];
            }
        for (Seat& other : seats_)
            if ((other.at - seat.at).norm() <= same_place * size) {
                other.ends.push_back(v);
                return;
            }
        seats_.push_back(std::move(seat));
    }

    Vec3 across(const SurfaceTree& tree, const SurfaceTree::Foot& foot) const {
        const Vec3 normal = tree.normal(foot.piece);
        Vec3 along = normal.unitOrthogonal();
        if (const SurfaceTree::Foot border = tree.closest_on_border(foot.at); border.piece >= 0) {
            const auto [a, b] = tree.border()[border.piece];
            const Vec3 way = mesh_.points[b] - mesh_.points[a], flat = way - way.dot(normal) * normal;
            if (flat.norm() > 0.1 * way.norm()) along = flat.normalized();
        }
        return Eigen::AngleAxisd(oblique, normal) * along;
    }

    [[noreturn]] void fail_apart() const {
        std::ostringstream text;
        text << "no beam of the addition ends on the mesh's surface";
        if (std::isfinite(nearest_))
            text << "; the end at " << point_text(nearest_end_) << " is " << nearest_ << " off";
        text << ". Move the addition, or give a larger tolerance";
        throw ToolError(text.str(), "other");
    }

    const Mesh& mesh_;
    const Mesh& addition_;
    std::optional<double> given_;
    const std::vector<Index>& shared_;
    std::map<Index, int> uses_;     // of corners by beams
    std::map<Index, double> beam_;  // length of one there
    OuterFaces outer_;
    std::vector<Seat> seats_;
    double nearest_ = std::numeric_limits<double>::infinity();
    Vec3 nearest_end_ = Vec3::Zero();
};

/// The mesh with nodes at all seats, which are then numbered in that.
Result with_nodes(const Mesh& mesh, std::vector<Seat>& seats, const MergeOptions& options, const Prepared& known) {
    std::vector<std::unique_ptr<Ribbon>> ribbons;
    std::vector<ImprintLine> lines;
    for (const Seat& seat : seats) {
        if (seat.node >= 0) continue;
        const double half = around_place * seat.size;
        const Vec3 along = half * seat.across;
        ribbons.push_back(std::make_unique<Ribbon>(std::vector<Vec3>{seat.at - along, seat.at + along},
                                                   std::vector<Vec3>{seat.normal, seat.normal}, false));
        lines.push_back({ribbons.back().get(), {half}, {seat.at}, {-1}, true});
    }
    Result out;
    if (lines.empty()) {
        out.mesh = mesh;
        out.report.operation = "merge";
        out.report.name = options.name;
        out.report.method = "snap";
        return out;
    }
    Seamed seamed = imprint_seam(mesh, std::move(lines), false, options, known);
    const NumberIndex numbers(seamed.result.mesh);
    std::size_t line = 0;
    for (Seat& seat : seats)
        seat.node = seat.node < 0 ? seamed.lines[line++].nodes.front() : *numbers.node(mesh.node_ids[seat.node]);
    return std::move(seamed.result);
}

/// The addition with nodes that are the mesh's where these are, mid-side nodes half as far.
Mesh with_ends_there(const Mesh& addition, const Mesh& mesh, const std::vector<Index>& shared) {
    Mesh out = addition;
    for (std::size_t v = 0; v < shared.size(); ++v)
        if (shared[v] >= 0) out.points[v] = mesh.points[shared[v]];
    for (const CellBlock& b : out.blocks()) {
        if (b.type != CellType::line3) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (shared[n[2]] >= 0) continue;
            for (const Index v : {n[0], n[1]}) out.points[n[2]] += (out.points[v] - addition.points[v]) / 2;
        }
    }
    return out;
}

/// Whether the report says that there are beams whose nodes do not turn.
void warn_of_solids(Index ends, Index along, Report& report) {
    if (ends > 0)
        report.warnings.push_back(counted(ends, "beam ends on a node", "beams end on nodes") +
                                  " of solids, which do not turn: no moment is carried there, as by a hinge. Let them "
                                  "end on a shell on the skin, or hold their turning otherwise");
    if (along > 0)
        report.warnings.push_back(counted(along, "beam lies on the skin", "beams lie on the skin") +
                                  " of solids, whose nodes do not turn: nothing holds them against turning about "
                                  "themselves. Lay them on a shell on the skin, or hold their turning otherwise");
}

}  // namespace

Result attach_beams(const Mesh& mesh, const Mesh& addition, const MergeOptions& options, const Prepared& known) {
    const Stopwatch::Time started = Stopwatch::now();
    std::vector<std::string> bowed;
    std::optional<AttachedAlong> along = attach_along(mesh, addition, options, known, bowed);
    const Mesh &base = along ? along->mesh : mesh, &beams = along ? along->addition : addition;
    std::vector<Index> shared;
    if (along) shared = along->shared;
    std::vector<Seat> seats = Seats(base, beams, options.tolerance, shared).run();
    Result out = with_nodes(base, seats, options, along ? Prepared{} : known);
    shared.resize(beams.points.size(), -1);
    if (along) {
        const NumberIndex numbers(out.mesh);
        for (Index& node : shared)
            if (node >= 0) node = *numbers.node(base.node_ids[node]);
        out.report = seats.empty() ? std::move(along->report) : joined(along->report, std::move(out.report));
    }
    Index on_solids = 0;
    for (const Seat& seat : seats) {
        for (const Index v : seat.ends) shared[v] = seat.node;
        if (seat.on_solid) on_solids += static_cast<Index>(seat.ends.size());
    }
    std::vector<Index> seam;
    for (const Index node : shared)
        if (node >= 0) seam.push_back(node);
    std::ranges::sort(seam);
    const auto [rest, end] = std::ranges::unique(seam);
    seam.erase(rest, end);
    const Mesh fitted = with_ends_there(beams, out.mesh, shared);
    const std::string added = options.name + "_ADDED";
    out.mesh.add_group(added, GroupKind::element);
    const Index nodes_before = out.mesh.node_count();
    unite(out.mesh, fitted, shared, added, names_of(options));
    mark_edge_beams(out.mesh, *out.mesh.find_group(added, GroupKind::element));
    add_seam(out.mesh, options.name, seam);
    out.report.groups = merged_records(mesh, out.mesh, out.report.groups);
    out.report.nodes_added += out.mesh.node_count() - nodes_before;
    out.report.elements_added += beams.cell_count();
    std::ranges::move(bowed, std::back_inserter(out.report.warnings));
    warn_of_solids(on_solids, along ? along->on_solids : 0, out.report);
    warn_of_sections(mesh, out.mesh, added, out.report);
    out.report.seconds = {{"merge", Stopwatch::since(started)}};
    return out;
}

}  // namespace femscalpel
