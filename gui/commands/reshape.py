# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: move a wall."""

from ..panels.reshape import ReshapePanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class Reshape(Operation):
    NAME = "FemScalpel_Reshape"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Reshape", "Reshape")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel_Reshape", "Moves a wall of the FEM mesh and keeps its groups")
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Reshape",
        "Moves what a group covers: the wall of a hole to another radius, a face to another plane, by a vector, "
        "or scaled about a point. The panel begins with the plane, cylinder or sphere that the wall lies on. The "
        "elements around follow as far as needed and are divided or merged where they would get poor. All groups "
        "keep their meaning.",
    )
    ACCEL = "X, W"
    PANEL = ReshapePanel
