# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges that meet at corners, rounded at once."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic, tetra_volumes
from test_fillet import check_conforming, face_points, l_shape, quality
from test_fillet_ends import part_of_box, room
from test_fillet_groups import group_volumes, grouped

SIZE = np.array([6.0, 5.0, 4.0])


def measure(mesh):
    """Volume; of ten-node tetrahedra by Keast's rule of 14 points, which is exact for their Jacobian determinants."""
    if "tetra" in mesh.cells:
        return tetra_volumes(mesh.points, mesh.cells["tetra"]).sum()
    places = []
    for c, weight in ((0.3108859192633006, 0.1126879257180159), (0.0927352503108912, 0.0734930431163619)):
        places += [(np.where(np.arange(4) == k, 1 - 3 * c, c), weight) for k in range(4)]
    c = 0.0455037041256496
    places += [
        (np.where(np.isin(np.arange(4), (i, j)), 0.5 - c, c), 0.0425460207770815) for i in range(4) for j in range(i)
    ]
    assert sum(w for _, w in places) == pytest.approx(1)
    nodes = mesh.points[mesh.cells["tetra10"]]
    gradient = np.array([[-1, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    pairs = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
    total = 0
    for at, weight in places:
        d = [(4 * at[k] - 1) * gradient[k] for k in range(4)]
        d += [4 * (at[i] * gradient[j] + at[j] * gradient[i]) for i, j in pairs]
        total += weight / 6 * np.linalg.det(np.einsum("enk,nl->ekl", nodes, np.array(d))).sum()
    return total


def on_planes(mesh, size=SIZE):
    """On how many of a box's six planes each node lies."""
    return ((np.abs(mesh.points) < 1e-9) | (np.abs(mesh.points - size) < 1e-9)).sum(axis=1)


def rounded_box(size, r):
    a, b, c = np.asarray(size) - 2 * r
    return a * b * c + 2 * r * (a * b + b * c + c * a) + np.pi * r**2 * (a + b + c) + 4 / 3 * np.pi * r**3


def off_rounded_box(points, r, size=SIZE):
    return np.abs(np.linalg.norm(points - np.clip(points, r, size - r), axis=1) - r).max()


@pytest.mark.parametrize("second_order", [False, True])
@pytest.mark.parametrize("radius", [0.5, 1.0, 1.7])
def test_all_edges_of_a_box(radius, second_order):
    mesh = grid_box((6, 5, 4), tuple(SIZE))
    mesh.add_group("EDGES", "node", mesh.node_ids[on_planes(mesh) >= 2])
    if second_order:
        edges = on_planes(mesh) >= 2
        mesh = quadratic(mesh)
        mesh.add_group("EDGES", "node", mesh.node_ids[: len(edges)][edges])
    result = fs.fillet(mesh, "EDGES", radius)
    assert off_rounded_box(face_points(result.mesh), radius) < 1e-9 * np.linalg.norm(SIZE)
    removed = np.prod(SIZE) - rounded_box(SIZE, radius)
    assert np.prod(SIZE) - measure(result.mesh) == pytest.approx(removed, rel=0.001 if second_order else 0.03)
    assert quality(result.mesh).min() >= 0.15
    # Where refinement halves an edge between two of its nodes, the group has the middle, on the face.
    assert radius < 1 or len(result.mesh.groups["EDGES"]) == 0
    assert not any("FILLET_END" in n for n in result.mesh.groups)
    if not second_order:
        check_conforming(result.mesh)


def test_a_box_turned_anyhow_with_groups():
    """Halves as element groups, faces as node groups."""
    rng = np.random.default_rng(5)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    plain = grid_box((6, 5, 4), tuple(SIZE))
    mesh = fs.Mesh(plain.points @ turn.T, plain.cells)
    ids = mesh.node_ids
    mesh.add_group("EDGES", "node", ids[on_planes(plain) >= 2])
    mesh.add_group("FLOOR", "node", ids[plain.points[:, 2] == 0])
    centres = plain.points[plain.cells["tetra"]].mean(axis=1)
    for name, where in (("LEFT", centres[:, 0] < 3), ("RIGHT", centres[:, 0] > 3)):
        mesh.add_group(name, "element", mesh.cell_ids["tetra"][where])
    result = fs.fillet(mesh, "EDGES", 1.0)
    points = result.mesh.points @ turn
    assert off_rounded_box(face_points(result.mesh) @ turn, 1.0) < 1e-8
    left, right = group_volumes(result.mesh, ["LEFT", "RIGHT"]).values()
    assert left == pytest.approx(right, rel=1e-3) and left + right == pytest.approx(rounded_box(SIZE, 1), rel=0.005)
    floor = set(result.mesh.groups["FLOOR"].ids.tolist())
    assert floor == set(result.mesh.node_ids[np.abs(points[:, 2]) < 1e-9].tolist())
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


@pytest.mark.parametrize("second_order", [False, True])
@pytest.mark.parametrize("radius", [0.5, 1.0, 1.7])
def test_two_edges_meet_in_a_plane(radius, second_order):
    mesh = grid_box((6, 5, 4), tuple(SIZE))
    if second_order:
        mesh = quadratic(mesh)
    result = fs.fillet(mesh, [(3, 0, 0), (0, 2.5, 0)], radius)
    points = face_points(result.mesh)
    off = np.minimum(
        np.abs(np.hypot(points[:, 1] - radius, points[:, 2] - radius) - radius),
        np.abs(np.hypot(points[:, 0] - radius, points[:, 2] - radius) - radius),
    )
    assert off.max() < 1e-8
    # Integrated along z: at each height, what is off the two sides.
    z = (np.arange(100000) + 0.5) / 100000 * radius
    step = radius - np.sqrt(radius**2 - (z - radius) ** 2)
    removed = (SIZE[0] * step + SIZE[1] * step - step**2).mean() * radius
    assert np.prod(SIZE) - measure(result.mesh) == pytest.approx(removed, rel=0.002 if second_order else 0.03)
    assert quality(result.mesh).min() >= 0.15
    if not second_order:
        check_conforming(result.mesh)


def test_an_outline_of_a_face():
    """Four edges in a ring, each of which meets two others."""
    mesh = grid_box((6, 5, 4), tuple(SIZE))
    nodes = mesh.node_ids[(mesh.points[:, 2] == 4) & (on_planes(mesh) >= 2)]
    result = fs.fillet(mesh, nodes, 1.0)
    z = (np.arange(100000) + 0.5) / 100000
    step = 1 - np.sqrt(1 - (z - 1) ** 2)
    removed = (2 * (SIZE[0] + SIZE[1]) * step - 4 * step**2).mean()
    assert np.prod(SIZE) - measure(result.mesh) == pytest.approx(removed, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


@pytest.mark.parametrize("radius", [0.6, 1.5])
def test_toe_around_a_boss(radius):
    """Concave edges that meet at a convex one."""
    mesh = part_of_box(lambda x, y, z: (z < 3) | ((np.abs(x - 4) < 1) & (np.abs(y - 4) < 1)), (8, 8, 6))
    points = mesh.points
    on_toe = (points[:, 2] == 3) & (np.abs(points[:, :2] - 4).max(axis=1) == 1)
    result = fs.fillet(mesh, mesh.node_ids[on_toe], radius)
    z = (np.arange(100000) + 0.5) / 100000 * radius
    step = radius - np.sqrt(radius**2 - (z - radius) ** 2)
    added = (4 * 2 * step + 4 * step**2).mean() * radius
    assert measure(result.mesh) - measure(mesh) == pytest.approx(added, rel=0.035)
    x = face_points(result.mesh)
    across = np.abs(x[:, :2] - 4).max(axis=1) - 1
    assert np.abs(np.hypot(across - radius, x[:, 2] - 3 - radius) - radius).max() < 1e-8
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


@pytest.mark.parametrize("radius", [0.6, 1.5])
def test_three_walls_of_a_room(radius):
    mesh = room()
    result = fs.fillet(mesh, [(4, 4, 6), (4, 6, 4), (6, 4, 4)], radius)
    x = face_points(result.mesh)
    off = np.abs(np.linalg.norm(np.minimum(x - 4 - radius, 0), axis=1) - radius)
    assert off.max() < 1e-8
    square = 1 - np.pi / 4
    added = 3 * square * radius**2 * (4 - radius) + (1 - np.pi / 6) * radius**3
    assert measure(result.mesh) - measure(mesh) == pytest.approx(added, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


@pytest.mark.parametrize("edges", [1, 2, 3])
def test_a_slanted_corner(edges):
    """No right angle at the corner."""
    plain = grid_box((7, 7, 7), (7.0, 7.0, 7.0))
    shear = np.array([[1, 0.25, 0.2], [0, 1, 0.15], [0, 0, 1]])
    if edges == 2:
        shear = np.array([[1, 0, 0.2], [0, 1, 0.2], [0, 0, 1]])
    mesh = fs.Mesh(plain.points @ shear.T, plain.cells)
    places = np.array([(3.5, 0, 0), (0, 3.5, 0), (0, 0, 3.5)])[:edges] @ shear.T
    result = fs.fillet(mesh, places, 1.2)
    assert quality(result.mesh).min() >= 0.15
    assert measure(mesh) - measure(result.mesh) > 0.15 * edges * 1.2**2 * 6
    check_conforming(result.mesh)


def test_refusals():
    mesh = l_shape()
    with pytest.raises(fs.ToolError, match="a convex and a concave one") as caught:
        fs.fillet(mesh, [(4, 4, 2), (6, 4, 0)], 1.0)
    assert caught.value.parameter == "along"
    box = grid_box((6, 5, 4), tuple(SIZE))
    with pytest.raises(fs.ToolError, match="roundings would meet") as caught:
        fs.fillet(box, [(3, 0, 0), (0, 2, 0), (0, 0, 2), (6, 2, 0), (6, 0, 2)], 3.1)
    assert caught.value.parameter == "radius"
    with pytest.raises(fs.ToolError, match="so near each other") as caught:
        fs.fillet(box, [(3, 0, 0), (3, 0, 4)], 2.1)
    assert caught.value.parameter == "along"


@pytest.mark.parametrize("radius", [0.6, 1.5])
def test_both_toes_of_a_thin_rib(radius):
    """Edges that do not meet, but are nearer to each other than what is replaced around them."""
    mesh = part_of_box(lambda x, y, z: (z < 3) | ((y > 4) & (y < 5)), (6, 9, 6))
    result = fs.fillet(mesh, [(3, 4, 3), (3, 5, 3)], radius)
    added = 2 * (1 - np.pi / 4) * radius**2 * 6
    assert measure(result.mesh) - measure(mesh) == pytest.approx(added, rel=0.03)
    x = face_points(result.mesh)
    across = np.abs(x[:, 1] - 4.5) - 0.5
    assert np.abs(np.hypot(across - radius, x[:, 2] - 3 - radius) - radius).max() < 1e-8
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_both_toes_of_a_rib_in_another_group():
    groups = {"PLATE": lambda x, y, z: z < 3, "RIB": lambda x, y, z: z > 3}
    mesh = grouped(part_of_box(lambda x, y, z: (z < 3) | ((y > 4) & (y < 5)), (6, 9, 6)), groups)
    before = group_volumes(mesh, groups)
    result = fs.fillet(mesh, [(3, 4, 3), (3, 5, 3)], 1.5)
    after = group_volumes(result.mesh, groups)
    for name in groups:
        assert after[name] - before[name] == pytest.approx((1 - np.pi / 4) * 1.5**2 * 6, rel=0.03)
    check_conforming(result.mesh)


@pytest.mark.parametrize("radius", [1.0, 2.5])
def test_toe_around_a_boss_in_another_group(radius):
    groups = {"PLATE": lambda x, y, z: z < 3, "BOSS": lambda x, y, z: z > 3}
    mesh = grouped(
        part_of_box(lambda x, y, z: (z < 3) | ((np.abs(x - 4) < 1) & (np.abs(y - 4) < 1)), (8, 8, 6)), groups
    )
    on_toe = (mesh.points[:, 2] == 3) & (np.abs(mesh.points[:, :2] - 4).max(axis=1) == 1)
    before = group_volumes(mesh, groups)
    result = fs.fillet(mesh, mesh.node_ids[on_toe], radius)
    after = group_volumes(result.mesh, groups)
    grown = {n: after[n] - before[n] for n in groups}
    assert sum(grown.values()) == pytest.approx(measure(result.mesh) - measure(mesh), rel=1e-9)
    assert 0.3 < grown["BOSS"] / sum(grown.values()) < 0.5
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)
