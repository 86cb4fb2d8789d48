// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/unite.h"

#include <algorithm>
#include <optional>
#include <unordered_set>

#include "cutting/rebuild.h"
#include "deck/adopt_sections.h"
#include "deck/solver_input.h"
#include "error.h"
#include "mesh/middles.h"

namespace femscalpel {
namespace {

class Uniter {
public:
    Uniter(Mesh& mesh, const Mesh& addition, const std::vector<Index>& shared, const UniteNames& names)
        : mesh_(mesh), addition_(addition), place_(shared), names_(names), number_(next_numbers(mesh)) {}

    /// Of the mesh, by group of the addition; -1: none.
    const std::vector<GroupIndex>& groups() const { return group_; }

    void run(std::optional<GroupIndex> added) {
        find_groups();
        share_middles();
        for (Index n = 0; n < addition_.node_count(); ++n) {
            if (place_[n] < 0) {
                place_[n] = mesh_.add_node(addition_.points[n], number_.node++, family(0, addition_.node_families[n]));
                continue;
            }
            FamilyIndex& own = mesh_.node_families[place_[n]];
            own = family(own, addition_.node_families[n]);
        }
        add_elements(added);
    }

private:
    /// The mesh's group of that name, as CalculiX compares names if it has a deck.
    std::optional<GroupIndex> found(const std::string& name, std::optional<GroupKind> kind) const {
        if (const auto exact = mesh_.find_group(name, kind); exact || !solver_input(mesh_)) return exact;
        const std::string key = deck_key(name);
        for (std::size_t g = 0; g < mesh_.groups.size(); ++g)
            if (const Group& group = mesh_.groups[g];
                !group.hidden && (!kind || group.kind == *kind) && deck_key(group.name) == key)
                return static_cast<GroupIndex>(g);
        return {};
    }

    /// Which group of the mesh each of the addition's becomes.
    void find_groups() {
        for (const Group& g : addition_.groups) {
            if (g.hidden) {
                group_.push_back(-1);
                continue;
            }
            const auto same = found(g.name, g.kind);
            if (same && names_.join_groups) {
                group_.push_back(*same);
                continue;
            }
            const std::string name = found(g.name, {}) ? names_.prefix + g.name : g.name;
            if (found(name, {}))
                throw ToolError("the addition's group '" + g.name +
                                    "' has the name of one that the mesh has, and so has '" + name +
                                    "': give another prefix",
                                "prefix");
            group_.push_back(mesh_.add_group(name, g.kind));
        }
    }

    FamilyIndex family(FamilyIndex own, FamilyIndex of_addition) {
        for (const GroupIndex g : addition_.families.groups(of_addition))
            if (group_[g] >= 0) own = mesh_.families.with(own, group_[g]);
        return own;
    }

    void share_middles() {
        std::unordered_set<Index> here, there;
        for (Index n = 0; n < addition_.node_count(); ++n)
            if (place_[n] >= 0) {
                here.insert(place_[n]);
                there.insert(n);
            }
        const auto both_in = [](const std::unordered_set<Index>& set) {
            return [&set](Index a, Index b) { return set.contains(a) && set.contains(b); };
        };
        const auto ours = middles_of(mesh_, both_in(here));
        if (ours.empty()) return;
        for (const auto& [key, middle] : middles_of(addition_, both_in(there))) {
            const auto found = ours.find(
                mesh_edge_key(place_[static_cast<Index>(key >> 32)], place_[static_cast<Index>(key & 0xffffffffU)]));
            if (found != ours.end()) place_[middle] = found->second;
        }
    }

    void add_elements(std::optional<GroupIndex> added) {
        std::array<Index, cell_type_count> first{};
        for (const CellBlock& b : addition_.blocks()) {
            first[static_cast<int>(b.type)] = mesh_.block(b.type).size();
            std::vector<Index> nodes;
            for (Index c = 0; c < b.size(); ++c) {
                nodes.clear();
                for (const Index n : b.nodes(c)) nodes.push_back(place_[n]);
                const FamilyIndex own = family(0, b.families[c]);
                mesh_.add_cell(b.type, nodes, number_.cell++, added ? mesh_.families.with(own, *added) : own);
            }
        }
        for (const Facet& f : addition_.facets)
            mesh_.facets.push_back({f.type, f.face, family(0, f.family), first[static_cast<int>(f.type)] + f.cell});
    }

    Mesh& mesh_;
    const Mesh& addition_;
    std::vector<Index> place_;  // in the mesh, by node of the addition
    const UniteNames& names_;
    Numbering number_;
    std::vector<GroupIndex> group_;
};

}  // namespace

void unite(Mesh& mesh, const Mesh& addition, const std::vector<Index>& shared, const std::string& added,
           const UniteNames& names) {
    std::optional<Mesh> renamed;
    if (solver_input(mesh) && solver_input(addition)) {
        renamed = addition;
        rename_section_groups(mesh, *renamed, names.prefix);
    }
    const Mesh& other = renamed ? *renamed : addition;
    Uniter uniter(mesh, other, shared, names);
    uniter.run(mesh.find_group(added, GroupKind::element));
    adopt_sections(mesh, other, uniter.groups(), names.prefix);
}

}  // namespace femscalpel
