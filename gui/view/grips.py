# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes of handles in the 3-D view, of length 1: arrows, and a ball to tilt with."""

import FreeCAD
import numpy as np
from pivy import coin

from .nodes import material, paint, style
from .overlay import unpickable


def sb_rotation(rotation):
    """A FreeCAD.Rotation as Coin's."""
    return coin.SbRotation(*rotation.Q)


def turned(start, end):
    """A node that turns the direction `start` to `end`."""
    node = coin.SoRotation()
    node.rotation.setValue(sb_rotation(FreeCAD.Rotation(FreeCAD.Vector(*start), FreeCAD.Vector(*end))))
    return node


def line(*points):
    """A node that is one line through points."""
    node = coin.SoSeparator()
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), points)
    node.addChild(coordinates)
    node.addChild(coin.SoLineSet())
    return node


def arrows(rgb, *which):
    """Arrows (direction in x, y, start, end) of one colour; start and end are distances from the middle."""
    node = coin.SoSeparator()
    node.addChild(material(rgb))
    for direction, start, end in which:
        node.addChild(_arrow(direction, start, end))
    return node


def ball(rgb):
    """Three thin great circles of radius 1, to be grabbed anywhere within."""
    node = coin.SoSeparator()
    rings = coin.SoSeparator()
    rings.addChild(unpickable())
    paint(rings, rgb, style(1.5))
    angles = np.linspace(0, 2 * np.pi, 49)
    zero, c, s = np.zeros_like(angles), np.cos(angles), np.sin(angles)
    for ring in ((c, s, zero), (zero, c, s), (s, zero, c)):
        rings.addChild(line(*np.stack(ring, axis=1).tolist()))
    node.addChild(rings)
    node.addChild(_unseen(coin.SoSphere()))
    return node


def _unseen(shape):
    """Something to grab that is not seen: thin lines are hard to hit."""
    grip = coin.SoSeparator()
    unseen = coin.SoDrawStyle()
    unseen.style = coin.SoDrawStyle.INVISIBLE
    grip.addChild(unseen)
    grip.addChild(shape)
    return grip


def _arrow(direction, start, end):
    arrow = coin.SoSeparator()
    arrow.addChild(turned((0, 1, 0), direction))
    shaft = coin.SoSeparator()
    shaft.addChild(unpickable())
    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    shaft.addChild(light)
    shaft.addChild(style(2.0))
    shaft.addChild(line((0, start, 0), (0, end - 0.3, 0)))
    arrow.addChild(shaft)
    place = coin.SoTranslation()
    place.translation.setValue(0, end - 0.15, 0)
    head = coin.SoCone()
    head.bottomRadius, head.height = 0.11, 0.3
    grip = coin.SoCylinder()
    grip.radius, grip.height = 0.14, end - start
    beside = coin.SoTranslation()
    beside.translation.setValue(0, (start + end) / 2 - (end - 0.15), 0)
    for node in (place, head, beside, _unseen(grip)):
        arrow.addChild(node)
    return arrow
