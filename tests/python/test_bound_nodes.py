# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pyramids beside nodes that a deck's cards make dependent (CalculiX takes their tip for four nodes), loads that cards
give twice, and sets whose order counts."""

import os
import re
import subprocess

import numpy as np
import pytest

import femscalpel as fs
from calculix_runs import solve
from mixed_meshes import grid, second_order

TESTS = "/usr/share/doc/calculix-ccx-test/examples/test"


def calculix_deck(name):
    """Path of one of CalculiX's own decks, which Debian packs in some releases; skips the test where there is none."""
    for path in (f"{TESTS}/{name}.inp", f"{TESTS}/{name}.inp.gz"):
        if os.path.exists(path):
            return path
    return pytest.skip("Debian package calculix-ccx-test is not installed")


def cards(points, cells, label, first=0, start=0):
    """*NODE and *ELEMENT of a block, numbered from there on."""
    rows = ["*NODE, NSET=NALL"] + ["%d, %.12g, %.12g, %.12g" % (first + i + 1, *x) for i, x in enumerate(points)]
    rows.append(f"*ELEMENT, TYPE={label}, ELSET=EALL")
    for e, c in enumerate(cells):
        words = [str(start + e + 1)] + [str(first + i + 1) for i in c]
        rows += [", ".join(words[:16]) + ("," if len(words) > 16 else "")]
        rows += [", ".join(words[16:])] if len(words) > 16 else []
    return "\n".join(rows) + "\n"


def block(counts, label):
    points, cells = grid(counts)
    return second_order(points, cells, "hexahedron") if "20" in label else (points, cells)


def tied_blocks(label, axis):
    """Two blocks tied at a plane across the axis, with nodes of their own, and pulled in z: the strain is uniform."""
    counts = ((4, 4, 8), (4, 4, 3)) if axis == 2 else ((4, 4, 20), (4, 3, 20))
    a, first = block(counts[0], label)
    b, second = block(counts[1], label)
    at, height = counts[0][axis], 11.0 if axis == 2 else 20.0
    b[:, axis] += at
    text = cards(a, first, label) + cards(b, second, label, len(a), len(first))
    text += "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n"
    slave, master = ("S2", "S1") if axis == 2 else ("S5", "S3")
    high, low = ([4, 5, 6, 7], [0, 1, 2, 3]) if axis == 2 else ([2, 3, 6, 7], [0, 1, 4, 5])
    text += "*SURFACE, NAME=SLAVE\n"
    text += "".join(f"{e + 1}, {slave}\n" for e, c in enumerate(first) if (a[c[high]][:, axis] == at).all())
    text += "*SURFACE, NAME=MASTER\n"
    on = [len(first) + e + 1 for e, c in enumerate(second) if (b[c[low]][:, axis] == at).all()]
    text += "".join(f"{e}, {master}\n" for e in on)
    text += "*TIE, NAME=T, POSITION TOLERANCE=0.01, ADJUST=NO\nSLAVE, MASTER\n"
    both = np.concatenate([a, b])
    slaves = (both[:, axis] == at) & (np.arange(len(both)) < len(a))
    for name, z in (("FIX", 0), ("PULL", height)):
        text += f"*NSET, NSET={name}\n" + "".join(f"{n + 1},\n" for n in np.flatnonzero((both[:, 2] == z) & ~slaves))
    return text + (
        f"*BOUNDARY\nFIX, 1, 3\n*STEP\n*STATIC\n*BOUNDARY\nPULL, 3, 3, {1e-3 * height}\n"
        "*NODE PRINT, NSET=NALL\nU\n*END STEP\n"
    )


@pytest.mark.parametrize(
    "label, axis, at", [("C3D8", 1, (2, 2, 9.5)), ("C3D8", 1, (2, 3.9, 10.5)), ("C3D20R", 2, (2, 2, 3))]
)
def test_pyramids_beside_a_tie(tmp_path, label, axis, at):
    """Their tips in the first two cases, edges of their bases in the third."""
    (tmp_path / "in.inp").write_text(tied_blocks(label, axis))
    mesh = fs.refine(fs.read(tmp_path / "in.inp"), near=at, size=0.7).mesh
    assert any(kind.startswith("pyramid") for kind in mesh.cells)
    fs.write(mesh, tmp_path / "out.inp")
    displacements, _ = solve(tmp_path, (tmp_path / "out.inp").read_text())
    place = dict(zip(mesh.node_ids.tolist(), mesh.points))
    off = max(abs(u[2] - 1e-3 * place[n][2]) for n, u in displacements.items())
    assert off < 1e-7 * 0.011 + 1e-9


@pytest.mark.parametrize("axis, at", [(1, (2, 2, 10)), (1, (2, 1.5, 10))])
def test_second_order_beside_a_tie(tmp_path, axis, at):
    """Of the slave surface the nodes of the faces are dependent, not all of the elements."""
    (tmp_path / "in.inp").write_text(tied_blocks("C3D8", axis))
    part = fs.Disk(at, 1.4)
    plane, options = fs.Plane(at, (1, 0.2, 0)), dict(second_order=True, refine=False)
    result = fs.crack(fs.read(tmp_path / "in.inp"), plane, within=part, **options)
    mesh = result.mesh
    fs.write(mesh, tmp_path / "out.inp")
    displacements, _ = solve(tmp_path, (tmp_path / "out.inp").read_text())
    place = dict(zip(mesh.node_ids.tolist(), mesh.points))
    assert max(abs(u[2] - 1e-3 * place[n][2]) for n, u in displacements.items()) < 1e-8


def test_pyramids_beside_cyclic_symmetry(tmp_path):
    """The four rigid-body modes of a disk's segment stay near zero."""
    mesh = fs.read(calculix_deck("segment"))
    centre = (mesh.points.min(axis=0) + mesh.points.max(axis=0)) / 2 + (0, 0.2, 0)
    found = []
    for m in (mesh, fs.refine(mesh, near=centre, size=0.08).mesh):
        fs.write(m, tmp_path / "run.inp")
        subprocess.run(["ccx", "run"], cwd=tmp_path, capture_output=True, check=True)
        text = (tmp_path / "run.dat").read_text()
        found.append([float(f) for f in re.findall(r"(?m)^ +1 +[1-5] +\S+ +\S+ +(\S+) +\S+$", text)[:5]])
    assert max(found[1][:4]) < 20
    assert found[1][4] == pytest.approx(found[0][4], rel=0.01)


def column(load):
    """Hexahedra held at the bottom, with a load on top."""
    points, cells = grid((2, 2, 6))
    top = [e + 1 for e, c in enumerate(cells) if points[c[4]][2] == 6]
    return (
        cards(points, cells, "C3D8")
        + "*ELSET, ELSET=TOP\n"
        + "".join(f"{e},\n" for e in top)
        + "*NSET, NSET=FIX\n"
        + "".join(f"{n + 1},\n" for n in np.flatnonzero(points[:, 2] == 0))
        + "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*BOUNDARY\nFIX, 1, 3\n"
        + f"*STEP\n*STATIC\n*DLOAD\n{load(top)}*NODE PRINT, NSET=FIX, TOTALS=ONLY\nRF\n*END STEP\n"
    )


@pytest.mark.parametrize(
    "load",
    [
        lambda top: "".join(f"{e}, P2, 1.\n{e}, P2, 1.\n" for e in top),
        lambda top: "TOP, P2, 1.\nTOP, P2, 1.\n",
        lambda top: f"TOP, P2, 1.\n{top[0]}, P2, 1.\n{top[0]}, P2, 1.\n",
    ],
    ids=["elements", "set", "set and elements"],
)
def test_a_load_given_twice_stays_twice(tmp_path, load):
    (tmp_path / "in.inp").write_text(column(load))
    at = (1, 1, 4.9)
    part = fs.HalfPlane(at, (-1, 0, 0))
    result = fs.crack(fs.read(tmp_path / "in.inp"), fs.Plane(at, (0.1, 0, 1)), within=part, strict=True)
    fs.write(result.mesh, tmp_path / "out.inp")

    def reaction(name):
        subprocess.run(["ccx", name], cwd=tmp_path, capture_output=True, check=True)
        return [float(w) for w in (tmp_path / f"{name}.dat").read_text().split()[-3:]]

    assert reaction("out") == pytest.approx(reaction("in"), abs=1e-4)
    assert result.report.converted


def test_order_of_a_set_that_an_mpc_names(tmp_path):
    """*MPC PLANE takes its plane from the set's first three nodes."""
    mesh = fs.read(calculix_deck("beamplane"))
    part = fs.HalfPlane((0.35, 0.5, 4.32), (-1, 0, 0))
    result = fs.crack(mesh, fs.Plane((0.5, 0.5, 4.32), (0, 0.1, 1)), within=part, strict=True)

    def nodes(m):
        fs.write(m, tmp_path / "plane.inp")
        lines = re.search(r"(?is)\*NSET, *NSET=Nplane\s*\n(.*?)\n\*", (tmp_path / "plane.inp").read_text())[1]
        return [int(n) for n in re.findall(r"\d+", lines)]

    before, after = nodes(mesh), nodes(result.mesh)
    assert before[:3] == [7, 8, 86] and before != sorted(before)
    assert len(after) > len(before) and after[: len(before)] == before
