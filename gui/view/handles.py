# SPDX-License-Identifier: LGPL-2.1-or-later
"""Handles in the 3-D view to move and tilt a plane or an axis with the mouse: Coin's draggers."""

import FreeCAD
import numpy as np
from pivy import coin

from .colours import HIGHLIGHT, TOOL
from .nodes import PointNode, material, two_sided

NAME = "FemScalpelHandles"
_Z = FreeCAD.Vector(0, 0, 1)


def _sb_rotation(rotation):
    return coin.SbRotation(*rotation.Q)


class Handles:
    """Draggers around one pose: a position and a rotation whose z axis is the plane's normal or the cylinder's axis.

    `changed(position, rotation, radius)` is called while the mouse drags, and when it lets go.
    """

    def __init__(self, view, size, changed):
        self._view, self._size, self._changed = view, size, changed
        self._quiet = False
        self._position, self._rotation, self._radius = FreeCAD.Vector(), FreeCAD.Rotation(), 0.0
        self.root = coin.SoSeparator()
        self._place = coin.SoTransform()
        self.root.addChild(self._place)
        self._tool_switch = coin.SoSwitch()
        self._tool_switch.whichChild = 0
        self._tool_switch.addChild(self._tool_shape())
        self.root.addChild(self._tool_switch)
        self._draggers, self._callbacks, self._lengths = [], [], {}
        # In front of everything: they would be out of reach inside the part.
        self._front = coin.SoAnnotation()
        self.root.addChild(self._front)
        self._make_draggers()
        self._marks = PointNode("FemScalpelPicked", HIGHLIGHT, 10.0)
        marks = coin.SoAnnotation()
        marks.addChild(self._marks.root)
        top = coin.SoSeparator()
        top.setName(NAME)
        top.addChild(self.root)
        top.addChild(marks)
        self.root = top
        view.getSceneGraph().addChild(self.root)

    def close(self):
        """Takes the handles out of the view."""
        try:
            graph = self._view.getSceneGraph()
        except (RuntimeError, AttributeError):
            return
        for dragger, kind, function in self._callbacks:
            self._view.removeDraggerCallback(dragger, kind, function)
        if graph.findChild(self.root) >= 0:
            graph.removeChild(self.root)
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

    def _add(self, name, dragger, length, before=()):
        """Adds a dragger that reaches `length` from its place."""
        self._lengths[name] = length
        branch = coin.SoSeparator()
        for node in before:
            branch.addChild(node)
        scale = coin.SoScale()
        scale.scaleFactor.setValue(length, length, length)
        branch.addChild(scale)
        branch.addChild(dragger)
        self._front.addChild(branch)
        self._draggers.append((name, dragger))
        # Through FreeCAD's view, which takes Python's lock first; pivy's own callbacks do not.
        for kind, function in (("addMotionCallback", self._moved), ("addFinishCallback", self._finish)):
            self._callbacks.append((dragger, kind, function))
            self._view.addDraggerCallback(dragger, kind, function)

    def _moved(self, dragger):
        if not self._quiet:
            self._changed(*self._pose())

    def _finish(self, dragger):
        if self._quiet:
            return
        pose = self._pose()
        self.set_pose(*pose)
        self._changed(*pose)

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
    """Arrow along the normal, cross in the plane, ball to tilt; the plane itself as a pane."""

    def _tool_shape(self):
        pane = coin.SoSeparator()
        pick = coin.SoPickStyle()
        pick.style = coin.SoPickStyle.UNPICKABLE
        pane.addChild(pick)
        half = 0.36 * self._size
        corners = coin.SoCoordinate3()
        corners.point.setValues(0, 4, [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)])
        pane.addChild(corners)
        frame = coin.SoSeparator()
        light = coin.SoLightModel()
        light.model = coin.SoLightModel.BASE_COLOR
        frame.addChild(light)
        frame.addChild(material(TOOL))
        line = coin.SoIndexedLineSet()
        line.coordIndex.setValues(0, 6, [0, 1, 2, 3, 0, -1])
        frame.addChild(line)
        pane.addChild(frame)
        pane.addChild(two_sided())
        pane.addChild(material(TOOL, 0.85))
        face = coin.SoFaceSet()
        face.numVertices = 4
        pane.addChild(face)
        return pane

    def _make_draggers(self):
        upright = coin.SoRotation()
        upright.rotation.setValue(_sb_rotation(FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), _Z)))
        # The ball takes every click within it, so the arrow is longer.
        self._add("move", coin.SoTranslate1Dragger(), 0.16 * self._size, (upright,))
        self._add("tilt", coin.SoRotateSphericalDragger(), 0.08 * self._size)

    def _local(self):
        shift = self._shift("move")
        return FreeCAD.Vector(0, 0, shift.x), self._turn("tilt"), 0.0


class AxisHandles(Handles):
    """Cross to move the axis sideways, ball to tilt it, arrow on the wall for the radius; the cylinder itself as a pane."""

    def _tool_shape(self):
        pane = coin.SoSeparator()
        pick = coin.SoPickStyle()
        pick.style = coin.SoPickStyle.UNPICKABLE
        pane.addChild(pick)
        axis = coin.SoSeparator()
        light = coin.SoLightModel()
        light.model = coin.SoLightModel.BASE_COLOR
        axis.addChild(light)
        axis.addChild(material(TOOL))
        ends = coin.SoCoordinate3()
        ends.point.setValues(0, 2, [(0, 0, -0.6 * self._size), (0, 0, 0.6 * self._size)])
        axis.addChild(ends)
        axis.addChild(coin.SoLineSet())
        pane.addChild(axis)
        upright = coin.SoRotation()
        upright.rotation.setValue(_sb_rotation(FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), _Z)))
        pane.addChild(upright)
        pane.addChild(two_sided())
        pane.addChild(material(TOOL, 0.85))
        self._cylinder = coin.SoCylinder()
        self._cylinder.height = 1.2 * self._size
        self._cylinder.parts = coin.SoCylinder.SIDES
        pane.addChild(self._cylinder)
        return pane

    def _make_draggers(self):
        self._wall = coin.SoTranslation()
        # Between the arrows of the cross, which may be as long as the radius.
        between = coin.SoRotation()
        between.rotation.setValue(_sb_rotation(FreeCAD.Rotation(_Z, 45)))
        self._add("radius", coin.SoTranslate1Dragger(), 0.05 * self._size, (between, self._wall))
        self._add("tilt", coin.SoRotateSphericalDragger(), 0.05 * self._size)
        self._add("move", coin.SoTranslate2Dragger(), 0.12 * self._size)

    def set_pose(self, position, rotation, radius=0.0):
        super().set_pose(position, rotation, radius)
        self._cylinder.radius = max(radius, 1e-6 * self._size)
        # Beyond the ball, which takes every click within it.
        self._wall.translation.setValue(max(radius, 0.05 * self._size) + 0.05 * self._size, 0, 0)

    def _local(self):
        shift = self._shift("move")
        radius = max(self._radius + self._shift("radius").x, 1e-3 * self._size)
        return FreeCAD.Vector(shift.x, shift.y, 0), self._turn("tilt"), radius
