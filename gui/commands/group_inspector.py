# SPDX-License-Identifier: LGPL-2.1-or-later
"""Command: group inspector."""

from ..panels.group_inspector import GroupInspectorPanel
from ..translate import QT_TRANSLATE_NOOP
from .base import Command


class GroupInspector(Command):
    NAME = "FemScalpel_GroupInspector"
    MENU = QT_TRANSLATE_NOOP("FemScalpel_GroupInspector", "Group inspector")
    TOOLTIP = QT_TRANSLATE_NOOP(
        "FemScalpel_GroupInspector", "Shows the groups of a FEM mesh, what they cover and what uses them"
    )
    WHATS_THIS = QT_TRANSLATE_NOOP(
        "FemScalpel_GroupInspector",
        "Lists the groups of the FEM mesh with kind, size, measure and what uses them. Tick groups to see them, "
        "double-click a name to rename the group and a colour to change it. Elementary groups are the "
        "entities "
        "that are in exactly the same groups; bounding, linking and isolated entities are what an "
        "operation must "
        "keep in shape.",
    )
    ACCEL = "X, G"
    PANEL = GroupInspectorPanel
