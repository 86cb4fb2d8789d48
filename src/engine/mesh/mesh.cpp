// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "cancel.h"
#include "mesh/companion.h"

namespace femscalpel {

std::string_view to_string(GroupKind kind) {
    switch (kind) {
        case GroupKind::node:
            return "node";
        case GroupKind::element:
            return "element";
        case GroupKind::facet:
            return "facet";
    }
    return "";
}

namespace {

/// Sorts numbers, of which there may be millions.
void sort_obeying(std::vector<Index>& numbers) {
    if (std::ranges::is_sorted(numbers)) return;
    SparseCheck check(1 << 16);
    std::ranges::sort(numbers, [&](Index a, Index b) {
        check();
        return a < b;
    });
}

std::string too_large(const char* what, Index number) {
    return "the " + std::string(what) + " number " + std::to_string(number) + " is larger than " +
           std::to_string(largest_number) + ", the largest there can be. Renumber the mesh";
}

}  // namespace

Mesh::Mesh() {
    for (const CellTraits& t : all_cell_types()) block(t.type).type = t.type;
}

Index Mesh::cell_count() const {
    Index n = 0;
    for (const CellBlock& b : blocks_) n += b.size();
    return n;
}

int Mesh::dimension() const {
    int d = -1;
    for (const CellBlock& b : blocks_)
        if (b.size() > 0) d = std::max(d, traits(b.type).dimension);
    return d;
}

Index Mesh::add_node(const Vec3& point, Index id, FamilyIndex family) {
    points.push_back(point);
    node_ids.push_back(id);
    node_families.push_back(family);
    return node_count() - 1;
}

Index Mesh::add_cell(CellType type, std::span<const Index> nodes, Index id, FamilyIndex family) {
    CellBlock& b = block(type);
    b.connectivity.insert(b.connectivity.end(), nodes.begin(), nodes.end());
    b.ids.push_back(id);
    b.families.push_back(family);
    return b.size() - 1;
}

Index Mesh::largest_node_id() const { return node_ids.empty() ? 0 : *std::ranges::max_element(node_ids); }

Index Mesh::largest_cell_id() const {
    Index largest = 0;
    for (const CellBlock& b : blocks_)
        for (Index id : b.ids) largest = std::max(largest, id);
    return largest;
}

std::optional<GroupIndex> Mesh::find_group(std::string_view wanted, std::optional<GroupKind> kind, bool hidden) const {
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups[g].name == wanted && groups[g].hidden == hidden && (!kind || groups[g].kind == *kind))
            return static_cast<GroupIndex>(g);
    return {};
}

GroupIndex Mesh::add_group(std::string group_name, GroupKind kind, bool hidden) {
    if (find_group(group_name, kind, hidden))
        throw Error("the mesh already has a " + std::string(to_string(kind)) + " group '" + group_name + "'");
    groups.push_back({std::move(group_name), kind, hidden});
    return static_cast<GroupIndex>(groups.size()) - 1;
}

void Mesh::check_numbers() const {
    if (const Index n = largest_node_id(); n > largest_number) throw Error(too_large("node", n));
    if (const Index n = largest_cell_id(); n > largest_number) throw Error(too_large("element", n));
}

void Mesh::validate() const {
    const auto bad_family = [this](FamilyIndex f) { return f < 0 || f >= families.size(); };
    if (node_ids.size() != points.size() || node_families.size() != points.size())
        throw Error("node numbers or families do not match the number of nodes");
    SparseCheck check;
    for (std::size_t i = 0; i < points.size(); ++i, check()) {
        if (!points[i].allFinite())
            throw Error("node " + std::to_string(node_ids[i]) + " has a coordinate that is not a finite number");
        if (node_ids[i] <= 0) throw Error("node number " + std::to_string(node_ids[i]) + " is not positive");
        if (node_ids[i] > largest_number) throw Error(too_large("node", node_ids[i]));
        if (bad_family(node_families[i])) throw Error("node " + std::to_string(node_ids[i]) + " has no valid family");
    }
    std::vector<Index> ids(node_ids);
    sort_obeying(ids);
    if (const auto twice = std::ranges::adjacent_find(ids); twice != ids.end())
        throw Error("node number " + std::to_string(*twice) + " is used twice");
    ids.clear();
    for (const CellBlock& b : blocks_) {
        const CellTraits& t = traits(b.type);
        if (b.connectivity.size() != b.ids.size() * static_cast<std::size_t>(t.nodes) ||
            b.families.size() != b.ids.size())
            throw Error("connectivity or families of the " + std::string(t.name) +
                        " elements do not match their number");
        for (Index c = 0; c < b.size(); ++c, check()) {
            const std::string who = std::string(t.name) + " element " + std::to_string(b.ids[c]);
            if (b.ids[c] <= 0) throw Error(who + ": element numbers must be positive");
            if (b.ids[c] > largest_number) throw Error(too_large("element", b.ids[c]));
            for (Index n : b.nodes(c))
                if (n < 0 || n >= node_count()) throw Error(who + " refers to a node that does not exist");
            if (bad_family(b.families[c])) throw Error(who + " has no valid family");
        }
        ids.insert(ids.end(), b.ids.begin(), b.ids.end());
    }
    sort_obeying(ids);
    if (const auto twice = std::ranges::adjacent_find(ids); twice != ids.end())
        throw Error("element number " + std::to_string(*twice) + " is used twice");
    for (const Facet& f : facets)
        if (f.cell < 0 || f.cell >= block(f.type).size() || bad_family(f.family))
            throw Error("a facet refers to an element that does not exist");
}

struct NumberIndex::Tables {
    // A flat table costs at most 4 entries per number; sparser numbering goes to the map.
    struct Lookup {
        std::vector<std::int64_t> flat;
        std::unordered_map<Index, std::int64_t> sparse;

        void reserve(Index largest, Index count) {
            if (largest < 4 * count + 1024)
                flat.assign(static_cast<std::size_t>(largest) + 1, -1);
            else
                sparse.reserve(static_cast<std::size_t>(count));
        }
        void put(Index id, std::int64_t value) {
            if (!flat.empty())
                flat[static_cast<std::size_t>(id)] = value;
            else
                sparse.emplace(id, value);
        }
        std::int64_t get(Index id) const {
            if (!flat.empty())
                return id >= 0 && id < static_cast<Index>(flat.size()) ? flat[static_cast<std::size_t>(id)] : -1;
            const auto it = sparse.find(id);
            return it == sparse.end() ? -1 : it->second;
        }
    };
    Lookup nodes;
    Lookup cells;  // value: cell * cell_type_count + type
};

NumberIndex::NumberIndex(const Mesh& mesh) : tables_(std::make_unique<Tables>()) {
    tables_->nodes.reserve(mesh.largest_node_id(), mesh.node_count());
    SparseCheck check(1 << 14);
    for (Index i = 0; i < mesh.node_count(); ++i, check()) tables_->nodes.put(mesh.node_ids[i], i);
    tables_->cells.reserve(mesh.largest_cell_id(), mesh.cell_count());
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c, check())
            tables_->cells.put(b.ids[c], c * cell_type_count + static_cast<Index>(b.type));
}

NumberIndex::~NumberIndex() = default;
NumberIndex::NumberIndex(NumberIndex&&) noexcept = default;

std::optional<Index> NumberIndex::node(Index id) const {
    const std::int64_t i = tables_->nodes.get(id);
    return i < 0 ? std::nullopt : std::optional<Index>(i);
}

std::optional<CellRef> NumberIndex::cell(Index id) const {
    const std::int64_t v = tables_->cells.get(id);
    if (v < 0) return {};
    return CellRef{static_cast<CellType>(v % cell_type_count), v / cell_type_count};
}

namespace {

/// Which families contain `group`, as a table by family.
std::vector<char> families_with(const Mesh& mesh, GroupIndex group) {
    std::vector<char> in(static_cast<std::size_t>(mesh.families.size()));
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f) in[f] = mesh.families.contains(f, group);
    return in;
}

std::string describe(const Group& group) { return std::string(to_string(group.kind)) + " group '" + group.name + "'"; }

Index find_node(const NumberIndex& numbers, const Group& group, Index id) {
    const auto node = numbers.node(id);
    if (!node) throw Error(describe(group) + " names node " + std::to_string(id) + ", which the mesh does not have");
    return *node;
}

CellRef find_cell(const NumberIndex& numbers, const Group& group, Index id) {
    const auto cell = numbers.cell(id);
    if (!cell) throw Error(describe(group) + " names element " + std::to_string(id) + ", which the mesh does not have");
    return *cell;
}

int last_face(CellType type) {
    const CellTraits& t = traits(type);
    if (t.dimension == 3) return static_cast<int>(t.faces.size());
    if (t.dimension == 2) return 2 + t.corners;
    return 0;
}

void check_facet(const Group& group, CellType type, Index id, Index face) {
    if (face < 1 || face > last_face(type))
        throw Error(describe(group) + " names face " + std::to_string(face) + " of element " + std::to_string(id) +
                    ", a " + std::string(traits(type).name) + ", which has faces 1 to " +
                    std::to_string(last_face(type)));
}

using FacetKey = std::array<Index, 3>;  // type, cell, face

FacetKey key_of(const Facet& f) { return {static_cast<Index>(f.type), f.cell, f.face}; }

/// Applies `change` to family indices, computing it once per family.
template <class Change>
class Memo {
public:
    explicit Memo(Change change) : change_(change) {}
    FamilyIndex operator()(FamilyIndex f) {
        if (static_cast<std::size_t>(f) >= known_.size()) known_.resize(static_cast<std::size_t>(f) + 1, -1);
        if (known_[f] < 0) {
            const FamilyIndex image = change_(f);
            known_[f] = image;
        }
        return known_[f];
    }

private:
    Change change_;
    std::vector<FamilyIndex> known_;
};

template <class Visit>
void for_each_family_slot(Mesh& mesh, Visit visit) {
    for (FamilyIndex& f : mesh.node_families) visit(f);
    for (CellBlock& b : mesh.blocks())
        for (FamilyIndex& f : b.families) visit(f);
    for (Facet& f : mesh.facets) visit(f.family);
}

void drop_free_facets(Mesh& mesh) {
    std::erase_if(mesh.facets, [](const Facet& f) { return f.family == 0; });
}

/// Membership as (entity, group) pairs. Groups ascend within each entity, as they are visited in order.
struct Memberships {
    std::vector<Index> entity;
    std::vector<GroupIndex> group;

    void add(Index e, std::size_t g) {
        entity.push_back(e);
        group.push_back(static_cast<GroupIndex>(g));
    }
};

using FacetMemberships = std::vector<std::pair<FacetKey, GroupIndex>>;

/// The family of each of `count` entities.
std::vector<FamilyIndex> families_of(const Memberships& pairs, Index count, FamilyTable& families) {
    std::vector<Index> start(static_cast<std::size_t>(count) + 1, 0);
    for (Index e : pairs.entity) ++start[e + 1];
    for (Index e = 0; e < count; ++e) start[e + 1] += start[e];
    std::vector<GroupIndex> bucket(pairs.group.size());
    std::vector<Index> fill(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < pairs.entity.size(); ++i) bucket[fill[pairs.entity[i]]++] = pairs.group[i];
    std::vector<FamilyIndex> out(static_cast<std::size_t>(count), 0);
    std::vector<GroupIndex> set;
    for (Index e = 0; e < count; ++e) {
        if (start[e] == start[e + 1]) continue;
        set.assign(bucket.begin() + start[e], bucket.begin() + start[e + 1]);
        set.erase(std::unique(set.begin(), set.end()), set.end());
        out[e] = families.intern(set);
    }
    return out;
}

std::vector<Facet> facets_of(FacetMemberships pairs, FamilyTable& families) {
    std::ranges::sort(pairs);
    std::vector<Facet> out;
    std::vector<GroupIndex> set;
    for (std::size_t i = 0; i < pairs.size();) {
        const FacetKey key = pairs[i].first;
        set.clear();
        for (; i < pairs.size() && pairs[i].first == key; ++i) set.push_back(pairs[i].second);
        set.erase(std::unique(set.begin(), set.end()), set.end());
        out.push_back({static_cast<CellType>(key[0]), static_cast<std::int8_t>(key[2]), families.intern(set), key[1]});
    }
    return out;
}

/// Looks up the members of a facet group.
void add_facets(const NumberIndex& numbers, const Group& group, const GroupMembers& m, GroupIndex g,
                FacetMemberships& out) {
    if (m.faces.size() != m.ids.size()) throw Error(describe(group) + " needs one face number per element number");
    for (std::size_t i = 0; i < m.ids.size(); ++i) {
        const CellRef c = find_cell(numbers, group, m.ids[i]);
        check_facet(group, c.type, m.ids[i], m.faces[i]);
        out.push_back({{static_cast<Index>(c.type), c.cell, m.faces[i]}, g});
    }
}

}  // namespace

GroupMembers group_members(const Mesh& mesh, GroupIndex group) {
    GroupMembers out;
    out.kind = mesh.groups.at(static_cast<std::size_t>(group)).kind;
    const std::vector<char> in = families_with(mesh, group);
    check_cancelled();
    switch (out.kind) {
        case GroupKind::node:
            for (Index i = 0; i < mesh.node_count(); ++i)
                if (in[mesh.node_families[i]]) out.ids.push_back(mesh.node_ids[i]);
            break;
        case GroupKind::element:
            for (const CellBlock& b : mesh.blocks())
                for (Index c = 0; c < b.size(); ++c)
                    if (in[b.families[c]]) out.ids.push_back(b.ids[c]);
            break;
        case GroupKind::facet:
            for (const Facet& f : mesh.facets)
                if (in[f.family]) {
                    out.ids.push_back(mesh.block(f.type).ids[f.cell]);
                    out.faces.push_back(f.face);
                }
            break;
    }
    return out;
}

void set_group_members(Mesh& mesh, GroupIndex group, const GroupMembers& members) {
    const Group& g = mesh.groups.at(static_cast<std::size_t>(group));
    const NumberIndex numbers(mesh);
    // Everything is looked up before anything changes, so that a bad number leaves the mesh as it was.
    std::vector<Index> nodes;
    std::vector<CellRef> cells;
    SparseCheck check;
    for (Index id : members.ids) {
        check();
        if (g.kind == GroupKind::node)
            nodes.push_back(find_node(numbers, g, id));
        else
            cells.push_back(find_cell(numbers, g, id));
    }
    if (g.kind == GroupKind::facet) {
        if (members.faces.size() != members.ids.size())
            throw Error(describe(g) + " needs one face number per element number");
        for (std::size_t i = 0; i < cells.size(); ++i) check_facet(g, cells[i].type, members.ids[i], members.faces[i]);
    }

    Memo without([&](FamilyIndex f) { return mesh.families.without(f, group); });
    Memo with([&](FamilyIndex f) { return mesh.families.with(f, group); });
    for_each_family_slot(mesh, [&](FamilyIndex& f) { f = without(f); });
    if (g.kind == GroupKind::node) {
        for (Index n : nodes) mesh.node_families[n] = with(mesh.node_families[n]);
    } else if (g.kind == GroupKind::element) {
        for (const CellRef& c : cells) {
            FamilyIndex& f = mesh.block(c.type).families[c.cell];
            f = with(f);
        }
    } else {
        for (std::size_t i = 0; i < cells.size(); ++i)
            mesh.facets.push_back({cells[i].type, static_cast<std::int8_t>(members.faces[i]), with(0), cells[i].cell});
        std::ranges::stable_sort(mesh.facets, {}, key_of);
        std::vector<Facet> merged;
        for (const Facet& f : mesh.facets) {
            if (!merged.empty() && key_of(merged.back()) == key_of(f))
                merged.back().family = mesh.families.unite(merged.back().family, f.family);
            else
                merged.push_back(f);
        }
        mesh.facets = std::move(merged);
    }
    drop_free_facets(mesh);
}

void assign_groups(Mesh& mesh, std::span<const GroupMembers> members) {
    const NumberIndex numbers(mesh);
    std::array<Index, cell_type_count + 1> first_cell{};
    for (int t = 0; t < cell_type_count; ++t) first_cell[t + 1] = first_cell[t] + mesh.blocks()[t].size();

    Memberships in_nodes, in_cells;
    FacetMemberships in_facets;
    for (std::size_t g = 0; g < members.size(); ++g) {
        check_cancelled();
        const Group& group = mesh.groups.at(g);
        const GroupMembers& m = members[g];
        if (group.kind == GroupKind::node) {
            for (Index id : m.ids) in_nodes.add(find_node(numbers, group, id), g);
        } else if (group.kind == GroupKind::element) {
            for (Index id : m.ids) {
                const CellRef c = find_cell(numbers, group, id);
                in_cells.add(first_cell[static_cast<int>(c.type)] + c.cell, g);
            }
        } else {
            add_facets(numbers, group, m, static_cast<GroupIndex>(g), in_facets);
        }
    }

    mesh.families = FamilyTable();
    mesh.node_families = families_of(in_nodes, mesh.node_count(), mesh.families);
    const std::vector<FamilyIndex> cells = families_of(in_cells, first_cell[cell_type_count], mesh.families);
    for (int t = 0; t < cell_type_count; ++t)
        mesh.blocks()[t].families.assign(cells.begin() + first_cell[t], cells.begin() + first_cell[t + 1]);
    mesh.facets = facets_of(std::move(in_facets), mesh.families);
}

void rename_group(Mesh& mesh, GroupIndex group, const std::string& name) {
    Group& renamed = mesh.groups.at(static_cast<std::size_t>(group));
    const auto taken = mesh.find_group(name, renamed.kind);
    if (taken && *taken != group)
        throw Error("the mesh already has a " + std::string(to_string(renamed.kind)) + " group '" + name + "'");
    if (mesh.companion)
        if (auto companion = mesh.companion->with_renamed_group(renamed.kind, renamed.name, name))
            mesh.companion = std::move(companion);
    renamed.name = name;
}

void remove_group(Mesh& mesh, GroupIndex group) {
    std::vector<bool> gone(mesh.groups.size(), false);
    gone.at(static_cast<std::size_t>(group)) = true;
    remove_groups(mesh, gone);
}

void remove_groups(Mesh& mesh, const std::vector<bool>& gone) {
    std::vector<GroupIndex> now(mesh.groups.size(), -1);
    std::vector<Group> left;
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        if (gone[g]) continue;
        now[g] = static_cast<GroupIndex>(left.size());
        left.push_back(std::move(mesh.groups[g]));
    }
    mesh.groups = std::move(left);
    FamilyTable table;
    std::vector<GroupIndex> set;
    Memo renumbered([&](FamilyIndex f) {
        set.clear();
        for (GroupIndex g : mesh.families.groups(f))
            if (now[g] >= 0) set.push_back(now[g]);
        return table.intern(set);
    });
    for_each_family_slot(mesh, [&](FamilyIndex& f) { f = renumbered(f); });
    mesh.families = std::move(table);
    drop_free_facets(mesh);
}

void compact_families(Mesh& mesh) {
    FamilyTable table;
    Memo kept([&](FamilyIndex f) { return table.intern(mesh.families.groups(f)); });
    for_each_family_slot(mesh, [&](FamilyIndex& f) { f = kept(f); });
    mesh.families = std::move(table);
}

}  // namespace femscalpel
