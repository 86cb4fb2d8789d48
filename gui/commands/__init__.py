# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands, one file each."""

import FreeCADGui

from .crack import Crack
from .cylindrical_crack import CylindricalCrack
from .drill import Drill
from .export import Export
from .group_inspector import GroupInspector
from .mesh_quality import MeshQuality
from .refine import Refine

#: In the order of menu and toolbar; None is a separator.
COMMANDS = (Crack, CylindricalCrack, Drill, Refine, None, GroupInspector, MeshQuality, Export)


def register():
    """Adds the commands to FreeCAD and returns their names, "Separator" between them."""
    names = []
    for command in COMMANDS:
        if command is None:
            names.append("Separator")
        else:
            FreeCADGui.addCommand(command.NAME, command())
            names.append(command.NAME)
    return names
