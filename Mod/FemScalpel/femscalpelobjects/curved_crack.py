# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a sphere, torus, cone or cylinder."""

import femscalpel

from .base import SURFACE_DEFAULTS, SURFACE_INPUTS, MeshOperation, surface_options
from .tool_properties import AXIS_DEFAULTS, AXIS_INPUTS, SHAPE_DEFAULTS, SHAPE_INPUTS, SHAPES, shape_of


class CurvedCrack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a curved tool."""

    Type = "FemScalpel::CurvedCrack"

    INPUTS = (
        *SHAPE_INPUTS,
        *AXIS_INPUTS,
        *SURFACE_INPUTS,
        ("App::PropertyString", "GroupName", "Prefix of the new groups: NAME_P and NAME_N are the lips, P outside"),
    )
    DEFAULTS = {
        **SHAPE_DEFAULTS,
        **AXIS_DEFAULTS,
        **SURFACE_DEFAULTS,
        "ToolShape": (list(SHAPES[1:]), "Sphere"),
        "GroupName": ("CRACK",),
    }

    def tools(self, obj):
        return [shape_of(obj)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], **surface_options(obj, mesh))
