// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "cancel.h"
#include "cutting/crossing.h"
#include "cutting/surface_line.h"
#include "deck/solver_input.h"
#include "mesh/middles.h"
#include "mesh/near_boxes.h"
#include "mesh/stopwatch.h"
#include "mesh/surface.h"
#include "mesh/surface_tree.h"
#include "mesh/triangle_crossing.h"
#include "mesh/union_find.h"
#include "words.h"

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;

/// A crossing is farther than this from the edges of both triangles, in their size.
constexpr double inside = 1e-6;

Vec3 centre_of(const Mesh& mesh, CellRef cell) {
    Vec3 out = Vec3::Zero();
    const CellTraits& t = traits(cell.type);
    const auto nodes = mesh.block(cell.type).nodes(cell.cell);
    for (int k = 0; k < t.corners; ++k) out += mesh.points[nodes[k]] / t.corners;
    return out;
}

/// Faces of tetrahedra that one of the group and one of the others have.
std::set<FaceKey> faces_between(const Mesh& mesh, GroupIndex added) {
    std::vector<char> in_added(mesh.points.size(), 0);
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c)
            if (mesh.families.contains(b.families[c], added))
                for (const Index n : b.nodes(c)) in_added[n] = 1;
    std::map<FaceKey, std::array<bool, 2>> sides;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.linear != CellType::tetra) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (std::count_if(n.begin(), n.begin() + 4, [&](Index v) { return in_added[v] != 0; }) < 3) continue;
            const bool side = mesh.families.contains(b.families[c], added);
            for (const auto& f : t.faces) sides[face_key({n[f[0]], n[f[1]], n[f[2]]})][side ? 1 : 0] = true;
        }
    }
    std::set<FaceKey> out;
    for (const auto& [face, side] : sides)
        if (side[0] && side[1]) out.insert(face);
    return out;
}

/// Members of groups, by group.
using Counts = std::map<GroupIndex, Index>;

void count(Counts& counts, const Mesh& mesh, FamilyIndex family) {
    for (const GroupIndex g : mesh.families.groups(family))
        if (!mesh.groups[g].hidden) ++counts[g];
}

/// Facets and triangles in each group, of those whose corners `holds` says yes to.
Counts faces_in_groups(const Mesh& mesh, auto holds) {
    Counts out;
    for (const Facet& f : mesh.facets) {
        const CellTraits& t = traits(f.type);
        if (t.linear != CellType::tetra) continue;
        const auto n = mesh.block(f.type).nodes(f.cell);
        const auto& face = t.faces[f.face - 1];
        if (holds(face_key({n[face[0]], n[face[1]], n[face[2]]}))) count(out, mesh, f.family);
    }
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).linear != CellType::triangle) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (holds(face_key({n[0], n[1], n[2]}))) count(out, mesh, b.families[c]);
        }
    }
    return out;
}

std::vector<Index> sizes(const Mesh& mesh) {
    std::vector<Index> out(mesh.groups.size(), 0);
    const auto add = [&](FamilyIndex family) {
        for (const GroupIndex g : mesh.families.groups(family)) ++out[g];
    };
    for (const FamilyIndex f : mesh.node_families) add(f);
    for (const CellBlock& b : mesh.blocks())
        for (const FamilyIndex f : b.families) add(f);
    for (const Facet& f : mesh.facets) add(f.family);
    return out;
}

bool is_inside(const Vec3& x, const TriangleCorners& t) {
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    for (std::size_t k = 0; k < 3; ++k)
        if ((t[(k + 1) % 3] - t[k]).cross(x - t[k]).dot(normal) < inside * normal.squaredNorm()) return false;
    return true;
}

/// Where two triangles without a common node cross within both; crossed_element() does not see that where edges meet
/// nothing but edges.
std::optional<Vec3> crossing_of(const Mesh& mesh, const std::vector<FaceKey>& triangles) {
    std::vector<Box> boxes;
    for (const FaceKey& t : triangles) {
        Box& box = boxes.emplace_back();
        for (const Index n : t) box.extend(mesh.points[n]);
    }
    SparseCheck check(256);
    for (const auto& [i, j] : near_boxes(boxes, boxes)) {
        check();
        const FaceKey &s = triangles[i], &t = triangles[j];
        if (i >= j || std::ranges::any_of(s, [&](Index n) { return std::ranges::find(t, n) != t.end(); })) continue;
        const auto corners = [&](const FaceKey& k) {
            return TriangleCorners{mesh.points[k[0]], mesh.points[k[1]], mesh.points[k[2]]};
        };
        const TriangleCorners first = corners(s), second = corners(t);
        const auto span = cross_triangles(first, second, inside * boxes[i].diagonal().norm());
        if (!span) continue;
        const Vec3 middle = ((*span)[0] + (*span)[1]) / 2;
        if (is_inside(middle, first) && is_inside(middle, second)) return middle;
    }
    return {};
}

/// Whether the first node that elements of `part` have is inside the solid.
bool is_within(const Mesh& part, const Mesh& solid) {
    const std::vector<SurfaceFace> own = surface_near(part, box_around(part)),
                                   skin = surface_near(solid, box_around(solid));
    if (own.empty() || skin.empty() || solid.dimension() < 3) return false;
    return SurfaceTree(solid, skin).signed_distance(part.points[own.front().nodes[0]]) < 0;
}

}  // namespace

std::string extents_text(const Mesh& mesh, const Mesh& addition) {
    const Box a = box_around(mesh), b = box_around(addition);
    return "The mesh reaches from " + point_text(a.min()) + " to " + point_text(a.max()) + ", the addition from " +
           point_text(b.min()) + " to " + point_text(b.max());
}

void check_tolerance(const Mesh& mesh, const Mesh& addition, const std::optional<double>& tolerance) {
    /// It is smaller than this part of either mesh.
    constexpr double largest_tolerance = 0.25;
    if (!tolerance) return;
    const double mesh_size = box_around(mesh).diagonal().norm(), size = box_around(addition).diagonal().norm();
    std::ostringstream text;
    if (!(std::isfinite(*tolerance) && *tolerance > 0))
        text << "tolerance is " << *tolerance << "; it must be a positive length";
    else if (*tolerance > largest_tolerance * std::min(mesh_size, size))
        text << "tolerance is " << *tolerance << ", but the " << (size < mesh_size ? "addition" : "mesh")
             << " is no larger than " << std::min(mesh_size, size)
             << " from corner to corner: all of it would count as touching. Give a little more than the gap between "
                "the two, less than an edge length";
    if (!text.view().empty()) throw ToolError(text.str(), "tolerance");
}

void check_itself(const Mesh& addition) {
    std::vector<FaceKey> parts;
    for (const SurfaceFace& f : surface_near(addition, box_around(addition))) parts.push_back(f.nodes);
    std::optional<Vec3> at;
    if (const auto crossed = crossed_element(addition, parts)) at = centre_of(addition, *crossed);
    if (!at && addition.dimension() == 2) at = crossing_of(addition, parts);
    if (at)
        throw ToolError("the addition crosses itself, or lies on itself, at " + point_text(*at) +
                            ", where its parts have no common nodes. Merge these with each other first, or one after "
                            "the other with the mesh",
                        "other");
}

void check_within(const Mesh& mesh, const Mesh& addition) {
    const char* what = is_within(addition, mesh)   ? "the addition is inside the mesh"
                       : is_within(mesh, addition) ? "the mesh is inside the addition"
                                                   : nullptr;
    if (what)
        throw ToolError(std::string(what) +
                            ", and their surfaces meet nowhere: there is nothing to be added, and no "
                            "place to join them. Move the addition so that it reaches through the skin",
                        "other");
}

void check_pieces(const Mesh& result, const std::string& name) {
    const GroupIndex added = *result.find_group(name + "_ADDED", GroupKind::element),
                     seam = *result.find_group(name + "_SEAM", GroupKind::node);
    UnionFind pieces(result.points.size());
    std::vector<CellRef> first;
    for (const CellBlock& b : result.blocks()) {
        if (traits(b.type).dimension < 1) continue;
        for (Index c = 0; c < b.size(); ++c) {
            if (!result.families.contains(b.families[c], added)) continue;
            const auto n = b.nodes(c);
            for (const Index v : n) pieces.unite(static_cast<int>(n[0]), static_cast<int>(v));
            first.push_back({b.type, c});
        }
    }
    std::set<int> held;
    for (Index n = 0; n < result.node_count(); ++n)
        if (result.families.contains(result.node_families[n], seam)) held.insert(pieces.find(static_cast<int>(n)));
    for (const CellRef& cell : first)
        if (!held.contains(pieces.find(static_cast<int>(result.block(cell.type).nodes(cell.cell)[0]))))
            throw ToolError("a piece of the addition, at " + point_text(centre_of(result, cell)) +
                                ", does not meet the mesh, nor has it nodes in common with the pieces that do: nothing "
                                "would hold it. Move it, or leave it out",
                            "other");
}

void warn_of_buried(const Mesh& result, const std::string& added, Report& report) {
    const std::set<FaceKey> between = faces_between(result, *result.find_group(added, GroupKind::element));
    if (between.empty()) return;
    const Counts buried = faces_in_groups(result, [&](const FaceKey& key) { return between.contains(key); });
    if (buried.empty()) return;
    const Counts all = faces_in_groups(result, [](const FaceKey&) { return true; });
    std::string names;
    for (const auto& [group, faces] : buried)
        names += (names.empty() ? "'" : ", '") + result.groups[group].name + "' (" + std::to_string(faces) + " of " +
                 std::to_string(all.at(group)) + ")";
    report.warnings.push_back("faces of " + names +
                              " are inside now, between the mesh and the addition: what a solver is told to do there, "
                              "as a pressure, it still does. Take them out of the groups if it should not");
}

void warn_of_joined_groups(const Mesh& mesh, const Mesh& addition, Report& report) {
    const bool in_deck = solver_input(mesh) != nullptr;  // which compares names as CalculiX does
    std::string names;
    Index count = 0;
    for (GroupIndex g = 0; g < static_cast<GroupIndex>(addition.groups.size()); ++g) {
        const Group& group = addition.groups[g];
        if (group.hidden || group.kind == GroupKind::element) continue;
        const bool is_there = std::ranges::any_of(mesh.groups, [&](const Group& other) {
            return !other.hidden && other.kind == group.kind &&
                   (other.name == group.name || (in_deck && deck_key(other.name) == deck_key(group.name)));
        });
        if (!is_there) continue;
        const GroupMembers all = group_members(addition, g);
        const auto members = static_cast<Index>(all.ids.size());
        if (members == 0) continue;
        count += members;
        names += (names.empty() ? "'" : ", '") + group.name + "'";
    }
    if (count > 0)
        report.warnings.push_back("both have groups " + names +
                                  ", which are one now: what a solver is told to do there, "
                                  "as a support or a load, it does at " +
                                  counted(count, "node or facet", "nodes or facets") +
                                  " of the addition, too. join_groups=False keeps them apart");
}

void warn_of_hinge(Report& report) {
    report.warnings.emplace_back(
        "the addition's shells hold to the solid by its nodes, which have no rotations: they turn about the seam as "
        "about a hinge. Where they are welded on, add them as solid elements, or tie their rotations in the solver's "
        "input");
}

void check_seam_edges(const Mesh& result, const std::string& added, const std::vector<std::array<Index, 2>>& edges) {
    std::unordered_map<std::uint64_t, std::array<bool, 2>> found;
    for (const auto& [a, b] : edges) found.try_emplace(mesh_edge_key(a, b));
    const GroupIndex group = *result.find_group(added, GroupKind::element);
    for (const CellBlock& b : result.blocks()) {
        const CellTraits& t = traits(traits(b.type).linear);
        if (t.dimension < 2) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (const auto& e : t.edges)
                if (const auto at = found.find(mesh_edge_key(n[e[0]], n[e[1]])); at != found.end())
                    at->second[result.families.contains(b.families[c], group) ? 1 : 0] = true;
        }
    }
    const auto is_double = [&](Index node) { return std::ranges::count(result.points, result.points[node]) > 1; };
    for (const auto& [a, b] : edges)
        if (const auto& [mesh, addition] = found.at(mesh_edge_key(a, b)); !mesh || !addition)
            throw QualityError(
                "the seam is no edge of " + std::string(mesh ? "the addition" : "the mesh") + " between " +
                    point_text(result.points[a]) + " and " + point_text(result.points[b]) +
                    (is_double(a) || is_double(b)
                         ? ": it crosses double nodes there, the lips of a crack or a contact, and the two would "
                           "come apart. Join them before it is cracked, or end the addition there"
                         : ", and the two would come apart there: the mesh is too coarse for where the addition ends. "
                           "Refine both there first, or move the addition a little"),
                "other");
}

void warn_of_inside(const Mesh& mesh, const Mesh& result, const std::string& added, Report& report) {
    const GroupIndex group = *result.find_group(added, GroupKind::element);
    const std::vector<SurfaceFace> skin = surface_near(mesh, box_around(mesh));
    if (skin.empty()) return;
    const SurfaceTree tree(mesh, skin);
    const Box box = box_around(mesh);
    Index inside = 0;
    Vec3 first = Vec3::Zero();
    SparseCheck check(64);
    for (const CellBlock& b : result.blocks()) {
        if (traits(b.type).dimension != 2) continue;
        for (Index c = 0; c < b.size(); ++c, check()) {
            if (!result.families.contains(b.families[c], group)) continue;
            const Vec3 centre = centre_of(result, {b.type, c});
            if (!box.contains(centre) || tree.signed_distance(centre) >= 0) continue;
            if (inside++ == 0) first = centre;
        }
    }
    if (inside > 0)
        report.warnings.push_back(std::to_string(inside) + " elements of the addition are inside the solid, as at " +
                                  point_text(first) +
                                  ": they have no nodes in common with it but along its skin, and do not hold to it "
                                  "there. keep_side, a point outside, leaves them off");
}

std::vector<std::string> emptied_groups(const Mesh& before, const Mesh& after) {
    const std::vector<Index> then = sizes(before), now = sizes(after);
    std::vector<std::string> out;
    for (std::size_t g = 0; g < before.groups.size(); ++g) {
        const Group& group = before.groups[g];
        if (group.hidden || then[g] == 0) continue;
        const auto found = after.find_group(group.name, group.kind);
        if (found && now[*found] == 0) out.push_back(group.name);
    }
    return out;
}

}  // namespace femscalpel
