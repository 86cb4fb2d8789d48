# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the inputs of planes and axes share: numbers, picking from the 3-D view, handles."""

import FreeCAD
import FreeCADGui
from PySide import QtCore

from ..translate import form, translate
from ..view import picking
from . import fields


class GeometryInput(QtCore.QObject):
    """A form with a point and a direction. `changed` comes with every new position, also while a handle is dragged;
    `picked(Picked)` after it when the position was picked; `picking_changed(bool)` when clicks in the 3-D view begin or
    stop to mean something."""

    changed = QtCore.Signal()
    picked = QtCore.Signal(object)
    picking_changed = QtCore.Signal(bool)

    UI = ""
    NODES = 3  # how many mesh nodes say the geometry

    def __init__(self, source_object):
        super().__init__()
        self.form = FreeCADGui.PySideUic.loadUi(form(self.UI))
        self.source_object = source_object
        self.source = None  # PreviewSource, once it is there
        self.handles = None
        self._observer = None
        box = source_object.FemMesh.BoundBox
        self.centre = box.Center
        self.size = box.DiagonalLength
        self.form.hint.hide()
        step = _round_step(self.size / 50)
        self._point = [fields.Number(getattr(self.form, "origin" + n), self._tell, step=step) for n in "XYZ"]
        self._direction = [fields.Number(getattr(self.form, "normal" + n), self._tell, step=0.1) for n in "XYZ"]
        self.form.pickNodes.clicked.connect(lambda on: self._start("nodes") if on else self.stop_picking())
        self.form.pickGeometry.clicked.connect(lambda on: self._start("geometry") if on else self.stop_picking())
        self.form.pickView.clicked.connect(self._take_view)
        self.form.centre.clicked.connect(lambda: self.set_pose(self.centre, self.direction()))
        self.set_pose(self.centre, FreeCAD.Vector(1, 0, 0))

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

    def set_pose(self, origin, direction, radius=None, from_handle=False):
        """Enters a position; `changed` follows."""
        for field, number in zip((*self._point, *self._direction), (*origin, *direction)):
            field.set(number)
        if radius is not None:
            self._set_radius(radius)
        self._tell(from_handle)

    def _set_radius(self, radius):
        pass

    def radius(self):
        """Radius, where there is one."""
        return 0.0

    def _tell(self, from_handle=False):
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
        return ""

    def show_error(self, text):
        """Shows a message under the numbers."""
        fields.show_error(self.form.geometryError, text)

    # Handles.

    def add_handles(self, view):
        """Puts the handles into a 3-D view."""
        self.handles = self._make_handles(view)
        self.handles.set_pose(self.origin(), self.rotation(), self.radius())

    def _make_handles(self, view):
        raise NotImplementedError

    def _dragged(self, position, rotation, radius, done):
        self.set_pose(position, rotation.multVec(FreeCAD.Vector(0, 0, 1)), radius or None, from_handle=not done)

    # Picking.

    def _start(self, kind):
        self.stop_picking()
        (self.form.pickNodes if kind == "nodes" else self.form.pickGeometry).setChecked(True)
        FreeCADGui.Selection.clearSelection()
        self._nodes = {}
        self._observer = _Observer(kind, self._clicked)
        FreeCADGui.Selection.addObserver(self._observer)
        self._hint(self._ask(kind, 0))
        self.picking_changed.emit(True)

    def stop_picking(self):
        """Clicks mean nothing any more."""
        if self.form is None:
            return
        for button in (self.form.pickNodes, self.form.pickGeometry):
            button.setChecked(False)
        if self._observer is not None:
            FreeCADGui.Selection.removeObserver(self._observer)
            self._observer = None
            FreeCADGui.Selection.clearSelection()
            self._mark([])
            self.picking_changed.emit(False)
        self._hint("")

    def is_picking(self):
        """Whether the next click in the 3-D view is for this input."""
        return self._observer is not None

    def _ask(self, kind, found):
        if kind == "nodes":
            return (
                translate("FemScalpel", "Click node %1 of %2 on the mesh. Escape stops.")
                .replace("%1", str(found + 1))
                .replace("%2", str(self.NODES))
            )
        return self._ask_geometry()

    def _ask_geometry(self):
        raise NotImplementedError

    def _hint(self, text):
        self.form.hint.setText(text)
        self.form.hint.setVisible(bool(text))

    def _clicked(self, click):
        if self._observer is None:
            return
        try:
            if self._observer.kind == "nodes":
                node = picking.node_at(click, self.source)
                if node is None:
                    raise picking.PickError(translate("FemScalpel", "That is not the mesh. Click a node of the mesh."))
                self._nodes[node[0]] = node[1]
                self._mark(self._nodes.values())
                if len(self._nodes) < self.NODES:
                    self._hint(self._ask("nodes", len(self._nodes)))
                    return
                points = list(self._nodes.values())
                self._nodes = {}
                picked = self._from_nodes(points)
            else:
                picked = self._from_click(click)
        except picking.PickError as error:
            self._hint(str(error))
            self._mark([])
            # Not from within Selection's own notification.
            QtCore.QTimer.singleShot(0, FreeCADGui.Selection.clearSelection)
            return
        QtCore.QTimer.singleShot(0, self.stop_picking)
        self.take(picked)

    def _mark(self, points):
        if self.handles is not None:
            self.handles.mark([tuple(p) for p in points])

    def take(self, picked):
        """Enters what was picked."""
        self.set_pose(picked.origin, picked.direction.normalize(), picked.radius)
        self.picked.emit(picked)

    def _from_nodes(self, points):
        raise NotImplementedError

    def _from_click(self, click):
        raise NotImplementedError

    def _take_view(self):
        direction = FreeCADGui.getDocument(self.source_object.Document.Name).ActiveView.getViewDirection().negative()
        self.set_pose(self.base(), FreeCAD.Vector(*(round(x, 12) + 0.0 for x in direction)))

    def close(self):
        """Ends picking and takes the handles away."""
        self.stop_picking()
        if self.handles is not None:
            self.handles.close()
            self.handles = None
        self.form, self._point, self._direction = None, [], []


class _Observer:
    """Tells what is added to FreeCAD's selection."""

    def __init__(self, kind, function):
        self.kind = kind
        self._function = function

    def addSelection(self, document, obj, sub, point):
        obj = FreeCAD.getDocument(document).getObject(obj)
        if obj is not None:
            self._function(picking.Click(obj, sub, FreeCAD.Vector(*point)))


def _round_step(length):
    """1, 2 or 5 times a power of ten, at most `length`."""
    power = 10.0 ** len(str(int(length))) / 10 if length >= 1 else 1.0
    while power > length > 0:
        power /= 10
    return next((k * power for k in (5, 2, 1) if k * power <= length), power)
