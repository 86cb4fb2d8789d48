// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace femscalpel::checks {

/// A box of nx x ny x nz cubes of side 1 about the origin's octant, each of six tetrahedra around a diagonal.
Mesh grid(int nx, int ny, int nz);

/// A cube of eight such cubes; the element groups LEFT (0) and RIGHT (1) are its halves in x.
Mesh two_halves();

/// A plate of 2 nx ny triangles with corner `origin` and cube edges `x`, `y`, sharing nodes that are already there.
void add_plate(Mesh& mesh, const Vec3& origin, const Vec3& x, const Vec3& y, int nx, int ny, FamilyIndex family = 0);

/// A block of nx x ny x nz hexahedra of side 1 about the origin's octant.
Mesh bricks(int nx, int ny, int nz);

/// A plate of nx x ny quadrangles of side 1 in z = 0.
Mesh quadrangles(int nx, int ny);

/// The same mesh with second-order triangles and tetrahedra, their mid-side nodes in the middle of straight edges.
Mesh second_order(const Mesh& mesh);

/// A new group's family.
FamilyIndex family_of(Mesh& mesh, const char* name, GroupKind kind);

/// Index of the node there.
Index number_near(const Mesh& mesh, const Vec3& at);

/// Numbers of a group's nodes or elements.
std::vector<Index> members(const Mesh& mesh, const char* name, GroupKind kind);

/// Tetrahedra 1 above and 2 below a triangle, with the double nodes 1 2 3 and 11 12 13.
Mesh touching_tetrahedra();

}  // namespace femscalpel::checks
