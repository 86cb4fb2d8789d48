# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands, one file each."""

import FreeCADGui

from .crack import Crack
from .curved_crack import CurvedCrack
from .cylindrical_crack import CylindricalCrack
from .drill import Drill
from .example import Example
from .export import Export
from .face_crack import FaceCrack
from .fillet import Fillet
from .group_inspector import GroupInspector
from .import_mesh import ImportMesh
from .incision import Incision
from .merge import Merge
from .mesh_quality import MeshQuality
from .refine import Refine
from .reshape import Reshape

#: In the order of menu and toolbar; None is a separator.
COMMANDS = (
    Crack,
    FaceCrack,
    CylindricalCrack,
    CurvedCrack,
    Drill,
    Incision,
    Merge,
    Fillet,
    Reshape,
    Refine,
    None,
    GroupInspector,
    MeshQuality,
    ImportMesh,
    Export,
)
#: In the menu alone, after the others.
IN_MENU = (None, Example)


def register():
    """Adds the commands to FreeCAD; returns the names for the toolbar and for the menu, "Separator" between them."""
    for command in filter(None, COMMANDS + IN_MENU):
        FreeCADGui.addCommand(command.NAME, command())
    return [
        ["Separator" if command is None else command.NAME for command in part]
        for part in (COMMANDS, COMMANDS + IN_MENU)
    ]
