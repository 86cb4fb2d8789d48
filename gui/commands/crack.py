# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: crack along a plane."""

from ..panels.crack import CrackPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class Crack(Operation):
    NAME = "FemScalpel_Crack"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Crack", "Crack")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel_Crack", "Cracks the FEM mesh along a plane and keeps its groups")
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Crack",
        "Opens the FEM mesh along a plane. Give the plane by numbers, pick it from the view (three nodes, a "
        "planar face, an edge, a datum, a sketch, the view direction) or drag the handles; the preview "
        "shows the "
        "mesh as it will be. OK makes an object that follows its source mesh. The faces of both lips "
        "become "
        "groups; all other groups keep their meaning.",
    )
    ACCEL = "X, C"
    PANEL = CrackPanel
