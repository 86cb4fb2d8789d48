# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh with rounded edges."""

import numpy as np

import femscalpel

from . import operator_options
from .base import MeshOperation


class Fillet(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh with edges rounded by a ball."""

    Type = "FemScalpel::Fillet"

    INPUTS = (
        ("App::PropertyString", "Along", "Mesh group of segments or nodes that is the edge; empty: see AlongPoints"),
        (
            "App::PropertyVectorList",
            "AlongPoints",
            "Points near edges of the mesh; each edge is rounded as far as it goes on without a corner",
        ),
        ("App::PropertyLength", "Radius", "Of the ball that rolls along the edge", 1),
        *operator_options.inputs(GroupName=("Prefix of the new group NAME_FACE, the faces of the rounding", "FILLET")),
    )

    def tools(self, obj):
        return []

    def where_nodes_may_move(self, obj, mesh, tools):
        # How far the edge goes on is for the operator to find.
        return np.ones(mesh.node_count, bool)

    def operate(self, obj, mesh, tools):
        if not obj.Along and not obj.AlongPoints:
            raise ValueError("neither Along nor AlongPoints says which edge is rounded; give one")
        if obj.Along and obj.AlongPoints:
            raise ValueError("Along and AlongPoints both say which edge is rounded; give one of them")
        along = obj.Along or [tuple(point) for point in obj.AlongPoints]
        return femscalpel.fillet(mesh, along, obj.Radius.Value, **operator_options.keywords(obj, mesh))
