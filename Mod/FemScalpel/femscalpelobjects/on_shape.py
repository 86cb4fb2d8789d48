# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keeps the nodes of a mesh on the geometry it was made from, while an operator changes it.

FreeCAD finds the nodes of a load or a support by geometry: those less than the shape's tolerance, mostly 1e-7 mm, from the
face, edge or vertex the constraint refers to. A mesh knows its geometry to the width of its elements only. So a node that
moves or is born on a curved face, or on a face inside the material that no mesh group marks (between two solids), would no
longer be found, and the load, support or material would end there without a message.
"""

import Fem
import FreeCAD
import numpy as np
import Part

import femscalpel
from femscalpel.mesh import CELL_TYPES

# Faces of a tetrahedron as CalculiX numbers them: corners, then the places of the mid-side nodes among all ten.
_TETRA_FACES = np.array(((0, 1, 2, 4, 5, 6), (0, 3, 1, 7, 8, 4), (1, 3, 2, 8, 9, 5), (2, 3, 0, 9, 7, 6)))
# Corners that the mid-side nodes, which come last, are between.
_MID_SIDES = {"triangle6": ((0, 1), (1, 2), (2, 0)), "tetra10": ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))}
_TETRAS = ("tetra", "tetra10")
_TRIANGLES = ("triangle", "triangle6")

_GROUP = "FemScalpel:"  # begins the names of bookkeeping groups
_MARGIN = 0.05  # part of FreeCAD's tolerance that is used
_POOR = 0.3  # mean ratio below which an element must not lose half of its own by putting a node back


def shapes_of(obj):
    """The shapes the mesh of `obj` lies on, as [(name, shape)], in global coordinates.

    The geometry it is made from, named "", and those faces, edges, vertices and solids of other objects, and vertices of the
    geometry, that the members of an analysis with `obj` or with a mesh it is made from refer to.
    """
    geometry = next((part for part in (getattr(obj, name, None) for name in ("Part", "Shape"))
                     if getattr(part, "Shape", None) is not None), None)
    found = {"": geometry.Shape} if geometry is not None else {}
    chain = [obj]
    while getattr(chain[-1], "Source", None) is not None:
        chain.append(chain[-1].Source)
    for analysis in obj.Document.findObjects("Fem::FemAnalysis"):
        if any(mesh in analysis.Group for mesh in chain):
            for member in analysis.Group:
                for part, names in getattr(member, "References", ()):
                    for name in names:
                        if part != geometry or name.startswith("Vertex"):
                            found[f"{part.Name}.{name}"] = element_of(part, name)
    return list(found.items())


def element_of(part, name):
    """The face, edge, vertex or solid `name` of a document object, in global coordinates."""
    from femtools.geomtools import get_element
    return get_element(part, name)


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
    """Boolean array: nodes of the elements that femscalpel.refine() divides first, and of `rings` layers around them."""
    distance = np.min([np.abs(tool.distance(mesh.points)) for tool in tools], axis=0)
    allowed = size + gradation * np.maximum(0, distance - reach)
    near = np.zeros(mesh.node_count, bool)
    for name, nodes in mesh.cells.items():
        corners = mesh.points[nodes[:, :CELL_TYPES[name][2]]]
        width = np.linalg.norm(np.ptp(corners, axis=1), axis=1)  # no edge is longer
        near[nodes[width > allowed[nodes].min(axis=1)]] = True
    return _with_rings(mesh, near, rings)


def _with_rings(mesh, near, rings):
    for _ in range(rings):
        touched = near.copy()
        for nodes in mesh.cells.values():
            touched[nodes[near[nodes].any(axis=1)]] = True
        near = touched
    return near


def bookkeeping_groups(mesh):
    """Names of the groups of `mesh` that an OnShape has made."""
    return [name for name in mesh.groups if name.startswith(_GROUP)]


class OnShape:
    """Which nodes of a mesh lie on which faces and edges of shapes, before and after an operator.

    Parameters
    ----------
    mesh : femscalpel.Mesh
        Gets bookkeeping groups, which the operator carries along; put_back() takes them out of its result.
    shapes : list of (str, Part.Shape)
        As from shapes_of().
    near : (n,) array of bool
        The nodes the operator may move or take as parents of new nodes. Only they are looked at.
    """

    def __init__(self, mesh, shapes, near):
        #: Names of the bookkeeping groups.
        self.group_names = set()
        #: After put_back(): what FreeCAD will not find, as "Face4: 3 nodes are off it by up to 0.2".
        self.lost = []
        self._mesh, self._near, self._shapes = mesh, near, shapes
        self._faces, self._edges, self._vertices = [], [], []
        if shapes and near.any():
            self._find_entities(mesh, shapes, near)
            self._mark_facets(mesh, near)
            self._mark_elements(mesh, near)
            for entity in self._edges + self._vertices:
                self._add_group(entity, "node", entity.nodes)

    # --- before the operator

    def _find_entities(self, mesh, shapes, near):
        finder = Fem.FemMesh()
        for number, point in zip(mesh.node_ids[near].tolist(), mesh.points[near].tolist()):
            finder.addNode(*point, number)
        for where, shape in shapes:
            if shape.ShapeType == "Vertex":
                # A group of one node: operators do not move it.
                vertex = _Entity(where, shape)
                vertex.nodes = finder.getNodesByVertex(shape)
                self._vertices.append(vertex)
                continue
            faces = [_Face(_name(where, shape, "Face", i), face, shape) for i, face in enumerate(shape.Faces)]
            for face in faces:
                face.nodes = finder.getNodesByFace(face.shape)
            for i, shape_edge in enumerate(shape.Edges):
                edge = _Edge(_name(where, shape, "Edge", i), shape_edge, [f for f in faces if f.has(shape_edge)])
                # The seam of a closed face is no line the mesh has to keep.
                if not (len(edge.faces) == 1 and shape_edge.isSeam(edge.faces[0].shape)):
                    edge.nodes = finder.getNodesByEdge(shape_edge)
                    if edge.nodes:
                        self._edges.append(edge)
            self._faces += [face for face in faces if face.nodes]

    def _mark_facets(self, mesh, near):
        """Groups of the faces of tetrahedra that lie on each face: of the skin, or between two solids."""
        rows = [np.empty((0, 5), np.int64)]
        for name in _TETRAS:
            if name in mesh.cells:
                cells = mesh.cells[name][:, :4]
                chosen = np.flatnonzero(near[cells].sum(axis=1) >= 3)
                for face, corners in enumerate(_TETRA_FACES[:, :3]):
                    nodes = np.sort(cells[chosen][:, corners], axis=1)
                    rows.append(np.column_stack([nodes, mesh.cell_ids[name][chosen], np.full(len(chosen), face + 1)]))
        rows = np.concatenate(rows)
        _, first, owners = np.unique(rows[:, :3], axis=0, return_index=True, return_counts=True)
        rows = rows[first]
        for face, lying in zip(self._faces, self._lying_on(rows[:, :3], owners)):
            self._add_group(face, "facet", rows[lying, 3:])

    def _mark_elements(self, mesh, near):
        """Groups of the triangle elements that lie on each face."""
        for name in _TRIANGLES:
            if name in mesh.cells:
                chosen = np.flatnonzero(near[mesh.cells[name][:, :3]].all(axis=1))
                triangles = mesh.cells[name][chosen, :3]
                for face, lying in zip(self._faces, self._lying_on(triangles, None)):
                    self._add_group(face, "element", mesh.cell_ids[name][chosen[lying]])

    def _lying_on(self, triangles, owners):
        """For each face the rows of `triangles` (corner nodes) that lie on it; `owners`: how many tetrahedra each belongs to."""
        lying = []
        for face in self._faces:
            on_face = np.isin(self._mesh.node_ids, face.nodes)
            mask = on_face[triangles].all(axis=1)
            if owners is not None and face.solids == 1:
                mask &= owners == 1
            lying.append(mask)
        lying = np.array(lying).reshape(len(self._faces), len(triangles))
        # A triangle whose corners are on the rim of two faces lies on the one that its middle is near.
        for row in np.flatnonzero(lying.sum(axis=0) > 1):
            candidates = np.flatnonzero(lying[:, row])
            middle = self._mesh.points[triangles[row]].mean(axis=0)
            lying[candidates, row] = False
            lying[min(candidates, key=lambda k: self._faces[k].distance(middle)), row] = True
        return lying

    def _add_group(self, entity, kind, ids):
        if not len(ids):
            return
        name = _GROUP + entity.name
        while any(group.name == name for group in self._mesh.groups.all(kind)) and (name, kind) not in entity.groups:
            name += "'"
        if (name, kind) in entity.groups:
            ids = np.concatenate([self._mesh.groups[name, kind].ids, ids])
            self._mesh.remove_group(name, kind)
        else:
            entity.groups.append((name, kind))
        self._mesh.add_group(name, kind, ids)
        self.group_names.add(name)

    # --- after the operator

    def covers(self, mesh):
        """Whether all nodes that the operator's result has moved, and all around its new nodes, were looked at."""
        if not self._shapes:
            return True
        known, moved, near = self._compared(mesh)
        if (moved & ~near).any():
            return False
        for nodes in mesh.cells.values():
            around_new = nodes[~known[nodes].all(axis=1)]
            if (known[around_new] & ~near[around_new]).any():
                return False
        return True

    def _compared(self, mesh):
        """Boolean arrays for the nodes of the operator's result: was there before, has moved, was looked at before."""
        order = np.argsort(self._mesh.node_ids)
        old_ids = self._mesh.node_ids[order]
        at = order[np.minimum(np.searchsorted(old_ids, mesh.node_ids), len(old_ids) - 1)]
        known = self._mesh.node_ids[at] == mesh.node_ids
        moved = known & (self._mesh.points[at] != mesh.points).any(axis=1)
        return known, moved, known & self._near[at]

    def put_back(self, mesh, tools):
        """Coordinates for the nodes of the operator's result: on the shapes, and on the tools, where they belong.

        Takes the bookkeeping groups out of `mesh`. Nodes that cannot go where they belong without spoiling an element
        stay, and are told in `lost`.
        """
        points = mesh.points.copy()
        if not self.group_names:
            return points
        entities = self._new_members(mesh)
        for group in [g for g in mesh.groups.all() if g.name in self.group_names]:
            mesh.remove_group(group.name, group.kind)

        size = np.ptp(points, axis=0).max()
        changed = np.zeros(mesh.node_count, bool)
        for nodes, places in self._off(points, entities):
            start = points[nodes[0]]
            kept = [tool for tool in tools if abs(tool.distance(start)[0]) < 1e-9 * size]
            place = _nearest(start, places, kept, size)
            if place is not None:
                points[nodes] = place
                changed[nodes] = True
        _carry_mid_sides(mesh, points, changed)
        while True:
            spoilt = _spoilt(mesh, points, changed)
            if not len(spoilt):
                break
            # Copies of a node at the same place go back together.
            places = set(map(tuple, mesh.points[spoilt]))
            back = np.flatnonzero(changed)
            back = back[[tuple(place) in places for place in mesh.points[back]]]
            points[back] = mesh.points[back]
            changed[back] = False
        for entity, nodes in entities:
            off = [d for d in map(entity.distance, points[nodes]) if not d < entity.tolerance]
            if off:
                self.lost.append(f"{entity.name}: {len(off)} node{'s are' if len(off) > 1 else ' is'} off it by up to {max(off):.3g}")
        return points

    def _new_members(self, mesh):
        """[(face or edge, indices of the nodes on it that are new or have moved and are not at once seen to be right)]."""
        known, moved, _ = self._compared(mesh)
        fresh = ~known | moved

        on_face = {}
        for face in self._faces:
            mask = np.zeros(mesh.node_count, bool)
            for name, kind in face.groups:
                ids = mesh.groups[name, kind].ids
                mask[_nodes_of_facets(mesh, ids) if kind == "facet" else _nodes_of_elements(mesh, ids)] = True
            on_face[face] = mask
        border = _border(mesh)
        found = []
        for edge in self._edges:
            mask = np.zeros(mesh.node_count, bool)
            for name, kind in edge.groups:
                mask |= np.isin(mesh.node_ids, mesh.groups[name, kind].ids)
            # Two nodes of a curved edge may also be joined by a chord through the face or the material.
            owners = [on_face[face] for face in edge.faces if face in on_face]
            if len(owners) > 1:
                mask &= np.sum(owners, axis=0) > 1
            elif owners:
                mask &= owners[0] & border
            found.append((edge, mask & fresh))
        found += [(face, mask & fresh) for face, mask in on_face.items()]
        result = []
        for entity, mask in found:
            nodes = np.flatnonzero(mask)
            nodes = nodes[~entity.holds(mesh.points[nodes])]
            if len(nodes):
                result.append((entity, nodes))
        return result

    @staticmethod
    def _off(points, entities):
        """(node indices at one place, what they have to lie on): edges if there are any, else faces."""
        places = {}
        for entity, nodes in entities:
            for node in nodes.tolist():
                where, on = places.setdefault(tuple(points[node]), ([], []))
                if node not in where:
                    where.append(node)
                if entity not in on:
                    on.append(entity)
        for nodes, on in places.values():
            yield nodes, [e for e in on if isinstance(e, _Edge)][:1] or on


def _name(where, shape, kind, index):
    """What messages call a part of a shape: "Face4" of the geometry, "Box.Face4" of another object, "Box.Solid1 Face4"."""
    if not where or shape.ShapeType == kind:
        return where or f"{kind}{index + 1}"
    return f"{where} {kind}{index + 1}"


class _Entity:
    """A face or an edge of a shape, and the nodes of the mesh on it."""

    def __init__(self, name, shape):
        self.name = name
        self.shape = shape
        self.tolerance = shape.Tolerance
        self.nodes = []
        self.groups = []

    def distance(self, point):
        """What FreeCAD measures to decide whether a node is on the shape."""
        return self.shape.distToShape(Part.Vertex(*point))[0]


class _Face(_Entity):
    def __init__(self, name, shape, whole):
        super().__init__(name, shape)
        self.surface = shape.Surface
        #: How many solids it bounds: with one, it is part of the skin.
        self.solids = sum(any(shape.isSame(face) for face in solid.Faces) for solid in whole.Solids)

    def has(self, edge):
        return any(edge.isSame(e) for e in self.shape.Edges)

    def holds(self, points):
        """Boolean array: points that need no look at the shape, as they are on its plane (and came to be inside its edges)."""
        if not isinstance(self.surface, Part.Plane):
            return np.zeros(len(points), bool)
        return np.abs((points - self.surface.Position) @ np.array(self.surface.Axis)) < _MARGIN * self.tolerance

    def condition(self, point):
        """(signed distance of `point` from the surface, its normal there)."""
        u, v = self.surface.parameter(FreeCAD.Vector(*point))
        normal = np.array(self.surface.normal(u, v))
        return normal @ (point - np.array(self.surface.value(u, v))), normal


class _Edge(_Entity):
    def __init__(self, name, shape, faces):
        super().__init__(name, shape)
        self.curve = shape.Curve
        self.faces = faces

    def holds(self, points):
        """Boolean array: points that need no look at the shape, as they are on its line."""
        if not isinstance(self.curve, Part.Line):
            return np.zeros(len(points), bool)
        along = np.array(self.curve.Direction)
        offset = points - np.array(self.curve.Location)
        return np.linalg.norm(offset - np.outer(offset @ along, along), axis=1) < _MARGIN * self.tolerance

    def nearest(self, point, tool):
        """The point of the curve near `point`, where it meets the tool if one is given; None if that is not found."""
        u = self.curve.parameter(FreeCAD.Vector(*point))
        if tool is not None:
            step = 1e-6 * (self.shape.LastParameter - self.shape.FirstParameter)
            for _ in range(30):
                here, there = (tool.distance(np.array(self.curve.value(t)))[0] for t in (u, u + step))
                if here == there:
                    break
                correction = here * step / (there - here)
                u -= correction
                if abs(correction) < 1e-3 * step * 1e-6:
                    break
        return np.array(self.curve.value(u))


def _nearest(start, entities, tools, size):
    """The point near `start` on all entities and tools, or None: an edge alone, or faces by Newton's method."""
    if isinstance(entities[0], _Edge):
        place = entities[0].nearest(start, tools[0] if tools else None)
    else:
        place = start.copy()
        for _ in range(30):
            conditions = [face.condition(place) for face in entities] + [_condition(tool, place, size) for tool in tools]
            values = np.array([value for value, _ in conditions])
            if np.abs(values).max() < 1e-13 * size:
                break
            step = np.linalg.lstsq(np.array([normal for _, normal in conditions]), -values, rcond=1e-6)[0]
            place += step
            if np.linalg.norm(step) < 1e-15 * size:
                break
    on = all(entity.distance(place) < _MARGIN * entity.tolerance for entity in entities) and \
        all(abs(tool.distance(place)[0]) < 1e-9 * size for tool in tools)
    return place if on else None


def _condition(tool, point, size):
    """(signed distance from a tool, its gradient)."""
    step = 1e-6 * size
    around = np.concatenate([[point], point + step * np.eye(3), point - step * np.eye(3)])
    distances = tool.distance(around)
    return distances[0], (distances[1:4] - distances[4:]) / (2 * step)


def _rows(ids, wanted):
    """Positions of `wanted` numbers in `ids`; those not there are left out."""
    order = np.argsort(ids)
    at = np.minimum(np.searchsorted(ids[order], wanted), max(len(ids) - 1, 0))
    return (order[at], ids[order][at] == wanted) if len(ids) else (np.zeros(len(wanted), int), np.zeros(len(wanted), bool))


def _nodes_of_facets(mesh, facets):
    """Node indices of faces of tetrahedra, with mid-side nodes."""
    found = [np.empty(0, np.int64)]
    for name in _TETRAS:
        if name in mesh.cells:
            rows, there = _rows(mesh.cell_ids[name], facets[:, 0])
            corners = _TETRA_FACES[facets[there, 1] - 1]
            nodes = mesh.cells[name][rows[there]]
            found.append(np.take_along_axis(nodes, corners if name == "tetra10" else corners[:, :3], axis=1).ravel())
    return np.unique(np.concatenate(found))


def _nodes_of_elements(mesh, numbers):
    """Node indices of triangle elements."""
    found = [mesh.cells[name][np.isin(mesh.cell_ids[name], numbers)].ravel() for name in _TRIANGLES if name in mesh.cells]
    return np.unique(np.concatenate(found)) if found else np.empty(0, np.int64)


def _border(mesh):
    """Boolean array: nodes on edges of only one triangle."""
    border = np.zeros(mesh.node_count, bool)
    edges, mids = [np.empty((0, 2), np.int64)], [np.empty(0, np.int64)]
    for name in _TRIANGLES:
        for k, (i, j) in enumerate(_MID_SIDES["triangle6"]):
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


def _carry_mid_sides(mesh, points, changed):
    """Mid-side nodes that have not been put anywhere themselves go half the way with their corners."""
    for name, edges in _MID_SIDES.items():
        nodes = mesh.cells.get(name)
        if nodes is None:
            continue
        nodes = nodes[changed[nodes].any(axis=1)]
        shift = points - mesh.points
        for middle, (i, j) in enumerate(edges, start=nodes.shape[1] - len(edges)):
            moving = ~changed[nodes[:, middle]] & (changed[nodes[:, i]] | changed[nodes[:, j]])
            middles = nodes[moving, middle]
            points[middles] = mesh.points[middles] + (shift[nodes[moving, i]] + shift[nodes[moving, j]]) / 2
    changed |= (points != mesh.points).any(axis=1)


def _spoilt(mesh, points, changed):
    """Indices of changed nodes to put back: of each element that is inverted or much worse at `points` than at mesh.points,
    the one that moved most."""
    shift = np.linalg.norm(points - mesh.points, axis=1)
    spoilt = []
    for name in _TETRAS + _TRIANGLES:
        if name not in mesh.cells:
            continue
        nodes = mesh.cells[name]
        nodes = nodes[changed[nodes].any(axis=1)]
        before, after = (_quality(name, p[nodes]) for p in (mesh.points, points))
        bad = nodes[(after < 0.5 * before) & (after < _POOR)]
        spoilt.append(bad[np.arange(len(bad)), shift[bad].argmax(axis=1)])
    return np.unique(np.concatenate(spoilt)) if spoilt else np.empty(0, np.int64)


def _quality(name, points):
    """Mean ratio of the corners of elements, shape (m, k, 3); 0 for quadratic ones inverted at an integration point."""
    corners = points[:, :4 if name in _TETRAS else 3]
    ids = np.arange(corners.shape[0] * corners.shape[1]).reshape(corners.shape[:2])
    linear = femscalpel.Mesh(corners.reshape(-1, 3), {"tetra" if name in _TETRAS else "triangle": ids})
    quality, = femscalpel.mean_ratio(linear).values() if len(ids) else (np.empty(0),)
    if name == "tetra10" and len(ids):
        quality = np.where(_jacobians(points).min(axis=1) > 0, quality, 0)
    return quality


def _jacobians(points):
    """Determinants at the four integration points of quadratic tetrahedra, shape (m, 4)."""
    result = []
    for b in 0.1381966011250105 + 0.4472135954999579 * np.eye(4):
        gradient = np.zeros((10, 4))  # of the shape functions, by barycentric coordinate
        gradient[:4] = np.diag(4 * b - 1)
        for k, (i, j) in enumerate(_MID_SIDES["tetra10"]):
            gradient[4 + k, i], gradient[4 + k, j] = 4 * b[j], 4 * b[i]
        by_corner = np.einsum("nc,mnx->mcx", gradient, points)
        result.append(np.linalg.det(by_corner[:, 1:] - by_corner[:, :1]))
    return np.array(result).T
