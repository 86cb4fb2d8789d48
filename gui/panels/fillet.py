# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: round edges."""

from ..translate import QT_TRANSLATE_NOOP
from ..view.preview_data import MadeNodes
from . import fields
from .edge_input import EdgeInput
from .tool_panel import ToolPanel


class FilletPanel(ToolPanel):
    """Asks for edges and a radius."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Fillet")
    ICON = "FemScalpel_Fillet"
    GROUP_NAME, OBJECT_NAME, MAKE = "FILLET", "Fillet", "makeFillet"
    TWO_SIDES = False
    WHOLE = True

    _has_radius = False  # whether one was proposed

    def make_geometry(self):
        return EdgeInput(self.source_object)

    def add_inputs(self):
        self.rounding = self.insert_form("fillet.ui")
        self._radius = fields.Number(
            self.rounding.filletRadius, self.update, self.geometry.size / 20, fields.round_step(self.geometry.size / 50)
        )

    def loaded(self):
        if self.edited is None and not self._has_radius:
            self._has_radius = True
            # Two elements wide.
            self._radius.set(fields.round_step(2 * self.source.edge_length()))
        super().loaded()

    def own_errors(self):
        return {"radius": self.rounding.radiusError}

    def tool(self):
        return self.geometry.along()

    def surface(self, tool):
        face = self.options.groupName.text() + "_FACE"
        return lambda result: MadeNodes(result.mesh, face, "element")

    def operation(self, tool, options):
        radius = self._radius.value
        return lambda scalpel: scalpel.fillet(tool, radius, **options)

    def read(self, obj):
        super().read(obj)
        self._radius.set(obj.Radius.Value)
        self.geometry.set_along(obj.Along or obj.AlongPoints)

    def arguments(self):
        own = {"along": repr(self.geometry.along()), "radius": repr(self._radius.value)}
        return {**own, **super().arguments()}

    def settings(self):
        along = self.geometry.along()
        group, points = (along, []) if isinstance(along, str) else ("", along)
        own = {"Along": repr(group), "AlongPoints": repr(points), "Radius": repr(self._radius.value)}
        return {**own, **super().settings()}

    def forget_widgets(self):
        super().forget_widgets()
        self.rounding = self._radius = None
