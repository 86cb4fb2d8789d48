# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of quadrangles, hexahedra and prisms, and what has to hold for what is made of them."""

import collections

import numpy as np

import femscalpel as fs

EDGES = {
    "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "hexahedron": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
    "wedge": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "pyramid": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
    "triangle": [(0, 1), (1, 2), (2, 0)],
    "tetra": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
}

#: Faces by corners.
FACES = {
    "tetra": [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)],
    "pyramid": [(0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)],
    "wedge": [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
    "hexahedron": [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)],
}


def grid(counts, jitter=0.0):
    """Points and cubes (or squares) of side 1, inner nodes moved at random."""
    random = np.random.default_rng(1)
    points = np.stack(np.meshgrid(*[np.arange(n + 1.0) for n in counts], indexing="ij"), axis=-1)
    inner = tuple(slice(1, -1) for _ in counts)
    points[inner] += jitter * random.uniform(-1, 1, points[inner].shape)
    index = np.arange(np.prod([n + 1 for n in counts])).reshape([n + 1 for n in counts])
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    if len(counts) == 3:
        corners = [(*c, z) for z in (0, 1) for c in corners]
    cells = [index[tuple(slice(o, n + o) for o, n in zip(c, counts))].ravel() for c in corners]
    points = points.reshape(-1, len(counts))
    if len(counts) == 2:
        points = np.hstack([points, np.zeros((len(points), 1))])
    return points, np.stack(cells, axis=1)


def second_order(points, cells, kind):
    points, middles, out = list(points), {}, []
    for cell in cells:
        row = list(cell)
        for a, b in EDGES[kind]:
            key = tuple(sorted((cell[a], cell[b])))
            if key not in middles:
                middles[key] = len(points)
                points.append((points[cell[a]] + points[cell[b]]) / 2)
            row.append(middles[key])
        out.append(row)
    return np.array(points), np.array(out)


def second_order_of_all(points, cells):
    """The same for elements of several kinds, with common mid-side nodes."""
    points, middles, out = list(points), {}, {}
    names = {"quad": "quad8", "hexahedron": "hexahedron20", "wedge": "wedge15", "triangle": "triangle6"}
    for kind, rows in cells.items():
        out[names[kind]] = made = []
        for cell in rows:
            row = list(cell)
            for a, b in EDGES[kind]:
                key = tuple(sorted((cell[a], cell[b])))
                if key not in middles:
                    middles[key] = len(points)
                    points.append((points[cell[a]] + points[cell[b]]) / 2)
                row.append(middles[key])
            made.append(row)
    return np.array(points), out


def prisms_of(hexahedra):
    """Each hexahedron cut into two prisms, along the same way as its neighbours."""
    return np.concatenate([hexahedra[:, [0, 1, 2, 4, 5, 6]], hexahedra[:, [0, 2, 3, 4, 6, 7]]])


def outer_faces(mesh):
    """Corners around each face that only one solid has, by the same in order; an assertion fails if one has three."""
    count, around = collections.Counter(), {}
    for kind, cells in mesh.cells.items():
        for face in FACES.get(kind.rstrip("0123456789"), []):
            rings = np.asarray(cells)[:, list(face)]
            for ring, nodes in zip(rings.tolist(), map(tuple, np.sort(rings, axis=1).tolist())):
                count[nodes] += 1
                around[nodes] = ring
    assert max(count.values(), default=1) <= 2, "a face of three elements"
    return {nodes: around[nodes] for nodes, times in count.items() if times == 1}


def outer_area(mesh):
    """Area of the faces that only one solid has, by their corners; an assertion fails where faces do not fit."""
    area = 0.0
    for nodes in outer_faces(mesh):
        p = mesh.points[list(nodes)]
        if len(p) == 3:
            area += np.linalg.norm(np.cross(p[1] - p[0], p[2] - p[0])) / 2
        else:  # of the three orders of four corners the one that does not cross itself encloses most
            area += max(
                np.linalg.norm(np.cross(p[o[2]] - p[o[0]], p[o[3]] - p[o[1]])) / 2
                for o in ((0, 1, 2, 3), (0, 2, 1, 3), (0, 1, 3, 2))
            )
    return area


def worst_of(mesh):
    """Of solids, or else of shells."""
    ratios = {k: v.min() for k, v in fs.mean_ratio(mesh).items() if len(v)}
    solids = [q for k, q in ratios.items() if k.rstrip("0123456789") in FACES]
    return min(solids or [q for k, q in ratios.items() if k.startswith(("triangle", "quad"))])
