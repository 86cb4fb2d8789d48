# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: incision, a slot between two parallel planes."""

import FreeCAD
import numpy as np

import femscalpel

from ..translate import QT_TRANSLATE_NOOP, translate
from . import fields
from .plane_panel import PlanePanel
from .placements import Z, Turn, as_text, turn_between, turned


class IncisionPanel(PlanePanel):
    """Asks for the middle plane and the width of a slot, and where it ends: another bottom that a document object has
    can stay."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Incision")
    ICON = "FemScalpel_Incision"
    GROUP_NAME, OBJECT_NAME, MAKE = "CUT", "Incision", "makeCut"

    def add_inputs(self):
        self.slot = self.insert_form("incision.ui")
        self._width = fields.Number(self.slot.slotWidth, self._choose, self.geometry.size / 50)
        self._kept = None  # the bottom of the document object, as a placement
        for text, data in (
            (translate("FemScalpel", "Through the whole part"), "Through"),
            (translate("FemScalpel", "Down to the point"), "Point"),
        ):
            self.slot.slotEnd.addItem(text, data)
        self._turn = Turn(
            self.geometry, lambda: self._end() == "Point", fields.Number(self.slot.slotTurn, self._choose, 0, 10)
        )
        self.slot.slotEnd.currentIndexChanged.connect(lambda *_: self._choose())
        self._choose()
        # Two walls are made by moving and splitting only.
        self.options.method.setCurrentIndex(self.options.method.findData("snap"))
        self.options.method.setEnabled(False)

    def turn(self):
        return self._turn.value

    def enter_turn(self, degrees):
        self._turn.set(degrees)

    def _end(self):
        return self.slot.slotEnd.currentData()

    def _choose(self):
        for box in (self.slot.turnLabel, self.slot.slotTurn):
            box.setVisible(self._end() == "Point")
        if self._end() == "Point":
            self.geometry.show_part(False, None, self._turn, self._outline, self._width)
        else:
            self.geometry.show_part(False, None, None, None, self._width)
        self.update()

    def _outline(self):
        """Corners (x, y) of the half of the middle plane in which the slot is, as far as it is drawn."""
        half = 0.36 * self.geometry.size
        return [(0, -half), (half, -half), (half, half), (0, half)]

    def placement(self):
        # So that an expression for the turn takes the bottom along, see following.follow().
        plane = self.geometry.placement()
        return turned(plane, self._turn.value) if self._turn.has_expression and self._end() == "Point" else plane

    def _bottom_placement(self):
        """Placement whose z axis points from the bottom into the material that stays; None without a bottom."""
        if self._end() == "Kept":
            return self._kept
        if self._end() == "Through":
            return None
        plane = turned(self.geometry.placement(), self._turn.value)
        return FreeCAD.Placement(plane.Base, plane.Rotation * FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), -90))

    def _bottom(self):
        bottom = self._bottom_placement()
        return None if bottom is None else femscalpel.Plane(bottom.Base, bottom.Rotation.multVec(Z))

    def operation(self, tool, options):
        width, bottom = self._width.value, self._bottom()
        return lambda scalpel, band_only: scalpel.cut(tool, width=width, bottom=bottom, band_only=band_only, **options)

    def surface(self, tool):
        return _Walls(tool, self._width.value)

    def removed_region(self, tool):
        return _Slot(tool, self._width.value, self._bottom())

    def read(self, obj):
        super().read(obj)
        self._width.set(obj.Width.Value)
        if not obj.Through:
            self._kept = obj.BottomPlacement
            mouth, normal = self._kept.Rotation.multVec(Z).negative(), self.geometry.direction()
            if (
                self._kept.Base.isEqual(self.geometry.origin(), 1e-9 * self.geometry.size)
                and abs(mouth.dot(normal)) < 1e-9 * normal.Length
            ):
                self._turn.set(
                    turn_between(self.geometry.rotation(), FreeCAD.Rotation(mouth, FreeCAD.Vector(), normal, "ZXY"))
                )
                end = "Point"
            else:
                if self.slot.slotEnd.findData("Kept") < 0:
                    self.slot.slotEnd.addItem(translate("FemScalpel", "At the bottom it has"), "Kept")
                end = "Kept"
            self.slot.slotEnd.setCurrentIndex(self.slot.slotEnd.findData(end))

    def arguments(self):
        arguments = {**super().arguments(), "width": repr(self._width.value)}
        bottom = self._bottom_placement()
        if self._turn.has_expression:
            del arguments["origin"], arguments["normal"]
            arguments = {"placement": self.placement_text(), **arguments}
        if bottom is not None:
            arguments["bottom"] = as_text(bottom)
        del arguments["method"]
        return arguments

    def settings(self):
        bottom = self._bottom_placement()
        placed = {} if bottom is None else {"BottomPlacement": as_text(bottom)}
        return {**super().settings(), "Width": repr(self._width.value), "Through": repr(bottom is None), **placed}

    def forget_widgets(self):
        super().forget_widgets()
        self.slot = self._width = self._turn = None


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
