// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/outer_faces.h"

#include <algorithm>
#include <map>
#include <span>

#include "cancel.h"

namespace femscalpel {
namespace {

using Corners = std::array<Index, 4>;  // of a triangle the last is -1

Corners sorted(Corners corners) {
    std::ranges::sort(corners);
    return corners;
}

class Finder {
public:
    Finder(const Mesh& mesh, const Eigen::AlignedBox3d& box) : mesh_(mesh), box_(box) {}

    OuterFaces run() {
        find_faces();
        std::ranges::stable_sort(faces_, {}, &Face::key);
        for (std::size_t k = 0, end = 0; k < faces_.size(); k = end) {
            std::size_t solids = 0;
            for (end = k; end < faces_.size() && faces_[end].key == faces_[k].key; ++end) solids += !faces_[end].shell;
            // Those of solids come first of equal ones; on them, shells are none of their own.
            if (solids < 2) add(faces_[k]);
        }
        find_edges();
        return std::move(out_);
    }

private:
    struct Face {
        Corners key, corners;
        Facet facet;
        bool shell;
    };

    bool reaches_in(std::span<const Index> corners) const {
        Eigen::AlignedBox3d own;
        for (const Index n : corners) own.extend(mesh_.points[n]);
        return own.intersects(box_);
    }

    void find_faces() {
        SparseCheck check(1 << 12);
        for (const int dimension : {3, 2})
            for (const CellBlock& b : mesh_.blocks()) {
                const CellTraits& t = traits(b.type);
                if (t.dimension != dimension) continue;
                for (Index c = 0; c < b.size(); ++c) {
                    check();
                    const auto n = b.nodes(c).first(static_cast<std::size_t>(t.corners));
                    if (!reaches_in(n)) continue;
                    if (dimension == 2) {
                        const Corners own{n[0], n[1], n[2], t.corners == 4 ? n[3] : -1};
                        faces_.push_back({sorted(own), own, {b.type, 2, 0, c}, true});
                    }
                    for (std::size_t f = 0; f < t.faces.size(); ++f) {
                        Corners own;
                        std::ranges::transform(t.faces[f], own.begin(), [&](int k) { return k < 0 ? -1 : n[k]; });
                        faces_.push_back({sorted(own), own, {b.type, static_cast<std::int8_t>(f + 1), 0, c}, false});
                    }
                }
            }
    }

    void add(const Face& face) {
        Corners n = face.corners;
        if (!reaches_in({n.data(), n[3] < 0 ? 3U : 4U})) return;
        if (!face.shell) turn_outwards(n, face.facet);
        out_.triangles.push_back({{n[0], n[1], n[2]}, face.shell});
        out_.owners.push_back(face.facet);
        if (n[3] < 0) return;
        out_.triangles.push_back({{n[0], n[2], n[3]}, face.shell});
        out_.owners.push_back(face.facet);
    }

    void turn_outwards(Corners& n, const Facet& facet) const {
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

OuterFaces outer_faces(const Mesh& mesh, const Eigen::AlignedBox3d& box) { return Finder(mesh, box).run(); }

}  // namespace femscalpel
