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

namespace {

/// The face that a triangle element is.
Model::Face face_of(const Mesh& mesh, std::span<const Index> n) {
    return make_face(mesh, {n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1});
}

Model::Segment segment_of(const Mesh& mesh, std::span<const Index> n) {
    const Vec3 &a = mesh.points[n[0]], &b = mesh.points[n[1]];
    return {{a, b}, n.size() == 3 ? mesh.points[n[2]] : Vec3((a + b) / 2), {}, {}, {}, 0};
}

/// Calls visit(face, outside) for each face of the skin and of the borders between groups: once, as one of its
/// tetrahedra sees it.
void for_each_border_face(const Mesh& mesh, auto visit) {
    const std::vector<std::string> names = family_names(mesh);
    const auto name = [&](const TetraFace& f) { return names[mesh.block(f.cell.type).families[f.cell.cell]]; };
    runs(tetra_faces(mesh), [&](auto first, auto last) {
        const bool outside = last - first == 1;
        if (outside || name(*first) != name(*(first + 1))) visit(*first, outside);
    });
}

/// Skin, borders, and the shells beside solids.
void find_skin(Model& m) {
    if (m.solid)
        for_each_border_face(m.mesh, [&](const TetraFace& f, bool outside) {
            (outside ? m.skin : m.borders).push_back(make_face(m.mesh, f.outward, f.mid));
        });
    std::set<Key3> host_faces;
    if (m.solid)
        for (const TetraFace& f : tetra_faces(m.mesh)) host_faces.insert(f.key);
    const std::vector<std::string> names = family_names(m.mesh);
    for_each_cell(m.mesh, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
        if (m.solid && !host_faces.contains(ascending(Key3{n[0], n[1], n[2]}))) {
            m.mixed = true;
            m.loose_kinds.insert(names[m.mesh.block(type).families[c]]);
        }
        if (!m.solid) m.skin.push_back(face_of(m.mesh, n));
    });
}

/// Edges where skin faces meet at more than 30 degrees, and edges where a border ends in the skin.
std::vector<Model::Segment> feature_lines(const Mesh& mesh) {
    std::map<Key2, std::vector<Vec3>> meeting, inward;
    for_each_border_face(mesh, [&](const TetraFace& f, bool) {
        for (int k = 0; k < 3; ++k) {
            const Key2 key = ascending(Key2{f.outward[k], f.outward[(k + 1) % 3]});
            meeting[key].push_back(make_face(mesh, f.outward, f.mid).normal);
            const Vec3 &a = mesh.points[key[0]], along = mesh.points[key[1]] - a;
            const Vec3 across = mesh.points[f.outward[(k + 2) % 3]] - a;
            inward[key].push_back((across - across.dot(along) / along.squaredNorm() * along).normalized());
        }
    });
    std::vector<Model::Segment> lines;
    for (const auto& [key, normals] : meeting) {
        bool feature = normals.size() != 2;
        for (const Vec3& n : normals) feature = feature || n.dot(normals[0]) < std::cos(std::numbers::pi / 6);
        if (!feature) continue;
        const Vec3 &a = mesh.points[key[0]], &b = mesh.points[key[1]];
        lines.push_back({{a, b}, (a + b) / 2, normals, inward.at(key), {}, 0});
    }
    return lines;
}

/// Whether nodes lie in one plane: that of three far apart.
bool are_planar(const Mesh& mesh, const std::set<Index>& nodes, double size) {
    const Vec3 &first = mesh.points[*nodes.begin()], &last = mesh.points[*nodes.rbegin()];
    Vec3 normal = Vec3::Zero();
    for (const Index n : nodes) {
        const Vec3 candidate = (last - first).cross(mesh.points[n] - first);
        if (candidate.norm() > normal.norm()) normal = candidate;
    }
    if (normal.norm() > 1e-6 * size * size) normal.normalize();
    return std::ranges::all_of(nodes,
                               [&](Index n) { return std::abs(normal.dot(mesh.points[n] - first)) < rounding * size; });
}

/// Triangles and line elements of a group of elements.
void find_shapes(Model& m, GroupIndex group) {
    const Mesh& mesh = m.mesh;
    const auto is_in = [&](CellType type, Index c) {
        return mesh.families.contains(mesh.block(type).families[c], group);
    };
    for_each_cell(mesh, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
        if (is_in(type, c)) m.group_faces[group].push_back(face_of(mesh, n));
    });
    for_each_cell(mesh, is_line, [&](CellType type, Index c, std::span<const Index> n) {
        if (is_in(type, c)) m.group_segments[group].push_back(segment_of(mesh, n));
    });
}

/// Members of a node group without neighbours in it, and the element group that has its name and nodes.
void describe_nodes(Model& m, GroupIndex group, const std::set<Key2>& neighbours, const std::set<Index>& corners) {
    const Mesh& mesh = m.mesh;
    std::set<Index> members;
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.families.contains(mesh.node_families[n], group)) members.insert(static_cast<Index>(n));
    std::set<Index> accompanied;
    for (const Key2& e : neighbours)
        if (members.contains(e[0]) && members.contains(e[1])) accompanied.insert(e.begin(), e.end());
    for (const Index n : members)
        if (!accompanied.contains(n) && corners.contains(n)) m.isolated_nodes.push_back(n);
    const auto twin = mesh.find_group(mesh.groups[group].name, GroupKind::element);
    if (!twin) return;
    std::set<Index> of_elements;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c)
            if (mesh.families.contains(b.families[c], *twin)) of_elements.insert(b.nodes(c).begin(), b.nodes(c).end());
    if (of_elements != members) return;
    m.group_twin[group] = *twin;
    m.group_planar[group] = m.sums[*twin].dimension == 3 || are_planar(mesh, members, m.size);
}

/// What is known of each group.
void describe_groups(Model& m, const std::set<Key2>& neighbours) {
    const Mesh& mesh = m.mesh;
    m.sums = group_sums(mesh);
    m.group_slack.assign(mesh.groups.size(), 0);
    for (const auto& [kind, slack] : m.curved_slack)
        for (std::size_t g = 0; g < mesh.groups.size(); ++g)
            if (kind.find(mesh.groups[g].name + ';') != std::string::npos) m.group_slack[g] += slack.area;
    m.group_faces.resize(mesh.groups.size());
    m.group_segments.resize(mesh.groups.size());
    m.group_twin.assign(mesh.groups.size(), -1);
    m.group_planar.assign(mesh.groups.size(), 0);
    std::set<Index> corners;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c)
            corners.insert(b.nodes(c).begin(), b.nodes(c).begin() + corners_of(b.type));
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        if (mesh.groups[g].hidden) continue;
        if (mesh.groups[g].kind == GroupKind::element && !m.flat) find_shapes(m, static_cast<GroupIndex>(g));
        if (mesh.groups[g].kind == GroupKind::node) describe_nodes(m, static_cast<GroupIndex>(g), neighbours, corners);
    }
}

}  // namespace

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
    find_skin(*this);
    std::set<Key2> neighbours;
    for (const Edge& e : edges_of(mesh, [](CellType t) { return is_tetra(t) || is_triangle(t); }))
        neighbours.insert(e.key);
    for_each_cell(mesh, is_line, [&](CellType type, Index c, std::span<const Index> n) {
        if (!neighbours.contains(ascending(Key2{n[0], n[1]}))) loose_cells.insert(mesh.block(type).ids[c]);
    });
    if (solid) {
        lines = feature_lines(mesh);
    } else {
        border_lengths(
            mesh, [](const Key2&) { return false; }, {}, &lines);
        find_bends();
    }
    describe_groups(*this, neighbours);
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
