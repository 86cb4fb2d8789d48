# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is said of edges that cannot be rounded is so, and says what can be."""

import re

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box
from test_fillet import check_conforming, face_points, quality
from test_fillet_ends import part_of_box


def room_for(mesh, along, radius, **options):
    """What the error says there is room for."""
    with pytest.raises(fs.ToolError) as caught:
        fs.fillet(mesh, along, radius, **options)
    return float(re.search(r"room for (?:a radius of )?about ([\d.e-]+)", str(caught.value)).group(1))


def disc(rings=8, around=24, radius=2.0, height=2.0):
    """A short cylinder, about z."""
    box = grid_box((2 * rings, 2 * rings, 3), (2.0, 2.0, height))
    x, y = (box.points[:, :2] - 1).T
    largest, length = np.maximum(abs(x), abs(y)), np.hypot(x, y)
    scale = radius * largest / np.where(length > 0, length, 1)
    return fs.Mesh(np.stack([x * scale, y * scale, box.points[:, 2]], axis=1), box.cells)


@pytest.mark.parametrize("radius", [1.6, 1.85])
def test_end_of_a_shaft_almost_to_the_axis(radius):
    mesh = disc()
    result = fs.fillet(mesh, [(2, 0, 2)], radius)
    points = face_points(result.mesh)
    off = np.hypot(np.hypot(points[:, 0], points[:, 1]) - 2 + radius, points[:, 2] - 2 + radius) - radius
    assert np.abs(off).max() < 1e-8
    check_conforming(result.mesh)


@pytest.mark.parametrize("radius", [1.95, 2.0, 2.6])
def test_but_not_beyond(radius):
    assert 1.85 < room_for(disc(height=4.0), [(2, 0, 4)], radius) < 1.95


def test_face_that_ends_names_the_room_beside_all_of_the_edge():
    """A round boss near the plate's side."""
    mesh = grid_box((8, 4, 4), (8.0, 4.0, 4.0))
    assert room_for(mesh, [(4, 0, 0)], 5.0) == pytest.approx(4 / 1.02, rel=0.01)
    fs.fillet(mesh, [(4, 0, 0)], 3.85)


def test_roundings_that_touch_name_the_radius_that_does_not():
    mesh = grid_box((8, 4, 4), (8.0, 4.0, 4.0))
    edges = [(4, 0, 0), (4, 0, 4)]
    for radius in (1.995, 2.4):
        assert room_for(mesh, edges, radius) == pytest.approx(1.98, abs=0.011)
    fs.fillet(mesh, edges, 1.96)


def test_a_radius_for_which_the_mesh_would_be_refined_without_end():
    mesh = grid_box((4, 2, 2), (4.0, 2.0, 2.0))
    for radius in (1e-4, 1e-12):
        with pytest.raises(fs.ToolError, match="so small against the edge's length of 4 .* million elements. Round by"):
            fs.fillet(mesh, [(2, 0, 0)], radius)


def test_a_group_of_nodes_with_a_face_inside_does_not_hold_the_foot_of_a_rib():
    """A rib one element wide: all nodes of faces under it are in the plate's group."""
    mesh = part_of_box(lambda x, y, z: (z < 4) | ((x > 3) & (x < 4) & (y > 2)))
    top = (np.abs(mesh.points[:, 2] - 4) < 1e-9) & ~((mesh.points[:, 1] == 4) & (mesh.points[:, 0] == 3))
    mesh.add_group("TOP", "node", mesh.node_ids[top])
    result = fs.fillet(mesh, [(3, 6, 4)], 1.0)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 0] - 2, points[:, 2] - 5) - 1).max() < 1e-8
    assert points[:, 1].max() == pytest.approx(8)
    assert quality(result.mesh).min() > 0.1
    check_conforming(result.mesh)
