# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a cylinder or a part of it."""

import femscalpel

from .base import SURFACE_DEFAULTS, SURFACE_INPUTS, MeshOperation, surface_options
from .patch_properties import CYLINDER_PART_DEFAULTS, CYLINDER_PART_INPUTS, cylinder_part_of, part_fronts_of
from .tool_properties import AXIS_DEFAULTS, AXIS_INPUTS, direction_of


class CylindricalCrack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a cylinder or a part of it."""

    Type = "FemScalpel::CylindricalCrack"

    INPUTS = (
        *AXIS_INPUTS,
        *CYLINDER_PART_INPUTS,
        *SURFACE_INPUTS,
        (
            "App::PropertyString",
            "GroupName",
            "Prefix of the new groups: NAME_P and NAME_N are the lips, P outside, NAME_FRONT the front",
        ),
    )
    DEFAULTS = {**AXIS_DEFAULTS, **CYLINDER_PART_DEFAULTS, **SURFACE_DEFAULTS, "GroupName": ("CRACK",)}

    def tools(self, obj):
        cylinder = femscalpel.Cylinder(obj.AxisPlacement.Base, direction_of(obj.AxisPlacement), obj.Radius.Value)
        return [cylinder, *part_fronts_of(obj)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], within=cylinder_part_of(obj), **surface_options(obj, mesh))
