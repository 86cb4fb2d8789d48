// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_cavity.h"

#include <algorithm>
#include <sstream>

#include "cutting/fill.h"
#include "cutting/inner_node.h"
#include "cutting/removal.h"
#include "mesh/quality.h"
#include "words.h"

namespace femscalpel {
FilletCavity::FilletCavity(Workpiece& workpiece, const Mesh& mesh, std::span<const FilletReach> edges,
                           std::vector<FilletVertex> vertices)
    : f_(workpiece), material_(workpiece, mesh, edges), vertices_(std::move(vertices)), patches_(material_) {
    for (std::size_t k = 0; k < edges.size(); ++k) runs_.emplace_back(material_, patches_, *edges[k].path, k);
    for (const FilletVertex& vertex : vertices_)
        for (std::size_t k = 0; k < vertex.members.size(); ++k)
            runs_[vertex.members[k].edge].end_in_plane(vertex.members[k].which, vertex.across[k], vertex.centre);
}

double FilletCavity::replace(int tag, int more) {
    for (FilletRun& run : runs_) run.find_sections();
    keep_other_borders();
    for (FilletRun& run : runs_) run.find_rows();
    for (FilletRun& run : runs_) run.put_rows_on_ball();
    for (const FilletVertex& vertex : vertices_) check_domains(vertex);
    make_arcs(more);
    for (FilletRun& run : runs_) run.make_faces();
    patches_.mesh();
    for (const FilletVertex& vertex : vertices_)
        if (vertex.sphere) mesh_sphere(vertex);
    const double worst = fill();
    patches_.carry_over();
    remove_elements(f_, material_.removed());
    add_new_faces(tag);
    put_on_ball();
    touch_at_vertices();
    return worst;
}

/// Edges that meet in a plane share the nodes there.
void FilletCavity::make_arcs(int more) {
    int divisions = 0;
    for (const FilletRun& run : runs_) divisions = std::max(divisions, run.wanted_divisions());
    divisions = std::max(4, divisions + more);
    if (std::ranges::any_of(runs_, [](const FilletRun& run) { return run.halved(); })) divisions += divisions % 2;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        runs_[k].make_arcs(divisions);
        for (const FilletVertex& vertex : vertices_) {
            if (!vertex.is_mitre()) continue;
            const bool first = vertex.members[0].edge < vertex.members[1].edge;
            const FilletVertex::Member &from = vertex.members[first ? 0 : 1], &to = vertex.members[first ? 1 : 0];
            if (from.edge != k) continue;
            std::vector<int> nodes = runs_[k].arc_at(from.which);
            if (!runs_[to.edge].begins_like(to.which, runs_[k], from.which)) std::ranges::reverse(nodes);
            runs_[to.edge].give_arc(to.which, std::move(nodes));
            runs_[to.edge].give_ridge(to.which, runs_[k].ridge_at(from.which));
        }
    }
}

/// Groups may meet along edges at a corner of two, if they do so in the same way along both.
void FilletCavity::check_domains(const FilletVertex& vertex) const {
    std::vector<std::array<int, 2>> all;
    for (const auto& [edge, which] : vertex.members) {
        all.push_back(runs_[edge].domains_at_end(which));
        if (!runs_[edge].begins_like(which, runs_[vertex.members[0].edge], vertex.members[0].which))
            std::swap(all.back()[0], all.back()[1]);
    }
    const bool same = std::ranges::all_of(all, [&](const auto& d) { return d == all[0]; });
    if (!same || (!vertex.is_mitre() && all[0][0] != all[0][1]))
        material_.refuse("groups meet at the corner", vertex.at);
}

void FilletCavity::add_new_faces(int tag) {
    auto& faces = f_.d.band.cut_faces;
    for (const FilletRun& run : runs_)
        for (const auto& face : run.arc()) faces.add(face.nodes, tag);
    for (const auto& face : spheres_) faces.add(face.nodes, tag);
    for (const FilletPatch& patch : patches_.all())
        for (const Triangle& t : patch.fresh)
            if (patch.free) faces.add(patch.domain[0] >= 0 ? t : Triangle{t[0], t[2], t[1]}, tag + 1);
}

/// Borders inside, that do not reach new material, stay where they are.
void FilletCavity::keep_other_borders() {
    for (const FilletMaterial::Border& b : material_.borders) {
        const Vec3& near = material_.at(b.nodes[0]);
        if (b.domain[0] == b.domain[1]) {
            if (!drop_faces_of_nodes(b.nodes))
                material_.refuse(
                    "faces of a group end inside the material there, which is made anew. Round the edge before that "
                    "group is made, or without it",
                    near);
            continue;
        }
        if (std::ranges::any_of(b.nodes, [&](int v) { return material_.is_rounded_off(v); }))
            material_.refuse(
                "a border of groups, or another surface that is kept, runs along the edge, or beside it, where "
                "material is rounded off. Round the edge before the groups are made",
                near);
        material_.kept.push_back({b.nodes, b.domain[0]});
        material_.kept.push_back({{b.nodes[0], b.nodes[2], b.nodes[1]}, b.domain[1]});
    }
    material_.borders.clear();
    material_.kept.insert(material_.kept.end(), material_.skin.begin(), material_.skin.end());
    material_.skin.clear();
}

/// Where all nodes of a face inside are of one node group, it is kept as if the group had it, until it is given up
/// here. False where elements or facets lie on it.
bool FilletCavity::drop_faces_of_nodes(const Triangle& face) {
    BandMesh& band = f_.d.band;
    if (band.triangles.find(face) >= 0 || band.facet_faces.find(face) >= 0) return false;
    const int slot = band.skin.find(face);
    if (slot < 0) return false;
    band.skin.remove(slot);
    return true;
}

/// What bounds a domain, normals outwards.
std::vector<Triangle> FilletCavity::surface_of(int domain) const {
    std::vector<Triangle> surface;
    const auto add = [&](const Triangle& t, const std::array<int, 2>& sides) {
        if (sides[0] == domain) surface.push_back(t);
        if (sides[1] == domain) surface.push_back({t[0], t[2], t[1]});
    };
    for (const auto* faces : {&material_.kept, &spheres_})
        for (const auto& face : *faces) add(face.nodes, {face.domain, -1});
    for (const FilletRun& run : runs_) {
        for (const auto& face : run.arc()) add(face.nodes, {face.domain, -1});
        for (const auto& wall : run.walls()) add(wall.nodes, wall.domain);
    }
    for (const FilletPatch& patch : patches_.all())
        for (const Triangle& t : patch.fresh) add(t, patch.domain);
    return surface;
}

/// Each domain by itself, so that new elements have the groups of their own.
double FilletCavity::fill() {
    std::vector<Vec3> points;
    points.reserve(f_.d.band.nodes.size());
    for (const BandNode& n : f_.d.band.nodes) points.push_back(n.at);
    BandMesh& band = f_.d.band;
    const auto at = [&](int v) -> const Vec3& { return band.nodes[v].at; };
    FillOptions options;
    options.enough = 0.3;
    double worst = 1;
    for (int domain = 0; domain < material_.domains(); ++domain) {
        const std::vector<Triangle> surface = surface_of(domain);
        if (surface.empty()) continue;
        const Filled filled = fill_cavity(points, surface, options);
        worst = std::min(worst, filled.worst);
        std::vector<int> fresh;
        fresh.reserve(filled.points.size());
        for (const Vec3& x : filled.points) fresh.push_back(add_inner_node(f_, x, {}, false, material_.nodes_near(x)));
        for (Tetra t : filled.tetras) {
            for (int& v : t)
                if (v >= static_cast<int>(points.size())) v = fresh[v - static_cast<int>(points.size())];
            const int of = material_.parent((at(t[0]) + at(t[1]) + at(t[2]) + at(t[3])) / 4, domain);
            band.tetras.add_part(t, of);
            f_.taken.push_back(
                {band.tetra_cells[band.tetras.origin(of)], -signed_volume(at(t[0]), at(t[1]), at(t[2]), at(t[3]))});
        }
    }
    return worst;
}

void FilletCavity::touch(int v, const Tool& ball) {
    const auto is_ball = [&](const Tool* t) {
        return std::ranges::any_of(runs_, [&](const FilletRun& run) { return t == &run.path().ball(); });
    };
    Contact on;
    for (const Tool* t : f_.d.contact[v].tools())
        if (is_ball(t)) on = on.with(t);
    f_.d.contact[v] = on.with(&ball);
}

/// Nodes on the tangent lines.
void FilletCavity::put_on_ball() {
    for (FilletRun& run : runs_) {
        if (f_.d.mids.any() && !run.path().is_straight()) {
            run.bend_row_edges(middles_);
            continue;
        }
        for (const int side : {0, 1})
            for (const int v : run.row(side)) touch(v, run.path().ball());
        const FilletRun::Beside beside = run.settle_rows();
        if (beside.count == 0) continue;
        std::ostringstream text;
        text.precision(3);
        text << counted(beside.count, "node") << " at the border of the new face, as at (" << beside.at.transpose()
             << "), on the facets of the face beside it, which lie up to " << beside.farthest
             << " off the bent surface they stand for: as far off the rounding. Where that matters, refine the mesh "
                "with its shape (skin=) before it is rounded";
        f_.warnings.push_back(text.str());
    }
}

}  // namespace femscalpel
