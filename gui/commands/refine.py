# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: refine near a tool."""

import FreeCADGui

from ..panels.refine import RefinePanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class Refine(Command):
    NAME = "FemScalpel_Refine"
    MENU = QT_TRANSLATE_NOOP("FemScalpel", "Refine")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel", "Refines the FEM mesh near a cylinder, sphere or plane and keeps its groups")
    ACCEL = "S, R"

    def run(self, mesh):
        FreeCADGui.Control.showDialog(RefinePanel(mesh))
