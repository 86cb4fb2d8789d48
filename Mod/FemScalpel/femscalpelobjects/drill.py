# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh with a hole drilled into it."""

import femscalpel

from .base import SURFACE_DEFAULTS, SURFACE_INPUTS, MeshOperation, surface_options
from .cylindrical_crack import CYLINDER_INPUTS, cylinder


class Drill(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh with a hole in it."""

    Type = "FemScalpel::Drill"

    INPUTS = (
        *CYLINDER_INPUTS,
        ("App::PropertyBool", "Through", "Through the whole part; else a blind hole with a flat bottom"),
        ("App::PropertyDistance", "Depth", "Of a blind hole: where its bottom is, from the placement along its z axis"),
        *SURFACE_INPUTS,
        ("App::PropertyString", "GroupName", "Prefix of the new groups: NAME_WALL, and NAME_BOTTOM of a blind hole"),
    )
    DEFAULTS = {**SURFACE_DEFAULTS, "Radius": (1,), "Through": (True,), "GroupName": ("HOLE",)}

    def tools(self, obj):
        return [cylinder(obj)]

    def operate(self, obj, mesh, tools):
        return femscalpel.drill(mesh, tools, depth=None if obj.Through else obj.Depth.Value, **surface_options(obj))
