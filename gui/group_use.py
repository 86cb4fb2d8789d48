# SPDX-License-Identifier: LGPL-2.1-or-later
"""What in a document uses the groups of a mesh."""

# FreeCAD's solver writers take a mesh's group for an object of the analysis when it is called like the object with one
# of these.
_SUFFIXES = ("_Nodes", "_Edges", "_Faces", "_Volumes")


def users_of_groups(mesh_object):
    """{group name: labels of the constraints, materials and sections that FreeCAD's solver writers look it up for}."""
    users = {}
    for analysis in mesh_object.Document.findObjects("Fem::FemAnalysis"):
        if mesh_object not in analysis.Group:
            continue
        for member in analysis.Group:
            if member != mesh_object:
                for suffix in _SUFFIXES:
                    users.setdefault(member.Name + suffix, []).append(member.Label)
    for obj in mesh_object.Document.Objects:
        # A mesh group of FreeCAD's own, from which the mesher makes the group.
        if getattr(getattr(obj, "Proxy", None), "Type", "") == "Fem::MeshGroup":
            users.setdefault(obj.Label if getattr(obj, "UseLabel", False) else obj.Name, []).append(obj.Label)
    return users
