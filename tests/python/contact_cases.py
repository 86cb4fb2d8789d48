# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random tools over two bodies that touch with double nodes, and how the pairs come out.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/python/contact_cases.py --cases 300

Each kind: planes and spheres that crack, cylinders that drill, slots, refinement, a crack through a crack or a slot; on
tetrahedra with a flat or a curved contact in first or second order, turned in space, partly glued, three bodies,
hexahedra, the lips of an earlier crack, two shells on each other, plates side by side. A result is checked: nodes and
faces on the contact are on both sides at the same places, volumes are positive, each body has its measure where nothing
is removed, the bodies are joined where they were and nowhere else and inside them nothing is open but the lips, the
groups of both sides count their members. Printed: how many were refused, in how many
pairs came apart with a warning, the smallest quality and how many are below
0.1 and below the mesh before, seconds, and what failed.
"""

import collections
import itertools

import numpy as np

import femscalpel as fs
from campaign import Tally, case_arguments
from meshes import quadratic
from mixed_meshes import EDGES, FACES, grid, worst_of

TETRA_OF_CUBE = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
HEIGHT = 4
BODIES = ("LOW", "UP", "RIGHT")  # of which the last is there in some kinds only
#: For the kind "turned": what a body along the axes becomes.
TURN = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
MADE = ("T_", "U_")  # how the groups that operations make begin


def curved(points):
    """The plane z = HEIGHT becomes a surface of two curvatures."""
    out = points.copy()
    bump = 0.5 * np.sin(points[:, 0] / 2.5) * np.cos(points[:, 1] / 3)
    out[:, 2] += bump * np.minimum(points[:, 2], 2 * HEIGHT - points[:, 2]).clip(0) / HEIGHT
    return out


def apart(points, cells, upper, shared):
    """Gives the cells `upper` nodes of their own where they touch the others, except the nodes `shared`."""
    own = np.unique(cells[~upper])
    double = np.setdiff1d(np.intersect1d(own, cells[upper]), shared)
    now = np.arange(len(points))
    now[double] = len(points) + np.arange(len(double))
    cells = cells.copy()
    cells[upper] = now[cells[upper]]
    return np.vstack([points, points[double]]), cells


def bodies(kind, rng):
    """Mesh with the groups LOW, UP (elements), CON_A, CON_B (nodes), SURF_A, SURF_B (element faces)."""
    points, cubes = grid((6, 5, 2 * HEIGHT), 0)
    inner = np.all((points > 0) & (points < (6, 5, 2 * HEIGHT)), axis=1)
    points[inner & (points[:, 2] != HEIGHT)] += rng.uniform(-0.2, 0.2, (np.sum(inner & (points[:, 2] != HEIGHT)), 3))
    flat = inner & (points[:, 2] == HEIGHT)
    points[flat, :2] += rng.uniform(-0.2, 0.2, (flat.sum(), 2))
    middles = points[cubes].mean(axis=1)
    cells, name = cubes, "hexahedron"
    if kind != "hexahedra":
        cells, name = cubes[:, TETRA_OF_CUBE].reshape(-1, 4), "tetra"
        middles = np.repeat(middles, 6, axis=0)
    upper = middles[:, 2] > HEIGHT
    shared = np.nonzero(points[:, 0] < 3)[0] if kind == "glued" else []
    if kind.startswith("curved"):
        points = curved(points)
    right = upper & (middles[:, 0] > 3) if kind == "three" else np.zeros(len(upper), bool)
    points, cells = apart(points, cells, upper, shared)
    if kind == "three":
        points, cells = apart(points, cells, right, [])
    if kind == "turned":
        points = points @ TURN
    mesh = fs.Mesh(points, {name: cells})
    if kind.endswith("second"):
        mesh = quadratic(mesh)
    ((name, _),) = mesh.cells.items()
    for group, chosen in zip(BODIES, (~upper, upper & ~right, right)):
        if chosen.any():
            mesh.add_group(group, "element", mesh.cell_ids[name][chosen])
    return mesh


def shells(kind, rng):
    points, squares = grid((10, 8), 0.2)
    cells = np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])
    if kind == "layers":
        cells = np.concatenate([cells, cells + len(points)])
        points = np.vstack([points, points])
        upper = np.arange(len(cells)) >= len(cells) // 2
    else:
        flat = np.abs(points[:, 0] - 5) < 0.5
        points[flat, 0] = 5
        upper = points[cells].mean(axis=1)[:, 0] > 5
        points, cells = apart(points, cells, upper, [])
    mesh = fs.Mesh(points, {"triangle": cells})
    for group, chosen in (("LOW", ~upper), ("UP", upper)):
        mesh.add_group(group, "element", mesh.cell_ids["triangle"][chosen])
    return mesh


def members(mesh, group):
    """Node indices of an element group."""
    ids = mesh.groups[group, "element"].ids
    return np.unique(np.concatenate([c[np.isin(mesh.cell_ids[k], ids)].ravel() for k, c in mesh.cells.items()]))


def skin(mesh, group):
    """Outer faces of a body as sets of places."""
    ids, count = mesh.groups[group, "element"].ids, collections.Counter()
    for kind, cells in mesh.cells.items():
        for face in FACES.get(kind.rstrip("0123456789"), ()):
            for row in cells[np.isin(mesh.cell_ids[kind], ids)][:, face]:
                count[tuple(sorted(row))] += 1
    return {frozenset(map(tuple, mesh.points[list(f)])) for f, n in count.items() if n == 1}


def add_contact(mesh):
    """CON_A, CON_B: nodes of the pairs on either side; SURF_A, SURF_B: their faces, of solids."""
    low, high = members(mesh, "LOW"), members(mesh, "UP")
    places = {}
    for n in np.setdiff1d(high, low):
        places[tuple(mesh.points[n])] = n
    pairs = [(n, places[tuple(mesh.points[n])]) for n in np.setdiff1d(low, high) if tuple(mesh.points[n]) in places]
    for name, side in zip(("CON_A", "CON_B"), zip(*pairs)):
        mesh.add_group(name, "node", mesh.node_ids[list(side)])
    return {tuple(mesh.points[a]) for a, _ in pairs}


def make(kind, seed):
    """Mesh, the operation as a function of the mesh, whether it removes."""
    rng = np.random.default_rng(seed)
    mesh = shells(kind, rng) if kind in ("layers", "plates") else bodies(kind, rng)
    if kind == "lips":
        middle = fs.Mesh(mesh.points, mesh.cells)
        merged = fs.crack(
            glued(middle), fs.Plane((3, 2.5, HEIGHT), (0, 0, 1)), within=fs.Disk((3, 2.5, HEIGHT), 1.8), name="OLD"
        ).mesh
        mesh = sided(merged)
    add_contact(mesh)
    plane = kind in ("layers", "plates")
    at = np.array((10, 8, 0) if plane else (6, 5, 0)) * rng.uniform(0.2, 0.8, 3)
    if not plane:
        at[2] = HEIGHT + rng.uniform(-1.2, 1.2)
    direction, other = rng.normal(size=(2, 3)) * (1, 1, 0.2 if plane else 1)
    if kind == "turned":
        at, direction, other = at @ TURN, direction @ TURN, other @ TURN
    what = rng.integers(7)
    if what >= 5:
        first, second = fs.Plane(at, direction), fs.Plane(at + rng.uniform(-0.3, 0.3, 3), other)
        if what == 5:
            return mesh, lambda m: fs.crack(fs.crack(m, first, name="T").mesh, second, name="U"), False
        return mesh, lambda m: fs.crack(fs.cut(m, first, width=0.3, name="T").mesh, second, name="U"), True
    if what == 0:
        return mesh, lambda m: fs.crack(m, fs.Plane(at, direction), name="T"), False
    if what == 1:
        return mesh, lambda m: fs.crack(m, fs.Sphere(at, rng.uniform(1.5, 2.5)), name="T"), False
    if what == 2:
        axis = (0.1, 0.2, 1) if plane else direction
        radius = rng.uniform(0.8, 1.6)
        return mesh, lambda m: fs.drill(m, fs.Cylinder(at, axis, radius), name="T"), True
    if what == 3:
        return mesh, lambda m: fs.cut(m, fs.Plane(at, direction), width=0.4, name="T"), True
    return mesh, lambda m: fs.refine(m, fs.Plane(at, direction), 0.5), False


def glued(mesh):
    """One body: nodes at one place made one."""
    _, first, inverse = np.unique(mesh.points, axis=0, return_index=True, return_inverse=True)
    return fs.Mesh(mesh.points[first], {k: inverse.reshape(-1)[c] for k, c in mesh.cells.items()})


def sided(mesh):
    """LOW and UP by the middle of elements."""
    for group, sign in (("LOW", -1), ("UP", 1)):
        ids = [
            mesh.cell_ids[k][sign * (mesh.points[c].mean(axis=1)[:, 2] - HEIGHT) > 0]
            for k, c in mesh.cells.items()
            if k.startswith("tetra")
        ]
        mesh.add_group(group, "element", np.concatenate(ids))
    return mesh


def check(kind, mesh, result, removes):
    """What does not hold."""
    found, after = [], result.mesh
    if min(v.min() for k, v in fs.measure(after).items() if len(v) and k != "vertex") <= 0:
        found.append("an element without volume")
    # By place: where a crack ends at the contact, one side may be doubled alone.
    places = [
        set(map(tuple, after.points[np.isin(after.node_ids, after.groups[g, "node"].ids)])) for g in ("CON_A", "CON_B")
    ]
    at_contact = places[0] | places[1]
    made = set(map(tuple, after.points[np.isin(after.node_ids, wall(after))]))
    if removes:  # of an element above and one below, one may have gone
        places = [side - made for side in places]
    parted = any("no longer match" in w for w in result.report.warnings)
    if places[0] != places[1] and not parted:
        found.append(f"pairs: {len(places[0] - places[1])} / {len(places[1] - places[0])} alone")
    found += check_sides(mesh, after)
    if kind not in ("layers", "plates", "lips", "glued") and not parted:
        middle = [{f for f in skin(after, g)} for g in ("LOW", "UP")]
        on = [{f for f in side if all(p in at_contact for p in f)} for side in middle]
        # A wall may have all its corners there, too, but is on one side alone.
        odd = [f for f in on[0] ^ on[1] if is_on_contact(kind, f) and not f <= made]
        if odd:
            found.append(f"{len(odd)} faces on one side alone")
    groups = {(g.name, g.kind): g for g in result.report.groups}
    bodies = np.array(
        [
            (g.measure_before, g.measure_after)
            for g in (groups[n, "element"] for n in BODIES if (n, "element") in groups)
        ]
    )
    if kind in ("lips", "three"):  # the border beyond them, that of the third, is not plane
        bodies = bodies.sum(axis=0, keepdims=True)
    if not removes and not kind.startswith("curved") and np.ptp(bodies, axis=1).max() > 1e-9 * bodies.max():
        found.append(f"measures {bodies.tolist()}")
    for name in ("CON_A", "CON_B"):
        g = groups[name, "node"]
        if g.count_after != len(after.groups[name, "node"].ids):
            found.append(f"{name} counts {g.count_after}")
    return found


def sides_of(mesh):
    """Faces of solids, or edges of shells where there are none, by their corners: the elements that have them as
    (body, number)."""
    found, groups = collections.defaultdict(list), [g for g in BODIES if (g, "element") in mesh.groups]
    solid = any(k.rstrip("0123456789") in FACES for k in mesh.cells)
    for kind, cells in mesh.cells.items():
        for side in (FACES if solid else {"triangle": EDGES["triangle"]}).get(kind.rstrip("0123456789"), ()):
            body = [np.isin(mesh.cell_ids[kind], mesh.groups[g, "element"].ids) for g in groups]
            for nodes, b, number in zip(np.sort(cells[:, side], axis=1), np.argmax(body, axis=0), mesh.cell_ids[kind]):
                found[tuple(nodes)].append((int(b), number))
    return found


def common_sides(mesh, sides, joined):
    """Faces (edges), as corners in space, that both bodies have, or that are there once for each, at one place."""
    if joined:
        return [mesh.points[list(f)] for f, owners in sides.items() if len({b for b, _ in owners}) > 1]
    at = collections.defaultdict(dict)
    for f, owners in sides.items():
        if len(owners) == 1:
            at[frozenset(map(tuple, mesh.points[list(f)]))][owners[0][0]] = f
    return [mesh.points[list(f)] for there in at.values() if len(there) > 1 for f in [next(iter(there.values()))]]


def is_in(points, sides):
    """Whether points (n, 3) lie on one of these triangles or edges (m, 3 or 2, 3)."""
    out = np.zeros(len(points), bool)
    for corners in sides:
        edges = (corners[1:] - corners[0]).T
        shares = np.linalg.lstsq(edges, (points - corners[0]).T, rcond=None)[0]
        off = np.abs((points - corners[0]).T - edges @ shares).max(axis=0)
        out |= (off < 1e-6) & (shares.min(axis=0) > -1e-6) & (shares.sum(axis=0) < 1 + 1e-6)
    return out


def check_sides(mesh, after):
    """Bodies are joined where they were and nowhere else, and nothing is open inside them but lips."""
    found, before, sides = [], sides_of(mesh), sides_of(after)
    glued, touching = common_sides(mesh, before, True), common_sides(mesh, before, False)
    joined = [f.mean(axis=0) for f in common_sides(after, sides, True)]
    if joined and (odd := np.count_nonzero(is_in(np.array(joined), touching)) if glued else len(joined)):
        found.append(f"{odd} faces join the bodies")
    of_bodies = [members(after, g) for g in BODIES if (g, "element") in after.groups]
    common = np.unique(np.concatenate([np.intersect1d(a, b) for a, b in itertools.combinations(of_bodies, 2)]))
    x = after.points[common]
    if len(x) and (odd := np.count_nonzero(is_in(x, touching) & ~is_in(x, glued)) if glued else len(x)):
        found.append(f"{odd} nodes join the bodies")
    lips = set()
    for g in after.groups.all():
        if g.kind == "element" and g.name.startswith(MADE):
            for kind, cells in after.cells.items():
                if count := {"triangle": 3, "line": 2}.get(kind.rstrip("0123456789")):
                    chosen = cells[np.isin(after.cell_ids[kind], g.ids), :count]
                    lips |= {tuple(sorted(c)) for c in chosen.tolist()}
    at = collections.defaultdict(list)
    for f, owners in sides.items():
        if len(owners) == 1 and f not in lips:
            at[frozenset(map(tuple, after.points[list(f)]))].append(owners[0][0])
    between = [np.mean(list(f), axis=0) for f, bodies in at.items() if len(set(bodies)) > 1]
    torn = sum(len(set(bodies)) < len(bodies) for bodies in at.values())
    if between and glued:
        torn += np.count_nonzero(~is_in(np.array(between), touching))
    if torn:
        found.append(f"{torn} faces came apart")
    return found


def wall(mesh):
    """Numbers of the nodes on what a tool made."""
    found = [mesh.node_ids[:0]]
    for g in mesh.groups.all():
        if g.name.startswith(MADE):
            found.append(g.ids if g.kind == "node" else mesh.node_ids[members(mesh, g.name)])
    return np.concatenate(found)


def is_on_contact(kind, face):
    if kind == "turned":
        return all(abs((TURN @ p)[2] - HEIGHT) < 1e-9 for p in face)
    middle = np.mean(list(face), axis=0)
    if kind.startswith("curved"):
        return abs(middle[2] - HEIGHT - 0.5 * np.sin(middle[0] / 2.5) * np.cos(middle[1] / 3)) < 0.05
    return all(abs(p[2] - HEIGHT) < 1e-9 for p in face)


def run(kind, cases, first, list_refused):
    tally, least, poor, parted = Tally(kind, list_refused), 1.0, 0, 0
    for seed in range(first, first + cases):
        mesh, operate, removes = make(kind, seed)
        result = tally.run(seed, lambda: operate(mesh))
        if result is None:
            continue
        if any("no longer match" in w for w in result.report.warnings):
            parted += 1
            tally.tell(seed, "pairs came apart")
        if wrong := check(kind, mesh, result, removes):
            tally.failed[seed] = wrong
        quality = worst_of(result.mesh)
        least = min(least, quality)
        if quality < min(0.1, worst_of(mesh)):
            poor += 1
            tally.tell(seed, f"quality {quality:.3f}")
    print(
        f"{kind:<14} {cases} cases, refused {dict(tally.refused)}, pairs apart {parted}, least quality {least:.3f}, "
        f"poor {poor}, "
        f"{tally.mean_seconds:.3f} s each"
    )
    return tally.is_sound()


KINDS = (
    "flat",
    "flat second",
    "curved",
    "curved second",
    "turned",
    "glued",
    "three",
    "lips",
    "hexahedra",
    "layers",
    "plates",
)


def main():
    given = case_arguments(__doc__, KINDS).parse_args()
    kinds = [given.kind] if given.kind else KINDS
    return 0 if all([run(k, given.cases, given.seed, given.refused) for k in kinds]) else 1


if __name__ == "__main__":
    raise SystemExit(main())
