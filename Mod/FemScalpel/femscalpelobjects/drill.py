# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh with one or several holes drilled into it."""

import femscalpel

from . import operator_options
from .base import MeshOperation
from .following import FOLLOW_INPUTS
from .tool_properties import AXIS_INPUTS, direction_of


class Drill(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh with parallel holes of one radius."""

    Type = "FemScalpel::Drill"

    INPUTS = (
        *AXIS_INPUTS,
        *FOLLOW_INPUTS,
        (
            "App::PropertyVectorList",
            "Positions",
            "Where the holes are, in the placement's own axes; empty: one, at its origin",
        ),
        ("App::PropertyBool", "Through", "Whether the holes go through; otherwise they end flat", True),
        ("App::PropertyLength", "Depth", "How far blind holes go beyond the placement's origin, along its z"),
        *operator_options.inputs(
            GroupName=(
                "Prefix of the new groups: NAME_WALL, NAME_BOTTOM, and with several holes NAME_WALL1, ...",
                "HOLE",
            )
        ),
    )

    def tools(self, obj):
        placement = obj.AxisPlacement
        axis = direction_of(placement)
        centers = [placement.multVec(position) for position in obj.Positions] or [placement.Base]
        holes = [femscalpel.Cylinder(center, axis, obj.Radius.Value) for center in centers]
        return holes if obj.Through else holes + [femscalpel.Plane(placement.Base + axis * obj.Depth.Value, axis)]

    def operate(self, obj, mesh, tools):
        if obj.Through:
            return femscalpel.drill(mesh, tools, **operator_options.keywords(obj, mesh))
        return femscalpel.drill(mesh, tools[:-1], depth=obj.Depth.Value, **operator_options.keywords(obj, mesh))
