# SPDX-License-Identifier: LGPL-2.1-or-later
"""Walls moved: random holes and faces against what must hold of every result, and special cases."""

import os
import pathlib
import re

import numpy as np
import pytest

import femscalpel as fs
from meshes import grid_box, quadratic, tetra_volumes
from test_physics import plate, quadratic_of

MESHES = pathlib.Path(
    os.environ.get("FEMSCALPEL_TEST_MESHES", pathlib.Path(__file__).parents[2] / "build/release/tests/meshes")
)
Z = (0.0, 0.0, 1.0)
CORNERS = {"tetra": 4, "tetra10": 4, "triangle": 3, "triangle6": 3}
EDGES = {
    "tetra10": ((0, 1, 4), (1, 2, 5), (2, 0, 6), (0, 3, 7), (1, 3, 8), (2, 3, 9)),
    "triangle6": ((0, 1, 3), (1, 2, 4), (2, 0, 5)),
}


def body(mesh):
    return next(k for k in ("tetra", "tetra10", "triangle", "triangle6") if len(mesh.cells.get(k, ())))


def check_conforming(mesh):
    """Every face (edge, of shells) is in at most two elements, every edge has one mid-side node."""
    kind = body(mesh)
    cells = mesh.cells[kind][:, : CORNERS[kind]]
    faces = np.concatenate([np.delete(cells, k, axis=1) for k in range(CORNERS[kind])])
    counts = np.unique(np.sort(faces, axis=1), axis=0, return_counts=True)[1]
    assert counts.max() <= 2
    if kind in EDGES:
        triples = np.concatenate([mesh.cells[kind][:, list(e)] for e in EDGES[kind]])
        triples[:, :2].sort(axis=1)
        found = np.unique(triples, axis=0)
        assert len(np.unique(found[:, :2], axis=0)) == len(found)
    used = np.unique(np.concatenate([c.ravel() for c in mesh.cells.values()]))
    assert len(used) == mesh.node_count


def check_kept(mesh, result):
    """Numbers, groups and all that did not move."""
    after, report = result.mesh, result.report
    old = dict(zip(mesh.node_ids.tolist(), mesh.points))
    new = dict(zip(after.node_ids.tolist(), after.points))
    kept = old.keys() & new.keys()
    assert min(new.keys() - kept, default=1 << 40) > max(old)
    moved = {n for n in kept if (old[n] != new[n]).any()}
    assert report.nodes_moved == len(moved) and report.nodes_removed == len(old) - len(kept)
    assert report.nodes_added == len(new) - len(kept)
    kind = body(mesh)
    before = dict(zip(mesh.cell_ids[kind].tolist(), mesh.node_ids[mesh.cells[kind]].tolist()))
    now = dict(zip(after.cell_ids[kind].tolist(), after.node_ids[after.cells[kind]].tolist()))
    assert min(now.keys() - before.keys(), default=1 << 40) > max(before)
    assert set(mesh.groups) <= set(after.groups)
    for record in report.groups:
        if record.status == "untouched" and record.kind == "element":
            assert record.measure_after == record.measure_before
            assert (mesh.groups[record.name].ids == after.groups[record.name].ids).all()
    return old, new


def check_quality(mesh, result):
    quality = result.report.quality
    assert quality.after.minimum >= min(0.2, quality.before.minimum)
    if body(result.mesh).startswith("tetra"):
        cells = result.mesh.cells[body(result.mesh)]
        assert tetra_volumes(result.mesh.points, cells).min() > 0


def check(mesh, result, tool=None):
    check_conforming(result.mesh)
    check_quality(mesh, result)
    if tool is not None:
        wall = np.isin(result.mesh.node_ids, result.mesh.groups["SHAPE_WALL"].ids)
        assert wall.sum() > 5
        assert np.abs(tool.distance(result.mesh.points[wall])).max() < 1e-9 * np.ptp(mesh.points, axis=0).max()
    return check_kept(mesh, result)


def record(result, name, kind="element"):
    return next(g for g in result.report.groups if g.name == name and g.kind == kind)


def random_hole(random):
    """A hole through the two glued boxes, away from all that is not to be met, and its factor."""
    while True:
        radius, factor = random.uniform(1.5, 3), random.uniform(0.6, 1.7)
        origin = np.array([random.uniform(3, 17), 5 + random.uniform(-1, 1), 0])
        if random.random() < 0.3:
            origin[0] = 10 + random.uniform(-0.4, 0.4)
        axis = np.array([*random.normal(scale=0.12, size=2), 1])
        fits = True
        for r in (radius, factor * radius):
            for z in (0, 10):
                x, y, _ = origin + axis * z
                beside = abs(x - 10)
                fits &= min(x - r, 20 - x - r, y - r, 10 - y - r) > 1.3
                fits &= beside > r + 1.3 or beside < 0.6 * r
        if fits:
            return origin, axis, radius, factor


@pytest.mark.parametrize("seed", range(12))
def test_random_holes_in_a_solid(seed):
    origin, axis, radius, factor = random_hole(np.random.default_rng(seed))
    drilled = fs.drill(fs.read(MESHES / "two_boxes.inp"), fs.Cylinder(origin, axis, radius)).mesh
    tool = fs.Cylinder(origin, axis, radius * factor)
    result = fs.reshape(drilled, "HOLE_WALL", onto=tool)
    check(drilled, result, tool)
    # The part's faces stay flat, the border between its groups too.
    after = result.mesh
    assert after.points.min(axis=0) == pytest.approx([0, 0, 0], abs=1e-12)
    assert after.points.max(axis=0) == pytest.approx([20, 10, 10], abs=1e-12)
    top = np.unique(after.cells["triangle"][np.isin(after.cell_ids["triangle"], after.groups["TOP"].ids)])
    assert np.abs(after.points[top, 2] - 10).max() < 1e-12
    glue = np.unique(after.cells["triangle"][np.isin(after.cell_ids["triangle"], after.groups["GLUE"].ids)])
    assert np.abs(after.points[glue, 0] - 10).max() < 1e-12
    for end in ("END_LEFT", "END_RIGHT"):
        assert record(result, end).measure_after == pytest.approx(record(result, end).measure_before, rel=1e-9)
    parts = sum(record(result, side).measure_after for side in ("LEFT", "RIGHT"))
    assert parts == pytest.approx(record(result, "ALL").measure_after, rel=1e-9)
    exact = np.pi * radius**2 * (factor**2 - 1) * 10 * np.linalg.norm(axis / axis[2])
    change = record(result, "ALL").measure_before - record(result, "ALL").measure_after
    assert change == pytest.approx(exact, abs=0.08 * np.pi * (radius * max(1, factor)) ** 2 * 10)


@pytest.mark.parametrize("seed", range(12))
def test_random_walls_of_a_solid(seed):
    random = np.random.default_rng(100 + seed)
    mesh = fs.read(MESHES / "two_boxes.inp")
    name, axis, side = [("END_LEFT", 0, -1), ("END_RIGHT", 0, 1), ("TOP", 2, 1)][seed % 3]
    by = np.zeros(3)
    by[axis] = random.uniform(-3, 3) * 1.25
    result = fs.reshape(mesh, name, by=by)
    check(mesh, result)
    for group in ("ALL", "LEFT", "RIGHT"):
        before, after = record(result, group).measure_before, record(result, group).measure_after
        moved = name == "TOP" or (group != "LEFT" if name == "END_RIGHT" else group != "RIGHT")
        area = (200 if group == "ALL" else 100) if name == "TOP" else 100
        assert after - before == pytest.approx(side * by[axis] * area if moved else 0, abs=1e-8)
    assert record(result, name).measure_after == pytest.approx(record(result, name).measure_before)


@pytest.mark.parametrize("second_order", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_random_holes_in_a_plate(seed, second_order):
    random = np.random.default_rng(200 + seed)
    count = int(random.integers(12, 24))
    mesh = plate((count, count), (10.0, 10.0))
    if second_order:
        mesh = quadratic_of(mesh)
    radius, factor = random.uniform(1, 2), random.uniform(0.6, 1.7)
    origin = (5 + random.uniform(-1, 1), 5 + random.uniform(-1, 1), 0)
    drilled = fs.drill(mesh, fs.Cylinder(origin, Z, radius)).mesh
    tool = fs.Cylinder(origin, Z, radius * factor)
    check(drilled, fs.reshape(drilled, "HOLE_WALL", onto=tool), tool)
    check(drilled, fs.reshape(drilled, "HOLE_WALL", scale=(factor, origin)), tool)
    by = random.uniform(-1, 1, size=3) * (1, 1, 0)
    moved = fs.reshape(drilled, "HOLE_WALL", by=by)
    check(drilled, moved, fs.Cylinder(origin + by, Z, radius))


@pytest.mark.parametrize("by", [(0, 0, 2), (0, 0, -2)])
def test_a_round_stem(by):
    """The cylinder beside the face goes on as the cylinder it is."""
    mesh = fs.read(MESHES / "flanged_cylinder.inp")
    result = fs.reshape(mesh, "HEAD", by=by)
    old, new = check(mesh, result)
    head = [n for n, x in old.items() if x[2] == 16]
    assert all(new[n][2] == pytest.approx(16 + by[2], abs=1e-12) for n in head)
    rim = [n for n in head if np.hypot(*old[n][:2]) > 3.99]
    assert all(np.hypot(*new[n][:2]) == pytest.approx(4, abs=1e-8) for n in rim)
    for name in ("CORNER", "FOOT", "GLUE", "FLANGE"):
        assert record(result, name).measure_after == record(result, name).measure_before


@pytest.mark.parametrize("radius", [2.5, 3.3, 5.0])
def test_the_stem_itself(radius):
    mesh = fs.read(MESHES / "flanged_cylinder.inp")
    tool = fs.Cylinder((0, 0, 0), Z, radius)
    result = fs.reshape(mesh, "Surface1", onto=tool)
    check(mesh, result, tool)
    corner = np.isin(result.mesh.cell_ids["line"], result.mesh.groups["CORNER"].ids)
    inside = np.unique(result.mesh.cells["line"][corner])
    assert np.abs(tool.distance(result.mesh.points[inside])).max() < 1e-9


@pytest.mark.parametrize("y", [-2.0, 1.5])
def test_the_elbow_gets_longer_or_shorter(y):
    mesh = fs.read(MESHES / "quadratic_elbow.inp")
    result = fs.reshape(mesh, "INLET", by=(0, y, 0))
    check(mesh, result, fs.Plane((0, -4 + y, 0), (0, 1, 0)))
    area = np.pi * (3.5**2 - 2**2)
    change = record(result, "STRAIGHT").measure_after - record(result, "STRAIGHT").measure_before
    assert change == pytest.approx(-y * area, rel=1e-3)


def with_fillet():
    """A step with a fillet: elements of a grid whose corner was rounded."""
    mesh = grid_box((12, 4, 4), (12.0, 4.0, 4.0))
    points = mesh.points.copy()
    along, height = mesh.points[:, 0], mesh.points[:, 2] - 4
    turn = np.clip((along - 4) / 4, 0, 1) * np.pi / 2
    points[:, 0] = np.where(along <= 4, along, 4 + (1 - height) * np.sin(turn))
    points[:, 2] = np.where(along <= 4, points[:, 2], 5 - (1 - height) * np.cos(turn) + np.maximum(0, along - 8))
    top = (height == 0) & (along <= 4)
    return fs.Mesh(points, {"tetra": mesh.cells["tetra"]}, groups={"STEP": ("node", mesh.node_ids[top])})


def test_a_fillet_follows():
    mesh = with_fillet()
    round_ = (np.abs(np.hypot(mesh.points[:, 0] - 4, mesh.points[:, 2] - 5) - 1) < 1e-9) & (mesh.points[:, 2] < 4.99)
    result = fs.reshape(mesh, "STEP", by=(0, 0, 0.8))
    old, new = check(mesh, result, fs.Plane((0, 0, 4.8), Z))
    for n in mesh.node_ids[round_]:
        assert new[n] - old[n] == pytest.approx([0, 0, 0.8], abs=1e-9)
    assert any("tangent" in w for w in result.report.warnings)


def test_part_of_a_face_takes_the_rest_along():
    mesh = grid_box()
    mesh.add_group("HALF", "node", mesh.node_ids[(mesh.points[:, 2] == 4) & (mesh.points[:, 0] <= 3)])
    result = fs.reshape(mesh, "HALF", by=(0, 0, 0.5))
    assert tetra_volumes(result.mesh.points, result.mesh.cells["tetra"]).sum() == pytest.approx(6 * 5 * 4.5)
    assert any("same surface" in w for w in result.report.warnings)


def test_a_tilted_plane():
    mesh = quadratic(grid_box())
    mesh.add_group("END", "node", mesh.node_ids[mesh.points[:, 0] == 6])
    plane = fs.Plane((6, 2.5, 2), (1, 0.2, -0.3))
    result = fs.reshape(mesh, "END", onto=plane, name="TILT")
    check_conforming(result.mesh)
    wall = np.isin(result.mesh.node_ids, result.mesh.groups["TILT_WALL"].ids)
    assert wall.sum() == (mesh.points[:, 0] == 6).sum()
    assert np.abs(plane.distance(result.mesh.points[wall])).max() < 1e-12
    assert result.mesh.points[:, 1:].min() >= -1e-12 and result.mesh.points[:, 1].max() <= 5 + 1e-12


def test_an_interface_inside():
    mesh = fs.read(MESHES / "two_boxes.inp")
    result = fs.reshape(mesh, "GLUE", by=(1.5, 0, 0))
    check(mesh, result, fs.Plane((11.5, 0, 0), (1, 0, 0)))
    assert record(result, "LEFT").measure_after == pytest.approx(1150)
    assert record(result, "RIGHT").measure_after == pytest.approx(850)
    assert record(result, "TOP").measure_after == pytest.approx(200)


def test_on_a_session():
    mesh = fs.read(MESHES / "two_boxes.inp")
    once, session = fs.reshape(mesh, "END_LEFT", by=(-1, 0, 0)), fs.Scalpel(mesh)
    again = session.reshape("END_LEFT", by=(-1, 0, 0))
    assert (once.mesh.points == again.mesh.points).all() and once.report.groups == again.report.groups


def box():
    mesh = grid_box()
    mesh.add_group("END", "node", mesh.node_ids[mesh.points[:, 0] == 6])
    mesh.add_group("INSIDE", "node", mesh.node_ids[mesh.points[:, 0] == 3])
    mesh.add_group("NONE", "node", [])
    mesh.add_group("VOLUMES", "element", mesh.cell_ids["tetra"][:20])
    return mesh


PLANE = fs.Plane((7, 0, 0), (1, 0, 0))


@pytest.mark.parametrize(
    "arguments, parameter, text",
    [
        (dict(group="NOWHERE", by=(1, 0, 0)), "group", "no group 'NOWHERE'; it has 'END'"),
        (dict(group="EDN", by=(1, 0, 0)), "group", "Did you mean 'END'?"),
        (dict(group="END", by=(1e300, 0, 0)), "by", "more than 300 times the length of the edges there"),
        (dict(group="END", scale=(1e9, (0, 0, 0))), "scale", "more than 300 times the length of the edges there"),
        (dict(group="NONE", by=(1, 0, 0)), "group", "is empty"),
        (dict(group="INSIDE", by=(1, 0, 0)), "group", "covers no face"),
        (dict(group="VOLUMES", by=(1, 0, 0)), "group", "has tetra"),
        (dict(group=3, by=(1, 0, 0)), "group", "must be a string"),
        (dict(group="END"), "onto", "none of onto, by and scale"),
        (dict(group="END", onto=PLANE, by=(1, 0, 0)), "by", "more than one"),
        (dict(group="END", onto=PLANE, scale=(2, (0, 0, 0))), "scale", "more than one"),
        (dict(group="END", onto=3), "onto", "must be"),
        (dict(group="END", by=(0, 0, 0)), "by", "is zero"),
        (dict(group="END", by=(0, 1, 2)), "by", "runs along the wall"),
        (dict(group="END", by=(1, 0)), "by", "three numbers"),
        (dict(group="END", scale=(0, (0, 0, 0))), "scale", "positive"),
        (dict(group="END", scale=(-1.5, (0, 0, 0))), "scale", "positive"),
        (dict(group="END", scale=2), "scale", "a factor and a point"),
        (dict(group="END", by=(-6.5, 0, 0)), "by", "cannot be moved so far"),
        (dict(group="END", onto=fs.Plane((-1, 0, 0), (1, 0, 0))), "onto", "cannot be moved so far"),
        (dict(group="END", onto=fs.Plane((0, 2.2, 0), (0, 1, 0))), "onto", "cannot get there"),
        (dict(group="END", by=(1, 0, 0), name=""), "name", "empty"),
        (dict(group="END", by=(1, 0, 0), name="END OF IT"), "name", "character"),
        (dict(group="END", by=(1, 0, 0), feature_angle=200), "feature_angle", "between 0 and 180"),
        (dict(group="END", by=(1, 0, 0), preserve=["NO"]), "preserve", "NO"),
    ],
)
def test_what_is_wrong_is_named(arguments, parameter, text):
    mesh = box()
    points = mesh.points.copy()
    with pytest.raises((fs.Error, TypeError, ValueError), match=text) as caught:
        fs.reshape(mesh, **arguments)
    assert caught.value.parameter == parameter
    assert (mesh.points == points).all() and "SHAPE_WALL" not in mesh.groups


@pytest.mark.parametrize(
    "motion, parameter",
    [
        (dict(by=(-6.5, 0, 0)), "by"),
        (dict(scale=(0.01, (0, 0, 0))), "scale"),
        (dict(onto=fs.Plane((-1, 0, 0), (1, 0, 0))), "onto"),
        (dict(onto=fs.Plane((0, 2.2, 0), (0, 1, 0))), "onto"),
    ],
)
def test_an_error_says_how_much_of_the_motion_works(motion, parameter):
    """It names the place and the group there; and what it says works does."""
    mesh = box()
    with pytest.raises(fs.ToolError) as caught:
        fs.reshape(mesh, "END", **motion)
    said = re.fullmatch(
        r".*\(.*\).* The nearest other group is 'INSIDE', [0-9.]+ away\."
        r" ([0-9]+) % of the motion works(?:, and perhaps more)?: (\w+)=(.*)",
        str(caught.value),
    )
    assert said and said[2] == parameter == caught.value.parameter and 5 <= int(said[1]) <= 95
    part = eval(said[3], {"Plane": fs.Plane})  # noqa: S307
    result = fs.reshape(mesh, "END", **{parameter: part})
    check_conforming(result.mesh)
    assert result.report.quality.after.minimum > 0.08


def test_an_error_says_which_radius_works():
    wall = fs.drill(fs.read(MESHES / "two_boxes.inp"), fs.Cylinder((5, 5, 0), (0, 0, 1), 2)).mesh
    with pytest.raises(fs.ToolError, match="works.*: onto=Cylinder") as caught:
        fs.reshape(wall, "HOLE_WALL", onto=fs.Cylinder((5, 5, 0), (0, 0, 1), 8))
    tool = eval(re.search(r"onto=(.*)", str(caught.value))[1], {"Cylinder": fs.Cylinder})  # noqa: S307
    assert 2.2 < tool.radius < 5
    check(wall, fs.reshape(wall, "HOLE_WALL", onto=tool), tool)


def test_a_deck_follows(tmp_path):
    mesh = grid_box()
    mesh.add_group("ALL", "element", mesh.cell_ids["tetra"])
    mesh.add_group("FIX", "node", mesh.node_ids[mesh.points[:, 0] == 0])
    mesh.add_group("END", "node", mesh.node_ids[mesh.points[:, 0] == 6])
    fs.write(mesh, tmp_path / "plain.inp")
    pulled = int(mesh.node_ids[(mesh.points == (6, 5, 4)).all(axis=1)][0])
    text = (tmp_path / "plain.inp").read_text() + (
        "*MATERIAL, NAME=M\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*STEP\n*STATIC\n"
        f"*BOUNDARY\nFIX, 1, 3\n*CLOAD\n{pulled}, 1, 5.\nEND, 3, 1.\n*END STEP\n"
    )
    (tmp_path / "deck.inp").write_text(text)
    deck = fs.read(tmp_path / "deck.inp")
    result = fs.reshape(deck, "END", by=(-2.5, 0, 0))
    fs.write(result.mesh, tmp_path / "out.inp")
    again = fs.read(tmp_path / "out.inp")
    out = (tmp_path / "out.inp").read_text()
    assert f"{pulled}, 1, 5." in out and "END, 3, 1." in out and "FIX, 1, 3" in out
    assert (again.groups["END"].ids == mesh.groups["END"].ids).all()
    ends = again.points[np.isin(again.node_ids, again.groups["END"].ids)]
    assert np.abs(ends[:, 0] - 3.5).max() < 1e-9
    assert len(result.report.warnings) == 1 and "with the wall it is on" in result.report.warnings[0]
    fs.reshape(deck, "END", by=(-2.5, 0, 0), strict=True)


@pytest.mark.parametrize("by, text", [(-9, "pass the end of what it slides on"), (-13, "pass through the part")])
def test_a_wall_that_passes_a_corner_or_the_whole_part_is_refused(by, text):
    mesh = fs.read(MESHES / "l_shape.inp")
    with pytest.raises(fs.ToolError, match=text) as error:
        fs.reshape(mesh, "LOAD", by=(by, 0, 0))
    assert error.value.parameter == "by"


def step_plate():
    """An L in the plane: 10 x 8 less the 5 x 4 in its upper right corner, with the sides of that in groups."""
    grid = np.stack(np.meshgrid(np.linspace(0, 10, 21), np.linspace(0, 8, 17), indexing="ij"), axis=-1).reshape(-1, 2)
    index = np.arange(21 * 17).reshape(21, 17)
    cells = np.array([t for i in range(20) for j in range(16) if i < 10 or j < 8 for t in (
        (index[i, j], index[i + 1, j], index[i + 1, j + 1]), (index[i, j], index[i + 1, j + 1], index[i, j + 1])
    )])  # fmt: skip
    used = np.unique(cells)
    mesh = fs.Mesh(np.column_stack([grid[used], np.zeros(len(used))]), {"triangle": np.searchsorted(used, cells)})
    x, y, _ = mesh.points.T
    mesh.add_group("INNER", "node", mesh.node_ids[(x == 5) & (y >= 4)])
    mesh.add_group("STEP", "node", mesh.node_ids[(y == 4) & (x >= 5)])
    mesh.add_group("TOP", "node", mesh.node_ids[y == 8])
    return mesh


@pytest.mark.parametrize("by", [5, 5.1, 6, 8])
def test_a_border_does_not_slide_past_the_end_of_another(by):
    """Else there would be a slit: nodes of the one side of the step on edges of the other."""
    with pytest.raises(fs.ToolError, match="its rim would pass the end of what it slides on"):
        fs.reshape(step_plate(), "INNER", by=(by, 0, 0))


@pytest.mark.parametrize("group, by", [
    ("INNER", (-6, 0, 0)), ("INNER", (-40, 0, 0)), ("TOP", (0, -9, 0)), ("STEP", (0, -5, 0)),
])  # fmt: skip
def test_the_border_of_a_shell_that_would_leave_it_is_refused_at_once(group, by):
    with pytest.raises(fs.ToolError, match="would pass through the part, and leave it on another side") as caught:
        fs.reshape(step_plate(), group, by=by)
    assert caught.value.parameter == "by"


@pytest.mark.parametrize("by", [(-4, 0, 0), (4.5, 0, 0), (2, 0, 0)])
def test_the_border_of_a_step_moves(by):
    mesh = step_plate()
    after = fs.reshape(mesh, "INNER", by=by).mesh
    a, b, c = (after.points[after.cells["triangle"][:, k], :2] for k in range(3))
    areas = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    assert areas.min() > 0 and areas.sum() == pytest.approx(60 + 4 * by[0])


@pytest.mark.parametrize("digits", [5, 6, 8, "single"])
@pytest.mark.parametrize("along", [-1.5, 1.5])
def test_rounded_coordinates_of_a_face_that_group_borders_cut(digits, along):
    """In a turned frame no plane is one to the last digit; both sides of the border have to go onto the same."""
    plain = grid_box((10, 8, 4), (10.0, 8.0, 4.0))
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    points = plain.points @ turn.T
    if digits == "single":
        points = points.astype(np.float32).astype(float)
    else:
        points = np.array([[float(f"{v:.{digits}g}") for v in x] for x in points])
    mesh = fs.Mesh(points, plain.cells)
    mesh.add_group("TOP", "node", mesh.node_ids[plain.points[:, 2] == 4])
    middle = plain.points[plain.cells["tetra"]].mean(axis=1)
    mesh.add_group("LEFT", "element", mesh.cell_ids["tetra"][middle[:, 0] < 5])
    mesh.add_group("FRONT", "element", mesh.cell_ids["tetra"][middle[:, 1] < 3])
    after = fs.reshape(mesh, "TOP", by=along * turn[:, 2]).mesh
    volumes = tetra_volumes(after.points, after.cells["tetra"])
    assert volumes.min() > 0 and volumes.sum() == pytest.approx(80 * (4 + along), rel=1e-3)
    left = np.isin(after.cell_ids["tetra"], after.groups["LEFT"].ids)
    assert volumes[left].sum() == pytest.approx(40 * (4 + along), rel=1e-3)


@pytest.mark.parametrize("radius, x, y", [(1.2, 6.3, 5.2), (1.3, 5.5, 5.1)])
def test_a_hole_so_coarse_that_its_facets_are_parted(radius, x, y):
    """Patches of one cylinder: what is fitted to each of them is not the same to the last digit."""
    mesh = fs.read(MESHES / "two_boxes.inp")
    mesh = fs.drill(mesh, fs.Cylinder((x, y, 0), Z, radius), refine=False, name="HOLE").mesh
    result = fs.reshape(mesh, "HOLE_WALL", by=(0.5, 0.2, 0))
    check(mesh, result, fs.Cylinder((x + 0.5, y + 0.2, 0), Z, radius))


def off_the_wall(mesh, axis, radius):
    """How far edges of the wall are off its cylinder in their middles, in the mean."""
    faces = mesh.cells["triangle"][np.isin(mesh.cell_ids["triangle"], mesh.groups["HOLE_WALL"].ids)]
    a, b = (mesh.points[np.concatenate([faces[:, [k, (k + d) % 3]] for k in range(3)])[:, d]] for d in (0, 1))
    lengths = np.linalg.norm(a - b, axis=1)
    off = np.abs(np.hypot(*((a + b) / 2 - axis)[:, :2].T) - radius)
    return (off * lengths).sum() / lengths.sum()


@pytest.mark.parametrize("gap, told", [(2, False), (0.2, True)])
def test_a_hole_that_gets_less_round_is_told(gap, told):
    """Between the hole and the side of the plate there is no room for all of its nodes."""
    mesh = fs.drill(
        fs.read(MESHES / "two_boxes.inp"), fs.Cylinder((6.3, 5.2, 0), Z, 1.2), refine=False, name="HOLE"
    ).mesh
    result = fs.reshape(mesh, "HOLE_WALL", by=(0, 10 - 1.2 - gap - 5.2, 0))
    before = off_the_wall(mesh, (6.3, 5.2, 0), 1.2)
    after = off_the_wall(result.mesh, (6.3, 10 - 1.2 - gap, 0), 1.2)
    assert (after > 1.05 * before) == told
    assert any("less round" in w for w in result.report.warnings) == told


def test_the_part_of_a_motion_onto_a_cone_that_an_error_tells_works():
    hole = fs.Cylinder((6, 4, 0), (0, 0, 1), 1)
    mesh = fs.drill(grid_box((12, 8, 3), (12.0, 8.0, 3.0)), hole, name="H").mesh
    with pytest.raises(fs.ToolError) as error:
        fs.reshape(mesh, "H_WALL", onto=fs.Cone((6, 4, 1.5), (0, 0, 1), 3.8, 20))
    told = re.search(r" % of the motion works.*onto=Cone\(\((.*)\), \((.*)\), (.*), (.*)\)$", str(error.value))
    origin, axis = ([float(x) for x in told[k].split(",")] for k in (1, 2))
    cone = fs.Cone(origin, axis, float(told[3]), float(told[4]))
    moved = fs.reshape(mesh, "H_WALL", onto=cone).mesh
    wall = moved.points[np.isin(moved.node_ids, moved.groups["SHAPE_WALL"].ids)]
    assert 1 < cone.radius < 3.8 and np.abs(cone.distance(wall)).max() < 1e-9
