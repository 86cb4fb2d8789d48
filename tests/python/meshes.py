# SPDX-License-Identifier: LGPL-2.1-or-later
"""Small meshes for the tests."""

import itertools

import numpy as np

import femscalpel as fs


def grid_box(counts=(6, 5, 4), size=(6.0, 5.0, 4.0), **kwargs):
    """A box of tetrahedra: a grid of bricks, each cut into six around its diagonal."""
    nx, ny, nz = counts
    axes = [np.linspace(0, s, n + 1) for s, n in zip(size, counts)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    index = np.arange((nx + 1) * (ny + 1) * (nz + 1)).reshape(nx + 1, ny + 1, nz + 1)
    tetrahedra = []
    for order in itertools.permutations(range(3)):
        corner, path = np.zeros(3, int), [(0, 0, 0)]
        for axis in order:
            corner[axis] = 1
            path.append(tuple(corner))
        nodes = np.stack([index[a : nx + a, b : ny + b, c : nz + c].ravel() for a, b, c in path], axis=1)
        odd = np.linalg.det(np.eye(3)[list(order)]) < 0
        tetrahedra.append(nodes[:, [0, 2, 1, 3]] if odd else nodes)
    return fs.Mesh(points, {"tetra": np.concatenate(tetrahedra)}, **kwargs)


def quadratic(mesh):
    """The same tetrahedra with mid-side nodes, groups left out."""
    edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
    cells, points = mesh.cells["tetra"], mesh.points
    pairs = np.sort(np.stack([cells[:, list(e)] for e in edges], axis=1), axis=2)
    unique, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    nodes = np.concatenate([cells, len(points) + inverse.reshape(-1, 6)], axis=1)
    return fs.Mesh(np.concatenate([points, points[unique].mean(axis=1)]), {"tetra10": nodes})


def tetra_volumes(points, cells):
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def box_with_groups():
    """grid_box() with volume, node and overlapping groups, and sparse numbers."""
    plain = grid_box()
    node_ids = 10 * np.arange(1, plain.node_count + 1) + 7
    cell_ids = 3 * np.arange(1, plain.cell_count + 1) + 100
    centres = plain.points[plain.cells["tetra"]].mean(axis=1)
    points = plain.points
    groups = {
        "LEFT": ("element", cell_ids[centres[:, 0] < 3]),
        "RIGHT": ("element", cell_ids[centres[:, 0] > 3]),
        "ALL": ("element", cell_ids),
        "FIX": ("node", node_ids[points[:, 2] == 0]),
        "TOP": ("node", node_ids[points[:, 2] == 4]),
        "EMPTY": ("node", []),
    }
    return fs.Mesh(points, plain.cells, node_ids, {"tetra": cell_ids}, groups, name="box")
