# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the commands leave in recorded macros."""

import FreeCADGui


def record_import():
    """Imports ObjectsFemScalpel by a recorded line.

    Gui.addModule() is no help: it records a module once in a session of FreeCAD, also when a second macro is recorded.
    """
    FreeCADGui.doCommand("import FreeCAD")
    FreeCADGui.doCommand("import ObjectsFemScalpel")
