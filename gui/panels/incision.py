# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: incision, a slot between two parallel planes."""

import numpy as np

import femscalpel

from ..translate import QT_TRANSLATE_NOOP
from . import fields
from .plane_panel import PlanePanel


class IncisionPanel(PlanePanel):
    """Asks for the middle plane and the width of a slot. A bottom that a document object has is kept."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Incision")
    ICON = "FemScalpel_Incision"
    GROUP_NAME, OBJECT_NAME, MAKE = "CUT", "Cut", "makeCut"

    def add_inputs(self):
        self.slot = self.insert_form("incision.ui")
        self._width = fields.Number(self.slot.slotWidth, self.update, self.geometry.size / 50)
        self._bottom = None  # femscalpel.Plane
        # Two walls are made by moving and splitting only.
        self.options.method.setCurrentIndex(self.options.method.findData("snap"))
        self.options.method.setEnabled(False)

    def operation(self, tool, options):
        width, bottom = self._width.value, self._bottom
        return lambda scalpel: scalpel.cut(tool, width=width, bottom=bottom, band_only=True, **options)

    def surface(self, tool):
        return _Walls(tool, self._width.value)

    def removed_region(self, tool):
        return _Slot(tool, self._width.value, self._bottom)

    def read(self, obj):
        super().read(obj)
        self._width.set(obj.Width.Value)
        if not obj.Through:
            bottom = obj.BottomPlacement
            self._bottom = femscalpel.Plane(bottom.Base, bottom.Rotation.multVec(type(bottom.Base)(0, 0, 1)))

    def arguments(self):
        arguments = {**super().arguments(), "width": repr(self._width.value)}
        del arguments["method"]
        return arguments

    def settings(self):
        return {**super().settings(), "Width": repr(self._width.value)}

    def forget_widgets(self):
        super().forget_widgets()
        self.slot = self._width = None


class _Walls:
    """Both walls of a slot as one surface."""

    def __init__(self, middle, width):
        self._middle, self._width = middle, width

    def distance(self, points):
        """Zero on the walls, positive beyond the one on the middle plane's positive side."""
        out = self._middle.distance(points)
        return np.sign(out) * (np.abs(out) - self._width / 2)


class _Slot:
    """What an incision takes away."""

    def __init__(self, middle, width, bottom):
        self._middle, self._width, self._bottom = middle, width, bottom

    def distance(self, points):
        """Negative inside, as a tool's."""
        out = np.abs(self._middle.distance(points)) - self._width / 2
        return out if self._bottom is None else np.maximum(out, self._bottom.distance(points))
