# SPDX-License-Identifier: LGPL-2.1-or-later
"""Properties that say what an object cuts with, and the tool they mean."""

import FreeCAD
import Part

import femscalpel

from .geometry import element_of

AXIS_INPUTS = (
    ("App::PropertyPlacement", "AxisPlacement", "The axis is z of this placement, through its origin"),
    ("App::PropertyLength", "Radius", "Of the cylinder"),
)
AXIS_DEFAULTS = {"Radius": (1,)}

#: Tools by the name of their class in femscalpel.
SHAPES = ("Plane", "Cylinder", "Sphere", "Torus", "Cone", "Face")
SHAPE_INPUTS = (
    (
        "App::PropertyEnumeration",
        "ToolShape",
        "What the tool is; AxisPlacement is its centre and axis, or a plane's normal",
    ),
    (
        "App::PropertyLinkSub",
        "ToolFace",
        "If the tool is a face: the face, or several that meet smoothly, or all of an object",
    ),
    ("App::PropertyLength", "TubeRadius", "Of a torus' tube; Radius is that of its ring"),
    (
        "App::PropertyAngle",
        "HalfAngle",
        "Between the axis of a cone, which opens along it, and its side; Radius is that at the " "placement's origin",
    ),
)
SHAPE_DEFAULTS = {"TubeRadius": (0.25,), "HalfAngle": (30,)}


def direction_of(placement):
    """The z axis of a placement."""
    return placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1))


def plane_of(placement):
    """The femscalpel tool that is the XY plane of a placement."""
    return femscalpel.Plane(placement.Base, direction_of(placement))


def shape_of(obj):
    """The femscalpel tool that the properties AXIS_INPUTS and SHAPE_INPUTS mean. Raises femscalpel.ToolError or
    ValueError."""
    center, axis, radius = obj.AxisPlacement.Base, direction_of(obj.AxisPlacement), obj.Radius.Value
    if obj.ToolShape == "Plane":
        return plane_of(obj.AxisPlacement)
    if obj.ToolShape == "Cylinder":
        return femscalpel.Cylinder(center, axis, radius)
    if obj.ToolShape == "Sphere":
        return femscalpel.Sphere(center, radius)
    if obj.ToolShape == "Torus":
        return femscalpel.Torus(center, axis, radius, obj.TubeRadius.Value)
    if obj.ToolShape == "Cone":
        return femscalpel.Cone(center, axis, radius, obj.HalfAngle.Value)
    if obj.ToolFace is None:
        raise ValueError("ToolFace is not set; choose the face of the geometry to cut with")
    part, names = obj.ToolFace
    faces = [element_of(part, name) for name in names if name] or [part.Shape]
    return femscalpel.Face(faces[0] if len(faces) == 1 else Part.makeCompound(faces))
