# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, refined around a tool."""

import femscalpel

from . import operator_options
from .base import MeshOperation
from .following import FOLLOW_INPUTS
from .mesh_parts import nodes_of_long_edges
from .tool_properties import AXIS_INPUTS, shape_inputs, shape_of


class Refine(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh with shorter edges around a tool."""

    Type = "FemScalpel::Refine"

    INPUTS = (
        *AXIS_INPUTS,
        *FOLLOW_INPUTS,
        *shape_inputs("Cylinder"),
        ("App::PropertyLength", "Size", "Longest edge wanted at the tool", 1),
        ("App::PropertyLength", "Reach", "Size holds up to this distance from the tool"),
        ("App::PropertyFloat", "Gradation", "How much longer edges may be per unit of distance beyond that", 0.5),
        *operator_options.inputs("feature_angle"),
    )

    def tools(self, obj):
        return [shape_of(obj)]

    def where_nodes_may_move(self, obj, mesh, tools):
        return nodes_of_long_edges(mesh, tools, obj.Size.Value, obj.Gradation, obj.Reach.Value, rings=4)

    def operate(self, obj, mesh, tools):
        return femscalpel.refine(
            mesh,
            tools,
            obj.Size.Value,
            gradation=obj.Gradation,
            reach=obj.Reach.Value,
            **operator_options.keywords(obj, mesh, "feature_angle"),
        )
