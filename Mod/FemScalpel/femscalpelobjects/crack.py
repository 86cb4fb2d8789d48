# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a plane or a part of it."""

import femscalpel

from . import operator_options
from .base import MeshOperation
from .following import FOLLOW_INPUTS
from .patch_properties import PATCH_INPUTS, fronts_of, patch_of
from .tool_properties import plane_of


class Crack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a plane or a part of it."""

    Type = "FemScalpel::Crack"

    INPUTS = (
        (
            "App::PropertyPlacement",
            "PlanePlacement",
            "The crack's plane: XY plane of this placement, z is the positive side",
        ),
        *FOLLOW_INPUTS,
        *PATCH_INPUTS,
        *operator_options.inputs(
            GroupName=("Prefix of the new groups: NAME_P and NAME_N are the lips, NAME_FRONT the front", "CRACK")
        ),
    )

    def tools(self, obj):
        return [plane_of(obj.PlanePlacement), *fronts_of(obj)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], within=patch_of(obj), **operator_options.keywords(obj, mesh))
