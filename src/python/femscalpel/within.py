# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of a tool's surface, for cracks that end inside the material; their border is the crack front."""

from typing import Optional, Sequence, Tuple

from . import _arguments, _engine

Within = _engine.Within


class Disk(_engine.Disk):
    """A disk in a plane.

    Parameters
    ----------
    center : three numbers
        A point of the plane, in the mesh's unit.
    radius : number
        In the mesh's unit.
    """

    def __init__(self, center: Sequence[float], radius: float):
        self.center, self.radius = _arguments.vector(center, "center"), _arguments.real(radius, "radius")
        super().__init__(self.center, self.radius)

    def __repr__(self) -> str:
        return f"Disk(center={self.center}, radius={self.radius})"


class Ellipse(_engine.Ellipse):
    """An ellipse in a plane.

    Parameters
    ----------
    center : three numbers
        A point of the plane, in the mesh's unit.
    half_axes : two numbers
        In the mesh's unit; either may be the longer one.
    direction : three numbers
        Direction of the first half axis; what of it is normal to the plane does not count.
    """

    def __init__(self, center: Sequence[float], half_axes: Sequence[float], direction: Sequence[float]):
        self.center, self.direction = _arguments.vector(center, "center"), _arguments.vector(direction, "direction")
        self.half_axes = _arguments.pair(half_axes, "half_axes")
        super().__init__(self.center, *self.half_axes, self.direction)

    def __repr__(self) -> str:
        return f"Ellipse(center={self.center}, half_axes={self.half_axes}, direction={self.direction})"


class Polygon(_engine.Polygon):
    """A polygon in a plane; it need not be convex.

    Parameters
    ----------
    corners : sequence of three or more points of the plane
        In order around it, either way. Each becomes a node if it is in the material.

    Raises
    ------
    ToolError
        Fewer than three corners, or one that is repeated; when a crack is made within it, sides that cross, or an area
        of zero.
    """

    def __init__(self, corners: Sequence[Sequence[float]]):
        try:
            corners = list(corners)
        except TypeError:
            raise _arguments.about(
                "corners", TypeError(f"corners must be a sequence of points, not {_arguments.describe(corners)}")
            ) from None
        self.corners = [_arguments.vector(c, f"corners[{k}]") for k, c in enumerate(corners)]
        super().__init__(self.corners)

    def __repr__(self) -> str:
        return f"Polygon({self.corners})"


class HalfPlane(_engine.HalfPlane):
    """The half of a plane on one side of a straight front.

    Parameters
    ----------
    origin : three numbers
        A point of the front, in the mesh's unit.
    direction : three numbers
        From the front into the crack. The front is normal to it.
    """

    def __init__(self, origin: Sequence[float], direction: Sequence[float]):
        self.origin, self.direction = _arguments.vector(origin, "origin"), _arguments.vector(direction, "direction")
        super().__init__(self.origin, self.direction)

    def __repr__(self) -> str:
        return f"HalfPlane(origin={self.origin}, direction={self.direction})"


class CylinderPart(_engine.CylinderPart):
    """A part of a :class:`femscalpel.Cylinder`.

    Parameters
    ----------
    along : two numbers
        From where to where along the axis, measured from the cylinder's origin, in the mesh's unit.
    angles : two numbers, optional
        From where to where about the axis, in degrees, right-handed; all around when not given.
    zero : three numbers, optional
        The direction across the axis from which `angles` are measured.
    """

    def __init__(
        self,
        along: Tuple[float, float],
        angles: Optional[Tuple[float, float]] = None,
        zero: Optional[Sequence[float]] = None,
    ):
        if (angles is None) != (zero is None):
            raise ValueError("give both angles and zero, or neither")
        self.along, self.angles, self.zero = _arguments.pair(along, "along"), None, None
        if angles is not None:
            self.angles, self.zero = _arguments.pair(angles, "angles"), _arguments.vector(zero, "zero")
        super().__init__(*self.along, None if angles is None else (*self.angles, self.zero))

    def __repr__(self) -> str:
        return f"CylinderPart(along={self.along}, angles={self.angles}, zero={self.zero})"


def check_within(within):
    """`within`; TypeError when it is something else or not None."""
    if within is not None and not isinstance(within, Within):
        raise _arguments.about(
            "within",
            TypeError(
                f"within must be a Disk, Ellipse, Polygon, HalfPlane or CylinderPart, not {_arguments.describe(within)}"
            ),
        )
    return within
