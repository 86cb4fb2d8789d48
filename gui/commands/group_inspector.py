# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: group inspector."""

import FreeCADGui

from ..panels.group_inspector import GroupInspectorPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class GroupInspector(Command):
    NAME = "FemScalpel_GroupInspector"
    MENU = QT_TRANSLATE_NOOP("FemScalpel", "Group inspector")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel", "Shows the groups of a FEM mesh, what they cover and what uses them")
    ACCEL = "S, G"

    def run(self, mesh):
        FreeCADGui.Control.showDialog(GroupInspectorPanel(mesh))
