# SPDX-License-Identifier: LGPL-2.1-or-later
"""Universal files: those of Gmsh, and closed loops through Python. FreeCAD's are in tests/freecad."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups
from test_msh_reader import box, gmsh, groups_in_gmsh, nodes_of  # noqa: F401


@pytest.mark.parametrize("order, recombined", [(1, False), (1, True), (2, False)])
def test_files_of_gmsh(tmp_path, gmsh, order, recombined):  # noqa: F811
    """What Gmsh exports, as FreeCAD's own mesher does on its way."""
    box(gmsh, order, recombined)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1)
    path = tmp_path / "box.unv"
    gmsh.option.setNumber("Mesh.SaveGroupsOfNodes", 0)
    gmsh.write(str(path))
    mesh = fs.Mesh._wrap(fs._engine.read(str(path)))
    mesh.validate()
    numbers, points, _ = gmsh.model.mesh.getNodes()
    by_number = dict(zip(numbers.tolist(), points.reshape(-1, 3)))
    for number, point in zip(mesh.node_ids.tolist(), mesh.points):
        np.testing.assert_allclose(point, by_number[number], rtol=1e-14, atol=1e-300)
    measures = fs.measure(mesh)
    assert sum(v.sum() for kind, v in measures.items() if fs.mesh.CELL_TYPES[kind][0] == 3) == pytest.approx(6)
    assert all((v > 0).all() for v in measures.values())
    expected = groups_in_gmsh(gmsh)
    for group in mesh.groups.all("element"):
        name = {"Körper_1": "Körper 1", "wall_2": "wall 2"}.get(group.name, group.name)
        if name in (
            "tips",
            "PhysicalLine5",
        ):  # Gmsh calls points so, and names point elements here that it does not write
            assert len(group) == 0
            assert f"group '{name}' names 2 nodes or elements that the file does" in " ".join(mesh.input_warnings)
        elif name != "wall":
            assert nodes_of(mesh, group) == expected[name]
    assert len(mesh.groups["wall"]) == len(expected["wall"])
    assert "several groups are called 'wall'; they are one" in " ".join(mesh.input_warnings)


def test_losses_are_told(tmp_path):
    mesh = box_with_groups()
    long = "a name of more than forty characters, as nobody would give one"
    mesh.add_group(long, "node", mesh.node_ids[:3])
    mesh.unit = "mm"
    expected = f"box.unv does not hold that the empty group 'EMPTY' is one of nodes; the name '{long}' for .*; the unit"
    with pytest.warns(UserWarning, match=expected):
        fs.write(mesh, tmp_path / "box.unv")
    back = fs.read(tmp_path / "box.unv")
    assert list(back.groups[long].ids) == list(mesh.groups[long].ids)


def test_cracked(tmp_path):
    result = fs.crack(box_with_groups(), fs.Plane(origin=(3, 2.5, 2.2), normal=(0.1, 0.2, 1)), name="CRACK")
    result.mesh.remove_group("EMPTY")
    fs.write(result.mesh, tmp_path / "cracked.unv")
    back = fs.read(tmp_path / "cracked.unv")
    np.testing.assert_array_equal(back.points, result.mesh.points)
    assert [(g.name, g.kind, g.ids.tolist()) for g in back.groups.all()] == [
        (g.name, g.kind, g.ids.tolist()) for g in result.mesh.groups.all()
    ]


@pytest.mark.parametrize("largest", [999999999, 1000000000, 2147483647])
def test_numbers_of_ten_digits(tmp_path, largest):
    points = np.eye(4, 3)
    nodes = [largest - k for k in range(4)]
    mesh = fs.Mesh(
        points,
        {"tetra": [[0, 1, 2, 3]], "line": [[0, 1], [2, 3]]},
        node_ids=nodes,
        cell_ids={"tetra": [largest], "line": [largest - 1, 7]},
        groups=[("N", "node", nodes[:3]), ("E", "element", [7, largest - 1, largest])],
    )
    fs.write(mesh, tmp_path / "a.unv")
    back = fs.read(tmp_path / "a.unv")
    assert not back.input_warnings and back.node_ids.tolist() == nodes
    for name in ("tetra", "line"):
        np.testing.assert_array_equal(back.cells[name], mesh.cells[name])
        np.testing.assert_array_equal(back.cell_ids[name], mesh.cell_ids[name])
    for group in mesh.groups.all():
        assert sorted(back.groups[group.name].ids) == sorted(group.ids)
