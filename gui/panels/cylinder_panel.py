# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the task panels of operators with a cylinder share."""

import FreeCAD

import femscalpel
from femscalpelobjects.tool_properties import direction_of

from .axis_input import AxisInput
from .tool_panel import ToolPanel


class CylinderPanel(ToolPanel):
    """Asks for a cylinder."""

    def make_geometry(self):
        return AxisInput(self.source_object)

    def tool(self):
        # To the last bit what the document object cuts with.
        return femscalpel.Cylinder(self.geometry.origin(), direction_of(self.placement()), self.geometry.radius())

    def read(self, obj):
        super().read(obj)
        placement = obj.AxisPlacement
        self.geometry.set_pose(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)), obj.Radius.Value)

    def arguments(self):
        geometry = {
            "origin": repr(tuple(self.geometry.origin())),
            "axis": repr(tuple(self.geometry.direction())),
            "radius": repr(self.geometry.radius()),
        }
        return {**geometry, **super().arguments()}

    def settings(self):
        return {"AxisPlacement": self.placement_text(), "Radius": repr(self.geometry.radius()), **super().settings()}
