# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cards by which Abaqus says part of the mesh in other words than CalculiX: put in CalculiX's words, or refused."""

import re
import shutil

import numpy as np
import pytest
from calculix_runs import solve

import femscalpel as fs

needs_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
SHEET = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n5,1,1,0\n*ELEMENT, TYPE=S3, ELSET=E\n1,1,2,3\n3,2,5,3\n"


def read_text(folder, text, name="in.inp"):
    (folder / name).write_text(text)
    return fs.read(folder / name)


def written(folder, mesh, name="out.inp"):
    fs.write(mesh, folder / name)
    return (folder / name).read_text()


def parts(cards="", assembly="", after=""):
    return (
        f"*PART, NAME=P\n{SHEET}{cards}*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
        f"*INSTANCE, NAME=J, PART=P\n5.,0.,0.\n*END INSTANCE\n{assembly}*END ASSEMBLY\n{after}"
    )


MAKERS = ("NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "IMPORT", "SYMMETRIC MODEL GENERATION")


@pytest.mark.parametrize("keyword", MAKERS)
def test_cards_that_make_part_of_the_mesh_are_refused(tmp_path, keyword):
    for text in (SHEET + f"*{keyword}\n1, 3, 1\n", parts(f"*{keyword.lower()}\n1, 3, 1\n")):
        line = text[: text.lower().index("*" + keyword.lower())].count("\n") + 1
        with pytest.raises(fs.ReadError, match=rf"in.inp:{line}: \*{keyword} .* when Abaqus reads .* lists all nodes"):
            read_text(tmp_path, text)


@pytest.mark.parametrize(
    "text, words",
    [
        (SHEET + "*SYSTEM\n1.,0.,0.\n*NODE\n9,0.,0.,0.\n", r"in.inp:9: \*SYSTEM: Abaqus takes the coordinates that"),
        (SHEET + "*NODE, SYSTEM=C\n9,1.,90.,0.\n", r"in.inp:9: SYSTEM=C of \*NODE: CalculiX takes the numbers for x"),
        (SHEET + "*NSET, NSET=N, GEN\n1,5,1\n", r"in.inp:9: GEN of \*NSET: Abaqus takes it for GENERATE, CalculiX"),
        (SHEET + "*SURFACE, NAME=S, COMBINE=UNION\nA, B\n", r"in.inp:9: \*SURFACE with COMBINE: CalculiX has no"),
        (SHEET + "*SURFACE, NAME=S\nE,\n", "in.inp:10: the face is missing behind 'E': S1 to S6, SNEG, SPOS"),
        (SHEET + "*SURFACE, NAME=S\nE, E2\n", "in.inp:10: 'E2' is not a face.*; edges E1 to E4 of a shell are S3 to"),
        (SHEET + "*SURFACE, TYPE=CYLINDER, NAME=S\n", r"in.inp:9: \*SURFACE of TYPE=CYLINDER; .* Give the surface ele"),
        (SHEET + "*NSET, NSET=N, ELSET=NO\n", r"in.inp:9: \*NSET, ELSET=NO: there is no element set 'NO'"),
        (
            SHEET + "*ELEMENT, TYPE=S3\n3,1,2,3\n",
            r"in.inp:10: element number 3 is used before \(.*in.inp:8\); give one",
        ),
        (SHEET + "*ELEMENT, TYPE=XYZ\n9,1,2,3\n", "in.inp:9: elements of type XYZ are not known to CalculiX; take a"),
        (parts(assembly="*NSET, NSET=N\nJ.4\n"), "in.inp:18: instance 'J' has no node 4: its nodes are 1 to 5, with g"),
        (parts(after="*STEP\n*CLOAD\nI.4, 1, 1.\n"), "in.inp:20: instance 'I' has no node 4"),
        (parts(assembly="*ELSET, ELSET=X\nJ.2\n"), "in.inp:18: instance 'J' has no element 2: its elements are 1 to 3"),
        (parts("*NSET, NSET=N\n4\n"), "in.inp:11: instance 'I' has no node 4"),
    ],
    ids=range(14),
)
def test_what_would_be_another_mesh_is_refused(tmp_path, text, words):
    with pytest.raises(fs.ReadError, match=words):
        read_text(tmp_path, text)


def test_an_instance_alone_has_no_more_numbers_than_its_part(tmp_path):
    text = f"*PART, NAME=P\n{SHEET}*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n*END INSTANCE\n"
    with pytest.raises(fs.ReadError, match="in.inp:15: instance 'P-1' has no node 9: its nodes are 1 to 5"):
        read_text(tmp_path, text + "*NSET, NSET=N\nP-1.9\n*END ASSEMBLY\n")


def test_lines_of_data_in_files_of_their_own_are_read(tmp_path):
    (tmp_path / "more").mkdir()
    (tmp_path / "more/nodes.txt").write_text("** places\n7, 2., 0., 0.\n8, 2., 1., 0.")
    (tmp_path / "elements.txt").write_text("8, 2, 7, 5\n9, 7, 8, 5\n")
    (tmp_path / "load.txt").write_text("7, 1, 5.\n")
    mesh = read_text(
        tmp_path,
        SHEET + '*NODE, NSET=N, INPUT="more/nodes.txt"\n*ELEMENT, INPUT=elements.txt, TYPE=S3, ELSET=E\n'
        "*NODE\n10, 5., 5., 5.\n*STEP\n*STATIC\n*CLOAD, INPUT=load.txt\n8, 1, 2.\n*END STEP\n",
    )
    assert mesh.node_ids.tolist() == [1, 2, 3, 5, 7, 8, 10]
    assert mesh.groups["E"].ids.tolist() == [1, 3, 8, 9] and mesh.groups["N"].ids.tolist() == [7, 8]
    assert mesh.input_warnings == ()
    text = written(tmp_path, mesh)
    assert "INPUT" not in text and "*CLOAD\n7, 1, 5.\n8, 1, 2.\n" in text
    assert fs.read(tmp_path / "out.inp").node_ids.tolist() == mesh.node_ids.tolist()
    (tmp_path / "elements.txt").write_text("8, 2, 7, 5\n9, 7, 88, 5\n")
    with pytest.raises(fs.ReadError, match="elements.txt:2: element 9 names node 88, which"):
        fs.read(tmp_path / "in.inp")
    (tmp_path / "elements.txt").unlink()
    with pytest.raises(fs.ReadError, match=r"in.inp:10: the file 'elements.txt' with the lines of \*ELEMENT does not"):
        fs.read(tmp_path / "in.inp")


def test_node_sets_of_element_sets_have_their_nodes(tmp_path):
    mesh = read_text(tmp_path, SHEET + "*ELSET, ELSET=ONE\n3\n*NSET, NSET=N, ELSET=ONE\n*NSET, NSET=M\nN, 1\n")
    assert mesh.groups["N"].ids.tolist() == [2, 3, 5] and mesh.groups["M"].ids.tolist() == [1, 2, 3, 5]
    assert mesh.input_warnings == (
        f"{tmp_path}/in.inp:11: *NSET, ELSET=ONE: CalculiX passes over ELSET=, so the 3 nodes of these elements are "
        "listed instead",
    )
    assert "*NSET, NSET=N\n2, 3, 5,\n" in written(tmp_path, mesh)
    mesh = read_text(tmp_path, SHEET + "*ELSET, ELSET=NONE\n*NSET, NSET=N, ELSET=NONE\n")
    assert len(mesh.groups["N"]) == 0 and "that set has no elements, so there are" in mesh.input_warnings[0]
    mesh = read_text(tmp_path, parts(assembly="*NSET, NSET=N, ELSET=E, INSTANCE=J\n*NSET, NSET=M, ELSET=I.E\n"))
    assert mesh.groups["N"].ids.tolist() == [11, 12, 13, 15] and mesh.groups["M"].ids.tolist() == [1, 2, 3, 5]


def test_words_and_edges_of_abaqus_become_those_of_calculix_in_decks_of_parts(tmp_path):
    mesh = read_text(
        tmp_path,
        parts("*NSET, NSET=N, GEN\n1,5,1\n", "*SURFACE, NAME=S\nI.E, E2\nJ.1, e1\n*SURFACE, NAME=T\nJ.E, SPOS\n"),
    )
    assert mesh.groups["J_N"].ids.tolist() == [11, 12, 13, 15]
    assert mesh.groups["S"].ids.tolist() == [[1, 4], [3, 4], [11, 3]]
    assert "*SURFACE, NAME=S\nI_E, S4\n11, S3\n" in written(tmp_path, mesh)


CUBE = "*NODE\n" + "".join(f"{4 * k + 2 * j + i + 1},{i},{j},{k}\n" for k in (0, 1) for j in (0, 1) for i in (0, 1))


def test_hybrid_elements_stay_hybrid_in_their_parts(tmp_path):
    text = CUBE + "*ELEMENT, TYPE=C3D8RH, ELSET=RUBBER\n1,1,2,4,3,5,6,8,7\n"
    result = fs.crack(read_text(tmp_path, text), fs.Plane((0.5, 0, 0), (1, 0.1, 0)))
    assert "*ELEMENT, TYPE=C3D4H, ELSET=RUBBER\n" in written(tmp_path, result.mesh)


def test_cards_of_later_versions_are_told_with_their_version(tmp_path):
    cards = "*MATERIAL, NAME=M\n*ELASTIC\n1.,0.\n*PLASTIC\n1.,0.\n*RATE DEPENDENT, TYPE=JOHNSON COOK\n1.,2.,3.\n"
    mesh = read_text(tmp_path, SHEET + cards + "*DAMAGE INITIATION\n1.\n" + cards.replace("NAME=M", "NAME=N"))
    assert [w.split("in.inp:")[1] for w in mesh.input_warnings] == [
        "14: *RATEDEPENDENT is a card of CalculiX 2.21 and later; earlier ones pass over it",
        "16: *DAMAGEINITIATION is a card of CalculiX 2.23 and later; earlier ones pass over it",
    ]
    report = fs.crack(mesh, fs.Plane((0.4, 0, 0), (1, 0.1, 0)), strict=True).report
    assert not [w for w in report.warnings if "in.inp" in w]


@pytest.mark.parametrize("strict", (True, False))
def test_sections_and_materials_of_abaqus_name_no_nodes(tmp_path, strict):
    """Though their numbers could be those of nodes."""
    cards = (
        "*SHELL GENERAL SECTION, ELSET=E\n1, 2, 3\n*TRANSVERSE SHEAR STIFFNESS\n1, 1, 2\n*UEL PROPERTY, ELSET=E\n2, 3\n"
    )
    plane = fs.Plane((0.4, 0, 0), (1, 0.1, 0))
    report = fs.crack(read_text(tmp_path, SHEET + cards), plane, strict=strict).report
    assert sum("names no node or element by number and is kept" in w for w in report.warnings) == 3
    turned = parts(cards).replace("5.,0.,0.\n", "5.,0.,0.\n0.,0.,0.,0.,0.,1.,90.\n")
    text = written(tmp_path, read_text(tmp_path, turned))
    assert text.count("*TRANSVERSE SHEAR STIFFNESS\n1, 1, 2\n") == 2 and "*UEL PROPERTY, ELSET=J_E\n2, 3\n" in text


def test_the_first_places_of_nodes_cannot_follow(tmp_path):
    mesh = read_text(tmp_path, SHEET + "*INITIAL MESH\n1,0,0,0\n2,1.1,0,0\n*STEP\n*STATIC\n*END STEP\n")
    plane = fs.Plane((0.4, 0, 0), (1, 0.1, 0))
    with pytest.raises(fs.Error, match=r"in.inp:9: \*INITIAL MESH says where the nodes were in a first mesh, which"):
        fs.crack(mesh, plane, strict=True)


@needs_ccx
def test_a_support_by_an_element_set_holds(tmp_path):
    """A bar of two cubes, held at the nodes of the first."""
    nodes = "*NODE\n" + "".join(
        f"{4 * i + 2 * j + k + 1},{i},{j},{k}\n" for i in range(3) for j in (0, 1) for k in (0, 1)
    )
    deck = (
        nodes + "*ELEMENT, TYPE=C3D8, ELSET=FIRST\n1,1,5,7,3,2,6,8,4\n*ELEMENT, TYPE=C3D8, ELSET=SECOND\n"
        "2,5,9,11,7,6,10,12,8\n*NSET, NSET=HELD, ELSET=FIRST\n*MATERIAL, NAME=M\n*ELASTIC\n1000.,0.\n"
        "*ELSET, ELSET=ALL\nFIRST, SECOND\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*NSET, NSET=OUT, GENERATE\n1,12,1\n"
        "*STEP\n*STATIC\n*BOUNDARY\nHELD, 1, 3\n*CLOAD\n9,1,25.\n10,1,25.\n11,1,25.\n12,1,25.\n"
        "*NODE PRINT, NSET=OUT\nU\n*END STEP\n"
    )
    displacements = solve(tmp_path, written(tmp_path, read_text(tmp_path, deck)))[0]
    np.testing.assert_allclose([displacements[n] for n in range(1, 9)], 0, atol=1e-15)
    np.testing.assert_allclose([displacements[n][0] for n in range(9, 13)], 0.1, rtol=1e-6)


BLOCK = (
    CUBE + "9, 0.5, 0.5, 3.\n*ELEMENT, TYPE=C3D8, ELSET=E\n1,1,2,4,3,5,6,8,7\n*SOLID SECTION, ELSET=E, MATERIAL=M\n,\n"
)


def block(assembly, load):
    """A cube, held at its bottom, and node 9 above it."""
    return (
        f"*PART, NAME=P\n{BLOCK}*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
        "*NSET, NSET=RP, INSTANCE=I\n9\n*NSET, NSET=TOP, INSTANCE=I\n5,6,7,8\n*SURFACE, NAME=LID\nI.1, S2\n"
        f"{assembly}*END ASSEMBLY\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.\n*DENSITY\n1.\n*STEP\n*STATIC\n*BOUNDARY\n"
        f"I.1, 1, 3\nI.2, 1, 3\nI.3, 1, 3\nI.4, 1, 3\n{load}*NODE PRINT, NSET=TOP\nU\n*END STEP\n"
    )


COUPLING = "*COUPLING, CONSTRAINT NAME=C, REF NODE=RP, SURFACE=LID\n*KINEMATIC\n"


@needs_ccx
@pytest.mark.parametrize(
    "constraint, says",
    [
        (COUPLING, "KINEMATIC: CalculiX couples degrees of freedom 1 to 3 alone"),
        (COUPLING + "** all\n1, 6\n", "KINEMATIC: CalculiX couples degrees of freedom 1 to 3 alone"),
        (COUPLING + "1, 1\n2, 2\n3, 3\n4, 4\n5, 5\n6, 6\n", "KINEMATIC: CalculiX couples degrees of freedom 1 to 3"),
        ("*RIGID BODY, REF NODE=RP, TIE NSET=TOP\n", ""),
        ("*RIGID BODY, REF NODE=RP, PIN NSET=TOP\n", "PIN NSET= of .* becomes NSET="),
    ],
    ids=("bare", "range", "six lines", "tie nset", "pin nset"),
)
def test_constraints_as_abaqus_writes_them_hold_in_calculix(tmp_path, constraint, says):
    """As they stand CalculiX passes over them without an error, and the load moves nothing; or it stops."""
    mesh = read_text(tmp_path, block(constraint, "*CLOAD\nRP, 1, 1.\n"))
    got = solve(tmp_path, written(tmp_path, mesh))[0]
    wanted = solve(tmp_path, written(tmp_path, read_text(tmp_path, block(COUPLING + "1, 3\n", "*CLOAD\nRP, 1, 1.\n"))))[
        0
    ]
    assert abs(wanted[8][0]) > 0.01
    for node, u in wanted.items():
        np.testing.assert_allclose(got[node], u, atol=1e-9)
    assert any(re.search(says, w) for w in mesh.input_warnings) and len(mesh.input_warnings) == 1 + bool(says)


@needs_ccx
def test_gravity_without_a_set_is_that_of_all_elements(tmp_path):
    mesh = read_text(tmp_path, block("", "*DLOAD\n, GRAV, 9.81, 0., 0., -1.\n"))
    assert mesh.groups["ALL_ELEMENTS"].ids.tolist() == [1]
    assert "a load without a set is that of the whole model" in mesh.input_warnings[1]
    displacements = solve(tmp_path, written(tmp_path, mesh))[0]
    np.testing.assert_allclose(displacements[8][2], -9.81 / 2 / 1000, rtol=1e-6)
    cracked = fs.crack(mesh, fs.Plane((0.5, 0, 0), (1, 0.1, 0.05))).mesh
    assert len(cracked.groups["ALL_ELEMENTS"]) == len(cracked.cell_ids["tetra"])


def test_constraints_that_calculix_passes_over_are_told(tmp_path):
    deck = BLOCK + "*SURFACE, NAME=LID\n1, S2\n*COUPLING, CONSTRAINT NAME=C, REF NODE=9, SURFACE=LID\n*KINEMATIC\n"
    mesh = read_text(tmp_path, deck + "*NSET, NSET=TOP\n5,6,7,8\n*RIGID BODY, REF NODE=9, TIE NSET=TOP\n")
    assert [w.split("in.inp:")[1] for w in mesh.input_warnings] == [
        "18: *KINEMATIC without a line couples nothing in CalculiX; give it degrees of freedom (1, 3)",
        "21: *RIGID BODY without NSET= or ELSET= is none in CalculiX; say its nodes by NSET=",
    ]
