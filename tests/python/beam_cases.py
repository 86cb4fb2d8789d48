# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random tools on beams alone, on plates with beams and on solids with beams, and how they come out.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/python/beam_cases.py --cases 300

Straight and bent beams of first and second order. A result is checked: no beam is left on both sides of the tool where
that is wanted, or inside what is removed; beams on the two sides of a crack have no node in common; the group of all
beams keeps its length, or loses exactly what is inside; new nodes between members of a node group are members; no node
is left without element. Printed: how many were refused, and the seeds that failed a check.
"""

import numpy as np

import femscalpel as fs
from campaign import Tally, case_arguments
from meshes import grid_box, quadratic
from mixed_meshes import grid

KINDS = ("frame", "plate", "solid")
#: A tool nearer to an end than this part of a beam passes through that end.
SHORTEST = 1e-3
SAMPLES = np.linspace(0, 1, 2001)


def lattice(rng, low, high):
    """Nodes of a lattice and its members: along the axes, and some braces."""
    counts = rng.integers(2, 4, 3)
    axes = [np.linspace(a, b, n) for a, b, n in zip(low, high, counts)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    index = np.arange(len(points)).reshape(counts)
    lines = [
        np.stack([index[:-1].ravel(), index[1:].ravel()], 1),
        np.stack([index[:, :-1].ravel(), index[:, 1:].ravel()], 1),
        np.stack([index[:, :, :-1].ravel(), index[:, :, 1:].ravel()], 1),
        np.stack([index[:-1, :-1].ravel(), index[1:, 1:].ravel()], 1),
    ]
    return points + rng.normal(scale=0.05, size=points.shape), np.concatenate(lines)


def carrier(kind, rng):
    """What the beams stand on."""
    if kind == "plate":
        points, quads = grid(rng.integers(5, 9, 2), 0.2)
        return points, {"quad": quads}
    if kind == "solid":
        box = grid_box((5, 5, 3), (5.0, 5.0, 3.0))
        if rng.integers(2):
            box = quadratic(box)
        return box.points, dict(box.cells)
    return np.zeros((0, 3)), {}


def make(kind, seed):
    """Mesh and random generator to go on with."""
    rng = np.random.default_rng(seed)
    points, cells = carrier(kind, rng)
    high = points[:, 2].max() if len(points) else 0.0
    frame, lines = lattice(rng, (0.5, 0.5, high + 1), (4.5, 4.5, high + 4))
    lines = lines + len(points)
    if len(points):
        corners = next(iter(cells.values()))[:, :4]
        tops = np.unique(corners[np.isin(corners, np.nonzero(points[:, 2] > high - 1e-9)[0])])
        feet = rng.choice(tops, 6, replace=False)
        feet = np.stack([feet, rng.integers(len(points), len(points) + len(frame), 6)], 1)
        inside = rng.choice(np.unique(corners), (6, 2))  # from node to node, through the material
        long = np.linalg.norm(points[inside[:, 0]] - points[inside[:, 1]], axis=1) > 2  # no edges of its elements
        lines = np.concatenate([lines, feet, inside[long]])
    points = np.concatenate([points, frame])
    lines = lines[np.linalg.norm(points[lines[:, 0]] - points[lines[:, 1]], axis=1) > 0.2]
    name = "line"
    if rng.integers(2):
        middles = (points[lines[:, 0]] + points[lines[:, 1]]) / 2
        middles += rng.normal(scale=0.1 * rng.integers(2), size=middles.shape)
        lines = np.concatenate([lines, len(points) + np.arange(len(lines))[:, None]], axis=1)
        points, name = np.concatenate([points, middles]), "line3"
    mesh = fs.Mesh(points, {**cells, name: lines})
    mesh.add_group("BEAMS", "element", mesh.cell_ids[name])
    few = rng.choice(len(lines), len(lines) // 2, replace=False)
    mesh.add_group("SOME", "element", mesh.cell_ids[name][few])
    mesh.add_group("NODES", "node", np.unique(mesh.node_ids[lines[few].ravel()]))
    mesh.add_group("EVERY NODE", "node", np.unique(mesh.node_ids[lines.ravel()]))
    return mesh, rng


def tool_for(mesh, rng):
    """What is done, the tool, and the crack's part of it."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    at, direction = low + (high - low) * rng.uniform(0.15, 0.85, 3), rng.normal(size=3)
    what = rng.integers(5)
    if what == 0:
        node = mesh.points[rng.integers(mesh.node_count)]
        return "crack", fs.Plane(node if rng.integers(2) else at, direction), None
    if what == 1:
        return "crack", fs.Plane(at, direction), fs.Disk(at, rng.uniform(1, 3))
    if what == 2:
        return "crack", fs.Sphere(at, rng.uniform(0.8, 2)), None
    if what == 3:
        return "drill", fs.Cylinder(at, direction, rng.uniform(0.4, 1.5)), None
    return "cut", fs.Plane(at, direction), None


def courses(mesh):
    """Points along each beam that is no edge of another element, by type and place."""
    out = {}
    edges = {
        tuple(sorted(e)) for k, c in mesh.cells.items() if k not in ("line", "line3", "vertex") for e in sides(k, c)
    }
    for name in ("line", "line3"):
        for k, n in enumerate(mesh.cells.get(name, ())):
            if tuple(sorted(n[:2])) in edges:
                continue
            a, b = mesh.points[n[0]], mesh.points[n[1]]
            bulge = mesh.points[n[2]] - (a + b) / 2 if len(n) == 3 else 0 * a
            t = SAMPLES[:, None]
            out[name, k] = (1 - t) * a + t * b + 4 * t * (1 - t) * bulge
    return out


def sides(kind, cells):
    """The edges of elements, by their corners."""
    corners = {"quad": 4, "triangle": 3, "triangle6": 3, "tetra": 4, "tetra10": 4, "pyramid": 5}.get(kind)
    pairs = {
        "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
    }.get(
        kind
    ) or [(a, b) for a in range(corners) for b in range(a)]
    return np.concatenate([cells[:, list(p)] for p in pairs]).tolist()


def depth_of(what, tool, width):
    """Signed distance to what is removed."""
    if what == "drill":
        return tool.distance
    return lambda x: np.abs(tool.distance(x)) - width / 2


def length_outside(mesh, depth):
    """Of all beams, outside what is removed."""
    total = 0.0
    for course in courses(mesh).values():
        d, steps = depth(course), np.linalg.norm(np.diff(course, axis=0), axis=1)
        a, b = d[:-1], d[1:]
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where((a > 0) & (b > 0), 1, np.where((a <= 0) & (b <= 0), 0, np.maximum(a, b) / np.abs(a - b)))
        total += (share * steps).sum()
    return total


def length_of(course):
    return np.linalg.norm(np.diff(course, axis=0), axis=1).sum()


def check_sides(what, tool, within, mesh, width):
    """Beams on both sides, or inside."""
    found = 0
    for course in courses(mesh).values():
        allowed = 3 * SHORTEST * length_of(course) + 1e-6
        if what == "crack":
            d = tool.distance(course)
            crosses = np.nonzero(d[:-1] * d[1:] <= 0)[0]
            inside = d.min() < -allowed and d.max() > allowed
            if inside and within is not None:
                inside = any(np.linalg.norm(course[k] - within.center) < within.radius - 0.01 for k in crosses)
            found += bool(inside)
        else:
            found += depth_of(what, tool, width)(course).min() < -allowed
    return [f"{found} beams reach through the tool"] if found else []


def check_parted(tool, within, mesh):
    """Beams of both sides of a crack in one node on it, unless other elements hold that together."""
    sides_at, others = {}, {}
    for (name, k), course in courses(mesh).items():
        d = tool.distance(course)
        side = np.sign(d[np.argmax(np.abs(d))])
        for n in mesh.cells[name][k][:2]:
            if abs(tool.distance(mesh.points[n][None])[0]) < 1e-9:
                sides_at.setdefault(n, set()).add(side)
    for kind, cells in mesh.cells.items():
        if kind in ("line", "line3", "vertex"):
            continue
        for n in np.unique(cells[np.isin(cells, list(sides_at))]):
            d = tool.distance(mesh.points[np.unique(cells[(cells == n).any(axis=1)])])
            others[n] = {s for s in (-1.0, 1.0) if (d * s > 1e-9).any()}
    found = 0
    for n, both in sides_at.items():
        if within is not None and np.linalg.norm(mesh.points[n] - within.center) > within.radius - 1e-6:
            continue
        held = others.get(n, set())
        found += len(held) < 2 and len(both | held) == 2
    return [f"beams of both sides meet in {found} nodes"] if found else []


def check(what, tool, within, mesh, result, width):
    """What does not hold."""
    after = result.mesh
    found = check_sides(what, tool, within, after, width)
    if what == "crack":
        found += check_parted(tool, within, after)
    groups = {g.name: g for g in result.report.groups}
    was, now = groups["BEAMS"].measure_before, groups["BEAMS"].measure_after
    right = was
    if what != "crack":
        edges = was - sum(length_of(c) for c in courses(mesh).values())
        right = length_outside(mesh, depth_of(what, tool, width)) + edges
        if abs(edges) > 1e-3:
            right = now  # some lie on edges of other elements, and what of these goes is theirs to tell
    bent = "line3" in mesh.cells  # whose lengths are sums over points
    tolerance = 1e-4 if bent or what != "crack" else 1e-9
    if abs(now - right) > tolerance * was + 3 * SHORTEST * (what != "crack"):
        found.append(f"length {was} -> {now}, not {right}")
    used = np.unique(np.concatenate([c.ravel() for c in after.cells.values()]))
    if len(used) < after.node_count:
        found.append(f"{after.node_count - len(used)} nodes without element")
    # Of first order, two nodes of a group at the ends of a beam may be none between them.
    for nodes, beams, kinds in (("NODES", "SOME", ("line3",)), ("EVERY NODE", "BEAMS", ("line", "line3"))):
        members = np.isin(after.node_ids, after.groups[nodes].ids)
        some = after.groups[beams].ids
        for name in kinds:
            numbers = after.cell_ids.get(name, np.zeros(0, int))
            for n in after.cells.get(name, np.zeros((0, 3), int))[np.isin(numbers, some)]:
                if not members[n].all():
                    found.append(f"a node of a beam of {beams} is not in {nodes}")
                    break
    return found


def run_case(kind, seed):
    """Operation, tool, its part, mesh, width of a slot, and what to call."""
    mesh, rng = make(kind, seed)
    what, tool, within = tool_for(mesh, rng)
    width = rng.uniform(0.3, 1.2)
    if what == "crack":
        return what, tool, within, mesh, width, lambda: fs.crack(mesh, tool, within=within)
    if what == "drill":
        return what, tool, within, mesh, width, lambda: fs.drill(mesh, tool)
    return what, tool, within, mesh, width, lambda: fs.cut(mesh, tool, width=width)


def run(kind, cases, first, list_refused):
    """Tries cases of a kind; whether nothing failed."""
    tally = Tally(kind, list_refused)
    cut = 0
    for seed in range(first, first + cases):
        what, tool, within, mesh, width, operate = run_case(kind, seed)
        result = tally.run(seed, operate)
        if result is None:
            continue
        cut += result.report.beams_cut
        if faults := check(what, tool, within, mesh, result, width):
            tally.failed[seed] = [what, *faults]
    print(f"{kind:>6}: {cases} cases, {sum(tally.refused.values())} refused {dict(tally.refused)}, {cut} beams cut")
    return tally.is_sound()


def main():
    arguments = case_arguments(__doc__, KINDS).parse_args()
    kinds = [arguments.kind] if arguments.kind else KINDS
    sound = [run(kind, arguments.cases, arguments.seed, arguments.refused) for kind in kinds]
    return 0 if all(sound) else 1


if __name__ == "__main__":
    raise SystemExit(main())
