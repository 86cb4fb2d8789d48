# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all commands share: texts, when they are active, and which mesh they are for."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

from femscalpelobjects.ours import made_of

from ..translate import icon, translate


class Unusable(Exception):
    """The command cannot work on what is selected; the text says what to do."""


def is_mesh(obj):
    """Whether a document object holds a FEM mesh."""
    return obj.isDerivedFrom("Fem::FemMeshObject")


def find_mesh(selected=None):
    """The mesh object the user means: the selected one, that of the selected or active analysis, or the only one.

    `selected`: in place of what is selected. Raises Unusable.
    """
    document = FreeCAD.ActiveDocument
    if document is None:
        raise Unusable(translate("FemScalpel", "Open a document with a FEM mesh first."))
    meshes = [o for o in document.Objects if is_mesh(o)]
    if not meshes:
        raise Unusable(
            translate(
                "FemScalpel", "The document has no FEM mesh. Make one in the FEM workbench, or import a mesh file."
            )
        )
    if selected is None:
        selected = FreeCADGui.Selection.getSelection(document.Name)
    chosen = [o for o in selected if is_mesh(o)]
    for analysis in (o for o in selected if o.isDerivedFrom("Fem::FemAnalysis")):
        chosen += [o for o in analysis.Group if is_mesh(o)]
    if len(chosen) > 1:
        raise Unusable(translate("FemScalpel", "Several FEM meshes are selected. Select one."))
    if not chosen and len(selected) == 1 and not hasattr(selected[0], "Shape"):
        raise Unusable(
            translate("FemScalpel", "%1 is not a FEM mesh. Select the mesh in the tree.").replace(
                "%1", selected[0].Label
            )
        )
    if not chosen and len(meshes) > 1:
        # A chain of operations counts as its last link.
        ends = [m for m in meshes if not any(m in made_of(o) for o in meshes)]
        if len(ends) > 1:
            raise Unusable(
                translate("FemScalpel", "The document has %1 FEM meshes. Select the one you mean in the tree.").replace(
                    "%1", str(len(ends))
                )
            )
        meshes = ends
    mesh = (chosen or meshes)[0]
    if "Invalid" in mesh.State:
        raise Unusable(
            translate("FemScalpel", "%1 has an error. Mend it, or select another mesh.").replace("%1", mesh.Label)
        )
    if not mesh.FemMesh.NodeCount:
        raise Unusable(
            translate("FemScalpel", "%1 has no mesh yet: it is empty. Make the mesh first.").replace("%1", mesh.Label)
        )
    return mesh


def has_free_window():
    """Whether no task panel is open."""
    return not FreeCADGui.Control.activeDialog()


class Command:
    """A command for one FEM mesh. Subclasses set NAME, MENU, TOOLTIP, WHATS_THIS, ACCEL, and PANEL or write
    run(mesh)."""

    NAME = MENU = TOOLTIP = WHATS_THIS = ACCEL = ICON = ""
    #: The task panel it opens.
    PANEL = None
    CONTEXT = "FemScalpel"

    def GetResources(self):
        return {
            "Pixmap": icon(self.ICON or self.NAME),
            "MenuText": translate(self.CONTEXT, self.MENU),
            "ToolTip": translate(self.CONTEXT, self.TOOLTIP),
            "StatusTip": translate(self.CONTEXT, self.TOOLTIP),
            "WhatsThis": translate(self.CONTEXT, self.WHATS_THIS),
            "Accel": self.ACCEL,
        }

    def IsActive(self):
        """With a FEM mesh in the active document and no task panel open."""
        document = FreeCAD.ActiveDocument
        return document is not None and has_free_window() and any(is_mesh(o) for o in document.Objects)

    def Activated(self, index=0):
        self.guarded(lambda: self.run(find_mesh()))

    def guarded(self, action):
        """Does something; tells the user when it raises Unusable."""
        try:
            action()
        except Unusable as reason:
            QtGui.QMessageBox.warning(
                FreeCADGui.getMainWindow(), translate(self.CONTEXT, self.MENU).replace("&", ""), str(reason)
            )

    def run(self, mesh):
        """Does it."""
        FreeCADGui.Control.showDialog(self.PANEL(mesh))
