# SPDX-License-Identifier: LGPL-2.1-or-later
"""A whole session, recorded as a macro, gives the identical meshes when replayed without a window."""

import json
import os
import shutil
import subprocess
import sys
import tempfile

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

import femscalpel as fs
from femscalpeltest.meshes import grid_box
from .gui_testing import *  # noqa: F403
from .gui_testing import GuiTest, QTest
from .mesh_content import content_of
from .test_crack_panel import enter_plane, long_box

_REPLAY = """
import json, sys
import FreeCAD
sys.path[:0] = {path!r}
from femscalpelguitest.mesh_content import content_of
doc = FreeCAD.openDocument({document!r})
exec(compile(open({macro!r}).read(), {macro!r}, "exec"), {{"__name__": "__main__"}})
with open({out!r}, "w") as file:
    json.dump({{o.Name: content_of(o) for o in doc.Objects if o.isDerivedFrom("Fem::FemMeshObject")}}, file)
"""


class Macro(GuiTest):
    def record(self, folder, name):
        """Starts FreeCAD's macro recorder through its dialog."""

        def fill():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is not None:
                timer.stop()
                dialog.findChild(QtGui.QLineEdit, "lineEditPath").setText(name)
                QTest.mouseClick(dialog.findChild(QtGui.QPushButton, "buttonStart"), QtCore.Qt.LeftButton)

        FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Macro").SetString("MacroPath", folder)
        timer = QtCore.QTimer()
        timer.timeout.connect(fill)
        timer.start(100)
        FreeCADGui.runCommand("Std_DlgMacroRecord")
        timer.stop()
        self.is_recording = True
        self.addCleanup(self.stop_recording)  # a test that failed meanwhile must not leave the next one a dialog

    def stop_recording(self):
        if self.is_recording:
            self.is_recording = False
            # FreeCAD 1.0 has one command that starts and stops.
            stop = "Std_MacroStopRecord"
            self.run_command(stop if FreeCADGui.Command.get(stop) else "Std_DlgMacroRecord")

    def test_session_replayed_without_window(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "source.FCStd")
            self.add_mesh(long_box())
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            self.doc = FreeCAD.openDocument(path)
            self.look()
            macro = os.path.join(folder, "session.FCMacro")
            self.record(folder, "session.FCMacro")

            self.run_command("FemScalpel_GroupInspector")
            wait_until(lambda: widget("groups").rowCount() > 0, "the list of groups")
            widget("groups").findItems("FIX", QtCore.Qt.MatchExactly)[0].setText("SUPPORT")
            wait_until(lambda: "RenamedGroups" in self.doc.Mesh.PropertiesList, "the new name")
            press_button(QtGui.QDialogButtonBox.Close)

            self.run_command("FemScalpel_Crack")
            self.wait_for_preview()
            enter_plane((4.123456789, 2.5, 2.0), (1.0, 0.2, 0.1))
            choose("patch", "HalfPlane")
            type_into("patchTurn", "20")
            choose("refine", "Size")
            type_into("refineSize", "0.7")
            self.wait_for_preview()
            press_ok()
            FreeCADGui.Selection.addSelection(self.doc.Name, "Crack")
            self.run_command("FemScalpel_CylindricalCrack")
            wait_until(lambda: "…" not in widget("status").text(), "the panel")
            for name, text in (("originX", "10.3"), ("normalX", "0"), ("normalZ", "1"), ("radius", "1.2")):
                type_into(name, text)
            self.wait_for_preview()
            press_ok()
            FreeCADGui.Selection.clearSelection()
            FreeCADGui.Selection.addSelection(self.doc.Name, "CylindricalCrack")
            self.run_command("FemScalpel_Drill")
            wait_until(lambda: "…" not in widget("status").text(), "the panel")
            for name, text in (
                ("originX", "7.2"),
                ("originY", "2.4"),
                ("normalX", "0"),
                ("normalZ", "-1"),
                ("radius", "0.9"),
            ):
                type_into(name, text)
            self.wait_for_preview()
            press_ok()
            FreeCADGui.Selection.clearSelection()
            FreeCADGui.Selection.addSelection(self.doc.Name, "Drill")
            self.run_command("FemScalpel_Incision")
            wait_until(lambda: "…" not in widget("status").text(), "the panel")
            enter_plane((12.9, 2.5, 2.0), (1.0, 0.1, 0.0))
            type_into("slotWidth", "0.4")
            choose("slotEnd", "Point")
            self.wait_for_preview()
            press_ok()
            FreeCADGui.Selection.clearSelection()
            FreeCADGui.Selection.addSelection(self.doc.Name, "Mesh")
            with_dialog(
                QtGui.QMessageBox,
                lambda box: box.button(QtGui.QMessageBox.No).click(),  # not the latest, but this one
                lambda: self.run_command("FemScalpel_Refine"),
            )
            wait_until(lambda: "…" not in widget("status").text(), "the panel")
            type_into("edgeSize", "0.6")
            self.wait_for_preview()
            press_ok()
            self.doc.Crack.ViewObject.doubleClicked()
            self.wait_for_preview()
            type_into("offset", "0.3333")
            self.wait_for_preview()
            press_ok()
            self.stop_recording()

            here = json.loads(json.dumps({o.Name: content_of(o) for o in self.doc.Objects}))
            self.assertEqual(set(here), {"Mesh", "Crack", "CylindricalCrack", "Drill", "Incision", "Refine"})
            text = self.replayed(folder, macro, path, here)
            for line in (
                "import ObjectsFemScalpel",
                "ObjectsFemScalpel.renameGroup(",
                "ObjectsFemScalpel.makeCrack(",
                "ObjectsFemScalpel.makeCylindricalCrack(",
                "ObjectsFemScalpel.makeDrill(",
                "ObjectsFemScalpel.makeCut(",
                "ObjectsFemScalpel.makeRefine(",
                ".PlanePlacement = FreeCAD.Placement(",
            ):
                self.assertIn(line, text)

    def test_material_replayed_without_window(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "source.FCStd")
            holed = fs.drill(grid_box((14, 5, 4), (14.0, 5.0, 4.0)), fs.Cylinder((3.1, 2.4, 0), (0, 0, 1), 0.8)).mesh
            self.add_mesh(holed)
            self.add_mesh(grid_box((3, 3, 2), (3.0, 3.0, 2.0)), "Boss").Placement.Base = FreeCAD.Vector(8.2, 1.3, 4)
            self.doc.recompute()
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            self.doc = FreeCAD.openDocument(path)
            self.look()
            macro = os.path.join(folder, "material.FCMacro")
            self.record(folder, "material.FCMacro")
            for command, source, enter in (
                ("Merge", "Mesh", lambda: type_into("mergeTolerance", "0.01")),
                ("Fillet", "Merge", self.pick_edge),
                ("Reshape", "Fillet", lambda: (choose("wall", "HOLE_WALL"), type_into("radius", "1.05"))),
            ):
                FreeCADGui.Selection.clearSelection()
                FreeCADGui.Selection.addSelection(self.doc.Name, source)
                self.run_command("FemScalpel_" + command)
                wait_until(lambda: "…" not in widget("status").text(), "the panel")
                enter()
                self.wait_for_preview()
                press_ok()
            self.doc.Merge.ViewObject.doubleClicked()
            self.wait_for_preview()
            choose("keep", "addition")
            self.wait_for_preview()
            press_ok()
            self.stop_recording()
            here = json.loads(json.dumps({o.Name: content_of(o) for o in self.doc.Objects}))
            self.assertEqual(set(here), {"Mesh", "Boss", "Merge", "Fillet", "Reshape"})
            text = self.replayed(folder, macro, path, here)
            for line in (
                "ObjectsFemScalpel.makeMerge(",
                "addition=FreeCAD.ActiveDocument.getObject('Boss')",
                "ObjectsFemScalpel.makeFillet(",
                "ObjectsFemScalpel.makeReshape(",
                ".Addition = ",
            ):
                self.assertIn(line, text)

    def pick_edge(self):
        click("pickEdge")
        FreeCADGui.Selection.addSelection(self.doc.Name, "Merge", "Elem1F1", 6.123456789, 0.0, 0.0123456789)
        spin(0.1)
        type_into("filletRadius", "0.7")

    def replayed(self, folder, macro, document, here):
        """The text of a macro; replayed without a window on a saved document it must give the meshes `here`."""
        self.assertTrue(os.path.exists(macro), os.listdir(folder))
        out = os.path.join(folder, "meshes.json")
        script = os.path.join(folder, "replay.py")
        with open(script, "w") as file:
            file.write(_REPLAY.format(path=[p for p in sys.path if p], document=document, macro=macro, out=out))
        done = subprocess.run(
            [shutil.which("freecadcmd") or shutil.which("FreeCADCmd"), script],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env={**os.environ, "FREECAD_USER_HOME": folder},
        )
        self.assertTrue(os.path.exists(out), done.stdout)
        with open(out) as file:
            there = json.load(file)
        self.assertEqual(set(there), set(here))
        for name in here:
            self.assertTrue(there[name] == here[name], f"{name} differs")
        with open(macro) as file:
            return file.read()
