// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/seven_nodes.h"

#include <algorithm>
#include <tuple>

#include "cutting/numbering.h"

namespace femscalpel {
namespace {

/// Moves facets on triangles of one type to another, by where these are now (-1: they stay).
void move_facets(Mesh& mesh, CellType from, CellType to, const std::vector<Index>& moved,
                 const std::vector<Index>& left) {
    for (Facet& f : mesh.facets) {
        if (f.type != from) continue;
        const Index now = moved[static_cast<std::size_t>(f.cell)];
        f.cell = now >= 0 ? now : left[static_cast<std::size_t>(f.cell)];
        if (now >= 0) f.type = to;
    }
    std::ranges::stable_sort(mesh.facets, {}, [](const Facet& f) { return std::tuple(f.type, f.cell, f.face); });
}

void keep_nodes(Mesh& mesh, const std::vector<Index>& order) {
    const Mesh was = mesh;
    std::vector<Index> place(was.points.size(), -1);
    for (std::size_t k = 0; k < order.size(); ++k) {
        place[order[k]] = static_cast<Index>(k);
        mesh.points[k] = was.points[order[k]];
        mesh.node_ids[k] = was.node_ids[order[k]];
        mesh.node_families[k] = was.node_families[order[k]];
    }
    mesh.points.resize(order.size());
    mesh.node_ids.resize(order.size());
    mesh.node_families.resize(order.size());
    for (CellBlock& b : mesh.blocks())
        for (Index& n : b.connectivity) n = place[n];
}

}  // namespace

SevenNodes::SevenNodes(const Mesh& input) : input_(input) {
    const CellBlock& seven = input.block(CellType::triangle7);
    if (seven.size() == 0) return;
    mesh_ = input;
    std::vector<Index> moved;
    for (Index c = 0; c < seven.size(); ++c) {
        places_.emplace(seven.ids[c], c);
        moved.push_back(mesh_.add_cell(CellType::triangle6, seven.nodes(c).first(6), seven.ids[c], seven.families[c]));
    }
    mesh_.block(CellType::triangle7) = CellBlock{CellType::triangle7, {}, {}, {}};
    move_facets(mesh_, CellType::triangle7, CellType::triangle6, moved, {});
    std::vector<char> gone(input.points.size(), 0);
    for (Index c = 0; c < seven.size(); ++c) gone[seven.nodes(c)[6]] = 1;
    for (const CellBlock& b : mesh_.blocks())
        for (const Index n : b.connectivity) gone[n] = 0;
    // One with the largest number keeps new nodes from the numbers of those that come back.
    const auto largest = std::ranges::max_element(input.node_ids) - input.node_ids.begin();
    if (gone[static_cast<std::size_t>(largest)]) placeholder_ = input.node_ids[static_cast<std::size_t>(largest)];
    gone[static_cast<std::size_t>(largest)] = 0;
    std::vector<Index> kept;
    for (Index n = 0; n < input.node_count(); ++n)
        if (!gone[n]) kept.push_back(n);
    keep_nodes(mesh_, kept);
}

Prepared SevenNodes::known() {
    Prepared out;
    out.stages = &stages_;
    out.renewed = [this](const Mesh&) { return known(); };
    return out;
}

void SevenNodes::finish(Result& result) {
    const auto held = std::ranges::find(result.mesh.node_ids, placeholder_);
    if (placeholder_ > 0 && held != result.mesh.node_ids.end()) *held = 0;
    put_middles(result.mesh, result.report);
    result.stages = stages_;
    sort_nodes(result.mesh);
    report_groups(result.mesh, result.report);
}

void SevenNodes::put_middles(Mesh& mesh, Report& report) const {
    std::unordered_map<Index, Index> parents;
    const Changes changes = in_one(stages_);
    for (const Changes::Part& p : changes.parts) parents.emplace(p.element, p.parent);
    Index next = std::max(next_numbers(input_).node, mesh.largest_node_id() + 1);
    const CellBlock six = mesh.block(CellType::triangle6);
    mesh.block(CellType::triangle6) = CellBlock{CellType::triangle6, {}, {}, {}};
    const CellBlock& input = input_.block(CellType::triangle7);
    std::vector<Index> moved(static_cast<std::size_t>(six.size()), -1), left = moved;
    Index kept = 0, made = 0;
    for (Index c = 0; c < six.size(); ++c) {
        const auto n = six.nodes(c);
        const auto parent = parents.find(six.ids[c]);
        const auto place = places_.find(parent == parents.end() ? six.ids[c] : parent->second);
        if (place == places_.end()) {
            left[c] = mesh.add_cell(CellType::triangle6, n, six.ids[c], six.families[c]);
            continue;
        }
        const auto was = input.nodes(place->second);
        const bool is_old = parent == parents.end();
        bool same = is_old;
        for (std::size_t k = 0; k < 6; ++k)
            same = same && mesh.node_ids[n[k]] == input_.node_ids[was[k]] && mesh.points[n[k]] == input_.points[was[k]];
        Vec3 at = input_.points[was[6]];
        if (!same)  // the shape functions there
            at = 4.0 / 9 * (mesh.points[n[3]] + mesh.points[n[4]] + mesh.points[n[5]]) -
                 1.0 / 9 * (mesh.points[n[0]] + mesh.points[n[1]] + mesh.points[n[2]]);
        FamilyIndex family = mesh.families.intern(input_.families.groups(input_.node_families[was[6]]));
        if (!is_old)
            family = mesh.families.intersect(
                mesh.families.intersect(mesh.node_families[n[0]], mesh.node_families[n[1]]), mesh.node_families[n[2]]);
        (is_old ? kept : made) += 1;
        std::vector<Index> nodes(n.begin(), n.end());
        nodes.push_back(mesh.add_node(at, is_old ? input_.node_ids[was[6]] : next++, family));
        moved[c] = mesh.add_cell(CellType::triangle7, nodes, six.ids[c], six.families[c]);
    }
    move_facets(mesh, CellType::triangle6, CellType::triangle7, moved, left);
    report.nodes_added += made;
    report.nodes_split += made;
    report.nodes_removed += input.size() - kept;
}

/// Those of the input in its order, then what is new; without the placeholder.
void SevenNodes::sort_nodes(Mesh& mesh) const {
    const NumberIndex numbers(input_);
    std::vector<Index> order;
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.node_ids[n] > 0) order.push_back(n);
    std::ranges::stable_sort(order, {},
                             [&](Index n) { return numbers.node(mesh.node_ids[n]).value_or(input_.node_count()); });
    keep_nodes(mesh, order);
}

void SevenNodes::report_groups(const Mesh& mesh, Report& report) const {
    std::vector<Index> before(mesh.groups.size(), 0), after(mesh.groups.size(), 0);
    const auto count = [](const Mesh& of, std::vector<Index>& counts) {
        for (const FamilyIndex f : of.node_families)
            for (const GroupIndex g : of.families.groups(f)) ++counts[static_cast<std::size_t>(g)];
    };
    count(input_, before);
    count(mesh, after);
    for (GroupRecord& r : report.groups) {
        const auto g = r.kind == GroupKind::node ? mesh.find_group(r.name, GroupKind::node) : std::nullopt;
        if (!g) continue;
        r.count_before = before[static_cast<std::size_t>(*g)];
        r.count_after = after[static_cast<std::size_t>(*g)];
    }
}

}  // namespace femscalpel
