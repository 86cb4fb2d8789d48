# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files whose text is not UTF-8, or whose lines end in other ways."""

import json
import os
import shutil
import warnings

import numpy as np
import pytest

import femscalpel as fs
from calculix_runs import solve
from meshes import grid_box

NAME = "Größe_ÄÖ"
TEXT = [".inp", ".msh", ".unv", ".bdf", ".vtu"]


def model():
    mesh = grid_box()
    out = fs.Mesh(mesh.points, mesh.cells)
    out.add_group(NAME, "node", out.node_ids[:7])
    out.add_group("E" + NAME, "element", next(iter(out.cell_ids.values())))
    return out


def written(tmp_path, suffix, change):
    """The model as a file whose bytes are changed."""
    path = tmp_path / ("a" + suffix)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        fs.write(model(), path)
    path.write_bytes(change(path.read_bytes()))
    return path


def latin(data):
    """A file's bytes with the names in Windows-1252."""
    return data.replace(NAME.encode(), NAME.encode("cp1252"))


def told(call, *arguments):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        return call(*arguments), [str(w.message) for w in caught]


def expect_model(mesh):
    np.testing.assert_array_equal(mesh.points, model().points)
    np.testing.assert_array_equal(mesh.groups[NAME, "node"].ids, model().groups[NAME, "node"].ids)
    assert len(mesh.groups["E" + NAME, "element"]) == mesh.cell_count


@pytest.mark.parametrize("suffix", TEXT)
def test_windows_1252(tmp_path, suffix):
    path = written(tmp_path, suffix, latin)
    mesh, said = told(fs.read, path)
    expect_model(mesh)
    line = 1 + path.read_bytes().split("ö".encode("cp1252"))[0].count(b"\n")
    (one,) = [s for s in said if "UTF-8" in s]
    assert one.startswith(f"{path}:{line}: the text is not UTF-8"), one
    assert NAME in json.dumps(fs.info(mesh).to_dict(), ensure_ascii=False)
    fs.check(mesh)
    result = fs.crack(mesh, fs.Plane((0.5, 0.5, 0.5), (1, 0.2, 0.1)))
    assert NAME in result.report.to_text()
    for other in [".med", *TEXT]:
        told(fs.write, mesh, tmp_path / ("b" + other))
        back, said = told(fs.read, tmp_path / ("b" + other))
        expect_model(back)
        assert not [s for s in said if "UTF-8" in s], "written as UTF-8"


def test_binary_gmsh_files(tmp_path):
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.add("m")
        box = gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(3, [box], 7)
        gmsh.model.setPhysicalName(3, 7, NAME)
        gmsh.model.mesh.generate(3)
        gmsh.option.setNumber("Mesh.Binary", 1)
        gmsh.write(str(tmp_path / "a.msh"))
    finally:
        gmsh.finalize()
    path = tmp_path / "a.msh"
    path.write_bytes(latin(path.read_bytes()))
    mesh, said = told(fs.read, path)
    assert [g.name for g in mesh.groups.all()] == [NAME]
    assert "a.msh: $PhysicalNames:3: the text is not UTF-8" in " ".join(said)


@pytest.mark.parametrize("suffix", TEXT[:-1])
def test_ends_of_lines_and_marks(tmp_path, suffix):
    plain, _ = told(fs.read, written(tmp_path, suffix, lambda b: b))
    for change in (
        lambda b: b.replace(b"\n", b"\r"),
        lambda b: b.replace(b"\n", b"\r\n"),
        lambda b: b"\xef\xbb\xbf" + b,
        lambda b: b"\xef\xbb\xbf" + b.replace(b"\n", b"\r"),
    ):
        mesh, said = told(fs.read, written(tmp_path, suffix, change))
        np.testing.assert_array_equal(mesh.points, plain.points)
        assert [(g.name, g.ids.tolist()) for g in mesh.groups.all()] == [
            (g.name, g.ids.tolist()) for g in plain.groups.all()
        ]
        assert not [s for s in said if "UTF-8" in s]


@pytest.mark.parametrize("suffix", TEXT)
@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "utf-32"])
def test_utf_16(tmp_path, suffix, encoding):
    mark = b"\xfe\xff" if encoding.endswith("be") else b""
    path = written(tmp_path, suffix, lambda b: mark + b.decode(errors="replace").encode(encoding))
    with pytest.raises(fs.ReadError, match="UTF-16 or UTF-32, which is not read; save it as UTF-8"):
        fs.read(path)


DECK = """*HEADING
Träger
*NODE, NSET=NALL
1,0,0,0
2,10,0,0
3,10,10,0
4,0,10,0
5,0,0,10
6,10,0,10
7,10,10,10
8,0,10,10
*ELEMENT, TYPE=C3D8, ELSET=Balken_Ö
1,1,2,3,4,5,6,7,8
*NSET,NSET=Größe
1,4,5,8
*MATERIAL, NAME=Stäbe
*ELASTIC
210000,.3
*SOLID SECTION, ELSET=Balken_Ö, MATERIAL=Stäbe
*STEP
*STATIC
*BOUNDARY
Größe,1,3
*CLOAD
7,1,10.
*NODE PRINT, NSET=Größe
U
*END STEP
"""


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_decks_find_their_sets(tmp_path):
    path = tmp_path / "a.inp"
    path.write_bytes(DECK.encode("latin-1"))
    mesh, said = told(fs.read, path)
    assert [s for s in said if s.startswith(f"{path}:2: the text is not UTF-8")]
    fs.write(mesh, tmp_path / "b.inp")
    text = (tmp_path / "b.inp").read_text("utf-8")
    assert text.count("Größe") == 3 and text.count("Balken_Ö") == 2 and text.count("Stäbe") == 2
    displacements, _ = solve(tmp_path, text)
    assert sorted(displacements) == [1, 4, 5, 8] and not np.any(list(displacements.values()))


@pytest.mark.parametrize(
    "old, new",
    [
        ("FIX,1,3", "Größe,1,3"),
        ("*STEP", "*GRÖSSE\n*STEP"),
        ("C3D8", "C3DÖ"),
        ("1,1,2,3,4,5", "1,1,2,3,4,Größe"),
        ("*STEP", "*INCLUDE, INPUT=ä.inc\n*STEP"),
        ("NSET=NALL", "NSET=NALL, GRÖSSE=1"),
    ],
)
def test_messages_about_odd_decks_are_text(tmp_path, old, new):
    path = tmp_path / "a.inp"
    path.write_bytes(DECK.replace("Größe", "FIX").replace(old, new).encode("latin-1"))
    try:
        mesh, _ = told(fs.read, path)
    except fs.ReadError as error:
        assert "\ufffd" not in str(error)
        return
    report = fs.crack(mesh, fs.Plane((5, 5, 5), (1, 0.1, 0.1))).report
    assert "\ufffd" not in fs.info(mesh).to_text() + report.to_text() + " ".join(report.warnings)
    fs.write(mesh, tmp_path / "b.inp")


def deck_in_two_files(folder, name, encoding, more=""):
    """The deck, its nodes and `more` in a file of that name, which is bytes."""
    head, rest = DECK.split("*NODE", 1)
    nodes, rest = rest.split("*ELEMENT", 1)
    path = folder / "a.inp"
    path.write_bytes(f"{head}*INCLUDE, INPUT=Stäbe – 1.inc\n*ELEMENT{rest}".encode(encoding))
    (folder / os.fsdecode(name)).write_text(f"*NODE{nodes}{more}")
    return path


@pytest.mark.parametrize("deck", ["utf-8", "cp1252"])
@pytest.mark.parametrize("disk", ["utf-8", "cp1252"])
@pytest.mark.parametrize("blanks", [True, False])
def test_included_files(tmp_path, deck, disk, blanks):
    name = "Stäbe – 1.inc" if blanks else "Stäbe–1.inc"
    path = deck_in_two_files(tmp_path, name.encode(disk), deck)
    if (deck, disk) == ("utf-8", "cp1252"):  # no such name stands there
        with pytest.raises(fs.ReadError, match="the included file 'Stäbe – 1.inc' does not exist"):
            told(fs.read, path)
        return
    mesh, _ = told(fs.read, path)
    assert mesh.node_count == 8


@pytest.mark.parametrize("deck", ["utf-8", "cp1252"])
def test_included_files_of_both_names(tmp_path, deck):
    for encoding in ("utf-8", "cp1252"):
        more = "99,9,9,9\n" if encoding == deck else ""
        path = deck_in_two_files(tmp_path, "Stäbe – 1.inc".encode(encoding), deck, more)
    mesh, _ = told(fs.read, path)
    assert 99 in mesh.node_ids, "that of the bytes that stand in the deck"


def test_parts_and_instances(tmp_path):
    path = tmp_path / "a.inp"
    nodes, rest = DECK.split("*NSET")[0].split("*NODE")[1], DECK.split("*MATERIAL")[1]
    path.write_bytes(
        (
            f"*PART, NAME=Träger\n*NODE{nodes}*END PART\n*ASSEMBLY, NAME=Ä\n*INSTANCE, NAME=Träger-1, PART=Träger\n"
            "*END INSTANCE\n*NSET, NSET=Größe, INSTANCE=Träger-1\n1,4\n*END ASSEMBLY\n*MATERIAL"
            + rest.split("*SOLID")[0]
        ).encode("latin-1")
    )
    mesh, said = told(fs.read, path)
    assert [i.name for i in mesh.instances] == ["Träger-1"] and mesh.groups["Größe", "node"].ids.tolist() == [1, 4]
    assert "Träger-1" in " ".join(said)


def test_xml_that_says_its_encoding(tmp_path):
    path = written(
        tmp_path,
        ".vtu",
        lambda b: b'<?xml version="1.0" encoding="ISO-8859-1"?>\n' + latin(b).split(b"?>", 1)[-1].lstrip(),
    )
    mesh, said = told(fs.read, path)
    expect_model(mesh)
    assert not said


def test_names_in_med_files(tmp_path):
    path = tmp_path / "a.med"
    told(fs.write, model(), path)
    data, name = path.read_bytes(), NAME.encode()
    assert data.count(name) >= 2
    path.write_bytes(data.replace(name, latin(name).ljust(len(name), b"\0")))
    mesh, said = told(fs.read, path)
    assert "a.med: names of groups are not UTF-8" in " ".join(said)
    expect_model(mesh)
