# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh, cracked along faces that it has."""

import numpy as np

import femscalpel

from . import operator_options
from .base import MeshOperation


class FaceCrack(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh, cracked along the faces of a group."""

    Type = "FemScalpel::FaceCrack"
    TAKES_SKIN = False

    INPUTS = (
        ("App::PropertyString", "Group", "Mesh group of faces (of a shell: edges) inside the mesh, or of their nodes"),
        *operator_options.inputs(
            "group_name", GroupName=("Prefix of the new groups: NAME_P and NAME_N are the lips", "CRACK")
        ),
    )

    def tools(self, obj):
        return []

    def where_nodes_may_move(self, obj, mesh, tools):
        return np.zeros(mesh.node_count, bool)

    def operate(self, obj, mesh, tools):
        if not obj.Group:
            raise ValueError("Group is not set; choose the mesh group to crack along")
        values = operator_options.values(obj, mesh, "group_name")
        return femscalpel.crack(mesh, femscalpel.Faces(obj.Group), **values)
