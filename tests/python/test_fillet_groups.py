# SPDX-License-Identifier: LGPL-2.1-or-later
"""Concave edges along which groups of elements meet."""

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic, tetra_volumes
from test_fillet import RIGHT_ANGLE, check_conforming, face_points, l_shape, quality, volume


def group_volumes(mesh, names):
    kind = "tetra" if "tetra" in mesh.cells else "tetra10"
    cells, ids = mesh.cells[kind][:, :4], mesh.cell_ids[kind]
    return {n: tetra_volumes(mesh.points, cells[np.isin(ids, mesh.groups[n].ids)]).sum() for n in names}


def grouped(mesh, groups):
    """Element groups by where the elements' middles are; every element must be in one."""
    kind = "tetra" if "tetra" in mesh.cells else "tetra10"
    centres = mesh.points[mesh.cells[kind][:, :4]].mean(axis=1)
    ids, found = mesh.cell_ids[kind], np.zeros(len(centres), int)
    for name, where in groups.items():
        found += where(*centres.T)
        mesh.add_group(name, "element", ids[where(*centres.T)])
    assert (found == 1).all()
    return mesh


def shares(mesh, result, names):
    """By how much the groups have grown; together they are still the whole."""
    before, after = group_volumes(mesh, names), group_volumes(result.mesh, names)
    kind = "tetra" if "tetra" in result.mesh.cells else "tetra10"
    whole = tetra_volumes(result.mesh.points, result.mesh.cells[kind][:, :4]).sum()
    assert sum(after.values()) == pytest.approx(whole, rel=1e-12)
    return np.array([after[n] - before[n] for n in names])


def on_cylinder(mesh, radius):
    points = face_points(mesh)
    return np.abs(np.hypot(points[:, 0] - 4 - radius, points[:, 1] - 4 - radius) - radius).max() < 1e-8


KNEE = {"KNEE": lambda x, y, z: (x < 4) & (y < 4), "FOOT": lambda x, y, z: x > 4, "WEB": lambda x, y, z: y > 4}


@pytest.mark.parametrize("radius", [0.5, 1.0, 2.0, 3.0])
def test_three_parts_meet_at_the_edge(radius):
    """The part behind the edge stays, the other two get a half each."""
    mesh = grouped(l_shape(), KNEE)
    result = fs.fillet(mesh, [(4, 4, 2)], radius)
    knee, foot, web = shares(mesh, result, KNEE)
    assert knee == pytest.approx(0, abs=1e-9) and foot == pytest.approx(web, rel=1e-9)
    assert foot + web == pytest.approx(RIGHT_ANGLE * radius**2 * 4, rel=0.03)
    assert foot + web == pytest.approx(volume(result.mesh) - volume(mesh), rel=1e-9)
    assert on_cylinder(result.mesh, radius) and quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)
    # The halves meet in the plane between the faces, and nothing of the old border is lost.
    cells = dict(zip(result.mesh.cell_ids["tetra"].tolist(), result.mesh.points[result.mesh.cells["tetra"]]))
    for name, sign in (("FOOT", 1), ("WEB", -1)):
        points = np.concatenate([cells[n] for n in result.mesh.groups[name].ids.tolist()])
        new = points[(points[:, 0] > 4) & (points[:, 1] > 4)]
        assert (sign * (new[:, 0] - new[:, 1]) > -1e-9).all()
    for name in KNEE:
        points = np.concatenate([cells[n] for n in result.mesh.groups[name].ids.tolist()])
        assert ((points[:, 0] < 4 + 1e-9) & (points[:, 1] < 4 + 1e-9)).all() == (name == "KNEE")


@pytest.mark.parametrize("side", [0, 1])
def test_two_parts_one_of_which_goes_on_under_the_edge(side):
    groups = [
        {"PLATE": lambda x, y, z: y < 4, "WEB": lambda x, y, z: y > 4},
        {"PLATE": lambda x, y, z: x > 4, "WEB": lambda x, y, z: x < 4},
    ][side]
    mesh = grouped(l_shape(), groups)
    result = fs.fillet(mesh, [(4, 4, 2)], 2.0)
    plate, web = shares(mesh, result, groups)
    assert plate == pytest.approx(web, rel=1e-9) and plate + web == pytest.approx(RIGHT_ANGLE * 16, rel=0.03)
    assert on_cylinder(result.mesh, 2.0) and quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_a_border_on_one_side_ends_at_that_along_the_edge():
    groups = {
        "WEB": lambda x, y, z: y > 4,
        "NEAR": lambda x, y, z: (y < 4) & (z < 2),
        "FAR": lambda x, y, z: (y < 4) & (z > 2),
    }
    mesh = grouped(l_shape(), groups)
    result = fs.fillet(mesh, [(4, 4, 1)], 1.5)
    web, near, far = shares(mesh, result, groups)
    assert near == pytest.approx(far, rel=0.01) and near + far == pytest.approx(web, rel=1e-9)
    assert on_cylinder(result.mesh, 1.5) and quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_a_border_along_a_part_of_the_edge():
    """From there on the new material is divided."""
    groups = {"WEB": lambda x, y, z: (y > 4) & (z > 2), "BODY": lambda x, y, z: (y < 4) | (z < 2)}
    mesh = grouped(l_shape(), groups)
    result = fs.fillet(mesh, [(4, 4, 1)], 1.5)
    web, body = shares(mesh, result, groups)
    assert body == pytest.approx(3 * web, rel=0.01)
    assert web + body == pytest.approx(RIGHT_ANGLE * 1.5**2 * 4, rel=0.03)
    assert on_cylinder(result.mesh, 1.5) and quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_borders_across_and_along_the_edge():
    quarters = {
        f"{name}_{half}": lambda x, y, z, name=name, half=half: ((y > 4) == (name == "WEB")) & ((z > 2) == half)
        for name in ("WEB", "PLATE")
        for half in (0, 1)
    }
    mesh = grouped(l_shape(), quarters)
    result = fs.fillet(mesh, [(4, 4, 1)], 1.5)
    assert shares(mesh, result, quarters) == pytest.approx(RIGHT_ANGLE * 1.5**2, rel=0.03)
    check_conforming(result.mesh)


def test_second_order():
    mesh = grouped(quadratic(l_shape()), KNEE)
    result = fs.fillet(mesh, [(4, 4, 2)], 2.0)
    knee, foot, web = shares(mesh, result, KNEE)
    assert knee == pytest.approx(0, abs=1e-9) and foot == pytest.approx(web, rel=1e-9)
    assert on_cylinder(result.mesh, 2.0) and quality(result.mesh).min() >= 0.15


def ring():
    """An L shape turned about an axis: a flange at a stem, with a concave circular edge at radius 4, height 2."""
    box = grid_box((8, 32, 6), (6.0, 2 * np.pi, 6.0))
    centres = box.points[box.cells["tetra"]].mean(axis=1)
    cells = box.cells["tetra"][(centres[:, 0] < 2.25) | (centres[:, 2] < 2)]
    r, angle, z = box.points.T
    points = np.stack([(r / 0.75 + 1) * np.cos(angle), (r / 0.75 + 1) * np.sin(angle), z], axis=1)
    _, first, same = np.unique(np.round(points, 6), axis=0, return_index=True, return_inverse=True)
    used, nodes = np.unique(same.ravel()[cells], return_inverse=True)
    return fs.Mesh(points[first][used], {"tetra": nodes.reshape(-1, 4)})


def test_a_border_around_a_circular_edge():
    groups = {"STEM": lambda x, y, z: z > 2, "FLANGE": lambda x, y, z: z < 2}
    mesh = grouped(ring(), groups)
    result = fs.fillet(mesh, [(4, 0, 2)], 1.2)
    stem, flange = shares(mesh, result, groups)
    assert stem + flange == pytest.approx(volume(result.mesh) - volume(mesh), rel=1e-9)
    # The flange's share is farther from the axis.
    assert 0.3 < stem / (stem + flange) < 0.5
    points = face_points(result.mesh)
    radii = np.hypot(points[:, 0], points[:, 1])
    assert np.abs(np.hypot(radii - 5.2, points[:, 2] - 3.2) - 1.2).max() < 1e-8
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_a_border_beside_the_edge_is_a_refusal():
    mesh = grouped(l_shape(), {"NEAR": lambda x, y, z: x < 5, "FAR": lambda x, y, z: x > 5})
    with pytest.raises(fs.QualityError, match="a border of groups"):
        fs.fillet(mesh, [(4, 4, 2)], 2.0)


def test_a_convex_edge_near_by():
    """Rounded in one cavity; the borders along the concave one stay."""
    mesh = grouped(l_shape(), KNEE)
    result = fs.fillet(mesh, [(4, 4, 2), (8, 4, 2)], 1.0)
    knee, foot, web = shares(mesh, result, KNEE)
    assert knee == pytest.approx(0, abs=1e-9)
    assert web == pytest.approx(RIGHT_ANGLE * 2, rel=0.03) and foot == pytest.approx(-RIGHT_ANGLE * 2, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


@pytest.mark.parametrize("across", [False, True])
@pytest.mark.parametrize("scale", [1.0, 1.4])
@pytest.mark.parametrize("radius", [0.6, 1.5, 2.5])
def test_a_border_along_a_convex_edge(radius, scale, across):
    """It ends at the ball, in its plane; another may cross it."""
    plain = grid_box((6, 4, 4), (6.0, 4.0, 4.0))
    mesh = fs.Mesh(plain.points * (1, scale, 1), plain.cells)
    groups = {
        f"{name}_{half}": lambda x, y, z, name=name, half=half: ((y > scale * z) == (name == "LOW"))
        & ((x > 3) == half if across else (half == 0) & (x > -1))
        for name in ("LOW", "HIGH")
        for half in ((0, 1) if across else (0,))
    }
    mesh = grouped(mesh, groups)
    result = fs.fillet(mesh, [(2, 0, 0)], radius)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 1] - radius, points[:, 2] - radius) - radius).max() < 1e-8
    gone = -shares(mesh, result, groups)
    assert gone.sum() == pytest.approx(RIGHT_ANGLE * radius**2 * 6, rel=0.03)
    if scale == 1:
        assert gone == pytest.approx(gone.mean(), rel=0.02)
    cells = dict(zip(result.mesh.cell_ids["tetra"].tolist(), result.mesh.points[result.mesh.cells["tetra"]]))
    for name in groups:
        x, y, z = np.concatenate([cells[n] for n in result.mesh.groups[name].ids.tolist()]).T
        assert ((y - scale * z) * (1 if name.startswith("LOW") else -1)).min() > -1e-8
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)
