# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: add another mesh to a mesh."""

from ..translate import QT_TRANSLATE_NOOP, translate
from ..view.preview_data import MadeNodes
from . import fields
from .addition_input import AdditionInput
from .tool_panel import ToolPanel


class MergePanel(ToolPanel):
    """Asks for the mesh to add, and how. `chosen`: the one that is entered first."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Merge")
    ICON = "FemScalpel_Merge"
    GROUP_NAME, OBJECT_NAME, MAKE = "ADD", "Merge", "makeMerge"
    OFFERED = ("group_name", "feature_angle", "refine")
    REFINED_WHERE = QT_TRANSLATE_NOOP("FemScalpel", "where one of them is finer")
    REFINED_WHAT = QT_TRANSLATE_NOOP("FemScalpel", "Whether elements of both are divided first where the two meet")
    TWO_SIDES = False
    WHOLE = True

    def __init__(self, source_object, edited=None, chosen=None):
        self._chosen = chosen
        super().__init__(source_object, edited)
        self._pieces = lambda parting: ""  # those of the addition are no news

    def make_geometry(self):
        chosen = self.edited.Addition if self.edited is not None else self._chosen
        return AdditionInput(self.source_object, self.edited, chosen)

    def add_inputs(self):
        self.merging = self.insert_form("merge.ui")
        for text, data in (
            (translate("FemScalpel", "cut off the addition"), "mesh"),
            (translate("FemScalpel", "cut off the mesh"), "addition"),
        ):
            self.merging.keep.addItem(text, data)
        self._tolerance = fields.Number(self.merging.mergeTolerance, self.update, 0)
        self.merging.keep.currentIndexChanged.connect(lambda *_: self.update())
        self.merging.joinGroups.toggled.connect(lambda *_: self.update())
        self.merging.groupPrefix.textChanged.connect(lambda *_: self.update())

    def own_errors(self):
        m = self.merging
        return {"tolerance": m.toleranceError, "prefix": m.prefixError}

    def pickable(self):
        return (self.source_object, *self.geometry.others())

    def beside(self):
        addition = self.geometry.addition()
        return addition.surface() if addition is not None else None

    def tool(self):
        return self.geometry.addition()

    def surface(self, tool):
        seam = self.options.groupName.text() + "_SEAM"
        return lambda result: MadeNodes(result.mesh, seam, "node")

    def operation(self, tool, options):
        values = {
            "keep": self.merging.keep.currentData(),
            "tolerance": self._tolerance.value or None,
            "prefix": self.merging.groupPrefix.text(),
            "join_groups": self.merging.joinGroups.isChecked(),
            "name": options["name"],
            "feature_angle": options["feature_angle"],
            "refine": options["refine"],
        }
        return lambda scalpel: scalpel.merge(tool.mesh(), **values)

    def read(self, obj):
        super().read(obj)
        m = self.merging
        m.keep.setCurrentIndex(m.keep.findData(obj.Keep))
        self._tolerance.set(obj.Tolerance.Value)
        m.groupPrefix.setText(obj.GroupPrefix)
        m.joinGroups.setChecked(obj.JoinGroups)

    def _common(self):
        m = self.merging
        return {
            "keep": ("Keep", m.keep.currentData()),
            "tolerance": ("Tolerance", self._tolerance.value),
            "prefix": ("GroupPrefix", m.groupPrefix.text()),
            "join_groups": ("JoinGroups", m.joinGroups.isChecked()),
        }

    def arguments(self):
        own = {name: repr(value) for name, (_, value) in self._common().items()}
        return {"addition": self._text_of(self.geometry.object()), **own, **super().arguments()}

    def settings(self):
        own = {name: repr(value) for name, value in self._common().values()}
        return {"Addition": self._text_of(self.geometry.object()), **own, **super().settings()}

    def _make_object(self):
        addition = self.geometry.object()
        obj = super()._make_object()
        self.hide_object(addition)
        return obj

    def forget_widgets(self):
        super().forget_widgets()
        self.merging = self._tolerance = None
