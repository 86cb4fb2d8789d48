# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along a plane or a part of it."""

import FreeCAD

import femscalpel

from ..translate import QT_TRANSLATE_NOOP, translate
from . import fields
from .plane_panel import PlanePanel
from .turned import X, turn_between, turned


class CrackPanel(PlanePanel):
    """Asks for the plane of a crack, and for the part of it that cracks. The polygon of a document object is kept."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Crack")
    ICON = "FemScalpel_Crack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "Crack", "makeCrack"

    def add_inputs(self):
        self.part = self.insert_form("patch.ui")
        self._corners = []
        for text, data in ((translate("FemScalpel", "The whole plane"), "Whole"), (translate("FemScalpel", "A disk"), "Disk"),
                           (translate("FemScalpel", "An ellipse"), "Ellipse"), (translate("FemScalpel", "A half plane"), "HalfPlane")):
            self.part.patch.addItem(text, data)
        self._radius = fields.Number(self.part.patchRadius, self.update, self.geometry.size / 8)
        self._second = fields.Number(self.part.patchSecondRadius, self.update, self.geometry.size / 16)
        self._turn = fields.Number(self.part.patchTurn, self.update, 0)
        self.part.patch.currentIndexChanged.connect(lambda *_: self._choose())
        self._choose()

    def _choose(self):
        """Shows the fields that matter to the part chosen."""
        shown, p = self._patch(), self.part
        for widgets, parts in (((p.radiusLabel, p.patchRadius), ("Disk", "Ellipse")), ((p.secondLabel, p.patchSecondRadius), ("Ellipse",)),
                               ((p.turnLabel, p.patchTurn), ("Ellipse", "HalfPlane"))):
            for widget in widgets:
                widget.setVisible(shown in parts)
        self.update()

    def _patch(self):
        return self.part.patch.currentData()

    def placement(self):
        """The plane, its x axis turned as entered."""
        return turned(self.geometry.placement(), self._turn.value)

    def _within(self):
        placement = self.placement()
        along = placement.Rotation.multVec(X)
        if self._patch() == "Disk":
            return femscalpel.Disk(placement.Base, self._radius.value)
        if self._patch() == "Ellipse":
            return femscalpel.Ellipse(placement.Base, (self._radius.value, self._second.value), along)
        if self._patch() == "HalfPlane":
            return femscalpel.HalfPlane(placement.Base, along)
        if self._patch() == "Polygon":
            return femscalpel.Polygon([placement.multVec(corner) for corner in self._corners])
        return None

    def operation(self, tool, options):
        within = self._within()
        return lambda scalpel: scalpel.crack(tool, within=within, band_only=True, **options)

    def read(self, obj):
        super().read(obj)
        self._turn.set(turn_between(self.geometry.rotation(), obj.PlanePlacement.Rotation))
        self._radius.set(obj.PatchRadius.Value)
        self._second.set(obj.PatchSecondRadius.Value)
        if obj.Patch == "Polygon":
            self._corners = [FreeCAD.Vector(c.x, c.y, 0) for c in obj.PatchCorners]
            self.part.patch.addItem(translate("FemScalpel", "The polygon it has"), "Polygon")
        self.part.patch.setCurrentIndex(self.part.patch.findData(obj.Patch))

    def arguments(self):
        arguments = super().arguments()
        if self._patch() == "Whole":
            return arguments
        del arguments["origin"], arguments["normal"]
        radii = {"Disk": {"patch_radius": self._radius}, "Ellipse": {"patch_radius": self._radius, "patch_second_radius": self._second}}
        return {"placement": self.placement_text(), "patch": repr(self._patch()),
                **{name: repr(field.value) for name, field in radii.get(self._patch(), {}).items()}, **arguments}

    def settings(self):
        return {**super().settings(), "Patch": repr(self._patch()), "PatchRadius": repr(self._radius.value),
                "PatchSecondRadius": repr(self._second.value)}

    def forget_widgets(self):
        super().forget_widgets()
        self.part = self._radius = self._second = self._turn = None
