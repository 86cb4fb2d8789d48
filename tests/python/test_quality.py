# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic

REGULAR = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]


def test_mean_ratio():
    mesh = fs.Mesh(REGULAR + [[9, 9, 9]], {"tetra": [[0, 1, 2, 3], [1, 0, 2, 3]], "triangle": [[0, 1, 2]], "line": [[0, 4]]})
    ratios = fs.mean_ratio(mesh)
    assert set(ratios) == {"tetra", "triangle", "line"}
    assert sorted(ratios["tetra"]) == pytest.approx([-1, 1])
    assert ratios["triangle"] == pytest.approx([1])


def test_measure():
    mesh = fs.Mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]],
                   {"tetra": [[0, 1, 2, 3]], "triangle": [[0, 1, 2]], "line": [[0, 1]], "vertex": [[0]]})
    sizes = {name: values.tolist() for name, values in fs.measure(mesh).items()}
    assert sizes == {"tetra": pytest.approx([4 / 3]), "triangle": pytest.approx([2]), "line": pytest.approx([2]), "vertex": [0]}
    box = quadratic(grid_box())
    assert fs.measure(box)["tetra10"].sum() == pytest.approx(120)
    assert np.all(fs.mean_ratio(box)["tetra10"] > 0)


UNIT = {
    "hexahedron": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    "wedge": [[0, 0, 0], [1, 0, 0], [0.5, 0.75**0.5, 0], [0, 0, 1], [1, 0, 1], [0.5, 0.75**0.5, 1]],
    "pyramid": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.5**0.5]],
    "tetra": REGULAR,
    "triangle": [[0, 0, 0], [1, 0, 0], [0.5, 0.75**0.5, 0]],
    "quad": [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]],
}
ANGLES = {"hexahedron": 90, "wedge": 60, "pyramid": np.degrees(np.arctan(2**0.5)), "tetra": np.degrees(np.arccos(1 / 3)),
          "triangle": 60, "quad": 90}


@pytest.mark.parametrize("shape", UNIT)
def test_regular_elements(shape):
    points = np.array(UNIT[shape], float)
    order = [1, 0, 2, 3] if shape == "tetra" and fs.mean_ratio(fs.Mesh(points, {shape: [[0, 1, 2, 3]]}))[shape][0] < 0 \
        else list(range(len(points)))
    mesh = fs.Mesh(points, {shape: [order]})
    assert fs.scaled_jacobian(mesh)[shape] == pytest.approx([1])
    assert fs.smallest_angle(mesh)[shape] == pytest.approx([ANGLES[shape]])


def test_scaled_jacobian_and_angle_of_bad_elements():
    flat = fs.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1e-3]], {"tetra": [[0, 1, 2, 3], [1, 0, 2, 3]], "line": [[0, 1]]})
    assert fs.scaled_jacobian(flat)["tetra"][0] == pytest.approx(-fs.scaled_jacobian(flat)["tetra"][1])
    assert 0 < fs.scaled_jacobian(flat)["tetra"][0] < 2e-3
    assert fs.smallest_angle(flat)["tetra"] == pytest.approx([np.degrees(1e-3)] * 2, abs=1e-3)
    assert fs.scaled_jacobian(flat)["line"] == [1] and np.isnan(fs.smallest_angle(flat)["line"]).all()
