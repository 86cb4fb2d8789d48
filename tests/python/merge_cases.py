# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random placements of what is joined to a mesh, and how they come out.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/python/merge_cases.py --cases 300

Each kind: stiffeners on a flat and on a curved shell; plates, blocks, rods and tubes on and into the two boxes, and
into the flanged cylinder; sleeves and parts of sleeves on a shaft; what overlaps and is flush with the mesh; shells of
quadrangles, blocks of hexahedra and prisms; all of these also in second order, with --quadratic. A result is checked:
one part, conforming, positive volumes, a seam without a gap. Printed: how many were refused, the smallest and usual
quality, how many are poor (below 0.12 and below the worse of the two inputs), the largest change of any group's
measure, and the seeds that failed a check; with --refused those that were refused, too.
"""

import collections
import pathlib
import time

import numpy as np

import femscalpel as fs
from campaign import case_arguments
from merge_parts import block, check_conforming, half_pipe, plate, rod, shell, triangles_of, tube
from meshes import quadratic
from mixed_meshes import EDGES, grid, prisms_of, second_order_of_all, worst_of

MESHES = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "tests" / "meshes"


def flat(rng):
    n = rng.integers(6, 20)
    floor = plate((0, 0, 0), (10, 0, 0), (0, 10, 0), (n, n), "FLOOR", rng.uniform(0, 0.3), rng.integers(1000))
    angle, tilt, length = rng.uniform(0, np.pi), rng.uniform(-0.6, 0.6), rng.uniform(2, 9)
    along = np.array([np.cos(angle), np.sin(angle), 0])
    up = np.array([-along[1] * np.sin(tilt), along[0] * np.sin(tilt), np.cos(tilt)]) * rng.uniform(1, 3)
    start = np.array([*rng.uniform(2, 8, 2), 0]) - along * length / 2 - up * rng.choice([0, 0, rng.uniform(0.2, 0.6)])
    counts = (rng.integers(2, 20), rng.integers(1, 5))
    return floor, plate(start, along * length, up, counts, "RIB", rng.uniform(0, 0.3), rng.integers(1000))


def curved(rng):
    pipe = half_pipe(5, 10, (rng.integers(12, 40), rng.integers(4, 14)), "PIPE")
    kind = rng.integers(3)
    if kind == 0:  # a ring on the outside
        k, first = rng.integers(8, 60), rng.uniform(0.1, 2)
        angle, radius = np.linspace(first, rng.uniform(first + 0.5, 3.1), k + 1), np.array([5, 5.5, 6.0])
        x = np.full((k + 1, 3), rng.uniform(1, 9))
        points = np.stack([x, np.outer(np.cos(angle), radius), np.outer(np.sin(angle), radius)], axis=-1)
        return pipe, shell(points.reshape(-1, 3), triangles_of(np.arange(x.size).reshape(x.shape)), "RIB")
    if kind == 1:  # a diaphragm
        corner, way = (rng.uniform(1, 5), -7, -1.1), (rng.uniform(-2, 4), 14, 0)
        counts = (rng.integers(8, 24), rng.integers(6, 14))
        return pipe, plate(corner, way, (0, 0, 8), counts, "RIB", rng.uniform(0, 0.3), rng.integers(1000))
    angle = rng.uniform(0.3, 2.8)
    out = np.array([0, np.cos(angle), np.sin(angle)])
    counts = (rng.integers(2, 16), rng.integers(1, 4))
    return pipe, plate(5 * out + [rng.uniform(0, 2), 0, 0], (rng.uniform(3, 8), 0, 0), out * 1.5, counts, "RIB")


def turned(axis, rng):
    """A frame whose third direction is `axis`."""
    axis = axis / np.linalg.norm(axis)
    side = np.cross(axis, rng.normal(size=3))
    side /= np.linalg.norm(side)
    return np.column_stack([side, np.cross(axis, side), axis])


def boss(origin, frame, edge, height, rng):
    """A block, a rod or a tube with elements of about `edge`."""
    size, layers = edge * rng.uniform(2.5, 5), max(1, round(height / edge))
    kind = rng.integers(3)
    if kind == 0:
        counts = (round(size / edge), max(1, round(0.7 * size / edge)), layers)
        return block(origin, (size, 0.7 * size, height), counts, "BOSS", frame)
    if kind == 1:
        return rod(origin, size / 2, height, (max(2, round(size / 2 / edge)), layers), "BOSS", frame)
    around = max(10, round(np.pi * size / edge))
    part = tube((0, 0, 0), size * 0.28, size / 2, height, (around, 1, layers), "BOSS")
    return fs.Mesh(part.points @ frame.T + origin, part.cells, groups={"BOSS": ("element", part.cell_ids["tetra"])})


def on_boxes(rng):
    mesh, edge = fs.read(MESHES / "two_boxes.inp"), rng.uniform(0.6, 1.1)
    origin = np.array([rng.uniform(2.5, 17.5), rng.uniform(2.5, 7.5), 10])
    return mesh, boss(origin, turned(np.array([0, 0, 1.0]), rng), edge, edge * rng.uniform(1.5, 4), rng)


def shell_on_boxes(rng):
    mesh, angle = fs.read(MESHES / "two_boxes.inp"), rng.uniform(0, np.pi)
    along = np.array([np.cos(angle), np.sin(angle), 0]) * rng.uniform(2, 4)
    tilt = np.cross(along, [0, 0, 1]) * rng.uniform(-0.2, 0.2)
    start = np.array([rng.uniform(5, 15), rng.uniform(4, 6), 10]) - along / 2
    start[2] -= rng.choice([0, rng.uniform(0.3, 1)])
    counts = (rng.integers(3, 8), rng.integers(2, 5))
    return mesh, plate(start, along, tilt + [0, 0, 3], counts, "BOSS", rng.uniform(0, 0.2), rng.integers(1000))


def into_boxes(rng):
    mesh, edge = fs.read(MESHES / "two_boxes.inp"), rng.uniform(0.6, 1.1)
    axis = np.array([*rng.uniform(-0.3, 0.3, 2), 1])
    axis /= np.linalg.norm(axis)
    deep = 2.5 * edge * np.linalg.norm(axis[:2]) + rng.uniform(0.5, 1.5)
    origin = np.array([rng.uniform(3, 17), rng.uniform(3, 7), 10]) - axis * deep
    return mesh, boss(origin, turned(axis, rng), edge, deep + edge * rng.uniform(1.5, 4), rng)


def into_cylinder(rng):
    mesh, edge = fs.read(MESHES / "flanged_cylinder.inp"), rng.uniform(0.5, 0.8)
    angle = rng.uniform(0, 2 * np.pi)
    axis = np.array([np.cos(angle), np.sin(angle), rng.uniform(-0.2, 0.2)])
    axis /= np.linalg.norm(axis)
    # The stem has a radius of 4.
    origin = np.array([0, 0, rng.uniform(5.5, 9)]) + axis * 2
    return mesh, boss(origin, turned(axis, rng), edge, 2 + edge * rng.uniform(2.5, 4), rng)


def on_shaft(rng):
    """A sleeve, or a part of one, whose facets are not those of the shaft; it may reach over the shaft's end."""
    edge, height = rng.uniform(0.2, 0.35), rng.uniform(0.8, 2)
    mesh = rod((0, 0, 0), 1, 4, (round(1 / edge), round(4 / edge)), "SHAFT")
    edge *= rng.uniform(0.6, 1.4)
    first, angle = rng.uniform(0, 2 * np.pi), rng.choice([2 * np.pi, rng.uniform(1, 5)])
    counts = (max(3, round(angle / edge)), rng.integers(1, 4), round(height / edge))
    bottom = rng.uniform(0.4, 3.6 - height) if rng.integers(3) else rng.uniform(4.4 - height, 3.6)
    return mesh, tube((0, 0, bottom), 1, 1 + edge * counts[1], height, counts, "BOSS", first, angle)


def flush(rng):
    """What overlaps the mesh and has some of its faces in the same planes, or on the same cylinder."""
    edge = rng.uniform(0.6, 1.1)
    if rng.integers(3) == 0:
        mesh, other = (rod((0, 0, 0), 2, 6, (round(2 / e), round(6 / e)), "SHAFT") for e in (0.7, edge))
        return mesh, fs.Mesh(other.points + [0, 0, rng.uniform(3, 5)], other.cells, groups={"BOSS": ("element", [1])})
    mesh, size = fs.read(MESHES / "two_boxes.inp"), rng.uniform(2, 4, 3)
    counts = np.maximum(2, np.round(size / edge)).astype(int)
    at = np.array([rng.uniform(1, 19 - size[0]), rng.uniform(1, 9 - size[1]), 10 - size[2] * rng.uniform(0.3, 0.7)])
    sides = [[0, 20 - size[0]], [0, 10 - size[1]]]
    for axis in ((0,), (1,), (0, 1))[rng.integers(3)]:
        at[axis] = rng.choice(sides[axis])
    return mesh, block(at + [size[0] / 2, size[1] / 2, 0], size, counts, "BOSS")


def of_quadrangles(mesh, rng):
    """A shell of triangles on a grid as quadrangles; of half of them, at times."""
    points, triangles = mesh.points, mesh.cells["triangle"]
    pairs = triangles.reshape(-1, 2, 3)
    quads = np.array([square_of(*pair) for pair in pairs])
    kept = np.arange(len(quads)) % 2 == 1 if rng.integers(3) == 0 else np.zeros(len(quads), bool)
    cells = {"quad": quads[~kept], "triangle": pairs[kept].reshape(-1, 3)}
    name = next(iter(mesh.groups))
    return fs.Mesh(points, cells, groups={name: ("element", np.arange(1, (~kept).sum() + 2 * kept.sum() + 1))})


def square_of(first, second):
    """The quadrangle of two triangles."""
    (alone,) = set(second) - set(first)
    k = next(k for k in range(3) if first[k] not in second)
    return [first[k], first[(k + 1) % 3], alone, first[(k + 2) % 3]]


def quadrangles(rng):
    mesh, part = (flat, curved)[rng.integers(2)](rng)
    return of_quadrangles(mesh, rng), part if rng.integers(2) else of_quadrangles(part, rng)


def bricks(origin, size, edge, name, rng, frame=np.eye(3)):
    """A block of hexahedra, of prisms, or of both."""
    counts = np.maximum(2, np.round(np.array(size) / edge).astype(int))
    points, hexahedra = grid(counts, 0.2)
    points = (points / points.max(axis=0) - [0.5, 0.5, 0]) * size @ frame.T + origin
    half, kind = counts[0] // 2 * counts[1] * counts[2], rng.integers(3)
    cells = {"hexahedron": hexahedra} if kind == 0 else {"wedge": prisms_of(hexahedra)}
    if kind == 2:
        cells = {"hexahedron": hexahedra[:half], "wedge": prisms_of(hexahedra[half:])}
    return fs.Mesh(points, cells, groups={name: ("element", np.arange(1, sum(map(len, cells.values())) + 1))})


def on_bricks(rng):
    """A block on a block, or into it."""
    mesh, edge = bricks((10, 5, 0), (20, 10, 10), rng.uniform(1.2, 2), "CORE", rng), rng.uniform(0.6, 1.3)
    deep = rng.choice([0, rng.uniform(0.5, 2)])
    origin = np.array([rng.uniform(4, 16), rng.uniform(4, 6), 10 - deep])
    size = edge * rng.uniform(2.5, 4, 3) + [0, 0, deep]
    frame = turned(np.array([0, 0, 1.0]), rng)
    if rng.integers(3) == 0:
        return mesh, boss(origin, frame, edge, size[2], rng)
    return mesh, bricks(origin, size, edge, "BOSS", rng, frame)


def shell_on_bricks(rng):
    mesh, part = shell_on_boxes(rng)
    mesh = bricks((10, 5, 0), (20, 10, 10), rng.uniform(1, 2), "CORE", rng)
    return mesh, of_quadrangles(part, rng) if rng.integers(2) else part


KINDS = {
    f.__name__: f
    for f in (flat, curved, shell_on_boxes, on_boxes, into_boxes, into_cylinder, on_shaft, flush)
    + (quadrangles, on_bricks, shell_on_bricks)
}


def in_one_line(mesh):
    """Whether more than two shells meet along as many edges as the seam has nodes, but for its ends."""
    cells = [
        (c, EDGES[name.rstrip("0123456789")]) for name, c in mesh.cells.items() if name.startswith(("tri", "quad"))
    ]
    edges = np.sort(np.concatenate([np.asarray(c)[:, list(e)] for c, all_of in cells for e in all_of]), axis=1)
    shared = (np.unique(edges, axis=0, return_counts=True)[1] > 2).sum()
    corners = mesh.node_ids[np.unique(edges)]
    return shared >= np.isin(mesh.groups["ADD_SEAM"].ids, corners).sum() - 2


def with_middles(mesh):
    """In second order; mid-side nodes of the pipe, whose radius is 5, are on it."""
    points, cells = second_order_of_all(mesh.points, mesh.cells)
    for kind, rows in cells.items() if "PIPE" in mesh.groups else ():
        ends = np.array(EDGES[kind.rstrip("0123456789")])
        middles = np.unique(np.array(rows)[:, len(ends) :])
        points[middles, 1:] *= 5 / np.linalg.norm(points[middles, 1:], axis=1)[:, None]
    groups = {name: (group.kind, group.ids) for name, group in mesh.groups.items()}
    return fs.Mesh(points, cells, groups=groups)


def one(kind, seed, second_order, **options):
    """(outcome, quality, the worse of the inputs' qualities, largest relative change of a group's measure)."""
    mesh, part = KINDS[kind](np.random.default_rng(seed))
    if second_order and "tetra" in mesh.cells:
        mesh = quadratic(fs.Mesh(mesh.points, {"tetra": mesh.cells["tetra"]}))
    elif second_order:
        mesh = with_middles(mesh)
    try:
        result = fs.merge(mesh, part, **options)
    except fs.Error as error:
        return str(error), None, None, None
    try:
        check_conforming(result.mesh)
        assert mesh.dimension == 3 or in_one_line(result.mesh), "the seam has a gap"
    except AssertionError as error:
        return f"WRONG: {error}", None, None, None
    change = [
        abs(g.measure_after / g.measure_before - 1)
        for g in result.report.groups
        if g.measure_before > 0 and g.name != "BOSS"
    ]
    return "", worst_of(result.mesh), min(worst_of(mesh), worst_of(part)), max(change, default=0)


def main():
    arguments = case_arguments(__doc__, KINDS)
    arguments.add_argument("--quadratic", action="store_true")
    given = arguments.parse_args()
    print("kind           cases  refused  wrong  minimum  poor  >= 0.25  measures  seconds")
    for kind in [given.kind] if given.kind else KINDS:
        started, outcomes, quality, changes = time.time(), collections.Counter(), [], []
        told, poor = [], 0
        for seed in range(given.seed, given.seed + given.cases):
            outcome, q, before, change = one(kind, seed, given.quadratic)
            what = "wrong" if outcome.startswith("WRONG") else "refused" if outcome else "made"
            outcomes[what] += 1
            if what == "made":
                quality.append(q)
                changes.append(change)
                poor += q < min(0.12, 0.999 * before)
            elif what == "wrong" or given.refused:
                told.append(f"  {seed}: {outcome}")
        good = np.mean(np.array(quality) >= 0.25) if quality else 0
        print(
            f"{kind:14} {given.cases:5}  {outcomes['refused']:7}  {outcomes['wrong']:5}  "
            f"{min(quality, default=0):7.3f}  "
            f"{poor:4}  {good:7.1%}  {max(changes, default=0):8.1e}  {time.time() - started:7.1f}"
        )
        print("\n".join(told), end="\n" if told else "")


if __name__ == "__main__":
    main()
