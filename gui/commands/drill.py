# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: drill a hole."""

import FreeCADGui

from ..panels.drill import DrillPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class Drill(Command):
    NAME = "FemScalpel_Drill"
    MENU = QT_TRANSLATE_NOOP("FemScalpel", "Drill")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel", "Drills a hole into the FEM mesh and keeps its groups")
    ACCEL = "S, D"

    def run(self, mesh):
        FreeCADGui.Control.showDialog(DrillPanel(mesh))
