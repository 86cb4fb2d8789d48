# SPDX-License-Identifier: LGPL-2.1-or-later
"""What geometry of a document says: axes, a radius, an outline. Targets are [(document object, "Face3" or "")]."""

import hashlib
from dataclasses import dataclass

import FreeCAD

_X, _Z = FreeCAD.Vector(1, 0, 0), FreeCAD.Vector(0, 0, 1)


@dataclass(frozen=True)
class Outline:
    """What a sketch encloses: a polygon with `corners`, an ellipse (a circle) with `radii`, or neither; in the axes of
    `placement`, z = 0."""

    placement: FreeCAD.Placement
    corners: tuple = ()
    radii: tuple = ()


@dataclass(frozen=True)
class Axes:
    """Where geometry is, and how it is turned; for what is round its radius, of a sketch its Outline."""

    placement: FreeCAD.Placement
    radius: object = None
    outline: object = None


def name_of(targets):
    """What targets are called: "Box.Face3", "Box.Vertex1, Box.Vertex2"."""
    return ", ".join(
        f"{part.Label.replace(',', ' ')}.{name}" if name else part.Label.replace(",", " ") for part, name in targets
    )


def axes_of(targets):
    """The Axes of a face, edge, datum or sketch, or of one to three vertices, in the document's coordinates.
    ValueError, which says why, where there are no such."""
    if len(targets) > 1 or targets and targets[0][1].startswith("Vertex"):
        return _of_points([_point(*target) for target in targets])
    part, name = targets[0]
    if is_datum(part) and not name:
        outline = outline_of(part) if is_sketch(part) else None
        if outline is not None and (outline.corners or outline.radii):
            return Axes(outline.placement, outline=outline)
        placement = part.getGlobalPlacement()
        if part.isDerivedFrom("App::Line"):
            placement = FreeCAD.Placement(placement.Base, placement.Rotation * FreeCAD.Rotation(_Z, _X))
        return Axes(placement)
    shape = shape_of(part, name)
    if shape is not None and shape.ShapeType == "Face":
        return _of_face(shape)
    if shape is not None and shape.ShapeType == "Edge":
        return _of_edge(shape)
    raise ValueError("it is no face, edge, vertex, datum or sketch")


def topology_of(targets):
    """A digest that is the same as long as the names of the faces, edges and vertices of the targets mean the same:
    of how many and what kinds the parts have, in order. Empty where no name is in use."""
    digest = hashlib.blake2b(digest_size=8)
    named = [part for part, name in targets if name]
    for part in dict.fromkeys(named):
        shape = getattr(part, "Shape", None)
        if shape is None or shape.isNull():
            continue
        faces = [(type(face.Surface).__name__, len(face.Edges), face.Orientation) for face in shape.Faces]
        edges = [_kind(edge) for edge in shape.Edges]
        digest.update(repr((part.Name, faces, edges, len(shape.Vertexes))).encode())
    return digest.hexdigest() if named else ""


def is_sketch(obj):
    """Whether a document object is a sketch."""
    return obj.isDerivedFrom("Sketcher::SketchObject")


def is_datum(obj):
    """Whether a document object is a plane, a line or a sketch, which has axes as a whole."""
    return is_sketch(obj) or any(
        obj.isDerivedFrom(kind) for kind in ("PartDesign::Plane", "App::Plane", "PartDesign::Line", "App::Line")
    )


def global_of(obj):
    """Takes what is given in the object's parent's coordinates, as its shape is, to the document's."""
    return (
        obj.getGlobalPlacement().multiply(obj.Placement.inverse()) if hasattr(obj, "Placement") else FreeCAD.Placement()
    )


def shape_of(part, name):
    """The face, edge or vertex `name` of a document object, or its only face or edge, in the document's coordinates.
    None where a whole object has no such; ValueError where it has no element of that name."""
    shape = getattr(part, "Shape", None)
    if shape is None or shape.isNull():
        return None
    if name:
        try:
            shape = shape.getElement(name)
        except Exception:  # of another type in each version of FreeCAD
            raise ValueError(f"'{part.Label}' has no {name}") from None
        if shape is None or shape.isNull():
            raise ValueError(f"'{part.Label}' has no {name}")
    elif len(shape.Faces) == 1:
        shape = shape.Faces[0]
    elif not shape.Faces and len(shape.Edges) == 1:
        shape = shape.Edges[0]
    else:
        return None
    shape = shape.copy()
    shape.Placement = global_of(part).multiply(shape.Placement)
    return shape


def outline_of(sketch):
    """What the lines of a sketch enclose, as Outline; an empty one where they are no closed polygon, circle or
    ellipse."""
    wires = sketch.Shape.Wires
    if len(wires) != 1 or not wires[0].isClosed():
        return Outline(sketch.getGlobalPlacement())
    edges = wires[0].OrderedEdges
    kinds = {type(edge.Curve).__name__ for edge in edges}
    axes = sketch.getGlobalPlacement().Rotation
    if kinds <= {"Line", "LineSegment"} and len(edges) > 2:
        corners = [global_of(sketch).multVec(vertex.Point) for vertex in wires[0].OrderedVertexes]
        middle = FreeCAD.Placement(sum(corners, FreeCAD.Vector()) / len(corners), axes)
        return Outline(middle, corners=tuple(middle.inverse().multVec(corner) for corner in corners))
    if len(edges) == 1 and kinds <= {"Circle", "Ellipse"}:
        curve = edges[0].Curve
        centre = global_of(sketch).multVec(curve.Center)
        if kinds == {"Circle"}:
            return Outline(FreeCAD.Placement(centre, axes), radii=(curve.Radius, curve.Radius))
        along = global_of(sketch).Rotation.multVec(curve.XAxis)
        rotation = FreeCAD.Rotation(along, FreeCAD.Vector(), axes.multVec(_Z), "ZXY")
        return Outline(FreeCAD.Placement(centre, rotation), radii=(curve.MajorRadius, curve.MinorRadius))
    return Outline(sketch.getGlobalPlacement())


def _kind(edge):
    try:
        return type(edge.Curve).__name__
    except TypeError:  # it has none, such as that at a cone's tip
        return ""


def _point(part, name):
    shape = shape_of(part, name)
    if shape is None or shape.ShapeType != "Vertex":
        raise ValueError(f"'{part.Label}' {name} is no vertex")
    return shape.Point


def _of_points(points):
    if len(points) == 1:
        return Axes(FreeCAD.Placement(points[0], FreeCAD.Rotation()))
    along = points[1] - points[0]
    if len(points) == 2:
        if not along.Length > 0:
            raise ValueError("its two points are in one place")
        return Axes(FreeCAD.Placement(points[0], FreeCAD.Rotation(_Z, along)))
    normal = along.cross(points[2] - points[0])
    if normal.Length <= 1e-9 * max(along.Length, (points[2] - points[0]).Length) ** 2:
        raise ValueError("its three points lie on a line")
    return Axes(FreeCAD.Placement(points[0], FreeCAD.Rotation(along, FreeCAD.Vector(), normal, "ZXY")))


def _of_face(face):
    surface = face.Surface
    if "Plane" in type(surface).__name__:
        centre = face.CenterOfMass
        normal = face.normalAt(*surface.parameter(centre))
        along = surface.value(1, 0) - surface.value(0, 0)
        return Axes(FreeCAD.Placement(centre, FreeCAD.Rotation(along, FreeCAD.Vector(), normal, "ZXY")))
    if hasattr(surface, "Axis") and hasattr(surface, "Center"):
        radius = getattr(surface, "Radius", None)
        is_cone = hasattr(surface, "SemiAngle")
        rotation = FreeCAD.Rotation(surface.value(0, 0) - surface.Center, FreeCAD.Vector(), surface.Axis, "ZXY")
        return Axes(FreeCAD.Placement(surface.Center, rotation), None if radius is None or is_cone else float(radius))
    if hasattr(surface, "Center"):  # a sphere
        return Axes(FreeCAD.Placement(surface.Center, FreeCAD.Rotation()), float(surface.Radius))
    raise ValueError("it is a curved face without an axis")


def _of_edge(edge):
    curve = edge.Curve
    if hasattr(curve, "Axis") and hasattr(curve, "Center"):
        radius = getattr(curve, "Radius", None)
        rotation = FreeCAD.Rotation(curve.value(0) - curve.Center, FreeCAD.Vector(), curve.Axis, "ZXY")
        return Axes(FreeCAD.Placement(curve.Center, rotation), None if radius is None else float(radius))
    middle = (edge.FirstParameter + edge.LastParameter) / 2
    return Axes(FreeCAD.Placement(edge.valueAt(middle), FreeCAD.Rotation(_Z, edge.tangentAt(middle))))
