# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which mesh a command takes, and what is selected afterwards."""

import FemGui
import FreeCADGui
import ObjectsFem
from PySide import QtGui

import ObjectsFemScalpel
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from femscalpeltest.meshes import box_with_groups

OPERATIONS = (
    "Crack",
    "FaceCrack",
    "CylindricalCrack",
    "CurvedCrack",
    "Drill",
    "Incision",
    "Merge",
    "Fillet",
    "Reshape",
    "Refine",
)
Box = QtGui.QMessageBox


def selected():
    return [s.ObjectName for s in FreeCADGui.Selection.getSelectionEx()]


class RightMesh(GuiTest):
    def setUp(self):
        super().setUp()
        self.mesh = self.add_mesh(box_with_groups())

    def add_crack(self, source, at, name="Crack"):
        crack = ObjectsFemScalpel.makeCrack(
            self.doc, source, name, origin=(at, 2, 2), normal=(1, 0.1, 0.2), group_name=f"{name}{at * 10:g}"
        )
        self.doc.recompute()
        return crack

    def select(self, *objects):
        FreeCADGui.Selection.clearSelection()
        for obj in objects:
            FreeCADGui.Selection.addSelection(self.doc.Name, obj.Name)

    def named(self, command="Crack"):
        """The mesh that the panel names which a command opens."""
        self.run_command("FemScalpel_" + command)
        wait_until(lambda: is_shown("meshName"), "the name of the mesh")
        text = widget("meshName").text()
        press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)
        return text

    def answered(self, answer, command="Crack"):
        """(question, the mesh that the panel names then or None); the question must come."""
        texts = []

        def handle(box):
            texts.append(box.text())
            box.button(answer).click()

        with_dialog(Box, handle, lambda: FreeCADGui.runCommand("FemScalpel_" + command))
        name = None
        if FreeCADGui.Control.activeDialog():
            name = widget("meshName").text()
            press_cancel()
        return texts[0], name

    def test_afterwards(self):
        self.select(self.mesh)
        for at in ("1.3", "4.6"):
            self.run_command("FemScalpel_Crack")
            self.wait_for_preview()
            source = self.doc.Objects[-1]
            type_into("originX", at)
            self.wait_for_preview()
            press_ok()
            made = self.doc.Objects[-1]
            self.assertEqual(made.Source, source)
            self.assertEqual(selected(), [made.Name])
            self.assertEqual([source.ViewObject.Visibility, made.ViewObject.Visibility], [False, True])
        screenshot("selected_afterwards")

    def test_named(self):
        self.mesh.Label = "Left half & <b>"
        for command in (*OPERATIONS, "GroupInspector", "MeshQuality"):
            with self.subTest(command=command):
                self.assertEqual(self.named(command), "Mesh: Left half & <b>")

    def test_named_when_edited(self):
        crack = self.add_crack(self.mesh, 3.3)
        crack.ViewObject.doubleClicked()
        self.wait_for_preview()
        self.assertEqual(widget("meshName").text(), "Mesh: Mesh")

    def test_last_of_the_chain(self):
        second = self.add_crack(self.add_crack(self.mesh, 1.3), 4.6)
        self.assertEqual(self.named(), "Mesh: " + second.Label)

    def test_mesh_of_the_analysis(self):
        other = self.add_mesh(box_with_groups(), "Other")
        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        analysis.addObject(other)
        self.assertEqual(self.named(), "Mesh: Other")
        crack = self.add_crack(other, 3.3)
        self.add_crack(self.mesh, 3.3, "Third")
        self.assertEqual(self.named(), "Mesh: " + crack.Label)
        ObjectsFemScalpel.putIntoAnalysis(crack)
        self.assertEqual(self.named(), "Mesh: " + crack.Label)

    def test_mesh_of_the_active_analysis(self):
        other = self.add_mesh(box_with_groups(), "Other")
        for mesh in (self.mesh, other):
            ObjectsFem.makeAnalysis(self.doc, "Of" + mesh.Name).addObject(mesh)
        self.addCleanup(FemGui.setActiveAnalysis)
        for mesh in (other, self.mesh):
            FemGui.setActiveAnalysis(self.doc.getObject("Of" + mesh.Name))
            self.assertEqual(self.named(), "Mesh: " + mesh.Label)

    def test_analysis_with_two_ends(self):
        ObjectsFem.makeAnalysis(self.doc, "Analysis").addObject(self.mesh)
        for name in ("First", "Second"):
            self.add_crack(self.mesh, 3.3, name)
        text = message_during(lambda: FreeCADGui.runCommand("FemScalpel_Crack"))
        self.assertIn("Select the one you mean", text)

    def test_source_of_another_operation(self):
        second = self.add_crack(self.add_crack(self.mesh, 1.3), 4.6)
        self.select(self.mesh)
        for command in OPERATIONS:
            with self.subTest(command=command):
                text, name = self.answered(Box.Yes, command)
                self.assertIn("Mesh is the source of another operation. Take Crack001, the latest, instead?", text)
                self.assertEqual(name, "Mesh: " + second.Label)
                self.assertEqual(self.answered(Box.No, command)[1], "Mesh: Mesh")
                self.assertIsNone(self.answered(Box.Cancel, command)[1])
        for command in ("GroupInspector", "MeshQuality"):
            self.assertEqual(self.named(command), "Mesh: Mesh", "asked although nothing is changed")
        self.assertEqual(selected(), ["Mesh"])

    def test_latest_with_an_error_is_not_offered(self):
        crack = self.add_crack(self.mesh, 1.3)
        self.add_crack(crack, 90, "Beside")
        self.select(self.mesh)
        self.assertEqual(self.named(), "Mesh: Mesh")
