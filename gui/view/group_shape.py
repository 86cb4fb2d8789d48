# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a group looks like: the faces, lines and points to draw for it."""

from dataclasses import dataclass

import numpy as np

from femscalpel.mesh import CELL_TYPES

from . import faces as mesh_faces


@dataclass(frozen=True, eq=False)
class GroupShape:
    """Faces (rows of `points`, -1 ends a triangle), lines (k, 2, 3) and points (m, 3)."""

    points: np.ndarray
    faces: np.ndarray
    lines: np.ndarray
    nodes: np.ndarray

    @property
    def is_empty(self):
        """True when there is nothing to see."""
        return not (len(self.faces) or len(self.lines) or len(self.nodes))


def group_shape(mesh, name, kind):
    """The GroupShape of a group of a femscalpel.Mesh; KeyError when there is none."""
    group = mesh.groups[name, kind]
    if kind == "node":
        return nodes_shape(mesh, group.ids)
    if kind == "facet":
        return facets_shape(mesh, group.ids)
    return elements_shape(mesh, group.ids)


def nodes_shape(mesh, ids):
    """The GroupShape of nodes."""
    nodes = mesh.points[np.isin(mesh.node_ids, ids)].astype(np.float32)
    return GroupShape(np.empty((0, 3), np.float32), np.empty((0, 4), np.int64), np.empty((0, 2, 3), np.float32), nodes)


def elements_shape(mesh, ids):
    """The GroupShape of elements: outer faces of solids, faces of shells, lines, points."""
    blocks, lines, nodes = [], [np.empty((0, 2, 3), np.float32)], [np.empty((0, 3), np.float32)]
    cell_ids = mesh.cell_ids
    for cell_type, connectivity in mesh.cells.items():
        chosen = np.isin(cell_ids[cell_type], ids)
        if not chosen.any():
            continue
        dimension = CELL_TYPES[cell_type][0]
        connectivity = mesh_faces.corners(cell_type, connectivity[chosen])
        if dimension >= 2:
            blocks.append((cell_type, connectivity))
        elif dimension == 1:
            lines.append(mesh.points[connectivity].astype(np.float32))
        else:
            nodes.append(mesh.points[connectivity[:, 0]].astype(np.float32))
    faces, _ = mesh_faces.outer_faces(blocks, mesh.node_count)
    rows, points = mesh_faces.compact(faces, mesh.points)
    return GroupShape(points, rows, np.concatenate(lines), np.concatenate(nodes))


def joined(first, second):
    """Two GroupShapes as one."""
    faces = np.where(second.faces < 0, -1, second.faces + len(first.points))
    return GroupShape(
        np.concatenate([first.points, second.points]),
        np.concatenate([first.faces, faces]),
        np.concatenate([first.lines, second.lines]),
        np.concatenate([first.nodes, second.nodes]),
    )


# CalculiX's faces of elements by their corner nodes, in its order; of shells, edges from the third on.
_LOCAL_FACES = {
    "tetra": ((0, 1, 2, -1), (0, 3, 1, -1), (1, 3, 2, -1), (2, 3, 0, -1)),
    "wedge": ((0, 1, 2, -1), (3, 4, 5, -1), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "hexahedron": ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}


def facets_shape(mesh, facets):
    """The GroupShape of facets, (n, 2) element number and local face. Facets of shells are drawn as the element."""
    rows = []
    shells = []
    cell_ids = mesh.cell_ids
    for cell_type, connectivity in mesh.cells.items():
        table = _LOCAL_FACES.get(mesh_faces.shape_of(cell_type))
        ids = cell_ids[cell_type]
        chosen = np.isin(facets[:, 0], ids)
        if not chosen.any():
            continue
        if table is None:
            shells.append(facets[chosen, 0])
            continue
        order = np.argsort(ids)
        at = order[np.searchsorted(ids[order], facets[chosen, 0])]
        local = np.array(table)[facets[chosen, 1] - 1]
        nodes = connectivity[at[:, None], np.maximum(local, 0)]
        rows.append(np.where(local < 0, -1, nodes))
    if shells:
        return elements_shape(mesh, np.concatenate(shells))
    faces = np.concatenate(rows) if rows else np.empty((0, 4), np.int64)
    faces, points = mesh_faces.compact(faces, mesh.points)
    return GroupShape(points, faces, np.empty((0, 2, 3), np.float32), np.empty((0, 3), np.float32))
