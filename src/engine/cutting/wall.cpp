// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/wall.h"

#include <algorithm>
#include <map>
#include <set>

#include "deformation/fitted_tool.h"

namespace femscalpel {
namespace {

/// Corners of a tetrahedron's face, or of a triangle's edge, in the order in which its normal points out of the
/// material (the material is on its left).
std::array<int, 3> outwards(const BandMesh& band, const std::array<int, 3>& face) {
    for (const int t : band.tetras.around(face[0])) {
        const auto& v = band.tetras[t];
        for (const auto& f : outward_faces) {
            const std::array<int, 3> corners{v[f[0]], v[f[1]], v[f[2]]};
            if (std::ranges::all_of(face, [&](int n) { return std::ranges::find(corners, n) != corners.end(); }))
                return corners;
        }
    }
    return face;
}

class Releaser {
public:
    Releaser(Workpiece& f, const Covered& covered) : f_(f), band_(f.d.band), covered_(covered) {
        out_.faces = covered.faces;
    }

    Wall run(const std::vector<std::array<Index, 3>>& following) {
        for (int v = 0; v < band_.size(); ++v) local_.emplace(band_.nodes[v].global, v);
        for (const auto& part : covered_.parts) add(part);
        follows_ = true;
        for (const auto& part : following) add(part);
        out_.nodes.assign(nodes_.begin(), nodes_.end());
        std::vector<int> facets, segments(edges_.begin(), edges_.end());
        if (covered_.faces)
            for (const Wall::Patch& p : out_.patches) facets.insert(facets.end(), p.parts.begin(), p.parts.end());
        f_.d.constraints.release(band_, facets, segments);
        const KeptGeometry& g = f_.d.constraints.geometry();
        for (const int v : nodes_) {
            for (const int k : g.facets_around[v]) out_.surfaces.insert(g.facets[k].shape);
            for (const int k : g.segments_around[v]) out_.curves.insert(g.segments[k].shape);
        }
        return std::move(out_);
    }

private:
    [[noreturn]] static void refuse(const char* what) {
        throw ToolError(std::string("the group covers ") + what + ", which cannot be moved", "group");
    }

    void add(const std::array<Index, 3>& part) {
        std::array<int, 3> nodes{-1, -1, -1};
        for (int k = 0; k < (covered_.faces ? 3 : 2); ++k) nodes[k] = local_.at(part[k]);
        covered_.faces ? add_face(nodes) : add_edge({nodes[0], nodes[1]});
    }

    int tag_of(int shape, int slot) {
        const auto [it, fresh] = tags_.try_emplace({shape, follows_}, static_cast<int>(out_.patches.size()));
        if (fresh) out_.patches.push_back({shape, {}, follows_});
        out_.patches[it->second].parts.push_back(slot);
        return it->second;
    }

    void add_face(const std::array<int, 3>& nodes) {
        const int slot = band_.skin.find(nodes);
        if (slot < 0 || band_.tetras.around(nodes[0]).empty()) refuse("a triangle that is no face of a tetrahedron");
        const KeptGeometry::Facet& facet = f_.d.constraints.geometry().facets[slot];
        if (f_.d.constraints.geometry().surfaces[facet.shape].shell)
            refuse("a triangle that is no face of a tetrahedron");
        band_.cut_faces.add(outwards(band_, nodes), tag_of(facet.shape, slot));
        for (int k = 0; k < 3; ++k) {
            nodes_.insert(nodes[k]);
            if (const int crease = band_.creases.find({nodes[k], nodes[(k + 1) % 3]}); crease >= 0)
                edges_.insert(crease);
        }
    }

    void add_edge(const std::array<int, 2>& nodes) {
        const int slot = band_.creases.find(nodes);
        if (slot < 0 || band_.triangles.around(nodes[0]).empty()) refuse("an edge that is none of a shell's border");
        band_.cut_edges.add(nodes, tag_of(f_.d.constraints.geometry().segments[slot].shape, slot));
        nodes_.insert(nodes.begin(), nodes.end());
        edges_.insert(slot);
    }

    Workpiece& f_;
    BandMesh& band_;
    const Covered& covered_;
    bool follows_ = false;
    std::map<Index, int> local_;
    std::map<std::pair<int, bool>, int> tags_;  // by shape and whether it follows
    std::set<int> nodes_, edges_;
    Wall out_;
};

}  // namespace

Wall release_wall(Workpiece& f, const Covered& covered, const std::vector<std::array<Index, 3>>& following) {
    return Releaser(f, covered).run(following);
}

void go_on_beside(Workpiece& f, const Wall& wall) {
    const KeptGeometry& g = f.d.constraints.geometry();
    const double tolerance = std::max(1e-8 * g.size, g.rounding);
    for (const int shape : wall.surfaces) {
        if (g.surfaces[shape].flat) continue;
        std::vector<int> parts;
        for (int k = 0; k < static_cast<int>(g.facets.size()); ++k)
            if (g.facets[k].shape == shape && g.facets[k].cad < 0) parts.push_back(k);
        const SurfaceSample sample = sample_of(g, parts);
        if (auto tool = fitted_tool(sample.points, sample.normals, tolerance, {}))
            f.d.constraints.set_exact(shape, std::move(tool));
        else
            f.d.constraints.let_surface_go_on(shape);
    }
    for (const int shape : wall.curves)
        if (!g.curves[shape].straight) f.d.constraints.let_curve_go_on(shape);
}

SurfaceSample sample_of(const KeptGeometry& g, const std::vector<int>& facets) {
    SurfaceSample out;
    for (const int part : facets) {
        const KeptGeometry::Facet& facet = g.facets[part];
        out.points.insert(out.points.end(), facet.corner.begin(), facet.corner.end());
        if (facet.curved) out.points.insert(out.points.end(), facet.mid.begin(), facet.mid.end());
        out.normals.push_back(
            (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]).normalized());
    }
    return out;
}

void double_across(SurfaceSample& sample, const Vec3& normal, double height) {
    const std::size_t count = sample.points.size();
    for (std::size_t k = 0; k < count; ++k) sample.points.push_back(sample.points[k] + height * normal);
}

std::vector<int> wall_tags(const BandMesh& band, int node) {
    std::set<int> out;
    for (const int s : band.cut_faces.around(node)) out.insert(band.cut_faces.tag(s));
    for (const int s : band.cut_edges.around(node)) out.insert(band.cut_edges.tag(s));
    return {out.begin(), out.end()};
}

}  // namespace femscalpel
