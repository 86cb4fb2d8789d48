# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands that add material, round edges and move walls."""

import unittest

import FreeCAD
import FreeCADGui
import numpy as np

import femmesh_bridge
import femscalpel as fs
from femscalpelgui import preferences
from femscalpelgui.view import wall
from femscalpelgui.view.preview_data import PreviewSource
from femscalpeltest.meshes import grid_box
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .mesh_content import content_of
from .test_crack_panel import long_box, traces


def place(x, y, z):
    return FreeCAD.Placement(FreeCAD.Vector(x, y, z), FreeCAD.Rotation())


class MaterialTest(GuiTest):
    PARTS = 1

    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(self.source())

    def source(self):
        return long_box(self.PARTS)

    def open_panel(self, name):
        self.run_command(name)
        wait_until(is_ready, "the panel")

    def shown(self, report):
        """Waits for the preview of what a report tells."""
        start = f"{report.nodes_moved} nodes moved, {report.nodes_added} added; {report.elements_added} elements added"
        wait_until(lambda: widget("status").text().startswith(start), "the preview")

    def made(self, name):
        """The object that OK has made, by itself, undone and redone."""
        press_ok()
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertIsNone(in_scene("FemScalpelPreview"))
        obj = self.doc.getObject(name)
        content = content_of(obj)
        self.assertEqual(len(self.doc.UndoNames), 1)
        self.doc.undo()
        self.assertIsNone(self.doc.getObject(name))
        self.doc.redo()
        obj = self.doc.getObject(name)
        self.assertEqual(content_of(obj), content)
        return obj

    def groups_listed(self):
        return [widget("groups").item(row, 0).text() for row in range(widget("groups").rowCount())]


class Merge(MaterialTest):
    def setUp(self):
        super().setUp()
        self.boss = grid_box((3, 3, 2), (3.0, 3.0, 2.0))
        self.addition = self.add_mesh(self.boss, "Boss")
        self.addition.Placement = place(5.2, 1.1, 4)
        self.doc.recompute()
        self.doc.clearUndos()
        self.look()

    def expected(self, shift=(5.2, 1.1, 4), **options):
        boss = fs.Mesh(self.boss.points + shift, self.boss.cells)
        return fs.merge(femmesh_bridge.from_femmesh(self.mesh.FemMesh), boss, **options)

    def select(self, *names):
        FreeCADGui.Selection.clearSelection()
        for name in names:
            FreeCADGui.Selection.addSelection(self.doc.Name, name)

    def test_made_edited_undone(self):
        self.select("Mesh", "Boss")
        self.open_panel("FemScalpel_Merge")
        expected = self.expected()
        self.shown(expected.report)
        self.assertEqual(widget("addition").currentData(), "Boss")
        self.assertIn("ADD_SEAM", self.groups_listed())
        self.assertGreater(lines_drawn("FemScalpelOutline"), 10)
        self.assertGreater(faces_drawn("FemScalpelBand"), 0)
        screenshot("merge_1_preview")
        merge = self.made("Merge")
        screenshot("merge_2_made")
        self.assertEqual((merge.Source, merge.Addition), (self.mesh, self.addition))
        self.assertEqual(merge.FemMesh.NodeCount, expected.mesh.node_count)
        self.assertFalse(self.mesh.ViewObject.Visibility or self.addition.ViewObject.Visibility)
        self.addition.Placement = place(5.2, 1.1, 3)
        self.doc.recompute()
        self.doc.clearUndos()
        merge.ViewObject.doubleClicked()
        self.shown(self.expected((5.2, 1.1, 3)).report)
        choose("keep", "addition")
        type_into("mergeTolerance", "0.02 mm")
        type_into("groupName", "BOSS")
        self.shown(self.expected((5.2, 1.1, 3), keep="addition", tolerance=0.02, name="BOSS").report)
        wait_until(lambda: "BOSS_SEAM" in self.groups_listed(), "the new name")
        screenshot("merge_overlap")
        press_ok()
        self.assertEqual((merge.Keep, merge.Tolerance.Value, merge.GroupName), ("addition", 0.02, "BOSS"))
        self.doc.undo()
        self.assertEqual((merge.Keep, merge.Tolerance.Value, merge.GroupName), ("mesh", 0, "ADD"))
        self.assertEqual(merge.FemMesh.NodeCount, self.expected((5.2, 1.1, 3)).mesh.node_count)

    def test_moved_while_the_panel_is_open(self):
        self.select("Mesh")
        self.open_panel("FemScalpel_Merge")
        self.shown(self.expected().report)
        self.addition.Placement = place(7.3, 1.2, 4)
        self.shown(self.expected((7.3, 1.2, 4)).report)
        self.addition.Placement = place(7.3, 1.2, 9)
        self.assertIn("does not meet", self.wait_for_message("geometryError"))
        self.assertGreater(faces_drawn("FemScalpelGhost"), 0, "the addition is not shown")
        screenshot("merge_beside")
        press_ok()
        self.assertTrue(FreeCADGui.Control.activeDialog(), "closed although nothing could be made")
        press_cancel()
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh", "Boss"])

    def test_chosen_from_several(self):
        other = self.add_mesh(grid_box((2, 2, 1), (2.0, 2.0, 1.0)), "Pad")
        other.Placement = place(1.1, 1.3, 4)
        self.doc.recompute()
        self.doc.clearUndos()
        self.select("Mesh")
        before = traces(self.doc)
        self.open_panel("FemScalpel_Merge")
        self.assertIn("Choose the mesh to add", self.wait_for_message("geometryError"))
        screenshot("merge_choose")
        click("pickAddition")
        self.assertTrue(is_shown("hint"))
        FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
        spin(0.1)
        self.assertIn("Mesh cannot be added", widget("hint").text())
        click_at((6.5, 2.5, 6))
        self.assertEqual(widget("addition").currentData(), "Boss")
        self.assertFalse(is_shown("hint"))
        self.shown(self.expected().report)
        choose("addition", "Pad")
        self.wait_for_preview()
        press_cancel()
        self.select("Mesh")
        self.assertEqual(traces(self.doc), before)

    def test_refined_where_they_meet(self):
        self.addCleanup(FreeCAD.ParamGet(preferences.GROUP).RemInt, "MostElements")
        FreeCAD.ParamGet(preferences.GROUP).SetInt("MostElements", 6000)
        self.select("Mesh", "Boss")
        self.open_panel("FemScalpel_Merge")
        self.wait_for_preview()
        choose("refine", "Size")
        type_into("refineSize", "0.04 mm")
        wait_until(lambda: widget("refinementQuestion").isEnabled(), "the question")
        self.assertIn("40.00", widget("refinementCost").text())
        screenshot("merge_refinement_question")
        click("refineFitting")
        self.wait_for_preview()
        self.assertGreater(value("refineSize"), 0.04)
        type_into("refineSize", "0.5 mm")
        expected = self.expected(refine=0.5)
        self.assertGreater(expected.mesh.cell_count, 2 * self.expected(refine=False).mesh.cell_count)
        self.shown(expected.report)
        merge = self.made("Merge")
        self.assertEqual((merge.Refine, merge.RefineSize.Value), ("Size", 0.5))
        self.assertEqual(merge.FemMesh.NodeCount, expected.mesh.node_count)
        merge.ViewObject.doubleClicked()
        self.shown(expected.report)
        choose("refine", "Never")
        self.shown(self.expected(refine=False).report)
        press_ok()
        self.assertEqual(merge.Refine, "Never")
        self.assertEqual(merge.FemMesh.NodeCount, self.expected(refine=False).mesh.node_count)

    def test_messages_at_their_fields(self):
        self.select("Mesh", "Boss")
        self.open_panel("FemScalpel_Merge")
        self.wait_for_preview()
        type_into("mergeTolerance", "-1 mm")
        self.assertIn("Tolerance must be", self.wait_for_message("toleranceError"))
        type_into("mergeTolerance", "0 mm")
        self.wait_for_preview()
        self.assertFalse(is_shown("toleranceError"))
        type_into("groupName", "A name that is longer than any deck allows")
        self.wait_for_message("nameError")
        press_cancel()

    def test_nothing_to_add(self):
        self.doc.removeObject("Boss")
        self.open_panel("FemScalpel_Merge")
        self.assertIn("no other FEM mesh", self.wait_for_message("geometryError"))
        press_cancel()


class Fillet(MaterialTest):
    PARTS = 2

    def source(self):
        mesh = super().source()
        for group in list(mesh.groups.all()):  # an edge between groups is not rounded
            mesh.remove_group(group.name, group.kind)
        points = mesh.points
        mesh.add_group("SPOT", "node", mesh.node_ids[(points == (7, 2.5, 4)).all(axis=1)])
        mesh.add_group("EDGE", "node", mesh.node_ids[(points[:, 0] == 14) & (points[:, 2] == 4)])
        return mesh

    def test_picked_made_edited(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        self.open_panel("FemScalpel_Fillet")
        self.assertIn("Press Pick", self.wait_for_message("geometryError"))
        self.assertFalse(is_shown("stays"))
        screenshot("fillet_empty")
        self.assertAlmostEqual(value("filletRadius"), 1)
        click("pickEdge")
        self.assertIn("near the edge", widget("hint").text())
        click_at((7, 0.1, 4))
        self.assertFalse(is_shown("hint"))
        self.shown(fs.fillet(source, [(7, 0, 4)], 1).report)
        self.assertEqual(points_drawn("FemScalpelPicked"), 1)
        self.assertGreater(lines_drawn("FemScalpelOutline"), 10)
        self.assertIn("FILLET_FACE", self.groups_listed())
        self.assertIn("A group goes with the mesh", widget("stays").text())
        screenshot("fillet_1_preview")
        type_into("filletRadius", "0.8 mm")
        expected = fs.fillet(source, [(7, 0, 4)], 0.8)
        self.shown(expected.report)
        fillet = self.made("Fillet")
        screenshot("fillet_2_made")
        self.assertEqual(fillet.FemMesh.NodeCount, expected.mesh.node_count)
        self.assertEqual((len(fillet.AlongPoints), fillet.Along, fillet.Radius.Value), (1, "", 0.8))
        self.doc.clearUndos()
        fillet.ViewObject.doubleClicked()
        self.shown(expected.report)
        self.assertIn("1 picked place", widget("edge").currentText())
        choose("edge", "EDGE")
        self.shown(fs.fillet(source, "EDGE", 0.8).report)
        self.assertFalse(is_shown("stays"))
        screenshot("fillet_group")
        press_ok()
        self.assertEqual((fillet.AlongPoints, fillet.Along), ([], "EDGE"))
        self.doc.undo()
        self.assertEqual(fillet.FemMesh.NodeCount, expected.mesh.node_count)

    def test_two_edges_cleared_cancelled(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        before = traces(self.doc)
        self.open_panel("FemScalpel_Fillet")
        for node in ((7.0, 0.0, 4.0), (7.0, 5.0, 4.0)):
            number = next(n for n, p in self.mesh.FemMesh.Nodes.items() if tuple(p) == node)
            click("pickEdge")
            FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh", f"Node{number}")
            spin(0.1)
        self.shown(fs.fillet(source, [(7, 0, 4), (7, 5, 4)], 1).report)
        self.assertIn("2 picked places", widget("edge").currentText())
        click("clearEdges")
        self.assertIn("Press Pick", self.wait_for_message("geometryError"))
        self.assertFalse(widget("clearEdges").isEnabled())
        click("pickEdge")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
        spin(0.1)
        self.assertIn("Click the mesh itself", widget("hint").text())
        press_cancel()  # ends picking
        press_cancel()
        self.assertEqual(traces(self.doc), before)

    def test_messages_at_their_fields(self):
        self.open_panel("FemScalpel_Fillet")
        choose("edge", "EDGE")
        self.wait_for_preview()
        type_into("filletRadius", "9 mm")
        self.assertIn("too large", self.wait_for_message("radiusError"))
        screenshot("fillet_too_large")
        type_into("filletRadius", "0.5 mm")
        self.wait_for_preview()
        self.assertFalse(is_shown("radiusError"))
        choose("edge", "SPOT")
        self.assertIn("SPOT", self.wait_for_message("geometryError"))
        press_ok()
        self.assertTrue(FreeCADGui.Control.activeDialog(), "closed although nothing could be made")
        press_cancel()
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])


class Reshape(MaterialTest):
    PARTS = 2

    def source(self):
        return fs.drill(long_box(2), fs.Cylinder((7.0, 2.5, 0), (0, 0, 1), 1.0)).mesh

    def test_hole_made_edited(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        self.open_panel("FemScalpel_Reshape")
        choose("wall", "HOLE_WALL")
        # The cylinder it lies on.
        self.assertEqual(widget("onto").currentData(), "Cylinder")
        np.testing.assert_allclose(
            [value(n) for n in ("originX", "originY", "normalX", "normalY", "normalZ", "radius")],
            (7, 2.5, 0, 0, 1, 1),
            atol=0.006,
        )
        type_into("radius", "1.4 mm")
        expected = fs.reshape(source, "HOLE_WALL", onto=fs.Cylinder((7, 2.5, 2), (0, 0, 1), 1.4))
        self.shown(expected.report)
        self.assertGreater(lines_drawn("FemScalpelOutline"), 10)
        self.assertIn("SHAPE_WALL", self.groups_listed())
        screenshot("reshape_1_preview")
        reshape = self.made("Reshape")
        screenshot("reshape_2_made")
        self.assertEqual(reshape.FemMesh.NodeCount, expected.mesh.node_count)
        self.assertEqual((reshape.Group, reshape.Motion, reshape.ToolShape), ("HOLE_WALL", "Onto", "Cylinder"))
        self.doc.clearUndos()
        reshape.ViewObject.doubleClicked()
        self.shown(expected.report)
        self.assertAlmostEqual(value("radius"), 1.4)
        choose("motion", "Scale")
        self.assertFalse(is_shown("radius"))
        type_into("scaleFactor", "0.8")
        for name, text in (("vectorX", "7 mm"), ("vectorY", "2.5 mm"), ("vectorZ", "2 mm")):
            type_into(name, text)
        scaled = fs.reshape(source, "HOLE_WALL", scale=(0.8, (7, 2.5, 2)))
        self.shown(scaled.report)
        screenshot("reshape_scale")
        press_ok()
        self.assertEqual((reshape.Motion, reshape.ScaleFactor), ("Scale", 0.8))
        self.assertEqual(reshape.FemMesh.NodeCount, scaled.mesh.node_count)
        self.doc.undo()
        self.assertEqual((reshape.Motion, reshape.FemMesh.NodeCount), ("Onto", expected.mesh.node_count))

    def test_face_picked_and_moved_by_a_vector(self):
        source = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        before = traces(self.doc)
        self.open_panel("FemScalpel_Reshape")
        click("pickWall")
        self.assertTrue(is_shown("pickHint"))
        click_at((3, 2.5, 4))
        self.assertEqual(widget("wall").currentData(), "TOP")
        self.assertFalse(is_shown("pickHint"))
        self.assertEqual(widget("onto").currentData(), "Plane")
        choose("motion", "By")
        type_into("vectorZ", "0.4 mm")
        self.shown(fs.reshape(source, "TOP", by=(0, 0, 0.4)).report)
        self.assertEqual(value("vectorX"), 0)
        screenshot("reshape_vector")
        choose("motion", "Onto")
        for name, text in (("originX", "3"), ("normalX", "1"), ("normalZ", "0")):
            type_into(name, text)
        self.assertTrue(self.wait_for_message("geometryError"))
        choose("motion", "By")
        self.assertAlmostEqual(value("vectorZ"), 0.4)
        self.wait_for_preview()
        click("pickWall")
        click_at((14, 2.5, 2))
        self.assertIn("in no group", widget("pickHint").text())
        press_cancel()  # ends picking
        press_cancel()
        self.assertEqual(traces(self.doc), before)

    def fields_shown(self):
        names = ("originX", "normalX", "radius", "pickNodes", "pickGeometry", "pickView")
        return {name for name in names if is_shown(name)}

    def test_controls_are_those_of_the_surface(self):
        self.open_panel("FemScalpel_Reshape")
        always = {"originX", "pickNodes", "pickGeometry"}
        for surface, nodes, others in (
            ("Plane", "3 nodes", {"normalX", "pickView"}),
            ("Cylinder", "2 nodes", {"normalX", "pickView", "radius"}),
            ("Sphere", "1 node", {"radius"}),
        ):
            choose("onto", surface)
            self.assertEqual(self.fields_shown(), always | others, surface)
            self.assertEqual(widget("pickNodes").text(), nodes)
            if "normalX" in others:
                self.assertEqual(widget("label8").text(), "Normal" if surface == "Plane" else "Axis")
            (points,) = [p for p in [in_scene("FemScalpelWall")] if p]
            points = np.array([p.getValue() for p in points.point.getValues()])
            flat = np.ptp(points[:, 2]) < 1e-6
            self.assertEqual(flat, surface == "Plane")
            screenshot(f"reshape_onto_{surface}")

    def test_a_plane_by_three_nodes(self):
        self.open_panel("FemScalpel_Reshape")
        choose("wall", "TOP")
        self.assertEqual(widget("onto").currentData(), "Plane")
        click("pickNodes")
        self.assertIn("node 1 of 3", widget("hint").text())
        for place in ((0, 0, 4), (0, 5, 4), (14, 0, 4)):
            click_at(place)
        self.assertEqual([value(n) for n in ("normalX", "normalY")], [0, 0])
        self.assertAlmostEqual(abs(value("normalZ")), 1)

    def test_nothing_is_asked_for_at_first(self):
        self.open_panel("FemScalpel_Reshape")
        self.assertTrue(widget("status").text().startswith("Nothing is moved yet"))
        choose("wall", "TOP")
        for motion in ("Onto", "By"):
            choose("motion", motion)
            wait_until(is_settled, "what is said")
            self.assertTrue(widget("status").text().startswith("Nothing is moved yet"))
            self.assertFalse(is_shown("geometryError") or is_shown("resultError") or is_shown("groupError"))
            self.assertEqual(faces_drawn("FemScalpelBand"), 0)
        screenshot("reshape_nothing_yet")
        type_into("vectorZ", "0.1 mm")
        self.wait_for_preview()
        choose("motion", "Onto")
        wait_until(lambda: widget("status").text().startswith("Nothing is moved yet"), "nothing once more")


class ReshapeOfCracked(MaterialTest):
    PARTS = 2

    def source(self):
        mesh = fs.crack(long_box(2), fs.Plane((3.1, 2.5, 2), (1, 0.1, 0)), name="AHEAD").mesh
        first = [g for g in mesh.groups.all() if g.name.startswith("AHEAD")]
        others = [g for g in mesh.groups.all() if not g.name.startswith("AHEAD")]
        return fs.Mesh(mesh.points, mesh.cells, mesh.node_ids, mesh.cell_ids, first + others)

    def test_lips_are_not_the_first_wall(self):
        self.open_panel("FemScalpel_Reshape")
        box = widget("wall")
        names = [box.itemData(k) for k in range(box.count())]
        self.assertIn("AHEAD", wall.walls(femmesh_bridge.from_femmesh(self.mesh.FemMesh))[0])
        self.assertIn("AHEAD_P", names)
        self.assertNotIn("AHEAD", names[0])
        self.assertEqual(widget("onto").currentData(), "Plane")
        self.assertFalse(is_shown("geometryError"))
        screenshot("reshape_of_cracked")


class Walls(unittest.TestCase):
    def check(self, mesh, name, shape, origin, direction, radius=0.0):
        found = wall.fit(PreviewSource(mesh), name)
        self.assertEqual(found.shape, shape)
        np.testing.assert_allclose(found.direction, direction / np.linalg.norm(direction), atol=1e-9)
        off = found.origin - origin
        if shape == "Plane":
            off = off @ found.direction
        elif shape == "Cylinder":
            off = np.cross(off, found.direction)
        np.testing.assert_allclose(off, 0, atol=1e-9)
        self.assertAlmostEqual(found.radius, radius, places=9)

    def test_of_solids(self):
        box = grid_box((28, 10, 8), (14.0, 5.0, 4.0))
        for axis in ((0, 0, 1), (0.1, 0.2, 1), (0, 1, 0)):
            holed = fs.drill(box, fs.Cylinder((7, 2.5, 2), axis, 1)).mesh
            self.check(holed, "HOLE_WALL", "Cylinder", (7, 2.5, 2), axis, 1)
            self.assertEqual(wall.walls(holed), ["HOLE_WALL"])
        moved = holed.points.copy()
        at = np.flatnonzero(wall.nodes_of(holed, "HOLE_WALL"))[::7]
        moved[at] += 0.004 * (moved[at] - (7, 2.5, 2))  # as a few are that lie on the skin's triangles
        holed = fs.Mesh(moved, holed.cells, holed.node_ids, holed.cell_ids, holed.groups.all())
        self.check(holed, "HOLE_WALL", "Cylinder", (7, 2.5, 2), axis, 1)
        bowl = fs.drill(box, fs.Sphere((7, 2.5, 3.9), 1)).mesh
        self.check(bowl, "HOLE_WALL", "Sphere", (7, 2.5, 3.9), (0, 0, 1), 1)
        box.add_group("END", "node", box.node_ids[box.points[:, 0] == 14])
        box.add_group("BODY", "element", box.cell_ids["tetra"])
        box.add_group("TWO", "node", box.node_ids[(box.points[:, 0] == 14) | (box.points[:, 2] == 4)])
        self.assertEqual(wall.walls(box), ["END", "TWO"])
        self.check(box, "END", "Plane", (14, 0, 0), (1, 0, 0))
        self.assertIsNone(wall.fit(PreviewSource(box), "TWO"))
        self.assertEqual(wall.wall_at(PreviewSource(box), (14, 2, 2)), "END")
        self.assertEqual(wall.wall_at(PreviewSource(box), (7, 2, 4)), "TWO")
        self.assertIsNone(wall.wall_at(PreviewSource(box), (0, 2, 2)))

    def test_of_shells(self):
        x, y = (a.ravel() for a in np.meshgrid(np.linspace(0, 4, 9), np.linspace(0, 3, 7), indexing="ij"))
        corners = [(7 * i + j, 7 * i + j + 7, 7 * i + j + 8, 7 * i + j + 1) for i in range(8) for j in range(6)]
        triangles = [t for a, b, c, d in corners for t in ((a, b, c), (a, c, d))]
        plate = fs.Mesh(np.column_stack([x, y, 0 * x]), {"triangle": triangles})
        plate = fs.drill(plate, fs.Cylinder((2, 1.5, 0), (0, 0, 1), 0.7)).mesh
        plate.add_group("END", "node", plate.node_ids[plate.points[:, 0] == 4])
        self.assertEqual(wall.walls(plate), ["HOLE_WALL", "END"])
        self.check(plate, "HOLE_WALL", "Cylinder", (2, 1.5, 0), (0, 0, 1), 0.7)
        self.check(plate, "END", "Plane", (4, 0, 0), (1, 0, 0))
