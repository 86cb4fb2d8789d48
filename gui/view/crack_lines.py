# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the lips and the front of a crack in a finished mesh are, as arrays. Makes no use of FreeCAD and Coin."""

from dataclasses import dataclass

import numpy as np

from femscalpel.mesh import CELL_TYPES

from . import faces as mesh_faces


@dataclass(frozen=True, eq=False)
class CrackShape:
    """Lines are (k, 2, 3) float32 coordinates."""

    outline: np.ndarray  #: around the lip; of a shell the lip itself
    front: np.ndarray  #: where the crack ends inside
    points: np.ndarray  #: (n, 3) of the faces
    faces: np.ndarray  #: of one lip, (m, 4), -1 ends a triangle


def crack_shape(mesh, name, points=None):
    """The CrackShape of the crack with groups of that name, empty where the mesh has none. `points`, (n, 3): in place
    of the mesh's own."""
    points = mesh.points if points is None else points
    lips, lines = _lip(mesh, name + "_P")
    total = mesh.node_count
    front = _members(mesh, name + "_FRONT")
    if len(lips):
        edges, sides = mesh_faces.border_edges(lips, np.zeros(len(lips), np.int64), total)
        edges = edges[sides[:, 1] < 0]
    else:
        edges = lines
    ends = np.zeros(total, bool)
    ends[front] = True
    on_front = ends[edges].all(axis=1) if len(edges) else np.zeros(0, bool)
    coordinates = points[edges].astype(np.float32).reshape(-1, 2, 3)
    rows, used = mesh_faces.compact(lips, points)
    return CrackShape(coordinates[~on_front], coordinates[on_front], used, rows)


def _lip(mesh, name):
    """(faces, lines) of a lip: of elements, or in a solid of the outer faces between the nodes of a group."""
    kinds = [kind for kind in ("element", "node") if (name, kind) in [(g.name, g.kind) for g in mesh.groups.all()]]
    none = np.empty((0, 4), np.int64), np.empty((0, 2), np.int64)
    if not kinds:
        return none
    members = mesh.groups[name, kinds[0]].ids
    cells, ids = mesh.cells, mesh.cell_ids
    if kinds[0] == "element":
        faces, lines = [none[0]], [none[1]]
        for kind, nodes in cells.items():
            chosen = mesh_faces.corners(kind, nodes[np.isin(ids[kind], members)])
            if CELL_TYPES[kind][0] == 2:
                faces.append(mesh_faces.faces_of(kind, chosen)[0])
            elif CELL_TYPES[kind][0] == 1:
                lines.append(chosen)
        return np.concatenate(faces), np.concatenate(lines)
    inside = np.zeros(mesh.node_count + 1, bool)
    inside[:-1] = np.isin(mesh.node_ids, members)
    inside[-1] = True  # of what a triangle lacks
    near = []
    for kind, nodes in cells.items():
        if CELL_TYPES[kind][0] == 3:
            corner_rows = mesh_faces.corners(kind, nodes)
            near.append((kind, corner_rows[inside[corner_rows].sum(axis=1) >= 3]))
    faces, _ = mesh_faces.outer_faces(near, mesh.node_count)
    return faces[inside[faces].all(axis=1)], none[1]


def _members(mesh, name):
    """Rows of the nodes of a front: a group of nodes or of segments."""
    known = [(g.name, g.kind) for g in mesh.groups.all()]
    if (name, "element") in known:
        members = mesh.groups[name, "element"].ids
        found = [nodes[np.isin(mesh.cell_ids[kind], members)].ravel() for kind, nodes in mesh.cells.items()]
        return np.unique(np.concatenate(found)) if found else np.empty(0, np.int64)
    if (name, "node") in known:
        return np.flatnonzero(np.isin(mesh.node_ids, mesh.groups[name, "node"].ids))
    return np.empty(0, np.int64)
