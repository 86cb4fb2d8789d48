// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cutting/workpiece.h"

namespace femscalpel {

/// A band taken apart along its interface (resources/docs/architecture.md, "open"; paper, 3.1.3): which elements get
/// copies of which nodes, and the two lips. Node numbers from BandMesh::size() on are copies.
struct Opening {
    std::vector<int> copy_of;  ///< source of each copied node

    /// Corner nodes of each element by slot, copies in place; elements not listed keep theirs.
    std::vector<std::array<int, 4>> tetras;
    std::vector<std::array<int, 3>> triangles;
    std::vector<std::array<int, 2>> lines;
    std::vector<std::array<int, 1>> vertices;

    /// An element on the crack that needs a second copy, for the other side.
    template <std::size_t N>
    struct Twin {
        int slot;
        std::array<int, N> nodes;
    };
    std::vector<Twin<3>> triangle_twins;
    std::vector<Twin<2>> line_twins;

    static constexpr int fresh = 1 << 30;  ///< Face::element where no element lies yet

    /// A face (edge, for shells) of a lip. `element`: slot of an element that already lies there, or
    /// minus one minus the index of a twin, or `fresh`.
    template <std::size_t N>
    struct Face {
        std::array<int, N> nodes;
        int group;  ///< which of the operator's groups of faces; of a crack: 0 the negative lip, 1 the positive
        int element;
        bool second_order;
    };
    std::vector<Face<3>> faces;  ///< normals out of the material
    std::vector<Face<2>> edges;

    /// An end of a beam where that was cut, in `group` as Face::group.
    struct End {
        int node;
        int group;
    };
    std::vector<End> ends;

    std::vector<int> interface_nodes;  ///< nodes of open faces and edges, ascending
    /// The front inside a solid as chains of nodes, each joined to the next by an edge; a closed one ends where it
    /// begins. Only of a crack that is bounded by a patch.
    std::vector<std::vector<int>> front_chains;
    bool removes = false;          ///< elements were taken out, and their nodes may have to go
    std::vector<int> front_nodes;  ///< of them, those that stay single
    std::vector<std::string> warnings;
};

/// Takes the band apart wherever elements on both sides of the tool share a face (an edge, for shells)
/// whose nodes all lie on the tool. At each interface node the elements fall into parts that are joined
/// by other faces and edges; the largest part on the negative side keeps the node, every other gets a
/// copy. Nodes with one part (a front) stay single.
///
/// Beams in a node of Workpiece::beam_nodes come apart there from others on the other side, and from elements that are
/// all on that; these keep the node, else the beams on the negative side do.
///
/// Other discrete elements that end on a doubled node stay whole, on one side, and a warning says so: a spring on
/// the side its other end is on, a mass or spring to ground, and what has all its nodes on the tool, on the side with
/// most elements there, the negative one if they are as many.
Opening open_lips(const Workpiece& workpiece);

/// The band as it is, nothing opened.
Opening no_opening(const BandMesh& band);

}  // namespace femscalpel
