# SPDX-License-Identifier: LGPL-2.1-or-later
"""Supports given node by node: which new nodes get them."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box

GRADIENT = np.array([[1.0, 2.0, -1.0], [0.5, -1.0, 1.0], [2.0, 0.0, 1.0]]) * 1e-3


def held_on_two_sides(path):
    """A block whose sides y = 0 and z = 4 are held as in a linear field."""
    mesh = grid_box((6, 4, 4), (6.0, 4.0, 4.0))
    text = "*NODE\n" + "".join(f"{i}, {x}, {y}, {z}\n" for i, (x, y, z) in zip(mesh.node_ids, mesh.points))
    text += "*ELEMENT, TYPE=C3D4, ELSET=ALL\n"
    for i, c in zip(mesh.cell_ids["tetra"], mesh.cells["tetra"]):
        text += f"{i}, {', '.join(map(str, mesh.node_ids[c]))}\n"
    held = (mesh.points[:, 1] == 0) | (mesh.points[:, 2] == 4)
    text += "*MATERIAL, NAME=M\n*ELASTIC\n1, 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n"
    for i, x in zip(mesh.node_ids[held], mesh.points[held]):
        text += "".join(f"{i}, {d + 1}, {d + 1}, {v:.17g}\n" for d, v in enumerate(GRADIENT @ x))
    path.write_text(text + "*END STEP\n")
    return fs.read(path)


@pytest.mark.parametrize("seed", range(6))
def test_no_node_inside_is_held_and_those_outside_as_where_they_are(tmp_path, seed):
    rng = np.random.default_rng(seed)
    mesh = held_on_two_sides(tmp_path / "held.inp")
    normal = rng.normal(size=3) + (3, 0, 0)
    result = fs.crack(mesh, fs.Plane((3.4, 0.5, 3.5), normal), within=fs.Disk((3.4, 0.5, 3.5), 1.5))
    fs.write(result.mesh, tmp_path / "out.inp")
    lines = (tmp_path / "out.inp").read_text().split("*BOUNDARY\n")[1].split("*")[0].split("\n")
    given = []  # node, freedom, value
    for fields in (line.split(",") for line in lines if line.strip()):
        node, first, last, value = fields + [""] * (4 - len(fields))
        for freedom in range(int(first), int(last or first) + 1):
            given.append((int(node), freedom, float(value or 0)))
    given = np.array(given)
    places = dict(zip(result.mesh.node_ids, result.mesh.points))
    at = np.array([places[int(n)] for n in given[:, 0]])
    assert ((at[:, 1] == 0) | (at[:, 2] == 4) | (at[:, 0] % 6 == 0)).all()
    wanted = np.einsum("ij,ij->i", GRADIENT[given[:, 1].astype(int) - 1], at)
    assert np.allclose(given[:, 2], wanted, rtol=0, atol=1e-12)
    new = np.setdiff1d(given[:, 0], mesh.node_ids)
    assert len(new) > 0
