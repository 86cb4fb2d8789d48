# SPDX-License-Identifier: LGPL-2.1-or-later
"""Element types that CalculiX has not."""

import numpy as np
import pytest

import femscalpel as fs

TYPES = {
    "line": ("B23", "B33", "CONN2D2", "CONN3D2", "PIPE21", "PIPE31", "R2D2", "RAX2", "SAX1"),
    "line3": ("B22", "PIPE32", "SAX2", "T2D3"),
    "triangle": ("STRI3", "R3D3", "SFM3D3", "CPEG3", "CPE3H", "AC2D3"),
    "triangle6": ("STRI65", "SFM3D6", "CPS6M", "CPEG6"),
    "quad": ("S4R5", "R3D4", "SFM3D4R", "CPEG4R"),
    "quad8": ("S8R5",),
    "tetra": ("AC3D4", "C3D4P"),
    "tetra10": ("C3D10M", "C3D10MH", "C3D10HS"),
    "wedge": ("SC6R",),
    "hexahedron": ("SC8R", "AC3D8R"),
}
COUNT = {"line": 2, "line3": 3, "triangle": 3, "triangle6": 6, "quad": 4, "quad8": 8, "tetra": 4, "tetra10": 10}
COUNT |= {"wedge": 6, "hexahedron": 8}

PLATE = """*NODE
1,0,0,0
2,1,0,0
3,2,0,0
4,0,1,0
5,1,1,0
6,2,1,0
"""


def lines_of(path, card):
    """The lines under a card."""
    return path.read_text().upper().replace(" ", "").split(card + "\n")[1].split("*")[0].strip().split("\n")


@pytest.mark.parametrize("cell, label", [(c, t) for c, types in TYPES.items() for t in types])
def test_they_are_read_and_stay_as_they_are_while_a_tool_stays_away(tmp_path, cell, label):
    places = np.random.default_rng(1).normal(size=(COUNT[cell], 3)) + (50, 0, 0)
    nodes = "".join(f"{k + 7}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(places))
    numbers = ",".join(str(k + 7) for k in range(COUNT[cell]))
    text = (
        PLATE
        + nodes
        + f"*ELEMENT,TYPE=S4,ELSET=PLATE\n1,1,2,5,4\n2,2,3,6,5\n*ELEMENT,TYPE={label},ELSET=X\n9,{numbers}\n"
    )
    (tmp_path / "in.inp").write_text(text)
    mesh = fs.read(tmp_path / "in.inp")
    assert mesh.cell_ids[cell].tolist()[-1] == 9
    result = fs.crack(mesh, fs.Plane((1, 0, 0), (1, 0, 0)))
    fs.write(result.mesh, tmp_path / "out.inp")
    assert lines_of(tmp_path / "out.inp", f"*ELEMENT,TYPE={label},ELSET=X") == [f"9,{numbers}"]


def test_shells_with_five_freedoms_are_cut_into_triangles(tmp_path):
    (tmp_path / "in.inp").write_text(PLATE + "*ELEMENT,TYPE=S4R5,ELSET=PLATE\n1,1,2,5,4\n2,2,3,6,5\n")
    result = fs.crack(fs.read(tmp_path / "in.inp"), fs.Plane((1.5, 0, 0), (1, 0, 0)))
    fs.write(result.mesh, tmp_path / "out.inp")
    assert len(lines_of(tmp_path / "out.inp", "*ELEMENT,TYPE=S3,ELSET=PLATE")) >= 3


CUBE = "*NODE\n" + "".join(f"{4 * k + 2 * j + i + 1},{i},{j},{k}\n" for k in (0, 1) for j in (0, 1) for i in (0, 1))


def test_continuum_shells_have_no_parts(tmp_path):
    (tmp_path / "in.inp").write_text(CUBE + "*ELEMENT,TYPE=SC8R,ELSET=PLATE\n1,1,2,4,3,5,6,8,7\n")
    with pytest.raises(fs.UnsupportedElementError, match="type SC8R have no parts of their kind"):
        fs.crack(fs.read(tmp_path / "in.inp"), fs.Plane((0.5, 0, 0), (1, 0.1, 0)))


def test_cohesive_elements_are_not_known(tmp_path):
    """They have no thickness, and nothing here knows which of their faces may open."""
    (tmp_path / "in.inp").write_text(CUBE + "*ELEMENT,TYPE=COH3D8,ELSET=LAYER\n1,1,2,4,3,5,6,8,7\n")
    with pytest.raises(fs.ReadError, match="elements of type COH3D8 are not known to CalculiX"):
        fs.read(tmp_path / "in.inp")
