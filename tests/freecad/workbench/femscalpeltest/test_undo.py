# SPDX-License-Identifier: LGPL-2.1-or-later
"""Undo, redo and aborted transactions without a window, and what objects remember for them."""

import os
import unittest
import zlib
from contextlib import contextmanager
from unittest import mock

import Fem
import FreeCAD
import ObjectsFem

import femmesh_bridge
import ObjectsFemScalpel
from femscalpelobjects.base import MeshOperation
from femscalpelobjects.memory import Made, Memory, memory

from .documents import DocumentTest, groups_of
from .meshes import box_with_groups


def made_meshes():
    """Records which objects make a mesh."""
    return mock.patch.object(MeshOperation, "result", autospec=True, side_effect=MeshOperation.result)


def names(calls):
    return [call.args[1].Name for call in calls.call_args_list]


def content(obj):
    """Something short that says which mesh it is, and of which run: its report holds the time it took."""
    mesh = obj.FemMesh
    elements = [mesh.getElementNodes(e) for e in mesh.Volumes]
    nodes = [tuple(point) for point in mesh.Nodes.values()]
    return (
        zlib.crc32(repr((nodes, elements, groups_of(mesh))).encode()),
        obj.NodesMoved,
        zlib.crc32(repr(obj.GroupReport).encode()),
    )


class Chain(DocumentTest):
    """A crack, and a second one of it."""

    def setUp(self):
        super().setUp()
        self.doc.UndoMode = 1
        self.source = self.add_source(box_with_groups())
        self.crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(3.3, 2.5, 2), normal=(0.9, 0.3, 0.2))
        self.second = ObjectsFemScalpel.makeCrack(
            self.doc, self.crack, "Second", origin=(1.2, 2.5, 2), normal=(1, 0, 0), group_name="SECOND"
        )
        self.doc.recompute()
        self.doc.clearUndos()

    @contextmanager
    def step(self, name="Step"):
        self.doc.openTransaction(name)
        yield
        self.doc.recompute()
        self.doc.commitTransaction()

    def move(self, x, crack=None):
        crack = crack or self.crack
        crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(x, 0, 0), crack.PlanePlacement.Rotation)

    def both(self):
        return content(self.crack), content(self.second)

    def assertUpToDate(self):
        self.assertEqual([o.State for o in (self.crack, self.second)], [["Up-to-date"]] * 2)


class Undo(Chain):
    def test_chain(self):
        before = self.both()
        with self.step():
            self.move(3.7)
        after = self.both()
        with made_meshes() as made:
            for act, expected in ((self.doc.undo, before), (self.doc.redo, after)) * 2:
                act()
                self.assertEqual(self.both(), expected)
                self.assertUpToDate()
            self.doc.recompute()
        self.assertEqual(names(made), [])

    def test_failure(self):
        before = self.both()
        with self.step():
            self.move(50)
        status = self.crack.getStatusString()
        self.assertIn("misses the mesh", status)
        with made_meshes() as made:
            self.doc.undo()
            self.assertEqual(self.both(), before)
            self.assertUpToDate()
            self.doc.redo()
            self.assertEqual([o.FemMesh.NodeCount for o in (self.crack, self.second)], [0, 0])
            self.assertEqual(self.crack.getStatusString(), status)
            self.doc.undo()
            self.assertEqual(self.both(), before)
        self.assertEqual(names(made), [])

    def test_aborted(self):
        before = self.both()
        self.doc.openTransaction("Preview")
        self.move(3.7)
        self.doc.recompute()
        self.doc.abortTransaction()
        self.assertEqual(self.both(), before)
        self.assertUpToDate()

    def test_forgotten(self):
        before = self.both()
        with self.step():
            self.move(3.7)
        memory.forget(self.doc)
        self.doc.undo()
        self.assertIn("Touched", self.crack.State)
        self.assertIn("Touched", self.second.State)
        self.doc.recompute()
        self.assertEqual([c[:2] for c in self.both()], [c[:2] for c in before])  # the report has other times
        self.assertEqual(self.doc.RedoCount, 1)

    def test_renamed_group_of_the_source(self):
        before = self.both()
        with self.step():
            ObjectsFemScalpel.renameGroup(self.source, "LEFT", "PORT")
        after = self.both()
        self.assertNotEqual(after[1][0], before[1][0])
        with made_meshes() as made:
            self.doc.undo()
            self.assertEqual(self.both(), before)
            self.doc.redo()
            self.assertEqual(self.both(), after)
        self.assertEqual(names(made), [])

    def test_geometry(self):
        """A face that is the tool changes, and changes back."""
        face = self.doc.addObject("Part::Plane", "Tool")
        face.Length = face.Width = 10
        face.Placement = FreeCAD.Placement(FreeCAD.Vector(-1, -1, 2.2), FreeCAD.Rotation())
        self.doc.recompute()
        curved = ObjectsFemScalpel.makeCurvedCrack(
            self.doc, self.source, "Face", tool="Face", face=face, group_name="FACE"
        )
        self.doc.recompute()
        self.doc.clearUndos()
        before = content(curved)
        with self.step():
            face.Placement.Base.z = 2.4
        after = content(curved)
        self.assertNotEqual(after, before)
        with made_meshes() as made:
            self.doc.undo()
            self.assertEqual(content(curved), before)
            self.doc.redo()
            self.assertEqual(content(curved), after)
        self.assertEqual(names(made), [])

    def test_loaded(self):
        path = os.path.join(self.folder.name, "saved.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.doc.UndoMode = 1
        self.source, self.crack, self.second = self.doc.Source, self.doc.Crack, self.doc.Second
        before = self.both()
        with self.step():
            self.move(3.7)
        after = self.both()
        with made_meshes() as made:
            self.doc.undo()
            self.assertEqual(self.both(), before)
            self.assertUpToDate()
            self.doc.redo()
            self.assertEqual(self.both(), after)
        self.assertEqual(names(made), [])

    def test_deleted_and_brought_back(self):
        analysis = ObjectsFem.makeAnalysis(self.doc)
        analysis.addObject(self.source)
        ObjectsFemScalpel.putIntoAnalysis(self.second)
        before = self.both()
        with self.step():
            self.doc.removeObject("Second")
        with made_meshes() as made:
            self.doc.undo()
            self.second = self.doc.Second
            self.assertEqual(self.both(), before)
            self.assertEqual(analysis.Group, [self.second])
        self.assertEqual(names(made), [])


class Recompute(Chain):
    """What a recompute takes from memory."""

    def test_of_the_same(self):
        before = self.both()
        self.crack.touch()
        with made_meshes() as made:
            self.doc.recompute()
            self.move(3.7)
            self.doc.recompute()
            self.crack.PlanePlacement.Base = FreeCAD.Vector(3.3, 2.5, 2)
            self.doc.recompute()
        self.assertEqual(names(made), ["Crack", "Second"])
        self.assertEqual(self.both(), before)

    def test_a_mesh_that_was_replaced(self):
        before = content(self.crack)
        self.crack.FemMesh = Fem.FemMesh()
        self.crack.touch()
        self.doc.recompute()
        self.assertEqual(content(self.crack), before)

    def test_a_source_that_was_replaced(self):
        """By a mesh of as many nodes and elements."""
        before = content(self.crack)
        mesh = box_with_groups()
        points = mesh.points.copy()
        points[mesh.node_count // 2] += 0.05
        self.source.FemMesh = femmesh_bridge.to_femmesh(mesh, points=points)
        with made_meshes() as made:
            self.doc.recompute()
        self.assertEqual(names(made), ["Crack", "Second"])
        self.assertNotEqual(content(self.crack), before)

    def test_faces_that_an_analysis_refers_to(self):
        """They count, but do not touch the object."""
        analysis = ObjectsFem.makeAnalysis(self.doc)
        analysis.addObject(self.source)
        box = self.doc.addObject("Part::Box", "Box")
        box.Length, box.Width, box.Height = 6, 5, 4
        load = ObjectsFem.makeConstraintForce(self.doc)
        load.References = [(box, "Face1")]
        self.doc.recompute()
        analysis.addObject(load)
        with made_meshes() as made:
            self.crack.touch()
            self.doc.recompute()
        self.assertIn("Crack", names(made))

    def test_name_that_a_constraint_takes(self):
        load = ObjectsFem.makeConstraintForce(self.doc, "CRACK")
        self.assertEqual(load.Name, "CRACK")
        self.crack.touch()
        self.doc.recompute()
        self.assertIn("Invalid", self.crack.State)
        self.assertIn("choose another GroupName", self.crack.getStatusString())


class Remembered(unittest.TestCase):
    class Document:
        Name = "Test"

    @staticmethod
    def made(name, nodes):
        mesh = Fem.FemMesh()
        for k in range(nodes - 1):  # and one for itself
            mesh.addNode(k, 0, 0, k + 1)
        return Made(name, None, name, mesh)

    def test_bounded(self):
        kept = Memory(limit=100)
        for name, nodes in ((b"a", 40), (b"b", 40)):
            kept.keep(self.Document, self.made(name, nodes))
        self.assertIsNotNone(kept.of(self.Document, b"a"))  # now b is the eldest
        kept.keep(self.Document, self.made(b"c", 40))
        self.assertIsNone(kept.of(self.Document, b"b"))
        self.assertIsNotNone(kept.of(self.Document, b"a"))
        kept.keep(self.Document, self.made(b"a", 50))
        self.assertEqual(len(kept), 2)
        kept.keep(self.Document, self.made(b"large", 500))
        self.assertEqual(len(kept), 1)
        self.assertIsNotNone(kept.of(self.Document, b"large"))

    def test_forgotten_with_its_document(self):
        document = FreeCAD.newDocument("FemScalpelForgotten")
        before = len(memory)
        memory.keep(document, self.made(b"a", 10))
        self.assertEqual(len(memory), before + 1)
        FreeCAD.closeDocument(document.Name)
        self.assertEqual(len(memory), before)
