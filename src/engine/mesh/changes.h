// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Where the new nodes and elements of an operator's result come from, by number. What kept its number is
/// not listed; what was removed or moved shows from the meshes themselves.
struct Changes {
    /// A further node at the place of another: the other side of a crack.
    struct Copy {
        Index node;
        Index source;  ///< a node of the input, or one listed in `born`
    };
    /// A node made on an edge, or in the middle of a face or element.
    struct Born {
        Index node;
        std::vector<Index> ancestors;  ///< nodes of the input: the ends of the edge; of edges born themselves, theirs;
                                       ///< or the corners of the face or element
        /// Nodes of the input and their shares in what a field has at the node; empty if its place is to tell.
        std::vector<std::pair<Index, double>> shares = {};
        /// Of a point of a beam, or one inside the material between two on its skin: what holds its ancestors is not
        /// known to hold what is between them.
        bool spans = false;
    };
    /// A further part of an element, or a second copy of one.
    struct Part {
        Index element;
        Index parent;  ///< element of the input; may itself have kept its number, or be gone
    };

    /// Nodes at one place on either side of faces (edges, shells) that lie on each other with double nodes.
    struct Facing {
        Index node;
        Index other;
    };

    std::vector<Copy> copies;
    std::vector<Born> born;
    std::vector<Part> parts;
    std::vector<Facing> facing;  ///< each pair once; only where double nodes are followed (unweld())

    bool empty() const { return copies.empty() && born.empty() && parts.empty(); }
};

/// Changes that came one after the other as one: what is new descends from what was there before the first.
Changes in_one(std::span<const Changes> stages);

}  // namespace femscalpel
