# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of hexahedra, drilled and cracked, solved with CalculiX: Kirsch's hole, and a cantilever whose crack is tied
again, which must bend as it did."""

import numpy as np
import pytest
from mixed_meshes import grid, second_order
from test_calculix_decks import needs_ccx
from test_physics import equations, lip_pairs
from test_physics_hole import HOLE, LENGTH, RADIUS, THICKNESS, WIDTH, concentration, nodal_stresses
from calculix_runs import solve

import femscalpel as fs

MATERIAL = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n"


def block_deck(path, counts, size, label, step):
    """The mesh of a deck: a block of hexahedra with sets for the ends in x, and what follows its mesh."""
    points, cells = grid(counts)
    points *= np.array(size) / counts
    if "20" in label:
        points, cells = second_order(points, cells, "hexahedron")
    rows = ["*NODE, NSET=NALL", *("%d, %.15g, %.15g, %.15g" % (n + 1, *x) for n, x in enumerate(points))]
    rows.append(f"*ELEMENT, TYPE={label}, ELSET=ALL")
    for number, cell in enumerate(cells + 1):
        words = [str(number + 1), *map(str, cell)]
        rows.append(", ".join(words[:16]) + ("," if len(words) > 16 else ""))
        rows += [", ".join(words[16:])] if len(words) > 16 else []
    for name, x in (("LEFT", 0), ("RIGHT", size[0])):
        rows += [f"*NSET, NSET={name}", *(f"{n + 1}," for n in np.flatnonzero(np.abs(points[:, 0] - x) < 1e-9))]
    path.write_text("\n".join(rows) + "\n" + MATERIAL + step)
    return fs.read(path)


def reactions(folder):
    """{node: forces} of a .dat file."""
    found, inside = {}, False
    for line in (folder / "run.dat").read_text().splitlines():
        words = line.split()
        if words and not words[0].isdigit():
            inside = words[0] == "forces"
        elif inside and words:
            found[int(words[0])] = np.array(words[1:], float)
    return found


PULL = """*BOUNDARY
LEFT, 1, 1
NALL, 3, 3
1, 2, 2
*STEP
*STATIC
*BOUNDARY
RIGHT, 1, 1, 0.01
*NODE PRINT, NSET=RIGHT
RF
*EL FILE
S
*END STEP
"""


@needs_ccx
@pytest.mark.parametrize("label", ["C3D20R", "C3D20"])
def test_kirsch(tmp_path, label):
    """Plane strain, in which the stresses in the plane are those of the plane problem."""
    mesh = block_deck(tmp_path / "in.inp", (40, 20, 1), (LENGTH, WIDTH, THICKNESS), label, PULL)
    refined = fs.refine(mesh, HOLE, size=RADIUS / 7, gradation=0.4).mesh
    result = fs.drill(refined, HOLE, name="HOLE")
    drilled = result.mesh
    left = {k: len(c) for k, c in drilled.cells.items() if len(c)}
    assert left["hexahedron20"] > 400 and left["pyramid13"] > 10 and left["tetra10"] > 1000
    fs.write(drilled, tmp_path / "out.inp")
    text = (tmp_path / "out.inp").read_text()
    assert f"TYPE={label}" in text
    solve(tmp_path, text)
    force = sum(f[0] for f in reactions(tmp_path).values())
    gross = force / (WIDTH * THICKNESS)
    place = dict(zip(drilled.node_ids.tolist(), drilled.points))
    stress, top = max((s, n) for n, s in nodal_stresses(tmp_path, "XX").items() if n in place)
    factor, expected = stress / gross, concentration()
    print(
        f"\n{label}: {left}, minimum mean ratio {result.report.quality.after.minimum:.2f}, stress concentration "
        f"{factor:.4f}, exact {expected:.4f} ({100 * (factor / expected - 1):+.2f} %)"
    )
    assert factor == pytest.approx(expected, rel=0.03)
    assert abs(HOLE.distance(place[top])[0]) < 1e-9 and abs(place[top][0] - HOLE.origin[0]) < 0.1 * RADIUS


SIZE = np.array([10.0, 2.0, 2.0])
BEND = """*BOUNDARY
LEFT, 1, 3
*STEP
*STATIC
*CLOAD
RIGHT, 2, 10.
RIGHT, 3, -5.
*NODE PRINT, NSET=NALL
U
*END STEP
"""
TIE = "*TIE, NAME=GLUE, POSITION TOLERANCE=1e-6, ADJUST=NO\nCRACK_P, CRACK_N\n"


def tied(mesh):
    return TIE


def cantilever(folder, label, glue=tied, within=None, second_order=False):
    """How far displacements of a bar with an oblique crack are from those it had, relative to the largest, over the
    nodes that stayed where they were; the ratio of those of its end; the crack's report. `glue`: cards for a mesh."""
    mesh = block_deck(folder / "in.inp", (20, 4, 4), SIZE, label, BEND)
    before, _ = solve(folder, (folder / "in.inp").read_text())
    plane = fs.Plane((4.1, 1, 1), (1, 0.3, 0.2))
    result = fs.crack(mesh, plane, within=within, second_order=second_order)
    fs.write(result.mesh, folder / "out.inp")
    text = (folder / "out.inp").read_text()
    left = {k: len(c) for k, c in result.mesh.cells.items() if len(c)}
    solids = ("tetra10", "pyramid13", "hexahedron20") if "20" in label else ("tetra", "pyramid", "hexahedron")
    if second_order:
        solids = ("tetra10", "pyramid13", "hexahedron20", "hexahedron")
    assert left.keys() >= set(solids) and f"TYPE={label}" in text and text.count("*STEP\n") == 1
    after, _ = solve(folder, text.replace("*STEP\n", glue(result.mesh) + "*STEP\n"))
    place = dict(zip(result.mesh.node_ids.tolist(), result.mesh.points))
    was = dict(zip(mesh.node_ids.tolist(), mesh.points))
    still = [n for n in before if (place[n] == was[n]).all()]
    end = [n for n in still if was[n][0] == SIZE[0]]
    assert len(still) > 0.8 * len(before) and len(end) > 20
    largest = max(np.linalg.norm(u) for u in before.values())
    off = max(np.linalg.norm(after[n] - before[n]) for n in still) / largest
    ratio = np.mean([after[n][1] for n in end]) / np.mean([before[n][1] for n in end])
    print(f"\n{label}: {left}, off by {100 * off:.2f} % of the largest, deflection {ratio:.4f} of what it was")
    return off, ratio, result.report


@needs_ccx
@pytest.mark.parametrize("label", ["C3D20R", "C3D20"])
def test_a_tied_crack_is_not_felt(tmp_path, label):
    off, *_ = cantilever(tmp_path, label)
    assert off < 0.005


@needs_ccx
def test_an_open_crack_is_felt(tmp_path):
    """The same bar cracked from its pulled side to the middle. At the front both lips have the same nodes, of which
    *TIE makes equations without a term; lips are tied node by node instead."""
    half = fs.HalfPlane((4.1, 1, 1), (0, -1, 0))
    (tmp_path / "tied").mkdir()
    (tmp_path / "open").mkdir()
    off, *_ = cantilever(tmp_path / "tied", "C3D20R", lambda mesh: equations(lip_pairs(mesh)), half)
    assert off < 0.005
    _, ratio, _ = cantilever(tmp_path / "open", "C3D20R", lambda mesh: "", half)
    assert 1.05 < ratio < 3


@needs_ccx
@pytest.mark.parametrize("label", ["C3D8", "C3D8I", "C3D8R"])
def test_tetrahedra_of_first_order_are_stiffer(tmp_path, label):
    """The bar deflects 0.914, 0.898 and 0.870 of what it did where these became C3D4 along half of its length: that is
    what such elements are, and the report says so."""
    _, ratio, report = cantilever(tmp_path, label)
    assert 0.85 < ratio < 0.95
    assert any("stiffer in bending" in w for w in report.warnings)


@needs_ccx
@pytest.mark.parametrize("label, low, high", [("C3D8I", 0.998, 1.002), ("C3D8", 1.0, 1.05), ("C3D8R", 0.93, 1.0)])
def test_a_second_order_band_is_not_felt(tmp_path, label, low, high):
    """It is exact, as C3D8I nearly are; C3D8 are too stiff, C3D8R too soft."""
    _, ratio, report = cantilever(tmp_path, label, second_order=True)
    assert low < ratio < high
    assert not any("stiffer" in w for w in report.warnings)
