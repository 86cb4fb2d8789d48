# SPDX-License-Identifier: LGPL-2.1-or-later
"""Properties that say what an object cuts with, and the tool they mean; both from femscalpel's table of tools."""

from dataclasses import dataclass
from typing import Any

import FreeCAD
import Part

import femscalpel
from femscalpel.signatures import Argument
from femscalpel.tools import ANGLE, DIRECTION, FACE, LENGTH, POINT, TOOLS

from .geometry import element_of

_TYPES = {LENGTH: "App::PropertyLength", ANGLE: "App::PropertyAngle", FACE: "App::PropertyLinkSub"}
_KINDS = {LENGTH: "float", ANGLE: "float", FACE: "object with a shape, or (object, names of its faces)"}
#: Properties that are not called as the argument.
_NAMES = {"face": "ToolFace"}


@dataclass(frozen=True)
class _Input:
    """What is asked for any tool, beside a place and a direction."""

    argument: Argument
    property: tuple  # (type, name, text, values)

    @property
    def name(self):
        return self.property[1]


def _inputs():
    """Parameters of all tools by what they are asked as: tools share them."""
    users, first = {}, {}
    for tool, kind in TOOLS.items():
        for p in kind.parameters:
            if p.kind in _TYPES:
                users.setdefault(p.asked_as, []).append(tool)
                first.setdefault(p.asked_as, p)
    out = {}
    for asked, p in first.items():
        name = _NAMES.get(asked) or asked.title().replace("_", "")
        text = p.ask or p.text
        values = () if p.default is None else (p.default,)
        argument = Argument(
            asked, p.default, _KINDS[p.kind], f"Of {', '.join(users[asked])}. {text}.".replace("..", ".")
        )
        out[asked] = _Input(argument, (_TYPES[p.kind], name, text, *values))
    return out


_INPUTS = _inputs()
#: Inputs in the order of the functions of ObjectsFemScalpel, before the options there; others come last.
_FIRST = ("radius", "tube_radius", "half_angle")

AXIS_INPUTS = (
    ("App::PropertyPlacement", "AxisPlacement", "The axis is z of this placement, through its origin"),
    _INPUTS["radius"].property,
)


def shape_inputs(default, without=()):
    """Properties (type, name, text, values) that, with AXIS_INPUTS, say any tool, but those of `without`."""
    shapes = [name for name in TOOLS if name not in without]
    text = "What the tool is; AxisPlacement is its centre and axis, or a plane's normal"
    inputs = [i.property for i in _INPUTS.values() if i.property not in AXIS_INPUTS]
    return (("App::PropertyEnumeration", "ToolShape", text, shapes, default), *inputs)


def arguments():
    """The inputs as arguments of a function of ObjectsFemScalpel."""
    return [i.argument for i in _INPUTS.values()]


def places(face, last):
    """Behind which arguments those stand that do not come first: the face behind `face`, later tools' behind `last`."""
    return {name: face if name == "face" else last for name in _INPUTS if name not in _FIRST}


def to_properties(given):
    """Values of properties for values of arguments(), both by name."""
    out = {_INPUTS[name].name: value for name, value in given.items()}
    face = out["ToolFace"]
    if face is not None and not isinstance(face, (tuple, list)):
        out["ToolFace"] = face, [""]
    return out


def property_of(asked):
    """Name of the property that holds an input, a parameter's `asked_as`."""
    return _INPUTS[asked].name


def direction_of(placement):
    """The z axis of a placement."""
    return placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1))


def plane_of(placement):
    """The femscalpel tool that is the XY plane of a placement."""
    return femscalpel.Plane(placement.Base, direction_of(placement))


def shape_of(obj):
    """The femscalpel tool that the properties AXIS_INPUTS and shape_inputs() mean. Raises femscalpel.ToolError or
    ValueError."""
    return TOOLS[obj.ToolShape].build(lambda parameter: _value(obj, parameter))


def _value(obj, parameter) -> Any:
    if parameter.kind == POINT:
        return obj.AxisPlacement.Base
    if parameter.kind == DIRECTION:
        return direction_of(obj.AxisPlacement)
    value = getattr(obj, _INPUTS[parameter.asked_as].name)
    return face_of(value) if parameter.kind == FACE else value.Value


def face_of(link):
    """The shape that a property of type LinkSub means. Raises ValueError where there is none."""
    if link is None:
        raise ValueError("ToolFace is not set; choose the face of the geometry to cut with")
    part, names = link
    faces = [element_of(part, name) for name in names if name] or [part.Shape]
    return faces[0] if len(faces) == 1 else Part.makeCompound(faces)
