# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: mesh quality."""

import FreeCADGui

from ..panels.mesh_quality import MeshQualityPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class MeshQuality(Command):
    NAME = "FemScalpel_MeshQuality"
    MENU = QT_TRANSLATE_NOOP("FemScalpel", "Mesh quality")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel", "Shows the quality of the elements of a FEM mesh in colours and finds the worst")
    ACCEL = "S, Q"

    def run(self, mesh):
        FreeCADGui.Control.showDialog(MeshQualityPanel(mesh))
