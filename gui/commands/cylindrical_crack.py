# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: crack along a cylinder."""

import FreeCADGui

from ..panels.cylindrical_crack import CylindricalCrackPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class CylindricalCrack(Command):
    NAME = "FemScalpel_CylindricalCrack"
    MENU = QT_TRANSLATE_NOOP("FemScalpel", "Cylindrical crack")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel", "Cracks the FEM mesh along a cylinder and keeps its groups")
    ACCEL = "S, Y"

    def run(self, mesh):
        FreeCADGui.Control.showDialog(CylindricalCrackPanel(mesh))
