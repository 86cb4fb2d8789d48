# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a cylinder."""

import femscalpel

from .base import SURFACE_DEFAULTS, SURFACE_INPUTS, MeshOperation, surface_options
from .tool_properties import AXIS_DEFAULTS, AXIS_INPUTS, direction_of


class CylindricalCrack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a cylinder."""

    Type = "FemScalpel::CylindricalCrack"

    INPUTS = (
        *AXIS_INPUTS,
        *SURFACE_INPUTS,
        ("App::PropertyString", "GroupName", "Prefix of the new groups: NAME_P and NAME_N are the lips, P outside"),
    )
    DEFAULTS = {**AXIS_DEFAULTS, **SURFACE_DEFAULTS, "GroupName": ("CRACK",)}

    def tools(self, obj):
        return [femscalpel.Cylinder(obj.AxisPlacement.Base, direction_of(obj.AxisPlacement), obj.Radius.Value)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], **surface_options(obj, mesh))
