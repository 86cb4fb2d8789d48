# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of a wall, and of where it is moved to."""

import FreeCAD
import FreeCADGui
import numpy as np
from PySide import QtGui

from ..translate import QT_TRANSLATE_NOOP, form, translate
from ..view import picking, wall
from . import fields
from .axis_input import AxisInput
from .tool_input import ROUND, name_of

MOTIONS = (
    ("Onto", QT_TRANSLATE_NOOP("FemScalpel", "onto a surface")),
    ("By", QT_TRANSLATE_NOOP("FemScalpel", "by a vector")),
    ("Scale", QT_TRANSLATE_NOOP("FemScalpel", "scaled about a point")),
)


class WallInput(AxisInput):
    """A group, and a surface, a vector, or a factor and a point. The surface is first that which the wall lies on."""

    def __init__(self, source_object):
        self.wall = FreeCADGui.PySideUic.loadUi(form("wall_input.ui"))
        self.moving = FreeCADGui.PySideUic.loadUi(form("wall_motion.ui"))
        super().__init__(source_object)
        fields.show_error(self.wall.pickHint, "")
        self.buttons["wall"] = self.wall.pickWall
        self.wall.pickWall.clicked.connect(self._starter("wall"))
        for data, text in MOTIONS:
            self.wall.motion.addItem(translate("FemScalpel", text), data)
        for shape in ROUND:
            self.wall.onto.addItem(name_of(shape), shape)
        self._factor = fields.Number(self.moving.scaleFactor, self._tell, 1.1, 0.1)
        step = fields.round_step(self.size / 50)
        boxes = [getattr(self.moving, "vector" + axis) for axis in "XYZ"]
        self._vector = [fields.Number(box, self._tell, step=step) for box in boxes]
        self._vectors = {"By": (0.0, 0.0, 0.0), "Scale": tuple(self.centre)}
        self._box = QtGui.QWidget()
        rows = QtGui.QVBoxLayout(self._box)
        self.form.layout().setContentsMargins(0, 0, 0, 0)
        for part in (self.wall, self.form, self.moving):
            rows.addWidget(part)
        self._shown = None
        self._choose_motion()
        self.wall.wall.currentIndexChanged.connect(lambda *_: self._choose_wall())
        self.wall.motion.currentIndexChanged.connect(lambda *_: self._choose_motion())
        self.wall.onto.currentIndexChanged.connect(lambda *_: self._tell())

    @property
    def window(self):
        return self._box

    # What is entered.

    def group(self):
        """The name of the wall's group, or None."""
        return self.wall.wall.currentData()

    def motion(self):
        """ "Onto", "By" or "Scale"."""
        return self.wall.motion.currentData()

    def shape(self):
        """The name of the surface's tool."""
        return self.wall.onto.currentData()

    def vector(self):
        """What "By" moves by, or the point that "Scale" leaves where it is."""
        return tuple(field.value for field in self._vector)

    def factor(self):
        """That of "Scale"."""
        return self._factor.value

    def targets(self):
        return super().targets() if self.motion() == "Onto" else []

    def forget_group(self):
        """No wall is chosen any more, until fill() lists them."""
        blocked = self.wall.wall.blockSignals(True)
        self.wall.wall.clear()
        self.wall.wall.blockSignals(blocked)

    def fill(self, source, group=None):
        """Lists the walls of a PreviewSource, and enters the one of that name, or the first."""
        self.source = source
        box = self.wall.wall
        blocked = box.blockSignals(True)
        names = wall.walls(source.mesh)
        box.clear()
        for name in names:
            box.addItem(name, name)
        if group is not None:
            if group not in names:
                box.addItem(group, group)
            box.setCurrentIndex(box.findData(group))
        box.blockSignals(blocked)
        if group is None:
            self._choose_wall()

    def enter(self, motion, shape, vector=None, factor=None):
        """Enters how the wall moves, without telling anyone."""
        for box, data in ((self.wall.motion, motion), (self.wall.onto, shape)):
            blocked = box.blockSignals(True)
            box.setCurrentIndex(max(box.findData(data), 0))
            box.blockSignals(blocked)
        if vector is not None:
            self._vectors[motion] = tuple(vector)
        if factor is not None:
            self._factor.set(factor)
        self._choose_motion()

    def _choose_wall(self):
        found = wall.fit(self.source, self.group()) if self.source is not None and self.group() else None
        if found is not None:
            blocked = self.wall.onto.blockSignals(True)
            self.wall.onto.setCurrentIndex(self.wall.onto.findData(found.shape))
            self.wall.onto.blockSignals(blocked)
            self._vectors["Scale"] = tuple(found.origin.tolist())
            if self._shown == "Scale":
                self._enter_vector()
            self.set_pose(FreeCAD.Vector(*found.origin), FreeCAD.Vector(*found.direction), found.radius or None)
        else:
            self._tell()

    def _choose_motion(self):
        if self._shown in self._vectors:
            self._vectors[self._shown] = self.vector()
        self._shown = self.motion()
        onto, scale = self._shown == "Onto", self._shown == "Scale"
        self.stop_picking()
        for box in (self.wall.ontoLabel, self.wall.onto, self.form):
            box.setVisible(onto)
        for box in (self.moving.factorLabel, self.moving.scaleFactor):
            box.setVisible(scale)
        for axis in "XYZ":
            for box in (getattr(self.moving, "vector" + axis), getattr(self.moving, "vectorLabel" + axis)):
                box.setVisible(not onto)
        self.moving.vectorLabel.setVisible(not onto)
        self.moving.vectorLabel.setText(
            translate("FemScalpel", "Centre") if scale else translate("FemScalpel", "Vector")
        )
        if not onto:
            self._enter_vector()
        if self.handles is not None:
            self.handles.show(onto)
        self._tell()

    def _enter_vector(self):
        for field, number in zip(self._vector, self._vectors[self._shown]):
            field.set(number)

    def error(self):
        if not self.group():
            return translate("FemScalpel", "The mesh has no group of faces or nodes. Make one first.")
        if self.motion() != "Onto":
            return ""
        return super().error()

    def error_label(self):
        return self.moving.geometryError

    def add_handles(self, view):
        super().add_handles(view)
        self.handles.show(self.motion() == "Onto")

    # Picking.

    def _ask(self, kind, found=0):
        if kind == "wall":
            return translate("FemScalpel", "Click a face of the mesh. Escape stops.")
        return super()._ask(kind, found)

    def _hint(self, text):
        of_wall = self.wall.pickWall.isChecked()
        super()._hint("" if of_wall else text)
        fields.show_error(self.wall.pickHint, text if of_wall else "")

    def _picked(self, kind, click):
        if kind != "wall":
            return super()._picked(kind, click)
        if not click.on_mesh or self.source is None:
            raise picking.PickError(translate("FemScalpel", "That is not the mesh. Click a face of the mesh."))
        name = wall.wall_at(self.source, np.array(click.point))
        if name is None:
            raise picking.PickError(
                translate("FemScalpel", "That face is in no group. Click another one, or make a group of it first.")
            )
        return name

    def take(self, picked):
        if isinstance(picked, str):
            self.wall.wall.setCurrentIndex(self.wall.wall.findData(picked))
        else:
            super().take(picked)

    def close(self):
        super().close()
        self.wall = self.moving = self._box = self._factor = None
        self._vector = []
