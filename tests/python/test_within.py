# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cracks that end inside the material."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic, tetra_volumes

PLANE = fs.Plane(origin=(3.1, 2.4, 1.9), normal=(0.2, 0.1, 1))
U = np.cross(PLANE.normal, (0, 1, 0))
U /= np.linalg.norm(U)
V = np.cross(PLANE.normal, U)
CENTER = np.array(PLANE.origin)


@pytest.fixture(scope="module")
def mesh():
    return grid_box((15, 13, 11), (6, 5, 4))


def lip(result, side, name="CRACK"):
    triangles, ids = result.mesh.cells["triangle"], result.mesh.cell_ids["triangle"]
    corners = result.mesh.points[triangles[np.isin(ids, result.mesh.groups[f"{name}_{side}"].ids)]]
    return corners, np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2


def front(result, name="CRACK"):
    group = result.mesh.groups[f"{name}_FRONT"]
    assert group.kind == "element"
    lines, ids = result.mesh.cells["line"], result.mesh.cell_ids["line"]
    return lines[np.isin(ids, group.ids)]


def check(result, volume=120.0):
    result.mesh.validate()
    volumes = tetra_volumes(result.mesh.points, result.mesh.cells["tetra"])
    assert volumes.min() > 0 and volumes.sum() == pytest.approx(volume, rel=1e-12)
    assert result.report.quality.after.minimum > 0.05
    edges = front(result)
    # Single nodes: no other node is at a front node's place; elsewhere on the lips there are two.
    where = {tuple(p) for p in result.mesh.points[np.unique(edges)]}
    places = [tuple(p) for p in result.mesh.points]
    assert all(places.count(p) == 1 for p in list(where)[:20])
    assert lip(result, "P")[1] == pytest.approx(lip(result, "N")[1], rel=1e-12)
    return edges


def test_disk_inside(mesh):
    disk = fs.Disk(CENTER, 1.4)
    result = fs.crack(mesh, PLANE, within=disk)
    edges = check(result)
    nodes = result.mesh.points[np.unique(edges)]
    np.testing.assert_allclose(np.linalg.norm(nodes - CENTER, axis=1), 1.4, atol=1e-9)
    assert np.abs(PLANE.distance(nodes)).max() < 1e-9
    # One closed chain, in order.
    assert (edges[1:, 0] == edges[:-1, 1]).all() and edges[0, 0] == edges[-1, 1]
    assert 0.95 < lip(result, "P")[1] / (np.pi * 1.4 ** 2) < 1


def test_disk_that_breaks_the_surface(mesh):
    plane = fs.Plane((3.1, 0, 1.9), (0, 0, 1))
    result = fs.crack(mesh, plane, within=fs.Disk((3.1, 0, 1.9), 1.4))
    edges = check(result)
    assert (edges[1:, 0] == edges[:-1, 1]).all() and edges[0, 0] != edges[-1, 1]
    ends = result.mesh.points[[edges[0, 0], edges[-1, 1]]]
    np.testing.assert_allclose(ends[:, 1], 0, atol=1e-12)
    np.testing.assert_allclose(np.sort(ends[:, 0]), [1.7, 4.5], atol=1e-9)


def test_half_plane(mesh):
    plane = fs.Plane((3.1, 0, 1.9), (0, 0, 1))
    result = fs.crack(mesh, plane, within=fs.HalfPlane((3.1, 0, 1.9), (-1, 0, 0)))
    edges = check(result)
    np.testing.assert_allclose(result.mesh.points[np.unique(edges), 0], 3.1, atol=1e-9)
    assert lip(result, "P")[1] == pytest.approx(3.1 * 5, rel=1e-9)


def test_ellipse(mesh):
    result = fs.crack(mesh, PLANE, within=fs.Ellipse(CENTER, (1.8, 1.1), U))
    nodes = result.mesh.points[np.unique(check(result))] - CENTER
    np.testing.assert_allclose((nodes @ U / 1.8) ** 2 + (nodes @ V / 1.1) ** 2, 1, atol=1e-9)


@pytest.mark.parametrize("corners", [
    [(-1.3, -1.1), (1.3, -1.1), (1.3, 1.1), (-1.3, 1.1)],
    [(-1.3, -1.1), (1.3, -1.1), (1.3, 0.1), (0.1, 0.1), (0.1, 1.2), (-1.3, 1.2)],
])
def test_polygon(mesh, corners):
    points = [CENTER + a * U + b * V for a, b in corners]
    result = fs.crack(mesh, PLANE, within=fs.Polygon(points))
    check(result)
    x, y = np.array(corners).T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    assert lip(result, "P")[1] == pytest.approx(area, rel=1e-9)
    for p in points:
        assert np.linalg.norm(result.mesh.points - p, axis=1).min() < 1e-9


def test_part_of_a_cylinder(mesh):
    cylinder = fs.Cylinder((3.1, 2.4, 0), (0, 0, 1), 1.5)
    result = fs.crack(mesh, cylinder, within=fs.CylinderPart((1, 3), (-20, 100), (1, 0, 0)))
    nodes = result.mesh.points[np.unique(check(result))]
    assert np.abs(cylinder.distance(nodes)).max() < 1e-9
    assert 0.9 < lip(result, "P")[1] / (2 * np.radians(120) * 1.5) <= 1


def test_cracks_that_cross(mesh):
    first = fs.crack(mesh, fs.Plane((3.1, 2.4, 1.9), (0, 0, 1)), within=fs.Disk((3.1, 2.4, 1.9), 1.5), name="A")
    areas = [lip(first, side, "A")[1] for side in "PN"]
    second = fs.crack(first.mesh, fs.Plane((3.1, 2.4, 1.9), (1, 0, 0)), within=fs.Disk((3.1, 2.4, 1.9), 1.2), name="B")
    second.mesh.validate()
    volumes = tetra_volumes(second.mesh.points, second.mesh.cells["tetra"])
    assert volumes.min() > 0 and volumes.sum() == pytest.approx(120, rel=1e-12)
    # The first crack keeps both lips, flat and whole; where nodes of its front slide along it, they cut its round a little.
    for side, area in zip("PN", areas):
        corners, now = lip(second, side, "A")
        assert now == pytest.approx(area, rel=3e-3) and np.abs(corners[..., 2] - 1.9).max() < 1e-9
    assert lip(second, "P", "B")[1] > 0.9 * np.pi * 1.2 ** 2


def test_quadratic_front_is_round():
    result = fs.crack(quadratic(grid_box((15, 13, 11), (6, 5, 4))), PLANE, within=fs.Disk(CENTER, 1.4))
    lines, ids = result.mesh.cells["line3"], result.mesh.cell_ids["line3"]
    nodes = result.mesh.points[np.unique(lines[np.isin(ids, result.mesh.groups["CRACK_FRONT"].ids)])]
    np.testing.assert_allclose(np.linalg.norm(nodes - CENTER, axis=1), 1.4, atol=1e-9)


@pytest.mark.parametrize("within, error, message", [
    (lambda: 5, TypeError, "within must be a Disk"),
    (lambda: fs.Disk(CENTER, 0), fs.ToolError, "radius is 0"),
    (lambda: fs.Disk(CENTER + (0, 0, 1), 1), fs.ToolError, "off the plane"),
    (lambda: fs.Disk(CENTER, 0.05), fs.ToolError, "too coarse"),
    (lambda: fs.Disk(CENTER + 50 * U, 1), fs.ToolError, "outside the part"),
    (lambda: fs.Polygon([CENTER, CENTER + U]), fs.ToolError, "at least three"),
    (lambda: fs.Polygon([CENTER, CENTER + U, CENTER + V, CENTER + U + V]), fs.ToolError, "sides 2 and 4 cross"),
    (lambda: fs.HalfPlane(CENTER, PLANE.normal), fs.ToolError, "normal to the plane"),
    (lambda: fs.CylinderPart((0, 1)), fs.ToolError, "lies on a cylinder"),
    (lambda: fs.CylinderPart((1, 0)), fs.ToolError, "low must be less than high"),
])
def test_bad_parts(mesh, within, error, message):
    with pytest.raises(error, match=message):
        fs.crack(mesh, PLANE, within=within())
