# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all commands share: texts, when they are active, and which mesh they are for."""

import FemGui
import FreeCAD
import FreeCADGui
from PySide import QtGui

from femscalpelobjects.ours import made_of

from .. import signs
from ..translate import icon, translate


class Unusable(Exception):
    """The command cannot work on what is selected; the text says what to do."""


def is_mesh(obj):
    """Whether a document object holds a FEM mesh."""
    return obj.isDerivedFrom("Fem::FemMeshObject")


def ends_of(mesh, meshes):
    """Those of some mesh objects that are made from `mesh`, or are it, and from which no other is made."""
    made = [m for m in meshes if mesh in made_of(m)]
    return [end for m in made for end in ends_of(m, meshes)] if made else [mesh]


def find_mesh(selected=None):
    """The mesh object the user means: the selected one, or that of the selected analysis; with nothing selected the
    last of the only chain of operations, or of the one that begins in the active, or only, analysis.

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
            analysed = [o for o in analysis.Group if is_mesh(o)] if (analysis := _analysis(document)) else []
            ends = list({end.Name: end for mesh in analysed for end in ends_of(mesh, meshes)}.values()) or ends
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


def _analysis(document):
    """The active analysis, or the only one, of a document, or None."""
    analyses = document.findObjects("Fem::FemAnalysis")
    active = FemGui.getActiveAnalysis()
    return active if active in analyses else analyses[0] if len(analyses) == 1 else None


def has_free_window():
    """Whether no task panel is open."""
    return not FreeCADGui.Control.activeDialog()


class Command:
    """A command that looks at one FEM mesh. Subclasses set NAME, MENU, TOOLTIP, WHATS_THIS, ACCEL, and PANEL or write
    run(mesh)."""

    NAME = MENU = TOOLTIP = WHATS_THIS = ACCEL = ICON = ""
    #: The task panel it opens.
    PANEL = None

    def GetResources(self):
        # FreeCAD translates the texts, in the context of the command's name, and anew when the language changes.
        return {
            "Pixmap": icon(self.ICON or self.NAME),
            "MenuText": self.MENU,
            "ToolTip": self.TOOLTIP,
            "StatusTip": self.TOOLTIP,
            "WhatsThis": self.WHATS_THIS,
            "Accel": self.ACCEL,
        }

    @classmethod
    def page(cls):
        """The name of its page of help."""
        return cls.__module__.rsplit(".", 1)[-1]

    def title(self):
        """Its name in the user's language."""
        return translate(self.NAME, self.MENU).replace("&", "")

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
            QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), self.title(), str(reason))

    def run(self, mesh):
        """Does it."""
        with signs.busy(translate("FemScalpel", "Opening the panel…")):
            FreeCADGui.Control.showDialog(self.PANEL(mesh))


class Operation(Command):
    """A command that makes a new mesh of one. Of a mesh that another operation has changed already it asks whether the
    latest is meant."""

    def Activated(self, index=0):
        self.guarded(self._start)

    def _start(self):
        mesh = self.latest(find_mesh())
        if mesh is not None:
            self.run(mesh)

    def latest(self, mesh):
        """`mesh`, or what was made from it last; None when the user wants neither."""
        meshes = [o for o in mesh.Document.Objects if is_mesh(o)]
        usable = [m for m in ends_of(mesh, meshes) if "Invalid" not in m.State and m.FemMesh.NodeCount]
        last = max(usable, key=meshes.index, default=mesh)
        if last == mesh:
            return mesh
        answer = QtGui.QMessageBox.question(
            FreeCADGui.getMainWindow(),
            self.title(),
            translate("FemScalpel", "%1 is the source of another operation. Take %2, the latest, instead?")
            .replace("%1", mesh.Label)
            .replace("%2", last.Label),
            QtGui.QMessageBox.Yes | QtGui.QMessageBox.No | QtGui.QMessageBox.Cancel,
            QtGui.QMessageBox.Yes,
        )
        return {QtGui.QMessageBox.Yes: last, QtGui.QMessageBox.No: mesh}.get(answer)
