# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of a wall, and of where it is moved to."""

import FreeCAD
import FreeCADGui
import numpy as np
from PySide import QtGui

from femscalpel.tools import DIRECTION, TOOLS

from ..translate import QT_TRANSLATE_NOOP, form, translate
from ..view import picking, wall
from . import fields
from .axis_input import AxisInput
from .geometry_input import GeometryInput
from .plane_input import PlaneInput
from .tool_input import RADII, ROUND, ToolInput, name_of

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
        for part in (self.wall, self.form, self.moving):
            part.layout().setContentsMargins(0, 0, 0, 0)
            rows.addWidget(part)
        self._shown = None
        self._offered = None  # what was entered by itself: nothing is asked for by that
        self._axis_texts = self.form.pickNodes.text(), self.form.label8.text()
        self._choose_motion()
        self.wall.wall.currentIndexChanged.connect(lambda *_: self._choose_wall())
        self.wall.motion.currentIndexChanged.connect(lambda *_: self._choose_motion())
        self.wall.onto.currentIndexChanged.connect(lambda *_: self._choose_surface())

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

    def _has_radius(self):
        return any(p.asked_as == "radius" for p in TOOLS[self.shape()].parameters)

    def _has_direction(self):
        return any(p.kind is DIRECTION for p in TOOLS[self.shape()].parameters)

    def direction(self):
        direction = super().direction()
        is_needed = self.shape() is None or self._has_direction()
        return direction if direction.Length > 0 or is_needed else FreeCAD.Vector(0, 0, 1)

    def asks_nothing(self):
        """Whether the wall is to stay where it is, as far as is entered: on the surface that it lies on, for one."""
        if self.motion() == "By":
            return not any(self.vector())
        if self.motion() == "Scale":
            return self.factor() == 1
        return not self.targets() and self._offered == self._surface()

    def _surface(self):
        return self.group(), self.shape(), tuple(self.origin()), tuple(self.direction()), self.radius()

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
        names = wall.best_first(source, wall.walls(source.mesh))
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
            self._offered = None
            blocked = self.blockSignals(True)
            self.set_pose(FreeCAD.Vector(*found.origin), FreeCAD.Vector(*found.direction), found.radius or None)
            self.blockSignals(blocked)
        self._offered = self._surface()
        self._choose_surface()

    def _choose_surface(self):
        """Shows the fields, buttons and handles that the surface has."""
        self.stop_picking()
        f, has_radius, has_direction = self.form, self._has_radius(), self._has_direction()
        is_plane = has_direction and not has_radius
        self.NODES = 3 if is_plane else 2 if has_direction else 1
        nodes = translate("FemScalpel", "3 nodes") if is_plane else self._axis_texts[0]
        f.pickNodes.setText(nodes if has_direction else translate("FemScalpel", "1 node"))
        f.label8.setText(translate("FemScalpel", "Normal") if is_plane else self._axis_texts[1])
        for box in (f.label12, f.radius):
            box.setVisible(has_radius)
        for box in (f.label8, f.normalX, f.normalY, f.normalZ, f.pickView):
            box.setVisible(has_direction)
        f.radius.setToolTip(translate("FemScalpel", RADII.get(self.shape(), "")))
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
        self._choose_surface()

    def _enter_vector(self):
        for field, number in zip(self._vector, self._vectors[self._shown]):
            field.set(number)

    def error(self):
        if not self.group():
            return translate("FemScalpel", "The mesh has no group of faces or nodes. Make one first.")
        if self.motion() != "Onto" or self.asks_nothing():
            return ""
        problem = GeometryInput.error(self) if self._has_direction() else self.followed.error()
        return problem or (self.radius_error() if self._has_radius() else "")

    def error_label(self):
        return self.moving.geometryError

    def add_handles(self, view):
        super().add_handles(view)
        self.handles.show(self.motion() == "Onto")
        self._tell()

    def _tell(self, from_handle=False):
        if self.handles is not None and self.shape() is not None:
            self.handles.show_shape(self.shape(), {}, self._has_direction())
        super()._tell(from_handle)

    # Picking.

    def _ask(self, kind, found=0):
        if kind == "wall":
            return translate("FemScalpel", "Click a face of the mesh. Escape stops.")
        if kind == "nodes" and self.NODES == 1:
            return translate("FemScalpel", "Click a node of the mesh. Escape stops.")
        return super()._ask(kind, found)

    def _ask_geometry(self):
        if self.NODES == 3:
            return PlaneInput._ask_geometry(self)
        return super()._ask_geometry() if self.NODES == 2 else ToolInput._ask_geometry(self)

    def _from_nodes(self, points):
        if self.NODES == 3:
            return picking.plane_through(points)
        return super()._from_nodes(points) if self.NODES == 2 else picking.Picked(points[0], self.direction())

    def _from_click(self, click):
        if self.NODES == 3:
            return picking.plane(click, self.source)
        return super()._from_click(click) if self.NODES == 2 else picking.tool(click, self.source)

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
