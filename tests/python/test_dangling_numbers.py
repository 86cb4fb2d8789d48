# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cards that name what is not there: told when the deck is read or written, and nothing new becomes what they name."""

import re
import shutil
import warnings

import numpy as np
import pytest
from calculix_runs import solve

import femscalpel as fs

PLACES = np.array([(x, y, z) for x in range(7) for y in range(4) for z in range(3)], float) * 10
TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
PLANE = fs.Plane((31, 0, 0), (1, 0.2, 0.1)), fs.HalfPlane((31, 15, 10), (0, 0, 1))
needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")


def deck(model="", loads=""):
    """A bar of 84 nodes and 216 tetrahedra, held on the left, pulled on the right."""
    number = np.arange(84).reshape(7, 4, 3) + 1
    lines = ["*NODE, NSET=NALL"] + [f"{n}, {x:g}, {y:g}, {z:g}" for n, (x, y, z) in enumerate(PLACES, 1)]
    lines.append("*ELEMENT, TYPE=C3D4, ELSET=EALL")
    e = 0
    for i, j, k in np.ndindex(6, 3, 2):
        at = [number[i + a, j + b, k + c] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for corners in TETRAHEDRA:
            e += 1
            lines.append(f"{e}, " + ", ".join(str(at[c]) for c in corners))
    for name, i in (("LEFT", 0), ("RIGHT", 6)):
        lines += [f"*NSET, NSET={name}", *(f"{n}," for n in number[i].ravel())]
    lines += ["*MATERIAL, NAME=S", "*ELASTIC", "210000., 0.3", "*EXPANSION, ZERO=0.", "1.e-5"]
    lines += ["*SOLID SECTION, ELSET=EALL, MATERIAL=S", "*BOUNDARY", "LEFT, 1, 3"]
    steps = ["*STEP", "*STATIC", "*CLOAD", "RIGHT, 3, -1."]
    text = "\n".join(lines) + f"\n{model}" + "\n".join(steps) + f"\n{loads}*NODE PRINT, NSET=NALL\nU\n*END STEP\n"
    return text


def read(tmp_path, text):
    (tmp_path / "deck.inp").write_text(text)
    return fs.read(tmp_path / "deck.inp")


def displacements(tmp_path, mesh):
    fs.write(mesh, tmp_path / "out.inp")
    return solve(tmp_path, (tmp_path / "out.inp").read_text())[0]


CASES = {
    "boundary": ("*BOUNDARY\n90, 1, 3\n", ""),
    "cload": ("", "*CLOAD\n100, 3, -500.\n"),
    "dload": ("", "*DLOAD\n230, P1, 300.\n"),
    "equation": ("*EQUATION\n2\n90, 2, 1., 84, 2, -1.\n", ""),
}


@pytest.mark.parametrize("model, loads", CASES.values(), ids=CASES)
def test_nobody_gets_what_nobody_had(tmp_path, model, loads):
    text = deck(model, loads)
    with pytest.warns(UserWarning, match="that the deck does not define; kept as it is"):
        mesh = read(tmp_path, text)
    line = 1 + text.splitlines().index((model + loads).splitlines()[-1])
    (told,) = mesh.input_warnings
    assert f"deck.inp:{line}: *" in told and "that the deck does not define" in told
    result = fs.crack(mesh, PLANE[0], within=PLANE[1])
    assert result.mesh.node_count > mesh.node_count and len(result.mesh.cell_ids["tetra"]) > 216
    absent = int(re.search("names (?:node|element) ([0-9]+) ", told)[1])
    assert absent not in (result.mesh.cell_ids["tetra"] if loads.startswith("*DLOAD") else result.mesh.node_ids)
    assert any(f"deck.inp:{line}: *" in w and "passes over it now" in w for w in result.report.warnings)
    with pytest.raises(fs.Error, match="that the deck does not define"):
        fs.crack(mesh, PLANE[0], within=PLANE[1], strict=True)


@needs_ccx
@pytest.mark.parametrize("model, loads", CASES.values(), ids=CASES)
def test_the_solution_is_that_without_the_card(tmp_path, model, loads):
    with_card = fs.crack(read(tmp_path, deck(model, loads)), PLANE[0], within=PLANE[1]).mesh
    without = fs.crack(read(tmp_path, deck()), PLANE[0], within=PLANE[1]).mesh
    assert np.array_equal(with_card.points, without.points)
    a, b = displacements(tmp_path, with_card), displacements(tmp_path, without)
    u = np.array([a[n] for n in with_card.node_ids.tolist()])
    v = np.array([b[n] for n in without.node_ids.tolist()])
    assert abs(u - v).max() <= 1e-6 * abs(v).max()


def test_temperatures_from_a_file_have_no_new_nodes(tmp_path):
    start = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 0.\n"
    mesh = read(tmp_path, deck(start, "*TEMPERATURE, FILE=heat.frd, BSTEP=1\n"))
    result = fs.crack(mesh, PLANE[0], within=PLANE[1])
    assert [w for w in result.report.warnings if "*TEMPERATURE, FILE takes values by number from results" in w]
    with pytest.raises(fs.Error, match="results of the mesh as it was"):
        fs.crack(mesh, PLANE[0], within=PLANE[1], strict=True)


def test_sets_that_are_gone_are_told(tmp_path):
    text = deck()
    mesh = read(tmp_path, text)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fs.write(mesh, tmp_path / "out.inp")
    mesh.remove_group("RIGHT")
    line = 1 + text.splitlines().index("RIGHT, 3, -1.")
    with pytest.warns(UserWarning, match=rf"out.inp: node set 'RIGHT' is not .*deck.inp:{line} \(\*CLOAD\) names it"):
        fs.write(mesh, tmp_path / "out.inp")
    mesh.add_group("RIGHT", "node", [84])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fs.write(mesh, tmp_path / "out.inp")
