# SPDX-License-Identifier: LGPL-2.1-or-later
"""The demo's caisson: geometry and groups of caisson.geo, meshed by Gmsh, as plain NumPy arrays."""

from dataclasses import dataclass, field
from pathlib import Path

import gmsh
import numpy as np

GEOMETRY = Path(__file__).with_name("caisson.geo")

# Physical groups of caisson.geo that stand for their nodes.
NODE_GROUPS = ("SUPPORT", "POINT", "GAUGE")

# Gmsh's element types: name as in meshio, and Gmsh's node order in terms of meshio's (and VTK's).
TYPES = {
    1: ("line", [0, 1]),
    2: ("triangle", [0, 1, 2]),
    3: ("quad", [0, 1, 2, 3]),
    4: ("tetra", [0, 1, 2, 3]),
    8: ("line3", [0, 1, 2]),
    9: ("triangle6", [0, 1, 2, 3, 4, 5]),
    16: ("quad8", [0, 1, 2, 3, 4, 5, 6, 7]),
    11: ("tetra10", [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
}


@dataclass
class Model:
    """A mesh as it comes from the mesher. Node number = row of `points` + 1."""

    points: np.ndarray  # (n, 3), mm
    cells: dict[str, np.ndarray]  # meshio type -> (m, k) rows of `points`
    cell_ids: dict[str, np.ndarray]  # meshio type -> (m,) element numbers
    groups: dict[str, tuple[str, np.ndarray]] = field(default_factory=dict)  # name -> (kind, numbers)


def make_model(solid: bool, size: float, order: int, quadrangles: bool = False) -> Model:
    """Meshes the caisson with element size `size` in mm: tetrahedra if `solid`, else shell triangles, or `quadrangles`
    with a triangle here and there."""
    arguments = ["gmsh", "-v", "2"]
    for name, value in (("solid", int(solid)), ("size", size), ("order", order)):
        arguments += ["-setnumber", name, str(value)]
    gmsh.initialize(arguments)
    try:
        gmsh.open(str(GEOMETRY))
        gmsh.option.setNumber("Mesh.RecombineAll", int(quadrangles))
        gmsh.option.setNumber("Mesh.SecondOrderIncomplete", int(quadrangles))  # eight nodes, not nine
        gmsh.model.mesh.generate(3 if solid else 2)
        return _from_gmsh()
    finally:
        gmsh.finalize()


def _from_gmsh() -> Model:
    tags, points, _ = gmsh.model.mesh.getNodes()
    row_of = np.zeros(int(tags.max()) + 1, np.int64)
    row_of[tags.astype(np.int64)] = np.arange(len(tags))
    blocks: dict[str, list[np.ndarray]] = {}
    numbers: dict[str, list[np.ndarray]] = {}
    number_of: dict[int, int] = {}  # Gmsh's element tag -> element number
    groups: dict[str, tuple[str, np.ndarray]] = {}
    # Numbers run from 1 through volumes, then faces, then edges; only elements of a group or of the body are kept.
    physical = sorted(gmsh.model.getPhysicalGroups(), key=lambda group: (-group[0], group[1]))
    for dim, tag in physical:
        name = gmsh.model.getPhysicalName(dim, tag)
        if name.startswith(NODE_GROUPS):
            nodes = gmsh.model.mesh.getNodesForPhysicalGroup(dim, tag)[0].astype(np.int64)
            groups[name] = ("node", np.unique(row_of[nodes]) + 1)
            continue
        members: list[int] = []
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, tag):
            for kind, cell_tags, nodes in zip(*gmsh.model.mesh.getElements(dim, entity)):
                cell_tags = cell_tags.astype(np.int64)
                if int(cell_tags[0]) not in number_of:
                    type_name, sequence = TYPES[int(kind)]
                    rows = row_of[nodes.astype(np.int64)].reshape(-1, len(sequence))[:, sequence]
                    first = len(number_of) + 1
                    number_of.update(zip(cell_tags.tolist(), range(first, first + len(rows))))
                    blocks.setdefault(type_name, []).append(rows)
                    numbers.setdefault(type_name, []).append(np.arange(first, first + len(rows)))
                members += [number_of[t] for t in cell_tags.tolist()]
        groups[name] = ("element", np.unique(np.array(members, np.int64)))
    return Model(
        points=np.ascontiguousarray(points.reshape(-1, 3)),
        cells={k: np.vstack(v) for k, v in blocks.items()},
        cell_ids={k: np.concatenate(v) for k, v in numbers.items()},
        groups=groups,
    )
