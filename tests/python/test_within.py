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
    return (
        corners,
        np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2,
    )


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
    check_no_face_is_closed(result)
    return edges


def check_no_face_is_closed(result, name="CRACK"):
    """No face of the crack has all its nodes on the front: it could not open."""
    triangles, ids = result.mesh.cells["triangle"], result.mesh.cell_ids["triangle"]
    sides = [
        {tuple(sorted(t)) for t in triangles[np.isin(ids, result.mesh.groups[f"{name}_{side}"].ids)].tolist()}
        for side in "PN"
    ]
    assert sides[0] and not sides[0] & sides[1]


def test_disk_inside(mesh):
    disk = fs.Disk(CENTER, 1.4)
    result = fs.crack(mesh, PLANE, within=disk)
    edges = check(result)
    nodes = result.mesh.points[np.unique(edges)]
    np.testing.assert_allclose(np.linalg.norm(nodes - CENTER, axis=1), 1.4, atol=1e-9)
    assert np.abs(PLANE.distance(nodes)).max() < 1e-9
    # One closed chain, in order.
    assert (edges[1:, 0] == edges[:-1, 1]).all() and edges[0, 0] == edges[-1, 1]
    assert 0.95 < lip(result, "P")[1] / (np.pi * 1.4**2) < 1


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


@pytest.mark.parametrize(
    "corners",
    [
        [(-1.3, -1.1), (1.3, -1.1), (1.3, 1.1), (-1.3, 1.1)],
        [(-1.3, -1.1), (1.3, -1.1), (1.3, 0.1), (0.1, 0.1), (0.1, 1.2), (-1.3, 1.2)],
    ],
)
def test_polygon(mesh, corners):
    points = [CENTER + a * U + b * V for a, b in corners]
    result = fs.crack(mesh, PLANE, within=fs.Polygon(points))
    check(result)
    x, y = np.array(corners).T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    assert lip(result, "P")[1] == pytest.approx(area, rel=1e-9)
    for p in points:
        assert np.linalg.norm(result.mesh.points - p, axis=1).min() < 1e-9


def test_squares_however_they_lie(mesh):
    random = np.random.default_rng(11)
    for _ in range(25):
        n = random.normal(size=3)
        u = np.cross(n, (0.3, 0.5, 0.8))
        u /= np.linalg.norm(u)
        v = np.cross(n, u) / np.linalg.norm(n)
        corners = [CENTER + a * u + b * v for a, b in ((-1.1, -1.1), (1.1, -1.1), (1.1, 1.1), (-1.1, 1.1))]
        for refine in (None, False):
            result = fs.crack(mesh, fs.Plane(CENTER, n), within=fs.Polygon(corners), refine=refine)
            check(result)
            assert lip(result, "P")[1] == pytest.approx(2.2**2, rel=1e-9)


@pytest.mark.parametrize("width", [0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2])
def test_squares_in_line_with_the_mesh(mesh, width):
    # Their corners fall on nodes and edges of the mesh, as it is or refined.
    corners = [CENTER + (a * width / 2, b * width / 2, 0) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    for refine in (False, None):
        result = fs.crack(mesh, fs.Plane(CENTER, (0, 0, 1)), within=fs.Polygon(corners), refine=refine)
        check(result)
        assert lip(result, "P")[1] == pytest.approx(width**2, rel=1e-9)


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
    check_no_face_is_closed(second, "B")
    second.mesh.validate()
    volumes = tetra_volumes(second.mesh.points, second.mesh.cells["tetra"])
    assert volumes.min() > 0 and volumes.sum() == pytest.approx(120, rel=1e-12)
    # The first crack keeps both lips, flat and whole.
    for side, area in zip("PN", areas):
        corners, now = lip(second, side, "A")
        assert now == pytest.approx(area, rel=1e-12) and np.abs(corners[..., 2] - 1.9).max() < 1e-12
    assert lip(second, "P", "B")[1] > 0.9 * np.pi * 1.2**2


@pytest.mark.parametrize("shape", ["disk", "half plane", "whole plane"])
def test_a_crack_through_a_crack_leaves_it_its_area_and_front(mesh, shape):
    random = np.random.default_rng(1)
    for _ in range(6):
        normals = random.normal(size=(2, 3))
        u = np.cross(normals[0], (0.3, 0.5, 0.8))
        within = {"disk": fs.Disk(CENTER, 1.4), "half plane": fs.HalfPlane(CENTER, u), "whole plane": None}[shape]
        first = fs.crack(mesh, fs.Plane(CENTER, normals[0]), within=within, name="A")
        center = CENTER + random.uniform(-0.3, 0.3, 3)
        second = fs.crack(
            first.mesh, fs.Plane(center, normals[1]), within=random.choice([None, fs.Disk(center, 1.2)]), name="B"
        )
        second.mesh.validate()
        volumes = tetra_volumes(second.mesh.points, second.mesh.cells["tetra"])
        assert volumes.min() > 0 and volumes.sum() == pytest.approx(120, rel=1e-12)
        for side in "PN":
            assert lip(second, side, "A")[1] == pytest.approx(lip(first, side, "A")[1], rel=1e-12)
        if within is not None:
            # The nodes of the first front stay where they are; what the second crack adds is between them.
            old, new = (r.mesh.points[np.unique(front(r, "A"))] for r in (first, second))
            assert shape != "disk" or {tuple(p) for p in old} <= {tuple(p) for p in new}
            length = [
                np.linalg.norm(r.mesh.points[e[:, 1]] - r.mesh.points[e[:, 0]], axis=1).sum()
                for r, e in ((first, front(first, "A")), (second, front(second, "A")))
            ]
            assert length[1] >= length[0] * (1 - 1e-12)
            assert shape != "disk" or np.abs(np.linalg.norm(old - CENTER, axis=1) - 1.4).max() < 1e-9


def test_two_cracks_across_make_four_pieces(mesh):
    first = fs.crack(mesh, fs.Plane(CENTER, (0, 0.1, 1)), name="A")
    second = fs.crack(first.mesh, fs.Plane(CENTER, (1, 0.2, 0.1)), name="B")
    cells = second.mesh.cells["tetra"]
    piece = np.arange(second.mesh.node_count)  # smallest node index known to be in the same piece
    while True:
        lowest = piece[cells].min(axis=1)
        before = piece.copy()
        for k in range(4):
            np.minimum.at(piece, cells[:, k], lowest)
        if (before == piece).all():
            break
    assert len(set(piece[np.unique(cells)].tolist())) == 4
    # Along the line where they cross, each piece has nodes of its own, from end to end.
    direction = np.cross((0, 0.1, 1), (1, 0.2, 0.1))
    direction /= np.linalg.norm(direction)
    on_line = np.flatnonzero(np.linalg.norm(np.cross(second.mesh.points - CENTER, direction), axis=1) < 1e-9)
    along = (second.mesh.points[on_line] - CENTER) @ direction
    for number in set(piece[on_line].tolist()):
        mine = np.sort(along[piece[on_line] == number])
        assert (
            len(mine) > 8
            and mine[0] == pytest.approx(along.min(), abs=1e-9)
            and mine[-1] == pytest.approx(along.max(), abs=1e-9)
        )
    assert len(set(piece[on_line].tolist())) == 4
    # What is on the two lips of the first crack need not match any more, and that is told.
    points = [{tuple(np.round(p, 9)) for p in lip(second, side, "A")[0].reshape(-1, 3)} for side in "PN"]
    unmatched = len(points[0] ^ points[1])
    told = [w for w in second.report.warnings if "no longer match node for node" in w]
    assert len(told) == (unmatched > 0) and (not told or f"({unmatched} nodes)" in told[0])
    assert not [w for w in first.report.warnings if "node for node" in w]


def test_a_crack_through_a_crack_of_second_order():
    mesh = quadratic(grid_box((11, 9, 8), (6, 5, 4)))
    random = np.random.default_rng(1)
    for within in (fs.Disk(CENTER, 1.4), None):
        for _ in range(4):
            normals = random.normal(size=(2, 3))
            first = fs.crack(mesh, fs.Plane(CENTER, normals[0]), within=within, name="A")
            second = fs.crack(first.mesh, fs.Plane(CENTER + random.uniform(-0.3, 0.3, 3), normals[1]), name="B")
            measures = [{g.name: g.measure_after for g in r.report.groups} for r in (first, second)]
            for side in "PN":
                assert measures[1]["A_" + side] == pytest.approx(
                    measures[0]["A_" + side], rel=1e-7 if within else 1e-12
                )


def test_every_face_of_a_crack_can_open(mesh):
    random = np.random.default_rng(5)
    for _ in range(40):
        center = CENTER + random.uniform(-0.3, 0.3, 3)
        result = fs.crack(
            mesh, fs.Plane(center, random.normal(size=3)), within=fs.Disk(center, random.uniform(0.6, 1.8))
        )
        check_no_face_is_closed(result)
        assert not any("cannot open" in w for w in result.report.warnings)


@pytest.mark.parametrize("within", [fs.Disk(CENTER, 1.4), fs.HalfPlane(CENTER, U)])
def test_a_front_is_the_same_after_a_file(mesh, tmp_path, within):
    result = fs.crack(mesh, PLANE, within=within)
    fs.write(result.mesh, tmp_path / "cracked.med")
    back = fs.read(tmp_path / "cracked.med")
    lines, ids = back.cells["line"], back.cell_ids["line"]
    chosen = np.isin(ids, back.groups["CRACK_FRONT"].ids)
    chain = back.node_ids[lines[chosen]]
    np.testing.assert_array_equal(chain, result.mesh.node_ids[front(result)])
    # In the order of their numbers the segments follow each other.
    assert (np.diff(ids[chosen]) > 0).all() and (chain[1:, 0] == chain[:-1, 1]).all()
    # CalculiX would take a segment for a beam: there the front is the set of its nodes.
    fs.write(result.mesh, tmp_path / "cracked.inp")
    group = fs.read(tmp_path / "cracked.inp").groups["CRACK_FRONT"]
    assert group.kind == "node" and set(group.ids.tolist()) == set(chain.ravel().tolist())


def test_fronts_in_a_shell(tmp_path):
    n = 14
    points = [(0.5 * i, 0.5 * j, 0) for j in range(n + 1) for i in range(n + 1)]
    cells = [
        t
        for j in range(n)
        for i in range(n)
        for a in [i + (n + 1) * j]
        for t in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))
    ]
    mesh = fs.Mesh(points, {"triangle": cells})
    plane = fs.Plane((3.6, 3.3, 0), (0.3, 1, 0))
    along = np.array((1, -0.3, 0)) / np.hypot(1, 0.3)
    center = np.array(plane.origin)
    for within, tips in (
        (fs.Disk(center, 1.7), [center - 1.7 * along, center + 1.7 * along]),
        (fs.HalfPlane(center, along), [center]),
        (fs.Disk(center, 0.3), [center - 0.3 * along, center + 0.3 * along]),
    ):
        result = fs.crack(mesh, plane, within=within)
        group = result.mesh.groups["CRACK_FRONT"]
        assert group.kind == "node" and len(group.ids) == len(tips)
        nodes = result.mesh.points[np.isin(result.mesh.node_ids, group.ids)]
        for tip in tips:
            assert np.linalg.norm(nodes - tip, axis=1).min() < 1e-9
        # It opens: between the tips there are two nodes at each place, at the tips one.
        lines, ids = result.mesh.cells["line"], result.mesh.cell_ids["line"]
        lips = [set(lines[np.isin(ids, result.mesh.groups[f"CRACK_{side}"].ids)].ravel().tolist()) for side in "PN"]
        assert {int(result.mesh.node_ids[k]) for k in lips[0] & lips[1]} == set(group.ids.tolist())
        assert lips[0] - lips[1]
        for suffix in (".med", ".inp"):
            fs.write(result.mesh, tmp_path / f"shell{suffix}")
            assert set(fs.read(tmp_path / f"shell{suffix}").groups["CRACK_FRONT"].ids.tolist()) == set(
                group.ids.tolist()
            )


def test_quadratic_front_is_round():
    result = fs.crack(quadratic(grid_box((15, 13, 11), (6, 5, 4))), PLANE, within=fs.Disk(CENTER, 1.4))
    lines, ids = result.mesh.cells["line3"], result.mesh.cell_ids["line3"]
    nodes = result.mesh.points[np.unique(lines[np.isin(ids, result.mesh.groups["CRACK_FRONT"].ids)])]
    np.testing.assert_allclose(np.linalg.norm(nodes - CENTER, axis=1), 1.4, atol=1e-9)


@pytest.mark.parametrize(
    "within, error, message",
    [
        (lambda: 5, TypeError, "within must be a Disk"),
        (lambda: fs.Disk(CENTER, 0), fs.ToolError, "radius is 0"),
        (lambda: fs.Disk(CENTER + (0, 0, 1), 1), fs.ToolError, "off the plane"),
        (lambda: fs.Disk(CENTER, 0.05), fs.ToolError, "too coarse"),
        (lambda: fs.Disk(CENTER + 50 * U, 1), fs.ToolError, "outside the part"),
        (lambda: fs.Polygon([CENTER, CENTER + U]), fs.ToolError, "at least three"),
        (lambda: fs.Polygon([CENTER, CENTER + U, CENTER + V, CENTER + U + V]), fs.ToolError, "sides 2 and 4 cross"),
        (lambda: fs.HalfPlane(CENTER, PLANE.normal), fs.ToolError, "normal to the plane"),
        (lambda: fs.CylinderPart((0, 1)), fs.ToolError, "lies on a cylinder"),
        (
            lambda: fs.CylinderPart((1, 0)),
            fs.ToolError,
            "along must go from one place to another farther along the axis",
        ),
    ],
)
def test_bad_parts(mesh, within, error, message):
    with pytest.raises(error, match=message):
        fs.crack(mesh, PLANE, within=within(), refine=False)
