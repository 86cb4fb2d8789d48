# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shells on the same nodes, and shells that stand on each other."""

import numpy as np
import pytest

import femscalpel as fs


def plate(nx, ny, origin=(0, 0, 0), u=(1, 0, 0), v=(0, 1, 0)):
    """Points and triangles of nx by ny squares, their diagonals turned in turn."""
    origin, u, v = (np.array(x, float) for x in (origin, u, v))
    points = np.array([origin + i * u + j * v for j in range(ny + 1) for i in range(nx + 1)])
    triangles = []
    for j in range(ny):
        for i in range(nx):
            a = j * (nx + 1) + i
            b, c, d = a + 1, a + nx + 2, a + nx + 1
            triangles += [[a, b, d], [b, c, d]] if (i + j) % 2 else [[a, b, c], [a, c, d]]
    return points, np.array(triangles)


def corner_sets(mesh, ids):
    cells = mesh.cells["triangle"][np.isin(mesh.cell_ids["triangle"], ids)]
    return sorted(tuple(sorted(row)) for row in cells)


OPERATIONS = [
    lambda mesh: fs.crack(mesh, fs.Plane((3.4, 2, 0), (1, 0.2, 0))),
    lambda mesh: fs.drill(mesh, fs.Cylinder((4.1, 2.1, 0), (0, 0, 1), 1.2)),
]


@pytest.mark.parametrize("operation", OPERATIONS)
@pytest.mark.parametrize("turned", [False, True])
def test_coincident_shells_are_one_sheet(operation, turned):
    points, triangles = plate(8, 4)
    count = len(triangles)
    copies = triangles[:, ::-1] if turned else triangles
    single = operation(fs.Mesh(points, {"triangle": triangles}))
    groups = {"PLATE": ("element", range(1, count + 1)), "LOAD": ("element", range(count + 1, 2 * count + 1))}
    double = operation(fs.Mesh(points, {"triangle": np.concatenate([triangles, copies])}, groups=groups))
    np.testing.assert_array_equal(double.mesh.points, single.mesh.points)
    assert double.report.quality.after.minimum == pytest.approx(single.report.quality.after.minimum, rel=1e-12)
    assert {k: len(v) for k, v in double.report.node_sets.items()} == {
        k: len(v) for k, v in single.report.node_sets.items()
    }
    assert double.report.constraints == single.report.constraints and double.report.warnings == []
    # Every copy is split and doubled as the other is.
    plate_now, load_now = (corner_sets(double.mesh, double.mesh.groups[name].ids) for name in ("PLATE", "LOAD"))
    assert plate_now == load_now == corner_sets(single.mesh, single.mesh.cell_ids["triangle"])


def test_a_skin_on_part_of_a_shell_keeps_its_rim():
    points, triangles = plate(8, 4)
    left = triangles[points[triangles][:, :, 0].mean(axis=1) < 4]
    groups = {"LOAD": ("element", range(len(triangles) + 1, len(triangles) + len(left) + 1))}
    result = fs.crack(
        fs.Mesh(points, {"triangle": np.concatenate([triangles, left])}, groups=groups),
        fs.Plane((4.3, 2, 0), (1, 0.5, 0)),
    )
    record = next(g for g in result.report.groups if g.name == "LOAD")
    assert record.measure_after == pytest.approx(16, rel=1e-12) and record.boundary_drift < 1e-12
    assert record.nodes_on_line > 0 and result.report.quality.after.minimum > 0.3


def joined(*parts):
    """One mesh of plates, nodes at one place made one; the number of triangles of each."""
    points = np.concatenate([p for p, _ in parts])
    starts = np.cumsum([0] + [len(p) for p, _ in parts])
    triangles = np.concatenate([t + s for (_, t), s in zip(parts, starts)])
    unique, inverse = np.unique(np.round(points, 9), axis=0, return_inverse=True)
    return unique, inverse.reshape(-1)[triangles], [len(t) for _, t in parts]


FLOOR = plate(8, 8, (0, -4, 0))
WEB = plate(8, 3, (0, 0, 0), (1, 0, 0), (0, 0, 1))
KEEL = plate(8, 3, (0, 0, 0), (1, 0, 0), (0, 0, -1))


def junction(*plates):
    points, triangles, counts = joined(*plates)
    ends = np.cumsum([0] + counts)
    names = ("FLOOR", "WEB", "KEEL")
    groups = {name: ("element", range(a + 1, b + 1)) for name, a, b in zip(names, ends, ends[1:])}
    groups["WELD"] = ("node", 1 + np.nonzero((points[:, 1] == 0) & (points[:, 2] == 0))[0])
    return fs.Mesh(points, {"triangle": triangles}, groups=groups)


def nodes_of(mesh, name):
    ids = mesh.groups[name].ids
    cells = [mesh.cells[t][np.isin(i, ids)] for t, i in mesh.cell_ids.items()]
    return set(np.concatenate([c.ravel() for c in cells]))


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -1)])
def test_crack_in_the_plane_of_a_shell_parts_it_from_what_stands_on_it(normal):
    mesh = junction(FLOOR, WEB)
    result = fs.crack(mesh, fs.Plane((0, 0, 0), normal))
    after = result.mesh
    after.validate()
    assert result.report.nodes_doubled == 9 and result.report.nodes_moved == 0 and "CRACK_FRONT" not in after.groups
    assert not nodes_of(after, "FLOOR") & nodes_of(after, "WEB")
    # The original nodes stay on the negative side; the lips are the junction's edges, one of the floor and one of the
    # web.
    web_is_positive = normal[2] > 0
    kept = "FLOOR" if web_is_positive else "WEB"
    old = set(range(mesh.node_count))
    assert nodes_of(after, kept) <= old and len(nodes_of(after, "WEB" if web_is_positive else "FLOOR") - old) == 9
    assert len(after.groups["CRACK_P"]) == len(after.groups["CRACK_N"]) == 8
    assert nodes_of(after, "CRACK_P" if web_is_positive else "CRACK_N") <= nodes_of(after, "WEB")
    assert nodes_of(after, "CRACK_N" if web_is_positive else "CRACK_P") <= nodes_of(after, "FLOOR")
    assert len(after.groups["WELD"]) == 18
    assert {g.status for g in result.report.groups if g.name in ("FLOOR", "WEB")} == {"kept", "untouched"}
    side = "negative" if web_is_positive else "positive"
    assert result.report.warnings == [f"128 shell elements lie in the tool's surface, and stay on the {side} side"]


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -1)])
def test_crack_in_a_shell_between_two_parts_what_is_on_the_positive_side(normal):
    after = fs.crack(junction(FLOOR, WEB, KEEL), fs.Plane((0, 0, 0), normal)).mesh
    positive, negative = ("WEB", "KEEL") if normal[2] > 0 else ("KEEL", "WEB")
    assert not nodes_of(after, positive) & nodes_of(after, "FLOOR")
    assert len(nodes_of(after, negative) & nodes_of(after, "FLOOR")) == 9


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -1)])
def test_crack_along_part_of_a_junction_has_its_tips(normal):
    result = fs.crack(junction(FLOOR, WEB), fs.Plane((0, 0, 0), normal), within=fs.Disk((4, 0, 0), 2.5))
    after = result.mesh
    tips = after.points[np.isin(after.node_ids, after.groups["CRACK_FRONT"].ids)]
    np.testing.assert_allclose(tips[np.argsort(tips[:, 0])], [[1.5, 0, 0], [6.5, 0, 0]], atol=1e-9)
    shared = nodes_of(after, "FLOOR") & nodes_of(after, "WEB")
    assert all(abs(after.points[n][0] - 4) >= 2.5 - 1e-9 for n in shared) and len(shared) == 6


def test_plane_in_shells_on_which_nothing_stands_says_so():
    points, triangles = FLOOR
    with pytest.raises(fs.ToolError, match=r"128 shell elements lie in the plane, and nothing stands on them"):
        fs.crack(fs.Mesh(points, {"triangle": triangles}), fs.Plane((0, 0, 0), (0, 0, 1)))
    # A plate that rises smoothly from the plane does not stand on the rest.
    rising = points.copy()
    rising[:, 2] = 0.02 * np.maximum(points[:, 0] - 4, 0) ** 2
    with pytest.raises(fs.ToolError, match="nothing stands on them"):
        fs.crack(fs.Mesh(rising, {"triangle": triangles}), fs.Plane((0, 0, 0), (0, 0, 1)))
