#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws figure_9.png and figure_12.png: what operators do to groups, as femscalpel computes it.

    PYTHONPATH=build/release/Mod/FemScalpel python3 resources/docs/group_borders.py [folder]

The paper's Figure 9: a group of nodes along the border of a shell takes in the node that is born between two of them.
Its Figure 12: the border between two groups of tetrahedra keeps its shape, unless told otherwise. Needs Gmsh.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D

import femscalpel as fs

LEFT, RIGHT, CRACK, MEMBER, ISOLATED = "#bcd7f0", "#f6d9b8", "#c01c28", "#1f5fa8", "#e8762c"

TWO_BOXES = """
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 6, 6, 6};
Box(2) = {6, 0, 0, 6, 6, 6};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Physical Volume("LEFT") = {1};
Physical Volume("RIGHT") = {2};
Mesh.MeshSizeMin = 0.9;
Mesh.MeshSizeMax = 0.9;
"""


def two_boxes():
    """A box of two groups of tetrahedra, LEFT and RIGHT, that meet in the plane x = 6."""
    with tempfile.TemporaryDirectory() as folder:
        geometry, path = Path(folder, "boxes.geo"), Path(folder, "boxes.inp")
        geometry.write_text(TWO_BOXES)
        subprocess.run(["gmsh", "-3", geometry, "-v", "2", "-format", "inp", "-o", path], check=True)
        return fs.read(path)


def skin_on_top(mesh):
    """Corners (n, 3) of the faces on top of the box, and whether they belong to tetrahedra of LEFT."""
    cells = mesh.cells["tetra"]
    left = np.isin(mesh.cell_ids["tetra"], mesh.groups["LEFT", "element"].ids)
    corners = np.concatenate([np.delete(cells, k, axis=1) for k in range(4)])
    on_top = (mesh.points[corners][:, :, 2] > 6 - 1e-9).all(axis=1)
    return mesh.points[corners[on_top]], np.tile(left, 4)[on_top]


def draw_figure_12(path):
    mesh = two_boxes()
    plane = fs.Plane(origin=(6.1, 3, 3), normal=(0.9, 0.45, 0.2))
    hole = fs.Cylinder(origin=(6.8, 3, 0), axis=(0, 0, 1), radius=1.2)
    figure, axes = plt.subplots(2, 2, figsize=(12.5, 10.4), dpi=100)
    for row, (operator, tool) in enumerate(((fs.crack, plane), (fs.drill, hole))):
        for column, (preserve, title) in enumerate(((None, "preserved (the default)"), ((), "preserve=()"))):
            result = operator(mesh, tool, preserve=preserve)
            record = next(g for g in result.report.groups if (g.name, g.kind) == ("LEFT", "element"))
            corners, left = skin_on_top(result.mesh)
            at = axes[row, column]
            for side, colour in ((left, LEFT), (~left, RIGHT)):
                at.add_collection(
                    PolyCollection(corners[side][:, :, :2], facecolors=colour, edgecolors="#777777", linewidths=0.7)
                )
            if operator is fs.crack:
                y = np.array([0.0, 6.0])
                at.plot(6.1 - (0.45 * (y - 3) + 0.2 * 3) / 0.9, y, color=CRACK, linewidth=2.4)
            at.axvline(6, color="black", linewidth=1.0, linestyle=":")
            at.set_xlim(2.2, 9.8)
            at.set_ylim(-0.1, 6.1)
            at.set_aspect("equal")
            at.set_axis_off()
            at.set_title(
                f"{title}: border drift {record.boundary_drift:.2g}\nvolume of LEFT {record.measure_before:.6f} → "
                f"{record.measure_after:.6f}",
                fontsize=12,
            )
    figure.suptitle("A crack (red) and a hole across the border of two groups of tetrahedra, from above", fontsize=13)
    figure.subplots_adjust(left=0.02, right=0.98, top=0.89, bottom=0.02, hspace=0.18, wspace=0.05)
    figure.savefig(path, facecolor="white")


def draw_figure_9(path):
    """A plate of 7 x 3 squares; the nodes of its lower border are the group GN, a node inside is alone in LONE."""
    points = [(i, 0.8 * j, 0) for j in range(4) for i in range(8)]
    triangles = []
    for j in range(3):
        for i in range(7):
            a = i + 8 * j
            triangles += (
                [(a, a + 1, a + 9), (a, a + 9, a + 8)]
                if (i + j) % 2 == 0
                else [(a, a + 1, a + 8), (a + 1, a + 9, a + 8)]
            )
    mesh = fs.Mesh(points, {"triangle": triangles}, groups={"GN": ("node", range(1, 9)), "LONE": ("node", [22])})
    result = fs.crack(mesh, fs.Plane(origin=(3.5, 0, 0), normal=(1, -0.22, 0)))
    figure, both = plt.subplots(2, 1, figsize=(9.0, 7.6), dpi=100)
    for axes, shown, title in (
        (both[0], mesh, "before"),
        (both[1], result.mesh, "after the crack (opened for the picture)"),
    ):
        xy = shown.points[:, :2].copy()
        cells = shown.cells["triangle"]
        if shown is not mesh:
            # Each side away from the crack; a doubled node goes with its elements.
            middle = shown.points[cells].mean(axis=1)
            right = (middle - (3.5, 0, 0)) @ np.array([1, -0.22, 0]) > 0
            xy[np.unique(cells[right])] += (0.12, 0)
            xy[np.unique(cells[~right])] -= (0.12, 0)
        axes.add_collection(PolyCollection(xy[cells], facecolors="#f2f2f2", edgecolors="#888888", linewidths=0.8))
        index = {number: k for k, number in enumerate(shown.node_ids.tolist())}
        for name, colour in (("GN", MEMBER), ("LONE", ISOLATED)):
            at = [index[n] for n in shown.groups[name, "node"].ids.tolist()]
            axes.scatter(*xy[at].T, s=70, color=colour, zorder=5)
        linking = fs.virtual_boundary(shown, "GN", "node").linking.edges
        axes.add_collection(
            LineCollection([[xy[index[n]] for n in edge] for edge in linking.tolist()], colors=MEMBER, linewidths=3.2)
        )
        if shown is mesh:
            for number, label in ((4, "n1"), (5, "n2")):
                axes.annotate(label, xy[index[number]] - (0, 0.34), ha="center", fontsize=12)
            axes.plot([3.5 - 0.22 * 0.2, 3.5 + 0.22 * 2.6], [-0.2, 2.6], color=CRACK, linewidth=1.6, linestyle="--")
        else:
            new = [n for n in shown.groups["GN", "node"].ids.tolist() if n > mesh.node_ids.max()]
            for n in new:
                axes.annotate("joins", xy[index[n]] - (0, 0.34), ha="center", fontsize=12)
        axes.set_title(title, fontsize=12)
        axes.set_xlim(-0.4, 7.4)
        axes.set_ylim(-0.5, 2.7)
        axes.set_aspect("equal")
        axes.set_axis_off()
    figure.legend(
        handles=[
            Line2D(
                [],
                [],
                marker="o",
                color=MEMBER,
                linewidth=3,
                markersize=8,
                label="node group GN and its linking elements",
            ),
            Line2D(
                [],
                [],
                marker="o",
                color="none",
                markerfacecolor=ISOLATED,
                markeredgecolor="none",
                markersize=9,
                label="isolated node of another group: stays, alone",
            ),
            Line2D([], [], color=CRACK, linestyle="--", label="crack"),
        ],
        loc="lower center",
        ncol=3,
        frameon=False,
        fontsize=10,
    )
    figure.subplots_adjust(left=0.02, right=0.98, top=0.95, bottom=0.06, hspace=0.1)
    figure.savefig(path, facecolor="white")


def main(folder):
    draw_figure_9(folder / "figure_9.png")
    draw_figure_12(folder / "figure_12.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
