# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curved solids of second order that meet at the rim of one of them."""

import numpy as np
import pytest

import femscalpel as fs
from merge_parts import check_conforming, rod, tube
from meshes import quadratic

PAIRS = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def bent(mesh, radii):
    """In second order, with mid-side nodes on cylinders about the z axis where both ends of their edge are."""
    out = quadratic(mesh)
    points, cells = out.points.copy(), out.cells["tetra10"]
    far = np.linalg.norm(points[:, :2], axis=1)
    for k, (a, b) in enumerate(PAIRS):
        for radius in radii:
            on = (np.abs(far[cells[:, [a, b]]] - radius) < 1e-9).all(axis=1)
            middles = np.unique(cells[on, 4 + k])
            points[middles, :2] *= radius / np.linalg.norm(points[middles, :2], axis=1)[:, None]
    return fs.Mesh(points, {"tetra10": cells}, groups={"PART": ("element", np.arange(1, len(cells) + 1))})


def least_jacobian(mesh):
    """At the integration points of second-order tetrahedra, over that of straight ones."""
    x = mesh.points[mesh.cells["tetra10"]]
    straight = np.linalg.det(x[:, 1:4] - x[:, :1])
    out = np.full(len(x), np.inf)
    for corner in range(4):
        at = np.where(np.arange(4) == corner, 0.585410196624969, 0.138196601125011)
        slope = np.zeros((10, 4))
        slope[np.arange(4), np.arange(4)] = 4 * at - 1
        for k, (a, b) in enumerate(PAIRS):
            slope[4 + k, a], slope[4 + k, b] = 4 * at[b], 4 * at[a]
        out = np.minimum(out, np.linalg.det(np.einsum("kd,ekx->edx", slope[:, 1:] - slope[:, :1], x)) / straight)
    return out.min()


def pipe(around=20):
    return bent(tube((0, 0, 0), 7, 10, 16, (around, 2, 8), "PIPE"), (7, 10))


@pytest.mark.parametrize("around", [14, 20])
@pytest.mark.parametrize("radius", [8.5, 13])
def test_a_lid_on_the_end_of_a_pipe(radius, around):
    mesh, lid = pipe(around), bent(rod((0, 0, 16), radius, 4, (5, 2), "LID"), (radius,))
    result = fs.merge(mesh, lid, name="LID")
    check_conforming(result.mesh)
    assert least_jacobian(result.mesh) > 0.1
    assert not result.report.poor
    # The rim of the bore is the seam, or beside it, and stays round.
    edges = result.mesh.cells["tetra10"]
    far = np.linalg.norm(result.mesh.points[:, :2], axis=1)
    rim = (np.abs(far - 7) < 1e-9) & (np.abs(result.mesh.points[:, 2] - 16) < 1e-9)
    before = (np.abs(np.linalg.norm(mesh.points[:, :2], axis=1) - 7) < 1e-9) & (mesh.points[:, 2] == 16)
    assert rim.sum() >= before.sum()
    for k, (a, b) in enumerate(PAIRS):
        both = rim[edges[:, a]] & rim[edges[:, b]]
        assert np.abs(far[edges[both, 4 + k]] - 7).max(initial=0) < 1e-9
