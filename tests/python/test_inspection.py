# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a mesh holds and what is odd in it, in Python and on the command line."""

import json
import os
import subprocess
import sys
import warnings

import numpy as np
import pytest

import femscalpel as fs
from femscalpel.command_line import main
from meshes import box_with_groups

CORNERS = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)], float)


def levels(mesh):
    return {(f.level, f.members) for f in fs.check(mesh)}


def test_info():
    mesh = box_with_groups()
    found = fs.info(mesh).to_dict()
    assert (found["nodes"], found["elements"], found["deck"]) == (mesh.node_count, mesh.cell_count, False)
    volume = fs.measure(mesh)["tetra"]
    assert found["types"]["tetra"]["measure"] == pytest.approx(volume.sum())
    assert found["types"]["tetra"]["least_mean_ratio"] == fs.mean_ratio(mesh)["tetra"].min()
    assert [(g["name"], g["kind"], g["count"]) for g in found["groups"]] == [
        (g.name, g.kind, len(g)) for g in mesh.groups.all()
    ]
    for group, g in zip(mesh.groups.all("element"), (g for g in found["groups"] if g["kind"] == "element")):
        inside = np.isin(mesh.cell_ids["tetra"], group.ids)
        assert g["measure"].get("3", 0.0) == pytest.approx(volume[inside].sum())
    assert json.loads(fs.info(mesh).to_json()) == found
    assert f"{mesh.node_count} nodes" in fs.info(mesh).to_text()
    assert "no nodes" in fs.info(fs.Mesh([], {})).to_text()


def test_nothing_is_odd_in_a_good_mesh():
    mesh = box_with_groups()
    assert all(f.level == "note" and f.kind == "group" for f in fs.check(mesh))


def test_inverted_and_flat_elements_are_errors():
    mesh = fs.Mesh(CORNERS, {"tetra": [(0, 1, 2, 3), (1, 2, 3, 4)]})
    assert levels(mesh) == set()
    turned = fs.Mesh(CORNERS, {"tetra": [(0, 2, 1, 3), (1, 2, 3, 4)]}, cell_ids={"tetra": [7, 9]})
    assert ("error", (7,)) in levels(turned)
    flat = fs.Mesh([*CORNERS[:3], (1, 1, 0)], {"tetra": [(0, 1, 2, 3)]})
    assert ("error", (1,)) in levels(flat)


def test_poor_and_folded_elements_are_warned_of():
    thin = fs.Mesh([*CORNERS[:3], (0.3, 0.3, 1e-4)], {"tetra": [(0, 1, 2, 3)]})
    assert ("warning", (1,)) in levels(thin)
    ends = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
    points = [*CORNERS[:4], *(0.5 * (CORNERS[a] + CORNERS[b]) for a, b in ends)]
    assert levels(fs.Mesh(points, {"tetra10": [range(10)]})) == set()
    quarter = [*points]
    quarter[4] = 0.25 * CORNERS[1]  # of an edge at a crack's front
    assert levels(fs.Mesh(quarter, {"tetra10": [range(10)]})) == set()
    folded = [*points]
    folded[4] = 0.05 * CORNERS[1]
    assert levels(fs.Mesh(folded, {"tetra10": [range(10)]})) == {("warning", (1,))}


def test_doubles_pieces_and_loose_nodes_are_told():
    points = [*CORNERS, (5, 5, 5), CORNERS[1] + 1e-12, CORNERS[2], CORNERS[3], (9, 0, 0)]
    cells = {"tetra": [(0, 1, 2, 3), (6, 7, 8, 4), (2, 0, 1, 3)]}
    mesh = fs.Mesh(points, cells, groups={"NONE": ("node", [])})
    found = {f.text.split(":")[0]: f for f in fs.check(mesh)}
    assert found["1 element is on the nodes of another one"].members == (3,)
    assert found["3 nodes are at the place of another one, as at the lips of a crack"].members == (7, 8, 9)
    assert found["2 nodes are of no element"].members == (6, 10)
    assert any(text.startswith("the mesh is in 2 pieces") for text in found)
    assert found["empty groups"].members == ("NONE",)


def test_quadrangles_that_cross_themselves():
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)], float)
    for order in ((0, 2, 1, 3), (0, 1, 3, 2), (0, 2, 3, 1)):
        for points in (square, square * (1.3, 1, 1) + square[:, :1] * (0, 0.2, 0.1) * square[:, 1:2]):
            mesh = fs.Mesh(points, {"quad": [order, (1, 4, 5, 2)]}, cell_ids={"quad": [7, 8]})
            assert ("error", (7,)) in levels(mesh)
            assert any(f.text == "1 element is crossing itself: 7" for f in fs.check(mesh))
            assert fs.mean_ratio(mesh)["quad"][0] < 0 < fs.mean_ratio(mesh)["quad"][1]
            assert fs.scaled_jacobian(mesh)["quad"][0] < 0 < fs.scaled_jacobian(mesh)["quad"][1]
    # As many turn their corners the other way round, or are twisted.
    inwards = fs.Mesh([(0, 0, 0), (1, 0, 0), (0.2, 0.2, 0), (0, 1, 0)], {"quad": [(0, 1, 2, 3)]})
    assert levels(inwards) == {("warning", (1,))} and fs.mean_ratio(inwards)["quad"][0] > 0
    twisted = fs.Mesh([(0, 0, 0.3), (1, 0, -0.3), (1, 1, 0.3), (0, 1, -0.3)], {"quad": [(0, 1, 2, 3)]})
    assert levels(twisted) == set()


def test_segments_without_a_length():
    mesh = fs.Mesh([(0, 0, 0), (1, 0, 0), (1, 0, 0)], {"line": [(0, 1), (1, 2)]})
    assert ("warning", (2,)) in levels(mesh)
    alone = fs.Mesh([(0, 0, 0), (0, 0, 0)], {"line": [(0, 1)]})
    assert ("warning", (1,)) in levels(alone)


@pytest.mark.parametrize("scale", [1e51, 1e160, 1e-160])
def test_sizes_that_nothing_can_be_computed_with(tmp_path, scale, capsys):
    path = str(tmp_path / "a.vtu")
    mesh = fs.Mesh(
        np.eye(4, 3) * scale, {"tetra": [(3, 0, 1, 2)], "triangle": [(0, 1, 2)]}, groups={"G": ("element", [1, 2])}
    )
    fs.write(mesh, path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        (found,) = fs.check(mesh)
        assert found.level == "error"
        assert main(["info", path, "--json"]) == 0
    json.loads(capsys.readouterr().out, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    assert main(["info", path]) == 0
    text = capsys.readouterr().out
    assert "nan" not in text and "inf" not in text
    assert main(["check", path]) == 1
    assert levels(fs.Mesh(np.eye(4, 3) * 1e49, {"tetra": [(3, 0, 1, 2)]})) == set()


def test_arguments_of_other_kinds():
    for function in (fs.info, fs.check):
        with pytest.raises(TypeError, match="mesh must be a femscalpel.Mesh"):
            function("mesh.med")


def test_command_line(tmp_path, capsys):
    mesh = box_with_groups()
    mesh.unit = "mm"
    path, out = str(tmp_path / "box.med"), str(tmp_path / "box.msh")
    fs.write(mesh, path)
    assert main(["info", path]) == 0
    assert f"{mesh.node_count} nodes" in capsys.readouterr().out
    assert main(["info", path, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["elements"] == mesh.cell_count
    assert main(["check", path]) == 0
    capsys.readouterr()
    assert main(["convert", path, out]) == 0
    assert "does not hold the unit 'mm'" in capsys.readouterr().err
    assert fs.read(out).node_count == mesh.node_count
    turned = str(tmp_path / "turned.med")
    fs.write(fs.Mesh(CORNERS[:4], {"tetra": [(0, 2, 1, 3)]}), turned)
    assert main(["check", turned, "--json"]) == 1
    assert json.loads(capsys.readouterr().out)[0]["members"] == [1]


def test_errors_of_the_command_line(tmp_path, capsys):
    assert main(["info", str(tmp_path / "none.med")]) == 2
    assert "none.med" in capsys.readouterr().err
    path = str(tmp_path / "box.med")
    fs.write(box_with_groups(), path)
    assert main(["convert", path, str(tmp_path / "box.xyz")]) == 1
    assert "box.xyz" in capsys.readouterr().err
    assert main(["info", path, "--mesh", "OTHER"]) == 2
    assert "OTHER" in capsys.readouterr().err
    with pytest.raises(SystemExit) as left:
        main(["nonsense"])
    assert left.value.code == 2


def test_as_a_module(tmp_path):
    path = str(tmp_path / "box.med")
    fs.write(box_with_groups(), path)
    run = subprocess.run([sys.executable, "-m", "femscalpel", "info", path], capture_output=True, text=True)
    assert run.returncode == 0 and "tetra" in run.stdout and run.stderr == ""


def run(*arguments, **environment):
    """The command line in a process of its own: status, output, errors."""
    done = subprocess.run(
        [sys.executable, "-m", "femscalpel", *arguments], capture_output=True, env={**os.environ, **environment}
    )
    assert b"Traceback" not in done.stderr, done.stderr.decode(errors="replace")
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize("name", [b"b\xff.med", "ü.med".encode(), b"b\xff.inp"])
@pytest.mark.parametrize("environment", [{}, {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}])
def test_names_of_files_in_any_encoding(tmp_path, name, environment):
    mesh = box_with_groups()
    mesh.unit = "mm"
    mesh.add_group("Größe", "node", mesh.node_ids[:3])
    folder = os.fsencode(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        fs.write(mesh, os.fsdecode(folder + b"/" + name))
    status, out, _ = run("info", folder + b"/" + name, **environment)
    assert status == 0 and (b"Gr\\xf6\\xdfe" if environment else "Größe".encode()) in out
    other = folder + b"/c" + name.replace(b".med", b".msh").replace(b".inp", b".msh")
    status, _, error = run("convert", folder + b"/" + name, other, **environment)
    assert status == 0 and os.path.exists(other)
    assert run("check", folder + b"/none" + name, **environment)[0] == 2
    assert run("info", folder + b"/" + name, "--mesh", os.fsencode("Größe"), **environment)[0] == 2


def test_exit_status(tmp_path):
    bad, odd = tmp_path / "bad.med", tmp_path / "odd.med"
    fs.write(fs.Mesh(CORNERS[:4], {"tetra": [(0, 2, 1, 3)]}), bad)
    odd.write_text("nothing")
    assert run("check", str(bad))[0] == 1
    for command in ("check", "info"):
        assert run(command, str(odd))[0] == 2 and run(command, str(tmp_path / "none.med"))[0] == 2
    assert run("convert", str(odd), str(tmp_path / "a.inp"))[0] == 2
    assert run("convert", str(bad), str(tmp_path / "none" / "a.inp"))[0] == 1
    for arguments in (["--help"], ["check", "--help"]):
        assert b"cannot be read" in run(*arguments)[1]
