# SPDX-License-Identifier: LGPL-2.1-or-later
import itertools

import numpy as np
import pytest

import femscalpel as fs
from merge_parts import block, rod
from meshes import grid_box, quadratic
from mixed_meshes import grid

REGULAR = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]


def test_mean_ratio():
    mesh = fs.Mesh(
        REGULAR + [[9, 9, 9]], {"tetra": [[0, 1, 2, 3], [1, 0, 2, 3]], "triangle": [[0, 1, 2]], "line": [[0, 4]]}
    )
    ratios = fs.mean_ratio(mesh)
    assert set(ratios) == {"tetra", "triangle", "line"}
    assert sorted(ratios["tetra"]) == pytest.approx([-1, 1])
    assert ratios["triangle"] == pytest.approx([1])


def test_measure():
    mesh = fs.Mesh(
        [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]],
        {"tetra": [[0, 1, 2, 3]], "triangle": [[0, 1, 2]], "line": [[0, 1]], "vertex": [[0]]},
    )
    sizes = {name: values.tolist() for name, values in fs.measure(mesh).items()}
    assert sizes == {
        "tetra": pytest.approx([4 / 3]),
        "triangle": pytest.approx([2]),
        "line": pytest.approx([2]),
        "vertex": [0],
    }
    box = quadratic(grid_box())
    assert fs.measure(box)["tetra10"].sum() == pytest.approx(120)
    assert np.all(fs.mean_ratio(box)["tetra10"] > 0)


UNIT = {
    "hexahedron": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    "wedge": [[0, 0, 0], [1, 0, 0], [0.5, 0.75**0.5, 0], [0, 0, 1], [1, 0, 1], [0.5, 0.75**0.5, 1]],
    "pyramid": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.5**0.5]],
    "tetra": REGULAR,
    "triangle": [[0, 0, 0], [1, 0, 0], [0.5, 0.75**0.5, 0]],
    "quad": [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]],
}
ANGLES = {
    "hexahedron": 90,
    "wedge": 60,
    "pyramid": np.degrees(np.arctan(2**0.5)),
    "tetra": np.degrees(np.arccos(1 / 3)),
    "triangle": 60,
    "quad": 90,
}


@pytest.mark.parametrize("kind", ["hexahedron", "wedge", "pyramid"])
def test_volume_of_elements_with_warped_faces(kind):
    """Their shape functions integrated by 4 points each way, a pyramid as the hexahedron whose upper nodes coincide."""
    rng = np.random.default_rng(3)
    cube = np.array([(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
    as_hexahedron = {
        "hexahedron": range(8),
        "wedge": (0, 1, 2, 2, 3, 4, 5, 5),
        "pyramid": (0, 1, 2, 3, 4, 4, 4, 4),
    }[kind]
    points, weights = np.polynomial.legendre.leggauss(4)
    for _ in range(20):
        corners = cube[[list(as_hexahedron).index(k) for k in range(max(as_hexahedron) + 1)]]
        nodes = 100 + corners + rng.uniform(-0.2, 0.2, corners.shape)
        expected = 0
        for x, y, z in itertools.product(range(4), repeat=3):
            at = (1 + (2 * cube - 1) * np.array([points[x], points[y], points[z]])) / 2
            gradient = np.stack([(2 * cube[:, i] - 1) / 2 * np.delete(at, i, 1).prod(1) for i in range(3)], axis=1)
            jacobian = np.linalg.det(nodes[list(as_hexahedron)].T @ gradient)
            expected += weights[x] * weights[y] * weights[z] * jacobian
        mesh = fs.Mesh(nodes, {kind: np.arange(len(nodes))[None]})
        assert fs.measure(mesh)[kind][0] == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize("shape", UNIT)
def test_regular_elements(shape):
    points = np.array(UNIT[shape], float)
    order = (
        [1, 0, 2, 3]
        if shape == "tetra" and fs.mean_ratio(fs.Mesh(points, {shape: [[0, 1, 2, 3]]}))[shape][0] < 0
        else list(range(len(points)))
    )
    mesh = fs.Mesh(points, {shape: [order]})
    assert fs.scaled_jacobian(mesh)[shape] == pytest.approx([1])
    assert fs.smallest_angle(mesh)[shape] == pytest.approx([ANGLES[shape]])


def test_scaled_jacobian_and_angle_of_bad_elements():
    flat = fs.Mesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 1e-3]], {"tetra": [[0, 1, 2, 3], [1, 0, 2, 3]], "line": [[0, 1]]}
    )
    assert fs.scaled_jacobian(flat)["tetra"][0] == pytest.approx(-fs.scaled_jacobian(flat)["tetra"][1])
    assert 0 < fs.scaled_jacobian(flat)["tetra"][0] < 2e-3
    assert fs.smallest_angle(flat)["tetra"] == pytest.approx([np.degrees(1e-3)] * 2, abs=1e-3)
    assert fs.scaled_jacobian(flat)["line"] == [1] and np.isnan(fs.smallest_angle(flat)["line"]).all()


# Ends of the edges that carry mid-side nodes, in their order.
EDGES = {
    "tetra10": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    "pyramid13": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    "wedge15": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexahedron20": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    "triangle6": ((0, 1), (1, 2), (2, 0)),
    "quad8": ((0, 1), (1, 2), (2, 3), (3, 0)),
}


@pytest.mark.parametrize("kind", EDGES)
def test_scaled_jacobian_looks_at_the_corners_of_second_order_elements(kind):
    shape = kind.rstrip("0123456789")
    corners = np.array(UNIT[shape], float)
    if shape == "tetra":
        corners[[0, 1]] = corners[[1, 0]]
    middles = np.array([(corners[a] + corners[b]) / 2 for a, b in EDGES[kind]])

    def value():
        points = np.concatenate([corners, middles])
        return fs.scaled_jacobian(fs.Mesh(points, {kind: [range(len(points))]}))[kind][0]

    assert value() == pytest.approx(1)
    for k, (a, b) in enumerate(EDGES[kind]):
        straight = middles[k].copy()
        # Along the edge past a quarter of it, the edge leaves its near end backwards.
        middles[k] = 0.76 * corners[a] + 0.24 * corners[b]
        assert value() < -0.5, (a, b)
        middles[k] = 0.74 * corners[a] + 0.26 * corners[b]
        assert value() > 0.5, (a, b)
        middles[k] = straight


def test_scaled_jacobian_of_bent_elements():
    # The edge 0-1 of a right triangle bent inwards by h: at node 1 the directions are (-1, 4h) and (-1, 1).
    for h in (0.1, 0.25, 0.4):
        points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, h, 0], [0.5, 0.5, 0], [0, 0.5, 0]]
        angle = np.arctan2(1, 1) - np.arctan2(4 * h, 1)
        expected = min(np.sin(angle), np.sin(np.pi / 4)) / np.sin(np.pi / 3)
        assert fs.scaled_jacobian(fs.Mesh(points, {"triangle6": [range(6)]}))["triangle6"] == pytest.approx(
            [expected], abs=1e-12
        )
        # In any plane, seen from either side.
        turned = np.array(points) @ np.linalg.qr(np.arange(9).reshape(3, 3) ** 2 + np.eye(3))[0]
        for order in (range(6), [1, 0, 2, 3, 5, 4]):
            mesh = fs.Mesh(turned, {"triangle6": [list(order)]})
            assert fs.scaled_jacobian(mesh)["triangle6"] == pytest.approx([expected], abs=1e-12)


def test_scaled_jacobian_of_a_quadrangle_with_a_reentrant_corner():
    mesh = fs.Mesh([[0, 0, 0], [2, 0, 0], [0.5, 0.5, 0], [0, 2, 0]], {"quad": [[0, 1, 2, 3]]})
    assert fs.scaled_jacobian(mesh)["quad"][0] < -0.5


def test_measure_of_curved_pyramids_is_that_of_the_hexahedron_they_fill():
    rng = np.random.default_rng(3)
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
    edges = EDGES["hexahedron20"]
    middles = np.array([(corners[a] + corners[b]) / 2 for a, b in edges]) + rng.uniform(-0.1, 0.1, (12, 3))
    tip = np.array([0.5, 0.45, 0.55])
    to_tip = (corners + tip) / 2 + rng.uniform(-0.05, 0.05, (8, 3))
    points = np.concatenate([corners, middles, [tip], to_tip])
    place = {frozenset(e): 8 + k for k, e in enumerate(edges)}
    pyramids = []
    for face in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
        base = face[::-1]
        around = [place[frozenset((base[k], base[(k + 1) % 4]))] for k in range(4)]
        pyramids.append([*base, 20, *around, *(21 + c for c in base)])
    found = fs.measure(fs.Mesh(points, {"hexahedron20": [range(20)], "pyramid13": pyramids}))
    assert abs(found["hexahedron20"][0] - 1) > 1e-3
    assert found["pyramid13"].sum() == pytest.approx(found["hexahedron20"][0], rel=1e-12)


def least_of_changed(before, after):
    """The least mean ratio of solids with other corners, or other places of these, than in the mesh before."""

    def corners(mesh, kind):
        nodes = np.asarray(mesh.cells[kind])
        return {n: (tuple(mesh.node_ids[c]), mesh.points[c].tobytes()) for n, c in zip(mesh.cell_ids[kind], nodes)}

    ratios = [1.0]
    for kind, all_of in fs.mean_ratio(after).items():
        if kind.startswith(("tetra", "pyramid", "wedge", "hexahedron")):
            was = corners(before, kind) if kind in before.cells else {}
            ratios += [q for q, (n, c) in zip(all_of, corners(after, kind).items()) if was.get(n) != c]
    return min(ratios)


def least(mesh):
    return min(q.min() for kind, q in fs.mean_ratio(mesh).items() if not kind.startswith(("line", "tri", "vertex")))


@pytest.mark.parametrize("angle", [0.1, 0.2, 0.4])
def test_reports_count_what_was_converted_beside_the_band(angle):
    """Pyramids and tetrahedra are farther from the tool than what it divides, and can be worse."""
    points, cells = grid((12, 7, 7), 0.2)
    mesh = fs.Mesh(points, {"hexahedron": cells})
    result = fs.crack(mesh, fs.Plane((6, 3.5, 3.5), (1, angle, 0.2)))
    quality = result.report.quality
    assert quality.after.minimum == pytest.approx(least_of_changed(mesh, result.mesh), abs=1e-12)
    assert quality.before.minimum >= least(mesh) and quality.before.count < quality.after.count


def test_reports_count_what_was_divided_beside_the_band():
    """Edges that grow slowly away from a fine hole."""
    mesh = grid_box((8, 8, 8), (10.0, 10.0, 10.0))
    hole = fs.Cylinder((5, 5, 0), (0.1, 0, 1), 0.5)
    result = fs.drill(mesh, hole, transition=1)
    quality, divided = result.report.quality, result.report.refinement
    assert divided.elements_after > divided.elements_before
    assert quality.after.minimum == pytest.approx(least_of_changed(mesh, result.mesh), abs=1e-12)
    changed = set(result.mesh.cell_ids["tetra"]) - set(mesh.cell_ids["tetra"])
    assert quality.after.count >= len(changed)


@pytest.mark.parametrize("keep", ["mesh", "addition"])
def test_reports_of_merge_count_all_that_changed(keep):
    base, boss = block((0, 0, 0), (6, 6, 2), (8, 8, 3), "BASE"), rod((0.3, 0.2, 1.5), 1.2, 2.5, (3, 5), "BOSS")
    result = fs.merge(base, boss, keep=keep)
    quality = result.report.quality
    added = np.isin(result.mesh.cell_ids["tetra"], result.mesh.groups["ADD_ADDED"].ids)
    of_added = fs.mean_ratio(result.mesh)["tetra"][added].min()
    assert quality.after.minimum == pytest.approx(min(of_added, least_of_changed(base, result.mesh)), abs=1e-12)
