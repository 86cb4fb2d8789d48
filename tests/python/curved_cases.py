# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random planes, holes, slots and disks in curved second-order meshes of 5 000 to 100 000 elements, beside the same in
the same meshes by their corners: processor time, quality, what is refused.

    PYTHONPATH=build/release/Mod/FemScalpel /usr/bin/python3 tests/python/curved_cases.py --cases 20

makes the meshes (by Gmsh, once, into build/release/tests/meshes/curved) and prints for every mesh, every kind of
operation and all: the processor time of all operations in the second-order mesh and in its linear twin, their ratio;
the slowest over the median of its mesh; of what does not graze anything the least mean ratio, and how often it is at
least 0.3 (or what the mesh had there before); how many were refused, and why. Grazing: somewhere the tool, or the rim
of a crack, runs at under 5 degrees along the skin, a border of groups or a feature line, within 0.15 edge lengths of
it. Every case is made from its mesh and number alone. --slow lists the slowest. A bolt whose grooves are too fine for
its mesh is asked for by --mesh "bolt, coarse"; it counts for itself.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass

import femscalpel as fs
import numpy as np
import rounding_cases as rounding

GEOMETRY = pathlib.Path(__file__).resolve().parents[1] / "meshes"
FOLDER = rounding.MESHES / "curved"

#: Name -> geometry, and size of elements.
PARTS = {
    "elbow": ("quadratic_elbow", 0.8),
    "elbow, fine": ("quadratic_elbow", 0.33),
    "bracket": ("bracket", 1.1),
    "bracket, fine": ("bracket", 0.6),
    "flanged cylinder": ("flanged_cylinder", 1.0),
    "flanged cylinder, fine": ("flanged_cylinder", 0.5),
    "ball": ("ball", 0.8),
    "ball, fine": ("ball", 0.45),
    "fins": ("fins", 1.0),
    "fins, fine": ("fins", 0.55),
    "bolt": ("grooved_bolt", 0.5),
    "bolt, coarse": ("grooved_bolt", 0.8),
}
#: Only when asked for: fewer elements, and so strongly curved that half of what is done there has no good result.
APART = ("bolt, coarse",)
KINDS = ("plane", "hole", "slot", "disk")
#: What says that a tool has nothing to do with the mesh.
MISSES = ("misses the mesh", "outside the part", "grazes the mesh", "removes nothing", "would remove the whole")
NARROW, NEAR = np.sin(np.radians(5)), 0.15
GOOD, LEAST = 0.3, 0.2

TETRA_EDGES = rounding.MIDDLES["tetra10"]
TETRA_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))


# ------------------------------------------------------------------------------------------------------------ meshes


def make(name):
    """Reads a second-order mesh, made first where it is not there."""
    geometry, size = PARTS[name]
    path = FOLDER / f"{geometry}_{size}.inp"
    source = GEOMETRY / f"{geometry}.geo"
    if not path.exists() or path.stat().st_mtime < source.stat().st_mtime:
        FOLDER.mkdir(parents=True, exist_ok=True)
        numbers = [] if size is None else ["-setnumber", "size", str(size)]
        made = path.with_suffix(".making")
        subprocess.run(
            [
                "gmsh",
                "-3",
                "-order",
                "2",
                "-nt",
                "1",
                "-v",
                "1",
                str(source),
                *numbers,
                "-format",
                "inp",
                "-o",
                str(made),
            ],
            check=True,
        )
        made.rename(path)
    return fs.read(path)


def by_corners(mesh):
    """The linear mesh with the same corners, numbers and groups."""
    cells = {rounding.FIRST_ORDER.get(t, t): c[:, : rounding.CORNERS[t]] for t, c in mesh.cells.items()}
    used = np.unique(np.concatenate([c.ravel() for c in cells.values()]))
    row = np.full(mesh.node_count, -1)
    row[used] = np.arange(len(used))
    kept = mesh.node_ids[used]
    groups = [(g.name, g.kind, np.intersect1d(g.ids, kept) if g.kind == "node" else g.ids) for g in mesh.groups.all()]
    ids = {rounding.FIRST_ORDER.get(t, t): i for t, i in mesh.cell_ids.items()}
    return fs.Mesh(mesh.points[used], {t: row[c] for t, c in cells.items()}, kept, ids, groups)


class Part(rounding.Subject):
    """A second-order mesh, its linear twin, and what tools can graze."""

    flat, slack = False, np.inf

    def __init__(self, name):
        super().__init__(make(name))
        self.twin = fs.Scalpel(by_corners(self.mesh))
        self.length = self.edge[self.corners].mean()
        self.folded = fs.scaled_jacobian(self.mesh)["tetra10"].min() <= 0
        self._find_surfaces()

    def _find_surfaces(self):
        """Places on the skin and on borders of groups, with normals, and on sharp lines, with directions."""
        mesh, cells = self.mesh, self.mesh.cells["tetra10"]
        family = np.zeros(len(cells), int)
        for k, g in enumerate(mesh.groups.all("element")):
            family[np.isin(mesh.cell_ids["tetra10"], g.ids)] += 1 << k
        middle = {e: 4 + k for k, e in enumerate(TETRA_EDGES)}
        of = lambda f: [*f, *(middle[min(f[k], f[(k + 1) % 3]), max(f[k], f[(k + 1) % 3])] for k in range(3))]
        faces = np.concatenate([cells[:, of(f)] for f in TETRA_FACES])
        owner = np.tile(family, 4)
        _, inverse, count = np.unique(np.sort(faces[:, :3], axis=1), axis=0, return_inverse=True, return_counts=True)
        inverse = inverse.ravel()
        order = np.argsort(inverse, kind="stable")
        first = order[np.searchsorted(inverse[order], np.arange(len(count)))]
        last = order[np.searchsorted(inverse[order], np.arange(len(count)), side="right") - 1]
        kept = (count == 1) | (owner[first] != owner[last])
        faces = faces[first[kept]]
        p = mesh.points[faces]
        self.places, self.normals, self.reach = [], [], []
        steps = np.linspace(0, 1, 5)
        size = np.linalg.norm(p[:, [1, 2, 0]] - p[:, [0, 1, 2]], axis=2).mean(1)
        for a in steps:
            for b in steps[steps <= 1 - a + 1e-9]:
                c = 1 - a - b
                shape = np.array([a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a])
                du = np.array([4 * a - 1, 0, 1 - 4 * c, 4 * b, -4 * b, 4 * (c - a)])
                dv = np.array([0, 4 * b - 1, 1 - 4 * c, 4 * a, 4 * (c - b), -4 * a])
                normal = np.cross(np.einsum("k,nkx->nx", du, p), np.einsum("k,nkx->nx", dv, p))
                self.places.append(np.einsum("k,nkx->nx", shape, p))
                self.normals.append(normal / np.linalg.norm(normal, axis=1)[:, None])
                self.reach.append(NEAR * size)
        self.places, self.normals, self.reach = map(np.concatenate, (self.places, self.normals, self.reach))
        # Sharp lines: edges of these faces that are not shared by two that go on smoothly.
        flat = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        flat /= np.linalg.norm(flat, axis=1)[:, None]
        edges = np.sort(np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        face = np.tile(np.arange(len(faces)), 3)
        unique, inverse, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
        order = np.argsort(inverse.ravel(), kind="stable")
        start = np.searchsorted(inverse.ravel()[order], np.arange(len(unique)))
        one, two = face[order[start]], face[order[np.minimum(start + 1, len(order) - 1)]]
        bent = np.linalg.norm(np.cross(flat[one], flat[two]), axis=1) >= np.sin(np.radians(20))
        ends = mesh.points[unique[(count != 2) | bent]]
        along = ends[:, 1] - ends[:, 0]
        length = np.linalg.norm(along, axis=1)
        self.line_places = np.concatenate([ends[:, 0] + t * along for t in steps])
        self.line_ways = np.tile(along / length[:, None], (len(steps), 1))
        self.line_reach = np.tile(NEAR * length, len(steps))

    def is_grazed(self, distance, radius):
        """By a surface, whose smallest radius is `radius`: refined elements are half that long."""

        def gradient(x):
            h = 1e-6 * self.size
            return np.stack([(distance(x + h * e) - distance(x - h * e)) / (2 * h) for e in np.eye(3)], axis=1)

        near = np.abs(distance(self.places)) < np.minimum(self.reach, NEAR * radius / 2)
        turned = np.cross(gradient(self.places[near]), self.normals[near])
        if (np.linalg.norm(turned, axis=1) < NARROW).any():
            return True
        near = np.abs(distance(self.line_places)) < np.minimum(self.line_reach, NEAR * radius / 2)
        return bool((np.abs((gradient(self.line_places[near]) * self.line_ways[near]).sum(1)) < NARROW).any())

    def is_grazed_by_curve(self, points, radius):
        """By the rim of a crack, or the line in which walls meet."""
        ways = np.diff(points, axis=0)
        ways /= np.linalg.norm(ways, axis=1)[:, None]
        around = ((self.places > points.min(0) - self.length) & (self.places < points.max(0) + self.length)).all(1)
        places, normals = self.places[around], self.normals[around]
        reach = np.minimum(self.reach[around], NEAR * radius / 2)
        for x, way in zip((points[1:] + points[:-1]) / 2, ways):
            close = (np.abs(places - x) < self.length).all(1)
            off = np.abs(((x - places[close]) * normals[close]).sum(1))
            near = off < reach[close]
            if (np.abs(normals[close][near] @ way) < NARROW).any():
                return True
        return False


# ------------------------------------------------------------------------------------------------------------- cases


@dataclass
class Case(rounding.Case):
    kind: str = ""
    grazes: bool = False

    def __str__(self):
        given = "".join(f", {k}={v!r}" for k, v in self.options.items())
        return f"{self.kind} {self.number} in {self.subject}: {self.operation} {self.tool!r}{given}"


_parts = {}


def part(name):
    if name not in _parts:
        _parts[name] = Part(name)
    return _parts[name]


def case(name, kind, number):
    """The case of a number."""
    rng = np.random.default_rng([18, list(PARTS).index(name), KINDS.index(kind), number])
    s = part(name)
    cell = s.cells[rng.integers(len(s.cells))]
    origin = rng.dirichlet(np.ones(4)) @ s.mesh.points[cell]
    normal = rng.normal(size=3)
    if rng.random() < 0.3:
        normal = np.eye(3)[rng.integers(3)]
    normal /= np.linalg.norm(normal)
    size = s.length * np.exp(rng.uniform(np.log(0.7), np.log(4)))
    out = lambda operation, tool, grazes, **options: Case(
        number, name, "as they are", kind, 0, operation, tool, options, kind, bool(grazes)
    )
    if kind == "hole":
        tool = fs.Cylinder(origin, normal, size)
        return out("drill", tool, s.is_grazed(tool.distance, size))
    tool = fs.Plane(origin, normal)
    if kind == "plane":
        return out("crack", tool, s.is_grazed(tool.distance, np.inf))
    if kind == "slot":
        walls = [lambda x, side=side: tool.distance(x) - side * size / 2 for side in (1, -1)]
        return out("cut", tool, any(s.is_grazed(w, np.inf) for w in walls), width=size)
    across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    across /= np.linalg.norm(across)
    turn = np.linspace(0, 2 * np.pi, 201)[:, None]
    rim = origin + size * (np.cos(turn) * across + np.sin(turn) * np.cross(normal, across))

    def beyond_rim(x):  # a plane that touches nothing outside the disk
        d = tool.distance(x)
        return np.where(np.linalg.norm(x - origin, axis=1) <= size + s.length, d, s.size)

    grazes = s.is_grazed(beyond_rim, size) or s.is_grazed_by_curve(rim, size)
    return out("crack", tool, grazes, within=fs.Disk(origin, size))


# --------------------------------------------------------------------------------------------------------- judgement


@dataclass
class Outcome(rounding.Outcome):
    linear_seconds: float = 0.0
    linear_verdict: str = ""
    linear_quality: float = 1.0

    @property
    def counts(self):
        return self.verdict != "misses" and self.linear_verdict != "misses"

    @property
    def judged(self):
        return self.counts and self.verdict != "refused" and not self.case.grazes


def attempt(session, c):
    """Processor time of an operation, and its result or why there is none."""
    start = time.process_time()
    try:
        result, verdict, text = getattr(session, c.operation)(c.tool, **c.options), "good", ""
    except fs.Error as e:
        text = f"{type(e).__name__}: {e}"
        result, verdict = None, "misses" if any(m in text for m in MISSES) else "refused"
    return time.process_time() - start, result, verdict, text


def run(c):
    s = part(c.subject)
    linear_seconds, linear, linear_verdict, _ = attempt(s.twin, c)
    linear_quality = linear.report.quality.after.minimum if linear else 1.0
    del linear
    seconds, result, verdict, text = attempt(s.session, c)
    out = Outcome(c, verdict, seconds=seconds, text=text, linear_seconds=linear_seconds,
                  linear_verdict=linear_verdict, linear_quality=linear_quality)  # fmt: skip
    if result is None:
        return out
    quality = result.report.quality
    out.quality, out.before, out.text = quality.after.minimum, quality.before.minimum, "; ".join(result.report.warnings)
    found = rounding.faults(s, c, result) if c.kind == "plane" else []
    if not s.folded and not fs.scaled_jacobian(result.mesh)["tetra10"].min() > 0:
        found.append("an element is folded at a corner")
    if found:
        out.verdict, out.text = "wrong", "; ".join(found)
    return out


# ------------------------------------------------------------------------------------------------------------ tables


def row(title, outcomes):
    some = [o for o in outcomes if o.counts]
    if not some:
        return f"{title:24} all miss"
    seconds = np.array([o.seconds for o in some])
    linear = np.array([o.linear_seconds for o in some])
    judged = [o for o in some if o.judged]
    good = np.mean([o.quality >= min(GOOD, o.before) for o in judged]) if judged else 1
    least = min((o.quality for o in judged), default=1)
    least_linear = min((o.linear_quality for o in judged), default=1)
    refused = sum(o.verdict == "refused" for o in some)
    # Each against the median of its own mesh, as larger ones take longer.
    median = {n: np.median([o.seconds for o in some if o.case.subject == n]) for n in {o.case.subject for o in some}}
    worst = max(o.seconds / median[o.case.subject] for o in some)
    below = sum(o.quality < LEAST for o in judged)
    return (
        f"{title:24} {len(some):5} {seconds.sum():8.2f} {linear.sum():8.2f} {seconds.sum() / linear.sum():6.1f} "
        f"{np.median(seconds):7.3f} {seconds.max():7.2f} {worst:6.1f}   {least:6.3f} {least_linear:6.3f} "
        f"{below:4} {100 * good:6.1f} % {len(some) - len(judged) - refused:5} {refused:4} "
        f"({100 * refused / len(some):.1f} %) {sum(o.verdict == 'wrong' for o in some):3}"
    )


HEAD = (
    f"{'':24} cases  seconds   linear  ratio  median slowest   over    least linear <0.2  >=0.3 grazing refused wrong"
    f"\n{'':24}                                                 median"
)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=20, help="of each kind in each mesh")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--mesh", action="append", choices=list(PARTS), help="only this; may be given several times")
    parser.add_argument("--kind", action="append", choices=KINDS, help="only this; may be given several times")
    parser.add_argument("--slow", type=int, default=0, help="so many of the slowest are listed")
    parser.add_argument("--poor", action="store_true", help="those are listed that are below 0.2 and graze nothing")
    a = parser.parse_args()
    outcomes, names = [], a.mesh or [n for n in PARTS if n not in APART]
    for name in names:
        for kind in a.kind or KINDS:
            for number in range(a.first, a.first + a.cases):
                outcomes.append(run(case(name, kind, number)))
        print(f"{name}: {part(name).mesh.cells['tetra10'].shape[0]} elements", flush=True)
    print(HEAD)
    for name in names:
        print(row(name, [o for o in outcomes if o.case.subject == name]))
    for kind in a.kind or KINDS:
        print(row(kind, [o for o in outcomes if o.case.kind == kind]))
    print(row("all", outcomes))
    for o in outcomes:
        if o.verdict == "wrong":
            print(f"WRONG {o.case}\n    {o.text}")
        elif o.verdict == "refused" and o.counts:
            print(f"refused ({'linear too' if o.linear_verdict == 'refused' else 'linear not'}"
                  f"{', grazes' if o.case.grazes else ''}): {o.case}\n    {o.text}")  # fmt: skip
        elif a.poor and o.judged and o.quality < LEAST:
            print(
                f"poor {o.quality:.3f} (before {o.before:.3f}, linear {o.linear_quality:.3f}): {o.case}\n    {o.text}"
            )
    for o in sorted((o for o in outcomes if o.counts), key=lambda o: -o.seconds)[: a.slow]:
        print(f"slow {o.seconds:.2f} s (linear {o.linear_seconds:.3f} s), mean ratio {o.quality:.3f} "
              f"(linear {o.linear_quality:.3f}): {o.case}\n    {o.text}")  # fmt: skip
    return any(o.verdict == "wrong" for o in outcomes)


if __name__ == "__main__":
    sys.exit(main())
