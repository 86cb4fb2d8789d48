# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rounding edges."""

import numpy as np
import pytest

import femscalpel as fs
from merge_parts import block, rod
from meshes import grid_box, quadratic, tetra_volumes

RIGHT_ANGLE = 1 - np.pi / 4  # of what is rounded off a right angle, times the radius squared


def quality(mesh):
    cells = mesh.cells["tetra" if "tetra" in mesh.cells else "tetra10"][:, :4]
    corners = mesh.points[cells]
    squares = sum(((corners[:, i] - corners[:, j]) ** 2).sum(axis=1) for i in range(4) for j in range(i))
    volumes = tetra_volumes(mesh.points, cells)
    return 12 * np.sign(volumes) * np.cbrt((3 * volumes) ** 2) / squares


def volume(mesh):
    return tetra_volumes(mesh.points, mesh.cells["tetra"]).sum()


def l_shape(counts=(8, 8, 4), size=(8.0, 8.0, 4.0), corner=(4.0, 4.0), **kwargs):
    """A box without the part beyond a concave edge along z."""
    box = grid_box(counts, size)
    centres = box.points[box.cells["tetra"]].mean(axis=1)
    kept = box.cells["tetra"][(centres[:, 0] < corner[0]) | (centres[:, 1] < corner[1])]
    used, nodes = np.unique(kept, return_inverse=True)
    return fs.Mesh(box.points[used], {"tetra": nodes.reshape(-1, 4)}, **kwargs)


def face_points(mesh, name="FILLET_FACE"):
    kind = "triangle" if "triangle" in mesh.cells else "triangle6"
    faces = mesh.cells[kind][np.isin(mesh.cell_ids[kind], mesh.groups[name].ids)]
    return mesh.points[np.unique(faces)]


def check_conforming(mesh):
    """Every face of a tetrahedron is one of two, or of the skin, which is closed."""
    cells = mesh.cells["tetra"]
    faces = np.sort(np.concatenate([np.delete(cells, k, axis=1) for k in range(4)]), axis=1)
    unique, counts = np.unique(faces, axis=0, return_counts=True)
    assert counts.max() == 2
    skin = unique[counts == 1]
    edges = np.sort(np.concatenate([np.delete(skin, k, axis=1) for k in range(3)]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] % 2 == 0).all()
    assert len(np.unique(cells)) == mesh.node_count


@pytest.mark.parametrize("radius", [0.5, 1.0, 2.0, 3.5])
def test_convex_edge(radius):
    mesh = grid_box((8, 5, 4), (8.0, 5.0, 4.0))
    result = fs.fillet(mesh, [(4, 0, 0)], radius)
    points = face_points(result.mesh)
    off = np.hypot(points[:, 1] - radius, points[:, 2] - radius) - radius
    assert np.abs(off).max() < 1e-9 * 10
    assert points[:, 0].min() == 0 and points[:, 0].max() == 8
    removed = RIGHT_ANGLE * radius**2 * 8
    assert volume(mesh) - volume(result.mesh) == pytest.approx(removed, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_away_from_the_edge_nothing_is_touched():
    mesh = grid_box((4, 12, 12), (4.0, 12.0, 12.0))
    result = fs.fillet(mesh, (2, 0, 0), 1.0)
    far = np.linalg.norm(mesh.points[:, 1:], axis=1) > 7
    kept = dict(zip(result.mesh.node_ids.tolist(), result.mesh.points.tolist()))
    assert all(kept[n] == p for n, p in zip(mesh.node_ids[far].tolist(), mesh.points[far].tolist()))
    cells = dict(zip(result.mesh.cell_ids["tetra"].tolist(), result.mesh.node_ids[result.mesh.cells["tetra"]].tolist()))
    whole = far[mesh.cells["tetra"]].all(axis=1)
    assert whole.sum() > 1000
    for number, nodes in zip(
        mesh.cell_ids["tetra"][whole].tolist(), mesh.node_ids[mesh.cells["tetra"]][whole].tolist()
    ):
        assert cells[number] == nodes


@pytest.mark.parametrize("radius", [0.5, 1.0, 2.0, 3.0])
def test_concave_edge(radius):
    mesh = l_shape()
    result = fs.fillet(mesh, [(4, 4, 2)], radius)
    points = face_points(result.mesh)
    off = np.hypot(points[:, 0] - 4 - radius, points[:, 1] - 4 - radius) - radius
    assert np.abs(off).max() < 1e-9 * 10
    added = RIGHT_ANGLE * radius**2 * 4
    assert volume(result.mesh) - volume(mesh) == pytest.approx(added, rel=0.03)
    assert quality(result.mesh).min() >= 0.15
    check_conforming(result.mesh)


def test_random_edges():
    """Boxes and L shapes of random proportions, turned anyhow."""
    rng = np.random.default_rng(3)
    for k in range(24):
        size = rng.uniform(0.8, 1.25, 3)
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        turn *= np.sign(np.linalg.det(turn))
        concave = k % 2 == 1
        plain = l_shape() if concave else grid_box((8, 8, 4), (8.0, 8.0, 4.0))
        mesh = fs.Mesh((plain.points * size) @ turn.T, plain.cells)
        place = (np.array([4.0, 4.0, 2.0] if concave else [0.0, 0.0, 2.0]) * size) @ turn.T
        radius = np.exp(rng.uniform(np.log(0.5), np.log(3.0)))
        result = fs.fillet(mesh, [place], radius)
        change = volume(result.mesh) - volume(mesh)
        expected = RIGHT_ANGLE * radius**2 * 4 * size[2] * (1 if concave else -1)
        assert change == pytest.approx(expected, rel=0.03), (k, radius)
        assert quality(result.mesh).min() >= 0.15, (k, radius)
        local = face_points(result.mesh) @ turn
        centre = np.array([4.0, 4.0] if concave else [0.0, 0.0]) * size[:2] + radius
        off = np.hypot(local[:, 0] - centre[0], local[:, 1] - centre[1]) - radius
        assert np.abs(off).max() < 1e-9 * np.linalg.norm(8 * size), (k, radius)


def test_edge_by_group_and_node_numbers():
    mesh = grid_box((6, 4, 4), (6.0, 4.0, 4.0))
    on_edge = mesh.node_ids[(mesh.points[:, 1] == 0) & (mesh.points[:, 2] == 0)]
    mesh.add_group("EDGE", "node", on_edge)
    by_point = fs.fillet(mesh, (3, 0, 0), 1)
    for along in ("EDGE", on_edge, on_edge.tolist()):
        result = fs.fillet(mesh, along, 1)
        np.testing.assert_array_equal(result.mesh.points, by_point.mesh.points)
    assert len(result.mesh.groups["EDGE"]) == 0
    record = {r.name: r for r in result.report.groups}["EDGE"]
    assert record.status == "became empty"
    assert any("EDGE" in w for w in result.report.warnings)
    part = fs.fillet(mesh, on_edge[:3], 1)
    assert any("goes on beyond what was named" in w for w in part.report.warnings)


def test_session_gives_the_same():
    mesh = grid_box((6, 4, 4), (6.0, 4.0, 4.0))
    once = fs.fillet(mesh, (3, 0, 0), 1)
    session = fs.Scalpel(mesh).fillet((3, 0, 0), 1)
    np.testing.assert_array_equal(session.mesh.points, once.mesh.points)


def test_groups():
    mesh = grid_box((6, 4, 4), (6.0, 4.0, 4.0))
    centres = mesh.points[mesh.cells["tetra"]].mean(axis=1)
    ids = mesh.cell_ids["tetra"]
    mesh.add_group("LEFT", "element", ids[centres[:, 0] < 3])
    mesh.add_group("RIGHT", "element", ids[centres[:, 0] > 3])
    mesh.add_group("END", "node", mesh.node_ids[mesh.points[:, 0] == 0])
    mesh.add_group("FLOOR", "node", mesh.node_ids[mesh.points[:, 2] == 0])
    result = fs.fillet(mesh, (3, 0, 0), 1.5)
    points = dict(zip(result.mesh.node_ids.tolist(), result.mesh.points))
    cells = dict(zip(result.mesh.cell_ids["tetra"].tolist(), result.mesh.points[result.mesh.cells["tetra"]]))
    left, right = (result.mesh.groups[name].ids for name in ("LEFT", "RIGHT"))
    assert len(left) + len(right) == len(cells) and not set(left) & set(right)
    assert max(cells[n][:, 0].max() for n in left) <= 3 + 1e-9
    assert min(cells[n][:, 0].min() for n in right) >= 3 - 1e-9
    end = set(result.mesh.groups["END"].ids.tolist())
    assert end == {n for n, p in points.items() if p[0] == 0}
    # A face's group ends at its tangent line.
    floor = set(result.mesh.groups["FLOOR"].ids.tolist())
    assert floor == {n for n, p in points.items() if p[2] == 0}
    assert min(points[n][1] for n in floor) == pytest.approx(1.5)


def test_facets_of_the_faces_end_at_the_tangent_lines():
    mesh = grid_box((6, 4, 4), (6.0, 4.0, 4.0))
    faces = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
    members = {"FLOOR": [], "END": []}
    for number, nodes in zip(mesh.cell_ids["tetra"], mesh.cells["tetra"]):
        for k, face in enumerate(faces):
            at = mesh.points[nodes[list(face)]]
            if (at[:, 2] == 0).all():
                members["FLOOR"].append((number, k + 1))
            if (at[:, 0] == 0).all():
                members["END"].append((number, k + 1))
    for name, facets in members.items():
        mesh.add_group(name, "facet", facets)
    result = fs.fillet(mesh, (3, 0, 0), 1.5)
    cells = dict(zip(result.mesh.cell_ids["tetra"].tolist(), result.mesh.cells["tetra"]))

    def area(name):
        total = 0
        for number, face in result.mesh.groups[name].ids:
            a, b, c = result.mesh.points[cells[number][list(faces[face - 1])]]
            total += np.linalg.norm(np.cross(b - a, c - a)) / 2
        return total

    assert area("FLOOR") == pytest.approx(6 * (4 - 1.5))
    assert area("END") == pytest.approx(16 - RIGHT_ANGLE * 1.5**2, rel=1e-3)


def test_second_order():
    mesh = quadratic(grid_box((6, 4, 4), (6.0, 4.0, 4.0)))
    result = fs.fillet(mesh, (3, 0, 0), 1.5)
    points = face_points(result.mesh)
    assert np.abs(np.hypot(points[:, 1] - 1.5, points[:, 2] - 1.5) - 1.5).max() < 1e-9
    assert quality(result.mesh).min() >= 0.15


@pytest.mark.parametrize(
    "along, radius, parameter, text",
    [
        ("NONE", 1, "along", "no group 'NONE'; it has 'ALL', 'INSIDE'"),
        ("INSIED", 1, "along", "Did you mean 'INSIDE'?"),
        ([1], 1, "along", "the nodes named are no edge"),
        ([(np.nan, 0, 0)], 1, "along", r"along\[0\] is \(nan, 0.0, 0.0\); the coordinates of a point must be finite"),
        ((3, 0, 0), 1e300, "radius", "which no face has room for"),
        ((3, 0, 0), 8000, "radius", r"There is room for about (3|4)\.?\d*,"),
        ("ALL", 1, "along", "elements other than segments"),
        ("INSIDE", 1, "along", "is no edge"),
        ([999999], 1, "along", "no node 999999"),
        ((3, 0, 0), 4.5, "radius", "too large for a face beside the edge"),
        ((3, 0, 0), -1, "radius", "positive"),
        ((3, 0, 0), float("nan"), "radius", "finite|positive"),
    ],
)
def test_errors(along, radius, parameter, text):
    mesh = grid_box((6, 4, 4), (6.0, 4.0, 4.0))
    mesh.add_group("ALL", "element", mesh.cell_ids["tetra"])
    mesh.add_group("INSIDE", "node", mesh.node_ids[(mesh.points[:, 1] == 2) & (mesh.points[:, 2] == 2)])
    before = mesh.points.copy()
    with pytest.raises((fs.ToolError, ValueError), match=text) as caught:
        fs.fillet(mesh, along, radius)
    assert caught.value.parameter == parameter
    np.testing.assert_array_equal(mesh.points, before)


@pytest.mark.parametrize("along", [None, 3.5, [(1, 2)], [], "", [[np.nan, 0, 0]]])
def test_along_must_name_something(along):
    with pytest.raises((TypeError, ValueError, fs.ToolError)) as caught:
        fs.fillet(grid_box(), along, 1)
    assert caught.value.parameter == "along"


@pytest.mark.parametrize("radius", [0.25, 0.5])
@pytest.mark.parametrize("keep", ["mesh", "addition"])
def test_the_foot_of_a_boss_that_was_added(radius, keep):
    """Where it was joined, the boss's edge has nodes on its chords."""
    base, boss = block((0, 0, 0), (6, 6, 2), (8, 8, 3), "BASE"), rod((0.3, 0.2, 1.5), 1.2, 2.5, (3, 5), "BOSS")
    mesh = fs.merge(base, boss, keep=keep).mesh
    result = fs.fillet(mesh, (1.5, 0.2, 2), radius)
    points = face_points(result.mesh) - (0.3, 0.2, 2)
    off = np.hypot(np.hypot(points[:, 0], points[:, 1]) - 1.2 - radius, points[:, 2] - radius) - radius
    assert np.abs(off).max() < 1e-9
    told = result.report.quality
    assert told.after.minimum >= min(0.2, told.before.minimum) and quality(result.mesh).min() > 0.1
    check_conforming(result.mesh)
    # Pappus' theorem on what is between a quarter of a circle and its two tangents; chords of it add up to a
    # tenth, and those of the boss what is between them and the circle.
    way = 1.2 + radius * (10 - 3 * np.pi) / (12 - 3 * np.pi)
    grown = volume(result.mesh) - volume(mesh)
    assert 1 < grown / (2 * np.pi * way * RIGHT_ANGLE * radius**2) < 1.12 + 0.0182 / (RIGHT_ANGLE * radius)


@pytest.mark.parametrize("part", [0.25, 0.5])
def test_the_rim_of_a_coarse_hole(part):
    """By a fraction of the edges: nodes on the tangent line of the wall may have to stay on its facets, which is told;
    all others are on the torus."""
    mesh = fs.drill(grid_box((12, 12, 6), (10.0, 10.0, 5.0)), fs.Cylinder((5, 5, 0), (0, 0, 1), 2), refine=False).mesh
    edge, radius = 10 / 12, part * 10 / 12
    result = fs.fillet(mesh, [(7, 5, 5)], radius)
    assert quality(result.mesh).min() > 0.15
    points = face_points(result.mesh) - (5, 5, 5)
    off = np.abs(np.hypot(np.hypot(points[:, 0], points[:, 1]) - 2 - radius, points[:, 2] + radius) - radius)
    facets = 1.2 * edge**2 / 16
    held = off > 1e-9
    assert off.max() < facets and held.sum() < 0.1 * len(off) and len(off) > 50
    assert (np.abs(points[held, 2] + radius) < 1e-9).all()
    told = [w for w in result.report.warnings if "on the facets of the face beside it" in w]
    assert len(told) == held.any()
