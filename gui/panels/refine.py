# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: refine near a tool with a place, a direction and a radius, such as a cylinder, sphere or plane."""

import FreeCAD

import femscalpel
from femscalpel.tools import DIRECTION, LENGTH, POINT, TOOLS

from ..translate import QT_TRANSLATE_NOOP, translate
from . import fields
from .cylinder_panel import CylinderPanel

#: Tools that a place, a direction and a radius say; those with a radius first.
SHAPES = sorted(
    (
        name
        for name, kind in TOOLS.items()
        if {p.asked_as for p in kind.parameters if p.kind not in (POINT, DIRECTION)} <= {"radius"}
    ),
    key=lambda name: not any(p.asked_as == "radius" for p in TOOLS[name].parameters),
)
TEXTS = (
    QT_TRANSLATE_NOOP("FemScalpel", "Cylinder"),
    QT_TRANSLATE_NOOP("FemScalpel", "Sphere"),
    QT_TRANSLATE_NOOP("FemScalpel", "Plane"),
)


class RefinePanel(CylinderPanel):
    """Asks for a tool and for the size of the elements near it."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Refine")
    ICON = "FemScalpel_Refine"
    GROUP_NAME, OBJECT_NAME, MAKE = "REFINED", "Refine", "makeRefine"
    OFFERED = ("feature_angle",)  # refining makes no groups and knows one method

    def add_inputs(self):
        self.sizes = self.insert_form("refine.ui")
        for shape in SHAPES:
            self.sizes.toolShape.addItem(translate("FemScalpel", shape), shape)
        size = self.geometry.size
        self._size = fields.Number(self.sizes.edgeSize, self.update, size / 30)
        self._reach = fields.Number(self.sizes.reach, self.update, 0)
        self.sizes.gradation.valueChanged.connect(lambda *_: self.update())
        self.sizes.toolShape.currentIndexChanged.connect(lambda *_: self.update())

    def _shape(self):
        return self.sizes.toolShape.currentData()

    def tool(self):
        entered = {POINT: self.geometry.origin(), DIRECTION: self.geometry.direction(), LENGTH: self.geometry.radius()}
        return TOOLS[self._shape()].build(lambda parameter: entered[parameter.kind])

    def operation(self, tool, options):
        size, reach, gradation, angle = (
            self._size.value,
            self._reach.value,
            self.sizes.gradation.value(),
            options["feature_angle"],
        )
        vain = translate(
            "FemScalpel",
            "Nothing to refine: the elements that the tool reaches have no edge longer than the size. "
            "Move the tool, give it a larger reach, or choose a smaller size.",
        )

        def operate(scalpel):
            result = femscalpel.refine(scalpel.mesh, tool, size, gradation=gradation, reach=reach, feature_angle=angle)
            if not result.report.elements_added:
                raise femscalpel.ToolError(vain)
            return result

        return operate

    def read(self, obj):
        placement = obj.AxisPlacement
        self._feature_angle.set(obj.FeatureAngle.Value)
        self._size.set(obj.Size.Value)
        self._reach.set(obj.Reach.Value)
        self.sizes.gradation.setValue(obj.Gradation)
        self.sizes.toolShape.setCurrentIndex(max(self.sizes.toolShape.findData(obj.ToolShape), 0))
        self.geometry.set_pose(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)), obj.Radius.Value)

    def _common(self, naming):
        names = {
            "tool": "ToolShape",
            "radius": "Radius",
            "size": "Size",
            "reach": "Reach",
            "gradation": "Gradation",
            "feature_angle": "FeatureAngle",
        }
        values = {
            "tool": self._shape(),
            "radius": self.geometry.radius(),
            "size": self._size.value,
            "reach": self._reach.value,
            "gradation": self.sizes.gradation.value(),
            "feature_angle": self._feature_angle.value,
        }
        return {names[k] if naming == "properties" else k: repr(v) for k, v in values.items()}

    def arguments(self):
        return {
            "origin": repr(tuple(self.geometry.origin())),
            "axis": repr(tuple(self.geometry.direction())),
            **self._common("arguments"),
        }

    def settings(self):
        return {"AxisPlacement": self.placement_text(), **self._common("properties")}

    def forget_widgets(self):
        super().forget_widgets()
        self.sizes = self._size = self._reach = None
