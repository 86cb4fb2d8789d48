# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: drill a hole."""

from ..panels.drill import DrillPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class Drill(Operation):
    NAME = "FemScalpel_Drill"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Drill", "Drill")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel_Drill", "Drills a hole into the FEM mesh and keeps its groups")
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Drill",
        "Drills a hole, through or to a depth. Give axis and radius as for a cylindrical crack; the elements that "
        "go are shown as ghosts. The faces of the wall become a group; groups lose what is drilled away "
        "and "
        "nothing else, and the report says which.",
    )
    ACCEL = "X, D"
    PANEL = DrillPanel
