# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along a plane."""

import FreeCAD

import femscalpel

from ..translate import QT_TRANSLATE_NOOP
from .plane_input import PlaneInput
from .tool_panel import ToolPanel


class CrackPanel(ToolPanel):
    """Asks for the plane of a crack."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Crack")
    ICON = "FemScalpel_Crack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "Crack", "makeCrack"

    def make_geometry(self):
        return PlaneInput(self.source_object)

    def tool(self):
        return femscalpel.Plane(self.geometry.origin(), self.geometry.direction())

    def operation(self, tool, options):
        return lambda scalpel: scalpel.crack(tool, band_only=True, **options)

    def read(self, obj):
        super().read(obj)
        placement = obj.PlanePlacement
        self.geometry.set_pose(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)))

    def arguments(self):
        geometry = {"origin": repr(tuple(self.geometry.origin())), "normal": repr(tuple(self.geometry.direction()))}
        return {**geometry, **super().arguments()}

    def settings(self):
        return {"PlanePlacement": self.placement_text(), **super().settings()}
