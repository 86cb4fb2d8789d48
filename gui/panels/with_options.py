# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options that the panels of operators have in common."""

from femscalpelobjects import operator_options

from .. import preferences
from ..translate import QT_TRANSLATE_NOOP, translate
from . import fields
from .preserve_input import PreserveInput
from .sections import Section, by_row

#: Labels for messages about an option, by the operators' parameter; what is about others is shown at the geometry.
OPTION_ERRORS = {
    "name": "nameError",
    "method": "methodError",
    "transition": "methodError",
    "feature_angle": "methodError",
    "refine": "refineError",
    "preserve": "preserveError",
}
#: Rows of the options in their form.
OPTION_ROWS = {"group_name": 0, "method": 2, "transition": 4, "feature_angle": 5, "refine": 6, "preserve": 9}


class WithOptions:
    """The part of a ToolPanel that is about `options`, the form of what all operators let their user choose."""

    #: The options that the operator has, as the functions of ObjectsFemScalpel call them.
    OFFERED = tuple(OPTION_ROWS)
    #: Where elements are divided first by themselves, and what of.
    REFINED_WHERE = QT_TRANSLATE_NOOP("FemScalpel", "where the tool is finer")
    REFINED_WHAT = QT_TRANSLATE_NOOP(
        "FemScalpel",
        "Whether elements near the tool (of a crack that ends inside: near its front) are divided first",
    )

    def _set_up_options(self):
        o = self.options
        for name in preferences.METHODS:
            o.method.addItem(
                {
                    "snap": translate("FemScalpel", "snap: move and split"),
                    "deform": translate("FemScalpel", "deform: only move nodes"),
                }[name],
                name,
            )
        o.method.setCurrentIndex(o.method.findData(preferences.method()))
        o.transition.setValue(preferences.transition())
        self._feature_angle = fields.Number(o.featureAngle, self.update, 30)
        for text, data in (
            (translate("FemScalpel", self.REFINED_WHERE), "Automatic"),
            (translate("FemScalpel", "never"), "Never"),
            (translate("FemScalpel", "to an edge length"), "Size"),
        ):
            o.refine.addItem(text, data)
        o.refine.setToolTip(translate("FemScalpel", self.REFINED_WHAT))
        self._refine_size = fields.Number(o.refineSize, self.update, self.geometry.size / 50)
        o.refine.currentIndexChanged.connect(lambda *_: self._choose_refinement())
        self._choose_refinement()
        self._preserve = PreserveInput(o, self._group_names(), self.update)
        o.groupName.setText(self._free_name())
        o.groupName.textChanged.connect(lambda *_: self.update())
        o.method.currentIndexChanged.connect(lambda *_: self.update())
        o.transition.valueChanged.connect(lambda *_: self.update())
        placed = by_row(o.grid)
        for row in (row for name, row in OPTION_ROWS.items() if name not in self.OFFERED):
            for column, _, box in placed[row]:
                if column < 2:
                    box.hide()
        self._fold_options()
        analysis = self._analysis()
        o.intoAnalysis.setVisible(analysis is not None and self.edited is None)
        o.intoAnalysis.setChecked(analysis is not None and self.edited is None and preferences.put_into_analysis())

    def _fold_options(self):
        """Puts what is not always needed into sections."""
        o = self.options
        sections = (
            (
                ("refine",),
                (6, 7, 8),
                "Refinement",
                translate("FemScalpel", "Refinement"),
                translate("FemScalpel", "Whether elements are divided first, and how small they become"),
                True,
            ),
            (
                ("method", "transition", "feature_angle", "preserve"),
                (2, 3, 4, 5, 9, 10, 11),
                "Advanced",
                translate("FemScalpel", "Advanced"),
                translate("FemScalpel", "How nodes are moved, which of them, and what must keep its shape"),
                False,
            ),
        )
        self._sections = [
            Section(o.rows, o.grid, rows, *texts)
            for names, rows, *texts in sections
            if any(name in self.OFFERED for name in names)
        ]

    def _refine_to(self, size):
        """Enters an edge length to refine to first."""
        o = self.options
        self._refine_size.set(size)
        blocked = o.refine.blockSignals(True)
        o.refine.setCurrentIndex(o.refine.findData("Size"))
        o.refine.blockSignals(blocked)
        self._choose_refinement()

    def _choose_refinement(self):
        for box in (self.options.refineSizeLabel, self.options.refineSize):
            box.setVisible(self.options.refine.currentData() == "Size")
        self.update()

    def _group_names(self):
        """Names of the groups of the source, each once."""
        femmesh = self.source_object.FemMesh
        return list(dict.fromkeys(femmesh.getGroupName(g) for g in femmesh.Groups))

    def _free_name(self):
        taken = self._group_names()
        name, number = self.GROUP_NAME, 2
        while any(t.startswith(name + "_") for t in taken):
            name, number = f"{self.GROUP_NAME}{number}", number + 1
        return name

    def entered(self):
        """What the options say: name, method, transition (None: automatic), feature_angle, refine (None: automatic),
        preserve (None: all groups)."""
        o = self.options
        refine = {"Automatic": None, "Never": False, "Size": self._refine_size.value}[o.refine.currentData()]
        return {
            "name": o.groupName.text(),
            "method": o.method.currentData(),
            "transition": o.transition.value() or None,
            "feature_angle": self._feature_angle.value,
            "refine": refine,
            "preserve": self._preserve.value(),
        }

    def read(self, obj):
        """Enters what a document object holds."""
        o = self.options
        if "group_name" in self.OFFERED:
            o.groupName.setText(obj.GroupName)
        if "method" in self.OFFERED:
            o.method.setCurrentIndex(o.method.findData(obj.Method))
        if "transition" in self.OFFERED:
            o.transition.setValue(obj.Transition)
        if "feature_angle" in self.OFFERED:
            self._feature_angle.set(obj.FeatureAngle.Value)
        if "refine" in self.OFFERED:
            o.refine.setCurrentIndex(o.refine.findData(obj.Refine))
            if obj.Refine == "Size":
                self._refine_size.set(obj.RefineSize.Value)
        if "preserve" in self.OFFERED:
            self._preserve.set(obj.PreservedGroups)

    def arguments(self):
        """Arguments of the function ObjectsFemScalpel.MAKE, as Python text by name, without document and source."""
        given = self._given().items()
        return {name: repr(value) for name, value in given if value is not None or name not in ("refine", "preserve")}

    def settings(self):
        """Properties of the document object as Python text by name."""
        return {name: repr(value) for name, value in operator_options.to_properties(self._given()).items()}

    def _given(self):
        """What the options say, as ObjectsFemScalpel's functions take it."""
        options = self.entered()
        given = {
            "method": options["method"],
            "transition": options["transition"] or 0,
            "group_name": options["name"],
            "feature_angle": options["feature_angle"],
            "refine": options["refine"],
            "preserve": options["preserve"],
        }
        return {name: value for name, value in given.items() if name in self.OFFERED}
