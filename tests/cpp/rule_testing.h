// SPDX-License-Identifier: LGPL-2.1-or-later
// Two tetrahedra with a deck, small changes of them made by hand, and what a card says afterwards, word by word.
#pragma once

#include "deck/carry_over.h"
#include "deck/mark_deck.h"
#include "deck_testing.h"

namespace femscalpel::rule_testing {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;

/// A change of the two tetrahedra: an operator's result, and its account of what it did.
using Change = void (*)(Mesh& mesh, Changes& changes);

inline CellBlock& tetras(Mesh& mesh) { return mesh.block(CellType::tetra); }

/// Nodes of element 1 or 2, to be changed.
inline Index* nodes_of_element(Mesh& mesh, Index number) { return &tetras(mesh).connectivity[4 * (number - 1)]; }

/// Nothing but node 5 and element 2 go.
inline void remove_element_2(Mesh& mesh, Changes& /*changes*/) {
    std::erase_if(mesh.facets, [](const Facet& f) { return f.cell == 1; });
    tetras(mesh).connectivity.resize(4);
    tetras(mesh).ids.pop_back();
    tetras(mesh).families.pop_back();
    mesh.points.pop_back();
    mesh.node_ids.pop_back();
    mesh.node_families.pop_back();
}

/// Element 2 gets a copy of node 2, number 6: a crack between the elements.
inline void double_node_2(Mesh& mesh, Changes& changes) {
    nodes_of_element(mesh, 2)[0] = mesh.add_node(mesh.points[1], 6, mesh.node_families[1]);
    changes.copies.push_back({6, 2});
}

/// Node 6 is born in the middle between 1 and 2; element 1 keeps the half at node 1, element 3 is the one at node 2.
inline void halve_element_1(Mesh& mesh, Changes& changes) {
    const FamilyIndex family = mesh.families.intersect(mesh.node_families[0], mesh.node_families[1]);
    const Index born = mesh.add_node((mesh.points[0] + mesh.points[1]) / 2, 6, family);
    const std::array<Index, 4> half{born, 1, 2, 3};
    const Index added = mesh.add_cell(CellType::tetra, half, 3, tetras(mesh).families[0]);
    nodes_of_element(mesh, 1)[1] = born;
    std::vector<Facet> facets;
    for (Facet f : mesh.facets) {
        if (f.cell != 0 || f.face != 3) facets.push_back(f);  // face 3 is the one without node 1
        if (f.cell != 0 || f.face == 4) continue;             // face 4 the one without node 2
        f.cell = added;
        facets.push_back(f);
    }
    mesh.facets = facets;
    changes.born.push_back({6, {1, 2}});
    changes.parts.push_back({3, 1});
}

/// What a deck and those who ran an operator on it have in the end.
struct Carried {
    std::string cards;                  ///< text of all cards but *NODE and *ELEMENT
    std::vector<std::string> warnings;  ///< places from the name of the file
    Mesh mesh;
};

class RuleTest : public deck_testing::DeckSemantics {
protected:
    /// Cards start at line 10; all nodes are in the set NALL, both elements in EALL.
    Mesh two_tetras(const std::string& cards) const {
        return read(
            "*NODE, NSET=NALL\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n5, 1., 1., 1.\n"
            "*ELEMENT, TYPE=C3D4, ELSET=EALL\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n" +
            cards);
    }

    /// Marks, changes and carries over.
    Carried carried(const std::string& cards, Change change) const {
        const Mesh mesh = two_tetras(cards);
        const DeckMarks marks = mark_deck(mesh);
        const Mesh& before = marks.mesh ? *marks.mesh : mesh;
        Carried out{"", {}, before};
        Changes changes;
        change(out.mesh, changes);
        out.warnings = warnings_of(carry_deck(before, out.mesh, changes), false);
        remove_marks(out.mesh);
        out.mesh.validate();
        for (std::string& w : out.warnings)
            for (std::size_t at; (at = w.find(folder_.string() + "/")) != w.npos;)
                w.erase(at, folder_.string().size() + 1);
        for (const Card& card : solver_input(out.mesh)->cards())
            if (card.keyword != "NODE" && card.keyword != "ELEMENT")
                for (const DeckText& t : card.text) out.cards += t.text;
        return out;
    }

    /// Numbers of the nodes that must not move.
    std::vector<Index> pinned(const std::string& cards) const {
        const Mesh mesh = two_tetras(cards);
        std::vector<Index> out;
        for (const Index n : mark_deck(mesh).pinned) out.push_back(mesh.node_ids[n]);
        return out;
    }

    /// Members of the groups that must keep their shape: nodes, elements, or 10 times element plus face.
    std::vector<std::vector<Index>> marked(const std::string& cards) const {
        const Mesh mesh = two_tetras(cards);
        const DeckMarks marks = mark_deck(mesh);
        std::vector<std::vector<Index>> out;
        for (std::size_t g = 0; marks.mesh && g < marks.kept.size(); ++g) {
            if (!marks.kept[g]) continue;
            const GroupMembers members = group_members(*marks.mesh, static_cast<GroupIndex>(g));
            out.push_back(members.ids);
            for (std::size_t k = 0; k < members.faces.size(); ++k)
                out.back()[k] = 10 * members.ids[k] + members.faces[k];
        }
        return out;
    }
};

}  // namespace femscalpel::rule_testing
