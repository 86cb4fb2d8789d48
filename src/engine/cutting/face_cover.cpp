// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/face_cover.h"

#include <algorithm>
#include <cmath>

namespace femscalpel {
namespace {

/// Nodes in their order, without repeated ones.
std::vector<Index> once_each(std::span<const Index> nodes) {
    std::vector<Index> out;
    for (const Index n : nodes)
        if (std::ranges::find(out, n) == out.end()) out.push_back(n);
    return out;
}

}  // namespace

FaceCover::FaceCover(const Mesh& mesh, GroupIndex group) : mesh_(mesh), group_(group), dimension_(mesh.dimension()) {}

FaceCover::FaceCover(const Mesh& mesh, const std::vector<double>& distance, double rounding)
    : mesh_(mesh), group_(-1), dimension_(mesh.dimension()), distance_(&distance), rounding_(rounding) {}

bool FaceCover::find() {
    find_wanted();
    find_owners();
    orient();
    return !faces_.empty();
}

FaceCover::Key FaceCover::key_of(std::span<const Index> corners) {
    std::vector<Index> nodes(corners.begin(), corners.end());
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    Key out{-1, -1, -1, -1};
    std::copy_n(nodes.begin(), std::min<std::size_t>(nodes.size(), 4), out.begin());
    return out;
}

void FaceCover::refuse(const std::string& why) const {
    if (distance_) throw ToolError("what lies on the tool " + why, "tool");
    throw ToolError("group '" + mesh_.groups[group_].name + "' " + why, "group");
}

std::span<const Index> FaceCover::corners(const CellRef& c) const {
    return mesh_.block(c.type).nodes(c.cell).first(static_cast<std::size_t>(traits(c.type).corners));
}

int FaceCover::face_count(CellType type) const {
    return static_cast<int>(dimension_ == 3 ? traits(type).faces.size() : traits(type).edges.size());
}

Facet FaceCover::facet(const Owner& o) { return {o.cell.type, static_cast<std::int8_t>(o.face), 0, o.cell.cell}; }

std::vector<Index> FaceCover::nodes_of(const Mesh& mesh, const Owner& o) {
    const FacetElement f = facet_element(mesh, facet(o));
    return {f.nodes.begin(), f.nodes.begin() + f.size};
}

std::vector<Index> FaceCover::corners_of(const Owner& o) const {
    const FacetElement f = facet_element(mesh_, facet(o));
    return {f.nodes.begin(), f.nodes.begin() + traits(f.type).corners};
}

/// Faces that the group covers; nodes that they have.
void FaceCover::find_wanted() {
    reached_.assign(mesh_.points.size(), 0);
    const auto want = [&](std::span<const Index> nodes) -> Face& {
        for (const Index n : nodes) reached_[n] = 1;
        return faces_[key_of(nodes)];
    };
    if (distance_) {
        for (std::size_t n = 0; n < reached_.size(); ++n) reached_[n] = std::abs((*distance_)[n]) <= rounding_;
        return;
    }
    const GroupKind kind = mesh_.groups[group_].kind;
    if (kind == GroupKind::node) {
        for (std::size_t n = 0; n < reached_.size(); ++n) reached_[n] = has(mesh_.node_families[n]);
    } else if (kind == GroupKind::facet) {
        for (const Facet& f : mesh_.facets)
            if (has(f.family) && traits(f.type).dimension == dimension_ && (dimension_ == 3 || f.face > 2)) {
                const Owner o{{f.type, f.cell}, f.face};
                told_.emplace(key_of(corners_of(o)), o.cell);
                want(corners_of(o));
            }
    } else {
        for (const CellBlock& b : mesh_.blocks())
            for (Index c = 0; c < b.size(); ++c) {
                if (!has(b.families[c])) continue;
                if (traits(b.type).dimension == dimension_)
                    refuse("has " + std::string(traits(b.type).name) + " elements; give a group of " + what() +
                           "s between them");
                if (traits(b.type).dimension == dimension_ - 1) want(corners({b.type, c}));
            }
    }
    if (kind != GroupKind::node && faces_.empty()) refuse("covers no " + what());
}

/// Elements on the faces.
void FaceCover::find_elements() {
    const bool by_elements = !distance_ && mesh_.groups[group_].kind == GroupKind::element;
    for_each_of(dimension_ - 1, [&](const CellRef& c) {
        const auto face = faces_.find(key_of(corners(c)));
        if (face == faces_.end()) return;
        std::vector<CellRef>& there = face->second.elements;
        const bool first = by_elements && has(mesh_.block(c.type).families[c.cell]);
        there.insert(first ? there.begin() : there.end(), c);
    });
}

void FaceCover::find_owners() {
    const bool by_nodes = distance_ || mesh_.groups[group_].kind == GroupKind::node;
    for_each_of(dimension_, [&](const CellRef& c) {
        if (std::ranges::count_if(corners(c), [&](Index n) { return reached_[n] != 0; }) < dimension_) return;
        for (int k = 0; k < face_count(c.type); ++k) {
            const Owner o = owner(c.type, c.cell, k);
            const std::vector<Index> nodes = corners_of(o);
            if (!std::ranges::all_of(nodes, [&](Index n) { return reached_[n] != 0; })) continue;
            const Key key = key_of(nodes);
            if (is_degenerate(key)) continue;
            if (by_nodes)
                faces_[key].owners.push_back(o);
            else if (const auto face = faces_.find(key); face != faces_.end())
                face->second.owners.push_back(o);
        }
    });
    const bool any = !faces_.empty();
    std::erase_if(faces_, [](const auto& f) { return f.second.owners.size() < 2; });
    if (!any && !distance_) refuse("covers no " + what() + ": no element has all corners of one in it");
    if (faces_.empty() && !distance_)
        refuse("covers no " + what() +
               " between two elements: it lies on the outside, or is open there already; nothing could be parted");
    find_elements();
    for (auto& [key, face] : faces_) {
        if (face.owners.size() > 2 && dimension_ == 3)
            refuse("has a face of " + std::to_string(face.owners.size()) + " elements: the mesh does not fit there");
        ask(key, face);
    }
}

/// What the group's element or facet says.
void FaceCover::ask(const Key& key, Face& face) const {
    if (distance_) {
        for (const Index n : corners(face.owners[0].cell))
            if (std::abs((*distance_)[n]) > rounding_) face.reference = (*distance_)[n] < 0 ? 1 : -1;
        return;
    }
    if (const auto told = told_.find(key); told != told_.end())
        face.reference = told->second == face.owners[0].cell ? 1 : -1;
    if (face.elements.empty() || mesh_.groups[group_].kind != GroupKind::element) return;
    const std::vector<Index> own = once_each(corners(face.elements.front())),
                             out = once_each(corners_of(face.owners[0]));
    const auto at = std::ranges::find(out, own[0]);
    const bool same = dimension_ == 2 ? out[0] == own[0] : *(at + 1 == out.end() ? out.begin() : at + 1) == own[1];
    face.reference = same ? 1 : -1;
}

/// Faces that go on smoothly have one negative side.
void FaceCover::orient() {
    std::map<Key, std::vector<std::pair<Face*, bool>>> at_border;  // of each edge (node): which way it runs
    for (auto& [key, face] : faces_) {
        const std::vector<Index> n = corners_of(face.owners[0]);
        if (dimension_ == 2) {
            at_border[key_of(std::span(n).first(1))].emplace_back(&face, true);
            at_border[key_of(std::span(n).subspan(1, 1))].emplace_back(&face, false);
            continue;
        }
        for (std::size_t k = 0; k < n.size(); ++k) {
            const std::array<Index, 2> edge{n[k], n[(k + 1) % n.size()]};
            if (edge[0] != edge[1]) at_border[key_of(edge)].emplace_back(&face, edge[0] < edge[1]);
        }
    }
    std::map<Face*, std::vector<std::pair<Face*, int>>> beside;
    for (const auto& [edge, there] : at_border)
        if (there.size() == 2) {
            const int turned = there[0].second == there[1].second ? -1 : 1;
            beside[there[0].first].emplace_back(there[1].first, turned);
            beside[there[1].first].emplace_back(there[0].first, turned);
        }
    for (auto& [key, face] : faces_) {
        if (face.sense != 0) continue;
        std::vector<Face*> patch{&face};
        face.sense = 1;
        for (std::size_t k = 0; k < patch.size(); ++k)
            for (const auto& [other, turned] : beside[patch[k]])
                if (other->sense == 0) {
                    other->sense = patch[k]->sense * turned;
                    patch.push_back(other);
                }
        if (is_turned(patch))
            for (Face* f : patch) f->sense = -f->sense;
    }
}

bool FaceCover::is_turned(const std::vector<Face*>& patch) const {
    int votes = 0;
    Vec3 normal = Vec3::Zero();
    for (const Face* f : patch) {
        votes += f->reference * f->sense;
        const std::vector<Index> n = corners_of(f->owners[0]);
        const Vec3& a = mesh_.points[n[0]];
        Vec3 way = Vec3::Zero();
        for (std::size_t k = 1; k + 1 < n.size() && dimension_ == 3; ++k)
            way += (mesh_.points[n[k]] - a).cross(mesh_.points[n[k + 1]] - a);
        normal += f->sense * (dimension_ == 3 ? way : mesh_.points[n[1]] - a);
    }
    if (votes != 0) return votes < 0;
    Eigen::Index largest = 0;
    normal.cwiseAbs().maxCoeff(&largest);
    return normal[largest] < 0;
}

}  // namespace femscalpel
