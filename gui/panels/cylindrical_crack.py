# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along a cylinder or a part of it."""

import femscalpel

from ..translate import QT_TRANSLATE_NOOP
from . import fields
from .cylinder_panel import CylinderPanel
from .placements import X, Turn, turn_between, turned


class CylindricalCrackPanel(CylinderPanel):
    """Asks for the cylinder of a crack, and for the heights and angles between which it cracks."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Cylindrical crack")
    ICON = "FemScalpel_CylindricalCrack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "CylindricalCrack", "makeCylindricalCrack"

    def add_inputs(self):
        self.part = self.insert_form("cylinder_part.ui")
        self._low = fields.Number(self.part.partLow, self.update, -self.geometry.size / 10)
        self._high = fields.Number(self.part.partHigh, self.update, self.geometry.size / 10)
        self._start = fields.Number(self.part.partStart, self.update, 0, 10)
        self._end = fields.Number(self.part.partEnd, self.update, 360, 10)
        self._turn = Turn(self.geometry, self.part.bounded.isChecked)  # of the direction angles are measured from
        self.part.bounded.toggled.connect(self._bound)

    def _bound(self, on):
        for box in (self.part.partLow, self.part.partHigh, self.part.partStart, self.part.partEnd):
            box.setEnabled(on)
        self.update()

    def update(self):
        if not self._closed and self.source is not None:
            ends = (self._low, self._high, self._start, self._end, self._turn)
            bounded = self.part.bounded.isChecked()
            self.geometry.show_part(tuple(number.value for number in ends) if bounded else None)
        super().update()

    def placement(self):
        """The axis, its x axis where the angles are measured from."""
        return turned(self.geometry.placement(), self._turn.value)

    def turn(self):
        return self._turn.value

    def enter_turn(self, degrees):
        self._turn.set(degrees)

    def _within(self):
        if not self.part.bounded.isChecked():
            return None
        along, start, end = (self._low.value, self._high.value), self._start.value, self._end.value
        if end - start == 360:
            return femscalpel.CylinderPart(along)
        return femscalpel.CylinderPart(along, (start, end), self.placement().Rotation.multVec(X))

    def operation(self, tool, options):
        within = self._within()
        return lambda scalpel, band_only: scalpel.crack(tool, within=within, band_only=band_only, **options)

    def read(self, obj):
        super().read(obj)
        self._turn.set(turn_between(self.geometry.rotation(), obj.AxisPlacement.Rotation))
        self._start.set(obj.StartAngle.Value)
        self._end.set(obj.EndAngle.Value)
        self._low.set(obj.Low.Value)
        self._high.set(obj.High.Value)
        self.part.bounded.setChecked(obj.Bounded)

    def arguments(self):
        arguments = super().arguments()
        if not self.part.bounded.isChecked():
            return arguments
        arguments["along"] = repr((self._low.value, self._high.value))
        if self._end.value - self._start.value != 360:
            del arguments["origin"], arguments["axis"]
            arguments = {
                "placement": self.placement_text(),
                **arguments,
                "angles": repr((self._start.value, self._end.value)),
            }
        return arguments

    def settings(self):
        return {
            **super().settings(),
            "Bounded": repr(self.part.bounded.isChecked()),
            "Low": repr(self._low.value),
            "High": repr(self._high.value),
            "StartAngle": repr(self._start.value),
            "EndAngle": repr(self._end.value),
        }

    def forget_widgets(self):
        super().forget_widgets()
        self.part = self._turn = self._low = self._high = self._start = self._end = None
