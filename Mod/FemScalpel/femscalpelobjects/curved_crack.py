# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a sphere, torus, cone or cylinder."""

import femscalpel

from . import operator_options
from .base import MeshOperation
from .following import FOLLOW_INPUTS
from .tool_properties import AXIS_INPUTS, shape_inputs, shape_of


class CurvedCrack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a curved tool."""

    Type = "FemScalpel::CurvedCrack"

    INPUTS = (
        *shape_inputs("Sphere", without=("Plane",)),
        *AXIS_INPUTS,
        *FOLLOW_INPUTS,
        *operator_options.inputs(
            GroupName=("Prefix of the new groups: NAME_P and NAME_N are the lips, P outside", "CRACK")
        ),
    )

    def tools(self, obj):
        return [shape_of(obj)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], **operator_options.keywords(obj, mesh))
