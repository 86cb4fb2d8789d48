# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decks of parts, instances and an assembly, as Abaqus/CAE writes them: read as the flat deck that says the same."""

import math
import re
import shutil

import numpy as np
import pytest
from calculix_runs import solve

import femscalpel as fs

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
CUBE = ((0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7))
FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # CalculiX's S1 to S4 of a tetrahedron


class Box:
    """A bar along x of tetrahedra: nodes (n, 3) and elements (m, 4), both numbered from 1."""

    def __init__(self, nx, ny, length):
        at = {}
        for k in range(ny + 1):
            for j in range(ny + 1):
                for i in range(nx + 1):
                    at[i, j, k] = len(at) + 1
        self.nodes = np.array([(length * i / nx, j / ny, k / ny) for i, j, k in at])
        self.elements = np.array(
            [
                [at[i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)] for c in corners]
                for i in range(nx)
                for j in range(ny)
                for k in range(ny)
                for corners in CUBE
            ]
        )

    def nodes_at(self, x):
        return [n + 1 for n in range(len(self.nodes)) if abs(self.nodes[n, 0] - x) < 1e-9]

    def faces_at(self, x):
        there = set(self.nodes_at(x))
        return [
            (e + 1, f + 1)
            for e, nodes in enumerate(self.elements)
            for f, face in enumerate(FACES)
            if all(nodes[k] in there for k in face)
        ]


LONG, SHORT = Box(4, 2, 2.0), Box(4, 3, 2.0)
MATERIAL = """*Material, name=WOOD
*Elastic, type=ENGINEERING CONSTANTS
12000., 800., 500., 0.4, 0.3, 0.35, 700., 600.
70., 20.
*Material, name=STEEL
*Elastic
210000., 0.3
"""


def node_lines(nodes, offset=0):
    return "".join(f"{n + offset}, {x!r}, {y!r}, {z!r}\n" for n, (x, y, z) in enumerate(nodes.tolist(), 1))


def element_lines(elements, offset=0):
    return "".join(
        f"{e + offset}, " + ", ".join(str(n + offset) for n in nodes) + "\n"
        for e, nodes in enumerate(elements.tolist(), 1)
    )


def surface_lines(faces, offset=0):
    return "".join(f"{e + offset}, S{f}\n" for e, f in faces)


def part(name, box, section):
    return (
        f"*Part, name={name}\n*Node\n{node_lines(box.nodes)}*Element, type=C3D4\n{element_lines(box.elements)}"
        f"*Elset, elset=ALL, generate\n1, {len(box.elements)}, 1\n"
        f"*Surface, type=ELEMENT, name=LEFT\n{surface_lines(box.faces_at(0))}"
        f"*Surface, type=ELEMENT, name=RIGHT\n{surface_lines(box.faces_at(2))}{section}*End Part\n**\n"
    )


#: The second bar is turned a quarter about its own axis, y = z = 0.5; the third is turned end to end.
PARTS = (
    "*Heading\n three bars in a row\n** PARTS\n**\n"
    + part(
        "Bar",
        LONG,
        "*Orientation, name=Ori-1\n1., 0., 0., 0., 1., 0.\n3, 0.\n"
        "*Solid Section, elset=ALL, orientation=Ori-1, material=WOOD\n,\n",
    )
    + part("End", SHORT, "*Solid Section, elset=ALL, material=STEEL\n,\n")
    + "** ASSEMBLY\n*Assembly, name=Assembly\n**\n*Instance, name=Bar-1, part=Bar\n*End Instance\n**\n"
    "*Instance, name=Bar-2, part=Bar\n 2., 0., 0.\n 2., 0.5, 0.5, 3., 0.5, 0.5, 90.\n*End Instance\n**\n"
    "*Instance, name=End-1, part=End\n 4., 0., 0.\n 5., 0.5, 0.5, 5., 0.5, 1.5, 180.\n*End Instance\n**\n"
    "*Node\n 1, 6.5, 0.5, 0.5\n*Nset, nset=RP, internal\n 1,\n"
    f"*Nset, nset=FIX, instance=Bar-1\n {', '.join(map(str, LONG.nodes_at(0)))}\n"
    f"*Nset, nset=GRIP, instance=End-1\n {', '.join(map(str, SHORT.nodes_at(0)))}\n"
    "*Tie, name=T1, adjust=no\nBar-2.LEFT, Bar-1.RIGHT\n*Tie, name=T2, adjust=no\nEnd-1.RIGHT, Bar-2.RIGHT\n"
    "*Rigid Body, ref node=RP, nset=GRIP\n*End Assembly\n"
    + MATERIAL
    + "*Step\n*Static\n*Boundary\nFIX, 1, 3\n*Cload\nRP, 2, 3.\nRP, 3, 5.\nBar-2.7, 1, 0.5\n"
    "*Node Print, nset=OUT\nU\n*End Step\n"
)
# The result is asked for by sets of the test's own, one per instance.
PARTS = PARTS.replace(
    "*Tie, name=T1",
    "".join(
        f"*Nset, nset=OUT, instance={name}, generate\n 1, {len(box.nodes)}, 1\n"
        for name, box in (("Bar-1", LONG), ("Bar-2", LONG), ("End-1", SHORT))
    )
    + "*Tie, name=T1",
    1,
)


def turned(box, shift, a, axis, degrees):
    """Rodrigues' formula after the translation."""
    x = box.nodes + shift - a
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return c * x + s * np.cross(axis, x) + (1 - c) * np.outer(x @ axis, axis) + a


def flat_by_hand():
    """The same model, written without parts."""
    offsets = (0, 100, 200)
    places = (
        LONG.nodes,
        np.round(turned(LONG, (2, 0, 0), np.array((2, 0.5, 0.5)), np.array((1.0, 0, 0)), 90), 12),
        np.round(turned(SHORT, (4, 0, 0), np.array((5, 0.5, 0.5)), np.array((0, 0, 1.0)), 180), 12),
    )
    text = "*HEADING\nthree bars by hand\n"
    for name, box, offset, nodes in zip("ABC", (LONG, LONG, SHORT), offsets, places):
        text += f"*NODE, NSET=OUT\n{node_lines(nodes, offset)}"
        text += f"*ELEMENT, TYPE=C3D4, ELSET={name}\n{element_lines(box.elements, offset)}"
        text += f"*SURFACE, NAME={name}L\n{surface_lines(box.faces_at(0), offset)}"
        text += f"*SURFACE, NAME={name}R\n{surface_lines(box.faces_at(2), offset)}"
    text += "*NODE\n501, 6.5, 0.5, 0.5\n"
    text += "*NSET, NSET=FIX\n" + ",\n".join(map(str, LONG.nodes_at(0))) + "\n"
    text += "*NSET, NSET=GRIP\n" + ",\n".join(str(n + 200) for n in SHORT.nodes_at(0)) + "\n"
    text += "*ORIENTATION, NAME=OA\n1., 0., 0., 0., 1., 0.\n*ORIENTATION, NAME=OB\n1., 0., 0., 0., 0., 1.\n" + MATERIAL
    text += "*SOLID SECTION, ELSET=A, MATERIAL=WOOD, ORIENTATION=OA\n*SOLID SECTION, ELSET=B, MATERIAL=WOOD, "
    text += "ORIENTATION=OB\n*SOLID SECTION, ELSET=C, MATERIAL=STEEL\n*TIE, NAME=T1, ADJUST=NO\nBL, AR\n"
    text += "*TIE, NAME=T2, ADJUST=NO\nCR, BR\n*RIGID BODY, NSET=GRIP, REF NODE=501\n"
    text += "*STEP\n*STATIC\n*BOUNDARY\nFIX, 1, 3\n*CLOAD\n501, 2, 3.\n501, 3, 5.\n107, 1, 0.5\n"
    return text + "*NODE PRINT, NSET=OUT\nU\n*END STEP\n"


def read_text(folder, text, name="in.inp"):
    (folder / name).write_text(text)
    return fs.read(folder / name)


def written(folder, mesh, name="out.inp"):
    fs.write(mesh, folder / name)
    return (folder / name).read_text()


def members(mesh):
    return {(g.name, g.kind): g.ids.tolist() for g in mesh.groups.all()}


@needs_ccx
def test_three_instances_solve_as_the_flat_deck_written_by_hand_before_and_after_a_crack(tmp_path):
    parts = read_text(tmp_path, PARTS)
    hand = read_text(tmp_path, flat_by_hand(), "hand.inp")
    assert [i.offset for i in parts.instances] == [0, 100, 200, 500]
    np.testing.assert_array_equal(parts.node_ids, hand.node_ids)
    np.testing.assert_allclose(parts.points, hand.points, atol=1e-12)
    plane = fs.Plane((3.1, 0, 0.5), (1, 0.1, 0))
    within = fs.Disk((3.1, 0, 0.5), 0.6)
    largest = []
    for cracked in (False, True):
        got, wanted = (
            solve(tmp_path, written(tmp_path, fs.crack(m, plane, within=within, strict=False).mesh if cracked else m))[
                0
            ]
            for m in (parts, hand)
        )
        assert got.keys() == wanted.keys() and len(got) >= len(parts.points) - 1
        a, b = (np.array([u[n] for n in sorted(u)]) for u in (got, wanted))
        largest.append(np.abs(a).max())
        print(f"DISPLACEMENTS cracked {cracked}: {len(a)} nodes, largest {largest[-1]:.6g}, "
              f"largest difference {np.abs(a - b).max():.3g}")  # fmt: skip
        assert np.abs(a - b).max() <= 1e-6 * largest[-1]
    assert largest[1] > 1.001 * largest[0], "the crack is seen"


def test_strict_does_not_refuse_decks_of_parts(tmp_path):
    mesh = read_text(tmp_path, PARTS)
    report = fs.crack(mesh, fs.Plane((1.1, 0.5, 0.5), (1, 0.1, 0)), strict=True).report
    assert report.warnings == []


def test_the_table_of_numbers_is_in_the_mesh_the_deck_and_the_warnings(tmp_path):
    mesh = read_text(tmp_path, PARTS)
    assert mesh.instances == (
        fs.Instance("Bar-1", "Bar", 0, (1, 45), (1, 96)),
        fs.Instance("Bar-2", "Bar", 100, (101, 145), (101, 196)),
        fs.Instance("End-1", "End", 200, (201, 280), (201, 416)),
        fs.Instance("", "", 500, (501, 501), (0, 0)),
    )
    (warning,) = mesh.input_warnings
    with pytest.warns(UserWarning, match="3 instances of parts are written out"):
        fs.read(tmp_path / "in.inp")
    assert "in.inp:" in warning and "3 instances of parts are written out" in warning
    lines = written(tmp_path, mesh).splitlines()
    assert lines[:6] == [
        "** Flat deck, put together from the parts and instances of in.inp. As read:",
        "** instance Bar-1 of part Bar: nodes 1 to 45, elements 1 to 96 (numbers as they were)",
        "** instance Bar-2 of part Bar: nodes 101 to 145, elements 101 to 196 (numbers + 100)",
        "** instance End-1 of part End: nodes 201 to 280, elements 201 to 416 (numbers + 200)",
        "** assembly: node 501, no elements (numbers + 500)",
        "** Names that several instances or the assembly have are INSTANCE_NAME.",
    ]
    result = fs.crack(mesh, fs.Plane((1.1, 0.5, 0.5), (1, 0.1, 0)))
    assert result.mesh.instances == result.report.instances == mesh.instances
    assert result.report.to_text().splitlines()[-6:] == [
        "instance   part    numbers      nodes   elements",
        "------------------------------------------------",
        "Bar-1      Bar  as in part    1 to 45    1 to 96",
        "Bar-2      Bar        +100 101 to 145 101 to 196",
        "End-1      End        +200 201 to 280 201 to 416",
        "(assembly)            +500 501 to 501       none",
    ]
    assert fs.read(tmp_path / "out.inp").instances == ()


def test_many_instances_are_listed_at_the_head_alone(tmp_path):
    more = "".join(f"*INSTANCE, NAME=K{k}, PART=P\n{k}., 9., 0.\n*END INSTANCE\n" for k in range(10))
    mesh = read_text(tmp_path, two(assembly=more))
    assert len(mesh.instances) == 12 and mesh.node_count == 48
    assert "K5 " in mesh.input_warnings[0] and "K6 " not in mesh.input_warnings[0]
    assert mesh.input_warnings[0].endswith("; and 4 more, listed at the head of the deck as written")
    assert "** instance K9 of part P: nodes 201 to 204, elements 201 to 202 (numbers + 200)" in written(tmp_path, mesh)


def test_what_is_written_reads_back_as_it_was(tmp_path):
    mesh = read_text(tmp_path, PARTS)
    text = written(tmp_path, mesh)
    back = fs.read(tmp_path / "out.inp")
    np.testing.assert_array_equal(back.points, mesh.points)
    assert members(back) == members(mesh)
    assert not re.search(r"^\*\s*(end )?(part|instance|assembly)", text, re.IGNORECASE | re.MULTILINE)
    for line in ("** PARTS", "** ASSEMBLY", "** Instance Bar-2 of part Bar", "101, 2, 1, 0"):
        assert line in text.splitlines(), line
    assert "*Rigid Body, REF NODE=501, NSET=GRIP" in text
    assert "\n107, 1, 0.5\n" in text and "Bar-2_LEFT, Bar-1_RIGHT" in text


SHEET = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,1,1,0\n*ELEMENT, TYPE=S3, ELSET=E\n1,1,2,3\n2,2,4,3\n"


def two(cards_in_part="", assembly="", second="5., 0., 0.\n", after="", more=""):
    """A deck of two instances of a sheet."""
    return (
        f"*PART, NAME=P\n{SHEET}{cards_in_part}*END PART\n{more}*ASSEMBLY, NAME=ALL\n*INSTANCE, NAME=I, PART=P\n"
        f"*END INSTANCE\n*INSTANCE, NAME=J, PART=P\n{second}*END INSTANCE\n{assembly}*END ASSEMBLY\n{after}"
    )


QUARTER = "0., 0., 0.\n0., 0., 0., 0., 0., 1., 90.\n"


@pytest.mark.parametrize(
    "cards, flat",
    [
        ("*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n3, 30.\n", "NAME=J_O\n0, 1, 0, -1, 0, 0\n3, 30.\n"),
        ("*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n1., 0., 0., 1., 0., 1.\n", "0, 1, 0, 0, 1, 1\n"),
        (
            "*NSET, NSET=N\n1\n*TRANSFORM, NSET=N, TYPE=R\n1., 0., 0., 0., 1., 0.\n",
            "NSET=J_N, TYPE=R\n0, 1, 0, -1, 0, 0\n",
        ),
        ("*NORMAL\n1, 2, 1., 0., 0.\n", "*NORMAL\n11, 12, 0, 1, 0\n"),
        ("*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n1., 2.\n1., 0., 0.\n", "1., 2.\n0, 1, 0\n"),
        ("*GAP, ELSET=E\n0.1, 1., 0., 0., , 7.\n", "0.1, 0, 1, 0, , 7.\n"),
        ("*DISTRIBUTION, NAME=D, LOCATION=ELEMENT\n2, 1., 0., 0., 0., 1., 0.\n", "12, 0, 1, 0, -1, 0, 0\n"),
    ],
    ids=lambda text: text.split(",")[0].strip(),
)
def test_directions_turn_with_their_instance(tmp_path, cards, flat):
    text = written(tmp_path, read_text(tmp_path, two(cards, second=QUARTER)))
    assert text.count(flat) == 1
    own = [line for line in cards.splitlines() if not line.startswith("*")]
    assert all(line in text.splitlines() for line in own), "those of the instance that stays do not"


@pytest.mark.parametrize(
    "cards, words",
    [
        ("*BOUNDARY\n1, 1, 3\n", r"in.inp:10: \*BOUNDARY stands in a part and has directions, and instance 'J'"),
        ("*EQUATION\n2\n1,1,1.,2,1,-1.\n", r"in.inp:10: \*EQUATION stands in a part"),
        ("*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT\n1., 2.\n", "in.inp:10: .*does not say the direction"),
        ("*WHATEVER\n1., 2., 3.\n", r"in.inp:11: \*WHATEVER is not a card of CalculiX; its numbers may be a direction"),
        ("*WHATEVER\n1, 2\n", r"in.inp:11: \*WHATEVER .* those of instance 'J' change by 10. Take the card out"),
        ("*ORIENTATION, NAME=O, SYSTEM=USER\n", "in.inp:10: SYSTEM=USER of"),
        ("*ELEMENT, TYPE=SPRING1, ELSET=SP\n7, 4\n*SPRING, ELSET=SP\n1\n100.\n", r"in.inp:12: \*SPRING stands in a"),
        ("*ELEMENT, TYPE=DASHPOT2, ELSET=SP\n7, 1, 4\n*DASHPOT, ELSET=SP\n1, 1\n9.\n", r"in.inp:12: \*DASHPOT stands"),
        ("*COUPLING, CONSTRAINT NAME=C, REF NODE=4, SURFACE=F\n*KINEMATIC\n1\n", r"in.inp:11: \*KINEMATIC stands in"),
    ],
)
def test_what_cannot_be_turned_or_renumbered_is_refused(tmp_path, cards, words):
    with pytest.raises(fs.ReadError, match=words):
        read_text(tmp_path, two(cards, second=QUARTER))


@pytest.mark.parametrize(
    "text, words",
    [
        (two().replace("*END PART\n", ""), r"in.inp:10: \*ASSEMBLY stands before the \*END PART of .*in.inp:1$"),
        (
            "*PART, NAME=P\n" + SHEET + "*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n",
            r"in.inp:10: \*INSTANCE stands before",
        ),
        (two().replace("*END ASSEMBLY\n", ""), r"in.inp:11: \*ASSEMBLY has no \*END ASSEMBLY"),
        (two().replace("NAME=J", "NAME=i"), "in.inp:14: an instance 'i' is there already .*in.inp:12"),
        (two(more="*PART, NAME=P\n*END PART\n"), "in.inp:11: a part 'P' is there already"),
        (two().replace("NAME=J, PART=P", "NAME=J, PART=Q"), "in.inp:14: instance 'J' is of part 'Q', which the deck"),
        (two().replace("NAME=J, PART=P", "NAME=J"), r"in.inp:14: \*INSTANCE needs PART="),
        (two().replace("NAME=J", "NAME=2"), "in.inp:14: the instance's name, '2', is a number"),
        (two().replace("NAME=J,", "NAME=J, LIBRARY=job,"), "in.inp:14: an instance imported from"),
        (two(second="5., x\n"), "in.inp:15: 'x' is not a finite number; the translation"),
        (two(second="0.\n1,1,1,1,1,1,90.\n"), "in.inp:16: the two points of the axis are one"),
        (two(second="0.\n1,1,1,1,1,90.\n"), "in.inp:16: not 7 numbers; the rotation"),
        (two(second="0.\n0,0,0,0,0,1,90.\n1.\n"), "in.inp:17: an instance has a line with its translation and one"),
        (two(assembly="*NSET, NSET=A, INSTANCE=K\n1\n"), "in.inp:17: there is no instance 'K'"),
        (
            two(assembly="*NSET, NSET=A, INSTANCE=I\n1, 7\n"),
            "in.inp:18: instance 'I' has no node 7: its nodes are 1 to 4",
        ),
        (two(assembly="*NSET, NSET=A\n1, 2\n"), "in.inp:18: number 1 is not of the assembly itself; .* as INSTANCE.1"),
        (two(assembly="*NSET, NSET=A\nJ.99\n"), "in.inp:18: instance 'J' has no node 99: its nodes are 1 to 4"),
        (two(assembly="*NSET, NSET=A\nJ.X\n"), "in.inp:18: instance 'J' has no set, surface or orientation 'X'"),
        (two(after="*STEP\n*DLOAD\nE, P, 1.\n"), "in.inp:20: 'E' is a name in instance 'I' and in instance 'J'; say"),
        (two(after="*NODE PRINT, NSET=X\nU\n*ELPRINT, ELSET=E\nS\n"), "in.inp:20: ELSET=E: 'E' is a name in"),
        (two(after="*NODE PRINT, NSET=K.X\nU\n"), "in.inp:18: NSET=K.X: there is no instance 'K', and no set of the n"),
        (two(after="*BOUNDARY\nI.1, 1\nK.3, 1\n"), "in.inp:20: there is no instance 'K', and no set of the name 'K.3'"),
        (two('*NSET, NSET="a,b"\n1\n'), r"in.inp:10: a name in quotes of \*NSET has a comma, which no name of"),
        (
            two('*NSET, NSET="S 1"\n1\n*NSET, NSET=S1\n2\n'),
            "in.inp:12: the names 'S1' and 'S 1' of instance 'I' differ in blanks alone, which CalculiX does not see",
        ),
        (two("*NODE, SYSTEM=S\n9, 1., 1., 1.\n"), "in.inp:10: SYSTEM=S of"),
        (two("*NODE\n2147483000, 0., 0., 0.\n"), "in.inp:16: instance 'J' has numbers up to 2147483000, .* more than"),
    ],
    ids=range(26),
)
def test_errors_name_the_line_of_the_users_file(tmp_path, text, words):
    with pytest.raises(fs.ReadError, match=words):
        read_text(tmp_path, text)


def test_errors_behind_the_parts_name_the_line_of_the_users_file(tmp_path):
    (tmp_path / "nodes.inc").write_text("9, 0., 0., 9.\n10, 0., y, 9.\n")
    with pytest.raises(fs.ReadError, match=r"nodes.inc:2: coordinate 2 of node 10, 'y', is not"):
        read_text(tmp_path, two("*NODE\n*INCLUDE, INPUT=nodes.inc\n"))
    with pytest.raises(fs.ReadError, match=r"in.inp:12: 'Q' is neither a number nor a node set"):
        read_text(tmp_path, two("*NSET,\n NSET=A\nQ\n", second=QUARTER))


def test_names_and_numbers_of_instances_are_told_apart(tmp_path):
    mesh = read_text(
        tmp_path,
        two(
            "*NSET, NSET=TOP, GENERATE\n3, 40, 1\n*ELSET, ELSET=SECOND\n2\n*SURFACE, NAME=S\nSECOND, SPOS\n1, S3\n",
            '*NODE, NSET="R P"\n3, 0., 0., 7.\n*NSET, NSET=TOP\n3, I.2, j.TOP\n*NSET, NSET=MIX, INSTANCE=I\n1\n'
            "*NSET, NSET=MIX, INSTANCE=J, INTERNAL\n1, TOP\n*ELSET, ELSET=FIRST\nI.1\n*ELSET, ELSET=FIRST\nALL.J.E\n",
        ),
    )
    nodes = {name: ids for (name, kind), ids in members(mesh).items() if kind == "node"}
    elements = {name: ids for (name, kind), ids in members(mesh).items() if kind == "element"}
    assert nodes == {
        "I_TOP": [3, 4], "J_TOP": [13, 14], "R P": [23], "TOP": [2, 13, 14, 23], "MIX": [1, 11, 13, 14],
    }  # fmt: skip
    assert elements == {"I_E": [1, 2], "J_E": [11, 12], "I_SECOND": [2], "J_SECOND": [12], "FIRST": [1, 11, 12]}
    assert sorted(mesh.groups["J_S"].ids[:, 0].tolist()) == [11, 12]


def test_names_may_have_blanks_quotes_and_points(tmp_path):
    deck = two("*NSET, NSET=N\n1\n", '*NSET, NSET=X\n"J. 2".3, "j. 2".N, I.2\n').replace("NAME=J", 'NAME="J. 2"')
    alike = deck.replace("NAME=I", "NAME=J").replace(", I.2", ", J.2")  # instances J and J. 2
    assert members(read_text(tmp_path, alike))["X", "node"] == [2, 11, 13]
    mesh = read_text(tmp_path, deck.replace("*INSTANCE, NAME=I", "* Instance ,name = i ").replace("PART=P", "PART=p "))
    assert members(mesh)["X", "node"] == [2, 11, 13]


def test_elements_equations_and_loads_name_nodes_of_several_instances(tmp_path):
    mesh = read_text(
        tmp_path,
        two(
            assembly="*ELEMENT, TYPE=SPRINGA, ELSET=SP\n1, I.1, J.2\n*ELEMENT, TYPE=C3D8\n2, I.1, I.2, I.3, I.4,\n"
            " J.1, J.2, J.3, J.4\n*EQUATION\n3\nI.2, 1, 1., J.1, 1, -1.\nI.3, 1, 2.\n*MPC\nBEAM, I.2, J.1\n",
            after="*STEP\n*DLOAD\nI.2, P, 1.\nJ.E, P, 2.\n*NODE PRINT, NSET=SP\nU\n*END STEP\n",
        ),
    )
    text = written(tmp_path, mesh)
    for lines in (
        "SPRINGA, ELSET=SP\n21, 1, 12\n", "\n22, 1, 2, 3, 4,\n 11, 12, 13, 14\n",
        "\n3\n2, 1, 1., 11, 1, -1.\n3, 1, 2.\n*MPC\nBEAM, 2, 11\n", "*DLOAD\n2, P, 1.\nJ_E, P, 2.\n",
    ):  # fmt: skip
        assert lines in text


def test_materials_in_parts_stand_once_and_comments_stay(tmp_path):
    cards = (
        "*SHELL SECTION, ELSET=E, MATERIAL=M\n1.\n*MATERIAL, NAME=M\n** steel\n*ELASTIC\n1., 0.3\n*NSET, NSET=N\n1\n"
    )
    text = written(tmp_path, read_text(tmp_path, two(cards)))
    assert text.count("*MATERIAL") == text.count("*ELASTIC") == text.count("** steel") == 1
    assert text.count("MATERIAL=M") == text.count("*NSET") == 2


def test_reference_points_of_couplings_are_numbers(tmp_path):
    """As Abaqus/CAE writes them: a set of one node, surfaces of nodes with areas."""
    cards = (
        "*NODE\n1, 9., 9., 9.\n*NSET, NSET=RP, INTERNAL\n1,\n*NSET, NSET=EDGE, INSTANCE=J\n1, 2\n"
        "*SURFACE, TYPE=NODE, NAME=EDGE_CNS_, INTERNAL\nEDGE, 1.\n*COUPLING, CONSTRAINT NAME=C, REF NODE=RP, "
        "SURFACE=EDGE_CNS_\n*KINEMATIC\n1, 3\n"
    )
    text = written(tmp_path, read_text(tmp_path, two(assembly=cards)))
    assert "*COUPLING, CONSTRAINT NAME=C, REF NODE=21, SURFACE=EDGE_CNS_\n*KINEMATIC\n1, 3\n" in text
    assert "*SURFACE, TYPE=NODE, NAME=EDGE_CNS_\nEDGE\n" in text
    with pytest.raises(fs.ReadError, match="in.inp:24: CalculiX has no areas of nodes in a surface"):
        read_text(tmp_path, two(assembly=cards.replace("EDGE, 1.", "EDGE, 2.5")))


def test_springs_along_their_nodes_turn_with_these(tmp_path):
    cards = "*ELEMENT, TYPE=SPRINGA, ELSET=SP\n7, 1, 4\n*SPRING, ELSET=SP\n\n100.\n"
    text = written(tmp_path, read_text(tmp_path, two(cards, second=QUARTER)))
    assert "*SPRING, ELSET=J_SP\n\n100.\n" in text


def test_keyword_lines_go_on_behind_comments_and_are_one_line_in_the_end(tmp_path):
    """CalculiX ignores what stands on a further line: NLGEOM, without a word."""
    deck = two("*SHELL SECTION, ELSET=E,\n** which\n MATERIAL=M\n1.\n", after="*STEP, NAME=S,\n NLGEOM=YES\n*STATIC\n")
    deck = deck.replace("TYPE=S3, ELSET=E", "TYPE=S3,\n** c\n ELSET=E").replace("NAME=J,", "NAME=J,\n ** c\n")
    mesh = read_text(tmp_path, deck)
    assert members(mesh) == {("I_E", "element"): [1, 2], ("J_E", "element"): [11, 12]}
    text = written(tmp_path, mesh)
    assert "*STEP, NAME=S, NLGEOM=YES\n" in text and text.count("\n** which\n") == 2
    assert "*SHELL SECTION, ELSET=J_E, MATERIAL=M\n" in text
    assert not [line for line in text.splitlines() if line.startswith("*") and line.endswith(",")]


def test_sets_with_an_instance_may_name_its_sets(tmp_path):
    mesh = read_text(tmp_path, two(assembly="*NSET, NSET=S, ELSET=E, INSTANCE=J\n"))
    assert "ELSET=J_E" in written(tmp_path, mesh)


def test_terms_of_equations_may_be_sets_of_one_node(tmp_path):
    """As Abaqus/CAE writes them."""
    sets = "*NSET, NSET=A, INSTANCE=I\n3\n*NSET, NSET=B, INSTANCE=J\n4\n*NSET, NSET=C, INSTANCE=J\n3, 4\n"
    mesh = read_text(tmp_path, two(assembly=sets + "*EQUATION\n2\nA, 3, 1.\nb, 3, -1.\n"))
    assert "*EQUATION\n2\n3, 3, 1.\n14, 3, -1.\n" in written(tmp_path, mesh)
    mesh = read_text(tmp_path, two(assembly=sets + "*EQUATION\n2\nA, 3, 1.\nC, 3, -1.\n"))
    assert "in.inp:26: 'C' of *EQUATION is a set of several nodes; CalculiX wants the" in " ".join(mesh.input_warnings)


@needs_ccx
def test_supports_by_name_hold_what_they_say(tmp_path):
    by_name, by_number = (
        solve(tmp_path, written(tmp_path, read_text(tmp_path, PARTS.replace("FIX, 1, 3\n", f"FIX, {support}\n"))))[0]
        for support in ("Encastre", "1, 6")
    )
    assert by_name and all((by_name[node] == u).all() for node, u in by_number.items())
    text = written(
        tmp_path, read_text(tmp_path, two(after="*BOUNDARY\nI.1, XSYMM\nI.2, 1, 2\nJ.2, zasymm\nJ.3, PINNED\n"))
    )
    assert "*BOUNDARY\n1, 1, 1\n2, 1, 2\n12, 1, 2\n13, 1, 3\n1, 5, 6\n12, 6, 6\n" in text


def test_two_instances_turned_about_each_other(tmp_path):
    axis = "2., 3., 1., 2.5, 3.5, 4."
    mesh = read_text(tmp_path, two(second=f"1., -2., 0.5\n{axis}, 37.5\n"))
    a, k = np.array((2, 3, 1.0)), np.array((0.5, 0.5, 3.0)) / np.linalg.norm((0.5, 0.5, 3.0))
    x = mesh.points[:4] + (1, -2, 0.5) - a
    c, s = math.cos(math.radians(37.5)), math.sin(math.radians(37.5))
    turned_points = c * x + s * np.cross(k, x) + (1 - c) * np.outer(x @ k, k) + a
    np.testing.assert_allclose(mesh.points[4:], turned_points, atol=1e-14)
    written(tmp_path, mesh)
    np.testing.assert_array_equal(fs.read(tmp_path / "out.inp").points, mesh.points)


def test_instances_hold_meshes_of_their_own(tmp_path):
    mesh = read_text(
        tmp_path,
        "*PART, NAME=P\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P, PART=P\n0., 0., 3.\n"
        + SHEET
        + "*END INSTANCE\n*NSET, NSET=N, INSTANCE=P\n1\n*END ASSEMBLY\n",
    )
    assert mesh.points[:, 2].tolist() == [3] * 4
    assert members(mesh) == {("E", "element"): [1, 2], ("N", "node"): [1]}


def test_a_part_without_an_instance_is_left_out_with_a_word(tmp_path):
    mesh = read_text(tmp_path, two(more="*PART, NAME=SPARE\n" + SHEET + "*END PART\n"))
    assert mesh.node_count == 8
    assert (
        "in.inp:11: part 'SPARE' has no instance, so nothing of it is in the model; left out" in mesh.input_warnings[1]
    )


def test_local_systems_and_cylindrical_coordinates_are_worked_out(tmp_path):
    cards = "*SYSTEM\n1., 0., 0., 1., 1., 0.\n*NODE\n5, 2., 0., 1.\n*SYSTEM\n*NODE, SYSTEM=C\n6, 2., 90., 5.\n"
    mesh = read_text(tmp_path, two(cards))
    points = dict(zip(mesh.node_ids.tolist(), mesh.points))
    np.testing.assert_allclose(points[5], (1, 2, 1), atol=1e-15)
    np.testing.assert_allclose(points[6], (0, 2, 5), atol=1e-15)
    np.testing.assert_allclose(points[15], (6, 2, 1), atol=1e-15)
    assert "SYSTEM" not in written(tmp_path, mesh).upper()


def test_cards_of_newer_versions_are_no_reason_to_refuse(tmp_path):
    deck = PARTS.replace("*Step", "*Rate Dependent, type=JOHNSON COOK\n1., 2.\n*Soils\n0.5, 10.\n*Step")
    result = fs.crack(read_text(tmp_path, deck), fs.Plane((1.1, 0.5, 0.5), (1, 0.1, 0)), strict=True)
    (warning,) = result.report.warnings
    assert re.search(r"in.inp:\d+: \*SOILS is not a card of CalculiX up to 2.23: it names no node or element", warning)
    deck = PARTS.replace("*Step", "*Soils\n0.5, 10\n*Step")
    mesh = read_text(tmp_path, deck.replace("*Soils\n0.5, 10", "*Soils\n10, 0.5"))
    assert "*SOILS is not a card of CalculiX: whether its numbers are nodes or elements" in mesh.input_warnings[1]
    with pytest.raises(fs.Error, match=r"\*SOILS is not a card of CalculiX up to 2.23: whether it names nodes"):
        fs.crack(mesh, fs.Plane((1.1, 0.5, 0.5), (1, 0.1, 0)), strict=True)


def test_element_cards_that_have_lost_their_lines_are_not_written(tmp_path):
    bricks = "".join(f"{n + 1},{n % 3},{n // 3 % 2},{n // 6}\n" for n in range(12))
    text = f"*NODE\n{bricks}*ELEMENT, TYPE=C3D8, ELSET=ALL\n** kept\n1,1,2,5,4,7,8,11,10\n2,2,3,6,5,8,9,12,11\n"
    text += "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n"
    mesh = fs.crack(read_text(tmp_path, text), fs.Plane((0.6, 0.5, 0.5), (1, 0.2, 0.1))).mesh
    assert "hexahedron" not in mesh.cells
    out = written(tmp_path, mesh)
    assert "C3D8" not in out and "** kept" in out
    assert len(fs.read(tmp_path / "out.inp").groups["ALL"]) == len(mesh.cells["tetra"])
