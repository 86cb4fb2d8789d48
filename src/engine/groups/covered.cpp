// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/covered.h"

#include <algorithm>
#include <string>
#include <utility>

#include "cancel.h"

namespace femscalpel {
namespace {

class Finder {
public:
    Finder(const Mesh& mesh, GroupIndex group, std::optional<GroupIndex> skin_inside)
        : mesh_(mesh), group_(group), skin_inside_(skin_inside) {
        out_.faces = mesh.dimension() == 3;
    }

    Covered run() {
        switch (mesh_.groups[group_].kind) {
            case GroupKind::element:
                look_at_elements();
                break;
            case GroupKind::facet:
                look_at_facets();
                break;
            case GroupKind::node:
                look_at_nodes();
                break;
        }
        std::ranges::sort(out_.parts);
        out_.parts.erase(std::unique(out_.parts.begin(), out_.parts.end()), out_.parts.end());
        if (out_.parts.empty()) {
            const char* parts = out_.faces ? "face of the solid" : "edge of the shell";
            refuse(members_ == 0 ? std::string("is empty") : std::string("covers no ") + parts);
        }
        return std::move(out_);
    }

private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw ToolError("group '" + mesh_.groups[group_].name + "' " + why +
                            "; give a group of faces (in a mesh of shells, of edges), or the nodes on them",
                        "group");
    }

    bool has(FamilyIndex family) const { return mesh_.families.contains(family, group_); }

    void add(std::array<Index, 3> nodes) { out_.parts.push_back(ascending(nodes)); }

    [[noreturn]] static void refuse_quadrangles(const std::string& name) {
        throw UnsupportedElementError("group '" + name +
                                      "' covers faces that are no triangles; only those of tetrahedra can be moved");
    }

    void look_at_elements() {
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            for (Index c = 0; c < b.size(); ++c) {
                check_();
                if (!has(b.families[c])) continue;
                ++members_;
                if (t.dimension == (out_.faces ? 3 : 2)) refuse("has " + std::string(t.name) + " elements");
                if (t.dimension != (out_.faces ? 2 : 1)) continue;
                const auto n = b.nodes(c);
                if (t.corners > 3) refuse_quadrangles(mesh_.groups[group_].name);
                add({n[0], n[1], t.corners == 3 ? n[2] : -1});
            }
        }
    }

    void look_at_facets() {
        for (const Facet& f : mesh_.facets) {
            check_();
            if (!has(f.family)) continue;
            ++members_;
            if (!traits(f.type).simplex) refuse_quadrangles(mesh_.groups[group_].name);
            if (const auto part = part_of(f)) add(*part);
        }
    }

    std::optional<std::array<Index, 3>> part_of(const Facet& f) const {
        const auto n = mesh_.block(f.type).nodes(f.cell);
        const CellTraits& t = traits(f.type);
        if (t.dimension != 3) {
            if (f.face <= 2 || out_.faces) return {};
            return std::array<Index, 3>{n[f.face - 3], n[(f.face - 2) % 3], -1};
        }
        const auto& face = t.faces[f.face - 1];
        return std::array<Index, 3>{n[face[0]], n[face[1]], n[face[2]]};
    }

    /// Faces or edges with all nodes in the group that only one element has.
    void look_at_nodes() {
        std::vector<char> in(mesh_.points.size(), 0);
        for (std::size_t n = 0; n < in.size(); ++n) members_ += in[n] = has(mesh_.node_families[n]);
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (!t.simplex || t.dimension != (out_.faces ? 3 : 2)) continue;
            for (Index c = 0; c < b.size(); ++c) {
                check_();
                const auto n = b.nodes(c);
                for (int k = 0; k < t.corners; ++k) {
                    std::array<Index, 3> part{-1, -1, -1};
                    for (int i = 0, j = 0; i < t.corners; ++i)
                        if (i != k) part[j++] = n[i];
                    const auto end = part.begin() + t.corners - 1;
                    if (std::all_of(part.begin(), end, [&](Index v) { return in[v] != 0; })) add(part);
                }
            }
        }
        keep_single();
        if (!skin_inside_) return;
        for (const Facet& f : mesh_.facets) {
            if (!mesh_.families.contains(f.family, *skin_inside_) || !traits(f.type).simplex) continue;
            const auto part = part_of(f);
            if (part && std::ranges::all_of(*part, [&](Index v) { return v < 0 || in[v] != 0; })) add(*part);
        }
    }

    void keep_single() {
        std::ranges::sort(out_.parts);
        std::vector<std::array<Index, 3>> single;
        for (std::size_t i = 0, end = 0; i < out_.parts.size(); i = end) {
            for (end = i; end < out_.parts.size() && out_.parts[end] == out_.parts[i];) ++end;
            if (end == i + 1) single.push_back(out_.parts[i]);
        }
        out_.parts = std::move(single);
    }

    const Mesh& mesh_;
    const GroupIndex group_;
    const std::optional<GroupIndex> skin_inside_;
    Index members_ = 0;
    SparseCheck check_;
    Covered out_;
};

}  // namespace

std::array<Index, 3> ascending(std::array<Index, 3> corners) {
    // Not by std::sort, of which GCC 14 warns that it might leave so short an array.
    const auto order = [&](std::size_t a, std::size_t b) {
        if (corners[b] < corners[a]) std::swap(corners[a], corners[b]);
    };
    order(0, 1);
    if (corners[2] >= 0) {
        order(1, 2);
        order(0, 1);
    }
    return corners;
}

Covered covered_by(const Mesh& mesh, GroupIndex group, std::optional<GroupIndex> skin_inside) {
    return Finder(mesh, group, skin_inside).run();
}

}  // namespace femscalpel
