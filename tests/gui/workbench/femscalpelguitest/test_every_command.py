# SPDX-License-Identifier: LGPL-2.1-or-later
"""What holds for every command: texts, when it is active, and what it says when it cannot work."""

import gc
import importlib

import FreeCAD
import FreeCADGui
import numpy as np

import femscalpel as fs
from femscalpelgui.commands import COMMANDS, IN_MENU
from femscalpelgui.commands.import_mesh import ImportMesh
from femscalpelgui.view.preview_data import PreviewData, PreviewSource
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest
from .test_crack_panel import long_box, traces

from PySide import QtCore, QtGui

shiboken = importlib.import_module("shiboken2" if QtCore.qVersion().startswith("5") else "shiboken6")

MESH_COMMANDS = [command for command in COMMANDS if command not in (None, ImportMesh)]
OPERATORS = (
    "FemScalpel_Crack",
    "FemScalpel_CylindricalCrack",
    "FemScalpel_Drill",
    "FemScalpel_Incision",
    "FemScalpel_Refine",
)


def meshes():
    """How many meshes panels have read."""
    gc.collect()
    return sum(isinstance(obj, (PreviewSource, PreviewData)) for obj in gc.get_objects())


def wrapped_boxes():
    """Which boxes of buttons Python knows."""
    return {id(obj) for obj in gc.get_objects() if isinstance(obj, QtGui.QDialogButtonBox)}


def bricks():
    """Four hexahedra in a row."""
    points = np.array([(x, y, z) for z in range(2) for y in range(2) for x in range(5)], float)
    return fs.Mesh(points, {"hexahedron": [[i, i + 1, i + 6, i + 5, i + 10, i + 11, i + 16, i + 15] for i in range(4)]})


class EveryCommand(GuiTest):
    def test_texts(self):
        for command in filter(None, COMMANDS + IN_MENU):
            with self.subTest(command=command.NAME):
                action = FreeCADGui.Command.get(command.NAME).getAction()[0]
                self.assertGreater(len(action.whatsThis()), 100)
                self.assertIn(action.whatsThis()[:60], command.WHATS_THIS)
                self.assertIn(command.TOOLTIP[:40], action.toolTip())
                self.assertFalse(action.icon().isNull())

    def test_keys_are_each_command_s_own(self):
        """No two have the same keys, nor the beginning of another's; nor any of FreeCAD's own or of the FEM workbench,
        whose commands stay known once it was active."""
        FreeCADGui.activateWorkbench("FemWorkbench")
        FreeCADGui.activateWorkbench("FemScalpelWorkbench")
        ours = {command.NAME: command.ACCEL for command in filter(None, COMMANDS + IN_MENU) if command.ACCEL}
        self.assertGreater(len(ours), 10)
        names = [n for n in FreeCADGui.Command.listAll() if n.startswith(("Std_", "FEM_")) or n in ours]
        keys = {name: self.keys_of(FreeCADGui.Command.get(name)) for name in names}
        self.assertEqual(keys["Std_Undo"], ("CTRL+Z",))
        self.assertEqual(keys["FEM_Analysis"], ("S", "A"))
        for ours_name in ours:
            mine = keys[ours_name]
            self.assertEqual(mine, self.parts(ours[ours_name]))
            for name, other in keys.items():
                if other and name != ours_name:
                    shorter = min(len(mine), len(other))
                    self.assertNotEqual(mine[:shorter], other[:shorter], f"{ours_name} and {name}")

    @staticmethod
    def parts(text):
        return tuple(part.strip().upper() for part in text.split(", ")) if text else ()

    def keys_of(self, command):
        return self.parts(command.getShortcut() or command.getInfo()["shortcut"])

    def test_without_a_usable_mesh(self):
        for name in ("First", "Second", "Third"):
            self.add_mesh(long_box(), name)
        self.doc.addObject("Fem::FemMeshObject", "Empty")
        self.doc.addObject("App::FeaturePython", "Thing")
        self.doc.addObject("App::DocumentObjectGroup", "Folder")
        before = traces(self.doc)
        for command in MESH_COMMANDS:
            for selected, text in (
                ((), "Select the one you mean"),
                (("First", "Second", "Third"), "Select one"),
                (("Thing",), "Thing is not a FEM mesh. Select the mesh"),
                (("Folder",), "Folder is not a FEM mesh"),
                (("Empty",), "Empty has no mesh yet: it is empty. Make the mesh first"),
            ):
                with self.subTest(command=command.NAME, selected=selected):
                    FreeCADGui.Selection.clearSelection()
                    for name in selected:
                        FreeCADGui.Selection.addSelection(self.doc.Name, name)
                    self.assertIn(text, message_during(lambda: FreeCADGui.runCommand(command.NAME)))
                    self.assertFalse(FreeCADGui.Control.activeDialog())
        FreeCADGui.Selection.clearSelection()
        self.assertEqual(traces(self.doc), before)
        for name in ("First", "Second", "Third", "Empty"):
            self.doc.removeObject(name)
        for command in MESH_COMMANDS:
            with self.subTest(command=command.NAME):
                self.assertFalse(FreeCADGui.Command.get(command.NAME).isActive())
                self.assertIn("no FEM mesh. Make one", message_during(command().Activated))
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
        for command in MESH_COMMANDS:
            with self.subTest(command=command.NAME):
                self.assertFalse(FreeCADGui.Command.get(command.NAME).isActive())
                self.assertIn("Open a document", message_during(command().Activated))

    def test_nothing_is_left_of_panels(self):
        """A panel that is closed goes, with the mesh it has read; and none of what PySide has made for it stays to be
        taken for what comes to lie in its place."""
        self.add_mesh(long_box())
        self.add_mesh(long_box(), "Other")
        before = wrapped_boxes()  # of FreeCAD's own panels, by tests before
        for command in MESH_COMMANDS:
            if command.NAME == "FemScalpel_Export":  # no panel
                continue
            with self.subTest(command=command.NAME):
                FreeCADGui.Selection.clearSelection()
                FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
                self.assertEqual(meshes(), 0)
                self.run_command(command.NAME)
                wait_until(lambda: meshes() > 0, "the mesh")
                spin(0.3)
                items = [
                    w for w in shiboken.getAllValidWrappers() if isinstance(w, (QtGui.QWidgetItem, QtGui.QSpacerItem))
                ]
                press_button(QtGui.QDialogButtonBox.Cancel, QtGui.QDialogButtonBox.Close)
                self.assertEqual(items, [])
                wait_until(lambda: meshes() == 0, "the end of the panel's mesh")
                gc.collect()
                self.assertEqual(wrapped_boxes() - before, set())

    def test_mesh_with_an_error(self):
        import ObjectsFemScalpel

        self.add_mesh(long_box())
        crack = ObjectsFemScalpel.makeCrack(self.doc, self.doc.Mesh, origin=(90, 0, 0), normal=(1, 0, 0))
        self.doc.recompute()
        FreeCADGui.Selection.addSelection(self.doc.Name, crack.Name)
        for command in MESH_COMMANDS:
            with self.subTest(command=command.NAME):
                self.assertIn(
                    "Crack has an error. Mend it", message_during(lambda: FreeCADGui.runCommand(command.NAME))
                )

    def test_hexahedra_are_converted(self):
        self.add_mesh(bricks(), "Bricks")
        for name in OPERATORS:
            with self.subTest(command=name):
                self.run_command(name)
                if is_shown("radius"):
                    type_into("originY", "0.2")
                    type_into("radius", "0.6")
                else:
                    type_into("originX", "2.3")  # not between two of them
                wait_until(lambda: "hexahedr" in widget("status").text().lower(), "what will be converted")
                screenshot("hexahedra_" + name)
                press_ok()
                self.assertFalse(FreeCADGui.Control.activeDialog())
                made = self.doc.ActiveObject
                self.assertGreater(made.FemMesh.TetraCount, 0)
                self.doc.undo()
                self.assertEqual([o.Name for o in self.doc.Objects], ["Bricks"])

    def test_tool_beside_the_part(self):
        self.add_mesh(long_box())
        for name in OPERATORS:
            with self.subTest(command=name):
                self.run_command(name)
                for field in ("originX", "originY"):
                    type_into(field, "500")
                text = self.wait_for_message("geometryError")
                self.assertRegex(text, "misses the mesh|Nothing to refine")
                self.assertIn("Move the", text)
                screenshot("beside_" + name)
                press_ok()
                self.assertTrue(FreeCADGui.Control.activeDialog(), "closed although nothing could be made")
                press_cancel()
                self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])

    def test_bricks_are_looked_at(self):
        # What only looks takes what the operators refuse.
        self.add_mesh(bricks(), "Bricks")
        for name in ("FemScalpel_GroupInspector", "FemScalpel_MeshQuality"):
            self.run_command(name)
            wait_until(lambda: "4 elements" in widget("status").text(), "the mesh")
            press_button(QtGui.QDialogButtonBox.Close)

    def test_example(self):
        self.assertTrue(FreeCADGui.Command.get("FemScalpel_Example").isActive())
        FreeCADGui.runCommand("FemScalpel_Example")
        caisson = FreeCAD.ActiveDocument
        self.assertNotEqual(caisson.Name, self.doc.Name)
        self.assertEqual(caisson.Caisson.FemMesh.GroupCount, 35)
        self.assertIn(caisson.Caisson, caisson.Analysis.Group)
        self.assertEqual(caisson.UndoNames, [])
        self.look()
        screenshot("example")
        self.doc = caisson
        self.run_command("FemScalpel_Crack")
        choose("patch", "Whole")
        for name, number in zip(
            ("originX", "originY", "originZ", "normalX", "normalY", "normalZ"), (200, -50, 430, -0.33, -0.30, 1)
        ):
            type_into(name, repr(number))
        self.wait_for_preview()
        wait_until(lambda: lines_drawn("FemScalpelOutline") > 0, "the crack")
        screenshot("example_crack")
        self.assertTrue(widget("intoAnalysis").isChecked())
        press_ok()
        self.assertIn(caisson.Crack, caisson.Analysis.Group)
