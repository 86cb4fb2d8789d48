// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/face_nodes.h"

#include <algorithm>
#include <map>
#include <optional>

#include "operators/feature_line.h"

namespace femscalpel {
namespace {

using Nodes = std::vector<Index>;  // ascending

/// Of each visible node group; empty for other groups.
std::vector<Nodes> named_nodes(const Mesh& mesh) {
    std::vector<Nodes> out(mesh.groups.size());
    for (Index n = 0; n < mesh.node_count(); ++n)
        for (const GroupIndex g : mesh.families.groups(mesh.node_families[n]))
            if (const Group& group = mesh.groups[g]; group.kind == GroupKind::node && !group.hidden)
                out[g].push_back(n);
    return out;
}

/// The nodes of the triangles of each element group that has nothing else; empty for other groups.
std::vector<Nodes> nodes_of_triangles(const Mesh& mesh) {
    std::vector<Nodes> out(mesh.groups.size());
    std::vector<char> has_others(mesh.groups.size(), 0);
    for (const CellBlock& b : mesh.blocks()) {
        const bool triangles = traits(b.type).linear == CellType::triangle;
        for (Index c = 0; c < b.size(); ++c)
            for (const GroupIndex g : mesh.families.groups(b.families[c])) {
                if (triangles)
                    std::ranges::copy(b.nodes(c), std::back_inserter(out[g]));
                else
                    has_others[g] = 1;
            }
    }
    for (std::size_t g = 0; g < out.size(); ++g) {
        if (has_others[g] != 0) out[g].clear();
        std::ranges::sort(out[g]);
        const auto [rest, end] = std::ranges::unique(out[g]);
        out[g].erase(rest, end);
    }
    return out;
}

/// Whether nodes are on a skin: their corners, or as middles of edges both of whose ends are.
std::vector<char> on_skin(const Mesh& mesh, const std::vector<std::array<Index, 3>>& skin) {
    std::vector<char> out(mesh.points.size(), 0);
    std::vector<std::array<Index, 2>> edges;
    for (const auto& face : skin)
        for (int k = 0; k < 3; ++k) {
            out[face[k]] = 1;
            const auto [a, b] = std::minmax(face[k], face[(k + 1) % 3]);
            edges.push_back({a, b});
        }
    const CellBlock& tetras = mesh.block(CellType::tetra10);
    if (tetras.size() == 0) return out;
    std::ranges::sort(edges);
    const auto& of_edge = traits(CellType::tetra10).edges;
    for (Index c = 0; c < tetras.size(); ++c) {
        const auto n = tetras.nodes(c);
        for (std::size_t k = 0; k < of_edge.size(); ++k) {
            const auto [a, b] = std::minmax(n[of_edge[k][0]], n[of_edge[k][1]]);
            if (out[a] != 0 && out[b] != 0 && std::ranges::binary_search(edges, std::array<Index, 2>{a, b}))
                out[n[4 + k]] = 1;
        }
    }
    return out;
}

void set_nodes(Mesh& mesh, GroupIndex group, const Nodes& was, const Nodes& nodes) {
    for (const Index n : was)
        if (!std::ranges::binary_search(nodes, n))
            mesh.node_families[n] = mesh.families.without(mesh.node_families[n], group);
    for (const Index n : nodes)
        if (!std::ranges::binary_search(was, n))
            mesh.node_families[n] = mesh.families.with(mesh.node_families[n], group);
}

}  // namespace

void keep_face_nodes(const Mesh& before, const std::vector<std::array<Index, 3>>& skin, Result& result) {
    const std::vector<Nodes> named = named_nodes(before);
    if (std::ranges::all_of(named, [](const Nodes& n) { return n.empty(); })) return;
    Mesh& mesh = result.mesh;
    std::map<Nodes, GroupIndex> faces;
    const std::vector<Nodes> of_triangles = nodes_of_triangles(before);
    for (std::size_t g = 0; g < of_triangles.size(); ++g)
        if (!of_triangles[g].empty() && !before.groups[g].hidden)
            faces.emplace(of_triangles[g], static_cast<GroupIndex>(g));
    const std::vector<Nodes> now = named_nodes(mesh), triangles_now = nodes_of_triangles(mesh);
    const std::vector<char> was_on = on_skin(before, skin), is_on = on_skin(mesh, skin_of(mesh));
    for (std::size_t g = 0; g < named.size(); ++g) {
        if (named[g].empty()) continue;
        const auto group = mesh.find_group(before.groups[g].name, GroupKind::node);
        if (!group) continue;
        Nodes wanted;
        if (const auto face = faces.find(named[g]); face != faces.end()) {
            const auto same = mesh.find_group(before.groups[face->second].name, GroupKind::element);
            if (!same) continue;
            wanted = triangles_now[*same];
        } else if (std::ranges::all_of(named[g], [&](Index n) { return was_on[n] != 0; })) {
            std::ranges::copy_if(now[*group], std::back_inserter(wanted), [&](Index n) { return is_on[n] != 0; });
        } else {
            continue;
        }
        set_nodes(mesh, *group, now[*group], wanted);
        for (GroupRecord& record : result.report.groups)
            if (record.kind == GroupKind::node && record.name == before.groups[g].name)
                record.count_after = static_cast<Index>(wanted.size());
    }
}

}  // namespace femscalpel
