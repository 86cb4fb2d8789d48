# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exchange with the package meshio, which reads and writes many formats. meshio is needed only here."""

import warnings

import numpy as np

from . import _engine
from .mesh import CELL_TYPES, Mesh, check_mesh

NODE_IDS = "node_ids"
CELL_IDS = "cell_ids"


def from_meshio(source) -> Mesh:
    """A :class:`femscalpel.Mesh` from a ``meshio.Mesh``.

    Point sets become node groups, cell sets element groups. Numbers are taken from the point and cell data
    "node_ids" and "cell_ids" if present, as :func:`to_meshio` leaves them, else they count from 1. Points with two
    coordinates get a third of 0. Raises :class:`femscalpel.Error` for element types femscalpel does not have.
    """
    points = np.asarray(source.points, dtype=float)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    node_ids = np.asarray(source.point_data.get(NODE_IDS, np.arange(1, len(points) + 1)), dtype=np.int64).ravel()
    blocks = [(block.type, np.asarray(block.data)) for block in source.cells]
    sizes = [len(nodes) for _, nodes in blocks]
    if CELL_IDS in source.cell_data:
        ids = [np.asarray(a, dtype=np.int64).ravel() for a in source.cell_data[CELL_IDS]]
    else:
        ids = np.split(np.arange(1, sum(sizes) + 1), np.cumsum(sizes)[:-1]) if blocks else []
    cells, cell_ids = {}, {}
    for (cell_type, nodes), numbers in zip(blocks, ids):
        if cell_type not in CELL_TYPES:
            raise _engine.Error(f"unknown element type {cell_type!r}; known are {', '.join(CELL_TYPES)}")
        cells.setdefault(cell_type, []).append(nodes)
        cell_ids.setdefault(cell_type, []).append(numbers)
    groups = [
        (name, "node", node_ids[np.asarray(members, dtype=np.int64)]) for name, members in source.point_sets.items()
    ]
    for name, parts in source.cell_sets.items():
        members = [numbers[np.asarray(part, dtype=np.int64)] for numbers, part in zip(ids, parts) if part is not None]
        groups.append((name, "element", np.concatenate(members) if members else []))
    return Mesh(
        points,
        {t: np.concatenate(a) for t, a in cells.items()},
        node_ids,
        {t: np.concatenate(a) for t, a in cell_ids.items()},
        groups,
    )


def to_meshio(mesh: Mesh):
    """A ``meshio.Mesh``: node groups as point sets, element groups as cell sets, numbers as point and cell data
    "node_ids" and "cell_ids". Facet groups have no counterpart; they are left out with a Python warning."""
    import meshio

    check_mesh(mesh)
    cells, cell_ids = mesh.cells, mesh.cell_ids
    facets = [group.name for group in mesh.groups.all("facet")]
    if facets:
        warnings.warn(f"meshio has no facet groups; left out: {', '.join(facets)}", stacklevel=2)
    point_sets = {g.name: np.flatnonzero(np.isin(mesh.node_ids, g.ids)) for g in mesh.groups.all("node")}
    cell_sets = {}
    for group in mesh.groups.all("element"):
        members = group.ids
        cell_sets[group.name] = [np.flatnonzero(np.isin(ids, members)) for ids in cell_ids.values()]
    return meshio.Mesh(
        mesh.points.copy(),
        [(t, a.copy()) for t, a in cells.items()],
        point_data={NODE_IDS: mesh.node_ids.copy()},
        cell_data={CELL_IDS: [a.copy() for a in cell_ids.values()]},
        point_sets=point_sets,
        cell_sets=cell_sets,
    )
