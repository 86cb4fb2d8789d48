// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// A place as a weighted sum of nodes: (node index, weight), ascending by node.
using Blend = std::vector<std::pair<Index, double>>;

/// Adds `factor` times `from`.
void add(Blend& to, const Blend& from, double factor = 1);

/// Where it is.
Vec3 place_of(const Mesh& mesh, const Blend& blend);

/// The shape functions of a quadrangle, prism or hexahedron in the form: the straight element's, and what the mid-side
/// nodes are beside the middles of their edges times functions of their own (serendipity functions; nodes in the middle
/// of faces and of the element count for nothing).
class ShapeBlend {
public:
    /// `nodes`: connectivity of an element of `type`, which must outlive this.
    ShapeBlend(CellType type, std::span<const Index> nodes) : type_(type), nodes_(nodes) {}

    /// Reference coordinates of a corner: -1 to 1; of prisms the triangle's from 0 to 1 and the height's.
    static Vec3 corner(CellType type, int k);
    /// Those of the middle.
    static Vec3 middle(CellType type);
    /// Whether they are inside the element, `margin` away from its faces.
    static bool inside(CellType type, const Vec3& x, double margin);

    /// The place with these reference coordinates.
    Blend at(const Vec3& x) const;
    /// What the bent edges add to that of the straight element.
    Blend bulge(const Vec3& x) const;

private:
    CellType type_;
    std::span<const Index> nodes_;
};

}  // namespace femscalpel
