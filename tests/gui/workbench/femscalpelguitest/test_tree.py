# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finished objects: in the tree, in their context menu, deleted, and their crack in the normal view."""

import os
import tempfile
import zipfile
from unittest import mock

import FreeCAD
import ObjectsFem
import ObjectsFemScalpel
from femscalpelobjects.base import MeshOperation
from femscalpeltest.documents import geometry_link
from .gui_testing import *  # noqa: F403
from .mesh_content import content_of
from .test_crack_panel import CrackTest


def actions_of(obj):
    """Texts and actions of an object's context menu."""
    menu = QtGui.QMenu()
    obj.ViewObject.Proxy.setupContextMenu(obj.ViewObject, menu)
    return menu, {action.text().replace("&", ""): action for action in menu.actions() if action.text()}


class TreeTest(CrackTest):
    def make(self, source, x, name):
        crack = ObjectsFemScalpel.makeCrack(self.doc, source, origin=(x, 2.5, 2), normal=(1, 0.1, 0), group_name=name)
        self.doc.recompute()
        return crack


class Tree(TreeTest):
    def test_sources_stand_under_their_result(self):
        crack = self.make(self.mesh, 2.9, "A")
        self.assertEqual(crack.ViewObject.claimChildren(), [self.mesh])

    def test_names_and_numbers(self):
        for command in 2 * ("FemScalpel_Crack", "FemScalpel_Incision"):
            FreeCADGui.Selection.clearSelection()
            FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
            with mock.patch.object(QtGui.QMessageBox, "question", return_value=QtGui.QMessageBox.No):
                self.run_command(command)
            self.wait_for_preview()
            press_ok()
        self.assertEqual([o.Label for o in self.doc.Objects], ["Mesh", "Crack", "Incision", "Crack 2", "Incision 2"])
        self.assertEqual(self.doc.UndoNames[0], "Incision")


class SavedWithoutWindow(TreeTest):
    """A document as freecadcmd saves it: without what a window knows of its objects."""

    def setUp(self):
        super().setUp()
        crack = self.make(self.mesh, 2.9, "A")
        ObjectsFemScalpel.makeDrill(self.doc, crack, origin=(7, 2.5, 2), axis=(0, 0, 1), radius=0.5)
        self.doc.recompute()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path, bare = (os.path.join(folder.name, name) for name in ("saved.FCStd", "bare.FCStd"))
        self.doc.saveAs(path)
        FreeCAD.closeDocument(self.doc.Name)
        with zipfile.ZipFile(path) as old, zipfile.ZipFile(bare, "w") as new:
            for name in old.namelist():
                if name != "GuiDocument.xml":
                    new.writestr(name, old.read(name))
        self.doc = FreeCAD.openDocument(bare)
        self.doc.UndoMode = 1
        self.mesh = self.doc.Mesh
        spin(0.2)

    def test_has_icons_and_panels(self):
        for obj, icon in ((self.doc.Crack, "FemScalpel_Crack"), (self.doc.Drill, "FemScalpel_Drill")):
            self.assertIn(icon + ".", obj.ViewObject.Proxy.getIcon())
            self.assertEqual(obj.ViewObject.claimChildren(), [obj.Source])
        screenshot("saved_without_window")
        self.assertEqual(self.doc.UndoNames, [])
        self.doc.Drill.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(value("radius"), 0.5)
        type_into("radius", "0.6")
        wait_until(is_settled, "the new hole")
        press_ok()
        made = content_of(self.doc.Drill)
        self.assertEqual(self.doc.Drill.Radius.Value, 0.6)
        self.doc.undo()
        self.assertEqual(self.doc.Drill.Radius.Value, 0.5)
        self.doc.redo()
        self.assertEqual(content_of(self.doc.Drill), made)

    def test_deleted_and_back(self):
        self.doc.openTransaction("Delete")
        self.doc.removeObject("Drill")
        self.doc.commitTransaction()
        self.doc.undo()
        spin(0.1)
        self.assertIn("FemScalpel_Drill.", self.doc.Drill.ViewObject.Proxy.getIcon())
        self.doc.Drill.ViewObject.doubleClicked()
        self.wait_for_preview()
        press_cancel()


class ContextMenu(TreeTest):
    def setUp(self):
        super().setUp()
        self.analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        self.analysis.addObject(self.mesh)
        self.crack = self.make(self.mesh, 2.9, "A")
        self.doc.UndoMode = 1

    def trigger(self, text):
        menu, actions = actions_of(self.crack)
        self.assertIn(text, actions)
        self.assertTrue(actions[text].isEnabled(), text)
        actions[text].trigger()
        spin(0.1)
        menu.deleteLater()

    def test_into_the_analysis_and_out(self):
        self.trigger("Put into the analysis")
        self.assertIn(self.crack, self.analysis.Group)
        self.assertNotIn(self.mesh, self.analysis.Group)
        self.trigger("Take out of the analysis")
        self.assertEqual([self.mesh], [m for m in self.analysis.Group if m.isDerivedFrom("Fem::FemMeshObject")])

    def test_inspections(self):
        for text, name in (("Group inspector", "groups"), ("Mesh quality", "histogram")):
            self.trigger(text)
            self.assertTrue(FreeCADGui.Control.activeDialog())
            wait_until(lambda name=name: is_shown(name), text)
            self.assertIn(self.crack.Label, widget("meshName").text())
            press_button(QtGui.QDialogButtonBox.Close)
        self.trigger("Edit")
        self.wait_for_preview()
        press_cancel()

    def test_report(self):
        self.trigger("Report…")
        text = widget("reportText").toPlainText()
        self.assertEqual(text.splitlines(), list(self.crack.GroupReport))
        widget("femscalpelReport").close()

    def test_crack_is_lit(self):
        self.mesh.ViewObject.Visibility = False
        spin(0.2)
        self.assertEqual(faces_drawn("FemScalpelMadeLips"), 0)
        self.trigger("Show crack")
        self.assertGreater(faces_drawn("FemScalpelMadeLips"), 20)
        self.assertGreater(self.crack.ViewObject.Transparency, 50)
        screenshot("crack_lit")
        self.trigger("Show crack")
        self.assertEqual(self.crack.ViewObject.Transparency, 0)
        self.assertFalse(self.crack.ViewObject.Proxy.crack.lips.is_shown)


class Recomputing(TreeTest):
    def test_geometry_that_changes_without_the_mesh(self):
        """Nothing of a chain is made anew for the sake of a part that is as it was."""
        box = self.doc.addObject("Part::Box", "Box")
        box.Length, box.Width, box.Height = 14, 5, 4
        mesh = ObjectsFem.makeMeshGmsh(self.doc, "OfBox")
        setattr(mesh, geometry_link(mesh), box)
        mesh.FemMesh = self.mesh.FemMesh
        self.doc.recompute()
        second = self.make(self.make(mesh, 2.9, "A"), 9.1, "B")
        before = content_of(second)
        with mock.patch.object(MeshOperation, "result", side_effect=AssertionError("a mesh was made")):
            for change in (
                lambda: box.touch(),
                lambda: setattr(box, "Label", "Other"),
                lambda: setattr(box.ViewObject, "ShapeColor", (1.0, 0.0, 0.0)),
                lambda: setattr(self.doc.addObject("Part::Cylinder", "Other"), "Radius", 3),
                lambda: mesh.touch(),
            ):
                change()
                self.doc.recompute()
                self.assertEqual(content_of(second), before)
        self.assertEqual([o.Name for o in self.doc.Objects if "Invalid" in o.State], [])


class MadeCrackInView(TreeTest):
    def switch(self, crack):
        return crack.ViewObject.Proxy.crack._switch.whichChild.getValue()

    def test_border_is_drawn(self):
        crack = self.make(self.mesh, 2.9, "A")
        spin(0.2)
        self.assertGreater(lines_drawn("FemScalpelMadeOutline"), 10)
        self.assertEqual(lines_drawn("FemScalpelMadeFront"), 0)
        self.mesh.ViewObject.Visibility = False
        spin(0.1)
        screenshot("crack_in_normal_view")
        points = shapes_in("FemScalpelMadeOutline", coin.SoCoordinate3)[0].point.getValues()
        for point in points:  # on the plane, around the box
            x, y, z = point.getValue()
            self.assertAlmostEqual((x - 2.9) + 0.1 * (y - 2.5), 0, places=4)
            self.assertTrue(min(abs(y), abs(y - 5), abs(z), abs(z - 4)) < 1e-5)
        crack.ViewObject.Visibility = False
        self.assertEqual(self.switch(crack), coin.SO_SWITCH_NONE)
        crack.ViewObject.Visibility = True
        self.assertEqual(self.switch(crack), coin.SO_SWITCH_ALL)

    def test_front_is_drawn(self):
        ObjectsFemScalpel.makeCrack(
            self.doc, self.mesh, origin=(6.9, 2.5, 2), normal=(1, 0, 0), patch="Disk", patch_radius=1.2
        )
        self.doc.recompute()
        spin(0.2)
        self.assertGreater(lines_drawn("FemScalpelMadeFront"), 10)

    def test_drawn_after_loading(self):
        self.make(self.mesh, 2.9, "A")
        spin(0.1)
        count = lines_drawn("FemScalpelMadeOutline")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "crack.FCStd")
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            self.doc = FreeCAD.openDocument(path)
        wait_until(lambda: lines_drawn("FemScalpelMadeOutline") == count, "the crack of the loaded mesh")

    def test_follows_a_change(self):
        crack = self.make(self.mesh, 2.9, "A")
        crack.PlanePlacement.Base.x = 6.1
        self.doc.recompute()
        spin(0.2)
        points = shapes_in("FemScalpelMadeOutline", coin.SoCoordinate3)[0].point.getValues()
        self.assertGreater(min(p.getValue()[0] for p in points), 5)


class Deleting(TreeTest):
    def test_analysis_gets_its_source_back(self):
        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        analysis.addObject(self.mesh)
        first = self.make(self.mesh, 2.9, "A")
        ObjectsFemScalpel.putIntoAnalysis(first)
        second = self.make(first, 9.1, "B")
        ObjectsFemScalpel.putIntoAnalysis(second)
        for mesh in (self.mesh, first):
            mesh.ViewObject.Visibility = False
        self.doc.clearUndos()
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.doc.Name, second.Name)
        FreeCADGui.runCommand("Std_Delete")
        spin(0.1)
        self.assertEqual([o.Name for o in self.doc.Objects if o.isDerivedFrom("Fem::FemMeshObject")], ["Mesh", "Crack"])
        self.assertIn(first, analysis.Group)
        self.assertTrue(first.ViewObject.Visibility)
        self.assertFalse(self.mesh.ViewObject.Visibility)
        self.assertEqual(len(self.doc.UndoNames), 1)
        self.doc.undo()
        spin(0.2)
        self.assertEqual([m.Name for m in analysis.Group if m.isDerivedFrom("Fem::FemMeshObject")], ["Crack001"])
        self.assertGreater(self.doc.Crack001.FemMesh.VolumeCount, 0)
