# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: crack along a cylinder."""

from ..panels.cylindrical_crack import CylindricalCrackPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class CylindricalCrack(Operation):
    NAME = "FemScalpel_CylindricalCrack"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_CylindricalCrack", "Cylindrical crack")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_CylindricalCrack", "Cracks the FEM mesh along a cylinder and keeps its groups"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_CylindricalCrack",
        "Opens the FEM mesh along a cylinder. Give axis and radius by numbers, pick them from the view (a "
        "cylindrical face, a straight or circular edge, two nodes, a point on a face) or drag the "
        "handles. "
        "It may crack between two heights and two angles only. Elements that are large for the cylinder are divided "
        "first.",
    )
    ACCEL = "X, Y"
    PANEL = CylindricalCrackPanel
