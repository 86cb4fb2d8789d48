# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces inside a mesh: the groups that cover some, and the lips of a crack along them."""

import numpy as np

from femscalpel.mesh import CELL_TYPES

from . import faces as mesh_faces

# Distances computed at a time, and faces of the lips that are looked at near them and far away.
_CHUNK, _NEAR, _FAR = 4_000_000, 3000, 300


def groups_inside(mesh):
    """Names of the groups that cover faces between solids (in a mesh of shells: edges between them): groups of
    elements on them, of facets, or of all their corners."""
    top = max((CELL_TYPES[name][0] for name in mesh.cells), default=0)
    if top < 2:
        return []
    count = mesh.node_count
    inner, keys = _inner(mesh, top, count)
    bulk = np.concatenate([ids for name, ids in mesh.cell_ids.items() if CELL_TYPES[name][0] == top])
    names = []
    for group in mesh.groups.all():
        if group.kind == "node":
            member = np.append(np.isin(mesh.node_ids, group.ids), True)  # the last for -1
            inside = member[inner].all(axis=1).any()
        elif group.kind == "element":
            inside = not np.isin(group.ids, bulk).any() and any(
                np.isin(_keys(name, nodes[np.isin(mesh.cell_ids[name], group.ids)], top, count), keys).any()
                for name, nodes in mesh.cells.items()
                if CELL_TYPES[name][0] == top - 1
            )
        else:
            inside = len(group.ids) > 0
        if inside:
            names.append(group.name)
    return list(dict.fromkeys(names))


def _inner(mesh, top, count):
    """Faces of the solids (edges of the shells) that more than one has, each once, and a number for each."""
    found = [
        mesh_faces.faces_of(name, mesh_faces.corners(name, nodes))[0]
        for name, nodes in mesh.cells.items()
        if CELL_TYPES[name][0] == top
    ]
    found = np.concatenate(found)
    if top == 2:
        found = mesh_faces.face_edges(found)[0]
        keys = found[:, 0] * (count + 1) + found[:, 1]
    else:
        keys = mesh_faces.face_keys(found, count)
    keys, first, times = np.unique(keys, return_index=True, return_counts=True)
    return found[first[times > 1]], keys[times > 1]


def _keys(cell_type, nodes, top, count):
    """The numbers that _inner() gives to the faces or edges that elements are."""
    nodes = mesh_faces.corners(cell_type, nodes)
    if top == 2:
        nodes = np.sort(nodes, axis=1)
        return nodes[:, 0] * (count + 1) + nodes[:, 1]
    return mesh_faces.face_keys(mesh_faces.faces_of(cell_type, nodes)[0], count)


class Lips:
    """In place of a tool for make_preview(): the lips that a crack along faces has made."""

    def __init__(self, mesh, name):
        """`mesh`: what the crack has made, at least the elements at the lips. `name`: of the crack."""
        ids = mesh.groups[name + "_N", "element"].ids
        centres, normals, nodes = [], [], []
        for cell_type, connectivity in mesh.cells.items():
            chosen = connectivity[np.isin(mesh.cell_ids[cell_type], ids)]
            if not len(chosen):
                continue
            corners = mesh_faces.corners(cell_type, chosen)
            nodes.append(np.unique(chosen))
            centres.append(mesh.points[corners].mean(axis=1))
            normals.append(_in_plane(mesh, corners) if corners.shape[1] == 2 else _normals(mesh.points[corners]))
        self._centres, self._normals = np.concatenate(centres), np.concatenate(normals)
        places = mesh.points[np.unique(np.concatenate(nodes))]
        self._places = set(map(tuple, places.tolist()))
        low, high = places.min(axis=0), places.max(axis=0)
        around = 0.2 * np.linalg.norm(high - low)
        self._low, self._high = low - around, high + around

    def distance(self, points):
        """Zero at the nodes of the lips; elsewhere that from the middle of the nearest face, positive on the side that
        the negative lip looks to."""
        points = np.asarray(points, float)
        near = ((points >= self._low) & (points <= self._high)).all(axis=1)
        out = np.empty(len(points))
        out[near], out[~near] = self._signed(points[near], _NEAR), self._signed(points[~near], _FAR)
        for row in np.flatnonzero(near):
            if tuple(points[row].tolist()) in self._places:
                out[row] = 0.0
        return out

    def _signed(self, points, most):
        step = -(-len(self._centres) // most)
        centres, normals = self._centres[::step], self._normals[::step]
        rows = max(_CHUNK // len(centres), 1)
        out = np.empty(len(points))
        for begin in range(0, len(points), rows):
            part = points[begin : begin + rows]
            square = (centres**2).sum(axis=1) - 2 * part @ centres.T  # but for the point's own
            nearest = square.argmin(axis=1)
            offset = part - centres[nearest]
            length = np.linalg.norm(offset, axis=1)
            positive = np.einsum("ij,ij->i", offset, normals[nearest]) > 0
            out[begin : begin + rows] = np.where(positive, length, -length)
        return out


def _normals(corners):
    """Normals of triangles and quadrangles (n, 3 or 4, 3), of any length."""
    if corners.shape[1] == 3:
        return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])


def _in_plane(mesh, edges):
    """Directions across edges of shells, away from the shell that has both nodes."""
    middles = mesh.points[edges].mean(axis=1)
    inside = np.zeros((len(edges), 3))
    key = {tuple(sorted(edge)): k for k, edge in enumerate(edges.tolist())}
    for cell_type, connectivity in mesh.cells.items():
        if CELL_TYPES[cell_type][0] == 2:
            corners = mesh_faces.corners(cell_type, connectivity)
            own, owner = mesh_faces.face_edges(mesh_faces.faces_of(cell_type, corners)[0])
            for row, edge in enumerate(map(tuple, own.tolist())):
                if edge in key:
                    inside[key[edge]] = mesh.points[corners[owner[row]]].mean(axis=0)
    along = mesh.points[edges[:, 1]] - mesh.points[edges[:, 0]]
    out = middles - inside
    return out - along * (np.einsum("ij,ij->i", out, along) / np.einsum("ij,ij->i", along, along))[:, None]
