# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands with a cylinder, export, and the preferences page."""

import os
import re
import tempfile

import FreeCAD
import FreeCADGui
import numpy as np
import Part
from PySide import QtCore, QtGui

import femmesh_bridge
import femscalpel as fs
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .mesh_content import content_of
from .test_crack_panel import enter_plane, long_box, traces


class CylinderTest(GuiTest):
    PARTS = 1

    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(long_box(self.PARTS))

    def enter_axis(self, origin, axis, radius):
        for name, number in zip(
            ("originX", "originY", "originZ", "normalX", "normalY", "normalZ", "radius"), (*origin, *axis, radius)
        ):
            type_into(name, repr(number))


class CylindricalCrack(CylinderTest):
    def test_made_edited_undone(self):
        self.run_command("FemScalpel_CylindricalCrack")
        spin(0.2)
        self.enter_axis((7.1, 2.4, 2.0), (0.0, 0.0, 1.0), 1.3)
        expected = fs.crack(femmesh_bridge.from_femmesh(self.mesh.FemMesh), fs.Cylinder((7.1, 2.4, 2), (0, 0, 1), 1.3))
        wait_until(lambda: widget("status").text().startswith(f"{expected.report.nodes_moved} "), "the preview")
        self.assertGreater(faces_drawn("FemScalpelBand"), 0)
        screenshot("cylinder_preview")
        press_ok()
        crack = self.doc.CylindricalCrack
        self.assertEqual(crack.NodesDoubled, expected.report.nodes_doubled)
        made = content_of(crack)
        self.doc.undo()
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.doc.redo()
        self.assertEqual(content_of(self.doc.CylindricalCrack), made)
        self.doc.CylindricalCrack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertAlmostEqual(value("radius"), 1.3)
        press_cancel()

    def test_axis_from_the_view(self):
        part = self.doc.addObject("Part::Cylinder", "Pin")
        part.Radius, part.Height = 0.9, 6
        part.Placement.Base = FreeCAD.Vector(5, 2.5, -1)
        self.doc.recompute()
        edges = {type(e.Curve).__name__: f"Edge{k}" for k, e in enumerate(part.Shape.Edges, 1)}
        before = traces(self.doc)
        self.run_command("FemScalpel_CylindricalCrack")
        self.wait_for_preview_or_message()
        nodes = {tuple(p): n for n, p in self.mesh.FemMesh.Nodes.items()}
        for obj, names, origin, axis, radius in (
            (part, ["Face1"], (5, 2.5, -1), (0, 0, 1), 0.9),
            (part, [edges["Circle"]], (5, 2.5, 5), (0, 0, 1), 0.9),
            (part, [edges["Line"]], None, (0, 0, 1), None),
        ):
            with self.subTest(picked=names):
                click("pickGeometry")
                for name in names:
                    FreeCADGui.Selection.addSelection(self.doc.Name, obj.Name, name)
                spin(0.05)
                if origin is not None:
                    np.testing.assert_allclose([value("originX"), value("originY")], origin[:2], atol=0.006)
                np.testing.assert_allclose(
                    np.abs([value("normalX"), value("normalY"), value("normalZ")]), axis, atol=0.006
                )
                if radius is not None:
                    self.assertAlmostEqual(value("radius"), radius)
        click("pickNodes")
        for point in ((3.0, 0.0, 0.0), (3.0, 5.0, 0.0)):
            FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh", f"Node{nodes[point]}")
        spin(0.05)
        np.testing.assert_allclose([value("normalX"), value("normalY"), value("normalZ")], (0, 1, 0), atol=0.006)
        click("pickGeometry")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Pin", "Face2", 5.2, 2.5, 5)
        spin(0.05)
        np.testing.assert_allclose([value("originX"), abs(value("normalZ"))], (5.2, 1), atol=0.006)
        type_into("radius", "-1")
        self.assertIn("larger than 0", self.wait_for_message("geometryError"))
        press_cancel()
        self.assertEqual(traces(self.doc), before)

    def test_mouse_click_on_a_cylindrical_face(self):
        part = self.doc.addObject("Part::Cylinder", "Pin")
        part.Radius, part.Height = 0.9, 6
        part.Placement.Base = FreeCAD.Vector(5, -2.5, -1)
        self.doc.recompute()
        self.run_command("FemScalpel_CylindricalCrack")
        self.wait_for_preview_or_message()
        click("pickGeometry")
        # The side that faces the isometric view.
        click_at(np.array((5, -2.5, 1.0)) + 0.9 * np.array((0.5**0.5, -(0.5**0.5), 0)))
        np.testing.assert_allclose(
            [value("originX"), value("originY"), abs(value("normalZ")), value("radius")], (5, -2.5, 1, 0.9), atol=0.006
        )
        self.assertFalse(widget("pickGeometry").isChecked())

    def test_axis_along_the_view(self):
        self.run_command("FemScalpel_CylindricalCrack")
        self.wait_for_preview_or_message()
        view().viewTop()
        click("pickView")
        np.testing.assert_allclose([value("normalX"), value("normalY"), value("normalZ")], (0, 0, 1), atol=0.006)

    def wait_for_preview_or_message(self):
        wait_until(is_ready, "the panel")

    def test_handles(self):
        self.run_command("FemScalpel_CylindricalCrack")
        self.wait_for_preview_or_message()
        self.enter_axis((7.0, 2.5, 2.0), (0.0, 0.0, 1.0), 1.2)
        spin(0.1)
        arrow, out = 1.2 + 50 * pixel(), np.array((0.5**0.5, 0.5**0.5, 0))
        drag((7, 2.5, 2) + arrow * out, (7, 2.5, 2) + (arrow + 0.5) * out)
        self.assertAlmostEqual(value("radius"), 1.7, delta=0.1)
        self.assertAlmostEqual(value("originX"), 7)
        screenshot("cylinder_handles")


class Patches(CylinderTest):
    PARTS = 2

    def shown(self, expected):
        wait_until(lambda: f" {expected.report.elements_added} " in widget("status").text(), "the preview")
        self.assertGreater(lines_drawn("FemScalpelFront"), 5)

    def open_crack(self, *plane):
        """The crack's panel, with origin and normal of a plane entered."""
        self.run_command("FemScalpel_Crack")
        choose("patch", "Whole")
        spin(0.2)
        if plane:
            enter_plane(*plane)

    def choose_disk(self, radius):
        choose("patch", "Disk")
        type_into("patchRadius", f"{radius} mm")

    def test_parts_of_a_plane(self):
        source, plane = femmesh_bridge.from_femmesh(self.mesh.FemMesh), fs.Plane((6.1, 2.5, 2), (1, 0, 0))
        self.open_crack((6.1, 2.5, 2.0), (1.0, 0.0, 0.0))
        self.assertFalse(is_shown("patchRadius"))
        self.choose_disk(1.3)
        self.shown(fs.crack(source, plane, within=fs.Disk((6.1, 2.5, 2), 1.3)))
        self.assertFalse(is_shown("patchTurn"))
        screenshot("crack_disk")
        type_into("patchRadius", "0 mm")
        wait_until(lambda: is_shown("geometryError") and "radius is 0" in widget("geometryError").text(), "the error")
        choose("patch", "Ellipse")
        type_into("patchRadius", "1.6 mm")
        type_into("patchSecondRadius", "0.9 mm")
        type_into("patchTurn", "90 deg")
        self.wait_for_preview()
        screenshot("crack_ellipse")
        press_ok()
        crack = self.doc.Crack
        self.assertEqual((crack.Patch, crack.PatchRadius.Value, crack.PatchSecondRadius.Value), ("Ellipse", 1.6, 0.9))
        made = content_of(crack)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertAlmostEqual(value("patchTurn"), 90)
        press_ok()
        self.assertEqual(content_of(crack), made)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        choose("patch", "HalfPlane")
        self.wait_for_preview()
        screenshot("crack_half_plane")
        press_ok()
        self.assertEqual(crack.Patch, "HalfPlane")
        self.assertNotEqual(content_of(crack), made)
        self.doc.undo()
        self.assertEqual(content_of(crack), made)

    def test_handles_of_a_disk(self):
        self.open_crack((7.0, 2.5, 2.0), (0.0, 0.0, 1.0))
        self.choose_disk(1.2)
        self.wait_for_preview()
        screenshot("crack_disk_handles")
        border, tip = 50 * pixel(), 64 * pixel()
        centre, out = np.array((7, 2.5, 2)), np.array((1, 0, 0))
        drag(centre + (1.2 + border) * out, centre + (1.7 + border) * out)
        self.assertAlmostEqual(value("patchRadius"), 1.7, delta=0.1)
        np.testing.assert_allclose([value("originX"), value("originY"), value("originZ")], centre, atol=1e-9)
        across = np.array((0.5**0.5, 0.5**0.5, 0))
        drag(centre + tip * across, centre + (tip + 0.6) * across)
        np.testing.assert_allclose(
            [value("originX"), value("originY"), value("originZ")], centre + 0.6 * across, atol=0.1
        )
        self.assertAlmostEqual(value("originZ"), 2, places=5)
        self.assertAlmostEqual(value("patchRadius"), 1.7, delta=0.1)
        self.wait_for_preview()
        choose("patch", "Whole")
        drag(centre + (tip + 0.6) * across, centre + (tip + 1.2) * across)  # nothing to drag any more
        np.testing.assert_allclose(
            [value("originX"), value("originY"), value("originZ")], centre + 0.6 * across, atol=0.1
        )

    def sketch(self, *lines):
        """A sketch in the plane x = 6.1, its axes along y and z, its origin at (6.1, 2, 2)."""
        sketch = self.doc.addObject("Sketcher::SketchObject", "Outline")
        axes = FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), FreeCAD.Vector(0, 0, 1), FreeCAD.Vector(1, 0, 0), "XYZ")
        sketch.Placement = FreeCAD.Placement(FreeCAD.Vector(6.1, 2, 2), axes)
        for line in lines:
            sketch.addGeometry(line)
        self.doc.recompute()
        self.doc.clearUndos()

    def pick_sketch(self):
        click("pickGeometry")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Outline", "Edge1")
        spin(0.1)

    def test_polygon_of_a_sketch(self):
        corners = [FreeCAD.Vector(*xy, 0) for xy in ((-1.2, -1), (1.7, -0.8), (1.1, 0.9), (-0.3, 1.4))]
        self.sketch(*(Part.LineSegment(a, b) for a, b in zip(corners, corners[1:] + corners[:1])))
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        polygon = fs.Polygon([(6.1, 2 + c.x, 2 + c.y) for c in corners])
        self.open_crack()
        choose("patch", "HalfPlane")
        self.assertTrue(is_shown("patchTurn"))
        choose("patch", "Polygon")
        self.assertIn("Pick a sketch", self.wait_for_message("geometryError"))
        self.assertFalse(is_shown("patchTurn"), "the half plane's")
        self.assertEqual(in_scene("FemScalpelToolMarks").getChild(0).whichChild.getValue(), -1)
        self.pick_sketch()
        self.assertTrue(is_shown("patchTurn"))
        expected = fs.crack(source, fs.Plane((6.1, 2, 2), (1, 0, 0)), within=polygon)
        self.shown(expected)
        screenshot("crack_polygon")
        click("flip")  # the sides change places, the polygon stays
        self.shown(fs.crack(source, fs.Plane((6.1, 2, 2), (-1, 0, 0)), within=polygon))
        press_ok()
        crack = self.doc.Crack
        places = [crack.PlanePlacement.multVec(corner) for corner in crack.PatchCorners]
        np.testing.assert_allclose(places, [(6.1, 2 + c.x, 2 + c.y) for c in corners], atol=1e-12)
        self.assertAlmostEqual(crack.PlanePlacement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)).x, -1)
        made = content_of(crack)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(widget("patch").currentData(), "Polygon")
        press_ok()
        self.assertEqual(content_of(crack), made)

    def test_ellipse_and_disk_of_a_sketch(self):
        self.sketch(Part.Ellipse(FreeCAD.Vector(0.3, 1.6, 0), FreeCAD.Vector(1, 0.1, 0), FreeCAD.Vector(0.3, 0.1, 0)))
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        self.open_crack()
        self.pick_sketch()
        self.assertEqual(widget("patch").currentData(), "Ellipse")
        np.testing.assert_allclose(
            [value("originY"), value("originZ"), value("patchRadius"), value("patchSecondRadius")],
            (2.3, 2.1, 1.5, 0.7),
            atol=0.006,
        )
        self.shown(
            fs.crack(
                source, fs.Plane((6.1, 2.3, 2.1), (1, 0, 0)), within=fs.Ellipse((6.1, 2.3, 2.1), (1.5, 0.7), (0, 0, 1))
            )
        )
        self.doc.Outline.delGeometry(0)
        self.doc.Outline.addGeometry(Part.Circle(FreeCAD.Vector(0.1, 0.2, 0), FreeCAD.Vector(0, 0, 1), 1.1))
        self.doc.recompute()
        self.pick_sketch()
        self.shown(fs.crack(source, fs.Plane((6.1, 2.1, 2.2), (1, 0, 0)), within=fs.Disk((6.1, 2.1, 2.2), 1.1)))
        self.assertEqual(widget("patch").currentData(), "Disk")
        press_cancel()

    def test_sketch_without_an_outline(self):
        self.sketch(
            Part.LineSegment(FreeCAD.Vector(-1, 0, 0), FreeCAD.Vector(1, 0, 0)),
            Part.LineSegment(FreeCAD.Vector(1, 0, 0), FreeCAD.Vector(1, 1, 0)),
        )
        self.open_crack()
        self.pick_sketch()
        self.assertEqual(widget("patch").currentData(), "Whole")
        np.testing.assert_allclose([value("originX"), value("normalX")], (6.1, 1), atol=0.006)
        choose("patch", "Polygon")
        self.assertIn("one closed line", self.wait_for_message("geometryError"))
        press_cancel()

    def test_part_is_carried_along_when_its_plane_tilts(self):
        self.open_crack((6.1, 2.5, 2.0), (0.0, 0.001, -1.0))
        choose("patch", "HalfPlane")
        type_into("patchTurn", "20 deg")
        self.wait_for_preview()
        press_ok()
        crack = self.doc.Crack
        before = crack.PlanePlacement.Rotation.multVec(FreeCAD.Vector(1, 0, 0))
        for y in ("0", "-0.001"):  # through the direction against which turns are measured
            crack.ViewObject.doubleClicked()
            self.wait_for_preview()
            type_into("normalY", y)
            self.wait_for_preview()
            press_ok()
            after = crack.PlanePlacement.Rotation.multVec(FreeCAD.Vector(1, 0, 0))
            self.assertLess(before.getAngle(after), 0.01)

    def test_refined_at_the_front_first(self):
        source, plane = femmesh_bridge.from_femmesh(self.mesh.FemMesh), fs.Plane((6.1, 2.5, 2), (1, 0, 0))
        self.open_crack((6.1, 2.5, 2.0), (1.0, 0.0, 0.0))
        self.choose_disk(1.3)
        self.assertFalse(is_shown("refineSize"))
        choose("refine", "Never")
        self.shown(fs.crack(source, plane, within=fs.Disk((6.1, 2.5, 2), 1.3), refine=False))
        choose("refine", "Size")
        self.assertGreater(value("refineSize"), 0)
        type_into("refineSize", "0 mm")
        self.assertIn("positive", self.wait_for_message("refineError"))
        type_into("refineSize", "0.3 mm")
        expected = fs.crack(source, plane, within=fs.Disk((6.1, 2.5, 2), 1.3), refine=0.3)
        self.assertGreater(expected.report.refinement.elements_after, expected.report.refinement.elements_before)
        self.shown(expected)
        self.assertFalse(is_shown("refineError"))
        screenshot("crack_refined")
        press_ok()
        crack = self.doc.Crack
        self.assertEqual((crack.Refine, crack.RefineSize.Value, crack.RefinedTo.Value), ("Size", 0.3, 0.3))
        made = content_of(crack)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(value("refineSize"), 0.3)
        choose("refine", "Automatic")
        self.wait_for_preview()
        press_ok()
        self.assertEqual(crack.Refine, "Automatic")
        self.assertNotEqual(content_of(crack), made)

    def test_part_of_a_cylinder(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        self.run_command("FemScalpel_CylindricalCrack")
        spin(0.2)
        self.enter_axis((7.1, 2.4, 2.0), (0.0, 0.0, 1.0), 1.3)
        click("bounded")
        type_into("partLow", "-1 mm")
        type_into("partHigh", "0.9 mm")
        self.shown(fs.crack(source, fs.Cylinder((7.1, 2.4, 2), (0, 0, 1), 1.3), within=fs.CylinderPart((-1, 0.9))))
        screenshot("cylinder_part")
        type_into("partStart", "20 deg")
        type_into("partEnd", "10 deg")
        wait_until(lambda: is_shown("geometryError") and "angle" in widget("geometryError").text(), "the error")
        type_into("partEnd", "200 deg")
        self.shown(
            fs.crack(
                source,
                fs.Cylinder((7.1, 2.4, 2), (0, 0, 1), 1.3),
                within=fs.CylinderPart((-1, 0.9), (20, 200), (1, 0, 0)),
            )
        )
        screenshot("cylinder_part_angles")
        press_ok()
        crack = self.doc.CylindricalCrack
        self.assertEqual(
            (crack.Bounded, crack.Low.Value, crack.High.Value, crack.StartAngle.Value, crack.EndAngle.Value),
            (True, -1, 0.9, 20, 200),
        )
        made = content_of(crack)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        press_ok()
        self.assertEqual(content_of(crack), made)


class Incision(CylinderTest):
    PARTS = 2

    def test_made_edited_undone(self):
        self.run_command("FemScalpel_Incision")
        spin(0.2)
        enter_plane((6.1, 2.5, 2.0), (1.0, 0.2, 0.1))
        type_into("slotWidth", "1.7 mm")
        plane = fs.Plane((6.1, 2.5, 2), (1, 0.2, 0.1))
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        expected = fs.cut(source, plane, width=1.7)
        wait_until(lambda: f" {expected.report.elements_removed} " in widget("status").text(), "the preview")
        self.assertGreater(faces_drawn("FemScalpelRemoved"), 0)
        self.assertGreater(faces_drawn("FemScalpelBand"), 0)
        self.assertFalse(widget("method").isEnabled())
        screenshot("incision_1_preview")
        choose("look", "whole")
        screenshot("incision_whole")
        press_ok()
        cut = self.doc.Incision
        self.assertEqual(cut.FemMesh.NodeCount, expected.mesh.node_count)
        screenshot("incision_2_made")
        made = content_of(cut)
        self.doc.undo()
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.doc.redo()
        self.assertEqual(content_of(self.doc.Incision), made)
        self.doc.Incision.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertAlmostEqual(value("slotWidth"), 1.7)
        type_into("slotWidth", "1.1 mm")
        self.wait_for_preview()
        press_ok()
        self.assertEqual(self.doc.Incision.FemMesh.NodeCount, fs.cut(source, plane, width=1.1).mesh.node_count)

    def test_down_to_the_point(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        self.run_command("FemScalpel_Incision")
        spin(0.2)
        enter_plane((6.1, 2.5, 1.7), (1.0, 0.0, 0.0))
        type_into("slotWidth", "0.8 mm")
        self.assertFalse(is_shown("slotTurn"))
        choose("slotEnd", "Point")
        type_into("slotTurn", "180 deg")
        expected = fs.cut(
            source, fs.Plane((6.1, 2.5, 1.7), (1, 0, 0)), width=0.8, bottom=fs.Plane((6.1, 2.5, 1.7), (0, 0, -1))
        )
        wait_until(lambda: f" {expected.report.elements_removed} removed" in widget("status").text(), "the preview")
        screenshot("incision_down_to_the_point")
        click("flip")  # the sides change places, the slot stays
        self.wait_for_preview()
        self.assertIn(f" {expected.report.elements_removed} removed", widget("status").text())
        press_ok()
        cut = self.doc.Incision
        self.assertFalse(cut.Through)
        np.testing.assert_allclose(
            cut.BottomPlacement.Rotation.multVec(FreeCAD.Vector(0, 0, 1)), (0, 0, -1), atol=1e-12
        )
        self.assertEqual(cut.FemMesh.NodeCount, expected.mesh.node_count)
        made = content_of(cut)
        cut.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(widget("slotEnd").currentData(), "Point")
        press_ok()
        self.assertEqual(content_of(cut), made)
        cut.ViewObject.doubleClicked()
        self.wait_for_preview()
        type_into("originZ", "2.1")  # the bottom follows the point
        self.wait_for_preview()
        press_ok()
        self.assertAlmostEqual(cut.BottomPlacement.Base.z, 2.1)

    def test_bottom_of_the_object_is_kept(self):
        import ObjectsFemScalpel

        bottom = FreeCAD.Placement(FreeCAD.Vector(0, 0, 1.7), FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 180))
        cut = ObjectsFemScalpel.makeCut(
            self.doc, self.mesh, origin=(6.1, 2.5, 2), normal=(1, 0, 0), width=0.8, bottom=bottom
        )
        self.doc.recompute()
        made = content_of(cut)
        cut.ViewObject.doubleClicked()
        self.wait_for_preview()
        names = [widget("groups").item(row, 0).text() for row in range(widget("groups").rowCount())]
        self.assertIn("CUT_BOTTOM", names)
        screenshot("incision_bottom")
        press_ok()
        self.assertEqual(content_of(cut), made)


class Drill(CylinderTest):
    PARTS = 2

    def test_coarse_mesh_is_refined_first(self):
        coarse = self.add_mesh(long_box(), "Coarse")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Coarse")
        self.run_command("FemScalpel_Drill")
        spin(0.2)
        self.enter_axis((7.1, 2.4, 4.0), (0.0, 0.0, -1.0), 1.3)
        expected = fs.drill(
            femmesh_bridge.from_femmesh(coarse.FemMesh), fs.Cylinder((7.1, 2.4, 4), (0, 0, -1), 1.3)
        ).report
        self.assertGreater(expected.elements_added, 100)
        wait_until(lambda: f" {expected.elements_added} " in widget("status").text(), "the preview")
        screenshot("drill_coarse")
        self.enter_axis((7.1, 2.4, 4.0), (0.0, 0.0, -1.0), 0.25)
        fine = fs.drill(
            femmesh_bridge.from_femmesh(coarse.FemMesh), fs.Cylinder((7.1, 2.4, 4), (0, 0, -1), 0.25)
        ).report.refinement
        wait_until(
            lambda: f"from {fine.elements_before} to {fine.elements_after} elements" in widget("status").text(),
            "what refining makes of the mesh",
        )

    def test_through_then_blind(self):
        self.run_command("FemScalpel_Drill")
        spin(0.2)
        self.enter_axis((7.1, 2.4, 4.0), (0.0, 0.0, -1.0), 1.3)
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        expected = fs.drill(source, fs.Cylinder((7.1, 2.4, 4), (0, 0, -1), 1.3))
        wait_until(lambda: f" {expected.report.elements_removed} " in widget("status").text(), "the preview")
        self.assertGreater(faces_drawn("FemScalpelRemoved"), 0)
        self.assertGreater(faces_drawn("FemScalpelBand"), 0)
        self.assertGreater(lines_drawn("FemScalpelOutline"), 0)
        screenshot("drill_1_preview")
        choose("look", "whole")
        screenshot("drill_whole")
        press_ok()
        drill = self.doc.Drill
        self.assertEqual(drill.FemMesh.NodeCount, expected.mesh.node_count)
        screenshot("drill_2_made")
        self.assertEqual(self.doc.UndoNames, ["Drill"])
        drill.ViewObject.doubleClicked()
        self.wait_for_preview()
        click("through")
        type_into("holeDepth", "2 mm")
        self.wait_for_preview()
        blind = fs.drill(source, fs.Cylinder((7.1, 2.4, 4), (0, 0, -1), 1.3), depth=2)
        wait_until(
            lambda: f" {blind.report.elements_removed} " in widget("status").text(), "the preview of the blind hole"
        )
        names = [widget("groups").item(row, 0).text() for row in range(widget("groups").rowCount())]
        self.assertIn("HOLE_BOTTOM", names)
        screenshot("drill_blind")
        press_ok()
        self.assertEqual(drill.FemMesh.NodeCount, blind.mesh.node_count)
        self.assertFalse(drill.Through)
        self.doc.undo()
        self.assertTrue(drill.Through)
        self.assertEqual(drill.FemMesh.NodeCount, expected.mesh.node_count)

    def test_chain_of_crack_and_drill(self):
        import ObjectsFemScalpel

        crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(3.1, 2.5, 2), normal=(1, 0.1, 0))
        self.doc.recompute()
        FreeCADGui.Selection.addSelection(self.doc.Name, crack.Name)
        self.run_command("FemScalpel_Drill")
        spin(0.2)
        self.enter_axis((9.1, 2.4, 4.0), (0.0, 0.0, -1.0), 1.3)
        self.wait_for_preview()
        press_ok()
        self.assertEqual(self.doc.Drill.Source, crack)
        before = content_of(self.doc.Drill)
        crack.PlanePlacement = FreeCAD.Placement(FreeCAD.Vector(4.2, 2.5, 2), crack.PlanePlacement.Rotation)
        self.doc.recompute()
        self.assertNotEqual(content_of(self.doc.Drill), before)
        # A link that leads nowhere marks the object.
        self.doc.removeObject(crack.Name)
        self.doc.recompute()
        self.assertIn("Invalid", self.doc.Drill.State)
        self.assertEqual(self.doc.Drill.FemMesh.NodeCount, 0)
        spin(0.3)
        # In one line: tearDown() looks for tracebacks.
        self.assertRegex(
            report_view()[self.reported :], r"FemScalpel: Drill: Source is not set; choose the FEM mesh to work on\n"
        )


class Refine(CylinderTest):
    def test_made_edited(self):
        self.run_command("FemScalpel_Refine")
        spin(0.2)
        self.enter_axis((7.0, 2.5, 4.0), (0.0, 0.0, 1.0), 1.0)
        type_into("edgeSize", "0.7")
        expected = fs.refine(
            femmesh_bridge.from_femmesh(self.mesh.FemMesh), fs.Cylinder((7, 2.5, 4), (0, 0, 1), 1), 0.7
        )
        wait_until(lambda: f" {expected.report.elements_added} " in widget("status").text(), "the preview")
        screenshot("refine_preview")
        press_ok()
        self.assertEqual(self.doc.Refine.FemMesh.NodeCount, expected.mesh.node_count)
        self.doc.Refine.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertAlmostEqual(value("edgeSize"), 0.7)
        choose("toolShape", "Plane")
        self.wait_for_preview()
        press_ok()
        self.assertEqual(self.doc.Refine.ToolShape, "Plane")
        self.doc.undo()
        self.assertEqual(self.doc.Refine.ToolShape, "Cylinder")
        self.assertEqual(self.doc.Refine.FemMesh.NodeCount, expected.mesh.node_count)


class Export(GuiTest):
    def test_files(self):
        from femscalpelgui.commands.base import Unusable
        from femscalpelgui.commands.export import Export as Command

        mesh = self.add_mesh(long_box())
        with tempfile.TemporaryDirectory() as folder:
            for ending in (e for f in fs.formats() if f.writes for e in f.extensions):
                path = os.path.join(folder, "mesh" + ending)
                Command.write(mesh, path)
                self.assertGreater(os.path.getsize(path), 1000)
            again = fs.read(os.path.join(folder, "mesh.med"))
            self.assertEqual(again.node_count, mesh.FemMesh.NodeCount)
            self.assertEqual(set(again.groups), {"LEFT", "RIGHT", "CORE", "FIX", "TOP"})
            with self.assertRaises(Unusable):
                Command.write(mesh, os.path.join(folder, "mesh.xyz"))

    def test_dialog(self):
        from femscalpelgui.commands.export import Export as Command

        mesh = self.add_mesh(long_box())
        asked = []
        with tempfile.TemporaryDirectory() as folder:

            def answer(parent, title, name, filters):
                asked[:] = [name, filters]
                return os.path.join(folder, "mesh"), filters.split(";;")[1]

            ask = QtGui.QFileDialog.getSaveFileName
            QtGui.QFileDialog.getSaveFileName = staticmethod(answer)
            try:
                Command().run(mesh)
            finally:
                QtGui.QFileDialog.getSaveFileName = ask
            self.assertEqual(os.listdir(folder), ["mesh.inp"])
        self.assertEqual(asked[0], mesh.Label + ".med")
        self.assertEqual(
            asked[1].split(";;")[:3],
            ["MED: Code_Aster, SALOME (*.med *.mmed *.rmed)", "CalculiX (*.inp *.inp.gz)", "ParaView (*.vtu)"],
        )


class Import(GuiTest):
    """From a file to a file, with what FreeCAD's mesh does not hold."""

    CARDS = "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET=CORE, MATERIAL=STEEL\n"

    def open(self, path, chosen=None):
        """Imports a file by the command, whose dialogs answer so; returns the filters that were offered."""
        offered = []
        dialogs = QtGui.QFileDialog.getOpenFileName, QtGui.QInputDialog.getItem

        def answer(parent, title, folder, filters):
            offered.extend(filters.split(";;"))
            return path, filters.split(";;")[0]

        QtGui.QFileDialog.getOpenFileName = staticmethod(answer)
        QtGui.QInputDialog.getItem = staticmethod(lambda *args: (chosen, chosen is not None))
        try:
            FreeCADGui.runCommand("FemScalpel_ImportMesh")
        finally:
            QtGui.QFileDialog.getOpenFileName, QtGui.QInputDialog.getItem = dialogs
        return offered

    def test_a_deck_cracked_and_exported(self):
        with tempfile.TemporaryDirectory() as folder:
            path, out = os.path.join(folder, "bar.inp"), os.path.join(folder, "out.inp")
            fs.write(long_box(), path)
            with open(path, "a") as file:
                file.write(self.CARDS)
            offered = self.open(path)
            self.assertIn("*.inp", offered[0])
            self.assertEqual(len(offered), 1 + sum(f.reads for f in fs.formats()))
            mesh = self.doc.getObject("bar")
            self.assertEqual(mesh.FemMesh.VolumeCount, sum(len(c) for t, c in long_box().cells.items() if "tetra" in t))
            self.assertEqual(FreeCADGui.Selection.getSelection(), [mesh])
            self.run_command("FemScalpel_Crack")
            self.wait_for_preview()
            screenshot("imported_crack")
            press_ok()
            from femscalpelgui.commands.export import Export as Command

            Command.write(self.doc.Crack, out)
            with open(out) as file:
                self.assertIn(self.CARDS, file.read())
            self.assertIn("CRACK_P", fs.read(out).groups)
            self.doc.undo()
            self.doc.undo()
            self.assertEqual(self.doc.Objects, [])

    def test_into_a_new_document(self):
        before = set(FreeCAD.listDocuments())
        active = FreeCAD.ActiveDocument.Name
        with tempfile.TemporaryDirectory() as folder:
            path, bad = os.path.join(folder, "bar.med"), os.path.join(folder, "bad.med")
            fs.write(long_box(), path)
            with open(bad, "w") as file:
                file.write("nothing of the kind")
            FreeCAD.setActiveDocument("")
            FreeCAD.closeDocument(active)
            try:
                said = self.refusal(lambda: self.open(bad))
                self.assertIn("bad.med", said)
                self.assertEqual(set(FreeCAD.listDocuments()), before - {active})
                self.open(path)
                (name,) = set(FreeCAD.listDocuments()) - (before - {active})
                self.assertEqual([o.Label for o in FreeCAD.getDocument(name).Objects], ["bar"])
                FreeCAD.closeDocument(name)
            finally:
                self.doc = FreeCAD.newDocument(active)

    def refusal(self, action):
        """What the message box says that `action` brings up."""
        said = []
        warning = QtGui.QMessageBox.warning
        QtGui.QMessageBox.warning = staticmethod(lambda parent, title, text: said.append(text))
        try:
            action()
        finally:
            QtGui.QMessageBox.warning = warning
        self.assertEqual(len(said), 1)
        return said[0]


class Preferences(GuiTest):
    def test_page(self):
        seen = []

        def look():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is None:
                return
            combo = dialog.findChild(QtGui.QComboBox, "Method")
            seen.append(combo is not None and dialog.findChild(QtGui.QDoubleSpinBox, "QualityThreshold").value())
            if combo is not None:
                dialog.resize(900, 700)
                screenshot("preferences")
                combo.setCurrentIndex(1)
                dialog.findChild(QtGui.QCheckBox, "PutIntoAnalysis").setChecked(False)
            timer.stop()
            dialog.accept()

        timer = QtCore.QTimer()
        timer.timeout.connect(look)
        timer.start(300)
        FreeCADGui.showPreferences("FemScalpel")
        self.assertEqual(seen, [0.2])
        from femscalpelgui import preferences

        self.assertEqual(preferences.method(), "deform")
        self.assertFalse(preferences.put_into_analysis())
        group = FreeCAD.ParamGet(preferences.GROUP)
        group.RemInt("Method")
        group.RemBool("PutIntoAnalysis")
        self.assertEqual(preferences.method(), "snap")
        self.assertEqual([round(255 * c) for c in preferences.colour("Interface", (0.86, 0.12, 0.16))], [219, 31, 41])
