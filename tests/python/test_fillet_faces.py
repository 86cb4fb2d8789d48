# SPDX-License-Identifier: LGPL-2.1-or-later
"""What fillet() leaves of elements and node groups on the skin, and which edge a point names."""

import pathlib

import numpy as np
import pytest

import femscalpel as fs
from test_fillet import l_shape

MESHES = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "tests" / "meshes"
CONCAVE, CONVEX = (4, 2, 4), (12, 2, 4)


def with_face_nodes():
    """The L of the test meshes, with a node group of the nodes of every element group of its skin."""
    mesh, kind = fs.read(MESHES / "l_shape.inp"), "triangle"
    for group in [g for g in mesh.groups.all() if g.kind == "element"]:
        faces = np.isin(mesh.cell_ids[kind], group.ids)
        if faces.any() and faces.sum() == len(group.ids):
            mesh.add_group(f"N_{group.name}", "node", mesh.node_ids[np.unique(mesh.cells[kind][faces])])
    return mesh, kind


@pytest.mark.parametrize("radius", [2.2, 2.8, 5.8, 8.8])
def test_no_triangle_is_there_twice(radius):
    mesh = fs.read(MESHES / "two_boxes.inp")
    result = fs.fillet(mesh, (5, 0, 0), radius).mesh
    faces = np.sort(result.cells["triangle"], axis=1)
    assert len(np.unique(faces, axis=0)) == len(faces)


@pytest.mark.parametrize("place", [CONCAVE, CONVEX])
def test_nodes_of_faces_stay_those_of_faces(place):
    mesh, kind = with_face_nodes()
    result = fs.fillet(mesh, place, 1.1)
    records = {g.name: g for g in result.report.groups if g.kind == "node"}
    named = [g for g in result.mesh.groups.all() if g.name.startswith("N_")]
    assert len(named) > 5
    for group in named:
        ids = result.mesh.groups[(group.name[2:], "element")].ids
        nodes = np.unique(result.mesh.cells[kind][np.isin(result.mesh.cell_ids[kind], ids)])
        assert set(group.ids) == set(result.mesh.node_ids[nodes])
        assert records[group.name].count_after == len(group.ids)


def test_nodes_that_are_inside_afterwards_leave_groups_of_the_skin():
    """Along a concave edge where groups of elements meet, the old edge stays, inside."""
    plain = l_shape((10, 10, 4), (10.0, 10.0, 4.0), (4.0, 4.0))
    middle = plain.points[plain.cells["tetra"]].mean(axis=1)
    mesh = fs.Mesh(plain.points, plain.cells)
    mesh.add_group("FOOT", "element", mesh.cell_ids["tetra"][middle[:, 1] < 4])
    mesh.add_group("WEB", "element", mesh.cell_ids["tetra"][middle[:, 1] >= 4])
    x = mesh.points
    edge = (x[:, 0] == 4) & (x[:, 1] == 4) & (x[:, 2] > 0) & (x[:, 2] < 4)
    mesh.add_group("SUPPORT", "node", mesh.node_ids[(x[:, 1] == 4) & (x[:, 0] >= 4)])
    mesh.add_group("ALL", "node", mesh.node_ids)
    result = fs.fillet(mesh, (4, 4, 2), 1.5).mesh
    inside = set(mesh.node_ids[edge]) & set(result.node_ids)
    assert inside
    assert not inside & set(result.groups["SUPPORT"].ids)
    assert inside <= set(result.groups["ALL"].ids)


@pytest.mark.parametrize("point", [(8, 2, -20), (2, 2, 2), (8, 2, 2)])
def test_a_point_far_from_any_edge_names_none(point):
    with pytest.raises(fs.ToolError, match="within an edge length of the point") as caught:
        fs.fillet(with_face_nodes()[0], point, 0.5)
    assert caught.value.parameter == "along"
