# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: refine near a tool."""

import femscalpel
from femscalpel.tools import TOOLS

from ..translate import QT_TRANSLATE_NOOP, translate
from . import fields
from .along_tool_panel import AlongToolPanel


class RefinePanel(AlongToolPanel):
    """Asks for a tool and for the size of the elements near it."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Refine")
    ICON = "FemScalpel_Refine"
    GROUP_NAME, OBJECT_NAME, MAKE = "REFINED", "Refine", "makeRefine"
    SHAPES = tuple(sorted(TOOLS, key=lambda name: name != "Cylinder"))
    WHOLE = True
    OFFERED = ("feature_angle",)  # refining makes no groups and knows one method

    def add_inputs(self):
        self.sizes = self.insert_form("refine.ui")
        size = self.geometry.size
        self._size = fields.Number(self.sizes.edgeSize, self.update, size / 30)
        self._reach = fields.Number(self.sizes.reach, self.update, 0)
        self.sizes.gradation.valueChanged.connect(lambda *_: self.update())

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
            result = femscalpel.refine(
                scalpel.mesh,
                tool,
                size,
                gradation=gradation,
                reach=reach,
                feature_angle=angle,
                before_refining=scalpel.before_refining,
            )
            if not result.report.elements_added:
                raise femscalpel.ToolError(vain)
            return result

        return operate

    def _refine_to(self, size):
        self._size.set(size)
        self.update()

    def read(self, obj):
        super().read(obj)
        self._size.set(obj.Size.Value)
        self._reach.set(obj.Reach.Value)
        self.sizes.gradation.setValue(obj.Gradation)

    def _sizes(self):
        return {"size": self._size.value, "reach": self._reach.value, "gradation": self.sizes.gradation.value()}

    def arguments(self):
        return {**super().arguments(), **{name: repr(value) for name, value in self._sizes().items()}}

    def settings(self):
        return {**super().settings(), **{name.title(): repr(value) for name, value in self._sizes().items()}}

    def forget_widgets(self):
        super().forget_widgets()
        self.sizes = self._size = self._reach = None
