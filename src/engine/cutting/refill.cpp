// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/refill.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>
#include <unsupported/Eigen/BVH>
#include <utility>

#include "cancel.h"
#include "cutting/cavity.h"
#include "cutting/checks.h"
#include "cutting/fill.h"
#include "cutting/rebuild.h"
#include "cutting/surface_line.h"
#include "mesh/band_mesh.h"
#include "mesh/crop.h"
#include "mesh/middles.h"
#include "mesh/near_boxes.h"
#include "mesh/stopwatch.h"
#include "mesh/surface.h"
#include "mesh/surface_tree.h"

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;
/// Tetrahedra as near to the other's skin as this, in its edges, are taken out, so that there is room for good ones.
constexpr double room = 0.6;

/// For Eigen's BVMinimize: the point nearest to a place.
struct Nearest {
    using Scalar = double;
    const std::vector<Vec3>& points;
    const Vec3& x;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();

    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVMinimize() calls them.
    double minimumOnVolume(const Box& box) const { return box.squaredExteriorDistance(x); }
    double minimumOnObject(int k) {
        const double d = (points[k] - x).squaredNorm();
        if (d < least) {
            least = d;
            best = k;
        }
        return d;
    }
    // NOLINTEND(readability-identifier-naming)
};

class Refiller {
public:
    Refiller(const Mesh& mesh, const Mesh& other, const std::vector<Index>& partner,
             const std::vector<SurfaceFace>& covered, const std::vector<SurfaceFace>& cover)
        : mesh_(mesh), other_(other), partner_(partner), cover_(cover) {
        for (const SurfaceFace& f : covered) {
            covered_.insert(face_key(f.nodes));
            for (const Index n : f.nodes) on_cover_.insert(n);
        }
    }

    Refilled run() {
        check_faces();
        find_taken();
        find_cavity();
        assemble(fill());
        out_.borders = crossed_borders(mesh_, taken_, other_, [&](const FaceKey& face) { return is_filled(face); });
        return std::move(out_);
    }

private:
    Filled fill() const {
        try {
            return fill_cavity(points_, triangles_);
        } catch (const CavityError& error) {
            fail(error);
        }
    }

    [[noreturn]] void fail(const CavityError& error) const {
        const std::string cannot = "the two solids cannot be joined";
        const Box there = box_around(other_).intersection(box_around(mesh_));
        for (const Mesh* mesh : {&mesh_, &other_})
            if (const std::optional<Vec3> at = double_nodes(*mesh, there, error.at))
                throw QualityError(
                    cannot + ": double nodes, of a crack's lips or a contact, are where the two meet, as at " +
                        point_text(*at) +
                        ". Join the two before it is cracked, or move the addition off the double nodes",
                    "other");
        if (cover_.empty())
            throw QualityError(cannot +
                                   ": they touch in a line or a point alone. They have to touch over an area, or to "
                                   "overlap. Move the addition, or leave that part of it out",
                               "other");
        throw QualityError(cannot + ": near " + point_text(error.at) + " their skins leave no volume between them (" +
                               error.why +
                               "), as where they run along each other at a small angle. Move the addition a little, or "
                               "refine both there first",
                           "other");
    }

    /// The type of the solid's tetrahedra that may be taken.
    static bool is_tetra(CellType type) { return traits(type).linear == CellType::tetra; }

    void for_each_solid(auto visit) const {
        for (const CellBlock& b : mesh_.blocks())
            if (traits(b.type).dimension == 3)
                for (Index c = 0; c < b.size(); ++c)
                    visit(CellRef{b.type, c}, b.nodes(c).first(static_cast<std::size_t>(traits(b.type).corners)));
    }

    Box box_of(std::span<const Index> nodes) const {
        Box box;
        for (const Index n : nodes) box.extend(mesh_.points[n]);
        return box;
    }

    /// Tetrahedra that have a node on the covered skin or inside the other, or come near the part of the other's skin.
    void find_taken() {
        std::vector<Box> boxes;
        for (const SurfaceFace& f : cover_) {
            Box box;
            double size = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                box.extend(other_.points[f.nodes[k]]);
                size += (other_.points[f.nodes[k]] - other_.points[f.nodes[(k + 1) % 3]]).norm() / 3;
            }
            boxes.push_back(grown(box, room * size));
        }
        const BoxTree cover(std::move(boxes));
        const Box inside = box_around(other_).intersection(box_around(mesh_));
        const std::vector<SurfaceFace> skin = surface_near(other_, grown(inside, 0.1 * inside.diagonal().norm()));
        const SurfaceTree other(other_, skin);
        std::unordered_map<Index, bool> within;
        const auto is_within = [&](Index n) {
            const auto [found, fresh] = within.emplace(n, false);
            if (fresh && inside.contains(mesh_.points[n]))
                found->second = on_cover_.contains(n) || other.signed_distance(mesh_.points[n]) < 0;
            return found->second;
        };
        SparseCheck check(64);
        for_each_solid([&](CellRef cell, std::span<const Index> nodes) {
            check();
            const Box box = box_of(nodes);
            if (!box.intersects(cover.all()) && !box.intersects(inside)) return;
            bool take = std::ranges::any_of(nodes, [&](Index n) { return on_cover_.contains(n) || is_within(n); });
            take = take || cover.meets(box);
            if (take && !is_tetra(cell.type)) fail_to_replace(mesh_.points[nodes.front()]);
            if (take) taken_[static_cast<int>(cell.type)].push_back(cell.cell);
        });
    }

    /// Throws where faces are no tetrahedra's.
    void check_faces() const {
        check_faces(other_, cover_);
        std::vector<SurfaceFace> own;
        own.reserve(covered_.size());
        for (const FaceKey& key : covered_) own.push_back({key, false});
        check_faces(mesh_, own);
    }

    static void check_faces(const Mesh& mesh, const std::vector<SurfaceFace>& faces) {
        const auto is_other = [](const CellBlock& b) {
            return b.size() > 0 && traits(b.type).dimension == 3 && !traits(b.type).simplex;
        };
        const auto other = std::ranges::find_if(mesh.blocks(), is_other);
        if (other == mesh.blocks().end()) return;
        std::set<FaceKey> left;
        for (const SurfaceFace& f : faces) left.insert(face_key(f.nodes));
        for (const CellBlock& b : mesh.blocks()) {
            if (!is_tetra(b.type)) continue;
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                for (const auto& f : outward_faces) left.erase(face_key({n[f[0]], n[f[1]], n[f[2]]}));
            }
        }
        if (!left.empty()) fail_to_replace(mesh.points[(*left.begin())[0]]);
    }

    [[noreturn]] static void fail_to_replace(const Vec3& at) {
        throw QualityError("elements other than tetrahedra are where the two meet, as at " + point_text(at) +
                               ", and could not be divided. Split them into tetrahedra first, or join the two with "
                               "method='tie'",
                           "other");
    }

    bool is_taken(CellRef cell) const {
        return std::ranges::binary_search(taken_[static_cast<int>(cell.type)], cell.cell);
    }

    /// The cavity's faces: of the taken tetrahedra those that are not between two of them, nor covered; and, turned
    /// round, the part of the other's skin.
    void find_cavity() {
        std::map<FaceKey, std::pair<FaceKey, int>> faces;  // as they are, and how many tetrahedra have them
        for (int type = 0; type < cell_type_count; ++type)
            for (const Index c : taken_[type]) {
                ++out_.taken;
                const auto n = mesh_.blocks()[type].nodes(c);
                for (const auto& f : outward_faces) {
                    const FaceKey face{n[f[0]], n[f[1]], n[f[2]]};
                    auto& entry = faces.emplace(face_key(face), std::pair(face, 0)).first->second;
                    ++entry.second;
                }
            }
        for (const auto& [key, face] : faces)
            if (face.second > 1)
                between_.insert(key);
            else if (!covered_.contains(key)) {
                left_.insert(key);
                triangles_.push_back({own(face.first[0]), own(face.first[1]), own(face.first[2])});
            }
        for (const SurfaceFace& f : cover_)
            triangles_.push_back({others(f.nodes[0]), others(f.nodes[2]), others(f.nodes[1])});
    }

    /// The cavity's point for a node of the mesh, or of the other.
    int own(Index n) { return partner_[n] >= 0 ? others(partner_[n]) : point(own_points_, n, mesh_.points[n]); }
    int others(Index n) { return point(other_points_, n, other_.points[n]); }
    int point(std::map<Index, int>& list, Index n, const Vec3& at) {
        const auto [found, fresh] = list.emplace(n, static_cast<int>(points_.size()));
        if (fresh) points_.push_back(at);
        return found->second;
    }

    void assemble(const Filled& filled) {
        out_.worst = filled.worst;
        const std::vector<Index> kept = keep_the_rest();
        const Numbering next = next_numbers(mesh_);
        number_ = next;
        // The cavity's points as nodes of the result.
        std::unordered_map<Index, Index> place;
        for (std::size_t n = 0; n < kept.size(); ++n) place[kept[n]] = static_cast<Index>(n);
        out_.partner.assign(kept.size(), -1);
        for (std::size_t n = 0; n < kept.size(); ++n) out_.partner[n] = partner_[kept[n]];
        std::unordered_map<Index, Index> of_partner;
        for (Index n = 0; n < mesh_.node_count(); ++n)
            if (partner_[n] >= 0) of_partner[partner_[n]] = n;
        at_.assign(points_.size() + filled.points.size(), -1);
        for (const auto& [n, p] : own_points_) at_[p] = place.contains(n) ? place[n] : add_old_node(n);
        for (const auto& [n, p] : other_points_) {
            if (const auto found = of_partner.find(n); found != of_partner.end()) {
                at_[p] = place.contains(found->second) ? place[found->second] : add_old_node(found->second);
                continue;
            }
            at_[p] = add_new_node(other_.points[n], n);
        }
        for (std::size_t k = 0; k < filled.points.size(); ++k)
            at_[points_.size() + k] = add_new_node(filled.points[k], -1);
        for (Index n = 0; n < mesh_.node_count(); ++n)
            if (partner_[n] >= 0 && other_points_.contains(partner_[n]))
                old_places_[n] = at_[other_points_.at(partner_[n])];
        for (const auto& [n, p] : own_points_) old_places_[n] = at_[p];
        add_elements(filled);
        for (const auto& [n, p] : place) old_places_.emplace(n, p);
        restore_skin();
    }

    /// A node of the mesh that only taken elements had, but which the cavity's faces have.
    Index add_old_node(Index n) {
        out_.partner.push_back(partner_[n]);
        return out_.mesh.add_node(mesh_.points[n], mesh_.node_ids[n], mesh_.node_families[n]);
    }

    Index add_new_node(const Vec3& at, Index partner) {
        out_.partner.push_back(partner);
        const Index node = out_.mesh.add_node(at, number_.node++);
        born_.emplace(node, false);
        return node;
    }

    /// New nodes of an element are in the node groups that hold the element it stands for: all of its corners or, of
    /// mid-side nodes, all of these.
    void join_node_groups(const std::vector<Index>& nodes, std::span<const Index> parent) {
        FamilyTable& families = out_.mesh.families;
        const auto common = [&](std::span<const Index> of) {
            FamilyIndex family = of.empty() ? 0 : mesh_.node_families[of.front()];
            for (const Index n : of) family = families.intersect(family, mesh_.node_families[n]);
            return family;
        };
        const auto join = [&](std::span<const Index> list, FamilyIndex family) {
            for (const Index n : list) {
                const auto born = born_.find(n);
                if (born == born_.end()) continue;
                FamilyIndex& own = out_.mesh.node_families[n];
                own = families.unite(own, family);
                if (std::exchange(born->second, true)) continue;
                out_.changes.born.push_back({out_.mesh.node_ids[n], {}});
                for (int k = 0; k < 4; ++k) out_.changes.born.back().ancestors.push_back(mesh_.node_ids[parent[k]]);
            }
        };
        join(std::span(nodes).first(4), common(parent.first(4)));
        join(std::span(nodes).subspan(4), common(parent.subspan(4)));
    }

    /// What is not taken out: all elements but the taken, and those on them that have no other to be on. The nodes of
    /// the mesh by node of the result.
    std::vector<Index> keep_the_rest() {
        std::vector<char> left(static_cast<std::size_t>(mesh_.node_count()), 0);
        CellLists cells;
        for (const CellBlock& b : mesh_.blocks()) {
            if (traits(b.type).dimension < 3) continue;
            for (Index c = 0; c < b.size(); ++c) {
                if (is_taken({b.type, c})) continue;
                cells[static_cast<int>(b.type)].push_back(c);
                for (const Index n : b.nodes(c)) left[n] = 1;
            }
        }
        std::vector<char> in_taken(left.size(), 0);
        for (int type = 0; type < cell_type_count; ++type)
            for (const Index c : taken_[type])
                for (const Index n : mesh_.blocks()[type].nodes(c)) in_taken[n] = 1;
        for (const CellBlock& b : mesh_.blocks()) {
            if (traits(b.type).dimension == 3) continue;
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                // What lies on taken elements alone is seen to later.
                const bool is_face = traits(b.type).corners == 3;
                const FaceKey key = is_face ? face_key({n[0], n[1], n[2]}) : FaceKey{-1, -1, -1};
                const bool gone = std::ranges::any_of(n, [&](Index v) { return in_taken[v] && !left[v]; }) ||
                                  (is_face && (covered_.contains(key) || between_.contains(key)));
                if (!gone)
                    cells[static_cast<int>(b.type)].push_back(c);
                else
                    loose_.push_back({b.type, c});
            }
        }
        Crop part = crop(mesh_, cells);
        out_.mesh = std::move(part.mesh);
        out_.mesh.companion = mesh_.companion;
        return std::move(part.nodes);
    }

    void add_elements(const Filled& filled) {
        std::vector<Vec3> centres;
        std::vector<CellRef> parents;
        bool second_order = false;
        for (int type = 0; type < cell_type_count; ++type)
            for (const Index c : taken_[type]) {
                const auto n = mesh_.blocks()[type].nodes(c);
                centres.emplace_back(
                    (mesh_.points[n[0]] + mesh_.points[n[1]] + mesh_.points[n[2]] + mesh_.points[n[3]]) / 4);
                parents.push_back({mesh_.blocks()[type].type, c});
                second_order = second_order || traits(parents.back().type).quadratic;
            }
        std::vector<int> objects(centres.size());
        std::iota(objects.begin(), objects.end(), 0);
        std::vector<Box> boxes;
        boxes.reserve(centres.size());
        for (const Vec3& x : centres) boxes.emplace_back(x);
        Eigen::KdBVH<double, 3, int> tree;
        tree.init(objects.begin(), objects.end(), boxes.begin(), boxes.end());
        if (second_order) find_middles();
        for (const Tetra& t : filled.tetras) {
            std::vector<Index> nodes;
            Vec3 centre = Vec3::Zero();
            for (const int p : t) {
                nodes.push_back(at_[p]);
                centre += out_.mesh.points[at_[p]] / 4;
            }
            Nearest nearest{centres, centre};
            Eigen::BVMinimize(tree, nearest);
            if (second_order)
                for (const auto& e : traits(CellType::tetra10).edges) nodes.push_back(middle(nodes[e[0]], nodes[e[1]]));
            const CellType type = second_order ? CellType::tetra10 : CellType::tetra;
            const CellRef& parent = parents[nearest.best];
            const CellBlock& of = mesh_.block(parent.type);
            out_.changes.parts.push_back({number_.cell, of.ids[parent.cell]});
            const Index cell = out_.mesh.add_cell(type, nodes, number_.cell++, of.families[parent.cell]);
            join_node_groups(nodes, of.nodes(parent.cell));
            out_.added.push_back({type, cell});
            for (int f = 0; f < 4; ++f) {
                const auto& o = outward_faces[f];
                filled_faces_[face_key({nodes[o[0]], nodes[o[1]], nodes[o[2]]})] = {type, cell};
            }
        }
    }

    /// Mid-side nodes that the result has already, or had on what is left of the skin.
    void find_middles() {
        middles_ = middles_of(out_.mesh);
        for (int type = 0; type < cell_type_count; ++type) {
            const CellTraits& t = all_cell_types()[type];
            if (!t.quadratic) continue;
            for (const Index c : taken_[type]) {
                const auto n = mesh_.blocks()[type].nodes(c);
                for (std::size_t k = 0; k < t.edges.size(); ++k) {
                    const auto a = old_places_.find(n[t.edges[k][0]]), b = old_places_.find(n[t.edges[k][1]]);
                    if (a == old_places_.end() || b == old_places_.end() ||
                        !is_left_edge(n[t.edges[k][0]], n[t.edges[k][1]]))
                        continue;
                    const auto key = mesh_edge_key(a->second, b->second);
                    if (!middles_.contains(key)) middles_[key] = add_old_node(n[t.corners + k]);
                }
            }
        }
    }

    /// Whether an edge of the mesh is one of what is left of its skin around the cavity.
    bool is_left_edge(Index a, Index b) {
        if (left_edges_.empty())
            for (const FaceKey& f : left_)
                for (std::size_t k = 0; k < 3; ++k) left_edges_.insert(std::minmax(f[k], f[(k + 1) % 3]));
        return left_edges_.contains(std::minmax(a, b));
    }

    Index middle(Index a, Index b) {
        const auto [found, fresh] = middles_.emplace(mesh_edge_key(a, b), out_.mesh.node_count());
        if (fresh) add_new_node((out_.mesh.points[a] + out_.mesh.points[b]) / 2, -1);
        return found->second;
    }

    /// Where a node of the mesh is in the result, or -1.
    Index place_now(Index n) const {
        const auto found = old_places_.find(n);
        return found == old_places_.end() ? -1 : found->second;
    }

    /// Whether a face of the mesh is one of what was filled in.
    bool is_filled(const FaceKey& face) const {
        return filled_faces_.contains(face_key({place_now(face[0]), place_now(face[1]), place_now(face[2])}));
    }

    /// Facets of taken elements, and elements on these, that lie on what is left of the skin.
    void restore_skin() {
        const auto now = [&](Index n) { return place_now(n); };
        std::vector<Index> nodes;
        for (const CellRef& c : loose_) {
            const CellBlock& b = mesh_.block(c.type);
            const CellTraits& t = traits(c.type);
            const auto n = b.nodes(c.cell);
            if (t.corners == 3 && covered_.contains(face_key({n[0], n[1], n[2]}))) continue;
            nodes.clear();
            for (int k = 0; k < t.corners; ++k) nodes.push_back(now(n[k]));
            if (std::ranges::any_of(nodes, [](Index v) { return v < 0; })) continue;
            if (t.corners == 3 && between_.contains(face_key({n[0], n[1], n[2]})) && !is_filled({n[0], n[1], n[2]}))
                continue;
            if (t.quadratic)
                for (const auto& e : t.edges) nodes.push_back(middle(nodes[e[0]], nodes[e[1]]));
            out_.mesh.add_cell(c.type, nodes, b.ids[c.cell], b.families[c.cell]);
        }
        for (const Facet& f : mesh_.facets) {
            if (traits(f.type).dimension < 3 || !is_taken({f.type, f.cell})) continue;
            const auto n = mesh_.block(f.type).nodes(f.cell);
            const auto& face = traits(f.type).faces[f.face - 1];
            if (covered_.contains(face_key({n[face[0]], n[face[1]], n[face[2]]}))) continue;
            FaceKey key{now(n[face[0]]), now(n[face[1]]), now(n[face[2]])};
            const auto found = filled_faces_.find(face_key(key));
            if (found == filled_faces_.end()) continue;
            out_.mesh.facets.push_back(
                {found->second.type, face_of(found->second, face_key(key)), f.family, found->second.cell});
        }
    }

    std::int8_t face_of(CellRef cell, const FaceKey& key) const {
        const auto n = out_.mesh.block(cell.type).nodes(cell.cell);
        const auto faces = traits(cell.type).faces;
        for (std::size_t k = 0; k < faces.size(); ++k)
            if (face_key({n[faces[k][0]], n[faces[k][1]], n[faces[k][2]]}) == key)
                return static_cast<std::int8_t>(k + 1);
        return 1;
    }

    const Mesh& mesh_;
    const Mesh& other_;
    const std::vector<Index>& partner_;
    const std::vector<SurfaceFace>& cover_;
    std::set<FaceKey> covered_;
    std::set<Index> on_cover_;  // nodes of the covered skin
    CellLists taken_;           // ascending
    std::vector<CellRef> loose_;
    std::set<FaceKey> left_, between_;  // the cavity's faces that are the mesh's; those between elements that are taken
    std::set<std::pair<Index, Index>> left_edges_;
    std::vector<Vec3> points_;
    std::vector<Triangle> triangles_;
    std::map<Index, int> own_points_, other_points_;
    std::vector<Index> at_;                        // node of the result, by point of the cavity
    std::unordered_map<Index, Index> old_places_;  // nodes of the mesh at the cavity, in the result
    std::unordered_map<std::uint64_t, Index> middles_;
    std::map<FaceKey, CellRef> filled_faces_;
    std::map<Index, bool> born_;  // nodes of the result that the mesh has not; whether the changes have them
    Numbering number_;
    Refilled out_;
};

}  // namespace

Refilled refill(const Mesh& mesh, const Mesh& other, const std::vector<Index>& partner,
                const std::vector<SurfaceFace>& covered, const std::vector<SurfaceFace>& cover) {
    return Refiller(mesh, other, partner, covered, cover).run();
}

}  // namespace femscalpel
