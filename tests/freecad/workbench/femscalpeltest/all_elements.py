# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of every element type, for tests of what FreeCAD makes of them."""

import numpy as np

import femscalpel as fs

#: The types of solids.
SOLIDS = ("tetra", "tetra10", "pyramid", "pyramid13", "wedge", "wedge15", "hexahedron", "hexahedron20")

# Of a brick (of a square), VTK's order: what it is cut into, 8 (4) standing for its middle; and edges with middles.
_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
_PARTS = {
    "hexahedron": ((0, 1, 2, 3, 4, 5, 6, 7),),
    "wedge": ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)),
    "pyramid": tuple((*face[::-1], 8) for face in _FACES),
    "tetra": tuple((0, a, b, 6) for a, b in ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))),
    "quad": ((0, 1, 2, 3),),
    "triangle": ((0, 1, 2), (0, 2, 3)),
}
_EDGES = {
    "tetra10": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    "pyramid13": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    "wedge15": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexahedron20": tuple((a, b) for a, b in zip((0, 1, 2, 3, 4, 5, 6, 7), (1, 2, 3, 0, 5, 6, 7, 4)))
    + tuple((a, a + 4) for a in range(4)),
    "quad8": ((0, 1), (1, 2), (2, 3), (3, 0)),
    "triangle6": ((0, 1), (1, 2), (2, 0)),
}


def mesh_of(kind):
    """A box 6 x 4 x 3 (a plate 6 x 4) of elements of one type, of the size 1.

    The node groups SECTION and HALF are all, and a half, of what is at x = 3; END is at x = 0. The element groups LOW
    and HIGH are what is below and above x = 3.
    """
    shape = kind.rstrip("0123456789")
    flat = shape in ("quad", "triangle")
    points, bricks = _grid((6, 4) if flat else (6, 4, 3))
    if shape == "pyramid":
        middles = len(points) + np.arange(len(bricks))
        points = np.concatenate([points, points[bricks].mean(axis=1)])
        bricks = np.column_stack([bricks, middles])
    cells = np.concatenate([bricks[:, list(part)] for part in _PARTS[shape]])
    if kind != shape:
        points, cells = _second_order(points, cells, _EDGES[kind])
    mesh = fs.Mesh(points, {kind: cells})
    x, y = points[:, 0], points[:, 1]
    mesh.add_group("HALF", "node", mesh.node_ids[(x == 3) & (y <= 2)])
    mesh.add_group("SECTION", "node", mesh.node_ids[x == 3])
    mesh.add_group("END", "node", mesh.node_ids[x == 0])
    low = points[cells].mean(axis=1)[:, 0] < 3
    mesh.add_group("LOW", "element", mesh.cell_ids[kind][low])
    mesh.add_group("HIGH", "element", mesh.cell_ids[kind][~low])
    return mesh


def _grid(counts):
    points = np.stack(np.meshgrid(*[np.arange(n + 1.0) for n in counts], indexing="ij"), axis=-1)
    index = np.arange(np.prod([n + 1 for n in counts])).reshape([n + 1 for n in counts])
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    if len(counts) == 3:
        corners = [(*c, z) for z in (0, 1) for c in corners]
    cells = [index[tuple(slice(o, n + o) for o, n in zip(c, counts))].ravel() for c in corners]
    points = points.reshape(-1, len(counts))
    if len(counts) == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return points, np.stack(cells, axis=1)


def _second_order(points, cells, edges):
    pairs = np.sort(np.stack([cells[:, list(edge)] for edge in edges], axis=1), axis=2)
    unique, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    middles = len(points) + inverse.reshape(-1, len(edges))
    return np.concatenate([points, points[unique].mean(axis=1)]), np.column_stack([cells, middles])


def plate_with_beams():
    """The plate of quadrangles, with the beams POST, 3 high, on the node in the middle, and segments RIM at y = 0."""
    plate = mesh_of("quad")
    foot = np.flatnonzero((plate.points == (3, 2, 0)).all(axis=1))[0]
    rim = np.flatnonzero(plate.points[:, 1] == 0)
    nodes = [foot, *(len(plate.points) + np.arange(3))]
    lines = [*zip(nodes, nodes[1:]), *zip(rim, rim[1:])]
    points = np.concatenate([plate.points, [(3, 2, z) for z in (1.0, 2.0, 3.0)]])
    mesh = fs.Mesh(points, {"quad": plate.cells["quad"], "line": lines})
    mesh.add_group("POST", "element", mesh.cell_ids["line"][:3])
    mesh.add_group("RIM", "element", mesh.cell_ids["line"][3:])
    mesh.add_group("SECTION", "node", mesh.node_ids[points[:, 0] == 3])
    return mesh
