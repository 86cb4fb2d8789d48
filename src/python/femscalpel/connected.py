# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a mesh falls into."""

from dataclasses import dataclass
from typing import List, Optional, Sequence, Tuple

import numpy as np

from . import _arguments, _engine
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


def pieces(mesh: Mesh, changed: Optional[Mesh] = None, gone: Sequence[int] = ()) -> List[Piece]:
    """The pieces a mesh falls into: those of solids first, then by measure, the largest first.

    Every element of dimension 1 or more belongs to one piece, segments (springs, rigid links) too, which join what
    they lead to. Nodes without elements, and with point elements alone, belong to none. Nodes at one place are not one
    node, and what a solver's input ties together besides (equations, contact) does not count.

    Parameters
    ----------
    mesh : Mesh
    changed : Mesh, optional
        A part of `mesh` after a change, such as an operator makes with `band_only`: its nodes and elements take the
        place of those of the same number. Of its groups those count that `mesh` has.
    gone : (n,) int array_like
        Numbers of further elements of `mesh` that the change has taken away; with `changed`.

    Raises
    ------
    TypeError, ValueError
        An argument is of another kind, or `gone` is given without `changed`.
    """
    engine_mesh = check_mesh(mesh)
    gone = _arguments.integers(gone, "gone")
    if gone.ndim != 1:
        raise _arguments.about("gone", ValueError("gone must be a one-dimensional array of element numbers"))
    if changed is None and len(gone):
        raise _arguments.about("gone", ValueError("gone needs changed, the part of the mesh after the change"))
    other = None if changed is None else check_mesh(changed, "changed")
    return [Piece(**fields) for fields in _engine.pieces(engine_mesh, other, gone)]
