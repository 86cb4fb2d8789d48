# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tools that pass nodes at distances from nothing to a hundredth of an edge, on meshes with coordinates as they are and
rounded as files round them: what an engineer does who cuts on a symmetry plane, a weld, the border of two materials.

    /usr/bin/python3 tests/python/rounding_cases.py --cases 3000

(with the package on PYTHONPATH) prints how many are good, poor, refused, slow or grown, by mesh, rounding and distance;
test_rounding.py runs some of them. Every case is made from its number alone.
"""
import argparse
import collections
import multiprocessing
import pathlib
import sys
import time
from dataclasses import dataclass, field

import femscalpel as fs
import numpy as np

#: Where the test meshes are, from the module that is tested.
MESHES = pathlib.Path(fs.__file__).resolve().parents[3] / "tests" / "meshes"

#: Distances from tool to node, in edge lengths.
OFFSETS = (0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2)
#: The same tools this far off, to compare with.
SHIFTED = 0.1

VOLUME, PLATE, EDGE = ("tetra", "tetra10"), ("triangle", "triangle6"), ("line", "line3")
CORNERS = {"tetra": 4, "tetra10": 4, "triangle": 3, "triangle6": 3, "line": 2, "line3": 2, "vertex": 1}
FIRST_ORDER = {"tetra10": "tetra", "triangle6": "triangle", "line3": "line"}
#: Ends of the edge of each mid-side node.
MIDDLES = {
    "tetra10": ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)),
    "triangle6": ((0, 1), (1, 2), (0, 2)),
    "line3": ((0, 1),),
}


# ----------------------------------------------------------------------------------------------------------------
# meshes


def _grid_plate(n=12, size=0.9):
    index = lambda i, j: j * (n + 1) + i
    points = np.array([(i * size / n, j * size / n, 0.0) for j in range(n + 1) for i in range(n + 1)])
    cells = []
    for j in range(n):
        for i in range(n):
            a, b, c, d = index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)
            cells += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    return points, "triangle", np.array(cells)


def _grid_box(n=6, size=0.6):
    index = lambda i, j, k: (k * (n + 1) + j) * (n + 1) + i
    points = np.array(
        [(i * size / n, j * size / n, k * size / n) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    )
    cells = []
    for k in range(n):
        for j in range(n):
            for i in range(n):
                v = [index(i + a, j + b, k + c) for c in (0, 1) for b in (0, 1) for a in (0, 1)]
                cells += [
                    [v[q] for q in t]
                    for t in ((0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7))
                ]
    return points, "tetra", np.array(cells)


def _second_order(points, kind, cells):
    edges = {"triangle": ((0, 1), (1, 2), (0, 2)), "tetra": ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))}[kind]
    points, middle, out = list(map(tuple, points)), {}, []
    for c in cells:
        row = list(c)
        for a, b in edges:
            key = tuple(sorted((c[a], c[b])))
            if key not in middle:
                middle[key] = len(points)
                points.append(tuple((np.array(points[key[0]]) + points[key[1]]) / 2))
            row.append(middle[key])
        out.append(row)
    return np.array(points), kind + {"triangle": "6", "tetra": "10"}[kind], np.array(out)


def _of_two_materials(points, kind, cells, seed):
    """With two groups that part the mesh in the middle of x, nodes named in groups of their own, one mid-side node
    among them."""
    rng = np.random.default_rng(seed)
    corners = CORNERS[kind]
    left = points[cells[:, :corners], 0].mean(1) < points[:, 0].mean()
    ids = np.arange(1, len(cells) + 1)
    groups = {"LEFT": ("element", ids[left]), "RIGHT": ("element", ids[~left])}
    used = np.unique(cells[:, :corners])
    groups["NAMED"] = ("node", rng.choice(used, 6, replace=False) + 1)
    if cells.shape[1] > corners:
        groups["NAMED_MIDDLE"] = ("node", rng.choice(np.unique(cells[:, corners:]), 4, replace=False) + 1)
    return fs.Mesh(points, {kind: cells}, groups=groups)


def _jittered(points, kind, cells, amount, seed):
    """Inner nodes of a flat mesh moved about, borders kept."""
    rng = np.random.default_rng(seed)
    low, high, middle = points.min(0), points.max(0), points[:, 0].mean()
    inner = np.ones(len(points), bool)
    for a in range(3):
        if high[a] > low[a]:
            inner &= (points[:, a] > low[a] + 1e-9) & (points[:, a] < high[a] - 1e-9)
    inner &= abs(points[:, 0] - middle) > 1e-9
    move = rng.uniform(-amount, amount, points.shape) * (high > low)
    out = points.copy()
    out[inner] += move[inner]
    return out, kind, cells


def _read(name):
    return lambda: fs.read(MESHES / f"{name}.inp")


#: Name -> function that makes the mesh, and how often it is taken.
SUBJECTS = {
    "plate": (lambda: _of_two_materials(*_grid_plate(), 1), 3),
    "uneven plate": (lambda: _of_two_materials(*_jittered(*_grid_plate(), 0.018, 5), 2), 2),
    "plate, second order": (lambda: _of_two_materials(*_second_order(*_grid_plate()), 3), 2),
    "box": (lambda: _of_two_materials(*_grid_box(), 4), 3),
    "uneven box": (lambda: _of_two_materials(*_jittered(*_grid_box(), 0.022, 6), 5), 2),
    "box, second order": (lambda: _of_two_materials(*_second_order(*_grid_box(4, 0.4)), 6), 3),
    "two_boxes": (_read("two_boxes"), 3),
    "l_shape": (_read("l_shape"), 3),
    "flanged_cylinder": (_read("flanged_cylinder"), 3),
    "caisson_shell": (_read("caisson_shell"), 2),
    "quadratic_elbow": (_read("quadratic_elbow"), 1),
}


def rounded(mesh, how):
    """The mesh with its coordinates in single precision ("single") or with so many significant digits (a number)."""
    if how == "as they are":
        return mesh
    points = mesh.points
    if how == "single":
        points = points.astype(np.float32).astype(float)
    else:
        points = np.array([float(f"{x:.{int(how) - 1}e}") for x in points.ravel()]).reshape(-1, 3)
    groups = [(g.name, g.kind, g.ids) for g in mesh.groups.all()]
    return fs.Mesh(points, mesh.cells, node_ids=mesh.node_ids, cell_ids=mesh.cell_ids, groups=groups)


ROUNDINGS = ("as they are", "single", 6)

#: Those whose surfaces are all flat.
FLAT = {
    "plate",
    "uneven plate",
    "plate, second order",
    "box",
    "uneven box",
    "box, second order",
    "two_boxes",
    "l_shape",
    "caisson_shell",
}


class Subject:
    """A mesh and what is known of it for making cases and judging results."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.corner_cells = {t: c[:, : CORNERS[t]] for t, c in mesh.cells.items() if t in VOLUME + PLATE + EDGE}
        main = VOLUME if any(t in mesh.cells for t in VOLUME) else PLATE
        self.main = main
        self.cells = np.concatenate([c for t, c in self.corner_cells.items() if t in main])
        self.corners = np.unique(self.cells)
        pairs = np.concatenate([self.cells[:, [a, b]] for a in range(self.cells.shape[1]) for b in range(a)])
        length = np.linalg.norm(mesh.points[pairs[:, 0]] - mesh.points[pairs[:, 1]], axis=1)
        total, count = np.zeros(mesh.node_count), np.zeros(mesh.node_count)
        for k in range(2):
            np.add.at(total, pairs[:, k], length)
            np.add.at(count, pairs[:, k], 1)
        self.edge = total / np.maximum(count, 1)
        self.places = self._places(pairs)
        self.size = np.linalg.norm(mesh.points.max(0) - mesh.points.min(0))
        self.session = fs.Scalpel(mesh)

    def _places(self, pairs):
        """Nodes by what holds them."""
        m, places = self.mesh, {"node": self.corners}
        row = {int(n): k for k, n in enumerate(m.node_ids)}
        for name in ("NAMED", "NAMED_MIDDLE"):
            if name in m.groups:
                places[name] = np.array([row[int(i)] for i in m.groups[name, "node"].ids])
        # Nodes of elements of several families lie on a border; those of lines on a feature line.
        family, count = {}, collections.defaultdict(set)
        for g in m.groups.all("element"):
            for i in g.ids:
                family.setdefault(int(i), []).append(g.name)
        for t, c in self.corner_cells.items():
            if t in self.main:
                for i, nodes in zip(m.cell_ids[t], c):
                    for n in nodes:
                        count[int(n)].add(tuple(family.get(int(i), ())))
        border = np.array([n for n, f in count.items() if len(f) > 1], dtype=int)
        if len(border):
            places["border"] = border
        low, high = m.points.min(0), m.points.max(0)
        extreme = (
            (abs(m.points - low) < 1e-6 * (high - low + 1e-9)) | (abs(m.points - high) < 1e-6 * (high - low + 1e-9))
        )[:, high > low].sum(1)
        corner = np.intersect1d(np.nonzero(extreme >= (high > low).sum())[0], self.corners)
        if len(corner):
            places["corner"] = corner
        return places


# -----------------------------------------------------------------------------------------------------------------
# cases


@dataclass
class Case:
    number: int
    subject: str
    rounding: object
    place: str
    offset: float
    operation: str
    tool: object
    options: dict = field(default_factory=dict)

    def __str__(self):
        return (
            f"case {self.number}: {self.operation} {self.subject} ({self.rounding}), {self.offset:g} edge lengths "
            f"beside a {self.place}: {self.tool!r}" + "".join(f", {k}={v!r}" for k, v in self.options.items())
        )


_subjects = {}


def subject(name, rounding):
    if (name, rounding) not in _subjects:
        _subjects[name, rounding] = Subject(rounded(SUBJECTS[name][0](), rounding))
    return _subjects[name, rounding]


def case(number, offset=None, names=None):
    """The case of a number; with `offset` (edge lengths) another distance than its own."""
    rng = np.random.default_rng([2026, number])
    names = names or list(SUBJECTS)
    weights = np.array([SUBJECTS[n][1] for n in names], float)
    name = names[rng.choice(len(names), p=weights / weights.sum())]
    rounding = ROUNDINGS[rng.integers(len(ROUNDINGS))]
    s = subject(name, rounding)
    place = list(s.places)[rng.integers(len(s.places))]
    own = OFFSETS[rng.integers(len(OFFSETS))] * rng.choice((-1, 1))
    offset = own if offset is None else offset * (np.sign(own) or 1)
    points = s.mesh.points
    node = rng.choice(s.places[place])
    shift = offset * (s.edge[node] or s.edge[s.corners].mean())
    flat = np.ptp(points[:, 2]) == 0
    kind = rng.choice(("axis", "row", "oblique", "cylinder", "hole", "disk"), p=(0.3, 0.25, 0.15, 0.1, 0.1, 0.1))
    normal = rng.normal(size=3)
    if flat:
        normal[2] = 0
    if kind in ("axis", "disk"):
        normal = np.eye(3)[rng.integers(2 if flat else 3)]
    if kind == "row":  # through two further nodes of the same kind, or one and the normal of a plate
        others = s.places[place] if len(s.places[place]) >= 3 else s.corners
        a, b = rng.choice(others, 2, replace=False)
        normal = np.cross(points[a] - points[node], (0, 0, 1.0) if flat else points[b] - points[node])
        if np.linalg.norm(normal) < 1e-6 * s.size**2:
            normal = np.eye(3)[0]
    normal = normal / np.linalg.norm(normal)
    if kind in ("cylinder", "hole"):
        axis = np.array((0, 0, 1.0)) if flat or rng.random() < 0.6 else normal
        away = np.cross(axis, rng.normal(size=3))
        away /= np.linalg.norm(away)
        radius = rng.uniform(1.5, 3) * s.edge[s.corners].mean()
        tool = fs.Cylinder(points[node] + (radius + shift) * away, axis, radius)
        return Case(number, name, rounding, place, offset, "drill" if kind == "hole" else "crack", tool)
    tool = fs.Plane(points[node] + shift * normal, normal)
    options = {}
    if kind == "disk" and not flat:
        radius = rng.uniform(2, 4) * s.edge[s.corners].mean()
        away = np.cross(normal, rng.normal(size=3))
        away /= np.linalg.norm(away)
        # The disk's rim passes the node at the same distance.
        options["within"] = fs.Disk(points[node] + shift * normal + (radius + shift) * away, radius)
    return Case(number, name, rounding, place, offset, "crack", tool, options)


# -------------------------------------------------------------------------------------------------------------
# judgement


@dataclass
class Outcome:
    case: Case
    verdict: str  # "good", "fair", "poor", "warned", "wrong", "refused", "misses"
    quality: float = 1.0
    before: float = 1.0
    seconds: float = 0.0
    growth: float = 1.0
    text: str = ""


def measures(mesh):
    out = []
    for t, c in mesh.cells.items():
        p = mesh.points[c[:, : CORNERS[t]]]
        if t in VOLUME:
            out.append(np.einsum("ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) / 6)
    return np.concatenate(out) if out else np.zeros(0)


def faults(s, case, result):
    """What must hold of any result; looked at from the outside."""
    mesh, found = result.mesh, []
    volume = measures(mesh)
    if len(volume) and not volume.min() > 0:
        found.append(f"{(volume <= 0).sum()} tetrahedra are flat or inverted")
    if case.operation != "crack":
        return found
    # Nodes of the lips lie on the tool, but for those that the report says are held beside it.
    name = "CRACK"
    lips = {}
    for side in ("_P", "_N"):
        ids = mesh.groups[name + side, "element"].ids
        nodes = [c[np.isin(mesh.cell_ids[t], ids)].ravel() for t, c in mesh.cells.items()]
        lips[side] = np.unique(np.concatenate(nodes))
    held = getattr(result.report, "held", None)
    allowed = 1e-7 * s.size if held is None else held.largest + 1e-9 * s.size
    off = abs(case.tool.distance(mesh.points[np.concatenate(list(lips.values()))])).max()
    if off > allowed and not any(t in ("tetra10", "triangle6") for t in mesh.cells):
        found.append(f"a node of the lips is {off:.3g} off the tool, {allowed:.3g} at most were reported")
    # Only the front joins the lips.
    joint = np.intersect1d(lips["_P"], lips["_N"])
    front = []
    for kind in ("node", "element"):
        if (name + "_FRONT", kind) in {(g.name, g.kind) for g in mesh.groups.all()}:
            ids = mesh.groups[name + "_FRONT", kind].ids
            if kind == "node":
                front.append(np.nonzero(np.isin(mesh.node_ids, ids))[0])
            else:
                front += [c[np.isin(mesh.cell_ids[t], ids)].ravel() for t, c in mesh.cells.items()]
    front = np.unique(np.concatenate(front)) if front else np.zeros(0, int)
    lost = np.setdiff1d(joint, front)
    corners = np.unique(np.concatenate([c[:, : CORNERS[t]].ravel() for t, c in mesh.cells.items()]))
    # A mid-side node may be one of an edge along the front.
    along = [
        c[:, CORNERS[t] + k]
        for t, c in mesh.cells.items()
        if t in MIDDLES
        for k, (a, b) in enumerate(MIDDLES[t])
        for c in [c[np.isin(c[:, a], front) & np.isin(c[:, b], front)]]
    ]
    if along and not any(g.name == name + "_FRONT" for g in mesh.groups.all("element")):  # whose segments name theirs
        lost = np.setdiff1d(lost, np.setdiff1d(np.concatenate(along), corners))
    if len(lost):
        found.append(f"{len(lost)} nodes join the lips and are in no front")
    # Volumes and areas of groups survive where all is flat.
    for r in result.report.groups:
        if r.status != "new" and r.measure_before > 0 and s.flat and r.dimension >= (3 if s.main == VOLUME else 2):
            change = abs(r.measure_after / r.measure_before - 1)
            if change > s.slack:
                found.append(f"group {r.name} changed its size by {change:.2g}")
    return found


def run(case):
    s = subject(case.subject, case.rounding)
    s.flat = case.subject in FLAT
    s.slack = {"as they are": 1e-9, "single": 3e-6, 6: 3e-5}[case.rounding]
    if case.subject == "caisson_shell":  # it has round holes, whose rims bend
        s.slack = 1e-3
    start = time.perf_counter()
    try:
        result = getattr(s.session, case.operation)(case.tool, **case.options)
    except fs.ToolError as e:
        return Outcome(case, "misses", seconds=time.perf_counter() - start, text=str(e))
    except fs.Error as e:
        return Outcome(case, "refused", seconds=time.perf_counter() - start, text=f"{type(e).__name__}: {e}")
    seconds = time.perf_counter() - start
    report = result.report
    q, before = report.quality.after.minimum, report.quality.before.minimum
    growth = result.mesh.cell_count / s.mesh.cell_count
    if report.refinement:
        growth /= report.refinement.elements_after / report.refinement.elements_before
    found = faults(s, case, result)
    out = Outcome(case, "good", q, before, seconds, growth, "; ".join(report.warnings))
    if found:
        out.verdict, out.text = "wrong", "; ".join(found)
    elif q < min(0.02, before / 10):
        out.verdict = "warned" if getattr(report, "poor", ()) else "poor"
    elif q < min(0.1, before / 2):
        out.verdict = "fair"
    return out


def summary(outcomes):
    """Figures of some outcomes, as a dict."""
    counted = [o for o in outcomes if o.verdict != "misses"]
    count = collections.Counter(o.verdict for o in outcomes)
    return {
        "cases": len(counted),
        **{v: count[v] for v in ("good", "fair", "warned", "poor", "wrong", "refused", "endless", "misses")},
        "slowest": max((o.seconds for o in counted), default=0),
        "growth": max((o.growth for o in counted), default=1),
    }


def line(title, outcomes):
    f = summary(outcomes)
    n = max(1, f["cases"])
    return (
        f"{title:28} {f['cases']:5} cases: good {100 * f['good'] / n:5.1f} %, fair {f['fair']}, warned {f['warned']}, "
        f"poor {f['poor']}, wrong {f['wrong']}, "
        f"refused {f['refused']}, endless {f['endless']}, misses {f['misses']}, slowest {f['slowest']:.2f} s, growth "
        f"{f['growth']:.2f}"
    )


def _answer(number, offset, names, pipe):
    pipe.send({**vars(run(case(number, offset, names))), "case": None})  # which has a tool of the engine
    pipe.close()


def _run_apart(number, offset, names, limit):
    """In a process of its own, which is stopped after `limit` seconds."""
    c = case(number, offset, names)  # makes the mesh here, once for all
    receiver, sender = multiprocessing.Pipe(False)
    process = multiprocessing.get_context("fork").Process(target=_answer, args=(number, offset, names, sender))
    process.start()
    sender.close()
    try:
        if receiver.poll(limit):
            return Outcome(**{**receiver.recv(), "case": c})
        return Outcome(c, "endless", seconds=limit)
    except EOFError:
        return Outcome(c, "wrong", text="the process died")
    finally:
        process.kill()
        process.join()


def run_many(numbers, offset=None, names=None, limit=None, on_outcome=None):
    """Outcomes of the cases of these numbers; with `limit` each in a process of its own that is stopped after so many
    seconds."""
    out = []
    for n in numbers:
        out.append(run(case(n, offset, names)) if limit is None else _run_apart(n, offset, names, limit))
        if on_outcome:
            on_outcome(out[-1])
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=300)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--limit", type=float, default=30, help="seconds after which a case counts as endless")
    parser.add_argument(
        "--mesh", action="append", choices=list(SUBJECTS), help="this mesh only; may be given several times"
    )
    parser.add_argument(
        "--file", action="append", default=[], help="a mesh of your own instead; may be given several times"
    )
    parser.add_argument(
        "--shifted", action="store_true", help="also the same tools a tenth of an edge off and at 1e-9, to compare"
    )
    parser.add_argument("--quiet", action="store_true", help="figures only")
    a = parser.parse_args()
    numbers = range(a.first, a.first + a.cases)
    for path in a.file:
        SUBJECTS[path] = (lambda path=path: fs.read(path), 1)
    a.mesh = (a.mesh or []) + a.file or None

    def tell(o):
        if not a.quiet and (o.verdict not in ("good", "misses") or o.seconds > 2 or o.growth > 4):
            print(
                f"{o.verdict}: {o.case}\n    mean ratio {o.before:.3f} -> {o.quality:.2g}, {o.seconds:.2f} s, growth "
                f"{o.growth:.2f}; {o.text[:300]}",
                flush=True,
            )

    outcomes = run_many(numbers, None, a.mesh, a.limit, tell)
    for title, key in (
        ("mesh", lambda o: o.case.subject),
        ("rounding", lambda o: str(o.case.rounding)),
        ("distance", lambda o: f"{abs(o.case.offset):g}"),
        ("place", lambda o: o.case.place),
        ("tool", lambda o: f"{o.case.operation} {type(o.case.tool).__name__}{' within' if o.case.options else ''}"),
    ):
        print(f"by {title}")
        groups = collections.defaultdict(list)
        for o in outcomes:
            groups[key(o)].append(o)
        for name, some in sorted(groups.items()):
            print("  " + line(name, some))
    print(line("all", outcomes))
    if a.shifted:
        for offset in (1e-9, SHIFTED):
            others = run_many(numbers, offset, a.mesh, a.limit)
            q = np.array([o.quality for o in others if o.verdict not in ("misses", "refused", "endless")])
            print(
                line(f"at {offset:g} edge lengths", others),
                " mean ratio at the tenth, quarter, half:",
                np.quantile(q, (0.1, 0.25, 0.5)).round(3),
            )
    return 0


if __name__ == "__main__":
    sys.exit(main())
