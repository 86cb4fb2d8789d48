# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command Crack, from the click on its button to the object in the document."""

import os
import tempfile
from unittest import mock

import FreeCAD
import FreeCADGui
import numpy as np
from PySide import QtCore

import femmesh_bridge
import femscalpel as fs
import ObjectsFemScalpel
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from .mesh_content import content_of
from femscalpeltest.meshes import grid_box


def long_box(parts=1):
    """A box 14 x 5 x 4 of bricks of 1 / parts, cut into tetrahedra, with overlapping groups."""
    plain = grid_box((14 * parts, 5 * parts, 4 * parts), (14.0, 5.0, 4.0))
    node_ids, cell_ids = 10 * np.arange(1, plain.node_count + 1) + 7, 3 * np.arange(1, plain.cell_count + 1) + 100
    middle = plain.points[plain.cells["tetra"]].mean(axis=1)
    groups = {
        "LEFT": ("element", cell_ids[middle[:, 0] < 5]),
        "RIGHT": ("element", cell_ids[middle[:, 0] > 5]),
        "CORE": ("element", cell_ids[abs(middle[:, 1] - 2.5) < 1.5]),
        "FIX": ("node", node_ids[plain.points[:, 0] == 0]),
        "TOP": ("node", node_ids[plain.points[:, 2] == 4]),
    }
    return fs.Mesh(plain.points, plain.cells, node_ids, {"tetra": cell_ids}, groups)


def enter_plane(origin, normal):
    for name, number in zip(("originX", "originY", "originZ", "normalX", "normalY", "normalZ"), (*origin, *normal)):
        type_into(name, repr(number))


def traces(doc):
    """Everything a cancelled command must leave as it was."""
    gui = FreeCADGui.getDocument(doc.Name)
    return (
        [(o.Name, o.ViewObject.Visibility, o.ViewObject.SwitchNode.whichChild.getValue()) for o in doc.Objects],
        doc.UndoNames,
        doc.RedoNames,
        gui.Modified,
        view().getSceneGraph().getNumChildren(),
        gui.getInEdit(),
        [s.ObjectName for s in FreeCADGui.Selection.getSelectionEx()],
    )


class CrackTest(GuiTest):
    """A box with groups, and the panel open on it when asked."""

    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(long_box())

    def open_panel(self):
        """The panel, for the whole plane."""
        self.run_command("FemScalpel_Crack")
        choose("patch", "Whole")
        self.wait_for_preview()


class CrackCommand(CrackTest):
    def test_typed_plane_becomes_an_object(self):
        self.open_panel()
        enter_plane((7.3, 2.5, 2.0), (1.0, 0.2, 0.1))
        self.wait_for_preview()
        wait_until(lambda: faces_drawn("FemScalpelBand") > 0, "the changed part")
        expected = fs.crack(femmesh_bridge.from_femmesh(self.mesh.FemMesh), fs.Plane((7.3, 2.5, 2.0), (1.0, 0.2, 0.1)))
        wait_until(
            lambda: widget("status").text().startswith(f"{expected.report.nodes_moved} "), "the typed plane's preview"
        )
        self.assertGreater(faces_drawn("FemScalpelRest"), 0)
        self.assertGreater(faces_drawn("FemScalpelGhost"), 0)
        self.assertGreater(lines_drawn("FemScalpelOutline"), 0)
        self.assertEqual(moved_drawn(), expected.report.nodes_moved)
        self.assertEqual(lines_drawn("FemScalpelWorst"), 6)
        names = [widget("groups").item(row, 0).text() for row in range(widget("groups").rowCount())]
        self.assertCountEqual(names, [g.name for g in expected.report.groups])
        np.testing.assert_array_equal(widget("histogram").after, expected.report.quality.after.histogram)
        screenshot("crack_1_preview")
        press_ok()
        (crack,) = (o for o in self.doc.Objects if o != self.mesh)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertIsNone(in_scene("FemScalpelPreview"))
        self.assertEqual(crack.Source, self.mesh)
        self.assertEqual(crack.NodesDoubled, expected.report.nodes_doubled)
        self.assertFalse(self.mesh.ViewObject.Visibility)
        self.assertTrue(crack.ViewObject.Visibility)
        screenshot("crack_2_made")
        made = content_of(crack)

        self.assertEqual(self.doc.UndoNames, ["Crack"])
        self.doc.undo()
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.assertTrue(self.mesh.ViewObject.Visibility)
        self.doc.redo()
        self.assertEqual(content_of(self.doc.Crack), made)

    def test_edited_by_double_click(self):
        crack = ObjectsFemScalpel.makeCrack(
            self.doc, self.mesh, origin=(2.9, 2.5, 2), normal=(1, 0, 0), group_name="FIRST"
        )
        self.doc.recompute()
        self.doc.clearUndos()
        before = content_of(crack)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(FreeCADGui.ActiveDocument.getInEdit().Object.Name, crack.Name)
        self.assertEqual(widget("groupName").text(), "FIRST")
        self.assertAlmostEqual(value("originX"), 2.9)
        type_into("offset", "-0.5")
        type_into("groupName", "SECOND")
        self.wait_for_preview()
        press_ok()
        self.assertIsNone(FreeCADGui.ActiveDocument.getInEdit())
        self.assertAlmostEqual(crack.PlanePlacement.Base.x, 2.4)
        self.assertEqual(crack.GroupName, "SECOND")
        after = content_of(crack)
        self.assertNotEqual(after, before)
        self.assertEqual(len(self.doc.UndoNames), 1)
        self.doc.undo()
        self.assertEqual(crack.GroupName, "FIRST")
        self.assertEqual(content_of(crack), before)
        self.doc.redo()
        self.assertEqual(content_of(crack), after)

    def test_edit_cancelled(self):
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(2.9, 2.5, 2), normal=(1, 0, 0))
        self.doc.recompute()
        before, mesh = traces(self.doc), content_of(crack)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        type_into("offset", "0.7")
        self.wait_for_preview()
        press_cancel()
        spin(0.1)
        self.assertEqual(traces(self.doc), before)
        self.assertEqual(content_of(crack), mesh)

    def test_cancel_leaves_no_trace(self):
        before = traces(self.doc)
        self.open_panel()
        enter_plane((2.2, 2.5, 2.0), (1.0, 0.5, 0.1))
        click("pickNodes")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh", "Node17")
        press_cancel()  # ends picking
        press_cancel()
        spin(0.1)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(traces(self.doc), before)

    def test_escape_cancels(self):
        before = traces(self.doc)
        self.open_panel()
        QTest.keyClick(widget("groupName"), QtCore.Qt.Key_Escape)
        spin(0.2)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(traces(self.doc), before)
        self.open_panel()
        canvas().setFocus()
        QTest.keyClick(canvas(), QtCore.Qt.Key_Escape)
        spin(0.2)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(traces(self.doc), before)

    def test_saved_and_loaded(self):
        self.open_panel()
        enter_plane((2.9, 2.5, 2.0), (1.0, 0.2, 0.1))
        self.wait_for_preview()
        press_ok()
        counts = self.doc.Crack.FemMesh.NodeCount, self.doc.Crack.FemMesh.VolumeCount
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "crack.FCStd")
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            self.doc = FreeCAD.openDocument(path)
        crack = self.doc.Crack
        self.assertEqual((crack.FemMesh.NodeCount, crack.FemMesh.VolumeCount), counts)
        self.look()
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertAlmostEqual(value("normalX"), 0.98)
        press_cancel()

    def test_view_choices(self):
        self.open_panel()
        enter_plane((2.9, 2.5, 2.0), (1.0, 0.2, 0.1))
        self.wait_for_preview()
        wait_until(lambda: faces_drawn("FemScalpelGhost"), "the preview")
        halves = faces_drawn("FemScalpelRest")
        choose("look", "whole")
        self.assertGreater(faces_drawn("FemScalpelRest"), halves)
        screenshot("crack_whole")
        choose("colouring", "groups")
        screenshot("crack_by_group")
        choose("look", "changed part only")
        self.assertEqual([s.whichChild.getValue() for s in shapes_in("FemScalpelRest", coin.SoSwitch)][0], -1)
        screenshot("crack_changed_part")
        click("moved")
        self.assertEqual([s.whichChild.getValue() for s in shapes_in("FemScalpelMoved", coin.SoSwitch)][0], -1)
        choose("look", "cut away")
        click_row("groups", "TOP")
        # All of it, not the part near the crack alone; its doubled nodes on both sides.
        top = len(
            fs.crack(
                femmesh_bridge.from_femmesh(self.mesh.FemMesh), fs.Plane((2.9, 2.5, 2.0), (1.0, 0.2, 0.1))
            ).mesh.groups["TOP"]
        )
        self.assertEqual(points_drawn("FemScalpelHighlightPoints"), top)
        screenshot("crack_group_lit")
        click_row("groups", "CRACK_N")
        self.assertEqual(
            [s.whichChild.getValue() for s in shapes_in("FemScalpelHighlightPoints", coin.SoSwitch)][0], -1
        )
        self.assertGreater(faces_drawn("FemScalpelHighlight"), 0)

    def test_put_into_analysis(self):
        import ObjectsFem

        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        analysis.addObject(self.mesh)
        self.doc.recompute()
        self.doc.clearUndos()
        self.open_panel()
        self.assertTrue(widget("intoAnalysis").isChecked())
        enter_plane((2.9, 2.5, 2.0), (1.0, 0.2, 0.1))
        press_ok()
        self.assertIn(self.doc.Crack, analysis.Group)
        self.assertNotIn(self.mesh, analysis.Group)
        self.doc.undo()
        self.assertEqual(analysis.Group, [self.mesh])


class CrackPicks(CrackTest):
    """The plane from the 3-D view, and from its handles."""

    def setUp(self):
        super().setUp()
        self.part = self.doc.addObject("Part::Box", "Box")
        self.part.Length, self.part.Width, self.part.Height = 14, 5, 4
        self.part.ViewObject.Transparency = 60
        self.doc.recompute()

    def pick(self, *names, obj=None, point=(0, 0, 0)):
        for name in names:
            FreeCADGui.Selection.addSelection(self.doc.Name, (obj or self.mesh).Name, name, *point)
            spin(0.02)

    def assert_plane(self, origin, normal):
        np.testing.assert_allclose([value("originX"), value("originY"), value("originZ")], origin, atol=0.006)
        np.testing.assert_allclose([value("normalX"), value("normalY"), value("normalZ")], normal, atol=0.006)
        spin(0.02)
        self.assertFalse(widget("pickNodes").isChecked() or widget("pickGeometry").isChecked())
        self.assertEqual(FreeCADGui.Selection.getSelectionEx(), [])

    def numbers_at(self, *points):
        nodes = {tuple(p): n for n, p in self.mesh.FemMesh.Nodes.items()}
        return [f"Node{nodes[p]}" for p in points]

    def test_three_nodes(self):
        self.open_panel()
        click("pickNodes")
        self.assertIn("1", widget("hint").text())
        first, second, third = self.numbers_at((2.0, 0.0, 0.0), (3.0, 5.0, 0.0), (2.0, 0.0, 4.0))
        self.pick(first)
        self.assertIn("2", widget("hint").text())
        screenshot("crack_pick_nodes")
        self.pick(second, third)
        self.assert_plane((2, 0, 0), np.array([5, -1, 0]) / np.sqrt(26))
        self.wait_for_preview()

    def test_three_nodes_on_a_line(self):
        self.open_panel()
        click("pickNodes")
        self.pick(*self.numbers_at((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)))
        self.assertIn("on a line", widget("hint").text())
        spin(0.05)
        self.pick(*self.numbers_at((2.0, 0.0, 0.0), (2.0, 5.0, 0.0), (2.0, 0.0, 4.0)))
        self.assert_plane((2, 0, 0), (1, 0, 0))

    def test_mouse_clicks_on_the_mesh(self):
        self.part.ViewObject.Visibility = False
        self.open_panel()
        click("pickNodes")
        for point in ((3.04, 0.02, 4.0), (3.04, 4.96, 4.0), (3.0, 0.0, 2.03)):
            click_at(point)
        self.assert_plane((3, 0, 4), (1, 0, 0) if value("normalX") > 0 else (-1, 0, 0))
        self.wait_for_preview()
        screenshot("crack_clicked_nodes")

    def test_escape_ends_picking_then_the_panel(self):
        before = traces(self.doc)
        self.open_panel()
        for place in (canvas(), widget("originX")):
            for button in ("pickNodes", "pickGeometry"):
                with self.subTest(button=button, place=place.objectName()):
                    click(button)
                    self.assertTrue(widget("hint").isVisible())
                    place.setFocus()
                    QTest.keyClick(place, QtCore.Qt.Key_Escape)
                    spin(0.2)
                    self.assertTrue(FreeCADGui.Control.activeDialog())
                    self.assertFalse(widget(button).isChecked())
                    self.assertFalse(is_shown("hint"))
        QTest.keyClick(canvas(), QtCore.Qt.Key_Escape)
        spin(0.2)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(traces(self.doc), before)

    def test_mouse_click_on_a_face(self):
        self.open_panel()
        click("pickGeometry")
        click_at((3, 2.5, 4.0))  # on the box's top, which covers the mesh's
        self.assertEqual(abs(value("normalZ")), 1)

    def test_geometry(self):
        sketch = self.doc.addObject("Sketcher::SketchObject", "Sketch")
        sketch.Placement = FreeCAD.Placement(FreeCAD.Vector(1, 2, 3), FreeCAD.Rotation(FreeCAD.Vector(0, 1, 0), 90))
        body = self.doc.addObject("PartDesign::Body", "Body")
        body.Placement = FreeCAD.Placement(FreeCAD.Vector(3, 0, 0), FreeCAD.Rotation())
        plane = body.newObject("PartDesign::Plane", "DatumPlane")
        plane.Placement.Rotation = FreeCAD.Rotation(FreeCAD.Vector(1, 0, 0), 90)
        line = body.newObject("PartDesign::Line", "DatumLine")
        self.doc.recompute()
        self.open_panel()
        for obj, name, origin, normal in (
            (self.part, "Face2", (14, 2.5, 2), (1, 0, 0)),
            (self.part, "Edge3", (0, 5, 2), (0, 0, 1)),
            (sketch, "", (1, 2, 3), (1, 0, 0)),
            (plane, "", (3, 0, 0), (0, -1, 0)),
            (line, "", (3, 0, 0), (0, 0, 1)),
        ):
            with self.subTest(picked=f"{obj.Name}.{name}"):
                click("pickGeometry")
                self.pick(name, obj=obj)
                np.testing.assert_allclose([value("originX"), value("originY"), value("originZ")], origin, atol=0.006)
                np.testing.assert_allclose(
                    np.abs([value("normalX"), value("normalY"), value("normalZ")]), np.abs(normal), atol=0.006
                )
                spin(0.02)
        click("pickGeometry")
        nodes = self.mesh.FemMesh.Nodes
        element, top = next(
            (e, top)
            for e in self.mesh.FemMesh.Volumes
            for top in [[nodes[n] for n in self.mesh.FemMesh.getElementNodes(e) if nodes[n].z == 4]]
            if len(top) == 3
        )
        self.pick(f"Elem{element}F1", point=tuple((top[0] + top[1] + top[2]) / 3))
        self.assertAlmostEqual(abs(value("normalZ")), 1)

    def test_what_cannot_be_a_plane(self):
        self.doc.addObject("Part::Cylinder", "Cylinder")
        self.doc.recompute()
        self.open_panel()
        click("pickGeometry")
        self.pick("Face1", obj=self.doc.Cylinder)
        self.assertIn("curved", widget("hint").text())
        spin(0.05)
        self.pick("Vertex1", obj=self.doc.Cylinder)
        self.assertIn("planar face", widget("hint").text())
        screenshot("crack_pick_curved")

    def test_view_direction_offset_flip_centre(self):
        self.open_panel()
        view().viewFront()
        click("pickView")
        np.testing.assert_allclose([value("normalX"), value("normalY"), value("normalZ")], (0, -1, 0), atol=0.006)
        type_into("offset", "1 mm")
        click("flip")
        np.testing.assert_allclose([value("originX"), value("originY"), value("originZ")], (7, 1.5, 2), atol=0.006)
        np.testing.assert_allclose([value("normalX"), value("normalY"), value("normalZ")], (0, 1, 0), atol=0.006)
        click("centre")
        self.assertAlmostEqual(value("originY"), 2.5)

    def test_units(self):
        self.open_panel()
        type_into("originX", "0.25 cm")
        self.assertAlmostEqual(value("originX"), 2.5)

    def test_handles(self):
        self.part.ViewObject.Visibility = False
        self.open_panel()
        tip = 60 * pixel()
        drag((7 + tip, 2.5, 2), (8 + tip, 2.5, 2))
        self.assertAlmostEqual(value("originX"), 8, delta=0.15)
        np.testing.assert_allclose([value("originY"), value("originZ"), value("normalX")], (2.5, 2, 1), atol=0.006)
        self.wait_for_preview()
        screenshot("crack_dragged")
        before = value("normalX"), value("normalY"), value("normalZ")
        centre, radius = np.array([value("originX"), 2.5, 2]), 32 * pixel()
        drag(centre, centre + (0, 0, radius * 0.6))
        self.assertGreater(
            np.linalg.norm(np.subtract((value("normalX"), value("normalY"), value("normalZ")), before)), 0.05
        )
        self.assertAlmostEqual(np.linalg.norm([value("normalX"), value("normalY"), value("normalZ")]), 1, delta=0.01)
        self.assertAlmostEqual(value("originX"), centre[0], delta=0.01)
        wait_until(lambda: is_shown("status"), "the panel")
        screenshot("crack_tilted")


class CrackMessages(CrackTest):
    """What the panel and the command say when something is wrong."""

    def test_at_the_field(self):
        self.open_panel()
        type_into("groupName", "NO GOOD")
        self.assertIn("character", self.wait_for_message("nameError"))
        screenshot("crack_bad_name")
        type_into("groupName", "A" * 30)
        wait_until(lambda: is_shown("nameError") and "too long" in widget("nameError").text(), "the message")
        type_into("groupName", "CRACK")
        wait_until(lambda: not is_shown("nameError"), "the message to go")
        type_into("originX", "50")
        self.assertIn("misses the mesh", self.wait_for_message("geometryError"))
        screenshot("crack_beside_the_part")
        press_ok()
        self.assertTrue(FreeCADGui.Control.activeDialog())
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.assertEqual(self.doc.UndoNames, [])
        for name in ("normalX", "normalY", "normalZ"):
            type_into(name, "0")
        self.assertIn("direction is zero", self.wait_for_message("geometryError"))
        press_ok()
        self.assertTrue(FreeCADGui.Control.activeDialog())

    def test_name_taken(self):
        femmesh = self.mesh.FemMesh.copy()
        femmesh.addGroupElements(femmesh.addGroup("OTHER_N", "Node"), [list(femmesh.Nodes)[0]])
        self.mesh.FemMesh = femmesh
        self.open_panel()
        type_into("groupName", "OTHER")
        self.assertIn("taken", self.wait_for_message("nameError"))

    def test_placed_by_the_parameter_and_not_by_the_words(self):
        self.open_panel()
        labels = ("nameError", "methodError", "refineError", "geometryError", "resultError")
        for number, (kind, parameter, label) in enumerate(
            (
                (fs.ToolError, "name", "nameError"),
                (fs.ToolError, "method", "methodError"),
                (fs.ToolError, "transition", "methodError"),
                (ValueError, "feature_angle", "methodError"),
                (ValueError, "refine", "refineError"),
                (fs.QualityError, "refine", "refineError"),
                (fs.QualityError, None, "methodError"),
                (fs.ToolError, "within", "geometryError"),
                (fs.ToolError, None, "geometryError"),
                (fs.UnsupportedElementError, None, "geometryError"),
                (ValueError, None, "resultError"),
            )
        ):
            error = kind(f"refine, name or method? number {number}")
            if parameter and kind is ValueError:
                error.parameter = parameter
            elif parameter:
                error._parameter = parameter  # as the engine's errors have it
            with self.subTest(kind=kind, parameter=parameter):
                with mock.patch.object(fs.Scalpel, "crack", side_effect=error):
                    type_into("originX", f"{5 + number / 10}")
                    wait_until(lambda: is_shown(label) and f"number {number}" in widget(label).text(), "the message")
                self.assertEqual([name for name in labels if is_shown(name)], [label])

    def test_options_out_of_range(self):
        self.open_panel()
        type_into("featureAngle", "0 deg")
        self.assertIn("“Sharp edges from” must be between 0", self.wait_for_message("methodError"))
        type_into("featureAngle", "30 deg")
        wait_until(lambda: not is_shown("methodError"), "the message to go")
        choose("refine", "Size")
        type_into("refineSize", "0 mm")
        self.assertIn("positive length", self.wait_for_message("refineError"))

    def test_deform_in_vain(self):
        self.open_panel()
        enter_plane((2.9, 2.5, 2.0), (1.0, 0.9, 0.8))
        choose("method", "deform")
        wait_until(lambda: is_shown("methodError") or "moved" in widget("status").text(), "an outcome")

    def test_inactive_while_a_panel_is_open(self):
        self.open_panel()
        self.assertFalse(FreeCADGui.Command.get("FemScalpel_Crack").isActive())
