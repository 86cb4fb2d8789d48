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


def as_text(placement):
    """`placement` as exact Python text."""
    return f"FreeCAD.Placement(FreeCAD.Vector{tuple(placement.Base)!r}, FreeCAD.Rotation{placement.Rotation.Q!r})"
