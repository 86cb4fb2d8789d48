# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces that a deck defines by helper sets, one for each face label, as CAE systems write them."""

import re
import shutil
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box

FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # CalculiX's S1 to S4
PLANE = fs.Plane((3.1, 2.5, 2), (1, 0.2, 0.3))


def deck(path, helpers):
    """A box under pressure on its top and, above z = 1, its side x = 6; the surface by helper sets or by numbers."""
    mesh = grid_box()
    x, cells, ids = mesh.points, mesh.cells["tetra"], mesh.cell_ids["tetra"]
    mesh.add_group("ALL", "element", ids)
    mesh.add_group("HELD", "node", mesh.node_ids[x[:, 2] == 0])
    fs.write(mesh, path)
    on = [
        (int(i), k + 1)
        for i, c in zip(ids, cells)
        for k, f in enumerate(FACES)
        if (x[c[list(f)]][:, 2] == 4).all() or ((x[c[list(f)]][:, 0] == 6) & (x[c[list(f)]][:, 2] >= 1)).all()
    ]
    lines = []
    if helpers:
        for k in range(1, 5):
            lines += [f"*ELSET, ELSET=_LOADED_S{k}, INTERNAL"] + [f"{i}," for i, label in on if label == k]
    lines.append("*SURFACE, NAME=LOADED, TYPE=ELEMENT")
    labels = sorted({label for _, label in on})
    lines += [f"_LOADED_S{k}, S{k}" for k in labels] if helpers else [f"{i}, S{k}" for i, k in on]
    with open(path, "a") as out:
        out.write(
            "\n".join(lines) + "\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n"
            "*BOUNDARY\nHELD, 1, 3\n*STEP\n*STATIC\n*DSLOAD\nLOADED, P, 2.\n*NODE PRINT, NSET=HELD, TOTALS=ONLY\nRF\n"
            "*END STEP\n"
        )
    return fs.read(path)


def reaction(mesh, folder, name):
    fs.write(mesh, folder / f"{name}.inp")
    done = subprocess.run(
        ["ccx", name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100
    )
    assert done.returncode == 0 and "Job finished" in done.stdout and "*ERROR" not in done.stdout, done.stdout[-2000:]
    text = (folder / f"{name}.dat").read_text()
    return np.array(re.search(r"total force.*HELD.*\n\s*\n(.*)", text).group(1).split(), float)


def test_helper_sets_cost_neither_quality_nor_elements(tmp_path):
    plain, helped = (fs.crack(deck(tmp_path / f"{h}.inp", h), PLANE, name="CRACK") for h in (False, True))
    assert np.array_equal(plain.mesh.points, helped.mesh.points)
    assert plain.report.quality.after.minimum == helped.report.quality.after.minimum
    assert plain.report.warnings == helped.report.warnings


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_the_solver_loads_the_same_surface(tmp_path):
    mesh = deck(tmp_path / "deck.inp", True)
    exact = np.array((2.0 * 5 * 3, 0, 2.0 * 6 * 5))
    assert np.allclose(reaction(mesh, tmp_path, "before"), exact, atol=1e-3)
    below = fs.HalfPlane((0, 0, 2), (0, 0, -1))
    for name, result in (
        ("crack", fs.crack(mesh, PLANE, name="CRACK", within=below)),
        ("refine", fs.refine(mesh, PLANE, size=0.6)),
    ):
        assert np.allclose(reaction(result.mesh, tmp_path, name), exact, atol=1e-3), name
        back = fs.read(tmp_path / f"{name}.inp")
        assert {g.name for g in back.groups.all()} >= {"_LOADED_S1", "_LOADED_S2", "_LOADED_S3", "_LOADED_S4"}
