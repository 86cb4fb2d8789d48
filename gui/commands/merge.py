# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: add another mesh to a mesh."""

import FreeCAD
import FreeCADGui

from ..panels.merge import MergePanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation, find_mesh, is_mesh


class Merge(Operation):
    NAME = "FemScalpel_Merge"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Merge", "Merge")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_Merge", "Adds another FEM mesh to the FEM mesh and keeps the groups of both"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Merge",
        "Adds another FEM mesh, such as a stiffener or a boss drawn in FreeCAD and meshed there. Where the two "
        "touch or cross they get the same nodes and edges; where two solids overlap, the overlap is cut off one "
        "of them. Select the mesh first, then the one to add, or choose that in the panel. The groups of both "
        "stay, and what was added and where it is joined become groups.",
    )
    ACCEL = "X, M"

    def _start(self):
        document = FreeCAD.ActiveDocument
        selected = FreeCADGui.Selection.getSelection(document.Name) if document is not None else []
        two = len(selected) == 2 and all(map(is_mesh, selected))
        mesh = self.latest(find_mesh(selected[:1] if two else None))
        if mesh is not None:
            FreeCADGui.Control.showDialog(MergePanel(mesh, chosen=selected[1] if two else None))
