# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box, tetra_volumes


def wall(result, group):
    triangles, ids = result.mesh.cells["triangle"], result.mesh.cell_ids["triangle"]
    return result.mesh.points[triangles[np.isin(ids, result.mesh.groups[group].ids)]]


def area(corners):
    return np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2


def volume(result):
    volumes = tetra_volumes(result.mesh.points, result.mesh.cells["tetra"])
    assert volumes.min() > 0
    return volumes.sum()


@pytest.mark.parametrize("width", [0.15, 0.6, 1.7])
def test_slot_between_parallel_planes(width):
    mesh = box_with_groups()
    plane = fs.Plane((3.1, 2.5, 2), (0.9, 0.3, 0))
    result = fs.cut(mesh, plane, width=width)
    across = 1 / plane.normal[0]
    assert 120 - volume(result) == pytest.approx(width * 5 * 4 * across, rel=1e-9)
    for group, side in (("CUT_P", 1), ("CUT_N", -1)):
        corners = wall(result, group)
        np.testing.assert_allclose(plane.distance(corners.reshape(-1, 3)), side * width / 2, atol=1e-9)
        assert area(corners) == pytest.approx(5 * 4 * across, rel=1e-9)
    assert set(mesh.groups) <= set(result.mesh.groups)
    assert set(result.report.node_sets) == {"ICN", "ECN", "ITN", "ETN"} and result.report.operation == "cut"


def test_saw_cut_stops_inside():
    mesh = grid_box((9, 8, 7), (6, 5, 4))
    result = fs.cut(
        mesh, fs.Plane((3.1, 0, 0), (1, 0, 0)), width=0.5, bottom=fs.Plane((0, 0, 1.6), (0, 0, -1)), name="SAW"
    )
    assert 120 - volume(result) == pytest.approx(0.5 * 5 * 2.4, rel=1e-9)
    assert area(wall(result, "SAW_BOTTOM")) == pytest.approx(0.5 * 5, rel=1e-9)
    np.testing.assert_allclose(wall(result, "SAW_BOTTOM")[..., 2], 1.6, atol=1e-9)


def test_notch_between_planes_that_meet():
    mesh = grid_box((9, 8, 7), (6, 5, 4))
    sides = fs.Plane((3.1, 0, 2), (2, 0, -1)), fs.Plane((3.1, 0, 2), (-2, 0, -1))
    result = fs.cut(mesh, sides[0], other=sides[1])
    assert 120 - volume(result) == pytest.approx(2 * 1 * 5, rel=1e-9)
    for group, plane in zip(("CUT_P", "CUT_N"), sides):
        assert np.abs(plane.distance(wall(result, group).reshape(-1, 3))).max() < 1e-9


def test_session_gives_the_same():
    mesh, plane = box_with_groups(), fs.Plane((3.1, 2.5, 2), (1, 0.2, 0))
    a, b = fs.Scalpel(mesh).cut(plane, width=0.5).mesh, fs.cut(mesh, plane, width=0.5).mesh
    assert a.points.tobytes() == b.points.tobytes() and a.cells["tetra"].tobytes() == b.cells["tetra"].tobytes()


PLANE = fs.Plane((3.1, 0, 0), (1, 0, 0))


@pytest.mark.parametrize(
    "kwargs, error, message",
    [
        ({}, ValueError, "give either width or other"),
        ({"width": 1, "other": PLANE}, ValueError, "other must not be given with width"),
        ({"width": 0}, fs.ToolError, "width is 0; it must be positive"),
        ({"width": -1}, fs.ToolError, "width is -1"),
        ({"width": "1"}, TypeError, "width must be a number"),
        ({"width": 1, "tool": fs.Cylinder((0, 0, 0), (0, 0, 1), 1)}, TypeError, "must be a femscalpel.Plane"),
        ({"width": 1, "bottom": 3}, TypeError, "bottom must be a tool"),
        ({"width": 1, "tool": fs.Plane((50, 0, 0), (1, 0, 0))}, fs.ToolError, "misses"),
        ({"width": 20}, fs.ToolError, "the plane would remove the whole mesh: all of it lies inside"),
        ({"width": 1, "method": "deform"}, fs.ToolError, "single surface"),
    ],
)
def test_bad_arguments(kwargs, error, message):
    with pytest.raises(error, match=message):
        fs.cut(**{"mesh": box_with_groups(), "tool": PLANE, **kwargs})


def test_a_slot_over_the_end_takes_the_end():
    mesh = box_with_groups()
    result = fs.cut(mesh, fs.Plane((6, 0, 0), (1, 0, 0)), width=1)
    volume = {g.name: g.measure_after for g in result.report.groups}
    assert volume["RIGHT"] == pytest.approx(50, rel=1e-12) and volume["LEFT"] == pytest.approx(60, rel=1e-12)
    assert any("the wall P (plane) lies beyond the part" in w for w in result.report.warnings)
    assert "CUT_N" in result.mesh.groups
