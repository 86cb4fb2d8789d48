#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws virtual_boundary.png: the virtual group boundary in its seven cases, as femscalpel computes it.

    PYTHONPATH=build/release/Mod/FemScalpel python3 resources/docs/virtual_boundary.py [picture]
"""

import itertools
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import femscalpel as fs

AREA, BOUNDING, LINKING, ISOLATED, MEMBER = "#bcd7f0", "#1f5fa8", "#e8762c", "#c01c28", "#222222"


def plate(groups_of):
    """A plate of 5 x 3 squares cut into triangles; node (i, j) has the number 1 + i + 6 j."""
    points = [(i, j, 0) for j in range(4) for i in range(6)]
    triangles = []
    for j, i in itertools.product(range(3), range(5)):
        a = i + 6 * j
        if (i + j) % 2 == 0:
            triangles += [(a, a + 1, a + 7), (a, a + 7, a + 6)]
        else:
            triangles += [(a, a + 1, a + 6), (a + 1, a + 7, a + 6)]
    return make(points, {"triangle": triangles}, groups_of)


def helix(groups_of):
    """Ten tetrahedra in a row: any four consecutive nodes make one, so nodes up to three apart are joined."""
    turn, radius, rise = np.arccos(-2 / 3), 3 * np.sqrt(3) / 10, 1.3 / np.sqrt(10)
    k = np.arange(13)
    points = np.stack([k * rise, radius * np.cos(k * turn), radius * np.sin(k * turn)], axis=1)
    cells = [(a, a + 1, a + 2, a + 3) for a in range(10)]
    return make(points, {"tetra": cells}, groups_of)


def make(points, cells, members):
    """A mesh with the group G: node numbers, or lists of node numbers, each an element to be made if missing."""
    if isinstance(members[0], int):
        return fs.Mesh(points, cells, groups={"G": ("node", members)})
    kind = {2: "line", 3: "triangle", 4: "tetra"}[len(members[0])]
    nodes = [tuple(n - 1 for n in m) for m in members]
    if kind in cells:
        of = {frozenset(c): k for k, c in enumerate(cells[kind], 1)}
        return fs.Mesh(points, cells, groups={"G": ("element", [of[frozenset(n)] for n in nodes])})
    first = 1 + sum(map(len, cells.values()))
    return fs.Mesh(points, {**cells, kind: nodes}, groups={"G": ("element", range(first, first + len(nodes)))})


def seen(points):
    """Points of a solid as seen from the front, a little from above."""
    turn, tilt = np.radians(-12), np.radians(18)
    x, y, z = points.T
    x, y = np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y
    return np.stack([x, np.cos(tilt) * z + np.sin(tilt) * y], axis=1)


def draw(axes, mesh, members, title):
    found = fs.virtual_boundary(mesh, "G")
    solid = mesh.dimension == 3
    points = seen(mesh.points) if solid else mesh.points[:, :2]
    cells = mesh.cells["tetra" if solid else "triangle"]

    def put(collection, numbers, shrink=0.0, **style):
        if len(numbers):
            corners = points[np.asarray(numbers) - 1]
            corners = corners + shrink * (corners.mean(axis=1, keepdims=True) - corners)
            axes.add_collection(collection(corners, **style))

    edges = np.unique(np.sort([e for c in cells for e in itertools.combinations(c, 2)], axis=1), axis=0)
    put(LineCollection, edges + 1, colors="#9a9a9a", linewidths=0.7, zorder=1)
    if solid:
        put(PolyCollection, found.bounding.triangles, facecolors=BOUNDING, alpha=0.18, zorder=2)
        put(PolyCollection, found.bounding.triangles, facecolors="none", edgecolors=BOUNDING, linewidths=1.6, zorder=3)
        put(PolyCollection, found.linking.triangles, facecolors=LINKING, alpha=0.5, zorder=4)
        put(PolyCollection, found.linking.triangles, facecolors="none", edgecolors=LINKING, linewidths=1.6, zorder=4)
    else:
        put(PolyCollection, cells[found.enclosed - 1] + 1, facecolors=AREA, zorder=0)
        put(LineCollection, found.bounding.edges, colors=BOUNDING, linewidths=3.4, zorder=3)
    put(LineCollection, found.linking.edges, colors=LINKING, linewidths=3.4, zorder=5)
    dashed = dict(edgecolors=MEMBER, linewidths=1.2, linestyles="dashed", zorder=7)
    if isinstance(members[0], int):
        axes.scatter(*points[np.array(members) - 1].T, s=24, color=MEMBER, zorder=7)
    elif len(members[0]) == 3:
        put(PolyCollection, members, facecolors="none", shrink=0.2, **dashed)
    elif len(members[0]) == 2:
        put(LineCollection, members, **dashed)
    isolated = points[found.isolated.nodes - 1]
    axes.scatter(*isolated.T, s=170, facecolors="none", edgecolors=ISOLATED, linewidths=2.2, zorder=8)
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0.04)
    axes.autoscale()
    axes.set_title(title, fontsize=11)


def main(path):
    tetrahedron = list(itertools.combinations((1, 2, 3, 4), 3))
    six = list(itertools.combinations((1, 2, 3, 4), 2))
    flat = [
        ("Faces in a 2-D mesh", [(2, 3, 8), (3, 9, 8), (8, 9, 15), (8, 15, 14), (5, 6, 12)]),
        ("Edges in a 2-D mesh", [(8, 9), (9, 15), (15, 8), (19, 20), (20, 21), (21, 22), (6, 12), (12, 18)]),
        ("Nodes in a 2-D mesh (Figure 9: the row on top)", [19, 20, 21, 22, 23, 3, 4, 10, 12]),
    ]
    solid = [
        ("Tetrahedra in a 3-D mesh", [(1, 2, 3, 4), (2, 3, 4, 5), (7, 8, 9, 10)]),
        ("Faces in a 3-D mesh", [*tetrahedron, (6, 7, 8), (7, 8, 10)]),
        ("Edges in a 3-D mesh", [*six, (5, 6), (6, 8), (5, 8), (10, 11), (11, 13)]),
        ("Nodes in a 3-D mesh", [1, 2, 3, 4, 6, 9, 13]),
    ]
    figure = plt.figure(figsize=(13.5, 9.0), dpi=110)
    for k, (title, members) in enumerate(flat):
        axes = figure.add_axes((0.015 + 0.328 * k, 0.67, 0.315, 0.27))
        draw(axes, plate(members), members, title)
    for k, (title, members) in enumerate(solid):
        axes = figure.add_axes((0.01 + 0.495 * (k % 2), 0.355 - 0.29 * (k // 2), 0.485, 0.27))
        draw(axes, helix(members), members, title)
    figure.legend(
        handles=[
            Patch(color=AREA, label="area"),
            Patch(facecolor=BOUNDING, alpha=0.5, label="bounding elements, BE"),
            Patch(facecolor=LINKING, alpha=0.8, label="linking elements, LE"),
            Line2D(
                [],
                [],
                marker="o",
                color="none",
                markeredgecolor=ISOLATED,
                markeredgewidth=2.2,
                markersize=11,
                label="isolated, IE",
            ),
            Line2D([], [], marker="o", color=MEMBER, linestyle="--", markersize=5, label="group members"),
        ],
        loc="lower center",
        ncol=5,
        frameon=False,
        fontsize=11,
    )
    figure.savefig(path, facecolor="white")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("virtual_boundary.png"))
