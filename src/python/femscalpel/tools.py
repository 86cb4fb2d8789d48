# SPDX-License-Identifier: LGPL-2.1-or-later
"""What one cuts with."""

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
        raise ValueError(f"points must have the shape (n, 3), not {array.shape}")
    return self.distances(array)


class Plane(_engine.Plane):
    """An infinite plane through `origin`, normal to `normal`.

    Parameters
    ----------
    origin : three numbers
        A point of the plane, in the mesh's unit.
    normal : three numbers
        Direction of the positive side; any length.

    Raises :class:`femscalpel.ToolError` when the normal is zero.
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

    Raises :class:`femscalpel.ToolError` when the axis is zero or the radius not positive.
    """

    def __init__(self, origin: Sequence[float], axis: Sequence[float], radius: float):
        super().__init__(_arguments.vector(origin, "origin"), _arguments.vector(axis, "axis"), _arguments.real(radius, "radius"))

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


def check_tool(tool, name: str = "tool"):
    """`tool`; TypeError that names the parameter when it is something else."""
    if not isinstance(tool, Tool):
        raise TypeError(f"{name} must be a tool such as femscalpel.Plane, not {_arguments.describe(tool)}")
    return tool
