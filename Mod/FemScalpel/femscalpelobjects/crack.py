# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a plane."""

import femscalpel

from .base import SURFACE_DEFAULTS, SURFACE_INPUTS, MeshOperation, surface_options
from .tool_properties import plane_of


class Crack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a plane."""

    Type = "FemScalpel::Crack"

    INPUTS = (
        ("App::PropertyPlacement", "PlanePlacement", "The crack's plane: XY plane of this placement, z is the positive side"),
        *SURFACE_INPUTS,
        ("App::PropertyString", "GroupName", "Prefix of the new groups: NAME_P and NAME_N are the lips"),
    )
    DEFAULTS = {**SURFACE_DEFAULTS, "GroupName": ("CRACK",)}

    def tools(self, obj):
        return [plane_of(obj.PlanePlacement)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], **surface_options(obj, mesh))
