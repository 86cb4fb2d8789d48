# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh with a wall moved."""

import numpy as np

import femscalpel

from . import operator_options
from .base import MeshOperation
from .following import FOLLOW_INPUTS
from .tool_properties import AXIS_INPUTS, shape_inputs, shape_of

MOTIONS = ("Onto", "By", "Scale")


class Reshape(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh with a wall moved.

    The wall's nodes are meant to leave the geometry Source was made from, so they are not put back onto it; OffShape
    says which faces they have left.
    """

    Type = "FemScalpel::Reshape"
    TAKES_SKIN = False
    MOVES_WALLS = True

    INPUTS = (
        ("App::PropertyString", "Group", "Mesh group of the faces (of a shell: edges) or nodes that are moved"),
        (
            "App::PropertyEnumeration",
            "Motion",
            "Onto: to the surface that ToolShape and AxisPlacement say; By: by MoveBy; Scale: by ScaleFactor about "
            "ScaleCentre",
            list(MOTIONS),
            MOTIONS[0],
        ),
        *AXIS_INPUTS,
        *FOLLOW_INPUTS,
        *shape_inputs("Cylinder"),
        ("App::PropertyVector", "MoveBy", "The vector to move it by"),
        ("App::PropertyFloat", "ScaleFactor", "What distances from ScaleCentre are multiplied by", 1),
        ("App::PropertyVector", "ScaleCentre", "The point that stays where it is"),
        *operator_options.inputs(
            "feature_angle",
            "preserve",
            "group_name",
            GroupName=("Prefix of the new group NAME_WALL, the nodes that were moved", "SHAPE"),
        ),
    )

    def tools(self, obj):
        return [shape_of(obj)] if obj.Motion == "Onto" else []

    def where_nodes_may_move(self, obj, mesh, tools):
        # How wide the band is, is for the operator to find.
        return np.ones(mesh.node_count, bool)

    def operate(self, obj, mesh, tools):
        if not obj.Group:
            raise ValueError("Group is not set; choose the mesh group to move")
        motion = {
            "Onto": lambda: {"onto": tools[0]},
            "By": lambda: {"by": tuple(obj.MoveBy)},
            "Scale": lambda: {"scale": (obj.ScaleFactor, tuple(obj.ScaleCentre))},
        }[obj.Motion]()
        values = operator_options.values(obj, mesh, "feature_angle", "preserve", "group_name")
        return femscalpel.reshape(mesh, obj.Group, **motion, **values)

    def meant_to_leave(self, report):
        return report.node_sets["WALL"]
