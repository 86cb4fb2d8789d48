# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random edges that are rounded and walls that are moved, and how they come out.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/python/fillet_cases.py --cases 200

Each kind: `convex` and `concave` edges, straight and circular, of the test meshes and of blocks and L shapes turned
anyhow (test meshes half of the time without their groups), the radius between half and six edge lengths where there
is room; `bordered` edges, along which and across which groups of elements meet in many ways;
`ended` ones that end at a wall or in another way; `corner`s of boxes: two or three edges at one, four around a face,
all twelve; a `hole` whose radius becomes 0.6 to 1.7 times the old; a `wall` that is moved by up to three edge lengths.
With --digits 6 or --single, meshes are turned anyhow, moved, and rounded to so many significant digits or to single
precision before, as files have them.
A result is checked: one part, conforming, positive volumes. Printed: how many were refused; the smallest mean
ratio, and how many results have at least 0.15 (fillets) or 0.2 or the input's (walls); the farthest node of the new
face or wall from its surface, in the size of the mesh; the largest error of the volume as a part of what is added
or taken away (of a hole: of the larger one's volume), for straight edges rounded by two edge lengths and more and
walls, and for all; the largest change of the measure of a group none of whose nodes moved; and the seeds that
failed a check, with --refused those that were refused, with --poor those without that quality, too.
"""

import collections
import dataclasses
import pathlib
import time

import numpy as np

import femscalpel as fs
from campaign import case_arguments
from merge_parts import check_conforming, worst
from meshes import grid_box, tetra_volumes
from rounding_cases import rounded
from test_fillet import l_shape
from test_reshape import random_hole

MESHES = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "tests" / "meshes"
CORNER = 1 - np.pi / 4  # between two lines at a right angle and an arc of radius 1
CENTROID = (10 - 3 * np.pi) / (12 - 3 * np.pi)  # of that, from either line


@dataclasses.dataclass
class Placement:
    """Where a mesh is put before something is done to it, and how its coordinates are rounded there."""

    turn: np.ndarray
    shift: np.ndarray
    rounding: object = "as they are"

    def point(self, x):
        return self.turn @ np.asarray(x, float) + self.shift

    def direction(self, x):
        return self.turn @ np.asarray(x, float)

    def back(self, points):
        return (points - self.shift) @ self.turn

    def of(self, mesh):
        if self.rounding == "as they are":
            return mesh
        return rounded(moved(mesh, mesh.points @ self.turn.T + self.shift), self.rounding)

    def off(self, mesh):
        """How far coordinates are off at most."""
        if self.rounding == "as they are":
            return 0
        exact = mesh.points @ self.turn.T + self.shift
        return np.abs(self.of(mesh).points - exact).max()


HERE = Placement(np.eye(3), np.zeros(3))


def moved(mesh, points):
    groups = [(g.name, g.kind, g.ids) for g in mesh.groups.all()]
    return fs.Mesh(points, mesh.cells, node_ids=mesh.node_ids, cell_ids=mesh.cell_ids, groups=groups)


@dataclasses.dataclass
class Case:
    """A mesh, what is done to it, and what must come out."""

    mesh: fs.Mesh
    run: object  # the operation, on the mesh where it is placed
    new_group: str
    distance: object  # of points to the surface
    change: float  # of the volume
    change_size: float  # what its error is measured in
    exact: bool  # whether that error counts
    goal: float  # least quality
    at: object = None  # whether points are where material comes or goes


def body(mesh):
    return mesh.cells["tetra"]


def volume(mesh):
    return tetra_volumes(mesh.points, body(mesh)).sum()


def edge_length_near(mesh, distance):
    """The mean length of the edges whose ends are both nearer than some edges."""
    t = body(mesh)
    ends = np.concatenate([t[:, [i, j]] for i in range(4) for j in range(i)])
    length = np.linalg.norm(mesh.points[ends[:, 0]] - mesh.points[ends[:, 1]], axis=1)
    near = (distance(mesh.points)[ends] < 1e-6 * np.ptp(mesh.points)).all(axis=1)
    return length[near].mean()


def log_uniform(rng, low, high):
    return np.exp(rng.uniform(np.log(low), np.log(high)))


def straight(mesh, start, end, first, second, room, sign, rng):
    """A right-angled edge; the faces beside it go off along `first` and `second`, as far as `room`."""
    start, end, first, second = (np.asarray(x, float) for x in (start, end, first, second))
    length = np.linalg.norm(end - start)
    along = (end - start) / length

    def to_edge(points):
        return np.linalg.norm(points - start - np.outer((points - start) @ along, along), axis=1)

    edge = edge_length_near(mesh, to_edge)
    radius = log_uniform(rng, 0.5 * edge, min(6 * edge, 0.85 * room))
    centre = start + radius * (first + second)

    def off(points):
        way = points - centre
        return np.linalg.norm(way - np.outer(way @ along, along), axis=1) - radius

    change = sign * CORNER * radius**2 * length
    point = start + rng.uniform(0.2, 0.8) * (end - start)
    return Case(mesh, lambda m, at: fs.fillet(m, [at.point(point)], radius), "FILLET_FACE", off, change, abs(change),
                radius >= 2 * edge, 0.15, lambda x: to_edge(x) < 1e-6 * np.ptp(mesh.points))  # fmt: skip


def circular(mesh, z, rim, up, sign, room, rng):
    """A right-angled circular edge about z; the ball is inside it if it is convex, and above (`up` = 1) or below."""

    def to_edge(x):
        return np.hypot(np.hypot(x[:, 0], x[:, 1]) - rim, x[:, 2] - z)

    edge = edge_length_near(mesh, to_edge)
    radius = log_uniform(rng, 0.5 * edge, min(6 * edge, 0.85 * room))

    def off(x):
        return np.hypot(np.hypot(x[:, 0], x[:, 1]) - rim - sign * radius, x[:, 2] - z - up * radius) - radius

    change = sign * CORNER * radius**2 * 2 * np.pi * (rim + sign * CENTROID * radius)
    angle = rng.uniform(0, 2 * np.pi)
    place = (rim * np.cos(angle), rim * np.sin(angle), z)
    return Case(mesh, lambda m, at: fs.fillet(m, [at.point(place)], radius), "FILLET_FACE", off, change, abs(change),
                False, 0.15, lambda x: to_edge(x) < 1e-6 * np.ptp(mesh.points))  # fmt: skip


def box_edge(mesh, size, turn, rng):
    """Any of the twelve edges of a box from the origin."""
    axis = rng.integers(3)
    others = [k for k in range(3) if k != axis]
    start, ways = np.zeros(3), []
    for k in others:
        far = rng.integers(2)
        start[k] = far * size[k]
        ways.append(np.eye(3)[k] * (-1 if far else 1))
    end = start + np.eye(3)[axis] * size[axis]
    room = min(size[k] for k in others)
    return straight(mesh, turn @ start, turn @ end, turn @ ways[0], turn @ ways[1], room, -1, rng)


def concave_shape(rng, arms=(8, 13), lengths=(3, 7), corners=(3, 5)):
    """An L shape turned anyhow: the mesh, its elements' middles before, in edges, the corner, how many edges long.

    The ranges are of how many edges the arms are wide, the shape is long, and the corner is from their ends.
    """
    size, turn = rng.uniform(0.8, 1.25, 3), any_turn(rng)
    counts, corner = (rng.integers(*arms), rng.integers(*arms), rng.integers(*lengths)), rng.integers(*corners, 2)
    plain = l_shape(tuple(counts), tuple(float(c) for c in counts), tuple(float(c) for c in corner))
    mesh = fs.Mesh((plain.points * size) @ turn.T, plain.cells)
    start, end = np.array([*corner, 0]) * size, np.array([*corner, counts[2]]) * size
    room = min((counts[:2] - corner) * size[:2])
    edge = (turn @ start, turn @ end, turn[:, 0], turn[:, 1], room, 1)
    return mesh, plain.points[body(plain)].mean(axis=1).T, corner, counts[2], edge


def bordered(rng):
    if rng.integers(4) == 0:
        return bordered_convex(rng)
    mesh, (x, y, z), (a, b), length, edge = concave_shape(rng)
    across = rng.integers(1, length)
    part = np.zeros(len(x), int)
    kind = rng.integers(6)
    if kind == 0:  # a knee and two arms
        part = np.where(x > a, 1, 0) + np.where(y > b, 2, 0)
    elif kind == 1:  # a plate, and what stands on it
        part = np.where(y > b, 1, 0)
    elif kind == 2:
        part = np.where(x > a, 1, 0)
    elif kind == 3:  # and a border of the plate alone
        part = np.where(y > b, 1, np.where(z > across, 2, 0))
    elif kind == 4:  # for a part of the length
        part = np.where((x > a) & (z > across), 1, 0)
    else:  # a border across all
        part = np.where(y > b, 1, 0) + np.where(z > across, 2, 0)
    for k in np.unique(part):
        mesh.add_group(f"PART_{k}", "element", mesh.cell_ids["tetra"][part == k])
    return straight(mesh, *edge, rng)


def bordered_convex(rng):
    """A border through the edge, at times one across, too."""
    counts, turn = rng.integers(5, 10, 3), any_turn(rng)
    size = counts * rng.uniform(0.8, 1.25, 3)
    plain = grid_box(tuple(counts), tuple(size))
    mesh = fs.Mesh(plain.points @ turn.T, plain.cells)
    x, y, z = (plain.points / size * counts)[body(plain)].mean(axis=1).T
    part = np.where(y > z, 1, 0) + (np.where(x > counts[0] // 2, 2, 0) if rng.integers(2) else 0)
    for k in np.unique(part):
        mesh.add_group(f"PART_{k}", "element", mesh.cell_ids["tetra"][part == k])
    return straight(mesh, np.zeros(3), turn[:, 0] * size[0], turn[:, 1], turn[:, 2], min(size[1:]), -1, rng)


def ended(rng):
    """In a wall, at the edge below one, or at the end of what stands on a plate."""
    size, turn = rng.uniform(0.8, 1.25, 3), any_turn(rng)
    counts = np.array([rng.integers(8, 12), rng.integers(8, 12), rng.integers(8, 12)])
    a, b, c = corner = rng.integers(3, 5, 3)
    box = grid_box(tuple(counts), tuple(float(n) for n in counts))
    x, y, z = box.points[body(box)].mean(axis=1).T
    kind = rng.integers(3)
    room, sign = min((counts[:2] - corner[:2]) * size[:2]), 1
    start, end, first, second = np.array(corner), np.array([a, b, counts[2]]), turn[:, 0], turn[:, 1]
    if kind == 0:
        kept = (x < a) | (y < b) | (z < c)
    elif kind == 1:
        kept = (x < a) | ((y < b) & (z > c))
    else:
        kept = (x < a) | (z < c)
        start, end, first, second, sign = np.array([a, 0, c]), np.array([counts[0], 0, c]), turn[:, 1], -turn[:, 2], -1
        room = min(c * size[2], counts[1] * size[1])
    used, nodes = np.unique(body(box)[kept], return_inverse=True)
    mesh = fs.Mesh((box.points[used] * size) @ turn.T, {"tetra": nodes.reshape(-1, 4)})
    if rng.integers(2):
        middle = box.points[body(box)][kept].mean(axis=1)
        part = middle[:, 2] > c if kind < 2 else middle[:, 0] > a
        for k in (0, 1):
            mesh.add_group(f"PART_{k}", "element", mesh.cell_ids["tetra"][part == k])
    return straight(mesh, turn @ (start * size), turn @ (end * size), first, second, room, sign, rng)


def corner(rng):
    """Edges of a box that meet."""
    if rng.integers(3):
        counts, turn = rng.integers(4, 10, 3), any_turn(rng)
        size = counts * rng.uniform(0.8, 1.25, 3)
        plain = grid_box(tuple(counts), tuple(size))
        mesh = fs.Mesh(plain.points @ turn.T, plain.cells)
    else:
        mesh, size, turn = read("two_boxes", rng), np.array([20.0, 10.0, 10.0]), np.eye(3)
    ends = rng.integers(0, 2, 3)  # the corner
    every = [(axis, i, j) for axis in range(3) for i in (0, 1) for j in (0, 1)]
    at = [(axis, *np.delete(ends, axis)) for axis in range(3)]
    edges = [at[:2], at, [e for e in every if e[0] != 2 and e[2] == ends[2]], every][rng.integers(4)]
    edge = edge_length_near(mesh, lambda p: np.abs(p @ turn - ends * size)[:, :2].max(axis=1))
    radius = log_uniform(rng, 0.5 * edge, min(6 * edge, 0.42 * size.min()))

    def line(e):
        axis, *sides = e
        start = np.insert(np.array(sides, float), axis, 0) * size
        return start, start + np.eye(3)[axis] * size[axis]

    def off(points):
        local = points @ turn
        core = np.clip(local, radius, size - radius)
        if len(edges) == 3:  # that run out at their other ends
            core = np.where(ends, np.minimum(local, size - radius), np.maximum(local, radius))
        distances = [np.linalg.norm(local - core, axis=1) - radius]
        if len(edges) in (2, 4):
            distances = [np.linalg.norm(np.delete(local - core, e[0], axis=1), axis=1) - radius for e in edges]
        return np.abs(distances).min(axis=0)

    lengths = [size[e[0]] for e in edges]
    if len(edges) in (2, 4):
        corners = 1 if len(edges) == 2 else 4
        change = CORNER * radius**2 * sum(lengths) - corners * (5 / 3 - np.pi / 2) * radius**3
    else:
        corners = 1 if len(edges) == 3 else 8
        change = CORNER * radius**2 * (sum(lengths) - 3 * corners * radius) + corners * (1 - np.pi / 6) * radius**3
    points = [turn @ (0.5 * sum(line(e))) for e in edges]
    return Case(mesh, lambda m, at: fs.fillet(m, [at.point(p) for p in points], radius), "FILLET_FACE", off, -change,
                change, radius >= 2 * edge, 0.15)  # fmt: skip


def any_turn(rng):
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return turn * np.sign(np.linalg.det(turn))


def read(name, rng):
    """A test mesh; half of them without groups, as borders between groups of elements hold a concave edge."""
    mesh = fs.read(MESHES / f"{name}.inp")
    return mesh if rng.integers(2) else fs.Mesh(mesh.points, {"tetra": body(mesh)})


def convex(rng):
    kind = rng.integers(4)
    if kind == 0:
        return box_edge(read("two_boxes", rng), (20.0, 10.0, 10.0), np.eye(3), rng)
    if kind == 1:
        mesh = read("flanged_cylinder", rng)
        z, rim, up, room = [(16, 4, -1, 4), (0, 7, 1, 2), (2, 7, -1, 2)][rng.integers(3)]
        return circular(mesh, z, rim, up, -1, room, rng)
    if kind == 2:
        mesh = read("l_shape", rng)
        places = [((12, 0, 0), (12, 4, 0), (-1, 0, 0), (0, 0, 1)), ((12, 0, 4), (12, 4, 4), (-1, 0, 0), (0, 0, -1)),
                  ((4, 0, 12), (4, 4, 12), (-1, 0, 0), (0, 0, -1)), ((0, 0, 0), (0, 4, 0), (1, 0, 0), (0, 0, 1)),
                  ((12, 0, 0), (12, 0, 4), (-1, 0, 0), (0, 1, 0))]  # fmt: skip
        return straight(mesh, *places[rng.integers(len(places))], 4, -1, rng)
    counts = rng.integers(4, 11, 3)
    size, turn = counts * rng.uniform(0.8, 1.25, 3), any_turn(rng)
    plain = grid_box(tuple(counts), tuple(size))
    return box_edge(fs.Mesh(plain.points @ turn.T, plain.cells), size, turn, rng)


def concave(rng):
    kind = rng.integers(3)
    if kind == 0:
        mesh = read("flanged_cylinder", rng)
        return circular(mesh, 2, 4, 1, 1, 3, rng)
    if kind == 1:
        mesh = read("l_shape", rng)
        return straight(mesh, (4, 0, 4), (4, 4, 4), (1, 0, 0), (0, 0, 1), 8, 1, rng)
    mesh, _, _, _, edge = concave_shape(rng, (8, 15), (2, 6), (2, 5))
    return straight(mesh, *edge, rng)


def hole(rng):
    origin, axis, radius, factor = random_hole(rng)
    mesh = fs.drill(fs.read(MESHES / "two_boxes.inp"), fs.Cylinder(origin, axis, radius)).mesh
    tool = fs.Cylinder(origin, axis, radius * factor)
    slant = np.linalg.norm(axis) / abs(axis[2])
    whole = volume(fs.read(MESHES / "two_boxes.inp"))
    change = whole - np.pi * (radius * factor) ** 2 * 10 * slant - volume(mesh)
    size = np.pi * (radius * max(1, factor)) ** 2 * 10 * slant

    def run(m, at):
        onto = fs.Cylinder(at.point(origin), at.direction(axis), radius * factor)
        return fs.reshape(m, "HOLE_WALL", onto=onto)

    return Case(mesh, run, "SHAPE_WALL", tool.distance, change, size, False, min(0.2, worst(mesh)))


def wall(rng):
    """A plane face along its normal, outwards or inwards."""
    if rng.integers(3):
        name, file, area, at, out = [
            ("END_LEFT", "two_boxes", 100, (0, 0, 0), (-1, 0, 0)),
            ("END_RIGHT", "two_boxes", 100, (20, 0, 0), (1, 0, 0)),
            ("TOP", "two_boxes", 200, (0, 0, 10), (0, 0, 1)),
            ("LOAD", "l_shape", 16, (12, 0, 0), (1, 0, 0)),
            ("FIX", "l_shape", 16, (0, 0, 12), (0, 0, 1)),
            ("HEAD", "flanged_cylinder", None, (0, 0, 16), (0, 0, 1)),
        ][rng.integers(6)]
        mesh = fs.read(MESHES / f"{file}.inp")
        at, out = np.array(at, float), np.array(out, float)
    else:
        counts, turn = rng.integers(4, 9, 3), any_turn(rng)
        size = counts * rng.uniform(0.8, 1.25, 3)
        plain = grid_box(tuple(counts), tuple(size))
        mesh = fs.Mesh(plain.points @ turn.T, plain.cells)
        name, area, at, out = "FACE", size[1] * size[2], turn[:, 0] * size[0], turn[:, 0]
        mesh.add_group(name, "node", mesh.node_ids[plain.points[:, 0] == size[0]])
    if area is None:
        area = fs.reshape(mesh, name, by=out).report
        area = next(g.measure_before for g in area.groups if g.name == name)
    edge = edge_length_near(mesh, lambda x: np.abs((x - at) @ out))
    by = edge * rng.uniform(0.1, 3) * rng.choice([-1, 1])
    return Case(mesh, lambda m, to: fs.reshape(m, name, by=to.direction(by * out)), "SHAPE_WALL",
                lambda x: (x - at) @ out - by, by * area, abs(by * area), True, min(0.2, worst(mesh)))  # fmt: skip


KINDS = {f.__name__: f for f in (convex, concave, bordered, ended, corner, hole, wall)}


def points_of(mesh, name):
    group = mesh.groups[name]
    if group.kind == "node":
        return mesh.points[np.isin(mesh.node_ids, group.ids)]
    nodes = [c[np.isin(mesh.cell_ids[k], group.ids)].ravel() for k, c in mesh.cells.items()]
    return mesh.points[np.unique(np.concatenate(nodes))]


def change_elsewhere(before, after, report, at):
    """The largest relative change of the measure of a group none of whose nodes went or moved, or is `at` the edge."""
    kept = dict(zip(after.node_ids.tolist(), after.points.tolist()))
    same = np.array([kept.get(n) == p for n, p in zip(before.node_ids.tolist(), before.points.tolist())])
    if at:
        same &= ~at(before.points)
    numbers, most = before.node_ids[same], 0
    for g in report.groups:
        if g.kind != "element" or not g.measure_before or g.name not in before.groups:
            continue
        nodes = [c[np.isin(before.cell_ids[k], before.groups[g.name].ids)].ravel() for k, c in before.cells.items()]
        if np.isin(before.node_ids[np.concatenate(nodes)], numbers).all():
            most = max(most, abs(g.measure_after / g.measure_before - 1))
    return most


@dataclasses.dataclass
class Outcome:
    problem: str = ""
    refused: bool = False
    quality: float = 1
    good: bool = True
    off: float = 0
    volume: float = 0
    exact: bool = False
    elsewhere: float = 0
    seconds: float = 0


def anywhere(rounding, seed):
    if rounding == "as they are":
        return HERE
    rng = np.random.default_rng([seed, 1])
    return Placement(any_turn(rng), rng.uniform(-20, 20, 3), rounding)


def one(kind, seed, rounding="as they are"):
    case = KINDS[kind](np.random.default_rng(seed))
    place = anywhere(rounding, seed)
    mesh = place.of(case.mesh)
    started = time.time()
    try:
        result = case.run(mesh, place)
    except fs.Error as error:
        return Outcome(str(error), True, seconds=time.time() - started)
    out = Outcome(seconds=time.time() - started, exact=case.exact)
    after = result.mesh
    try:
        check_conforming(after)
    except AssertionError as error:
        out.problem = f"not sound: {error}"
        return out
    size = np.linalg.norm(np.ptp(case.mesh.points, axis=0))
    out.quality = worst(after)
    out.good = out.quality >= case.goal
    out.off = np.abs(case.distance(place.back(points_of(after, case.new_group)))).max() / size
    out.volume = abs(volume(after) - volume(case.mesh) - case.change) / case.change_size
    out.elsewhere = change_elsewhere(mesh, after, result.report, case.at and (lambda x: case.at(place.back(x))))
    if out.off > 1e-9 + 10 * place.off(case.mesh) / size:
        out.problem = f"nodes are {out.off:.1e} of the size off the surface"
    elif out.elsewhere > 1e-9:
        out.problem = f"a group elsewhere changed by {out.elsewhere:.1e}"
    return out


def main():
    arguments = case_arguments(__doc__, KINDS)
    arguments.add_argument("--poor", action="store_true")
    how = arguments.add_mutually_exclusive_group()
    how.add_argument("--digits", type=int, help="significant, that meshes are rounded to")
    how.add_argument("--single", action="store_true", help="meshes are rounded to single precision")
    given = arguments.parse_args()
    rounding = given.digits or ("single" if given.single else "as they are")
    print("kind     cases  refused  wrong  minimum    good      off   volume  (all)  elsewhere  seconds  slowest")
    for kind in [given.kind] if given.kind else KINDS:
        seeds = range(given.seed, given.seed + given.cases)
        all_of = {seed: one(kind, seed, rounding) for seed in seeds}
        made = [o for o in all_of.values() if not o.problem]
        counts = collections.Counter("refused" if o.refused else "wrong" for o in all_of.values() if o.problem)
        seconds = [o.seconds for o in all_of.values()]
        print(
            f"{kind:8} {given.cases:5}  {counts['refused']:7}  {counts['wrong']:5}"
            f"  {min((o.quality for o in made), default=0):7.3f}"
            f"  {np.mean([o.good for o in made]) if made else 0:6.1%}"
            f"  {max((o.off for o in made), default=0):7.1e}"
            f"  {max((o.volume for o in made if o.exact), default=0):7.2%}"
            f"  {max((o.volume for o in made), default=0):5.1%}"
            f"  {max((o.elsewhere for o in made), default=0):9.1e}  {sum(seconds):7.1f}  {max(seconds):7.1f}",
            flush=True,
        )
        for seed, o in all_of.items():
            if o.problem and (given.refused or not o.refused):
                print(f"  {seed}: {'refused' if o.refused else 'WRONG'}: {o.problem}")
            elif given.poor and not o.good:
                print(f"  {seed}: quality {o.quality:.3f}")


if __name__ == "__main__":
    main()
