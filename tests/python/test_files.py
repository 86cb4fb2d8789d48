# SPDX-License-Identifier: LGPL-2.1-or-later
import pathlib
import re
import subprocess
import sys
import warnings

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


def written(mesh, path):
    """What is told when a mesh is written."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        fs.write(mesh, path)
    return " ".join(str(w.message) for w in caught)


@pytest.mark.parametrize("suffix", BOTH_WAYS)
def test_meshes_without_nodes_are_not_written(tmp_path, suffix):
    with pytest.raises(fs.WriteError, match="nodes"):
        fs.write(fs.Mesh([], {}), tmp_path / ("a" + suffix))
    assert not list(tmp_path.iterdir())


def test_losses_of_vtu_are_told(tmp_path):
    mesh = box_with_groups()
    assert written(mesh, tmp_path / "a.vtu") == ""
    mesh.unit = "mm"
    mesh.add_group("a\tb", "node", mesh.node_ids[:2])
    told = written(mesh, tmp_path / "a.vtu")
    assert "the control characters in the name of the node group 'a_b'; the unit 'mm'" in told
    assert fs.read(tmp_path / "a.vtu").groups["a_b"].ids.tolist() == mesh.node_ids[:2].tolist()


def test_losses_of_med_are_told(tmp_path):
    mesh = box_with_groups()
    mesh.unit = "mm"
    name = mesh.groups.all("element")[0].name
    mesh.add_group("ALONE", "facet", [(int(mesh.cell_ids["tetra"][0]), 1)])
    assert written(mesh, tmp_path / "a.med") == ""
    mesh.add_group(name, "facet", [(int(mesh.cell_ids["tetra"][0]), 1)])
    assert f"does not hold the name of the facet group '{name}', called '{name}_SURF' there" in written(
        mesh, tmp_path / "a.med"
    )
    assert f"{name}_SURF" in [g.name for g in fs.read(tmp_path / "a.med").groups.all()]


def test_digits_that_decks_have_no_room_for(tmp_path):
    """They are rounded, which is no loss to tell."""
    mesh = box_with_groups()
    points = np.array(mesh.points)
    points[:3, 0] = (1.2345678901234567e-5, -1.2345678901234567e-5, 1 / 3e6)
    assert written(fs.Mesh(points, mesh.cells), tmp_path / "a.inp") == ""
    back = fs.read(tmp_path / "a.inp")
    assert 0 < np.abs(back.points - points).max() < 1e-18 and written(back, tmp_path / "b.inp") == ""
    # What keeps its line of a deck keeps its digits, however many they are.
    text = (tmp_path / "a.inp").read_text()
    line = next(line for line in text.splitlines() if line.startswith("2, "))
    long = "2, -0.000012345678901234567, " + line.split(", ", 2)[2]
    (tmp_path / "c.inp").write_text(text.replace(line, long))
    kept = fs.read(tmp_path / "c.inp")
    assert kept.points[1, 0] == points[1, 0] and written(kept, tmp_path / "d.inp") == ""
    assert fs.read(tmp_path / "d.inp").points[1, 0] == points[1, 0]


@pytest.mark.parametrize("suffix", [".inp", ".bdf"])
def test_the_largest_coordinates(tmp_path, suffix):
    largest = np.finfo(float).max
    mesh = fs.Mesh([[0, 0, 0], [largest, 0, 0], [0, -largest, 0], [0, 0, 1]], {"tetra": [[0, 1, 2, 3]]})
    told = written(mesh, tmp_path / ("a" + suffix))
    assert ("the last digits of the coordinates of" in told) == (suffix == ".bdf")
    np.testing.assert_allclose(fs.read(tmp_path / ("a" + suffix)).points, mesh.points, rtol=1e-8)


@pytest.mark.parametrize("suffix", BOTH_WAYS)
def test_disks_without_room(tmp_path, suffix):
    code = (
        "import resource, sys, numpy as np, femscalpel as fs\n"
        "mesh = fs.Mesh(np.random.default_rng(1).random((20000, 3)), {'tetra': [[0, 1, 2, 3]]})\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))\n"
        "try:\n"
        "    fs.write(mesh, sys.argv[1])\n"
        "except fs.WriteError as error:\n"
        "    print(error)\n"
    )
    path = tmp_path / ("a" + suffix)
    run = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True)
    assert run.returncode == 0 and run.stderr == "", (run.returncode, run.stderr)
    assert run.stdout.startswith(str(path)) and "disk" in run.stdout
    assert not list(tmp_path.iterdir())
