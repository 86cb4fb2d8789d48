# SPDX-License-Identifier: LGPL-2.1-or-later
"""A periodic cell is cracked through its matching sides: CalculiX's solution stays that of the periodic cell."""

import shutil
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic

STRETCH, POISSON = 1e-3, 0.3


def periodic_cell(path, order):
    """Unit cube: nodes of the side y = 1 move as their partners at y = 0, and STRETCH more along y, told by a reference
    node."""
    mesh = grid_box((5, 4, 5), (1.0, 1.0, 1.0))
    if order == 2:
        mesh = quadratic(mesh)
    points, ids = mesh.points, mesh.node_ids
    mesh.add_group("ALL", "element", np.concatenate(list(mesh.cell_ids.values())))
    mesh.add_group("N", "node", ids)
    fs.write(mesh, path)
    number = {tuple(np.round(p, 9)): int(n) for p, n in zip(points, ids)}
    reference = int(ids.max()) + 1
    lines = [f"*NODE, NSET=REF\n{reference}, 0., 3., 0.\n*EQUATION"]
    for (x, y, z), n in number.items():
        if y == 1:
            lines += [
                f"3\n{n}, {dof}, 1., {number[x, 0.0, z]}, {dof}, -1., {reference}, {dof}, -1." for dof in (1, 2, 3)
            ]
    lines += [
        "*MATERIAL, NAME=M\n*ELASTIC\n1000., %g\n*SOLID SECTION, ELSET=ALL, MATERIAL=M" % POISSON,
        f"*BOUNDARY\n{reference}, 1, 1\n{reference}, 3, 3\n{number[0, 0, 0]}, 1, 3\n{number[1, 0, 0]}, 3, 3",
        f"*STEP\n*STATIC\n*BOUNDARY\n{reference}, 2, 2, {STRETCH}\n*NODE PRINT, NSET=N\nU\n*END STEP",
    ]
    with open(path, "a") as out:
        out.write("\n".join(lines) + "\n")
    return fs.read(path)


def displacements(mesh, folder, name):
    fs.write(mesh, folder / f"{name}.inp")
    done = subprocess.run(
        ["ccx", name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100
    )
    assert done.returncode == 0 and "Job finished" in done.stdout and "*ERROR" not in done.stdout, done.stdout[-2000:]
    rows = [line.split() for line in (folder / f"{name}.dat").read_text().splitlines()]
    table = {int(r[0]): np.array(r[1:], float) for r in rows if len(r) == 4 and r[0].isdigit()}
    kept = [i for i, n in enumerate(mesh.node_ids.tolist()) if n in table]
    assert len(kept) >= mesh.node_count - 1  # all but the reference node
    return mesh.points[kept], np.array([table[n] for n in mesh.node_ids[kept].tolist()])


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
@pytest.mark.parametrize("order", [1, 2])
def test_a_cracked_periodic_cell_stretches_as_the_whole_one(tmp_path, order):
    mesh = periodic_cell(tmp_path / "cell.inp", order)
    # Stretching leaves no stress on a crack that runs along it: the solution stays linear, if the sides stay related.
    front = fs.HalfPlane((0.53, 0, 0), (-1, 0, 0))
    for name, tool in (
        ("oblique", fs.Plane((0.5, 0.5, 0.47), (0.1, 0, 1))),
        ("on_nodes", fs.Plane((0.5, 0.5, 0.6), (0, 0, 1))),
    ):
        result = fs.crack(mesh, tool, within=front, name="CRACK", strict=True)
        assert not any("EQUATION" in w for w in result.report.warnings)
        assert result.report.nodes_doubled > 5
        points, u = displacements(result.mesh, tmp_path, name)
        exact = STRETCH * points * (-POISSON, 1, -POISSON)
        assert np.abs(u - exact).max() < 1e-5 * STRETCH, name
