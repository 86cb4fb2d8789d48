# SPDX-License-Identifier: LGPL-2.1-or-later
"""CalculiX's own decks of hexahedra, cracked a third through, with the steps, loads, contacts and relations they come
with: CalculiX solves them, and the supports carry what they carried before."""

import numpy as np
import pytest
from hexahedral_decks import (
    DECKS,
    deck_text,
    eigenvalues,
    half_crack,
    imbalance,
    keyword,
    solve_as_it_comes,
    solve_cracked,
)
from test_calculix_decks import needs_ccx, sets_of

import femscalpel as fs

pytestmark = pytest.mark.skipif(not DECKS.exists(), reason="Debian package calculix-ccx-test is not installed")

#: Decks whose loads are forces, or heat: the sum of the reactions is the load.
LOADED = {
    "achtel9": "C3D20R, an eighth of a cube, point loads, equations of nine terms",
    "achtelp": "C3D20R, an eighth of a cube, point loads",
    "aniso": "C3D20R, anisotropic material",
    "beam20p": "C3D20, a cantilever, shear force",
    "beam8p": "C3D8, the same",
    "beamabq": "C3D20R, a material of Abaqus's interface",
    "beamcontact": "C3D20R and C3D8 in contact",
    "beamd": "C3D20R, pressure on faces",
    "beamdelay": "C3D20R, an amplitude with a delay",
    "beamdynamic": "C3D20R, a static step, then a dynamic one",
    "beamf2": "C3D20R, a load near the one it buckles at, then frequencies",
    "beamhf": "C3D20R, hyperfoam, large strains",
    "beamhtbf": "C3D20R, heat transfer, heat in the volume",
    "beamhtfc": "C3D20R and a gas network, forced convection",
    "beamnlmpc": "C3D20R, equations, large displacements",
    "beamnlp": "C3D20R, large displacements",
    "beamog": "C3D20R, Ogden's material",
    "beamp1rotate": "C3D20R, a beam on hinges",
    "beampfix": "C3D20R, a displacement kept (*BOUNDARY, FIXED), then loads; two steps",
    "beampik": "C3D20R, plasticity with hardening of both kinds; loaded and unloaded",
    "beampo2": "C3D20R, orthotropic material, *ORIENTATION",
    "beampset": "C3D20R, a set of sets",
    "beamptied1": "C3D20R, two parts, *TIE of a surface of nodes",
    "beamptied2": "C3D20R, two parts, *TIE of faces",
    "beamstraight": "C3D20R, *MPC STRAIGHT",
    "beamuamp": "C3D20R, an amplitude of CalculiX's own",
    "changefric": "C3D8, contact, *CHANGE FRICTION; five steps",
    "changesolidsection": "C3D20R, *CHANGE SOLID SECTION; two steps",
    "contact2": "C3D20, temperature, contact removed and added; three steps",
    "contact6": "C3D8, contact that overlaps",
    "contactenergy": "C3D8, contact",
    "distcoup": "C3D20R, *DISTRIBUTING COUPLING",
    "fricloop": "C3D8, contact with friction, to and fro; four steps",
    "modelchel": "C3D20R, elements removed; two steps",
    "mpcforce": "C3D20R, two materials joined by equations",
    "segmentf": "C3D20R, a segment of a disk, forces in cylindrical coordinates",
}

#: Decks with prescribed displacements or strains, or loads in balance: supports hold each other, their sum is zero.
HELD = {
    "achteld": "C3D20R, an eighth of a cube, displacements",
    "beam20t": "C3D20, a heated beam",
    "beam8t": "C3D8, the same",
    "beamnld": "C3D20R, displacements, large",
    "beamprb": "C3D20R, *RIGID BODY",
    "beampt": "C3D20R, a heated beam of plastic material",
    "beamptied3": "C3D20R, two parts in contact; *MODEL CHANGE, then frequencies",
    "beamptied5": "C3D20R, two parts in contact of friction, then frequencies",
    "beamt4": "C3D20R, temperatures that vary",
    "contact10": "C3D8 and S8 in contact",
    "contact11": "C3D8 and B32R in contact",
    "contact4": "C3D20, contact at nodes in the middle",
    "cubef2f3": "C3D20 and C3D10, tied",
    "cubespring": "C3D8, contact by springs",
    "friction1": "C3D8, contact, sticking; pressure",
    "friction2": "C3D8, contact, slipping; four steps",
    "gap2": "C3D8, gap elements",
    "pret3": "C3D20R and B31, pre-tension",
    "punch1": "C3D20, a punch in contact; pressure",
    "resstress2": "C3D20R, stresses at the start",
    "sc123": "C3D20, a material of a single crystal",
}


#: Where these stand is the writer's.
OF_THE_MESH = {"", "*NODE", "*ELEMENT", "*NSET", "*ELSET", "*SURFACE"}


def cards(text):
    """The keywords of all cards but the mesh's, in order."""
    return [k for k in map(keyword, text.splitlines()) if k not in OF_THE_MESH]


def check_deck(before, mesh, after, result):
    """All cards and sets are there; elements were converted, and nodes doubled."""
    report = result.report
    assert sum(report.converted.values()) > 0 and report.nodes_doubled >= 3
    assert sets_of(mesh) <= sets_of(result.mesh)
    assert not any(g.status == "became empty" for g in report.groups)
    # Equations are added where pyramids are made.
    equations = cards(before).count("*EQUATION")
    assert cards(after).count("*EQUATION") in (equations, equations + 1)
    assert [k for k in cards(after) if k != "*EQUATION"] == [k for k in cards(before) if k != "*EQUATION"]


def solve_both(folder, text):
    """The sums of reactions before and after; the result."""
    mesh, before = solve_as_it_comes(folder / "before", text)
    result, after = solve_cracked(folder / "after", mesh)
    check_deck((folder / "before" / "run.inp").read_text(), mesh, (folder / "after" / "run.inp").read_text(), result)
    return before, after, result


@needs_ccx
@pytest.mark.parametrize("name", LOADED)
def test_supports_carry_the_loads(tmp_path, name):
    before, after, _ = solve_both(tmp_path, deck_text(name))
    assert max(abs(total).max() / size for total, size in before) > 0.01
    assert imbalance(before, after) < 1e-4


@needs_ccx
@pytest.mark.parametrize("name", HELD)
def test_supports_hold_each_other(tmp_path, name):
    before, after, _ = solve_both(tmp_path, deck_text(name))
    assert min(size for _, size in before) > 0
    assert imbalance(before, after) < 1e-5


@needs_ccx
@pytest.mark.parametrize("label", ["C3D8R", "C3D8I"])
def test_supports_carry_the_loads_of_other_hexahedra(tmp_path, label):
    """The deck beam8p with elements of another kind: CalculiX's own have none that is linear and loaded by forces."""
    text = deck_text("beam8p").replace("TYPE=C3D8", f"TYPE={label}")
    assert text.count(f"TYPE={label}") == 256
    before, after, result = solve_both(tmp_path, text)
    assert before[0][0][1] == pytest.approx(-9) and imbalance(before, after) < 1e-4
    written = (tmp_path / "after" / "run.inp").read_text()
    assert f"TYPE={label}" in written and len(result.mesh.cells["hexahedron"]) > 100


#: Deck: between what the first frequency or buckling factor is, relative to that before. C3D4 are stiffer than C3D8.
EIGENVALUES = {
    "beamf": (0.98, 1),  # C3D20R, frequencies
    "beamdy1": (0.98, 1),  # C3D20R, frequencies, then a load in modes
    "beamb": (0.95, 1),  # C3D20R, buckling
    "beam8f": (1, 1.08),  # C3D8, frequencies
    "beam8b": (1, 1.2),  # C3D8, buckling
    "beampisof": (0.98, 1),  # C3D20R, plastic, then frequencies
}


@needs_ccx
@pytest.mark.parametrize("name", EIGENVALUES)
def test_frequencies_and_buckling(tmp_path, name):
    solve_both(tmp_path, deck_text(name))
    before, after = (np.array(eigenvalues(tmp_path / when)) for when in ("before", "after"))
    assert len(before) == len(after) >= 4 and (np.diff(after) >= 0).all()
    low, high = EIGENVALUES[name]
    assert low < after[0] / before[0] < high


def test_what_a_deck_cannot_follow_is_named():
    """Equations between two faces."""
    mesh = fs.read(next(DECKS.glob("achtel2.inp*")))
    plane, half = half_crack(mesh)
    why = "have no counterpart between the partners of these"
    with pytest.raises(fs.Error, match=why):
        fs.crack(mesh, plane, within=half, strict=True)
    assert any(why in w for w in fs.crack(mesh, plane, within=half).report.warnings)


def test_initial_strains_go_to_the_parts_and_it_is_said():
    mesh = fs.read(next(DECKS.glob("inistrain.inp*")))
    plane, half = half_crack(mesh)
    said = fs.crack(mesh, plane, within=half, strict=True).report.warnings
    assert sum("the integration points of its parts have the values of the nearest one it had" in w for w in said) == 2
