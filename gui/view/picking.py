# SPDX-License-Identifier: LGPL-2.1-or-later
"""From clicks in the 3-D view, or in the tree, to a plane or an axis.

Each function takes Clicks and raises PickError, which says what to pick instead.
"""

import math
import re
from dataclasses import dataclass, field

import FreeCAD
import numpy as np

from femscalpelobjects.picked_geometry import axes_of, is_datum, is_sketch, outline_of, shape_of

from ..translate import translate

_Z = FreeCAD.Vector(0, 0, 1)


class PickError(ValueError):
    """The selection does not say what is needed; the text is for the user."""


@dataclass(frozen=True)
class Picked:
    """A point and a direction; for an axis also a radius, None where nothing says one; of a sketch its Outline; for a
    tool its further lengths and angles by what femscalpel.tools asks them as; and what it can follow, see
    targets_of()."""

    origin: FreeCAD.Vector
    direction: FreeCAD.Vector
    radius: object = None
    outline: object = None
    values: dict = field(default_factory=dict)
    targets: tuple = ()


@dataclass(frozen=True)
class Click:
    """An object, what of it was clicked at ("Face3", "Node12", "Elem7F2" or ""), and where."""

    obj: object
    name: str
    point: FreeCAD.Vector

    @property
    def on_mesh(self):
        """Whether it was a FEM mesh."""
        return self.obj.isDerivedFrom("Fem::FemMeshObject")


def node_at(click, source):
    """Number and place of the mesh node a click means, None when it was not on a mesh.

    A click on an element or one of its edges counts as one on the nearest of the nodes there.
    """
    if not click.on_mesh:
        return None
    femmesh = click.obj.FemMesh
    node = re.fullmatch(r"Node(\d+)", click.name)
    if node:
        number = int(node[1])
        return (number, FreeCAD.Vector(femmesh.getNodeById(number))) if number in femmesh.Nodes else None
    element = re.fullmatch(r"Elem(\d+)F\d+", click.name)
    if element:
        corners = femmesh.getElementNodes(int(element[1]))
        number = min(corners, key=lambda n: femmesh.getNodeById(n).distanceToPoint(click.point))
        return number, FreeCAD.Vector(femmesh.getNodeById(number))
    if source is None:
        return None
    rows = np.unique(source.skin[source.skin >= 0])
    row = rows[np.argmin(((source.points[rows] - np.array(click.point)) ** 2).sum(axis=1))]
    return int(source.mesh.node_ids[row]), FreeCAD.Vector(*source.points[row])


def plane_through(points):
    """The plane through three points as Picked; PickError when they are on a line."""
    a, b, c = points
    normal = (b - a).cross(c - a)
    if normal.Length <= 1e-9 * max((b - a).Length, (c - a).Length) ** 2:
        raise PickError(translate("FemScalpel", "The three nodes lie on a line. Pick nodes that span a plane."))
    return Picked(a, normal.normalize())


def axis_through(points):
    """The axis through two points as Picked."""
    a, b = points
    return Picked(a, (b - a).normalize())


def plane(click, source):
    """The plane that a face, edge, datum, sketch or mesh face says."""
    if click.on_mesh:
        return _mesh_face(click, source)
    datum, shape = _of_document(click, _pick_plane)
    if datum is not None:
        return datum
    if shape.ShapeType == "Face":
        if "Plane" not in type(shape.Surface).__name__:
            raise PickError(translate("FemScalpel", "That face is curved. Pick a planar face."))
        return Picked(shape.CenterOfMass, _normal(shape, shape.CenterOfMass))
    if shape.ShapeType == "Edge":
        kind = type(shape.Curve).__name__
        if kind in ("Circle", "Ellipse", "ArcOfCircle"):
            return Picked(shape.Curve.Center, shape.Curve.Axis)
        at = (shape.FirstParameter + shape.LastParameter) / 2
        return Picked(shape.valueAt(at), shape.tangentAt(at))
    raise PickError(_pick_plane())


def axis(click, source):
    """The axis that a cylindrical face, an edge, a datum line or a face at the clicked point says."""
    if click.on_mesh:
        return Picked(click.point, _mesh_face(click, source).direction)
    # An edge of a sketch is meant itself.
    datum, shape = (None, _shape(click)) if is_sketch(click.obj) and click.name else _of_document(click, _pick_axis)
    if datum is not None:
        return datum
    if shape.ShapeType == "Face":
        surface = shape.Surface
        if hasattr(surface, "Axis") and hasattr(surface, "Radius"):
            return Picked(surface.Center, surface.Axis, float(surface.Radius))
        return Picked(click.point, _normal(shape, click.point))
    if shape.ShapeType == "Edge":
        curve = shape.Curve
        if hasattr(curve, "Axis") and hasattr(curve, "Radius"):
            return Picked(curve.Center, curve.Axis, float(curve.Radius))
        if "Line" not in type(curve).__name__:
            raise PickError(translate("FemScalpel", "That edge is curved. Pick a straight or a circular edge."))
        return Picked(shape.valueAt(shape.FirstParameter), shape.tangentAt(shape.FirstParameter))
    raise PickError(_pick_axis())


def tool(click, source):
    """As axis(), and what the face of a torus or cone says more."""
    shape = None if click.on_mesh or is_sketch(click.obj) else _shape(click)
    surface = shape.Surface if shape is not None and shape.ShapeType == "Face" else None
    if hasattr(surface, "MinorRadius") and hasattr(surface, "Center"):
        values = {"tube_radius": float(surface.MinorRadius)}
        return Picked(surface.Center, surface.Axis, float(surface.MajorRadius), values=values)
    if hasattr(surface, "SemiAngle"):
        slope = math.tan(surface.SemiAngle)
        centre, radius = surface.Center, float(surface.Radius)
        if radius < 1e-6 * shape.BoundBox.DiagonalLength:  # it begins at the tip
            height = (shape.CenterOfMass - centre).dot(surface.Axis)
            centre, radius = centre + surface.Axis * height, radius + height * slope
        opens = surface.Axis if slope > 0 else surface.Axis.negative()
        return Picked(centre, opens, radius, values={"half_angle": abs(math.degrees(surface.SemiAngle))})
    return axis(click, source)


def face(click):
    """The object whose face was clicked at, and the face's name; "" for all faces of an object clicked at in the
    tree."""
    name = click.name.split(".")[-1]
    has_faces = not click.on_mesh and getattr(getattr(click.obj, "Shape", None), "Faces", None)
    if not has_faces or name and not name.startswith("Face"):
        raise PickError(translate("FemScalpel", "That is no face of a part. Click one."))
    return click.obj, name


def targets_of(click, document, edges_of_sketches=False):
    """What of a document can be followed that a click means, as following.targets_of(); empty where there is nothing.
    A sketch is meant as a whole, or its edges are."""
    if click.on_mesh or click.obj.Document != document:
        return ()
    name = click.name.split(".")[-1]
    if is_datum(click.obj) and not (edges_of_sketches and is_sketch(click.obj)):
        name = ""
    try:
        axes_of([(click.obj, name)])
    except ValueError:
        return ()
    return ((click.obj, name),)


def _pick_plane():
    return translate(
        "FemScalpel", "Pick a planar face, an edge, a datum plane or line, a sketch, or a face of the mesh."
    )


def _pick_axis():
    return translate(
        "FemScalpel", "Pick a cylindrical face, a straight or circular edge, a datum line, or a point on a face."
    )


def _datum(obj):
    """Plane or line of a datum object or sketch; None for other objects."""
    if not is_datum(obj):
        return None
    direction = FreeCAD.Vector(1, 0, 0) if obj.isDerivedFrom("App::Line") else _Z
    placement = obj.getGlobalPlacement()
    outline = outline_of(obj) if is_sketch(obj) else None
    return Picked(placement.Base, placement.Rotation.multVec(direction), outline=outline)


def _of_document(click, ask):
    """(what a datum or sketch says, None) or (None, the shape clicked at); PickError with ask() where there is
    neither."""
    datum = _datum(click.obj)
    shape = None if datum is not None else _shape(click)
    if datum is None and shape is None:
        raise PickError(ask())
    return datum, shape


def _shape(click):
    return shape_of(click.obj, click.name.split(".")[-1])


def _normal(face, point):
    return face.normalAt(*face.Surface.parameter(point))


def _mesh_face(click, source):
    """The plane of the outer mesh face under a click."""
    if source is None or not len(source.skin):
        raise PickError(_pick_plane())
    element = re.fullmatch(r"Elem(\d+)F\d+", click.name)
    rows = np.flatnonzero(source.cells.ids[source.skin_owner] == int(element[1])) if element else np.empty(0, int)
    if not len(rows):
        rows = np.arange(len(source.skin))
    nearest = rows[np.argmin(np.linalg.norm(source.skin_centres[rows] - np.array(click.point), axis=1))]
    corners = [FreeCAD.Vector(*source.points[i]) for i in source.skin[nearest][:3]]
    return Picked(FreeCAD.Vector(*source.skin_centres[nearest]), plane_through(corners).direction)
