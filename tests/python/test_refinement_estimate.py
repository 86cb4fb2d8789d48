# SPDX-License-Identifier: LGPL-2.1-or-later
"""What refining comes to, told before it is done; and that nothing is refined but what it is for."""

import math

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic

MIDDLE = (3.0, 2.5, 2.0)


class Stop(Exception):
    pass


def told_by(operate):
    """(estimates as (size, before, after), the result)."""
    estimates = []
    result = operate(lambda e: estimates.append((e.size, e.elements_before, e.elements_after, e.is_more)))
    return estimates, result


@pytest.mark.parametrize("mesh", [grid_box(), quadratic(grid_box()), grid_box((24, 20, 16))], ids=["6", "tet10", "24"])
@pytest.mark.parametrize("size", [0.35, 0.12])
def test_near_what_is_made(mesh, size):
    ((given, before, after, is_more),), result = told_by(
        lambda told: fs.refine(mesh, fs.Sphere(MIDDLE, 1.3), size, before_refining=told)
    )
    assert given == size and before == mesh.cell_count and not is_more
    assert before < after and after == pytest.approx(result.mesh.cell_count, rel=0.3)


def test_shells():
    box = grid_box((12, 10, 1), (6.0, 5.0, 0.1))
    points = box.points[:, :]
    faces = [(0, 1, 2)]
    mesh = fs.Mesh(points[[0, 30, 90]], {"triangle": faces})
    ((_, _, after, _),), result = told_by(lambda told: fs.refine(mesh, points[0], 0.05, before_refining=told))
    assert after == pytest.approx(result.mesh.cell_count, rel=0.3) and after > 50


@pytest.mark.parametrize(
    "operate",
    [
        lambda m, told: fs.crack(m, fs.Plane(MIDDLE, (1, 0.1, 0)), within=fs.Disk(MIDDLE, 0.4), before_refining=told),
        lambda m, told: fs.crack(m, fs.Plane(MIDDLE, (1, 0.1, 0)), refine=0.3, before_refining=told),
        lambda m, told: fs.drill(m, fs.Cylinder(MIDDLE, (0, 0, 1), 0.4), before_refining=told),
        lambda m, told: fs.Scalpel(m).drill(fs.Cylinder(MIDDLE, (0, 0, 1), 0.4), before_refining=told),
    ],
    ids=["disk", "size", "hole", "session"],
)
def test_operators_tell(operate):
    mesh = grid_box()
    (estimate,), result = told_by(lambda told: operate(mesh, told))
    done = result.report.refinement
    assert estimate[0] == done.size and estimate[1] == done.elements_before
    assert estimate[2] - done.elements_before > 0.4 * (done.elements_after - done.elements_before)
    assert estimate[2] < 1.4 * done.elements_after

    def stop(_):
        raise Stop

    with pytest.raises(Stop):
        operate(mesh, stop)


def test_nothing_to_tell():
    estimates, _ = told_by(lambda told: fs.crack(grid_box(), fs.Plane(MIDDLE, (1, 0.1, 0)), before_refining=told))
    assert estimates == []


def test_size_that_fits():
    mesh, kept, sizes = grid_box(), [], {}

    def told(estimate):
        kept.append(estimate)
        for limit in (2000, 20_000):
            sizes[limit] = estimate.size_for(limit)
        assert estimate.size_for(10) == math.inf  # the mesh alone has more
        raise Stop

    with pytest.raises(Stop):
        fs.refine(mesh, fs.Sphere(MIDDLE, 1.3), 0.02, before_refining=told)
    assert 0.02 < sizes[20_000] < sizes[2000]
    for limit, size in sizes.items():
        count = fs.refine(mesh, fs.Sphere(MIDDLE, 1.3), size).mesh.cell_count
        assert 0.5 * limit < count < 1.25 * limit
        assert float(f"{size:.2g}") == pytest.approx(size, rel=1e-12)
    with pytest.raises(RuntimeError, match="before it is"):
        kept[0].size_for(2000)


def test_far_too_fine_is_told_at_once_and_refused():
    estimates = []

    def operate(size):
        estimates.clear()
        with pytest.raises(fs.ToolError, match="more than 5000000 elements") as caught:
            fs.refine(
                grid_box(),
                fs.Plane(MIDDLE, (1, 0, 0)),
                size,
                before_refining=lambda e: estimates.append((e.elements_after, e.is_more)),
            )
        assert caught.value.parameter == "size"

    operate(1e-5)
    assert estimates[0][0] >= 10_000_000 and estimates[0][1]


def test_only_a_callable():
    with pytest.raises(TypeError, match="before_refining must be callable") as caught:
        fs.crack(grid_box(), fs.Plane(MIDDLE, (1, 0, 0)), before_refining=5)
    assert caught.value.parameter == "before_refining"


def test_what_is_behind_a_disk_stays():
    """The distance from a disk changes its sign at the border of the column behind it, which is no surface."""
    mesh = grid_box((18, 15, 12))
    centre, radius = np.array((3.1, 2.4, 2.2)), 0.05
    result = fs.crack(mesh, fs.Plane(centre, (1, 0.1, 0.05)), within=fs.Disk(centre, radius))
    new = result.mesh.points[~np.isin(result.mesh.node_ids, mesh.node_ids)]
    assert len(new) > 20
    # Edges may grow by the distance, so that those of 1/3 and their diagonals stay from there on; and some that follow.
    assert np.linalg.norm(new - centre, axis=1).max() < 2.0
    assert result.report.refinement.elements_after < 1.5 * mesh.cell_count
