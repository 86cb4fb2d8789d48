# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along a cylinder."""

import FreeCAD

import femscalpel

from .base import SURFACE_DEFAULTS, SURFACE_INPUTS, MeshOperation, surface_options

#: Input properties of operators with a cylinder.
CYLINDER_INPUTS = (
    ("App::PropertyPlacement", "AxisPlacement", "The cylinder's axis: z axis of this placement"),
    ("App::PropertyLength", "Radius", "Radius of the cylinder"),
)


def cylinder(obj):
    """The femscalpel.Cylinder the properties CYLINDER_INPUTS say."""
    placement = obj.AxisPlacement
    return femscalpel.Cylinder(placement.Base, placement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)), obj.Radius.Value)


class CylindricalCrack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along a cylinder."""

    Type = "FemScalpel::CylindricalCrack"

    INPUTS = (
        *CYLINDER_INPUTS,
        *SURFACE_INPUTS,
        ("App::PropertyString", "GroupName", "Prefix of the new groups: NAME_P (outside) and NAME_N (inside) are the lips"),
    )
    DEFAULTS = {**SURFACE_DEFAULTS, "Radius": (1,), "GroupName": ("CRACK",)}

    def tools(self, obj):
        return [cylinder(obj)]

    def operate(self, obj, mesh, tools):
        return femscalpel.crack(mesh, tools[0], **surface_options(obj))
