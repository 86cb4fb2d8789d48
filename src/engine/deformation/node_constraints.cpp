// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/node_constraints.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "cancel.h"
#include "deformation/foot.h"
#include "groups/band_boundaries.h"

namespace femscalpel {
namespace {

/// Square of the sine of the angle up to which a tool runs along a surface (line): 0.06 degrees.
constexpr double parallel = 1e-6;

/// Whether two nodes are in one simplex of a list.
bool share(const auto& list, int a, int b) {
    return std::ranges::any_of(list.around(a), [&](int s) { return std::ranges::find(list[s], b) != list[s].end(); });
}

/// Groups whose boundary is not kept.
std::vector<bool> drifting_groups(const Mesh& mesh, const ConstraintOptions& options) {
    std::vector<bool> drifting(mesh.groups.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g)
        drifting[g] = (!options.meaningless.empty() && options.meaningless[g]) ||
                      (mesh.groups[g].hidden ? options.kept_hidden.empty() || !options.kept_hidden[g]
                                             : !options.drifting_groups.empty() && options.drifting_groups[g]);
    return drifting;
}

double off_tools(const Contact& tools, const Vec3& x) {
    double off = 0;
    for (const Tool* t : tools.tools()) off = std::max(off, std::abs(t->distance(x)));
    return off;
}

/// The search of a near point on the shape of a constraint (not a fixed one) and on tools.
class Projection {
public:
    /// A tool that runs along the shape and is no farther than `near` off it adds nothing. What is left of the tools
    /// then may be off by `held`.
    Projection(const KeptGeometry& geometry, const NodeConstraint& constraint, const Contact& tools, double near,
               double held)
        : geometry_(geometry),
          at_(constraint),
          tools_(tools),
          across_(tools),
          near_(near),
          held_(held),
          free_(constraint.freedom == NodeFreedom::free),
          surface_(constraint.freedom == NodeFreedom::surface),
          exact_(geometry.is_straight(constraint)),
          tight_(1e-14 * geometry.size),
          accept_(exact_                             ? 1e-12 * geometry.size
                  : geometry.is_on_shape(constraint) ? 1e-11 * geometry.size
                                                     : 1e-9 * geometry.size) {}

    /// Where it ends: at a point on all; or at one on the shape and on `across`, while the tools that run along the
    /// shape are still to be met; or nowhere.
    enum class End { none, on_all, beside_tools };

    End run(Vec3& x) {
        for (int i = 0; i < 60; ++i) {
            const Foot foot = foot_of(x);
            at_.hint = foot.piece;
            if (i == 0) leave_out_parallel(foot);
            if (std::sqrt(foot.distance2) <= (exact_ ? tight_ : accept_) && off_tools(across_, x) <= tight_)
                return end(x);
            switch (step(foot, x)) {
                case Step::taken:
                    break;
                case Step::at_meeting:
                    return end(x);
                case Step::none:
                    return End::none;
            }
        }
        // At a kink of a faceted surface the steps may alternate between two facets: close enough counts.
        const Foot foot = foot_of(x);
        if (std::sqrt(foot.distance2) > (exact_ ? accept_ : 1e-6 * geometry_.size)) return End::none;
        return off_tools(across_, x) <= 1e-12 * geometry_.size ? end(x) : End::none;
    }

    /// The constraint, with the facet or segment last seen on.
    const NodeConstraint& at() const { return at_; }

private:
    enum class Step { none, taken, at_meeting };

    Foot foot_of(const Vec3& x) const {
        if (free_) return {.at = x};
        return surface_ ? surface_foot(geometry_, at_, x) : curve_foot(geometry_, at_, x);
    }

    /// The part of `n` along the shape.
    Vec3 along_shape(const Foot& foot, const Vec3& n) const {
        if (free_) return n;
        const Vec3 off_shape = n.dot(foot.normal) * foot.normal;
        return surface_ ? Vec3(n - off_shape) : off_shape;
    }

    /// Leaves the tools that do not merely run along the shape where the node is.
    void leave_out_parallel(const Foot& foot) {
        for (const Tool* t : tools_.tools())
            if (along_shape(foot, t->normal(foot.at)).squaredNorm() < parallel &&
                std::abs(t->distance(foot.at)) <= near_)
                across_ = across_.without(t);
    }

    End end(const Vec3& x) const {
        return across_.count() == tools_.count() || off_tools(tools_, x) <= 1.001 * held_ ? End::on_all
                                                                                          : End::beside_tools;
    }

    /// From the foot, along the shape, onto the tangent planes of the tools.
    Step step(const Foot& foot, Vec3& x) const {
        if (across_.count() > 1) return step_to_meeting(foot, x);
        x = foot.at;
        if (!across_) return Step::taken;
        const Tool& tool = *across_.tools()[0];
        const Vec3 along = along_shape(foot, tool.normal(foot.at));
        const double slope = along.squaredNorm();
        if (slope < parallel) return Step::none;
        x -= (tool.distance(foot.at) / slope) * along;
        return Step::taken;
    }

    /// The shortest such step with several tools: along = A^T m with A A^T m = -distances.
    Step step_to_meeting(const Foot& foot, Vec3& x) const {
        const int count = across_.count();
        Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> a(count, 3);
        Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> d(count);
        for (int k = 0; k < count; ++k) {
            a.row(k) = along_shape(foot, across_.tools()[k]->normal(foot.at)).transpose();
            d[k] = across_.tools()[k]->distance(foot.at);
        }
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
        if (svd.singularValues()[count - 1] < 1e-3) {
            // More tools than directions: only right where they happen to meet.
            if (off_tools(across_, foot.at) > 1e-12 * geometry_.size) return Step::none;
            x = foot.at;
            return Step::at_meeting;
        }
        x = foot.at - Vec3(svd.solve(d));
        return Step::taken;
    }

    const KeptGeometry& geometry_;
    NodeConstraint at_;
    const Contact& tools_;
    Contact across_;
    double near_, held_;
    bool free_, surface_, exact_;
    double tight_, accept_;
};

}  // namespace

NodeConstraints::NodeConstraints(const BandMesh& band, const Mesh& mesh, const ConstraintOptions& options) {
    const BandBoundaries boundaries(band, mesh, drifting_groups(mesh, options), options.on_shortcuts,
                                    options.meaningless);
    geometry_ = find_kept_geometry(band, mesh, boundaries, options);
    close_ = std::max({1e-10 * geometry_.size, options.tolerance, options.rounding});
    nodes_.resize(static_cast<std::size_t>(band.size()));
    find_shells(band);
    find_loose(band, mesh, options);
    find_isolated(band, boundaries, options);
    find_freedom(band, options);
    find_exterior();
}

void NodeConstraints::find_shells(const BandMesh& band) {
    SparseCheck check(64);
    shell_.assign(static_cast<std::size_t>(band.triangles.size()), 0);
    for (int t = 0; t < band.triangles.size(); ++t, check()) {
        const auto& v = band.triangles[t];
        shell_[t] = std::ranges::none_of(band.tetras.around(v[0]), [&](int s) {
            const auto& n = band.tetras[s];
            return std::ranges::find(n, v[1]) != n.end() && std::ranges::find(n, v[2]) != n.end();
        });
    }
}

/// Segments that hang loose hold what they are attached to.
void NodeConstraints::find_loose(const BandMesh& band, const Mesh& mesh, const ConstraintOptions& options) {
    loose_.assign(static_cast<std::size_t>(band.lines.size()), 0);
    for (int l = 0; l < band.lines.size(); ++l) {
        const auto& v = band.lines[l];
        if (share(band.tetras, v[0], v[1]) || share(band.triangles, v[0], v[1])) continue;
        const CellRef& cell = band.line_cells[l];
        const bool whole = !options.whole.empty() && options.whole[mesh.block(cell.type).families[cell.cell]];
        const double length = (band.nodes[v[0]].at - band.nodes[v[1]].at).norm();
        loose_[l] = whole || length <= close_ ? other : beam;
        for (int n : v) fix_node(n);
    }
}

/// Isolated members of groups (IE) do not move.
void NodeConstraints::find_isolated(const BandMesh& band, const BandBoundaries& boundaries,
                                    const ConstraintOptions& options) {
    kinds_ = boundaries.kinds();
    has_shortcuts_ = !boundaries.shortcuts().empty();
    for (const BandBoundaries::Node& n : boundaries.isolated()) {
        fix_node(n.node);
        isolated_.push_back({n.node, n.kind});
    }
    for (const auto& [a, b] : boundaries.isolated_middles()) fixed_middles_.insert(edge_key(a, b));
    if (!options.pinned.empty())
        for (const auto& [key, mid] : band.mid_nodes)
            if (std::ranges::binary_search(options.pinned, mid)) fixed_middles_.insert(key);
}

/// Of the nodes that nothing else has fixed.
void NodeConstraints::find_freedom(const BandMesh& band, const ConstraintOptions& options) {
    SparseCheck check(64);
    leash_.assign(nodes_.size(), std::numeric_limits<double>::infinity());
    held_.assign(nodes_.size(), 0);
    if (!options.related.empty())
        for (const BandNode& n : band.nodes) related_.push_back(std::ranges::binary_search(options.related, n.global));
    for (int v = 0; v < band.size(); ++v) {
        check();
        if (!band.nodes[v].movable() || !band.vertices.around(v).empty() ||
            std::ranges::binary_search(options.pinned, band.nodes[v].global))
            fix_node(v);
        if (nodes_[v].freedom == NodeFreedom::fixed) {
            held_[v] = band.nodes[v].movable();
            continue;
        }
        const KeptGeometry::Place place = geometry_.place_of(v);
        nodes_[v] = place.constraint;
        leash_[v] = place.leash;
    }
}

void NodeConstraints::find_exterior() {
    exterior_.assign(nodes_.size(), 0);
    for (const KeptGeometry::Facet& f : geometry_.facets)
        if (geometry_.surfaces[f.shape].is_skin())
            for (int v : f.node) exterior_[v] = 1;
    for (const KeptGeometry::Segment& s : geometry_.segments)
        if (geometry_.curves[s.shape].border)
            for (int v : s.node) exterior_[v] = 1;
}

NodeConstraint NodeConstraints::on_edge(const BandMesh& band, int a, int b) const {
    if (const int crease = band.creases.find({a, b}); crease >= 0)
        return geometry_.on_segment(band.creases.origin(crease));
    for (const int s : band.skin.around(a)) {
        const auto& v = band.skin[s];
        if (std::ranges::find(v, b) != v.end()) return geometry_.on_facet(band.skin.origin(s));
    }
    return {};
}

NodeConstraint NodeConstraints::on_face(const BandMesh& band, int a, int b, int c) const {
    const int face = band.skin.find({a, b, c});
    return face < 0 ? NodeConstraint{} : geometry_.on_facet(band.skin.origin(face));
}

void NodeConstraints::add_node(const BandMesh& band, int node) {
    nodes_.resize(static_cast<std::size_t>(band.size()));
    exterior_.resize(static_cast<std::size_t>(band.size()), 0);
    leash_.resize(static_cast<std::size_t>(band.size()), std::numeric_limits<double>::infinity());
    const auto& [a, b] = band.births[node - band.original_nodes()];
    nodes_[node] = on_edge(band, a, node);
    if (!related_.empty()) {
        related_.resize(static_cast<std::size_t>(band.size()));
        related_[node] = related_[a] && related_[b];
        if (related_[node] && nodes_[node].freedom != NodeFreedom::free) nodes_[node].freedom = NodeFreedom::fixed;
    }
    for (const int s : band.skin.around(node))
        if (surface(band, s).is_skin()) exterior_[node] = 1;
    for (const int s : band.creases.around(node))
        if (is_border(band, s)) exterior_[node] = 1;
}

void NodeConstraints::add_lone_node(const BandMesh& band, int node, bool exterior) {
    nodes_.resize(static_cast<std::size_t>(band.size()));
    exterior_.resize(static_cast<std::size_t>(band.size()), 0);
    leash_.resize(static_cast<std::size_t>(band.size()), std::numeric_limits<double>::infinity());
    if (!related_.empty()) related_.resize(static_cast<std::size_t>(band.size()));
    if (!exterior) return;
    exterior_[node] = 1;
    fix_node(node);
}

bool NodeConstraints::is_skin_edge(const BandMesh& band, int a, int b) const {
    return std::ranges::any_of(band.skin.around(a), [&](int s) {
        return !surface(band, s).internal && std::ranges::find(band.skin[s], b) != band.skin[s].end();
    });
}

bool NodeConstraints::is_exterior_edge(const BandMesh& band, int a, int b) const {
    if (const int crease = band.creases.find({a, b}); crease >= 0 && is_border(band, crease)) return true;
    return std::ranges::any_of(band.skin.around(a), [&](int s) {
        return surface(band, s).is_skin() && std::ranges::find(band.skin[s], b) != band.skin[s].end();
    });
}

bool NodeConstraints::is_internal_edge(const BandMesh& band, int a, int b) const {
    return std::ranges::any_of(band.skin.around(a), [&](int s) {
        return surface(band, s).internal && std::ranges::find(band.skin[s], b) != band.skin[s].end();
    });
}

bool NodeConstraints::is_on_skin(const BandMesh& band, int node) const {
    return std::ranges::any_of(band.skin.around(node), [&](int s) { return !surface(band, s).internal; });
}

bool NodeConstraints::is_on_internal(const BandMesh& band, int node) const {
    return std::ranges::any_of(band.skin.around(node), [&](int s) { return surface(band, s).internal; });
}

bool NodeConstraints::project(const NodeConstraint& c, const Contact& tools, Vec3& x, double held) const {
    if (c.freedom == NodeFreedom::fixed) return off_tools(tools, x) <= close_;
    const bool free = c.freedom == NodeFreedom::free;
    if (!tools) {
        if (!free) x = (c.freedom == NodeFreedom::surface ? surface_foot : curve_foot)(geometry_, c, x).at;
        return true;
    }
    Projection projection(geometry_, c, tools, std::max(close_, 1.001 * held), held);
    switch (projection.run(x)) {
        case Projection::End::on_all:
            return true;
        case Projection::End::none:
            return false;
        case Projection::End::beside_tools:
            break;
    }
    // There the tools are what counts.
    return project(NodeConstraint{}, tools, x) && distance(projection.at(), x) <= 2 * close_;
}

int NodeConstraints::tangents(int node, const Contact& tools, const Vec3& x, Eigen::Matrix3d& basis) const {
    const NodeConstraint& c = nodes_[node];
    // Orthonormal directions the node may not move in.
    Eigen::Matrix3d held;
    int count = 0;
    switch (c.freedom) {
        case NodeFreedom::fixed:
            return 0;
        case NodeFreedom::curve:
            if (tools) return 0;
            basis.col(0) = curve_foot(geometry_, c, x).normal;
            return 1;
        case NodeFreedom::surface:
            held.col(count++) = surface_foot(geometry_, c, x).normal;
            break;
        case NodeFreedom::free:
            break;
    }
    for (const Tool* t : tools.tools()) {
        if (count == 3) return 0;
        Vec3 n = t->normal(x);
        for (int k = 0; k < count; ++k) n -= held.col(k).dot(n) * held.col(k);
        const double length = n.norm();
        if (length < 1e-3) {
            if (c.freedom == NodeFreedom::surface && count == 1 && geometry_.surfaces[c.shape].flat &&
                std::isinf(t->feature_size()))
                continue;  // a plane on a plane
            return 0;
        }
        held.col(count++) = n / length;
    }
    switch (count) {
        case 0:
            basis.setIdentity();
            return 3;
        case 1:
            basis.col(0) = held.col(0).unitOrthogonal();
            basis.col(1) = held.col(0).cross(basis.col(0));
            return 2;
        case 2:
            basis.col(0) = held.col(0).cross(held.col(1)).normalized();
            return 1;
        default:
            return 0;
    }
}

double NodeConstraints::distance(const NodeConstraint& c, const Vec3& x) const {
    if (c.freedom == NodeFreedom::surface) return std::sqrt(surface_foot(geometry_, c, x).distance2);
    if (c.freedom == NodeFreedom::curve) return std::sqrt(curve_foot(geometry_, c, x).distance2);
    return 0;
}

std::vector<int> NodeConstraints::kinds_at(const BandMesh& band, int node) const {
    std::vector<int> kinds;
    for (const int s : band.skin.around(node)) kinds.push_back(surface(band, s).kind);
    for (const int s : band.creases.around(node)) kinds.push_back(geometry_.curves[band.creases.tag(s)].kind);
    const auto alone = std::ranges::lower_bound(isolated_, node, {}, [](const auto& n) { return n.first; });
    if (alone != isolated_.end() && alone->first == node) kinds.push_back(alone->second);
    std::ranges::sort(kinds);
    kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
    return kinds;
}

std::vector<GroupIndex> NodeConstraints::groups_at(const BandMesh& band, int node) const {
    std::set<GroupIndex> groups;
    for (const int kind : kinds_at(band, node)) groups.insert(kinds_.groups(kind).begin(), kinds_.groups(kind).end());
    return {groups.begin(), groups.end()};
}

std::vector<NodeConstraints::GroupCount> NodeConstraints::count_by_group(const BandMesh& band,
                                                                         std::span<const int> nodes,
                                                                         std::size_t group_count) const {
    // Many nodes lie on few combinations of kinds: these are counted, and spread over their groups at the end.
    std::map<std::vector<int>, GroupCount> by_kinds;
    for (const int v : nodes) {
        GroupCount& count = by_kinds[kinds_at(band, v)];
        switch (nodes_[v].freedom) {
            case NodeFreedom::free:
                break;
            case NodeFreedom::surface:
                ++count.surface;
                break;
            case NodeFreedom::curve:
                ++count.line;
                break;
            case NodeFreedom::fixed:
                ++count.fixed;
                break;
        }
    }
    std::vector<GroupCount> out(group_count);
    std::vector<GroupIndex> groups;
    for (const auto& [combination, count] : by_kinds) {
        groups.clear();
        for (const int kind : combination)
            groups.insert(groups.end(), kinds_.groups(kind).begin(), kinds_.groups(kind).end());
        std::ranges::sort(groups);
        groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
        for (const GroupIndex g : groups) {
            out[g].surface += count.surface;
            out[g].line += count.line;
            out[g].fixed += count.fixed;
        }
    }
    return out;
}

std::optional<Vec3> NodeConstraints::surface_normal(const NodeConstraint& c, const Vec3& x) const {
    if (c.freedom != NodeFreedom::surface) return {};
    return surface_foot(geometry_, c, x).normal;
}

}  // namespace femscalpel
