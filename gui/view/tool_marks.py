# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lines that say how a tool's extents and angles count: where they are zero, where to, and where they end."""

import math

import numpy as np
from pivy import coin

from .colours import TOOL
from .label import LabelNode
from .nodes import LineNode, Part
from .overlay import unpickable

_STEP = math.radians(5)


class ToolMarks(Part):
    """Thin lines, dashed ones, and labels at zero, in front of everything."""

    def __init__(self):
        super().__init__("FemScalpelToolMarks", coin.SoAnnotation())
        self.lines = LineNode("FemScalpelMarkLines", TOOL, 2.0)
        self.dashed = LineNode("FemScalpelMarkDashes", TOOL, 1.5)
        self.dashed.dash()
        self.zero, self.angle = LabelNode("FemScalpelZero"), LabelNode("FemScalpelZeroAngle")
        for node in (unpickable(), self.lines.root, self.dashed.root, self.zero.root, self.angle.root):
            self._inside.addChild(node)

    def show(self, lines, dashed, zero=None, angle=None):
        """Shows polylines, each (n, 3), and where an extent is zero, and an angle, if there are such."""
        self.lines.show(pairs(lines))
        self.dashed.show(pairs(dashed))
        for label, text, point in ((self.zero, "0", zero), (self.angle, "0°", angle)):
            if point is None:
                label.hide()
            else:
                label.show(point, text)
        self.reveal()


def arc(radius, start, end, height=0.0):
    """Points (n, 3) of an arc about z between angles in degrees, at a height."""
    steps = max(2, round(abs(math.radians(end - start)) / _STEP) + 1)
    angles = np.radians(np.linspace(start, end, steps))
    return np.column_stack([radius * np.cos(angles), radius * np.sin(angles), np.full(steps, height)])


def head_of_arc(radius, end, sense, height=0.0):
    """The head (3, 3) of an arrow along an arc about z, at an angle in degrees; `sense` 1 or -1: towards larger angles
    or smaller ones."""
    back = end - sense * 9
    return np.concatenate(
        [
            arc(0.92 * radius, back, back, height)[:1],
            arc(radius, end, end, height)[:1],
            arc(1.08 * radius, back, back, height)[:1],
        ]
    )


def arrow_along(start, end, head):
    """Polylines of an arrow on the z axis between two heights; `head` is its length, which the arrow is if shorter."""
    head = math.copysign(min(head, abs(end - start)), end - start)
    tip = np.array((0, 0, end))
    wings = [tip + (x, y, -head) for x, y in ((0.35 * head, 0), (-0.35 * head, 0), (0, 0.35 * head), (0, -0.35 * head))]
    return [np.array([(0, 0, start), tip]), np.array([wings[0], tip, wings[1]]), np.array([wings[2], tip, wings[3]])]


def ray(radius, angle, height=0.0, start=0.0):
    """The line (2, 3) away from the z axis at an angle in degrees."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return np.array([(start * c, start * s, height), (radius * c, radius * s, height)])


def pairs(polylines):
    """Polylines as lines (k, 2, 3) of two points."""
    parts = [np.stack([line[:-1], line[1:]], axis=1) for line in polylines if len(line) > 1]
    return np.concatenate([np.empty((0, 2, 3)), *parts])
