// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/marking.h"

#include <algorithm>
#include <tuple>

#include "mesh/rounding.h"

namespace femscalpel {
namespace {

/// Names are unique as they are; Mesh::add_group() would compare each with all.
GroupIndex add_hidden(Mesh& mesh, const std::string& name, GroupKind kind) {
    mesh.groups.push_back({std::string(mark_prefix) + name, kind, true});
    return static_cast<GroupIndex>(mesh.groups.size()) - 1;
}

}  // namespace

void Marking::pin(Index number) {
    if (const auto node = deck_.numbers().node(number)) pinned_.insert(*node);
}

void Marking::pin_related(Index number) {
    pin(number);
    if (const auto node = deck_.numbers().node(number)) related_.insert(*node);
}

bool Marking::is_one_place(Index number, Index other) {
    const auto node = deck_.numbers().node(number), partner = deck_.numbers().node(other);
    if (!node || !partner) return false;
    const std::vector<Vec3>& points = deck_.mesh().points;
    if (same_place_ < 0) same_place_ = same_place(points, coordinate_rounding(points));
    return (points[*node] - points[*partner]).norm() <= same_place_;
}

void Marking::pin_pair(Index number, Index other) {
    const auto node = deck_.numbers().node(number), partner = deck_.numbers().node(other);
    if (!node || !partner) return;
    pairs_[*node].push_back(*partner);
    pairs_[*partner].push_back(*node);
}

void Marking::mark_node(const std::string& group, Index number) {
    if (const auto node = deck_.numbers().node(number)) nodes_[group].push_back(*node);
}

void Marking::mark_element(const std::string& group, Index number) {
    if (const auto cell = deck_.numbers().cell(number)) cells_[group].push_back(*cell);
}

void Marking::mark_face(const std::string& group, Index element, int face) {
    if (const auto cell = deck_.numbers().cell(element)) faces_[group].push_back({*cell, face});
}

DeckMarks Marking::result() {
    DeckMarks out;
    out.surface_sets = surface_sets(deck_.mesh());
    const std::set<Index> for_other_reasons = with_ends_of_middles(pinned_);
    for (const auto& [node, partners] : pairs_) {
        pinned_.insert(node);
        related_.insert(node);
        if (!for_other_reasons.contains(node)) out.together.emplace(node, partners);
    }
    const std::set<Index> all = with_ends_of_middles(pinned_);
    for (const Index n : all)
        if (!for_other_reasons.contains(n)) out.together.try_emplace(n);
    out.pinned.assign(all.begin(), all.end());
    out.related.assign(related_.begin(), related_.end());
    if (!nodes_.empty() || !cells_.empty() || !faces_.empty()) out.mesh = marked(out.kept);
    return out;
}

/// A mid-side node follows the ends of its edge.
std::set<Index> Marking::with_ends_of_middles(std::set<Index> pinned) const {
    if (pinned.empty()) return pinned;
    for (const CellBlock& block : deck_.mesh().blocks()) {
        const CellTraits& t = traits(block.type);
        if (!t.quadratic) continue;
        for (Index c = 0; c < block.size(); ++c) {
            const auto n = block.nodes(c);
            for (std::size_t e = 0; e < t.edges.size(); ++e)
                if (pinned.contains(n[static_cast<std::size_t>(t.corners) + e]))
                    pinned.insert({n[t.edges[e][0]], n[t.edges[e][1]]});
        }
    }
    return pinned;
}

Mesh Marking::marked(std::vector<bool>& kept) const {
    Mesh mesh = deck_.mesh();
    const std::size_t first = mesh.groups.size();
    for (const auto& [name, nodes] : nodes_) {
        const GroupIndex group = add_hidden(mesh, name, GroupKind::node);
        for (const Index n : nodes) mesh.node_families[n] = mesh.families.with(mesh.node_families[n], group);
    }
    for (const auto& [name, cells] : cells_) {
        const GroupIndex group = add_hidden(mesh, name, GroupKind::element);
        for (const CellRef& c : cells) {
            FamilyIndex& family = mesh.block(c.type).families[c.cell];
            family = mesh.families.with(family, group);
        }
    }
    mark_facets(mesh);
    kept.assign(mesh.groups.size(), false);
    std::fill(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end(), true);
    return mesh;
}

void Marking::mark_facets(Mesh& mesh) const {
    std::map<std::tuple<CellType, Index, std::int8_t>, FamilyIndex> facets;
    for (const Facet& f : mesh.facets) facets.emplace(std::tuple(f.type, f.cell, f.face), f.family);
    for (const auto& [name, faces] : faces_) {
        const GroupIndex group = add_hidden(mesh, name, GroupKind::facet);
        for (const auto& [cell, face] : faces) {
            FamilyIndex& family = facets[{cell.type, cell.cell, static_cast<std::int8_t>(face)}];
            family = mesh.families.with(family, group);
        }
    }
    mesh.facets.clear();
    for (const auto& [where, family] : facets) {
        const auto& [type, cell, face] = where;
        mesh.facets.push_back({type, face, family, cell});
    }
}

}  // namespace femscalpel
