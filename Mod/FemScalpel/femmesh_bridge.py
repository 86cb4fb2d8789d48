# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fem.FemMesh to femscalpel.Mesh and back, with the same node and element numbers and groups.

What the two do not share:

- A FemMesh group holds elements of one dimension. An element group of several dimensions becomes one FemMesh group per
  dimension, all of the same name; read back, they are one group again. An empty element group gets the type "All".
- FemMesh has no facet groups, no means to add point (0D) elements and none to add the element types in `NOT_ADDABLE`:
  facet groups and point elements are left out with a warning, the other types raise femscalpel.WriteError.
- FreeCAD's export to CalculiX drops pyramids without a word. In a FemMesh they are hexahedra with a face in one point,
  which that export writes and CalculiX takes as the pyramids they are; read back, such hexahedra are pyramids again.
- FemMesh allows several groups of one name and type; all but the first get a suffix "_2", "_3", ... and a warning.
- FreeCAD itself drops the empty groups of a FemMesh whenever it copies it, for example into a document object, and
  renumbers nodes and elements from 1 when it saves a document.
"""

from collections import deque
from itertools import chain

import FreeCAD
import Fem
import numpy as np

import femscalpel
from femscalpel.mesh import CELL_TYPES

# Position in FemMesh's node list (SMESH's order) of each node of our list (VTK's order). SMESH turns volumes the other
# way round. The tables are their own inverses.
_ORDER = {
    "tetra": (0, 2, 1, 3),
    "tetra10": (0, 2, 1, 3, 6, 5, 4, 7, 9, 8),
    "pyramid": (0, 3, 2, 1, 4),
    "pyramid13": (0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10),
    "wedge": (0, 2, 1, 3, 5, 4),
    "wedge15": (0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13),
    "hexahedron": (0, 3, 2, 1, 4, 7, 6, 5),
    "hexahedron20": (0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17),
}

# A pyramid's nodes as those of a hexahedron whose lower face is its tip: FreeCAD writes the upper face first.
_AS_HEXAHEDRON = {
    "pyramid": ("hexahedron", (4, 4, 4, 4, 3, 2, 1, 0)),
    "pyramid13": ("hexahedron20", (4, 4, 4, 4, 3, 2, 1, 0, 4, 4, 4, 4, 7, 6, 5, 8, 12, 11, 10, 9)),
}
# A face of a hexahedron, and the opposite one so that it turns about the way from there to the first.
_OPPOSITE_FACES = (
    ((4, 5, 6, 7), (0, 1, 2, 3)),
    ((0, 1, 2, 3), (7, 6, 5, 4)),
    ((0, 3, 7, 4), (5, 6, 2, 1)),
    ((1, 2, 6, 5), (0, 3, 7, 4)),
    ((0, 1, 5, 4), (3, 2, 6, 7)),
    ((3, 2, 6, 7), (4, 5, 1, 0)),
)
_HEXAHEDRON_EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]

#: Element types of femscalpel that FemMesh's Python interface cannot add.
NOT_ADDABLE = ("triangle7", "quad9", "wedge18", "hexahedron27")

_GROUP_TYPES = {0: "0DElement", 1: "Edge", 2: "Face", 3: "Volume"}
# Elements handled at a time: their Python objects then stay in the processor's cache and never pile up.
_CHUNK = 4096

_LARGEST_NUMBER = 2**31 - 1

_TYPE_BY_SHAPE = {
    (dimension, nodes): name for name, (dimension, nodes, _) in CELL_TYPES.items() if name not in NOT_ADDABLE
}


def from_femmesh(femmesh):
    """A femscalpel.Mesh with the nodes, elements, numbers and groups of a Fem.FemMesh.

    Coordinates are those of FemMesh.Nodes: with the placement of the mesh object applied, as the user sees them.
    Raises femscalpel.ReadError for elements femscalpel does not have (polygons, polyhedra, ...).
    """
    nodes = femmesh.Nodes
    node_ids = np.fromiter(nodes.keys(), np.int64, len(nodes))
    points = np.fromiter(chain.from_iterable(nodes.values()), np.float64, 3 * len(nodes)).reshape(-1, 3)
    index_of = _index_table(node_ids)

    cells, cell_ids = {}, {}
    for dimension, element_ids in ((1, femmesh.Edges), (2, femmesh.Faces), (3, femmesh.Volumes)):
        for name, connectivity, ids in _elements(femmesh, dimension, element_ids):
            connectivity = _reordered(name, index_of(connectivity))
            for kind, nodes, numbers in _pyramids_apart(name, connectivity, ids):
                if kind in cells:
                    nodes = np.concatenate([cells[kind], nodes])
                    numbers = np.concatenate([cell_ids[kind], numbers])
                cells[kind], cell_ids[kind] = nodes, numbers
    known = {int(i) for ids in cell_ids.values() for i in ids} if _has_point_elements(femmesh) else None
    if known is not None:
        _warn("point (0D) elements of the mesh are left out")
    return femscalpel.Mesh(points, cells, node_ids, cell_ids, _read_groups(femmesh, known))


def to_femmesh(mesh, as_node_groups=(), points=None, into=None, progress=None, tell=None):
    """A Fem.FemMesh with the nodes, elements, numbers and groups of a femscalpel.Mesh.

    `as_node_groups` names element groups whose elements are not added; their nodes form a node group of that name.
    `points`, (n, 3), are used in place of the mesh's own coordinates. `into` is an empty FemMesh to fill in place of a
    new one; progress(fraction) is called now and then, and may raise. See the module's text for what a FemMesh cannot
    hold; tell(sentence) hears of it, FreeCAD's report view where that is None. Raises femscalpel.WriteError.
    """
    say = _warn if tell is None else tell
    cell_ids = mesh.cell_ids
    _check_addable(mesh)
    left_out = [mesh.groups[name, "element"].ids for name in as_node_groups]
    left_out = np.unique(np.concatenate(left_out)) if left_out else np.empty(0, np.int64)

    femmesh = Fem.FemMesh() if into is None else into
    try:
        return _filled(femmesh, mesh, points, left_out, as_node_groups, progress, say)
    except Exception as error:  # FreeCAD's own, or RuntimeError
        if "bad_alloc" not in str(error):
            raise
        largest = max(mesh.node_ids.max(initial=0), *(ids.max(initial=0) for ids in cell_ids.values()), 0)
        raise femscalpel.WriteError(
            f"FreeCAD's mesh does not fit into memory: it takes room for all numbers up to the largest, {largest}. "
            f"Renumber the mesh from 1"
        ) from None


def _filled(femmesh, mesh, points, left_out, as_node_groups, progress, say):
    """The FemMesh, with the nodes, elements but those left out, and groups; see to_femmesh()."""
    cells, cell_ids = mesh.cells, mesh.cell_ids
    done = _Fractions(progress, mesh.node_count + mesh.cell_count)
    x, y, z = (mesh.points if points is None else points).T.tolist()
    numbers = mesh.node_ids.astype(object)  # one Python integer per node, however many elements name it
    for begin in range(0, len(x), _CHUNK):
        part = slice(begin, begin + _CHUNK)
        _for_each(femmesh.addNode, x[part], y[part], z[part], numbers[part])
        done(len(x[part]))
    add = {1: femmesh.addEdge, 2: femmesh.addFace, 3: femmesh.addVolume}
    dimension_of = _Dimensions()
    for name, connectivity in cells.items():
        dimension = CELL_TYPES[name][0]
        ids = cell_ids[name]
        if dimension == 0:
            say(f"{len(ids)} point elements are left out: a FemMesh has no means to add them")
            left_out = np.union1d(left_out, ids)
            continue
        if left_out.size:
            kept = ~np.isin(ids, left_out)
            connectivity, ids = connectivity[kept], ids[kept]
        dimension_of.add(ids, dimension)
        if name in _AS_HEXAHEDRON:
            name, order = _AS_HEXAHEDRON[name]
            connectivity = connectivity[:, order]
        connectivity = _reordered(name, connectivity)
        for begin in range(0, len(ids), _CHUNK):
            part = slice(begin, begin + _CHUNK)
            _for_each(add[dimension], numbers[connectivity[part]].tolist(), ids[part].tolist())
            done(len(ids[part]))

    for group in mesh.groups.all():
        done(0)
        if group.kind == "facet":
            say(f"facet group '{group.name}' is left out: a FemMesh has no groups of element faces")
        elif group.kind == "node":
            _add_group(femmesh, group.name, "Node", group.ids)
        elif group.name in as_node_groups:
            _add_group(femmesh, group.name, "Node", _nodes_of(mesh, group.ids))
        else:
            _add_element_group(femmesh, group.name, group.ids, dimension_of)
    return femmesh


def _index_table(node_ids):
    """A function from node numbers to indices; a flat table where the numbers are dense."""
    if node_ids.size and node_ids.max() < 4 * node_ids.size + 1024:
        table = np.full(int(node_ids.max()) + 1, -1, np.int64)
        table[node_ids] = np.arange(node_ids.size)
        return table.__getitem__
    order = np.argsort(node_ids)
    ascending = node_ids[order]
    return lambda numbers: order[np.searchsorted(ascending, numbers)]


def _elements(femmesh, dimension, element_ids):
    """(type name, node numbers, element numbers) per type among the elements of one dimension."""
    if not element_ids:
        return
    # One Python call per element is what FreeCAD offers; everything else is done on whole arrays.
    ids = np.fromiter(element_ids, np.int64, len(element_ids))
    widths = np.empty(len(ids), np.int64)
    parts = []
    for begin in range(0, len(ids), _CHUNK):
        rows = list(map(femmesh.getElementNodes, element_ids[begin : begin + _CHUNK]))
        widths[begin : begin + len(rows)] = np.fromiter(map(len, rows), np.int64, len(rows))
        parts.append(np.fromiter(chain.from_iterable(rows), np.int64))
    flat = np.concatenate(parts)
    starts = np.cumsum(widths) - widths
    for width in np.unique(widths):
        chosen = widths == width
        name = _TYPE_BY_SHAPE.get((dimension, int(width)))
        if name is None:
            raise femscalpel.ReadError(
                f"element {ids[chosen][0]} of the FemMesh is of dimension {dimension} with {width} nodes, which "
                f"femscalpel "
                "does not have; remesh without polygons, polyhedra or elements with centre nodes"
            )
        if chosen.all():
            yield name, flat.reshape(-1, width), ids
        else:
            yield name, flat[starts[chosen][:, None] + np.arange(width)], ids[chosen]


def _reordered(name, connectivity):
    order = _ORDER.get(name)
    return connectivity if order is None else connectivity[:, order]


def _pyramids_apart(name, connectivity, ids):
    """(type name, nodes, element numbers) of hexahedra with a face in one point, which are pyramids, and the rest."""
    if name not in ("hexahedron", "hexahedron20"):
        return [(name, connectivity, ids)]
    parts, left = [], np.ones(len(ids), bool)
    for face, base in _OPPOSITE_FACES:
        tip = connectivity[:, face]
        chosen = left & (tip == tip[:, :1]).all(axis=1)
        if not chosen.any():
            continue
        left &= ~chosen
        order = [*base, face[0]]
        if name == "hexahedron20":
            side = [next(f for f in face if (f, b) in _HEXAHEDRON_EDGES or (b, f) in _HEXAHEDRON_EDGES) for b in base]
            for a, b in [*zip(base, base[1:] + base[:1]), *zip(base, side)]:
                edge = (a, b) if (a, b) in _HEXAHEDRON_EDGES else (b, a)
                order.append(8 + _HEXAHEDRON_EDGES.index(edge))
        kind = "pyramid" if name == "hexahedron" else "pyramid13"
        parts.append((kind, connectivity[chosen][:, order], ids[chosen]))
    return [(name, connectivity[left], ids[left]), *parts] if left.any() else parts


def _has_point_elements(femmesh):
    return bool(femmesh.getIdByElementType("0DElement"))


def _read_groups(femmesh, known_elements):
    """Groups as (name, kind, numbers), in order; parts of one element group are put together again."""
    groups, parts = {}, set()
    for index in femmesh.Groups:
        name, group_type = femmesh.getGroupName(index), femmesh.getGroupElementType(index)
        members = femmesh.getGroupElements(index)
        if known_elements is not None and group_type != "Node":
            members = [i for i in members if i in known_elements]
        unique = _unused_name(name, group_type, parts)
        if unique != name:
            _warn(f"the mesh has several groups '{name}' of type {group_type}; one is now called '{unique}'")
        parts.add((unique, group_type))
        kind = "node" if group_type == "Node" else "element"
        groups.setdefault((unique, kind), []).append(np.fromiter(members, np.int64, len(members)))
    return [(name, kind, np.concatenate(members)) for (name, kind), members in groups.items()]


def _unused_name(name, group_type, taken):
    candidate, number = name, 2
    while (candidate, group_type) in taken:
        candidate, number = f"{name}_{number}", number + 1
    return candidate


def _check_addable(mesh):
    for name, ids in mesh.cell_ids.items():
        if name in NOT_ADDABLE:
            raise femscalpel.WriteError(
                f"a FemMesh cannot hold the {len(ids)} {name} elements of the mesh (first: {ids[0]})"
            )
        if ids.max() > _LARGEST_NUMBER:
            raise femscalpel.WriteError(
                f"element number {ids.max()} is too large for a FemMesh, which ends at {_LARGEST_NUMBER}"
            )
    if mesh.node_count and mesh.node_ids.max() > _LARGEST_NUMBER:
        raise femscalpel.WriteError(
            f"node number {mesh.node_ids.max()} is too large for a FemMesh, which ends at {_LARGEST_NUMBER}"
        )


class _Fractions:
    """Tells which part of a number is done."""

    def __init__(self, tell, total):
        self._tell, self._done, self._total = tell, 0, max(total, 1)

    def __call__(self, more):
        self._done += more
        if self._tell is not None:
            self._tell(min(1.0, self._done / self._total))


def _for_each(function, *columns):
    deque(map(function, *columns), maxlen=0)


def _nodes_of(mesh, element_ids):
    """Numbers of the nodes of some elements."""
    found = [mesh.cells[name][np.isin(ids, element_ids)].ravel() for name, ids in mesh.cell_ids.items()]
    return mesh.node_ids[np.unique(np.concatenate(found))] if found else np.empty(0, np.int64)


class _Dimensions:
    """Dimensions of elements by number."""

    def __init__(self):
        self._blocks = []
        self._table = None

    def add(self, ids, dimension):
        self._blocks.append((ids, np.full(len(ids), dimension)))
        self._table = None

    def __call__(self, ids):
        """Dimension of each element; 0 for those never added."""
        if self._table is None:
            numbers = np.concatenate([np.empty(0, np.int64)] + [block for block, _ in self._blocks])
            dimensions = np.concatenate([np.empty(0, np.int64)] + [block for _, block in self._blocks])
            order = np.argsort(numbers)
            self._table = numbers[order], dimensions[order]
        numbers, dimensions = self._table
        if not numbers.size:
            return np.zeros(len(ids), np.int64)
        at = np.minimum(np.searchsorted(numbers, ids), numbers.size - 1)
        return np.where(numbers[at] == ids, dimensions[at], 0)


def _add_element_group(femmesh, name, ids, dimension_of):
    dimensions = dimension_of(ids)
    present = [d for d in (1, 2, 3) if (dimensions == d).any()]
    for dimension in present:
        _add_group(femmesh, name, _GROUP_TYPES[dimension], ids[dimensions == dimension])
    if not present:
        _add_group(femmesh, name, "All", ids[:0])


def _add_group(femmesh, name, group_type, ids):
    index = femmesh.addGroup(name, group_type)
    if len(ids):
        femmesh.addGroupElements(index, ids.tolist())


def _warn(message):
    FreeCAD.Console.PrintWarning(f"FemScalpel: {message}.\n")
