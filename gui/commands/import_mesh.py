# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: read a mesh with its groups from a file."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

import femscalpel

from ..macro import record_import
from ..panels.summary import sentence
from ..panels.view_panel import TOLD
from ..translate import QT_TRANSLATE_NOOP, translate
from .base import Command, Unusable, has_free_window


class ImportMesh(Command):
    NAME = "FemScalpel_ImportMesh"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_ImportMesh", "Import mesh…")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_ImportMesh", "Reads a FEM mesh with its groups from a file, and keeps what else the file holds"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_ImportMesh",
        "Reads a mesh with its groups from a file. Cards of a CalculiX deck, fields and groups of element faces are "
        "kept in the document, and Export writes them, after cracks and holes too.",
    )
    ACCEL = "X, L"

    def IsActive(self):
        return has_free_window()

    def Activated(self, index=0):
        self.guarded(self.ask)

    def ask(self):
        """Asks for the file and reads it."""
        path, _ = QtGui.QFileDialog.getOpenFileName(
            FreeCADGui.getMainWindow(), translate("FemScalpel", "Import mesh"), "", ";;".join(self.filters())
        )
        if path:
            self.read(path)

    @staticmethod
    def filters():
        """Those of the file dialog: all files that can be read, then each kind."""
        readable = [f for f in femscalpel.formats() if f.reads]
        endings = " ".join("*" + e for f in readable for e in f.extensions)
        each = [f"{f.title} ({' '.join('*' + e for e in f.extensions)})" for f in readable]
        return [translate("FemScalpel", "Meshes") + f" ({endings})", *each]

    @classmethod
    def read(cls, path):
        """Adds the mesh of a file to the active document, or to a new one; raises Unusable with the reason when that is
        not possible."""
        is_new = False
        try:
            names = femscalpel.meshes_in(path)
            name = names[0] if names else None
            if len(names) > 1:
                name, is_chosen = QtGui.QInputDialog.getItem(
                    FreeCADGui.getMainWindow(),
                    translate("FemScalpel", "Import mesh"),
                    translate("FemScalpel", "The file holds %1 meshes. Which one?").replace("%1", str(len(names))),
                    names,
                    0,
                    False,
                )
                if not is_chosen:
                    return
            record_import()
            is_new = FreeCAD.ActiveDocument is None
            if is_new:
                FreeCADGui.doCommand("FreeCAD.newDocument()")
            which = f", mesh={name!r}" if len(names) > 1 else ""
            FreeCADGui.doCommand(f"ObjectsFemScalpel.importMesh(FreeCAD.ActiveDocument, {path!r}{which})")
            said = translate("FemScalpel", "%1 was read.").replace("%1", path)
        except femscalpel.Cancelled:
            cls.leave(is_new)
            said = translate("FemScalpel", "Cancelled: nothing was imported.")
        except (femscalpel.Error, OSError, ValueError) as error:
            cls.leave(is_new)
            raise Unusable(sentence(str(error))) from error
        else:
            cls.show(FreeCAD.ActiveDocument)
        FreeCADGui.getMainWindow().statusBar().showMessage(said, TOLD)

    @staticmethod
    def leave(is_new):
        """Closes a document that was made for a mesh that did not come."""
        if is_new:
            FreeCADGui.doCommand("FreeCAD.closeDocument(FreeCAD.ActiveDocument.Name)")

    @staticmethod
    def show(document):
        """Selects what was added last, and fits the view to what there is."""
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(document.Objects[-1])
        view = FreeCADGui.getDocument(document.Name).ActiveView
        if len(document.Objects) == 1:
            view.viewIsometric()
        view.fitAll()
