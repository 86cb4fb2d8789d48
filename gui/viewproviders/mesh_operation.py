# SPDX-License-Identifier: LGPL-2.1-or-later
"""View provider of the objects an operator makes: icon, tree, context menu, double-click to edit, and the crack."""

import importlib

import FreeCADGui
from PySide import QtGui

from femscalpelobjects.ours import made_of

from .. import signs
from ..translate import icon, translate
from . import context_menu
from .deleting import before_deletion
from .made_crack import MadeCrack

#: Type of the object's proxy: (icon, module of panels, class).
PANELS = {
    "FemScalpel::Crack": ("FemScalpel_Crack", "crack", "CrackPanel"),
    "FemScalpel::FaceCrack": ("FemScalpel_FaceCrack", "face_crack", "FaceCrackPanel"),
    "FemScalpel::CylindricalCrack": ("FemScalpel_CylindricalCrack", "cylindrical_crack", "CylindricalCrackPanel"),
    "FemScalpel::CurvedCrack": ("FemScalpel_CurvedCrack", "curved_crack", "CurvedCrackPanel"),
    "FemScalpel::Drill": ("FemScalpel_Drill", "drill", "DrillPanel"),
    "FemScalpel::Cut": ("FemScalpel_Incision", "incision", "IncisionPanel"),
    "FemScalpel::Merge": ("FemScalpel_Merge", "merge", "MergePanel"),
    "FemScalpel::Fillet": ("FemScalpel_Fillet", "fillet", "FilletPanel"),
    "FemScalpel::Reshape": ("FemScalpel_Reshape", "reshape", "ReshapePanel"),
    "FemScalpel::Refine": ("FemScalpel_Refine", "refine", "RefinePanel"),
}


# Whenever a mesh changes, also hidden, FreeCAD compares each of its faces with each other to leave out inner ones: for
# meshes of up to so many faces. With FreeCAD's own limit, 50000, that takes a second, with this one hundredths.
_MOST_FACES_COMPARED = 10000


class ViewProviderMeshOperation:
    """Opens the task panel the object was made with, and draws the crack that it made."""

    crack = None  # MadeCrack, once attached
    _edits = None  # the panel that edits the object

    def __init__(self, vobj):
        self.Object = vobj.Object
        vobj.Proxy = self
        if self.crack is None:  # FreeCAD attaches but once, and may have done so to none
            self.attach(vobj)
        vobj.MaxFacesShowInner = min(vobj.MaxFacesShowInner, _MOST_FACES_COMPARED)

    def attach(self, vobj):
        self.Object = vobj.Object
        self.crack = MadeCrack(vobj)

    def updateData(self, obj, prop):
        if prop == "FemMesh" and self.crack is not None:
            self.crack.mesh_changed()

    def onChanged(self, vobj, prop):
        if prop == "Visibility" and self.crack is not None:
            self.crack.show()

    def _panel(self):
        return PANELS.get(getattr(getattr(self.Object, "Proxy", None), "Type", ""))

    def getIcon(self):
        panel = self._panel()
        return icon(panel[0] if panel else "FemScalpel")

    def claimChildren(self):
        """The meshes that this one is made of stand under it in the tree."""
        return made_of(self.Object)

    def setEdit(self, vobj, mode=0):
        panel = self._panel()
        if mode != 0 or panel is None:
            return None
        obj = vobj.Object
        if obj.Source is None or not obj.Source.FemMesh.NodeCount:
            QtGui.QMessageBox.warning(
                FreeCADGui.getMainWindow(),
                translate("FemScalpel", "Edit"),
                translate("FemScalpel", "%1 has no source mesh. Set its property Source to a FEM mesh first.").replace(
                    "%1", obj.Label
                ),
            )
            return False
        module = importlib.import_module("femscalpelgui.panels." + panel[1])
        with signs.busy(translate("FemScalpel", "Opening the panel…")):
            self._edits = getattr(module, panel[2])(obj.Source, obj)
            FreeCADGui.Control.showDialog(self._edits)
        return True

    def unsetEdit(self, vobj, mode=0):
        panel, self._edits = self._edits, None
        if panel is not None:
            panel.end()  # before FreeCAD deletes its forms
        FreeCADGui.Control.closeDialog()
        return True

    def doubleClicked(self, vobj):
        document = FreeCADGui.getDocument(vobj.Object.Document.Name)
        if context_menu.is_free(translate("FemScalpel", "Edit")):
            document.setEdit(vobj.Object.Name)
        return True

    def setupContextMenu(self, vobj, menu):
        context_menu.fill(menu, self, vobj)

    def onDelete(self, vobj, subelements):
        before_deletion(vobj.Object)
        return True

    def dumps(self):
        return None

    def loads(self, state):
        return None

    # FreeCAD before 0.21.2 asks for these.
    __getstate__ = dumps
    __setstate__ = loads
