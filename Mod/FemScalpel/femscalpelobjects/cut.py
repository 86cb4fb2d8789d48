# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh with a slot cut into it."""

import femscalpel

from . import operator_options
from .base import MeshOperation
from .following import FOLLOW_INPUTS
from .tool_properties import direction_of, plane_of


class Cut(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh with an incision between two parallel planes."""

    Type = "FemScalpel::Cut"

    INPUTS = (
        ("App::PropertyPlacement", "PlanePlacement", "The middle of the slot: XY plane of this placement"),
        *FOLLOW_INPUTS,
        ("App::PropertyLength", "Width", "Of the slot", 1),
        (
            "App::PropertyBool",
            "Through",
            "Whether the slot goes through the whole part; otherwise it ends at a bottom",
            True,
        ),
        (
            "App::PropertyPlacement",
            "BottomPlacement",
            "The bottom: XY plane of this placement, z points into the material that stays",
        ),
        *operator_options.inputs(
            Method=(["snap"], "snap"),
            GroupName=("Prefix of the new groups: NAME_P and NAME_N are the walls, NAME_BOTTOM the bottom", "CUT"),
        ),
    )

    def tools(self, obj):
        middle, normal = obj.PlanePlacement.Base, direction_of(obj.PlanePlacement)
        half = obj.Width.Value / 2
        walls = [femscalpel.Plane(middle + normal * half, normal), femscalpel.Plane(middle - normal * half, normal)]
        return walls if obj.Through else walls + [plane_of(obj.BottomPlacement)]

    def operate(self, obj, mesh, tools):
        bottom = None if obj.Through else tools[2]
        return femscalpel.cut(
            mesh,
            plane_of(obj.PlanePlacement),
            width=obj.Width.Value,
            bottom=bottom,
            **operator_options.keywords(obj, mesh),
        )
