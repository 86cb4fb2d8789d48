# SPDX-License-Identifier: LGPL-2.1-or-later
"""Planes and axes that follow picked geometry."""

import os
from unittest import mock

import FreeCAD
import Part

import ObjectsFemScalpel

from .documents import DocumentTest
from .meshes import box_with_groups
from .test_undo import made_meshes, names

V = FreeCAD.Vector


class Following(DocumentTest):
    """A crack whose plane is the face x = 3.3 of a box, and another one of it; the mesh is 5 x 5 x 4 or so."""

    def setUp(self):
        super().setUp()
        self.doc.UndoMode = 1
        self.source = self.add_source(box_with_groups())
        self.part = self.doc.addObject("Part::Box", "Box")
        self.part.Length, self.part.Width, self.part.Height = 3.3, 2, 2
        self.doc.recompute()
        self.crack = ObjectsFemScalpel.makeCrack(self.doc, self.source, origin=(3.3, 1, 1), normal=(1, 0, 0))
        self.second = ObjectsFemScalpel.makeCrack(
            self.doc, self.crack, "Second", origin=(1.2, 2.5, 2), normal=(1, 0, 0), group_name="SECOND"
        )
        ObjectsFemScalpel.followGeometry(self.crack, [(self.part, "Face2")])
        self.doc.recompute()
        self.doc.clearUndos()

    def plane(self, crack=None):
        placement = (crack or self.crack).PlanePlacement
        return tuple(round(x, 9) for x in (*placement.Base, *placement.Rotation.multVec(V(0, 0, 1))))

    def change(self, **values):
        self.doc.openTransaction("Change")
        for name, value in values.items():
            setattr(self.part, name, value)
        self.doc.recompute()
        self.doc.commitTransaction()

    def assertSame(self, one, other):
        for point in (V(), V(1, 0, 0), V(0, 0, 1)):
            self.assertLess(one.multVec(point).distanceToPoint(other.multVec(point)), 1e-9)

    def lips(self, obj=None):
        """x of the nodes of the upper lip."""
        mesh = (obj or self.crack).FemMesh
        group = next(g for g in mesh.Groups if mesh.getGroupName(g) == "CRACK_P")
        ids = mesh.getGroupElements(group)
        if mesh.getGroupElementType(group) == "Face":
            ids = {n for e in ids for n in mesh.getElementNodes(e)}
        return {round(mesh.getNodeById(n).x, 6) for n in ids}

    def test_follows_and_undo(self):
        self.assertEqual(self.lips(), {3.3})
        with made_meshes() as calls:
            self.change(Length=3.7)
        self.assertEqual(names(calls), ["Crack", "Second"])
        self.assertEqual(self.plane(), (3.7, 1, 1, 1, 0, 0))
        self.assertEqual(self.lips(), {3.7})
        with made_meshes() as calls:
            self.doc.undo()
            self.assertEqual((self.plane()[0], self.lips()), (3.3, {3.3}))
            self.doc.redo()
            self.assertEqual((self.plane()[0], self.lips()), (3.7, {3.7}))
            self.doc.recompute()
        self.assertEqual(names(calls), [])

    def test_same_tool_computes_nothing(self):
        with made_meshes() as calls:
            self.change(Placement=FreeCAD.Placement(V(1, 0, 0), FreeCAD.Rotation()), Length=2.3)
        self.assertEqual(names(calls), [])
        self.assertEqual(self.plane(), (3.3, 1, 1, 1, 0, 0))
        self.assertEqual([o.State for o in (self.crack, self.second)], [["Up-to-date"]] * 2)

    def test_save_and_reopen(self):
        path = os.path.join(self.folder.name, "following.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.crack, self.part = self.doc.Crack, self.doc.Box
        self.assertEqual((self.crack.Follow, self.crack.FollowedName), ("Geometry", "Box.Face2"))
        self.assertIn("ReadOnly", self.crack.getEditorMode("PlanePlacement"))
        self.change(Length=3.7)
        self.assertEqual((self.plane()[0], self.lips()), (3.7, {3.7}))

    def test_older_documents(self):
        for name in ("Follow", "FollowedGeometry", "FollowOffset", "SizeFollows", "FollowedName", "FollowedTopology"):
            self.crack.removeProperty(name)
        path = os.path.join(self.folder.name, "older.FCStd")
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        self.doc = FreeCAD.openDocument(path)
        self.crack, self.part = self.doc.Crack, self.doc.Box
        self.assertEqual((self.crack.Follow, self.plane()), ("Numbers", (3.3, 1, 1, 1, 0, 0)))
        self.change(Length=3.7)
        self.assertEqual((self.plane()[0], self.lips()), (3.3, {3.3}))

    def assertBroken(self, *words):
        self.assertIn("Invalid", self.crack.State)
        self.assertEqual(self.crack.FemMesh.NodeCount, 0)
        self.assertEqual(self.plane()[0], 3.3)
        status = self.crack.getStatusString()
        for word in words:
            self.assertIn(word, status)

    def test_deleted(self):
        self.doc.openTransaction("Delete")
        self.doc.removeObject("Box")
        self.doc.recompute()
        self.doc.commitTransaction()
        self.assertBroken("Box.Face2", "not there any more", "Numbers")
        with made_meshes() as calls:
            self.doc.undo()
            self.doc.recompute()
        self.assertEqual((names(calls), self.lips(), self.crack.State), ([], {3.3}, ["Up-to-date"]))
        self.doc.redo()
        self.doc.recompute()
        self.assertBroken("not there any more")
        self.crack.Follow = "Numbers"
        self.doc.recompute()
        self.assertEqual((self.lips(), self.crack.State), ({3.3}, ["Up-to-date"]))

    def test_renumbered(self):
        feature = self.doc.addObject("Part::Feature", "Feature")
        feature.Shape = Part.makeBox(3.3, 2, 2)
        ObjectsFemScalpel.followGeometry(self.crack, [(feature, "Face2")])
        self.doc.recompute()
        # The face is where it was: its name means it still.
        feature.Shape = Part.makeBox(3.3, 2, 2).cut(Part.makeBox(0.5, 0.5, 0.5)).removeSplitter()
        moved = next(
            f"Face{i}" for i, face in enumerate(feature.Shape.Faces, 1) if abs(face.CenterOfMass.x - 3.3) < 1e-9
        )
        self.doc.recompute()
        if moved == "Face2":
            self.assertEqual(self.crack.State, ["Up-to-date"])
        # Other faces, and what the name means is elsewhere.
        feature.Shape = Part.makeCylinder(1, 2).fuse(Part.makeBox(3.4, 2, 2))
        self.doc.recompute()
        self.assertBroken("Feature.Face2")
        self.assertEqual(self.second.FemMesh.NodeCount, 0)

    def test_element_is_gone(self):
        ObjectsFemScalpel.followGeometry(self.crack, [(self.part, "Edge1")])
        feature = self.doc.addObject("Part::Feature", "Feature")
        feature.Shape = Part.makeBox(3.3, 2, 2)
        ObjectsFemScalpel.followGeometry(self.crack, [(feature, "Face6")], FreeCAD.Placement())
        ObjectsFemScalpel.followGeometry(self.crack, None)
        self.crack.PlanePlacement = FreeCAD.Placement(V(3.3, 1, 1), FreeCAD.Rotation(V(0, 0, 1), V(1, 0, 0)))
        ObjectsFemScalpel.followGeometry(self.crack, [(feature, "Face6")])
        feature.Shape = Part.makeCylinder(1, 2)
        self.doc.recompute()
        self.assertBroken("Feature.Face6", "has no Face6", "pick it again")

    def test_setting_numbers_unlinks(self):
        with mock.patch.object(FreeCAD, "Console") as console:
            self.crack.PlanePlacement = FreeCAD.Placement(V(3.0, 1, 1), self.crack.PlanePlacement.Rotation)
        self.assertIn("does not follow Box.Face2 any more", console.PrintWarning.call_args.args[0])
        self.assertEqual((self.crack.Follow, self.crack.FollowedGeometry), ("Numbers", []))
        self.change(Length=3.7)
        self.assertEqual(self.plane()[0], 3.0)

    def test_expression_and_link(self):
        # An expression is to set it by hand.
        self.crack.setExpression("PlanePlacement.Base.x", "3.1")
        self.doc.recompute()
        self.assertEqual((self.crack.Follow, self.crack.State, self.lips()), ("Numbers", ["Up-to-date"], {3.1}))
        self.change(Length=3.7)
        self.assertEqual(self.lips(), {3.1})

    def test_three_vertices_two_vertices_edges_and_datums(self):
        line = self.doc.addObject("PartDesign::Line", "Line") if FreeCAD.GuiUp else None
        for targets in (
            [(self.part, "Vertex5"), (self.part, "Vertex6"), (self.part, "Vertex7")],
            [(self.part, "Vertex5"), (self.part, "Vertex6")],
            [(self.part, "Vertex5")],
            [(self.part, "Edge5")],
            *([[(line, "")]] if line else []),
        ):
            with self.subTest(targets=targets):
                self.part.Length = 3.3
                self.doc.recompute()
                ObjectsFemScalpel.followGeometry(self.crack, targets)
                self.doc.recompute()
                before = self.plane()
                self.part.Length = 3.7
                self.doc.recompute()
                after = self.plane()
                expected = 0.4 if targets[0][0] == self.part else 0.0
                self.assertAlmostEqual(after[0] - before[0], expected, 9)
                self.assertEqual(after[1:], before[1:])

    def test_turns_with_part(self):
        place = self.crack.PlanePlacement
        turn = FreeCAD.Placement(V(), FreeCAD.Rotation(V(0, 1, 0), 7), V(3, 1, 1))
        self.part.Placement = turn
        self.doc.recompute()
        self.assertSame(self.crack.PlanePlacement, turn.multiply(place))

    def test_radius(self):
        rod = self.doc.addObject("Part::Cylinder", "Rod")
        rod.Radius, rod.Height = 0.8, 9
        rod.Placement = FreeCAD.Placement(V(3, 2.5, -1), FreeCAD.Rotation())
        self.doc.recompute()
        drill = ObjectsFemScalpel.makeDrill(self.doc, self.source, origin=(3, 2.5, 0), axis=(0, 0, 1), radius=0.8)
        ObjectsFemScalpel.followGeometry(drill, [(rod, "Face1")])
        self.assertTrue(drill.SizeFollows)
        rod.Radius = 0.9
        rod.Placement.Base = V(3.2, 2.5, -1)
        self.doc.recompute()
        self.assertEqual((drill.Radius.Value, round(drill.AxisPlacement.Base.x, 9)), (0.9, 3.2))
        drill.Radius = 0.7
        self.assertFalse(drill.SizeFollows)
        rod.Radius = 0.5
        rod.Placement.Base = V(3.3, 2.5, -1)
        self.doc.recompute()
        self.assertEqual((drill.Radius.Value, round(drill.AxisPlacement.Base.x, 9)), (0.7, 3.3))

    def test_bottom_goes_along(self):
        cut = ObjectsFemScalpel.makeCut(
            self.doc,
            self.source,
            origin=(3.3, 1, 1),
            normal=(1, 0, 0),
            width=0.2,
            bottom=FreeCAD.Placement(V(3.3, 1, 1), FreeCAD.Rotation()),
        )
        ObjectsFemScalpel.followGeometry(cut, [(self.part, "Face2")])
        self.part.Placement.Base = V(0.2, 0, 0.4)
        self.doc.recompute()
        self.assertSame(cut.BottomPlacement, FreeCAD.Placement(V(3.5, 1, 1.4), FreeCAD.Rotation()))

    def test_sketch(self):
        sketch = self.doc.addObject("Sketcher::SketchObject", "Sketch")
        sketch.Placement = FreeCAD.Placement(V(3.3, 2.5, 2), FreeCAD.Rotation(V(0, 0, 1), V(1, 0, 0)))
        sketch.addGeometry(Part.Circle(V(), V(0, 0, 1), 1.1))
        self.doc.recompute()
        disk = ObjectsFemScalpel.makeCrack(
            self.doc, self.source, origin=(3.3, 2.5, 2), normal=(1, 0, 0), patch="Disk", patch_radius=1.1
        )
        ObjectsFemScalpel.followGeometry(disk, [(sketch, "")])
        self.assertTrue(disk.SizeFollows)
        sketch.delGeometry(0)
        sketch.addGeometry(Part.Circle(V(0.1, 0, 0), V(0, 0, 1), 1.3))
        self.doc.recompute()
        self.assertAlmostEqual(disk.PatchRadius.Value, 1.3)
        self.assertAlmostEqual(disk.PlanePlacement.Base.distanceToPoint(V(3.3, 2.5, 2)), 0.1)
        sketch.addGeometry(Part.LineSegment(V(3, 3, 0), V(4, 4, 0)))
        self.doc.recompute()
        self.assertIn("Invalid", disk.State)
        self.assertIn("no circle", disk.getStatusString())
        self.assertAlmostEqual(disk.PatchRadius.Value, 1.3)

    def test_refused(self):
        other = FreeCAD.newDocument("Other")
        try:
            far = other.addObject("Part::Box", "Far")
            for targets, words in (
                ([(far, "Face1")], "another document"),
                ([(self.part, "Face99")], "has no Face99"),
                ([(self.part, "")], "no face"),
                ([(self.crack, "")], "made from"),
                ([(self.part, f"Vertex{i}") for i in (1, 1, 2)], "on a line"),
            ):
                with self.subTest(words=words):
                    with self.assertRaisesRegex(ValueError, words):
                        ObjectsFemScalpel.followGeometry(self.crack, targets)
                    self.assertEqual(self.crack.FollowedName, "Box.Face2")
        finally:
            FreeCAD.closeDocument(other.Name)
        with self.assertRaisesRegex(ValueError, "no placement"):
            ObjectsFemScalpel.followGeometry(
                ObjectsFemScalpel.makeFillet(self.doc, self.source, along=[(0, 0, 0)], radius=1), [(self.part, "Face2")]
            )
