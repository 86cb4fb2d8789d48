# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along a plane."""

from ..translate import QT_TRANSLATE_NOOP
from .plane_panel import PlanePanel


class CrackPanel(PlanePanel):
    """Asks for the plane of a crack."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Crack")
    ICON = "FemScalpel_Crack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "Crack", "makeCrack"

    def operation(self, tool, options):
        return lambda scalpel: scalpel.crack(tool, band_only=True, **options)
