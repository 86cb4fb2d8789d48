# SPDX-License-Identifier: LGPL-2.1-or-later
"""Handles in the 3-D view to move and tilt a tool with the mouse: Coin's draggers."""

import FreeCAD
import numpy as np
from pivy import coin
from PySide import QtCore

from .colours import GRIP, HIGHLIGHT
from .grips import sb_rotation
from .label import pixel_ratio
from .nodes import LineNode, PointNode
from .overlay import Overlay, unpickable
from .screen import Screen
from .tool_marks import ToolMarks

NAME = "FemScalpelHandles"
#: How far the handles reach around their middle, in pixels.
REACH = 70
#: Milliseconds between two looks at the camera. Coin could tell, but pivy does not take Python's lock then.
_LOOK = 50
# A tool this much smaller than the ball, in its radii, would be covered.
_COVERED = 1.3
_UNSEEN = 3  # a tool of so few pixels is seen by a point only
_GAP = 14  # pixels between such a tool and the handles
_DIAGONAL = 0.5**0.5
_ASIDE = ((_DIAGONAL, _DIAGONAL), (-_DIAGONAL, _DIAGONAL), (_DIAGONAL, -_DIAGONAL), (-_DIAGONAL, -_DIAGONAL))


class Handles(Overlay):
    """Draggers around one pose: a position and a rotation whose z axis is the plane's normal or the cylinder's axis.

    They have the same size on the screen whatever the camera, and stand beside a tool that they would cover.
    `changed(position, rotation, radius, done)` is called while the mouse drags, and when it lets go; then set_pose() is
    to follow.
    """

    #: Radius of the ball in pixels, set by subclasses.
    BALL = 0

    def __init__(self, view, size, changed):
        super().__init__(view, NAME)
        self._size, self._changed = size, changed
        self._quiet = self._dragged = False
        self._position, self._rotation, self._radius = FreeCAD.Vector(), FreeCAD.Rotation(), 0.0
        self._pixel, self._beside = Screen(view).pixel(self._position) * pixel_ratio(), FreeCAD.Vector()
        posed = coin.SoSeparator()
        self.root.addChild(posed)
        self._place = coin.SoTransform()
        posed.addChild(self._place)
        pane = coin.SoSeparator()
        pane.addChild(unpickable())
        self._add_tool_shape(pane)
        posed.addChild(pane)
        self._tool_marks = ToolMarks()
        posed.addChild(self._tool_marks.root)
        self._draggers, self._callbacks, self._lengths, self._switches, self._scales = [], [], {}, {}, {}
        # In front of everything: they would be out of reach inside the part.
        self._front, self._shown = coin.SoAnnotation(), coin.SoSwitch()
        self._shown.whichChild = coin.SO_SWITCH_ALL
        self._leader = LineNode("FemScalpelLeader", GRIP, 1.0)
        self._small = PointNode("FemScalpelSmallTool", GRIP, 4.0)
        leader = coin.SoAnnotation()
        for node in (unpickable(), self._leader.root, self._small.root):
            leader.addChild(node)
        self._aside = coin.SoTranslation()
        self._aside.setName("FemScalpelAside")
        self._front.addChild(self._aside)
        for node in (leader, self._front):
            self._shown.addChild(node)
        posed.addChild(self._shown)
        self._make_draggers()
        self._marks = PointNode("FemScalpelPicked", HIGHLIGHT, 10.0)
        marks = coin.SoAnnotation()
        marks.addChild(self._marks.root)
        self.root.addChild(marks)
        self.open()
        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._look)
        self._timer.start(_LOOK)

    def close(self):
        """Takes the handles out of the view."""
        self._timer.stop()
        super().close()
        try:
            for dragger, kind, function in self._callbacks:
                self._view.removeDraggerCallback(dragger, kind, function)
        except (RuntimeError, AttributeError):  # the view is gone
            pass
        self._draggers.clear()
        self._callbacks.clear()

    def set_pose(self, position, rotation, radius=0.0):
        """Moves the handles without calling `changed`."""
        self._position, self._rotation, self._radius = FreeCAD.Vector(position), FreeCAD.Rotation(rotation), radius
        self._quiet, self._dragged = True, False
        self._place.translation.setValue(*position)
        self._place.rotation.setValue(sb_rotation(rotation))
        self._reset()
        self._look(always=True)
        self._quiet = False

    def mark(self, points):
        """Marks picked points."""
        self._marks.show(np.array(points, np.float32).reshape(-1, 3))

    def show_grips(self, on):
        """Whether there is something to grab: it would take clicks that are meant for what is behind it."""
        self._shown.whichChild = coin.SO_SWITCH_ALL if on else coin.SO_SWITCH_NONE

    def dragger(self, name):
        """The Coin dragger "move", "tilt", ... for tests."""
        return next(d for n, d in self._draggers if n == name)

    def _add(self, name, dragger, pixels, look, before=()):
        """Adds a dragger that reaches so many pixels from its place; look(rgb) makes what is seen of it, 1 for that
        length."""
        part = "rotator" if name == "tilt" else "translator"
        dragger.setPart(part, look(GRIP))
        dragger.setPart(part + "Active", look(HIGHLIGHT))
        in_plane = ("xAxisFeedback", "yAxisFeedback") if isinstance(dragger, coin.SoTranslate2Dragger) else ()
        for feedback in ("feedback", "feedbackActive", *in_plane):
            dragger.setPart(feedback, coin.SoSeparator())
        branch = coin.SoSeparator()
        for node in before:
            branch.addChild(node)
        self._scales[name] = coin.SoScale(), pixels
        branch.addChild(self._scales[name][0])
        branch.addChild(dragger)
        self._switches[name] = coin.SoSwitch()
        self._switches[name].whichChild = coin.SO_SWITCH_ALL
        self._switches[name].addChild(branch)
        self._front.addChild(self._switches[name])
        self._draggers.append((name, dragger))
        self._scale(name)
        # Through FreeCAD's view, which takes Python's lock first; pivy's own callbacks do not.
        for kind, function in (("addMotionCallback", self._moved), ("addFinishCallback", self._finish)):
            self._callbacks.append((dragger, kind, function))
            self._view.addDraggerCallback(dragger, kind, function)

    def _switch(self, name, shown):
        """Shows or hides a dragger."""
        self._switches[name].whichChild = coin.SO_SWITCH_ALL if shown else coin.SO_SWITCH_NONE

    # Their size and place on the screen.

    def _scale(self, name):
        scale, pixels = self._scales[name]
        self._lengths[name] = length = pixels * self._pixel
        scale.scaleFactor.setValue(length, length, length)

    def _look(self, always=False):
        """Gives the handles their size and place on the screen, if the camera or the tool is another one."""
        if self._dragged:
            return
        try:
            screen = Screen(self._view)
            pixel = screen.pixel(self._position) * pixel_ratio()
            beside = self._rotation.inverted().multVec(self._way_aside(screen, pixel))
        except (RuntimeError, AttributeError):  # the view is gone
            self._timer.stop()
            return
        is_same = abs(pixel - self._pixel) <= 0.01 * self._pixel and (beside - self._beside).Length <= 2 * pixel
        if is_same and not always:
            return
        self._pixel, self._beside = pixel, beside
        for name in self._scales:
            self._scale(name)
        self._aside.translation.setValue(*beside)
        if beside.Length > 0:
            extent = self._extent()[0]
            ends = beside * (extent / beside.Length), beside * (1 - self.BALL * pixel / beside.Length)
            self._leader.show(np.array([[tuple(end) for end in ends]]))
            self._small.show(np.zeros((1 if extent < _UNSEEN * pixel else 0, 3)))
        else:
            self._leader.hide()
            self._small.hide()
        self._arrange()

    def _way_aside(self, screen, pixel):
        """From the tool's place to that of the handles: nothing, unless they would cover the tool."""
        extent, axis = self._extent()
        if not extent < _COVERED * self.BALL * pixel:
            return FreeCAD.Vector()
        ways, reach = _ASIDE, extent / pixel + REACH + _GAP
        right, up = screen.turned_to_it(axis) if axis is not None else (0.0, 0.0)
        seen = (right**2 + up**2) ** 0.5
        if seen > 0.2:  # the tool goes on along its axis, so across
            across = (-up / seen, right / seen) if right >= 0 else (up / seen, -right / seen)
            ways = (across, (-across[0], -across[1]))
        x, y = screen.place(self._position)
        scale = pixel_ratio()

        def room(way):
            at = x + way[0] * reach * scale, y + way[1] * reach * scale
            return min(at[0], screen.width - at[0], at[1], screen.height - at[1]) / scale

        right, up = next((way for way in ways if room(way) > REACH), max(ways, key=room))
        return screen.direction(right, up) * (reach * pixel)

    def _extent(self):
        """How far the tool reaches from its place, across its axis where it goes on along that; and such an axis, or
        None."""
        raise NotImplementedError

    def _arrange(self):
        """Puts handles to their places, after a change of size."""

    def _moved(self, dragger):
        if not self._quiet:
            self._dragged = True
            self._changed(*self._pose(), False)

    def _finish(self, dragger):
        if self._quiet:
            return
        self._dragged = False
        self._changed(*self._pose(), True)

    def _local(self):
        """Translation in units of the model and rotation the draggers show, in the pose's own axes; radius."""
        raise NotImplementedError

    def _reset(self):
        for _, dragger in self._draggers:
            for field in ("translation", "rotation"):
                if hasattr(dragger, field):
                    getattr(dragger, field).setValue(*((0, 0, 0) if field == "translation" else (0, 0, 0, 1)))

    def _pose(self):
        shift, turn, radius = self._local()
        return self._position + self._rotation.multVec(shift), self._rotation.multiply(turn), radius

    def _shift(self, name):
        return FreeCAD.Vector(*self.dragger(name).translation.getValue().getValue()) * self._lengths[name]

    def _turn(self, name):
        return FreeCAD.Rotation(*self.dragger(name).rotation.getValue().getValue())

    def _dragged_radius(self):
        if not self._radius > 0:
            return 0.0
        shift = self._shift("radius").x
        return max(self._radius + shift, min(self._radius, 1e-3 * self._size)) if shift else self._radius
