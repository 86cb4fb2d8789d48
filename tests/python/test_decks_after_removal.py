# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decks that are drilled and slotted run in CalculiX with the supports, loads, ties and requests they came with."""

import re
import shutil
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box

pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")

FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # CalculiX's S1 to S4


def faces_where(mesh, ids, holds):
    """Lines "element, S.." of the element faces all of whose nodes are where `holds` says."""
    lines = []
    for number, cell in zip(mesh.cell_ids["tetra"].tolist(), mesh.cells["tetra"]):
        if number in ids:
            lines += [
                f"{number}, S{k + 1}" for k, face in enumerate(FACES) if holds(mesh.points[cell[list(face)]]).all()
            ]
    return "\n".join(lines)


def blocks(path):
    """Two blocks tied at x = 6, held at one end, pulled at the other, with supports and loads by number as well."""
    left, right = grid_box((10, 7, 6), (6, 4, 3)), grid_box((8, 6, 5), (5, 4, 3))
    points = np.concatenate([left.points, right.points + (6, 0, 0)])
    cells = np.concatenate([left.cells["tetra"], right.cells["tetra"] + left.node_count])
    mesh = fs.Mesh(points, {"tetra": cells})
    ids = mesh.cell_ids["tetra"]
    first = set(ids[: len(left.cells["tetra"])].tolist())
    second = set(ids.tolist()) - first
    mesh.add_group("ALL", "element", ids)
    mesh.add_group("LEFT", "element", list(first))
    mesh.add_group("RIGHT", "element", list(second))
    x = points.T
    mesh.add_group("HELD", "node", mesh.node_ids[x[0] == 0])
    mesh.add_group("PULLED", "node", mesh.node_ids[x[0] == 11])
    mesh.add_group("INSIDE", "node", mesh.node_ids[np.hypot(x[0] - 3, x[1] - 2) < 0.5])
    fs.write(mesh, path)
    inside = int(mesh.groups["INSIDE"].ids[0])
    line = [n for n in mesh.node_ids[(x[2] == 0) & (x[1] == 0) & (x[0] < 6)].tolist()]
    with open(path, "a") as out:
        out.write(
            "*SURFACE, NAME=SLAVE\n"
            + faces_where(mesh, first, lambda p: p[:, 0] == 6)
            + "\n*SURFACE, NAME=MASTER\n"
            + faces_where(mesh, second, lambda p: p[:, 0] == 6)
            + "\n*SURFACE, NAME=TOP\n"
            + faces_where(mesh, set(ids.tolist()), lambda p: p[:, 2] == 3)
            + "\n*TIE, NAME=GLUE, POSITION TOLERANCE=0.01\nSLAVE, MASTER\n"
            "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n"
            "*SOLID SECTION, ELSET=LEFT, MATERIAL=STEEL\n*SOLID SECTION, ELSET=RIGHT, MATERIAL=STEEL\n"
            "*BOUNDARY\nHELD, 1, 3\n"
            + "".join(f"{n}, 2, 2\n" for n in line)
            + "*STEP\n*STATIC\n*CLOAD\nPULLED, 1, 10.\n"
            + f"{inside}, 3, 2.\n"
            + "*DSLOAD\nTOP, P, 1.\n*DLOAD\nALL, GRAV, 9810., 0., 0., -1.\n"
            "*NODE PRINT, NSET=HELD, TOTALS=ONLY\nRF\n*NODE PRINT, NSET=INSIDE\nU\n*NODE PRINT, NSET=PULLED\nU\n*EL "
            "PRINT, ELSET=ALL, TOTALS=ONLY\nEVOL\n*END STEP\n"
        )
    return fs.read(path)


@pytest.fixture(scope="module")
def deck(tmp_path_factory):
    return blocks(tmp_path_factory.mktemp("deck") / "blocks.inp")


def solve(mesh, folder, name):
    """(sum of forces at HELD, largest displacement of PULLED along x, volume) by CalculiX."""
    fs.write(mesh, folder / f"{name}.inp")
    done = subprocess.run(["ccx", name], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0 and "Job finished" in done.stdout and "*ERROR" not in done.stdout, done.stdout[-2000:]
    text = (folder / f"{name}.dat").read_text()
    force = [float(f) for f in re.search(r"total force.*HELD.*\n\s*\n(.*)", text).group(1).split()]
    pulled = text[re.search(r"displacements.*PULLED", text).end() :]
    rows = [line.split() for line in pulled.split("total")[0].splitlines()]
    stretch = max(float(row[1]) for row in rows if len(row) == 4)
    volume = float(re.search(r"total volume.*ALL.*\n\s*\n(.*)", text).group(1))
    return np.array(force), stretch, volume


HOLES = [
    fs.Cylinder((3, 2, 0), (0, 0, 1), 0.9),
    fs.Cylinder((6, 0, 1.5), (0, 1, 0), 0.7),
]  # in the left block; through the tie
SLOT = fs.Plane((8.6, 0, 0), (1, 0.1, 0))


def test_drilled_and_slotted_deck_runs(deck, tmp_path):
    before = solve(deck, tmp_path, "before")
    drilled = fs.drill(deck, HOLES)
    slotted = fs.cut(drilled.mesh, SLOT, width=0.4, bottom=fs.Plane((0, 0, 1.3), (0, 0, -1)))
    after = solve(slotted.mesh, tmp_path, "after")

    volume = sum(
        g.measure_before - g.measure_after for r in (drilled, slotted) for g in r.report.groups if g.name == "ALL"
    )
    assert before[2] == pytest.approx(11 * 4 * 3, rel=1e-5) and after[2] == pytest.approx(before[2] - volume, rel=1e-5)
    # The pull is whole; pressure and weight are those of what is left; the load in the hole is gone.
    area = sum(
        g.measure_before - g.measure_after for r in (drilled, slotted) for g in r.report.groups if g.name == "TOP"
    )
    assert area > np.pi * 0.8**2
    assert (
        after[0][0]
        == pytest.approx(before[0][0], rel=1e-6)
        == pytest.approx(-10 * len(deck.groups["PULLED"].ids), rel=1e-6)
    )
    lost = before[0][2] - after[0][2]
    assert lost == pytest.approx(1 * area + 7.8e-9 * 9810 * volume - 2, rel=1e-5)
    # Weaker than before.
    assert after[1] > 1.05 * before[1]

    warnings = "\n".join(drilled.report.warnings)
    assert re.search(r"blocks.inp:\d+: \*CLOAD names node \d+, which was removed, and with it the load", warnings)
    assert re.search(r"blocks.inp:\d+: \*NODEPRINT names node set 'INSIDE', which lost all its members", warnings)
    assert "group 'INSIDE' loses all its" in warnings and "TIE" not in warnings
    assert {g.name: g.status for g in drilled.report.groups}["INSIDE"] == "became empty"
    with pytest.raises(fs.Error, match="strict=True.*\n.*blocks.inp:"):
        fs.drill(deck, HOLES, strict=True)
    # The second hole alone names nothing.
    fs.drill(deck, HOLES[1], strict=True)
