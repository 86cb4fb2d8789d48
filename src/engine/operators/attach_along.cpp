// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/attach_along.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "cancel.h"
#include "cutting/beams.h"
#include "cutting/meeting.h"
#include "cutting/split_beams.h"
#include "cutting/surface_line.h"
#include "deck/carry_over.h"
#include "deck/mark_deck.h"
#include "deck/solver_sets.h"
#include "mesh/closest_point.h"
#include "mesh/outer_faces.h"
#include "mesh/surface_tree.h"
#include "operators/joint.h"
#include "operators/simplify_first.h"
#include "words.h"

namespace femscalpel {
namespace {

/// What touches, in the shorter of beam and mean edge; as far as a faceted surface may be off the smooth one, in its
/// sag.
constexpr double beside = 0.1, beside_facets = 1.5;
/// Beams with both ends on the surface that are no farther off between, in their length, are worth a word.
constexpr double bow = 0.25;
/// A beam lies in a surface at less than this sine of the angle to it.
constexpr double steepest = 0.5;
/// Height of the shell that stands for beams, in their length.
constexpr double height = 0.5;

/// A beam that lies in the surface.
struct LyingBeam {
    CellRef cell;
    std::vector<Index> nodes;  ///< its two ends, after the middle of a second-order one that is to be divided there: 3
    double off;                ///< as far as it may be beside the surface
};

/// Finds the beams, and makes the shell whose foot they are.
class FootOfBeams {
public:
    FootOfBeams(const Mesh& mesh, const Mesh& addition, std::optional<double> tolerance)
        : mesh_(mesh), addition_(addition), given_(tolerance) {
        const Eigen::AlignedBox3d box = box_around(addition);
        outer_ = outer_faces(mesh, grown(box, std::max(box.diagonal().norm(), given_.value_or(0))));
        for (const SurfaceFace& face : outer_.triangles)
            for (std::size_t k = 0; k < 3; ++k) edges_.insert(std::minmax(face.nodes[k], face.nodes[(k + 1) % 3]));
    }

    void run() {
        const SurfaceTree tree(mesh_, outer_.triangles);
        const std::vector<char> whole = families_of_whole_elements(addition_);
        SparseCheck check(64);
        for (const CellType type : {CellType::line, CellType::line3}) {
            const CellBlock& block = addition_.block(type);
            for (Index c = 0; c < block.size(); ++c, check())
                if (whole.empty() || !whole[block.families[c]]) look_at({type, c}, tree);
        }
    }

    /// The shell; its first nodes are those of the beams, as in nodes().
    Mesh shell() const {
        Mesh out;
        std::map<Index, Index> place;
        for (const Index n : nodes_) {
            place.emplace(n, static_cast<Index>(place.size()));
            out.add_node(addition_.points[n], static_cast<Index>(place.size()), 0);
        }
        const auto count = static_cast<Index>(nodes_.size());
        for (const Index n : nodes_)
            out.add_node(addition_.points[n] + height * length_.at(n) * normal_.at(n).normalized(),
                         out.node_count() + 1, 0);
        Index number = 0;
        for (const LyingBeam& beam : beams_)
            for (std::size_t k = 0; k + 1 < beam.nodes.size(); ++k) {
                const Index a = place.at(beam.nodes[k]), b = place.at(beam.nodes[k + 1]);
                out.add_cell(CellType::triangle, std::array<Index, 3>{a, b, b + count}, ++number, 0);
                out.add_cell(CellType::triangle, std::array<Index, 3>{a, b + count, a + count}, ++number, 0);
            }
        return out;
    }

    const std::vector<LyingBeam>& beams() const { return beams_; }
    const std::vector<Index>& nodes() const { return nodes_; }
    Index on_solids() const { return on_solids_; }
    Index bowed() const { return bowed_; }
    const Vec3& bowed_at() const { return bowed_at_; }
    double most_off() const { return most_off_; }

    /// Distance of a point from the beams.
    double distance(const Vec3& x) const {
        double out = std::numeric_limits<double>::infinity();
        for (const LyingBeam& beam : beams_)
            for (std::size_t k = 0; k + 1 < beam.nodes.size(); ++k) {
                const Vec3 &a = addition_.points[beam.nodes[k]], &b = addition_.points[beam.nodes[k + 1]];
                out = std::min(out, (closest_on_segment(a, b, x) - x).norm());
            }
        return out;
    }

private:
    Vec3 at(std::span<const Index> n, double t) const {
        const Vec3 &a = addition_.points[n[0]], &b = addition_.points[n[1]];
        if (n.size() == 2) return (1 - t) * a + t * b;
        return (1 - t) * (1 - 2 * t) * a + t * (2 * t - 1) * b + 4 * t * (1 - t) * addition_.points[n[2]];
    }

    void look_at(const CellRef& cell, const SurfaceTree& tree) {
        const auto n = addition_.block(cell.type).nodes(cell.cell);
        const Vec3 way = addition_.points[n[1]] - addition_.points[n[0]];
        const double length = way.norm();
        if (!(length > 0)) return;
        std::array<SurfaceTree::Foot, 5> feet;
        double off = 0, most = 0;
        bool ends = true, between = true;
        for (std::size_t k = 0; k < feet.size(); ++k) {
            const Vec3 x = at(n, static_cast<double>(k) / 4);
            feet[k] = tree.closest(x);
            if (feet[k].piece < 0) return;
            const double near = given_.value_or(
                std::max(beside * std::min(length, tree.size(feet[k].piece)), beside_facets * tree.sag(feet[k].piece)));
            (k == 0 || k == 4 ? ends : between) &= feet[k].distance <= near;
            off = std::max(off, feet[k].distance);
            most = std::max(most, near);
        }
        if (!ends || std::abs(way.dot(tree.normal(feet[2].piece))) > steepest * length) return;
        if (!between) {
            if (off <= bow * length && bowed_++ == 0) bowed_at_ = at(n, 0.5);
            return;
        }
        LyingBeam beam{cell, {n[0], n[1]}, most};
        if (n.size() == 3 && !is_edge(n[0], n[1], feet[0], feet[4])) beam.nodes.insert(beam.nodes.begin() + 1, n[2]);
        on_solids_ += outer_.triangles[feet[2].piece].shell ? 0 : 1;
        most_off_ = std::max(most_off_, most);
        for (const Index v : beam.nodes) {
            const auto& foot = feet[v == n[0] ? 0 : v == n[1] ? 4 : 2];
            const Vec3 normal = tree.normal(foot.piece);
            const auto [found, is_new] = normal_.try_emplace(v, normal);
            if (is_new)
                nodes_.push_back(v);
            else
                found->second += normal.dot(found->second) < 0 ? Vec3(-normal) : normal;
            const auto [known, first] = length_.try_emplace(v, length);
            known->second = std::min(known->second, length);
        }
        align(beam.nodes);
        beams_.push_back(std::move(beam));
    }

    /// Shells may be turned either way; what stands on them does not change sides along a beam.
    void align(const std::vector<Index>& nodes) {
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
            if (normal_.at(nodes[k]).dot(normal_.at(nodes[k + 1])) < 0) normal_.at(nodes[k + 1]) *= -1;
    }

    /// Whether a beam is an edge of the mesh as it is.
    bool is_edge(Index a, Index b, const SurfaceTree::Foot& at_a, const SurfaceTree::Foot& at_b) const {
        const auto node = [&](Index end, const SurfaceTree::Foot& foot) -> Index {
            for (const Index v : outer_.triangles[foot.piece].nodes)
                if ((mesh_.points[v] - addition_.points[end]).norm() <= 1e-6 * length_of(a, b)) return v;
            return -1;
        };
        const Index first = node(a, at_a), last = node(b, at_b);
        return first >= 0 && last >= 0 && edges_.contains(std::minmax(first, last));
    }
    double length_of(Index a, Index b) const { return (addition_.points[a] - addition_.points[b]).norm(); }

    const Mesh& mesh_;
    const Mesh& addition_;
    std::optional<double> given_;
    OuterFaces outer_;
    std::set<std::pair<Index, Index>> edges_;
    std::vector<LyingBeam> beams_;
    std::vector<Index> nodes_;
    std::map<Index, Vec3> normal_;
    std::map<Index, double> length_;
    Index on_solids_ = 0, bowed_ = 0;
    Vec3 bowed_at_ = Vec3::Zero();
    double most_off_ = 0;
};

/// The mesh's nodes and edges along the beams.
struct Imprinted {
    std::map<Index, Index> node;               ///< of the mesh, by that of the addition
    std::map<Index, std::vector<Index>> next;  ///< along the seam

    Imprinted(Joint& joint, const std::vector<Index>& beam_nodes) {
        for (const JointLine& line : joint.lines())
            for (std::size_t k = 0; k < line.stops.size(); ++k) {
                const auto& [at, nodes, bound] = line.stops[k];
                const Index number = joint.mesh(1).node_ids[nodes[1]];
                if (number <= static_cast<Index>(beam_nodes.size())) node[beam_nodes[number - 1]] = nodes[0];
                if (k + 1 == line.stops.size() && !line.closed) continue;
                const Index other = line.stops[(k + 1) % line.stops.size()].node[0];
                next[nodes[0]].push_back(other);
                next[other].push_back(nodes[0]);
            }
    }

    /// The nodes between two, along the seam beside the straight line between them; nothing if they are not joined.
    std::optional<std::vector<Index>> between(const Mesh& mesh, Index from, Index to, double off) const {
        const Vec3 &a = mesh.points[from], &b = mesh.points[to];
        const auto is_beside = [&](Index n) {
            return (closest_on_segment(a, b, mesh.points[n]) - mesh.points[n]).norm() <= 2 * off;
        };
        std::map<Index, Index> before{{from, from}};
        std::deque<Index> open{from};
        while (!open.empty() && !before.contains(to)) {
            const Index here = open.front();
            open.pop_front();
            const auto found = next.find(here);
            if (found == next.end()) continue;
            for (const Index n : found->second)
                if (is_beside(n) && before.try_emplace(n, here).second) open.push_back(n);
        }
        if (!before.contains(to)) return {};
        std::vector<Index> out;
        for (Index n = before.at(to); n != from; n = before.at(n)) out.push_back(n);
        std::ranges::reverse(out);
        return out;
    }
};

/// Where the beams are to be divided, and for each place there, in order, the node of the mesh.
struct Divisions {
    BeamCuts cuts;
    std::vector<Index> nodes;

    Divisions(const Mesh& mesh, const Mesh& addition, const FootOfBeams& foot, const Imprinted& imprinted) {
        for (const LyingBeam& beam : foot.beams()) {
            BeamCut cut{beam.cell, {}};
            const std::size_t parts = beam.nodes.size() - 1;
            for (std::size_t k = 0; k < parts; ++k) {
                const auto from = imprinted.node.find(beam.nodes[k]), to = imprinted.node.find(beam.nodes[k + 1]);
                std::optional<std::vector<Index>> between;
                if (from != imprinted.node.end() && to != imprinted.node.end())
                    between = imprinted.between(mesh, from->second, to->second, beam.off);
                if (!between) refuse(addition, beam, from == imprinted.node.end() || to == imprinted.node.end());
                const Vec3 &a = mesh.points[from->second], way = mesh.points[to->second] - a;
                double last = 0;
                for (const Index n : *between) {
                    const double t = (mesh.points[n] - a).dot(way) / way.squaredNorm();
                    if (!(t > last && t < 1)) continue;
                    last = t;
                    cut.at.push_back((static_cast<double>(k) + t) / static_cast<double>(parts));
                    nodes.push_back(n);
                }
                if (k + 1 < parts) {
                    cut.at.push_back(0.5);
                    nodes.push_back(to->second);
                }
            }
            if (!cut.at.empty()) cuts.cuts.push_back(std::move(cut));
        }
    }

private:
    [[noreturn]] static void refuse(const Mesh& addition, const LyingBeam& beam, bool merged) {
        std::ostringstream text;
        text << "the beam from " << point_text(addition.points[beam.nodes.front()]) << " to "
             << point_text(addition.points[beam.nodes.back()])
             << " lies in the surface, but cannot be joined to it along its length: ";
        if (merged)
            text
                << "it is too short for what counts as touching there, " << beam.off
                << " (facets of a curved surface are as far off it). Refine the mesh there first, or give longer beams";
        else
            text << "something there holds the surface's nodes, or it ends. Move the beam a little, or refine the mesh "
                    "there first";
        throw QualityError(text.str(), "other");
    }
};

}  // namespace

std::optional<AttachedAlong> attach_along(const Mesh& mesh, const Mesh& addition, const MergeOptions& options,
                                          const Prepared& known, std::vector<std::string>& bowed) {
    FootOfBeams foot(mesh, addition, options.tolerance);
    foot.run();
    if (foot.bowed() > 0)
        bowed.push_back(counted(foot.bowed(), "beam") + ", as at " + point_text(foot.bowed_at()) +
                        ", with both ends on the surface, and off it between by little: joined at the ends alone. Give "
                        "a larger tolerance, or shorter beams, to join all along");
    if (foot.beams().empty()) return {};
    const Mesh shell = foot.shell();
    Meeting meeting = find_meeting(mesh, shell, options.tolerance);
    std::vector<JointLine> lines;
    const double near = 2 * foot.most_off() + 1e-9 * box_around(addition).diagonal().norm();
    for (const MeetingLine& line : meeting.lines)
        if (std::ranges::all_of(line.points, [&](const auto& p) { return foot.distance(p.at) <= near; }))
            lines.push_back(line_of(line, mesh));
    Joint joint(mesh, shell, std::move(lines), options);
    if (!joint.lines().empty()) joint.run(known);
    const Imprinted imprinted(joint, foot.nodes());
    const Divisions divisions(joint.lines().empty() ? mesh : joint.mesh(0), addition, foot, imprinted);

    AttachedAlong out;
    out.on_solids = foot.on_solids();
    std::map<Index, Index> by_number;
    for (const auto& [v, node] : imprinted.node) by_number[addition.node_ids[v]] = node;
    out.report = std::move(joint.report(0));
    out.mesh = std::move(joint.mesh(0));
    if (divisions.cuts.cuts.empty()) {
        out.addition = addition;
    } else {
        const DeckMarks marks = mark_deck(addition);
        Simplified parts = split_beams(marks.mesh ? *marks.mesh : addition, divisions.cuts, next_numbers(addition));
        for (std::size_t k = 0; k < parts.stops.size(); ++k) by_number[parts.stops[k]] = divisions.nodes[k];
        Refined divided = with_parts(addition, std::move(parts), marks, {});
        for (const std::string& warning : warnings_of(divided.trace.deck, options.strict))
            out.report.warnings.push_back("the addition: " + warning);
        out.addition = std::move(divided.mesh);
    }
    const NumberIndex numbers(out.addition);
    out.shared.assign(out.addition.points.size(), -1);
    for (const auto& [number, node] : by_number) out.shared[*numbers.node(number)] = node;
    return out;
}

}  // namespace femscalpel
