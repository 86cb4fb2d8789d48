# SPDX-License-Identifier: LGPL-2.1-or-later
import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups

meshio = pytest.importorskip("meshio")


def test_there_and_back():
    mesh = box_with_groups()
    back = fs.from_meshio(fs.to_meshio(mesh))
    np.testing.assert_array_equal(back.points, mesh.points)
    np.testing.assert_array_equal(back.node_ids, mesh.node_ids)
    np.testing.assert_array_equal(back.cell_ids["tetra"], mesh.cell_ids["tetra"])
    assert {(g.name, g.kind) for g in back.groups.all()} == {(g.name, g.kind) for g in mesh.groups.all()}
    for group in mesh.groups.all():
        np.testing.assert_array_equal(back.groups[group.name, group.kind].ids, group.ids)


def test_flat_points_repeated_blocks_and_sets():
    source = meshio.Mesh(
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        [("triangle", [[0, 1, 2]]), ("line", [[0, 1]]), ("triangle", [[0, 2, 3]])],
        point_sets={"corner": [2]},
        cell_sets={"second": [[], [], [0]], "both": [[0], [0], []]},
    )
    mesh = fs.from_meshio(source)
    assert mesh.points.shape == (4, 3) and mesh.dimension == 2
    np.testing.assert_array_equal(mesh.cells["triangle"], [[0, 1, 2], [0, 2, 3]])
    np.testing.assert_array_equal(mesh.groups["corner"].ids, [3])
    np.testing.assert_array_equal(mesh.groups["second"].ids, [3])
    assert sorted(mesh.groups["both"].ids) == [1, 2]


def test_facet_groups_are_left_out_with_a_warning():
    mesh = box_with_groups()
    mesh.add_group("SIDE", "facet", [[mesh.cell_ids["tetra"][0], 1]])
    with pytest.warns(UserWarning, match="SIDE"):
        assert "SIDE" not in fs.to_meshio(mesh).cell_sets


def test_unknown_element_type():
    source = meshio.Mesh(np.eye(3), [])
    source.cells = [meshio.CellBlock("polygon", np.array([[0, 1, 2]]))]
    with pytest.raises(fs.Error, match="polygon"):
        fs.from_meshio(source)
