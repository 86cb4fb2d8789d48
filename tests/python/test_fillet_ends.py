# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges that end at something else than a plane face through which their rounding runs out."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic
from test_fillet import RIGHT_ANGLE, check_conforming, face_points, l_shape, quality, volume
from test_fillet_groups import grouped, shares


def part_of_box(where, counts=(8, 8, 8)):
    """Unit cubes of a grid whose middles are at a place."""
    box = grid_box(counts, tuple(float(c) for c in counts))
    centres = box.points[box.cells["tetra"]].mean(axis=1)
    kept = box.cells["tetra"][where(*centres.T)]
    used, nodes = np.unique(kept, return_inverse=True)
    return fs.Mesh(box.points[used], {"tetra": nodes.reshape(-1, 4)})


def room():
    """A block without one of its octants: three walls."""
    return part_of_box(lambda x, y, z: (x < 4) | (y < 4) | (z < 4))


@pytest.mark.parametrize("radius", [0.6, 1.5, 2.5])
def test_concave_into_a_wall(radius):
    mesh = room()
    result = fs.fillet(mesh, [(4, 4, 6)], radius)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 0] - 4 - radius, points[:, 1] - 4 - radius) - radius).max() < 1e-8
    assert points[:, 2].min() == pytest.approx(4) and points[:, 2].max() == pytest.approx(8)
    assert volume(result.mesh) - volume(mesh) == pytest.approx(RIGHT_ANGLE * radius**2 * 4, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    assert "FILLET_END" not in result.mesh.groups
    check_conforming(result.mesh)


def test_the_wall_may_be_in_another_group():
    groups = {"FLOOR": lambda x, y, z: z < 4, "WALLS": lambda x, y, z: z > 4}
    mesh = grouped(room(), groups)
    result = fs.fillet(mesh, [(4, 4, 6)], 1.5)
    floor, walls = shares(mesh, result, groups)
    assert floor == pytest.approx(0, abs=1e-9) and walls == pytest.approx(RIGHT_ANGLE * 1.5**2 * 4, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)
    groups = {
        "FLOOR": lambda x, y, z: z < 4,
        "ONE": lambda x, y, z: (z > 4) & (x < 4),
        "OTHER": lambda x, y, z: (z > 4) & (x > 4),
    }
    mesh = grouped(room(), groups)
    result = fs.fillet(mesh, [(4, 4, 6)], 1.5)
    floor, one, other = shares(mesh, result, groups)
    assert floor == pytest.approx(0, abs=1e-9) and one == pytest.approx(other, rel=1e-6)
    check_conforming(result.mesh)


def end_of(result, axis, at):
    faces = result.mesh.cells["triangle"][
        np.isin(result.mesh.cell_ids["triangle"], result.mesh.groups["FILLET_END"].ids)
    ]
    points = result.mesh.points[faces]
    assert np.abs(points[..., axis] - at).max() < 1e-8
    return np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1).sum() / 2


def area_of_chords(points, centre, radius):
    """Of what is between a right angle and the chords at which a rounding about `centre` ends, which are equal, six or
    more: how many there are depends on where good elements are found, and that on the last digit."""
    x, y = (points - centre).T
    angles = np.unique(np.arccos(np.clip(x / np.hypot(x, y), -1, 1)).round(6))
    steps = np.diff(angles)
    assert len(steps) >= 6 and np.abs(steps - np.pi / 2 / len(steps)).max() < 1e-5
    return radius**2 * (1 - len(steps) / 2 * np.sin(np.pi / 2 / len(steps)))


@pytest.mark.parametrize("radius", [0.6, 1.5, 2.5])
def test_convex_edge_that_ends_at_a_wall(radius):
    """The upper edge of a foot below a wall: the wall goes on down to the arc."""
    mesh = l_shape()
    result = fs.fillet(mesh, [(6, 4, 0)], radius)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 1] - 4 + radius, points[:, 2] - radius) - radius).max() < 1e-8
    assert points[:, 0].min() == pytest.approx(4) and points[:, 0].max() == pytest.approx(8)
    area = area_of_chords(points[points[:, 0] < 4 + 1e-9, 1:], (4 - radius, radius), radius)
    assert volume(mesh) - volume(result.mesh) == pytest.approx(area * 4, rel=1e-9)
    assert end_of(result, 0, 4) == pytest.approx(area, rel=1e-9)
    assert any("it stops at (4 4 0)" in w for w in result.report.warnings)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_convex_edge_that_ends_at_a_wall_of_another_group():
    groups = {"FOOT": lambda x, y, z: x > 4, "WALL": lambda x, y, z: x < 4}
    mesh = grouped(l_shape(), groups)
    result = fs.fillet(mesh, [(6, 4, 0)], 1.5)
    foot, wall = shares(mesh, result, groups)
    points = face_points(result.mesh)
    area = area_of_chords(points[points[:, 0] < 4 + 1e-9, 1:], (2.5, 1.5), 1.5)
    assert wall == pytest.approx(0, abs=1e-9) and foot == pytest.approx(-area * 4, rel=1e-9)
    assert end_of(result, 0, 4) == pytest.approx(area, rel=1e-9)
    check_conforming(result.mesh)


@pytest.mark.parametrize("radius", [0.6, 1.5, 2.5])
def test_toe_of_a_stiffener_that_ends_on_its_plate(radius):
    mesh = part_of_box(lambda x, y, z: (z < 3) | ((y < 4) & (x > 2)))
    result = fs.fillet(mesh, [(5, 4, 3)], radius)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 1] - 4 - radius, points[:, 2] - 3 - radius) - radius).max() < 1e-8
    assert volume(result.mesh) - volume(mesh) == pytest.approx(RIGHT_ANGLE * radius**2 * 6, rel=0.03)
    assert end_of(result, 0, 2) == pytest.approx(RIGHT_ANGLE * radius**2, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_that_of_another_group():
    groups = {"PLATE": lambda x, y, z: z < 3, "RIB": lambda x, y, z: z > 3}
    mesh = grouped(part_of_box(lambda x, y, z: (z < 3) | ((y < 4) & (x > 2))), groups)
    result = fs.fillet(mesh, [(5, 4, 3)], 1.5)
    plate, rib = shares(mesh, result, groups)
    assert plate == pytest.approx(rib, rel=1e-6) and plate + rib == pytest.approx(RIGHT_ANGLE * 1.5**2 * 6, rel=0.03)
    check_conforming(result.mesh)


def test_second_order():
    mesh = quadratic(l_shape())
    result = fs.fillet(mesh, [(6, 4, 0)], 1.5)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 1] - 4 + 1.5, points[:, 2] - 1.5) - 1.5).max() < 1e-8
    assert quality(result.mesh).min() >= 0.15
    mesh = quadratic(room())
    result = fs.fillet(mesh, [(4, 4, 6)], 1.5)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 0] - 5.5, points[:, 1] - 5.5) - 1.5).max() < 1e-8


def test_where_the_face_narrows_it_stops_before():
    """A bevelled end: the upper face ends before the edge does."""
    plain = grid_box((10, 5, 5), (10.0, 5.0, 5.0))
    x, y, z = plain.points.T
    # Slants and twists the end face x = 10: the face z = 0 is shorter away from the edge.
    moved = plain.points.copy()
    moved[:, 0] = x - np.maximum(x - 5, 0) / 5 * (0.8 * y + 0.02 * y * z)
    mesh = fs.Mesh(moved, plain.cells)
    result = fs.fillet(mesh, [(3, 0, 0)], 1.5)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 1] - 1.5, points[:, 2] - 1.5) - 1.5).max() < 1e-8
    last = points[:, 0].max()
    assert last == pytest.approx(10 - 0.8 * 1.1 * 1.5, abs=5e-3)
    area = area_of_chords(points[points[:, 0] < 1e-9, 1:], (1.5, 1.5), 1.5)
    assert end_of(result, 0, last) == pytest.approx(area, rel=0.03)
    assert volume(mesh) - volume(result.mesh) == pytest.approx(area * last, rel=0.03)
    # Elements at the slanted end are poor already.
    assert quality(result.mesh).min() >= 0.75 * quality(mesh).min() > 0.13
    check_conforming(result.mesh)
