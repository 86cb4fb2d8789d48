# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document object: a FEM mesh with another one added to it."""

import dataclasses

import femscalpel

from . import contents, operator_options
from .base import MeshOperation
from .mesh_parts import nodes_in_box, without_skin_elements
from .whole import left_behind

KEEPS = ("mesh", "addition")


def as_added(addition, source):
    """What of a femscalpel.Mesh is added to a Fem.FemMesh; see Merge."""
    return without_skin_elements(addition) if source.VolumeCount and not source.FaceCount else addition


class Merge(MeshOperation):
    """Proxy of a Fem::FemMeshObjectPython that holds its Source's mesh and its Addition's, joined where they meet.

    The addition's placement is applied to its nodes. Of an addition to a solid mesh without face elements, those on its
    skin and edges are left out and their groups become groups of nodes: FreeCAD's solver writers would lose the face
    loads on a mesh that has some face elements only.
    """

    Type = "FemScalpel::Merge"
    TAKES_SKIN = False
    TELLS_PIECES = False

    INPUTS = (
        ("App::PropertyLink", "Addition", "FEM mesh object that is added; it is not changed"),
        (
            "App::PropertyEnumeration",
            "Keep",
            "Which of two solids that overlap stays as it is; the overlap is cut off the other",
            list(KEEPS),
            KEEPS[0],
        ),
        (
            "App::PropertyLength",
            "Tolerance",
            "What is nearer than this to the other's surface touches it; 0: automatic",
        ),
        (
            "App::PropertyString",
            "GroupPrefix",
            "Of groups of the addition whose name the source has for others; GroupName and _ when empty",
        ),
        ("App::PropertyBool", "JoinGroups", "Whether groups of one name and kind become one", True),
        *operator_options.inputs(
            "feature_angle",
            "refine",
            "group_name",
            GroupName=(
                "Prefix of the new groups: NAME_SEAM, the nodes both share, and NAME_ADDED, the elements",
                "ADD",
            ),
        ),
    )

    def tools(self, obj):
        return []

    def where_nodes_may_move(self, obj, mesh, tools):
        box = self.mesh_of(obj, "Addition").BoundBox
        return nodes_in_box(mesh, (box.XMin, box.YMin, box.ZMin), (box.XMax, box.YMax, box.ZMax), rings=3)

    def operate(self, obj, mesh, tools):
        if obj.Addition == obj.Source:
            raise ValueError("Addition and Source are the same mesh; choose another mesh to add")
        self.mesh_of(obj, "Addition")
        addition, is_whole = contents.read_mesh(obj.Addition)
        result = femscalpel.merge(
            mesh,
            as_added(addition, obj.Source.FemMesh),
            keep=obj.Keep,
            tolerance=obj.Tolerance.Value or None,
            prefix=obj.GroupPrefix,
            join_groups=obj.JoinGroups,
            **operator_options.values(obj, mesh, "feature_angle", "refine", "group_name"),
        )
        if not is_whole:
            warnings = [*result.report.warnings, *left_behind(obj.Addition)]
            result = dataclasses.replace(result, report=dataclasses.replace(result.report, warnings=warnings))
        return result

    def _node_groups(self, source, report):
        return ()  # operate() has seen to that
