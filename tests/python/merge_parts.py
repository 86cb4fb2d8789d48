# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plates, rods and tubes to join, and what must hold of what becomes of them."""

import collections
import itertools

import numpy as np

import femscalpel as fs
from meshes import grid_box, tetra_volumes
from mixed_meshes import outer_faces, worst_of

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def triangles_of(index, around=False):
    """Triangles on a grid of nodes, diagonals in turn; with `around` the first direction is closed."""
    rows, columns = index.shape
    out = []
    for i in range(rows if around else rows - 1):
        for j in range(columns - 1):
            a, b, c, d = index[i, j], index[(i + 1) % rows, j], index[(i + 1) % rows, j + 1], index[i, j + 1]
            out += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    return np.array(out)


def shell(points, triangles, name):
    return fs.Mesh(points, {"triangle": triangles}, groups={name: ("element", np.arange(1, len(triangles) + 1))})


def plate(origin, first, second, counts, name, jitter=0.0, seed=0):
    """A parallelogram; inner nodes are off their place by at most `jitter` of the spacing."""
    rng = np.random.default_rng(seed)
    grid = np.stack(np.meshgrid(*(np.linspace(0, 1, n + 1) for n in counts), indexing="ij"), axis=-1)
    inner = np.s_[1:-1, 1:-1]
    grid[inner] += jitter * rng.uniform(-1, 1, grid[inner].shape) / counts
    index = np.arange(grid[..., 0].size).reshape(grid.shape[:2])
    points = np.asarray(origin, float) + grid.reshape(-1, 2) @ np.array([first, second], float)
    return shell(points, triangles_of(index), name)


def half_pipe(radius, length, counts, name):
    """Half a pipe along x, z >= 0, as faceted as `counts` (around, along) says."""
    angle, x = np.meshgrid(np.linspace(0, np.pi, counts[0] + 1), np.linspace(0, length, counts[1] + 1), indexing="ij")
    points = np.stack([x, radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    return shell(points.reshape(-1, 3), triangles_of(np.arange(x.size).reshape(x.shape)), name)


def pipe(centre, radius, height, counts, name):
    """A pipe along z."""
    angle, z = np.meshgrid(
        np.linspace(0, 2 * np.pi, counts[0], endpoint=False), np.linspace(0, height, counts[1] + 1), indexing="ij"
    )
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1).reshape(-1, 3)
    return shell(points + centre, triangles_of(np.arange(z.size).reshape(z.shape), around=True), name)


def joined(*plates, name):
    """Several shells as one; nodes at one place are one."""
    points = np.concatenate([p.points for p in plates])
    starts = np.cumsum([0] + [p.node_count for p in plates])
    triangles = np.concatenate([p.cells["triangle"] + s for p, s in zip(plates, starts)])
    _, first, place = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    return shell(points[first], place.reshape(-1)[triangles], name)


def solid(points, tetrahedra, name):
    turned = tetra_volumes(points, tetrahedra) < 0
    tetrahedra = np.where(turned[:, None], tetrahedra[:, [0, 2, 1, 3]], tetrahedra)
    return fs.Mesh(points, {"tetra": tetrahedra}, groups={name: ("element", np.arange(1, len(tetrahedra) + 1))})


def block(origin, size, counts, name, turn=np.eye(3)):
    box = grid_box(counts, (1.0, 1.0, 1.0))
    points = (box.points - [0.5, 0.5, 0]) * size
    return solid(points @ np.asarray(turn).T + origin, box.cells["tetra"], name)


def disk(rings):
    """Points and triangles of a round disk of radius 1: a centre, and 6, 12, ... nodes in rings."""
    points, triangles, start = [(0.0, 0.0)], [], [0]
    for k in range(1, rings + 1):
        start.append(len(points))
        points += [(k / rings * np.cos(a), k / rings * np.sin(a)) for a in np.arange(6 * k) * np.pi / (3 * k)]
    for k in range(1, rings + 1):
        for side in range(6):
            outer = lambda i, s=side, k=k: start[k] + (s * k + i) % (6 * k)  # noqa: E731
            inner = lambda i, s=side, k=k: start[k - 1] + (s * (k - 1) + i) % max(6 * (k - 1), 1)  # noqa: E731
            triangles += [(inner(i), outer(i), outer(i + 1)) for i in range(k)]
            triangles += [(inner(i), outer(i + 1), inner(i + 1)) for i in range(k - 1)]
    return np.array(points), np.array(triangles)


def rod(origin, radius, height, counts, name, turn=np.eye(3)):
    """A round rod: disks of `counts[0]` rings, `counts[1]` layers high, each prism cut into three."""
    flat, triangles = disk(counts[0])
    z = np.linspace(0, height, counts[1] + 1)
    points = np.concatenate([np.column_stack([radius * flat, np.full(len(flat), h)]) for h in z])
    tetrahedra = []
    for layer in range(counts[1]):
        for t in np.sort(triangles, axis=1):
            a, b, c = t + layer * len(flat)
            d, e, f = t + (layer + 1) * len(flat)
            tetrahedra += [(a, b, c, f), (a, b, e, f), (a, d, e, f)]
    return solid(points @ np.asarray(turn).T + origin, np.array(tetrahedra), name)


def tube(origin, inner, outer, height, counts, name, first=0.0, angle=2 * np.pi):
    """A thick tube along z: `counts` elements around, across and along; or that part of it, from an angle on."""
    around, across, along = counts
    box = grid_box((around, across, along), (angle, outer - inner, height))
    turn, radius = first + box.points[:, 0], inner + box.points[:, 1]
    points = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), box.points[:, 2]])
    _, kept, place = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    return solid(points[kept] + origin, place.reshape(-1)[box.cells["tetra"]], name)


def corners(mesh):
    """Corners of the elements of the mesh's dimension, by type."""
    kinds = {2: {"triangle": 3, "quad": 4}, 3: {"tetra": 4, "pyramid": 5, "wedge": 6, "hexahedron": 8}}[mesh.dimension]
    names = [(name, kinds.get(name.rstrip("0123456789"), 0)) for name in mesh.cells]
    return [np.asarray(mesh.cells[name])[:, :count] for name, count in names if count]


def areas(mesh):
    points = mesh.points[np.concatenate([c[:, :3] for n, c in mesh.cells.items() if n.startswith("triangle")])]
    return np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1) / 2


def worst(mesh):
    kind = {2: "triangle", 3: "tetra"}[mesh.dimension]
    return min(q.min() for name, q in fs.mean_ratio(mesh).items() if name.startswith(kind))


def number_of_parts(mesh):
    elements = corners(mesh)
    parent = np.arange(mesh.node_count)
    while True:
        new = parent.copy()
        for e in elements:
            np.minimum.at(new, e.reshape(-1), np.repeat(new[e].min(axis=1), e.shape[1]))
        if (new == parent).all():
            return len(np.unique(parent[np.unique(np.concatenate([e.reshape(-1) for e in elements]))]))
        parent = new


def check_conforming(mesh):
    """One part, no node twice; of solids a skin that is closed, and on which no faces lie on each other."""
    elements = corners(mesh)
    assert number_of_parts(mesh) == 1
    used = mesh.points[np.unique(np.concatenate([e.reshape(-1) for e in elements]))]
    size = np.ptp(used, axis=0).max()
    assert len(np.unique(np.round(used / (1e-9 * size)), axis=0)) == len(used), "nodes twice"
    assert worst_of(mesh) > 0, "a volume that is not positive"
    if mesh.dimension == 3:
        skin = outer_faces(mesh)
        triangles = {face for face in skin if len(face) == 3}
        assert not any(set(itertools.combinations(face, 3)) & triangles for face in skin if len(face) == 4), "no match"
        edges = collections.Counter(edge for ring in skin.values() for edge in edges_of(ring))
        assert all(count % 2 == 0 for count in edges.values()), "a skin that is open"


def edges_of(ring):
    return [tuple(sorted(pair)) for pair in zip(ring, [*ring[1:], ring[0]])]


def check_untouched(before, after, far):
    """Nodes of `before` where `far(points)` holds, and elements with no other, are in `after` bit for bit."""
    place = {number: k for k, number in enumerate(after.node_ids)}
    away = far(before.points)
    for k in np.flatnonzero(away):
        assert (after.points[place[before.node_ids[k]]] == before.points[k]).all()
    for kind, cells in before.cells.items():
        rows = {number: k for k, number in enumerate(after.cell_ids[kind])}
        for cell, number in zip(cells, before.cell_ids[kind]):
            if away[cell].all():
                now = after.cells[kind][rows[number]]
                assert (after.node_ids[now] == before.node_ids[cell]).all()
