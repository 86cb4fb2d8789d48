# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: mesh quality."""

from ..panels.mesh_quality import MeshQualityPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class MeshQuality(Command):
    NAME = "FemScalpel_MeshQuality"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_MeshQuality", "Mesh quality")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_MeshQuality", "Shows the quality of the elements of a FEM mesh in colours and finds the worst"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_MeshQuality",
        "Colours the elements by mean ratio (1: equilateral, 0: flat), smallest dihedral angle or scaled "
        "Jacobian. Click one of the worst elements to go to it. The mesh is not changed.",
    )
    ACCEL = "X, Q"
    PANEL = MeshQualityPanel
