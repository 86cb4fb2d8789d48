# SPDX-License-Identifier: LGPL-2.1-or-later
"""Everything of a mesh object, to compare exactly; also used without a window."""


def content_of(obj):
    """Nodes, elements and groups, as JSON can hold them."""
    mesh = obj.FemMesh
    nodes = {str(n): tuple(p) for n, p in mesh.Nodes.items()}
    elements = {str(e): mesh.getElementNodes(e) for e in (*mesh.Edges, *mesh.Faces, *mesh.Volumes)}
    groups = sorted(
        (mesh.getGroupName(g), mesh.getGroupElementType(g), sorted(mesh.getGroupElements(g))) for g in mesh.Groups
    )
    return [nodes, elements, groups]
