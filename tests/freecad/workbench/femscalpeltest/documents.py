# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of document objects share."""

import shutil
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


def geometry_link(mesh):
    """Name of the property of FreeCAD's mesh objects that is their geometry: Part up to 0.21, Shape from 1.0."""
    return "Shape" if "Shape" in mesh.PropertiesList else "Part"


def solver_of(doc):
    """CalculiX's solver object in FreeCAD's examples; from 1.0 on its name is spelt with another C."""
    return doc.getObject("CalculiXCcxTools") or doc.getObject("CalculiXccxTools")


def set_value(obj, prop, value, unit):
    """Sets a load; up to 0.21 it is a plain number in the solver's units, from 1.0 on a quantity."""
    setattr(obj, prop, f"{value} {unit}" if hasattr(getattr(obj, prop), "UserString") else value)


def need(program, name):
    """Skips the test that runs where a program is not installed."""
    if not shutil.which(program):
        raise unittest.SkipTest(f"{name} ({program}) is not installed")


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
