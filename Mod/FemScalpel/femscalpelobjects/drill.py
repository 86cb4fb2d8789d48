# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh with one or several holes drilled into it."""

import femscalpel

from .base import SURFACE_DEFAULTS, SURFACE_INPUTS, MeshOperation, surface_options
from .tool_properties import AXIS_DEFAULTS, AXIS_INPUTS, direction_of


class Drill(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh with parallel holes of one radius."""

    Type = "FemScalpel::Drill"

    INPUTS = (
        *AXIS_INPUTS,
        (
            "App::PropertyVectorList",
            "Positions",
            "Where the holes are, in the placement's own axes; empty: one, at its origin",
        ),
        ("App::PropertyBool", "Through", "Whether the holes go through; otherwise they end flat"),
        ("App::PropertyLength", "Depth", "How far blind holes go beyond the placement's origin, along its z"),
        *SURFACE_INPUTS,
        (
            "App::PropertyString",
            "GroupName",
            "Prefix of the new groups: NAME_WALL, NAME_BOTTOM, and with several holes NAME_WALL1, ...",
        ),
    )
    DEFAULTS = {**AXIS_DEFAULTS, **SURFACE_DEFAULTS, "Through": (True,), "GroupName": ("HOLE",)}

    def tools(self, obj):
        placement = obj.AxisPlacement
        axis = direction_of(placement)
        centers = [placement.multVec(position) for position in obj.Positions] or [placement.Base]
        holes = [femscalpel.Cylinder(center, axis, obj.Radius.Value) for center in centers]
        return holes if obj.Through else holes + [femscalpel.Plane(placement.Base + axis * obj.Depth.Value, axis)]

    def operate(self, obj, mesh, tools):
        if obj.Through:
            return femscalpel.drill(mesh, tools, **surface_options(obj, mesh))
        return femscalpel.drill(mesh, tools[:-1], depth=obj.Depth.Value, **surface_options(obj, mesh))
