# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: crack along a plane."""

import FreeCADGui

from ..panels.crack import CrackPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class Crack(Command):
    NAME = "FemScalpel_Crack"
    MENU = QT_TRANSLATE_NOOP("FemScalpel", "Crack")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel", "Cracks the FEM mesh along a plane and keeps its groups")
    ACCEL = "S, C"

    def run(self, mesh):
        FreeCADGui.Control.showDialog(CrackPanel(mesh))
