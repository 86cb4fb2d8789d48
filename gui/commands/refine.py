# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: refine near a tool."""

from ..panels.refine import RefinePanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class Refine(Operation):
    NAME = "FemScalpel_Refine"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Refine", "Refine")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_Refine", "Refines the FEM mesh near a cylinder, sphere or other tool and keeps its groups"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Refine",
        "Divides the elements near a cylinder, sphere, plane, CAD face or other tool until their edges are as short "
        "as you ask, growing towards the rest of the mesh by the gradation. Use it where a crack or hole needs a "
        "finer mesh around it. All groups keep their meaning.",
    )
    ACCEL = "X, R"
    PANEL = RefinePanel
