# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: open the example. FreeCAD's own list of examples (Start page) has no place for those of add-ons."""

import FreeCADGui

from ..macro import record_import
from ..translate import EXAMPLE, QT_TRANSLATE_NOOP, translate
from .base import Command, Unusable, has_free_window


class Example(Command):
    NAME = "FemScalpel_Example"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_Example", "Example: caisson")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_Example", "Opens a welded caisson as a new document, a mesh with 35 groups to try the commands on"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_Example",
        "Opens a new document with the mesh of a caisson that hangs on stiffeners, in an analysis: tetrahedra with "
        "groups "
        "for parts, supports, loads and gauges. Crack a hanger, drill the floor, look at the groups before and after.",
    )
    ICON = "FemScalpel"

    def IsActive(self):
        return has_free_window()

    def Activated(self, index=0):
        self.guarded(self.open)

    @staticmethod
    def open():
        """Opens it; raises Unusable when the workbench was built without."""
        if not EXAMPLE:
            raise Unusable(translate("FemScalpel", "This workbench was built without its example: Gmsh was not there."))
        record_import()
        FreeCADGui.doCommand("ObjectsFemScalpel.openExample()")
        view = FreeCADGui.ActiveDocument.ActiveView
        view.viewIsometric()
        view.fitAll()
