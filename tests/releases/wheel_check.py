# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an installed wheel must do where nothing but NumPy is beside it: crack the demo's mesh, with MED and .inp files,
join two blocks by the program that fills cavities, read a face of a STEP file. Prints a line.

    python wheel_check.py caisson.npz face.step
"""

import sys
import tempfile
import time
from pathlib import Path

start = time.time()
import numpy as np  # noqa: E402

import femscalpel as fs  # noqa: E402

CUBE = np.array([(0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7)])


def block(start, size, counts, name):
    """A block of tetrahedra, all in the group `name`."""
    x, y, z = (np.linspace(0, s, n + 1) + a for a, s, n in zip(start, size, counts))
    points = np.array([(a, b, c) for c in z for b in y for a in x])
    nx, ny = counts[0] + 1, counts[1] + 1
    corners = [
        [i + a + nx * (j + b + ny * (k + c)) for c in (0, 1) for b in (0, 1) for a in (0, 1)]
        for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])
    ]  # fmt: skip
    cells = np.array(corners)[:, CUBE].reshape(-1, 4)
    return fs.Mesh(points, {"tetra": cells}, groups={name: ("element", np.arange(1, len(cells) + 1))})


def example(path):
    """The mesh that resources/demo/make_example.py has written."""
    parts = {"cells": {}, "ids": {}, "group": {}}
    with np.load(path) as arrays:
        for key in arrays.files:
            what, *names = key.split(" ", 2)
            if what != "points":
                parts[what][names[-1]] = (names[0], arrays[key]) if what == "group" else arrays[key]
        return fs.Mesh(arrays["points"], parts["cells"], cell_ids=parts["ids"], groups=parts["group"])


def main(caisson, face):
    mesh = example(caisson)
    result = fs.crack(mesh, fs.Plane((200, -50, 430), (-0.33, -0.30, 1)))
    assert result.report.nodes_doubled > 0 and len(result.mesh.groups) > len(mesh.groups)
    took = time.time() - start
    with tempfile.TemporaryDirectory() as folder:
        for name in ("cracked.med", "cracked.inp"):
            fs.write(result.mesh, Path(folder) / name)
            again = fs.read(Path(folder) / name)
            assert (again.points == result.mesh.points).all() and set(result.mesh.groups) <= set(again.groups), name
    base = block((0, 0, 0), (4, 4, 2), (8, 8, 4), "BASE")
    assert fs.merge(base, block((1, 1, 2), (1.5, 1.5, 1), (4, 4, 2), "BOSS")).mesh.node_count > base.node_count
    assert fs.crack(base, fs.Face(face)).report.nodes_doubled > 0
    print(
        f"wheel: femscalpel {fs.__version__}, NumPy {np.__version__}, Python {sys.version.split()[0]}: "
        f"{mesh.node_count} nodes before, {result.mesh.node_count} after, in {took:.1f} s; MED, .inp, filler, STEP work"
    )


main(*sys.argv[1:])
