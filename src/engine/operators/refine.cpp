// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/refine.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <nanoflann.hpp>
#include <queue>
#include <set>
#include <sstream>
#include <unordered_set>

#include "cancel.h"
#include "cutting/checks.h"
#include "cutting/folded_input.h"
#include "cutting/locate.h"
#include "cutting/mend_curved.h"
#include "cutting/opening.h"
#include "cutting/rebuild.h"
#include "cutting/workpiece.h"
#include "deck/carry_over.h"
#include "deck/mark_deck.h"
#include "deck/solver_input.h"
#include "deformation/curved_shape.h"
#include "deformation/relaxation.h"
#include "groups/opened_areas.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

void require(bool holds, const std::string& what, double value, const char* rule) {
    if (holds) return;
    std::ostringstream message;
    message << what << " is " << value << "; it must be " << rule;
    throw ToolError(message.str());
}

void check(const RefineOptions& o) {
    require(std::isfinite(o.size) && o.size > 0, "size", o.size, "a positive length");
    require(std::isfinite(o.gradation) && o.gradation >= 0, "gradation", o.gradation,
            "0 (one size everywhere) or more");
    require(std::isfinite(o.reach) && o.reach >= 0, "reach", o.reach, "0 or a positive length");
    require(o.max_elements > 0, "max_elements", static_cast<double>(o.max_elements), "positive");
    require(o.feature_angle > 0 && o.feature_angle < 180, "feature_angle", o.feature_angle,
            "between 0 and 180 degrees");
}

/// How long edges may be.
class Target {
public:
    Target(const DistanceField& distance, const RefineOptions& options) : distance_(distance), options_(options) {}

    double distance(const Vec3& x) const { return distance_(x); }

    /// Whether an edge between `a` and `b`, at distances `da` and `db`, has to be bisected.
    bool exceeded(const Vec3& a, const Vec3& b, double da, double db) const {
        const double length = (b - a).norm();
        if (length <= options_.size) return false;
        // Distances change by no more than the way between two points, so most edges are settled by their ends.
        const double ends = std::min(std::abs(da), std::abs(db));
        const bool crosses = (da < 0) != (db < 0);
        if (!crosses && length <= longest(std::max(0.0, ends - length / 2))) return false;
        if (crosses || length > longest(ends)) return true;
        const double middle = distance_((a + b) / 2);
        return (middle < 0) != (da < 0) || length > longest(std::min(ends, std::abs(middle)));
    }

private:
    double longest(double distance) const {
        return options_.size + options_.gradation * std::max(0.0, distance - options_.reach);
    }

    const DistanceField& distance_;
    const RefineOptions& options_;
};

/// Marks the corners of elements that have an edge to be bisected, level 0.
std::vector<std::int8_t> find_long_edges(const Mesh& mesh, const Target& target, const std::vector<double>& distance) {
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 2) continue;
        std::vector<Index> unsupported;
        SparseCheck check(256);
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            check();
            const bool is_long = std::ranges::any_of(t.edges, [&](const auto& e) {
                return target.exceeded(mesh.points[n[e[0]]], mesh.points[n[e[1]]], distance[n[e[0]]],
                                       distance[n[e[1]]]);
            });
            if (!is_long) continue;
            if (!t.simplex) unsupported.push_back(b.ids[c]);
            for (int k = 0; k < t.corners; ++k) level[n[k]] = 0;
        }
        if (unsupported.empty()) continue;
        std::string numbers;
        for (std::size_t k = 0; k < unsupported.size() && k < 5; ++k)
            numbers += (k ? ", " : "") + std::to_string(unsupported[k]);
        if (unsupported.size() > 5) numbers += ", ...";
        throw UnsupportedElementError(
            "the refinement reaches " + std::to_string(unsupported.size()) + " " + std::string(t.name) + " elements (" +
            numbers + "); only triangles and tetrahedra can be bisected. Choose a larger size or gradation, " +
            "or split these elements into tetrahedra first");
    }
    return level;
}

/// Edges of elements that cannot be bisected, between nodes of the band.
std::unordered_set<std::uint64_t> blocked_edges(const Mesh& mesh, const BandMesh& band) {
    std::unordered_set<std::uint64_t> blocked;
    std::vector<int> local(mesh.points.size(), -1);
    for (int v = 0; v < band.size(); ++v) local[band.nodes[v].global] = v;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.simplex) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (const auto& e : t.edges)
                if (local[n[e[0]]] >= 0 && local[n[e[1]]] >= 0)
                    blocked.insert(edge_key(local[n[e[0]]], local[n[e[1]]]));
        }
    }
    return blocked;
}

/// A band's geometry before it is refined: where points of its elements are, second-order ones on their curves.
class InputGeometry {
public:
    InputGeometry(const BandMesh& band, const MidSides& mids, const Mesh& mesh) : band_(band) {
        for (const auto& [key, node] : band.mid_nodes) mids_.emplace(key, mesh.points[node]);
        for (const auto& [key, bulge] : mids.mended()) {
            const int a = static_cast<int>(key >> 32), b = static_cast<int>(key & 0xffffffffu);
            mids_[key] = (input(a) + input(b)) / 2 + mids.bulge(a, b);
        }
        SparseCheck check;
        const auto look = [&](const auto& list, std::vector<char>& curved) {
            curved.assign(static_cast<std::size_t>(list.size()), 0);
            for (int s = 0; s < list.size(); ++s, check())
                for (std::size_t i = 0; i < list[s].size(); ++i)
                    for (std::size_t j = 0; j < i; ++j) curved[s] = curved[s] || bends(list[s][i], list[s][j]);
        };
        look(band.tetras, curved_tetras_);
        look(band.triangles, curved_triangles_);
        look(band.lines, curved_lines_);
    }

    /// Records the node just born in the middle of the edge a-b.
    void add_node(int a, int b) { born_.push_back(between(a, b)); }

    /// The middle, in the element's own parameters, of an edge inside an element of the input.
    Vec3 middle(int a, int b) const {
        const auto mid = mids_.find(edge_key(a, b));
        return mid == mids_.end() ? at(between(a, b)) : mid->second;
    }

    /// Whether an element around `node` is part of a curved one.
    bool is_curved_around(int node) const {
        const auto any = [&](const auto& list, const std::vector<char>& curved) {
            return std::ranges::any_of(list.around(node), [&](int s) { return curved[list.origin(s)] != 0; });
        };
        return any(band_.tetras, curved_tetras_) || any(band_.triangles, curved_triangles_) ||
               any(band_.lines, curved_lines_);
    }

private:
    /// A point by barycentric coordinates: up to four nodes of the input, the corners of a simplex.
    struct Place {
        std::array<int, 4> node{-1, -1, -1, -1};
        std::array<double, 4> weight{};

        void add(int n, double w) {
            for (int k = 0; k < 4; ++k) {
                if (node[k] >= 0 && node[k] != n) continue;
                node[k] = n;
                weight[k] += w;
                return;
            }
        }
    };

    const Vec3& input(int node) const { return band_.nodes[node].start; }

    bool bends(int a, int b) const {
        const auto mid = mids_.find(edge_key(a, b));
        if (mid == mids_.end()) return false;
        return (mid->second - (input(a) + input(b)) / 2).norm() > 1e-10 * (input(a) - input(b)).norm();
    }

    Place between(int a, int b) const {
        Place out;
        for (const int v : {a, b}) {
            if (!band_.is_new(v)) {
                out.add(v, 0.5);
                continue;
            }
            const Place& p = born_[v - band_.original_nodes()];
            for (int k = 0; k < 4; ++k)
                if (p.node[k] >= 0) out.add(p.node[k], p.weight[k] / 2);
        }
        return out;
    }

    Vec3 at(const Place& p) const {
        Vec3 x = Vec3::Zero();
        for (int i = 0; i < 4 && p.node[i] >= 0; ++i) {
            x += p.weight[i] * (2 * p.weight[i] - 1) * input(p.node[i]);
            for (int j = 0; j < i; ++j) {
                const auto mid = mids_.find(edge_key(p.node[i], p.node[j]));
                const Vec3 m = mid == mids_.end() ? Vec3((input(p.node[i]) + input(p.node[j])) / 2) : mid->second;
                x += 4 * p.weight[i] * p.weight[j] * m;
            }
        }
        return x;
    }

    const BandMesh& band_;
    std::unordered_map<std::uint64_t, Vec3> mids_;
    std::vector<Place> born_;
    std::vector<char> curved_tetras_, curved_triangles_, curved_lines_;  // by slot of the original element
};

/// Parts of elements with a mean ratio below this are not made.
constexpr double spoilt = 0.02;

class Bisector {
public:
    Bisector(Deformable& d, const Mesh& mesh, const Target& target, const RefineOptions& options,
             std::vector<double> distance, bool may_grow)
        : d_(d),
          band_(d.band),
          mesh_(mesh),
          target_(target),
          options_(options),
          distance_(std::move(distance)),
          may_grow_(may_grow),
          blocked_(blocked_edges(mesh, d.band)),
          geometry_(d.band, d.mids, mesh) {}

    /// False when an edge had to be bisected some of whose elements are outside the band.
    bool run() {
        const int rounds = options_.relax ? 3 : 1;
        for (int round = 0; round < rounds; ++round) {
            const int before = band_.size();
            if (!split_long_edges()) return false;
            if (band_.size() == before || !options_.relax) break;
            improve();
            if (round == rounds - 1 && !split_long_edges()) return false;  // what relaxing has stretched
        }
        if (options_.skin) put_on_shape();
        return true;
    }

    /// New nodes of the skin that are off the shape the mesh was made from, because elements would have been spoilt.
    int off_shape() const { return off_shape_; }

    /// The middle of an edge: in the input's geometry, unless relaxing took an end of it from where it was there.
    Vec3 middle(int a, int b) const {
        return strayed_[a] || strayed_[b] ? Vec3((band_.nodes[a].at + band_.nodes[b].at) / 2) : geometry_.middle(a, b);
    }

    /// Edges that were left as they are because their elements are so curved that parts of them would be flat.
    int left() const { return static_cast<int>(left_.size()); }

    /// Where a mid-side node between two nodes belongs.
    Vec3 mid_side(int a, int b) const {
        Vec3 x = middle(a, b);
        if (!options_.skin || (!band_.is_new(a) && !band_.is_new(b))) return x;
        const NodeConstraint on = d_.constraints.on_edge(band_, a, b);
        if (Vec3 put = x; d_.constraints.is_on_shape(on) && d_.constraints.project(on, {}, put) &&
                          (put - x).norm() < 0.2 * (band_.nodes[a].at - band_.nodes[b].at).norm())
            x = put;
        return x;
    }

private:
    /// Edges in the order they are bisected in. Lengths are rounded, so that rounding does not decide between equal
    /// ones.
    struct Edge {
        float length;
        int a, b;
        bool operator<(const Edge& other) const {
            return std::tie(length, a, b) < std::tie(other.length, other.a, other.b);
        }
    };

    Edge edge(int a, int b) const {
        return {static_cast<float>((band_.nodes[a].at - band_.nodes[b].at).squaredNorm()), std::min(a, b),
                std::max(a, b)};
    }
    bool exceeded(int a, int b) const {
        return target_.exceeded(band_.nodes[a].at, band_.nodes[b].at, distance_[a], distance_[b]);
    }
    bool is_inside(int a, int b) const { return band_.nodes[a].movable() || band_.nodes[b].movable(); }

    template <class Visit>
    void for_each_around(int a, int b, Visit visit) const {
        const auto look = [&](const auto& list) {
            for (const int s : list.around(a))
                if (std::ranges::find(list[s], b) != list[s].end()) visit(list[s]);
        };
        look(band_.tetras);
        look(band_.triangles);
    }

    bool exists(int a, int b) const {
        bool found = false;
        for_each_around(a, b, [&](const auto&) { found = true; });
        return found;
    }

    bool split_long_edges() {
        std::priority_queue<Edge> queue;
        std::vector<int> neighbours;
        const auto gather = [&](int v, bool once) {
            band_.neighbours(v, neighbours);
            for (const int w : neighbours)
                if ((!once || v < w) && is_inside(v, w) && exceeded(v, w) && exists(v, w)) queue.push(edge(v, w));
        };
        SparseCheck check(64);
        for (int v = 0; v < band_.size(); ++v, check()) gather(v, true);
        while (!queue.empty()) {
            check();
            const Edge e = queue.top();
            if (!exists(e.a, e.b) || left_.contains(edge_key(e.a, e.b))) {
                queue.pop();
                continue;
            }
            const Edge longest = terminal(e);
            if (!is_inside(longest.a, longest.b)) return false;
            if (longest.a == e.a && longest.b == e.b) queue.pop();
            if (split(longest.a, longest.b)) gather(band_.size() - 1, false);
        }
        return true;
    }

    /// The end of the longest-edge propagation path from `e`: an edge that is the longest of all elements around it.
    Edge terminal(Edge e) const {
        for (;;) {
            Edge longest = e;
            for_each_around(e.a, e.b, [&](const auto& nodes) {
                for (std::size_t i = 0; i < nodes.size(); ++i)
                    for (std::size_t j = 0; j < i; ++j) {
                        const Edge other = edge(nodes[i], nodes[j]);
                        const std::uint64_t key = edge_key(other.a, other.b);
                        if (!(longest < other) || blocked_.contains(key) || left_.contains(key)) continue;
                        if (may_grow_ || is_inside(other.a, other.b)) longest = other;
                    }
            });
            if (longest.a == e.a && longest.b == e.b) return e;
            e = longest;
            if (!is_inside(e.a, e.b)) return e;
        }
    }

    /// Whether parts of the elements around an edge would be nearly flat or inverted, split in its bent middle: their
    /// curved shape may be sound all the same, but not what is made of their corners.
    bool would_spoil(int a, int b, const Vec3& at) const {
        if (at == (band_.nodes[a].at + band_.nodes[b].at) / 2) return false;
        const double worst = d_.worst_part(a, b, at);
        return worst < spoilt && worst < d_.worst_part(a, b, (band_.nodes[a].at + band_.nodes[b].at) / 2) / 2;
    }

    bool split(int a, int b) {
        Vec3 at = middle(a, b);
        if (would_spoil(a, b, at)) {
            left_.insert(edge_key(a, b));
            return false;
        }
        geometry_.add_node(a, b);
        // On the shape the mesh was made from, if that leaves sound elements.
        bool on_shape = false;
        if (options_.skin && d_.constraints.is_on_shape(d_.constraints.on_edge(band_, a, b)) &&
            !d_.constraints.has_fixed_middle(a, b)) {
            const Deformable::SplitPoint point = d_.fitted_split(a, b, at, {});
            on_shape = point.fits && point.worst > 0.1;
            if (on_shape) at = point.at;
        }
        d_.split_edge(a, b, at, {});
        strayed_.push_back(on_shape || strayed_[a] || strayed_[b]);
        distance_.push_back(target_.distance(at));
        if (mesh_.cell_count() + band_.tetras.size() + band_.triangles.size() <=
            options_.max_elements + count_at_start_)
            return true;
        std::ostringstream message;
        message << "size " << options_.size << " would make more than " << options_.max_elements
                << " elements. Choose a larger size or gradation, or a larger max_elements";
        throw ToolError(message.str());
    }

    /// Brings nodes onto the shape for which there was no room when they were born.
    void put_on_shape() {
        bool moved = true;
        for (int round = 0; round < 5 && moved; ++round) {
            moved = false;
            off_shape_ = 0;
            for (int v = band_.original_nodes(); v < band_.size(); ++v) {
                Vec3 x = band_.nodes[v].at;
                if (!d_.constraints.is_on_shape(d_.constraints[v]) ||
                    d_.constraints.distance(d_.constraints[v], x) <= 1e-9 * band_.mean_edge_length(v))
                    continue;
                if (!d_.constraints.project(v, {}, x) ||
                    quality_around(d_, v, x) < std::min(0.1, quality_around(d_, v, band_.nodes[v].at))) {
                    ++off_shape_;
                    continue;
                }
                band_.nodes[v].at = x;
                distance_[v] = target_.distance(x);
                strayed_[v] = 1;
                moved = true;
            }
        }
    }

    /// Relaxes new nodes wherever that changes neither the geometry nor a border.
    void improve() {
        std::vector<int> movable;
        SparseCheck check(64);
        for (int v = band_.original_nodes(); v < band_.size(); ++v, check()) {
            if (band_.nodes[v].global >= 0 || geometry_.is_curved_around(v)) continue;
            const NodeConstraint& c = d_.constraints[v];
            if (c.freedom == NodeFreedom::fixed ||
                (c.freedom == NodeFreedom::surface && !d_.constraints.is_flat(c.shape)) ||
                (c.freedom == NodeFreedom::curve && !d_.constraints.is_straight(c.shape)))
                continue;
            movable.push_back(v);
        }
        relax(d_, movable);
        for (const int v : movable) {
            distance_[v] = target_.distance(band_.nodes[v].at);
            strayed_[v] = strayed_[v] || band_.nodes[v].at != band_.nodes[v].start;
        }
    }

    Deformable& d_;
    BandMesh& band_;
    const Mesh& mesh_;
    const Target& target_;
    const RefineOptions& options_;
    std::vector<double> distance_;  // by band node
    int off_shape_ = 0;
    const bool may_grow_;  // whether a larger band may be asked for; otherwise propagation ends at the rim
    const Index count_at_start_ = band_.tetras.size() + band_.triangles.size();
    const std::unordered_set<std::uint64_t> blocked_;
    std::unordered_set<std::uint64_t> left_;  // see left()
    InputGeometry geometry_;
    /// By band node: it is not where its place in the input's elements says, as it or a node it was born between moved.
    std::vector<char> strayed_ = std::vector<char>(static_cast<std::size_t>(band_.size()), 0);
};

/// Points in the form nanoflann asks for, and its search tree.
struct NearestPoint {
    struct Cloud {
        std::vector<Vec3> points;
        std::size_t kdtree_get_point_count() const { return points.size(); }
        double kdtree_get_pt(std::size_t k, std::size_t axis) const {
            return points[k][static_cast<Eigen::Index>(axis)];
        }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    using Distance = nanoflann::L2_Simple_Adaptor<double, Cloud>;

    explicit NearestPoint(std::vector<Vec3> points) : cloud{std::move(points)}, tree(3, cloud) {}

    Cloud cloud;
    nanoflann::KDTreeSingleIndexAdaptor<Distance, Cloud, 3, std::size_t> tree;
};

/// Elements of the band that were split, and their parts.
void describe_quality(const Mesh& mesh, const Workpiece& f, const Rebuilt& rebuilt, Report& report) {
    std::set<Index> attached;  // triangles on tetrahedra: their shape is that of the tetrahedra
    for (std::size_t t = 0; t < f.d.band.triangle_cells.size(); ++t)
        if (const CellRef& c = f.d.band.triangle_cells[t]; !f.d.constraints.is_shell(static_cast<int>(t)))
            attached.insert(mesh.block(c.type).ids[c.cell]);
    for (const Changes::Part& part : rebuilt.changes.parts)
        if (attached.contains(part.parent)) attached.insert(part.element);
    const auto collect = [&](const Mesh& m, const std::vector<CellRef>& cells) {
        std::vector<ElementQuality> out;
        SparseCheck check;
        for (const CellRef& c : cells) {
            check();
            if (const Index id = m.block(c.type).ids[c.cell]; traits(c.type).dimension > 1 && !attached.contains(id))
                out.push_back({id, mean_ratio(m, c.type, c.cell)});
        }
        return out;
    };
    report.quality_before = summarise(collect(mesh, rebuilt.before));
    report.quality_after = summarise(collect(rebuilt.mesh, rebuilt.after));
}

}  // namespace

DistanceField distance_to(std::vector<const Tool*> tools) {
    if (tools.empty()) throw ToolError("near is empty: give a tool or points to refine around");
    return [tools = std::move(tools)](const Vec3& x) {
        double nearest = tools[0]->distance(x);
        for (std::size_t k = 1; k < tools.size(); ++k)
            if (const double d = tools[k]->distance(x); std::abs(d) < std::abs(nearest)) nearest = d;
        return nearest;
    };
}

DistanceField distance_to(std::vector<Vec3> points) {
    if (points.empty()) throw ToolError("near is empty: give a tool or points to refine around");
    for (std::size_t k = 0; k < points.size(); ++k)
        if (!points[k].allFinite())
            throw ToolError("near: point " + std::to_string(k) + " has a value that is not a finite number");
    return [search = std::make_shared<const NearestPoint>(std::move(points))](const Vec3& x) {
        std::size_t nearest = 0;
        double squared = 0;
        search->tree.knnSearch(x.data(), 1, &nearest, &squared);
        return std::sqrt(squared);
    };
}

Result refine(const Mesh& input, const DistanceField& distance, const RefineOptions& options) {
    Laps seconds;
    Stopwatch watch(seconds);
    std::vector<Index> on_shortcuts;
    if (std::optional<Result> result = refine_where_needed(input, distance, options, on_shortcuts))
        return std::move(*result);
    watch.lap("locate");
    Result untouched;
    const FamilyTotals totals = family_totals(input);
    untouched.report.operation = "refine";
    untouched.report.method = "bisection";
    untouched.report.groups = compare_groups(input, totals, input, totals);
    for (GroupRecord& r : untouched.report.groups) r.status = "untouched";
    untouched.report.warnings = {"no edge is longer than wanted: nothing was refined"};
    untouched.mesh = input;
    watch.lap("report");
    untouched.report.seconds = seconds.list();
    return untouched;
}

std::optional<Result> refine_where_needed(const Mesh& input, const DistanceField& distance,
                                          const RefineOptions& options, std::vector<Index>& on_shortcuts) {
    check(options);
    Result result;
    Report& report = result.report;
    report.operation = "refine";
    report.method = "bisection";
    Laps seconds;
    Stopwatch watch(seconds);
    const Target target(distance, options);
    std::vector<double> distances(input.points.size());
    SparseCheck check(256);
    for (std::size_t n = 0; n < distances.size(); ++n, check()) distances[n] = target.distance(input.points[n]);
    const std::vector<std::int8_t> core = find_long_edges(input, target, distances);
    watch.lap("locate");
    if (std::ranges::find(core, 0) == core.end()) return {};
    const DeckMarks marks = mark_deck(input);
    const Mesh& mesh = marks.mesh ? *marks.mesh : input;
    if (input.companion) watch.lap("mark deck");
    auto copy = async_obeying(std::launch::async,
                              [&mesh] { return std::pair(std::make_unique<Mesh>(mesh), family_totals(mesh)); });

    ConstraintOptions constraint_options;
    constraint_options.feature_angle = options.feature_angle;
    constraint_options.kept_hidden = marks.kept;
    constraint_options.meaningless = groups_of(marks.surface_sets, mesh);
    constraint_options.pinned = marks.pinned;
    constraint_options.related = marks.related;
    constraint_options.shape = options.skin;
    // The propagation of longest edges leaves the elements to be refined by a few elements, seldom more.
    constexpr int first_band = 2, last_band = 64;
    std::optional<Workpiece> f;
    std::optional<Bisector> bisector;
    for (int levels = first_band;; levels *= 4) {
        std::vector<std::int8_t> level = core;
        spread_levels(mesh, level, levels);
        bisector.reset();
        f.reset();
        f.emplace(Workpiece{.d = Deformable(extract_band(mesh, level, nullptr, true), mesh, constraint_options),
                            .tool = nullptr,
                            .tolerance = 0,
                            .bandwidth = 0});
        check_input_shape(*f, mesh);
        check_skin(*f);
        std::vector<double> known(static_cast<std::size_t>(f->d.band.size()));
        for (int v = 0; v < f->d.band.size(); ++v) known[v] = distances[f->d.band.nodes[v].global];
        bisector.emplace(f->d, mesh, target, options, std::move(known), levels < last_band);
        if (bisector->run()) break;
    }
    watch.lap("bisect");

    if (!f->folded_input.empty()) check_folded_input(*f, newly_folded(*f, folded_elements(*f, 0)));
    put_back_middles(*f, mesh);
    f->mid_side = [&](int a, int b) { return bisector->mid_side(a, b); };
    auto [output, totals] = await(copy);
    Rebuilt rebuilt = rebuild(mesh, std::move(*output), *f, no_opening(f->d.band), {}, next_numbers(mesh));
    if (!marks.surface_sets.empty())
        renew_surface_sets(rebuilt.mesh, marks.surface_sets, *solver_input(input), rebuilt.after);
    watch.lap("rebuild");
    for (int v = f->d.band.original_nodes(); v < f->d.band.size(); ++v)
        if (const Index n = rebuilt.node[v]; n >= 0 && f->d.constraints[v].freedom == NodeFreedom::free &&
                                             !rebuilt.mesh.families.groups(rebuilt.mesh.node_families[n]).empty())
            on_shortcuts.push_back(rebuilt.mesh.node_ids[n]);
    report.warnings = f->warnings;
    for (std::string& warning : warnings_of_opened_areas(f->d.band, mesh))
        report.warnings.push_back(std::move(warning));
    if (bisector->left() > 0)
        report.warnings.push_back(std::to_string(bisector->left()) +
                                  " edge(s) stay longer than wanted: the second-order elements around them are so "
                                  "curved that parts of them would be flat or inverted by their corners");
    if (bisector->off_shape() > 0)
        report.warnings.push_back(
            std::to_string(bisector->off_shape()) +
            " new node(s) of the skin stay on its triangles: on the shape they would spoil elements");
    if (input.companion) {
        carry_deck(mesh, rebuilt.mesh, rebuilt.changes, options.strict, report.warnings);
        watch.lap("carry deck");
    }
    report.nodes_added = report.nodes_split = rebuilt.nodes_split;
    report.elements_added = rebuilt.elements_added;
    describe_quality(mesh, *f, rebuilt, report);
    if (report.quality_before.minimum > 0 && report.quality_after.minimum <= 0)
        throw QualityError("elements would be inverted by refinement; choose a larger size, or another place");
    FamilyTotals after = totals;
    count_cells(after, mesh, rebuilt.before, -1);
    count_cells(after, rebuilt.mesh, rebuilt.after, +1);
    recount_nodes_and_facets(after, rebuilt.mesh);
    report.groups = compare_groups(mesh, totals, rebuilt.mesh, after);
    for (GroupRecord& r : report.groups)
        if (r.status == "kept" && r.count_before == r.count_after) r.status = "untouched";
    remove_marks(rebuilt.mesh);
    watch.lap("report");
    report.seconds = seconds.list();
    result.mesh = std::move(rebuilt.mesh);
    return result;
}

}  // namespace femscalpel
