#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The paper's cases, rebuilt on the demo's caisson: prints them in its terms and draws figure_3, 7, 9_caisson, 10, 11
and 12_caisson.png.

    PYTHONPATH=build/release/Mod/FemScalpel python3 resources/docs/paper_cases.py [folder]

Pictures go to the folder. Without one they are this folder's, and the table in paper.md is made anew, too. Needs Gmsh.
Its mesher HXT does not repeat itself to the last element, and so neither do the numbers.
"""

import itertools
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from PIL import Image

import femscalpel as fs

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "demo"))
import caisson  # noqa: E402

# STIFFENER_1 of the caisson: its web stands across x = 200, from the side of the box (y = 0) to its flange (y = -80 to
# -104); it goes up from the floor (z = 0) past the roof (z = 360), where its hanger begins, to the support (z = 520).
ROOF_Z = 360.0
SLANTING = fs.Plane(origin=(200, -50, 430), normal=(-0.33, -0.30, 1))  # rises above all other hangers
HOLE = fs.Cylinder(origin=(150, -40, 440), axis=(1, 0, 0), radius=22)
BORDER_HOLE = fs.Cylinder(origin=(150, -40, ROOF_Z + 6), axis=(1, 0, 0), radius=22)
DEPTH = 100.0  # past this web, short of the next stiffener's at x = 600
SLOT_WIDTH = 14.0
# On its flange, outside, up to the support: two plates, and in the solid mesh a block.
LOWER_Z, UPPER_Z, STANDS_OUT, BLOCK_WIDTH = 400.0, 520.0, 50.0, 28.0
RADIUS = 10.0  # of the flange's edges

# Of elements in several groups the first counts; faces of the skin that are in a group of faces have its colour.
COLOURS = {
    "ADD_ADDED": "#c5a3d9",
    "FACE_FLANGE_1": "#bcd9a4",
    "HANGERS": "#f6c58f",
    "STIFFENER_1": "#e8a25c",
    "ROOF": "#a9c8e8",
    "SIDE_A": "#7fa9d1",
}
EDGE, WALL, REST = "#7b3fa0", "#e58b93", "#d9d9d9"
TOOL, ON_TOOL, ON_SKIN, FREE = "#c01c28", "#c01c28", "#1f5fa8", "#2e8b57"


def caisson_mesh(solid, size):
    """The demo's caisson with its groups, first order."""
    model = caisson.make_model(solid, size, order=1)
    mesh = fs.Mesh(model.points, model.cells, cell_ids=model.cell_ids, groups=model.groups)
    mesh.unit = "mm"
    return mesh


@dataclass
class Case:
    """One of the paper's figures: a mesh before and after an operator."""

    figure: str
    title: str
    mesh: fs.Mesh
    result: fs.Result
    tool: fs.Tool | None = None

    def count(self, *sets):
        """Number of nodes in some of the paper's node sets."""
        return sum(len(self.result.report.node_sets[name]) for name in sets)

    def constraint(self, kind):
        return self.result.report.constraints.get(kind, 0)

    def lines(self):
        """The case in the paper's terms."""
        return [f"Figure {self.figure}: {self.title}", *(self._on_tool() if self.tool else []), *self._changes()]

    def _on_tool(self):
        report, tool = self.result.report, self.tool.kind
        on_tool, transition = [[n for n in report.node_sets if (n[1] == "T") == moves] for moves in (False, True)]
        return [
            "    "
            + ", ".join(
                f"{name} {self.count(name)}"
                for name in sorted(on_tool, reverse=True) + sorted(transition, reverse=True)
            ),
            f"    {self.count(*on_tool)} nodes on the {tool}, {self.count(*transition)} around them that may move; "
            f"{report.nodes_moved} were moved",
            f"    {self.constraint(tool)} {tool} constraints, {self.constraint('tangent plane')} tangent-plane "
            f"constraints, {self.constraint('free')} nodes free",
        ]

    def _changes(self):
        report = self.result.report
        text = [
            f"    {report.nodes_split} nodes born on edges, {report.nodes_doubled} doubled, {report.nodes_added} added "
            f"in all; {report.elements_added} elements added, {report.elements_removed} removed; smallest mean ratio "
            f"there {report.quality.before.minimum:.2f} before, {report.quality.after.minimum:.2f} after",
        ]
        changed = [g for g in report.groups if g.status in ("changed", "reduced", "became empty")]
        if changed:
            text.append(
                "    groups: "
                + ", ".join(
                    f"{g.name} {g.measure_before:.6g} -> {g.measure_after:.6g}"
                    if g.kind == "element"
                    else f"{g.name} {g.count_before} -> {g.count_after} {g.kind}s"
                    for g in changed
                )
            )
        return text


#: Sizes of the elements for the page, shells and tetrahedra.
PAGE_SIZES = 14, 20


def page_table(shell, hole, plates, block, fillet):
    """The rows of paper.md's table: what the paper counts, its number, ours."""

    def total(case, *sets):
        return f"{' + '.join(str(case.count(*names)) for names in sets)} = {case.count(*sum(sets, ()))}"

    crack = ("ICN", "ECN"), ("ITN", "ETN")
    return [
        "| the paper | there | here |",
        "| --- | --- | --- |",
        f"| Figure 10, crack in the shell mesh: plane constraints = interface nodes | 84 | "
        f"{shell.constraint('plane')} |",
        f"| tangent-plane constraints = interface and transition nodes | 84 + 341 = 425 | {total(shell, *crack)} |",
        f"| Figure 11, hole in a stiffener of the solid mesh: cylinder constraints = nodes of the hole, IHN and "
        f"EHN | 19 | {total(hole, ('IHN',), ('EHN',))} |",
        f"| plane constraints = EHN and ETN | 46 | {total(hole, ('EHN',), ('ETN',))} |",
        f"| nodes free to move = ITN | 21 | {hole.constraint('free')} |",
        f"| Figure 9, two stiffeners on the shell mesh: nodes of the seam, of them born on edges; "
        f"members of SUPPORT_1 | one more each | {seam(plates)}, {plates.result.report.nodes_split}; "
        f"{' -> '.join(str(n) for n in members(plates, 'SUPPORT_1'))} |",
        f"| Figure 3.b, a solid mesh merged with another: nodes of the seam | | {seam(block)} |",
        f"| Figure 3.c, fillet on a sharp edge: triangles of its surface | | {members(fillet, 'FILLET_FACE')[1]} |",
    ]


def members(case, group):
    """How many a group has before and after."""
    record = next(g for g in case.result.report.groups if g.name == group)
    return record.count_before, record.count_after


def seam(case):
    return members(case, "ADD_SEAM")[1]


def write_table(page, rows):
    """Puts the rows in the place of the page's table."""
    lines = page.read_text().splitlines()
    at = [k for k, line in enumerate(lines) if line.startswith("|")]
    page.write_text("\n".join(lines[: at[0]] + rows + lines[at[-1] + 1 :]) + "\n")


def attempt(case, *arguments, **options):
    """A case by the method "deform", or the reason why the mesh cannot be deformed so."""
    figure, title, mesh, tool = case
    try:
        operator = fs.crack if isinstance(tool, fs.Plane) else fs.drill
        return Case(figure, title, mesh, operator(mesh, tool, *arguments, method="deform", **options), tool)
    except (fs.QualityError, fs.ToolError) as error:
        return f"Figure {figure}: {title}: {error}"


def shell_cases(mesh):
    """Figure 10: a crack through the hanger, in shells; the same by moving nodes only."""
    return [
        Case("10", "crack in the shell mesh of the caisson", mesh, fs.crack(mesh, SLANTING), SLANTING),
        attempt(("10", "the same, by moving nodes only (the paper's way)", mesh, SLANTING)),
    ]


def solid_cases(mesh):
    """Figures 11, 12 (its border kept, and not) and 7, in tetrahedra; the hole once more by moving nodes only."""
    whole = fs.CylinderPart((0, DEPTH))
    return [
        Case("11", "hole in a stiffener of the solid mesh", mesh, fs.drill(mesh, HOLE, depth=DEPTH), HOLE),
        Case(
            "12",
            "hole across a group border that keeps its shape",
            mesh,
            fs.drill(mesh, BORDER_HOLE, depth=DEPTH),
            BORDER_HOLE,
        ),
        Case(
            "12",
            "the same, borders of groups may drift",
            mesh,
            fs.drill(mesh, BORDER_HOLE, depth=DEPTH, preserve=()),
            BORDER_HOLE,
        ),
        Case("7.a to c", "cylindrical crack", mesh, fs.crack(mesh, HOLE, within=whole), HOLE),
        Case("7.d to f", "incision between two planes", mesh, fs.cut(mesh, SLANTING, width=SLOT_WIDTH), SLANTING),
        attempt(("11", "the hole through three stiffeners, by moving nodes only (the paper's way)", mesh, HOLE)),
    ]


def plate_mesh(origin, first, second, counts):
    """Points and triangles of a parallelogram."""
    grid = np.stack(np.meshgrid(*(np.linspace(0, 1, n + 1) for n in counts), indexing="ij"), axis=-1)
    index = np.arange(grid[..., 0].size).reshape(grid.shape[:-1])
    a, b, c, d = (index[i : i - 1 or None, j : j - 1 or None].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return np.array(origin) + grid.reshape(-1, 2) @ np.array([first, second]), np.hstack([[a, b, c], [a, c, d]]).T


def stiffeners(mesh):
    """Two plates that stand on the flange; each ends halfway between two nodes of its upper edge."""
    edge = mesh.points[np.isin(mesh.node_ids, mesh.groups["SUPPORT_1"].ids)]
    y = edge[:, 1].min()
    x = np.unique(edge[edge[:, 1] == y][:, 0])
    middles = (x[:-1] + x[1:]) / 2
    height, points, triangles = UPPER_Z - LOWER_Z, [], []
    for at in middles[len(middles) // 4], middles[-1 - len(middles) // 4]:
        plate = plate_mesh((at, y, LOWER_Z), (0, -STANDS_OUT, 0), (0, 0, height), (4, 9))
        triangles.append(plate[1] + sum(map(len, points)))
        points.append(plate[0])
    return fs.Mesh(np.vstack(points), {"triangle": np.vstack(triangles)})


def block(mesh):
    """A block of tetrahedra that stands on the flange: cubes in six, as their diagonal says."""
    size, counts = (BLOCK_WIDTH, STANDS_OUT, UPPER_Z - LOWER_Z), (2, 4, 8)
    index = np.arange(np.prod(np.add(counts, 1))).reshape(np.add(counts, 1))
    points = np.stack(np.unravel_index(index.ravel(), index.shape), axis=1) / counts * size
    shifted = lambda at: index[tuple(slice(k, k - 1 or None) for k in at)].ravel()  # noqa: E731
    tetrahedra = []
    for way in itertools.permutations(np.eye(3, dtype=int)):
        path = [shifted(tuple(np.sum(way[:k], axis=0, dtype=int) * np.ones(3, int))) for k in range(4)]
        tetrahedra.append(np.stack(path if np.linalg.det(way) > 0 else [path[k] for k in (1, 0, 2, 3)], axis=1))
    flange = mesh.points[np.isin(mesh.node_ids, mesh.groups["SUPPORT_1"].ids)][:, 1].min()
    return fs.Mesh(points + [200 - BLOCK_WIDTH / 2, flange - STANDS_OUT, LOWER_Z], {"tetra": np.vstack(tetrahedra)})


def plates_case(mesh):
    """Figure 9: two stiffeners are added to the shells; the group of nodes at the support gets new ones."""
    return Case("9", "two stiffeners on the shell mesh of the caisson", mesh, fs.merge(mesh, stiffeners(mesh)))


def added_cases(mesh):
    """Figures 3.b and 3.c, in tetrahedra."""
    fillet = fs.fillet(mesh, "EDGE_FLANGE_1", RADIUS)
    return [
        Case("3.b", "a block merged with the solid mesh", mesh, fs.merge(mesh, block(mesh))),
        Case("3.c", f"fillets of {RADIUS:g} mm on the edges of the flange", mesh, fillet),
    ]


# --- pictures


@dataclass
class View:
    """A parallel projection of what lies in a box, or of some groups' parts there."""

    low: tuple
    high: tuple
    to_eye: tuple
    only: tuple = ()
    #: Whether the picture ends at the box, not with the last element.
    framed: bool = False

    def __post_init__(self):
        self.to_eye = np.array(self.to_eye) / np.linalg.norm(self.to_eye)
        right = np.cross((0, 0, 1), self.to_eye)
        self.axes = np.array([right, np.cross(self.to_eye, right)]).T / np.linalg.norm(right)

    def flat(self, points):
        return points @ self.axes

    def shows(self, points):
        return ((points > self.low) & (points < self.high)).all(axis=-1)


BESIDE = View(
    (140, -108, 352), (260, 0, 524), (1, 0, 0), only=("STIFFENER_1",), framed=True
)  # the hanger's web, face on
BORDER = View((186, -82, 328), (260, 0, 404), (1, 0, 0), only=("STIFFENER_1",), framed=True)
ASLANT = View((140, -120, 352), (260, 30, 525), (-0.85, -0.75, 0.5), only=("STIFFENER_1",))  # the hanger from outside
# With what is added, and its upper end.
OUTSIDE = View((140, -170, 352), (260, 30, 525), (-0.6, -0.9, 0.45), only=("STIFFENER_1", "ADD_ADDED"))
UPPER_END = View((144, -170, 455), (256, -84, 525), (-0.35, -0.9, 0.75), only=("STIFFENER_1", "ADD_ADDED"))


class Picture:
    """A mesh, or a part of it, as it is seen."""

    def __init__(self, axes, view, mesh, points=None, marked=(), walls=()):
        """`marked`: numbers of elements, `walls`: names of groups of faces in the tool's colour."""
        self.axes, self.view, self.mesh = axes, view, mesh
        self.points = points = mesh.points if points is None else points
        cells, numbers = elements_of(mesh)
        margin = 40 if view.framed else 0
        middle = mesh.points[cells].mean(axis=1)
        shown = ((middle > np.array(view.low) - margin) & (middle < np.array(view.high) + margin)).all(axis=1)
        if view.only:
            ids = [mesh.groups[name].ids for name in view.only if name in mesh.groups]
            shown &= np.isin(numbers, np.concatenate(ids))
        cells, numbers = cells[shown], numbers[shown]
        colours = self._colours(numbers, REST)
        colours[np.isin(numbers, marked)] = to_rgb(WALL)
        solid = cells.shape[1] == 4
        faces = cells
        if solid:
            faces = np.vstack([cells[:, f] for f in ([0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2])])
            _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
            faces, colours = faces[first[count == 1]], np.tile(colours, (4, 1))[first[count == 1]]
            self._colour_skin(faces, colours, walls)
        corners = points[faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        slope = normals @ view.to_eye / np.linalg.norm(normals, axis=1)
        front = slope > 1e-6 if solid else np.ones(len(faces), bool)
        corners, colours, slope = corners[front], colours[front], slope[front]
        order = np.argsort(corners.mean(axis=1) @ view.to_eye)
        shade = (0.72 + 0.28 * np.abs(slope[order]))[:, None]
        self.corners = corners[order]
        axes.add_collection(
            PolyCollection(
                view.flat(self.corners), facecolors=colours[order] * shade, edgecolors="#5a5a5a", linewidths=0.6
            )
        )

    def _colours(self, numbers, rest):
        out = np.tile(to_rgb(rest), (len(numbers), 1))
        for name in [n for n in reversed(COLOURS) if n in self.mesh.groups]:
            inside = np.isin(numbers, self.mesh.groups[name].ids)
            out[inside] = to_rgb(COLOURS[name])
        return out

    def _colour_skin(self, faces, colours, walls):
        triangles = np.sort(self.mesh.cells["triangle"], axis=1)
        ids = self.mesh.cell_ids["triangle"]
        painted = {}
        for name, colour in [("FACE_FLANGE_1", COLOURS["FACE_FLANGE_1"])] + [(name, WALL) for name in walls]:
            painted.update(
                (tuple(t), to_rgb(colour)) for t in triangles[np.isin(ids, self.mesh.groups[name].ids)].tolist()
            )
        for k, face in enumerate(np.sort(faces, axis=1).tolist()):
            colours[k] = painted.get(tuple(face), colours[k])

    def hides(self, points):
        """Which points are behind a face."""
        flat, deep = self.view.flat(points), points @ self.view.to_eye
        a, b, c = (self.view.flat(self.corners[:, k]) for k in range(3))
        depth = self.corners @ self.view.to_eye
        cross = lambda u, v: u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]  # noqa: E731
        area = cross(b - a, c - a)
        hidden = np.zeros(len(points), bool)
        for k, p in enumerate(flat):
            v, w = cross(p - a, c - a) / area, cross(b - a, p - a) / area
            over = (v > -1e-9) & (w > -1e-9) & (v + w < 1 + 1e-9)
            hidden[k] = (over & ((1 - v - w) * depth[:, 0] + v * depth[:, 1] + w * depth[:, 2] > deep[k] + 1)).any()
        return hidden

    def nodes(self, numbers, colour, size=30, inside=False):
        """Dots at nodes that are seen; with `inside` at all others, too."""
        at = self.points[np.isin(self.mesh.node_ids, numbers)]
        at = at[self.view.shows(at)]
        if not inside:
            at = at[~self.hides(at)]
        self.axes.scatter(*self.view.flat(at).T, s=size, color=colour, edgecolors="white", linewidths=0.6, zorder=5)

    def edges(self, group, colour, width=2.6):
        """Segments of a group."""
        edges = self.mesh.cells["line"][np.isin(self.mesh.cell_ids["line"], self.mesh.groups[group].ids)]
        edges = edges[self.view.shows(self.mesh.points[edges].mean(axis=1))]
        edges = edges[~self.hides(self.points[edges].mean(axis=1))]
        self.axes.add_collection(
            LineCollection(self.view.flat(self.points[edges]), colors=colour, linewidths=width, zorder=4)
        )

    def finish(self, title):
        self.axes.autoscale_view()
        self.axes.set_aspect("equal")
        self.axes.margins(0.03)
        if self.view.framed:
            corners = self.view.flat(np.array([self.view.low, self.view.high]))
            self.axes.set_xlim(*sorted(corners[:, 0]))
            self.axes.set_ylim(*sorted(corners[:, 1]))
        self.axes.set_axis_off()
        self.axes.set_title(title, fontsize=11, loc="left")


def elements_of(mesh):
    """(corner nodes, numbers) of the body's elements: tetrahedra, or triangles of shells."""
    kind = "tetra" if "tetra" in mesh.cells else "triangle"
    return mesh.cells[kind], mesh.cell_ids[kind]


def opened(case, way):
    """Coordinates with the positive side of a crack, or the inside of a cylindrical one, moved by `way`."""
    mesh = case.result.mesh
    cells, numbers = elements_of(mesh)
    middle = mesh.points[cells].mean(axis=1)
    near = np.isin(numbers, mesh.groups["STIFFENER_1"].ids) & ASLANT.shows(middle)
    distance = case.tool.distance(middle[near])
    points = mesh.points.copy()
    points[np.unique(cells[near][distance > 0 if case.tool.kind == "plane" else distance < 0])] += way
    return points


def group_keys(*names):
    return [Patch(facecolor=COLOURS[n], edgecolor="#5a5a5a", label=n) for n in names]


def dot(colour, label):
    return Line2D([], [], marker="o", ls="", color=colour, ms=7, label=label)


EDGE_KEY = Line2D([], [], color=EDGE, lw=2.6, label="EDGE_FLANGE_1 (edges)")


def save(figure, path, keys, title):
    figure.suptitle(title, fontsize=13, x=0.02, ha="left")
    figure.legend(handles=keys, loc="lower center", ncol=min(len(keys), 7), fontsize=10, frameon=False)
    figure.subplots_adjust(left=0.02, right=0.98, top=0.87, bottom=0.09, wspace=0.08)
    figure.savefig(path, facecolor="white")
    plt.close(figure)
    with Image.open(path) as picture:  # a third of the size, and looks the same
        small = picture.convert("RGB").quantize(200)
    small.save(path, optimize=True)


def draw_crack_in_shell(case, path):
    figure, axes = plt.subplots(1, 3, figsize=(14, 6.8), dpi=100)
    mesh, sets = case.result.mesh, case.result.report.node_sets
    before = Picture(axes[0], ASLANT, case.mesh)
    before.finish("before")
    after = Picture(axes[1], ASLANT, mesh)
    after.nodes(np.concatenate([sets["ITN"], sets["ETN"]]), ON_SKIN, 22)
    after.nodes(np.concatenate([sets["ICN"], sets["ECN"]]), ON_TOOL)
    after.finish(
        f"after: {case.constraint('plane')} plane and {case.constraint('tangent plane')} tangent-plane constraints"
    )
    apart = Picture(axes[2], ASLANT, mesh, opened(case, 9 * np.array(SLANTING.normal)))
    for name in ("CRACK_P", "CRACK_N"):
        apart.edges(name, TOOL)
    apart.finish("opened for the picture")
    for picture in (before, after, apart):
        picture.edges("EDGE_FLANGE_1", EDGE)
    save(
        figure,
        path,
        [
            *group_keys("FACE_FLANGE_1", "HANGERS"),
            EDGE_KEY,
            dot(ON_TOOL, "on the crack plane"),
            dot(ON_SKIN, "moves on its tangent plane"),
            Line2D([], [], color=TOOL, lw=2.6, label="CRACK_P, CRACK_N"),
        ],
        "As the paper's Figure 10: a crack through a hanger of the caisson, shells",
    )


def draw_hole(case, path):
    figure, axes = plt.subplots(1, 2, figsize=(11.5, 8.4), dpi=100)
    mesh, sets = case.result.mesh, case.result.report.node_sets
    before = Picture(axes[0], BESIDE, case.mesh, marked=np.setdiff1d(elements_of(case.mesh)[1], elements_of(mesh)[1]))
    ring = np.linspace(0, 2 * np.pi, 100)
    circle = np.array(HOLE.origin) + HOLE.radius * np.stack([0 * ring, np.cos(ring), np.sin(ring)], axis=1)
    axes[0].plot(*BESIDE.flat(circle).T, color=TOOL, linewidth=2)
    before.finish("before; the drill, and elements that go whole")
    after = Picture(axes[1], BESIDE, mesh, walls=["HOLE_WALL"])
    after.nodes(sets["ITN"], FREE, 26, inside=True)
    after.nodes(sets["ETN"], ON_SKIN, 26)
    after.nodes(np.concatenate([sets["IHN"], sets["EHN"]]), ON_TOOL)
    after.finish(
        f"after: {case.constraint('cylinder')} cylinder, {case.constraint('tangent plane')} tangent-plane constraints, "
        f"{case.constraint('free')} free"
    )
    save(
        figure,
        path,
        [
            *group_keys("HANGERS", "STIFFENER_1"),
            dot(ON_TOOL, "on the cylinder"),
            dot(ON_SKIN, "moves on its tangent plane"),
            dot(FREE, "inside the material"),
        ],
        "As the paper's Figure 11: a hole in a stiffener of the caisson, tetrahedra, seen along its axis",
    )


def draw_border(cases, path):
    figure, axes = plt.subplots(1, 3, figsize=(14, 5.6), dpi=100)
    Picture(axes[0], BORDER, cases[0].mesh).finish("before")
    for at, case, label in zip(axes[1:], cases, ("preserved (the default)", "preserve=()")):
        record = next(g for g in case.result.report.groups if g.name == "HANGERS")
        Picture(at, BORDER, case.result.mesh, walls=["HOLE_WALL"]).finish(
            f"{label}: border drift {record.boundary_drift:.2g} mm"
        )
    for at in axes:
        at.axhline(ROOF_Z, color="black", linewidth=1.4, linestyle=":")
    save(
        figure,
        path,
        [
            *group_keys("HANGERS", "STIFFENER_1"),
            Line2D([], [], color="black", ls=":", label="border of HANGERS, z = 360"),
            Patch(facecolor=WALL, label="HOLE_WALL"),
        ],
        "As the paper's Figure 12: a hole across the border of two groups of tetrahedra in the stiffener's web",
    )


def draw_cylinder_and_slot(crack, slot, path):
    figure, axes = plt.subplots(1, 3, figsize=(14, 6.8), dpi=100)
    pictures = [
        Picture(axes[0], ASLANT, crack.mesh),
        Picture(
            axes[1], ASLANT, crack.result.mesh, opened(crack, np.array([-40.0, 0, 0])), walls=["CRACK_P", "CRACK_N"]
        ),
        Picture(axes[2], ASLANT, slot.result.mesh, walls=["CUT_P", "CUT_N"]),
    ]
    for picture, title in zip(
        pictures,
        ("before", "cylindrical crack; what it frees pulled out for the picture", f"incision, {SLOT_WIDTH:g} mm wide"),
    ):
        picture.edges("EDGE_FLANGE_1", EDGE)
        picture.finish(title)
    save(
        figure,
        path,
        [
            *group_keys("FACE_FLANGE_1", "HANGERS", "STIFFENER_1"),
            EDGE_KEY,
            Patch(facecolor=WALL, label="lips CRACK_P, CRACK_N; walls CUT_P, CUT_N"),
        ],
        "As the paper's Figure 7: cylindrical crack and incision, in a stiffener of the solid caisson",
    )


def draw_plates(case, path):
    figure, axes = plt.subplots(1, 3, figsize=(14, 6.8), dpi=100)
    mesh, groups = case.result.mesh, case.result.mesh.groups
    support, seam_nodes = groups["SUPPORT_1"].ids, groups["ADD_SEAM"].ids
    pictures = [
        Picture(axes[0], OUTSIDE, case.mesh),
        Picture(axes[1], OUTSIDE, mesh),
        Picture(axes[2], UPPER_END, mesh),
    ]
    pictures[0].nodes(case.mesh.groups["SUPPORT_1"].ids, ON_SKIN)
    for picture in pictures[1:]:
        picture.nodes(seam_nodes, FREE, 22)
        picture.nodes(support, ON_SKIN)
        picture.nodes(np.intersect1d(support, seam_nodes), ON_TOOL, 44)
    before, after = members(case, "SUPPORT_1")
    for picture, title in zip(
        pictures,
        (f"before: {before} nodes in SUPPORT_1", f"after: {after}; {seam(case)} nodes on the seam", "its upper end"),
    ):
        picture.finish(title)
    save(
        figure,
        path,
        [
            *group_keys("FACE_FLANGE_1", "HANGERS", "ADD_ADDED"),
            dot(ON_SKIN, "SUPPORT_1"),
            dot(ON_TOOL, "born on its edge: in both"),
            dot(FREE, "ADD_SEAM"),
        ],
        "As the paper's Figure 9: two stiffeners added to a hanger of the caisson, shells",
    )


def draw_block_and_fillet(block, fillet, path):
    figure, axes = plt.subplots(1, 3, figsize=(14, 6.8), dpi=100)
    pictures = [
        Picture(axes[0], OUTSIDE, block.mesh),
        Picture(axes[1], OUTSIDE, block.result.mesh),
        Picture(axes[2], OUTSIDE, fillet.result.mesh, walls=["FILLET_FACE"]),
    ]
    for picture, title in zip(pictures, ("before", "merged with a block", f"fillets of {RADIUS:g} mm")):
        picture.finish(title)
    save(
        figure,
        path,
        [*group_keys("FACE_FLANGE_1", "HANGERS", "ADD_ADDED"), Patch(facecolor=WALL, label="FILLET_FACE")],
        "As the paper's Figures 3.a to 3.c: material added to and edges rounded on the solid caisson",
    )


def main(folder, page=None):
    shell_mesh, solid_mesh = caisson_mesh(False, PAGE_SIZES[0]), caisson_mesh(True, PAGE_SIZES[1])
    shell, deformed = shell_cases(shell_mesh)
    hole, kept, drifting, cylinder, slot, moved = solid_cases(solid_mesh)
    plates = plates_case(shell_mesh)
    added, fillet = added_cases(solid_mesh)
    for case in (shell, deformed, hole, moved, kept, drifting, cylinder, slot, plates, added, fillet):
        print(case if isinstance(case, str) else "\n".join(case.lines()))
    draw_crack_in_shell(shell, folder / "figure_10.png")
    draw_hole(hole, folder / "figure_11.png")
    draw_border((kept, drifting), folder / "figure_12_caisson.png")
    draw_cylinder_and_slot(cylinder, slot, folder / "figure_7.png")
    draw_plates(plates, folder / "figure_9_caisson.png")
    draw_block_and_fillet(added, fillet, folder / "figure_3.png")
    if page:
        write_table(page, page_table(shell, hole, plates, added, fillet))


if __name__ == "__main__":
    here = Path(__file__).parent
    if len(sys.argv) > 1:
        main(Path(sys.argv[1]))
    else:
        main(here, here / "paper.md")
