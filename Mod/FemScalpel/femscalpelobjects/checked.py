# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arguments of ObjectsFemScalpel's functions: errors that name the argument and say what is expected."""

import os
import re
from numbers import Integral, Real

import FreeCAD

from .stand_in import Workshop

# Of properties that are not called as the arguments they come from.
_ARGUMENTS = {
    "AxisPlacement": "placement",
    "PlanePlacement": "placement",
    "BottomPlacement": "bottom",
    "ToolFace": "face",
    "ToolShape": "tool",
    "PreservedGroups": "preserve",
    "RefineSize": "refine",
    "GroupPrefix": "prefix",
    "Low": "along",
    "High": "along",
    "StartAngle": "angles",
    "EndAngle": "angles",
    "MoveBy": "by",
    "ScaleFactor": "scale",
    "ScaleCentre": "scale",
}
_NUMBER = "a number, or a quantity as '3 mm'"
_EXPECTED = {
    "Angle": "a number of degrees, or a quantity as '3 deg'",
    "Bool": "True or False",
    "Distance": _NUMBER,
    "Float": "a number",
    "Integer": "a whole number",
    "IntegerConstraint": "a whole number",
    "Length": _NUMBER,
    "LinkSub": "an object with a shape, or (object, names of its faces)",
}


def said(value):
    """A value as errors name it."""
    return "None" if value is None else f"{value!r} ({type(value).__name__})"


def _is_gone(value):
    """Whether this is an object, or a document, that was deleted."""
    try:
        getattr(value, "Name", None)
    except ReferenceError:
        return True
    return False


def is_open(doc):
    """Whether this is a document of FreeCAD that is open."""
    return isinstance(doc, FreeCAD.Document) and doc in FreeCAD.listDocuments().values()


def document(doc, name="doc"):
    """`doc`, an open document, or what stands in place of one. TypeError or ValueError where it is none."""
    if isinstance(doc, Workshop):
        return doc
    if not isinstance(doc, FreeCAD.Document):
        raise TypeError(f"{name} must be a document of FreeCAD (App.Document), not {said(doc)}")
    if not is_open(doc):
        raise ValueError(f"{name} is a document that was closed")
    return doc


def any_object(obj, name):
    """`obj`, an object of a document. TypeError or ValueError where it is none."""
    if _is_gone(obj):
        raise ValueError(f"{name} is an object that was deleted")
    if not isinstance(obj, FreeCAD.DocumentObject):
        raise TypeError(f"{name} must be an object of a document (App.DocumentObject), not {said(obj)}")
    return obj


def mesh_object(obj, name="obj", doc=None):
    """`obj`, a FEM mesh object (of `doc`). TypeError or ValueError where it is none."""
    if _is_gone(obj):
        raise ValueError(f"{name} is an object that was deleted")
    if not isinstance(obj, FreeCAD.DocumentObject) or not obj.isDerivedFrom("Fem::FemMeshObject"):
        raise TypeError(f"{name} must be a FEM mesh object (Fem::FemMeshObject), not {said(obj)}")
    if doc is not None and obj.Document != doc:
        raise ValueError(f"{name} '{obj.Label}' is in another document")
    return obj


def made_object(obj, name="obj"):
    """`obj`, an object of FemScalpel. TypeError or ValueError where it is none."""
    if "Source" not in mesh_object(obj, name).PropertiesList:
        raise TypeError(f"{name} must be an object that FemScalpel has made, as a crack; '{obj.Label}' is none")
    return obj


def text(value, name, optional=False):
    """`value`, a str, or None where that is allowed."""
    if isinstance(value, str) or (optional and value is None):
        return value
    raise TypeError(f"{name} must be a string{' or None' if optional else ''}, not {said(value)}")


def path(value, name="path"):
    """`value`, a path as text."""
    try:
        return os.fsdecode(value if isinstance(value, str) else os.fspath(value))
    except TypeError:
        raise TypeError(f"{name} must be a string or a path object, not {said(value)}") from None


def vector(value, name):
    """App.Vector of `value`, one or three numbers."""
    if isinstance(value, FreeCAD.Vector):
        return FreeCAD.Vector(value)
    numbers = several(value, f"{name} must be an App.Vector or three numbers")
    if len(numbers) != 3 or not all(map(_is_number, numbers)):
        raise TypeError(f"{name} must be an App.Vector or three numbers, not {said(value)}")
    return FreeCAD.Vector(*map(float, numbers))


def vectors(value, name):
    """List of App.Vector."""
    points = several(value, f"{name} must be a sequence of App.Vector or of three numbers each")
    return [vector(point, f"each of {name}") for point in points]


def pair(value, name, what="two numbers"):
    """The two of `value`."""
    two = several(value, f"{name} must be {what}")
    if len(two) != 2:
        raise TypeError(f"{name} must be {what}, not {said(value)}")
    return two


def several(value, expected):
    """List of what is in `value`, which is no text; `expected` begins the error."""
    if not isinstance(value, str):
        try:
            return list(value)
        except TypeError:
            pass
    raise TypeError(f"{expected}, not {said(value)}")


def placement(value, name="placement"):
    """App.Placement of `value`, one, or what FreeCAD makes one of."""
    try:
        return FreeCAD.Placement(value)
    except Exception:
        raise TypeError(f"{name} must be an App.Placement, not {said(value)}") from None


def one_of(value, name, known):
    """`value`, a str that is among `known`."""
    if text(value, name) not in known:
        raise ValueError(f"{name} must be one of {', '.join(map(repr, known))}, not {value!r}")
    return value


def set_property(obj, key, value):
    """Gives a property of a new object its value. TypeError or ValueError that names the argument it comes from."""
    name = _ARGUMENTS.get(key) or re.sub(r"(?<!^)(?=[A-Z])", "_", key).lower()
    kind = obj.getTypeIdOfProperty(key).removeprefix("App::Property")
    if kind == "Enumeration":
        value = one_of(value, name, obj.getEnumerationsOfProperty(key))
    elif kind == "String":
        value = text(value, name)
    elif kind == "StringList":
        value = [text(one, f"each of {name}") for one in several(value, f"{name} must be a sequence of strings")]
    elif kind in _EXPECTED and _is_number(value):
        value = int(value) if isinstance(value, Integral) else float(value)
    try:
        setattr(obj, key, value)
    except Exception as error:
        expected = _EXPECTED.get(kind, "something else")
        kind_of_error = TypeError if isinstance(error, TypeError) else ValueError
        raise kind_of_error(f"{name} must be {expected}, not {said(value)}") from None


def _is_number(value):
    return isinstance(value, Real) and not isinstance(value, bool)
