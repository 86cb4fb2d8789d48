# SPDX-License-Identifier: LGPL-2.1-or-later
"""Handles in the 3-D view to move and tilt a plane or an axis with the mouse: Coin's draggers."""

import FreeCAD
import numpy as np
from pivy import coin

from . import faces as mesh_faces
from .colours import GRIP, HIGHLIGHT, TOOL
from .nodes import PointNode, material, paint, set_values, style, two_sided
from .overlay import Overlay, unpickable
from .profiles import ENDLESS, PROFILES, revolved

NAME = "FemScalpelHandles"
_Z = FreeCAD.Vector(0, 0, 1)


def _sb_rotation(rotation):
    return coin.SbRotation(*rotation.Q)


def _turned(start, end):
    """A node that turns the direction `start` to `end`."""
    node = coin.SoRotation()
    node.rotation.setValue(_sb_rotation(FreeCAD.Rotation(FreeCAD.Vector(*start), FreeCAD.Vector(*end))))
    return node


def _line(*points):
    line = coin.SoSeparator()
    coordinates = coin.SoCoordinate3()
    coordinates.point.setValues(0, len(points), points)
    line.addChild(coordinates)
    line.addChild(coin.SoLineSet())
    return line


def _grip(shape):
    """Something to grab that is not seen: thin lines are hard to hit."""
    grip = coin.SoSeparator()
    unseen = coin.SoDrawStyle()
    unseen.style = coin.SoDrawStyle.INVISIBLE
    grip.addChild(unseen)
    grip.addChild(shape)
    return grip


def _arrow(direction, start, end):
    """A thin arrow along a direction of x, y; `start` and `end` are distances from the middle, the head is 0.3 long."""
    arrow = coin.SoSeparator()
    arrow.addChild(_turned((0, 1, 0), direction))
    shaft = coin.SoSeparator()
    shaft.addChild(unpickable())
    light = coin.SoLightModel()
    light.model = coin.SoLightModel.BASE_COLOR
    shaft.addChild(light)
    shaft.addChild(style(2.0))
    shaft.addChild(_line((0, start, 0), (0, end - 0.3, 0)))
    arrow.addChild(shaft)
    place = coin.SoTranslation()
    place.translation.setValue(0, end - 0.15, 0)
    head = coin.SoCone()
    head.bottomRadius, head.height = 0.11, 0.3
    grip = coin.SoCylinder()
    grip.radius, grip.height = 0.14, end - start
    beside = coin.SoTranslation()
    beside.translation.setValue(0, (start + end) / 2 - (end - 0.15), 0)
    for node in (place, head, beside, _grip(grip)):
        arrow.addChild(node)
    return arrow


def _arrows(rgb, *arrows):
    """Arrows (direction, start, end) of one colour."""
    node = coin.SoSeparator()
    node.addChild(material(rgb))
    for arrow in arrows:
        node.addChild(_arrow(*arrow))
    return node


def _ball(rgb):
    """Three thin great circles of radius 1, to be grabbed anywhere within."""
    node = coin.SoSeparator()
    rings = coin.SoSeparator()
    rings.addChild(unpickable())
    paint(rings, rgb, style(1.5))
    angles = np.linspace(0, 2 * np.pi, 49)
    zero, c, s = np.zeros_like(angles), np.cos(angles), np.sin(angles)
    for ring in ((c, s, zero), (zero, c, s), (s, zero, c)):
        rings.addChild(_line(*np.stack(ring, axis=1).tolist()))
    node.addChild(rings)
    node.addChild(_grip(coin.SoSphere()))
    return node


class Handles(Overlay):
    """Draggers around one pose: a position and a rotation whose z axis is the plane's normal or the cylinder's axis.

    `changed(position, rotation, radius, done)` is called while the mouse drags, and when it lets go; then set_pose() is
    to follow.
    """

    def __init__(self, view, size, changed):
        super().__init__(view, NAME)
        self._size, self._changed = size, changed
        self._quiet = False
        self._position, self._rotation, self._radius = FreeCAD.Vector(), FreeCAD.Rotation(), 0.0
        posed = coin.SoSeparator()
        self.root.addChild(posed)
        self._place = coin.SoTransform()
        posed.addChild(self._place)
        pane = coin.SoSeparator()
        pane.addChild(unpickable())
        self._add_tool_shape(pane)
        posed.addChild(pane)
        self._draggers, self._callbacks, self._lengths, self._switches = [], [], {}, {}
        # In front of everything: they would be out of reach inside the part.
        self._front = coin.SoAnnotation()
        posed.addChild(self._front)
        self._make_draggers()
        self._marks = PointNode("FemScalpelPicked", HIGHLIGHT, 10.0)
        marks = coin.SoAnnotation()
        marks.addChild(self._marks.root)
        self.root.addChild(marks)
        self.open()

    def close(self):
        """Takes the handles out of the view."""
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
        self._quiet = True
        self._place.translation.setValue(*position)
        self._place.rotation.setValue(_sb_rotation(rotation))
        self._reset()
        self._quiet = False

    def mark(self, points):
        """Marks picked points."""
        self._marks.show(np.array(points, np.float32).reshape(-1, 3))

    def dragger(self, name):
        """The Coin dragger "move", "tilt", ... for tests."""
        return next(d for n, d in self._draggers if n == name)

    def _add(self, name, dragger, length, look, before=()):
        """Adds a dragger that reaches `length` from its place; look(rgb) makes what is seen of it, 1 for `length`."""
        self._lengths[name] = length
        part = "rotator" if name == "tilt" else "translator"
        dragger.setPart(part, look(GRIP))
        dragger.setPart(part + "Active", look(HIGHLIGHT))
        in_plane = ("xAxisFeedback", "yAxisFeedback") if isinstance(dragger, coin.SoTranslate2Dragger) else ()
        for feedback in ("feedback", "feedbackActive", *in_plane):
            dragger.setPart(feedback, coin.SoSeparator())
        branch = coin.SoSeparator()
        for node in before:
            branch.addChild(node)
        scale = coin.SoScale()
        scale.scaleFactor.setValue(length, length, length)
        branch.addChild(scale)
        branch.addChild(dragger)
        self._switches[name] = coin.SoSwitch()
        self._switches[name].whichChild = coin.SO_SWITCH_ALL
        self._switches[name].addChild(branch)
        self._front.addChild(self._switches[name])
        self._draggers.append((name, dragger))
        # Through FreeCAD's view, which takes Python's lock first; pivy's own callbacks do not.
        for kind, function in (("addMotionCallback", self._moved), ("addFinishCallback", self._finish)):
            self._callbacks.append((dragger, kind, function))
            self._view.addDraggerCallback(dragger, kind, function)

    def _switch(self, name, shown):
        """Shows or hides a dragger."""
        self._switches[name].whichChild = coin.SO_SWITCH_ALL if shown else coin.SO_SWITCH_NONE

    def _moved(self, dragger):
        if not self._quiet:
            self._changed(*self._pose(), False)

    def _finish(self, dragger):
        if self._quiet:
            return
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


class PlaneHandles(Handles):
    """Arrow along the normal, ball to tilt; the plane itself, or its part, as a pane. For a part of the plane also four
    arrows to move it in the plane, and where it has a radius, arrows on its border."""

    def _add_tool_shape(self, pane):
        self._pane_turn, self._corners = coin.SoRotation(), coin.SoCoordinate3()
        self._corners.setName("FemScalpelPane")
        pane.addChild(self._pane_turn)
        pane.addChild(self._corners)
        frame = coin.SoSeparator()
        paint(frame, TOOL, style(2.0))
        self._frame = coin.SoLineSet()
        frame.addChild(self._frame)
        pane.addChild(frame)
        hints = two_sided()
        hints.faceType = coin.SoShapeHints.UNKNOWN_FACE_TYPE  # a polygon may be concave
        pane.addChild(hints)
        pane.addChild(material(TOOL, 0.85))
        self._face = coin.SoFaceSet()
        pane.addChild(self._face)
        self.show_outline(None)

    def show_outline(self, outline):
        """Shows the part of the plane within `outline`, (x, y) in order around it in its own axes; None: all of it."""
        half = 0.36 * self._size
        corners = outline or [(-half, -half), (half, -half), (half, half), (-half, half)]
        set_values(self._corners.point, [(x, y, 0) for x, y in (*corners, corners[0])])
        self._frame.numVertices = len(corners) + 1
        self._face.numVertices = len(corners)

    def _make_draggers(self):
        # The ball takes every click within it, so the arrow begins at it.
        ball, arrow = 0.06 * self._size, 0.13 * self._size
        self._add(
            "move",
            coin.SoTranslate1Dragger(),
            arrow,
            lambda rgb: _arrows(rgb, ((1, 0, 0), ball / arrow, 1)),
            (_turned((1, 0, 0), (0, 0, 1)),),
        )
        self._add("tilt", coin.SoRotateSphericalDragger(), ball, _ball)
        self._angle, self._border, self._between = coin.SoRotation(), coin.SoTranslation(), coin.SoRotation()
        self._in_plane, cross, radius = FreeCAD.Rotation(), 0.13 * self._size, 0.05 * self._size
        both = ((1, 0, 0), 0.1, 1), ((-1, 0, 0), 0.1, 1)
        self._add(
            "radius", coin.SoTranslate1Dragger(), radius, lambda rgb: _arrows(rgb, *both), (self._angle, self._border)
        )
        four = [(direction, ball / cross, 1) for direction in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]
        self._add("slide", coin.SoTranslate2Dragger(), cross, lambda rgb: _arrows(rgb, *four), (self._between,))
        self.show_part(False)

    def show_part(self, movable, turn=0.0):
        """Whether there is a part of the plane to move; by how many degrees its first axis is turned about the
        normal."""
        self._switch("slide", movable)
        self._angle.rotation.setValue(_sb_rotation(FreeCAD.Rotation(_Z, turn)))
        self._pane_turn.rotation.setValue(_sb_rotation(FreeCAD.Rotation(_Z, turn)))
        # Between the arrows on the border, which may be as far away.
        self._in_plane = FreeCAD.Rotation(_Z, turn + 45)
        self._between.rotation.setValue(_sb_rotation(self._in_plane))

    def set_pose(self, position, rotation, radius=0.0):
        super().set_pose(position, rotation, radius)
        self._switch("radius", radius > 0)
        # Beyond the ball, which takes every click within it.
        self._border.translation.setValue(max(radius, 0.06 * self._size) + 0.05 * self._size, 0, 0)

    def _local(self):
        slide = self._in_plane.multVec(self._shift("slide"))
        radius = max(self._radius + self._shift("radius").x, 1e-3 * self._size) if self._radius > 0 else 0.0
        return FreeCAD.Vector(slide.x, slide.y, self._shift("move").x), self._turn("tilt"), radius


class AxisHandles(Handles):
    """Four arrows to move the axis sideways, ball to tilt it, arrows on the wall for the radius; the cylinder itself as
    a pane. For other surfaces of revolution also arrows along the axis."""

    def _add_tool_shape(self, pane):
        axis = coin.SoSeparator()
        paint(axis, TOOL, style(1.5))
        axis.addChild(_line((0, 0, -0.6 * self._size), (0, 0, 0.6 * self._size)))
        self._axis = coin.SoSwitch()
        self._axis.addChild(axis)
        self._axis.whichChild = coin.SO_SWITCH_ALL
        pane.addChild(self._axis)
        self._wall_points, self._wall_faces = coin.SoCoordinate3(), coin.SoIndexedFaceSet()
        self._shape, self._values = "Cylinder", {}
        for node in (self._wall_points, two_sided(), material(TOOL, 0.85), self._wall_faces):
            pane.addChild(node)

    def _make_draggers(self):
        self._wall = coin.SoTranslation()
        # Between the arrows that move the axis, which may be as long as the radius.
        between = coin.SoRotation()
        between.rotation.setValue(_sb_rotation(FreeCAD.Rotation(_Z, 45)))
        ball, cross, radius = 0.045 * self._size, 0.11 * self._size, 0.05 * self._size
        both = ((1, 0, 0), 0.1, 1), ((-1, 0, 0), 0.1, 1)
        self._add("radius", coin.SoTranslate1Dragger(), radius, lambda rgb: _arrows(rgb, *both), (between, self._wall))
        self._add("tilt", coin.SoRotateSphericalDragger(), ball, _ball)
        four = [(direction, ball / cross, 1) for direction in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))]
        self._add("move", coin.SoTranslate2Dragger(), cross, lambda rgb: _arrows(rgb, *four))
        two = [(direction, ball / cross, 1) for direction in ((1, 0, 0), (-1, 0, 0))]
        along = _turned((1, 0, 0), (0, 0, 1))
        self._add("along", coin.SoTranslate1Dragger(), cross, lambda rgb: _arrows(rgb, *two), (along,))
        self._switch("along", False)

    def show_shape(self, shape, values, tilted):
        """Says what tool it is, by the name of its class, with its `values` beside the radius; whether it can be
        `tilted`. set_pose() is to follow."""
        self._shape, self._values = shape, {**self._values, **values}
        self._switch("along", shape not in ENDLESS)
        self._switch("tilt", tilted)
        self._axis.whichChild = coin.SO_SWITCH_ALL if tilted else coin.SO_SWITCH_NONE

    def show_depth(self, depth):
        """Says how far beyond its position a hole ends, None for one that does not. set_pose() is to follow."""
        self._values["depth"] = depth

    def set_pose(self, position, rotation, radius=0.0):
        super().set_pose(position, rotation, radius)
        profile = PROFILES.get(self._shape, lambda *_: ())(max(radius, 1e-6 * self._size), self._values, self._size)
        points, faces = revolved(profile)
        set_values(self._wall_points.point, np.ascontiguousarray(points, np.float32))
        set_values(self._wall_faces.coordIndex, mesh_faces.coin_index(faces)[0])
        # Beyond the ball, which takes every click within it.
        self._wall.translation.setValue(max(radius, 0.045 * self._size) + 0.05 * self._size, 0, 0)

    def _local(self):
        shift = self._shift("move")
        radius = max(self._radius + self._shift("radius").x, 1e-3 * self._size)
        return FreeCAD.Vector(shift.x, shift.y, self._shift("along").x), self._turn("tilt"), radius
