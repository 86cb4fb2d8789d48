# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the task panels of operators with a plane share."""

import FreeCAD

import femscalpel
from femscalpelobjects.tool_properties import direction_of

from .plane_input import PlaneInput
from .tool_panel import ToolPanel


class PlanePanel(ToolPanel):
    """Asks for a plane."""

    def make_geometry(self):
        return PlaneInput(self.source_object)

    def tool(self):
        # To the last bit what the document object cuts with.
        return femscalpel.Plane(self.geometry.origin(), direction_of(self.placement()))

    def read(self, obj):
        super().read(obj)
        placement = obj.PlanePlacement
        self.geometry.set_pose(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)))

    def arguments(self):
        geometry = {"origin": repr(tuple(self.geometry.origin())), "normal": repr(tuple(self.geometry.direction()))}
        return {**geometry, **super().arguments()}

    def settings(self):
        return {"PlanePlacement": self.placement_text(), **super().settings()}
