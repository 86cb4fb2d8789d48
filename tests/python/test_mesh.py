# SPDX-License-Identifier: LGPL-2.1-or-later
import copy
import gc
import pickle

import numpy as np
import pytest

import femscalpel as fs
from femscalpel.mesh import CELL_TYPES

POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
CELLS = {"tetra": [[0, 1, 2, 3], [4, 2, 1, 3]], "triangle": [[0, 1, 2]]}


def make(**kwargs):
    return fs.Mesh(POINTS, CELLS, **kwargs)


def test_arrays():
    mesh = make()
    assert mesh.points.dtype == np.float64 and mesh.points.shape == (5, 3)
    np.testing.assert_array_equal(mesh.points, POINTS)
    np.testing.assert_array_equal(mesh.node_ids, [1, 2, 3, 4, 5])
    assert set(mesh.cells) == {"tetra", "triangle"}
    assert mesh.cells["tetra"].dtype == np.int64 and mesh.cell_ids["triangle"].dtype == np.int64
    np.testing.assert_array_equal(mesh.cells["tetra"], CELLS["tetra"])
    # Default numbers run over the types in the order given.
    np.testing.assert_array_equal(mesh.cell_ids["tetra"], [1, 2])
    np.testing.assert_array_equal(mesh.cell_ids["triangle"], [3])
    assert (mesh.dimension, mesh.node_count, mesh.cell_count) == (3, 5, 3)


def test_given_numbers():
    mesh = fs.Mesh(POINTS, CELLS, [50, 40, 30, 20, 10], {"triangle": [7], "tetra": [2**40, 1]})
    np.testing.assert_array_equal(mesh.node_ids, [50, 40, 30, 20, 10])
    np.testing.assert_array_equal(mesh.cell_ids["tetra"], [2**40, 1])


def test_every_element_type():
    for name, (dimension, nodes, corners) in CELL_TYPES.items():
        points = np.arange(3.0 * nodes).reshape(nodes, 3)
        mesh = fs.Mesh(points, {name: [range(nodes)]})
        assert mesh.dimension == dimension and 1 <= corners <= nodes
        np.testing.assert_array_equal(mesh.cells[name], [range(nodes)])


def test_views_share_memory_are_read_only_and_keep_the_mesh():
    mesh = make()
    first, second = mesh.points, mesh.points
    assert np.shares_memory(first, second)
    views = [mesh.points, mesh.node_ids, mesh.cells["tetra"], mesh.cell_ids["tetra"]]
    for view in views:
        assert not view.flags.owndata
        with pytest.raises(ValueError):
            view[0] = 0
        with pytest.raises(ValueError):
            view.flags.writeable = True
    expected = [v.copy() for v in views]
    del mesh, first, second, view
    gc.collect()
    junk = [np.full((50, 3), 1e30) for _ in range(200)]  # takes the memory the mesh would have left
    for view, values in zip(views, expected):
        np.testing.assert_array_equal(view, values)
    assert len(junk) == 200


def test_input_is_copied():
    points = np.array(POINTS, float)
    mesh = fs.Mesh(points, CELLS)
    points[0] = 99
    np.testing.assert_array_equal(mesh.points[0], [0, 0, 0])


def test_input_of_other_layouts():
    points = np.asfortranarray(np.array(POINTS, np.float32))
    cells = {"tetra": np.array(CELLS["tetra"], np.int32)[::-1], "triangle": np.array(CELLS["triangle"], np.uint16)}
    mesh = fs.Mesh(points, cells)
    np.testing.assert_array_equal(mesh.points, POINTS)
    np.testing.assert_array_equal(mesh.cells["tetra"], CELLS["tetra"][::-1])


def test_empty_mesh():
    mesh = fs.Mesh([], {})
    assert mesh.points.shape == (0, 3) and mesh.cells == {} and mesh.dimension == -1
    assert fs.Mesh(POINTS, {"tetra": []}).cells == {}


def test_groups():
    mesh = make(groups={"FIX": ("node", [3, 1, 1]), "PART": ("element", [3, 1]), "SIDE": ("facet", [[1, 4], [2, 1]])})
    assert list(mesh.groups) == ["FIX", "PART", "SIDE"] and len(mesh.groups) == 3
    assert "FIX" in mesh.groups and "fix" not in mesh.groups
    assert mesh.groups["FIX"].kind == "node"
    np.testing.assert_array_equal(mesh.groups["FIX"].ids, [1, 3])
    assert len(mesh.groups["FIX"]) == 2
    # Mesh order: by type of element, then as given.
    assert sorted(mesh.groups["PART"].ids) == [1, 3]
    np.testing.assert_array_equal(mesh.groups["SIDE"].ids, [[1, 4], [2, 1]])
    assert mesh.groups["SIDE"].ids.dtype == np.int64
    assert {name: group.kind for name, group in mesh.groups.items()} == {
        "FIX": "node",
        "PART": "element",
        "SIDE": "facet",
    }
    with pytest.raises(KeyError):
        mesh.groups["NONE"]


def test_one_name_for_two_kinds():
    mesh = make(groups=[("X", "node", [1]), ("X", "element", [3])])
    assert list(mesh.groups) == ["X"] and len(mesh.groups) == 1
    assert mesh.groups["X"].kind == "node"
    np.testing.assert_array_equal(mesh.groups["X", "element"].ids, [3])
    assert [g.kind for g in mesh.groups.all()] == ["node", "element"]
    assert [g.kind for g in mesh.groups.all("element")] == ["element"]
    assert ("X", "facet") not in mesh.groups
    mesh.remove_group("X", "element")
    assert [g.kind for g in mesh.groups.all()] == ["node"]


def test_changing_groups():
    mesh = make()
    group = mesh.add_group("A", "node", np.array([5, 2]))
    np.testing.assert_array_equal(group.ids, [2, 5])
    mesh.add_group("NOBODY", "facet")
    assert mesh.groups["NOBODY"].ids.shape == (0, 2)
    renamed = mesh.rename_group("A", "B")
    assert renamed.name == "B" and "A" not in mesh.groups
    np.testing.assert_array_equal(mesh.groups["B"].ids, [2, 5])
    with pytest.raises(fs.Error, match="no node group 'A'"):
        group.ids
    with pytest.raises(fs.Error, match="already has a node group 'B'"):
        mesh.add_group("B", "node")
    with pytest.raises(fs.Error, match="node 6"):
        mesh.add_group("C", "node", [6])
    with pytest.raises(fs.Error, match="face 5 of element 1"):
        mesh.add_group("C", "facet", [[1, 5]])
    assert "C" not in mesh.groups
    mesh.add_group("C", "node", [1])
    with pytest.raises(fs.Error, match="already has a node group 'C'"):
        mesh.rename_group("B", "C")
    with pytest.raises(KeyError):
        mesh.remove_group("A")
    mesh.remove_group("B")
    np.testing.assert_array_equal(mesh.groups["C"].ids, [1])
    mesh.validate()


DECK = """*NODE, NSET=FIX
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
*ELEMENT, TYPE=C3D4, ELSET=BODY
1, 1, 2, 3, 4
*SURFACE, NAME=SIDE, TYPE=ELEMENT
1, S1
*STEP
*BOUNDARY
FIX, 1
*DSLOAD
SIDE, P, 1.
*END STEP
"""


@pytest.mark.parametrize("kind, name", [("node", "FIX"), ("element", "BODY"), ("facet", "SIDE")])
def test_a_set_of_a_deck_keeps_the_name_that_cards_name_it_by(tmp_path, kind, name):
    (tmp_path / "in.inp").write_text(DECK)
    mesh = fs.read(tmp_path / "in.inp")
    assert mesh.has_deck
    before = mesh.copy()
    mesh.rename_group(name, "OTHER", kind)
    with pytest.warns(UserWarning, match=f"the name 'OTHER', as the deck's cards name that .* '{name}'"):
        fs.write(mesh, tmp_path / "out.inp")
    assert (tmp_path / "out.inp").read_text() == DECK
    fs.write(before, tmp_path / "before.inp")  # which the deck was shared with
    mesh.rename_group("OTHER", name, kind)
    fs.write(mesh, tmp_path / "again.inp")
    assert (tmp_path / "again.inp").read_text() == (tmp_path / "before.inp").read_text() == DECK


@pytest.mark.parametrize("ending", [".med", ".vtu", ".msh", ".unv", ".bdf"])
def test_cards_that_a_file_does_not_hold_are_told(tmp_path, ending):
    (tmp_path / "in.inp").write_text(DECK)
    with pytest.warns(UserWarning, match="the cards of the deck"):
        fs.write(fs.read(tmp_path / "in.inp"), tmp_path / ("out" + ending))


def test_copies_are_independent():
    mesh = make(groups={"A": ("node", [1])}, name="first")
    for other in (mesh.copy(), copy.copy(mesh), copy.deepcopy(mesh)):
        other.add_group("B", "node", [2])
        other.name = "second"
        assert not np.shares_memory(mesh.points, other.points)
        assert list(mesh.groups) == ["A"] and list(other.groups) == ["A", "B"] and mesh.name == "first"


def test_repr_tells_counts():
    text = repr(make(groups={"A": ("node", [1])}, name="beam"))
    for part in ("beam", "5 nodes", "2 tetra", "1 triangle", "1 group"):
        assert part in text
    assert "2 nodes" in repr(make(groups={"A": ("node", [1, 2])}).groups["A"])


@pytest.mark.parametrize(
    "arguments, error, message",
    [
        (("abc", {}), TypeError, "points"),
        (([[1, 2]], {}), ValueError, r"points must have the shape \(n, 3\)"),
        ((POINTS, [[0, 1, 2, 3]]), TypeError, "cells must be a dict"),
        ((POINTS, {"tetra": [[0, 1, 2]]}), ValueError, r"cells\['tetra'\] must have the shape \(m, 4\)"),
        ((POINTS, {"tetra": [[0.0, 1.0, 2.0, 3.0]]}), TypeError, r"cells\['tetra'\] must be an array of integers"),
        ((POINTS, {"tetra4": [[0, 1, 2, 3]]}), fs.Error, "tetra4"),
        ((POINTS, {"tetra": [[0, 1, 2, 5]]}), fs.Error, "tetra element 1 refers to a node that does not exist"),
        ((POINTS, {"tetra": [[0, 1, 2, -1]]}), fs.Error, "tetra element 1"),
        ((POINTS, CELLS, [1, 2, 3]), ValueError, "node_ids must have the shape"),
        ((POINTS, CELLS, [1, 2, 3, 4, 4]), fs.Error, "node number 4 is used twice"),
        ((POINTS, CELLS, [0, 1, 2, 3, 4]), fs.Error, "node number 0 is not positive"),
        ((POINTS, CELLS, None, {"tetra": [1, 2]}), ValueError, "cell_ids must have an entry 'triangle'"),
        ((POINTS, CELLS, None, {"tetra": [1], "triangle": [2]}), ValueError, r"cell_ids\['tetra'\]"),
        ((POINTS, CELLS, None, {"tetra": [1, 2], "triangle": [2]}), fs.Error, "element number 2 is used twice"),
        ((POINTS, CELLS, None, {"tetra": [1, 2], "triangle": [3], "quad": []}), ValueError, "quad"),
        (([[0, 0, float("nan")]], {}), fs.Error, "node 1 has a coordinate that is not a finite number"),
        ((POINTS, CELLS, None, None, {"A": ("nodes", [1])}), ValueError, r"groups\['A'\]: kind must be one of"),
        ((POINTS, CELLS, None, None, {"A": ("node", [99])}), fs.Error, "node group 'A' names node 99"),
        ((POINTS, CELLS, None, None, {"A": ("facet", [1, 2])}), fs.Error, "facet group 'A'"),
        ((POINTS, CELLS, None, None, ["A"]), TypeError, "groups must be"),
    ],
)
def test_bad_arguments(arguments, error, message):
    with pytest.raises(error, match=message):
        fs.Mesh(*arguments)


def test_meshes_are_not_pickled_by_half():
    with pytest.raises(TypeError):
        pickle.dumps(make())
