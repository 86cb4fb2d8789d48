# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along a cylinder."""

from ..translate import QT_TRANSLATE_NOOP
from .cylinder_panel import CylinderPanel


class CylindricalCrackPanel(CylinderPanel):
    """Asks for the cylinder of a crack."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Cylindrical crack")
    ICON = "FemScalpel_CylindricalCrack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "CylindricalCrack", "makeCylindricalCrack"

    def operation(self, tool, options):
        return lambda scalpel: scalpel.crack(tool, band_only=True, **options)
