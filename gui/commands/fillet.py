# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: round edges."""

from ..panels.fillet import FilletPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class Fillet(Operation):
    NAME = "FemScalpel_Fillet"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Fillet", "Fillet")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel_Fillet", "Rounds edges of the FEM mesh and keeps its groups")
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Fillet",
        "Rounds an edge, convex or concave, as a ball of the radius would that rolls along it. Click near the "
        "edge in the 3-D view, or choose a group on it; it is rounded as far as it goes on without a corner. The "
        "faces of the rounding become a group, and the groups beside it keep to their sides.",
    )
    ACCEL = "X, F"
    PANEL = FilletPanel
