// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/crossed_borders.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "cancel.h"
#include "mesh/band_mesh.h"
#include "mesh/stopwatch.h"
#include "mesh/surface.h"
#include "mesh/surface_tree.h"

namespace femscalpel {
namespace {

class Finder {
public:
    Finder(const Mesh& mesh, const CellLists& taken, const Mesh& other,
           const std::function<bool(const FaceKey&)>& is_kept)
        : mesh_(mesh), taken_(taken), other_(other), is_kept_(is_kept) {}

    CrossedBorders run() {
        find_inner_faces();
        for (const auto& [face, sides] : faces_)
            if (sides.size() == 2) look_at_border(face, sides[0], sides[1]);
        look_at_faces();
        return std::move(out_);
    }

private:
    void find_inner_faces() {
        SparseCheck check(256);
        for (int type = 0; type < cell_type_count; ++type) {
            const CellBlock& b = mesh_.blocks()[type];
            for (const Index c : taken_[type]) {
                check();
                const auto n = b.nodes(c);
                for (const auto& f : outward_faces)
                    faces_[face_key({n[f[0]], n[f[1]], n[f[2]]})].push_back(b.families[c]);
            }
        }
    }

    Vec3 middle(const FaceKey& face) const {
        return (mesh_.points[face[0]] + mesh_.points[face[1]] + mesh_.points[face[2]]) / 3;
    }

    bool is_outside(const FaceKey& face) {
        if (!tree_) {
            skin_ = surface_near(other_, box_around(other_));
            tree_.emplace(other_, skin_);
        }
        return tree_->signed_distance(middle(face)) > 0;
    }

    void add(std::set<GroupIndex>& to, FamilyIndex family, FamilyIndex but) const {
        for (const GroupIndex g : mesh_.families.groups(family))
            if (!mesh_.groups[g].hidden && !mesh_.families.contains(but, g)) to.insert(g);
    }

    void look_at_border(const FaceKey& face, FamilyIndex one, FamilyIndex two) {
        if (one == two) return;
        std::set<GroupIndex> groups;
        add(groups, one, two);
        add(groups, two, one);
        if (groups.empty() || !is_outside(face)) return;
        out_.groups.merge(groups);
        out_.at = middle(face);
    }

    void look_at_face(const FaceKey& face, FamilyIndex family) {
        const auto found = faces_.find(face_key(face));
        if (found == faces_.end() || found->second.size() < 2 || is_kept_(found->first)) return;
        std::set<GroupIndex> groups;
        add(groups, family, 0);
        if (groups.empty() || !is_outside(face)) return;
        out_.faces.merge(groups);
        out_.at = middle(face);
        ++out_.lost;
    }

    /// Triangles and facets that lie between elements taken out.
    void look_at_faces() {
        for (const CellBlock& b : mesh_.blocks()) {
            if (traits(b.type).linear != CellType::triangle) continue;
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                look_at_face({n[0], n[1], n[2]}, b.families[c]);
            }
        }
        for (const Facet& f : mesh_.facets) {
            const CellTraits& t = traits(f.type);
            if (t.linear != CellType::tetra) continue;
            const auto n = mesh_.block(f.type).nodes(f.cell);
            const auto& face = t.faces[f.face - 1];
            look_at_face({n[face[0]], n[face[1]], n[face[2]]}, f.family);
        }
    }

    const Mesh& mesh_;
    const CellLists& taken_;
    const Mesh& other_;
    const std::function<bool(const FaceKey&)>& is_kept_;
    std::map<FaceKey, std::vector<FamilyIndex>> faces_;  // of the elements that have them
    std::vector<SurfaceFace> skin_;
    std::optional<SurfaceTree> tree_;
    CrossedBorders out_;
};

}  // namespace

CrossedBorders crossed_borders(const Mesh& mesh, const CellLists& taken, const Mesh& other,
                               const std::function<bool(const std::array<Index, 3>&)>& is_kept) {
    return Finder(mesh, taken, other, is_kept).run();
}

}  // namespace femscalpel
