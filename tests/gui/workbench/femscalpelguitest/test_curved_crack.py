# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command for cracks along curved tools, and the input of tools that the panel of Refine has, too."""

import FreeCAD
import FreeCADGui
import numpy as np
import Part

import femmesh_bridge
import femscalpel as fs
from femscalpelgui.view.profiles import PROFILES, revolved
from .gui_testing import *  # noqa: F403
from .mesh_content import content_of
from .test_crack_panel import traces
from .test_other_commands import CylinderTest

ORIGIN, AXIS = (7.1, 2.4, 2.1), (0.0, 0.0, 1.0)
#: What is typed for a tool beside origin and axis, the same for the engine, and the fields that are not shown.
KINDS = {
    "Sphere": ({"radius": 1.5}, fs.Sphere(ORIGIN, 1.5), ("normalX", "pickView", "tubeRadius", "halfAngle", "pickFace")),
    "Torus": ({"radius": 1.4, "tubeRadius": 0.9}, fs.Torus(ORIGIN, AXIS, 1.4, 0.9), ("halfAngle", "pickFace")),
    "Cone": ({"radius": 3.0, "halfAngle": 20.0}, fs.Cone(ORIGIN, AXIS, 3, 20), ("tubeRadius", "pickFace")),
    "Cylinder": ({"radius": 1.3}, fs.Cylinder(ORIGIN, AXIS, 1.3), ("tubeRadius", "halfAngle", "pickFace")),
}


class CurvedTest(CylinderTest):
    def open_panel(self, name="FemScalpel_CurvedCrack"):
        self.run_command(name)
        wait_until(is_ready, "the panel")

    def enter(self, kind):
        choose("toolShape", kind)
        fields = {name + axis: x for name, v in (("origin", ORIGIN), ("normal", AXIS)) for axis, x in zip("XYZ", v)}
        for name, number in {**fields, **KINDS[kind][0]}.items():
            if is_shown(name):
                type_into(name, repr(number))

    def shown(self, report):
        """Waits for the preview of what a report tells."""
        start = f"{report.nodes_moved} nodes moved, {report.nodes_added} added; {report.elements_added} elements added"
        wait_until(lambda: widget("status").text().startswith(start), "the preview")

    def blade(self, place=(7.2, -7, -3)):
        """A part whose face, a cylinder of radius 9, goes through the box."""
        part = self.doc.addObject("Part::Feature", "Blade")
        part.Shape = Part.makeCylinder(9, 12, FreeCAD.Vector(*place), FreeCAD.Vector(0, 0, 1))
        self.doc.recompute()
        return part


class CurvedCrack(CurvedTest):
    def test_made_edited_undone(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        for kind, (values, tool, hidden) in KINDS.items():
            with self.subTest(kind=kind):
                self.open_panel()
                self.assertEqual(widget("toolShape").currentData(), "Sphere")
                self.enter(kind)
                self.assertEqual([name for name in hidden if is_shown(name)], [])
                expected = fs.crack(source, tool).report
                self.shown(expected)
                self.assertGreater(faces_drawn("FemScalpelBand"), 0)
                self.assertGreater(faces_drawn("FemScalpelHandles"), 0)
                np.testing.assert_array_equal(widget("histogram").after, expected.quality.after.histogram)
                screenshot("curved_" + kind)
                press_ok()
                crack = self.doc.CurvedCrack
                self.assertEqual((crack.ToolShape, crack.NodesDoubled), (kind, expected.nodes_doubled))
                made = content_of(crack)
                crack.ViewObject.doubleClicked()
                self.shown(expected)
                self.assertEqual(widget("toolShape").currentData(), kind)
                for name, number in values.items():
                    self.assertAlmostEqual(value(name), number)
                type_into("originX", "7.3")
                self.wait_for_preview()
                press_ok()
                self.assertNotEqual(content_of(crack), made)
                self.doc.undo()
                self.assertEqual(content_of(crack), made)
                self.doc.undo()
                self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])

    def test_clicked_face(self):
        blade = self.blade()
        before = traces(self.doc)
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        expected = fs.crack(source, fs.Face(blade.Shape.Faces[0])).report
        self.open_panel()
        choose("toolShape", "Face")
        self.assertIn("click a face of a part", self.wait_for_message("geometryError"))
        self.assertFalse(is_shown("originX") or is_shown("radius") or is_shown("pickNodes") or is_shown("centre"))
        self.assertIsNone(in_scene("FemScalpelHandles"))
        click("pickFace")
        click_at((7.2 + 9 * 0.5**0.5, -7 - 9 * 0.5**0.5, 2.0))  # of the side that the isometric view looks at
        self.assertFalse(widget("pickFace").isChecked())
        self.assertEqual(widget("faces").text(), "Blade Face1")
        self.shown(expected)
        self.assertEqual(blade.ViewObject.SwitchNode.whichChild.getValue(), -1)
        self.assertTrue(blade.ViewObject.Visibility)
        screenshot("curved_Face")
        press_ok()
        crack = self.doc.CurvedCrack
        self.assertEqual((crack.ToolFace, crack.NodesDoubled), ((blade, ["Face1"]), expected.nodes_doubled))
        self.assertNotEqual(blade.ViewObject.SwitchNode.whichChild.getValue(), -1)
        crack.ViewObject.doubleClicked()
        self.shown(expected)
        self.assertEqual(widget("faces").text(), "Blade Face1")
        click("clearFaces")
        self.assertIn("click a face of a part", self.wait_for_message("geometryError"))
        press_cancel()
        self.assertEqual(crack.ToolFace, (blade, ["Face1"]))
        self.doc.undo()
        self.open_panel()
        choose("toolShape", "Face")
        press_cancel()
        self.assertEqual(traces(self.doc)[0], before[0])

    def test_faces_that_do_not_fit(self):
        blade = self.blade()
        self.open_panel()
        choose("toolShape", "Face")
        for name in ("Face1", "Face2"):
            click("pickFace")
            FreeCADGui.Selection.addSelection(self.doc.Name, blade.Name, name)
            spin(0.05)
        self.assertEqual(widget("faces").text(), "2 faces of Blade")
        self.assertIn("faces meet at 90", self.wait_for_message("geometryError"))
        click("clearFaces")
        click("pickFace")
        FreeCADGui.Selection.addSelection(self.doc.Name, blade.Name, "Edge1")
        self.assertIn("no face of a part", widget("hint").text())
        spin(0.05)
        FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh", "Elem103F1", 1, 0, 0)
        self.assertIn("no face of a part", widget("hint").text())
        spin(0.05)
        self.assertTrue(widget("pickFace").isChecked())
        press_cancel()  # ends picking only
        self.assertFalse(widget("pickFace").isChecked())

    def test_face_selected_before(self):
        blade = self.blade()
        expected = fs.crack(femmesh_bridge.from_femmesh(self.mesh.FemMesh), fs.Face(blade.Shape.Faces[0])).report
        FreeCADGui.Selection.addSelection(self.doc.Name, blade.Name, "Face1")
        self.open_panel()
        self.assertEqual(widget("toolShape").currentData(), "Face")
        self.shown(expected)

    def test_crack_that_ends_with_the_face(self):
        corners = [FreeCAD.Vector(7.1, y, z) for y, z in ((-2, 2.2), (9, 2.2), (9, 7), (-2, 7), (-2, 2.2))]
        part = self.doc.addObject("Part::Feature", "Sheet")
        part.Shape = Part.Face(Part.makePolygon(corners))
        self.doc.recompute()
        FreeCADGui.Selection.addSelection(self.doc.Name, part.Name, "Face1")
        self.open_panel()
        self.wait_for_preview()
        self.assertGreater(lines_drawn("FemScalpelFront"), 0)

    def test_picked_from_round_faces(self):
        place = FreeCAD.Placement(FreeCAD.Vector(7, 2.5, 2), FreeCAD.Rotation())
        for kind, shape, fields in (
            ("Sphere", Part.makeSphere(1.7), {"radius": 1.7}),
            ("Torus", Part.makeTorus(2.2, 0.6), {"radius": 2.2, "tubeRadius": 0.6, "normalZ": 1}),
            ("Cone", Part.makeCone(0.5, 2.5, 2), {"radius": 0.5, "halfAngle": 45, "normalZ": 1}),
            ("Cone", Part.makeCone(2.5, 0.5, 2), {"radius": 2.5, "halfAngle": 45, "normalZ": -1}),
        ):
            with self.subTest(kind=kind):
                part = self.doc.addObject("Part::Feature", "Round")
                part.Shape, part.Placement = shape, place
                self.doc.recompute()
                self.open_panel()
                choose("toolShape", kind)
                click("pickGeometry")
                FreeCADGui.Selection.addSelection(self.doc.Name, part.Name, "Face1", 7, 2.5, 2)
                spin(0.05)
                for name, number in {"originX": 7, "originY": 2.5, "originZ": 2, **fields}.items():
                    self.assertAlmostEqual(value(name), number, delta=0.006, msg=name)
                press_cancel()
                self.doc.removeObject(part.Name)

    def test_cone_with_a_tip(self):
        part = self.doc.addObject("Part::Feature", "Round")
        part.Shape = Part.makeCone(0, 2, 4, FreeCAD.Vector(7, 2.5, -3))
        self.doc.recompute()
        self.open_panel()
        choose("toolShape", "Cone")
        click("pickGeometry")
        FreeCADGui.Selection.addSelection(self.doc.Name, part.Name, "Face1")
        spin(0.05)
        self.assertGreater(value("radius"), 0.1)
        self.assertAlmostEqual(value("originZ") + 3, 2 * value("radius"), delta=0.02)
        self.assertAlmostEqual(value("halfAngle"), np.degrees(np.arctan(0.5)), delta=0.01)

    def test_one_node_is_the_middle_of_a_sphere(self):
        self.open_panel()
        self.assertEqual(widget("pickNodes").text(), "1 node")
        nodes = {tuple(p): n for n, p in self.mesh.FemMesh.Nodes.items()}
        click("pickNodes")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh", f"Node{nodes[(3.0, 0.0, 4.0)]}")
        spin(0.05)
        self.assertEqual([value(name) for name in ("originX", "originY", "originZ")], [3, 0, 4])
        choose("toolShape", "Torus")
        self.assertEqual(widget("pickNodes").text(), "2 nodes")

    def test_handles(self):
        self.open_panel()
        self.enter("Torus")
        spin(0.1)
        tip, origin = 54 * pixel(), np.array(ORIGIN)
        up = np.array((0, 0, 1.0))
        drag(origin + tip * up, origin + (tip + 0.8) * up)
        self.assertAlmostEqual(value("originZ"), ORIGIN[2] + 0.8, delta=0.15)
        self.assertAlmostEqual(value("originX"), ORIGIN[0], delta=0.01)
        self.assertAlmostEqual(value("tubeRadius"), 0.9)
        screenshot("curved_handles")

    def test_messages_at_their_fields(self):
        self.open_panel()
        self.enter("Torus")
        type_into("tubeRadius", "2")
        self.assertIn("radius", self.wait_for_message("geometryError"))
        type_into("tubeRadius", "0.5")
        self.wait_for_preview()
        self.assertFalse(is_shown("geometryError"))
        choose("toolShape", "Cone")
        type_into("halfAngle", "95")
        self.assertIn("angle", self.wait_for_message("geometryError"))
        choose("toolShape", "Sphere")
        type_into("radius", "0")
        self.assertIn("larger than 0", self.wait_for_message("geometryError"))
        press_ok()
        self.assertTrue(FreeCADGui.Control.activeDialog())

    def test_pictures_are_the_tools(self):
        for kind, (values, tool, _) in KINDS.items():
            further = {"tube_radius": values.get("tubeRadius"), "half_angle": values.get("halfAngle")}
            points, faces = revolved(PROFILES[kind](values["radius"], further, 15))
            np.testing.assert_allclose(tool.distance(points + ORIGIN), 0, atol=1e-9)
            self.assertEqual(faces.max(), len(points) - 1)


class RefineNearAnyTool(CurvedTest):
    def test_torus_and_face(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        blade = self.blade()
        self.open_panel("FemScalpel_Refine")
        self.enter("Torus")
        type_into("edgeSize", "0.8")
        self.shown(fs.refine(source, KINDS["Torus"][1], 0.8).report)
        screenshot("refine_torus")
        press_ok()
        refined = self.doc.Refine
        self.assertEqual((refined.ToolShape, refined.TubeRadius.Value), ("Torus", 0.9))
        refined.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertAlmostEqual(value("tubeRadius"), 0.9)
        choose("toolShape", "Face")
        click("pickFace")
        FreeCADGui.Selection.addSelection(self.doc.Name, blade.Name, "Face1")
        spin(0.05)
        expected = fs.refine(source, fs.Face(blade.Shape.Faces[0]), 0.8)
        self.shown(expected.report)
        press_ok()
        self.assertEqual(refined.ToolFace, (blade, ["Face1"]))
        self.assertEqual(refined.FemMesh.NodeCount, expected.mesh.node_count)
