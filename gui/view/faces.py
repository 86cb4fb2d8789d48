# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces and edges of a mesh for drawing, by NumPy alone.

Elements count by their corner nodes. A face is a row of four node rows, the last -1 for a triangle.
"""

import numpy as np

from femscalpel.mesh import CELL_TYPES

# Corner nodes of the faces of each shape, VTK's node order.
_FACES = {
    "tetra": ((0, 2, 1, -1), (0, 1, 3, -1), (1, 2, 3, -1), (0, 3, 2, -1)),
    "pyramid": ((0, 1, 4, -1), (1, 2, 4, -1), (2, 3, 4, -1), (3, 0, 4, -1), (0, 3, 2, 1)),
    "wedge": ((0, 1, 2, -1), (3, 5, 4, -1), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    "triangle": ((0, 1, 2, -1),),
    "quad": ((0, 1, 2, 3),),
}
_EDGES = {
    "tetra": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    "pyramid": ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    "wedge": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "hexahedron": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    "triangle": ((0, 1), (1, 2), (2, 0)),
    "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
    "line": ((0, 1),),
}


def shape_of(cell_type):
    """ "tetra" for "tetra10", and so on."""
    return cell_type.rstrip("0123456789")


def corners(cell_type, connectivity):
    """The corner nodes of elements."""
    return connectivity[:, : CELL_TYPES[cell_type][2]]


def faces_of(cell_type, connectivity):
    """Every face of every element of one type: (faces (n, 4), position of the element (n,)), grouped by local face."""
    parts = []
    for local in _FACES[shape_of(cell_type)]:
        face = np.full((len(connectivity), 4), -1, np.int64)
        width = 3 if local[3] < 0 else 4
        face[:, :width] = connectivity[:, local[:width]]
        parts.append(face)
    owner = np.tile(np.arange(len(connectivity)), len(parts))
    return np.concatenate(parts), owner


def edges_of_element(cell_type, nodes):
    """Edges (k, 2) of one element, given its nodes."""
    nodes = np.asarray(nodes)
    return nodes[np.array(_EDGES[shape_of(cell_type)])]


def face_keys(faces, node_count):
    """A number per face that only depends on the set of its nodes. Equal node_count gives comparable keys."""
    ordered = np.sort(faces, axis=1) + 1
    base = node_count + 1
    if base < 2_000_000:
        # Three nodes say which face: in a conforming mesh two different faces never share three.
        return (ordered[:, 1] * base + ordered[:, 2]) * base + ordered[:, 3]
    _, pair = np.unique(ordered[:, 1] * base + ordered[:, 2], return_inverse=True)
    return pair * base + ordered[:, 3]


def once(keys):
    """Mask of the keys that occur exactly once."""
    order = np.argsort(keys, kind="stable")
    ascending = keys[order]
    differs = np.ones(len(keys) + 1, bool)
    np.not_equal(ascending[1:], ascending[:-1], out=differs[1:-1])
    mask = np.zeros(len(keys), bool)
    mask[order[differs[1:] & differs[:-1]]] = True
    return mask


def outer_faces(blocks, node_count):
    """Faces that one element alone has.

    `blocks` is a list of (element type, connectivity). Returns (faces (n, 4), owner (n,)): owner counts through the
    elements of all blocks. Elements of dimension 2 are their own face; those on a face of a solid are left out.
    """
    solids, shells, first = [], [], 0
    for cell_type, connectivity in blocks:
        if CELL_TYPES[cell_type][0] >= 2:
            faces, owner = faces_of(cell_type, connectivity)
            (solids if CELL_TYPES[cell_type][0] == 3 else shells).append((faces, owner + first))
        first += len(connectivity)
    faces, owner = joined(solids)
    keys = face_keys(faces, node_count)
    outer = once(keys)
    shell_faces, shell_owner = joined(shells)
    if len(faces) and len(shell_faces):
        free = ~np.isin(face_keys(shell_faces, node_count), keys)
        shell_faces, shell_owner = shell_faces[free], shell_owner[free]
    return np.concatenate([faces[outer], shell_faces]), np.concatenate([owner[outer], shell_owner])


def joined(parts):
    """Pairs of faces and their owners as one."""
    if not parts:
        return np.empty((0, 4), np.int64), np.empty(0, np.int64)
    return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])


def find(keys, among):
    """Which of `keys` are among others, and where there."""
    if not len(among):
        return np.zeros(len(keys), bool), np.zeros(len(keys), np.int64)
    order = np.argsort(among)
    at = order[np.minimum(np.searchsorted(among[order], keys), len(among) - 1)]
    return among[at] == keys, at


def with_parts(faces):
    """Faces, then the four triangles that each quadrangle may be cut into, whichever way: (faces, row of the face that
    each is or is part of)."""
    quads = np.flatnonzero(faces[:, 3] >= 0)
    parts = [np.column_stack([np.delete(faces[quads], k, axis=1), np.full(len(quads), -1)]) for k in range(4)]
    return np.concatenate([faces, *parts]), np.concatenate([np.arange(len(faces)), np.tile(quads, 4)])


def free_lines(lines, faces, node_count):
    """Mask of the lines (k, 2) that are no edge of a face."""
    if not len(lines):
        return np.zeros(0, bool)
    edges, _ = face_edges(faces)
    lines = np.sort(lines, axis=1)
    base = node_count + 1
    return ~np.isin(lines[:, 0] * base + lines[:, 1], edges[:, 0] * base + edges[:, 1])


def face_edges(faces):
    """Edges of faces: (edges (n, 2) with the smaller node first, face of each (n,))."""
    triangle = faces[:, 3] < 0
    edges, owner = [], []
    for chosen, ring in ((triangle, (0, 1, 2)), (~triangle, (0, 1, 2, 3))):
        rows = np.flatnonzero(chosen)
        for a, b in zip(ring, ring[1:] + ring[:1]):
            edges.append(faces[rows][:, [a, b]])
            owner.append(rows)
    return np.sort(np.concatenate(edges), axis=1), np.concatenate(owner)


def unique_edges(edges, node_count):
    """Every edge once."""
    _, first = np.unique(edges[:, 0] * (node_count + 1) + edges[:, 1], return_index=True)
    return edges[first]


def border_edges(faces, label, node_count):
    """Edges where the label of the faces changes, or where a face ends: (edges (k, 2), (k, 2) faces on both sides).

    The second face is -1 where there is none. Edges with more than two faces are borders.
    """
    edges, owner = face_edges(faces)
    order = np.argsort(edges[:, 0] * (node_count + 1) + edges[:, 1], kind="stable")
    edges, owner = edges[order], owner[order]
    starts = np.ones(len(edges), bool)
    starts[1:] = (edges[1:] != edges[:-1]).any(axis=1)
    first = np.flatnonzero(starts)
    count = np.diff(np.append(first, len(edges)))
    second = np.where(count > 1, owner[np.minimum(first + 1, max(len(edges) - 1, 0))], -1)
    a = owner[first]
    border = (count != 2) | (label[a] != label[second])
    return edges[first][border], np.stack([a, second], axis=1)[border]


def coin_index(faces):
    """Faces as SoIndexedFaceSet.coordIndex wants them, triangles first: (index int32, order of the faces)."""
    triangle = faces[:, 3] < 0
    order = np.concatenate([np.flatnonzero(triangle), np.flatnonzero(~triangle)])
    quads = faces[~triangle]
    closed = np.column_stack([quads, np.full(len(quads), -1)]) if len(quads) else np.empty(0, np.int64)
    return np.concatenate([faces[triangle].ravel(), closed.ravel()]).astype(np.int32), order


def compact(rows, points):
    """Renumbers node rows (-1 stays) to those in use: (rows in the new numbering, points in use as float32)."""
    used = np.zeros(len(points) + 1, bool)
    used[rows.ravel()] = True
    used[-1] = False
    number = np.cumsum(used) - 1
    number[-1] = -1
    return number[rows], points[used[:-1]].astype(np.float32)
