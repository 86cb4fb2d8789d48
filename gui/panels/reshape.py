# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: move a wall."""

import FreeCAD

from femscalpel.tools import DIRECTION, LENGTH, POINT, TOOLS

from ..translate import QT_TRANSLATE_NOOP, translate
from ..view.preview_data import MadeNodes
from .group_panel import GroupPanel
from .wall_input import WallInput


class ReshapePanel(GroupPanel):
    """Asks for a group, and where it is moved to."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Reshape")
    ICON = "FemScalpel_Reshape"
    GROUP_NAME, OBJECT_NAME, MAKE = "SHAPE", "Reshape", "makeReshape"
    OFFERED = ("group_name", "feature_angle", "preserve")
    TWO_SIDES = False
    WHOLE = True

    def make_geometry(self):
        return WallInput(self.source_object)

    def idle(self):
        nothing = translate("FemScalpel", "Nothing is moved yet. Enter where the wall is to be.")
        return nothing if self.geometry.asks_nothing() else ""

    def own_errors(self):
        return {"group": self.geometry.wall.groupError}

    def tool(self):
        """The keyword of femscalpel.reshape() that says the motion, and its value."""
        g = self.geometry
        if g.motion() == "By":
            return "by", g.vector()
        if g.motion() == "Scale":
            return "scale", (g.factor(), g.vector())
        entered = {POINT: g.origin(), DIRECTION: g.direction(), LENGTH: g.radius()}
        return "onto", TOOLS[g.shape()].build(lambda parameter: entered[parameter.kind])

    def surface(self, tool):
        nodes = self.options.groupName.text() + "_WALL"
        return lambda result: MadeNodes(result.mesh, nodes, "node")

    def operation(self, tool, options):
        group, values = self.geometry.group(), {k: options[k] for k in ("name", "feature_angle", "preserve")}
        return lambda scalpel: scalpel.reshape(group, **dict([tool]), **values)

    def read(self, obj):
        super().read(obj)
        placement = obj.AxisPlacement
        vector = {"Onto": None, "By": obj.MoveBy, "Scale": obj.ScaleCentre}[obj.Motion]
        self.geometry.enter(obj.Motion, obj.ToolShape, vector, obj.ScaleFactor)
        self.geometry.set_pose(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)), obj.Radius.Value)

    def arguments(self):
        g, (keyword, value) = self.geometry, self.tool()
        own = {keyword: repr(value)}
        if keyword == "onto":
            own = {
                "onto": repr(g.shape()),
                "origin": repr(tuple(g.origin())),
                "axis": repr(tuple(g.direction())),
                "radius": repr(g.radius()),
            }
        return {"group": repr(g.group()), **own, **super().arguments()}

    def settings(self):
        g, (keyword, value) = self.geometry, self.tool()
        own = {
            "onto": lambda: {
                "ToolShape": repr(g.shape()),
                "AxisPlacement": self.placement_text(),
                "Radius": repr(g.radius()),
            },
            "by": lambda: {"MoveBy": repr(value)},
            "scale": lambda: {"ScaleFactor": repr(value[0]), "ScaleCentre": repr(value[1])},
        }[keyword]()
        return {"Group": repr(g.group()), "Motion": repr(g.motion()), **own, **super().settings()}
