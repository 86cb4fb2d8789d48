# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moving single nodes of a femscalpel.Mesh without spoiling elements."""

import numpy as np

import femscalpel

from .mesh_parts import MID_SIDES, TETRAS, TRIANGLES

_POOR = 0.3  # mean ratio below which an element must not lose half of its own


def carry_mid_sides(mesh, points, changed, free):
    """`free` mid-side nodes that have not been put anywhere themselves go half the way with their corners.

    Returns their indices.
    """
    before = changed.copy()
    for name, edges in MID_SIDES.items():
        nodes = mesh.cells.get(name)
        if nodes is None:
            continue
        nodes = nodes[changed[nodes].any(axis=1)]
        shift = points - mesh.points
        for middle, (i, j) in enumerate(edges, start=nodes.shape[1] - len(edges)):
            moving = free[nodes[:, middle]] & ~before[nodes[:, middle]] & (changed[nodes[:, i]] | changed[nodes[:, j]])
            middles = nodes[moving, middle]
            points[middles] = mesh.points[middles] + (shift[nodes[moving, i]] + shift[nodes[moving, j]]) / 2
    changed |= (points != mesh.points).any(axis=1)
    return np.flatnonzero(changed & ~before)


def spoilt_by(mesh, points, changed):
    """Indices of changed nodes to put back: of each element that is inverted or much worse at `points` than at
    mesh.points, the one that moved most."""
    shift = np.linalg.norm(points - mesh.points, axis=1)
    spoilt = []
    for name in TETRAS + TRIANGLES:
        if name not in mesh.cells:
            continue
        nodes = mesh.cells[name]
        nodes = nodes[changed[nodes].any(axis=1)]
        before, after = (_quality(name, p[nodes]) for p in (mesh.points, points))
        bad = nodes[(after < 0.5 * before) & (after < _POOR)]
        spoilt.append(bad[np.arange(len(bad)), shift[bad].argmax(axis=1)])
    return np.unique(np.concatenate(spoilt)) if spoilt else np.empty(0, np.int64)


def _quality(name, points):
    """Mean ratio of the corners of elements, shape (m, k, 3); 0 for quadratic ones inverted at an integration point."""
    corners = points[:, : 4 if name in TETRAS else 3]
    ids = np.arange(corners.shape[0] * corners.shape[1]).reshape(corners.shape[:2])
    linear = femscalpel.Mesh(corners.reshape(-1, 3), {"tetra" if name in TETRAS else "triangle": ids})
    (quality,) = femscalpel.mean_ratio(linear).values() if len(ids) else (np.empty(0),)
    if name == "tetra10" and len(ids):
        quality = np.where(_jacobians(points).min(axis=1) > 0, quality, 0)
    return quality


def _jacobians(points):
    """Determinants at the four integration points of quadratic tetrahedra, shape (m, 4)."""
    result = []
    for b in 0.1381966011250105 + 0.4472135954999579 * np.eye(4):
        gradient = np.zeros((10, 4))  # of the shape functions, by barycentric coordinate
        gradient[:4] = np.diag(4 * b - 1)
        for k, (i, j) in enumerate(MID_SIDES["tetra10"]):
            gradient[4 + k, i], gradient[4 + k, j] = 4 * b[j], 4 * b[i]
        by_corner = np.einsum("nc,mnx->mcx", gradient, points)
        result.append(np.linalg.det(by_corner[:, 1:] - by_corner[:, :1]))
    return np.array(result).T
