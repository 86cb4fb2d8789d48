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
