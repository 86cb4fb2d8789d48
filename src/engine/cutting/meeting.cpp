// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/meeting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "cancel.h"
#include "mesh/closest_point.h"
#include "mesh/near_boxes.h"
#include "mesh/stopwatch.h"
#include "mesh/surface.h"
#include "mesh/surface_tree.h"

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;

/// What touches, in the shorter of the two mean edge lengths.
constexpr double touching = 0.1;
/// Where surfaces cross, what is nearer than this part of the shortest mean edge length is one point.
constexpr double crossing_tolerance = 1e-3;
/// Sine of the angle from which on a border that comes near does not lie there.
constexpr double steep = 0.3;
/// The same for flat faces, along a whole edge.
constexpr double shallow = 0.1;
/// Faces whose surface is no farther off them, in their edges, are flat, but for rounding.
constexpr double straight = 1e-5;
/// Where borders cross, the one may seem to go on along the other for so many times as much as it may be off.
constexpr double overshoot = 2.5;
/// Cosine of the angle from which on a border does not run along another.
constexpr double parallel = 0.8;
/// Cosine of the angle between normals, opposite or alike, from which on faces of solids do not lie on each other.
constexpr double flush = 0.8;
/// An edge runs along a border if both its ends are near it, or from its start to its end the two part by no more than
/// so many times as much as it may be off: one that crosses the border at a small angle does not.
constexpr double drift = 2.5;
/// Places along a border edge at which it is looked whether it touches.
constexpr int samples = 16;

/// A piece of a border on the other mesh.
struct Touch {
    Span span;
    MeetingLines::Sides sides;
    double reach;  ///< as far it may be off
};

/// Finds the meeting of two meshes. A node of the second that touches the first counts as being there.
class Meeter {
public:
    Meeter(const Mesh& a, const Mesh& b, std::optional<double> tolerance) : given_(tolerance) {
        meshes_ = {a, b};
        for (const std::size_t m : {0U, 1U}) meshes_[m].companion.reset();
        const Box box_a = box_around(a), box_b = box_around(b);
        // How far apart what touches can be is known only when the faces there are.
        const double apart = tolerance.value_or(touching * std::min(longest_edge(a), longest_edge(b)));
        const Box common = grown(box_a, apart).intersection(grown(box_b, apart));
        for (const std::size_t m : {0U, 1U})
            faces_[m] = common.isEmpty() ? std::vector<SurfaceFace>() : surface_near(meshes_[m], grown(common, apart));
        for (const std::size_t m : {0U, 1U}) trees_[m] = std::make_unique<SurfaceTree>(meshes_[m], faces_[m]);
    }

    Meeting run() {
        Meeting out = find();
        out.facets = has_facets();
        return out;
    }

private:
    Meeting find() {
        if (faces_[0].empty() || faces_[1].empty()) return {};
        find_fineness();
        if (are_solids()) {
            find_lying();
            // What bounds a volume has no loose ends; with these, something only nearly touches.
            find_crossings();
            if (std::vector<MeetingLine> outline = lines(); !outline.empty() && is_closed(outline))
                return {std::move(outline), 0};
            crossings_.clear();
            // What is where it should be, but for rounding, would only be blurred by more.
            const std::vector<Vec3> points = meshes_[1].points;
            const auto wide = std::exchange(given_, std::min(fine_, given_.value_or(fine_)));
            if (Meeting exact = meet(); !exact.lines.empty() && bounds_patches(exact.lines)) return exact;
            given_ = wide;
            meshes_[1].points = points;
            touches_.clear();
            placed_ = {};
            crossings_.clear();
        }
        return meet();
    }

    /// Whether a face that lies on the other's is one of a curved surface.
    bool has_facets() const {
        for (const std::size_t m : {0U, 1U})
            for (std::size_t f = 0; f < lying_[m].size(); ++f) {
                const int face = static_cast<int>(f);
                if (lying_[m][f] && trees_[m]->sag(face) > straight * trees_[m]->size(face)) return true;
            }
        return false;
    }

    struct Crossing {
        Span span;
        std::array<int, 2> face;
    };

    /// The longest edge of a mesh.
    static double longest_edge(const Mesh& mesh) {
        double longest = 0;
        for (const CellBlock& b : mesh.blocks()) {
            const CellTraits& t = traits(b.type);
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                for (const auto& e : t.edges)
                    longest = std::max(longest, (mesh.points[n[e[0]]] - mesh.points[n[e[1]]]).squaredNorm());
            }
        }
        return std::sqrt(longest);
    }

    /// What touches, and where else the two cross.
    Meeting meet() {
        find_touches(0);
        find_touches(1);
        put_touching_nodes_there();
        find_crossings();
        Meeting out{lines(), 0};
        for (const Touch& t : touches_) out.tolerance = std::max(out.tolerance, t.reach);
        return out;
    }

    bool are_solids() const {
        return std::ranges::all_of(faces_, [](const std::vector<SurfaceFace>& faces) {
            return std::ranges::none_of(faces, &SurfaceFace::shell);
        });
    }

    /// How many lines end at each place where one does.
    static std::map<std::array<double, 3>, int> ends_of(const std::vector<MeetingLine>& lines) {
        std::map<std::array<double, 3>, int> ends;
        for (const MeetingLine& line : lines)
            if (!line.closed)
                for (const Vec3& x : {line.points.front().at, line.points.back().at}) ++ends[{x[0], x[1], x[2]}];
        return ends;
    }

    /// Whether lines are loops, as where two skins cross.
    static bool is_closed(const std::vector<MeetingLine>& lines) {
        return std::ranges::all_of(ends_of(lines), [](const auto& end) { return end.second % 2 == 0; });
    }

    /// Whether lines bound patches, which may have sides in common.
    static bool bounds_patches(const std::vector<MeetingLine>& lines) {
        return std::ranges::all_of(ends_of(lines), [](const auto& end) { return end.second > 1; });
    }

    void find_fineness() {
        double least = std::numeric_limits<double>::infinity();
        for (const std::size_t m : {0U, 1U})
            for (int f = 0; f < static_cast<int>(faces_[m].size()); ++f) least = std::min(least, trees_[m]->size(f));
        fine_ = crossing_tolerance * least;
    }

    /// How far what touches may be off, by the sizes of the two faces and how far a smooth surface may be off them.
    double reach_of(double size, double sag, double other_size, double other_sag) const {
        // Of shells only the other's surface counts: their own border is a line of its own.
        const double off = lying_[0].empty() ? other_sag : std::max(sag, other_sag);
        return given_.value_or(std::max(touching * std::min(size, other_size), 1.5 * off));
    }

    /// Faces of solids that lie on the other's, as those of a sleeve on a shaft do: facets of different sizes, of which
    /// one is now above, now below the other. Where they cross says nothing.
    void find_lying() {
        for (const std::size_t m : {0U, 1U}) lying_[m].assign(faces_[m].size(), 0);
        SparseCheck check(64);
        for (const std::size_t m : {0U, 1U})
            for (int f = 0; f < static_cast<int>(faces_[m].size()); ++f) {
                check();
                const TriangleCorners at = corners(m, faces_[m][f]);
                lying_[m][f] = lies_there(m, f, (at[0] + at[1] + at[2]) / 3, flush) &&
                               std::ranges::all_of(at, [&](const Vec3& x) { return lies_there(m, f, x, 0); });
            }
    }

    /// Whether a point of a face of mesh m is on the other, whose normal there makes at least that cosine with its own.
    bool lies_there(std::size_t m, int face, const Vec3& x, double cosine) const {
        const SurfaceTree &own = *trees_[m], &other = *trees_[1 - m];
        const SurfaceTree::Foot foot = other.closest(x);
        return foot.distance <=
                   reach_of(own.size(face), own.sag(face), other.size(foot.piece), other.sag(foot.piece)) &&
               std::abs(own.normal(face).dot(other.normal(foot.piece))) >= cosine;
    }

    bool lie_on_each_other(int i, int j) const {
        return !lying_[0].empty() && (lying_[0][i] || lying_[1][j]) &&
               std::abs(trees_[0]->normal(i).dot(trees_[1]->normal(j))) >= flush;
    }

    /// A border edge of a mesh.
    struct Edge {
        std::size_t mesh;
        int face;
        Index nodes[2];
        Vec3 start, way;
        double size;  ///< the shorter of its length and its face's mean edge
        Vec3 at(double t) const { return start + t * way; }
    };

    /// Where a point of a border is on the other mesh; nothing where it does not touch. `reach`: as far it may be off.
    std::optional<SurfaceTree::Foot> touch(const Edge& edge, double t, double* reach = nullptr) const {
        const SurfaceTree& other = *trees_[1 - edge.mesh];
        const Vec3 x = edge.at(t);
        SurfaceTree::Foot foot = other.closest(x);
        const double most =
            reach_of(edge.size, trees_[edge.mesh]->sag(edge.face), other.size(foot.piece), other.sag(foot.piece));
        if (reach) *reach = most;
        if (foot.distance > most) return {};
        // Beside the other's border only what runs along it is on it.
        const SurfaceTree::Foot border = other.closest_on_border(x);
        if (border.piece < 0 || border.distance > most) return foot;
        const auto [a, b] = other.border()[border.piece];
        const auto& points = meshes_[1 - edge.mesh].points;
        const Vec3 line = (points[b] - points[a]).normalized();
        const auto is_near = [&](double end) {
            return other.closest_on_border(edge.at(end)).distance <= std::max(most, 0.1 * edge.way.norm());
        };
        const bool along = std::abs(line.dot(edge.way.normalized())) > parallel &&
                           (line.cross(edge.way).norm() <= drift * most || (is_near(0) && is_near(1)));
        const bool beside = (foot.at - border.at).norm() <= 1e-9 * other.size(foot.piece);
        if (!along) return beside && foot.distance > 0.1 * most ? std::nullopt : std::optional(foot);
        return SurfaceTree::Foot{border.at, border.distance, other.face_at_border(border.piece)};
    }

    /// Pieces of the border of mesh m that are on the other.
    void find_touches(std::size_t m) {
        const SurfaceTree& own = *trees_[m];
        const auto& points = meshes_[m].points;
        SparseCheck check(64);
        for (int e = 0; e < static_cast<int>(own.border().size()); ++e) {
            check();
            const auto [p, q] = own.border()[e];
            const Vec3 way = points[q] - points[p];
            const int face = own.face_at_border(e);
            const Edge edge{m, face, {p, q}, points[p], way, std::min(own.size(face), way.norm())};
            const auto at = [&](double t) { return touch(edge, t).has_value(); };
            for (int from = 0; from <= samples;) {
                if (!at(from / static_cast<double>(samples))) {
                    ++from;
                    continue;
                }
                int to = from;
                while (to < samples && at((to + 1) / static_cast<double>(samples))) ++to;
                add_touch(edge, own.border_normal(e), edge_of_touch(at, from, -1), edge_of_touch(at, to, +1));
                from = to + 1;
            }
        }
    }

    /// Where between a sample that touches and the next, which does not, that ends.
    static double edge_of_touch(auto at, int sample, int step) {
        double in = sample / static_cast<double>(samples);
        if (sample + step < 0 || sample + step > samples) return in;
        double out = (sample + step) / static_cast<double>(samples);
        for (int k = 0; k < 30; ++k) {
            const double middle = (in + out) / 2;
            (at(middle) ? in : out) = middle;
        }
        return in;
    }

    /// Whether what seems to touch flat faces leaves them, or passes, at an angle. Who gives a tolerance means it.
    bool rises(const Edge& edge, double start, double end, const SurfaceTree::Foot& first,
               const SurfaceTree::Foot& last, double length) const {
        const SurfaceTree& other = *trees_[1 - edge.mesh];
        const auto is_curved = [&](int face) { return other.sag(face) > straight * other.size(face); };
        if (given_ || first.piece < 0 || last.piece < 0 || is_curved(first.piece) || is_curved(last.piece))
            return false;
        const double before = (edge.at(start) - first.at).dot(other.normal(first.piece)),
                     after = (edge.at(end) - last.at).dot(other.normal(last.piece));
        return std::abs(after - before) > shallow * length;
    }

    void add_touch(const Edge& edge, const Vec3& normal, double start, double end) {
        const std::size_t m = edge.mesh;
        const SurfaceTree& other = *trees_[1 - m];
        double reach = 0;
        const auto first = touch(edge, start), last = touch(edge, end, &reach), middle = touch(edge, (start + end) / 2);
        const double length = (end - start) * edge.way.norm();
        if (!first || !last || !middle || length <= 0) return;
        // An edge that but ends there, or passes, at an angle, does not lie there.
        const auto [low, high] = std::minmax({first->distance, last->distance, middle->distance});
        if (length < 4 * reach && high - low > steep * length) return;
        if (rises(edge, start, end, *first, *last, length)) return;
        Touch out{{first->at, last->at},
                  {{normal, other.normal(middle->piece)}, {edge.size, other.size(middle->piece)}},
                  reach};
        if (m == 1) {
            std::swap(out.sides.normal[0], out.sides.normal[1]);
            std::swap(out.sides.size[0], out.sides.size[1]);
        }
        for (const auto& [t, k] : {std::pair(start, 0U), std::pair(end, 1U)}) {
            // The first mesh stays as it is.
            if (m == 0) out.span[k] = edge.at(t);
            if (t == 0 || t == 1) placed_[m].insert_or_assign(edge.nodes[k], out.span[k]);
        }
        touches_.push_back(out);
    }

    void put_touching_nodes_there() {
        for (const auto& [n, at] : placed_[1]) meshes_[1].points[n] = at;
    }

    /// Whether a span runs along what touches; one that but ends there is a line of its own.
    bool is_touched(const Span& span) const {
        const Vec3 way = (span[1] - span[0]).normalized();
        const auto near = [&](const Vec3& x) {
            return std::ranges::any_of(touches_, [&](const Touch& t) {
                return (closest_on_segment(t.span[0], t.span[1], x) - x).norm() <= 2 * t.reach &&
                       std::abs((t.span[1] - t.span[0]).normalized().dot(way)) >= parallel;
            });
        };
        return near(span[0]) && near(span[1]) && near((span[0] + span[1]) / 2);
    }

    std::vector<std::pair<int, int>> near_pairs() const {
        std::array<std::vector<Box>, 2> boxes;
        for (const std::size_t m : {0U, 1U})
            for (const SurfaceFace& f : faces_[m]) {
                Box box;
                for (const Vec3& x : corners(m, f)) box.extend(x);
                boxes[m].push_back(grown(box, fine_));
            }
        return near_boxes(boxes[0], boxes[1]);
    }

    TriangleCorners corners(std::size_t m, const SurfaceFace& f) const {
        const auto& points = meshes_[m].points;
        return {points[f.nodes[0]], points[f.nodes[1]], points[f.nodes[2]]};
    }

    void find_crossings() {
        SparseCheck check(64);
        for (const auto& [i, j] : near_pairs()) {
            check();
            if (lie_on_each_other(i, j)) continue;
            const auto span = cross_triangles(corners(0, faces_[0][i]), corners(1, faces_[1][j]), fine_);
            if (span && !is_touched(*span)) crossings_.push_back({*span, {i, j}});
        }
    }

    std::vector<MeetingLine> lines() const {
        MeetingLines out(fine_);
        for (const std::size_t m : {0U, 1U}) {
            for (const auto& [n, at] : placed_[m]) out.add_node(at, m, n);
            std::set<Index> nodes;
            const auto& points = meshes_[m].points;
            for (const Crossing& c : crossings_)
                for (const Index n : faces_[m][c.face[m]].nodes)
                    if ((points[n] - c.span[0]).norm() <= fine_ || (points[n] - c.span[1]).norm() <= fine_)
                        nodes.insert(n);
            for (const Index n : nodes) out.add_node(points[n], m, n);
        }
        for (const Crossing& c : crossings_)
            out.add(c.span, {{trees_[0]->normal(c.face[0]), trees_[1]->normal(c.face[1])},
                             {trees_[0]->size(c.face[0]), trees_[1]->size(c.face[1])}});
        double reach = 0;
        for (const Touch& t : touches_)
            for (const Vec3& x : t.span) out.add_point(x);
        for (const Touch& t : touches_) {
            out.add(t.span, t.sides, t.reach);
            reach = std::max(reach, t.reach);
        }
        out.prune(overshoot * reach);
        return out.pieces();
    }

    std::optional<double> given_;
    std::array<Mesh, 2> meshes_;
    std::array<std::vector<SurfaceFace>, 2> faces_;
    std::array<std::unique_ptr<SurfaceTree>, 2> trees_;
    std::array<std::vector<char>, 2> lying_;  // by face, of solids
    double fine_ = 0;                         // crossing_tolerance, as a length
    std::vector<Touch> touches_;
    std::array<std::map<Index, Vec3>, 2> placed_;  // nodes of borders that touch, and where
    std::vector<Crossing> crossings_;
};

}  // namespace

Meeting find_meeting(const Mesh& a, const Mesh& b, std::optional<double> tolerance) {
    return Meeter(a, b, tolerance).run();
}

}  // namespace femscalpel
