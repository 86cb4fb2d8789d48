# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a mesh falls into."""

from dataclasses import dataclass
from typing import List, Tuple

import numpy as np

from . import _engine
from .mesh import Mesh, check_mesh


@dataclass(frozen=True, eq=False)
class Piece:
    """Elements that share nodes, directly or through others, and nothing with the rest of the mesh; see
    :func:`pieces`."""

    dimension: int  #: largest of its elements
    measure: float  #: length, area or volume of those of the largest dimension, in the mesh's unit
    place: Tuple[float, float, float]  #: their centre, weighted by measure
    elements: np.ndarray  #: (n,) int64 element numbers, of all dimensions, ascending
    nodes: np.ndarray  #: (m,) int64 node numbers, ascending
    groups: List[Tuple[str, str]]  #: name and kind of the groups with nodes, elements or facets of it

    def __repr__(self) -> str:
        what = {1: "length", 2: "area", 3: "volume"}[self.dimension]
        return f"<Piece: {len(self.elements)} elements, {what} {self.measure:.6g}>"


def pieces(mesh: Mesh) -> List[Piece]:
    """The pieces a mesh falls into: those of solids first, then by measure, the largest first.

    Every element of dimension 1 or more belongs to one piece, segments (springs, rigid links) too, which join what
    they lead to. Nodes without elements, and with point elements alone, belong to none. Nodes at one place are not one
    node, and what a solver's input ties together besides (equations, contact) does not count.

    Raises TypeError when `mesh` is no :class:`Mesh`.
    """
    found, of_node = _engine.pieces(check_mesh(mesh))
    counts = len(found)
    nodes = _sorted_by_piece(of_node, mesh.node_ids, counts)
    labels, ids = [np.empty(0, np.int64)], [np.empty(0, np.int64)]
    for name, rows in mesh.cells.items():
        if name != "vertex":
            labels.append(of_node[rows[:, 0]])
            ids.append(mesh.cell_ids[name])
    elements = _sorted_by_piece(np.concatenate(labels), np.concatenate(ids), counts)
    return [Piece(elements=e, nodes=n, **fields) for fields, e, n in zip(found, elements, nodes)]


def _sorted_by_piece(labels, ids, count):
    """Of each piece the numbers `ids` that are labelled with it, ascending."""
    order = np.lexsort((ids, labels))
    at = np.searchsorted(labels[order], np.arange(count + 1))
    return [ids[order[at[k] : at[k + 1]]] for k in range(count)]
