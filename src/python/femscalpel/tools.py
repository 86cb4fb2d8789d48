# SPDX-License-Identifier: LGPL-2.1-or-later
"""What one cuts with: one class for each tool, whose parameters are said once, in the table over it.

From the table come the constructor and its checks, the attributes, the docstring and what repr() shows; documents and
task panels of FreeCAD read it as `TOOLS`. A new tool is a class here, bound under its name, its parameters over it.
"""

import inspect
import os
import textwrap
from dataclasses import dataclass
from typing import Any, Callable, Dict, Optional, Sequence, Tuple

import numpy as np

from . import _arguments, _engine
from .signatures import bind

__all__ = ["Cone", "Cylinder", "Face", "Plane", "Sphere", "Tool", "Torus"]

Tool = _engine.Tool
Vector = Tuple[float, float, float]


@dataclass(frozen=True)
class Kind:
    """What a parameter of a tool can be."""

    name: str
    text: str  #: for docstrings
    annotation: Any
    check: Callable[[Any, str], Any]  #: what the engine takes, of a value and the parameter's name
    attribute: str = "{}"  #: of the engine's class that gives it back, from the parameter's name


def _shape(value, name):
    """The text of a FreeCAD shape, or the path of a file."""
    if hasattr(value, "exportBrepToString"):
        return value.exportBrepToString().encode()
    if isinstance(value, (str, os.PathLike)):
        return _arguments.path(value, name)
    raise _arguments.about(
        name, TypeError(f"{name} must be a path or a FreeCAD shape, not {_arguments.describe(value)}")
    )


POINT = Kind("point", "three numbers", Sequence[float], _arguments.vector)
DIRECTION = Kind("direction", "three numbers", Sequence[float], _arguments.vector, "unit_{}")
LENGTH = Kind("length", "number", float, _arguments.real)
ANGLE = Kind("angle", "number", float, _arguments.real)  # in degrees
FACE = Kind("face", "path, or FreeCAD shape", Any, _shape)


@dataclass(frozen=True)
class Parameter:
    """A parameter of a tool."""

    name: str  #: in the constructor, and of the attribute that gives it back
    kind: Kind
    text: str  #: what it is
    value: str = ""  #: what the attribute is, where that is not what was given
    asked: str = ""  #: what those call it who ask for any tool, whose parameters then share fields; its name otherwise
    ask: str = ""  #: what they say of it; the text otherwise
    default: Optional[float] = None  #: what they begin with

    @property
    def asked_as(self) -> str:
        """Name of the field of those who ask for any tool."""
        return self.asked or self.name


@dataclass(frozen=True)
class ToolKind:
    """A tool and its parameters."""

    tool: type
    parameters: Tuple[Parameter, ...]

    def build(self, value: Callable[[Parameter], Any]) -> Tool:
        """The tool with `value(parameter)` for each of its parameters."""
        return self.tool(**{p.name: value(p) for p in self.parameters})


#: All tools by the name of their class.
TOOLS: Dict[str, ToolKind] = {}


def _distance(self, points) -> np.ndarray:
    """Signed distances of `points`, shape (n, 3), to the surface, in the mesh's unit; positive on the normal's side."""
    array = _arguments.coordinates(points, "points")
    if array.ndim == 1:
        array = array.reshape(1, -1)
    if array.ndim != 2 or array.shape[1] != 3:
        raise _arguments.about("points", ValueError(f"points must have the shape (n, 3), not {array.shape}"))
    return self.distances(array)


def _constructor(tool, parameters):
    positional = inspect.Parameter.POSITIONAL_OR_KEYWORD
    own = [inspect.Parameter(p.name, positional, annotation=p.kind.annotation) for p in parameters]
    signature = inspect.Signature(own)

    def __init__(self, *args, **kwargs):
        given = bind(tool.__name__, signature, args, kwargs).arguments
        super(tool, self).__init__(*(p.kind.check(given[p.name], p.name) for p in parameters))

    __init__.__signature__ = signature.replace(parameters=[inspect.Parameter("self", positional), *own])
    return __init__


def _attribute(tool, parameter):
    name = parameter.kind.attribute.format(parameter.name)

    def get(self):
        value = getattr(super(tool, self), name)
        return value if isinstance(value, float) else tuple(value)

    get.__annotations__["return"] = float if parameter.kind.annotation is float else Vector
    return property(get, doc=parameter.value or parameter.text)


def _documentation(tool, parameters, errors) -> str:
    """The docstring of a tool, numpydoc: `errors` are pairs of class and text."""
    lines = [inspect.cleandoc(tool.__doc__), "", "Parameters", "----------"]
    for p in parameters:
        lines += [
            f"{p.name} : {p.kind.text}",
            *textwrap.wrap(p.text, 112, initial_indent="    ", subsequent_indent="    "),
        ]
    lines += ["", "Raises", "------"]
    for name, text in errors:
        lines += [name, f"    {text}"]
    return "\n".join(lines) + "\n"


def _made_from(*parameters, **errors):
    """Makes a tool of a class derived from the engine's: what it does not define itself comes from its parameters.
    `errors` are the texts of those its constructor raises."""

    def decorate(tool):
        def __repr__(self) -> str:
            return f"{tool.__name__}({', '.join(f'{p.name}={getattr(self, p.name)}' for p in parameters)})"

        made = {"__repr__": __repr__, "__init__": _constructor(tool, parameters)}
        made.update((p.name, _attribute(tool, p)) for p in parameters if p.kind is not FACE)
        for name, value in made.items():
            if name not in vars(tool):
                setattr(tool, name, value)
        tool.__doc__ = _documentation(tool, parameters, errors.items())
        TOOLS[tool.__name__] = ToolKind(tool, parameters)
        return tool

    return decorate


_AXIS_ORIGIN = Parameter(
    "origin", POINT, "A point of the axis, in the mesh's unit.", value="The point of the axis it was made with."
)


@_made_from(
    Parameter(
        "origin", POINT, "A point of the plane, in the mesh's unit.", value="The point of the plane it was made with."
    ),
    Parameter(
        "normal",
        DIRECTION,
        "Direction of the positive side; any length.",
        value="Unit normal; it points to the positive side.",
    ),
    ToolError="The normal is zero.",
)
class Plane(_engine.Plane):
    """An infinite plane through `origin`, normal to `normal`."""

    normal: Vector  # for editors
    distance = _distance


@_made_from(
    _AXIS_ORIGIN,
    Parameter("axis", DIRECTION, "Direction of the axis; any length.", value="Unit vector along the axis."),
    Parameter("radius", LENGTH, "In the mesh's unit.", ask="Of the cylinder", default=1.0),
    ToolError="The axis is zero or the radius not positive.",
)
class Cylinder(_engine.Cylinder):
    """An infinite circular cylinder; its positive side is outside."""

    axis: Vector  # for editors
    distance = _distance


@_made_from(
    Parameter("center", POINT, "In the mesh's unit.", value="Its middle."),
    Parameter("radius", LENGTH, "In the mesh's unit."),
    ToolError="The radius is not positive.",
)
class Sphere(_engine.Sphere):
    """A sphere; its positive side is outside."""

    distance = _distance


@_made_from(
    Parameter("center", POINT, "Middle of the circle, in the mesh's unit.", value="Middle of the circle."),
    Parameter(
        "axis", DIRECTION, "Normal of the circle's plane; any length.", value="Unit normal of the circle's plane."
    ),
    Parameter("major_radius", LENGTH, "Of the circle, in the mesh's unit.", asked="radius"),
    Parameter(
        "minor_radius",
        LENGTH,
        "Of the tube around it, in the mesh's unit.",
        asked="tube_radius",
        ask="Of a torus' tube; Radius is that of its ring",
        default=0.25,
    ),
    ToolError="The axis is zero, a radius not positive, or the minor radius not smaller than the major one.",
)
class Torus(_engine.Torus):
    """A ring torus: a tube around a circle; its positive side is outside the tube."""

    axis: Vector  # for editors
    distance = _distance


@_made_from(
    Parameter(
        "origin",
        POINT,
        "The point of the axis at which the cone has `radius`, in the mesh's unit.",
        value="The point of the axis it was made with.",
    ),
    Parameter(
        "axis",
        DIRECTION,
        "Direction in which the cone gets wider; any length.",
        value="Unit vector along the axis, to the wide side.",
    ),
    Parameter("radius", LENGTH, "At the origin, in the mesh's unit."),
    Parameter(
        "half_angle",
        ANGLE,
        "Degrees between the axis and the surface.",
        ask="Between the axis of a cone, which opens along it, and its side; Radius is that at the placement's origin",
        default=30.0,
    ),
    ToolError="The axis is zero, the radius not positive or the angle not between 0 and 90.",
)
class Cone(_engine.Cone):
    """A circular cone, from its apex on without end; its positive side is outside.

    The mesh cannot follow a cone to its apex: keep :attr:`apex` out of the material.
    """

    axis: Vector  # for editors
    distance = _distance

    @property
    def apex(self) -> Vector:
        """The cone's tip."""
        return tuple(super().apex)


@_made_from(
    Parameter(
        "source",
        FACE,
        "A ``.step``, ``.stp``, ``.brep`` or ``.brp`` file, or a ``Part.Shape``: all faces in it, which must meet "
        "smoothly. Lengths of a STEP file are taken in millimetres.",
        asked="face",
        ask="If the tool is a face: the face, or several that meet smoothly, or all of an object",
    ),
    ReadError="The file cannot be read.",
    ToolError="There is no face in it, or faces that meet at an angle.",
)
class Face(_engine.Face):
    """A face or shell of a CAD model, by OpenCASCADE; its positive side is the one its normals point to.

    A crack along it goes as far as the face does: where its border lies inside the material it is the crack's front,
    and ``name_FRONT`` has the segments along it (see ``within`` of :func:`crack`); corners of the border become nodes.
    """

    distance = _distance

    def __init__(self, source):
        super().__init__(_shape(source, "source"))
        # Kept, so that debuggers can show an object whose construction failed.
        self._text = f"Face({_arguments.describe(source)}, {self.face_count} face{'s'[: self.face_count != 1]})"

    def __repr__(self) -> str:
        return getattr(self, "_text", "Face()")


class Faces:
    """Faces that a mesh has already, for :func:`crack`: elements of any type come apart there, and none moves.

    Of the options, `name`, `strict` and `band_only` count. Beams and springs that end on the faces stay whole, on the
    negative side: springs between double nodes get none for new pairs, of which a warning tells.

    Parameters
    ----------
    group : str
        A group that covers faces inside the solids (in a mesh of shells: edges between them): of elements on the faces,
        of facets, or of nodes, which stands for the faces all of whose corners are members. The negative side, which
        keeps its nodes, is that of the solids whose facets they are, or the one that the elements' normals point away
        from (of segments: the left); with a group of nodes, normals point to larger x, y or z.
    """

    __slots__ = ("group",)

    def __init__(self, group: str):
        self.group = _arguments.text(group, "group")

    def __repr__(self) -> str:
        return f"Faces({self.group!r})"


def check_tool(tool, name: str = "tool"):
    """`tool`; TypeError that names the parameter when it is something else."""
    if not isinstance(tool, Tool):
        raise _arguments.about(
            name, TypeError(f"{name} must be a tool such as femscalpel.Plane, not {_arguments.describe(tool)}")
        )
    return tool
