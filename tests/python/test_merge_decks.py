# SPDX-License-Identifier: LGPL-2.1-or-later
"""An addition with a deck of its own: its sections, materials and orientations come along, and CalculiX runs."""

import numpy as np
import pytest

import femscalpel as fs
from calculix_runs import solve
from merge_parts import block, plate
from meshes import grid_box, quadratic
from test_physics import needs_ccx
from test_tie import hexahedra, with_deck

LOWER = "*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.\n"
UPPER = "*Material, Name=M\n*Elastic\n3000., 0.\n*Density\n7.8e-9\n"


def elastic(text):
    """{material: Young's modulus} of a deck's text."""
    lines = text.splitlines()
    out = {}
    for k, line in enumerate(lines):
        if line.upper().startswith("*MATERIAL"):
            out[line.split("=")[1].strip()] = float(lines[k + 2].split(",")[0])
    return out


def cards(text, keyword):
    """Keyword lines and their data, as they stand in a deck's text."""
    out = []
    for line in text.splitlines():
        if line.startswith("*") and not line.startswith("**"):
            out.append([])
        out[-1].append(line)
    return [card for card in out if card[0].upper().replace(" ", "").startswith("*" + keyword)]


def merged(tmp_path, low, low_deck, top, top_deck, **options):
    folders = [tmp_path / name for name in ("low", "top")]
    for folder in folders:
        folder.mkdir()
    base, addition = with_deck(folders[0], low, low_deck), with_deck(folders[1], top, top_deck)
    result = fs.merge(base, addition, name="ADD", **options)
    fs.write(result.mesh, tmp_path / "out.inp")
    fs.read(tmp_path / "out.inp").validate()
    return result, (tmp_path / "out.inp").read_text()


def named(mesh, name="EALL"):
    mesh.add_group(name, "element", np.concatenate(list(mesh.cell_ids.values())))
    return mesh


PARTS = {
    "first order": (
        lambda: grid_box((2, 2, 4), (2.0, 2.0, 4.0)),
        lambda: block((1, 1, 4), (2, 2, 4), (2, 2, 4), "TOP"),
    ),
    "second order": (
        lambda: quadratic(grid_box((2, 2, 4), (2.0, 2.0, 4.0))),
        lambda: block((1, 1, 4), (2, 2, 4), (3, 3, 4), "TOP"),
    ),
    "hexahedra, tied": (
        lambda: hexahedra((0, 0, 0), (2, 2, 4), (2, 2, 4), "LOW"),
        lambda: hexahedra((0, 0, 4), (2, 2, 4), (2, 2, 4), "TOP"),
    ),
}


@needs_ccx
@pytest.mark.parametrize("keep", ["mesh", "addition"])
@pytest.mark.parametrize("name", PARTS)
def test_two_boxes_of_different_material(tmp_path, name, keep):
    """Springs in series: 1 / k = 4 / (1000 A) + 4 / (3000 A). The names of set and material are in both decks."""
    low, top = (named(make()) for make in PARTS[name])
    low.add_group("FZ", "node", low.node_ids[np.abs(low.points[:, 2]) < 1e-9])
    low_deck = LOWER + "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\nFZ, 1, 3\n*END STEP\n"
    top_deck = UPPER + "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n*STEP\n*STATIC\n*BOUNDARY\n1, 1, 3\n*END STEP\n"
    method = "tie" if "tied" in name else "conform"
    result, text = merged(tmp_path, low, low_deck, top, top_deck, keep=keep, method=method)
    assert elastic(text) == {"M": 1000, "ADD_M": 3000}
    (warning,) = [w for w in result.report.warnings if "left out" in w]
    assert "*STEP (" in warning and "top/mesh.inp:" in warning and "*BOUNDARY" in warning
    assert not any("no section" in w for w in result.report.warnings)
    mesh = result.mesh
    assert len(mesh.groups["ADD_EALL"]) == len(mesh.groups["ADD_ADDED"])
    assert len(mesh.groups["EALL"]) + len(mesh.groups["ADD_EALL"]) == mesh.cell_count
    end = "".join(f"{n}, 3, 3, 0.08\n" for n in mesh.node_ids[np.abs(mesh.points[:, 2] - 8) < 1e-9])
    more = "*EL PRINT, ELSET=ADD_EALL\nS\n"
    text = text.replace(
        "*END STEP", f"*BOUNDARY\n{end}*NODE PRINT, NSET=NALL\nU\n*EL PRINT, ELSET=EALL\nS\n{more}*END STEP"
    )
    text = text.replace("*STEP", "*NSET, NSET=NALL\n" + "".join(f"{n},\n" for n in mesh.node_ids) + "*STEP", 1)
    u, stress = solve(tmp_path, text)
    z = mesh.points[:, 2]
    expected = np.where(z < 4, z * 0.015, 0.06 + (z - 4) * 0.005)
    assert [u[n][2] for n in mesh.node_ids] == pytest.approx(expected, abs=1e-6)
    assert len(stress) == mesh.cell_count
    assert np.array([s[2] for rows in stress.values() for s in rows]) == pytest.approx(15, rel=1e-4)


def test_names_that_do_not_clash_stay_and_equal_materials_are_one(tmp_path):
    low, top = named(grid_box((2, 2, 4), (2.0, 2.0, 4.0)), "LOWER"), block((1, 1, 4), (2, 2, 4), (2, 2, 4), "UPPER")
    deck = "*MATERIAL, NAME=m\n*ELASTIC\n 1000.,0.\n*MATERIAL, NAME=OTHER\n*ELASTIC\n5., 0.\n"
    deck += "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n*SOLID SECTION, ELSET=UPPER, MATERIAL=M, ORIENTATION=O\n"
    result, text = merged(tmp_path, low, LOWER + "*SOLID SECTION, ELSET=LOWER, MATERIAL=M\n", top, deck)
    assert elastic(text) == {"M": 1000, "OTHER": 5}
    section = cards(text, "SOLIDSECTION")[1][0]
    assert section == "*SOLID SECTION, ELSET=UPPER, MATERIAL=M, ORIENTATION=O"
    assert cards(text, "ORIENTATION") == [["*ORIENTATION, NAME=O", "1., 0., 0., 0., 1., 0."]]
    assert not result.report.warnings


def test_shells_composites_orientations_and_element_types(tmp_path):
    floor = named(plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (10, 10), "FLOOR"))
    rib = named(plate((1, 3.3, 0), (8, 0, 0), (0, 0, 2), (8, 2), "RIB"))
    low = LOWER + "*ORIENTATION, NAME=O\n0, 1, 0, -1, 0, 0\n*SHELL SECTION, ELSET=EALL, MATERIAL=M\n0.1\n"
    top = UPPER + "*ORIENTATION, NAME=O\n1, 0, 0, 0, 0, 1\n** layers\n"
    top += "*SHELL SECTION, ELSET=RIB, COMPOSITE\n0.1,, M, O\n0.2,, M, O\n"
    _, text = merged(tmp_path, floor, low, rib, top)
    assert cards(text, "SHELLSECTION")[1] == [
        "*SHELL SECTION, ELSET=RIB, COMPOSITE",
        "0.1, , ADD_M, ADD_O",
        "0.2, , ADD_M, ADD_O",
    ]
    assert [c[0] for c in cards(text, "ORIENTATION")] == ["*ORIENTATION, NAME=O", "*ORIENTATION, NAME=ADD_O"]
    assert elastic(text) == {"M": 1000, "ADD_M": 3000}


def test_distributions_follow_the_numbers(tmp_path):
    low, top = named(grid_box((2, 2, 4), (2.0, 2.0, 4.0)), "LOWER"), block((1, 1, 4), (2, 2, 4), (2, 2, 4), "UPPER")
    deck = "*DISTRIBUTION TABLE, NAME=TAB\nCOORD3D, COORD3D\n*DISTRIBUTION, NAME=D, LOCATION=ELEMENT, TABLE=TAB\n"
    deck += ", 1., 0., 0., 0., 1., 0.\n90, 0., 1., 0., -1., 0., 0.\n*ORIENTATION, NAME=O\nD\n"
    deck += UPPER + "*SOLID SECTION, ELSET=UPPER, MATERIAL=M, ORIENTATION=O\n"
    result, text = merged(tmp_path, low, LOWER + "*SOLID SECTION, ELSET=LOWER, MATERIAL=M\n", top, deck, method="tie")
    (default, line) = cards(text, "DISTRIBUTION,")[0][1:]
    number = int(line.split(",")[0])
    assert default.startswith(",") or default.split(",")[0].strip() == ""
    row = np.flatnonzero(result.mesh.cell_ids["tetra"] == number)[0]
    middle = result.mesh.points[result.mesh.cells["tetra"][row]].mean(axis=0)
    assert middle == pytest.approx(top.points[top.cells["tetra"][89]].mean(axis=0))


def test_element_types_come_along(tmp_path):
    low, top = named(hexahedra((0, 0, 0), (2, 2, 4), (2, 2, 4), "LOW")), hexahedra((0, 0, 4), (2, 2, 4), (2, 2, 4), "T")
    folder = tmp_path / "top"
    folder.mkdir()
    base = with_deck(tmp_path, low, LOWER + "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n")
    fs.write(top, folder / "top.inp")
    text = (folder / "top.inp").read_text().replace("TYPE=C3D8", "TYPE=C3D8I") + UPPER
    (folder / "top.inp").write_text(text + "*SOLID SECTION, ELSET=T, MATERIAL=M\n")
    mesh = fs.merge(base, fs.read(folder / "top.inp"), method="tie").mesh
    fs.write(mesh, tmp_path / "out.inp")
    text = (tmp_path / "out.inp").read_text()
    counts = {c[0].split("TYPE=")[1].split(",")[0]: len(c) - 1 for c in cards(text, "ELEMENT,") if len(c) > 1}
    assert counts == {"C3D8": 16, "C3D8I": 16}
    again = fs.read(tmp_path / "out.inp")
    assert len(again.groups["T"]) == 16


def test_without_a_deck_of_the_mesh_that_of_the_addition_is_left_out(tmp_path):
    low, top = grid_box((2, 2, 4), (2.0, 2.0, 4.0)), named(block((1, 1, 4), (2, 2, 4), (2, 2, 4), "TOP"))
    addition = with_deck(tmp_path, top, UPPER + "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n")
    result = fs.merge(low, addition)
    assert any("the mesh has no deck" in w and "*SOLIDSECTION" in w for w in result.report.warnings)
    fs.write(result.mesh, tmp_path / "out.inp")
    assert "*Material" not in (tmp_path / "out.inp").read_text()


@pytest.mark.parametrize("group, material", [("ADD_EALL", "X"), ("X", "ADD_M")])
def test_names_that_are_taken_with_the_prefix_too(tmp_path, group, material):
    low, top = named(grid_box((2, 2, 4), (2.0, 2.0, 4.0))), named(block((1, 1, 4), (2, 2, 4), (2, 2, 4), "TOP"))
    low.add_group(group, "element", [1])
    deck = LOWER + f"*MATERIAL, NAME={material}\n*ELASTIC\n7., 0.\n*SOLID SECTION, ELSET=EALL, MATERIAL=M\n"
    top_deck = UPPER + "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n"
    with pytest.raises(fs.ToolError, match="give another prefix") as caught:
        merged(tmp_path, low, deck, top, top_deck)
    assert caught.value.parameter == "prefix"
