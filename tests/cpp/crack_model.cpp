// SPDX-License-Identifier: LGPL-2.1-or-later
#include "crack_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace femscalpel::checks {

Model::Face make_face(const Mesh& mesh, const Key3& corner, const Key3& mid) {
    Model::Face f;
    f.curved = mid[0] >= 0;
    f.centre = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
        f.corner[k] = mesh.points[corner[k]];
        f.centre += f.corner[k] / 3;
    }
    for (int k = 0; k < 3; ++k) {
        f.mid[k] = f.curved ? mesh.points[mid[k]] : Vec3((f.corner[k] + f.corner[(k + 1) % 3]) / 2);
        f.edge += (f.corner[k] - f.corner[(k + 1) % 3]).norm() / 3;
    }
    for (int k = 0; k < 3; ++k)
        f.radius = std::max({f.radius, (f.corner[k] - f.centre).norm(), (f.mid[k] - f.centre).norm()});
    if (f.curved) f.radius *= 1.5;
    f.normal = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).normalized();
    return f;
}

std::map<std::string, double> border_lengths(const Mesh& mesh, const std::function<bool(const Key2&)>& skip,
                                             const std::set<std::string>& without,
                                             std::vector<Model::Segment>* segments) {
    std::set<Key2> line_elements;
    for_each_cell(mesh, is_line, [&](CellType, Index, std::span<const Index> n) {
        line_elements.insert(ascending(Key2{n[0], n[1]}));
    });
    const std::vector<std::string> names = family_names(mesh, without);
    std::map<std::string, double> lengths;
    const auto normal = [&](const CellRef& c) {
        const auto n = mesh.block(c.type).nodes(c.cell);
        return Vec3((mesh.points[n[1]] - mesh.points[n[0]]).cross(mesh.points[n[2]] - mesh.points[n[0]]).normalized());
    };
    runs(edges_of(mesh, is_triangle), [&](auto first, auto last) {
        if (skip(first->key)) return;
        std::multiset<std::string> meeting;
        std::vector<Vec3> plates;
        for (auto e = first; e != last; ++e) {
            meeting.insert(names[mesh.block(e->cell.type).families[e->cell.cell]]);
            plates.push_back(normal(e->cell));
        }
        const bool crease = plates.size() == 2 && plates[0].cross(plates[1]).norm() > 1e-6;
        const bool inside = plates.size() == 2 && !crease && *meeting.begin() == *meeting.rbegin();
        if (inside && !(segments && line_elements.contains(first->key))) return;
        std::string key = crease ? "crease " : "";
        for (const std::string& m : meeting) key += "[" + m + "]";
        const Vec3 &a = mesh.points[first->key[0]], &b = mesh.points[first->key[1]];
        if (!inside) lengths[key] += (a - b).norm();
        if (segments) segments->push_back({{a, b}, (a + b) / 2, plates, {}, key, 0});
    });
    return lengths;
}

Model::Model(Mesh input, bool is_flat) : mesh(std::move(input)), flat(is_flat) {
    solid = mesh.block(CellType::tetra).size() + mesh.block(CellType::tetra10).size() > 0;
    low = high = mesh.points.front();
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        low = low.cwiseMin(mesh.points[n]);
        high = high.cwiseMax(mesh.points[n]);
        node_index.emplace(mesh.node_ids[n], static_cast<Index>(n));
        largest_node = std::max(largest_node, mesh.node_ids[n]);
    }
    size = (high - low).norm();
    for (const CellBlock& b : mesh.blocks())
        for (const Index i : b.ids) largest_cell = std::max(largest_cell, i);

    std::set<Key3> host_faces;
    const std::vector<std::string> names = family_names(mesh);
    if (solid) {
        const std::vector<TetraFace> faces = tetra_faces(mesh);
        runs(faces, [&](auto first, auto last) {
            host_faces.insert(first->key);
            const auto family = [&](const TetraFace& f) { return mesh.block(f.cell.type).families[f.cell.cell]; };
            if (last - first == 1)
                skin.push_back(make_face(mesh, first->outward, first->mid));
            else if (names[family(*first)] != names[family(*(first + 1))])
                borders.push_back(make_face(mesh, first->outward, first->mid));
        });
    }
    for_each_cell(mesh, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
        if (solid && !host_faces.contains(ascending(Key3{n[0], n[1], n[2]}))) {
            mixed = true;
            loose_kinds.insert(names[mesh.block(type).families[c]]);
        }
        if (!solid)
            skin.push_back(
                make_face(mesh, {n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1}));
    });
    std::set<Key2> neighbours;
    for (const Edge& e : edges_of(mesh, [](CellType t) { return is_tetra(t) || is_triangle(t); }))
        neighbours.insert(e.key);
    const auto segment = [&](std::span<const Index> n) {
        Segment s{{mesh.points[n[0]], mesh.points[n[1]]}, (mesh.points[n[0]] + mesh.points[n[1]]) / 2, {}, {}, {}, 0};
        if (n.size() == 3) s.mid = mesh.points[n[2]];
        return s;
    };
    for_each_cell(mesh, is_line, [&](CellType type, Index c, std::span<const Index> n) {
        if (!neighbours.contains(ascending(Key2{n[0], n[1]}))) loose_cells.insert(mesh.block(type).ids[c]);
    });
    if (!solid) {
        border_lengths(
            mesh, [](const Key2&) { return false; }, {}, &lines);
        find_bends();
    } else {
        // Feature lines: edges where skin faces meet at more than 30 degrees, and edges where a border ends in the
        // skin.
        std::map<Key2, std::vector<Vec3>> meeting, inward;
        runs(tetra_faces(mesh), [&](auto first, auto last) {
            const auto family = [&](const TetraFace& f) { return mesh.block(f.cell.type).families[f.cell.cell]; };
            const bool outside = last - first == 1;
            if (!outside && names[family(*first)] == names[family(*(first + 1))]) return;
            for (int k = 0; k < 3; ++k) {
                const Key2 key = ascending(Key2{first->outward[k], first->outward[(k + 1) % 3]});
                meeting[key].push_back(make_face(mesh, first->outward, first->mid).normal);
                const Vec3 &a = mesh.points[key[0]], along = mesh.points[key[1]] - a;
                const Vec3 across = mesh.points[first->outward[(k + 2) % 3]] - a;
                inward[key].push_back((across - across.dot(along) / along.squaredNorm() * along).normalized());
            }
        });
        for (const auto& [key, normals] : meeting) {
            bool feature = normals.size() != 2;
            for (const Vec3& n : normals) feature = feature || n.dot(normals[0]) < std::cos(std::numbers::pi / 6);
            if (feature)
                lines.push_back({{mesh.points[key[0]], mesh.points[key[1]]},
                                 (mesh.points[key[0]] + mesh.points[key[1]]) / 2,
                                 normals,
                                 inward.at(key),
                                 {},
                                 0});
        }
    }

    sums = group_sums(mesh);
    group_slack.assign(mesh.groups.size(), 0);
    for (const auto& [kind, slack] : curved_slack)
        for (std::size_t g = 0; g < mesh.groups.size(); ++g)
            if (kind.find(mesh.groups[g].name + ';') != std::string::npos) group_slack[g] += slack.area;
    group_faces.resize(mesh.groups.size());
    group_segments.resize(mesh.groups.size());
    group_twin.assign(mesh.groups.size(), -1);
    group_planar.assign(mesh.groups.size(), 0);
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        const auto group = static_cast<GroupIndex>(g);
        if (mesh.groups[g].hidden) continue;
        if (mesh.groups[g].kind == GroupKind::element && !flat) {
            for_each_cell(mesh, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
                if (mesh.families.contains(mesh.block(type).families[c], group))
                    group_faces[g].push_back(
                        make_face(mesh, {n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1}));
            });
            for_each_cell(mesh, is_line, [&](CellType type, Index c, std::span<const Index> n) {
                if (mesh.families.contains(mesh.block(type).families[c], group))
                    group_segments[g].push_back(segment(n));
            });
        }
        if (mesh.groups[g].kind != GroupKind::node) continue;
        std::set<Index> members;
        for (std::size_t n = 0; n < mesh.points.size(); ++n)
            if (mesh.families.contains(mesh.node_families[n], group)) members.insert(static_cast<Index>(n));
        std::set<Index> accompanied;
        for (const Key2& e : neighbours)
            if (members.contains(e[0]) && members.contains(e[1])) accompanied.insert(e.begin(), e.end());
        std::set<Index> corners;
        for (const CellBlock& b : mesh.blocks())
            for (Index c = 0; c < b.size(); ++c)
                corners.insert(b.nodes(c).begin(), b.nodes(c).begin() + corners_of(b.type));
        for (const Index n : members)
            if (!accompanied.contains(n) && corners.contains(n)) isolated_nodes.push_back(n);
        const auto twin = mesh.find_group(mesh.groups[g].name, GroupKind::element);
        if (!twin) continue;
        std::set<Index> of_elements;
        for (const CellBlock& b : mesh.blocks())
            for (Index c = 0; c < b.size(); ++c)
                if (mesh.families.contains(b.families[c], *twin))
                    of_elements.insert(b.nodes(c).begin(), b.nodes(c).end());
        if (of_elements != members) continue;
        group_twin[g] = *twin;
        if (sums[*twin].dimension == 3) {
            group_planar[g] = 1;
            continue;
        }
        // The plane of three members far apart, if all others are in it.
        const std::vector<Index> list(members.begin(), members.end());
        Vec3 normal = Vec3::Zero();
        for (const Index n : list) {
            const Vec3 candidate = (mesh.points[list.back()] - mesh.points[list.front()])
                                       .cross(mesh.points[n] - mesh.points[list.front()]);
            if (candidate.norm() > normal.norm()) normal = candidate;
        }
        if (normal.norm() > 1e-6 * size * size) normal.normalize();
        group_planar[g] = std::ranges::all_of(list, [&](Index n) {
            return std::abs(normal.dot(mesh.points[n] - mesh.points[list[0]])) < rounding * size;
        });
    }
}

/// Lines that turn a little from segment to segment are curves to the mesh's author: nodes slide along them, and what
/// they bound changes by the little areas between chords.
void Model::find_bends() {
    std::map<std::pair<std::string, std::array<double, 3>>, std::vector<Segment*>> ends;
    for (Segment& s : lines)
        for (const Vec3& e : s.end) ends[{s.kind, {e.x(), e.y(), e.z()}}].push_back(&s);
    for (const auto& [end, meeting] : ends) {
        if (meeting.size() != 2) continue;
        const auto direction = [](const Segment& s) { return Vec3((s.end[1] - s.end[0]).normalized()); };
        const double bend = std::asin(std::min(1.0, direction(*meeting[0]).cross(direction(*meeting[1])).norm()));
        if (bend < 1e-6 || bend > std::numbers::pi / 6) continue;
        for (Segment* s : meeting) s->bend = std::max(s->bend, bend);
    }
    for (const Segment& s : lines) {
        const double length = (s.end[1] - s.end[0]).norm();
        Slack& slack = curved_slack[s.kind];
        slack.length += length * s.bend * s.bend / 8;
        slack.area += length * length * s.bend / 4;
        area_slack += length * length * s.bend / 4;
    }
}

}  // namespace femscalpel::checks
