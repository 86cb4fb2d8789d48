# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of document objects share."""

import tempfile
import unittest

import FreeCAD

import femmesh_bridge


def groups_of(femmesh):
    return [
        (femmesh.getGroupName(g), femmesh.getGroupElementType(g), tuple(femmesh.getGroupElements(g)))
        for g in femmesh.Groups
    ]


def content(mesh):
    """Everything of a mesh, by number."""
    nodes = dict(zip(mesh.node_ids.tolist(), map(tuple, mesh.points.tolist())))
    elements = {
        i: (name, tuple(row))
        for name, ids in mesh.cell_ids.items()
        for i, row in zip(ids.tolist(), mesh.node_ids[mesh.cells[name]].tolist())
    }
    groups = {
        (g.name, g.kind): frozenset(map(tuple, g.ids.tolist()) if g.kind == "facet" else g.ids.tolist())
        for g in mesh.groups.all()
    }
    return nodes, elements, groups


class DocumentTest(unittest.TestCase):
    def setUp(self):
        self.doc = FreeCAD.newDocument("FemScalpelTest")
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        FreeCAD.closeDocument(self.doc.Name)
        self.folder.cleanup()

    def add_source(self, mesh):
        source = self.doc.addObject("Fem::FemMeshObject", "Source")
        source.FemMesh = femmesh_bridge.to_femmesh(mesh)
        return source
