# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the inputs of planes and axes share: numbers, picking from the 3-D view, handles."""

import dataclasses

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..translate import translate
from ..view import picking
from . import fields
from .followed import Followed, vertex_at
from .narrow import share_by_captions
from .panel_input import PanelInput


class GeometryInput(PanelInput):
    """A form with a point and a direction. `changed` comes also while a handle is dragged; `picked(Picked)` after it
    when the position was picked."""

    picked = QtCore.Signal(object)

    #: Whether a click at a sketch means its edge.
    EDGES_OF_SKETCHES = False

    NODES = 3  # how many mesh nodes say the geometry

    def __init__(self, source_object):
        super().__init__(source_object)
        self.handles = None
        self.buttons = {"nodes": self.form.pickNodes, "geometry": self.form.pickGeometry}
        self.followed = Followed(self.form, self._tell)
        step = fields.round_step(self.size / 50)
        self._point = [fields.Number(getattr(self.form, "origin" + n), self._typed, step=step) for n in "XYZ"]
        self._direction = [fields.Number(getattr(self.form, "normal" + n), self._typed, step=0.1) for n in "XYZ"]
        for field in self.form.findChildren(QtGui.QAbstractSpinBox):
            # Two in a row, with the icon of expressions: arrows beside them would hide the first digits.
            field.setButtonSymbols(QtGui.QAbstractSpinBox.NoButtons)
        share_by_captions((self.form.pickNodes, self.form.pickGeometry, self.form.pickView))
        self._connect_buttons()
        self.form.pickView.clicked.connect(self._take_view)
        self.form.centre.clicked.connect(lambda: self.set_pose(self.centre, self.direction()))
        self.set_pose(self.centre, FreeCAD.Vector(1, 0, 0))

    def move_into(self, source):
        inside = source.nearest_inside(self.centre)
        if inside is None or not self.base().isEqual(self.centre, 1e-9 * self.size):
            return False
        self.centre = FreeCAD.Vector(*inside)
        self.set_pose(self.centre, self.direction())
        return True

    # What is entered.

    def base(self):
        """The point as entered."""
        return FreeCAD.Vector(*(field.value for field in self._point))

    def origin(self):
        """The point of the tool."""
        return self.base()

    def direction(self):
        """The direction as entered; any length, also zero."""
        return FreeCAD.Vector(*(field.value for field in self._direction))

    def _typed(self):
        if self.is_expressed() or self._is_elsewhere(*self._told):  # a field that is left tells, too
            self.followed.end_by_hand()
        self._tell()

    def set_pose(self, origin, direction, radius=None, from_handle=False, follows=False):
        """Enters a position; `changed` follows. Unless it is told that it still `follows` what it did, another one
        ends that."""
        if not follows and self._is_elsewhere(origin, direction):
            self.followed.end_by_hand()
        for field, number in zip((*self._point, *self._direction), (*origin, *direction)):
            field.set(number)
        if radius is not None:
            self._set_radius(radius)
        self._tell(from_handle)

    def is_expressed(self):
        """Whether an expression says any number of the position."""
        return self.is_fixed() or any(field.has_expression for field in self._direction)

    def read_expressed(self, obj):
        """Enters what a document object holds of which expressions say the direction."""
        self.set_pose(obj.Origin, FreeCAD.Vector(obj.Direction), follows=True)

    def expressed(self, turn):
        """Properties of such an object as Python text by name; `turn` in degrees."""
        return {
            "Direction": f"FreeCAD.Vector{tuple(self.direction())!r}",
            "Origin": f"FreeCAD.Vector{tuple(self.base())!r}",
            "Turn": repr(float(turn)),
        }

    def is_fixed(self):
        """Whether an expression says a coordinate of the point."""
        return any(field.has_expression for field in self._point)

    def _is_elsewhere(self, origin, direction):
        # What handles say is rounded.
        old, new = self.direction(), FreeCAD.Vector(*direction)
        turned = not (old.Length > 0 and new.Length > 0) or old.getAngle(new) > 1e-5
        return turned or self.origin().distanceToPoint(FreeCAD.Vector(*origin)) > 1e-6 * self.size

    def targets(self):
        """The geometry that the position follows, as following.targets_of()."""
        return [] if self.is_expressed() else self.followed.targets

    def _set_radius(self, radius):
        pass

    def radius(self):
        """Radius, where there is one."""
        return 0.0

    def _tell(self, from_handle=False):
        self._told = self.origin(), self.direction()
        if self.handles is not None and not from_handle and self.direction().Length > 0:
            self.handles.set_pose(self.origin(), self.rotation(), self.radius())
        self.changed.emit()

    def rotation(self):
        """Rotation that takes z to the direction, turned no further than needed."""
        return FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), self.direction())

    def placement(self):
        """The tool as a placement whose z axis is the direction."""
        return FreeCAD.Placement(self.origin(), self.rotation())

    def error(self):
        """What is wrong with the numbers, "" when nothing is."""
        if not self.direction().Length > 0:
            return translate("FemScalpel", "The direction is zero. Give one, or pick it from the 3-D view.")
        return self.followed.error()

    # Handles.

    def add_handles(self, view):
        """Puts the handles into a 3-D view."""
        self.handles = self._make_handles(view)
        self.handles.set_pose(self.origin(), self.rotation(), self.radius())

    def show_grips(self, on):
        if self.handles is not None:
            self.handles.show_grips(on)

    def _make_handles(self, view):
        raise NotImplementedError

    def _dragged(self, position, rotation, radius, done):
        self.set_pose(position, rotation.multVec(FreeCAD.Vector(0, 0, 1)), radius or None, from_handle=not done)

    # Picking.

    def _start(self, kind):
        self._nodes, self._vertices = {}, []
        super()._start(kind)

    def _ask(self, kind, found=0):
        if kind == "nodes":
            return (
                translate("FemScalpel", "Click node %1 of %2 on the mesh, or a vertex of a part. Escape stops.")
                .replace("%1", str(found + 1))
                .replace("%2", str(self.NODES))
            )
        return self._ask_geometry()

    def _ask_geometry(self):
        raise NotImplementedError

    def _picked(self, kind, click):
        if kind == "nodes":
            node, vertex = picking.node_at(click, self.source), vertex_at(click)
            if vertex is not None:
                target = (click.obj, click.name.split(".")[-1])
                node = ((target[0].Name, target[1]), vertex)
                if target not in self._vertices and target[0].Document == self.source_object.Document:
                    self._vertices.append(target)
            if node is None:
                raise picking.PickError(translate("FemScalpel", "That is not the mesh. Click a node of the mesh."))
            self._nodes[node[0]] = node[1]
            self._mark(self._nodes.values())
            if len(self._nodes) < self.NODES:
                self._hint(self._ask("nodes", len(self._nodes)))
                return None
            points = list(self._nodes.values())
            self._nodes = {}
            targets = tuple(self._vertices) if len(self._vertices) == len(points) else ()
            return dataclasses.replace(self._from_nodes(points), targets=targets)
        targets = picking.targets_of(click, self.source_object.Document, self.EDGES_OF_SKETCHES)
        return dataclasses.replace(self._from_click(click), targets=targets)

    def _mark(self, points):
        if self.handles is not None:
            self.handles.mark([tuple(p) for p in points])

    def take(self, picked):
        """Enters what was picked."""
        self.set_pose(picked.origin, picked.direction.normalize(), picked.radius)
        self.picked.emit(picked)
        self.followed.start(() if self.is_expressed() else picked.targets)
        self._tell()  # that it follows, when all is entered

    def _from_nodes(self, points):
        raise NotImplementedError

    def _from_click(self, click):
        raise NotImplementedError

    def _take_view(self):
        direction = FreeCADGui.getDocument(self.source_object.Document.Name).ActiveView.getViewDirection().negative()
        self.set_pose(self.base(), FreeCAD.Vector(*(round(x, 12) + 0.0 for x in direction)))

    def close(self):
        if self.handles is not None:
            handles, self.handles = self.handles, None
            handles.close()
        super().close()
        self.followed = None
        self._point, self._direction = [], []
