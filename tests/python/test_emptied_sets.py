# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sets and surfaces that lose all their members: CalculiX reads what is written, whatever they are called."""

import itertools
import shutil

import numpy as np
import pytest
from calculix_runs import solve

import femscalpel as fs

pytestmark = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")

LAST = "~FEMSCALPEL"
PLACES = np.array([(x, y, z) for x in range(4) for y in range(2) for z in range(2)], float) * 10
HEXAHEDRA = [[4 * i + c for c in (0, 4, 6, 2, 1, 5, 7, 3)] for i in range(3)]


def deck(cards, loads, nset="", elset=""):
    """Three hexahedra in a row, numbered from 1, with sets on cards of their own, as Abaqus/CAE writes them; `nset` and
    `elset` are parameters of *NODE and *ELEMENT."""
    lines = ["*NODE" + nset] + [f"{n}, {x:g}, {y:g}, {z:g}" for n, (x, y, z) in enumerate(PLACES, 1)]
    lines += ["*ELEMENT, TYPE=C3D8" + elset]
    lines += [f"{e}, " + ", ".join(str(n + 1) for n in nodes) for e, nodes in enumerate(HEXAHEDRA, 1)]
    lines += ["*ELSET, ELSET=ALL", "1, 2, 3", "*NSET, NSET=LEFT", "1, 2, 3, 4", *cards]
    lines += ["*MATERIAL, NAME=S", "*ELASTIC", "210000., 0.3", "*SOLID SECTION, ELSET=ALL, MATERIAL=S"]
    lines += ["*BOUNDARY", "LEFT, 1, 3", "*STEP", "*STATIC", "*CLOAD", "13, 1, 5.", *loads]
    return "\n".join(lines + ["*NODE PRINT, NSET=LEFT", "U", "*END STEP"]) + "\n"


def read(tmp_path, text):
    (tmp_path / "deck.inp").write_text(text)
    return fs.read(tmp_path / "deck.inp")


def written(tmp_path, mesh):
    """The text, which CalculiX takes and which is the same once more when it was read; groups are the same, too."""
    fs.write(mesh, tmp_path / "out.inp")
    text = (tmp_path / "out.inp").read_text()
    solve(tmp_path, text)
    again = fs.read(tmp_path / "out.inp")
    assert {(g.name, g.kind, len(g)) for g in again.groups.all()} == {
        (g.name, g.kind, len(g)) for g in mesh.groups.all()
    }
    assert (again.node_ids == mesh.node_ids).all()
    fs.write(again, tmp_path / "again.inp")
    assert (tmp_path / "again.inp").read_text() == text
    return text


def empty(mesh, *names):
    for name in names:
        kind = next(g.kind for g in mesh.groups.all() if g.name == name)
        mesh.remove_group(name, kind)
        mesh.add_group(name, kind)


@pytest.mark.parametrize("nset, elset", itertools.product(["", ", NSET=NALL"], ["", ", ELSET=EALL"]))
@pytest.mark.parametrize("names", itertools.permutations(["AAA", "LEFT_S1", "_TOP_S2"], 2))
def test_element_sets_of_surfaces(tmp_path, names, nset, elset):
    cards = []
    for name in names:
        cards += [f"*ELSET, ELSET={name}", "1", f"*SURFACE, NAME=OF{name}", f"{name}, S1"]
    mesh = read(tmp_path, deck(cards, [], nset, elset))
    empty(mesh, *names, *(f"OF{name}" for name in names))
    text = written(tmp_path, mesh)
    assert (LAST in text) == (not nset and not elset)  # else some set has a member before these are read


@pytest.mark.parametrize("name", ["AAA", "ZZZ", "zz_z"])
def test_surfaces_that_are_loaded(tmp_path, name):
    """What a card names is there, whatever comes behind it in the order of names."""
    cards = [f"*SURFACE, NAME={name}", "1, S1", "*SURFACE, NAME=KEPT", "3, S2"]
    mesh = read(tmp_path, deck(cards, ["*DSLOAD", f"{name}, P, 3."]))
    empty(mesh, name)
    written(tmp_path, mesh)


def test_all_kinds_at_once(tmp_path):
    cards = [
        "*NSET, NSET=ZN",
        "15",
        "*ELSET, ELSET=ZE",
        "3",
        "*SURFACE, NAME=ZF",
        "3, S2",
        "*SURFACE, NAME=ZG",
        "2, S2",
    ]
    loads = ["*CLOAD", "ZN, 2, 1.", "*DLOAD", "ZE, P2, 1.", "*DSLOAD", "ZF, P, 1.", "ZG, P, 1."]
    mesh = read(tmp_path, deck(cards, loads))
    assert LAST not in written(tmp_path, mesh)
    empty(mesh, "ZN", "ZE", "ZF", "ZG")
    assert LAST in written(tmp_path, mesh)


def test_sets_of_a_deck_of_another_format(tmp_path):
    """Without cards of its own a deck is made anew, and has the sets behind all elements."""
    mesh = fs.Mesh(PLACES, {"hexahedron": HEXAHEDRA})
    mesh.add_group("ZE", "element")
    mesh.add_group("ZF", "facet")
    mesh.add_group("KEPT", "facet", [[1, 1]])
    fs.write(mesh, tmp_path / "new.inp")
    text = (tmp_path / "new.inp").read_text()
    assert text.index(LAST) < text.index("*NODE\n")
    assert {g.name for g in fs.read(tmp_path / "new.inp").groups.all()} == {"ZE", "ZF", "KEPT"}


def test_a_crack_through_a_flat_deck(tmp_path):
    """Sets that only surfaces name become empty as surfaces name the pieces of their faces."""
    cards = ["*ELSET, ELSET=_BOT_S1", "1, 2, 3", "*SURFACE, NAME=BOT", "_BOT_S1, S3"]
    cards += ["*ELSET, ELSET=_TOP_S2", "1, 2, 3", "*SURFACE, NAME=TOP", "_TOP_S2, S5"]
    mesh = read(tmp_path, deck(cards, ["*DSLOAD", "TOP, P, 1.", "BOT, P, 1."]))
    result = fs.crack(mesh, fs.Plane((21, 0, 0), (1, 0.1, 0.1)), within=fs.HalfPlane((21, 5, 5), (0, 0, 1)))
    fs.write(result.mesh, tmp_path / "out.inp")
    solve(tmp_path, (tmp_path / "out.inp").read_text())
