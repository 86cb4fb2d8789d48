# SPDX-License-Identifier: LGPL-2.1-or-later
"""The demo's pictures: scenes by VTK (needs an X display, also a virtual one), put together by Matplotlib."""

from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

# Groups of plates, disjoint and together the whole body, and their colours.
PARTS = {
    "STIFFENER_1": "#e8762c",
    "STIFFENER_2": "#f3b562",
    "STIFFENER_3": "#f7d58b",
    "STIFFENER_4": "#d9a066",
    "STIFFENER_5": "#c98f5a",
    "STIFFENER_6": "#e6c9a0",
    "ROOF": "#a9c8e8",
    "FLOOR": "#5a7fa8",
    "SIDE_A": "#7fa9d1",
    "SIDE_B": "#6b93bd",
    "END_A": "#93d0c4",
    "END_B": "#63b0a3",
    "DIAPHRAGM": "#b9a7d6",
    "LONGITUDINALS": "#8fbf6b",
}
STRESS_MAP = matplotlib.colors.LinearSegmentedColormap.from_list(
    "stress", ["#e3e9f0", "#9cc3e4", "#4fae9b", "#f0d040", "#ef7d29", "#b0131c"]
)
DIRECTION = np.array([-0.62, -1.0, 0.62])  # from the scene to the eye
HANGER = np.array([200.0, -50.0, 445.0])  # middle of the cracked hanger


@dataclass
class Mesh:
    """What is drawn of a mesh: all arrays index `points`."""

    points: np.ndarray  # (n, 3)
    row_of: dict[int, int]  # node number -> row
    surface: np.ndarray  # (m, 3 or 4) of a shell, or of a solid's skin; with 4, triangles have their last twice
    part: np.ndarray  # (m,) index into PARTS
    lines: dict[str, np.ndarray]  # edge group -> (k, 2)
    nodes: dict[str, np.ndarray]  # node group -> rows
    lips: np.ndarray  # (k, 2) border of both lips, for shells the lips themselves; empty without a crack


def prepare(mesh) -> Mesh:
    """What is drawn of a femscalpel.Mesh."""
    cells = {name.rstrip("0123456789"): nodes for name, nodes in mesh.cells.items()}
    ids = {name.rstrip("0123456789"): numbers for name, numbers in mesh.cell_ids.items()}
    solid = "tetra" in cells
    rows = {name: dict(zip(numbers.tolist(), range(len(numbers)))) for name, numbers in ids.items()}
    body = {"tetra": 4} if solid else {n: k for n, k in (("triangle", 3), ("quad", 4)) if n in cells}
    body_ids = np.concatenate([ids[n] for n in body])
    part = np.zeros(len(body_ids), int)
    for k, name in enumerate(PARTS):
        part[np.isin(body_ids, mesh.groups[name].ids)] = k
    if solid:
        faces = np.vstack([cells["tetra"][:, f] for f in ([0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2])])
        _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
        skin = first[count == 1]
        surface, part = faces[skin], np.tile(part, 4)[skin]
    else:
        width = max(body.values())
        corners = [np.minimum(np.arange(width), k - 1) for k in body.values()]
        surface = np.vstack([cells[n][:, c] for n, c in zip(body, corners)])
    row_of = dict(zip(mesh.node_ids.tolist(), range(len(mesh.node_ids))))
    lines, nodes, lips = {}, {}, np.empty((0, 2), int)
    for name in mesh.groups:
        group = mesh.groups[name]
        members = group.ids.tolist()
        if group.kind == "node":
            nodes[name] = np.array([row_of[i] for i in members], int)
        elif group.kind == "element" and members and members[0] in rows.get("line", {}):
            lines[name] = np.array([cells["line"][rows["line"][i]][:2] for i in members])
        elif group.kind == "element" and name in ("CRACK_P", "CRACK_N") and members:
            triangles = np.array([cells["triangle"][rows["triangle"][i]][:3] for i in members])
            edges = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
            edges, count = np.unique(edges, axis=0, return_counts=True)
            lips = np.vstack([lips, edges[count == 1]])
    for name in ("CRACK_P", "CRACK_N"):
        lips = np.vstack([lips, lines.get(name, lips[:0])])
    return Mesh(mesh.points, row_of, surface, part, lines, nodes, lips)


def by_node(mesh: Mesh, values: dict[int, np.ndarray]) -> np.ndarray:
    """Results by node number as an array by row; zero where there is none."""
    example = next(iter(values.values()))
    out = np.zeros((len(mesh.points), *np.shape(example)))
    for number, value in values.items():
        row = mesh.row_of.get(number)
        if row is not None:
            out[row] = value
    return out


def _colours(names) -> np.ndarray:
    return (np.array([matplotlib.colors.to_rgb(n) for n in names]) * 255).astype(np.uint8)


def _poly(points, faces=None, lines=None) -> vtk.vtkPolyData:
    poly = vtk.vtkPolyData()
    vtk_points = vtk.vtkPoints()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    poly.SetPoints(vtk_points)
    for nodes, setter in ((faces, poly.SetPolys), (lines, poly.SetLines)):
        if nodes is not None and len(nodes):
            width = nodes.shape[1]
            cells = vtk.vtkCellArray()
            flat = np.column_stack([np.full(len(nodes), width), nodes]).astype(np.int64).ravel()
            cells.SetCells(len(nodes), numpy_to_vtkIdTypeArray(flat, deep=True))
            setter(cells)
    return poly


def _actor(source, colour=None) -> vtk.vtkActor:
    mapper = vtk.vtkPolyDataMapper()
    if isinstance(source, vtk.vtkPolyData):
        mapper.SetInputData(source)
    else:
        mapper.SetInputConnection(source.GetOutputPort())
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    if colour is not None:
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(*matplotlib.colors.to_rgb(colour))
    return actor


def _surface(mesh: Mesh, points, cell_colours=None, node_colours=None, edges=True) -> vtk.vtkActor:
    poly = _poly(points, mesh.surface)
    if cell_colours is not None:
        poly.GetCellData().SetScalars(numpy_to_vtk(cell_colours, deep=True))
    if node_colours is not None:
        poly.GetPointData().SetScalars(numpy_to_vtk(node_colours, deep=True))
    actor = _actor(poly)
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.SetAmbient(0.6)
    look.SetDiffuse(0.45)
    if edges:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(0.27, 0.31, 0.36)
        look.SetLineWidth(1.0)
    return actor


def _tubes(points, lines, colour, radius) -> vtk.vtkActor:
    tube = vtk.vtkTubeFilter()
    tube.SetInputData(_poly(points, lines=lines))
    tube.SetRadius(radius)
    tube.SetNumberOfSides(10)
    return _actor(tube, colour)


def _glyphs(points, source, colour) -> vtk.vtkActor:
    glyph = vtk.vtkGlyph3D()
    glyph.SetInputData(_poly(points))
    glyph.SetSourceConnection(source.GetOutputPort())
    glyph.ScalingOff()
    return _actor(glyph, colour)


def _spheres(points, colour, radius) -> vtk.vtkActor:
    sphere = vtk.vtkSphereSource()
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(14)
    sphere.SetPhiResolution(14)
    return _glyphs(points, sphere, colour)


def _arrows_down(points, colour, length) -> vtk.vtkActor:
    arrow = vtk.vtkArrowSource()
    arrow.SetTipResolution(20)
    arrow.SetShaftResolution(20)
    turn = vtk.vtkTransform()
    turn.Translate(0, 0, length)
    turn.RotateY(90)
    turn.Scale(length, length, length)
    placed = vtk.vtkTransformPolyDataFilter()
    placed.SetTransform(turn)
    placed.SetInputConnection(arrow.GetOutputPort())
    return _glyphs(points, placed, colour)


def _render(actors, size, focus, scale) -> np.ndarray:
    """RGB image of the scene, parallel projection; `scale` is half the height of what is seen, in mm."""
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(np.asarray(focus) + 4000 * DIRECTION / np.linalg.norm(DIRECTION)))
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelScale(scale)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]


WHOLE = {"focus": (600, 220, 215), "scale": 560}
ZOOM = {"focus": HANGER, "scale": 125}


def _mesh_scene(mesh: Mesh, size, marks: float, focus, scale) -> np.ndarray:
    points = mesh.points
    actors = [
        _surface(mesh, points, cell_colours=_colours(PARTS.values())[mesh.part]),
        _tubes(points, mesh.lines["WELD_STIFFENERS"], "#1a1a1a", 3 * marks),
        _tubes(points, mesh.lines["LINE_LOAD"], "#c2185b", 6 * marks),
        _spheres(points[mesh.nodes["SUPPORTS"]], "#c62828", 7 * marks),
        _spheres(points[mesh.nodes["GAUGE_HANGER_1"]], "#2e7d32", 9 * marks),
        _spheres(points[mesh.nodes["GAUGE_FLOOR"]], "#2e7d32", 9 * marks),
        _arrows_down(points[mesh.nodes["POINT_LOAD"]], "#c2185b", 130),
    ]
    if len(mesh.lips):
        actors.append(_tubes(points, mesh.lips, "#d50000", 3 * marks))
    return _render(actors, size, focus, scale)


def _show(axes, image, title) -> None:
    axes.imshow(image)
    axes.set_title(title, fontsize=12, loc="left")
    axes.axis("off")


def mesh_picture(path: Path, title: str, before: Mesh, after: Mesh) -> None:
    """Mesh coloured by group: the whole structure, then the cracked hanger before and after."""
    figure = plt.figure(figsize=(15, 9.2), dpi=100)
    grid = figure.add_gridspec(
        2, 2, width_ratios=[1.75, 1], left=0.01, right=0.99, top=0.9, bottom=0.15, wspace=0.02, hspace=0.08
    )
    _show(
        figure.add_subplot(grid[:, 0]), _mesh_scene(after, (1400, 1060), 1.0, **WHOLE), "Whole structure, crack in red"
    )
    _show(
        figure.add_subplot(grid[0, 1]), _mesh_scene(before, (800, 500), 0.35, **ZOOM), "Hanger of STIFFENER_1, before"
    )
    _show(
        figure.add_subplot(grid[1, 1]),
        _mesh_scene(after, (800, 500), 0.35, **ZOOM),
        "The same after: nodes lie on the crack plane, groups are kept",
    )
    keys = [Patch(facecolor=c, edgecolor="0.3", label=n) for n, c in PARTS.items()]
    keys += [
        Line2D([], [], color="#1a1a1a", lw=3, label="WELD_STIFFENERS (edges)"),
        Line2D([], [], color="#c2185b", lw=4, label="LINE_LOAD (edges)"),
        Line2D([], [], color="#c2185b", marker="v", ls="", ms=9, label="POINT_LOAD (nodes)"),
        Line2D([], [], color="#c62828", marker="o", ls="", ms=8, label="SUPPORTS (nodes)"),
        Line2D([], [], color="#2e7d32", marker="o", ls="", ms=8, label="GAUGE_... (nodes)"),
        Line2D([], [], color="#d50000", lw=3, label="crack: CRACK_P, CRACK_N"),
    ]
    figure.legend(handles=keys, loc="lower center", ncol=5, fontsize=10, frameon=False)
    figure.suptitle(title, fontsize=15, x=0.01, ha="left")
    figure.savefig(path)
    plt.close(figure)


def opened_picture(path: Path, title: str, states, magnification: float, stress_name: str) -> None:
    """Deformed shapes before and after, coloured by von Mises stress.

    `states` holds for before and after: Mesh, displacement (n, 3) in mm, von Mises stress (n,) in MPa.
    """
    # A few nodes in re-entrant corners would take the whole scale.
    top = float(
        np.ceil(max(np.percentile(stress[np.unique(mesh.surface)], 99.8) for mesh, _, stress in states) / 5) * 5
    )
    scenes = []
    for (mesh, displacement, stress), size, view in (
        (states[0], (1200, 860), WHOLE),
        (states[1], (1200, 860), WHOLE),
        (states[1], (900, 1250), ZOOM),
    ):
        colours = (STRESS_MAP(np.clip(stress / top, 0, 1))[:, :3] * 255).astype(np.uint8)
        points = mesh.points + magnification * displacement
        actors = [_surface(mesh, points, node_colours=colours, edges=view is not WHOLE)]
        if len(mesh.lips):
            actors.append(_tubes(points, mesh.lips, "#d50000", 3 if view is WHOLE else 1.2))
        scenes.append(_render(actors, size, **dict(view, scale=190) if view is ZOOM else view))
    figure = plt.figure(figsize=(15, 9.2), dpi=100)
    grid = figure.add_gridspec(
        2, 2, width_ratios=[1.25, 1], left=0.01, right=0.92, top=0.9, bottom=0.02, wspace=0.02, hspace=0.08
    )
    for place, scene, caption in zip(
        (grid[0, 0], grid[1, 0], grid[:, 1]),
        scenes,
        (
            "Before",
            "After: the cracked hanger is idle, its neighbours carry more",
            "After: the crack (lips in red) opens",
        ),
    ):
        _show(figure.add_subplot(place), scene, caption)
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, top), STRESS_MAP)
    bar = figure.colorbar(scale, cax=figure.add_axes((0.935, 0.15, 0.015, 0.6)))
    bar.set_label(f"{stress_name}, MPa", fontsize=12)
    figure.suptitle(f"{title}; displacements magnified {magnification:.0f} times", fontsize=15, x=0.01, ha="left")
    figure.savefig(path)
    plt.close(figure)


def quality_picture(path: Path, title: str, quality) -> None:
    """Histogram of the mean ratio near the crack, before and after; `quality` as in femscalpel.Report."""
    figure, axes = plt.subplots(figsize=(9, 5), dpi=100)
    left = np.arange(20) / 20
    for summary, label, shift, colour in (
        (quality.before, "before", 0.003, "#9db4c8"),
        (quality.after, "after", 0.025, "#e8762c"),
    ):
        axes.bar(
            left + shift,
            summary.histogram,
            0.022,
            align="edge",
            color=colour,
            label=f"{label}: {summary.count} elements, minimum {summary.minimum:.2f}, mean {summary.mean:.2f}",
        )
    axes.set_xlim(0, 1)
    axes.set_xlabel("mean ratio (1: equilateral, 0: flat)")
    axes.set_ylabel("number of elements near the crack")
    axes.legend(loc="upper left", frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_title(title, loc="left")
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)
