# SPDX-License-Identifier: LGPL-2.1-or-later
import csv
import re

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box
from mixed_meshes import grid


def rows(array):
    return {frozenset(row) for row in array.tolist()}


def test_elementary_groups_are_disjoint_and_complete():
    mesh = box_with_groups()
    mesh.add_group("CORNER", "node", [*mesh.groups["FIX"].ids[:3], *mesh.groups["TOP"].ids[:2]])
    classes = mesh.elementary_groups()
    assert {(c.kind, c.dimension, c.groups) for c in classes} == {
        ("node", 0, ("FIX",)),
        ("node", 0, ("TOP",)),
        ("node", 0, ("FIX", "CORNER")),
        ("node", 0, ("TOP", "CORNER")),
        ("element", 3, ("LEFT", "ALL")),
        ("element", 3, ("RIGHT", "ALL")),
    }
    for kind in ("node", "element"):
        ids = np.concatenate([c.ids for c in classes if c.kind == kind])
        assert len(np.unique(ids)) == len(ids)
    for group in mesh.groups.all():
        ids = [c.ids for c in classes if c.kind == group.kind and group.name in c.groups]
        np.testing.assert_array_equal(np.sort(np.concatenate(ids)) if ids else [], np.sort(group.ids))


def test_facet_classes_have_element_and_face():
    mesh = grid_box((1, 1, 1), (1.0, 1.0, 1.0), groups={"S": ("facet", [[1, 1], [2, 4]])})
    (found,) = mesh.elementary_groups()
    assert (found.kind, found.dimension, found.groups) == ("facet", 2, ("S",))
    np.testing.assert_array_equal(found.ids, [[1, 1], [2, 4]])


def test_support_on_a_face():
    mesh = box_with_groups()
    found = fs.virtual_boundary(mesh, "FIX")
    assert (found.name, found.kind) == ("FIX", "node")
    # 6 x 5 squares, two triangles each; nothing else.
    assert found.linking.triangles.shape == (60, 3) and found.linking.triangles.dtype == np.int64
    assert rows(found.linking.triangles) and set(found.linking.triangles.ravel()) == set(mesh.groups["FIX"].ids)
    np.testing.assert_array_equal(found.linking.triangle_elements, np.zeros(60))
    assert len(found.bounding) == len(found.isolated) == len(found.enclosed) == 0
    assert len(found.linking) == 60


def test_volume_group_is_bounded_by_its_surface():
    mesh = box_with_groups()
    found = fs.virtual_boundary(mesh, "LEFT", "element")
    assert found.bounding.triangles.shape == (2 * 2 * (3 * 5 + 5 * 4 + 3 * 4), 3)
    np.testing.assert_array_equal(np.sort(found.enclosed), np.sort(mesh.groups["LEFT"].ids))
    index = {number: k for k, number in enumerate(mesh.node_ids)}
    corners = mesh.points[np.vectorize(index.get)(found.bounding.triangles)]
    # Normals out of the area: the flux of x is its volume.
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    assert np.isclose(np.einsum("ij,ij->", corners.mean(axis=1), normals) / 3, 3 * 5 * 4)


def test_figure_9():
    points = [[x, y, 0] for y in range(3) for x in range(3)]
    cells = [[a, a + 1, a + 4] for a in (0, 1, 3, 4)] + [[a, a + 4, a + 3] for a in (0, 1, 3, 4)]
    mesh = fs.Mesh(
        points, {"triangle": cells, "line": [[0, 3]]}, groups={"GN": ("node", [1, 4, 7]), "ALONE": ("node", [5])}
    )
    found = fs.virtual_boundary(mesh, "GN")
    assert rows(found.linking.edges) == {frozenset({1, 4}), frozenset({4, 7})}
    by_edge = dict(zip(map(frozenset, found.linking.edges.tolist()), found.linking.edge_elements.tolist()))
    assert by_edge == {frozenset({1, 4}): 9, frozenset({4, 7}): 0}
    np.testing.assert_array_equal(fs.virtual_boundary(mesh, "ALONE").isolated.nodes, [5])


def test_quadrangles_are_listed_apart():
    points = [[x, y, z] for z in range(2) for y in range(2) for x in range(2)]
    mesh = fs.Mesh(points, {"hexahedron": [[0, 1, 3, 2, 4, 5, 7, 6]]}, groups={"BASE": ("node", [1, 2, 3, 4])})
    found = fs.virtual_boundary(mesh, "BASE")
    assert rows(found.linking.quads) == {frozenset({1, 2, 3, 4})} and found.linking.quads.shape == (1, 4)
    assert found.linking.triangles.shape == (0, 3)


def test_all_at_once_equals_one_by_one():
    mesh = box_with_groups()
    mesh.add_group("FIX", "element", mesh.groups["LEFT"].ids[:5])
    found = fs.virtual_boundaries(mesh)
    assert [(b.name, b.kind) for b in found] == [(g.name, g.kind) for g in mesh.groups.all()]
    for b in found:
        one = fs.virtual_boundary(mesh, b.name, b.kind)
        for part in ("bounding", "linking", "isolated"):
            for name in ("nodes", "edges", "triangles", "quads", "edge_elements", "triangle_elements"):
                np.testing.assert_array_equal(getattr(getattr(b, part), name), getattr(getattr(one, part), name))
        np.testing.assert_array_equal(b.enclosed, one.enclosed)
    assert [b.name for b in fs.virtual_boundaries(mesh, "node")] == ["FIX", "TOP", "EMPTY"]
    assert "60 triangles" in repr(found[3])


def test_errors():
    mesh = box_with_groups()
    with pytest.raises(KeyError, match="NOPE"):
        fs.virtual_boundary(mesh, "NOPE")
    with pytest.raises(KeyError):
        fs.virtual_boundary(mesh, "FIX", "element")
    with pytest.raises(ValueError, match="kind"):
        fs.virtual_boundary(mesh, "FIX", "nodes")
    with pytest.raises(TypeError, match="mesh must be"):
        fs.virtual_boundary("mesh", "FIX")


def test_preserve_of_reshape():
    mesh = box_with_groups()
    for preserve, kept in ((None, True), ((), False)):
        result = fs.reshape(mesh, "TOP", by=(0.0, 0.0, 0.3), preserve=preserve)
        assert {g.boundary_kept for g in result.report.groups if g.status != "new"} == {kept}
    some = fs.reshape(mesh, "TOP", by=(0.0, 0.0, 0.3), preserve=["LEFT"])
    assert {g.name for g in some.report.groups if g.boundary_kept and g.status != "new"} == {"LEFT"}


def test_preserve():
    mesh = box_with_groups()
    plane = fs.Plane((3.3, 2.5, 2), (0.9, 0.3, 0.2))
    result = fs.crack(mesh, plane)
    records = {(g.name, g.kind): g for g in result.report.groups}
    assert all(g.boundary_kept for g in result.report.groups)
    free = fs.crack(mesh, plane, preserve=())
    assert not any(g.boundary_kept for g in free.report.groups if g.status != "new")
    some = fs.Scalpel(mesh).crack(plane, preserve=iter(["LEFT"]))
    assert {g.name for g in some.report.groups if g.boundary_kept and g.status != "new"} == {"LEFT"}
    left = next(g for g in free.report.groups if g.name == "LEFT")
    assert left.boundary_drift > 1e-3 and abs(left.measure_after - left.measure_before) > 1e-6
    assert records["LEFT", "element"].boundary_drift < 1e-9
    assert "free" in free.report.to_text() and " free" not in result.report.to_text().split("\n\n")[1]
    with pytest.raises(fs.ToolError, match="preserve names 'LEFFT'"):
        fs.crack(mesh, plane, preserve=["LEFFT"])
    with pytest.raises(TypeError, match="preserve must be a list"):
        fs.crack(mesh, plane, preserve="LEFT")
    with pytest.raises(TypeError, match="preserve"):
        fs.crack(mesh, plane, preserve=[3])


def test_constraints_by_group_in_every_form(tmp_path):
    mesh = box_with_groups()
    report = fs.crack(mesh, fs.Plane((3.3, 2.5, 2), (0.9, 0.3, 0.2))).report
    counts = report.constraints_by_group
    assert counts.keys() == {g.name for g in report.groups}
    left = next(g for g in report.groups if (g.name, g.kind) == ("LEFT", "element"))
    assert left.nodes_on_surface > 10 and left.nodes_on_line > 3
    assert counts["LEFT"] == {"surface": left.nodes_on_surface, "line": left.nodes_on_line, "fixed": left.nodes_fixed}
    line = next(row for row in report.to_text().splitlines() if row.startswith("LEFT "))
    assert line.split()[-1] == f"{left.nodes_on_surface}/{left.nodes_on_line}/{left.nodes_fixed}"
    report.to_csv(tmp_path / "groups.csv")
    with (tmp_path / "groups.csv").open(newline="") as file:
        rows_of = {(row["name"], row["kind"]): row for row in csv.DictReader(file)}
    assert len(rows_of) == len(report.groups)
    for g in report.groups:
        row = rows_of[g.name, g.kind]
        assert [int(row[k]) for k in ("nodes_on_surface", "nodes_on_line", "nodes_fixed")] == [
            g.nodes_on_surface,
            g.nodes_on_line,
            g.nodes_fixed,
        ]
        assert (
            row["boundary_kept"] == "True"
            and float(row["measure_after"]) == g.measure_after
            and row["status"] == g.status
        )


def test_scattered_groups_that_hold_nodes_everywhere_are_warned_of():
    mesh = grid_box((12, 10, 8))
    ids = mesh.cell_ids["tetra"]
    plane = fs.Plane((3.1, 2.5, 2.0), (1.0, 0.2, 0.3))
    assert not any("hold" in w for w in fs.crack(mesh, plane, name="CRACK").report.warnings)
    rng = np.random.default_rng(3)
    for k in range(100):
        mesh.add_group(f"R{k:02}", "element", rng.choice(ids, 60, replace=False))
    report = fs.crack(mesh, plane, name="CRACK").report
    (warning,) = [w for w in report.warnings if "hold" in w]
    assert report.quality.after.minimum < 0.2 and "preserve" in warning
    # Those named first hold most nodes.
    named = re.findall(r"'(\w+)' \((\d+)\)", warning)
    assert len(named) == 5 and [int(n) for _, n in named] == sorted((int(n) for _, n in named), reverse=True)
    held = {g.name: g.nodes_fixed + g.nodes_on_line for g in report.groups if g.name.startswith("R")}
    assert all(held[name] >= int(n) >= 10 for name, n in named)
    # Without them it is as it was, and nothing is said.
    free = fs.crack(mesh, plane, name="CRACK", preserve=()).report
    assert free.quality.after.minimum > 0.4 and not any("hold" in w for w in free.warnings)


def test_a_group_that_alternates_keeps_its_members_and_the_elements_their_shape():
    mesh = grid_box((12, 10, 8))
    inner = ((mesh.points > 0) & (mesh.points < (6, 5, 4))).all(axis=1)
    points = mesh.points + np.random.default_rng(1).uniform(-0.07, 0.07, mesh.points.shape) * inner[:, None]
    mesh = fs.Mesh(points, mesh.cells)
    mesh.add_group("ALT", "element", mesh.cell_ids["tetra"][::2])
    result = fs.crack(mesh, fs.Plane((3.1, 2.5, 2.0), (1.0, 0.2, 0.3)), name="CRACK")
    (alternating,) = [g for g in result.report.groups if g.name == "ALT"]
    assert abs(alternating.measure_after - alternating.measure_before) < 2e-3 * alternating.measure_before
    assert result.report.quality.after.minimum > 0.2


def covered_points(mesh, name):
    """Triangles and edges, as coordinates, of what a group covers."""
    found = fs.virtual_boundary(mesh, name)
    place = dict(zip(mesh.node_ids, mesh.points))
    faces = [[place[n] for n in row] for part in (found.bounding, found.linking) for row in part.triangles]
    edges = [[place[n] for n in row] for part in (found.bounding, found.linking) for row in part.edges]
    return np.array(faces).reshape(-1, 3, 3), np.array(edges).reshape(-1, 2, 3)


def distance_to_triangle(x, a, b, c):
    from scipy.optimize import nnls

    # The nearest convex combination: least squares with the sum of weights held to one by a heavy row.
    heavy = 1e4
    matrix = np.vstack([np.stack([a, b, c], axis=1), heavy * np.ones(3)])
    return np.linalg.norm(np.stack([a, b, c], axis=1) @ nnls(matrix, np.append(x, heavy))[0] - x)


def test_drift_along_shortcuts_is_reported():
    """A support on two sides of an edge of a box: faces and edges lead through the corner elements from one to the
    other."""
    box = grid_box()
    x, y = box.points[:, 0], box.points[:, 1]
    mesh = fs.Mesh(
        box.points,
        box.cells,
        groups={"FIX": ("node", 1 + np.nonzero((x == 0) | (y == 5))[0]), "SIDE": ("node", 1 + np.nonzero(x == 0)[0])},
    )
    plane = fs.Plane((0.6, 4.5, 2.2), (1, 1, 0.2))
    result = fs.crack(mesh, plane)
    drift = {g.name: g.boundary_drift for g in result.report.groups}
    assert drift["SIDE"] < 1e-12  # has no shortcuts
    old = covered_points(mesh, "FIX")
    old = [*old[0], *(np.array([a, b, b]) for a, b in old[1])]
    farthest = 0
    for face in covered_points(result.mesh, "FIX")[0]:
        if np.abs(plane.distance(face)).max() < 1e-9:
            continue  # a lip, inside what the group encloses
        near = [piece for piece in old if np.linalg.norm(piece.mean(axis=0) - face.mean(axis=0)) < 2]
        for point in (*face, face.mean(axis=0)):
            farthest = max(farthest, min(distance_to_triangle(point, *piece) for piece in near))
    assert farthest > 0.05 and drift["FIX"] == pytest.approx(farthest, abs=1e-3)


def test_an_area_that_edges_no_longer_enclose_is_warned_of():
    points = np.array([(i, j, 0.0) for j in range(5) for i in range(9)])
    triangles = np.array(
        [
            (j * 9 + i + a, j * 9 + i + b, j * 9 + i + c)
            for j in range(4)
            for i in range(8)
            for a, b, c in ((0, 1, 10), (0, 10, 9))
        ]
    )
    inside, away = 2 * (2 * 8 + 3), 2 * 8 + 14
    rings = [[t[k], t[(k + 1) % 3]] for t in (triangles[inside], triangles[away]) for k in range(3)]
    count = len(triangles)
    groups = {
        "RING": ("element", range(count + 1, count + 4)),
        "AWAY": ("element", range(count + 4, count + 7)),
        "ROW": ("element", range(count + 1, count + 3)),
        "WHOLE": ("element", [inside + 1, *range(count + 1, count + 4)]),
    }
    mesh = fs.Mesh(points, {"triangle": triangles, "line": rings}, groups=groups)
    enclosed = [len(fs.virtual_boundary(mesh, name).enclosed) for name in ("RING", "AWAY", "ROW", "WHOLE")]
    assert enclosed == [1, 1, 0, 1]
    result = fs.crack(mesh, fs.Plane(points[triangles[inside]].mean(axis=0), (1, 0.4, 0)))
    warned = [w for w in result.report.warnings if "covers less than before" in w]
    assert len(warned) == 1 and f"group 'RING' covers element {inside + 1}, or" in warned[0]
    assert [len(fs.virtual_boundary(result.mesh, name).enclosed) > 0 for name in ("RING", "AWAY", "WHOLE")] == [
        False,
        True,
        True,
    ]
    refined = fs.refine(mesh, near=fs.Sphere(points[triangles[inside]].mean(axis=0), 0.01), size=0.5)
    assert any("group 'RING' covers" in w for w in refined.report.warnings)


@pytest.mark.parametrize("with_edges", [False, True])
def test_a_volume_that_faces_or_edges_no_longer_enclose_is_warned_of(with_edges):
    box = grid_box()
    centres = box.points[box.cells["tetra"]].mean(axis=1)
    k = int(np.linalg.norm(centres - (3.3, 2.5, 2), axis=1).argmin())
    a, b, c, d = box.cells["tetra"][k]
    count = box.cell_count
    if with_edges:
        cells, members = {"line": [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]]}, 6
    else:
        cells, members = {"triangle": [[a, b, c], [a, b, d], [a, c, d], [b, c, d]]}, 4
    mesh = fs.Mesh(
        box.points, {**box.cells, **cells}, groups={"SHELL": ("element", range(count + 1, count + members + 1))}
    )
    before = fs.virtual_boundary(mesh, "SHELL")
    assert len(before.enclosed) == 1
    result = fs.crack(mesh, fs.Plane(centres[k], (0.9, 0.3, 0.2)))
    after = fs.virtual_boundary(result.mesh, "SHELL")
    warned = any("group 'SHELL' covers" in w and "covers less than before" in w for w in result.report.warnings)
    assert len(after.enclosed) == 0 and warned


def test_faces_on_edges_of_shells_stay_where_elements_are_merged_away():
    """Cracks that leave slivers at a plate's border: what has the edge may be another element then."""
    points, squares = grid((10, 8), 0.2)
    cells = np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])
    rng = np.random.default_rng(5)
    for _ in range(60):
        mesh = fs.Mesh(points, {"triangle": cells})
        lower = points[cells][:, :, 1] == 0  # by corner: edge k runs from corner k to the next
        rows, k = np.nonzero(lower & np.roll(lower, -1, axis=1))
        mesh.add_group("EDGE", "facet", np.stack([mesh.cell_ids["triangle"][rows], k + 3], axis=1))
        for name in "AB":
            at, turn = (rng.uniform(2, 8), 0.2, 0), rng.uniform(-1.5, 1.5)
            result = fs.crack(mesh, fs.Plane(at, (np.cos(turn), np.sin(turn), 0)), name=name)
            (record,) = [g for g in result.report.groups if g.name == "EDGE"]
            assert record.measure_after == pytest.approx(10, abs=1e-9)
            mesh = result.mesh
