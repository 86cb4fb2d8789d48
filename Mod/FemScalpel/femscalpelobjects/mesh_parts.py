# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of a femscalpel.Mesh that the document objects look for."""

import numpy as np

import femscalpel
from femscalpel.mesh import CELL_TYPES

#: Faces of a tetrahedron as CalculiX numbers them: corners, then the places of the mid-side nodes among all ten.
TETRA_FACES = np.array(((0, 1, 2, 4, 5, 6), (0, 3, 1, 7, 8, 4), (1, 3, 2, 8, 9, 5), (2, 3, 0, 9, 7, 6)))
#: Corners that the mid-side nodes, which come last, are between.
MID_SIDES = {"triangle6": ((0, 1), (1, 2), (2, 0)), "tetra10": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))}
TETRAS = ("tetra", "tetra10")
TRIANGLES = ("triangle", "triangle6")


def nodes_around(mesh, tools, rings):
    """Boolean array: nodes of the elements that a tool crosses, and of `rings` layers of elements around them."""
    near = np.zeros(mesh.node_count, bool)
    for tool in tools:
        side = tool.distance(mesh.points) > 0
        for nodes in mesh.cells.values():
            above = side[nodes]
            near[nodes[above.any(axis=1) & ~above.all(axis=1)]] = True
    return _with_rings(mesh, near, rings)


def nodes_of_long_edges(mesh, tools, size, gradation, reach, rings):
    """Boolean array: nodes of the elements that femscalpel.refine() divides first, and of `rings` layers around
    them."""
    distance = np.min([np.abs(tool.distance(mesh.points)) for tool in tools], axis=0)
    allowed = size + gradation * np.maximum(0, distance - reach)
    near = np.zeros(mesh.node_count, bool)
    for name, nodes in mesh.cells.items():
        corners = mesh.points[nodes[:, : CELL_TYPES[name][2]]]
        width = np.linalg.norm(np.ptp(corners, axis=1), axis=1)  # no edge is longer
        near[nodes[width > allowed[nodes].min(axis=1)]] = True
    return _with_rings(mesh, near, rings)


def nodes_in_box(mesh, low, high, rings):
    """Boolean array: nodes of the elements that reach into a box with sides along the axes, and of `rings` layers of
    elements around them."""
    near = np.zeros(mesh.node_count, bool)
    for name, nodes in mesh.cells.items():
        corners = mesh.points[nodes[:, : CELL_TYPES[name][2]]]
        reach_in = (corners.max(axis=1) >= low) & (corners.min(axis=1) <= high)
        near[nodes[reach_in.all(axis=1)]] = True
    return _with_rings(mesh, near, rings)


def _with_rings(mesh, near, rings):
    for _ in range(rings):
        touched = near.copy()
        for nodes in mesh.cells.values():
            touched[nodes[near[nodes].any(axis=1)]] = True
        near = touched
    return near


def _rows(ids, wanted):
    """Positions of `wanted` numbers in `ids`; those not there are left out."""
    order = np.argsort(ids)
    at = np.minimum(np.searchsorted(ids[order], wanted), max(len(ids) - 1, 0))
    return (
        (order[at], ids[order][at] == wanted) if len(ids) else (np.zeros(len(wanted), int), np.zeros(len(wanted), bool))
    )


def nodes_of_facets(mesh, facets):
    """Node indices of faces of tetrahedra, with mid-side nodes."""
    found = [np.empty(0, np.int64)]
    for name in TETRAS:
        if name in mesh.cells:
            rows, there = _rows(mesh.cell_ids[name], facets[:, 0])
            corners = TETRA_FACES[facets[there, 1] - 1]
            nodes = mesh.cells[name][rows[there]]
            found.append(np.take_along_axis(nodes, corners if name == "tetra10" else corners[:, :3], axis=1).ravel())
    return np.unique(np.concatenate(found))


def nodes_of_elements(mesh, numbers):
    """Node indices of triangle elements."""
    found = [
        mesh.cells[name][np.isin(mesh.cell_ids[name], numbers)].ravel() for name in TRIANGLES if name in mesh.cells
    ]
    return np.unique(np.concatenate(found)) if found else np.empty(0, np.int64)


def border_nodes(mesh):
    """Boolean array: nodes on edges of only one triangle."""
    border = np.zeros(mesh.node_count, bool)
    edges, mids = [np.empty((0, 2), np.int64)], [np.empty(0, np.int64)]
    for name in TRIANGLES:
        for k, (i, j) in enumerate(MID_SIDES["triangle6"]):
            if name in mesh.cells:
                nodes = mesh.cells[name]
                edges.append(np.sort(nodes[:, [i, j]], axis=1))
                mids.append(nodes[:, 3 + k] if name == "triangle6" else nodes[:, i])
    edges, mids = np.concatenate(edges), np.concatenate(mids)
    _, inverse, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    single = count[inverse.ravel()] == 1
    border[edges[single].ravel()] = True
    border[mids[single]] = True
    return border


def without_skin_elements(mesh):
    """`mesh` without the triangle and segment elements that are faces or edges of its tetrahedra; groups of nothing
    else become groups of their nodes."""
    tetrahedra = [mesh.cells[name][:, :4] for name in TETRAS if name in mesh.cells]
    if not tetrahedra:
        return mesh
    tetrahedra = np.concatenate(tetrahedra)
    parts = {
        1: np.unique(_keys(tetrahedra[:, MID_SIDES["tetra10"]].reshape(-1, 2), mesh.node_count)),
        2: np.unique(_keys(tetrahedra[:, TETRA_FACES[:, :3]].reshape(-1, 3), mesh.node_count)),
    }
    cells, cell_ids, gone, nodes_gone = {}, {}, [], []
    for name, nodes in mesh.cells.items():
        dimension, _, corners = CELL_TYPES[name]
        on = np.zeros(len(nodes), bool)
        if dimension in parts and corners == dimension + 1:
            on = np.isin(_keys(nodes[:, :corners], mesh.node_count), parts[dimension])
        gone += mesh.cell_ids[name][on].tolist()
        nodes_gone += nodes[on].tolist()
        if not on.all():
            cells[name], cell_ids[name] = nodes[~on], mesh.cell_ids[name][~on]
    nodes_of = dict(zip(gone, nodes_gone))
    groups = {}
    for group in mesh.groups.all("node") + mesh.groups.all("element"):
        kind, ids = group.kind, group.ids
        if kind == "element" and np.isin(ids, gone).any():
            ids = np.setdiff1d(group.ids, gone)
            if not len(ids):
                kind, ids = "node", mesh.node_ids[np.unique([n for i in group.ids.tolist() for n in nodes_of[i]])]
        groups[group.name, kind] = np.union1d(groups.get((group.name, kind), ids), ids)
    groups = [(name, kind, ids) for (name, kind), ids in groups.items()]
    return femscalpel.Mesh(mesh.points, cells, mesh.node_ids, cell_ids, groups, name=mesh.name)


def _keys(corners, count):
    """A number for each edge or triangle, the same for the same corners in whatever order."""
    key = np.zeros(len(corners), np.int64)
    for column in np.sort(corners, axis=1).T:
        key = key * count + column
    return key
