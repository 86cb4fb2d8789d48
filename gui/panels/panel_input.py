# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all inputs of the operators' task panels share: a form, and picking from the 3-D view."""

import FreeCAD
import FreeCADGui
from PySide import QtCore

from ..translate import form
from ..view import picking
from . import fields


class PanelInput(QtCore.QObject):
    """A form that says where an operator works, with the labels `hint` and `geometryError`. `changed` comes with
    everything new that is entered; `picking_changed(bool)` when clicks in the 3-D view begin or stop to mean
    something."""

    changed = QtCore.Signal()
    picking_changed = QtCore.Signal(bool)

    UI = ""

    followed = None  # the Followed, where the position can follow geometry

    def __init__(self, source_object):
        super().__init__()
        self.form = FreeCADGui.PySideUic.loadUi(form(self.UI))
        self.source_object = source_object
        self.source = None  # PreviewSource, once it is there
        self.buttons = {}  # those that start picking, by what they pick
        self._observer = None
        box = source_object.FemMesh.BoundBox
        self.centre = box.Center
        self.size = box.DiagonalLength
        self.form.hint.hide()

    @property
    def window(self):
        """The widget that the task panel shows."""
        return self.form

    def error(self):
        """What is wrong with what is entered, "" when nothing is."""
        return ""

    def show_error(self, text):
        """Shows a message under the fields."""
        fields.show_error(self.error_label(), text)

    def error_label(self):
        """The label for messages about the geometry."""
        return self.form.geometryError

    def move_into(self, source):
        """Moves what is entered at first, beside the material of a PreviewSource, into it. Whether it did, and told."""
        return False

    def list_groups(self, source_object):
        """The mesh object has other groups now."""

    def add_handles(self, view):
        """Puts what can be seen of it into a 3-D view."""

    def show_grips(self, on):
        """Whether what is seen in the 3-D view can be grabbed."""

    # Picking.

    def _connect_buttons(self):
        for kind, button in self.buttons.items():
            button.clicked.connect(self._starter(kind))

    def _starter(self, kind):
        return lambda on: self._start(kind) if on else self.stop_picking()

    def _start(self, kind):
        self.stop_picking()
        self.buttons[kind].setChecked(True)
        FreeCADGui.Selection.clearSelection()
        self._observer = _Observer(kind, self._clicked)
        FreeCADGui.Selection.addObserver(self._observer)
        self._hint(self._ask(kind))
        self.picking_changed.emit(True)

    def stop_picking(self):
        """Clicks mean nothing any more."""
        if self.form is None:
            return
        for button in self.buttons.values():
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

    def _ask(self, kind):
        """What to click at, for the user."""
        raise NotImplementedError

    def _hint(self, text):
        self.form.hint.setText(text)
        self.form.hint.setVisible(bool(text))

    def _clicked(self, click):
        if self._observer is None:
            return
        try:
            picked = self._picked(self._observer.kind, click)
        except picking.PickError as error:
            self._hint(str(error))
            self._mark([])
            # Not from within Selection's own notification.
            QtCore.QTimer.singleShot(0, FreeCADGui.Selection.clearSelection)
            return
        if picked is not None:
            QtCore.QTimer.singleShot(0, self.stop_picking)
            self.take(picked)

    def _picked(self, kind, click):
        """What a click says, None while more clicks are needed; may raise PickError."""
        raise NotImplementedError

    def take(self, picked):
        """Enters what was picked."""
        raise NotImplementedError

    def _mark(self, points):
        """Marks picked points in the 3-D view."""

    def close(self):
        """Ends picking and takes everything out of the 3-D view."""
        self.stop_picking()
        self.form, self.buttons, self.source = None, {}, None


class _Observer:
    """Tells what is added to FreeCAD's selection."""

    def __init__(self, kind, function):
        self.kind = kind
        self._function = function

    def addSelection(self, document, obj, sub, point):
        obj = FreeCAD.getDocument(document).getObject(obj)
        if obj is not None:
            self._function(picking.Click(obj, sub, FreeCAD.Vector(*point)))
