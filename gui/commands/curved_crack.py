# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: crack along a curved tool."""

import FreeCAD
import FreeCADGui

from ..panels.curved_crack import CurvedCrackPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class CurvedCrack(Operation):
    NAME = "FemScalpel_CurvedCrack"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_CurvedCrack", "Curved crack")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_CurvedCrack",
        "Cracks the FEM mesh along a sphere, torus, cone or face of a part and keeps its groups",
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_CurvedCrack",
        "Opens the FEM mesh along a sphere, torus, cone or cylinder, given by numbers, picked from the view or dragged "
        "by its handles; or along faces of a part drawn in FreeCAD: as far as these go, and where they end inside the "
        "material is the crack front. Faces that are selected before are taken. The preview shows the mesh as it will "
        "be; the faces of both lips become groups; all other groups keep their meaning.",
    )
    ACCEL = "X, U"

    def run(self, mesh):
        FreeCADGui.Control.showDialog(CurvedCrackPanel(mesh, faces=_selected_faces()))


def _selected_faces():
    """(object, names) of the faces that are selected, of the first object with any; None where there are none."""
    for selected in FreeCADGui.Selection.getSelectionEx(FreeCAD.ActiveDocument.Name):
        names = [name for name in selected.SubElementNames if name.startswith("Face")]
        if names and hasattr(selected.Object, "Shape"):
            return selected.Object, names
    return None
