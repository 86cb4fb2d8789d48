// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/elementary_groups.h"

#include <algorithm>
#include <iterator>

#include "cancel.h"

namespace femscalpel {
namespace {

/// The classes of one kind and dimension, by family.
class Classes {
public:
    Classes(GroupKind kind, int dimension, const FamilyTable& visible)
        : kind_(kind), dimension_(dimension), visible_(visible), slot_(static_cast<std::size_t>(visible.size()), -1) {}

    /// Members of a class of `visible`; what is in no visible group belongs nowhere.
    GroupMembers* members(FamilyIndex family) {
        if (family == 0) return nullptr;
        int& slot = slot_[family];
        if (slot < 0) {
            slot = static_cast<int>(classes_.size());
            const auto groups = visible_.groups(family);
            classes_.push_back({kind_, dimension_, {groups.begin(), groups.end()}, {kind_, {}, {}}});
        }
        return &classes_[slot].members;
    }

    void move_to(std::vector<ElementaryGroup>& out) {
        std::ranges::sort(classes_, {}, &ElementaryGroup::groups);
        std::ranges::move(classes_, std::back_inserter(out));
    }

private:
    GroupKind kind_;
    int dimension_;
    const FamilyTable& visible_;
    std::vector<int> slot_;
    std::vector<ElementaryGroup> classes_;
};

}  // namespace

std::vector<ElementaryGroup> elementary_groups(const Mesh& mesh) {
    FamilyTable visible;
    std::vector<FamilyIndex> image(static_cast<std::size_t>(mesh.families.size()));
    std::vector<GroupIndex> set;
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f) {
        set.clear();
        for (const GroupIndex g : mesh.families.groups(f))
            if (!mesh.groups[g].hidden) set.push_back(g);
        image[f] = visible.intern(set);
    }

    std::vector<ElementaryGroup> out;
    Classes nodes(GroupKind::node, 0, visible);
    SparseCheck check(1 << 14);
    for (Index n = 0; n < mesh.node_count(); ++n, check())
        if (GroupMembers* m = nodes.members(image[mesh.node_families[n]])) m->ids.push_back(mesh.node_ids[n]);
    nodes.move_to(out);
    for (int dimension = 0; dimension <= 3; ++dimension) {
        Classes elements(GroupKind::element, dimension, visible);
        for (const CellBlock& b : mesh.blocks()) {
            if (traits(b.type).dimension != dimension) continue;
            for (Index c = 0; c < b.size(); ++c, check())
                if (GroupMembers* m = elements.members(image[b.families[c]])) m->ids.push_back(b.ids[c]);
        }
        elements.move_to(out);
    }
    for (int dimension = 1; dimension <= 2; ++dimension) {
        Classes facets(GroupKind::facet, dimension, visible);
        for (const Facet& f : mesh.facets) {
            check();
            // Faces 1 and 2 of a shell element are its two sides, the others its edges.
            if ((traits(f.type).dimension == 3 || f.face <= 2 ? 2 : 1) != dimension) continue;
            if (GroupMembers* m = facets.members(image[f.family])) {
                m->ids.push_back(mesh.block(f.type).ids[f.cell]);
                m->faces.push_back(f.face);
            }
        }
        facets.move_to(out);
    }
    return out;
}

}  // namespace femscalpel
