# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curved pieces of second order: a lid on the end of a pipe, whose seam is, or is beside, the rims of that; and round
bosses on a flat face, whose rims are theirs."""

import numpy as np
import pytest

import femscalpel as fs
from merge_cases import MESHES
from merge_parts import check_conforming, rod
from meshes import grid_box, quadratic

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


def round_rod(origin, radius, height, counts):
    """A rod of second order whose side is round."""
    straight = quadratic(rod(origin, radius, height, counts, "ROD"))
    points, cells = straight.points.copy(), np.asarray(straight.cells["tetra10"])
    off = np.linalg.norm(points[:, :2] - origin[:2], axis=1)
    side = np.zeros(len(points), bool)
    for k, (a, b) in enumerate(PAIRS):
        side[cells[(np.abs(off[cells[:, [a, b]]] - radius) < 1e-9).all(axis=1), 4 + k]] = True
    points[side, :2] = origin[:2] + (points[side, :2] - origin[:2]) * (radius / off[side])[:, None]
    return fs.Mesh(points, {"tetra10": cells}, groups={"ROD": ("element", straight.cell_ids["tetra10"])})


def volume(mesh):
    return fs.measure(mesh)["tetra10"].sum()


@pytest.mark.parametrize("keep", ["mesh", "addition"])
@pytest.mark.parametrize("deep", [0, 0.88])
@pytest.mark.parametrize("radius, rings", [(2.17, 3), (2.69, 4)])
def test_a_round_boss_on_a_flat_face_stays_round(radius, rings, deep, keep):
    """Along its rim, or where its side comes out of the face, mid-side nodes of both are on its circle."""
    base = quadratic(grid_box((8, 8, 4), (10.0, 10.0, 4.0)))
    base = fs.Mesh(base.points, base.cells, groups={"BASE": ("element", base.cell_ids["tetra10"])})
    boss = round_rod(np.array([5.1, 4.9, 4 - deep]), radius, 2 + deep, (rings, 4))
    result = fs.merge(base, boss, keep=keep)
    check_conforming(result.mesh)
    curved, straight = jacobians(result.mesh)
    assert (curved > 0.15 * straight).all()
    above = volume(boss) * 2 / (2 + deep)
    told = result.report.straightened
    assert volume(result.mesh) == pytest.approx(400 + above, abs=(2e-5 if told.count == 0 else 3e-4) * above)
    assert told.count <= 2 and any("own curved skin" in w for w in result.report.warnings) == (told.count > 0)
    if keep == "mesh":
        record = next(g for g in result.report.groups if g.name == "BASE")
        assert record.measure_after == pytest.approx(400, rel=1e-12)


def test_a_rim_that_has_no_room_for_its_curve_is_told():
    """Its edges are so long that some would fold the base's elements beside them."""
    base = quadratic(grid_box((8, 8, 4), (10.0, 10.0, 4.0)))
    result = fs.merge(base, round_rod(np.array([5.1, 4.9, 4]), 1.5, 2, (2, 3)))
    check_conforming(result.mesh)
    told = result.report.straightened
    assert told.count > 0 and told.largest == pytest.approx(1.5 * (1 - np.cos(np.pi / 12)), rel=1e-3)
    words = f"the addition: along the seam its own curved skin is left by up to {told.largest:.6g} ({told.count} edges)"
    assert any(w.startswith(words) for w in result.report.warnings)


@pytest.mark.parametrize("seed", [0, 1, 10, 14, 24, 32, 34])
def test_nothing_is_folded_beside_curved_walls(seed):
    """What is filled in beside a round bore is straight; edges inside that were curved would fold it."""
    rng = np.random.default_rng(seed)
    rng.integers(4, 8)
    radius = rng.uniform(0.7, 2)
    counts = (int(rng.integers(2, 4)), int(rng.integers(3, 6)))
    shaft = round_rod(np.array([0, 0, -3.0]), 2 * radius, 3, counts)
    tube = fs.drill(shaft, fs.Cylinder((0, 0, 0), (0, 0, 1), 0.9 * radius), refine=False).mesh
    angle = rng.uniform(0, 6.28)
    deep = rng.choice([0.0, rng.uniform(0.3, 0.9)])
    at = np.array([1.5 * radius * np.cos(angle), 1.5 * radius * np.sin(angle), -deep])
    boss = rod(at, rng.uniform(0.2, 0.55) * radius, 1 + deep, (int(rng.integers(1, 4)), 3), "BOSS")
    result = fs.merge(tube, boss, keep=("mesh", "addition")[int(rng.integers(2))])
    check_conforming(result.mesh)
    curved, straight = jacobians(result.mesh)
    assert (curved > 0.02 * straight).all()
