# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: write a mesh with its groups to a file."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

import femscalpel

from ..macro import record_import
from ..panels.summary import sentence
from ..panels.view_panel import TOLD
from ..translate import QT_TRANSLATE_NOOP, translate
from .base import Command, Unusable


class Export(Command):
    NAME = "FemScalpel_Export"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Export", "Export mesh…")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_Export", "Writes the FEM mesh with its groups to a file, in a format of solvers or viewers"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Export",
        "Writes the mesh with its groups to a file whose ending says the format. The file dialog lists the formats.",
    )
    ACCEL = "X, E"

    def run(self, mesh):
        endings = self.endings()
        path, chosen = QtGui.QFileDialog.getSaveFileName(
            FreeCADGui.getMainWindow(),
            translate("FemScalpel", "Export mesh"),
            mesh.Label + next(iter(endings.values())),
            ";;".join(endings),
        )
        if path:
            self.write(mesh, path if "." in path.rsplit("/", 1)[-1] else path + endings[chosen])

    @staticmethod
    def endings():
        """Each filter of the file dialog, and the ending a name without one gets under it."""
        return {
            f"{f.title} ({' '.join('*' + e for e in f.extensions)})": f.extensions[0]
            for f in femscalpel.formats()
            if f.writes
        }

    @staticmethod
    def write(mesh, path):
        """Writes the mesh of an object; raises Unusable with the reason when that is not possible."""
        document = (
            "FreeCAD.ActiveDocument"
            if mesh.Document == FreeCAD.ActiveDocument
            else f"FreeCAD.getDocument({mesh.Document.Name!r})"
        )
        record_import()
        try:
            FreeCADGui.doCommand(f"ObjectsFemScalpel.exportMesh({document}.getObject({mesh.Name!r}), {path!r})")
            said = translate("FemScalpel", "%1 was written.").replace("%1", path)
        except femscalpel.Cancelled:
            said = translate("FemScalpel", "Cancelled: no file was written.")
        except (femscalpel.Error, OSError, ValueError) as error:
            raise Unusable(sentence(str(error))) from error
        FreeCADGui.getMainWindow().statusBar().showMessage(said, TOLD)
