# SPDX-License-Identifier: LGPL-2.1-or-later
"""Handles of a surface of revolution, and what is seen of it."""

import math

import FreeCAD
import numpy as np
from pivy import coin

from . import faces as mesh_faces
from .colours import TOOL
from .grips import arrows, ball, sb_rotation, turned
from .handles import Handles
from .nodes import LineNode, material, paint, set_values, style, two_sided
from .profiles import ENDLESS, PROFILES, revolved
from .tool_marks import arc, arrow_along, head_of_arc, pairs, ray

_Z = FreeCAD.Vector(0, 0, 1)
_CROSS, _RADIUS = 60, 27  # pixels from the middle to the end of the arrows, and of those on the wall


class AxisHandles(Handles):
    """Four arrows to move the axis sideways, ball to tilt it, arrows on the wall for the radius; the cylinder itself as
    a pane. For other surfaces of revolution also arrows along the axis."""

    BALL = 24

    def _add_tool_shape(self, pane):
        axis = coin.SoSeparator()
        paint(axis, TOOL, style(1.5))
        line = LineNode("FemScalpelAxis", TOOL, 1.5)
        line.show(pairs(arrow_along(-0.6 * self._size, 0.6 * self._size, 0.05 * self._size)))
        axis.addChild(line.root)
        self._axis = coin.SoSwitch()
        self._axis.addChild(axis)
        self._axis.whichChild = coin.SO_SWITCH_ALL
        pane.addChild(self._axis)
        self._rims = LineNode("FemScalpelRims", TOOL, 2.0)
        pane.addChild(self._rims.root)
        self._wall_points, self._wall_faces = coin.SoCoordinate3(), coin.SoIndexedFaceSet()
        self._wall_points.setName("FemScalpelWall")
        self._shape, self._values, self._part = "Cylinder", {}, None
        for node in (self._wall_points, two_sided(), material(TOOL, 0.85), self._wall_faces):
            pane.addChild(node)

    def _make_draggers(self):
        self._wall = coin.SoTranslation()
        # Between the arrows that move the axis, which may be as long as the radius.
        between = coin.SoRotation()
        between.rotation.setValue(sb_rotation(FreeCAD.Rotation(_Z, 45)))
        both = ((1, 0, 0), 0.1, 1), ((-1, 0, 0), 0.1, 1)
        self._add("radius", coin.SoTranslate1Dragger(), _RADIUS, lambda rgb: arrows(rgb, *both), (between, self._wall))
        self._add("tilt", coin.SoRotateSphericalDragger(), self.BALL, ball)
        first = self.BALL / _CROSS
        four = [(direction, first, 1) for direction in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]
        self._add("move", coin.SoTranslate2Dragger(), _CROSS, lambda rgb: arrows(rgb, *four))
        two = [(direction, first, 1) for direction in ((1, 0, 0), (-1, 0, 0))]
        along = turned((1, 0, 0), (0, 0, 1))
        self._add("along", coin.SoTranslate1Dragger(), _CROSS, lambda rgb: arrows(rgb, *two), (along,))
        self._switch("along", False)

    def show_shape(self, shape, values, tilted):
        """Says what tool it is, by the name of its class, with its `values` beside the radius; whether it can be
        `tilted`. set_pose() is to follow."""
        self._shape, self._values = shape, {**self._values, **values}
        self._switch("along", shape not in ENDLESS)
        self._switch("radius", shape != "Plane")
        self._switch("tilt", tilted)
        self._axis.whichChild = coin.SO_SWITCH_ALL if tilted else coin.SO_SWITCH_NONE

    def show_depth(self, depth):
        """Says how far beyond its position a hole ends, None for one that does not. set_pose() is to follow."""
        self._values["depth"] = depth

    def show_part(self, part):
        """Says what part of a cylinder it is: (from, to, start, end, turn) along the axis and in degrees, which are
        measured from the x axis turned by `turn` degrees; None for all of it."""
        if part != self._part:
            self._part = part
            self._draw()

    def set_pose(self, position, rotation, radius=0.0):
        super().set_pose(position, rotation, radius)
        self._draw()

    def _draw(self):
        """Draws the surface and its marks."""
        radius = max(self._radius, 1e-6 * self._size)
        if self._part is not None:
            low, high, start, end, turn = self._part
            profile, sector = ((radius, low), (radius, high)), (turn + start, turn + end)
        else:
            profile, sector = PROFILES.get(self._shape, lambda *_: ())(radius, self._values, self._size), (0, 360)
        points, faces = revolved(profile, *sector)
        set_values(self._wall_points.point, np.ascontiguousarray(points, np.float32))
        set_values(self._wall_faces.coordIndex, mesh_faces.coin_index(faces)[0])
        rims = [arc(r, *sector, z) for r, z in (*profile[:1], *profile[-1:]) if r > 0] if len(profile) else []
        if self._values.get("depth") is not None and self._shape == "Cylinder":
            rims.append(arc(radius, 0, 360, self._values["depth"]))
        if self._part is not None and abs(sector[1] - sector[0]) < 360:
            rims += [np.array([ray(radius, angle, z)[1] for z in (low, high)]) for angle in sector]
        self._rims.show(pairs(rims))
        self._show_marks(radius)

    def _show_marks(self, radius):
        """Shows from where a depth, extents and angles count, where to, and where they end."""
        depth, head = self._values.get("depth"), 0.04 * self._size
        around = arc(radius, 0, 360)
        if self._part is not None:
            low, high, start, end, turn = self._part
            lines = arrow_along(min(low, 0), max(high, 0) + 2 * head, head)
            lines += [ray(0.3 * radius, turn + angle, z) for z in (low, high) for angle in (0, 120, 240)]
            outer = 1.25 * radius
            shown = end if abs(end - start) < 360 else start + 60
            sense = math.copysign(1, end - start)
            lines += [arc(outer, turn + start, turn + shown), head_of_arc(outer, turn + shown, sense)]
            zero = ray(1.2 * outer, turn)
            self._tool_marks.show(lines, [around, zero], zero=(0, 0, 0), angle=zero[1])
        elif depth is not None and self._shape == "Cylinder":
            lines = arrow_along(0, depth, head) if depth else []
            lines += [ray(radius, angle, depth) for angle in (0, 90, 180, 270)]
            self._tool_marks.show(lines, [around], zero=(0, 0, 0))
        else:
            self._tool_marks.hide()

    def _arrange(self):
        # Beyond the ball, which takes every click within it.
        self._wall.translation.setValue(max(self._radius, self.BALL * self._pixel) + self._lengths["radius"], 0, 0)

    def _extent(self):
        if self._shape == "Plane":
            return math.inf, None
        extent = self._radius + (self._values.get("tube_radius", 0.0) if self._shape == "Torus" else 0.0)
        endless = self._shape in ("Cylinder", "Cone")
        return extent, self._rotation.multVec(_Z) if endless else None

    def _local(self):
        shift = self._shift("move")
        return FreeCAD.Vector(shift.x, shift.y, self._shift("along").x), self._turn("tilt"), self._dragged_radius()
