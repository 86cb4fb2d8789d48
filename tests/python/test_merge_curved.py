# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lid on the end of a curved pipe of second order: its seam is, or is beside, the rims of the pipe."""

import numpy as np
import pytest

import femscalpel as fs
from merge_cases import MESHES
from merge_parts import check_conforming, rod

PAIRS = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
OUT_OF_THE_INLET = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])


def jacobians(mesh):
    """Determinants at the four integration points of second-order tetrahedra, and of the straight ones."""
    x = mesh.points[mesh.cells["tetra10"]]
    out = []
    for corner in range(4):
        at = np.where(np.arange(4) == corner, 0.585410196624969, 0.138196601125011)
        slope = np.zeros((10, 4))
        slope[np.arange(4), np.arange(4)] = 4 * at - 1
        for k, (a, b) in enumerate(PAIRS):
            slope[4 + k, a], slope[4 + k, b] = 4 * at[b], 4 * at[a]
        out.append(np.linalg.det(np.einsum("kd,ekx->edx", slope[:, 1:] - slope[:, :1], x)))
    return np.array(out), np.linalg.det(x[:, 1:4] - x[:, :1])


def at_inlet(mesh):
    """Distances of nodes from the pipe's middle, and whether they are in the plane of its inlet."""
    return np.linalg.norm(mesh.points[:, [0, 2]] - [8, 0], axis=1), np.abs(mesh.points[:, 1] + 4) < 1e-9


@pytest.mark.parametrize("radius, rings", [(2.75, 3), (4.2, 4), (5, 5)])
def test_a_lid_on_a_pipe(radius, rings):
    mesh = fs.read(MESHES / "quadratic_elbow.inp")
    result = fs.merge(mesh, rod((8, -4, 0), radius, 1.5, (rings, 2), "LID", OUT_OF_THE_INLET), name="LID")
    check_conforming(result.mesh)
    curved, straight = jacobians(result.mesh)
    assert (curved > 0.1 * straight).all() and (straight > 0).all()
    assert not result.report.poor and result.report.straightened.count == 0
    records = {g.name: g for g in result.report.groups}
    for name in ("BEND", "STRAIGHT", "INLET", "OUTLET", "BORE"):
        assert records[name].measure_after == pytest.approx(records[name].measure_before, rel=3e-5), name
    # The rims stay round: mid-side nodes of their edges, and of parts of these, are on the circles.
    edges = result.mesh.cells["tetra10"]
    (before, there), (far, here) = at_inlet(mesh), at_inlet(result.mesh)
    for circle in (2, 3.5):
        rim = here & (np.abs(far - circle) < 1e-3)
        assert rim.sum() >= (there & (np.abs(before - circle) < 1e-3)).sum() > 20
        for k, (a, b) in enumerate(PAIRS):
            assert rim[edges[rim[edges[:, a]] & rim[edges[:, b]], 4 + k]].all()
