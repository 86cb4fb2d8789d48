# SPDX-License-Identifier: LGPL-2.1-or-later
import pathlib
import re

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups

ROOT = pathlib.Path(__file__).resolve().parents[2]


def listed(way):
    """The extensions of the formats that can be read ("reads") or written ("writes"), as messages name them."""
    return ", ".join(e for f in fs.formats() if getattr(f, way) for e in f.extensions)


BOTH_WAYS = [e for f in fs.formats() if f.reads and f.writes for e in f.extensions]


@pytest.mark.parametrize("suffix", BOTH_WAYS)
@pytest.mark.parametrize("as_path", [str, pathlib.Path])
def test_round_trip(tmp_path, suffix, as_path):
    mesh = box_with_groups()
    path = as_path(tmp_path / ("box" + suffix))
    fs.write(mesh, path)
    back = fs.read(path)
    np.testing.assert_array_equal(back.points, mesh.points)
    np.testing.assert_array_equal(back.node_ids, mesh.node_ids)
    np.testing.assert_array_equal(back.cells["tetra"], mesh.cells["tetra"])
    np.testing.assert_array_equal(back.cell_ids["tetra"], mesh.cell_ids["tetra"])
    for group in mesh.groups.all():
        kind = "element" if suffix == ".unv" and len(group) == 0 else group.kind  # a loss that is told
        np.testing.assert_array_equal(back.groups[group.name, kind].ids, group.ids)


def test_formats():
    assert fs.formats()[:3] == [
        ("MED: Code_Aster, SALOME", (".med", ".mmed", ".rmed"), True, True),
        ("CalculiX", (".inp", ".inp.gz"), True, True),
        ("ParaView", (".vtu",), True, True),
    ]


@pytest.mark.parametrize("suffix", [e for f in fs.formats() if not f.reads for e in f.extensions])
def test_formats_that_are_written_only(tmp_path, suffix):
    path = tmp_path / ("box" + suffix)
    fs.write(box_with_groups(), path)
    assert path.stat().st_size > 1000
    with pytest.raises(fs.ReadError, match=f"can only be written; those that can be read are {listed('reads')}$"):
        fs.read(path)


def test_readme_lists_the_formats():
    rows = re.findall(r"^\| ([^|]+) \| (`\.[^|]+`) \| ([^|]*) \|$", (ROOT / "README.md").read_text(), re.M)
    assert rows == [
        (
            f.title,
            ", ".join(f"`{e}`" for e in f.extensions),
            ", ".join(["read"] * f.reads + ["written"] * f.writes),
        )
        for f in fs.formats()
    ]


def test_errors(tmp_path):
    with pytest.raises(fs.ReadError, match="nowhere.med"):
        fs.read(tmp_path / "nowhere.med")
    with pytest.raises(fs.ReadError, match="box.xyz"):
        fs.read(tmp_path / "box.xyz")
    known = f"box.xyz: the format is told by the extension, one of {listed('writes')}$"
    with pytest.raises(fs.WriteError, match=known):
        fs.write(box_with_groups(), tmp_path / "box.xyz")
    with pytest.raises(fs.WriteError):
        fs.write(box_with_groups(), tmp_path / "no" / "folder" / "box.med")
    with pytest.raises(TypeError, match="path must be a string"):
        fs.read(5)
    with pytest.raises(TypeError, match="mesh must be a femscalpel.Mesh"):
        fs.write("box.med", "box.med")


def test_files_of_med_2_3(capfd):
    """One tetrahedron, as SALOME 3 to 6 and Code_Aster 9 to 11 wrote it."""
    mesh = fs.read(pathlib.Path(__file__).parent / "files" / "med_2_3.med")
    assert mesh.points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    assert list(mesh.cells) == ["tetra"] and fs.measure(mesh)["tetra"] == pytest.approx([1 / 6])
    assert not any(capfd.readouterr())


def test_files_of_several_meshes(recwarn):
    path = pathlib.Path(__file__).parent / "files" / "two_meshes.med"
    assert fs.meshes_in(path) == ["FIRST", "SECOND"] and not recwarn
    with pytest.warns(UserWarning, match="holds 2 meshes: 'FIRST', 'SECOND'. The first was read"):
        first = fs.read(path)
    assert first.name == "FIRST"
    second = fs.read(path, mesh="SECOND")
    assert second.name == "SECOND"
    with pytest.raises(fs.ReadError, match="has no mesh 'THIRD'; it has 'FIRST', 'SECOND'"):
        fs.read(path, mesh="THIRD")
    with pytest.raises(fs.ReadError, match="hold one mesh, without a name"):
        fs.read("box.inp", mesh="A")
    assert fs.meshes_in("box.inp") == []
