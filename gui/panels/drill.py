# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: drill a hole."""

import numpy as np

from ..translate import QT_TRANSLATE_NOOP
from . import fields
from .cylinder_panel import CylinderPanel


class DrillPanel(CylinderPanel):
    """Asks for the axis, radius and depth of a hole."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Drill")
    ICON = "FemScalpel_Drill"
    GROUP_NAME, OBJECT_NAME, MAKE = "HOLE", "Drill", "makeDrill"

    def add_inputs(self):
        self.hole = self.insert_form("drill.ui")
        self._depth = fields.Number(self.hole.holeDepth, self._deepen, self.geometry.size / 4)
        self.hole.through.toggled.connect(self._through)

    def _through(self, on):
        self.hole.holeDepth.setEnabled(not on)
        self._deepen()

    def _deepen(self):
        self.geometry.show_depth(self._depth_or_none())
        self.update()

    def _depth_or_none(self):
        return None if self.hole.through.isChecked() else self._depth.value

    def removed_region(self, tool):
        return _Hole(tool, self._depth_or_none())

    def operation(self, tool, options):
        depth = self._depth_or_none()
        return lambda scalpel, band_only: scalpel.drill(tool, depth=depth, band_only=band_only, **options)

    def read(self, obj):
        super().read(obj)
        self._depth.set(obj.Depth.Value)
        self.hole.through.setChecked(obj.Through)
        self.geometry.show_depth(self._depth_or_none())

    def arguments(self):
        return {**super().arguments(), "depth": repr(self._depth_or_none())}

    def settings(self):
        through = self.hole.through.isChecked()
        depth = {} if through else {"Depth": repr(self._depth.value)}
        return {**super().settings(), "Through": repr(through), **depth}

    def forget_widgets(self):
        super().forget_widgets()
        self.hole = self._depth = None


class _Hole:
    """Inside of a hole that ends `depth` beyond the cylinder's origin; through without a depth."""

    def __init__(self, cylinder, depth):
        self._cylinder, self._depth = cylinder, depth

    def distance(self, points):
        """Negative inside, as a tool's."""
        out = self._cylinder.distance(points)
        if self._depth is None:
            return out
        return np.maximum(
            out, (np.asarray(points) - self._cylinder.origin) @ np.array(self._cylinder.axis) - self._depth
        )
