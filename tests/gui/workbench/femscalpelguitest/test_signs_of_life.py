# SPDX-License-Identifier: LGPL-2.1-or-later
"""OK computes on another thread: it shows what it does, can be cancelled, and does nothing twice."""

import os
import tempfile
import threading
import time
from unittest import mock

import FreeCADGui
from PySide import QtCore, QtGui

import femmesh_bridge
import femscalpel
import ObjectsFemScalpel
from femscalpelgui import signs
from femscalpelgui.commands.export import Export
from femscalpelgui.panels import with_ok
from femscalpelobjects.crack import Crack
from .gui_testing import *  # noqa: F403
from .gui_testing import QTest
from .mesh_content import content_of
from .test_crack_panel import CrackTest, traces


class SlowCrack:
    """In place of Crack.operate: takes a while, and keeps which threads it was called on."""

    def __init__(self, seconds):
        self.seconds, self.threads = seconds, []
        self._operate = Crack.operate

    def __call__(self, proxy, obj, mesh, tools):
        self.threads.append(threading.current_thread())
        time.sleep(self.seconds)
        return self._operate(proxy, obj, mesh, tools)


class Looking:
    """Looks at the window every few milliseconds while something is done."""

    def __init__(self, at):
        self._at, self._timer = at, QtCore.QTimer()
        self._timer.timeout.connect(self._tick)
        self.longest, self._last = 0.0, time.monotonic()

    def _tick(self):
        now = time.monotonic()
        self.longest, self._last = max(self.longest, now - self._last), now
        self._at()

    def __enter__(self):
        self._last = time.monotonic()
        self._timer.start(10)
        return self

    def __exit__(self, *exception):
        self._timer.stop()
        self.longest = max(self.longest, time.monotonic() - self._last)


class SignsOfLife(CrackTest):
    def test_ok_shows_what_it_does_and_lets_the_window_live(self):
        self.open_panel()
        seen = []

        def look():
            bar = FreeCADGui.getMainWindow().statusBar().currentMessage()
            status = widget("status").text() if is_shown("status") else ""
            dialog = QtGui.QApplication.activeModalWidget()
            seen.append((bar, status, dialog.objectName() if dialog else ""))

        slow = SlowCrack(1.5)
        with mock.patch.object(Crack, "operate", lambda *args: slow(*args)), Looking(look) as looking:
            press_ok()
        self.assertEqual(self.doc.Crack.FemMesh.VolumeCount > 0, True)
        self.assertEqual(len(slow.threads), 1)
        self.assertIsNot(slow.threads[0], threading.main_thread())
        self.assertLess(looking.longest, 0.5)
        self.assertTrue(any("Computing the new mesh" in bar for bar, _, _ in seen))
        self.assertTrue(any("Computing the new mesh" in status for _, status, _ in seen))
        self.assertTrue(any(name == "femscalpelProgress" for _, _, name in seen))
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertIsNone(QtGui.QApplication.activeModalWidget())
        self.assertEqual(self.doc.UndoNames, ["Crack"])

    def test_escape_cancels_ok(self):
        self.open_panel()
        before = traces(self.doc)
        pressed = []

        def escape():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is not None and not pressed:
                pressed.append(True)
                screenshot("ok_progress")
                QTest.keyClick(dialog, QtCore.Qt.Key_Escape)

        slow = SlowCrack(1.5)
        with mock.patch.object(Crack, "operate", lambda *args: slow(*args)), Looking(escape):
            press_ok()
        self.assertTrue(pressed)
        self.assertTrue(FreeCADGui.Control.activeDialog())
        self.assertEqual(traces(self.doc), before)
        self.assertIn("Cancelled", widget("status").text())
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        press_ok()
        self.assertEqual(self.doc.Crack.Source, self.mesh)
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def test_clicks_meant_for_nothing(self):
        """A second click on OK, and one on a field, while the first is at work."""
        self.open_panel()
        done = []

        def click_about():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is not None and not done:
                done.append(True)
                press_ok()
                QTest.keyClicks(widget("groupName"), "X")

        slow = SlowCrack(1.0)
        with mock.patch.object(Crack, "operate", lambda *args: slow(*args)), Looking(click_about):
            press_ok()
        self.assertTrue(done)
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh", "Crack"])
        self.assertEqual(len(slow.threads), 1)

    def test_nothing_is_read_or_made_twice(self):
        self.open_panel()
        read, made = mock.Mock(side_effect=femmesh_bridge.from_femmesh), SlowCrack(0)
        with mock.patch.object(femmesh_bridge, "from_femmesh", read):
            with mock.patch.object(Crack, "operate", lambda *args: made(*args)):
                press_ok()
        self.assertEqual(read.call_count, 0)  # the preview has read it
        self.assertEqual(len(made.threads), 1)

    def test_escape_while_freecad_takes_the_mesh_over(self):
        self.open_panel()
        recompute = with_ok.FreeCADGui.doCommand

        def late(line):
            recompute(line)
            if "recompute()" in line:
                panel.append(FreeCADGui.Control.activeDialog())
                progress[0].cancelled = True

        panel, progress = [], []
        original = with_ok.Progress

        def kept(*args):
            progress.append(original(*args))
            return progress[0]

        with mock.patch.object(with_ok, "Progress", kept), mock.patch.object(with_ok.FreeCADGui, "doCommand", late):
            press_ok()
        self.assertTrue(panel)
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.assertIn("Cancelled", widget("status").text())

    def test_ok_waits_for_the_preview_and_escape_ends_that(self):
        from femscalpelgui.panels import tool_panel

        self.open_panel()
        preview_of, pressed = tool_panel.preview_of, []

        def slow(*args):
            time.sleep(3)
            return preview_of(*args)

        def escape():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is not None and not pressed:
                pressed.append(True)
                QTest.keyClick(dialog, QtCore.Qt.Key_Escape)

        with mock.patch.object(tool_panel, "preview_of", slow):
            type_into("originX", "6.6")
            with Looking(escape):
                press_ok()
        self.assertTrue(pressed)
        self.assertEqual([o.Name for o in self.doc.Objects], ["Mesh"])
        self.assertIn("Cancelled", widget("status").text())
        press_ok()
        self.assertAlmostEqual(self.doc.Crack.PlanePlacement.Base.x, 6.6)

    def test_edit_computes_what_follows_on_the_other_thread(self):
        first = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(2.9, 2.5, 2), normal=(1, 0, 0))
        second = ObjectsFemScalpel.makeCrack(
            self.doc, first, origin=(9.3, 2.5, 2), normal=(1, 0, 0), group_name="SECOND"
        )
        self.doc.recompute()
        self.doc.clearUndos()
        before = content_of(second)
        first.ViewObject.doubleClicked()
        self.wait_for_preview()
        slow = SlowCrack(0)
        with mock.patch.object(Crack, "operate", lambda *args: slow(*args)):
            type_into("offset", "0.4")
            self.wait_for_preview()
            press_ok()
        self.assertEqual(len(slow.threads), 2)
        self.assertNotIn(threading.main_thread(), slow.threads)
        self.assertNotEqual(content_of(second), before)
        self.assertNotIn("Touched", second.State)
        self.doc.undo()
        self.assertEqual(content_of(second), before)


class OtherWaits(CrackTest):
    """What else takes its time in large meshes: each says so before."""

    def test_panels_say_that_they_open(self):
        said = []
        with mock.patch.object(signs, "begin", lambda text: said.append(text)), mock.patch.object(signs, "end"):
            self.run_command("FemScalpel_Crack")
            self.assertEqual(said, ["Opening the panel…"])
            self.wait_for_preview()
            press_ok()
            self.doc.Crack.ViewObject.doubleClicked()
            self.assertEqual(said, 2 * ["Opening the panel…"])
            self.wait_for_preview()
            press_cancel()

    def test_a_sign_is_seen_and_goes(self):
        bar, app = FreeCADGui.getMainWindow().statusBar(), QtGui.QApplication
        with signs.busy("Waiting…"):
            self.assertEqual(bar.currentMessage(), "Waiting…")
            self.assertEqual(app.overrideCursor().shape(), QtCore.Qt.WaitCursor)
        self.assertEqual(bar.currentMessage(), "")
        self.assertIsNone(app.overrideCursor())

    def test_undo_and_redo(self):
        with mock.patch.object(signs, "QUICK", 10):
            crack = ObjectsFemScalpel.makeCrack(self.doc, self.mesh, origin=(2.9, 2.5, 2), normal=(1, 0, 0))
            self.doc.recompute()
            self.doc.openTransaction("Move")
            crack.PlanePlacement.Base.x = 6.1
            self.doc.recompute()
            self.doc.commitTransaction()
            for step in (self.doc.undo, self.doc.redo):
                events = []
                noted = (
                    mock.patch.object(signs, "begin", lambda text, events=events: events.append("begin")),
                    mock.patch.object(signs, "end", lambda text, events=events: events.append("end")),
                    mock.patch.object(
                        Crack,
                        "_set_mesh",
                        autospec=True,
                        side_effect=lambda *args, events=events, given=Crack._set_mesh: (
                            events.append("mesh"),
                            given(*args),
                        ),
                    ),
                )
                with noted[0], noted[1], noted[2]:
                    step()
                self.assertEqual(events, ["begin", "mesh", "end"])
        self.assertIsNone(QtGui.QApplication.overrideCursor())

    def test_the_status_bar_waits_for_nothing_after_the_panel(self):
        self.run_command("FemScalpel_Crack")
        bar = FreeCADGui.getMainWindow().statusBar()
        self.assertTrue(bar.currentMessage().endswith("…"))
        press_cancel()
        self.assertEqual(bar.currentMessage(), "")


class Writing(CrackTest):
    """Export writes on another thread."""

    def export(self, path, at):
        write, threads = femscalpel.write, []

        def slow(*args):
            threads.append(threading.current_thread())
            time.sleep(1.5)
            return write(*args)

        with mock.patch.object(femscalpel, "write", slow), Looking(at) as looking:
            Export.write(self.mesh, path)
        self.assertEqual(len(threads), 1)
        self.assertIsNot(threads[0], threading.main_thread())
        return looking.longest

    def test_signs(self):
        seen = []

        def look():
            dialog = QtGui.QApplication.activeModalWidget()
            seen.append((FreeCADGui.getMainWindow().statusBar().currentMessage(), dialog is not None))

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.inp")
            self.assertLess(self.export(path, look), 0.5)
            self.assertGreater(os.path.getsize(path), 1000)
            self.assertIn(f"{path} was written", FreeCADGui.getMainWindow().statusBar().currentMessage())
        self.assertTrue(any("Writing the file…" in bar for bar, _ in seen))
        self.assertTrue(any(dialog for _, dialog in seen))

    def test_escape(self):
        pressed = []

        def escape():
            dialog = QtGui.QApplication.activeModalWidget()
            if dialog is not None and not pressed:
                pressed.append(True)
                QTest.keyClick(dialog, QtCore.Qt.Key_Escape)

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh.inp")
            self.export(path, escape)
            spin(0.3)
            self.assertTrue(pressed)
            self.assertEqual(os.listdir(folder), [])
        self.assertIn("Cancelled", FreeCADGui.getMainWindow().statusBar().currentMessage())
