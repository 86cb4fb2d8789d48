# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along a plane or a part of it."""

import math

import FreeCAD

import femscalpel

from ..translate import QT_TRANSLATE_NOOP, translate
from . import fields
from .plane_panel import PlanePanel
from .placements import X, Turn, turn_between, turned

#: Parts of a plane to which its x axis matters.
TURNED = ("Ellipse", "HalfPlane", "Polygon")


class CrackPanel(PlanePanel):
    """Asks for the plane of a crack, and for the part of it that cracks: also what a picked sketch encloses."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Crack")
    ICON = "FemScalpel_Crack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "Crack", "makeCrack"

    def add_inputs(self):
        self.part = self.insert_form("patch.ui")
        self._first_turn = None  # that of the half plane entered at first
        self._corners = []  # of the polygon, in the axes of placement()
        for text, data in (
            (translate("FemScalpel", "The whole plane"), "Whole"),
            (translate("FemScalpel", "A disk"), "Disk"),
            (translate("FemScalpel", "An ellipse"), "Ellipse"),
            (translate("FemScalpel", "A half plane"), "HalfPlane"),
            (translate("FemScalpel", "A polygon"), "Polygon"),
        ):
            self.part.patch.addItem(text, data)
        self._radius = fields.Number(self.part.patchRadius, self._changed, self.geometry.size / 8)
        self._second = fields.Number(self.part.patchSecondRadius, self._changed, self.geometry.size / 16)
        self._turn = Turn(
            self.geometry,
            lambda: self._patch() in TURNED,
            fields.Number(self.part.patchTurn, self._changed, 0, 10),
            self._mirror,
        )
        self.part.patch.currentIndexChanged.connect(lambda *_: self._choose())
        self.geometry.picked.connect(self._take_outline)
        if self.edited is None:
            self._end_inside()
        self._choose()

    def _end_inside(self):
        """Enters a crack across the part, at its middle: from the side one looks at to halfway through."""
        femmesh = self.source_object.FemMesh
        if not femmesh.FaceCount and not femmesh.VolumeCount:
            return  # beams are cut as a whole
        box = femmesh.BoundBox
        lengths = (box.XLength, box.YLength, box.ZLength)
        axes = sorted(range(3), key=lambda axis: -round(lengths[axis] / box.DiagonalLength, 3))
        normal, along = FreeCAD.Vector(), FreeCAD.Vector()
        normal[axes[0]], along[axes[1]] = 1, (1, -1, 1)[axes[1]]
        self._choose_quietly("HalfPlane")
        self.geometry.set_pose(self.geometry.centre, normal)
        towards = FreeCAD.Rotation(along, FreeCAD.Vector(), normal, "ZXY")
        self._first_turn = turn_between(self.geometry.rotation(), towards)
        self._turn.set(self._first_turn)

    def _choose(self):
        """Shows the fields that matter to the part chosen."""
        shown, p = self._patch(), self.part
        if not self._is_turned() and self._turn.value == self._first_turn:
            self._turn.set(0)  # nobody has asked for that
        for widgets, parts in (
            ((p.radiusLabel, p.patchRadius), ("Disk", "Ellipse")),
            ((p.secondLabel, p.patchSecondRadius), ("Ellipse",)),
            ((p.turnLabel, p.patchTurn), (shown,) if self._is_turned() else ()),
        ):
            for widget in widgets:
                widget.setVisible(shown in parts)
        self._changed()

    def _is_turned(self):
        """Whether the x axis matters to what is entered: not to a polygon that was not picked yet."""
        shown = self._patch()
        return shown in TURNED and (shown != "Polygon" or bool(self._corners))

    def _changed(self):
        """The part has other numbers: its handles follow, and the preview."""
        shown = self._patch()
        radius = self._radius if shown in ("Disk", "Ellipse") else None
        turn = self._turn if self._is_turned() else None
        self.geometry.show_part(shown != "Whole", radius, turn, self._outline)
        self.update()

    def _outline(self):
        """Corners (x, y) of the part in the axes of placement(), of a half plane as far as it is drawn; None for the
        whole plane."""
        shown, half = self._patch(), 0.36 * self.geometry.size
        if shown in ("Disk", "Ellipse"):
            first = self._radius.value
            second = first if shown == "Disk" else self._second.value
            angles = (2 * math.pi * k / 72 for k in range(72))
            return [(first * math.cos(angle), second * math.sin(angle)) for angle in angles]
        if shown == "HalfPlane":
            return [(0, -half), (half, -half), (half, half), (0, half)]
        if shown == "Polygon" and self._corners:
            return [(corner.x, corner.y) for corner in self._corners]
        return None

    def size_is_of(self, axes):
        outline, shown = axes.outline, self._patch()
        if outline is None or shown not in ("Disk", "Ellipse", "Polygon"):
            return False
        if shown == "Polygon":
            back = axes.placement.inverse().multiply(self.placement())
            corners = [back.multVec(corner) for corner in self._corners]
            return len(corners) == len(outline.corners) and all(
                a.distanceToPoint(b) <= 1e-9 * self.geometry.size for a, b in zip(corners, outline.corners)
            )
        second = self._radius if shown == "Disk" else self._second
        radii = (self._radius.value, second.value)
        return bool(outline.radii) and all(abs(a - b) <= 1e-9 * max(1.0, b) for a, b in zip(radii, outline.radii))

    def _take_outline(self, picked):
        """Enters what a picked sketch encloses. A sketch without such says the plane only."""
        outline = picked.outline
        if outline is None:
            return
        self._corners = list(outline.corners)
        kind = "Polygon" if outline.corners else None
        if outline.radii:
            self._radius.set(outline.radii[0])
            self._second.set(outline.radii[1])
            kind = "Disk" if outline.radii[0] == outline.radii[1] else "Ellipse"
        if kind is not None:
            self._choose_quietly(kind)
            self.geometry.set_pose(outline.placement.Base, self.geometry.direction())
            self._turn.set(turn_between(self.geometry.rotation(), outline.placement.Rotation))
        self._choose()

    def _choose_quietly(self, patch):
        blocked = self.part.patch.blockSignals(True)
        self.part.patch.setCurrentIndex(self.part.patch.findData(patch))
        self.part.patch.blockSignals(blocked)

    def _mirror(self):
        """Leaves the polygon where it is when the plane has been turned over."""
        self._corners = [FreeCAD.Vector(corner.x, -corner.y, 0) for corner in self._corners]

    def _patch(self):
        return self.part.patch.currentData()

    def placement(self):
        """The plane, its x axis turned as entered."""
        return turned(self.geometry.placement(), self._turn.value)

    def turn(self):
        return self._turn.value

    def enter_turn(self, degrees):
        self._turn.set(degrees)

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
            if not self._corners:
                raise femscalpel.ToolError(
                    translate(
                        "FemScalpel", "Pick a sketch with one closed line of straight sides: that is the polygon."
                    )
                )
            return femscalpel.Polygon([placement.multVec(corner) for corner in self._corners])
        return None

    def operation(self, tool, options):
        within = self._within()
        return lambda scalpel, band_only: scalpel.crack(tool, within=within, band_only=band_only, **options)

    def read(self, obj):
        super().read(obj)
        self._turn.set(
            turn_between(self.geometry.rotation(), obj.PlanePlacement.Rotation)
        )  # the patch is still the whole
        self._radius.set(obj.PatchRadius.Value)
        self._second.set(obj.PatchSecondRadius.Value)
        self._corners = [FreeCAD.Vector(c.x, c.y, 0) for c in obj.PatchCorners]
        self.part.patch.setCurrentIndex(self.part.patch.findData(obj.Patch))

    def arguments(self):
        arguments = super().arguments()
        if self._patch() == "Whole":
            return arguments
        del arguments["origin"], arguments["normal"]
        shape = {
            "Disk": {"patch_radius": repr(self._radius.value)},
            "Ellipse": {"patch_radius": repr(self._radius.value), "patch_second_radius": repr(self._second.value)},
            "Polygon": {"patch_corners": repr([(corner.x, corner.y) for corner in self._corners])},
        }
        return {
            "placement": self.placement_text(),
            "patch": repr(self._patch()),
            **shape.get(self._patch(), {}),
            **arguments,
        }

    def settings(self):
        corners = ", ".join(f"FreeCAD.Vector({corner.x!r}, {corner.y!r}, 0)" for corner in self._corners)
        return {
            **super().settings(),
            "Patch": repr(self._patch()),
            "PatchRadius": repr(self._radius.value),
            "PatchSecondRadius": repr(self._second.value),
            "PatchCorners": f"[{corners}]",
        }

    def forget_widgets(self):
        super().forget_widgets()
        self.part = self._radius = self._second = self._turn = None
