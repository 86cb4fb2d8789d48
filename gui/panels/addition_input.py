# SPDX-License-Identifier: LGPL-2.1-or-later
"""Input of the mesh that is added to another one."""

import FreeCAD
from PySide import QtCore

import femmesh_bridge
from femscalpelobjects.merge import as_added
from femscalpelobjects.whole import whole_of

from ..translate import translate
from ..view import picking
from ..view.preview_data import PreviewSource
from .panel_input import PanelInput


class Addition:
    """The mesh that an object adds to another one; read at the first use, on whatever thread that is."""

    def __init__(self, obj, source_object):
        self.name = obj.Name
        self._object, self._femmesh, self._source = obj, obj.FemMesh, source_object.FemMesh
        self._mesh = self._surface = None

    def mesh(self):
        """The femscalpel.Mesh."""
        if self._mesh is None:
            mesh = whole_of(self._object) or femmesh_bridge.from_femmesh(self._femmesh)
            self._mesh = as_added(mesh, self._source)
            self._surface = PreviewSource(self._mesh).whole()
        return self._mesh

    def surface(self):
        """What there is to draw of it, None while it was not read."""
        return self._surface


class AdditionInput(PanelInput):
    """A FEM mesh object of the document, other than `source_object` and what is made of `edited`."""

    UI = "addition_input.ui"

    def __init__(self, source_object, edited=None, chosen=None):
        super().__init__(source_object)
        self._addition = None
        self.buttons = {"mesh": self.form.pickAddition}
        self._connect_buttons()
        document = source_object.Document
        self._others = [o for o in document.Objects if self._can_be_added(o, edited)]
        box = self.form.addition
        if len(self._others) != 1:
            box.addItem(translate("FemScalpel", "none yet") if self._others else translate("FemScalpel", "none"), None)
        for obj in self._others:
            box.addItem(obj.Label, obj.Name)
        if chosen in self._others:
            self._choose(chosen)
        box.currentIndexChanged.connect(lambda *_: self._tell())
        self._observer_of_document = _Changes(self._changed, self._deleted)
        FreeCAD.addDocumentObserver(self._observer_of_document)

    def _can_be_added(self, obj, edited):
        if not obj.isDerivedFrom("Fem::FemMeshObject") or obj in (self.source_object, edited):
            return False
        return obj.FemMesh.NodeCount > 0 and (edited is None or edited not in obj.OutListRecursive)

    def _choose(self, obj):
        self.form.addition.setCurrentIndex(self.form.addition.findData(obj.Name))

    def _tell(self):
        self._addition = None
        self.changed.emit()

    def _changed(self, obj, prop):
        # Moved by hand, or meshed anew, while the panel is open.
        if self.form is not None and obj == self.object() and prop in ("Placement", "FemMesh"):
            self._addition = None
            QtCore.QTimer.singleShot(0, self.changed.emit)

    def _deleted(self, obj):
        if self.form is None or obj not in self._others:
            return
        self._others.remove(obj)
        index = self.form.addition.findData(obj.Name)
        if index >= 0:
            QtCore.QTimer.singleShot(0, lambda: self.form is not None and self.form.addition.removeItem(index))

    def object(self):
        """The object that is chosen, or None."""
        name = self.form.addition.currentData()
        return self.source_object.Document.getObject(name) if name else None

    def addition(self):
        """The Addition that is chosen, or None."""
        obj = self.object()
        if self._addition is None and obj is not None:
            self._addition = Addition(obj, self.source_object)
        return self._addition

    def others(self):
        """The objects that can be chosen."""
        return self._others

    def error(self):
        if not self._others:
            return translate(
                "FemScalpel",
                "The document has no other FEM mesh. Draw the part to add, and mesh it in the FEM workbench, or import "
                "a mesh file.",
            )
        return "" if self.object() is not None else translate("FemScalpel", "Choose the mesh to add, or pick it.")

    # Picking.

    def _ask(self, kind):
        return translate("FemScalpel", "Click the mesh to add, here or in the tree. Escape stops.")

    def _picked(self, kind, click):
        if click.obj not in self._others:
            raise picking.PickError(
                translate("FemScalpel", "%1 cannot be added. Click another FEM mesh.").replace("%1", click.obj.Label)
            )
        return click.obj

    def take(self, picked):
        self._choose(picked)

    def close(self):
        if self._observer_of_document is not None:
            FreeCAD.removeDocumentObserver(self._observer_of_document)
            self._observer_of_document = None
        self._addition = None
        super().close()


class _Changes:
    """Tells of changes of document objects."""

    def __init__(self, changed, deleted):
        self._changed, self._deleted = changed, deleted

    def slotChangedObject(self, obj, prop):
        self._changed(obj, prop)

    def slotDeletedObject(self, obj):
        self._deleted(obj)
