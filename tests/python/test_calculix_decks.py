# SPDX-License-Identifier: LGPL-2.1-or-later
"""CalculiX's own test decks (Debian package calculix-ccx-test): all that hold triangles or tetrahedra are cracked and
solved, with the steps, loads and ties they come with. (That all others are read and written back unchanged is tested in
C++.)"""

import gzip
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import femscalpel as fs

DECKS = Path("/usr/share/doc/calculix-ccx-test/examples/test")
pytestmark = pytest.mark.skipif(not DECKS.exists(), reason="Debian package calculix-ccx-test is not installed")
needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")

X, Y, Z = np.eye(3)
#: Deck: normal of the plane through the middle of its triangles and tetrahedra. Where the other directions cut off a
#: piece that nothing holds, CalculiX cannot solve it.
NORMALS = {
    "ax6": Y,  # a disk held at its inner rim
    "ax6ht": X,  # the same, a temperature field
    "beam10p": X,  # a cantilever, cut along
    "cubef2f1": Z,  # a cube of tetrahedra on one of hexahedra; tied by contact
    "cubef2f2": Z,
    "cubef2f3": Z,
    "furnace": X,  # shells, gas, radiation
    "segmenttet": Z,  # a segment of a disk, cyclic symmetry by ties, frequencies
}


def deck_path(name):
    return next(p for p in (DECKS / f"{name}.inp", DECKS / f"{name}.inp.gz") if p.exists())


def cut_part(mesh):
    """Points of the elements that can be cut."""
    cells = [c.ravel() for kind, c in mesh.cells.items() if kind.startswith(("triangle", "tetra"))]
    return mesh.points[np.unique(np.concatenate(cells))] if cells else np.zeros((0, 3))


def middle_plane(mesh, normal):
    points = cut_part(mesh)
    return fs.Plane((points.min(axis=0) + points.max(axis=0)) / 2, normal)


def cards(path):
    """Keywords of a deck, in order."""
    text = gzip.open(path, "rt").read() if path.suffix == ".gz" else path.read_text()
    return [
        line.split(",")[0].strip().upper()
        for line in text.splitlines()
        if line.startswith("*") and not line.startswith("**")
    ]


def sets_of(mesh):
    return {(g.name, g.kind) for g in mesh.groups.all()}


def values(folder):
    """All numbers CalculiX printed, and those of the fields it wrote for pictures."""
    found = []
    for name in ("run.dat", "run.frd"):
        path = folder / name
        if not path.exists():
            continue
        for line in path.read_text().splitlines():
            if name == "run.frd":
                if not line.startswith(" -1") or len(line) < 25:
                    continue
                fields = [line[k : k + 12] for k in range(13, len(line.rstrip()), 12)]
            else:
                fields = line.split()
            for field in fields:
                try:
                    found.append(float(field))
                except ValueError:  # a word
                    pass
    return np.array(found)


def test_the_list_is_complete():
    with_simplices = set()
    for path in sorted(DECKS.glob("*.inp")) + sorted(DECKS.glob("*.inp.gz")):
        try:
            mesh = fs.read(path)
        except fs.ReadError as error:
            assert path.name in str(error)
            continue
        if len(cut_part(mesh)):
            with_simplices.add(path.name.split(".")[0])
    assert with_simplices >= set(NORMALS)  # CalculiX 2.22 has 14 more


@needs_ccx
@pytest.mark.parametrize("name", NORMALS)
def test_cracked_deck_runs(tmp_path, name):
    mesh = fs.read(deck_path(name))
    result = fs.crack(mesh, middle_plane(mesh, NORMALS[name]), strict=True)
    assert result.report.nodes_doubled > 3 and result.report.quality.after.minimum > 0.25
    assert sets_of(mesh) <= sets_of(result.mesh)
    assert not any(g.status == "became empty" for g in result.report.groups)
    fs.write(result.mesh, tmp_path / "run.inp")
    before, after = cards(deck_path(name)), cards(tmp_path / "run.inp")
    # Every card is still there, in order; new are sets and surfaces of the lips, and elements no card had room for.
    remaining = iter(after)
    assert all(card in remaining for card in before)
    assert {c for c in after if after.count(c) > before.count(c)} <= {
        "*NSET",
        "*ELSET",
        "*SURFACE",
        "*ELEMENT",
        "*NODE",
    }

    done = subprocess.run(
        ["ccx", "run"],
        cwd=tmp_path,
        env=dict(os.environ, OMP_NUM_THREADS="1"),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=200,
    )
    assert done.returncode == 0 and "Job finished" in done.stdout and "*ERROR" not in done.stdout, done.stdout[-2000:]
    numbers = values(tmp_path)
    assert len(numbers) > 20 and np.isfinite(numbers).all() and np.abs(numbers).max() < 1e20


def test_what_cannot_be_cracked_says_why():
    disk = fs.read(deck_path("ax6"))
    with pytest.raises(fs.ToolError, match="lie in the plane, and nothing stands on them"):  # an axisymmetric mesh
        fs.crack(disk, middle_plane(disk, Z))


@needs_ccx
def test_a_loose_piece_is_calculixs_to_refuse(tmp_path):
    """The radial cut of the disk leaves its outer ring without support: the crack is right, CalculiX must say no."""
    disk = fs.read(deck_path("ax6"))
    fs.write(fs.crack(disk, middle_plane(disk, X)).mesh, tmp_path / "run.inp")
    done = subprocess.run(
        ["ccx", "run"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100
    )
    assert done.returncode != 0 and "*ERROR" in done.stdout
