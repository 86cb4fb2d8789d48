# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a cylinder or a part of it."""

import femscalpel

from . import operator_options
from .base import MeshOperation
from .following import FOLLOW_INPUTS
from .patch_properties import CYLINDER_PART_INPUTS, cylinder_part_of, part_fronts_of
from .tool_properties import AXIS_INPUTS, direction_of


class CylindricalCrack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a cylinder or a part of it."""

    Type = "FemScalpel::CylindricalCrack"

    INPUTS = (
        *AXIS_INPUTS,
        *FOLLOW_INPUTS,
        *CYLINDER_PART_INPUTS,
        *operator_options.inputs(
            GroupName=(
                "Prefix of the new groups: NAME_P and NAME_N are the lips, P outside, NAME_FRONT the front",
                "CRACK",
            )
        ),
    )

    def tools(self, obj):
        cylinder = femscalpel.Cylinder(obj.AxisPlacement.Base, direction_of(obj.AxisPlacement), obj.Radius.Value)
        return [cylinder, *part_fronts_of(obj)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], within=cylinder_part_of(obj), **operator_options.keywords(obj, mesh))
