# SPDX-License-Identifier: LGPL-2.1-or-later
"""The shapes a mesh lies on: which, their faces and edges, and the places on them."""

import FreeCAD
import numpy as np
import Part

_MARGIN = 0.05  # part of FreeCAD's tolerance that is used


def geometry_of(obj):
    """The object whose shape the mesh of `obj` is made from, or None."""
    return next(
        (
            part
            for part in (getattr(obj, name, None) for name in ("Part", "Shape"))
            if getattr(part, "Shape", None) is not None
        ),
        None,
    )


def shapes_of(obj):
    """The shapes the mesh of `obj` lies on, as [(name, shape)], in global coordinates.

    The geometry it is made from, named "", and those faces, edges, vertices and solids of other objects, and vertices
    of the geometry, that the members of an analysis with `obj` or with a mesh it is made from refer to.
    """
    geometry = geometry_of(obj)
    found = {"": geometry.Shape} if geometry is not None else {}
    chain = [getattr(obj, "StandsFor", None) or obj]
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


def name_of(where, shape, kind, index):
    """What messages call a part of a shape: "Face4" of the geometry, "Box.Face4" of another object, "Box.Solid1
    Face4"."""
    if not where or shape.ShapeType == kind:
        return where or f"{kind}{index + 1}"
    return f"{where} {kind}{index + 1}"


class Owners:
    """Finds the owners of parts of shapes: the solids of a face, the faces of an edge."""

    def __init__(self, owned):
        """`owned`: (owner, its parts) pairs."""
        self._by_hash = {}
        for owner, parts in owned:
            for part in parts:
                self._by_hash.setdefault(part.hashCode(), []).append((part, owner))

    def of(self, part):
        """Owners of a part, each once."""
        found = []
        for other, owner in self._by_hash.get(part.hashCode(), ()):
            if part.isSame(other) and not any(owner is known for known in found):
                found.append(owner)
        return found


class Entity:
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


class Face(Entity):
    def __init__(self, name, shape, solids):
        super().__init__(name, shape)
        self.surface = shape.Surface
        #: How many solids it bounds: with one, it is part of the skin.
        self.solids = solids

    def holds(self, points):
        """Boolean array: points that need no look at the shape, as they are on its plane (and came to be inside its
        edges)."""
        if not isinstance(self.surface, Part.Plane):
            return np.zeros(len(points), bool)
        return np.abs((points - self.surface.Position) @ np.array(self.surface.Axis)) < _MARGIN * self.tolerance

    def condition(self, point):
        """(signed distance of `point` from the surface, its normal there)."""
        u, v = self.surface.parameter(FreeCAD.Vector(*point))
        normal = np.array(self.surface.normal(u, v))
        return normal @ (point - np.array(self.surface.value(u, v))), normal


class Edge(Entity):
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


def nearest(start, entities, tools, size):
    """The point near `start` on all entities and tools, or None: an edge alone, or faces by Newton's method."""
    if entities and isinstance(entities[0], Edge):
        place = entities[0].nearest(start, tools[0] if tools else None)
    else:
        place = start.copy()
        for _ in range(30):
            conditions = [face.condition(place) for face in entities] + [
                _condition(tool, place, size) for tool in tools
            ]
            values = np.array([value for value, _ in conditions])
            if np.abs(values).max() < 1e-13 * size:
                break
            step = np.linalg.lstsq(np.array([normal for _, normal in conditions]), -values, rcond=1e-6)[0]
            place += step
            if np.linalg.norm(step) < 1e-15 * size:
                break
    on = all(entity.distance(place) < _MARGIN * entity.tolerance for entity in entities) and all(
        abs(tool.distance(place)[0]) < 1e-9 * size for tool in tools
    )
    return place if on else None


def _condition(tool, point, size):
    """(signed distance from a tool, its gradient)."""
    step = 1e-6 * size
    around = np.concatenate([[point], point + step * np.eye(3), point - step * np.eye(3)])
    distances = tool.distance(around)
    return distances[0], (distances[1:4] - distances[4:]) / (2 * step)
