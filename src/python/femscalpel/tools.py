# SPDX-License-Identifier: LGPL-2.1-or-later
"""What one cuts with."""

import os
from typing import Sequence, Tuple

import numpy as np

from . import _arguments, _engine

Tool = _engine.Tool


def _distance(self, points) -> np.ndarray:
    """Signed distances of `points`, shape (n, 3), to the surface, in the mesh's unit; positive on the normal's side."""
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.ndim == 1:
        array = array.reshape(1, -1)
    if array.ndim != 2 or array.shape[1] != 3:
        raise _arguments.about("points", ValueError(f"points must have the shape (n, 3), not {array.shape}"))
    return self.distances(array)


class Plane(_engine.Plane):
    """An infinite plane through `origin`, normal to `normal`.

    Parameters
    ----------
    origin : three numbers
        A point of the plane, in the mesh's unit.
    normal : three numbers
        Direction of the positive side; any length.

    Raises
    ------
    ToolError
        The normal is zero.
    """

    def __init__(self, origin: Sequence[float], normal: Sequence[float]):
        super().__init__(_arguments.vector(origin, "origin"), _arguments.vector(normal, "normal"))

    @property
    def origin(self) -> Tuple[float, float, float]:
        """The point of the plane it was made with."""
        return tuple(super().origin)

    @property
    def normal(self) -> Tuple[float, float, float]:
        """Unit normal; it points to the positive side."""
        return tuple(self.unit_normal)

    distance = _distance

    def __repr__(self) -> str:
        return f"Plane(origin={self.origin}, normal={self.normal})"


class Cylinder(_engine.Cylinder):
    """An infinite circular cylinder; its positive side is outside.

    Parameters
    ----------
    origin : three numbers
        A point of the axis, in the mesh's unit.
    axis : three numbers
        Direction of the axis; any length.
    radius : number
        In the mesh's unit.

    Raises
    ------
    ToolError
        The axis is zero or the radius not positive.
    """

    def __init__(self, origin: Sequence[float], axis: Sequence[float], radius: float):
        super().__init__(
            _arguments.vector(origin, "origin"), _arguments.vector(axis, "axis"), _arguments.real(radius, "radius")
        )

    @property
    def origin(self) -> Tuple[float, float, float]:
        """The point of the axis it was made with."""
        return tuple(super().origin)

    @property
    def axis(self) -> Tuple[float, float, float]:
        """Unit vector along the axis."""
        return tuple(self.unit_axis)

    distance = _distance

    def __repr__(self) -> str:
        return f"Cylinder(origin={self.origin}, axis={self.axis}, radius={self.radius})"


class Sphere(_engine.Sphere):
    """A sphere; its positive side is outside.

    Parameters
    ----------
    center : three numbers
        In the mesh's unit.
    radius : number
        In the mesh's unit.

    Raises
    ------
    ToolError
        The radius is not positive.
    """

    def __init__(self, center: Sequence[float], radius: float):
        super().__init__(_arguments.vector(center, "center"), _arguments.real(radius, "radius"))

    @property
    def center(self) -> Tuple[float, float, float]:
        """Its middle."""
        return tuple(super().center)

    distance = _distance

    def __repr__(self) -> str:
        return f"Sphere(center={self.center}, radius={self.radius})"


class Torus(_engine.Torus):
    """A ring torus: a tube around a circle; its positive side is outside the tube.

    Parameters
    ----------
    center : three numbers
        Middle of the circle, in the mesh's unit.
    axis : three numbers
        Normal of the circle's plane; any length.
    major_radius, minor_radius : number
        Radius of the circle and of the tube around it, in the mesh's unit.

    Raises
    ------
    ToolError
        The axis is zero, a radius not positive, or the minor radius not smaller than the major one.
    """

    def __init__(self, center: Sequence[float], axis: Sequence[float], major_radius: float, minor_radius: float):
        super().__init__(
            _arguments.vector(center, "center"),
            _arguments.vector(axis, "axis"),
            _arguments.real(major_radius, "major_radius"),
            _arguments.real(minor_radius, "minor_radius"),
        )

    @property
    def center(self) -> Tuple[float, float, float]:
        """Middle of the circle."""
        return tuple(super().center)

    @property
    def axis(self) -> Tuple[float, float, float]:
        """Unit normal of the circle's plane."""
        return tuple(self.unit_axis)

    distance = _distance

    def __repr__(self) -> str:
        radii = f"major_radius={self.major_radius}, minor_radius={self.minor_radius}"
        return f"Torus(center={self.center}, axis={self.axis}, {radii})"


class Cone(_engine.Cone):
    """A circular cone, from its apex on without end; its positive side is outside.

    The mesh cannot follow a cone to its apex: keep :attr:`apex` out of the material.

    Parameters
    ----------
    origin : three numbers
        The point of the axis at which the cone has `radius`, in the mesh's unit.
    axis : three numbers
        Direction in which the cone gets wider; any length.
    radius : number
        In the mesh's unit.
    half_angle : number
        Degrees between the axis and the surface.

    Raises
    ------
    ToolError
        The axis is zero, the radius not positive or the angle not between 0 and 90.
    """

    def __init__(self, origin: Sequence[float], axis: Sequence[float], radius: float, half_angle: float):
        super().__init__(
            _arguments.vector(origin, "origin"),
            _arguments.vector(axis, "axis"),
            _arguments.real(radius, "radius"),
            _arguments.real(half_angle, "half_angle"),
        )

    @property
    def origin(self) -> Tuple[float, float, float]:
        """The point of the axis it was made with."""
        return tuple(super().origin)

    @property
    def axis(self) -> Tuple[float, float, float]:
        """Unit vector along the axis, to the wide side."""
        return tuple(self.unit_axis)

    @property
    def apex(self) -> Tuple[float, float, float]:
        """The cone's tip."""
        return tuple(super().apex)

    distance = _distance

    def __repr__(self) -> str:
        return f"Cone(origin={self.origin}, axis={self.axis}, radius={self.radius}, half_angle={self.half_angle})"


class Face(_engine.Face):
    """A face or shell of a CAD model, by OpenCASCADE; its positive side is the one its normals point to.

    A crack along it goes as far as the face does: where its border lies inside the material it is the crack's front,
    and ``name_FRONT`` has the segments along it (see ``within`` of :func:`crack`); corners of the border become nodes.

    Parameters
    ----------
    source : path, or FreeCAD shape
        A ``.step``, ``.stp``, ``.brep`` or ``.brp`` file, or a ``Part.Shape``: all faces in it, which must meet
        smoothly. Lengths of a STEP file are taken in millimetres.

    Raises
    ------
    ReadError
        The file cannot be read.
    ToolError
        There is no face in it, or faces that meet at an angle.
    """

    def __init__(self, source):
        if hasattr(source, "exportBrepToString"):
            super().__init__(source.exportBrepToString().encode())
        elif isinstance(source, (str, os.PathLike)):
            super().__init__(os.fspath(source))
        else:
            raise _arguments.about(
                "source", TypeError(f"source must be a path or a FreeCAD shape, not {_arguments.describe(source)}")
            )
        # Kept, so that debuggers can show an object whose construction failed.
        self._text = f"Face({_arguments.describe(source)}, {self.face_count} face(s))"

    distance = _distance

    def __repr__(self) -> str:
        return getattr(self, "_text", "Face()")


def check_tool(tool, name: str = "tool"):
    """`tool`; TypeError that names the parameter when it is something else."""
    if not isinstance(tool, Tool):
        raise _arguments.about(
            name, TypeError(f"{name} must be a tool such as femscalpel.Plane, not {_arguments.describe(tool)}")
        )
    return tool
