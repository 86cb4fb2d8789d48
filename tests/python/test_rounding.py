# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rounding is not geometry: tools within rounding of nodes, or a little beside what holds them."""
import os

import femscalpel as fs
import numpy as np
import pytest
import rounding_cases as cases
from meshes import grid_box

#: How many random cases; 3000 take some minutes.
COUNT = int(os.environ.get("FEMSCALPEL_ROUNDING_CASES", 150))


def test_random_tools_beside_nodes_give_good_meshes():
    outcomes = cases.run_many(range(COUNT))
    figures = cases.summary(outcomes)
    print("\n" + cases.line("all", outcomes))
    told = [str(o.case) + ": " + o.text for o in outcomes if o.verdict in ("poor", "wrong")]
    assert not told, told[:5]
    assert figures["refused"] <= max(1, 0.01 * figures["cases"])
    assert figures["good"] >= 0.97 * figures["cases"] - 1
    assert figures["growth"] <= 4


def two_materials(points, kind, cells):
    left = points[cells].mean(axis=1)[:, 0] < points[:, 0].mean()
    ids = np.arange(1, len(cells) + 1)
    return fs.Mesh(points, {kind: cells}, groups={"LEFT": ("element", ids[left]), "RIGHT": ("element", ids[~left])})


@pytest.mark.parametrize("noise", [0, 1e-8, 1e-6])
@pytest.mark.parametrize("offset", [0, 1e-9, 1e-7, 1e-6, 1e-4, 1e-3])
@pytest.mark.parametrize("make", [cases._grid_plate, cases._grid_box], ids=["plate", "box"])
def test_plane_beside_the_border_of_two_materials(make, offset, noise):
    """The border's nodes are the crack's: no sliver comes to lie between the two."""
    points, kind, cells = make()
    middle, edge = points[:, 0].mean(), np.ptp(points[:, 0]) / (12 if kind == "triangle" else 6)
    row = abs(points[:, 0] - middle) < 1e-9
    points[row, 0] += np.random.default_rng(1).uniform(-noise, noise, row.sum())
    mesh = two_materials(points, kind, cells)
    result = fs.crack(mesh, fs.Plane((middle + offset * edge, 0, 0), (1, 0, 0)))
    assert result.report.quality.after.minimum == pytest.approx(result.report.quality.before.minimum, rel=1e-3)
    assert result.report.nodes_doubled == row.sum() and result.mesh.cells[kind].shape == mesh.cells[kind].shape
    for group in result.report.groups:
        if group.name in ("LEFT", "RIGHT"):
            assert group.measure_after == pytest.approx(group.measure_before, rel=1e-9)
    held = result.report.held
    if offset * edge > 10 * noise + 1e-9:
        assert (
            held.count == row.sum()
            and held.largest == pytest.approx(offset * edge, abs=2 * noise + 1e-12)
            and set(held.groups) == {"LEFT", "RIGHT"}
        )
    # What is far below an edge length is no reason for a warning.
    said = [w for w in result.report.warnings if "held by" in w]
    if held.largest > 2e-5 * edge:
        assert len(said) == 1 and "'LEFT'" in said[0]
    if held.largest < 0.5e-5 * edge:
        assert not said


def test_nodes_of_a_rounded_file_are_put_onto_the_tool():
    rng = np.random.default_rng(5)
    points, kind, cells = cases._jittered(*cases._grid_box(), 0.02, 3)
    points = np.array([float(f"{x:.5e}") for x in (points + 1.2345678 / 3).ravel()]).reshape(-1, 3)
    mesh = fs.Mesh(points, {kind: cells})
    node = rng.choice(np.nonzero(np.ptp(np.sort(points, axis=1), axis=1))[0])
    plane = fs.Plane(points[node] + 1e-7, (0.3, 0.9, 0.2))  # beside it by less than the last digit
    result = fs.crack(mesh, plane)
    assert abs(plane.distance(result.mesh.points[node])) < 1e-12
    assert result.report.quality.after.minimum > 0.2


def named_middle_mesh():
    points, kind, cells = cases._second_order(*cases._grid_box(4, 0.4))
    inner = [
        n
        for n in np.unique(cells[:, 4:])
        if 0.1 < points[n, 0] < 0.3 and 0 < points[n, 1] < 0.4 and 0 < points[n, 2] < 0.4
    ]
    return fs.Mesh(points, {kind: cells}, groups={"GAUGE": ("node", [inner[0] + 1])}), points[inner[0]]


@pytest.mark.parametrize("offset", [1e-10, 2.5e-8, 1e-6, 1e-4])
def test_plane_beside_a_named_mid_side_node(offset):
    mesh, place = named_middle_mesh()
    result = fs.crack(mesh, fs.Plane(place + (offset * 0.1, 0, 0), (1, 0, 0)))
    assert result.mesh.cell_count < 2 * mesh.cell_count and result.report.quality.after.minimum > 0.2
    gauges = result.mesh.groups["GAUGE", "node"].ids
    assert np.allclose(points_of(result.mesh, gauges), place, atol=1e-12)
    assert not any(g.name == "CRACK_FRONT" for g in result.mesh.groups.all())


def points_of(mesh, ids):
    return mesh.points[np.isin(mesh.node_ids, ids)]


@pytest.mark.parametrize("away", [0, 6e2, 6e3, 6e5])
@pytest.mark.parametrize("order", [1, 2])
def test_far_from_the_origin_flat_stays_flat(away, order):
    """A simple grid moved away has more digits, but is not rounded to them."""
    made = cases._jittered(*cases._grid_box(), 0.02, 6)
    points, kind, cells = cases._second_order(*made) if order == 2 else made
    mesh = two_materials(points + (away, 0, 0), kind, cells)
    result = fs.crack(mesh, fs.Plane((away + 0.31, 0.27, 0.3), (1, 0.3, 0.2)))
    assert result.report.warnings == [] and result.report.held.count == 0
    for group in result.report.groups:
        if group.name in ("LEFT", "RIGHT"):
            assert group.measure_after == pytest.approx(group.measure_before, rel=1e-9)


@pytest.mark.parametrize("order", [1, 2])
def test_no_edge_inside_a_crack_joins_its_lips(order):
    """From a node of the front to another: along it the lips would hang together."""
    made = cases._grid_box(4, 0.4)
    points, kind, cells = cases._second_order(*made) if order == 2 else made
    mesh, edge, made = fs.Mesh(points, {kind: cells}), 0.107, 0
    for seed in range(12):
        rng = np.random.default_rng(seed)
        at, normal = points[rng.integers(len(points))], np.eye(3)[rng.integers(3)]
        a = np.cross(normal, rng.normal(size=3))
        a *= 2 * edge / np.linalg.norm(a)
        b = np.cross(normal, a)
        try:
            result = fs.crack(
                mesh,
                fs.Plane(at, normal),
                within=fs.Polygon([at, at + a, at + a + b, at + 0.3 * (a + b), at + b]),
                refine=False,
            )
        except fs.Error:
            continue
        made += 1
        lips = {side: result.mesh.groups["CRACK_" + side, "element"].ids for side in "PN"}
        lips = {
            side: {
                int(n)
                for t, c in result.mesh.cells.items()
                for row in c[np.isin(result.mesh.cell_ids[t], ids)]
                for n in row
            }
            for side, ids in lips.items()
        }
        front = result.mesh.groups["CRACK_FRONT", "element"].ids
        front = {
            int(n)
            for t, c in result.mesh.cells.items()
            for row in c[np.isin(result.mesh.cell_ids[t], front)]
            for n in row
        }
        assert lips["P"] & lips["N"] <= front
    assert made >= 5


def test_plane_that_nearly_touches_a_coarse_curved_skin():
    """It runs along the elbow's straight part, just below its outermost line, where second-order faces are coarse."""
    mesh = fs.read(cases.MESHES / "quadratic_elbow.inp")
    result = fs.crack(mesh, fs.Plane((7.5018980660435, 0, -3.4643750475600625), (0, 0, 1)))
    off, edges = result.report.straightened, mesh.points[mesh.cells["tetra10"][:, :2]]
    # In every mesh nearer to where they belong than to the ends of their edges.
    assert off.count > 0 and 0 < off.largest < np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).max() / 2
    told = f"{off.count} nodes were left in the middle of straight edges, up to {off.largest:.3g} "
    assert any(told in w for w in result.report.warnings)
    assert result.report.quality.after.minimum > 0.1
    assert fs.scaled_jacobian(result.mesh)["tetra10"].min() > 0


@pytest.mark.parametrize("beam", [False, True])
def test_what_would_grow_over_four_times_is_refused_unless_refined_first(beam):
    """A plane along the middle of a one-layer plate crosses all its elements; a beam that is divided does not count."""
    plate = grid_box((24, 24, 1), (24.0, 24.0, 1.0))
    points, cells = plate.points, dict(plate.cells)
    if beam:
        points = np.vstack([points, [(12, 12, -1), (12, 12, 2)]])
        cells["line"] = np.array([[len(points) - 2, len(points) - 1]])
    mesh, plane = fs.Mesh(points, cells), fs.Plane((12, 12, 0.5), (0.004, 0.003, 1))
    with pytest.raises(fs.ToolError, match="would grow from 345[68] to"):
        fs.crack(mesh, plane)
    report = fs.crack(mesh, plane, refine=0.6).report
    assert report.refinement.elements_after > 2 * report.refinement.elements_before and report.nodes_doubled > 500


def plate_with_left(below):
    points, kind, cells = cases._grid_plate(6, 6.0)
    left = points[cells].mean(axis=1)[:, 0] < below
    return fs.Mesh(points, {kind: cells}, groups={"LEFT": ("element", np.arange(1, len(cells) + 1)[left])})


def test_wedge_between_a_plane_and_a_border_is_closed_where_it_is_thin():
    """Of 1.7 degrees: nodes of the border up to a twentieth of an element beside the plane are the crack's."""
    mesh = plate_with_left(3)
    result = fs.crack(mesh, fs.Plane((3.05, 3, 0), (1, 0.03, 0)))
    held = result.report.held
    assert result.report.quality.after.minimum > 0.3  # 0.05 with the wedge filled
    assert held.count > 0 and held.largest < 0.05 and "LEFT" in held.groups
    assert any("held by" in w for w in result.report.warnings)
    report = {g.name: g for g in result.report.groups}
    assert report["LEFT"].measure_after == pytest.approx(report["LEFT"].measure_before, rel=1e-9)


@pytest.mark.parametrize(
    "normal, depth", [((0.7068, 0.7069, 0.028), 2.3e-3), ((0.0045, 0.9999, 0.0091), 1.6e-3), ((0.08, 1, 0.01), 1.2e-3)]
)
def test_a_corner_is_cut_off_though_all_of_it_could_be_held(normal, depth):
    """Where holding nodes beside the plane would leave nothing to part, they are not held."""
    points, kind, cells = cases._grid_box()
    normal = np.array(normal) / np.linalg.norm(normal)
    corner = points[np.argmax(points @ normal)]
    result = fs.crack(fs.Mesh(points, {kind: cells}), fs.Plane(corner - depth * normal, normal))
    assert result.report.nodes_doubled > 0 and len(fs.pieces(result.mesh)) == 2
    assert result.report.quality.after.minimum > 0.02


def second_order_box(amount=0.0, seed=0):
    points, kind, cells = cases._second_order(*cases._jittered(*cases._grid_box(4, 0.4), amount, seed))
    return fs.Mesh(points, {kind: cells})


def check_second_order(mesh, tool, result):
    """No element is folded, and what is beside the tool is in the report."""
    assert fs.scaled_jacobian(result.mesh)["tetra10"].min() > 0
    ids = np.concatenate([result.mesh.groups["CRACK" + side, "element"].ids for side in ("_P", "_N")])
    faces = result.mesh.cells["triangle6"][np.isin(result.mesh.cell_ids["triangle6"], ids)]
    told = max(result.report.held.largest, result.report.straightened.largest)
    assert abs(tool.distance(result.mesh.points[np.unique(faces)])).max() <= told + 1e-8
    assert cases.measures(result.mesh).sum() == pytest.approx(cases.measures(mesh).sum(), rel=1e-9)


def test_cylinders_beside_a_row_of_corners_of_second_order_elements():
    """The row is held where the cylinder passes it a little beside, as in first-order meshes: a third of
    these were refused, as curved elements between row and wall are folded."""
    mesh, rng = second_order_box(), np.random.default_rng(5)
    for number in range(40):
        angle, radius = rng.uniform(0, 2 * np.pi), rng.uniform(0.12, 0.3)
        beside = rng.choice((1e-5, 1e-4, 1e-3, 3e-3)) * 0.1 * rng.choice((-1, 1))
        corner = np.array(((0, 0, 0), (0.4, 0, 0), (0.4, 0.4, 0), (0, 0.4, 0))[rng.integers(4)])
        tool = fs.Cylinder(corner + (radius + beside) * np.array((np.cos(angle), np.sin(angle), 0)), (0, 0, 1), radius)
        try:
            result = fs.crack(mesh, tool, refine=False)
        except fs.ToolError:  # only touches the corner
            continue
        assert result.report.quality.after.minimum > 0.1, (number, tool)
        check_second_order(mesh, tool, result)


@pytest.mark.parametrize(("seed", "straightens"), [(5, False), (10, True)])
def test_shallow_dents_in_the_face_of_a_second_order_mesh(seed, straightens):
    """Between a flat face and a cylinder that dips into it by a fraction of an edge curved elements find little room:
    nodes are held, or edges left straight, and said to be; one of these (5) was refused."""
    mesh, rng, straight = second_order_box(0.02, seed), np.random.default_rng(seed), 0
    for number in range(10):
        radius, depth = rng.uniform(0.12, 0.3), 10 ** rng.uniform(-3.5, -1.7)
        axis = np.array((rng.normal() * 0.3, 1, 0))
        tool = fs.Cylinder((rng.uniform(0.1, 0.3), 0.2, 0.4 + radius - depth), axis / np.linalg.norm(axis), radius)
        try:
            result = fs.crack(mesh, tool)
        except fs.ToolError:  # holds all nodes there are
            continue
        straight += result.report.straightened.count
        if result.report.straightened.count:
            assert any("straight edges" in w for w in result.report.warnings)
        assert result.report.quality.after.minimum > 0.05, (number, tool)
        check_second_order(mesh, tool, result)
    assert (straight > 0) == straightens
