# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands that look at a mesh: group inspector and mesh quality."""

import FreeCAD
import numpy as np

import femmesh_bridge
import femscalpel as fs
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .test_crack_panel import long_box, traces

from PySide import QtCore, QtGui


class GroupInspector(GuiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(long_box())

    def open_panel(self):
        self.run_command("FemScalpel_GroupInspector")
        wait_until(lambda: widget("groups").rowCount() > 0, "the list of groups")

    def cell(self, name, column):
        table = widget("groups")
        return table.item(table.findItems(name, QtCore.Qt.MatchExactly)[0].row(), column).text()

    def tick(self, name):
        table = widget("groups")
        item = table.findItems(name, QtCore.Qt.MatchExactly)[0]
        item.setCheckState(QtCore.Qt.Checked)
        spin(0)

    def test_groups_and_their_sizes(self):
        import ObjectsFem

        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        material = ObjectsFem.makeMaterialSolid(self.doc, "Steel")
        analysis.addObject(self.mesh)
        analysis.addObject(material)
        femmesh = self.mesh.FemMesh.copy()
        femmesh.addGroupElements(femmesh.addGroup(f"{material.Name}_Volumes", "Volume"), list(femmesh.Volumes))
        self.mesh.FemMesh = femmesh
        self.doc.recompute()
        self.open_panel()
        mesh = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        self.assertEqual(widget("groups").rowCount(), len(mesh.groups.all()))
        self.assertEqual(self.cell("LEFT", 3), str(len(mesh.groups["LEFT"])))
        self.assertEqual(self.cell("LEFT", 4), "100 mm³")
        self.assertEqual(self.cell("FIX", 2), "nodes")
        self.assertEqual(self.cell(f"{material.Name}_Volumes", 5), material.Label)
        self.tick("LEFT")
        self.tick("TOP")
        self.assertEqual(points_drawn("FemScalpelInspector"), len(mesh.groups["TOP"]))
        self.assertGreater(faces_drawn("FemScalpelInspector"), 0)
        screenshot("groups_two")
        click("none")
        click("all")
        screenshot("groups_all")
        choose("what", "elementary")
        self.assertEqual(widget("groups").rowCount(), len(mesh.elementary_groups()))
        click("all")
        screenshot("groups_elementary")

    def test_virtual_boundaries(self):
        self.open_panel()
        self.tick("LEFT")
        choose("part", "bounding")
        mesh = femmesh_bridge.from_femmesh(self.mesh.FemMesh)
        expected = len(fs.virtual_boundary(mesh, "LEFT", "element").bounding.triangles)
        shown = [s for s in shapes_in("FemScalpelShape", coin.SoIndexedFaceSet)]
        self.assertEqual(sum(list(s.coordIndex.getValues()).count(-1) for s in shown), expected)
        screenshot("groups_bounding")
        click("none")
        self.tick("FIX")
        choose("part", "linking")
        shown = shapes_in("FemScalpelShape", coin.SoIndexedFaceSet)
        expected = len(fs.virtual_boundary(mesh, "FIX", "node").linking.triangles)
        self.assertEqual(sum(list(s.coordIndex.getValues()).count(-1) for s in shown), expected)

    def test_rename_undo_redo(self):
        self.open_panel()
        item = widget("groups").findItems("FIX", QtCore.Qt.MatchExactly)[0]
        item.setText("SUPPORT")
        names = lambda: sorted(self.mesh.FemMesh.getGroupName(g) for g in self.mesh.FemMesh.Groups)  # noqa: E731
        wait_until(lambda: "SUPPORT" in names(), "the new name")
        self.assertNotIn("FIX", names())
        item = widget("groups").findItems("SUPPORT", QtCore.Qt.MatchExactly)[0]
        item.setText("TOP")
        self.assertIn("taken", self.wait_for_message("error"))
        screenshot("groups_name_taken")
        self.assertTrue(widget("groups").findItems("SUPPORT", QtCore.Qt.MatchExactly))
        press_button(QtGui.QDialogButtonBox.Close)
        self.assertEqual(self.doc.UndoNames, ["Rename group FIX"])
        self.doc.undo()
        self.assertIn("FIX", names())
        self.doc.redo()
        self.assertIn("SUPPORT", names())

    def test_colour_chosen(self):
        from femscalpelgui import preferences

        self.open_panel()
        self.tick("LEFT")
        table = widget("groups")
        cell = table.item(table.findItems("LEFT", QtCore.Qt.MatchExactly)[0].row(), 1)

        def choose_colour(dialog):
            dialog.setCurrentColor(QtGui.QColor(10, 200, 30))
            screenshot("groups_colour")
            dialog.accept()

        place = table.visualItemRect(cell).center()
        with_dialog(
            QtGui.QColorDialog,
            choose_colour,
            lambda: (
                QTest.mouseClick(table.viewport(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, place),
                QTest.mouseDClick(table.viewport(), QtCore.Qt.LeftButton, QtCore.Qt.NoModifier, place),
            ),
        )
        self.assertEqual(cell.background().color().getRgb()[:3], (10, 200, 30))
        drawn = [
            tuple(round(255 * c) for c in m.diffuseColor[0].getValue())
            for m in shapes_in("FemScalpelShapeFaces", coin.SoMaterial)
        ]
        self.assertIn((10, 200, 30), drawn)
        press_button(QtGui.QDialogButtonBox.Close)
        self.open_panel()
        table = widget("groups")
        again = table.item(table.findItems("LEFT", QtCore.Qt.MatchExactly)[0].row(), 1)
        self.assertEqual(again.background().color().getRgb()[:3], (10, 200, 30))
        FreeCAD.ParamGet(preferences.GROUP).RemGroup("GroupColours")

    def test_leaves_no_trace(self):
        before = traces(self.doc)
        self.open_panel()
        click("all")
        press_button(QtGui.QDialogButtonBox.Close)
        self.assertEqual(traces(self.doc), before)
        self.assertIsNone(in_scene("FemScalpelInspector"))


class MeshQuality(GuiTest):
    def test_measures_and_worst_elements(self):
        plain = long_box()
        points = plain.points.copy()
        inner = np.flatnonzero((points > 0.5).all(axis=1) & (points < (13.5, 4.5, 3.5)).all(axis=1))
        points[inner] += np.random.default_rng(1).uniform(-0.3, 0.3, (len(inner), 3))
        mesh = fs.Mesh(points, plain.cells)
        obj = self.add_mesh(mesh)
        before = traces(self.doc)
        self.run_command("FemScalpel_MeshQuality")
        wait_until(lambda: widget("worst").rowCount() > 0, "the worst elements")
        for measure, function in (
            ("mean ratio", fs.mean_ratio),
            ("smallest angle", fs.smallest_angle),
            ("scaled Jacobian", fs.scaled_jacobian),
        ):
            with self.subTest(measure=measure):
                choose("measure", measure)
                values = function(mesh)["tetra"]
                order = np.argsort(values, kind="stable")
                number = int(widget("worst").item(0, 0).text())
                self.assertEqual(number, femmesh_bridge.from_femmesh(obj.FemMesh).cell_ids["tetra"][order[0]])
                self.assertEqual(widget("histogram").after.sum(), len(values))
                self.assertIn(f"{values.min():.3f}", widget("status").text())
                screenshot("quality_" + measure.replace(" ", "_"))
        table = widget("worst")
        height = view().getCameraNode().height.getValue()
        QTest.mouseClick(
            table.viewport(),
            QtCore.Qt.LeftButton,
            QtCore.Qt.NoModifier,
            table.visualItemRect(table.item(0, 0)).center(),
        )
        spin(0.1)
        self.assertLess(view().getCameraNode().height.getValue(), height)
        self.assertTrue(widget("onlyBad").isChecked())
        screenshot("quality_worst")
        press_button(QtGui.QDialogButtonBox.Close)
        self.assertEqual(traces(self.doc), before)
