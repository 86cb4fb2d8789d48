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


OPERATIONS = [lambda mesh: fs.crack(mesh, fs.Plane((3.4, 2, 0), (1, 0.2, 0))),
              lambda mesh: fs.drill(mesh, fs.Cylinder((4.1, 2.1, 0), (0, 0, 1), 1.2))]


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
    assert {k: len(v) for k, v in double.report.node_sets.items()} == {k: len(v) for k, v in single.report.node_sets.items()}
    assert double.report.constraints == single.report.constraints and double.report.warnings == []
    # Every copy is split and doubled as the other is.
    plate_now, load_now = (corner_sets(double.mesh, double.mesh.groups[name].ids) for name in ("PLATE", "LOAD"))
    assert plate_now == load_now == corner_sets(single.mesh, single.mesh.cell_ids["triangle"])


def test_a_skin_on_part_of_a_shell_keeps_its_rim():
    points, triangles = plate(8, 4)
    left = triangles[points[triangles][:, :, 0].mean(axis=1) < 4]
    groups = {"LOAD": ("element", range(len(triangles) + 1, len(triangles) + len(left) + 1))}
    result = fs.crack(fs.Mesh(points, {"triangle": np.concatenate([triangles, left])}, groups=groups), fs.Plane((4.3, 2, 0), (1, 0.5, 0)))
    record = next(g for g in result.report.groups if g.name == "LOAD")
    assert record.measure_after == pytest.approx(16, rel=1e-12) and record.boundary_drift < 1e-12
    assert record.nodes_on_line > 0 and result.report.quality.after.minimum > 0.3
