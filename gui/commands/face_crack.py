# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: crack along faces that the mesh has."""

from ..panels.face_crack import FaceCrackPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Operation


class FaceCrack(Operation):
    NAME = "FemScalpel_FaceCrack"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_FaceCrack", "Crack along faces")
    TOOLTIP = QT_TRANSLATE_NOOP("FemScalpel_FaceCrack", "Cracks the FEM mesh along faces that it has, those of a group")
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_FaceCrack",
        "Opens the FEM mesh along faces between its elements. Choose a group of such faces (of a shell: of edges), or "
        "of their nodes; elements may be of any type, and none moves or is divided. OK makes an object that follows "
        "its source mesh. The faces of both lips become groups; all other groups keep their meaning.",
    )
    ACCEL = "X, A"
    PANEL = FaceCrackPanel
