# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: cut a slot."""

from ..panels.incision import IncisionPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class Incision(Operation):
    NAME = "FemScalpel_Incision"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Incision", "Incision")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel_Incision", "Cuts a slot into the FEM mesh and keeps its groups")
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Incision",
        "Cuts a slot between two parallel planes. Give the plane in the middle as for a crack, the width, "
        "and whether it goes right through or down to the plane's point; the elements that go are shown "
        "as "
        "ghosts. The faces of the two walls become groups; groups lose what is cut "
        "away and nothing else, and the report says which.",
    )
    ACCEL = "X, I"
    PANEL = IncisionPanel
