// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/crack_lips.h"

#include <algorithm>
#include <array>
#include <map>
#include <ranges>

#include "groups/group_nodes.h"
#include "mesh/adjacency.h"
#include "mesh/chains.h"

namespace femscalpel {
namespace {

GroupIndex group_of(const Mesh& mesh, const std::string& name, GroupKind kind, const std::string& what) {
    if (const auto group = mesh.find_group(name, kind)) return *group;
    throw Error("the mesh has no " + std::string(to_string(kind)) + " group '" + name + "', " + what, "front");
}

/// Elements of a group, of one dimension less than the mesh.
std::vector<CellRef> faces_of(const Mesh& mesh, GroupIndex group) {
    std::vector<CellRef> out;
    const int dimension = mesh.dimension() - 1;
    for (const CellBlock& block : mesh.blocks())
        if (traits(block.type).dimension == dimension)
            for (Index cell = 0; cell < block.size(); ++cell)
                if (std::ranges::binary_search(mesh.families.groups(block.families[cell]), group))
                    out.push_back({block.type, cell});
    return out;
}

Vec3 middle(const Mesh& mesh, CellRef cell) {
    Vec3 sum = Vec3::Zero();
    const int corners = traits(cell.type).corners;
    for (int k = 0; k < corners; ++k) sum += mesh.points[mesh.block(cell.type).nodes(cell.cell)[k]];
    return sum / corners;
}

/// By node of the front: the direction to the positive side, and roughly the one ahead.
struct Sides {
    std::map<Index, Vec3> normal, ahead;
};

/// The element of the mesh's dimension that has all corners of a face.
CellRef element_at(const Mesh& mesh, const Adjacency& adjacency, CellRef face) {
    const auto corners = mesh.block(face.type).nodes(face.cell).first(traits(face.type).corners);
    CellRef found{CellType::vertex, -1};
    adjacency.around(corners[0], [&](CellType type, Index cell) {
        if (traits(type).dimension != mesh.dimension()) return;
        const auto nodes = mesh.block(type).nodes(cell);
        if (std::ranges::all_of(corners, [&](Index v) { return std::ranges::find(nodes, v) != nodes.end(); }))
            found = {type, cell};
    });
    return found;
}

Vec3 normal_of(const Mesh& mesh, CellRef face, const Vec3& inside) {
    const auto nodes = mesh.block(face.type).nodes(face.cell);
    const Vec3 &a = mesh.points[nodes[0]], &b = mesh.points[nodes[1]];
    Vec3 normal = inside;
    if (traits(face.type).dimension == 2) {
        normal = (b - a).cross(mesh.points[nodes[2]] - a);
        if (normal.dot(inside) < 0) normal = -normal;
    } else {
        const Vec3 along = (b - a).normalized();
        normal -= normal.dot(along) * along;
    }
    return normal.normalized();
}

Sides sides_at(const Mesh& mesh, const std::vector<CellRef>& positive, const std::vector<char>& on_front) {
    const Adjacency adjacency(mesh);
    Sides out;
    for (const CellRef face : positive) {
        const auto nodes = mesh.block(face.type).nodes(face.cell);
        const auto corners = nodes.first(traits(face.type).corners);
        const bool near = std::ranges::any_of(nodes, [&](Index v) { return on_front[v] != 0; });
        if (!near || std::ranges::all_of(corners, [&](Index v) { return on_front[v] != 0; })) continue;
        const CellRef element = element_at(mesh, adjacency, face);
        if (element.cell < 0) continue;
        const Vec3 at = middle(mesh, face), normal = normal_of(mesh, face, middle(mesh, element) - at);
        for (const Index v : nodes)
            if (on_front[v]) {
                out.normal.try_emplace(v, Vec3::Zero()).first->second += normal;
                out.ahead.try_emplace(v, Vec3::Zero()).first->second += (mesh.points[v] - at).normalized();
            }
    }
    return out;
}

/// The front's nodes as chains, mid-side nodes in their places.
std::vector<std::vector<Index>> chains(const Mesh& mesh, const std::vector<CellRef>& segments) {
    std::vector<std::array<Index, 2>> edges;
    for (const CellRef segment : segments) {
        const auto nodes = mesh.block(segment.type).nodes(segment.cell);
        if (nodes.size() == 3) {
            edges.push_back({nodes[0], nodes[2]});
            edges.push_back({nodes[2], nodes[1]});
        } else {
            edges.push_back({nodes[0], nodes[1]});
        }
    }
    return chains_of(edges);
}

std::vector<CellRef> segments_of(const Mesh& mesh, GroupIndex group) {
    std::vector<CellRef> out;
    for (const CellType type : {CellType::line, CellType::line3}) {
        const CellBlock& block = mesh.block(type);
        for (Index cell = 0; cell < block.size(); ++cell)
            if (std::ranges::binary_search(mesh.families.groups(block.families[cell]), group))
                out.push_back({type, cell});
    }
    return out;
}

double mean_edge(const Mesh& mesh, const std::vector<char>& on_front) {
    double sum = 0;
    Index count = 0;
    for (const CellBlock& block : mesh.blocks()) {
        const CellTraits& t = traits(block.type);
        if (t.dimension != mesh.dimension()) continue;
        for (Index cell = 0; cell < block.size(); ++cell) {
            const auto nodes = block.nodes(cell);
            if (std::ranges::none_of(nodes, [&](Index v) { return on_front[v] != 0; })) continue;
            for (const auto& [a, b] : t.edges) sum += (mesh.points[nodes[a]] - mesh.points[nodes[b]]).norm(), ++count;
        }
    }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

}  // namespace

std::string crack_name(const std::string& front) {
    constexpr std::string_view end = "_FRONT";
    if (!front.ends_with(end) || front.size() == end.size())
        throw Error("front '" + front +
                        "' has no name of the form NAME_FRONT, so that its lips NAME_P and NAME_N are "
                        "not known: take the group that crack has made",
                    "front");
    return front.substr(0, front.size() - end.size());
}

CrackLips crack_lips(const Mesh& mesh, const std::string& front) {
    const std::string name = crack_name(front);
    const bool of_solids = mesh.dimension() == 3;
    if (mesh.dimension() < 2) throw Error("stress intensity needs a mesh of solids or shells", "mesh");
    const GroupIndex group = group_of(mesh, front, of_solids ? GroupKind::element : GroupKind::node,
                                      of_solids ? "the segments along the front" : "the tips of the crack");
    const GroupIndex p = group_of(mesh, name + "_P", GroupKind::element, "the positive lip of '" + front + "'");
    const GroupIndex n = group_of(mesh, name + "_N", GroupKind::element, "the negative lip of '" + front + "'");
    CrackLips out;
    out.positive = nodes_of_group(mesh, p);
    out.negative = nodes_of_group(mesh, n);
    const std::vector<char> on_front = nodes_of_group(mesh, group);
    std::vector<std::vector<Index>> lines;
    if (of_solids)
        lines = chains(mesh, segments_of(mesh, group));
    else
        for (Index v = 0; v < mesh.node_count(); ++v)
            if (on_front[v]) lines.push_back({v});
    if (lines.empty()) throw Error("front '" + front + "' is empty", "front");
    const Sides sides = sides_at(mesh, faces_of(mesh, p), on_front);
    out.edge = mean_edge(mesh, on_front);
    for (std::vector<Index>& line : lines) {
        std::vector<Vec3> points, ahead, normals;
        std::vector<Index> known;
        for (const Index v : line) {
            if (!sides.normal.contains(v)) continue;  // on the lips' border, where all corners of a face are
            known.push_back(v);
            points.push_back(mesh.points[v]);
            normals.push_back(sides.normal.at(v).normalized());
            ahead.push_back(sides.ahead.at(v));
        }
        if (known.empty())
            throw Error("front '" + front + "': the lips '" + name + "_P' do not reach node " +
                            std::to_string(mesh.node_ids[line.front()]) + " of it",
                        "front");
        const Vec3 first = points.front();
        CrackFront made(points, ahead, normals);
        if (!(made.points().front() - first).isZero(0)) std::ranges::reverse(known);
        if (made.closed()) known.pop_back();
        out.lines.push_back({std::move(made), std::move(known)});
    }
    return out;
}

}  // namespace femscalpel
