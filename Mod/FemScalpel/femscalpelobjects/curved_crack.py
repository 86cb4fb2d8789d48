# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a sphere, torus, cone or cylinder."""

from .cylindrical_crack import CylindricalCrack
from .tool_properties import SHAPE_DEFAULTS, SHAPE_INPUTS, SHAPES, shape_of


class CurvedCrack(CylindricalCrack):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a curved tool."""

    Type = "FemScalpel::CurvedCrack"

    INPUTS = (*SHAPE_INPUTS, *CylindricalCrack.INPUTS)
    DEFAULTS = {**SHAPE_DEFAULTS, **CylindricalCrack.DEFAULTS, "ToolShape": (list(SHAPES[1:]), "Sphere")}

    def tools(self, obj):
        return [shape_of(obj)]
