# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a group covers: its virtual boundary."""

from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

from . import _arguments, _engine
from .mesh import Mesh, check_mesh


@dataclass(frozen=True, eq=False)
class BoundaryPart:
    """Nodes, edges and faces of a :class:`VirtualBoundary`, by the numbers of their corner nodes (int64).

    An edge or face need not be an element of the mesh. `..._elements` give the number of the element that lies
    on it, the group's own if there is one, and 0 where there is none.
    """

    #: (n,) isolated nodes.
    nodes: np.ndarray
    #: (n, 2)
    edges: np.ndarray
    #: (n, 3)
    triangles: np.ndarray
    #: (n, 4)
    quads: np.ndarray
    #: (n,) element numbers, as `edges`; 0: no element.
    edge_elements: np.ndarray
    #: (n,) as `triangles`.
    triangle_elements: np.ndarray
    #: (n,) as `quads`.
    quad_elements: np.ndarray

    def __len__(self) -> int:
        return len(self.nodes) + len(self.edges) + len(self.triangles) + len(self.quads)

    def __repr__(self) -> str:
        counts = [
            f"{len(getattr(self, name))} {name}"
            for name in ("nodes", "edges", "triangles", "quads")
            if len(getattr(self, name))
        ]
        return f"<BoundaryPart: {', '.join(counts) or 'empty'}>"


@dataclass(frozen=True, eq=False)
class VirtualBoundary:
    """Virtual group boundary of one group; see :func:`virtual_boundary`."""

    #: Name of the group.
    name: str
    #: "node", "element" or "facet".
    kind: str
    #: Bounding elements (BE): faces of a 3-D mesh, normal outwards, or edges of a 2-D mesh, around `enclosed`.
    bounding: BoundaryPart
    #: Linking elements (LE): faces of a 3-D mesh and edges that the group covers outside of `enclosed`.
    linking: BoundaryPart
    #: Isolated elements (IE): nodes that neither has.
    isolated: BoundaryPart
    #: (n,) numbers of the elements of the mesh's dimension inside the bounding elements.
    enclosed: np.ndarray

    def __repr__(self) -> str:
        return (
            f"<VirtualBoundary of {self.kind} group {self.name!r}: bounding {self.bounding!r}, linking "
            f"{self.linking!r}, "
            f"isolated {self.isolated!r}, {len(self.enclosed)} elements enclosed>"
        )


def virtual_boundary(mesh: Mesh, name: str, kind: Optional[str] = None) -> VirtualBoundary:
    """What of the mesh a group covers: its virtual boundary (paper, section 4.2).

    Nodes on it keep to its shape when an operator moves them. What is born inside the bounding elements or on
    linking elements joins the group; nothing joins through isolated ones.

    A node, edge or face *belongs* to a node group if all its corner nodes do; to an element or facet group if
    one of the group's elements or facets lies on it, or, for a face, if all its edges belong. Let d be the mesh's
    dimension.

    - Enclosed is each element of dimension d that is in the group, or whose nodes (faces, edges) all belong.
    - Bounding elements are the faces (d = 3) or edges (d = 2) with enclosed elements on exactly one side.
    - Linking elements are the other faces (d = 3) that belong, unless between enclosed elements; and the
      edges that belong and are on none of these faces and on no enclosed element.
    - Isolated are the group's nodes on none of these.

    Parameters
    ----------
    mesh : Mesh
    name : str
        The group's name.
    kind : "node", "element" or "facet", optional
        Needed when groups of several kinds have this name; without it the first is taken.

    Returns
    -------
    VirtualBoundary

    Raises
    ------
    KeyError
        The mesh has no such group.

    See Also
    --------
    virtual_boundaries : many groups at once, which is faster
    """
    check_mesh(mesh)
    group = mesh._find(_arguments.text(name, "name"), kind)
    return _find(mesh, [(group.name, group.kind)])[0]


def virtual_boundaries(mesh: Mesh, kind: Optional[str] = None) -> Tuple[VirtualBoundary, ...]:
    """:func:`virtual_boundary` of every group, or of every group of one kind, in the mesh's order.

    Costs one pass over the mesh, then for each group only the elements at its nodes.
    """
    check_mesh(mesh)
    return tuple(_find(mesh, [(group.name, group.kind) for group in mesh.groups.all(kind)]))


def _find(mesh: Mesh, groups: list) -> list:
    found = _engine.virtual_boundaries(mesh._engine_mesh, groups)
    return [
        VirtualBoundary(
            name, kind, BoundaryPart(**bounding), BoundaryPart(**linking), BoundaryPart(**isolated), enclosed
        )
        for (name, kind), (bounding, linking, isolated, enclosed) in zip(groups, found)
    ]
