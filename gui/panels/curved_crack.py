# SPDX-License-Identifier: LGPL-2.1-or-later
"""Task panel: crack along a sphere, torus, cone, cylinder or face of a part."""

from femscalpel.tools import TOOLS

from ..translate import QT_TRANSLATE_NOOP
from .along_tool_panel import AlongToolPanel


class CurvedCrackPanel(AlongToolPanel):
    """Asks for the tool of a crack that is no plane."""

    TITLE = QT_TRANSLATE_NOOP("FemScalpel", "Curved crack")
    ICON = "FemScalpel_CurvedCrack"
    GROUP_NAME, OBJECT_NAME, MAKE = "CRACK", "CurvedCrack", "makeCurvedCrack"
    SHAPES = sorted((name for name in TOOLS if name != "Plane"), key=lambda name: name != "Sphere")

    def operation(self, tool, options):
        return lambda scalpel, band_only: scalpel.crack(tool, band_only=band_only, **options)
