# SPDX-License-Identifier: LGPL-2.1-or-later
"""Placements: turned about their own z axis, which says what a plane or an axis alone does not, and as text."""

import math

import FreeCAD

X, Z = FreeCAD.Vector(1, 0, 0), FreeCAD.Vector(0, 0, 1)


def turned(placement, degrees):
    """`placement`, turned about its z axis."""
    return FreeCAD.Placement(placement.Base, placement.Rotation * FreeCAD.Rotation(Z, degrees))


def turn_between(rotation, other):
    """By how many degrees `other` is turned about the z axis against `rotation`, which has the same z axis."""
    along = rotation.inverted().multVec(other.multVec(X))
    return math.degrees(math.atan2(along.y, along.x))


def carried_turn(old, new, degrees):
    """`degrees` about the z axis `old`, so that with the z axis `new` the x axis has turned no further than that took;
    where the z axis is reversed, the x axis stays."""
    rotation = FreeCAD.Rotation(Z, old) * FreeCAD.Rotation(Z, degrees)
    if old.getAngle(new) > math.pi - 1e-9:
        carried = FreeCAD.Rotation(rotation.multVec(X), FreeCAD.Vector(), new, "ZXY")
    else:
        carried = FreeCAD.Rotation(old, new) * rotation
    return turn_between(FreeCAD.Rotation(Z, new), carried)


class Turn:
    """By how many degrees a tool's x axis is turned about the z axis of a GeometryInput, in a number field or without
    one.

    Where the x axis matters (`matters()`), it is carried along when the z axis changes; `mirrored()` is called when
    that is reversed."""

    def __init__(self, geometry, matters, field=None, mirrored=None):
        self._geometry, self._matters, self._field, self._mirrored = geometry, matters, field, mirrored
        self._value, self._axis = 0.0, geometry.direction()
        geometry.changed.connect(self._follow)

    @property
    def value(self):
        """The angle."""
        return self._field.value if self._field is not None else self._value

    @property
    def has_expression(self):
        """Whether an expression says the angle."""
        return self._field is not None and self._field.has_expression

    def set(self, degrees):
        """Enters an angle without telling anyone."""
        if self._field is not None:
            self._field.set(degrees)
        else:
            self._value = degrees

    def _follow(self):
        axis = self._geometry.direction()
        if not axis.Length > 0:
            return
        if self._matters() and self._axis.getAngle(axis) > 1e-9:
            self.set(carried_turn(self._axis, axis, self.value))
            if self._mirrored is not None and self._axis.getAngle(axis) > math.pi - 1e-9:
                self._mirrored()
        self._axis = axis


def as_text(placement):
    """`placement` as exact Python text."""
    return f"FreeCAD.Placement(FreeCAD.Vector{tuple(placement.Base)!r}, FreeCAD.Rotation{placement.Rotation.Q!r})"
