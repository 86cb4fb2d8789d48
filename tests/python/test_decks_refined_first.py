# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is told of a deck when the mesh is refined first is about the user's deck and the result: nobody sees the mesh
between."""

import re

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box

FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # CalculiX's S1 to S4


def box(path, cards):
    """A box from (0, 0, 0) to (6, 5, 4) with `cards`; {top}, {nodes} there are its upper faces and their nodes."""
    mesh = grid_box()
    fs.write(mesh, path)
    faces = [
        f"{number}, P{k + 1}, 10."
        for number, cell in zip(mesh.cell_ids["tetra"].tolist(), mesh.cells["tetra"])
        for k, face in enumerate(FACES)
        if (mesh.points[cell[list(face)], 2] == 4).all()
    ]
    nodes = [f"{n}, 30." for n in mesh.node_ids[mesh.points[:, 2] == 4].tolist()]
    with open(path, "a") as out:
        out.write(cards.format(top="\n".join(faces), nodes="\n".join(nodes)))
    return fs.read(path)


def check_numbers(result, mesh):
    """Every number in the warnings is one of the input or the result."""
    nodes = set(mesh.node_ids.tolist()) | set(result.mesh.node_ids.tolist())
    elements = set(np.concatenate([*mesh.cell_ids.values(), *result.mesh.cell_ids.values()]).tolist())
    for warning in result.report.warnings:
        assert "carried over" not in warning
        assert {int(n) for n in re.findall(r"node (\d+)", warning)} <= nodes, warning
        assert {int(n) for n in re.findall(r"element (\d+)", warning)} <= elements, warning


def test_warnings_name_what_the_input_has(tmp_path):
    mesh = box(tmp_path / "box.inp", "*STEP\n*STATIC\n*DLOAD\n{top}\n*TEMPERATURE\n{nodes}\n*END STEP\n")
    result = fs.drill(mesh, fs.Cylinder((3, 3, 2), (0, 0.05, 1), 0.7))
    assert result.report.refinement
    check_numbers(result, mesh)
    told = [w for w in result.report.warnings if "box.inp:" in w]
    # The hole takes one node of the top, and of no element all of it.
    gone = set(mesh.node_ids.tolist()) - set(result.mesh.node_ids.tolist())
    (top,) = [n for n in gone if mesh.points[list(mesh.node_ids).index(n), 2] == 4]
    assert len(told) == 1 and re.fullmatch(
        rf".*box.inp:\d+: \*TEMPERATURE names node {top}, which was removed", told[0]
    )


def test_what_a_hole_takes_again_is_not_told(tmp_path):
    """Two nodes with equations of different form, and a hole that takes them and what refinement makes between them."""
    plain = grid_box()
    number = {tuple(p): n for p, n in zip(plain.points.tolist(), plain.node_ids.tolist())}
    a, b = number[3, 2, 4], number[3, 3, 4]
    far = number[0, 0, 0]
    equations = f"*EQUATION\n2\n{a}, 2, 1., {a}, 3, -1.\n2\n{b}, 2, 1., {far}, 2, -1.\n"
    mesh = box(tmp_path / "box.inp", equations)
    result = fs.drill(mesh, fs.Cylinder((3, 2.5, 2), (0, 0, 1), 0.7))
    assert result.report.refinement and not {a, b} & set(result.mesh.node_ids.tolist())
    check_numbers(result, mesh)
    told = [w for w in result.report.warnings if "box.inp:" in w]
    assert len(told) == 1 and f"names node {a} and 1 more, each of which was removed; its equation" in told[0]
    with pytest.raises(fs.Error) as error:
        fs.drill(mesh, fs.Cylinder((3, 2.5, 2), (0, 0, 1), 0.7), strict=True)
    assert str(error.value).splitlines()[1:] == ["  " + told[0]]


def test_strict_is_about_the_result(tmp_path):
    """A hole that takes parts of loaded elements, which refinement made, but of none all: the load follows."""
    mesh = box(tmp_path / "box.inp", "*STEP\n*STATIC\n*DLOAD\n{top}\n*END STEP\n")
    result = fs.drill(mesh, fs.Cylinder((3.5, 2.5, 2), (0, 0, 1), 0.4), strict=True)
    assert result.report.refinement
    assert not [w for w in result.report.warnings if "box.inp:" in w]


def test_sets_have_the_names_of_the_deck(tmp_path):
    mesh = grid_box()
    top = mesh.node_ids[(mesh.points[:, 2] == 4)]
    mesh.add_group("TOP", "node", top)
    fs.write(mesh, tmp_path / "box.inp")
    with open(tmp_path / "box.inp", "a") as out:
        out.write("*STEP\n*STATIC\n*CLOAD\nTOP, 3, -1.\n*END STEP\n")
    mesh = fs.read(tmp_path / "box.inp")
    result = fs.drill(mesh, fs.Cylinder((3, 3, 2), (0, 0, 1), 0.7))
    assert result.report.refinement
    told = [w for w in result.report.warnings if "box.inp:" in w]
    assert len(told) == 2
    assert "*CLOAD names set 'TOP', which lost 1 node and with it its load" in told[0]
    assert "*CLOAD names set 'TOP', which has new nodes; the card now names 'TOP_LOAD1'" in told[1]
    assert set(result.mesh.groups["TOP_LOAD1"].ids) == set(top) & set(result.mesh.node_ids.tolist())
