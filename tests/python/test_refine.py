# SPDX-License-Identifier: LGPL-2.1-or-later
import re

import numpy as np
import pytest

import femscalpel as fs
from meshes import box_with_groups, grid_box, quadratic, tetra_volumes

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


def longest(mesh, near):
    """Longest edge of a tetrahedron with a corner within 1e-9 of `near`."""
    points, cells = mesh.points, mesh.cells[next(k for k in mesh.cells if k.startswith("tetra"))][:, :4]
    edges = points[cells][:, [a for a, _ in EDGES]] - points[cells][:, [b for _, b in EDGES]]
    touching = (np.linalg.norm(points[cells] - near, axis=2) < 1e-9).any(axis=1)
    return np.linalg.norm(edges[touching], axis=2).max()


@pytest.mark.parametrize("kind", ["tetra", "tetra10"])
def test_around_a_point(kind):
    mesh = box_with_groups() if kind == "tetra" else quadratic(grid_box())
    points, ids = mesh.points.copy(), mesh.node_ids.copy()
    corner = (0, 0, 0)
    result = fs.refine(mesh, near=corner, size=0.3)
    assert longest(mesh, corner) > 1 and longest(result.mesh, corner) <= 0.3
    assert np.array_equal(mesh.points, points) and np.array_equal(result.mesh.points[: len(points)], points)
    assert (
        np.array_equal(result.mesh.node_ids[: len(ids)], ids) and (result.mesh.node_ids[len(ids) :] > ids.max()).all()
    )
    assert fs.measure(result.mesh)[kind].sum() == pytest.approx(120, rel=1e-12)
    assert tetra_volumes(result.mesh.points, result.mesh.cells[kind]).min() > 0
    report = result.report
    assert report.operation == "refine" and report.elements_added > 100 and not report.warnings
    assert report.quality.after.minimum > 0.5 * report.quality.before.minimum
    assert report.to_text().startswith("refine: method bisection")


def test_groups_are_inherited():
    mesh = box_with_groups()
    result = fs.refine(mesh, fs.Plane((3, 0, 0), (1, 0, 0)), size=0.6)
    volumes = dict(zip(result.mesh.cell_ids["tetra"].tolist(), fs.measure(result.mesh)["tetra"]))
    for name, volume in (("LEFT", 60), ("RIGHT", 60), ("ALL", 120)):
        assert sum(volumes[i] for i in result.mesh.groups[name].ids.tolist()) == pytest.approx(volume, rel=1e-12)
    point = dict(zip(result.mesh.node_ids.tolist(), result.mesh.points))
    for name, height in (("FIX", 0), ("TOP", 4)):
        assert set(result.mesh.groups[name].ids.tolist()) == {n for n, x in point.items() if abs(x[2] - height) < 1e-12}
    assert len(result.mesh.groups["EMPTY"].ids) == 0


def test_near_takes_tools_and_points():
    mesh = grid_box()
    tools = [fs.Plane((1, 0, 0), (1, 0, 0)), fs.Cylinder((4, 2, 0), (0, 0, 1), 0.5)]
    counts = [
        fs.refine(mesh, near, size=0.7).mesh.cell_count
        for near in (tools[0], tools[1], tools, np.zeros((2, 3)), [0, 0, 0])
    ]
    assert counts[2] > max(counts[:2]) and counts[3] == counts[4] > mesh.cell_count


def test_gradation_and_reach():
    mesh = grid_box()

    def count(**kwargs):
        return fs.refine(mesh, (0, 0, 0), size=0.5, **kwargs).mesh.cell_count

    assert count(gradation=1.0) < count() < count(gradation=0.2) < count(gradation=0)
    assert count() < count(reach=1.5)


def test_relax_pays():
    box = grid_box()
    inside = ((box.points > 0) & (box.points < (6, 5, 4))).all(axis=1)
    shift = np.random.default_rng(1).uniform(-0.2, 0.2, box.points.shape) * inside[:, None]
    mesh = fs.Mesh(box.points + shift, box.cells)
    relaxed, plain = (fs.refine(mesh, (3, 2.5, 2), size=0.3, relax=r).report.quality.after for r in (True, False))
    assert relaxed.mean > plain.mean and relaxed.minimum > plain.minimum


def test_for_a_tool_finer_than_the_mesh():
    """A crack along a small sphere: coarse, a good part of it is missing, and a warning says so; refined it is not."""
    mesh, sphere = grid_box(), fs.Sphere((3, 2.5, 2), 1.2)

    def crack(m, refine=None):
        result = fs.crack(m, sphere, refine=refine)
        return next(g.measure_after for g in result.report.groups if g.name == "CRACK_P"), " ".join(
            result.report.warnings
        )

    whole = 4 * np.pi * sphere.radius**2
    coarse, warning = crack(mesh, refine=False)
    assert coarse < 0.9 * whole and "the mesh is coarse for the sphere" in warning
    fine, warning = crack(fs.refine(mesh, sphere, size=sphere.radius / 3).mesh)
    assert fine == pytest.approx(whole, rel=0.05) and "coarse" not in warning
    fine, warning = crack(mesh)
    assert fine == pytest.approx(whole, rel=0.05) and "the mesh is coarse" not in warning


HOLE = fs.Cylinder((3.1, 2.4, 0), (0, 0, 1), 0.5)


def same(a, b):
    """Whether two meshes are the same to the last bit."""
    return (
        np.array_equal(a.points, b.points)
        and np.array_equal(a.node_ids, b.node_ids)
        and a.cells.keys() == b.cells.keys()
        and all(
            np.array_equal(a.cells[k], b.cells[k]) and np.array_equal(a.cell_ids[k], b.cell_ids[k]) for k in a.cells
        )
        and a.groups.keys() == b.groups.keys()
        and all(np.array_equal(a.groups[g].ids, b.groups[g].ids) for g in a.groups)
    )


def test_operators_refine_first():
    """One operation: counts and groups of the report compare the input with the result; with a session and as a preview
    too."""
    mesh = box_with_groups()
    with pytest.raises(fs.ToolError, match="Refine the mesh there"):
        fs.drill(mesh, HOLE, refine=False)
    result = fs.drill(mesh, HOLE)
    report = result.report
    assert (
        report.refinement.size == 0.25
        and report.refinement.elements_before == mesh.cell_count < report.refinement.elements_after
    )
    assert "first, to edges of 0.25 near the tool: 720 -> " in report.to_text() and "refine" in report.seconds
    kept = np.isin(result.mesh.node_ids, mesh.node_ids)
    assert (
        report.nodes_removed == mesh.node_count - kept.sum()
        and report.nodes_added == (~kept).sum() == report.nodes_split
    )
    old, new = (np.concatenate(list(m.cell_ids.values())) for m in (mesh, result.mesh))
    assert report.elements_removed == len(np.setdiff1d(old, new)) and report.elements_added == len(
        np.setdiff1d(new, old)
    )
    before = {g.name: g for g in fs.drill(mesh, fs.Cylinder((3.1, 2.4, 0), (0, 0, 1), 2.2), refine=False).report.groups}
    for g in report.groups:
        assert g.status == "new" or (g.count_before, g.measure_before) == (
            before[g.name].count_before,
            before[g.name].measure_before,
        )
    volume = next(g.measure_before - g.measure_after for g in report.groups if g.name == "ALL")
    assert volume == pytest.approx(np.pi * 0.25 * 4, rel=0.02)
    assert report.quality.after.minimum > 0.3
    session = fs.Scalpel(mesh)
    assert same(session.drill(HOLE).mesh, result.mesh)
    preview = session.drill(HOLE, band_only=True)
    assert preview.mesh.cell_count < result.mesh.cell_count
    for name in (
        "refinement",
        "nodes_added",
        "nodes_removed",
        "elements_added",
        "elements_removed",
        "nodes_moved",
        "groups",
    ):
        assert getattr(preview.report, name) == getattr(report, name), name


def test_first_refinement_that_makes_many_elements_says_so():
    """The report, and the preview before it, say what becomes of the mesh; so it was asked for, or little, there is
    nothing to say."""
    mesh, hole = grid_box((4, 3, 2), (4.0, 3.0, 2.0)), fs.Cylinder((2.1, 1.4, 0), (0, 0, 1), 0.1)
    result = fs.drill(mesh, hole)
    before, after = result.report.refinement.elements_before, result.report.refinement.elements_after
    assert before == 144 and after < 55_000  # edges that grew half as fast from the wall made 76 000
    told = [w for w in result.report.warnings if f"from 144 to {after} elements" in w]
    assert len(told) == 1 and "refine=0.1 makes fewer, refine=False none" in told[0]
    assert fs.Scalpel(mesh).drill(hole, band_only=True).report.warnings == result.report.warnings
    assert result.report.quality.after.minimum > 0.4
    fewer = fs.drill(mesh, hole, refine=0.1).report
    assert fewer.refinement.elements_after < after / 2 and not any("refined first" in w for w in fewer.warnings)
    small = fs.drill(grid_box((12, 9, 6), (4.0, 3.0, 2.0)), fs.Cylinder((2.1, 1.4, 0), (0, 0, 1), 0.8)).report
    assert small.refinement is not None and not any("refined first" in w for w in small.warnings)


def test_first_refinement_by_size_or_never():
    mesh, plane, big = (
        box_with_groups(),
        fs.Plane((3.1, 2.4, 2.1), (1, 0.2, 0.1)),
        fs.Cylinder((-8, 2.4, 0), (0, 0, 1), 10),
    )
    for operate in (
        lambda **k: fs.crack(mesh, plane, **k),
        lambda **k: fs.cut(mesh, plane, width=0.2, **k),
        lambda **k: fs.drill(mesh, big, **k),
    ):
        automatic, never, sized = operate(), operate(refine=False), operate(refine=0.6)
        assert (
            automatic.report.refinement is None and same(automatic.mesh, never.mesh) and not automatic.report.warnings
        )
        assert sized.report.refinement.size == 0.6 and sized.mesh.cell_count > 2 * never.mesh.cell_count
    disk = fs.Disk(plane.origin, 1.5)
    front = {refine: fs.crack(mesh, plane, within=disk, refine=refine) for refine in (False, None, 0.2)}
    lengths = {}
    for refine, result in front.items():
        ends = result.mesh.points[result.mesh.cells["line"]]
        lengths[refine] = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    assert (
        front[None].report.refinement.size == 0.75
        and lengths[None].mean() < 0.75 < lengths[False].max()
        and lengths[0.2].max() < 0.3
    )
    assert fs.crack(mesh, plane, method="deform").report.refinement is None


def test_elements_that_cannot_be_bisected_are_no_obstacle():
    """Bricks too near to be refined around: the hole is drilled in the mesh as it is, with a warning; a size given is
    an error."""
    box = grid_box()
    n = box.node_count
    brick = np.array([[6, y, z] for z in (0, 4) for y in (0, 5)] + [[7.5, y, z] for z in (0, 4) for y in (0, 5)], float)
    corner = {tuple(p): i for i, p in enumerate(box.points.tolist())}
    old = [corner[tuple(p)] for p in brick[:4].tolist()]
    cell = [old[0], n, n + 1, old[1], old[2], n + 2, n + 3, old[3]]
    mesh = fs.Mesh(np.concatenate([box.points, brick[4:]]), {"tetra": box.cells["tetra"], "hexahedron": [cell]})
    hole = fs.Cylinder((1.6, 2.5, 0), (0, 0, 1), 1.2)
    result = fs.drill(mesh, hole)
    assert result.report.refinement is not None and result.report.converted == {"hexahedron": 1}
    assert fs.drill(mesh, hole, refine=0.6).report.converted == {"hexahedron": 1}


@pytest.mark.parametrize(
    "refine, error, message",
    [
        (0, ValueError, "refine must be a positive length"),
        (-1.0, ValueError, "refine must be a positive length"),
        (True, TypeError, "not True"),
        ("fine", TypeError, "refine must be a number"),
        (float("inf"), ValueError, "refine must be a finite number"),
    ],
)
def test_bad_first_refinement(refine, error, message):
    with pytest.raises(error, match=message):
        fs.drill(grid_box(), HOLE, refine=refine)


def test_nothing_to_do():
    mesh = grid_box()
    result = fs.refine(mesh, (0, 0, 0), size=5)
    assert result.mesh.node_count == mesh.node_count and "nothing was refined" in result.report.warnings[0]


@pytest.mark.parametrize(
    "near, options, error, message",
    [
        ((0, 0, 0), {"size": 0}, fs.ToolError, "size is 0"),
        ((0, 0, 0), {"size": float("nan")}, ValueError, "size must be a finite number"),
        ((0, 0, 0), {"size": "1"}, TypeError, "size must be a number"),
        ((0, 0, 0), {"size": 1, "gradation": -1}, fs.ToolError, "gradation is -1"),
        ((0, 0, 0), {"size": 1, "reach": -1}, fs.ToolError, "reach is -1"),
        ((0, 0, 0), {"size": 0.01, "gradation": 0, "max_elements": 5000}, fs.ToolError, "more than 5000 elements"),
        ((0, 0, 0), {"size": 1, "max_elements": 0}, ValueError, "max_elements must be at least 1"),
        ((0, 0, 0), {"size": 1, "relax": 1}, TypeError, "relax must be True or False"),
        ((0, 0), {"size": 1}, TypeError, "near must be a tool"),
        ("here", {"size": 1}, TypeError, "near must be a tool"),
        ([], {"size": 1}, TypeError, "near must be a tool"),
        (np.zeros((0, 3)), {"size": 1}, fs.ToolError, "near is empty"),
        ([(0, 0, float("inf"))], {"size": 1}, fs.ToolError, "near: point 0"),
        ([fs.Plane((0, 0, 0), (0, 0, 1)), 3], {"size": 1}, TypeError, r"near\[1\] must be a tool"),
    ],
)
def test_bad_arguments(near, options, error, message):
    with pytest.raises(error, match=message):
        fs.refine(grid_box(), near, **options)


def test_flat_walls_of_a_coarse_hole_are_told():
    """Chords of a hole leave material standing; how much of the hole is said where it is much."""
    mesh, hole = box_with_groups(), fs.Cylinder((3.1, 2.4, 0), (0, 0, 1), 1.2)

    def left(result):
        removed = next(g.measure_before - g.measure_after for g in result.report.groups if g.name == "ALL")
        return 1 - removed / (np.pi * hole.radius**2 * 4)

    coarse = fs.drill(mesh, hole, refine=False)
    (warning,) = (w for w in coarse.report.warnings if "the mesh is coarse for the cylinder of radius 1.2" in w)
    assert left(coarse) > 0.05
    assert float(re.search(r"leave about (\d+) %", warning)[1]) / 100 == pytest.approx(left(coarse), abs=0.03)
    fine = fs.drill(mesh, hole)
    assert left(fine) < 0.05 and not any("the mesh is coarse" in w for w in fine.report.warnings)


def test_too_small_a_size_of_an_operator_is_its_own_error():
    with pytest.raises(fs.ToolError, match="refine: size 0.01 would make more than"):
        fs.drill(box_with_groups(), HOLE, refine=0.01)


def test_beams_alone_are_not_refined_and_said_to_be_so():
    beam = fs.Mesh([(0, 0, 0), (1, 0, 0)], {"line": [[0, 1]]})
    result = fs.refine(beam, fs.Plane((0.5, 0, 0), (1, 0, 0)), size=0.1)
    assert result.mesh.node_count == 2 and "beams" in result.report.warnings[0]
