// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/outer_faces.h"

#include <algorithm>
#include <map>
#include <span>
#include <tuple>

#include "cancel.h"

namespace femscalpel {
namespace {

using FaceCorners = std::array<Index, 4>;  // of a triangle the last is -1

/// FaceCorners of a face, without those that degenerate elements have twice; nothing where fewer than three are left.
FaceCorners distinct(const FaceCorners& corners) {
    FaceCorners out{-1, -1, -1, -1};
    std::size_t count = 0;
    for (const Index n : corners)
        if (n >= 0 && std::find(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count), n) ==
                          out.begin() + static_cast<std::ptrdiff_t>(count))
            out[count++] = n;
    return out;
}

class OuterFaceFinder {
public:
    OuterFaceFinder(const Mesh& mesh, const Eigen::AlignedBox3d& box) : mesh_(mesh), box_(box) {}

    OuterFaces run() {
        find_faces();
        // Those of solids come first of equal ones; on them, shells are none of their own.
        std::ranges::sort(faces_, {}, [](const Face& f) {
            return std::tuple(f.key, is_shell(f.facet), f.facet.type, f.facet.cell, f.facet.face);
        });
        for (std::size_t k = 0, end = 0; k < faces_.size(); k = end) {
            std::size_t solids = 0;
            for (end = k; end < faces_.size() && faces_[end].key == faces_[k].key; ++end)
                solids += is_shell(faces_[end].facet) ? 0 : 1;
            if (solids < 2) add(faces_[k].facet);
        }
        find_edges();
        return std::move(out_);
    }

private:
    struct Face {
        FaceCorners key;  // ascending
        Facet facet;
    };

    static bool is_shell(const Facet& facet) { return traits(facet.type).dimension == 2; }

    bool reaches_in(std::span<const Index> corners) const {
        Eigen::AlignedBox3d own;
        for (const Index n : corners) own.extend(mesh_.points[n]);
        return own.intersects(box_);
    }

    FaceCorners corners_of(const Facet& facet) const {
        const CellTraits& t = traits(facet.type);
        const auto n = mesh_.block(facet.type).nodes(facet.cell);
        if (is_shell(facet)) return distinct({n[0], n[1], n[2], t.corners == 4 ? n[3] : -1});
        FaceCorners out;
        std::ranges::transform(t.faces[facet.face - 1], out.begin(), [&](int k) { return k < 0 ? -1 : n[k]; });
        return t.simplex ? out : distinct(out);
    }

    void find_faces() {
        SparseCheck check(1 << 12);
        const auto add_face = [&](const Facet& facet) {
            FaceCorners key = corners_of(facet);
            if (key[2] < 0) return;
            std::ranges::sort(key);
            faces_.push_back({key, facet});
        };
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (t.dimension < 2) continue;
            for (Index c = 0; c < b.size(); ++c) {
                check();
                if (!reaches_in(b.nodes(c).first(static_cast<std::size_t>(t.corners)))) continue;
                if (t.dimension == 2) add_face({b.type, 2, 0, c});
                for (std::size_t f = 0; f < t.faces.size(); ++f)
                    add_face({b.type, static_cast<std::int8_t>(f + 1), 0, c});
            }
        }
    }

    void add(const Facet& facet) {
        FaceCorners n = corners_of(facet);
        if (!reaches_in({n.data(), n[3] < 0 ? 3U : 4U})) return;
        if (!is_shell(facet)) turn_outwards(n, facet);
        out_.triangles.push_back({{n[0], n[1], n[2]}, is_shell(facet)});
        out_.owners.push_back(facet);
        if (n[3] < 0) return;
        out_.triangles.push_back({{n[0], n[2], n[3]}, is_shell(facet)});
        out_.owners.push_back(facet);
    }

    void turn_outwards(FaceCorners& n, const Facet& facet) const {
        const auto nodes =
            mesh_.block(facet.type).nodes(facet.cell).first(static_cast<std::size_t>(traits(facet.type).corners));
        Vec3 middle = Vec3::Zero();
        for (const Index k : nodes) middle += mesh_.points[k] / static_cast<double>(nodes.size());
        const Vec3& a = mesh_.points[n[0]];
        const Vec3 normal = (mesh_.points[n[1]] - a).cross(mesh_.points[n[2]] - a);
        if (normal.dot(middle - a) > 0) std::swap(n[0], n[2]);
    }

    /// Edges of the shells that are left.
    void find_edges() {
        if (std::ranges::none_of(out_.triangles, &SurfaceFace::shell)) return;
        std::map<std::pair<Index, Index>, int> count;
        const auto key = [](const OuterFaces::Edge& e) { return std::pair(std::minmax(e.nodes[0], e.nodes[1])); };
        for (std::size_t t = 0; t < out_.triangles.size(); ++t) {
            const auto& corners = out_.triangles[t].nodes;
            if (!out_.triangles[t].shell) {
                for (std::size_t k = 0; k < 3; ++k) count[std::minmax(corners[k], corners[(k + 1) % 3])] += 2;
                continue;
            }
            if (t > 0 && is_same(out_.owners[t - 1], out_.owners[t])) continue;
            const Facet& owner = out_.owners[t];
            const auto nodes = mesh_.block(owner.type).nodes(owner.cell);
            const auto& edges = traits(owner.type).edges;
            for (std::size_t k = 0; k < edges.size(); ++k) {
                out_.edges.push_back({{nodes[edges[k][0]], nodes[edges[k][1]]},
                                      {owner.type, static_cast<std::int8_t>(k + 3), 0, owner.cell},
                                      static_cast<int>(t)});
                ++count[key(out_.edges.back())];
            }
        }
        std::erase_if(out_.edges, [&](const OuterFaces::Edge& e) {
            return count.at(key(e)) > 1 || !reaches_in({e.nodes.data(), 2});
        });
    }

    static bool is_same(const Facet& a, const Facet& b) {
        return a.type == b.type && a.cell == b.cell && a.face == b.face;
    }

    const Mesh& mesh_;
    const Eigen::AlignedBox3d& box_;
    std::vector<Face> faces_;
    OuterFaces out_;
};

}  // namespace

OuterFaces outer_faces(const Mesh& mesh, const Eigen::AlignedBox3d& box) { return OuterFaceFinder(mesh, box).run(); }

}  // namespace femscalpel
