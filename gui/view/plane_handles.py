# SPDX-License-Identifier: LGPL-2.1-or-later
"""Handles of a plane or a part of it, and what is seen of it."""

import math

import FreeCAD
from pivy import coin

from .colours import TOOL
from .grips import arrows, ball, sb_rotation, turned
from .handles import REACH, Handles
from .nodes import material, paint, set_values, style, two_sided
from .tool_marks import arc, head_of_arc, ray

_Z = FreeCAD.Vector(0, 0, 1)
_RADIUS = 27  # pixels from the middle to the end of the arrows on a border
_FEW = 12  # corners, each of which has an edge from wall to wall of a slot
_HINT = 25  # degrees of the arc that shows the sense of an angle of 0


class PlaneHandles(Handles):
    """Arrow along the normal, ball to tilt; the plane itself, or its part, as a pane. For a part of the plane also four
    arrows to move it in the plane, and where it has a radius, arrows on its border."""

    BALL = 32

    def _add_tool_shape(self, pane):
        self._pane_turn, self._corners = coin.SoRotation(), coin.SoCoordinate3()
        self._corners.setName("FemScalpelPane")
        pane.addChild(self._pane_turn)
        pane.addChild(self._corners)
        frame = coin.SoSeparator()
        paint(frame, TOOL, style(2.0))
        self._frame = coin.SoIndexedLineSet()
        frame.addChild(self._frame)
        pane.addChild(frame)
        hints = two_sided()
        hints.faceType = coin.SoShapeHints.UNKNOWN_FACE_TYPE  # a polygon may be concave
        pane.addChild(hints)
        pane.addChild(material(TOOL, 0.85))
        self._face = coin.SoIndexedFaceSet()
        pane.addChild(self._face)
        self._reaches = math.inf
        self.show_outline(None)

    def show_outline(self, outline, width=0.0):
        """Shows the part of the plane within `outline`, (x, y) in order around it in its own axes; None: all of it. Of
        a slot of a `width`, both walls."""
        half = 0.36 * self._size
        corners = outline or [(-half, -half), (half, -half), (half, half), (-half, half)]
        self._reaches = max(math.hypot(x, y) for x, y in outline) if outline else math.inf
        count, heights = len(corners), (-width / 2, width / 2) if width > 0 else (0.0,)
        set_values(self._corners.point, [(x, y, z) for z in heights for x, y in (*corners, corners[0])])
        loops = [range(first, first + count + 1) for first in range(0, len(heights) * (count + 1), count + 1)]
        lines = [[*loop, -1] for loop in loops]
        if len(loops) == 2 and count <= _FEW:
            lines += [[a, b, -1] for a, b in zip(loops[0], loops[1][:-1])]
        set_values(self._frame.coordIndex, [k for line in lines for k in line])
        set_values(self._face.coordIndex, [k for loop in loops for k in (*loop[:-1], -1)])

    def _make_draggers(self):
        # The ball takes every click within it, so the arrow begins at it.
        first = self.BALL / REACH
        self._add(
            "move",
            coin.SoTranslate1Dragger(),
            REACH,
            lambda rgb: arrows(rgb, ((1, 0, 0), first, 1)),
            (turned((1, 0, 0), (0, 0, 1)),),
        )
        self._add("tilt", coin.SoRotateSphericalDragger(), self.BALL, ball)
        self._angle, self._border, self._between = coin.SoRotation(), coin.SoTranslation(), coin.SoRotation()
        self._in_plane = FreeCAD.Rotation()
        both = ((1, 0, 0), 0.1, 1), ((-1, 0, 0), 0.1, 1)
        self._add(
            "radius", coin.SoTranslate1Dragger(), _RADIUS, lambda rgb: arrows(rgb, *both), (self._angle, self._border)
        )
        four = [(direction, first, 1) for direction in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]
        self._add("slide", coin.SoTranslate2Dragger(), REACH, lambda rgb: arrows(rgb, *four), (self._between,))
        self.show_part(False)

    def show_part(self, movable, turn=None):
        """Whether there is a part of the plane to move; by how many degrees its first axis is turned about the normal,
        None where that does not matter."""
        self._switch("slide", movable)
        self._show_turn(turn)
        turn = turn or 0.0
        self._angle.rotation.setValue(sb_rotation(FreeCAD.Rotation(_Z, turn)))
        self._pane_turn.rotation.setValue(sb_rotation(FreeCAD.Rotation(_Z, turn)))
        # Between the arrows on the border, which may be as far away.
        self._in_plane = FreeCAD.Rotation(_Z, turn + 45)
        self._between.rotation.setValue(sb_rotation(self._in_plane))

    def _show_turn(self, turn):
        """Shows where the angle is 0, and how it counts."""
        if turn is None:
            self._tool_marks.hide()
            return
        radius = 0.25 * self._size
        shown = turn if abs(turn) > 1 else _HINT
        curve = arc(radius, 0, shown)
        head = head_of_arc(radius, shown, math.copysign(1, shown))
        # An angle of 0 has no arc of its own, but counts this way.
        solid, dashed = ([head], [curve]) if shown != turn else ([curve, head], [])
        self._tool_marks.show(solid, [ray(1.15 * radius, 0), *dashed], angle=ray(1.15 * radius, 0)[1])

    def set_pose(self, position, rotation, radius=0.0):
        super().set_pose(position, rotation, radius)
        self._switch("radius", radius > 0)

    def _arrange(self):
        # Beyond the ball, which takes every click within it.
        self._border.translation.setValue(max(self._radius, self.BALL * self._pixel) + self._lengths["radius"], 0, 0)

    def _extent(self):
        return self._reaches, None

    def _local(self):
        slide = self._in_plane.multVec(self._shift("slide"))
        return FreeCAD.Vector(slide.x, slide.y, self._shift("move").x), self._turn("tilt"), self._dragged_radius()
