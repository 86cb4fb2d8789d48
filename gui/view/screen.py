# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the model is on the screen, and how large."""

import math

import FreeCAD
from pivy import coin


class Screen:
    """What a 3-D view shows just now: its camera and its size in pixels. Raises RuntimeError or AttributeError when the
    view is gone."""

    def __init__(self, view):
        self.width, self.height = (max(1, n) for n in view.getSize())
        self._camera = view.getCameraNode()

    def pixel(self, point):
        """The length in the model of one pixel of the screen at a point."""
        camera, shorter = self._camera, min(
            self.width, self.height
        )  # Coin fits the camera's height to the shorter side
        if camera.isOfType(coin.SoOrthographicCamera.getClassTypeId()):
            return camera.height.getValue() / shorter
        right, up, back = self._axes()
        away = -(FreeCAD.Vector(point) - FreeCAD.Vector(*camera.position.getValue().getValue())).dot(back)
        return 2 * max(away, 1e-9) * math.tan(camera.heightAngle.getValue() / 2) / shorter

    def place(self, point):
        """Where a point is, in pixels from the lower left corner."""
        volume = self._camera.getViewVolume(self.width / self.height)
        if self.width < self.height:
            volume.scale(self.height / self.width)
        x, y, _ = volume.projectToScreen(coin.SbVec3f(*point)).getValue()
        return x * self.width, y * self.height

    def direction(self, x, y):
        """The direction in the model that goes so far to the right and up on the screen."""
        right, up, _ = self._axes()
        return right * x + up * y

    def turned_to_it(self, direction):
        """(x, y) of a direction of the model as it is seen: to the right, up."""
        right, up, _ = self._axes()
        return right.dot(direction), up.dot(direction)

    def _axes(self):
        rotation = FreeCAD.Rotation(*self._camera.orientation.getValue().getValue())
        return [rotation.multVec(FreeCAD.Vector(*axis)) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
